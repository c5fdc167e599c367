// See make_discretization_error() in temper/errors.hpp. The mean squared error of a scheme over many waves, and its
// derivatives by the discrete adjoint.
//
// A scheme solves A v = b(u) for a wave u. The squared error is J = c Σ m e², e = v − u at the unknowns and m their
// areas. The adjoint λ solves A λ = 2 c m e. Now v depends on A, b, m and u. The total derivative
// of J by any of them is the derivative of J − λᵀ(A v − b) with v and λ kept.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>
#include <utility>

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

// Wave numbers in radians per half of the bounding box, one for each block of waves.
constexpr double kWaveNumbers[] = {2, 4};
// A block has a sine and a cosine in each direction. So the sum of their squares does not depend on the place. The sum
// of k k k k over four directions does not depend on directions.
constexpr std::size_t kDirections = kLanes / 2;

/// ½∫ cos(s h) ds and ½∫ s sin(s h) ds over [−1, 1]: a wave's means over a segment on which its angle changes by 2h.
struct SegmentMeans {
  double even = 1, odd = 0;

  explicit SegmentMeans(double h) {
    const double z = h * h;
    if (z < 0.06) {  // the next terms are below 1e-16
      even = 1 - z / 6 * (1 - z / 20 * (1 - z / 42 * (1 - z / 72 * (1 - z / 110))));
      odd = h / 3 * (1 - z / 10 * (1 - z / 28 * (1 - z / 54 * (1 - z / 88))));
    } else {
      const auto [sine, cosine] = sine_cosine(h);
      even = sine / h, odd = (sine - h * cosine) / z;
    }
  }
};

/// Waves side by side in the coordinates of the mesh.
struct WaveBlock {
  Lanes x = {}, y = {}, phase = {};  // of k · p + phase
  Lanes k2 = {};
  Lanes share = {};  // c of J, relative to the mean square ½, over k⁴ in the frame, in the mean

  [[nodiscard]] SineCosine at(std::size_t i, Vec2 p) const { return sine_cosine(x[i] * p.x + y[i] * p.y + phase[i]); }
};

/// A mesh with its operators, and the waves in its units.
struct ErrorSubject {
  const Mesh& mesh;
  DecComplex dec;
  std::vector<WaveBlock> waves;
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
  [[nodiscard]] virtual double error(const WaveBlock& waves, Adjoint* by) const = 0;

 protected:
  /// The solution at all points, 0 where it is given.
  [[nodiscard]] std::vector<Lanes> solved(std::vector<Lanes> sources) const {
    matrix_.solve(points_, sources);
    return sources;
  }
  [[nodiscard]] const ErrorSubject& subject() const { return s_; }
  [[nodiscard]] const PointSystem& points() const { return points_; }

  /// J = c Σ m e²; `force` is its derivative by e. At given points e is 0.
  template <class Masses>
  static double squared(const WaveBlock& waves, const Masses& masses, const std::vector<Lanes>& errors,
                        std::vector<Lanes>& force) {
    force.resize(errors.size());
    Lanes sums = {};
    for (std::size_t p = 0; p < errors.size(); ++p) {
      for (std::size_t i = 0; i < kLanes; ++i) {
        const double me = waves.share[i] * masses.begin()[p] * errors[p][i];
        sums[i] += me * errors[p][i];
        force[p][i] = 2 * me;
      }
    }
    double sum = 0;
    for (const double part : sums) sum += part;
    return sum;
  }

 private:
  const ErrorSubject& s_;
  PointSystem points_;
  Cholesky& matrix_;
  bool is_definite_;
};

/// The derivative of −λᵀ A v by the coefficient between two points.
double by_coefficient(const Lanes& lambda_a, const Lanes& lambda_b, const Lanes& a, const Lanes& b) {
  double sum = 0;
  for (std::size_t i = 0; i < kLanes; ++i) sum -= (lambda_a[i] - lambda_b[i]) * (a[i] - b[i]);
  return sum;
}

