// The operators: edges in the order of their vertices, then everything that belongs to a triangle or an edge, by
// quotients of accurate determinants.
//
// With S_k, S_l twice the areas of the triangles of an edge and D the power determinant of their four corners, moving
// along the dual line from one orthocenter to the other changes the power of the fourth corner from −D / S_k to 0, at
// the rate 2 S_l / ℓ. So (h_k + h_l) / ℓ = −D / (2 S_k S_l): accurate where the two heights cancel, and 0 for
// cocircular points.
#include "temper/dec.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/assert.hpp"
#include "dec/accurate.hpp"
#include "mesh/erased.hpp"
#include "temper/geometry.hpp"

namespace temper {
namespace {

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

class DecBuilder {
 public:
  explicit DecBuilder(const Mesh& mesh) : mesh_(mesh), doubled_(mesh.n_triangles()) {}
  DecComplex build();

 private:
  void triangles();
  void add_edge(HalfedgeId h);
  void measure(DecEdge& edge, HalfedgeId left, HalfedgeId right);
  [[nodiscard]] double height(HalfedgeId h, double length) const;
  [[nodiscard]] double star1(HalfedgeId left, HalfedgeId right) const;
  void incidence();
  void dual_areas();

  const Mesh& mesh_;
  IdVector<TriangleId, double> doubled_;  // twice the area
  DecComplex c_;
};

DecComplex DecBuilder::build() {
  triangles();
  const std::vector<HalfedgeId> edges = sorted_edges(mesh_);
  c_.edges.reserve(edges.size());
  c_.star1.reserve(edges.size());
  c_.flux.reserve(edges.size());
  c_.edge_of_halfedge.resize(mesh_.n_halfedges());
  for (const HalfedgeId h : edges) add_edge(h);
  incidence();
  dual_areas();
  return std::move(c_);
}

void DecBuilder::triangles() {
  const std::size_t n = mesh_.n_triangles();
  c_.areas.resize(n);
  c_.star2.resize(n);
  c_.orthocenters.resize(n);
  for (const TriangleId t : mesh_.triangles()) {
    const auto [i, j, k] = mesh_.corners(t);
    doubled_[t] = accurate::doubled_area(mesh_.position(i), mesh_.position(j), mesh_.position(k));
    c_.areas[t] = 0.5 * doubled_[t];
    c_.star2[t] = 2 / doubled_[t];
    c_.orthocenters[t] = orthocenter(mesh_.point(i), mesh_.point(j), mesh_.point(k));
  }
}

void DecBuilder::add_edge(HalfedgeId h) {
  const bool upwards = mesh_.origin(h) < mesh_.target(h);
  const HalfedgeId left = upwards ? h : mesh_.twin(h), right = upwards ? mesh_.twin(h) : h;
  const EdgeId e(c_.edges.size());
  c_.edge_of_halfedge[h] = e;
  if (mesh_.twin(h).valid()) c_.edge_of_halfedge[mesh_.twin(h)] = e;
  DecEdge edge;
  edge.from = upwards ? mesh_.origin(h) : mesh_.target(h);
  edge.to = upwards ? mesh_.target(h) : mesh_.origin(h);
  measure(edge, left, right);
  const double ratio = star1(left, right);
  edge.dual_length = ratio * edge.length;
  c_.edges.push_back(edge);
  c_.star1.push_back(ratio);
  c_.flux.push_back(ratio == 0 ? std::numeric_limits<double>::infinity() : 1 / ratio);
}

void DecBuilder::measure(DecEdge& edge, HalfedgeId left, HalfedgeId right) {
  const WeightedPoint from = mesh_.point(edge.from), to = mesh_.point(edge.to);
  const Vec2 along = to.position() - from.position();
  const double l2 = squared_length(along);
  const double lower = accurate::doubled_split(from, to), upper = accurate::doubled_split(to, from);
  edge.length = std::sqrt(l2);
  edge.split = 0.5 * lower / edge.length;
  // From the nearer end: the midpoint is then as accurate as its distance from it.
  edge.midpoint = std::abs(lower) <= std::abs(upper) ? from.position() + (0.5 * lower / l2) * along
                                                     : to.position() - (0.5 * upper / l2) * along;
  if (left.valid()) edge.left = Mesh::triangle(left), edge.left_height = height(left, edge.length);
  if (right.valid()) edge.right = Mesh::triangle(right), edge.right_height = height(right, edge.length);
}

double DecBuilder::height(HalfedgeId h, double length) const {
  const double numerator = accurate::height_numerator(mesh_.point(mesh_.origin(h)), mesh_.point(mesh_.target(h)),
                                                      mesh_.point(mesh_.opposite(h)));
  return 0.5 * (numerator / doubled_[Mesh::triangle(h)]) / length;
}

double DecBuilder::star1(HalfedgeId left, HalfedgeId right) const {
  const HalfedgeId h = left.valid() ? left : right;
  const WeightedPoint p = mesh_.point(mesh_.origin(h)), q = mesh_.point(mesh_.target(h));
  const WeightedPoint r = mesh_.point(mesh_.opposite(h));
  const double here = doubled_[Mesh::triangle(h)];
  if (!left.valid() || !right.valid()) {
    const double l2 = squared_length(q.position() - p.position());
    return 0.5 * (accurate::height_numerator(p, q, r) / here) / l2;
  }
  const WeightedPoint s = mesh_.point(mesh_.opposite(right));
  // 0 − D rather than −D: a tie is +0.
  return 0.5 * ((0 - accurate::power_determinant(p, q, r, s)) / here) / doubled_[Mesh::triangle(right)];
}

void DecBuilder::incidence() {
  const std::size_t n_edges = c_.edges.size(), n_triangles = mesh_.n_triangles();
  c_.d0 = {mesh_.n_vertices(), std::vector<std::int32_t>(n_edges + 1), {}, {}};
  c_.d0.columns.reserve(2 * n_edges);
  c_.d0.signs.reserve(2 * n_edges);
  for (std::size_t e = 0; e < n_edges; ++e) {
    const DecEdge& edge = c_.edges[EdgeId(e)];
    c_.d0.columns.push_back(static_cast<std::int32_t>(edge.from.index));
    c_.d0.columns.push_back(static_cast<std::int32_t>(edge.to.index));
    c_.d0.signs.push_back(-1);
    c_.d0.signs.push_back(1);
    c_.d0.starts[e + 1] = static_cast<std::int32_t>(2 * (e + 1));
  }
  c_.d1 = {n_edges, std::vector<std::int32_t>(n_triangles + 1), {}, {}};
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
    c_.d1.starts[t.index + 1] = static_cast<std::int32_t>(3 * (t.index + 1));
  }
}

// Each edge has its two half-edges' heights, and its two ends' shares of the length.
void DecBuilder::dual_areas() {
  c_.star0.resize(mesh_.n_vertices(), 0.0);
  for (const DecEdge& edge : c_.edges) {
    const double both = edge.left_height + edge.right_height;
    c_.star0[edge.from] += 0.5 * edge.split * both;
    c_.star0[edge.to] += 0.5 * (edge.length - edge.split) * both;
  }
}

}  // namespace

DecComplex dec(const Mesh& mesh) {
  TEMPER_ASSERT(mesh.n_halfedges() < std::size_t{1} << 31);
  TEMPER_ASSERT_SLOW(!has_erased_triangles(mesh));
  return DecBuilder(mesh).build();
}

}  // namespace temper
