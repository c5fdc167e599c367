// Grading of the boundary and of constrained lines: no edge is much longer than its neighbor.
//
//     |-|-----------------------------|        a short edge beside a long one, ratio 16
//     |-|---|------|------------------|        pieces that grow by one factor q ≤ ratio: s q, s q², s q³ …
//
// Every vertex of a line has a size s: the shortest piece that meets it. An edge of length L between sizes s_a and s_b
// stays whole when L ≤ r min(s_a, s_b), r the ratio. Otherwise it gets the least number k of pieces that can cover it
// when they grow by r from both ends,
//     Σ u_i(r) ≥ L,   u_i(q) = min(q^i s_a, q^(k+1−i) s_b),   i = 1 … k,
// and then the least growth q for which k pieces suffice: Σ u_i(q) = L, pieces u_i(q). With r ≥ 2, k pieces of the
// smaller size are shorter than L, since k ≤ 2(k−1) and k − 1 pieces of r s were too short. So q ≥ 1, and no piece is
// shorter than the smaller of the two sizes. The piece at the other end may be shorter than its old size, and becomes
// its size.
//
// So sizes spread from the smallest outwards as in Dijkstra's algorithm. A vertex taken from the queue has its final
// size, because all later vertices are at least as large. Each vertex is visited once, and every piece p at a vertex of
// size s has s ≤ p ≤ r s: any two of them are within r.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <queue>
#include <utility>

#include "base/assert.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/topology.hpp"
#include "topology/locate.hpp"

namespace temper {
namespace {

constexpr double kLeastRatio = 2;  // below, pieces could be shorter than what they grow from: see above
// Pieces grow by this much less than the ratio, so that they keep the ratio after their ends are rounded to doubles.
// Rounding is 2⁻⁵³ of the coordinates, which are up to a few million times the pieces.
constexpr double kRoomForRounding = 1 - 0x1p-30;

struct LineEdge {
  VertexId a, b;
  double length;
  bool halve;  ///< seen at too wide an angle to stay whole
  [[nodiscard]] VertexId other(VertexId v) const { return v == a ? b : a; }
};

/// Σ of min(q^i s_a, q^(k+1−i) s_b), i = 1 … k. The pieces themselves go into `pieces`, if given.
double reach(double s_a, double s_b, std::size_t k, double q, std::vector<double>* pieces = nullptr) {
  std::vector<double> powers(k + 1, 1);
  for (std::size_t i = 1; i <= k; ++i) powers[i] = powers[i - 1] * q;
  double sum = 0;
  for (std::size_t i = 1; i <= k; ++i) {
    const double piece = std::min(powers[i] * s_a, powers[k + 1 - i] * s_b);
    sum += piece;
    if (pieces != nullptr) pieces->push_back(piece);
  }
  return sum;
}

/// The pieces of an edge between two sizes, from a to b: one piece if it may stay whole.
std::vector<double> divide(const LineEdge& edge, double s_a, double s_b, double ratio) {
  const double length = edge.length;
  if (length <= ratio * std::min(s_a, s_b)) {
    return edge.halve ? std::vector<double>{0.5 * length, 0.5 * length} : std::vector<double>{length};
  }
  ratio *= kRoomForRounding;
  std::size_t k = 2;
  while (reach(s_a, s_b, k, ratio) < length) ++k;
  double low = 1, high = ratio;  // reach grows with q: as many halvings as a double has bits
  for (int i = 0; i < 53; ++i) {
    const double middle = 0.5 * (low + high);
    (reach(s_a, s_b, k, middle) < length ? low : high) = middle;
  }
  std::vector<double> pieces;
  reach(s_a, s_b, k, high, &pieces);
  return pieces;
}

/// Does the corner across h see its edge at more than the angle whose cosine is given?
bool is_seen_wide(const Mesh& mesh, HalfedgeId h, double cosine) {
  if (!h.valid()) return false;
  const Vec2 c = mesh.position(mesh.opposite(h));
  const Vec2 to_a = mesh.position(mesh.origin(h)) - c, to_b = mesh.position(mesh.target(h)) - c;
  return dot(to_a, to_b) < cosine * length(to_a) * length(to_b);
}

std::vector<LineEdge> line_edges(const Mesh& mesh, double widest_angle_deg) {
  const double cosine = std::cos(widest_angle_deg * std::numbers::pi / 180);
  const bool any_angle = !(widest_angle_deg < 180);
  std::vector<LineEdge> edges;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_erased(Mesh::triangle(h)) || !mesh.is_edge_representative(h)) continue;
    if (!mesh.is_boundary(h) && !mesh.is_constrained(h)) continue;
    const VertexId a = std::min(mesh.origin(h), mesh.target(h)), b = std::max(mesh.origin(h), mesh.target(h));
    const bool wide = !any_angle && (is_seen_wide(mesh, h, cosine) || is_seen_wide(mesh, mesh.twin(h), cosine));
    edges.push_back({a, b, length(mesh.position(b) - mesh.position(a)), wide});
  }
  std::sort(edges.begin(), edges.end(),
            [](const LineEdge& e, const LineEdge& f) { return std::pair(e.a, e.b) < std::pair(f.a, f.b); });
  return edges;
}

