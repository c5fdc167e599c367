// See make_discretization_error() in temper/errors.hpp. The mean squared error of a scheme over many waves, and its
// derivatives by the discrete adjoint.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "base/sine_cosine.hpp"
#include "dec/measures.hpp"
#include "errors/diffusion.hpp"
#include "errors/fields.hpp"
#include "errors/lender.hpp"
#include "errors/poisson.hpp"
#include "errors/vertex_error.hpp"
#include "temper/dec.hpp"
#include "temper/detail/discretization_error.hpp"
#include "temper/errors.hpp"

namespace temper {
namespace error_detail {
namespace {

/// ½∫ cos(s h) ds and ½∫ s sin(s h) ds over [−1, 1] in each direction: a wave's means over a segment on which its angle
/// changes by 2h.
struct SegmentMeans {
  using Values = std::array<double, kDirections>;
  Values even, odd;
  Values half_secant;    ///< 1/(2 cos h), for short segments
  bool is_long = false;  ///< in some direction

  SegmentMeans() = default;
  explicit SegmentMeans(const Values& h) {
    constexpr double kLong = 0.06;  // of h²: below it the next terms of these series are below 1e-16
    for (std::size_t d = 0; d < kDirections; ++d) {
      const double z = h[d] * h[d];
      even[d] = 1 - 1.0 / 6 * z * (1 - 1.0 / 20 * z * (1 - 1.0 / 42 * z * (1 - 1.0 / 72 * z * (1 - 1.0 / 110 * z))));
      odd[d] = 1.0 / 3 * h[d] * (1 - 1.0 / 10 * z * (1 - 1.0 / 28 * z * (1 - 1.0 / 54 * z * (1 - 1.0 / 88 * z))));
      half_secant[d] =
          0.5 / (1 - 0.5 * z * (1 - 1.0 / 12 * z * (1 - 1.0 / 30 * z * (1 - 1.0 / 56 * z * (1 - 1.0 / 90 * z)))));
    }
    for (std::size_t d = 0; d < kDirections; ++d) {
      if (h[d] * h[d] < kLong) continue;
      is_long = true;
      const auto [sine, cosine] = sine_cosine(h[d]);
      even[d] = sine / h[d], odd[d] = (sine - h[d] * cosine) / (h[d] * h[d]);
    }
  }
};

using Waves = FieldBlock<Vec2>;

/// A mesh with its operators, and the waves in its units.
struct ErrorSubject {
  const Mesh& mesh;
  DecComplex dec;
  std::vector<Waves> waves;
};

/// A scheme on a mesh, its matrix factored. It solves for e directly: A e = b − A u.
class Solver {
 public:
  Solver(const ErrorSubject& subject, PointSystem points, Cholesky& matrix)
      : s_(subject),
        points_(std::move(points)),
        matrix_(matrix),
        is_definite_(matrix_.factor(points_.n_unknowns(), points_.lower())) {}
  virtual ~Solver() = default;
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  [[nodiscard]] bool is_definite() const { return is_definite_; }
  /// The squared error of a block of waves. If `by` is not null, adds its derivatives there.
  [[nodiscard]] virtual double error(const Waves& waves, Adjoint* by) const = 0;

 protected:
  [[nodiscard]] const ErrorSubject& subject() const { return s_; }
  [[nodiscard]] FactoredPoints factored() const { return {points_, matrix_}; }

 private:
  const ErrorSubject& s_;
  PointSystem points_;
  Cholesky& matrix_;
  bool is_definite_;
};

// --- unknowns at the vertices: d0ᵀ ★1 d0 u = ★0 f --------------------------------------------------------------------

class VertexSolver final : public Solver {
 public:
  VertexSolver(const ErrorSubject& s, Cholesky& matrix)
      : Solver(s, vertex_system(s.dec, given_vertices(s.mesh)), matrix) {}

  [[nodiscard]] double error(const Waves& waves, Adjoint* by) const override {
    return vertex_error(subject().mesh, subject().dec, factored(), waves, by);
  }

 private:
  static std::vector<bool> given_vertices(const Mesh& mesh) {
    std::vector<bool> given;
    for (const VertexId v : mesh.vertices()) given.push_back(mesh.is_isolated(v) || mesh.is_boundary(v));
    return given;
  }
};

// --- unknowns at the orthocenters: Σ ℓ/D (u_k − u_l) = ∫ f -----------------------------------------------------------

class CellSolver final : public Solver {
 public:
  CellSolver(const ErrorSubject& s, Cholesky& matrix) : Solver(s, cell_system(s.dec, s.dec.transmissibility), matrix) {}

