#include "optimize/flips/guard.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/sine_cosine.hpp"
#include "base/sum.hpp"
#include "geometry/surface.hpp"
#include "mesh/blocks.hpp"
#include "optimize/working/working_copy.hpp"
#include "size/solver_measures.hpp"
#include "size/star_area.hpp"

namespace temper {
namespace {

constexpr double kLeastDepth = 1;  // [m]: on dry land waves need a speed, too
/// 1 + cosine of the angle between two edges, across from the third. All lengths are squared.
double cosine_of(double across, double p, double q) { return 1 + (p + q - across) / (2 * std::sqrt(p * q)); }

/// Says that the ratio of two angles is at least a limit, from rough angles, or does not know. The smaller is acute.
bool is_ratio_surely_at_least(double limit, double cosine, double cosine_of_larger) {
  constexpr double kRough = 1e-3;  // more than the errors of both
  const double acute = rough_acute_angle(std::fmin(std::abs(cosine_of_larger), 1.0));
  const double larger = cosine_of_larger < 0 ? std::numbers::pi - acute : acute;
  return limit > 0 && rough_acute_angle(std::fmin(cosine, 1.0)) >= (1 + kRough) * limit * larger;
}

}  // namespace

Guard::Guard(const Mesh& mesh, const WorkingUnits& units, std::shared_ptr<const GuardLimits> limits, bool in_copy)
    : mesh_(mesh), units_(units), limits_(std::move(limits)), in_copy_(in_copy) {
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
  const auto place = [&](const WeightedPoint& p) { return position_in_space(mesh_.space(), p); };
  if (mesh_.space().is_plane()) {
    t.doubled_area = measure(a.position(), b.position(), c.position());
  } else {
    t.doubled_area = length(measure(place(a), place(b), place(c)));
  }
  if (limits_->has_flow) {
    t.corners = corners;
    t.at = {place(a), place(b), place(c)};
  }
  if (!has_depth()) return t;
  for (const VertexId v : corners) t.depth += (is_there(v) ? there_ : (*depths_)[v]).value / 3;
  t.depth = std::max(t.depth, kLeastDepth);
  return t;
}

void Guard::add_cell(Triangle& t) const {
  if (limits_->has_flow) t.cell = flow_cell(t.at[0], t.at[1], t.at[2]);
}

Guard::Triangle Guard::triangle(TriangleId id) const {
  Triangle t = triangle(mesh_.corners(id));
  add_cell(t);
  for (std::size_t k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(id, static_cast<int>(k));
    if (!mesh_.is_diagonal(h)) continue;
    t.diagonal = k;
    if (!mesh_.twin(h).valid()) continue;  // a copy may end there
    t.doubled_area += triangle(mesh_.corners(Mesh::triangle(mesh_.twin(h)))).doubled_area;
    if (limits_->has_flow) t.cell = flow_cell_of(mesh_, id, mesh_.point(mesh_.corners(id)[0]));
  }
  return t;
}

void Guard::take_alone(GuardValues& v, const Triangle& t, const GuardValues& limits) const {
  if (t.diagonal) return;  // a quadrilateral stays as it is, and half of it has other angles
  const auto [least, most] = std::minmax({t.l2[0], t.l2[1], t.l2[2]});
  const double middle = t.l2[0] + t.l2[1] + t.l2[2] - least - most;
  const double height2 = t.doubled_area * t.doubled_area / most;
  const double of_largest = cosine_of(most, least, middle);
  v.take(GuardValues::sine, height2 / middle);
  v.take(GuardValues::cosine, of_largest);
  v.take(GuardValues::shortest, units_.scale * units_.scale * least);
  if (limits_->has_cells) {
    v.take(GuardValues::edges_alike, least / most);
    const double cosine = cosine_of(least, middle, most) - 1;
    if (!is_ratio_surely_at_least(limits.value[GuardValues::angles_alike], cosine, of_largest - 1))
      v.take(GuardValues::angles_alike, arc_cosine(cosine) / arc_cosine(of_largest - 1));
  }
  if (!has_depth()) return;
  const double slowness2 = units_.scale * units_.scale / (kGravity * t.depth);
  v.take(GuardValues::crossing, slowness2 * height2);
  v.take(GuardValues::edge_crossing, slowness2 * least);
}

void Guard::take_pair(GuardValues& v, const Triangle& s, std::size_t k, const Triangle& t) {
  const auto [less, more] = std::minmax(s.doubled_area, t.doubled_area);
  v.take(GuardValues::areas, less / more);
  v.take(GuardValues::edge, std::numbers::sqrt3 * s.l2[k] / (s.doubled_area + t.doubled_area));
}

void Guard::take_link(GuardValues& v, const Triangle& s, std::size_t k, const Triangle& t) const {
  FlowCell across = t.cell;
  if (mesh_.space().is_periodic()) {  // the image of t that is next to s
    for (std::size_t m = 0; m < 3; ++m) {
      if (t.corners[m] == s.corners[k]) across.center = across.center + (s.at[k] - t.at[m]);
    }
  }
  const FlowLink link = flow_link(s.at[(k + 1) % 3] - s.at[k], s.cell, across);
  v.take(GuardValues::orthogonality, -link.orthogonality);
  v.take(GuardValues::link, link.length);
}

GuardValues Guard::cell(VertexId v, bool moved, const OutsideNeighbors* outside) const {
  const Space& space = mesh_.space();
  gather(ring_, mesh_, v, [&](VertexId u, const WeightedPoint& near) {
    return moved && u == moving_ ? space.image(place_, near) : mesh_.point(u, near);
  });
  bool closed = !mesh_.is_boundary(v);
  if (outside != nullptr && outside->is_outside) {
    closed = outside->is_closed;
    for (const WeightedPoint& p : outside->points) ring_.around.push_back(space.image(p, ring_.center));
  }
  GuardValues values;
  const double spacing = units_.scale * grid_spacing(space, ring_);
  values.value[GuardValues::spacing] = spacing;
  values.value[GuardValues::wide_spacing] = -spacing;
  if (!closed) return values;
  StarArea star;
  for (std::size_t k = 0; k < ring_.around.size(); ++k, ++star.triangles) {
    star.doubled += unsigned_doubled_area(space, ring_.center, ring_.around[k], ring_.after(k));
  }
  values.value[GuardValues::duals_alike] = cell_quality(space, ring_);
  values.value[GuardValues::centroid] = -centroid_offset(space, ring_) / star.size();
  return values;
}

GuardValues Guard::cells_around(VertexId v, bool moved) const {
  GuardValues values = cell(v, moved);
  for (const HalfedgeId h : mesh_.star(v)) {
    values.take(cell(mesh_.target(h), moved));
    if (mesh_.is_boundary(Mesh::prev(h))) values.take(cell(mesh_.opposite(h), moved));
  }
  return values;
}

GuardValues Guard::around(TriangleId t, const GuardValues& limits, std::span<const TriangleId> except) const {
  const Triangle shape = triangle(t);
  GuardValues v;
  take_alone(v, shape, limits);
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId across = mesh_.twin(Mesh::halfedge(t, k));
    if (!across.valid() || mesh_.is_diagonal(across) ||
        std::ranges::find(except, Mesh::triangle(across)) != except.end())
      continue;
    if (!part_.contains(mesh_.opposite(across))) continue;
    take_pair_and_link(v, shape, static_cast<std::size_t>(k), triangle(Mesh::triangle(across)));
  }
  return v;
}