/// The edges at each vertex; vertex v has entries[first[v] … first[v + 1]).
class Incidence {
 public:
  Incidence(std::size_t n_vertices, const std::vector<LineEdge>& edges) : first_(n_vertices + 1, 0) {
    for (const LineEdge& e : edges) ++first_[e.a.index + 1], ++first_[e.b.index + 1];
    for (std::size_t v = 0; v < n_vertices; ++v) first_[v + 1] += first_[v];
    entries_.resize(first_.back());
    std::vector<std::size_t> at(first_.begin(), first_.end() - 1);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      entries_[at[edges[e].a.index]++] = e;
      entries_[at[edges[e].b.index]++] = e;
    }
  }
  [[nodiscard]] std::span<const std::size_t> of(VertexId v) const {
    return std::span(entries_).subspan(first_[v.index], first_[v.index + 1] - first_[v.index]);
  }

 private:
  std::vector<std::size_t> first_, entries_;
};

using Sizes = IdVector<VertexId, double>;

/// The size of each vertex of a line: spread from the smallest outwards.
Sizes spread_sizes(const std::vector<LineEdge>& edges, const Incidence& incidence, std::size_t n, double ratio) {
  Sizes sizes(n, HUGE_VAL);
  for (const LineEdge& e : edges) {
    for (const VertexId v : {e.a, e.b}) sizes[v] = std::min(sizes[v], e.halve ? 0.5 * e.length : e.length);
  }
  using Entry = std::pair<double, VertexId>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::size_t v = 0; v < n; ++v) {
    if (sizes[VertexId(v)] < HUGE_VAL) queue.emplace(sizes[VertexId(v)], VertexId(v));
  }
  while (!queue.empty()) {
    const auto [size, v] = queue.top();
    queue.pop();
    if (size > sizes[v]) continue;  // has become smaller since
    for (const std::size_t e : incidence.of(v)) {
      const VertexId u = edges[e].other(v);
      const bool from_a = v == edges[e].a;
      const std::vector<double> pieces = divide(edges[e], sizes[edges[e].a], sizes[edges[e].b], ratio);
      const double last = from_a ? pieces.back() : pieces.front();
      if (last >= sizes[u]) continue;
      sizes[u] = std::max(last, size);  // not below size by rounding: what is taken out stays final
      queue.emplace(sizes[u], u);
    }
  }
  return sizes;
}

/// The largest ratio of two pieces that meet, given the pieces of each edge.
double largest_ratio(const std::vector<LineEdge>& edges, const std::vector<std::vector<double>>& pieces,
                     std::size_t n) {
  double largest = 1;
  IdVector<VertexId, std::pair<double, double>> ends(n, {HUGE_VAL, 0});
  const auto meet = [&](VertexId v, double piece) {
    auto& [least, most] = ends[v];
    least = std::min(least, piece), most = std::max(most, piece);
    largest = std::max(largest, most / least);
  };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    meet(edges[e].a, pieces[e].front());
    meet(edges[e].b, pieces[e].back());
    for (std::size_t i = 1; i < pieces[e].size(); ++i) {
      const double before = pieces[e][i - 1], after = pieces[e][i];
      largest = std::max(largest, std::max(before / after, after / before));
    }
  }
  return largest;
}

std::vector<double> splits_of(const std::vector<double>& pieces) {
  double total = 0, sum = 0;
  for (const double piece : pieces) total += piece;
  std::vector<double> at;
  for (std::size_t i = 0; i + 1 < pieces.size(); ++i) at.push_back((sum += pieces[i]) / total);
  return at;
}

/// Cuts the edge a→b at `at`, one after the other.
void split_edge_at(Mesh& mesh, const EdgeSplits& cuts, const InsertionObserver* observer, Grading& grading) {
  const WeightedPoint a = mesh.point(cuts.a), b = mesh.point(cuts.b);
  const Vec2 step = b.position() - a.position();
  VertexId from = cuts.a;
  double done = 0;
  InsertionPlan plan;
  for (const double t : cuts.at) {
    HalfedgeId h = mesh.find_halfedge(from, cuts.b);
    if (!h.valid()) h = mesh.find_halfedge(cuts.b, from);
    const Vec2 p = a.position() + t * step, rest = b.position() - mesh.position(from);
    const double w = split_weight(mesh.weight(from), b.w, squared_length(rest), (t - done) / (1 - done));
    plan = plan_split(mesh, h, {p.x, p.y, w}, std::move(plan));
    if (plan.status != InsertionStatus::possible && plan.status != InsertionStatus::not_regular) {
      ++grading.refused;
      continue;
    }
    from = insert_vertex(mesh, plan, observer);
    done = t;
    ++grading.vertices;
    grading.flips += plan.flips.size();
  }
}

}  // namespace

