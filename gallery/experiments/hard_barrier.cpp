#include "experiments/hard_barrier.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "experiments/random.hpp"
#include "temper/generate.hpp"
#include "temper/detail/geometry.hpp"

namespace temper::gallery {
namespace {

struct Multiple {
  std::int64_t times;
  const char* name;
};

struct IntegerPoint {
  std::int64_t x, y;
};
IntegerPoint operator-(IntegerPoint a, IntegerPoint b) { return {a.x - b.x, a.y - b.y}; }
std::int64_t dot(IntegerPoint a, IntegerPoint b) { return a.x * b.x + a.y * b.y; }

IntegerPoint integer_position(const Mesh& mesh, std::size_t v) {
  const Vec2 p = mesh.position(VertexId(v));
  return {std::llround(p.x), std::llround(p.y)};  // the coordinates are integers
}

std::string edge_name(const char* letter, std::size_t p, std::size_t q) {
  return letter + ("_" + std::to_string(p)) + std::to_string(q);
}

/// 2 S h_pq ℓ_pq of triangle pqr: (|pr|² + w_p − w_r) |pq|² − (|pq|² + w_p − w_q) (pq · pr).
Condition height_condition(const Mesh& mesh, const std::array<std::size_t, 3>& corners, const std::string& triangle) {
  const auto [p, q, r] = corners;
  const IntegerPoint a = integer_position(mesh, q) - integer_position(mesh, p);
  const IntegerPoint b = integer_position(mesh, r) - integer_position(mesh, p);
  Condition c;
  c.name = edge_name("h", p, q) + " of " + triangle;
  c.constant = dot(b, b) * dot(a, a) - dot(a, a) * dot(a, b);
  c.weight[p] = dot(a, a) - dot(a, b);
  c.weight[q] = dot(a, b);
  c.weight[r] = -dot(a, a);
  return c;
}

/// 2 d_pq ℓ_pq = |pq|² + w_p − w_q.
Condition split_condition(const Mesh& mesh, std::size_t p, std::size_t q) {
  const IntegerPoint a = integer_position(mesh, q) - integer_position(mesh, p);
  Condition c{edge_name("d", p, q), dot(a, a), {}};
  c.weight[p] = 1;
  c.weight[q] = -1;
  return c;
}

Certificate combine(std::span<const Multiple> multiples) {
  const std::vector<Condition> conditions = hard_barrier_conditions();
  Certificate sum;
  sum.complete = true;
  for (const auto& [times, name] : multiples) {
    const auto found = std::ranges::find(conditions, name, &Condition::name);
    if (found == conditions.end() || times <= 0) {
      sum.complete = false;
      continue;
    }
    sum.terms += (sum.terms.empty() ? "" : " + ") + std::to_string(times) + " " + name;
    sum.constant += times * found->constant;
    for (std::size_t i = 0; i < sum.weight.size(); ++i) sum.weight[i] += times * found->weight[i];
  }
  return sum;
}

double margin(const Mesh& mesh, bool with_d) {
  double least = 1;
  for (const TriangleId t : mesh.triangles()) {
    const auto v = mesh.corners(t);
    for (std::size_t i = 0; i < 3; ++i) {
      const WeightedPoint p = mesh.point(v[i]), q = mesh.point(v[(i + 1) % 3]), r = mesh.point(v[(i + 2) % 3]);
      const double edge = length(q.position() - p.position());
      least = std::min(least, signed_height(p, q, r) / edge);
      if (with_d) least = std::min({least, edge_split(p, q) / edge, edge_split(q, p) / edge});
    }
  }
  return least;
}

}  // namespace

std::vector<Condition> hard_barrier_conditions() {
  const Mesh mesh = sparse_horseshoe();
  std::vector<Condition> conditions;
  for (const TriangleId t : mesh.triangles()) {
    const auto v = mesh.corners(t);
    std::string name;
    for (const VertexId corner : v) name += std::to_string(corner.index);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::array<std::size_t, 3> corners = {v[i].index, v[(i + 1) % 3].index, v[(i + 2) % 3].index};
      conditions.push_back(height_condition(mesh, corners, name));
    }
  }
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_edge_representative(h)) continue;
    const std::size_t p = mesh.origin(h).index, q = mesh.target(h).index;
    conditions.push_back(split_condition(mesh, p, q));
    conditions.push_back(split_condition(mesh, q, p));
  }
  return conditions;
}

bool Certificate::proves() const {
  return complete && constant <= 0 && std::ranges::all_of(weight, [](std::int64_t w) { return w == 0; });
}

Certificate shortest_certificate() {
  constexpr Multiple kTerms[] = {{1, "h_30 of 430"}, {4, "d_10"}, {4, "d_41"}, {16, "d_43"}};
  return combine(kTerms);
}

Certificate papers_certificate() {
  constexpr Multiple kTerms[] = {{2, "h_40 of 014"}, {5, "h_30 of 430"}, {26, "d_10"}, {80, "d_43"}};
  return combine(kTerms);
}

MarginSearch search_margin(bool with_d, std::size_t tries) {
  Random uniform(3);
  Mesh mesh = sparse_horseshoe();
  MarginSearch best{margin(mesh, with_d), {}, tries};
  // Concave in the weights, so that shrinking random steps climb to the top: from ±4, of the order of ℓ², down to 1e−6.
  constexpr double kFirst = 4, kLast = 1e-6;
  for (std::size_t k = 0; k < tries; ++k) {
    const double reach = kFirst * std::pow(kLast / kFirst, static_cast<double>(k) / static_cast<double>(tries));
    std::array<double, 5> weights = best.weights;
    for (std::size_t i = 0; i < 4; ++i) weights[i] += reach * uniform(-1, 1);  // w_4 stays 0: only differences count
    for (std::size_t i = 0; i < 5; ++i) mesh.set_weight(VertexId(i), weights[i]);
    const double t = margin(mesh, with_d);
    if (t > best.margin) best.margin = t, best.weights = weights;
  }
  return best;
}

}  // namespace temper::gallery
