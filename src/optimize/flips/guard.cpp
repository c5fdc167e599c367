#include "optimize/flips/guard.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/sum.hpp"
#include "geometry/surface.hpp"
#include "mesh/blocks.hpp"
#include "optimize/working/working_copy.hpp"

namespace temper {
namespace {

constexpr double kGravity = 9.81;
// Values in the user's units differ by rounding from those in the units of the run.
constexpr double kRounding = 1e-9;
// A map from degrees changes the areas of neighbors by up to a few thousandths, each in its own way.
constexpr double kMargin = 1.005;

}  // namespace

void GuardValues::take(const GuardValues& other) {
  for (std::size_t i = 0; i < kMeasures; ++i) value[i] = std::min(value[i], other.value[i]);
}

/// Values that are infinite before hold only within the limits.
bool GuardValues::hold(const GuardValues& before, const GuardValues& limits) const {
  for (std::size_t i = 0; i < kMeasures; ++i) {
    if (value[i] < before.value[i] && value[i] < limits.value[i]) return false;
  }
  return true;
}

Guard::Guard(const Mesh& mesh, const WorkingUnits& units, std::shared_ptr<const GuardLimits> limits)
    : mesh_(mesh), units_(units), limits_(std::move(limits)) {
  grow();
}

double Guard::depth_at(const WeightedPoint& p) {
  const SizeField::Sample sample = limits_->depth->at(units_.to_user(p), near_);
  near_ = sample.triangle;
  return sample.size;
}

Guard::Triangle Guard::triangle(const Corners& corners, bool of_plan) const {
  const auto is_there = [&](VertexId v) { return of_plan && v == moving_; };
  const WeightedPoint first = is_there(corners[0]) ? place_ : mesh_.point(corners[0]);
  Triangle t;
  std::array<Vec3, 3> x;
  for (std::size_t k = 0; k < 3; ++k) {
    const VertexId v = corners[k];
    const WeightedPoint p = is_there(v) ? mesh_.space().image(place_, first) : mesh_.point(v, first);
    x[k] = position_in_space(mesh_.space(), p);
    if (has_depth()) t.depth += (is_there(v) ? there_ : depth_[v]) / 3;
  }
  for (std::size_t k = 0; k < 3; ++k) t.l2[k] = squared_length(x[(k + 1) % 3] - x[k]);
  const Vec3 normal = cross(x[1] - x[0], x[2] - x[0]);
  t.doubled_area = mesh_.space().is_plane() ? normal.z : length(normal);
  return t;
}

GuardValues Guard::alone(const Triangle& t) const {
  const auto [least, most] = std::minmax({t.l2[0], t.l2[1], t.l2[2]});
  const double middle = t.l2[0] + t.l2[1] + t.l2[2] - least - most;
  GuardValues v;
  v.value[GuardValues::sine] = t.doubled_area / std::sqrt(middle * most);
  if (!has_depth()) return v;
  const double slowness = units_.scale / std::sqrt(kGravity * t.depth);
  v.value[GuardValues::crossing] = slowness * t.doubled_area / std::sqrt(most);
  v.value[GuardValues::edge_crossing] = slowness * std::sqrt(least);
  return v;
}

GuardValues Guard::of_pair(const Triangle& s, const Triangle& t, double l2) {
  const auto [less, more] = std::minmax(s.doubled_area, t.doubled_area);
  GuardValues v;
  v.value[GuardValues::areas] = less / more;
  v.value[GuardValues::edge] = std::numbers::sqrt3 * l2 / (s.doubled_area + t.doubled_area);
  return v;
}

GuardValues Guard::around(TriangleId t, std::span<const TriangleId> except) const {
  const Triangle shape = triangle(t);
  GuardValues v = alone(shape);
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId across = mesh_.twin(Mesh::halfedge(t, k));
    if (!across.valid() || std::ranges::find(except, Mesh::triangle(across)) != except.end()) continue;
    v.take(of_pair(shape, triangle(Mesh::triangle(across)), shape.l2[static_cast<std::size_t>(k)]));
  }
  return v;
}

/// `fresh` replace `old`: both fill the same place. Most changes are within the limits, whatever was before. Pairs are
/// old ones, fresh ones, and each with the triangles outside.
bool Guard::allows(std::span<const TriangleId> old, std::span<const Corners> fresh) {
  GuardValues after;
  shapes_.clear();
  for (const Corners& corners : fresh) {
    shapes_.push_back(triangle(corners, true));
    after.take(alone(shapes_.back()));
  }
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = fresh[i][k], b = fresh[i][(k + 1) % 3];
      bool inside = false;
      for (std::size_t j = 0; j < fresh.size() && !inside; ++j) {
        for (std::size_t m = 0; m < 3 && !inside; ++m) {
          inside = fresh[j][m] == b && fresh[j][(m + 1) % 3] == a;
        }
        if (inside && i < j) after.take(of_pair(shapes_[i], shapes_[j], shapes_[i].l2[k]));
      }
      if (inside || !a.valid() || !b.valid()) continue;
      const HalfedgeId h = mesh_.find_halfedge(a, b);
      if (!h.valid() || mesh_.is_boundary(h)) continue;
      const TriangleId outside = Mesh::triangle(mesh_.twin(h));
      after.take(of_pair(shapes_[i], triangle(outside), shapes_[i].l2[k]));
    }
  }
  if (after.hold(GuardValues(), limits_->for_steps)) return true;
  GuardValues before;
  for (const TriangleId t : old) before.take(around(t));
  return after.hold(before, limits_->for_steps);
}

