// The user's own problem, see DiffusionProblem: both schemes, and the reference by finite elements.
#include "errors/diffusion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "base/median.hpp"
#include "base/text.hpp"

namespace temper {
namespace error_detail {
namespace {

constexpr std::size_t kMostFine = 4'000'000;  // triangles of the reference: some five gigabytes with its factors

// --- the mesh as arrays, and its refinements -------------------------------------------------------------------------

//        c
//       / \        Children: a and its midpoints, b and its, c and its, the three midpoints.
//     ca---bc
//     / \ / \      .
//    a--ab---b
Discrete refined(const Discrete& coarse) {
  Discrete fine = coarse;
  fine.triangles.clear();
  fine.coefficient.clear();
  fine.sides.clear();
  std::vector<std::pair<VertexPair, std::size_t>> edges;  // with their place among the corners of triangles
  edges.reserve(3 * coarse.triangles.size());
  for (std::size_t t = 0; t < coarse.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      edges.emplace_back(sorted(coarse.triangles[t][k], coarse.triangles[t][(k + 1) % 3]), 3 * t + k);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<std::uint32_t> middle(edges.size());
  const auto add_middle = [&](const VertexPair& ends) {
    fine.places.push_back(0.5 * (coarse.places[ends[0]] + coarse.places[ends[1]]));
    fine.source.push_back(0.5 * (coarse.source[ends[0]] + coarse.source[ends[1]]));
  };
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i == 0 || edges[i].first != edges[i - 1].first) add_middle(edges[i].first);
    middle[edges[i].second] = static_cast<std::uint32_t>(fine.places.size() - 1);
  }
  for (std::size_t t = 0; t < coarse.triangles.size(); ++t) {
    const auto [a, b, c] = coarse.triangles[t];
    const std::uint32_t ab = middle[3 * t], bc = middle[3 * t + 1], ca = middle[3 * t + 2];
    fine.triangles.insert(fine.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    fine.coefficient.insert(fine.coefficient.end(), 4, coarse.coefficient[t]);
  }
  for (const Side& side : coarse.sides) {
    const auto at = std::lower_bound(edges.begin(), edges.end(), std::pair(side.ends, std::size_t{0}));
    const std::uint32_t between = middle[at->second];
    for (const std::uint32_t end : side.ends) fine.sides.push_back({sorted(end, between), side.value, side.flux});
  }
  return fine;
}

/// Equations at vertices, with the values of u that sides give; later sides count. An isolated vertex has the value 0.
Equations without_matrix(const Discrete& d) {
  std::vector<bool> given(d.places.size(), true);
  Equations equations = {PointSystem({}), std::vector<double>(given.size()), std::vector<double>(given.size())};
  for (const auto& corners : d.triangles) {
    for (const std::uint32_t corner : corners) given[corner] = false;
  }
  for (const Side& side : d.sides) {
    if (!side.value) continue;
    for (const std::uint32_t end : side.ends) given[end] = true, equations.values[end] = *side.value;
  }
  equations.points = PointSystem(given);
  return equations;
}

/// The values at all points; nothing if the system is singular.
std::optional<std::vector<double>> solved(Equations e, ErrorSystem& system) {
  const LinearSystem linear = {e.points.n_unknowns(), e.points.lower(), {e.points.right_side(e.sources, e.values)}};
  const LinearSolution solution = solve(linear, false);
  describe(linear, solution, system);
  if (solution.singular) return {};
  e.points.put(solution.solutions[0], e.values);
  return std::move(e.values);
}

/// Linear finite elements: K cot/2 over each edge of a triangle, ∫ f φ with f linear.
std::optional<std::vector<double>> finite_elements(const Discrete& d) {
  Equations equations = without_matrix(d);
  for (std::size_t t = 0; t < d.triangles.size(); ++t) {
    const auto& corners = d.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t i = corners[k], j = corners[(k + 1) % 3], o = corners[(k + 2) % 3];
      const Vec2 a = d.places[i] - d.places[o], b = d.places[j] - d.places[o];
      equations.points.connect(i, j, 0.5 * d.coefficient[t] * dot(a, b) / cross(a, b));
      const double area = 0.5 * cross(a, b);
      equations.sources[o] += area / 12 * (2 * d.source[o] + d.source[i] + d.source[j]);
    }
  }
  for (const Side& side : d.sides) {
    if (!side.flux) continue;
    const double half = 0.5 * length(d.places[side.ends[1]] - d.places[side.ends[0]]) * *side.flux;
    for (const std::uint32_t end : side.ends) equations.sources[end] += half;
  }
  ErrorSystem ignored;
  return solved(std::move(equations), ignored);
}

void count_coefficients(const IdVector<EdgeId, double>& coefficients, const DecComplex& dec, ErrorSystem& system) {
  std::vector<double> inside;
  for (std::size_t e = 0; e < dec.edges.size(); ++e) {
    system.negative += coefficients[EdgeId(e)] < 0 ? 1 : 0;
    if (!dec.edges[EdgeId(e)].is_boundary()) inside.push_back(std::abs(coefficients[EdgeId(e)]));
  }
  system.largest_over_median = largest_over_median(std::move(inside));
}

/// The child that has a place of triangle t, with its shares there.
std::size_t child(std::size_t t, std::array<double, 3>& shares) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (shares[k] < 0.5) continue;
    for (std::size_t i = 0; i < 3; ++i) shares[i] = i == k ? 2 * shares[i] - 1 : 2 * shares[i];
    return 4 * t + k;
  }
  // ab, bc, ca: each is opposite the corner of the same rank, from c on.
  shares = {1 - 2 * shares[2], 1 - 2 * shares[0], 1 - 2 * shares[1]};
  return 4 * t + 3;
}

}  // namespace

