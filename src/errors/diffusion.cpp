// The user's own problem, see DiffusionProblem: both schemes, and the reference by finite elements.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "base/median.hpp"
#include "base/text.hpp"
#include "errors/poisson.hpp"
#include "temper/dec.hpp"
#include "temper/detail/location.hpp"
#include "temper/errors.hpp"

namespace temper {
namespace error_detail {
namespace {

constexpr std::size_t kMostFine = 4'000'000;  // triangles of the reference: some five gigabytes with its factors
constexpr std::size_t kGivenHere = static_cast<std::size_t>(-1);

// --- the mesh as arrays, and its refinements -------------------------------------------------------------------------

using Pair = std::array<std::uint32_t, 2>;
Pair sorted(std::uint32_t a, std::uint32_t b) { return a < b ? Pair{a, b} : Pair{b, a}; }

/// A boundary edge with its value.
struct Side {
  Pair ends;
  std::optional<double> value, flux;
};

/// The problem on a triangulation. Refinements keep the vertices; the children of triangle t are 4 t to 4 t + 3.
struct Discrete {
  std::vector<Vec2> places;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<double> coefficient, source;
  std::vector<Side> sides;
};

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
  std::vector<std::pair<Pair, std::size_t>> edges;  // with their place among the corners of triangles
  edges.reserve(3 * coarse.triangles.size());
  for (std::size_t t = 0; t < coarse.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      edges.emplace_back(sorted(coarse.triangles[t][k], coarse.triangles[t][(k + 1) % 3]), 3 * t + k);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<std::uint32_t> middle(edges.size());
  const auto add_middle = [&](const Pair& ends) {
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

/// The values of u that sides give; later sides count.
std::vector<std::optional<double>> given_values(const Discrete& d) {
  std::vector<std::optional<double>> given(d.places.size());
  for (const Side& side : d.sides) {
    if (!side.value) continue;
    for (const std::uint32_t end : side.ends) given[end] = side.value;
  }
  return given;
}

/// A system with unknowns at points. Points with given values have none.
class PointSystem {
 public:
  explicit PointSystem(std::vector<std::optional<double>> given) : given_(std::move(given)) {
    for (const auto& value : given_) unknown_.push_back(value ? kGivenHere : linear_.unknowns++);
    linear_.right_sides.emplace_back(linear_.unknowns, 0.0);
  }

  /// A flux coefficient (u_i − u_j).
  void connect(std::size_t i, std::size_t j, double coefficient) {
    for (const auto& [here, there] : {std::pair(i, j), std::pair(j, i)}) {
      if (unknown_[here] == kGivenHere) continue;
      linear_.lower.push_back({unknown_[here], unknown_[here], coefficient});
      if (given_[there]) add(here, coefficient * *given_[there]);
    }
    if (unknown_[i] == kGivenHere || unknown_[j] == kGivenHere) return;
    linear_.lower.push_back({std::max(unknown_[i], unknown_[j]), std::min(unknown_[i], unknown_[j]), -coefficient});
  }
  /// A flux coefficient (u_i − value).
  void connect_to_value(std::size_t i, double value, double coefficient) {
    linear_.lower.push_back({unknown_[i], unknown_[i], coefficient});
    add(i, coefficient * value);
  }
  void add(std::size_t i, double amount) {
    if (unknown_[i] != kGivenHere) linear_.right_sides[0][unknown_[i]] += amount;
  }

  /// The value at each point; nothing if the system is singular.
  std::optional<std::vector<double>> solve(ErrorSystem* system) const {
    const LinearSolution solution = error_detail::solve(linear_, false);
    if (system != nullptr) {
      system->unknowns = linear_.unknowns;
      system->m_matrix = system->negative == 0 && !solution.singular;
      system->definite = solution.definite;
      system->singular = solution.singular;
    }
    if (solution.singular) return {};
    std::vector<double> values;
    for (std::size_t i = 0; i < given_.size(); ++i)
      values.push_back(given_[i] ? *given_[i] : solution.solutions[0][unknown_[i]]);
    return values;
  }

 private:
  std::vector<std::optional<double>> given_;
  std::vector<std::size_t> unknown_;
  LinearSystem linear_;
};

/// Linear finite elements: K cot/2 over each edge of a triangle, ∫ f φ with f linear.
std::optional<std::vector<double>> finite_elements(const Discrete& d) {
  PointSystem system(given_values(d));
  for (std::size_t t = 0; t < d.triangles.size(); ++t) {
    const auto& corners = d.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t i = corners[k], j = corners[(k + 1) % 3], o = corners[(k + 2) % 3];
      const Vec2 a = d.places[i] - d.places[o], b = d.places[j] - d.places[o];
      system.connect(i, j, 0.5 * d.coefficient[t] * dot(a, b) / cross(a, b));
      const double area = 0.5 * cross(a, b);
      system.add(o, area / 12 * (2 * d.source[o] + d.source[i] + d.source[j]));
    }
  }
  for (const Side& side : d.sides) {
    if (!side.flux) continue;
    const double half = 0.5 * length(d.places[side.ends[1]] - d.places[side.ends[0]]) * *side.flux;
    for (const std::uint32_t end : side.ends) system.add(end, half);
  }
  return system.solve(nullptr);
}

/// The reference on refined triangles, at any place of the mesh.
struct Reference {
  Discrete fine;
  std::vector<double> values;
  int refinements;

  [[nodiscard]] double at(const temper::Place& place, const Mesh& mesh) const {
    std::array<double, 3> shares = {};  // of the corners of the triangle
    const auto corners = mesh.corners(place.triangle);
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < static_cast<std::size_t>(place.n); ++i)
        shares[k] += place.corners[i] == corners[k] ? place.shares[i] : 0;
    }
    std::size_t t = place.triangle.index;
    for (int level = 0; level < refinements; ++level) t = child(t, shares);
    double value = 0;
    for (std::size_t k = 0; k < 3; ++k) value += shares[k] * values[fine.triangles[t][k]];
    return value;
  }

