#include "optimize/flips/guard.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/sum.hpp"
#include "geometry/surface.hpp"
#include "mesh/blocks.hpp"
#include "optimize/working/working_copy.hpp"
#include "temper/detail/location.hpp"

namespace temper {
namespace {

constexpr double kLeastDepth = 1;  // [m]: on dry land waves need a speed, too
// Values in the user's units differ by rounding from those in the units of the run.
constexpr double kRounding = 1e-9;
// A map from degrees changes the areas of neighbors by up to a few thousandths, each in its own way.
constexpr double kMargin = 1.005;

/// The values, with times and lengths multiplied by a factor near 1 and ratios moved as far.
GuardValues scaled(GuardValues v, double factor) {
  for (std::size_t i = 0; i < GuardValues::kMeasures; ++i) {
    v.value[i] *= i == GuardValues::areas ? factor : factor * factor;
  }
  return v;
}

}  // namespace

class DepthField {
 public:
  DepthField(Mesh mesh, std::span<const double> depths)
      : mesh_(std::move(mesh)), depths_(depths.begin(), depths.end()) {
    for (double& depth : depths_) depth = std::isnan(depth) ? 0 : depth;
  }
  [[nodiscard]] double at(const WeightedPoint& p, TriangleId& near) const {
    const Place place = finder_.find(p, near);
    near = place.triangle;
    return interpolated(place, [this](VertexId v) { return depths_[v.index]; });
  }

 private:
  Mesh mesh_;
  std::vector<double> depths_;
  PointLocator finder_{mesh_};
};

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
  if (on() && has_depth()) depths_ = std::make_shared<IdVector<VertexId, Depth>>();
  grow();
}

Guard::Depth Guard::depth_at(const WeightedPoint& p, TriangleId near) const {
  Depth depth{0, near};
  depth.value = limits_->depth->at(units_.to_user(p), depth.near);
  return depth;
}

Guard::Triangle Guard::triangle(const Corners& corners, bool of_plan) const {
  const auto is_there = [&](VertexId v) { return of_plan && v == moving_; };
  const WeightedPoint a = is_there(corners[0]) ? place_ : mesh_.point(corners[0]);
  const auto corner = [&](std::size_t k) {
    return is_there(corners[k]) ? mesh_.space().image(place_, a) : mesh_.point(corners[k], a);
  };
  const WeightedPoint b = corner(1), c = corner(2);
  Triangle t;
  const auto measure = [&t](const auto& p, const auto& q, const auto& r) {
    t.l2 = {squared_length(q - p), squared_length(r - q), squared_length(p - r)};
    return cross(q - p, r - p);
  };
  if (mesh_.space().is_plane()) {
    t.doubled_area = measure(a.position(), b.position(), c.position());
  } else {
    const auto place = [&](const WeightedPoint& p) { return position_in_space(mesh_.space(), p); };
    t.doubled_area = length(measure(place(a), place(b), place(c)));
  }
  if (!has_depth()) return t;
  for (const VertexId v : corners) t.depth += (is_there(v) ? there_ : (*depths_)[v]).value / 3;
  t.depth = std::max(t.depth, kLeastDepth);
  return t;
}

GuardValues Guard::alone(const Triangle& t) const {
  const auto [least, most] = std::minmax({t.l2[0], t.l2[1], t.l2[2]});
  const double middle = t.l2[0] + t.l2[1] + t.l2[2] - least - most;
  const double height2 = t.doubled_area * t.doubled_area / most;
  GuardValues v;
  v.value[GuardValues::sine] = height2 / middle;
  if (!has_depth()) return v;
  const double slowness2 = units_.scale * units_.scale / (kGravity * t.depth);
  v.value[GuardValues::crossing] = slowness2 * height2;
  v.value[GuardValues::edge_crossing] = slowness2 * least;
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
    if (!part_.contains(mesh_.opposite(across))) continue;
    v.take(of_pair(shape, triangle(Mesh::triangle(across)), shape.l2[static_cast<std::size_t>(k)]));
  }
  return v;
}

GuardValues Guard::around(std::span<const TriangleId> triangles) const {
  GuardValues v;
  for (const TriangleId t : triangles) v.take(around(t));
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
  return after.hold(GuardValues(), limits_->for_steps) || after.hold(around(old), limits_->for_steps);
}

