#include "optimize/repair/local_copy.hpp"

#include "feasibility/change.hpp"
#include "feasibility/constraints.hpp"
#include "feasibility/potential.hpp"
#include "geometry/predicates_inline.hpp"
#include "geometry/surface.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/regularity.hpp"

namespace temper {

bool may_be_removed(const Mesh& mesh, VertexId v, bool is_own) {
  if (mesh.is_isolated(v) || mesh.is_fixed(v)) return false;
  return is_own || lines_at(mesh, v).empty();
}

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
      step_({work_.mesh, settings_, state_, grid, limits_, recorder_}, flipper_) {
  for (const VertexId v : around.mesh.vertices()) {
    if (around.frozen[v.index] != 0) limits_.freeze(v);
  }
}

bool LocalCopy::insert(TriangleId t, const WeightedPoint& place) {
  const Mesh& mesh = work_.mesh;
  if (mesh.is_half(t)) return false;
  const auto [a, b, c] = mesh.points(t);
  // The weight comes first: on the sphere it moves the vertex by rounding.
  const WeightedPoint p = with_interpolated_weight(mesh.space(), grid_.snap(mesh.space().image(place, a)), a, b, c);
  for (const auto& [q, r] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
    if (inlined::orientation(mesh.space(), q, r, p) != Sign::positive) return false;
  }
  flipper_.insert(work_, t, p, kNoEnergy, kNoEnergy);
  limits_.grow();
  return true;
}

bool LocalCopy::split(HalfedgeId h, double part) {
  const Mesh& mesh = work_.mesh;
  if (mesh.is_frozen(h)) return false;  // it may bound a polygon
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
  return true;
}

/// Returns the vertex at a part of the way along an edge of the boundary or of a line, in the plane.
WeightedPoint LocalCopy::place_on_line(HalfedgeId h, double part) const {
  const WeightedPoint a = work_.mesh.point(work_.mesh.origin(h)), b = work_.mesh.point(work_.mesh.target(h));
  const Vec2 along = b.position() - a.position();
  const Vec2 x = work_.divided_by(h).nearest(a.position() + part * along, grid_);
  const double l2 = squared_length(along), t = dot(x - a.position(), along) / l2;
  return {x.x, x.y, split_weight(a.w, b.w, l2, t)};
}

bool LocalCopy::remove(VertexId v) {
  const RemovalPlan plan = plan_removal(work_.mesh, v);
  if (plan.status != RemovalStatus::possible) return false;
  flipper_.remove(EventKind::removal, plan, kNoEnergy, kNoEnergy);
  return true;
}

bool LocalCopy::assign_weights(VertexMask free, double margin) {
  Mesh compact = work_.mesh;
  const Compaction kept = compact.compact();
  const TriangleDemand demand(compact, constraints_of(settings_.criterion));
  const VertexWeights weights = demand.weights();
  VertexMask mask(compact.n_vertices(), 0);
  for (const VertexId v : compact.vertices()) {
    if (!is_frozen(kept.vertices[v])) mask[v] = free[kept.vertices[v]];
  }
  bool all = true;
  for (const Region& region : regions_of(demand, mask, demand.has_duals())) {
    const RegionChange found = least_violation({demand, weights, margin}, region, *settings_.lp);
    if (found.status != LpStatus::optimal) {
      all = false;
      continue;
    }
    for (std::size_t i = 0; i < region.free.size(); ++i) {
      if (found.change[i] == 0) continue;
      const VertexId v = region.free[i];
      set_weight(kept.vertices[v], changed_weight(compact.space(), weights[v], found.change[i]));
    }
  }
  return all;
}

void LocalCopy::set_weight(VertexId v, double w) {
  const WeightedPoint from = work_.mesh.point(v);
  work_.mesh.set_point(v, work_.mesh.space().with_weight(from, w));
  recorder_.placed(v, from, work_.mesh.point(v), kNoEnergy, kNoEnergy);
}

bool LocalCopy::is_regular() const {
  return count_non_regular_edges(work_.mesh, false) == 0 && rim_is_regular(around_, work_.mesh);
}

void LocalCopy::return_to(const State& state) {
  work_ = state.work;
  limits_.mobility = state.mobility;
  limits_.degree.resize(limits_.mobility.size());
  events_.resize(state.events);
}

Settings settings_of_copies(const Settings& settings) {
  OptimizeOptions o;
  o.star = settings.options.star;
  o.unknowns = settings.options.unknowns;
  o.interfaces = settings.options.interfaces;
  o.boundary = settings.options.boundary;
  o.size_band = settings.options.size_band;
  o.paper.insertion_place = settings.options.paper.insertion_place;
  Settings s = settings;
  s.options = std::move(o);
  s.policy = Policy(s.options);
  s.model.wall = true;
  s.model.kind = s.options.energy;
  if (!s.options.size_band) s.size_field.reset();
  s.hooks = {};
  s.in_copy = true;
  return s;
}

}  // namespace temper