 private:
  /// The child that has the place, with its shares there.
  static std::size_t child(std::size_t t, std::array<double, 3>& shares) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (shares[k] < 0.5) continue;
      for (std::size_t i = 0; i < 3; ++i) shares[i] = i == k ? 2 * shares[i] - 1 : 2 * shares[i];
      return 4 * t + k;
    }
    // ab, bc, ca: each is opposite the corner of the same rank, from c on.
    shares = {1 - 2 * shares[2], 1 - 2 * shares[0], 1 - 2 * shares[1]};
    return 4 * t + 3;
  }
};

// --- the two schemes -------------------------------------------------------------------------------------------------

struct DiffusionSubject {
  const Mesh& mesh;
  const Discrete& discrete;
  DecComplex dec;
  std::map<Pair, const Side*> side_of;

  DiffusionSubject(const Mesh& m, const Discrete& d, DecComplex complex)
      : mesh(m), discrete(d), dec(std::move(complex)) {
    for (const Side& side : d.sides) side_of[side.ends] = &side;
  }
  [[nodiscard]] const Side* side(const DecEdge& edge) const {
    const auto found = side_of.find(sorted(edge.from.index, edge.to.index));
    return found == side_of.end() ? nullptr : found->second;
  }
};

void describe(const IdVector<EdgeId, double>& coefficients, const DecComplex& dec, ErrorSystem& system) {
  std::vector<double> inside;
  for (std::size_t e = 0; e < dec.edges.size(); ++e) {
    system.negative += coefficients[EdgeId(e)] < 0 ? 1 : 0;
    if (!dec.edges[EdgeId(e)].is_boundary()) inside.push_back(std::abs(coefficients[EdgeId(e)]));
  }
  system.largest_over_median = largest_over_median(std::move(inside));
}

std::optional<std::vector<double>> solve_at_vertices(const DiffusionSubject& s, ErrorSystem& system) {
  describe(s.dec.star1, s.dec, system);
  PointSystem points(given_values(s.discrete));
  for (std::size_t i = 0; i < s.dec.edges.size(); ++i) {
    const DecEdge& edge = s.dec.edges[EdgeId(i)];
    points.connect(edge.from.index, edge.to.index, s.dec.star1[EdgeId(i)]);
    const Side* const side = edge.is_boundary() ? s.side(edge) : nullptr;
    if (side == nullptr || !side->flux) continue;
    points.add(edge.from.index, edge.crossing * *side->flux);
    points.add(edge.to.index, (edge.length - edge.crossing) * *side->flux);
  }
  for (const VertexId v : s.mesh.vertices()) points.add(v.index, s.dec.star0[v] * s.discrete.source[v.index]);
  return points.solve(&system);
}

