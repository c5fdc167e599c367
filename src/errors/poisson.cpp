#include "errors/poisson.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/median.hpp"
#include "errors/stars.hpp"

namespace temper::error_detail {
namespace {

constexpr std::size_t kGiven = static_cast<std::size_t>(-1);

/// Inner vertices in their order; kGiven of those on the boundary, or of the first one if there is none.
std::vector<std::size_t> number_inner_vertices(const Setting& s, std::size_t& count) {
  const Mesh& mesh = s.mesh;
  std::vector<std::size_t> unknowns(mesh.n_vertices(), kGiven);
  bool skip = s.is_closed;
  for (const VertexId v : mesh.vertices()) {
    if (mesh.is_isolated(v) || mesh.is_boundary(v)) continue;
    if (!skip) unknowns[v.index] = count++;
    skip = false;
  }
  return unknowns;
}

/// The deficit of ★0 f per area: on a closed mesh the sum must be zero.
double surplus(const Setting& s, const Field& field) {
  if (!s.is_closed) return 0;
  double sum = 0, area = 0;
  for (const VertexId v : s.mesh.vertices()) {
    sum += s.area_in_frame(s.dec.star0[v]) * field.at(s.vertex(v)).laplacian;
    area += s.area_in_frame(s.dec.star0[v]);
  }
  return sum / area;
}

std::vector<double> right_side(const Setting& s, const Field& field, const std::vector<std::size_t>& unknowns,
                               std::size_t count) {
  std::vector<double> right(count, 0.0);
  std::vector<double> given(unknowns.size(), 0.0);
  const double mean = surplus(s, field);
  for (const VertexId v : s.mesh.vertices()) {
    const FieldValue value = field.at(s.vertex(v));
    given[v.index] = value.u;
    if (unknowns[v.index] == kGiven) continue;
    right[unknowns[v.index]] = -s.area_in_frame(s.dec.star0[v]) * (value.laplacian - mean);
  }
  for (std::size_t e = 0; e < s.dec.edges.size(); ++e) {
    const auto& edge = s.dec.edges[EdgeId(e)];
    const std::size_t i = unknowns[edge.from.index], j = unknowns[edge.to.index];
    if (i != kGiven && j == kGiven) right[i] += s.dec.star1[EdgeId(e)] * given[edge.to.index];
    if (j != kGiven && i == kGiven) right[j] += s.dec.star1[EdgeId(e)] * given[edge.from.index];
  }
  return right;
}

void assemble(const Setting& s, const std::vector<std::size_t>& unknowns, LinearSystem& linear, ErrorSystem& system) {
  for (std::size_t e = 0; e < s.dec.edges.size(); ++e) {
    const std::size_t i = unknowns[s.dec.edges[EdgeId(e)].from.index], j = unknowns[s.dec.edges[EdgeId(e)].to.index];
    if (i == kGiven && j == kGiven) continue;
    const double star1 = s.dec.star1[EdgeId(e)];
    if (star1 < 0) ++system.negative;
    if (i != kGiven) linear.lower.push_back({i, i, star1});
    if (j != kGiven) linear.lower.push_back({j, j, star1});
    if (i != kGiven && j != kGiven) linear.lower.push_back({std::max(i, j), std::min(i, j), -star1});
  }
}

ErrorNorms poisson_norms(const Setting& s, const Field& field, const std::vector<std::size_t>& unknowns,
                         const std::vector<double>& solution) {
  std::vector<double> weights, errors;
  for (const VertexId v : s.mesh.vertices()) {
    const std::size_t unknown = unknowns[v.index];
    if (unknown == kGiven && (!s.is_closed || s.mesh.is_isolated(v))) continue;
    weights.push_back(std::abs(s.area_in_frame(s.dec.star0[v])));
    errors.push_back(unknown == kGiven ? 0 : solution[unknown] - field.at(s.vertex(v)).u);
  }
  if (s.is_closed) forget_constant(weights, errors);
  const ErrorNorms norms = norms_of(weights, errors);
  const double size = size_of(field).value;
  return {norms.l2 / std::sqrt(s.area) / size, norms.max / size};
}

}  // namespace

void forget_constant(const std::vector<double>& weights, std::vector<double>& errors) {
  double sum = 0, weight = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) sum += weights[i] * errors[i], weight += weights[i];
  for (double& error : errors) error -= sum / weight;
}

