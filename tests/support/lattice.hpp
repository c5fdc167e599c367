// A jittered triangular lattice with random weights: the small mesh that laws are tried on.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <ostream>
#include <vector>

#include "temper/mesh.hpp"

namespace temper::test {

/// Uniform in [−1, 1), the same on every platform.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15u + 1) {}
  double operator()() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return static_cast<double>(state_ >> 11) * 0x1p-52 - 1.0;
  }

 private:
  std::uint64_t state_;
};

struct LatticeOptions {
  int n = 5;             ///< rows and columns of vertices
  double jitter = 0.05;  ///< of interior vertices, relative to the spacing 1
  double weight = 0.05;  ///< amplitude of random weights
  double scale = 1;      ///< of coordinates; weights go with its square
  Vec2 offset = {0, 0};  ///< added after scaling
  std::uint64_t seed = 1;
  double radius = 0;  ///< not 0: on a sphere of this radius, in units of `scale`

  friend void PrintTo(const LatticeOptions& o, std::ostream* out) {
    *out << o.n << " x " << o.n << " scaled by " << o.scale << " at (" << o.offset.x << ", " << o.offset.y << ")";
  }
};

/// n × n points in equilateral triangles.
inline Mesh lattice(const LatticeOptions& options = {}) {
  Noise noise(options.seed);
  std::vector<Vec2> points;
  std::vector<double> weights;
  const int n = options.n;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const bool inside = i > 0 && j > 0 && i < n - 1 && j < n - 1;
      const double jitter = inside ? options.jitter : 0;
      const Vec2 p{i + 0.5 * j + jitter * noise(), std::sqrt(0.75) * j + jitter * noise()};
      points.push_back(options.scale * p + options.offset);
      weights.push_back(options.scale * options.scale * options.weight * noise());
    }
  }
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (int j = 0; j + 1 < n; ++j) {
    for (int i = 0; i + 1 < n; ++i) {
      const int a = j * n + i, b = a + 1, c = a + n, d = c + 1;
      triangles.push_back({a, b, c});
      triangles.push_back({b, d, c});
    }
  }
  MeshInput input{.points = points, .weights = weights, .triangles = triangles};
  std::vector<Vec3> projected;
  if (options.radius > 0) {
    const double radius = options.scale * options.radius;
    const Vec2 middle = 0.5 * (points.front() + points.back());
    for (const Vec2 p : points) {
      // Not along an axis.
      const double x = p.x - middle.x;
      const Vec3 q{0.6 * radius + 0.8 * x, p.y - middle.y, 0.8 * radius - 0.6 * x};
      projected.push_back(radius / length(q) * q);
    }
    input.space = Space::sphere(radius);
    input.sphere_points = projected;
  }
  auto built = Mesh::build(input);
  if (!built) {
    ADD_FAILURE() << built.error().what();
    return {};
  }
  return std::move(built->mesh);
}

}  // namespace temper::test