std::array<Vec2, 3> gradients_of_shares(Vec2 a, Vec2 b, Vec2 c) {
  const double inverse = 1 / cross(b - a, c - a);
  const auto across = [inverse](Vec2 e) { return inverse * Vec2{-e.y, e.x}; };
  return {across(c - b), across(a - c), across(b - a)};
}

std::array<double, 3> shares_of(const temper::Place& place, const Mesh& mesh) {
  std::array<double, 3> shares = {};
  const auto corners = mesh.corners(place.triangle);
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(place.n); ++i)
      shares[k] += place.corners[i] == corners[k] ? place.shares[i] : 0;
  }
  return shares;
}

Sample Reference::at(std::size_t t, std::array<double, 3> shares) const {
  for (int level = 0; level + 1 < refinements; ++level) t = child(t, shares);
  std::array<std::size_t, 3> corners = {};
  for (std::size_t k = 0; k < 3; ++k) corners[k] = fine.triangles[4 * t + k][k];
  const auto& middles = fine.triangles[4 * t + 3];  // ab, bc, ca
  const auto& p = fine.places;
  const std::array<Vec2, 3> slopes = gradients_of_shares(p[corners[0]], p[corners[1]], p[corners[2]]);
  Sample sample;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const double at_corner = values[corners[k]], at_middle = values[middles[k]], s = shares[k], n = shares[next];
    sample.value += at_corner * s * (2 * s - 1) + at_middle * 4 * s * n;
    sample.gradient = sample.gradient + (at_corner * (4 * s - 1) + at_middle * 4 * n) * slopes[k] +
                      (at_middle * 4 * s) * slopes[next];
  }
  return sample;
}

Expected<Reference> reference_of(const Discrete& coarse, int refinements) {
  Discrete fine = coarse;
  for (int i = 0; i + 1 < refinements; ++i) fine = refined(fine);
  auto before = finite_elements(fine);
  Reference reference{refined(fine), {}, refinements, {}};
  auto values = finite_elements(reference.fine);
  if (!before || !values) {
    return InputError{ErrorCode::invalid_option, "",
                      "the problem has no solution by finite elements: its matrix is singular"};
  }
  before->resize(coarse.places.size());
  reference.before = *std::move(before);
  reference.values = *std::move(values);
  return reference;
}