SchemeErrors poisson_errors(const Setting& s, const std::vector<Field>& fields, bool condition) {
  SchemeErrors result;
  LinearSystem linear;
  const std::vector<std::size_t> unknowns = number_inner_vertices(s, linear.unknowns);
  assemble(s, unknowns, linear, result.system);
  for (const Field& field : fields) linear.right_sides.push_back(right_side(s, field, unknowns, linear.unknowns));
  const LinearSolution solution = solve(linear, condition);

  std::vector<double> inside;
  for (std::size_t e = 0; e < s.dec.edges.size(); ++e) {
    if (!s.dec.edges[EdgeId(e)].is_boundary()) inside.push_back(std::abs(s.dec.star1[EdgeId(e)]));
  }
  result.system.unknowns = linear.unknowns;
  result.system.m_matrix = result.system.negative == 0 && !solution.singular;
  result.system.definite = solution.definite;
  result.system.singular = solution.singular;
  result.system.largest_over_median = largest_over_median(std::move(inside));
  result.system.condition = solution.condition;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const double infinity = std::numeric_limits<double>::infinity();
    result.fields.push_back(solution.singular ? ErrorNorms{infinity, infinity}
                                              : poisson_norms(s, fields[i], unknowns, solution.solutions[i]));
  }
  return result;
}

// Two-point flux between orthocenters. In triangle k:  Σ ℓ / (h_k + h_l) (u_k − u_l) + Σ ℓ / h_k (u_k − u_b) = ∫ f.
// Here u_b is the solution at the weighted midpoint of a boundary edge, and ∫ f = −∮ ∇u · n is exact.
//
// If orthocenters coincide (a dual edge of no length: cocircular points) they have one value, the limit of the scheme
// as the coefficient grows without bound. Their triangles are one cell. An orthocenter on the boundary has the value
// there.

namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);
// The dual length relative to the edge's: a coefficient beyond 1e10 would take as many digits from all others.
constexpr double kCoincident = 1e-10;

/// The least member of the set that i is in.
std::size_t root_of(std::vector<std::size_t>& parents, std::size_t i) {
  while (parents[i] != i) {
    parents[i] = parents[parents[i]];
    i = parents[i];
  }
  return i;
}

TriangleId inner_triangle(const DecEdge& edge) { return edge.left.valid() ? edge.left : edge.right; }

}  // namespace

FluxScheme::FluxScheme(const Setting& setting) : setting_(setting) {
  merge();
  number();
  assemble();
}

bool FluxScheme::coincident(const DecEdge& edge) const {
  return std::abs(edge.dual_length) <= kCoincident * edge.length;
}

void FluxScheme::merge() {
  groups_.resize(setting_.mesh.n_triangles());
  std::iota(groups_.begin(), groups_.end(), std::size_t{0});
  for (const DecEdge& edge : setting_.dec.edges) {
    if (edge.is_boundary() || !coincident(edge)) continue;
    ++system_.merged;
    const std::size_t a = root_of(groups_, edge.left.index), b = root_of(groups_, edge.right.index);
    groups_[std::max(a, b)] = std::min(a, b);
  }
  for (std::size_t t = 0; t < groups_.size(); ++t) groups_[t] = root_of(groups_, t);
}

void FluxScheme::number() {
  std::vector<bool> given(groups_.size(), false);
  given_at_.resize(groups_.size(), Place(0, 0));
  for (std::size_t e = 0; e < setting_.dec.edges.size(); ++e) {
    const DecEdge& edge = setting_.dec.edges[EdgeId(e)];
    if (!edge.is_boundary() || !coincident(edge)) continue;
    const std::size_t g = group(inner_triangle(edge));
    given[g] = true;
    given_at_[g] = setting_.midpoint(EdgeId(e));
  }
  if (setting_.is_closed) {
    given[0] = true;
    given_at_[0] = setting_.orthocenter(TriangleId(0));
  }
  unknowns_.assign(groups_.size(), kNone);
  for (std::size_t t = 0; t < groups_.size(); ++t) {
    if (groups_[t] == t && !given[t]) unknowns_[t] = linear_.unknowns++;
  }
}

