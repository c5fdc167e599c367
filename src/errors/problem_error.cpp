// The model of errors for the user's own problem, see DiscretizationErrorOptions::problem.
//
// Coefficient, source and the reference u are functions of place, made once on the mesh of the problem. On any mesh of
// the domain a scheme solves A v = b. The squared error is J = c Σ m e², e = v − u at the unknowns, m their areas. As
// in solver_error.cpp, its derivatives come from the discrete adjoint A λ = 2 c m e.
//
// The reference has an error, too. Its square is added to J, since a smaller difference says nothing.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "errors/adjoint.hpp"
#include "errors/diffusion.hpp"
#include "temper/detail/discretization_error.hpp"

namespace temper::error_detail {
namespace {

constexpr int kRefinements = 2;                   // of the reference, or one less in large meshes
constexpr double kLeastError = 1e-12;             // of the reference: solutions that both reproduce leave rounding
constexpr double kInward = 1e-9;                  // part of the way from the boundary to a centroid
constexpr double kLeftByLastRefinement = 1. / 3;  // of its change: errors of second order fall to a quarter

/// J = Σ w e², and its derivatives by the errors e at points.
struct SquaredErrors {
  explicit SquaredErrors(std::size_t n) : error(n), force(n) {}
  void add(std::size_t i, double weight, double e) {
    sum += weight * e * e;
    error[i] = e;
    force[i] = 2 * weight * e;
  }

  double sum = 0;
  std::vector<double> error, force;  ///< 0 at given points
};

/// A problem and its reference as functions of place. Meshes may have other units and numbers than the problem's.
class PlacedProblem {
 public:
  PlacedProblem(const Mesh& mesh, Discrete discrete, Reference reference, const DiffusionProblem& problem)
      : mesh_(mesh), discrete_(std::move(discrete)), reference_(std::move(reference)), parts_(problem.boundary) {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      for (const auto& [a, b] : parts_[i].edges) parts_of_[sorted(a.index, b.index)].push_back(i);
    }
    double sum = 0, area = 0;
    for (std::size_t t = 0; t < discrete_.triangles.size(); ++t) {
      const auto [a, b, c] = discrete_.triangles[t];
      const auto& p = discrete_.places;
      const double third = cross(p[b] - p[a], p[c] - p[a]) / 6;
      for (const std::uint32_t corner : discrete_.triangles[t]) {
        sum += third * reference_.values[corner] * reference_.values[corner];
        area += third;
      }
    }
    mean_square_ = sum / area;
    std::vector<double> cells(mesh.n_vertices(), 1.0);
    const double change = relative(cells, reference_.before, reference_.at_vertices(mesh.n_vertices())).l2;
    least_square_error_ = std::pow(std::max(kLeftByLastRefinement * change, kLeastError), 2);
  }

  [[nodiscard]] double mean_square() const { return mean_square_; }
  /// The square of the reference's own relative error.
  [[nodiscard]] double least_square_error() const { return least_square_error_; }

 private:
  friend class ProblemOnMesh;

  const Mesh mesh_;
  PointLocator locator_{mesh_};
  Discrete discrete_;
  Reference reference_;
  std::vector<BoundaryValue> parts_;
  std::map<VertexPair, std::vector<std::size_t>> parts_of_;  // by edge
  double mean_square_ = 0, least_square_error_ = 0;
};

/// A problem on another mesh of the same domain, in the units of that mesh.
class ProblemOnMesh {
 public:
  ProblemOnMesh(const PlacedProblem& problem, const Mesh& mesh)
      : p_(problem), mesh_(mesh), there_(field_frame(problem.mesh_)), here_(field_frame(mesh)) {
    near_centroid_.resize(mesh.n_triangles());
    for (const TriangleId t : mesh.triangles()) near_centroid_[t] = find(centroid(t));
    here_problem_.boundary = problem.parts_;
    for (BoundaryValue& part : here_problem_.boundary) {
      part.edges.clear();
      if (part.is_flux) part.value *= scale();
    }
    for (const TriangleId t : mesh.triangles())
      here_problem_.coefficient.push_back(p_.discrete_.coefficient[near_centroid_[t].triangle.index]);
    for (const HalfedgeId h : mesh.halfedges()) {
      if (mesh.is_boundary(h)) add_edge(h);
    }
    for (const VertexId v : mesh.vertices()) {
      places_.push_back(place_of(v));
      const Sample f = source(places_.back());
      here_problem_.source.push_back(f.value);
      source_gradients_.push_back(f.gradient);
    }
  }