GuardValues Guard::around(std::span<const TriangleId> triangles) const {
  GuardValues v;
  for (const TriangleId t : triangles) v.take(around(t, limits_->for_steps));
  return v;
}

/// `fresh` replace `old`: both fill the same place. Most changes are within the limits, whatever was before. Pairs are
/// old ones, fresh ones, and each with the triangles outside.
bool Guard::allows(std::span<const TriangleId> old, std::span<const Corners> fresh) {
  GuardValues after;
  shapes_.clear();
  for (const Corners& corners : fresh) {
    shapes_.push_back(triangle(corners, true));
    add_cell(shapes_.back());
    take_alone(after, shapes_.back(), limits_->for_steps);
  }
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = fresh[i][k], b = fresh[i][(k + 1) % 3];
      bool inside = false;
      for (std::size_t j = 0; j < fresh.size() && !inside; ++j) {
        for (std::size_t m = 0; m < 3 && !inside; ++m) {
          inside = fresh[j][m] == b && fresh[j][(m + 1) % 3] == a;
        }
        if (inside && i < j) take_pair_and_link(after, shapes_[i], k, shapes_[j]);
      }
      if (inside || !a.valid() || !b.valid()) continue;
      const HalfedgeId h = mesh_.find_halfedge(a, b);
      if (!h.valid() || mesh_.is_boundary(h)) continue;
      const TriangleId outside = Mesh::triangle(mesh_.twin(h));
      take_pair_and_link(after, shapes_[i], k, triangle(outside));
    }
  }
  return after.are_within(limits_->for_steps) || after.hold(around(old), limits_->for_steps);
}

