#include "verify/poisson.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/median.hpp"
#include "verify/stars.hpp"

namespace temper::verify_detail {
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

/// What ★0 f lacks to sum to nothing, as it must on a closed mesh, for each area.
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

void assemble(const Setting& s, const std::vector<std::size_t>& unknowns, LinearSystem& linear, VerifySystem& system) {
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

}  // namespace temper::verify_detail
