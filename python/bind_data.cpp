// Rules by which data follow a mesh that changes, once for triangles and tetrahedra. See io::DataRules.
#include <algorithm>
#include <utility>

#include "bind.hpp"
#include "data_arrays.hpp"

namespace temper::python {
namespace {

/// The file that has the data of a mesh, or null.
const io::MeshFile* file_with_data(const PyMesh& self) { return self.source() ? &self.source()->file : nullptr; }
const io::MeshFile* file_with_data(const PyTetMesh& self) { return self.file.get(); }

const MeshDataRules& rules_of(const PyMesh& self) { return self.data_rules(); }
const MeshDataRules& rules_of(const PyTetMesh& self) { return self.data_rules; }

void set_rules(PyMesh& self, MeshDataRules rules) { self.set_data_rules(std::move(rules)); }
void set_rules(PyTetMesh& self, MeshDataRules rules) {
  refuse_while_running(self.running);
  self.data_rules = std::move(rules);
}

/// The data of the cells that the mesh of a file has.
const std::vector<io::DataArray>& cell_data_of(const io::MeshFile& file) {
  return file.dimension() == 3 ? file.tetrahedra.data : file.triangles.data;
}

void erase_rules_of_absent(io::DataRules& rules, const std::vector<io::DataArray>& arrays) {
  std::erase_if(rules.exceptions, [&](const auto& rule) {
    return std::ranges::find(arrays, rule.first, &io::DataArray::name) == arrays.end();
  });
}

}  // namespace

MeshDataRules without_absent(MeshDataRules rules, const io::MeshFile& file) {
  erase_rules_of_absent(rules.of_points, file.point_data);
  erase_rules_of_absent(rules.of_cells, cell_data_of(file));
  return rules;
}

void check_data_rules(const MeshDataRules& rules, const io::MeshFile& file) {
  or_raise(io::check_data_rules(rules.of_points, file.point_data, io::DataOf::points));
  or_raise(io::check_data_rules(rules.of_cells, cell_data_of(file), io::DataOf::cells));
}

template <class AnyMesh>
void define_data_rules(py::class_<AnyMesh>& type) {
  type.def("data_rules", [](const AnyMesh& self, bool of_points) {
    return to_python(io::data_rule_words(of_points ? rules_of(self).of_points : rules_of(self).of_cells));
  });
  type.def("set_data_rules", [](AnyMesh& self, bool of_points, const py::sequence& words) {
    MeshDataRules rules = rules_of(self);
    (of_points ? rules.of_points : rules.of_cells) =
        or_raise(io::parse_data_rules(strings_from(words), of_points ? io::DataOf::points : io::DataOf::cells));
    const io::MeshFile* const file = file_with_data(self);
    check_data_rules(rules, file == nullptr ? io::MeshFile() : *file);
    set_rules(self, std::move(rules));
  });
}
template void define_data_rules(py::class_<PyMesh>&);
template void define_data_rules(py::class_<PyTetMesh>&);

}  // namespace temper::python
