// The mesh of a curved surface: made from arrays and files, and improved. Functions for it that have the name of one
// for triangles are overloads, in the files of these. See surfaces.hpp.
#include <utility>

#include "optimize_options.hpp"
#include "space_mesh.hpp"
#include "temper/detail/lp.hpp"
#include "temper/solvers.hpp"

namespace temper::python {
namespace {

/// `strict`: points of no triangle are an error.
py::tuple surface_from_arrays(const py::dict& d, bool strict) {
  const auto points = d["points"].cast<Doubles>();
  io::MeshFile file;
  io::SpacePoints space = {{}, 2};
  for (const Vec3& p : as_span<Vec3>(points)) {
    file.points.push_back({p.x, p.y});
    space.heights.push_back(p.z);
  }
  file.points_in = std::move(space);
  file.triangles.corners = narrow<3>(d["triangles"].cast<Int64s>(), "triangle");
  check_range<3>(file.triangles.corners, file.points.size(), "triangle");
  take_contents(file, file.triangles, d, file.points.size());
  py::tuple made = load_surface(std::move(file), {});
  if (strict) refuse_unused(made[0].cast<const PySurface&>().vertex_of_point, "triangle");
  return made;
}

py::array surface_points(const PySurface& self) {
  std::vector<Vec3> points;
  for (const VertexId v : self.mesh().vertices()) points.push_back(self.mesh().position(v));
  return rows_of<double>(std::span<const Vec3>(points));
}

py::tuple optimize_surface(PySurface& self, const py::dict& given, const py::object& /*threads*/,
                           const py::object& observer, const py::object& /*tensor*/) {
  surfaces::SurfaceOptions options = or_raise(surfaces::surface_options(options_from(given)));
  surfaces::SurfaceMesh mesh = self.mesh();
  Visitor visitor;
  options.observer = observer_of(visitor, observer);
  options.squared_errors = surfaces::squared_errors();
  options.must_stop = [&visitor] { return !visitor.check_signals(); };
  const Run run(self.running);
  auto report = aside([&] { return optimize(mesh, *clp_solver(), options); });
  return end_run(self, std::move(report), visitor,
                 [&](const surfaces::SurfaceReport& r) { return replace(self, std::move(mesh), r.vertices); });
}

}  // namespace

io::DataReport replace(PySurface& self, surfaces::SurfaceMesh mesh, const IdVector<VertexId, VertexId>& vertices) {
  io::MeshFile file = *self.file;
  const io::UpdateOptions options = self.data_rules.options(nullptr);
  io::DataReport data = aside([&] { return io::update(file, *self.loaded, mesh, vertices, options); });
  io::LoadedSurface loaded = {std::move(mesh), io::VertexOfPoint(file.points.size()), {}, {}};
  if (!self.loaded->edge_lines.empty()) loaded.edge_lines = or_raise(io::make_surface(file)).edge_lines;
  take_state(self, std::move(file), std::move(loaded), vertices);
  return data;
}

py::tuple load_surface(io::MeshFile file, const std::vector<std::string>& fixed_tags) {
  auto made = aside([&] { return io::make_surface(file, fixed_tags); });
  return loaded_to_python(std::move(file), or_raise(std::move(made)));
}

void bind_surfaces(py::module_& m) {
  m.def("surface_from_arrays", surface_from_arrays);
  m.def("optimize_in_space", optimize_surface);
  py::class_<PySurface> type(m, "SurfaceMesh");
  define_triangles(type);
  define_space_mesh(type);
  type.def("points", surface_points);
}

}  // namespace temper::python
