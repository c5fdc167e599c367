// Surfaces for tests: lifted and folded plane meshes, tori, icospheres, and public files.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "base/rng.hpp"
#include "temper/surfaces.hpp"

namespace temper::test {

struct SurfaceArrays {
  std::vector<Vec3> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<double> weights = {};
  std::vector<std::int32_t> regions = {};
  std::vector<std::array<std::int32_t, 2>> constrained = {};

  [[nodiscard]] surfaces::SurfaceInput input() const {
    surfaces::SurfaceInput in;
    in.points = points;
    in.triangles = triangles;
    in.weights = weights;
    in.regions = regions;
    in.constrained_edges = constrained;
    return in;
  }
};

inline surfaces::SurfaceMesh mesh_of(const SurfaceArrays& arrays) {
  auto built = surfaces::SurfaceMesh::build(arrays.input());
  if (!built) {
    ADD_FAILURE() << built.error().what();
    return {};
  }
  EXPECT_EQ(built->mesh.validate(), std::nullopt);
  return std::move(built->mesh);
}

/// A mesh of the plane with a place in space for each point.
template <class Place>
SurfaceArrays mapped(const Mesh& plane, const Place& place) {
  SurfaceArrays arrays;
  for (const VertexId v : plane.vertices()) {
    arrays.points.push_back(place(plane.position(v)));
    arrays.weights.push_back(plane.weight(v));
  }
  for (const TriangleId t : plane.triangles()) {
    const auto [a, b, c] = plane.corners(t);
    arrays.triangles.push_back(
        {static_cast<std::int32_t>(a.index), static_cast<std::int32_t>(b.index), static_cast<std::int32_t>(c.index)});
    arrays.regions.push_back(plane.region(t));
  }
  return arrays;
}

/// The mesh in the plane z = 0.
inline SurfaceArrays lifted(const Mesh& plane) {
  return mapped(plane, [](Vec2 p) { return Vec3{p.x, p.y, 0}; });
}

/// Two triangles between the points a and a + 1 and those `next` numbers later, with a random diagonal.
inline void add_square(std::vector<std::array<std::int32_t, 3>>& triangles, int a, int next, Rng& rng) {
  const int b = a + next, c = b + 1, d = a + 1;
  if (rng.below(2) == 0) {
    triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
  } else {
    triangles.insert(triangles.end(), {{a, b, d}, {b, c, d}});
  }
}

/// A strip of n columns between the lines x = 0, 1, …, with random points on these lines, weights and diagonals.
inline Mesh plane_strip(int n, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Vec2> points;
  std::vector<double> weights;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      points.push_back({static_cast<double>(i), j + rng.uniform(-0.3, 0.3)});
      weights.push_back(rng.uniform(-0.2, 0.2));
    }
  }
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      add_square(triangles, i * (n + 1) + j, n + 1, rng);
    }
  }
  MeshInput input;
  input.points = points;
  input.weights = weights;
  input.triangles = triangles;
  auto built = Mesh::build(input);
  EXPECT_TRUE(built) << built.error().what();
  return std::move(built->mesh);
}

/// The strip folded along its lines, like an accordion.
inline SurfaceArrays folded(const Mesh& strip, double angle) {
  return mapped(strip, [angle](Vec2 p) {
    const bool is_odd = std::lround(p.x) % 2 != 0;
    return Vec3{std::cos(angle) * p.x, p.y, is_odd ? std::sin(angle) : 0};
  });
}

/// A place on the torus of radius 1 whose tube has radius 0.4.
inline Vec3 on_torus(double u, double v) {
  const double away = 1 + 0.4 * std::cos(v);
  return {away * std::cos(u), away * std::sin(u), 0.4 * std::sin(v)};
}

