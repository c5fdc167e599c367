// Figure 11: the sparse and the dense horseshoe, and why the hard barrier cannot start from the sparse one.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "experiments/dense_runs.hpp"
#include "experiments/domain.hpp"
#include "experiments/numbers.hpp"
#include "experiments/sparse_runs.hpp"
#include "experiments/text.hpp"
#include "figures.hpp"
#include "plot/plot.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/draw.hpp"
#include "temper/generate.hpp"
#include "temper/quality.hpp"

namespace temper::gallery::fig11 {
namespace {

// Are there weights for which every d and every h of the sparse horseshoe is positive, at its input positions (§6.4)?
//
// 2 S h ℓ and 2 d ℓ are linear in the weights, with integer coefficients for integer coordinates (S twice the area of
// the triangle). So strict positivity of all of them is a linear system, and a combination of some of them by
// positive integers that has no weights left in it and is not positive proves that there is no solution (Farkas).

/// constant + Σ weight[i] w_i > 0.
struct Condition {
  std::string name;  ///< "h_30 of 430", "d_10"
  std::int64_t constant = 0;
  std::array<std::int64_t, 5> weight = {};
};

/// Multiples of conditions, by name.
struct Certificate {
  std::string terms;                        ///< "1 h_30 of 430 + 4 d_10 + …"
  std::array<std::int64_t, 5> weight = {};  ///< of their sum
  std::int64_t constant = 0;
  bool complete = false;  ///< every name was found, every multiple is positive
  /// No weights satisfy all these conditions.
  [[nodiscard]] bool proves() const;
};

/// The greatest margin t that a seeded random search finds with every h ≥ t ℓ and, if asked, t ℓ ≤ d ≤ (1 − t) ℓ.
struct MarginSearch {
  double margin = 0;
  std::array<double, 5> weights = {};
  std::size_t tries = 0;
};

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
Condition crossing_condition(const Mesh& mesh, std::size_t p, std::size_t q) {
  const IntegerPoint a = integer_position(mesh, q) - integer_position(mesh, p);
  Condition c{edge_name("d", p, q), dot(a, a), {}};
  c.weight[p] = 1;
  c.weight[q] = -1;
  return c;
}

/// The 12 conditions on h and the 16 on d of the sparse horseshoe, in exact integers.
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
    conditions.push_back(crossing_condition(mesh, p, q));
    conditions.push_back(crossing_condition(mesh, q, p));
  }
  return conditions;
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
      if (with_d) least = std::min({least, dual_crossing(p, q) / edge, dual_crossing(q, p) / edge});
    }
  }
  return least;
}

bool Certificate::proves() const {
  return complete && constant <= 0 && std::ranges::all_of(weight, [](std::int64_t w) { return w == 0; });
}

/// The shortest proof, of four conditions.
Certificate shortest_certificate() {
  constexpr Multiple kTerms[] = {{1, "h_30 of 430"}, {4, "d_10"}, {4, "d_41"}, {16, "d_43"}};
  return combine(kTerms);
}

/// The four conditions that the paper's argument uses: h_40 of 014, h_03 of 430, d_10, and d_43.
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

Claim one_free_vertex(const Mesh& mesh) {
  const std::size_t free = count_interior(mesh);
  return {"11",
          "In the sparse horseshoe one vertex alone is free to move",
          "only p_4 is free; 5 vertices",
          digits(mesh.n_vertices()) + " vertices, " + digits(free) + " of them interior",
          mesh.n_vertices() == 5 && free == 1,
          "counted on the mesh"};
}

/// Each interior vertex goes to the mean of its neighbors.
Claim laplacian_inverts(const Mesh& input) {
  Mesh mesh = input;
  const VertexId v(std::size_t{4});
  Vec2 sum;
  double neighbors = 0;
  for (const HalfedgeId h : mesh.star(v)) {
    sum = sum + mesh.position(mesh.target(h));
    neighbors += 1;
  }
  const Vec2 mean = (1 / neighbors) * sum;
  mesh.set_point(v, {mean.x, mean.y, 0});
  const std::size_t inverted = quality(mesh).inverted_triangles;
  return {"11",
          "Laplacian smoothing inverts triangles of the sparse horseshoe",
          "often inverts triangles",
          "p_4 goes to (" + digits(mean.x, 3) + ", " + digits(mean.y, 3) + "), and " + digits(inverted) +
              " triangles turn over",
          inverted > 0,
          "one step: p_4 to the mean of its neighbors, orientation by the exact test"};
}

