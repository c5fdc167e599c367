// The input of Mesh::build with its names, and the checks that need no mesh.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "base/text.hpp"
#include "temper/mesh.hpp"

namespace temper {

class NamedInput {
 public:
  explicit NamedInput(const MeshInput& input)
      : in(input), names(input.names != nullptr ? *input.names : default_names()) {}

  [[nodiscard]] bool on_sphere() const { return in.space.dimension() == 3; }
  [[nodiscard]] std::size_t n_points() const { return on_sphere() ? in.sphere_points.size() : in.points.size(); }
  [[nodiscard]] Vec3 place(std::size_t i) const {
    return on_sphere() ? in.sphere_points[i] : Vec3{in.points[i].x, in.points[i].y, 0};
  }
  [[nodiscard]] std::string place_text(std::size_t i) const {
    return on_sphere() ? coordinates(in.sphere_points[i]) : coordinates(in.points[i]);
  }
  [[nodiscard]] bool is_point(std::int32_t i) const { return i >= 0 && static_cast<std::size_t>(i) < n_points(); }
  [[nodiscard]] double weight(std::size_t i) const { return in.weights.empty() ? 0.0 : in.weights[i]; }
  [[nodiscard]] InputError point_error(ErrorCode code, std::size_t i, const std::string& message) const {
    return {code, names.point_where(i), message};
  }
  [[nodiscard]] InputError triangle_error(ErrorCode code, std::size_t t, const std::string& message) const {
    return {code, names.triangle_where(t), message};
  }

  const MeshInput& in;
  const InputNames& names;

 private:
  static const InputNames& default_names() {
    static const InputNames names;
    return names;
  }
};

/// An error of the numbers of points, triangles, weights and regions.
[[nodiscard]] std::optional<InputError> check_sizes(const NamedInput& input);

/// An error of coordinates, weights or lengths that are too large or too small for exact arithmetic, or of places off
/// their sphere.
[[nodiscard]] std::optional<InputError> check_scale(const NamedInput& input);

/// Of coordinates, absolute, and relative to the largest one or to the radius of a sphere. On a sphere smaller ones are
/// rounded zeros.
inline constexpr double kSmallestCoordinate = 1e-60;

/// An error if two points are at the same place.
[[nodiscard]] std::optional<InputError> find_duplicate(const NamedInput& input);

}  // namespace temper
