// The measures of one tetrahedron: signs from the exact predicates, lengths and angles from doubles.
//
// A tetrahedron that is not positive has no inside: its heights count as −∞ and its signs as negative.
#pragma once

#include <array>

#include "temper/tets/quality.hpp"

namespace temper::tets {

struct TetMeasure {
  Sign orientation = Sign::zero;
  std::array<Sign, 4> h_sign = {};          ///< of the height of the orthocenter over the face opposite corner f, exact
  std::array<double, 4> h = {};             ///< this height
  std::array<double, 4> h_over_l = {};      ///< relative to the face
  std::array<double, 6> dihedral_deg = {};  ///< at the edges of kEdgeCorners
  double volume = 0;

  [[nodiscard]] bool orthocenter_inside() const;
  [[nodiscard]] double margin() const;
};
[[nodiscard]] TetMeasure measure_tetrahedron(const std::array<WeightedPoint, 4>& corners);

using FacePoints = std::array<WeightedPoint, 3>;
[[nodiscard]] FacePoints points_of(const TetMesh& mesh, HalffaceId h);
/// Says whether the orthocenter of a face is strictly inside. Exact.
[[nodiscard]] bool is_crossed(const FacePoints& face);
/// Says whether 0 < d < ℓ. Exact.
[[nodiscard]] bool is_crossed(const WeightedPoint& p, const WeightedPoint& q);
/// Says whether all faces and edges of a tetrahedron are crossed. Exact.
[[nodiscard]] bool has_all_crossed(const TetMesh& mesh, TetId t);

[[nodiscard]] double area(const FacePoints& face);
/// The side of the equilateral triangle with this area.
[[nodiscard]] double length_of_area(double area);

/// The cosine of the least dihedral angle of a tetrahedron or of a mesh.
[[nodiscard]] double largest_dihedral_cosine(const TetMesh& mesh, TetId t);
[[nodiscard]] double largest_dihedral_cosine(const TetMesh& mesh, Executor* executor);

/// The entry of the report on one tetrahedron.
[[nodiscard]] WorstTet describe(const TetMesh& mesh, TetId t, const IdVector<VertexId, std::uint8_t>& on_boundary);

}  // namespace temper::tets