  [[nodiscard]] double error(const Waves& waves, Adjoint* by) const override {
    const auto& [mesh, dec, all] = subject();
    std::vector<Lanes> at_vertices(mesh.n_vertices()), value(mesh.n_triangles()), errors(value.size());
    for (const VertexId v : mesh.vertices()) at_vertices[v.index] = waves.at(mesh.position(v));
    for (const TriangleId t : mesh.triangles()) value[t.index] = waves.at(dec.orthocenters[t]);
    add_residuals(waves, at_vertices, value, errors);
    const FactoredPoints scheme = factored();
    scheme.matrix.solve(scheme.points, errors);
    const double sum = squared_error(waves.share, dec.areas, errors);
    if (by == nullptr) return sum;
    const std::vector<Lanes> lambda = scheme.adjoint(waves.share, dec.areas, errors);
    for (const TriangleId t : mesh.triangles()) {
      const std::size_t p = t.index;
      Lanes by_angle = waves.slopes(value[p]);
      for (std::size_t i = 0; i < kLanes; ++i) {
        by_angle[i] *= -2 * waves.share * dec.areas[t] * errors[p][i];
        value[p][i] += errors[p][i];
      }
      by->area[t] += waves.share * squared(errors[p]);
      by->orthocenter[t] = by->orthocenter[t] + waves.by_place(by_angle);
    }
    for (std::size_t e = 0; e < dec.edges.size(); ++e) add_edge(EdgeId(e), waves, {at_vertices, value, lambda}, *by);
    return sum;
  }

 private:
  struct Values {
    const std::vector<Lanes>&at_vertices, &in_triangles, &lambda;
  };
  /// Waves on an edge: their means, and their values in its middle. By sin a + sin b = 2 sin((a + b)/2) cos((a − b)/2)
  /// the values at the ends give those in the middle.
  struct OnEdge {
    Vec2 e;
    SegmentMeans means;
    Lanes middle;

    OnEdge(const Mesh& mesh, const Waves& waves, const DecEdge& edge, const std::vector<Lanes>& at_vertices)
        : e(mesh.position(edge.to) - mesh.position(edge.from)) {
      const Lanes &from = at_vertices[edge.from.index], &to = at_vertices[edge.to.index];
      SegmentMeans::Values h;
      for (std::size_t d = 0; d < kDirections; ++d) h[d] = 0.5 * dot(waves.k[d], e);
      means = SegmentMeans(h);
      for (std::size_t i = 0; i < kLanes; ++i) middle[i] = means.half_secant[i / 2] * (from[i] + to[i]);
      if (means.is_long) middle = waves.at(mesh.position(edge.from) + 0.5 * e);
    }
  };

  /// Adds the flow of waves through each edge, less the flux by their values in triangles.
  void add_residuals(const Waves& waves, const std::vector<Lanes>& at_vertices, const std::vector<Lanes>& value,
                     std::vector<Lanes>& errors) const {
    const DecComplex& dec = subject().dec;
    for (std::size_t e = 0; e < dec.edges.size(); ++e) {
      const DecEdge& edge = dec.edges[EdgeId(e)];
      const double coefficient = dec.transmissibility[EdgeId(e)];
      const Lanes flow = flow_through(waves, edge, at_vertices);
      if (edge.is_boundary()) {
        const std::size_t k = inner_triangle(edge).index;
        const Lanes outside = waves.at(edge.midpoint);
        for (std::size_t i = 0; i < kLanes; ++i) {
          errors[k][i] += (edge.left.valid() ? flow[i] : -flow[i]) - coefficient * (value[k][i] - outside[i]);
        }
      } else {
        const std::size_t left = edge.left.index, right = edge.right.index;
        Lanes flux;
        for (std::size_t i = 0; i < kLanes; ++i) flux[i] = flow[i] - coefficient * (value[left][i] - value[right][i]);
        move(flux, errors[right], errors[left]);
      }
    }
  }
  /// ∫ ∇u · n over an edge, n to its left.
  [[nodiscard]] Lanes flow_through(const Waves& waves, const DecEdge& edge,
                                   const std::vector<Lanes>& at_vertices) const {
    const OnEdge on(subject().mesh, waves, edge, at_vertices);
    Lanes flow = waves.slopes(on.middle), factor;
    for (std::size_t d = 0; d < kDirections; ++d) {
      factor[2 * d] = factor[2 * d + 1] = cross(on.e, waves.k[d]) * on.means.even[d];
    }
    for (std::size_t i = 0; i < kLanes; ++i) flow[i] *= factor[i];
    return flow;
  }

