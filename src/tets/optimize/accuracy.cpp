#include "tets/optimize/accuracy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/cube_root.hpp"
#include "base/loops.hpp"
#include "base/portable_log.hpp"
#include "tets/quality/duals.hpp"
#include "tets/quality/measure.hpp"

namespace temper::tets {
namespace {

// Floors: the margin ε, or this part of a smaller one. A larger part keeps repaired tetrahedra in the way: on a cube,
// 0.2 leaves an error of 1.12 where 0.01 leaves 1.03.
constexpr double kMargin = 0.02, kFloorOfMargin = 0.01;
constexpr double kMostOfMargin = 0.9;  // of a margin that is to stay
constexpr double kBarrier = 0.005;     // μ
constexpr double kOffsetShare = 3;     // κ
constexpr int kSmoothings = 10;
// The phase ends if kStepsToGain steps lower the sum by less than kLeastDecrease.
constexpr std::size_t kStepsToGain = 20;
constexpr double kLeastDecrease = 2e-3;
// Below, the margin is not certain in doubles.
constexpr double kLeastMargin = 1e-9;
// A cosine beyond the limit may grow by this, a fiftieth of a degree: with less its corners end the way of all.
constexpr double kRoomOfCosine = 1e-4;

[[nodiscard]] WeightedPoint operator*(double f, const WeightedPoint& p) { return {f * p.x, f * p.y, f * p.z, f * p.w}; }
[[nodiscard]] WeightedPoint operator+(const WeightedPoint& a, const WeightedPoint& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w};
}

}  // namespace

double AccuracyErrors::mean_ratio(const std::vector<double>& errors) const {
  double product = 1;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    for (int k = 0; k < count(i); ++k) product *= errors[i] / unit[i];
  }
  const double root = std::sqrt(product);
  return counts() == 3 ? cube_root(root) : counts() == 2 ? std::sqrt(root) : root;
}

AccuracyModel accuracy_model(Scheme scheme) {
  // Vertex-centered: no flux passes the duals of boundary edges. Cells: the first flux passes the boundary faces.
  switch (scheme) {
    case Scheme::vertex:
      return {1, 0.03, 0, 0, kBarrier};
    case Scheme::cell:
      return {0, 0, 1, 3, kBarrier};
    default:
      return {1, 0.03, 1, 3, kBarrier};
  }
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
                   const AccuracyLimits& limits, AccuracyErrors errors, Executor* executor)
    : mesh_(mesh),
      mobility_(std::move(mobility)),
      criterion_(limits.criterion),
      errors_(std::move(errors)),
      executor_(executor),
      before_(mesh.n_vertices()),
      sizes_(local_sizes(mesh)),
      floors_(mesh.n_halffaces()),
      most_cosine_(mesh.n_tetrahedra()) {
  for (const HalffaceId h : mesh.halffaces()) {
    const double height = keeps_criterion(h) ? height_that_counts(mesh, h, criterion_) : 0;
    const double floor =
        std::max(std::min(kMargin, kFloorOfMargin * height), std::min(limits.margin, kMostOfMargin * height));
    floors_[h] = height > kLeastMargin ? floor : AccuracyEnergy::kNoFloor;
  }
  energy_ = AccuracyEnergy(mesh, sizes_, floors_, model, criterion_);
  const auto keep = [this](VertexId v) { mobility_[v] = Mobility::none; };
  for (const TetId t : mesh.tetrahedra()) {
    bool stays = energy_.leaves_out_part_of(t);
    for (int f = 0; f < 4; ++f) {
      const HalffaceId h = TetMesh::halfface(t, f);
      if (floors_[h] != AccuracyEnergy::kNoFloor) continue;
      stays = true;
      if (has_joined_sides(mesh, h, criterion_)) keep(mesh.opposite(mesh.twin(h)));
    }
    if (stays) std::for_each(mesh.corners(t).begin(), mesh.corners(t).end(), keep);
    most_cosine_[t] = std::max(limits.most_cosine, largest_dihedral_cosine(mesh, t) + kRoomOfCosine);
  }
  now_ = value();
}