// --- unknowns at the vertices: d0ᵀ ★1 d0 u = ★0 f --------------------------------------------------------------------

class VertexSolver final : public Solver {
 public:
  VertexSolver(const ErrorSubject& s, Cholesky& matrix)
      : Solver(s, vertex_system(s.dec, given_vertices(s.mesh)), matrix) {}

  [[nodiscard]] double error(const WaveBlock& waves, Adjoint* by) const override {
    const auto& [mesh, dec, all] = subject();
    std::vector<Lanes> value(mesh.n_vertices()), slope(value.size()), sources(value.size()), force;
    for (const VertexId v : mesh.vertices()) {
      for (std::size_t i = 0; i < kLanes; ++i) {
        const auto [sine, cosine] = waves.at(i, mesh.position(v));
        value[v.index][i] = sine, slope[v.index][i] = cosine;
        sources[v.index][i] = dec.star0[v] * waves.k2[i] * sine;
      }
    }
    const std::vector<Lanes> exact = value;
    for (std::size_t e = 0; e < dec.edges.size(); ++e) {
      const auto& [from, to] = std::pair(dec.edges[EdgeId(e)].from.index, dec.edges[EdgeId(e)].to.index);
      for (std::size_t i = 0; i < kLanes; ++i) {
        const double flux = dec.star1[EdgeId(e)] * (exact[from][i] - exact[to][i]);
        sources[from][i] -= flux, sources[to][i] += flux;
      }
    }
    const std::vector<Lanes> errors = solved(std::move(sources));
    const double sum = squared(waves, dec.star0, errors, force);
    if (by == nullptr) return sum;
    const std::vector<Lanes> lambda = solved(force);
    for (const VertexId v : mesh.vertices()) {
      const std::size_t p = v.index;
      if (points().is_given(p)) continue;
      Vec2 by_place;
      for (std::size_t i = 0; i < kLanes; ++i) {
        const double source = lambda[p][i] * waves.k2[i];
        by->star0[v] += waves.share[i] * errors[p][i] * errors[p][i] + source * exact[p][i];
        const double by_u = (source * dec.star0[v] - force[p][i]) * slope[p][i];
        by_place = by_place + by_u * Vec2{waves.x[i], waves.y[i]};
        value[p][i] += errors[p][i];
      }
      by->vertex[v] = by->vertex[v] + by_place;
    }
    for (std::size_t e = 0; e < dec.edges.size(); ++e) {
      const auto& [from, to] = std::pair(dec.edges[EdgeId(e)].from.index, dec.edges[EdgeId(e)].to.index);
      by->star1[EdgeId(e)] += by_coefficient(lambda[from], lambda[to], value[from], value[to]);
    }
    return sum;
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

  [[nodiscard]] double error(const WaveBlock& waves, Adjoint* by) const override {
    const auto& [mesh, dec, all] = subject();
    std::vector<Lanes> value(mesh.n_triangles()), slope(value.size()), sources(value.size()), force;
    for (const TriangleId t : mesh.triangles()) {
      for (std::size_t i = 0; i < kLanes; ++i) {
        const auto [sine, cosine] = waves.at(i, dec.orthocenters[t]);
        value[t.index][i] = sine, slope[t.index][i] = cosine;
      }
    }
    std::vector<EdgeWaves> on_edges(dec.edges.size());
    for (std::size_t e = 0; e < dec.edges.size(); ++e) {
      const DecEdge& edge = dec.edges[EdgeId(e)];
      on_edges[e] = edge_waves(waves, edge);
      for (std::size_t i = 0; i < kLanes; ++i) {
        const double flow = on_edges[e].flow[i], coefficient = dec.transmissibility[EdgeId(e)];
        if (edge.is_boundary()) {
          const std::size_t k = inner_triangle(edge).index;
          sources[k][i] += (edge.left.valid() ? flow : -flow) - coefficient * (value[k][i] - on_edges[e].first[i]);
        } else {
          const double flux = flow - coefficient * (value[edge.left.index][i] - value[edge.right.index][i]);
          sources[edge.left.index][i] += flux, sources[edge.right.index][i] -= flux;
        }
      }
    }
    const std::vector<Lanes> errors = solved(std::move(sources));
    const double sum = squared(waves, dec.areas, errors, force);
    if (by == nullptr) return sum;
    const std::vector<Lanes> lambda = solved(force);
    for (const TriangleId t : mesh.triangles()) {
      const std::size_t p = t.index;
      for (std::size_t i = 0; i < kLanes; ++i) {
        by->area[t] += waves.share[i] * errors[p][i] * errors[p][i];
        by->orthocenter[t] = by->orthocenter[t] - (force[p][i] * slope[p][i]) * Vec2{waves.x[i], waves.y[i]};
        value[p][i] += errors[p][i];
      }
    }
    for (std::size_t e = 0; e < dec.edges.size(); ++e) add_edge(EdgeId(e), waves, on_edges[e], value, lambda, *by);
    return sum;
  }

 private:
  /// The waves on an edge. On the boundary: value and slope at the weighted midpoint. Inside: ∫ f (1 − t) and ∫ f t,
  /// t from 0 to 1.
  struct EdgeWaves {
    Lanes flow;  // ∫ ∇u · n, n to its left
    Lanes first, second;
  };
  [[nodiscard]] EdgeWaves edge_waves(const WaveBlock& waves, const DecEdge& edge) const {
    const Vec2 a = subject().mesh.position(edge.from), e = subject().mesh.position(edge.to) - a, middle = a + 0.5 * e;
    EdgeWaves result;
    for (std::size_t i = 0; i < kLanes; ++i) {
      const auto [sine, cosine] = waves.at(i, middle);
      const SegmentMeans means(0.5 * (waves.x[i] * e.x + waves.y[i] * e.y));
      result.flow[i] = (waves.y[i] * e.x - waves.x[i] * e.y) * cosine * means.even;
      const double half = 0.5 * waves.k2[i];
      result.first[i] = half * (sine * means.even - cosine * means.odd);
      result.second[i] = half * (sine * means.even + cosine * means.odd);
      if (!edge.is_boundary()) continue;
      const auto [value, slope] = waves.at(i, edge.midpoint);
      result.first[i] = value, result.second[i] = slope;
    }
    return result;
  }

  void add_edge(EdgeId id, const WaveBlock& waves, const EdgeWaves& on, const std::vector<Lanes>& value,
                const std::vector<Lanes>& lambda, Adjoint& by) const {
    const auto& [mesh, dec, all] = subject();
    const DecEdge& edge = dec.edges[id];
    const Vec2 e = mesh.position(edge.to) - mesh.position(edge.from);
    if (edge.is_boundary()) {
      const std::size_t k = inner_triangle(edge).index;
      by.transmissibility[id] += by_coefficient(lambda[k], {}, value[k], on.first);
      for (std::size_t i = 0; i < kLanes; ++i) {
        const double along = (waves.x[i] * e.x + waves.y[i] * e.y) / edge.length;
        by.crossing[id] += lambda[k][i] * dec.transmissibility[id] * on.second[i] * along;
      }
      return;
    }
    const std::size_t left = edge.left.index, right = edge.right.index;
    by.transmissibility[id] += by_coefficient(lambda[left], lambda[right], value[left], value[right]);
    // ∫ f over the triangle on the left grows by f times the way if the edge moves to the right.
    double at_from = 0, at_to = 0;
    for (std::size_t i = 0; i < kLanes; ++i) {
      at_from += (lambda[left][i] - lambda[right][i]) * on.first[i];
      at_to += (lambda[left][i] - lambda[right][i]) * on.second[i];
    }
    by.vertex[edge.from] = by.vertex[edge.from] + at_from * Vec2{e.y, -e.x};
    by.vertex[edge.to] = by.vertex[edge.to] + at_to * Vec2{e.y, -e.x};
  }
};

// --- the model -------------------------------------------------------------------------------------------------------

/// The waves of all blocks, in the units of a mesh. The directions of one block are halfway between those of the other.
std::vector<WaveBlock> waves_of(const FieldFrame& frame, double area) {
  constexpr std::size_t kBlocks = std::size(kWaveNumbers);
  std::vector<WaveBlock> blocks(kBlocks);
  for (std::size_t b = 0; b < kBlocks; ++b) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      const std::size_t direction = 2 * (i / 2 * kBlocks + b) + 1;
      const auto [sine, cosine] =
          sine_cosine(std::numbers::pi * static_cast<double>(direction) / (2 * kBlocks * kDirections));
      const double in_frame = kWaveNumbers[b], number = in_frame / frame.half_size;
      const Vec2 k = number * Vec2{cosine, sine};
      blocks[b].x[i] = k.x, blocks[b].y[i] = k.y;
      blocks[b].phase[i] = (i % 2 == 0 ? 0 : std::numbers::pi / 2) - dot(k, frame.center);
      blocks[b].k2[i] = number * number;
      blocks[b].share[i] = 2 / (area * in_frame * in_frame * in_frame * in_frame * kBlocks * kLanes);
    }
  }
  return blocks;
}