/// A torus of n times m trapezoids, each cut in two. If `staggered`, every other ring is turned by half a step: then m
/// is even, and triangles are isosceles.
inline SurfaceArrays torus(int n, int m, bool staggered = false) {
  SurfaceArrays arrays;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      const double turn = staggered ? 0.5 * (j % 2) : 0;
      arrays.points.push_back(on_torus(2 * std::numbers::pi * (i + turn) / n, 2 * std::numbers::pi * j / m));
      const int a = i * m + j, b = (i + 1) % n * m + j, c = (i + 1) % n * m + (j + 1) % m, d = i * m + (j + 1) % m;
      if (staggered && j % 2 == 0) {
        arrays.triangles.insert(arrays.triangles.end(), {{a, b, d}, {b, c, d}});
      } else {
        arrays.triangles.insert(arrays.triangles.end(), {{a, b, c}, {a, c, d}});
      }
    }
  }
  return arrays;
}

/// An icosahedron whose triangles are halved `levels` times, on the unit sphere.
inline SurfaceArrays icosphere(int levels) {
  const double g = std::numbers::phi;
  SurfaceArrays arrays = {{{-1, g, 0},
                           {1, g, 0},
                           {-1, -g, 0},
                           {1, -g, 0},
                           {0, -1, g},
                           {0, 1, g},
                           {0, -1, -g},
                           {0, 1, -g},
                           {g, 0, -1},
                           {g, 0, 1},
                           {-g, 0, -1},
                           {-g, 0, 1}},
                          {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                           {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                           {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (Vec3& p : arrays.points) p = (1 / length(p)) * p;
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
    const auto middle = [&](std::int32_t a, std::int32_t b) {
      const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(arrays.points.size()));
      if (is_new) {
        const Vec3 sum = arrays.points[static_cast<std::size_t>(a)] + arrays.points[static_cast<std::size_t>(b)];
        arrays.points.push_back((1 / length(sum)) * sum);
      }
      return at->second;
    };
    std::vector<std::array<std::int32_t, 3>> finer;
    for (const auto& [a, b, c] : arrays.triangles) {
      const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    arrays.triangles = finer;
  }
  return arrays;
}

/// Reads the points and triangles of an OFF or OBJ file.
inline SurfaceArrays read_surface(const std::filesystem::path& path) {
  SurfaceArrays arrays;
  std::ifstream file(path);
  std::string word;
  if (path.extension() == ".off") {
    std::size_t n = 0, m = 0, edges = 0;
    file >> word >> n >> m >> edges;
    arrays.points.resize(n);
    for (Vec3& p : arrays.points) file >> p.x >> p.y >> p.z;
    for (std::size_t i = 0, corners = 0; i < m; ++i) {
      std::array<std::int32_t, 3> t = {};
      file >> corners >> t[0] >> t[1] >> t[2];
      arrays.triangles.push_back(t);
    }
    return arrays;
  }
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    words >> word;
    if (word == "v") {
      Vec3 p;
      words >> p.x >> p.y >> p.z;
      arrays.points.push_back(p);
    } else if (word == "f") {
      std::vector<std::int32_t> corners;
      while (words >> word) corners.push_back(std::stoi(word) - 1);
      for (std::size_t k = 2; k < corners.size(); ++k)
        arrays.triangles.push_back({corners[0], corners[k - 1], corners[k]});
    }
  }
  return arrays;
}

/// Drops points of no triangle.
inline SurfaceArrays without_unused(SurfaceArrays arrays) {
  std::vector<std::int32_t> number(arrays.points.size(), -1);
  std::vector<Vec3> points;
  for (auto& triangle : arrays.triangles) {
    for (std::int32_t& corner : triangle) {
      std::int32_t& n = number[static_cast<std::size_t>(corner)];
      if (n < 0) {
        n = static_cast<std::int32_t>(points.size());
        points.push_back(arrays.points[static_cast<std::size_t>(corner)]);
      }
      corner = n;
    }
  }
  arrays.points = points;
  return arrays;
}

}  // namespace temper::test
