// Triangles around one vertex, number 0, open or closed: where the reasons of this layer can be worked out by hand.
#pragma once

#include <numbers>
#include <vector>

#include "support/lattice.hpp"
#include "support/shapes.hpp"

namespace temper::test {

constexpr double kRadians = std::numbers::pi / 180;

/// Vertex 0 in the origin, vertex i + 1 at the end of spoke i; angles in degrees between one spoke and the next.
inline Mesh fan(const std::vector<double>& lengths, const std::vector<double>& angles) {
  std::vector<Vec2> points = {{0, 0}};
  std::vector<std::array<std::int32_t, 3>> triangles;
  double turn = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    points.push_back({lengths[i] * std::cos(turn * kRadians), lengths[i] * std::sin(turn * kRadians)});
    if (i < angles.size()) turn += angles[i];
  }
  const bool closed = angles.size() == lengths.size();
  const auto n = static_cast<std::int32_t>(lengths.size());
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(angles.size()); ++i) {
    triangles.push_back({0, i + 1, closed && i + 1 == n ? 1 : i + 2});
  }
  return mesh_of(points, triangles);
}

/// n triangles, obtuse ones among them, that turn less than once around vertex 0; closed: just once.
inline Mesh random_fan(std::uint64_t seed, int n, bool closed = false) {
  Noise noise(seed);
  std::vector<double> lengths, angles;
  double total = 0;
  for (int i = 0; i < n; ++i) {
    angles.push_back(closed ? 1 + 0.3 * noise() : 60 + 50 * noise());
    total += angles.back();
  }
  if (closed || total > 350) {
    for (double& angle : angles) angle *= (closed ? 360 : 350) / total;
  }
  for (int i = 0; i < (closed ? n : n + 1); ++i) lengths.push_back(std::exp((closed ? 0.5 : 1.2) * noise()));
  return fan(lengths, angles);
}

inline std::vector<TriangleId> all_triangles(const Mesh& mesh) {
  return {mesh.triangles().begin(), mesh.triangles().end()};
}

}  // namespace temper::test
