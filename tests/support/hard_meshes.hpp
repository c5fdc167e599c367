// Meshes that plain sweeps do not, or only just, make well-centered: polygons without interior vertices, sharp corners,
// strong grading. Each is a constrained Delaunay triangulation with zero weights.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "base/rng.hpp"
#include "temper/generate.hpp"

namespace temper::test {

/// The polygon through these points, with what is inside as further points.
inline Mesh mesh_of_polygon(const std::vector<Vec2>& outline, const std::vector<Vec2>& inside = {}) {
  std::vector<Vec2> points = outline;
  points.insert(points.end(), inside.begin(), inside.end());
  std::vector<std::array<std::int32_t, 2>> segments;
  const auto n = static_cast<std::int32_t>(outline.size());
  for (std::int32_t i = 0; i < n; ++i) segments.push_back({i, (i + 1) % n});
  auto mesh = constrained_delaunay({.points = points, .segments = segments});
  if (!mesh) {
    ADD_FAILURE() << mesh.error().what();
    return {};
  }
  return *std::move(mesh);
}

/// The regular polygon with n corners, and nothing inside.
inline Mesh gon(int n) {
  std::vector<Vec2> outline;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    outline.push_back({std::cos(angle), std::sin(angle)});
  }
  return mesh_of_polygon(outline);
}

/// A triangle with a corner of so many degrees between sides of length 1, each in n pieces; random points inside.
inline Mesh wedge(double degrees, int n, std::uint64_t seed) {
  const double angle = degrees * std::numbers::pi / 180;
  const Vec2 right{1, 0}, left{std::cos(angle), std::sin(angle)};
  std::vector<Vec2> outline, inside;
  for (int i = 0; i <= n; ++i) outline.push_back((double(i) / n) * right);
  for (int i = n; i > 0; --i) outline.push_back((double(i) / n) * left);
  Rng rng(seed);
  for (int i = 0; i < n; ++i) {
    const double r = rng.uniform(0.3, 0.95), s = rng.uniform(0.2, 0.8);
    inside.push_back(r * ((1 - s) * right + s * left));
  }
  return mesh_of_polygon(outline, inside);
}

/// A square whose edges grow from 1/64 at one corner; random points inside, as dense as the boundary near them.
inline Mesh graded_points(std::uint64_t seed) {
  const auto size = [](Vec2 p) { return 1.0 / 64 + 0.2 * length(p); };
  std::vector<double> steps = {0};
  while (steps.back() < 1) steps.push_back(steps.back() + size({steps.back(), 0}));
  for (double& s : steps) s /= steps.back();
  std::vector<Vec2> outline, inside;
  const auto side = [&](auto place) {
    for (std::size_t i = 0; i + 1 < steps.size(); ++i) outline.push_back(place(steps[i]));
  };
  side([](double s) { return Vec2{s, 0}; });
  side([](double s) { return Vec2{1, s}; });
  side([](double s) { return Vec2{1 - s, 1}; });
  std::vector<Vec2> left;
  for (std::size_t i = steps.size() - 1; i > 0; --i) left.push_back({0, steps[i]});
  outline.insert(outline.end(), left.begin(), left.end());
  Rng rng(seed);
  for (int i = 0; i < 20000; ++i) {
    const double r = rng.uniform() * rng.uniform();
    const Vec2 p{r * rng.uniform(0, 1), r * rng.uniform(0, 1)};
    const double apart = 0.6 * size(p);
    const auto near = [&](Vec2 q) { return length(p - q) < apart; };
    if (std::any_of(outline.begin(), outline.end(), near) || std::any_of(inside.begin(), inside.end(), near)) continue;
    if (p.x > apart / 2 && p.y > apart / 2) inside.push_back(p);
  }
  return mesh_of_polygon(outline, inside);
}

}  // namespace temper::test
