#include "optimize/coarsen/local_copy.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "feasibility/change.hpp"
#include "feasibility/constraints.hpp"
#include "feasibility/potential.hpp"
#include "geometry/predicates_inline.hpp"
#include "geometry/surface.hpp"
#include "mesh/bad_triangles.hpp"
#include "optimize/step/insertion_place.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/regularity.hpp"
#include "topology/locate.hpp"

namespace temper {
namespace {

// γ/ℓ of the first sweep, its factor from sweep to sweep, and its least value; and enough sweeps for all of them.
constexpr double kWidest = 0.5, kNarrowing = 0.7, kNarrowest = 0.003;
constexpr int kMostSweeps = 25;
// After the first sweeps, more are hopeless if the violation is above this multiple of γ. Among 358 removals that
// succeed this rule stops 5 %. Among 9059 that fail it stops nine of ten within seven sweeps.
constexpr double kHopeless = 11;
constexpr int kFirstSweeps = 3;
// A new vertex on a line is at least this part of its edge away from the ends.
constexpr double kFromEnds = 0.02;

// Below this violation a linear program often finds weights that sweeps do not. Above it, it is a waste of time.
constexpr double kNearlyCentered = 0.3;
constexpr double kProgramMargin = 0.002;

}  // namespace

LocalCopy::LocalCopy(const Neighborhood& around, const Settings& settings, const WorkingUnits& grid, bool with_events)
    : around_(around),
      settings_(settings),
      grid_(grid),
      tracer_(with_events ? Tracer([this](const TraceEvent& e) { events_.push_back(e); }) : Tracer()),
      work_(WorkingCopy::part(around.mesh, around.divided)),
      state_(settings_),
      recorder_(tracer_, work_, 1),
      flipper_(work_.mesh, settings_, state_, recorder_),
      limits_(work_, settings_, grid),
      step_({work_.mesh, settings_, state_, grid, limits_, recorder_}, flipper_),
      violation_before_(defect_of(around.mesh).violation) {
  for (const VertexId v : around.mesh.vertices()) {
    if (around.frozen[v.index] != 0) limits_.freeze(v);
  }
}

bool may_be_removed(const WorkingCopy& work, VertexId v) {
  if (work.mesh.is_isolated(v) || work.mesh.is_fixed(v)) return false;
  return work.divided_edge(v) != nullptr || lines_at(work.mesh, v).empty();
}

bool LocalCopy::remove(VertexId v) {
  const RemovalPlan plan = plan_removal(work_.mesh, v);
  if (plan.status != RemovalStatus::possible) return false;
  flipper_.remove(EventKind::removal, plan, kNoEnergy, kNoEnergy);
  return flipper_.restore_all();
}

bool LocalCopy::insert_near(TriangleId t, Rng& rng) {
  const Mesh& mesh = work_.mesh;
  const auto [a, b, c] = mesh.points(t);
  const InsertionPlace rule = settings_.policy.insertion_place;
  if (rule != InsertionPlace::best) return insert_by_rule(t, rule);
  const std::uint32_t choice = rng.below(4);
  const HalfedgeId side = Mesh::halfedge(t, static_cast<int>(rng.below(3)));
  const double random_part = rng.uniform(0.2, 0.8);
  if (choice == 1) {
    const WeightedPoint o = orthocenter(mesh.space(), a, b, c);
    const Location at = std::isfinite(o.x) && std::isfinite(o.y) ? locate(mesh, o, t) : Location();
    if (at.kind == Location::Kind::in_triangle) return insert(at.triangle, o);
  } else if (choice > 1 && !mesh.is_unflippable(side)) {
    return split(side, 0.5);
  } else if (choice > 1 && may_split_line(side)) {
    const WeightedPoint p = mesh.point(mesh.origin(side)), q = mesh.point(mesh.target(side), p);
    const Vec2 along = q.position() - p.position();
    const Vec2 to_apex = mesh.point(mesh.opposite(side), p).position() - p.position();
    return split(side, choice == 2 ? dot(to_apex, along) / squared_length(along) : random_part);
  }
  return insert(t, middle(mesh.space(), a, b, c));
}

bool LocalCopy::may_split_line(HalfedgeId h) const {
  const Mesh& mesh = work_.mesh;
  return settings_.options.boundary == BoundaryVertices::split && !around_.is_rim(mesh.origin(h), mesh.target(h));
}

/// Inserts a vertex in the point of the triangle, or where the way from its centroid to this point meets a line.
bool LocalCopy::insert_by_rule(TriangleId t, InsertionPlace rule) {
  const Mesh& mesh = work_.mesh;
  const auto [a, b, c] = mesh.points(t);
  const WeightedPoint p = insertion_point(mesh.space(), rule, a, b, c);
  if (!std::isfinite(p.x) || !std::isfinite(p.y)) return false;
  const Location at = locate(mesh, p, t);
  if (at.kind == Location::Kind::in_triangle) return insert(at.triangle, p);
  Vec2 from = middle(mesh.space(), a, b, c).position();
  const Vec2 way = p.position() - from;
  for (TriangleId here = t, before; here.valid();) {
    const TriangleId now = here;
    here = TriangleId();
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(now, k);
      if (mesh.twin(h).valid() && Mesh::triangle(mesh.twin(h)) == before) continue;
      const Vec2 q = mesh.position(mesh.origin(h)), along = mesh.position(mesh.target(h)) - q;
      const double turn = cross(way, along), part = turn == 0 ? -1 : cross(q - from, way) / turn;
      if (!(turn > 0) || part < 0 || part > 1) continue;
      if (mesh.is_unflippable(h)) return may_split_line(h) && split(h, part);
      here = Mesh::triangle(mesh.twin(h));
      break;
    }
    before = now;
  }
  return false;
}

