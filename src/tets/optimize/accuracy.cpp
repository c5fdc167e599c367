#include "tets/optimize/accuracy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/cube_root.hpp"
#include "base/portable_log.hpp"
#include "tets/energy/star.hpp"

namespace temper::tets {
namespace {

// Floors: the margin ε, or this part of a smaller one. A larger part keeps repaired tetrahedra in the way: on a cube,
// 0.2 leaves an error of 1.12 where 0.01 leaves 1.03.
constexpr double kMargin = 0.02, kFloorOfMargin = 0.01;
constexpr double kBarrier = 0.005;  // μ
constexpr double kOffsetShare = 3;  // κ
constexpr int kSmoothings = 10;
// As in the plane (optimize/solver_error/solver_error_phase.cpp).
constexpr double kLongestStep = 0.3, kKeptRoom = 0.2, kArmijo = 1e-4;
constexpr int kMostHalvings = 25;
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
      sizes_(local_sizes(mesh)),
      floors_(mesh.n_tetrahedra()) {
  for (const TetId t : mesh.tetrahedra()) {
    const double margin = is_good(mesh, t) ? least_height(mesh, t) : 0;
    floors_[t] = margin > kLeastMargin ? std::min(kMargin, kFloorOfMargin * margin) : AccuracyEnergy::kNoFloor;
    if (floors_[t] != AccuracyEnergy::kNoFloor) continue;
    for (const VertexId v : mesh.corners(t)) mobility_[v] = Mobility::none;
  }
  energy_ = AccuracyEnergy(mesh, sizes_, floors_, model);
  now_ = total();
}

Accuracy::Total Accuracy::total() const {
  Total result;
  result.lowered = result.measure = HUGE_VAL;
  Gradient of_error(mesh_.n_vertices()), of_energy;
  const double error = error_ != nullptr ? error_->squared_error(mesh_, &of_error) : 1;
  const auto [offsets, barrier] = energy_.of(mesh_, &of_energy, executor_);
  const double sum = offsets + barrier;
  if (!(error > 0 && std::isfinite(error) && sum > 0 && std::isfinite(sum))) return result;
  result.measure = error_ != nullptr ? std::sqrt(error) : offsets;
  result.lowered = portable_log(error) + kOffsetShare * portable_log(sum);
  result.gradient.resize(4 * mesh_.n_vertices());
  const double by_error = 1 / error, by_sum = kOffsetShare / sum;
  for (const VertexId v : mesh_.vertices()) {
    double* to = &result.gradient[4 * std::size_t{v.index}];
    const double s = sizes_[v];
    if (mobility_[v].moves()) {
      const Vec3 at = mobility_[v].allowed(by_error * of_error[v].position() + by_sum * of_energy[v].position());
      to[0] = s * at.x, to[1] = s * at.y, to[2] = s * at.z;
    }
    if (mobility_[v].weighs) to[3] = s * s * (by_error * of_error[v].w + by_sum * of_energy[v].w);
  }
  return result;
}

void Accuracy::place(const IdVector<VertexId, WeightedPoint>& from, const Descent::Vector& step, double t) {
  for (const VertexId v : mesh_.vertices()) {
    const double *by = &step[4 * std::size_t{v.index}], s = sizes_[v];
    WeightedPoint p = from[v];
    const Vec3 move = mobility_[v].allowed({t * s * by[0], t * s * by[1], t * s * by[2]});
    if (mobility_[v].moves()) p.x += move.x, p.y += move.y, p.z += move.z;
    if (mobility_[v].weighs) p.w += t * s * s * by[3];
    mesh_.set_point(v, t != 0 && is_exact(p) ? p : from[v]);
  }
}

/// Shortens the step of each vertex so far that its tetrahedra keep a part of their margin: one of them would else end
/// the way of all vertices.
void Accuracy::shorten(const IdVector<VertexId, WeightedPoint>& from, Descent::Vector& step) {
  const auto scale = [&step](VertexId v, double factor) {
    for (std::size_t i = 0; i < 4; ++i) step[4 * std::size_t{v.index} + i] *= factor;
  };
  for (const VertexId v : mesh_.vertices()) {
    double most = 0;
    for (std::size_t i = 0; i < 4; ++i) most = std::max(most, std::abs(step[4 * std::size_t{v.index} + i]));
    if (most > kLongestStep) scale(v, kLongestStep / most);
  }
  const auto room = [this](TetId t) { return least_height(mesh_, t) - floors_[t]; };
  std::vector<double> least;
  least.reserve(mesh_.n_tetrahedra());
  for (const TetId t : mesh_.tetrahedra()) least.push_back(kKeptRoom * room(t));
  for (int i = 0; i < kMostHalvings; ++i) {
    place(from, step, 1);
    IdVector<VertexId, std::uint8_t> is_short(mesh_.n_vertices());
    bool any = false;
    for (const TetId t : mesh_.tetrahedra()) {
      if (room(t) >= least[t.index]) continue;
      for (const VertexId v : mesh_.corners(t)) is_short[v] = 1;
      any = true;
    }
    if (!any) return;
    for (const VertexId v : mesh_.vertices()) {
      if (is_short[v] != 0) scale(v, 0.5);
    }
  }
}

bool Accuracy::is_valid() const {
  const auto all = mesh_.tetrahedra();
  return std::all_of(all.begin(), all.end(),
                     [this](TetId t) { return floors_[t] == AccuracyEnergy::kNoFloor || is_good(mesh_, t); });
}

bool Accuracy::descend(const MustStop& must_stop) {
  if (!std::isfinite(now_.lowered)) return false;
  if (lowered_.size() > kStepsToGain && lowered_.end()[-1 - std::ptrdiff_t(kStepsToGain)] - now_.lowered < kLeastGain)
    return false;
  IdVector<VertexId, WeightedPoint> before(mesh_.n_vertices());
  for (const VertexId v : mesh_.vertices()) before[v] = mesh_.point(v);
  for (;;) {
    Descent::Vector step = descent_.direction(now_.gradient);
    shorten(before, step);
    const double slope = temper::dot(now_.gradient, step);
    double t = 1;
    for (int i = 0; i < kMostHalvings && slope < 0; ++i, t *= 0.5) {
      if (must_stop(0)) {
        place(before, step, 0);
        return false;
      }
      place(before, step, t);
      if (!is_valid()) continue;
      Total there = total();
      if (!(there.lowered <= now_.lowered + kArmijo * t * slope)) continue;
      Descent::Vector change = there.gradient;
      for (std::size_t k = 0; k < change.size(); ++k) change[k] -= now_.gradient[k], step[k] *= t;
      descent_.learn(std::move(step), std::move(change));
      now_ = std::move(there);
      lowered_.push_back(now_.lowered);
      return true;
    }
    place(before, step, 0);
    if (descent_.knows_nothing()) return false;
    descent_.forget();
  }
}

}  // namespace temper::tets
