// The mesh of tetrahedra: made from arrays and files, shown as arrays, measured, improved and written. See
// tets/mesh.hpp.
#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "optimize_options.hpp"
#include "space_mesh.hpp"
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
  if (strict) refuse_unused(made[0].cast<const PyTetMesh&>().vertex_of_point, "tetrahedron");
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
  // New vertices of a part that a tag lists are marked in the file alone.
  if (file.marked_points.size() != mesh.tagged_points().size()) mesh = or_raise(io::make_tet_mesh(file)).mesh;
  io::VertexOfPoint all(mesh.n_vertices());
  take_state(self, std::move(file), io::LoadedTetMesh{std::move(mesh), std::move(all), {}}, origins.vertices);
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
  return end_run(self, std::move(report), visitor, [&](const tets::OptimizeReport& r) {
    return replace(self, std::move(mesh), r.origins, executor.get(), r.corner_weights);
  });
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
  return loaded_to_python(std::move(file), std::move(loaded));
}

void bind_tets(py::module_& m) {
  m.def("tet_mesh_from_arrays", tets_from_arrays);
  m.def("write_tets", write_tets);
  m.def("tet_set_data", set_space_data<io::LoadedTetMesh>);
  m.def("tet_quality", tet_quality);
  m.def("optimize_in_space", optimize_tets);
  m.def("tetrahedron_quality", tetrahedron_quality_of);
  py::class_<PyTetMesh> type(m, "TetMesh");
  type.def("n_vertices", [](const PyTetMesh& self) { return self.mesh().n_vertices(); });
  type.def("n_tetrahedra", [](const PyTetMesh& self) { return self.mesh().n_tetrahedra(); });
  type.def("n_faces", [](const PyTetMesh& self) { return self.mesh().n_faces(); });
  type.def("points", tet_points);
  type.def("weights", tet_weights);
  type.def("tetrahedra", tetrahedra_of);
  type.def("set_corner_weights", set_tet_corner_weights);
  type.def("neighbors", neighbors_of);
  type.def("regions", tet_regions);
  type.def("file", file_of_tets);
  type.def("vertices_of_points", [](const PyTetMesh& self) { return array_of<std::int32_t>(self.vertex_of_point); });
  define_space_mesh(type);
}

}  // namespace temper::python
