#include "errors/poisson.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "errors/surface_means.hpp"

namespace temper::error_detail {
namespace {

/// Values are given on the boundary, and at the first vertex if there is none. Isolated vertices have no equation.
std::vector<bool> given_vertices(const Setting& s) {
  std::vector<bool> given;
  bool skip = s.is_closed;
  for (const VertexId v : s.mesh.vertices()) {
    const bool is_inside = !s.mesh.is_isolated(v) && !s.mesh.is_boundary(v);
    given.push_back(!is_inside || skip);
    if (is_inside) skip = false;
  }
  return given;
}

/// The part of ∫ Δu over the cell of a vertex that is above its mean: on a closed mesh the sum must be zero.
std::vector<double> laplacians(const Setting& s, const Field& field) {
  std::vector<double> all;
  if (s.surface != nullptr) all = laplacians_on_surface(s, field);
  double sum = 0, area = 0;
  for (const VertexId v : s.mesh.vertices()) {
    const double cell = s.area_in_frame(s.dec.star0[v]);
    sum += s.surface != nullptr ? all[v.index] : cell * field.at(s.vertex(v)).laplacian;
    area += cell;
  }
  const double mean = s.is_closed ? sum / area : 0;
  if (s.surface == nullptr) all.resize(s.mesh.n_vertices());
  for (const VertexId v : s.mesh.vertices()) {
    const double cell = s.area_in_frame(s.dec.star0[v]);
    all[v.index] = s.surface != nullptr ? all[v.index] - cell * mean : cell * (field.at(s.vertex(v)).laplacian - mean);
  }
  return all;
}

std::vector<double> right_side(const Setting& s, const Field& field, const PointSystem& points) {
  std::vector<double> sources = laplacians(s, field), values;
  for (double& source : sources) source = -source;
  for (const VertexId v : s.mesh.vertices()) values.push_back(field.at(s.vertex(v)).u);
  return points.right_side(sources, values);
}

ErrorNorms poisson_norms(const Setting& s, const Field& field, const PointSystem& points,
                         const std::vector<double>& solution) {
  std::vector<double> exact, values, weights, errors;
  for (const VertexId v : s.mesh.vertices()) exact.push_back(field.at(s.vertex(v)).u);
  points.put(solution, values = exact);
  for (const VertexId v : s.mesh.vertices()) {
    if (points.is_given(v.index) && (!s.is_closed || s.mesh.is_isolated(v))) continue;
    weights.push_back(std::abs(s.area_in_frame(s.dec.star0[v])));
    errors.push_back(values[v.index] - exact[v.index]);
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

PointSystem cell_system(const DecComplex& dec, const IdVector<EdgeId, double>& flux) {
  PointSystem points(std::vector<bool>(dec.areas.size(), false));
  for (std::size_t i = 0; i < dec.edges.size(); ++i) {
    const DecEdge& edge = dec.edges[EdgeId(i)];
    if (edge.is_boundary()) {
      points.connect_outside(inner_triangle(edge).index, flux[EdgeId(i)]);
    } else {
      points.connect(edge.left.index, edge.right.index, flux[EdgeId(i)]);
    }
  }
  return points;
}

void describe(const LinearSystem& linear, const LinearSolution& solution, ErrorSystem& system) {
  system.unknowns = linear.unknowns;
  system.m_matrix = system.negative == 0 && !solution.singular;
  system.definite = solution.definite;
  system.singular = solution.singular;
  system.condition = solution.condition;
}

SchemeErrors poisson_errors(const Setting& s, const std::vector<Field>& fields, bool condition) {
  const PointSystem points = vertex_system(s.dec, given_vertices(s));
  LinearSystem linear = {points.n_unknowns(), points.lower(), {}};
  for (const Field& field : fields) linear.right_sides.push_back(right_side(s, field, points));
  const LinearSolution solution = solve(linear, condition);

  SchemeErrors result;
  describe_coefficients(
      s.dec, points, [](const DecEdge& edge) { return edge.is_boundary(); }, result.system);
  describe(linear, solution, result.system);
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const double infinity = std::numeric_limits<double>::infinity();
    result.fields.push_back(solution.singular ? ErrorNorms{infinity, infinity}
                                              : poisson_norms(s, fields[i], points, solution.solutions[i]));
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

}  // namespace

bool CellLink::is_coincident() const { return std::abs(dual_length) <= kCoincident * size; }

FluxScheme::FluxScheme(std::vector<CellLink> links, std::vector<Place> orthocenters, bool is_closed)
    : links_(std::move(links)), orthocenters_(std::move(orthocenters)), is_closed_(is_closed), points_({}) {
  merge();
  points_ = PointSystem(given_groups());
  assemble();
}

void FluxScheme::merge() {
  groups_.resize(orthocenters_.size());
  std::iota(groups_.begin(), groups_.end(), std::size_t{0});
  for (const CellLink& link : links_) {
    if (link.is_boundary() || !link.is_coincident()) continue;
    ++system_.merged;
    const std::size_t a = root_of(groups_, link.cell), b = root_of(groups_, link.other);
    groups_[std::max(a, b)] = std::min(a, b);
  }
  for (std::size_t t = 0; t < groups_.size(); ++t) groups_[t] = root_of(groups_, t);
}

std::vector<bool> FluxScheme::given_groups() {
  std::vector<bool> given(groups_.size(), false);
  given_at_.resize(groups_.size(), Place(0, 0));
  for (const CellLink& link : links_) {
    if (!link.is_boundary() || !link.is_coincident()) continue;
    given[groups_[link.cell]] = true;
    given_at_[groups_[link.cell]] = link.foot;
  }
  if (is_closed_) {
    given[0] = true;
    given_at_[0] = orthocenters_[0];
  }
  for (std::size_t t = 0; t < groups_.size(); ++t) given[t] = given[t] || groups_[t] != t;
  return given;
}

void FluxScheme::assemble() {
  std::vector<double> inside;
  for (const CellLink& link : links_) {
    if (!link.is_boundary()) inside.push_back(std::abs(link.transmissibility));
    if (link.transmissibility < 0) ++system_.negative;
    if (link.is_coincident()) continue;
    const std::size_t a = groups_[link.cell];
    if (link.is_boundary()) {
      points_.connect_outside(a, link.transmissibility);
    } else if (a != groups_[link.other]) {  // else merged by other edges, so that nothing flows between them
      points_.connect(a, groups_[link.other], link.transmissibility);
    }
  }
  system_.largest_over_median = largest_over_median(std::move(inside));
}

void FluxScheme::add_field(const Field& field, const std::vector<double>& inflows) {
  std::vector<double> sources(groups_.size(), 0.0);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const CellLink& link = links_[i];
    sources[groups_[link.cell]] += inflows[i];
    if (!link.is_boundary())
      sources[groups_[link.other]] -= inflows[i];
    else if (!link.is_coincident())
      sources[groups_[link.cell]] += link.transmissibility * field.at(link.foot).u;
  }
  right_sides_.push_back(points_.right_side(sources, given_values(field)));
  fields_.push_back(field);
}

std::vector<double> FluxScheme::given_values(const Field& field) const {
  std::vector<double> values;
  for (const Place& place : given_at_) values.push_back(field.at(place).u);
  return values;
}

SchemeErrors FluxScheme::solve(const std::vector<double>& weights, double all, bool condition) {
  const LinearSystem linear = {points_.n_unknowns(), points_.lower(), std::move(right_sides_)};
  const LinearSolution solution = error_detail::solve(linear, condition);
  SchemeErrors result = {system_, {}};
  describe(linear, solution, result.system);
  const double infinity = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    if (solution.singular) {
      result.fields.push_back({infinity, infinity});
      continue;
    }
    std::vector<double> errors, values = given_values(fields_[f]);
    points_.put(solution.solutions[f], values);
    for (std::size_t t = 0; t < groups_.size(); ++t)
      errors.push_back(values[groups_[t]] - fields_[f].at(orthocenters_[t]).u);
    if (is_closed_) forget_constant(weights, errors);
    const ErrorNorms norms = norms_of(weights, errors);
    const double size = size_of(fields_[f]).value;
    result.fields.push_back({norms.l2 / std::sqrt(all) / size, norms.max / size});
  }
  return result;
}

FluxScheme flux_scheme(const Setting& s) {
  std::vector<CellLink> links;
  std::vector<Place> orthocenters;
  links.reserve(s.dec.edges.size());
  orthocenters.reserve(s.mesh.n_triangles());
  for (std::size_t e = 0; e < s.dec.edges.size(); ++e) {
    const DecEdge& edge = s.dec.edges[EdgeId(e)];
    const std::size_t other = edge.is_boundary() ? CellLink::kOutside : edge.right.index;
    links.push_back({inner_triangle(edge).index, other, s.dec.transmissibility[EdgeId(e)], edge.dual_length,
                     edge.length, s.midpoint(EdgeId(e))});
  }
  for (const TriangleId t : s.mesh.triangles()) orthocenters.push_back(s.orthocenter(t));
  return {std::move(links), std::move(orthocenters), s.is_closed};
}

/// n points to the right of an edge out of the triangle on its left.
std::vector<double> inflows(const Setting& s, const IdVector<EdgeId, EdgeMeans>& means) {
  std::vector<double> flows;
  flows.reserve(means.size());
  for (std::size_t e = 0; e < means.size(); ++e) {
    const DecEdge& edge = s.dec.edges[EdgeId(e)];
    const Vec2 left = turned_left(direction(s, edge));
    const double flow = s.length_in_frame(edge.length) * dot(means[EdgeId(e)].gradient, left);
    flows.push_back(edge.left.valid() ? flow : -flow);
  }
  return flows;
}

}  // namespace temper::error_detail