Equations at_vertices(const DiffusionSubject& s) {
  Equations equations = without_matrix(s.discrete);
  std::vector<bool> given;
  for (const VertexId v : s.mesh.vertices()) {
    given.push_back(equations.points.is_given(v.index));
    equations.sources[v.index] = s.dec.star0[v] * s.discrete.source[v.index];
  }
  equations.points = vertex_system(s.dec, given);
  for (const DecEdge& edge : s.dec.edges) {
    const double flux = s.flux(edge).value_or(0);
    equations.sources[edge.from.index] += edge.crossing * flux;
    equations.sources[edge.to.index] += (edge.length - edge.crossing) * flux;
  }
  return equations;
}

Equations at_orthocenters(const DiffusionSubject& s, std::size_t& merged) {
  constexpr double kLargest = 1e10;  // over the median: more would take as many digits from all others
  std::vector<double> sizes;
  for (const double value : s.dec.transmissibility) {
    if (std::isfinite(value)) sizes.push_back(std::abs(value));
  }
  const double bound = kLargest * median_of(std::move(sizes));
  IdVector<EdgeId, double> flux = s.dec.transmissibility;
  std::vector<double> sources(s.mesh.n_triangles());
  for (const TriangleId t : s.mesh.triangles()) {
    for (const VertexId v : s.mesh.corners(t)) sources[t.index] += s.dec.areas[t] * s.discrete.source[v.index] / 3;
  }
  for (std::size_t i = 0; i < s.dec.edges.size(); ++i) {
    const DecEdge& edge = s.dec.edges[EdgeId(i)];
    double& c = flux[EdgeId(i)];
    merged += std::abs(c) >= bound ? 1 : 0;
    c = std::clamp(c, -bound, bound);
    if (!edge.is_boundary()) continue;
    const std::optional<double> value = s.value(edge);
    if (!value) c = 0;
    sources[inner_triangle(edge).index] += c * value.value_or(0) + edge.length * s.flux(edge).value_or(0);
  }
  return {cell_system(s.dec, flux), std::move(sources), std::vector<double>(s.mesh.n_triangles())};
}

ErrorNorms relative(const std::vector<double>& weights, const std::vector<double>& values,
                    const std::vector<double>& reference) {
  std::vector<double> errors(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) errors[i] = values[i] - reference[i];
  const ErrorNorms error = norms_of(weights, errors), size = norms_of(weights, reference);
  const auto over = [](double a, double b) { return a == 0 ? 0 : a / b; };
  return {over(error.l2, size.l2), over(error.max, size.max)};
}

// --- checks ----------------------------------------------------------------------------------------------------------

namespace {

InputError refused(const std::string& message, std::string where = {}) {
  return {ErrorCode::invalid_option, std::move(where), message};
}

}  // namespace

std::optional<InputError> check_problem(const Mesh& mesh, const DiffusionProblem& problem, int refinements,
                                        const InputNames& names) {
  if (mesh.space().kind() != SpaceKind::plane) return refused("a problem of one's own is for meshes of the plane");
  if (mesh.n_triangles() == 0) return InputError{ErrorCode::empty_input, "", "the mesh has no triangles"};
  if (!problem.source.empty() && problem.source.size() != mesh.n_vertices()) {
    return refused("expected a source for each of the " + std::to_string(mesh.n_vertices()) + " vertices, found " +
                   std::to_string(problem.source.size()));
  }
  for (std::size_t v = 0; v < problem.source.size(); ++v) {
    if (!std::isfinite(problem.source[v]))
      return refused(names.point(v) + " has the source " + to_text(problem.source[v]) + "; expected a finite number",
                     names.point_where(v));
  }
  if (refinements < 1) return refused("expected at least one refinement for the reference");
  double fine = static_cast<double>(mesh.n_triangles());
  for (int i = 0; i < refinements; ++i) fine *= 4;
  if (fine > static_cast<double>(kMostFine)) {
    return refused("refining " + std::to_string(refinements) + " times makes more than " + std::to_string(kMostFine) +
                   " triangles");
  }
  bool any_value = false;
  for (const BoundaryValue& part : problem.boundary) {
    if (!std::isfinite(part.value)) return refused("a value on the boundary is not finite");
    any_value = any_value || (!part.is_flux && !part.edges.empty());
    for (const auto& [a, b] : part.edges) {
      const bool known = a.index < mesh.n_vertices() && b.index < mesh.n_vertices();
      const HalfedgeId h = known ? mesh.find_halfedge(a, b) : HalfedgeId();
      const HalfedgeId other = known ? mesh.find_halfedge(b, a) : HalfedgeId();
      if ((h.valid() && mesh.is_boundary(h)) || (other.valid() && mesh.is_boundary(other))) continue;
      return refused("the edge from " + names.point(a.index) + " to " + names.point(b.index) +
                     " is not on the boundary of the mesh; expected boundary edges for given values");
    }
  }
  if (!any_value) return refused("no boundary edge has a value of u, so u is known up to a constant only");
  return {};
}

