// See make_discretization_error() in temper/errors.hpp. The mean squared error of a scheme over many waves, and its
// derivatives by the discrete adjoint.
//
// A scheme solves A v = b(u) for a wave u. The squared error is J = c Σ m e², e = v − u at the unknowns and m their
// areas. The adjoint λ solves A λ = 2 c m e. Now v depends on A, b, m and u. The total derivative
// of J by any of them is the derivative of J − λᵀ(A v − b) with v and λ kept.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

#include "base/rng.hpp"
#include "base/sine_cosine.hpp"
#include "errors/adjoint.hpp"
#include "errors/diffusion.hpp"
#include "errors/fields.hpp"
#include "errors/poisson.hpp"
#include "temper/dec.hpp"
#include "temper/detail/discretization_error.hpp"
#include "temper/errors.hpp"

namespace temper {
namespace error_detail {
namespace {

constexpr double kLeastWaveNumber = 1, kMostWaveNumber = 4;
constexpr std::size_t kBatch = 8;  // waves that a task takes: each has derivatives of its own to add up

/// sin(k · p + phase), in the coordinates of the mesh.
struct Wave {
  Vec2 k;
  double phase = 0;

  [[nodiscard]] double angle(Vec2 p) const { return dot(k, p) + phase; }
  [[nodiscard]] double at(Vec2 p) const { return sine_cosine(angle(p)).sine; }
  [[nodiscard]] Vec2 gradient(Vec2 p) const { return sine_cosine(angle(p)).cosine * k; }
  /// −Δ of it.
  [[nodiscard]] double source(Vec2 p) const { return squared_length(k) * at(p); }
  /// ∫ ∇u · n over the segment, n to its left.
  [[nodiscard]] double flow_to_left(Vec2 a, Vec2 b) const {
    const Vec2 e = b - a;
    const double half = 0.5 * dot(k, e);
    const double sinc = std::abs(half) < 1e-4 ? 1 - half * half / 6 : sine_cosine(half).sine / half;
    return (k.y * e.x - k.x * e.y) * sine_cosine(angle(0.5 * (a + b))).cosine * sinc;
  }
};

/// A mesh with its operators, and the waves in its units.
struct ErrorSubject {
  const Mesh& mesh;
  DecComplex dec;
  std::vector<Wave> waves;
  double area = 0;

  /// c of J: relative to the wave's mean square ½, over the fourth power of its number in the frame, in the mean.
  [[nodiscard]] double factor(const Wave& wave, double half_size) const {
    const double k2 = squared_length(wave.k) * half_size * half_size;
    return 2 / (area * k2 * k2 * static_cast<double>(waves.size()));
  }
};

/// A scheme on a mesh, its matrix factored.
class Solver {
 public:
  Solver(const ErrorSubject& subject, double half_size, PointSystem points)
      : s_(subject),
        half_size_(half_size),
        points_(std::move(points)),
        matrix_(Cholesky::of(points_.n_unknowns(), points_.lower())) {}
  virtual ~Solver() = default;
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  [[nodiscard]] bool is_definite() const { return matrix_.has_value(); }
  /// The squared error of one wave. If `by` is not null, adds its derivatives there.
  [[nodiscard]] virtual double error(const Wave& wave, Adjoint* by) const = 0;

 protected:
  /// The solution at all points, with these values where they are given.
  [[nodiscard]] std::vector<double> solved(const std::vector<double>& sources, std::vector<double> values) const {
    return solution_at_points(points_, *matrix_, sources, std::move(values));
  }
  /// The solution that is 0 at given points.
  [[nodiscard]] std::vector<double> solved(const std::vector<double>& sources) const {
    return solved(sources, std::vector<double>(sources.size(), 0.0));
  }
  [[nodiscard]] const ErrorSubject& subject() const { return s_; }
  [[nodiscard]] const PointSystem& points() const { return points_; }
  [[nodiscard]] double factor_of(const Wave& wave) const { return s_.factor(wave, half_size_); }

 private:
  const ErrorSubject& s_;
  double half_size_;
  PointSystem points_;
  std::optional<Cholesky> matrix_;
};

// --- unknowns at the vertices: d0ᵀ ★1 d0 u = ★0 f --------------------------------------------------------------------

class VertexSolver final : public Solver {
 public:
  VertexSolver(const ErrorSubject& s, double half_size)
      : Solver(s, half_size, vertex_system(s.dec, given_vertices(s.mesh))) {}

