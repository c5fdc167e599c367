// The operators: first edges in the order of their vertices, then everything that belongs to a triangle or an edge,
// with the measures of the space.
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
#include "dec/coefficient.hpp"
#include "dec/joint_polygons.hpp"
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

/// Half-edges that stand for edges, sorted by (lower vertex, higher vertex): buckets by the lower one, each sorted.
std::vector<HalfedgeId> sorted_edges(const Mesh& mesh) {
  const auto low = [&](HalfedgeId h) { return std::min(mesh.origin(h), mesh.target(h)); };
  const auto high = [&](HalfedgeId h) { return std::max(mesh.origin(h), mesh.target(h)); };
  std::vector<std::size_t> starts(mesh.n_vertices() + 1, 0);
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_edge_representative(h)) ++starts[low(h).index + 1];
  }
  for (std::size_t v = 0; v < mesh.n_vertices(); ++v) starts[v + 1] += starts[v];
  std::vector<HalfedgeId> sorted(starts.back());
  std::vector<std::size_t> next = starts;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_edge_representative(h)) sorted[next[low(h).index]++] = h;
  }
  const auto at = [&](std::size_t i) { return sorted.begin() + static_cast<std::ptrdiff_t>(i); };
  for (std::size_t v = 0; v < mesh.n_vertices(); ++v) {
    std::sort(at(starts[v]), at(starts[v + 1]), [&](HalfedgeId a, HalfedgeId b) { return high(a) < high(b); });
  }
  return sorted;
}

/// Builds the operators from the measures of one space.
template <class Measures>
class DecBuilder {
 public:
  explicit DecBuilder(const Mesh& mesh) : mesh_(mesh), measures_(mesh) {}
  DecComplex build();

 private:
  void triangles();
  void add_edge(HalfedgeId h);
  [[nodiscard]] double height(HalfedgeId h, double length) const;
  [[nodiscard]] double star1(HalfedgeId left, HalfedgeId right, double length) const;
  void incidence();
  void dual_areas();

  const Mesh& mesh_;
  const Measures measures_;
  DecComplex c_;
};

template <class Measures>
DecComplex DecBuilder<Measures>::build() {
  triangles();
  const std::vector<HalfedgeId> edges = sorted_edges(mesh_);
  c_.edges.reserve(edges.size());
  c_.star1.reserve(edges.size());
  c_.transmissibility.reserve(edges.size());
  c_.edge_of_halfedge.resize(mesh_.n_halfedges());
  for (const HalfedgeId h : edges) add_edge(h);
  incidence();
  dual_areas();
  return std::move(c_);
}

template <class Measures>
void DecBuilder<Measures>::triangles() {
  c_.areas.reserve(mesh_.n_triangles());
  c_.star2.reserve(mesh_.n_triangles());
  for (const TriangleId t : mesh_.triangles()) {
    measures_.triangle(c_, t);
    c_.star2.push_back(1 / c_.areas[t]);
  }
  const JointPolygons joints(mesh_);
  for (const TriangleId t : mesh_.triangles()) {
    if (joints.whole(t) == t) continue;
    if (!mesh_.space().is_plane()) {
      c_.sphere_orthocenters[t] = c_.sphere_orthocenters[joints.whole(t)];
      continue;
    }
    const auto [i, j, k] = mesh_.corners(joints.whole(t));
    const WeightedPoint here = mesh_.point(mesh_.corners(t)[0]);
    c_.orthocenters[t] = orthocenter(mesh_.point(i, here), mesh_.point(j, here), mesh_.point(k, here));
  }
}

template <class Measures>
void DecBuilder<Measures>::add_edge(HalfedgeId h) {
  const bool upwards = mesh_.origin(h) < mesh_.target(h);
  const HalfedgeId left = upwards ? h : mesh_.twin(h), right = upwards ? mesh_.twin(h) : h;
  const EdgeId e(c_.edges.size());
  c_.edge_of_halfedge[h] = e;
  if (mesh_.twin(h).valid()) c_.edge_of_halfedge[mesh_.twin(h)] = e;
  DecEdge edge;
  edge.from = upwards ? mesh_.origin(h) : mesh_.target(h);
  edge.to = upwards ? mesh_.target(h) : mesh_.origin(h);
  measures_.line(c_, edge);
  if (left.valid()) edge.left = Mesh::triangle(left), edge.left_height = height(left, edge.length);
  if (right.valid()) edge.right = Mesh::triangle(right), edge.right_height = height(right, edge.length);
  double ratio = 0;
  if (!mesh_.is_joint(h))
    ratio = star1(left, right, edge.length);
  else if (!edge.is_boundary())
    edge.right_height = -edge.left_height;  // both are to one orthocenter
  else
    edge.left_height = edge.right_height = 0;  // the orthocenter is on the edge
  edge.dual_length = ratio * edge.length;
  c_.edges.push_back(edge);
  c_.star1.push_back(ratio);
  c_.transmissibility.push_back(ratio == 0 ? std::numeric_limits<double>::infinity() : 1 / ratio);
}

