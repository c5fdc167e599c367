// Rules by which data follow a mesh that changes, once for all kinds of meshes. See io::DataRules.
#include <algorithm>
#include <utility>

#include "bind.hpp"
#include "data_arrays.hpp"

namespace temper::python {
namespace {

/// The file that has the data of a mesh, or null.
const io::MeshFile* file_with_data(const PyMesh& self) { return self.source() ? &self.source()->file : nullptr; }
template <class Loaded>
const io::MeshFile* file_with_data(const PySpaceMesh<Loaded>& self) {
  return self.file.get();
}

const MeshDataRules& rules_of(const PyMesh& self) { return self.data_rules(); }
template <class Loaded>
const MeshDataRules& rules_of(const PySpaceMesh<Loaded>& self) {
  return self.data_rules;
}

void set_rules(PyMesh& self, MeshDataRules rules) { self.set_data_rules(std::move(rules)); }
template <class Loaded>
void set_rules(PySpaceMesh<Loaded>& self, MeshDataRules rules) {
  refuse_while_running(self.running);
  self.data_rules = std::move(rules);
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
    const std::vector<std::string> given = strings_from(words);
    (of_points ? rules.of_points : rules.of_cells) =
        or_raise(io::parse_data_rules(given, of_points ? io::DataOf::points : io::DataOf::cells));
    const auto conserves = [](const std::string& word) { return word.starts_with("conserve"); };
    if (std::is_same_v<AnyMesh, PySurface> && std::ranges::any_of(given, conserves))
      fail(ErrorCode::unsupported, "data are not conserved on curved surfaces. Next: leave out conserve");
    const io::MeshFile* const file = file_with_data(self);
    check_data_rules(rules, file == nullptr ? io::MeshFile() : *file);
    set_rules(self, std::move(rules));
  });
}
template void define_data_rules(py::class_<PyMesh>&);
template void define_data_rules(py::class_<PyTetMesh>&);
template void define_data_rules(py::class_<PySurface>&);

}  // namespace temper::python
