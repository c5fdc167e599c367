// The energy of the accuracy objective, the squared offsets between the centroids of primal and dual elements, and its
// barrier.
//
// A diagonal ★ takes a mean over an edge or face σ for a mean over its dual σ*. The first error, for a linear field, is
// the field's gradient times the offset between their centroids. Over the local size s at σ,
//
//     E = Σ_σ s⁻² |σ| |σ*| |offset|² = Σ_σ s⁻² |N|²/V,     V = |σ| |σ*|,   N = |σ| ∫_{σ*} (x − centroid of σ)
//
// over edges for ★1 (unknowns at vertices) and over faces for ★2 (unknowns in tetrahedra). At an edge N has the dual
// face's centroid against the crossing, and the crossing against the midpoint of the edge; at a face the orthocenter
// against the centroid, and the face against the midpoint of its dual edge. In the plane N is δ and η
// (energy/accuracy_energy.hpp). The moments of HOT that no mesh avoids are left out. V and N are sums over tetrahedra
// (parts.hpp), but E is not: the parts of a dual cancel. A sum of |N|²/V over tetrahedra bounds it, yet its minimum
// cannot be near 0.
//
// Behind it stands the barrier − μ Σ s³ ln(h/ℓ − f) over the sides of all faces, with the height h and the floor f of
// the side. If the criterion asks for positive dual lengths only, a face inside a region has the sum of its heights on
// both sides.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "temper/detail/criterion.hpp"
#include "temper/tets/mesh.hpp"
#include "tets/energy/parts.hpp"

namespace temper::tets {

/// The factors of edges and faces in E. On the boundary the dual ends, and its offset cannot vanish.
struct AccuracyModel {
  double edges = 0, boundary_edges = 0;
  double faces = 0, boundary_faces = 0;
  double barrier = 0;  ///< μ
};
struct AccuracyTotal {
  double energy = 0, barrier = 0;
};

using VertexSizes = IdVector<VertexId, double>;

/// Says whether the heights on both sides of a face count together.
[[nodiscard]] inline bool has_joined_sides(const TetMesh& mesh, HalffaceId h, Criterion criterion) {
  return criterion != Criterion::well_centered && !mesh.bounds_region(h);
}
/// h/ℓ of a side of a face, or the sum of both sides if they count together.
[[nodiscard]] double height_that_counts(const TetMesh& mesh, HalffaceId h, Criterion criterion);

/// The energy of meshes with one connectivity. Sizes and floors stay.
class AccuracyEnergy {
 public:
  static constexpr double kNoFloor = -HUGE_VAL;  ///< The floor of a side without a barrier
  using Floors = IdVector<HalffaceId, double>;

  AccuracyEnergy() = default;
  /// Elements of this mesh whose V is not positive are left out.
  AccuracyEnergy(const TetMesh& mesh, const VertexSizes& sizes, Floors floors, const AccuracyModel& model,
                 Criterion criterion);
  /// Says whether an element of a tetrahedron is left out.
  [[nodiscard]] bool leaves_out_part_of(TetId t) const;

  /// Infinite if some V is not positive, or some side not above its floor. If `gradient` is not null, sets it to the
  /// derivatives of the sum by all vertices.
  [[nodiscard]] AccuracyTotal of(const TetMesh& mesh, Gradient* gradient, Executor* executor) const;

 private:
  /// The numbers of the edges and faces of a tetrahedron among all elements.
  struct Elements {
    std::array<std::uint32_t, 6> edges;
    std::array<std::uint32_t, 4> faces;
  };

  using Parts = IdVector<TetId, TetParts>;
  /// V and N of all elements.
  [[nodiscard]] std::vector<Offset> sums_of(const Parts& parts) const;
  /// Returns the barrier, and adds its derivatives by all heights.
  double barrier_of(const TetMesh& mesh, const Parts& parts, Floors& by_height) const;

  IdVector<TetId, Elements> elements_;
  std::vector<double> factors_;  // of the elements: edges, then faces
  std::vector<std::uint8_t> is_left_out_;
  Floors barriers_, floors_;  // μ s³
  Criterion criterion_ = Criterion::well_centered;
};

}  // namespace temper::tets