GradingPlan plan_boundary_grading(const Mesh& mesh, double ratio, double widest_angle_deg) {
  TEMPER_ASSERT(mesh.space().dimension() == 2);
  ratio = std::max(kLeastRatio, ratio);
  const std::vector<LineEdge> edges = line_edges(mesh, widest_angle_deg);
  const std::size_t n = mesh.n_vertices();
  const Sizes sizes = spread_sizes(edges, Incidence(n, edges), n, ratio);
  std::vector<std::vector<double>> whole, pieces;
  GradingPlan plan;
  for (const LineEdge& e : edges) {
    whole.push_back({e.length});
    pieces.push_back(divide(e, sizes[e.a], sizes[e.b], ratio));
    if (pieces.back().size() == 1) continue;
    plan.cuts.push_back({e.a, e.b, splits_of(pieces.back())});
    plan.vertices += plan.cuts.back().at.size();
  }
  plan.ratio_before = largest_ratio(edges, whole, n);
  plan.ratio_after = largest_ratio(edges, pieces, n);
  return plan;
}

std::vector<std::array<VertexId, 3>> triangles_without_free_corner(const Mesh& mesh) {
  TEMPER_ASSERT(mesh.space().dimension() == 2);
  IdVector<VertexId, std::uint8_t> on_line(mesh.n_vertices(), 0);
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_erased(Mesh::triangle(h)) || (!mesh.is_boundary(h) && !mesh.is_constrained(h))) continue;
    on_line[mesh.origin(h)] = on_line[mesh.target(h)] = 1;
  }
  using Entry = std::pair<double, std::array<VertexId, 3>>;  // minus the squared longest edge, and the corners
  std::vector<Entry> found;
  for (const TriangleId t : mesh.triangles()) {
    if (mesh.is_erased(t)) continue;
    std::array<VertexId, 3> corners = mesh.corners(t);
    if (on_line[corners[0]] + on_line[corners[1]] + on_line[corners[2]] < 3) continue;
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 side = mesh.position(corners[(k + 1) % 3]) - mesh.position(corners[k]);
      longest = std::max(longest, squared_length(side));
    }
    found.emplace_back(-longest, corners);
  }
  std::sort(found.begin(), found.end());
  std::vector<std::array<VertexId, 3>> triangles;
  triangles.reserve(found.size());
  for (const Entry& entry : found) triangles.push_back(entry.second);
  return triangles;
}

namespace {

/// Says whether a vertex at p, in t, would make a triangle at the boundary or at a line so flat that sweeps hardly move
/// p.
bool is_beside_line(const Mesh& mesh, TriangleId t, Vec2 p) {
  constexpr double kFlat = 1e-3;  // height over length
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(t, k);
    const Vec2 a = mesh.position(mesh.origin(h)), along = mesh.position(mesh.target(h)) - a;
    if (mesh.is_unflippable(h) && cross(along, p - a) < kFlat * squared_length(along)) return true;
  }
  return false;
}

}  // namespace

InsertionPlan plan_center(const Mesh& mesh, const std::array<VertexId, 3>& corners, InsertionPlan storage) {
  storage.status = InsertionStatus::outside;
  const HalfedgeId h = mesh.find_halfedge(corners[0], corners[1]);
  if (!h.valid() || mesh.opposite(h) != corners[2]) return storage;
  const TriangleId t = Mesh::triangle(h);
  Vec2 p = orthocenter(mesh.point(corners[0]), mesh.point(corners[1]), mesh.point(corners[2]));
  TriangleId around = locate(mesh, p, t).triangle;
  if (!around.valid()) return storage;
  if (is_beside_line(mesh, around, p)) {
    p = (1.0 / 3) * (mesh.position(corners[0]) + mesh.position(corners[1]) + mesh.position(corners[2]));
    around = t;
  }
  const double weight = interpolated_weight(mesh, around, p);
  InsertionPlan plan = plan_insertion(mesh, {p.x, p.y, weight}, around, std::move(storage));
  const bool replaces = std::find(plan.cavity.begin(), plan.cavity.end(), t) != plan.cavity.end();
  if (plan.status == InsertionStatus::possible && !replaces) plan.status = InsertionStatus::outside;
  return plan;
}

Grading grade_boundary(Mesh& mesh, double ratio, const InsertionObserver* observer) {
  Grading grading;
  for (int pass = 0; pass < kGradingPasses; ++pass) {
    const GradingPlan plan = plan_boundary_grading(mesh, ratio, kWidestBoundaryAngle);
    for (const EdgeSplits& cuts : plan.cuts) split_edge_at(mesh, cuts, observer, grading);
  }
  InsertionPlan plan;
  for (const auto& corners : triangles_without_free_corner(mesh)) {
    plan = plan_center(mesh, corners, std::move(plan));
    if (plan.status != InsertionStatus::possible) continue;
    insert_vertex(mesh, plan, observer);
    ++grading.inside;
    grading.flips += plan.flips.size();
  }
  return grading;
}

}  // namespace temper
