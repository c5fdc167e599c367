// The parts of meshes of points in space, once for tetrahedra and curved surfaces.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "bind.hpp"
#include "data_arrays.hpp"
#include "reports.hpp"

namespace temper::python {

inline std::vector<std::int32_t> numbers_of(const io::VertexOfPoint& vertex) {
  std::vector<std::int32_t> vertices;
  vertices.reserve(vertex.size());
  for (std::size_t p = 0; p < vertex.size(); ++p) vertices.push_back(vertex[p]);
  return vertices;
}

/// A mesh that was made from a file, and the warnings.
template <class Loaded>
py::tuple loaded_to_python(io::MeshFile file, Loaded loaded) {
  std::vector<std::string> warnings = std::exchange(file.warnings, {});
  warnings.insert(warnings.end(), loaded.warnings.begin(), loaded.warnings.end());
  std::vector<std::int32_t> vertices = numbers_of(loaded.vertex_of_point);
  return py::make_tuple(PySpaceMesh<Loaded>{std::make_shared<const io::MeshFile>(std::move(file)),
                                            std::make_shared<const Loaded>(std::move(loaded)), std::move(vertices)},
                        to_python(warnings));
}

/// Raises if a point of a mesh of arrays is in no cell.
inline void refuse_unused(const std::vector<std::int32_t>& vertex_of_point, const std::string& cell) {
  const auto unused = std::ranges::find(vertex_of_point, -1);
  if (unused == vertex_of_point.end()) return;
  fail(ErrorCode::unused_point,
       "point " + std::to_string(unused - vertex_of_point.begin()) + " belongs to no " + cell + ". Next: remove it");
}

/// The mesh gets its new state. `vertices`: former number of each vertex, empty if they are the same.
template <class Loaded>
void take_state(PySpaceMesh<Loaded>& self, io::MeshFile file, Loaded loaded,
                const IdVector<VertexId, VertexId>& vertices) {
  std::vector<std::int32_t> now(self.mesh().n_vertices(), -1);
  for (const VertexId v : loaded.mesh.vertices()) {
    const VertexId former = vertices.empty() ? v : vertices[v];
    if (former.valid()) now[former.index] = static_cast<std::int32_t>(v.index);
  }
  for (std::int32_t& v : self.vertex_of_point) v = v < 0 ? -1 : now[static_cast<std::size_t>(v)];
  self.data_rules = without_absent(std::move(self.data_rules), file);
  self.file = std::make_shared<const io::MeshFile>(std::move(file));
  self.loaded = std::make_shared<const Loaded>(std::move(loaded));
  ++self.version;
}

/// The mesh gets another state with the same vertices.
inline void take_mesh(PyTetMesh& self, tets::TetMesh mesh) { replace(self, std::move(mesh), {}, nullptr); }
inline void take_mesh(PySurface& self, surfaces::SurfaceMesh mesh) { replace(self, std::move(mesh)); }

template <class Loaded>
void set_space_weights(PySpaceMesh<Loaded>& self, const Doubles& weights) {
  const Run run(self.running);
  const auto values = as_span<double>(weights);
  if (values.size() != self.mesh().n_vertices()) {
    fail(ErrorCode::size_mismatch,
         "weights: expected " + std::to_string(self.mesh().n_vertices()) + ", found " + std::to_string(values.size()));
  }
  auto mesh = self.mesh();
  for (const VertexId v : mesh.vertices()) {
    if (!std::isfinite(values[v.index])) {
      fail(ErrorCode::not_finite, "weights: expected finite numbers, found " + std::to_string(values[v.index]) +
                                      " for vertex " + std::to_string(v.index));
    }
    if (!is_exact_weight(values[v.index])) {
      fail(ErrorCode::out_of_scale,
           "weights: the weight of vertex " + std::to_string(v.index) + " is out of the range of exact arithmetic");
    }
    mesh.set_weight(v, values[v.index]);
  }
  take_mesh(self, std::move(mesh));
}

/// Sets an array of point data or cell data, or with None removes it.
template <class Loaded>
void set_space_data(PySpaceMesh<Loaded>& self, bool of_points, const std::string& name, const py::object& values) {
  const Run run(self.running);
  take_mesh(self, self.mesh());  // without points of no cell
  io::MeshFile file = *self.file;
  std::vector<io::DataArray>& arrays = of_points ? file.point_data : cell_data_of(file);
  if (values.is_none()) {
    erase_array(arrays, name);
  } else {
    const std::size_t n_cells = file.dimension() == 3 ? file.tetrahedra.size() : file.triangles.size();
    io::DataArray array = from_python_array(name, values.cast<py::array>(), of_points ? file.points.size() : n_cells,
                                            of_points ? "point data" : "cell data");
    const auto same = std::ranges::find(arrays, name, &io::DataArray::name);
    (same == arrays.end() ? arrays.emplace_back() : *same) = std::move(array);
  }
  MeshDataRules rules = without_absent(self.data_rules, file);
  check_data_rules(rules, file);
  self.data_rules = std::move(rules);
  self.file = std::make_shared<const io::MeshFile>(std::move(file));
}

/// The result of a run: the report, the report on the data or None, and what is lost. `data_of` gives the mesh its new
/// state. Exceptions of the observer are raised after that.
template <class Loaded, class Report, class DataOf>
py::tuple end_run(PySpaceMesh<Loaded>& self, Expected<Report> report, const Visitor& visitor, const DataOf& data_of) {
  const bool has_data = !self.file->point_data.empty() || !cell_data_of(*self.file).empty();
  const std::size_t known = self.file->warnings.size();
  py::object data = py::none();
  std::vector<std::string> lost;
  if (report) {
    const io::DataReport changed = data_of(*report);
    const ReportTable& table = self.file->dimension() == 3 ? table_for_tetrahedra(&changed) : table_of(&changed);
    if (has_data) data = to_python(ReportView{&table, view_of(changed).report});
    lost.assign(self.file->warnings.begin() + static_cast<std::ptrdiff_t>(known), self.file->warnings.end());
  }
  visitor.raise();
  return py::make_tuple(report_to_python(or_raise(std::move(report))), data, to_python(lost));
}

/// The methods that all these meshes have.
template <class Loaded>
void define_space_mesh(py::class_<PySpaceMesh<Loaded>>& type) {
  using AnyMesh = PySpaceMesh<Loaded>;
  type.def("set_weights", set_space_weights<Loaded>);
  define_data_rules(type);
  type.def("version", [](const AnyMesh& self) { return self.version; });
  type.def("copy", [](const AnyMesh& self) {
    AnyMesh copy = self;
    copy.running = false;
    return copy;
  });
  type.def("validate", [](const AnyMesh& self) { return to_python(self.mesh().validate()); });
  type.def("equal", [](const AnyMesh& self, const AnyMesh& other) { return self.mesh() == other.mesh(); });
}

}  // namespace temper::python