  void add_edge(EdgeId id, const Waves& waves, const Values& values, Adjoint& by) const {
    const auto& [mesh, dec, all] = subject();
    const auto& [at_vertices, value, lambda] = values;
    const DecEdge& edge = dec.edges[id];
    if (edge.is_boundary()) {
      const Vec2 e = mesh.position(edge.to) - mesh.position(edge.from);
      const std::size_t k = inner_triangle(edge).index;
      const Lanes outside = waves.at(edge.midpoint);
      by.transmissibility[id] += by_coefficient(lambda[k], {}, value[k], outside);
      Lanes by_angle = waves.slopes(outside);
      for (std::size_t i = 0; i < kLanes; ++i) by_angle[i] *= lambda[k][i] * dec.transmissibility[id];
      by.crossing[id] += dot(waves.by_place(by_angle), e) / edge.length;
      return;
    }
    const Lanes &left = lambda[edge.left.index], &right = lambda[edge.right.index];
    by.transmissibility[id] += by_coefficient(left, right, value[edge.left.index], value[edge.right.index]);
    // ∫ f over the triangle on the left grows by f times the way if the edge moves to the right. The ends take ∫ f (1 −
    // t) and ∫ f t, t from 0 to 1.
    const OnEdge on(mesh, waves, edge, at_vertices);
    const auto& [e, means, middle] = on;
    const Lanes slopes = waves.slopes(middle);
    double even = 0, odd = 0;
    for (std::size_t d = 0; d < kDirections; ++d) {
      for (const std::size_t i : {2 * d, 2 * d + 1}) {
        even += (left[i] - right[i]) * middle[i] * means.even[d];
        odd += (left[i] - right[i]) * slopes[i] * means.odd[d];
      }
    }
    const double half = 0.5 * waves.k2;
    by.vertex[edge.from] = by.vertex[edge.from] + half * (even - odd) * Vec2{e.y, -e.x};
    by.vertex[edge.to] = by.vertex[edge.to] + half * (even + odd) * Vec2{e.y, -e.x};
  }
};

// --- the model -------------------------------------------------------------------------------------------------------

/// Matrices that the measurement of one mesh leaves to the next, whose connectivity is mostly the same.
struct Matrices {
  Cholesky at_vertices, in_cells;
};

class SolverErrorModel final : public DiscretizationError {
 public:
  explicit SolverErrorModel(Scheme scheme) : scheme_(scheme) {}

  [[nodiscard]] std::vector<double> errors(const Mesh& mesh, std::vector<Gradient>* gradients,
                                           Executor* executor) const override {
    if (gradients != nullptr) gradients->clear();
    const ErrorSubject subject = subject_of(mesh);
    const auto matrices = last_.take();
    std::optional<VertexSolver> at_vertices;
    std::optional<CellSolver> in_cells;
    std::vector<const Solver*> solvers;
    if (scheme_ != Scheme::cell) solvers.push_back(&at_vertices.emplace(subject, matrices->at_vertices));
    if (scheme_ != Scheme::vertex) solvers.push_back(&in_cells.emplace(subject, matrices->in_cells));
    if (!std::all_of(solvers.begin(), solvers.end(), [](const Solver* s) { return s->is_definite(); })) return {};

    std::vector<double> errors;
    for (const Solver* solver : solvers) {
      std::optional<Adjoint> by;
      if (gradients != nullptr) by.emplace(mesh, subject.dec);
      errors.push_back(sum_over(subject.waves, by ? &*by : nullptr, executor,
                                [&](const Waves& waves, Adjoint* part) { return solver->error(waves, part); }));
      if (by) gradients->push_back(pulled_back(mesh, subject.dec, *by));
    }
    return errors;
  }

 private:
  [[nodiscard]] ErrorSubject subject_of(const Mesh& mesh) const {
    ErrorSubject subject{mesh, dec_measures(mesh), {}};
    double area = 0;
    for (const double of_triangle : subject.dec.areas) area += of_triangle;
    std::span<const double> numbers = kWaveNumbers;
    if (scheme_ == Scheme::cell) numbers = kWaveNumberInCells;
    subject.waves = waves_of<Vec2>(field_frame(mesh), area, numbers);
    return subject;
  }

  Scheme scheme_;
  mutable Lender<Matrices> last_;
};

}  // namespace
}  // namespace error_detail

Expected<std::shared_ptr<const DiscretizationError>> make_discretization_error(
    const Mesh& mesh, const DiscretizationErrorOptions& options) {
  const auto refused = [](const std::string& message) { return InputError{ErrorCode::invalid_option, "", message}; };
  if (mesh.space().kind() != SpaceKind::plane)
    return refused("`objective=solver_error` is for meshes of the plane; expected `objective=accuracy`");
  if (options.scheme == Scheme::stars) {
    return refused(
        "`objective=solver_error` is for a scheme that solves, and stars solve nothing; expected `scheme=vertex`, "
        "`scheme=cell` or `scheme=all`");
  }
  if (options.problem != nullptr) {
    return error_detail::make_problem_error(mesh, *options.problem, options.scheme, options.names);
  }
  return std::shared_ptr<const DiscretizationError>(std::make_shared<error_detail::SolverErrorModel>(options.scheme));
}

}  // namespace temper
