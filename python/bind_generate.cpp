// Generated meshes: triangulations of points, and the examples. See generate.hpp.
#include "bind.hpp"
#include "temper/generate.hpp"

namespace temper::python {
namespace {

std::unique_ptr<PyMesh> made(Expected<Mesh> mesh) { return std::make_unique<PyMesh>(or_raise(std::move(mesh))); }

template <class Make>
std::unique_ptr<PyMesh> made_aside(const Make& make) {
  return made(aside(make));
}

void bind_delaunay(py::module_& m) {
  m.def("constrained_delaunay", [](const Doubles& points, const Int64s& segments, bool carve) {
    const auto ends = narrow<2>(segments, "segment");
    return made_aside([&] { return constrained_delaunay({as_span<Vec2>(points), ends, carve}); });
  });
  m.def("spherical_delaunay", [](const Doubles& points, double radius) {
    return made_aside([&] { return spherical_delaunay(as_span<Vec3>(points), radius); });
  });
  m.def("periodic_delaunay", [](const Doubles& points, double x, double y) {
    return made_aside([&] { return periodic_delaunay(as_span<Vec2>(points), {x, y}); });
  });
}

void bind_plane_examples(py::module_& m) {
  m.def("sparse_horseshoe", [] { return std::make_unique<PyMesh>(sparse_horseshoe()); });
  m.def("letter_a", [] { return std::make_unique<PyMesh>(letter_a()); });
  m.def("horseshoe", [](int a, int b, double x0, double x1, double y0, double y1) {
    return made(horseshoe({a, b, {x0, x1}, {y0, y1}}));
  });
  m.def("single_triangle", [](double a, double b, double angle) { return made(single_triangle({a, b, angle})); });
  m.def("random_mesh", [](std::size_t vertices, std::uint64_t seed, const Doubles& polygon) {
    const auto corners = as_span<Vec2>(polygon);
    return made(random_mesh({vertices, seed, {corners.begin(), corners.end()}}));
  });
  m.def("sheared_grid", [](int nx, int ny, double shear) { return made(sheared_grid({nx, ny, shear})); });
  m.def("annulus", [](double inner, double outer, int around, int rings, double jitter, std::uint64_t seed) {
    return made(annulus({inner, outer, around, rings, jitter, seed}));
  });
  m.def("airfoil", [](int around, double growth, std::uint64_t seed) { return made(airfoil({around, growth, seed})); });
  m.def("regular_polygon", [](int corners) { return made(regular_polygon({corners})); });
  m.def("wedge", [](double angle, int pieces, std::uint64_t seed) { return made(wedge({angle, pieces, seed})); });
  m.def("graded_mesh", [](double finest, double growth, std::uint64_t seed) {
    return made(graded_mesh({finest, growth, seed}));
  });
}

void bind_sphere_examples(py::module_& m) {
  m.def("icosahedral", [](int level, double radius) { return made(icosahedral({level, radius})); });
  m.def("random_sphere", [](std::size_t vertices, std::uint64_t seed, double radius) {
    return made(random_sphere({vertices, seed, radius}));
  });
  m.def("graded_sphere",
        [](std::size_t vertices, double ratio, double lon, double lat, std::uint64_t seed, double radius) {
          return made(graded_sphere({vertices, ratio, {lon, lat}, seed, radius}));
        });
  m.def("graded_sphere_size",
        [](std::size_t vertices, double ratio, double lon, double lat, double radius, const Doubles& directions) {
          const GradedSphere shape = {.vertices = vertices, .ratio = ratio, .at = {lon, lat}, .radius = radius};
          std::vector<double> sizes;
          for (const Vec3 p : as_span<Vec3>(directions)) sizes.push_back(graded_sphere_size(shape, p));
          return to_python(sizes);
        });
}

void bind_periodic_examples(py::module_& m) {
  m.def("random_periodic", [](std::size_t vertices, std::uint64_t seed, double x, double y) {
    return made(random_periodic({vertices, seed, {x, y}}));
  });
  m.def("periodic_hexagons", [](int nx, int ny, double distance, bool channel) {
    return made(periodic_hexagons({nx, ny, distance, channel}));
  });
}

}  // namespace

void bind_generate(py::module_& m) {
  bind_delaunay(m);
  bind_plane_examples(m);
  bind_sphere_examples(m);
  bind_periodic_examples(m);
}

}  // namespace temper::python
