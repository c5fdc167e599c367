// Newton's equations of all the vertices of a part at once.
//
// What moves are the vertices whose whole star is in the part. No two parts share a triangle that moves, so they may be
// worked on at the same time, and each reads points of its own vertices only.
//
// With D the diagonal 3 × 3 blocks of the Hessian H and D = C Cᵀ, the system that is solved is C⁻¹ H C⁻ᵀ z = −C⁻¹ g,
// the step C⁻ᵀ z: its diagonal blocks are identities, its numbers near 1 whatever the mesh, good for single precision.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "energy/star_kernels.hpp"
#include "optimize/step/freedom.hpp"
#include "optimize/sweep/conjugate_gradients.hpp"
#include "optimize/sweep/partition.hpp"

namespace temper {

/// The unknowns of a vertex that move.
enum class Movable : std::uint8_t { nothing, weight, position, all };

class PartSystem {
 public:
  /// Finds the vertices that move, and the pattern of the matrix.
  void gather(const Mesh& mesh, const IdVector<VertexId, Mobility>& mobility, Unknowns unknowns, const Part& part);
  /// The equations at the mesh as it is. Returns the energy of the triangles that move, +∞ outside the barrier's
  /// domain.
  [[nodiscard]] double assemble(const Mesh& mesh, const EdgeFormula& formula);
  /// Solves them, roughly.
  void solve();

  [[nodiscard]] std::size_t size() const { return movable_.size(); }
  [[nodiscard]] VertexId vertex(std::size_t i) const { return VertexId(part_.first.index + i); }
  [[nodiscard]] Movable movable(std::size_t i) const { return movable_[i]; }
  /// The step of vertex(i) in (x, y, w), of what moves.
  [[nodiscard]] std::array<double, 3> step(std::size_t i) const;

  /// The triangles with a corner that moves.
  [[nodiscard]] std::size_t n_triangles() const { return triangles_.size(); }
  /// The next of them from `begin` on, one a lane, the last one in what is left. Returns how many there are.
  std::size_t load(const Mesh& mesh, std::size_t begin, TriangleLanes& lanes) const;

 private:
  [[nodiscard]] bool moves(VertexId v) const { return movable_[index(v)] != Movable::nothing; }
  [[nodiscard]] std::size_t index(VertexId v) const { return v.index - part_.first.index; }
  [[nodiscard]] std::size_t entry(std::size_t begin, std::size_t column) const;

  void find_movable(const Mesh& mesh, const IdVector<VertexId, Mobility>& mobility, Unknowns unknowns);
  void add_row(const Mesh& mesh, std::size_t i);
  void add_triangle(const std::array<VertexId, 3>& corners, const TriangleHessians& hessians, std::size_t lane);
  void add_pair(std::size_t i, std::size_t j, const std::array<double, 9>& block);
  void normalise();
  void factorise(std::size_t i);
  void normalise_block(std::size_t i, std::size_t k);

  Part part_;
  std::vector<Movable> movable_;
  std::vector<TriangleId> triangles_;
  BlockMatrix matrix_;        // while it is assembled: of U alone, scaled by the units below
  std::vector<double> unit_;  // of length, at each vertex: numbers are scaled by (unit, unit, unit²)
  std::vector<std::array<double, 6>> diagonal_;  // lower triangle of D, row by row; once factorised, of C⁻¹
  std::vector<std::array<double, 3>> gradient_;
  std::vector<Float4> right_side_;
  ConjugateGradients solver_;
  const std::vector<Float4>* solution_ = nullptr;
};

}  // namespace temper
