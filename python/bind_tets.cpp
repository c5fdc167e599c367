// The mesh of tetrahedra: made from arrays and files, shown as arrays, measured, improved and written. See
// tets/mesh.hpp.
#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "bind.hpp"
#include "data_arrays.hpp"
#include "optimize_options.hpp"
#include "reports.hpp"
#include "temper/solvers.hpp"
#include "temper/tets/optimize.hpp"
#include "temper/tets/quality.hpp"

namespace temper::python {
namespace {

using tets::HalffaceId;
using tets::TetId;

/// Gives all tetrahedra the corners of the mesh: those that were negative are reversed in the file, too.
void reverse_as_mesh(io::MeshFile& file, const io::LoadedTetMesh& loaded) {
  for (std::size_t t = 0; t < file.tetrahedra.size(); ++t) {
    auto& corners = file.tetrahedra[t];
    const std::int32_t third = loaded.vertex_of_point[static_cast<std::size_t>(corners[2])];
    if (third != static_cast<std::int32_t>(loaded.mesh.corners(TetId(t))[2].index)) std::swap(corners[2], corners[3]);
  }
}

/// `strict`: points of no tetrahedron are an error, as they are for triangles from arrays.
py::tuple tets_from_arrays(const py::dict& d, bool strict, const py::object& threads) {
  const auto points = d["points"].cast<Doubles>();
  io::MeshFile file;
  file.tetrahedra.corners = narrow<4>(d["tetrahedra"].cast<Int64s>(), "tetrahedron");
  or_raise(io::set_points(file, copy_of<Vec3>(points)));
  check_range<4>(file.tetrahedra.corners, file.points.size(), "tetrahedron");
  take_contents(file, file.tetrahedra, d, file.points.size());
  file.triangles.corners = narrow<3>(d["faces"].cast<Int64s>(), "face");
  check_range<3>(file.triangles.corners, file.points.size(), "face");
  file.triangles.tags = copy_of<std::int32_t>(d["face_tags"].cast<Int32s>());
  file.triangles.data = from_python_dict(d["face_data"].cast<py::dict>(), file.triangles.size(), "face data");
  const auto executor = make_threads(threads_from(threads));
  py::tuple made = load_tetrahedra(std::move(file), executor.get());
  const auto& vertex = made[0].cast<const PyTetMesh&>().vertex_of_point;
  for (std::size_t p = 0; strict && p < vertex.size(); ++p) {
    if (vertex[p] >= 0) continue;
    fail(ErrorCode::unused_point, "point " + std::to_string(p) + " belongs to no tetrahedron. Next: remove it");
  }
  return made;
}

// --- arrays -------------------------------------------------------------------------------------------

/// Numbers of each vertex, as they lie in memory.
py::array tet_places(const PyTetMesh& self, std::vector<py::ssize_t> shape, double tets::WeightedPoint::*first) {
  const auto data = self.mesh().point_data();
  shape.insert(shape.begin(), static_cast<py::ssize_t>(data.size()));
  std::vector<py::ssize_t> strides = {sizeof(tets::WeightedPoint), sizeof(double)};
  strides.resize(shape.size());
  return view(py::dtype::of<double>(), shape, strides, data.empty() ? nullptr : &(data.front().*first),
              keep(self.loaded));
}
py::array tet_points(const PyTetMesh& self) { return tet_places(self, {3}, &tets::WeightedPoint::x); }
py::array tet_weights(const PyTetMesh& self) { return tet_places(self, {}, &tets::WeightedPoint::w); }

py::array tetrahedra_of(const PyTetMesh& self) {
  const auto data = self.mesh().corner_data();
  constexpr py::ssize_t item = sizeof(VertexId);
  return view(dtype_of<VertexId>(), {static_cast<py::ssize_t>(data.size()), 4}, {4 * item, item}, data.data(),
              keep(self.loaded));
}

py::array neighbors_of(const PyTetMesh& self) {
  std::vector<std::array<std::int32_t, 4>> neighbors(self.mesh().n_tetrahedra());
  for (const HalffaceId h : self.mesh().halffaces()) {
    const HalffaceId twin = self.mesh().twin(h);
    neighbors[h.index / 4][h.index % 4] = twin.valid() ? static_cast<std::int32_t>(twin.index / 4) : -1;
  }
  return rows_of<std::int32_t>(std::span<const std::array<std::int32_t, 4>>(neighbors));
}

py::array tet_regions(const PyTetMesh& self) {
  std::vector<std::int32_t> regions;
  regions.reserve(self.mesh().n_tetrahedra());
  for (const TetId t : self.mesh().tetrahedra()) regions.push_back(self.mesh().region(t));
  return array_of<std::int32_t>(regions);
}

std::vector<std::int32_t> numbers_of(const io::VertexOfPoint& vertex) {
  std::vector<std::int32_t> vertices;
  vertices.reserve(vertex.size());
  for (std::size_t p = 0; p < vertex.size(); ++p) vertices.push_back(vertex[p]);
  return vertices;
}

/// Everything in the file but points and tetrahedra, in its numbers, and the vertex of each point.
py::dict file_of_tets(const PyTetMesh& self) {
  const io::MeshFile& file = *self.file;
  return contents_of(file)("faces",
                           rows_of<std::int32_t>(std::span<const std::array<std::int32_t, 3>>(file.triangles)))(
             "face_tags", array_of<std::int32_t>(file.triangles.tags))("face_data",
                                                                       py::object(to_python_dict(file.triangles.data)))(
             "vertices", array_of<std::int32_t>(numbers_of(self.loaded->vertex_of_point)))
      .dict;
}

}  // namespace

// --- changes ------------------------------------------------------------------------------------------

io::DataReport replace(PyTetMesh& self, tets::TetMesh mesh, const tets::Origins& origins, Executor* executor,
                       const std::vector<double>& corner_weights) {
  io::MeshFile file = *self.file;
  const io::UpdateOptions options = self.data_rules.options(executor);
  io::DataReport data = aside([&] { return io::update(file, *self.loaded, mesh, origins, options); });
  io::set_corner_weights(file, corner_weights);
  std::vector<std::int32_t> now(self.mesh().n_vertices(), -1);
  for (const VertexId v : mesh.vertices()) {
    const VertexId former = origins.vertices.empty() ? v : origins.vertices[v];
    if (former.valid()) now[former.index] = static_cast<std::int32_t>(v.index);
  }
  for (std::int32_t& v : self.vertex_of_point) v = v < 0 ? -1 : now[static_cast<std::size_t>(v)];
  // New vertices of a part that a tag lists are marked in the file alone.
  if (file.marked_points.size() != mesh.tagged_points().size()) mesh = or_raise(io::make_tet_mesh(file)).mesh;
  io::VertexOfPoint all(mesh.n_vertices());
  self.data_rules = without_absent(std::move(self.data_rules), file);
  self.file = std::make_shared<const io::MeshFile>(std::move(file));
  self.loaded = std::make_shared<const io::LoadedTetMesh>(io::LoadedTetMesh{std::move(mesh), std::move(all), {}});
  ++self.version;
  return data;
}

namespace {

/// The weights of corners go into the cell data.
void set_tet_corner_weights(PyTetMesh& self, const Doubles& weights) {
  const Run run(self.running);
  const auto values = as_span<double>(weights);
  if (values.size() != self.mesh().n_halffaces()) {
    fail(ErrorCode::size_mismatch, "weights: expected four for each of " + std::to_string(self.mesh().n_tetrahedra()) +
                                       " tetrahedra, found " + std::to_string(values.size()) + " numbers");
  }
  for (const double w : values) {
    if (!is_exact_weight(w))
      fail(ErrorCode::out_of_scale, "weights: expected numbers in the range of exact arithmetic");
  }
  replace(self, self.mesh(), {}, nullptr, {values.begin(), values.end()});
}

void set_tet_weights(PyTetMesh& self, const Doubles& weights) {
  const Run run(self.running);
  const auto values = as_span<double>(weights);
  if (values.size() != self.mesh().n_vertices()) {
    fail(ErrorCode::size_mismatch,
         "weights: expected " + std::to_string(self.mesh().n_vertices()) + ", found " + std::to_string(values.size()));
  }
  tets::TetMesh mesh = self.mesh();
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
  replace(self, std::move(mesh), {}, nullptr);
}

/// Sets an array of point data or cell data, or with None removes it.
void set_tet_data(PyTetMesh& self, bool of_points, const std::string& name, const py::object& values) {
  const Run run(self.running);
  replace(self, self.mesh(), {}, nullptr);  // without points of no tetrahedron
  io::MeshFile file = *self.file;
  std::vector<io::DataArray>& arrays = of_points ? file.point_data : file.tetrahedra.data;
  if (values.is_none()) {
    erase_array(arrays, name);
  } else {
    io::DataArray array =
        from_python_array(name, values.cast<py::array>(), of_points ? file.points.size() : file.tetrahedra.size(),
                          of_points ? "point data" : "cell data");
    const auto same = std::ranges::find(arrays, name, &io::DataArray::name);
    (same == arrays.end() ? arrays.emplace_back() : *same) = std::move(array);
  }
  MeshDataRules rules = without_absent(self.data_rules, file);
  check_data_rules(rules, file);
  self.data_rules = std::move(rules);
  self.file = std::make_shared<const io::MeshFile>(std::move(file));
}

/// The mesh gets its new state, whatever ended the run. Exceptions of the observer are raised after that. Returns the
/// report, the report on the data or None, and what is lost.
py::tuple optimize_tets(PyTetMesh& self, const py::dict& given, const py::object& threads, const py::object& observer,
                        const py::object& tensor) {
  OptimizeOptions options = options_from(given);
  if (!tensor.is_none()) {
    GivenTensors<Tensor3> tensors = tensors_from<Tensor3>(tensor);
    options.tetrahedra_tensors = tensors.one ? std::vector{*tensors.one} : std::move(tensors.of_cells);
    options.corner_weights = std::move(tensors.corner_weights);
  }
  const auto executor = make_threads(threads_from(threads));
  const auto loaded = self.loaded;
  tets::TetMesh mesh = loaded->mesh;
  Visitor visitor;
  tets::OptimizeHooks hooks = {observer_of(visitor, observer), executor.get()};
  hooks.solvers = tets::solvers(options.scheme);
  const Run run(self.running);
  Expected<tets::OptimizeReport> report = aside([&] { return optimize(mesh, options, hooks); });
  const bool has_data = !self.file->point_data.empty() || !self.file->tetrahedra.data.empty();
  const std::size_t known = self.file->warnings.size();
  py::object data = py::none();
  std::vector<std::string> lost;
  if (report) {
    const io::DataReport changed =
        replace(self, std::move(mesh), report->origins, executor.get(), report->corner_weights);
    if (has_data) data = to_python(ReportView{&table_for_tetrahedra(&changed), view_of(changed).report});
    lost.assign(self.file->warnings.begin() + static_cast<std::ptrdiff_t>(known), self.file->warnings.end());
  }
  visitor.raise();
  return py::make_tuple(report_to_python(or_raise(std::move(report))), data, to_python(lost));
}

// --- the report and files -----------------------------------------------------------------------------

py::object tet_quality(const PyTetMesh& self, std::size_t worst, const py::object& threads) {
  const auto executor = make_threads(threads_from(threads));
  const auto loaded = self.loaded;
  const tets::Quality q = aside([&] { return tets::quality(loaded->mesh, {worst, executor.get()}); });
  return report_to_python(q);
}

py::dict tetrahedron_quality_of(const PyTetMesh& self) {
  const std::size_t n = self.mesh().n_tetrahedra();
  std::vector<std::uint8_t> well_centered(n);
  std::vector<double> h_over_l(n), dihedral(n);
  aside([&] {
    for (const TetId t : self.mesh().tetrahedra()) {
      const tets::TetrahedronQuality q = tets::tetrahedron_quality(self.mesh().points(t));
      well_centered[t.index] = q.well_centered ? 1 : 0;
      h_over_l[t.index] = q.min_h_over_l;
      dihedral[t.index] = q.min_dihedral_deg;
    }
  });
  return Record()("well_centered", py::object(array_of<std::uint8_t>(well_centered).attr("astype")("bool")))(
             "min_h_over_l", h_over_l)("min_dihedral_deg", dihedral)
      .dict;
}

py::object write_tets(const std::string& path, const PyTetMesh& self, const std::string& format,
                      const std::string& encoding, bool triangle_quality, const py::object& threads) {
  const auto executor = make_threads(threads_from(threads));
  io::WriteOptions options;
  options.format = format;
  if (!encoding.empty()) options.encoding = from_name<io::Encoding>("encoding", encoding);
  options.triangle_quality = triangle_quality;
  options.executor = executor.get();
  const auto file = self.file;
  return to_python(or_raise(aside([&] { return io::write(path, *file, options); })));
}

}  // namespace

py::tuple load_tetrahedra(io::MeshFile file, Executor* executor) {
  auto made = aside([&] { return io::make_tet_mesh(file, executor); });
  io::LoadedTetMesh loaded = or_raise(std::move(made));
  reverse_as_mesh(file, loaded);
  std::vector<std::string> warnings = std::exchange(file.warnings, {});
  warnings.insert(warnings.end(), loaded.warnings.begin(), loaded.warnings.end());
  std::vector<std::int32_t> vertices = numbers_of(loaded.vertex_of_point);
  return py::make_tuple(PyTetMesh{std::make_shared<const io::MeshFile>(std::move(file)),
                                  std::make_shared<const io::LoadedTetMesh>(std::move(loaded)), std::move(vertices)},
                        to_python(warnings));
}

void bind_tets(py::module_& m) {
  m.def("tet_mesh_from_arrays", tets_from_arrays);
  m.def("write_tets", write_tets);
  m.def("tet_set_data", set_tet_data);
  m.def("tet_quality", tet_quality);
  m.def("tet_optimize", optimize_tets);
  m.def("tetrahedron_quality", tetrahedron_quality_of);
  py::class_<PyTetMesh> type(m, "TetMesh");
  type.def("n_vertices", [](const PyTetMesh& self) { return self.mesh().n_vertices(); });
  type.def("n_tetrahedra", [](const PyTetMesh& self) { return self.mesh().n_tetrahedra(); });
  type.def("n_faces", [](const PyTetMesh& self) { return self.mesh().n_faces(); });
  type.def("points", tet_points);
  type.def("weights", tet_weights);
  type.def("tetrahedra", tetrahedra_of);
  type.def("set_weights", set_tet_weights);
  type.def("set_corner_weights", set_tet_corner_weights);
  type.def("neighbors", neighbors_of);
  type.def("regions", tet_regions);
  type.def("file", file_of_tets);
  define_data_rules(type);
  type.def("vertices_of_points", [](const PyTetMesh& self) { return array_of<std::int32_t>(self.vertex_of_point); });
  type.def("version", [](const PyTetMesh& self) { return self.version; });
  type.def("copy", [](const PyTetMesh& self) {
    PyTetMesh copy = self;
    copy.running = false;
    return copy;
  });
  type.def("validate", [](const PyTetMesh& self) { return to_python(self.mesh().validate()); });
  type.def("equal", [](const PyTetMesh& self, const PyTetMesh& other) { return self.mesh() == other.mesh(); });
}

}  // namespace temper::python