bool Guard::allows_move(VertexId v, const WeightedPoint& p) {
  moving_ = v, place_ = p;
  if (has_depth()) there_ = depth_at(p);
  old_.clear();
  fresh_.clear();
  for (const HalfedgeId h : mesh_.star(v)) {
    old_.push_back(Mesh::triangle(h));
    fresh_.push_back(mesh_.corners(old_.back()));
  }
  return allows(old_, fresh_);
}

bool Guard::allows(const RemovalPlan& plan) {
  if (!on()) return true;
  moving_ = plan.vertex;
  old_.clear();
  for (const HalfedgeId h : mesh_.star(plan.vertex)) old_.push_back(Mesh::triangle(h));
  return allows(old_, plan.triangles);
}

bool Guard::allows(const InsertionPlan& plan) {
  if (!on()) return true;
  moving_ = VertexId(), place_ = plan.point;
  if (has_depth()) there_ = depth_at(plan.point);
  fresh_.clear();
  const bool open = plan.edge.valid() && mesh_.is_boundary(plan.edge);
  for (std::size_t i = 0; i + (open ? 1 : 0) < plan.link.size(); ++i) {
    fresh_.push_back({VertexId(), plan.link[i], plan.link[(i + 1) % plan.link.size()]});
  }
  return allows(plan.cavity, fresh_);
}

void Guard::begin_flips() {
  touched_.clear();
  before_ = {};
}

/// A pair with a triangle that is touched already has been counted when that was touched, or flips have made it.
void Guard::about_to_flip(HalfedgeId h) {
  const TriangleId left = Mesh::triangle(h), right = Mesh::triangle(mesh_.twin(h));
  const std::size_t n = touched_.size();
  for (const TriangleId t : {left, right}) {
    if (std::ranges::find(touched_, t) != touched_.end()) continue;
    before_.take(around(t, std::span(touched_).first(n)));
    touched_.push_back(t);
  }
}

bool Guard::allow_flips() const {
  GuardValues after;
  for (const TriangleId t : touched_) after.take(around(t));
  return after.hold(before_, limits_->for_steps);
}

GuardValues Guard::worst(Executor* executor) const {
  const std::size_t n = mesh_.n_triangles();
  std::vector<GuardValues> of_blocks((n + kLoopBlock - 1) / kLoopBlock);
  for_blocks(n, executor, [&](std::size_t first, std::size_t last) {
    for (const TriangleId t : IdRange<TriangleId>(TriangleId(first), TriangleId(last))) {
      if (!mesh_.is_erased(t)) of_blocks[first / kLoopBlock].take(around(t));
    }
  });
  GuardValues worst;
  for (const GuardValues& v : of_blocks) worst.take(v);
  return worst;
}

GuardValues Guard::across(HalfedgeId h, const WeightedPoint& beyond) const {
  const Triangle inside = triangle(Mesh::triangle(h));
  const WeightedPoint a = mesh_.point(mesh_.origin(h)), b = mesh_.point(mesh_.target(h), a);
  const auto place = [&](const WeightedPoint& p) {
    return position_in_space(mesh_.space(), mesh_.space().image(p, a));
  };
  Triangle outside;
  outside.doubled_area = length(cross(place(b) - place(a), place(beyond) - place(a)));
  return of_pair(inside, outside, squared_length(place(b) - place(a)));
}

std::size_t Guard::count_beyond(Executor* executor) const {
  GuardValues limits = limits_->values;
  for (double& x : limits.value) x *= 1 - kRounding;
  return static_cast<std::size_t>(blockwise_sum(mesh_.n_triangles(), executor, [&](std::size_t i) {
    return around(TriangleId(i)).hold(GuardValues(), limits) ? 0.0 : 1.0;
  }));
}

void Guard::grow() {
  if (!on() || !has_depth()) return;
  const std::size_t first = depth_.size();
  depth_.resize(mesh_.n_vertices());
  for (std::size_t v = first; v < mesh_.n_vertices(); ++v) depth_[VertexId(v)] = depth_at(mesh_.point(VertexId(v)));
}

void Guard::renumber(const Compaction& kept) {
  if (on() && has_depth()) depth_ = kept_of(depth_, kept.vertices);
}

std::shared_ptr<const GuardLimits> guard_limits(const Mesh& input, const OptimizeOptions& options, Executor* executor) {
  const GuardOptions& o = options.guard;
  if (objective_of(options) == Objective::energy) return nullptr;
  if (o.angle == 0 && o.edge == 0 && o.areas == 0 && !o.step) return nullptr;
  auto limits = std::make_shared<GuardLimits>();
  limits->depth = o.depth;
  GuardValues bounds;
  bounds.value[GuardValues::sine] = std::sin(o.angle * std::numbers::pi / 180);
  bounds.value[GuardValues::edge] = o.edge * o.edge;
  bounds.value[GuardValues::areas] = o.areas > 0 ? 1 / std::max(o.areas, 1.0) : 0;
  if (o.step) bounds.value[GuardValues::crossing] = bounds.value[GuardValues::edge_crossing] = *o.step;
  WorkingUnits same;
  same.space = input.space();
  limits->values = Guard(input, same, limits).worst(executor);
  limits->values.take(bounds);
  if (!o.depth) {
    limits->values.value[GuardValues::crossing] = limits->values.value[GuardValues::edge_crossing] = 0;
  }
  limits->for_steps = limits->values;
  for (double& x : limits->for_steps.value) x *= kMargin;
  return limits;
}

std::size_t count_beyond(const Mesh& mesh, const WorkingUnits& units, const std::shared_ptr<const GuardLimits>& limits,
                         Executor* executor) {
  return limits == nullptr ? 0 : Guard(mesh, units, limits).count_beyond(executor);
}

}  // namespace temper