  [[nodiscard]] double error(const Wave& wave, Adjoint* by) const override {
    const auto& [mesh, dec, waves, area] = subject();
    std::vector<double> sources(mesh.n_vertices()), exact(mesh.n_vertices());
    for (const VertexId v : mesh.vertices()) {
      exact[v.index] = wave.at(mesh.position(v));
      sources[v.index] = dec.star0[v] * wave.source(mesh.position(v));
    }
    const std::vector<double> value = solved(sources, exact);
    const double c = factor_of(wave);
    SquaredErrors j(mesh.n_vertices());
    for (const VertexId v : mesh.vertices()) {
      if (!points().is_given(v.index)) j.add(v.index, c * dec.star0[v], value[v.index] - exact[v.index]);
    }
    if (by == nullptr) return j.sum;
    const std::vector<double> lambda = solved(j.force);
    for (const VertexId v : mesh.vertices()) {
      if (points().is_given(v.index)) continue;
      const double k2 = squared_length(wave.k), e = j.error[v.index];
      by->star0[v] += c * e * e + lambda[v.index] * k2 * exact[v.index];
      by->vertex[v] =
          by->vertex[v] + (lambda[v.index] * dec.star0[v] * k2 - j.force[v.index]) * wave.gradient(mesh.position(v));
    }
    by->add_star1(dec, value, lambda);
    return j.sum;
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
  CellSolver(const ErrorSubject& s, double half_size)
      : Solver(s, half_size, cell_system(s.dec, s.dec.transmissibility)) {}

  [[nodiscard]] double error(const Wave& wave, Adjoint* by) const override {
    const auto& [mesh, dec, waves, area] = subject();
    const std::vector<double> solution = solved(sources(wave));
    const double c = factor_of(wave);
    SquaredErrors j(solution.size());
    for (const TriangleId t : mesh.triangles())
      j.add(t.index, c * dec.areas[t], solution[t.index] - wave.at(dec.orthocenters[t]));
    if (by == nullptr) return j.sum;
    const std::vector<double> lambda = solved(j.force);
    for (const TriangleId t : mesh.triangles()) {
      const double e = j.error[t.index];
      by->area[t] += c * e * e;
      by->orthocenter[t] = by->orthocenter[t] - j.force[t.index] * wave.gradient(dec.orthocenters[t]);
    }
    by->add_flux(dec, solution, lambda);
    for (std::size_t i = 0; i < dec.edges.size(); ++i) add_edge(EdgeId(i), wave, solution, lambda, *by);
    return j.sum;
  }

 private:
  [[nodiscard]] std::vector<double> sources(const Wave& wave) const {
    const auto& [mesh, dec, waves, area] = subject();
    std::vector<double> right(mesh.n_triangles(), 0.0);
    for (std::size_t i = 0; i < dec.edges.size(); ++i) {
      const DecEdge& edge = dec.edges[EdgeId(i)];
      const double flow = wave.flow_to_left(mesh.position(edge.from), mesh.position(edge.to));
      if (edge.left.valid()) right[edge.left.index] += flow;
      if (edge.right.valid()) right[edge.right.index] -= flow;
      if (edge.is_boundary())
        right[inner_triangle(edge).index] += dec.transmissibility[EdgeId(i)] * wave.at(edge.midpoint);
    }
    return right;
  }

  void add_edge(EdgeId id, const Wave& wave, const std::vector<double>& solution, const std::vector<double>& lambda,
                Adjoint& by) const {
    const auto& [mesh, dec, waves, area] = subject();
    const DecEdge& edge = dec.edges[id];
    const Vec2 a = mesh.position(edge.from), b = mesh.position(edge.to), e = b - a;
    if (edge.is_boundary()) {
      const std::size_t k = inner_triangle(edge).index;
      by.transmissibility[id] -= lambda[k] * (solution[k] - wave.at(edge.midpoint));
      by.crossing[id] += lambda[k] * dec.transmissibility[id] * dot(wave.gradient(edge.midpoint), e) / edge.length;
      return;
    }
    const double difference = lambda[edge.left.index] - lambda[edge.right.index];
    // ∫ f over the triangle on the left grows by f times the way if the edge moves to the right.
    const Vec2 right = difference * Vec2{e.y, -e.x};
    along_segment(a, b, [&](Vec2 p, double weight) {
      const double t = dot(p - a, e) / squared_length(e), f = weight * wave.source(p);
      by.vertex[edge.from] = by.vertex[edge.from] + (f * (1 - t)) * right;
      by.vertex[edge.to] = by.vertex[edge.to] + (f * t) * right;
    });
  }
};

// --- the model -------------------------------------------------------------------------------------------------------

/// In the frame: half the bounding box has length 1.
std::vector<Wave> waves_of(const DiscretizationErrorOptions& options) {
  Rng rng(options.seed);
  std::vector<Wave> waves;
  for (std::size_t i = 0; i < options.fields; ++i) {
    const double turn = (static_cast<double>(i) + rng.uniform()) / static_cast<double>(options.fields);
    const double k = rng.uniform(kLeastWaveNumber, kMostWaveNumber);
    const auto [sine, cosine] = sine_cosine(std::numbers::pi * turn);
    waves.push_back({{k * cosine, k * sine}, rng.uniform(0, 2 * std::numbers::pi)});
  }
  return waves;
}

class SolverErrorModel final : public DiscretizationError {
 public:
  explicit SolverErrorModel(const DiscretizationErrorOptions& options)
      : scheme_(options.scheme), waves_(waves_of(options)) {}