  [[nodiscard]] const DiffusionProblem& problem() const { return here_problem_; }
  [[nodiscard]] Vec2 source_gradient(VertexId v) const { return source_gradients_[v.index]; }
  [[nodiscard]] Sample reference(VertexId v) const { return reference(places_[v.index]); }
  /// At a place of triangle t.
  [[nodiscard]] Sample reference(Vec2 p, TriangleId t) const { return reference(find(p, near_centroid_[t].triangle)); }

 private:
  /// Lengths of the problem over lengths of this mesh.
  [[nodiscard]] double scale() const { return there_.half_size / here_.half_size; }
  [[nodiscard]] Vec2 centroid(TriangleId t) const {
    const auto [a, b, c] = mesh_.corners(t);
    return (1. / 3) * (mesh_.position(a) + mesh_.position(b) + mesh_.position(c));
  }
  temper::Place find(Vec2 p, TriangleId near = {}) const {
    const temper::Place place =
        p_.locator_.find(there_.center + scale() * (p - here_.center), near.valid() ? near : last_);
    last_ = place.triangle;
    return place;
  }
  /// A hair inside one of its triangles on the boundary, because the two sides of a crack differ.
  [[nodiscard]] temper::Place place_of(VertexId v) const {
    if (mesh_.is_isolated(v)) return temper::Place::at(VertexId(0), TriangleId(0));
    const Vec2 p = mesh_.position(v);
    const TriangleId t = Mesh::triangle(*mesh_.star(v).begin());
    return find(mesh_.is_boundary(v) ? p + kInward * (centroid(t) - p) : p, near_centroid_[t].triangle);
  }
  [[nodiscard]] std::array<Vec2, 3> slopes(TriangleId t) const {
    const auto& [a, b, c] = p_.discrete_.triangles[t.index];
    return gradients_of_shares(p_.discrete_.places[a], p_.discrete_.places[b], p_.discrete_.places[c]);
  }
  [[nodiscard]] Sample source(const temper::Place& place) const {
    const std::array<double, 3> shares = shares_of(place, p_.mesh_);
    const std::array<Vec2, 3> by = slopes(place.triangle);
    const double area = scale() * scale();  // f is per area, in units of this mesh
    Sample f;
    for (std::size_t k = 0; k < 3; ++k) {
      const double at_corner = p_.discrete_.source[p_.discrete_.triangles[place.triangle.index][k]];
      f.value += area * at_corner * shares[k];
      f.gradient = f.gradient + (area * scale() * at_corner) * by[k];
    }
    return f;
  }
  [[nodiscard]] Sample reference(const temper::Place& place) const {
    Sample u = p_.reference_.at(place.triangle.index, shares_of(place, p_.mesh_));
    u.gradient = scale() * u.gradient;
    return u;
  }
  /// Adds a boundary edge to the parts of the problem's edge that it is on.
  void add_edge(HalfedgeId h) {
    const VertexId a = mesh_.origin(h), b = mesh_.target(h);
    const Vec2 middle = 0.5 * (mesh_.position(a) + mesh_.position(b));
    const TriangleId t = Mesh::triangle(h);
    const temper::Place place = find(middle + kInward * (centroid(t) - middle), near_centroid_[t].triangle);
    const std::array<double, 3> shares = shares_of(place, p_.mesh_);
    const auto& corners = p_.discrete_.triangles[place.triangle.index];
    std::optional<std::size_t> opposite;  // the corner with the least share whose opposite edge is on the boundary
    for (std::size_t k = 0; k < 3; ++k) {
      const HalfedgeId edge = p_.mesh_.find_halfedge(VertexId(corners[(k + 1) % 3]), VertexId(corners[(k + 2) % 3]));
      if (p_.mesh_.is_boundary(edge) && (!opposite || shares[k] < shares[*opposite])) opposite = k;
    }
    if (!opposite) return;
    const auto parts = p_.parts_of_.find(sorted(corners[(*opposite + 1) % 3], corners[(*opposite + 2) % 3]));
    if (parts == p_.parts_of_.end()) return;
    for (const std::size_t part : parts->second) here_problem_.boundary[part].edges.push_back({a, b});
  }