std::string proof_text(const Certificate& c) { return c.terms + " = " + digits(static_cast<double>(c.constant)); }

Claim no_hard_barrier_weights() {
  const Certificate proof = shortest_certificate();
  const MarginSearch search = search_margin(true, 20000);
  return {"6.4",
          "No weights make all d and all h of the sparse horseshoe positive at its input positions: the hard barrier "
          "cannot be used",
          "no such weights",
          "proved: with 2ℓd and 2Sℓh in exact integers, " + proof_text(proof) +
              " for all weights, so the four cannot all be positive",
          proof.proves() && search.margin < 0,
          "a Farkas certificate, checked in integers; besides, the best margin of d/ℓ and h/ℓ that " +
              digits(search.tries) + " random trials climb to is " + digits(search.margin, 6)};
}

Claim papers_argument() {
  const Certificate proof = papers_certificate();
  return {"6.4",
          "The paper's argument: h_40 > 0 in 014 and d_10 > 0 leave h_03 < 0 in 430, as all d are positive",
          "easy to observe",
          proof_text(proof) + " for all weights",
          proof.proves(),
          "exact integers; of the other d only d_43 is needed"};
}

Claim heights_alone() {
  const MarginSearch search = search_margin(false, 5000);
  std::string weights;
  for (const double w : search.weights) weights += (weights.empty() ? "" : ", ") + digits(w, 3);
  return {"6.4",
          "It is the conditions on d that stand in the way: h alone can be made positive",
          "left open (its open problem: weights with all h positive)",
          "weights (" + weights + ") give every h ≥ " + digits(search.margin, 3) + " ℓ",
          search.margin > 0,
          digits(search.tries) + " random trials, each better one kept",
          Author::temper};
}

Claim dense_input(const Mesh& mesh) {
  const Quality q = quality(mesh);
  const std::size_t star = 1;
  return {"11",
          "The dense horseshoe has 7 × 9 vertices and obtuse triangles whose circumcenters lie across their edges",
          "7 values of a, 9 of b",
          digits(mesh.n_vertices()) + " vertices, " + digits(count_interior(mesh)) + " interior; circumcenters of " +
              digits(q.orthocenters_outside) + " of " + digits(q.triangles) + " triangles lie outside them, " +
              digits(q.negative_boundary_duals) + " of them across the boundary; E_F^1 = " +
              digits(q.energy[0][star], 6) + ", E_∂T^1 = " + digits(q.energy[2][star], 6),
          mesh.n_vertices() == 63 && q.orthocenters_outside > 0 && q.non_regular_edges == 0,
          "counted by exact predicates; constrained Delaunay, no edge needs a flip"};
}

}  // namespace

Page make(Effort) {
  const Mesh sparse = sparse_horseshoe();
  const Mesh& dense = dense_horseshoe();
  const std::array<std::string, 2> panels = {
      sparse_picture(sparse, "sparse", "5 vertices, 4 triangles"),
      dense_picture(dense, "dense",
                    digits(dense.n_vertices()) + " vertices, " + digits(dense.n_triangles()) + " triangles", 0, 300)};
  Page page;
  page.pictures.push_back({"fig11", grid_svg(panels, 2),
                           "The inputs, with duals in blue: every triangle of the sparse one, and most of the dense "
                           "one, have their circumcenter outside."});
  page.claims = {one_free_vertex(sparse), laplacian_inverts(sparse), no_hard_barrier_weights(),
                 papers_argument(),       heights_alone(),           dense_input(dense)};
  return page;
}

}  // namespace temper::gallery::fig11