/// Matrices that the measurement of one mesh leaves to the next, whose connectivity is mostly the same.
struct Matrices {
  Cholesky at_vertices, in_cells;
};

/// Lends the last matrices, or new ones while they are lent.
class LastMatrices {
 public:
  [[nodiscard]] auto take() {
    const std::lock_guard lock(mutex_);
    const auto give_back = [this](Matrices* m) {
      const std::lock_guard here(mutex_);
      last_.reset(m);
    };
    return std::unique_ptr<Matrices, decltype(give_back)>(last_ ? last_.release() : new Matrices, give_back);
  }

 private:
  std::mutex mutex_;
  std::unique_ptr<Matrices> last_;
};

class SolverErrorModel final : public DiscretizationError {
 public:
  explicit SolverErrorModel(Scheme scheme) : scheme_(scheme) {}

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
      errors.push_back(mean_error(*solver, subject, by ? &*by : nullptr, executor));
      if (by) gradients->push_back(pulled_back(mesh, subject.dec, *by));
    }
    return errors;
  }

  [[nodiscard]] ErrorSubject subject_of(const Mesh& mesh) const {
    ErrorSubject subject{mesh, dec_operators(mesh), {}};
    double area = 0;
    for (const double of_triangle : subject.dec.areas) area += of_triangle;
    subject.waves = waves_of(field_frame(mesh), area);
    return subject;
  }

  /// The sum over all waves, and over their derivatives, in an order independent of the number of threads.
  static double mean_error(const Solver& solver, const ErrorSubject& subject, Adjoint* by, Executor* executor) {
    const std::vector<WaveBlock>& waves = subject.waves;
    std::vector<double> sums(waves.size(), 0.0);
    std::vector<std::optional<Adjoint>> parts(by != nullptr ? waves.size() : 0);
    or_serial(executor).run(waves.size(), [&](std::size_t block) {
      Adjoint* part = by != nullptr ? &parts[block].emplace(subject.mesh, subject.dec) : nullptr;
      sums[block] = solver.error(waves[block], part);
    });
    double sum = 0;
    for (const double part : sums) sum += part;
    for (const std::optional<Adjoint>& part : parts) by->add(*part);
    return sum;
  }

  Scheme scheme_;
  mutable LastMatrices last_;
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
  return std::shared_ptr<const DiscretizationError>(std::make_shared<error_detail::SolverErrorModel>(options.scheme));
}

}  // namespace temper
