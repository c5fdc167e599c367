// The operators with the measures of the plane and of the sphere, and what is made from operators.
#include "temper/dec.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "base/assert.hpp"
#include "base/median.hpp"
#include "dec/accurate.hpp"
#include "dec/builder.hpp"
#include "dec/coefficient.hpp"
#include "dec/measures.hpp"
#include "dec/summary.hpp"
#include "geometry/surface.hpp"
#include "mesh/bad_triangles.hpp"
#include "temper/detail/geometry.hpp"

namespace temper {
namespace {

// The parts of the operators in each space: lengths, heights and areas of one edge or one triangle, from quotients of
// accurate determinants.

/// Let S_k, S_l be twice the areas of the triangles of an edge, and D the power determinant of their four corners.
/// Moving along the dual line from one orthocenter to the other changes the power of the fourth corner from −D / S_k to
/// 0, at the rate 2 S_l / ℓ. So (h_k + h_l) / ℓ = −D / (2 S_k S_l): accurate when the two heights cancel, and 0 for
/// cocircular points.
class PlaneMeasures {
 public:
  using Point = WeightedPoint;
  explicit PlaneMeasures(const Mesh& mesh) : mesh_(mesh) {}
  [[nodiscard]] Point point(VertexId v) const { return mesh_.point(v); }
  [[nodiscard]] Point point(VertexId v, const Point& near) const { return mesh_.point(v, near); }

  void triangle(DecComplex& c, TriangleId t) const {
    const auto [p, q, r] = mesh_.points(t);
    c.areas.push_back(0.5 * accurate::doubled_area(p.position(), q.position(), r.position()));
    c.orthocenters.push_back(orthocenter(p, q, r));
  }
  void line(DecComplex& /*c*/, DecEdge& edge) const {
    const WeightedPoint from = point(edge.from), to = point(edge.to, from);
    const Vec2 along = to.position() - from.position();
    const double l2 = squared_length(along);
    const double lower = accurate::doubled_crossing(from, to), upper = accurate::doubled_crossing(to, from);
    edge.length = std::sqrt(l2);
    edge.crossing = 0.5 * lower / edge.length;
    // From the nearer end: then the relative error of the distance from there is small.
    edge.midpoint = std::abs(lower) <= std::abs(upper) ? from.position() + (0.5 * lower / l2) * along
                                                       : to.position() - (0.5 * upper / l2) * along;
  }
  /// h over pq in pqr.
  [[nodiscard]] double height(const Point& p, const Point& q, const Point& r, double area, double length) const {
    return 0.5 * (accurate::height_numerator(p, q, r) / (2 * area)) / length;
  }
  /// h/ℓ over pq in pqr.
  [[nodiscard]] double end_ratio(const Point& p, const Point& q, const Point& r, double area, double /*length*/) const {
    const double l2 = squared_length(q.position() - p.position());
    return 0.5 * (accurate::height_numerator(p, q, r) / (2 * area)) / l2;
  }
  /// (h_k + h_l)/ℓ over pq, in pqr and qps, with their areas. 0 − D rather than −D: a tie is +0.
  [[nodiscard]] double dual_ratio(const std::array<Point, 4>& quad, std::array<double, 2> areas,
                                  double /*length*/) const {
    const auto& [p, q, r, s] = quad;
    return 0.5 * ((0 - accurate::power_determinant(p, q, r, s)) / (2 * areas[0])) / (2 * areas[1]);
  }

 private:
  const Mesh& mesh_;
};

/// The normals of the faces PQR and QPS satisfy n_k × n_l = −D (Q − P), D their power determinant. So the arc from one
/// orthocenter to the other has tan(h_k + h_l) = −D |PQ| / (n_k·n_l). This is accurate when the two heights cancel, and
/// 0 for cocircular points.
class SphereMeasures {
 public:
  using Point = Vec3;
  explicit SphereMeasures(const Mesh& mesh) : mesh_(mesh), radius_(mesh.space().radius()) {}
  [[nodiscard]] Point point(VertexId v) const { return mesh_.weighted_vector(v); }
  [[nodiscard]] Point point(VertexId v, const Point& /*near*/) const { return point(v); }

  void triangle(DecComplex& c, TriangleId t) const {
    const auto [i, j, k] = mesh_.corners(t);
    const Vec3 p = point(i), q = point(j), r = point(k);
    c.areas.push_back(radius_ * radius_ * solid_angle(accurate::orientation_determinant(p, q, r), p, q, r));
    c.sphere_orthocenters.push_back(radius_ * orthocenter(p, q, r));
  }
  void line(DecComplex& c, DecEdge& edge) const {
    const Vec3 from = point(edge.from), to = point(edge.to), along = to - from;
    const double l2 = squared_length(along);
    const double lower = accurate::crossing_product(from, to), upper = accurate::crossing_product(to, from);
    const double across = length(cross(from, along));
    edge.length = radius_ * arc_length(from, to);
    edge.crossing = radius_ * std::atan2(lower, across);
    const Vec3 foot = std::abs(lower) <= std::abs(upper) ? from + (lower / l2) * along : to - (upper / l2) * along;
    c.sphere_midpoints.push_back(radius_ / length(foot) * foot);
  }
  [[nodiscard]] double height(const Point& p, const Point& q, const Point& r, double /*area*/,
                              double /*length*/) const {
    const Vec3 n = cross(q - p, r - p), m = cross(p, q - p);
    return radius_ * std::atan2(accurate::height_numerator(p, q, r), length(cross(m, n)));
  }
  [[nodiscard]] double end_ratio(const Point& p, const Point& q, const Point& r, double area, double length) const {
    return height(p, q, r, area, length) / length;
  }
  [[nodiscard]] double dual_ratio(const std::array<Point, 4>& quad, std::array<double, 2> /*areas*/,
                                  double length) const {
    const auto& [p, q, r, s] = quad;
    const Vec3 a = q - p, n_k = cross(a, r - p), n_l = cross(s - p, a);
    const double sine = (0 - accurate::power_determinant(p, q, r, s)) * temper::length(a);
    return radius_ * std::atan2(sine, dot(n_k, n_l)) / length;
  }