  const PlacedProblem& p_;
  const Mesh& mesh_;
  const FieldFrame there_, here_;
  mutable TriangleId last_;  // where the search for the next place begins
  IdVector<TriangleId, temper::Place> near_centroid_;
  DiffusionProblem here_problem_;
  std::vector<temper::Place> places_;
  std::vector<Vec2> source_gradients_;
};

class ProblemErrorModel final : public DiscretizationError {
 public:
  ProblemErrorModel(Scheme scheme, const Mesh& mesh, Discrete discrete, Reference reference,
                    const DiffusionProblem& problem)
      : scheme_(scheme), problem_(mesh, std::move(discrete), std::move(reference), problem) {}

  [[nodiscard]] const PlacedProblem& problem() const { return problem_; }
  [[nodiscard]] std::vector<double> errors(const Mesh& mesh, std::vector<Gradient>* gradients,
                                           Executor* /*executor*/) const override {
    if (gradients != nullptr) gradients->clear();
    const ProblemOnMesh on(problem_, mesh);
    const Discrete discrete = discrete_of(mesh, on.problem());
    Expected<DecComplex> dec = with_coefficient(mesh, dec_operators(mesh), discrete.coefficient);
    if (!dec) return {};
    const DiffusionSubject subject(mesh, discrete, *std::move(dec));
    double area = 0;
    for (const double a : subject.dec.areas) area += a;
    std::vector<double> errors;
    for (const Scheme scheme : {Scheme::vertex, Scheme::cell}) {
      if (scheme_ != Scheme::all && scheme_ != scheme) continue;
      std::size_t merged = 0;
      Equations equations = scheme == Scheme::vertex ? at_vertices(subject) : at_orthocenters(subject, merged);
      Cholesky matrix;
      if (!matrix.factor(equations.points.n_unknowns(), equations.points.lower())) return {};
      const Factored factored = {subject, on, 1 / (area * problem_.mean_square()), std::move(equations),
                                 std::move(matrix)};
      std::optional<Adjoint> by;
      if (gradients != nullptr) by.emplace(mesh, subject.dec);
      const double error =
          scheme == Scheme::vertex ? error_at_vertices(factored, by) : error_at_orthocenters(factored, by);
      errors.push_back(error + problem_.least_square_error());
      if (by) gradients->push_back(pulled_back(mesh, subject.dec, *by));
    }
    return errors;
  }

 private:
  /// A scheme with its matrix factored, and c of J.
  struct Factored {
    const DiffusionSubject& s;
    const ProblemOnMesh& on;
    double c;
    Equations equations;
    Cholesky matrix;

    [[nodiscard]] std::vector<double> solution(const std::vector<double>& sources, std::vector<double> values) const {
      std::vector<double> right = equations.points.right_side(sources, values);
      matrix.solve(right);
      equations.points.put(right, values);
      return values;
    }
  };