/// Orthocenters that coincide are one unknown.
std::optional<std::vector<double>> solve_at_orthocenters(const DiffusionSubject& s, ErrorSystem& system) {
  describe(s.dec.transmissibility, s.dec, system);
  constexpr double kLargest = 1e10;  // over the median: more would take as many digits from all others
  std::vector<double> sizes;
  for (const double value : s.dec.transmissibility) {
    if (std::isfinite(value)) sizes.push_back(std::abs(value));
  }
  const double bound = kLargest * median_of(std::move(sizes));
  PointSystem cells(std::vector<std::optional<double>>(s.mesh.n_triangles()));
  for (std::size_t i = 0; i < s.dec.edges.size(); ++i) {
    const DecEdge& edge = s.dec.edges[EdgeId(i)];
    const double flux = std::clamp(s.dec.transmissibility[EdgeId(i)], -bound, bound);
    if (std::abs(flux) == bound) ++system.merged;
    if (!edge.is_boundary()) {
      cells.connect(edge.left.index, edge.right.index, flux);
      continue;
    }
    const std::size_t t = (edge.left.valid() ? edge.left : edge.right).index;
    const Side* const side = s.side(edge);
    if (side != nullptr && side->value) cells.connect_to_value(t, *side->value, flux);
    if (side != nullptr && side->flux) cells.add(t, edge.length * *side->flux);
  }
  for (const TriangleId t : s.mesh.triangles()) {
    double f = 0;
    for (const VertexId v : s.mesh.corners(t)) f += s.discrete.source[v.index] / 3;
    cells.add(t.index, s.dec.areas[t] * f);
  }
  return cells.solve(&system);
}

/// Errors relative to the reference: in L2 with these weights, and at most.
ErrorNorms relative(const std::vector<double>& weights, const std::vector<double>& values,
                    const std::vector<double>& reference) {
  std::vector<double> errors(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) errors[i] = values[i] - reference[i];
  const ErrorNorms error = norms_of(weights, errors), size = norms_of(weights, reference);
  const auto over = [](double a, double b) { return a == 0 ? 0 : a / b; };
  return {over(error.l2, size.l2), over(error.max, size.max)};
}

// --- checks ----------------------------------------------------------------------------------------------------------

InputError refused(const std::string& message, std::string where = {}) {
  return {ErrorCode::invalid_option, std::move(where), message};
}

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
  std::map<Pair, std::size_t> known;
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

}  // namespace
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

  Discrete fine = coarse;
  for (int i = 0; i + 1 < refinements; ++i) fine = refined(fine);
  const auto before = finite_elements(fine);
  Reference reference{refined(fine), {}, refinements};
  auto values = finite_elements(reference.fine);
  if (!before || !values)
    return InputError{ErrorCode::invalid_option, "",
                      "the problem has no solution by finite elements: its matrix is singular"};
  reference.values = *std::move(values);

  DiffusionErrors result;
  result.refinements = refinements;
  const std::vector<double> at_vertices(reference.values.begin(),
                                        reference.values.begin() + static_cast<std::ptrdiff_t>(mesh.n_vertices()));
  const auto [least, largest] = std::minmax_element(at_vertices.begin(), at_vertices.end());
  result.least = *least, result.largest = *largest;
  std::vector<double> cells;
  for (const double area : subject.dec.star0) cells.push_back(std::abs(area));
  const std::vector<double> last(before->begin(), before->begin() + static_cast<std::ptrdiff_t>(mesh.n_vertices()));
  result.reference = relative(cells, last, at_vertices);

  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  result.vertex = result.cell = {kInfinity, kInfinity};
  if (const auto u = solve_at_vertices(subject, result.vertex_system)) result.vertex = relative(cells, *u, at_vertices);
  if (const auto u = solve_at_orthocenters(subject, result.cell_system)) {
    const PointLocator locator(mesh);
    std::vector<double> there;
    for (const TriangleId t : mesh.triangles())
      there.push_back(reference.at(locator.find(subject.dec.orthocenters[t], t), mesh));
    result.cell = relative(subject.dec.areas.raw(), *u, there);
  }
  return result;
}

}  // namespace temper