void Guard::begin_step() {
  link_.clear();
  cells_.reset();
  if (!on()) return;
  least_ = limits_->for_steps;
  knows_star_.fill(false);
}

/// Fills the triangles of the star: as they are, or after the move.
void Guard::find_star(std::vector<Triangle>& star, bool moved) const {
  star.clear();
  for (const LinkEdge& edge : link_) star.push_back(triangle({moving_, edge.from, edge.to}, moved));
}

/// Takes the measures of one stage. Pairs are in the star, or with the triangles across the link.
void Guard::take_stage(GuardValues& v, Stage stage, std::vector<Triangle>& star) {
  if (stage == alone) {
    for (const Triangle& t : star) take_alone(v, t, least_);
    return;
  }
  if (stage == links) {
    for (Triangle& t : star) add_cell(t);
  }
  const auto take = [&](const Triangle& s, std::size_t k, const Triangle& t) {
    stage == pairs ? take_pair(v, s, k, t) : take_link(v, s, k, t);
  };
  for (std::size_t i = 0; i < link_.size(); ++i) {
    LinkEdge& edge = link_[i];
    if (i > 0) take(star[i], 0, star[i - 1]);
    if (!edge.across.valid()) continue;
    if (!edge.outside) edge.outside = triangle(edge.across);
    take(star[i], 1, *edge.outside);
  }
  if (!mesh_.is_boundary(moving_)) take(star.front(), 0, star.back());
}

/// Says whether the star after the move is within the limits, or not worse than before. Most are within the limits.
bool Guard::allows_stage(Stage stage) {
  GuardValues after;
  take_stage(after, stage, shapes_);
  if (after.are_within(least_)) return true;
  if (knows_star_[stage]) return false;
  knows_star_[stage] = true;
  find_star(star_, false);
  GuardValues before;
  take_stage(before, stage, star_);
  least_.take(before);
  return after.are_within(least_);
}

/// The move changes the triangles of the star. A refusal needs one measure, so those that take long come last.
bool Guard::allows_move(VertexId v, const WeightedPoint& p) {
  moving_ = v, place_ = p;
  if (has_depth()) there_ = depth_at(p, (*depths_)[v].near);
  if (link_.empty()) {
    for (const HalfedgeId h : mesh_.star(v)) {
      const HalfedgeId across = mesh_.twin(Mesh::next(h));
      link_.push_back({mesh_.target(h), mesh_.opposite(h), across.valid() ? Mesh::triangle(across) : TriangleId()});
    }
  }
  find_star(shapes_, true);
  if (!allows_stage(alone) || !allows_stage(pairs) || (limits_->has_flow && !allows_stage(links))) return false;
  if (!reads_stars()) return true;
  const GuardValues cells = cells_around(v, true);
  if (cells.are_within(limits_->for_steps)) return true;
  if (!cells_) cells_ = cells_around(v, false);
  return cells.hold(*cells_, limits_->for_steps);
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
  link_.clear();  // flips that are undone may renumber it
  touched_.clear();
  corners_.clear();
  before_ = {};
}