/// The move changes the triangles of the star. Their pairs are with each other and with the triangles across the link.
bool Guard::allows_move(VertexId v, const WeightedPoint& p) {
  moving_ = v, place_ = p;
  if (has_depth()) there_ = depth_at(p, (*depths_)[v].near);
  old_.clear();
  shapes_.clear();
  GuardValues after;
  for (const HalfedgeId h : mesh_.star(v)) {
    old_.push_back(Mesh::triangle(h));
    shapes_.push_back(triangle({v, mesh_.target(h), mesh_.opposite(h)}, true));
    const Triangle& t = shapes_.back();
    after.take(alone(t));
    if (shapes_.size() > 1) after.take(of_pair(shapes_[shapes_.size() - 2], t, t.l2[0]));
    const HalfedgeId across = mesh_.twin(Mesh::next(h));
    if (across.valid()) after.take(of_pair(t, triangle(Mesh::triangle(across)), t.l2[1]));
  }
  if (!mesh_.is_boundary(v)) after.take(of_pair(shapes_.back(), shapes_.front(), shapes_.front().l2[0]));
  if (after.hold(GuardValues(), limits_->for_steps)) return true;
  if (!star_) star_ = around(old_);
  return after.hold(*star_, limits_->for_steps);
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
  if (has_depth()) there_ = depth_at(plan.point, (*depths_)[mesh_.corners(plan.triangle)[0]].near);
  fresh_.clear();
  const bool open = plan.edge.valid() && mesh_.is_boundary(plan.edge);
  for (std::size_t i = 0; i + (open ? 1 : 0) < plan.link.size(); ++i) {
    fresh_.push_back({VertexId(), plan.link[i], plan.link[(i + 1) % plan.link.size()]});
  }
  return allows(plan.cavity, fresh_);
}

void Guard::begin_flips(const Part& part) {
  part_ = part;
  touched_.clear();
  before_ = {};
}

/// A pair with a triangle that is touched already has been counted when that was touched, or flips have made it. A pair
/// with a triangle that leaves the part is not: Lawson::run looks at its edge later and ends the step.
void Guard::about_to_flip(HalfedgeId h) {
  const TriangleId left = Mesh::triangle(h), right = Mesh::triangle(mesh_.twin(h));
  const std::size_t n = touched_.size();
  for (const TriangleId t : {left, right}) {
    if (std::ranges::find(touched_, t) != touched_.end()) continue;
    before_.take(around(t, std::span(touched_).first(n)));
    touched_.push_back(t);
  }
}

bool Guard::allow_flips() const { return around(touched_).hold(before_, limits_->for_steps); }

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
  const GuardValues limits = scaled(limits_->values, 1 - kRounding);
  return static_cast<std::size_t>(blockwise_sum(mesh_.n_triangles(), executor, [&](std::size_t i) {
    return around(TriangleId(i)).hold(GuardValues(), limits) ? 0.0 : 1.0;
  }));
}

void Guard::follow(VertexId v) {
  if (on() && has_depth()) (*depths_)[v] = depth_at(mesh_.point(v), (*depths_)[v].near);
}

void Guard::grow() {
  if (!on() || !has_depth()) return;
  const VertexId first(depths_->size());
  depths_->resize(mesh_.n_vertices());
  TriangleId near = first.index > 0 ? (*depths_)[VertexId(first.index - 1)].near : TriangleId();
  for (const VertexId v : IdRange<VertexId>(first, VertexId(mesh_.n_vertices()))) {
    (*depths_)[v] = depth_at(mesh_.point(v), near);
    near = (*depths_)[v].near;  // the next vertex on the curve is near
  }
}

void Guard::renumber(const Compaction& kept) {
  if (on() && has_depth()) *depths_ = kept_of(*depths_, kept.vertices);
}

Expected<std::shared_ptr<const GuardLimits>> guard_limits(const Mesh& input, const OptimizeOptions& options,
                                                          Executor* executor) {
  const GuardOptions& o = options.guard;
  if (!o.depth.empty() && o.depth.size() != input.n_vertices()) {
    return InputError{ErrorCode::size_mismatch,
                      {},
                      "the guard has " + std::to_string(o.depth.size()) + " depths; expected one for each of the " +
                          std::to_string(input.n_vertices()) + " vertices"};
  }
  const bool off = o.angle == 0 && o.edge == 0 && o.areas == 0 && !o.step;
  if (off || objective_of(options) == Objective::energy) return std::shared_ptr<const GuardLimits>();
  auto limits = std::make_shared<GuardLimits>();
  if (!o.depth.empty()) limits->depth = std::make_shared<const DepthField>(input, o.depth);
  WorkingUnits same;
  same.space = input.space();
  limits->values = Guard(input, same, limits).worst(executor);
  GuardValues bounds;
  const double sine = std::sin(o.angle * std::numbers::pi / 180),
               step = o.step.value_or(std::numeric_limits<double>::infinity());
  bounds.value = {sine * sine, o.edge * o.edge, o.areas > 0 ? 1 / o.areas : 0, step * step, step * step};
  if (o.depth.empty()) bounds.value[GuardValues::crossing] = bounds.value[GuardValues::edge_crossing] = 0;
  limits->values.take(bounds);
  limits->for_steps = scaled(limits->values, kMargin);
  return std::shared_ptr<const GuardLimits>(std::move(limits));
}

std::size_t count_beyond(const Mesh& mesh, const WorkingUnits& units, const std::shared_ptr<const GuardLimits>& limits,
                         Executor* executor) {
  return limits == nullptr ? 0 : Guard(mesh, units, limits).count_beyond(executor);
}

}  // namespace temper
