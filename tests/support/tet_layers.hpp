// Tetrahedra in layers with different diffusion tensors.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "support/tet_lattice.hpp"
#include "temper/tets/tensor.hpp"

namespace temper::test {

/// The tensor whose inverse is this matrix.
inline Tensor3 inverse_of(const Tensor3& m) {
  const Vec3 a = {m.xx, m.xy, m.xz}, b = {m.xy, m.yy, m.yz}, c = {m.xz, m.yz, m.zz};
  const double determinant = dot(a, cross(b, c));
  const Vec3 x = (1 / determinant) * cross(b, c), y = (1 / determinant) * cross(c, a),
             z = (1 / determinant) * cross(a, b);
  return {x.x, x.y, x.z, y.y, y.z, z.z};
}

/// Tensors whose inverses are isotropic within planes z = const, so that their metrics are multiples of each other
/// there; axes are tilted.
inline const Tensor3 kLower = inverse_of({1, 0, 0.2, 1, -0.1, 3}), kUpper = inverse_of({0.2, 0, -0.1, 0.2, 0.05, 0.15});
/// One that is not.
inline const Tensor3 kOther = {1, 0.3, 0.1, 4, 0, 2};

/// n³ cubes of tetrahedra in two layers. Inner vertices off the plane between the layers are moved and have weights.
inline tets::TetMesh two_layers(int n, double jitter, double weight, const CubeCut& cut = kFiveTets) {
  TetArrays a = cubes(n, cut);
  Noise noise(5);
  for (const Vec3& p : std::vector<Vec3>(a.points)) {
    const auto inside = [n](double x) { return x > 0 && x < n; };
    const bool moves = inside(p.x) && inside(p.y) && inside(p.z) && p.z != n / 2;
    const Vec3 by = jitter * Vec3{noise(), noise(), noise()};
    const double w = weight * noise();
    a.weights.push_back(moves ? w : 0);
    if (moves) a.points[a.weights.size() - 1] = p + by;
  }
  make_positive(a);
  tets::TetMesh mesh = mesh_of(a);
  for (const tets::TetId t : mesh.tetrahedra()) {
    double z = 0;
    for (const VertexId v : mesh.corners(t)) z += 0.25 * mesh.position(v).z;
    mesh.set_region(t, z < n / 2 ? 1 : 2);
  }
  return mesh;
}

/// The tensor of each tetrahedron: of region 1, or of the other region.
inline std::vector<Tensor3> tensors_of(const tets::TetMesh& mesh, const Tensor3& one, const Tensor3& other) {
  std::vector<Tensor3> tensors;
  for (const tets::TetId t : mesh.tetrahedra()) tensors.push_back(mesh.region(t) == 1 ? one : other);
  return tensors;
}

inline tets::MetricMesh pieces_of(const tets::TetMesh& mesh, const Tensor3& one, const Tensor3& other) {
  const auto metrics = tets::Metrics::of(tensors_of(mesh, one, other));
  auto pieces = mapped(mesh, *metrics);
  EXPECT_TRUE(pieces);
  return *std::move(pieces);
}

}  // namespace temper::test