  static double error_at_vertices(const Factored& scheme, std::optional<Adjoint>& by) {
    const auto& [s, on, c, equations, matrix] = scheme;
    const std::vector<double> v = scheme.solution(equations.sources, equations.values);
    SquaredErrors j(s.mesh.n_vertices());
    for (const VertexId i : s.mesh.vertices()) {
      if (!equations.points.is_given(i.index)) j.add(i.index, c * s.dec.star0[i], v[i.index] - on.reference(i).value);
    }
    if (!by) return j.sum;
    const std::vector<double> lambda = scheme.solution(j.force, std::vector<double>(v.size()));
    for (const VertexId i : s.mesh.vertices()) {
      const double l = lambda[i.index], e = j.error[i.index];
      by->star0[i] += c * e * e + l * s.discrete.source[i.index];
      by->vertex[i] =
          by->vertex[i] + (l * s.dec.star0[i]) * on.source_gradient(i) - j.force[i.index] * on.reference(i).gradient;
    }
    by->add_star1(s.dec, v, lambda);
    for (std::size_t i = 0; i < s.dec.edges.size(); ++i) {
      const DecEdge& edge = s.dec.edges[EdgeId(i)];
      by->crossing[EdgeId(i)] += (lambda[edge.from.index] - lambda[edge.to.index]) * s.flux(edge).value_or(0);
    }
    return j.sum;
  }

  static double error_at_orthocenters(const Factored& scheme, std::optional<Adjoint>& by) {
    const auto& [s, on, c, equations, matrix] = scheme;
    const std::vector<double> v = scheme.solution(equations.sources, equations.values);
    SquaredErrors j(s.mesh.n_triangles());
    std::vector<Vec2> slopes(v.size());
    for (const TriangleId t : s.mesh.triangles()) {
      const Sample u = on.reference(s.dec.orthocenters[t], t);
      slopes[t.index] = u.gradient;
      j.add(t.index, c * s.dec.areas[t], v[t.index] - u.value);
    }
    if (!by) return j.sum;
    const std::vector<double> lambda = scheme.solution(j.force, std::vector<double>(v.size()));
    for (const TriangleId t : s.mesh.triangles()) {
      const double third = lambda[t.index] / 3, e = j.error[t.index];
      by->area[t] += c * e * e;
      by->orthocenter[t] = by->orthocenter[t] - j.force[t.index] * slopes[t.index];
      for (const VertexId i : s.mesh.corners(t)) {
        by->area[t] += third * s.discrete.source[i.index];
        by->vertex[i] = by->vertex[i] + (third * s.dec.areas[t]) * on.source_gradient(i);
      }
    }
    by->add_flux(s.dec, v, lambda);
    for (std::size_t i = 0; i < s.dec.edges.size(); ++i) {
      const DecEdge& edge = s.dec.edges[EdgeId(i)];
      const std::optional<double> value = s.value(edge);
      if (!value) continue;
      const std::size_t t = inner_triangle(edge).index;
      by->transmissibility[EdgeId(i)] -= lambda[t] * (v[t] - *value);
    }
    return j.sum;
  }

  Scheme scheme_;
  PlacedProblem problem_;
};

}  // namespace

Expected<std::shared_ptr<const DiscretizationError>> make_problem_error(const Mesh& mesh,
                                                                        const DiffusionProblem& problem, Scheme scheme,
                                                                        const InputNames* names) {
  const InputNames from_zero;
  const InputNames& say = names != nullptr ? *names : from_zero;
  int refinements = kRefinements;
  if (check_problem(mesh, problem, refinements, say)) --refinements;
  if (auto error = check_problem(mesh, problem, refinements, say)) return *std::move(error);
  Discrete discrete = discrete_of(mesh, problem);
  if (auto dec = with_coefficient(mesh, dec_operators(mesh), discrete.coefficient, names); !dec) return dec.error();
  Expected<Reference> reference = reference_of(discrete, refinements);
  if (!reference) return reference.error();
  auto model =
      std::make_shared<const ProblemErrorModel>(scheme, mesh, std::move(discrete), *std::move(reference), problem);
  if (!(model->problem().mean_square() > 0)) {
    return InputError{
        ErrorCode::invalid_option, "",
        "the solution of the problem is 0 everywhere, and has no error. Next: give a source, or a boundary "
        "value other than 0"};
  }
  return std::shared_ptr<const DiscretizationError>(std::move(model));
}

}  // namespace temper::error_detail
