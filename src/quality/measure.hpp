// The measures of one triangle for the report: signs from the exact predicates, lengths and angles from doubles.
//
// Edge k runs from corner k to corner k + 1, like halfedge 3 t + k; the corner across from it is k + 2.
// A triangle that is not counter-clockwise has no inside: its heights count as −∞ and its signs as negative.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/mesh.hpp"
#include "temper/quality.hpp"

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
  /// The least of all h/ℓ and d/ℓ: a distance from well-centered that does not depend on the size of the triangle.
  [[nodiscard]] double margin() const;
};

[[nodiscard]] TriangleMeasure measure_triangle(const Space& space, const std::array<WeightedPoint, 3>& corners);
[[nodiscard]] TriangleMeasure measure_triangle(const Mesh& mesh, TriangleId t);

/// The corner across from edge k, and the one after corner k.
constexpr int corner_after(int k) { return k == 2 ? 0 : k + 1; }
constexpr int corner_across(int k) { return k == 0 ? 2 : k - 1; }

// The triangles that are furthest from well-centered, with a sentence on each that gives the reason.
//
// Triangles are ranked by the least of their h/ℓ and d/ℓ, ties by number: the list does not depend on how the mesh was
// cut into blocks.

struct Ranked {
  double margin = 0;
  TriangleId triangle;
  friend bool operator<(const Ranked& a, const Ranked& b) {
    return a.margin != b.margin ? a.margin < b.margin : a.triangle < b.triangle;
  }
};

/// The first n in rank of everything offered.
class WorstList {
 public:
  explicit WorstList(std::size_t n) : n_(n) {}
  void offer(Ranked candidate);
  void merge(const WorstList& other);
  [[nodiscard]] std::vector<Ranked> sorted() const;

 private:
  std::size_t n_;
  std::vector<Ranked> heap_;  // the best ranked of the list on top
};

/// The entry of the report on one triangle; `why` uses these numbers, or counts from 0.
[[nodiscard]] WorstTriangle describe(const Mesh& mesh, TriangleId t, const InputNames* names = nullptr);

/// The centroid of a triangle, for reports.
[[nodiscard]] Vec2 middle_of(const Mesh& mesh, TriangleId t);

/// The number of a vertex or a triangle in reports: the last word of its name, "12" of "point 12".
[[nodiscard]] std::string number_of(VertexId v, const InputNames* names);
[[nodiscard]] std::string number_of(TriangleId t, const InputNames* names);
/// "138.3°": rounded for people.
[[nodiscard]] std::string degrees(double angle);

/// Two passes, over triangles and over vertices; if brief, one over the edges for the measures over the local size. All
/// executors give equal results. Precondition: no erased triangles. O(n).
[[nodiscard]] SolverMeasures solver_measures(const Mesh& mesh, bool brief, Executor* executor);

}  // namespace temper
