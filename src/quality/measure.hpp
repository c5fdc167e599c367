// The measures of one triangle for the report: signs from the exact predicates, lengths and angles from doubles.
//
// Edge k runs from corner k to corner k + 1, like halfedge 3 t + k; the corner across from it is k + 2.
// A triangle that is not counter-clockwise has no inside: its heights count as −∞ and its signs as negative.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
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

// Parts of the report that triangles and tetrahedra share. Elements are ranked by their margins, ties by number: the
// list of the worst does not depend on how the mesh was cut into blocks.

template <class Element>
struct Ranked {
  double margin = 0;
  Element element;
  friend bool operator<(const Ranked& a, const Ranked& b) {
    return a.margin != b.margin ? a.margin < b.margin : a.element < b.element;
  }
};

/// The first n in rank of everything offered.
template <class Element>
class WorstList {
 public:
  explicit WorstList(std::size_t n) : n_(n) {}
  /// A margin that is NaN ranks as the worst.
  void offer(Ranked<Element> candidate) {
    if (std::isnan(candidate.margin)) candidate.margin = -std::numeric_limits<double>::infinity();
    if (heap_.size() == n_) {
      if (n_ == 0 || !(candidate < heap_.front())) return;
      std::pop_heap(heap_.begin(), heap_.end());
      heap_.pop_back();
    }
    heap_.push_back(candidate);
    std::push_heap(heap_.begin(), heap_.end());
  }
  void merge(const WorstList& other) {
    for (const Ranked<Element>& candidate : other.heap_) offer(candidate);
  }
  [[nodiscard]] std::vector<Ranked<Element>> sorted() const {
    std::vector<Ranked<Element>> result = heap_;
    std::sort(result.begin(), result.end());
    return result;
  }

 private:
  std::size_t n_;
  std::vector<Ranked<Element>> heap_;  // the best ranked of the list on top
};

/// Bins of 10°, and of 0.1 with a bin edge at h = 0.
inline Histogram empty_angle_histogram() { return {0, 180, std::vector<std::size_t>(18)}; }
inline Histogram empty_height_histogram() { return {-0.5, 1, std::vector<std::size_t>(15)}; }
/// Bins of 0.05 with a bin edge at d = 0.
inline Histogram empty_crossing_histogram() { return {-0.1, 0.5, std::vector<std::size_t>(12)}; }

/// The number of different regions of the elements of a mesh.
template <class MeshOfAnyKind, class Elements>
[[nodiscard]] std::size_t count_regions(const MeshOfAnyKind& mesh, const Elements& elements) {
  std::set<std::int32_t> regions;
  std::optional<std::int32_t> last;
  for (const auto element : elements) {
    if (last != mesh.region(element)) regions.insert(*(last = mesh.region(element)));
  }
  return regions.size();
}

/// The entry of the report on one triangle; `why` uses these numbers, or counts from 0.
[[nodiscard]] WorstTriangle describe(const Mesh& mesh, TriangleId t, const InputNames* names = nullptr);
/// The same without its place, from the measures of the triangle and the squared lengths of its edges. The mesh gives
/// connectivity and weights alone.
[[nodiscard]] WorstTriangle describe(const Mesh& mesh, TriangleId t, const TriangleMeasure& m,
                                     const std::array<double, 3>& squared_lengths, const InputNames* names = nullptr);

/// The centroid of a triangle, for reports.
[[nodiscard]] Vec2 middle_of(const Mesh& mesh, TriangleId t);
/// The edge of h, for reports.
[[nodiscard]] EdgePlace place_of(const Mesh& mesh, HalfedgeId h);

/// The number of a vertex or a triangle in reports: the last word of its name, "12" of "point 12".
[[nodiscard]] std::string number_of(VertexId v, const InputNames* names);
[[nodiscard]] std::string number_of(TriangleId t, const InputNames* names);
/// "138.3°": rounded for people.
[[nodiscard]] std::string degrees(double angle);

}  // namespace temper
