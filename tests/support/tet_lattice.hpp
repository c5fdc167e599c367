// Lattices of tetrahedra: the degenerate families of the third dimension, and the small meshes that laws are tried on.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "support/lattice.hpp"
#include "temper/tets/mesh.hpp"

namespace temper::test {

/// Arrays that make a mesh of tetrahedra.
struct TetArrays {
  std::vector<Vec3> points;
  std::vector<double> weights;
  std::vector<std::array<std::int32_t, 4>> tetrahedra;

  [[nodiscard]] tets::TetMeshInput input() const {
    tets::TetMeshInput in;
    in.points = points, in.weights = weights, in.tetrahedra = tetrahedra;
    return in;
  }
};

inline tets::BuiltTetMesh built(const tets::TetMeshInput& input) {
  auto result = tets::TetMesh::build(input);
  if (!result) {
    ADD_FAILURE() << result.error().what();
    return {};
  }
  return *std::move(result);
}
inline tets::TetMesh mesh_of(const TetArrays& arrays) { return built(arrays.input()).mesh; }

/// Cubes around which corners are numbered by the bits x, y, z.
using CubeCut = std::vector<std::array<int, 4>>;
/// Six tetrahedra around the diagonal (Kuhn); in truth cospherical, and so is every cut.
inline const CubeCut kSixTets = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
/// Five tetrahedra, one in the middle. Neighboring cubes are mirrored.
inline const CubeCut kFiveTets = {{0, 3, 5, 6}, {0, 3, 1, 5}, {0, 5, 4, 6}, {0, 6, 2, 3}, {3, 5, 6, 7}};

/// Exchanges two corners of negative tetrahedra.
inline void make_positive(TetArrays& a) {
  for (auto& [p, q, r, s] : a.tetrahedra) {
    const auto at = [&](std::int32_t i) { return a.points[std::size_t(i)]; };
    if (tets::orientation(at(p), at(q), at(r), at(s)) == Sign::negative) std::swap(r, s);
  }
}

/// n³ cubes of side 1, each cut into tetrahedra.
inline TetArrays cubes(int n, const CubeCut& cut) {
  TetArrays a;
  const auto index = [n](int x, int y, int z) { return (z * (n + 1) + y) * (n + 1) + x; };
  for (int z = 0; z <= n; ++z) {
    for (int y = 0; y <= n; ++y) {
      for (int x = 0; x <= n; ++x) a.points.push_back({double(x), double(y), double(z)});
    }
  }
  const bool mirrored = cut.size() == 5;
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const int flip = mirrored && (x + y + z) % 2 == 1 ? 1 : 0;
        for (const auto& corners : cut) {
          auto& t = a.tetrahedra.emplace_back();
          for (std::size_t k = 0; k < 4; ++k) {
            const int c = corners[k] ^ flip;
            t[k] = index(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2));
          }
        }
      }
    }
  }
  make_positive(a);
  return a;
}

/// Tetrahedra of the body-centered cubic lattice: each has the centers of two cubes that share a face, and an edge of
/// this face. All are well-centered, with four equal heights.
inline TetArrays body_centered(int n) {
  const TetArrays all = cubes(n, kFiveTets);
  TetArrays a;
  a.points = all.points;
  const auto corner = [n](std::array<int, 3> p) { return (p[2] * (n + 1) + p[1]) * (n + 1) + p[0]; };
  const auto center = [&](std::array<int, 3> p) {
    return static_cast<int>(all.points.size()) + (p[2] * n + p[1]) * n + p[0];
  };
  for (int i = 0; i < n * n * n; ++i) a.points.push_back({i % n + 0.5, i / n % n + 0.5, i / n / n + 0.5});
  for (int i = 0; i < n * n * n; ++i) {
    const std::array<int, 3> cube = {i % n, i / n % n, i / n / n};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::array<int, 3> next = cube;
      if (++next[axis] == n) continue;
      std::array<std::int32_t, 4> face;
      constexpr int kAround[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
      for (std::size_t k = 0; k < 4; ++k) {
        std::array<int, 3> p = next;
        p[(axis + 1) % 3] += kAround[k][0], p[(axis + 2) % 3] += kAround[k][1];
        face[k] = corner(p);
      }
      for (std::size_t k = 0; k < 4; ++k)
        a.tetrahedra.push_back({center(cube), center(next), face[k], face[(k + 1) % 4]});
    }
  }
  std::vector<std::int32_t> number(a.points.size(), -1);
  std::vector<Vec3> used;
  for (auto& t : a.tetrahedra) {
    for (std::int32_t& p : t) {
      auto& to = number[std::size_t(p)];
      if (to < 0) to = static_cast<std::int32_t>(used.size()), used.push_back(a.points[std::size_t(p)]);
      p = to;
    }
  }
  a.points = used;
  make_positive(a);
  return a;
}

/// Moves the points by at most `jitter` along each axis, and gives them random weights.
inline TetArrays shaken(TetArrays a, double jitter, double weight, std::uint64_t seed = 1) {
  Noise noise(seed);
  for (Vec3& p : a.points) p = p + jitter * Vec3{noise(), noise(), noise()};
  for (std::size_t i = 0; i < a.points.size(); ++i) a.weights.push_back(weight * noise());
  return a;
}

}  // namespace temper::test