void FluxScheme::assemble() {
  std::vector<double> inside;
  const auto& dec = setting_.dec;
  for (std::size_t e = 0; e < dec.edges.size(); ++e) {
    const DecEdge& edge = dec.edges[EdgeId(e)];
    const double flux = dec.transmissibility[EdgeId(e)];
    if (!edge.is_boundary()) inside.push_back(std::abs(flux));
    if (flux < 0) ++system_.negative;
    if (coincident(edge)) continue;
    const std::size_t a = unknowns_[group(inner_triangle(edge))];
    const std::size_t b = edge.is_boundary() ? kNone : unknowns_[group(edge.right)];
    if (a == b) continue;  // both given; or merged by other edges, so that nothing flows between them
    if (a != kNone) linear_.lower.push_back({a, a, flux});
    if (b != kNone) linear_.lower.push_back({b, b, flux});
    if (a != kNone && b != kNone) linear_.lower.push_back({std::max(a, b), std::min(a, b), -flux});
  }
  system_.unknowns = linear_.unknowns;
  system_.m_matrix = system_.negative == 0;
  system_.largest_over_median = largest_over_median(std::move(inside));
}

void FluxScheme::add_field(const Field& field, const IdVector<EdgeId, EdgeMeans>& means) {
  std::vector<double> right(linear_.unknowns, 0.0);
  const auto add = [&](TriangleId t, double value) {
    if (const std::size_t i = unknowns_[group(t)]; i != kNone) right[i] += value;
  };
  const auto given = [&](TriangleId t) { return field.at(given_at_[group(t)]).u; };
  for (std::size_t e = 0; e < means.size(); ++e) {
    const DecEdge& edge = setting_.dec.edges[EdgeId(e)];
    // ∫ f = −∮ ∇u · n, and n points to the right of the edge out of the triangle on its left.
    const Vec2 left = turned_left(direction(setting_, edge));
    const double flow = setting_.length_in_frame(edge.length) * dot(means[EdgeId(e)].gradient, left);
    if (edge.left.valid()) add(edge.left, flow);
    if (edge.right.valid()) add(edge.right, -flow);
    if (coincident(edge)) continue;
    const double coefficient = setting_.dec.transmissibility[EdgeId(e)];
    if (edge.is_boundary()) {
      add(inner_triangle(edge), coefficient * field.at(setting_.midpoint(EdgeId(e))).u);
      continue;
    }
    if (unknowns_[group(edge.right)] == kNone) add(edge.left, coefficient * given(edge.right));
    if (unknowns_[group(edge.left)] == kNone) add(edge.right, coefficient * given(edge.left));
  }
  linear_.right_sides.push_back(std::move(right));
  fields_.push_back(field);
}

SchemeErrors FluxScheme::solve(bool condition) {
  const LinearSolution solution = error_detail::solve(linear_, condition);
  SchemeErrors result = {system_, {}};
  result.system.m_matrix = system_.m_matrix && !solution.singular;
  result.system.definite = solution.definite;
  result.system.singular = solution.singular;
  result.system.condition = solution.condition;
  const double infinity = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    if (solution.singular) {
      result.fields.push_back({infinity, infinity});
      continue;
    }
    std::vector<double> weights, errors;
    for (const TriangleId t : setting_.mesh.triangles()) {
      const std::size_t i = unknowns_[group(t)];
      weights.push_back(setting_.area_in_frame(setting_.dec.areas[t]));
      const double value = i != kNone ? solution.solutions[f][i] : fields_[f].at(given_at_[group(t)]).u;
      errors.push_back(value - fields_[f].at(setting_.orthocenter(t)).u);
    }
    if (setting_.is_closed) forget_constant(weights, errors);
    const ErrorNorms norms = norms_of(weights, errors);
    const double size = size_of(fields_[f]).value;
    result.fields.push_back({norms.l2 / std::sqrt(setting_.area) / size, norms.max / size});
  }
  return result;
}

}  // namespace temper::error_detail