/// Inserts a vertex with the weight that the corners have there.
bool LocalCopy::insert(TriangleId t, const WeightedPoint& place) {
  const Mesh& mesh = work_.mesh;
  const auto [a, b, c] = mesh.points(t);
  // The weight comes first: on the sphere it moves the vertex by rounding.
  const WeightedPoint p = with_interpolated_weight(mesh.space(), grid_.snap(mesh.space().image(place, a)), a, b, c);
  for (const auto& [q, r] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
    if (inlined::orientation(mesh.space(), q, r, p) != Sign::positive) return false;
  }
  flipper_.insert(work_, t, p, kNoEnergy, kNoEnergy);
  limits_.grow();
  return flipper_.restore_all();
}

bool LocalCopy::split(HalfedgeId h, double part) {
  if (part < kFromEnds || part > 1 - kFromEnds) return false;
  const Mesh& mesh = work_.mesh;
  const Space& space = mesh.space();
  const WeightedPoint a = mesh.point(mesh.origin(h)), b = mesh.point(mesh.target(h), a);
  const double w = 0.5 * (space.weight(a) + space.weight(b));
  const WeightedPoint p =
      mesh.is_unflippable(h) ? place_on_line(h, part) : space.with_weight(grid_.snap(middle(space, a, b)), w);
  for (const HalfedgeId side : {h, mesh.twin(h)}) {
    if (!side.valid()) continue;
    for (const HalfedgeId link : {Mesh::next(side), Mesh::prev(side)}) {
      const WeightedPoint q = mesh.point(mesh.origin(link), p), r = mesh.point(mesh.target(link), p);
      if (inlined::orientation(space, q, r, p) != Sign::positive) return false;
    }
  }
  flipper_.split(work_, h, p, kNoEnergy, kNoEnergy);
  limits_.grow();
  return flipper_.restore_all();
}

