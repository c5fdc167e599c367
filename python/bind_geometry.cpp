// Predicates and constructions over arrays (geometry.hpp), and the maps of projection.hpp.
#include <tuple>

#include "bind.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/projection.hpp"

namespace temper::python {
namespace {

using Points = std::span<const WeightedPoint>;

template <std::size_t n>
std::array<Points, n> same_length(const std::array<Doubles, n>& arrays) {
  std::array<Points, n> points;
  for (std::size_t i = 0; i < n; ++i) {
    points[i] = as_span<WeightedPoint>(arrays[i]);
    if (points[i].size() != points[0].size()) throw py::value_error("arrays of different lengths");
  }
  return points;
}

/// An array of f(a_i, b_i, …). A result of f is one Value or several.
template <class Value, std::size_t n, class F>
py::array over(const std::array<Doubles, n>& arrays, const F& f) {
  const std::array<Points, n> points = same_length(arrays);
  using Result = decltype(f(points, std::size_t{0}));
  constexpr py::ssize_t per = sizeof(Result) / sizeof(Value);
  const auto size = static_cast<py::ssize_t>(points[0].size());
  py::array_t<Value> result(per == 1 ? Shape{size} : Shape{size, per});
  auto* out = reinterpret_cast<Result*>(result.mutable_data());
  for (std::size_t i = 0; i < points[0].size(); ++i) out[i] = f(points, i);
  return result;
}

/// Calls f(a_i, b_i, …) for points of the plane, or for weighted vectors of the sphere.
template <class Value, std::size_t n, class F>
py::array in_space(bool sphere, const std::array<Doubles, n>& arrays, const F& f) {
  if (sphere) {
    return over<Value, n>(arrays, [&f](const auto& points, std::size_t i) {
      return std::apply([&f, i](const auto&... p) { return f(as_vector(p[i])...); }, points);
    });
  }
  return over<Value, n>(arrays, [&f](const auto& points, std::size_t i) {
    return std::apply([&f, i](const auto&... p) { return f(p[i]...); }, points);
  });
}

std::int8_t as_number(Sign sign) { return static_cast<std::int8_t>(sign); }

void bind_predicates(py::module_& m) {
  m.def("orientation", [](const Doubles& a, const Doubles& b, const Doubles& c, bool sphere) {
    // Any sphere gives the same result.
    const Space space = sphere ? Space::sphere(1) : Space();
    return over<std::int8_t, 3>({a, b, c}, [space](const auto& p, std::size_t i) {
      return as_number(orientation(space, p[0][i], p[1][i], p[2][i]));
    });
  });
  m.def("power_test", [](const Doubles& a, const Doubles& b, const Doubles& c, const Doubles& d, bool sphere) {
    return in_space<std::int8_t, 4>(sphere, {a, b, c, d}, [](const auto&... p) { return as_number(power_test(p...)); });
  });
  m.def("power_test_perturbed",
        [](const Doubles& a, const Doubles& b, const Doubles& c, const Doubles& d,
           const py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>& index, bool sphere) {
          const auto indices = as_span<std::array<std::uint32_t, 4>>(index);
          if (indices.size() * 3 != static_cast<std::size_t>(a.size()))
            throw py::value_error("arrays of different lengths");
          const Space space = sphere ? Space::sphere(1) : Space();
          return over<std::int8_t, 4>({a, b, c, d}, [space, indices](const auto& p, std::size_t i) {
            return as_number(power_test_perturbed(space, p[0][i], p[1][i], p[2][i], p[3][i], indices[i]));
          });
        });
  m.def("signed_height_sign", [](const Doubles& a, const Doubles& b, const Doubles& c, bool sphere) {
    return in_space<std::int8_t, 3>(sphere, {a, b, c},
                                    [](const auto&... p) { return as_number(signed_height_sign(p...)); });
  });
  m.def("dual_crossing_sign", [](const Doubles& a, const Doubles& b, bool sphere) {
    return in_space<std::int8_t, 2>(sphere, {a, b},
                                    [](const auto&... p) { return as_number(dual_crossing_sign(p...)); });
  });
  m.def("is_well_centered", [](const Doubles& a, const Doubles& b, const Doubles& c, bool sphere) {
    return in_space<bool, 3>(sphere, {a, b, c}, [](const auto&... p) { return is_well_centered(p...); });
  });
  m.def("is_exact_coordinate", [](double x) { return is_exact_coordinate(x); });
  m.def("is_exact_weight", [](double w) { return is_exact_weight(w); });
}

void bind_constructions(py::module_& m) {
  m.def("orthocenter", [](const Doubles& a, const Doubles& b, const Doubles& c, bool sphere) {
    return in_space<double, 3>(sphere, {a, b, c}, [](const auto&... p) { return orthocenter(p...); });
  });
  m.def("dual_crossing", [](const Doubles& a, const Doubles& b, bool sphere) {
    return in_space<double, 2>(sphere, {a, b}, [](const auto&... p) { return dual_crossing(p...); });
  });
  m.def("signed_height", [](const Doubles& a, const Doubles& b, const Doubles& c, bool sphere) {
    return in_space<double, 3>(sphere, {a, b, c}, [](const auto&... p) { return signed_height(p...); });
  });
  m.def("scaled_heights", [](const Doubles& a, const Doubles& b, const Doubles& c) {
    return over<double, 3>({a, b, c},
                           [](const auto& p, std::size_t i) { return scaled_heights(p[0][i], p[1][i], p[2][i]); });
  });
  m.def("doubled_area", [](const Doubles& a, const Doubles& b, const Doubles& c) {
    return over<double, 3>({a, b, c}, [](const auto& p, std::size_t i) {
      return doubled_area(p[0][i].position(), p[1][i].position(), p[2][i].position());
    });
  });
  m.def("corner_angle", [](const Doubles& a, const Doubles& b, const Doubles& c, bool sphere) {
    return over<double, 3>({a, b, c}, [sphere](const auto& p, std::size_t i) {
      if (sphere) return corner_angle(as_vector(p[0][i]), as_vector(p[1][i]), as_vector(p[2][i]));
      return corner_angle(p[0][i].position(), p[1][i].position(), p[2][i].position());
    });
  });
  m.def("arc_length", [](const Doubles& a, const Doubles& b) {
    return over<double, 2>(
        {a, b}, [](const auto& p, std::size_t i) { return arc_length(as_vector(p[0][i]), as_vector(p[1][i])); });
  });
  m.def("solid_angle", [](const Doubles& a, const Doubles& b, const Doubles& c) {
    return over<double, 3>({a, b, c}, [](const auto& p, std::size_t i) {
      return solid_angle(as_vector(p[0][i]), as_vector(p[1][i]), as_vector(p[2][i]));
    });
  });
}

// --- projections ------------------------------------------------------------------------------------------

Projection projection_from(const std::string& kind, double longitude, double latitude, double radius) {
  return {from_name<ProjectionKind>("projection", kind), {longitude, latitude}, radius};
}

void bind_projections(py::module_& m) {
  m.def("parse_projection", [](const std::string& text, const Doubles& places) {
    const Projection p = or_raise(parse_projection(text, as_span<Vec2>(places)));
    return py::make_tuple(to_python(name_of(p.kind)), to_python(p.center), p.radius);
  });
  m.def("forward", [](const std::string& kind, double lon, double lat, double radius, const Doubles& places) {
    const Projection projection = projection_from(kind, lon, lat, radius);
    std::vector<Vec2> result;
    for (const Vec2 p : as_span<Vec2>(places)) result.push_back(forward(projection, p));
    return rows_of<double>(std::span<const Vec2>(result));
  });
  m.def("inverse", [](const std::string& kind, double lon, double lat, double radius, const Doubles& places) {
    const Projection projection = projection_from(kind, lon, lat, radius);
    std::vector<Vec2> result;
    for (const Vec2 p : as_span<Vec2>(places)) result.push_back(inverse(projection, p));
    return rows_of<double>(std::span<const Vec2>(result));
  });
  m.def("scale_factor", [](const std::string& kind, double lon, double lat, double radius, const Doubles& places) {
    const Projection projection = projection_from(kind, lon, lat, radius);
    std::vector<double> result;
    for (const Vec2 p : as_span<Vec2>(places)) result.push_back(scale_factor(projection, p));
    return to_python(result);
  });
  m.def("direction_of", [](const Doubles& places) {
    std::vector<Vec3> result;
    for (const Vec2 p : as_span<Vec2>(places)) result.push_back(direction_of(p));
    return rows_of<double>(std::span<const Vec3>(result));
  });
  m.def("lon_lat_of", [](const Doubles& directions) {
    std::vector<Vec2> result;
    for (const Vec3 p : as_span<Vec3>(directions)) result.push_back(lon_lat_of(p));
    return rows_of<double>(std::span<const Vec2>(result));
  });
  m.def("mean_place", [](const Doubles& places) { return to_python(mean_place(as_span<Vec2>(places))); });
}

}  // namespace

void bind_geometry(py::module_& m) {
  bind_predicates(m);
  bind_constructions(m);
  bind_projections(m);
}

}  // namespace temper::python