bool Accuracy::keeps_criterion(HalffaceId h) const {
  return (has_joined_sides(mesh_, h, criterion_) ? dual_sign(mesh_, h) : height_sign(mesh_, h)) == Sign::positive;
}

double Accuracy::room(std::size_t tetrahedron) const {
  const TetId t(tetrahedron);
  double least = most_cosine_[t] - largest_dihedral_cosine(mesh_, t);
  for (int f = 0; f < 4; ++f) {
    const HalffaceId h = TetMesh::halfface(t, f);
    if (floors_[h] == AccuracyEnergy::kNoFloor) continue;
    least = std::min(least, height_that_counts(mesh_, h, criterion_) - floors_[h]);
  }
  return least;
}

Accuracy::Value Accuracy::value() const {
  Value result;
  result.lowered = result.measure = HUGE_VAL;
  std::vector<Gradient> of_errors;
  const std::vector<double> errors =
      errors_.model ? errors_.model->errors(mesh_, &of_errors, executor_) : std::vector<double>{};
  if (errors.size() != errors_.unit.size()) return result;
  Gradient slopes;
  const auto [offsets, barrier] = energy_.of(mesh_, &slopes, executor_);
  const double sum = offsets + barrier;
  const double mean = errors_.mean_ratio(errors);
  if (!(sum > 0 && mean > 0 && std::isfinite(sum) && std::isfinite(mean))) return result;
  result.lowered = 2 * portable_log(mean) + kOffsetShare * portable_log(sum);
  result.measure = errors_.model ? mean : offsets;
  const int counts = errors_.counts();
  for (const VertexId v : mesh_.vertices()) {
    slopes[v] = kOffsetShare / sum * slopes[v];
    for (std::size_t i = 0; i < errors.size(); ++i)
      slopes[v] = slopes[v] + errors_.count(i) / (counts * errors[i]) * of_errors[i][v];
  }
  result.gradient.resize(kUnknowns * mesh_.n_vertices());
  for (const VertexId v : mesh_.vertices()) {
    double* to = &result.gradient[kUnknowns * v.index];
    const double s = sizes_[v];
    if (mobility_[v].moves()) {
      const Vec3 at = mobility_[v].allowed(slopes[v].position());
      to[0] = s * at.x, to[1] = s * at.y, to[2] = s * at.z;
    }
    if (mobility_[v].weighs) to[3] = s * s * slopes[v].w;
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
  const auto is_kept = [this](TetId t) {
    const auto [p, q, r, s] = mesh_.points(t);
    if (orientation(p.position(), q.position(), r.position(), s.position()) != Sign::positive) return false;
    for (int f = 0; f < 4; ++f) {
      const HalffaceId h = TetMesh::halfface(t, f);
      if (floors_[h] != AccuracyEnergy::kNoFloor && !keeps_criterion(h)) return false;
    }
    return largest_dihedral_cosine(mesh_, t) <= most_cosine_[t];
  };
  const auto all = mesh_.tetrahedra();
  return std::all_of(all.begin(), all.end(), is_kept);
}

bool Accuracy::descend(const MustStop& must_stop) {
  if (!std::isfinite(now_.lowered)) return false;
  if (lowered_.size() > kStepsToGain &&
      lowered_.end()[-1 - std::ptrdiff_t(kStepsToGain)] - now_.lowered < kLeastDecrease)
    return false;
  for (const VertexId v : mesh_.vertices()) before_[v] = mesh_.point(v);
  Descent::Outcome outcome = Descent::Outcome::none;
  do {
    outcome = descent_.take_step(*this, now_, executor_, [&must_stop] { return must_stop(0); });
  } while (outcome == Descent::Outcome::none);
  if (outcome == Descent::Outcome::taken) lowered_.push_back(now_.lowered);
  return outcome == Descent::Outcome::taken;
}

}  // namespace temper::tets
