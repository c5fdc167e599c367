// The measures of one triangle for the report: signs from the exact predicates, lengths and angles from doubles.
//
// Edge k runs from corner k to corner k + 1, like halfedge 3 t + k; the corner across from it is k + 2.
// A triangle that is not counter-clockwise has no inside: its heights count as −∞ and its signs as negative.
#pragma once

#include <array>

#include "temper/detail/geometry.hpp"
#include "temper/mesh.hpp"

namespace temper {

struct TriangleMeasure {
  Sign orientation = Sign::zero;
  std::array<Sign, 3> h_sign = {};       ///< of the height of the orthocenter over edge k, exact
  std::array<bool, 3> crossed = {};      ///< 0 < d < ℓ on edge k, exact
  std::array<double, 3> h_over_l = {};   ///< h / ℓ of edge k
  std::array<double, 3> d_over_l = {};   ///< the lesser of d/ℓ and 1 − d/ℓ of edge k
  std::array<double, 3> angle_deg = {};  ///< at corner k

  [[nodiscard]] bool orthocenter_inside() const;
  [[nodiscard]] bool well_centered() const;
  /// The least of all h/ℓ and d/ℓ: how far from well-centered, whatever the size of the triangle.
  [[nodiscard]] double margin() const;
};

[[nodiscard]] TriangleMeasure measure_triangle(const Space& space, const std::array<WeightedPoint, 3>& corners);
[[nodiscard]] TriangleMeasure measure_triangle(const Mesh& mesh, TriangleId t);

/// The corner across from edge k, and the one after corner k.
constexpr int corner_after(int k) { return k == 2 ? 0 : k + 1; }
constexpr int corner_across(int k) { return k == 0 ? 2 : k - 1; }

}  // namespace temper