/// Returns the vertex at a part of the way along an edge of the boundary or of a line, in the plane.
WeightedPoint LocalCopy::place_on_line(HalfedgeId h, double part) const {
  const WeightedPoint a = work_.mesh.point(work_.mesh.origin(h)), b = work_.mesh.point(work_.mesh.target(h));
  const Vec2 along = b.position() - a.position();
  const Vec2 x = work_.divided_by(h).nearest(a.position() + part * along, grid_);
  const double l2 = squared_length(along), t = dot(x - a.position(), along) / l2;
  return {x.x, x.y, split_weight(a.w, b.w, l2, t)};
}

LocalDefect LocalCopy::improve() {
  const LocalDefect swept = sweep();
  const bool has_weights = settings_.options.unknowns != Unknowns::positions;
  const bool is_near = violation_before_ < kNearlyCentered && swept.violation < kNearlyCentered;
  if (swept.bad == 0 || settings_.lp == nullptr || !has_weights || !is_near) return swept;
  const State before = state();
  if (assign_weights()) {
    const LocalDefect now = defect_of(work_.mesh);
    if (now < swept) return now;
  }
  return_to(before);
  return swept;
}

/// Gives all vertices except those on the rim the weights that lack least of a margin. Returns false if there are none.
bool LocalCopy::assign_weights() {
  Mesh compact = work_.mesh;
  const Compaction kept = compact.compact();
  const TriangleDemand demand(compact, Constraints::well_centered);
  const VertexWeights weights = demand.weights();
  VertexMask free(compact.n_vertices(), 0);
  for (const VertexId v : compact.vertices()) free[v] = limits_.mobility[kept.vertices[v]] != Mobility::frozen ? 1 : 0;
  for (const Region& region : regions_of(demand, free)) {
    const RegionChange found = least_violation({demand, weights, kProgramMargin}, region, *settings_.lp);
    if (found.status != LpStatus::optimal) return false;
    for (std::size_t i = 0; i < region.free.size(); ++i) {
      if (found.change[i] == 0) continue;
      const VertexId v = kept.vertices[region.free[i]];
      const WeightedPoint from = work_.mesh.point(v);
      const double w = changed_weight(work_.mesh.space(), weights[region.free[i]], found.change[i]);
      work_.mesh.set_point(v, work_.mesh.space().with_weight(from, w));
      recorder_.placed(v, from, work_.mesh.point(v), kNoEnergy, kNoEnergy);
    }
  }
  return flipper_.restore_all();
}

LocalDefect LocalCopy::sweep() {
  LocalDefect defect;
  double gamma = kWidest;
  for (int i = 0; i < kMostSweeps; ++i) {
    state_.model.gamma = {gamma, LengthScale::relative};
    step_.begin_sweep(i, settings_.options.unknowns);
    for (const VertexId v : work_.mesh.vertices()) {
      if (limits_.mobility[v] != Mobility::frozen && !work_.mesh.is_isolated(v)) step_.improve(v);
    }
    gamma = std::max(kNarrowest, kNarrowing * gamma);
    defect = defect_of(work_.mesh);
    if (defect.bad == 0) break;
    if (i + 1 >= kFirstSweeps && defect.violation > violation_before_ + kHopeless * gamma) break;
  }
  return defect;
}

bool LocalCopy::is_valid() const {
  return count_non_regular_edges(work_.mesh, false) == 0 && rim_is_regular(around_, work_.mesh);
}

void LocalCopy::return_to(const State& state) {
  work_ = state.work;
  limits_.mobility = state.mobility;
  limits_.degree.resize(limits_.mobility.size());
  events_.resize(state.events);
}

Settings settings_of_search(const Settings& settings) {
  OptimizeOptions o;
  o.star = settings.options.star;
  o.unknowns = settings.options.unknowns;
  o.interfaces = settings.options.interfaces;
  o.boundary = settings.options.boundary;
  o.paper.insertion_place = settings.options.paper.insertion_place;
  Settings s = settings;
  s.options = std::move(o);
  s.policy = Policy(s.options);
  s.model.wall = true;
  s.model.kind = s.options.energy;
  s.size_field.reset();
  s.hooks = {};
  return s;
}

}  // namespace temper
