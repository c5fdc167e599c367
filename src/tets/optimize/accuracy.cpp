#include "tets/optimize/accuracy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/cube_root.hpp"

namespace temper::tets {
namespace {

// Floors: the margin ε, or this part of a smaller one. A larger part keeps repaired tetrahedra in the way: on a cube,
// 0.2 leaves an error of 1.12 where 0.01 leaves 1.03.
constexpr double kMargin = 0.02, kFloorOfMargin = 0.01;
constexpr double kBarrier = 0.005;  // μ
constexpr double kOffsetShare = 3;  // κ
constexpr int kSmoothings = 10;
// The phase ends if kStepsToGain steps lower the sum by less than kLeastGain.
constexpr std::size_t kStepsToGain = 20;
constexpr double kLeastGain = 1e-3;
// Below, the margin is not certain in doubles.
constexpr double kLeastMargin = 1e-9;

}  // namespace

AccuracyModel accuracy_model(Scheme scheme) {
  // Vertex-centered: no flux passes the duals of boundary edges. Cells: the first flux passes the boundary faces.
  return scheme == Scheme::cell ? AccuracyModel{0, 0, 1, 3, kBarrier} : AccuracyModel{1, 0.03, 0, 0, kBarrier};
}

VertexSizes local_sizes(const TetMesh& mesh) {
  VertexSizes sizes(mesh.n_vertices()), count(mesh.n_vertices());
  for (const TetId t : mesh.tetrahedra()) {
    const auto [p, q, r, s] = mesh.points(t);
    const double volume6 = six_volumes(p.position(), q.position(), r.position(), s.position());
    for (const VertexId v : mesh.corners(t)) sizes[v] += volume6, count[v] += 1;
  }
  for (const VertexId v : mesh.vertices()) sizes[v] = cube_root(std::sqrt(2.0) * sizes[v] / count[v]);
  for (int k = 0; k < kSmoothings; ++k) {
    VertexSizes sum(mesh.n_vertices());
    for (const TetId t : mesh.tetrahedra()) {
      const auto& [a, b, c, d] = mesh.corners(t);
      const double mean = (sizes[a] + sizes[b] + sizes[c] + sizes[d]) / 4;
      for (const VertexId v : mesh.corners(t)) sum[v] += mean;
    }
    for (const VertexId v : mesh.vertices()) sizes[v] = sum[v] / count[v];
  }
  return sizes;
}

Accuracy::Accuracy(TetMesh& mesh, IdVector<VertexId, Mobility> mobility, const AccuracyModel& model,
                   const DiscretizationError* error, Executor* executor)
    : mesh_(mesh),
      mobility_(std::move(mobility)),
      error_(error),
      executor_(executor),
      before_(mesh.n_vertices()),
      sizes_(local_sizes(mesh)),
      floors_(mesh.n_tetrahedra()) {
  for (const TetId t : mesh.tetrahedra()) {
    const double margin = is_good(mesh, t) ? least_height(mesh, t) : 0;
    floors_[t] = margin > kLeastMargin ? std::min(kMargin, kFloorOfMargin * margin) : AccuracyEnergy::kNoFloor;
    if (floors_[t] != AccuracyEnergy::kNoFloor) continue;
    for (const VertexId v : mesh.corners(t)) mobility_[v] = Mobility::none;
  }
  energy_ = AccuracyEnergy(mesh, sizes_, floors_, model);
  now_ = value();
}

Accuracy::Value Accuracy::value() const {
  Value result;
  result.lowered = result.measure = HUGE_VAL;
  std::vector<Gradient> of_errors;
  const std::vector<double> errors = error_ ? error_->errors(mesh_, &of_errors, executor_) : std::vector{1.0};
  if (!error_) of_errors.emplace_back(mesh_.n_vertices());
  Gradient of_energy;
  const auto [offsets, barrier] = energy_.of(mesh_, &of_energy, executor_);
  const double sum = offsets + barrier;
  if (errors.empty() || !(errors[0] > 0 && std::isfinite(errors[0]) && sum > 0 && std::isfinite(sum))) return result;
  result.measure = error_ ? std::sqrt(errors[0]) : offsets;
  const LogObjective objective = log_objective(errors, {1}, sum, kOffsetShare);
  result.lowered = objective.value;
  result.gradient.resize(kUnknowns * mesh_.n_vertices());
  const double by_error = objective.by_error[0], by_sum = objective.by_total;
  for (const VertexId v : mesh_.vertices()) {
    double* to = &result.gradient[kUnknowns * v.index];
    const double s = sizes_[v];
    const WeightedPoint &of_error = of_errors[0][v], &of_sum = of_energy[v];
    if (mobility_[v].moves()) {
      const Vec3 at = mobility_[v].allowed(by_error * of_error.position() + by_sum * of_sum.position());
      to[0] = s * at.x, to[1] = s * at.y, to[2] = s * at.z;
    }
    if (mobility_[v].weighs) to[3] = s * s * (by_error * of_error.w + by_sum * of_sum.w);
  }
  return result;
}

void Accuracy::place(const Descent::Vector& step, double t) {
  for (const VertexId v : mesh_.vertices()) {
    const double *by = &step[kUnknowns * v.index], s = sizes_[v];
    WeightedPoint p = before_[v];
    const Vec3 move = mobility_[v].allowed({t * s * by[0], t * s * by[1], t * s * by[2]});
    if (mobility_[v].moves()) p.x += move.x, p.y += move.y, p.z += move.z;
    if (mobility_[v].weighs) p.w += t * s * s * by[3];
    mesh_.set_point(v, t != 0 && is_exact(p) ? p : before_[v]);
  }
}

bool Accuracy::is_inside() const {
  const auto all = mesh_.tetrahedra();
  return std::all_of(all.begin(), all.end(),
                     [this](TetId t) { return floors_[t] == AccuracyEnergy::kNoFloor || is_good(mesh_, t); });
}

bool Accuracy::descend(const MustStop& must_stop) {
  if (!std::isfinite(now_.lowered)) return false;
  if (lowered_.size() > kStepsToGain && lowered_.end()[-1 - std::ptrdiff_t(kStepsToGain)] - now_.lowered < kLeastGain)
    return false;
  for (const VertexId v : mesh_.vertices()) before_[v] = mesh_.point(v);
  Descent::Outcome outcome;
  do {
    outcome = descent_.take_step(*this, now_, executor_, [&must_stop] { return must_stop(0); });
  } while (outcome == Descent::Outcome::none);
  if (outcome == Descent::Outcome::taken) lowered_.push_back(now_.lowered);
  return outcome == Descent::Outcome::taken;
}

}  // namespace temper::tets