Discrete discrete_of(const Mesh& mesh, const DiffusionProblem& problem) {
  Discrete d;
  for (const VertexId v : mesh.vertices()) d.places.push_back(mesh.position(v));
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    d.triangles.push_back({a.index, b.index, c.index});
  }
  d.coefficient = problem.coefficient;
  if (d.coefficient.empty()) d.coefficient.assign(mesh.n_triangles(), 1.0);
  d.source = problem.source;
  if (d.source.empty()) d.source.assign(mesh.n_vertices(), 0.0);
  std::map<VertexPair, std::size_t> known;
  for (const BoundaryValue& part : problem.boundary) {
    for (const auto& [a, b] : part.edges) {
      const auto [at, is_new] = known.emplace(sorted(a.index, b.index), d.sides.size());
      if (is_new) d.sides.push_back({at->first, {}, {}});
      Side& side = d.sides[at->second];
      (part.is_flux ? side.flux : side.value) = part.value;
    }
  }
  for (Side& side : d.sides) {
    if (side.value) side.flux.reset();  // what is given counts
  }
  return d;
}

}  // namespace error_detail

Expected<DiffusionErrors> measure_diffusion_errors(const Mesh& mesh, const DiffusionProblem& problem, int refinements,
                                                   const InputNames* names) {
  using namespace error_detail;
  const InputNames from_zero;
  const InputNames& say = names != nullptr ? *names : from_zero;
  if (auto error = check_problem(mesh, problem, refinements, say)) return *std::move(error);
  const Discrete coarse = discrete_of(mesh, problem);
  Expected<DecComplex> complex = with_coefficient(mesh, dec_operators(mesh), coarse.coefficient, names);
  if (!complex) return complex.error();
  const DiffusionSubject subject(mesh, coarse, *std::move(complex));

  const Expected<Reference> reference = reference_of(coarse, refinements);
  if (!reference) return reference.error();

  DiffusionErrors result;
  result.refinements = refinements;
  const std::vector<double> exact = reference->at_vertices(mesh.n_vertices());
  const auto [least, largest] = std::minmax_element(exact.begin(), exact.end());
  result.least = *least, result.largest = *largest;
  std::vector<double> cells;
  for (const double area : subject.dec.star0) cells.push_back(std::abs(area));
  result.reference = relative(cells, reference->before, exact);

  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  result.vertex = result.cell = {kInfinity, kInfinity};
  count_coefficients(subject.dec.star1, subject.dec, result.vertex_system);
  count_coefficients(subject.dec.transmissibility, subject.dec, result.cell_system);
  if (const auto u = solved(at_vertices(subject), result.vertex_system)) result.vertex = relative(cells, *u, exact);
  if (const auto u = solved(at_orthocenters(subject, result.cell_system.merged), result.cell_system)) {
    const PointLocator locator(mesh);
    std::vector<double> there;
    for (const TriangleId t : mesh.triangles()) {
      const temper::Place place = locator.find(subject.dec.orthocenters[t], t);
      there.push_back(reference->at(place.triangle.index, shares_of(place, mesh)).value);
    }
    result.cell = relative(subject.dec.areas.raw(), *u, there);
  }
  return result;
}

}  // namespace temper