template <class Measures>
double DecBuilder<Measures>::height(HalfedgeId h, double length) const {
  const auto p = measures_.point(mesh_.origin(h));
  return measures_.height(p, measures_.point(mesh_.target(h), p), measures_.point(mesh_.opposite(h), p),
                          c_.areas[Mesh::triangle(h)], length);
}

template <class Measures>
double DecBuilder<Measures>::star1(HalfedgeId left, HalfedgeId right, double length) const {
  const HalfedgeId h = left.valid() ? left : right;
  const auto p = measures_.point(mesh_.origin(h)), q = measures_.point(mesh_.target(h), p);
  const auto r = measures_.point(mesh_.opposite(h), p);
  const double here = c_.areas[Mesh::triangle(h)];
  if (!left.valid() || !right.valid()) return measures_.end_ratio(p, q, r, here, length);
  const auto s = measures_.point(mesh_.opposite(right), p);
  return measures_.dual_ratio({p, q, r, s}, {here, c_.areas[Mesh::triangle(right)]}, length);
}

template <class Measures>
void DecBuilder<Measures>::incidence() {
  const std::size_t n_edges = c_.edges.size(), n_triangles = mesh_.n_triangles();
  TEMPER_ASSERT(n_edges < std::size_t{1} << 31);
  c_.d0 = {mesh_.n_vertices(), std::vector<std::int64_t>(n_edges + 1), {}, {}};
  c_.d0.columns.reserve(2 * n_edges);
  c_.d0.signs.reserve(2 * n_edges);
  for (std::size_t e = 0; e < n_edges; ++e) {
    const DecEdge& edge = c_.edges[EdgeId(e)];
    c_.d0.columns.push_back(static_cast<std::int32_t>(edge.from.index));
    c_.d0.columns.push_back(static_cast<std::int32_t>(edge.to.index));
    c_.d0.signs.push_back(-1);
    c_.d0.signs.push_back(1);
    c_.d0.starts[e + 1] = static_cast<std::int64_t>(2 * (e + 1));
  }
  c_.d1 = {n_edges, std::vector<std::int64_t>(n_triangles + 1), {}, {}};
  c_.d1.columns.reserve(3 * n_triangles);
  c_.d1.signs.reserve(3 * n_triangles);
  for (const TriangleId t : mesh_.triangles()) {
    std::array<HalfedgeId, 3> sides = {Mesh::halfedge(t, 0), Mesh::halfedge(t, 1), Mesh::halfedge(t, 2)};
    std::sort(sides.begin(), sides.end(),
              [&](HalfedgeId a, HalfedgeId b) { return c_.edge_of_halfedge[a] < c_.edge_of_halfedge[b]; });
    for (const HalfedgeId h : sides) {
      c_.d1.columns.push_back(static_cast<std::int32_t>(c_.edge_of_halfedge[h].index));
      c_.d1.signs.push_back(mesh_.origin(h) < mesh_.target(h) ? 1 : -1);
    }
    c_.d1.starts[t.index + 1] = 3 * (std::int64_t{t.index} + 1);
  }
}

// Each edge has its two half-edges' heights, and its two ends' shares of the length.
template <class Measures>
void DecBuilder<Measures>::dual_areas() {
  c_.star0.resize(mesh_.n_vertices(), 0.0);
  for (const DecEdge& edge : c_.edges) {
    const double left = edge.left_height, right = edge.right_height;
    c_.star0[edge.from] += right_triangle_areas(mesh_.space(), edge.crossing, left, right);
    c_.star0[edge.to] += right_triangle_areas(mesh_.space(), edge.length - edge.crossing, left, right);
  }
}

}  // namespace

DecComplex dec_operators(const Mesh& mesh) {
  TEMPER_ASSERT_SLOW(!has_erased_triangles(mesh));
  return mesh.space().is_plane() ? DecBuilder<PlaneMeasures>(mesh).build() : DecBuilder<SphereMeasures>(mesh).build();
}

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

DecSummary summarize(const Mesh& mesh, const DecComplex& complex) {
  DecSummary s;
  s.vertices = complex.star0.size();
  s.edges = complex.edges.size();
  s.triangles = mesh.n_triangles();
  count_signs(s, mesh, complex);
  find_extremes(s, complex);
  for (const double a : complex.areas) s.area += a;
  for (const double a : complex.star0) s.star0_sum += a;
  for (const TriangleId t : mesh.triangles()) {
    s.not_well_centered += is_bad(mesh, t);
  }
  return s;
}

}  // namespace temper
