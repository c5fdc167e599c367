#include "tets/optimize/accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/portable_log.hpp"
#include "tets/energy/star.hpp"
#include "tets/optimize/valid_step.hpp"

namespace temper::tets {
namespace {

constexpr double kMargin = 0.02, kFloorOfMargin = 0.2;  // floors: the margin ε, or this part of a smaller one
constexpr double kBarrier = 0.001;                      // μ
constexpr double kOffsetShare = 3;                      // κ
constexpr int kSmoothings = 10;
// Of the steps over all vertices, as in the plane (optimize/solver_error/solver_error_phase.cpp).
constexpr double kLongestStep = 0.3, kKeptRoom = 0.2, kArmijo = 1e-4;
constexpr int kMostHalvings = 25;

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
  for (const VertexId v : mesh.vertices()) sizes[v] = std::cbrt(std::sqrt(2.0) * sizes[v] / count[v]);
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

Accuracy::Accuracy(TetMesh& mesh, IdVector<VertexId, Mobility> mobility, const AccuracyModel& model)
    : mesh_(mesh),
      mobility_(std::move(mobility)),
      model_(model),
      domain_{local_sizes(mesh), IdVector<TetId, double>(mesh.n_tetrahedra())} {
  for (const TetId t : mesh.tetrahedra()) {
    domain_.floors[t] = std::min(kMargin, kFloorOfMargin * least_height(mesh, t));
    if (is_good(mesh, t)) continue;
    for (const VertexId v : mesh.corners(t)) mobility_[v] = Mobility::none;
  }
}

void Accuracy::gather(VertexId v) {
  collect_link(mesh_, v, link_);
  star_.gather(mesh_, v, link_, domain_, model_);
}

void Accuracy::improve(VertexId v, double relaxation) {
  if (mobility_[v] == Mobility::none) return;
  gather(v);
  take_valid_step(mesh_, v, link_, star_, mobility_[v], domain_.sizes[v], relaxation);
}

AccuracyTotal Accuracy::energy() {
  AccuracyTotal sum;
  for (const VertexId v : mesh_.vertices()) {
    gather(v);
    const AccuracyTotal own = star_.own(mesh_.point(v));
    sum.energy += own.energy;
    sum.barrier += own.barrier;
  }
  return sum;
}

void Accuracy::find_scales() {
  const auto [offsets, barrier] = energy();
  scales_.resize(mesh_.n_vertices());
  for (const VertexId v : mesh_.vertices()) {
    gather(v);
    const auto h = star_.derivatives(mesh_.point(v)).hessian;
    const double s = domain_.sizes[v], share = kOffsetShare / (offsets + barrier);
    const auto scale = [&](double size, double curvature) {
      return size / std::sqrt(1 + share * size * size * curvature);
    };
    auto& [x, y, z, w] = scales_[v] = {scale(s, h.xx), scale(s, h.yy), scale(s, h.zz), scale(s * s, h.ww)};
    if (mobility_[v].slides()) x = y = z = std::min({x, y, z});  // along any direction
  }
}

Accuracy::Total Accuracy::total(const DiscretizationError& model) {
  Total result;
  result.lowered = result.error = HUGE_VAL;
  IdVector<VertexId, WeightedPoint> gradient(mesh_.n_vertices());
  const double error = model.squared_error(mesh_, &gradient);
  const auto [offsets, barrier] = energy();
  const double sum = offsets + barrier;
  if (!std::isfinite(error) || !std::isfinite(sum)) return result;
  result.error = error;
  result.lowered = portable_log(error) + kOffsetShare * portable_log(sum);
  result.gradient.resize(4 * mesh_.n_vertices());
  for (const VertexId v : mesh_.vertices()) {
    const Mobility& mobility = mobility_[v];
    if (mobility == Mobility::none) continue;
    gather(v);
    const auto [g, g_w] = star_.derivatives(mesh_.point(v)).gradient;
    const double of_error = 1 / error, of_sum = kOffsetShare / sum;
    const Vec3 at = mobility.allowed(of_error * gradient[v].position() + of_sum * Vec3{g.x, g.y, g.z});
    const std::array<double, 4> by = {at.x, at.y, at.z, of_error * gradient[v].w + of_sum * g_w};
    for (std::size_t i = mobility.moves() ? 0 : 3; i < (mobility.weighs ? 4 : 3); ++i)
      result.gradient[4 * std::size_t{v.index} + i] = scales_[v][i] * by[i];
  }
  return result;
}

void Accuracy::place(const IdVector<VertexId, WeightedPoint>& from, const Descent::Vector& step, double t) {
  for (const VertexId v : mesh_.vertices()) {
    const double* by = &step[4 * std::size_t{v.index}];
    const auto& scale = scales_[v];
    WeightedPoint p = from[v];
    const Vec3 move = mobility_[v].allowed({t * scale[0] * by[0], t * scale[1] * by[1], t * scale[2] * by[2]});
    if (mobility_[v].moves()) p.x += move.x, p.y += move.y, p.z += move.z;
    if (mobility_[v].weighs) p.w += t * scale[3] * by[3];
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
  const auto room = [this](TetId t) { return least_height(mesh_, t) - domain_.floors[t]; };
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

bool Accuracy::descend(const DiscretizationError& model, const std::function<bool()>& must_stop) {
  if (!std::exchange(has_begun_, true)) {
    find_scales();
    now_ = total(model);
  }
  if (!std::isfinite(now_.lowered) || !(now_.error > 0)) return false;
  IdVector<VertexId, WeightedPoint> before(mesh_.n_vertices());
  for (const VertexId v : mesh_.vertices()) before[v] = mesh_.point(v);
  for (;;) {
    Descent::Vector step = descent_.direction(now_.gradient);
    shorten(before, step);
    const double slope = temper::dot(now_.gradient, step);
    double t = 1;
    for (int i = 0; i < kMostHalvings && slope < 0; ++i, t *= 0.5) {
      if (must_stop()) {
        place(before, step, 0);
        return false;
      }
      place(before, step, t);
      const auto all = mesh_.tetrahedra();
      if (!std::all_of(all.begin(), all.end(), [this](TetId tet) { return is_good(mesh_, tet); })) continue;
      Total there = total(model);
      if (!(there.lowered <= now_.lowered + kArmijo * t * slope)) continue;
      Descent::Vector change = there.gradient;
      for (std::size_t k = 0; k < change.size(); ++k) change[k] -= now_.gradient[k], step[k] *= t;
      descent_.learn(std::move(step), std::move(change));
      now_ = std::move(there);
      return true;
    }
    place(before, step, 0);
    if (descent_.knows_nothing()) return false;
    descent_.forget();
  }
}

}  // namespace temper::tets