  [[nodiscard]] std::vector<double> errors(const Mesh& mesh, Executor* executor) const override {
    return measure(mesh, nullptr, executor);
  }
  [[nodiscard]] std::vector<double> errors(const Mesh& mesh, std::vector<Gradient>& gradients,
                                           Executor* executor) const override {
    gradients.clear();
    return measure(mesh, &gradients, executor);
  }

 private:
  [[nodiscard]] std::vector<double> measure(const Mesh& mesh, std::vector<Gradient>* gradients,
                                            Executor* executor) const {
    const FieldFrame frame = field_frame(mesh);
    ErrorSubject subject{mesh, dec_operators(mesh), {}, 0};
    for (const double area : subject.dec.areas) subject.area += area;
    for (const Wave& wave : waves_) {
      const Vec2 k = (1 / frame.half_size) * wave.k;
      subject.waves.push_back({k, wave.phase - dot(k, frame.center)});
    }
    std::optional<VertexSolver> at_vertices;
    std::optional<CellSolver> in_cells;
    std::vector<const Solver*> solvers;
    if (scheme_ != Scheme::cell) solvers.push_back(&at_vertices.emplace(subject, frame.half_size));
    if (scheme_ != Scheme::vertex) solvers.push_back(&in_cells.emplace(subject, frame.half_size));
    if (!std::all_of(solvers.begin(), solvers.end(), [](const Solver* s) { return s->is_definite(); })) return {};

    std::vector<double> errors;
    for (const Solver* solver : solvers) {
      std::optional<Adjoint> by;
      if (gradients != nullptr) by.emplace(mesh, subject.dec);
      errors.push_back(mean_error(*solver, subject, by ? &*by : nullptr, executor));
      if (by) gradients->push_back(pulled_back(mesh, subject.dec, *by));
    }
    return errors;
  }

  /// The sum over all waves, and over their derivatives, in an order independent of the number of threads.
  static double mean_error(const Solver& solver, const ErrorSubject& subject, Adjoint* by, Executor* executor) {
    const std::vector<Wave>& waves = subject.waves;
    std::vector<double> sums((waves.size() + kBatch - 1) / kBatch, 0.0);
    std::vector<std::optional<Adjoint>> parts(by != nullptr ? sums.size() : 0);
    or_serial(executor).run(sums.size(), [&](std::size_t batch) {
      Adjoint* part = by != nullptr ? &parts[batch].emplace(subject.mesh, subject.dec) : nullptr;
      const std::size_t end = std::min(waves.size(), (batch + 1) * kBatch);
      for (std::size_t i = batch * kBatch; i < end; ++i) sums[batch] += solver.error(waves[i], part);
    });
    double sum = 0;
    for (const double part : sums) sum += part;
    for (const std::optional<Adjoint>& part : parts) by->add(*part);
    return sum;
  }

  Scheme scheme_;
  std::vector<Wave> waves_;
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
        "`scheme=cell` "
        "or `scheme=all`");
  }
  if (options.problem != nullptr) {
    return error_detail::make_problem_error(mesh, *options.problem, options.scheme, options.names);
  }
  if (options.fields == 0) return refused("errors are averaged over no field; expected one at least");
  return std::shared_ptr<const DiscretizationError>(std::make_shared<error_detail::SolverErrorModel>(options));
}

}  // namespace temper