/// A pair with a triangle that is touched already has been counted when that was touched, or flips have made it. A pair
/// with a triangle that leaves the part is not: Lawson::run looks at its edge later and ends the step.
void Guard::about_to_flip(HalfedgeId h) {
  const TriangleId left = Mesh::triangle(h), right = Mesh::triangle(mesh_.twin(h));
  const std::size_t n = touched_.size();
  for (const TriangleId t : {left, right}) {
    if (std::ranges::find(touched_, t) != touched_.end()) continue;
    before_.take(around(t, limits_->for_steps, std::span(touched_).first(n)));
    touched_.push_back(t);
  }
  if (!reads_stars()) return;
  for (const VertexId v : {mesh_.origin(h), mesh_.target(h), mesh_.opposite(h), mesh_.opposite(mesh_.twin(h))}) {
    if (std::ranges::find(corners_, v) != corners_.end()) continue;
    before_.take(cell(v));
    corners_.push_back(v);
  }
}

bool Guard::allow_flips() const {
  GuardValues after = around(touched_);
  for (const VertexId v : corners_) after.take(cell(v));
  return after.hold(before_, limits_->for_steps);
}

GuardValues Guard::worst(Executor* executor, std::span<const OutsideNeighbors> outside) const {
  const std::size_t n = mesh_.n_triangles();
  std::vector<GuardValues> of_blocks((n + kLoopBlock - 1) / kLoopBlock);
  for_blocks(n, executor, [&](std::size_t first, std::size_t last) {
    for (const TriangleId t : IdRange<TriangleId>(TriangleId(first), TriangleId(last))) {
      if (!mesh_.is_erased(t)) of_blocks[first / kLoopBlock].take(around(t, GuardValues()));
    }
  });
  GuardValues worst;
  for (const GuardValues& v : of_blocks) worst.take(v);
  for (const VertexId v : mesh_.vertices()) {
    if (!limits_->has_cells) break;
    if (!mesh_.is_isolated(v)) worst.take(cell(v, false, v.index < outside.size() ? &outside[v.index] : nullptr));
  }
  return worst;
}

GuardValues Guard::across(HalfedgeId h, const WeightedPoint& beyond) const {
  const Triangle inside = triangle(Mesh::triangle(h));
  const WeightedPoint a = mesh_.point(mesh_.origin(h)), b = mesh_.point(mesh_.target(h), a);
  const auto place = [&](const WeightedPoint& p) {
    return position_in_space(mesh_.space(), mesh_.space().image(p, a));
  };
  Triangle outside;
  outside.corners = {mesh_.target(h), mesh_.origin(h), VertexId()};
  outside.at = {place(b), place(a), place(beyond)};
  outside.doubled_area = length(cross(outside.at[1] - outside.at[0], outside.at[2] - outside.at[0]));
  outside.cell = flow_cell(outside.at[0], outside.at[1], outside.at[2]);
  std::size_t k = 0;
  while (mesh_.corners(Mesh::triangle(h)).at(k) != mesh_.origin(h)) ++k;
  GuardValues v;
  take_pair_and_link(v, inside, k, outside);
  return v;
}

std::size_t Guard::count_beyond(const GuardValues& limits, Executor* executor) const {
  return static_cast<std::size_t>(blockwise_sum(mesh_.n_triangles(), executor, [&](std::size_t i) {
    return mesh_.is_erased(TriangleId(i)) || around(TriangleId(i), limits).are_within(limits) ? 0.0 : 1.0;
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

}  // namespace temper