 private:
  const Mesh& mesh_;
  double radius_;
};

}  // namespace

DecComplex dec_operators(const Mesh& mesh) {
  TEMPER_ASSERT_SLOW(!has_erased_triangles(mesh));
  return mesh.space().is_plane() ? DecBuilder(mesh, PlaneMeasures(mesh)).build()
                                 : DecBuilder(mesh, SphereMeasures(mesh)).build();
}

DecComplex dec_measures(const Mesh& mesh) { return DecBuilder(mesh, PlaneMeasures(mesh)).build_measures(); }

Expected<DecComplex> with_coefficient(const Mesh& mesh, DecComplex complex, std::span<const double> coefficient,
                                      const InputNames* names) {
  const InputNames from_zero;
  const InputNames& numbers = names != nullptr ? *names : from_zero;
  const auto triangle = [&](std::size_t t) { return std::pair(numbers.triangle_where(t), numbers.triangle(t)); };
  if (auto error = check_coefficient(coefficient, mesh.n_triangles(), "triangles", triangle)) return *error;
  complex.coefficient = IdVector<TriangleId, double>(coefficient.size());
  std::copy(coefficient.begin(), coefficient.end(), complex.coefficient.begin());
  complex.capacity.assign(mesh.n_vertices(), 0.0);
  for (std::size_t i = 0; i < complex.edges.size(); ++i) {
    const EdgeId e(i);
    const DecEdge& edge = complex.edges[e];
    const auto value = [&](TriangleId side, TriangleId other) {
      return complex.coefficient[side.valid() ? side : other];
    };
    const double left = value(edge.left, edge.right), right = value(edge.right, edge.left);
    const DualEdge dual = {edge.dual_length, edge.left_height, edge.right_height};
    complex.star1[e] = dual.combined(left, right) / edge.length;
    const double resistance = dual.combined(1 / left, 1 / right);
    complex.transmissibility[e] = resistance == 0 ? std::numeric_limits<double>::infinity() : edge.length / resistance;
    for (const auto& [v, d] : {std::pair{edge.from, edge.crossing}, std::pair{edge.to, edge.length - edge.crossing}}) {
      complex.capacity[v] += left * right_triangle_areas(mesh.space(), d, edge.left_height, 0) +
                             right * right_triangle_areas(mesh.space(), d, 0, edge.right_height);
    }
  }
  return complex;
}

// A summary of the operators for the authors of solvers: signs, sums, extremes.

namespace {

double largest_of(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

/// Edges inside polygons around ends of faces have no dual, and no sign.
void count_signs(DecSummary& s, const Mesh& mesh, const DecComplex& complex) {
  const JointPolygons joints(mesh);
  for (std::size_t i = 0; i < complex.edges.size(); ++i) {
    const EdgeId e(i);
    const double value = complex.star1[e];
    if (complex.edges[e].is_boundary()) {
      ++s.boundary_edges;
      s.negative_boundary_star1 += value < 0 ? 1 : 0;
    } else {
      s.negative_star1 += value < 0 ? 1 : 0;
      s.zero_star1 += value == 0 && !joints.are_one(complex.edges[e].left, complex.edges[e].right) ? 1 : 0;
    }
  }
  for (const double value : complex.star0) s.negative_star0 += value < 0 ? 1 : 0;
}

void find_extremes(DecSummary& s, const DecComplex& complex) {
  std::vector<double> stars, transmissibilities;
  stars.reserve(complex.edges.size());
  transmissibilities.reserve(complex.edges.size());
  for (std::size_t i = 0; i < complex.edges.size(); ++i) {
    const EdgeId e(i);
    stars.push_back(std::abs(complex.star1[e]));
    if (!complex.edges[e].is_boundary()) transmissibilities.push_back(std::abs(complex.transmissibility[e]));
  }
  s.min_star0 = complex.star0.empty() ? 0 : *std::min_element(complex.star0.begin(), complex.star0.end());
  s.min_star1 = complex.star1.empty() ? 0 : *std::min_element(complex.star1.begin(), complex.star1.end());
  s.max_star1 = largest_of(stars);
  s.max_transmissibility = largest_of(transmissibilities);
  s.median_star1 = median_of(std::move(stars));
  s.median_transmissibility = median_of(std::move(transmissibilities));
}

}  // namespace

DecSummary summary_of_operators(const Mesh& mesh, const DecComplex& complex) {
  DecSummary s;
  s.vertices = complex.star0.size();
  s.edges = complex.edges.size();
  s.triangles = mesh.n_triangles();
  count_signs(s, mesh, complex);
  find_extremes(s, complex);
  for (const double a : complex.areas) s.area += a;
  for (const double a : complex.star0) s.star0_sum += a;
  return s;
}

DecSummary summarize(const Mesh& mesh, const DecComplex& complex) {
  DecSummary s = summary_of_operators(mesh, complex);
  for (const TriangleId t : mesh.triangles()) {
    s.not_well_centered += is_bad(mesh, t);
  }
  return s;
}

}  // namespace temper
