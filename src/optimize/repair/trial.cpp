#include "optimize/repair/trial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/rng.hpp"
#include "feasibility/change.hpp"
#include "feasibility/constraints.hpp"
#include "feasibility/potential.hpp"
#include "geometry/predicates_inline.hpp"
#include "geometry/surface.hpp"
#include "geometry/triangle_kernel.hpp"
#include "mesh/bad_triangles.hpp"
#include "optimize/repair/refinement.hpp"
#include "optimize/run/judge.hpp"
#include "optimize/run/run.hpp"
#include "optimize/step/vertex_step.hpp"
#include "temper/detail/necessity.hpp"
#include "temper/regularity.hpp"
#include "topology/locate.hpp"

namespace temper {
namespace {

// Enough sweeps for γ to fall from kFirstGamma to kLeastGamma, and a few at the floor.
constexpr int kSweeps = 25;
constexpr double kFirstGamma = 0.5, kGammaFactor = 0.7, kLeastGamma = 0.003;
// Below this γ/ℓ sweeps rarely make well-centered triangles bad again.
constexpr double kSharp = 0.1;
// Length of a random perturbation, relative to the shortest edge. Most longer ones would turn a triangle over.
constexpr double kKick = 0.4;
// Half of the margin of `temper weights`. With more, one triangle would turn bad for the margins of a few others.
constexpr double kWeighedMargin = 0.005;
// Programs with one more ring take four times as long and cure hardly more.
constexpr int kWeighedRings = 2;
// More vertices than any neighborhood lacks.
constexpr int kMostInserted = 300;

/// Returns the largest of −h/ℓ, −d/ℓ and d/ℓ − 1, which is positive if the triangle is bad.
double violation_of(const Mesh& mesh, TriangleId t) {
  const auto [p, q, r] = mesh.points(t);
  double worst = 0;
  for (const EdgeShape& e : triangle_shape(mesh.space(), p, q, r).edges) {
    worst = std::max({worst, -e.g / e.l2, 0.5 * (std::abs(e.dw) / e.l2 - 1)});
  }
  return worst;
}

class Trial {
 public:
  Trial(const Neighborhood& around, const Settings& settings, const WorkingUnits& grid, bool with_events)
      : around_(around),
        settings_(
            of_trial(settings, with_events ? Tracer([this](const TraceEvent& e) { events_.push_back(e); }) : Tracer())),
        grid_(grid),
        work_(WorkingCopy::part(around.mesh, around.divided)),
        state_(settings_),
        recorder_(settings_.hooks.tracer, work_, 1),
        flipper_(work_.mesh, settings_, state_, recorder_),
        limits_(work_, settings_, grid),
        step_({work_.mesh, settings_, state_, grid, limits_, recorder_}, flipper_) {
    for (const VertexId v : around.mesh.vertices()) {
      if (around.frozen[v.index] != 0) limits_.freeze(v);
    }
  }
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;
  ~Trial() = default;

  TrialResult run(const Edit& edit, bool levels) && {
    if (levels && !level_weights()) return {};
    if (!apply(edit) || !flipper_.restore_all()) return {};
    if (edit.kind == Edit::only_refine) return {true, defect_of(work_.mesh), std::move(events_)};
    if (edit.kind != Edit::assign_weights) sweep();  // the first γ of sweeps would undo the weights
    TrialResult result;
    result.defect = defect_of(work_.mesh, settings_.accuracy);
    result.valid =
        count_non_regular_edges(work_.mesh, false) == 0 && rim_is_regular(around_, work_.mesh) && is_guarded();
    result.events = std::move(events_);
    return result;
  }

 private:
  /// Says whether the guard allows the neighborhood as it is now, in place of what it was.
  [[nodiscard]] bool is_guarded() const {
    if (settings_.guard == nullptr) return true;
    const Guard guard(work_.mesh, grid_, settings_.guard);
    const Guard original(around_.mesh, grid_, settings_.guard);
    return worst(guard, work_.mesh).hold(worst(original, around_.mesh), guard.limits());
  }
  [[nodiscard]] GuardValues worst(const Guard& guard, const Mesh& mesh) const {
    GuardValues v = guard.worst();
    for (std::size_t i = 0; i < around_.rim.size(); ++i) {
      const HalfedgeId h = mesh.find_halfedge(around_.rim[i][0], around_.rim[i][1]);
      if (h.valid()) v.take(guard.across(h, around_.beyond[i]));
    }
    return v;
  }

  /// Newton steps on E_BP by temper's default method, with the unknowns and constraints of the run.
  static Settings of_trial(const Settings& settings, Tracer tracer) {
    OptimizeOptions o;
    o.star = settings.options.star;
    o.unknowns = settings.options.unknowns;
    o.interfaces = settings.options.interfaces;
    o.boundary = settings.options.boundary;
    o.size_band = settings.options.size_band;
    Settings s = settings;
    s.options = std::move(o);
    s.policy = Policy(s.options);
    s.model.wall = true;
    s.model.kind = s.options.energy;
    s.hooks = {};
    s.hooks.tracer = std::move(tracer);
    return s;
  }

  bool apply(const Edit& edit) {
    switch (edit.kind) {
      case Edit::nothing:
        return true;
      case Edit::kick: {
        Rng rng(edit.seed);
        step_.shake(kKick, rng);
        return true;
      }
      case Edit::assign_weights:
        assign_weights();
        return true;
      case Edit::insert:
        return insert(edit.triangle, edit.place);
      case Edit::split:
        return split(edit.edge, edit.part);
      case Edit::cut_corner:
        return cut_corner(edit.vertex, edit.distance);
      case Edit::remove:
        return remove(edit.vertex);
      case Edit::remesh:
        remove_free_vertices();
        return refine({edit.gradation, edit.factor}, edit.splits_lines);
      case Edit::refine:
      case Edit::only_refine:
        return refine({edit.gradation, edit.factor}, edit.splits_lines);
    }
    return false;
  }

  /// Gives the vertices that are not frozen weights that are linear in their positions, as near as possible to the
  /// weights of frozen vertices. Linear weights hide no vertex, also none that comes between. Returns false if an edge
  /// cannot be made regular.
  bool level_weights() {
    const Mesh& mesh = work_.mesh;
    // Least squares for w = a + b·(x − center): normal equations by Gram-Schmidt on the functions 1, x and y.
    double n = 0, xx = 0, xy = 0, yy = 0, xw = 0, yw = 0, mean = 0;
    Vec2 center;
    const auto each_frozen = [&](auto&& use) {
      for (const VertexId v : mesh.vertices()) {
        if (around_.frozen[v.index] != 0) use(mesh.position(v), mesh.weight(v));
      }
    };
    each_frozen([&](Vec2 p, double w) { ++n, center = center + p, mean += w; });
    if (n > 0) center = (1 / n) * center, mean /= n;
    each_frozen([&](Vec2 p, double w) {
      const Vec2 x = p - center;
      xx += x.x * x.x, xy += x.x * x.y, yy += x.y * x.y, xw += x.x * (w - mean), yw += x.y * (w - mean);
    });
    const double determinant = xx * yy - xy * xy;
    Vec2 slope;
    if (determinant > 1e-6 * xx * yy) slope = (1 / determinant) * Vec2{yy * xw - xy * yw, xx * yw - xy * xw};
    for (const VertexId v : mesh.vertices()) {
      if (around_.frozen[v.index] != 0) continue;
      const WeightedPoint from = mesh.point(v);
      double sum = 0, sum_of_rest = 0;
      each_frozen([&](Vec2 p, double w) {
        const double near = 1 / (squared_length(p - from.position()) * squared_length(p - from.position()));
        sum += near, sum_of_rest += near * (w - mean - dot(slope, p - center));
      });
      const double rest = sum > 0 ? sum_of_rest / sum : 0;
      work_.mesh.set_point(v, mesh.space().with_weight(from, mean + dot(slope, from.position() - center) + rest));
      recorder_.placed(v, from, mesh.point(v), kNoEnergy, kNoEnergy);
    }
    return flipper_.restore_all();
  }

  /// Assigns weights around the bad triangle. Vertices on the rim, which have triangles outside, keep theirs.
  void assign_weights() {
    const Mesh& mesh = work_.mesh;
    VertexMask free(mesh.n_vertices(), 0);
    const auto corners = mesh.corners(around_.seed);
    for (const VertexId v : corners) free[v] = 1;
    const TriangleDemand demand(mesh, Constraints::well_centered);
    grow(demand, free, {corners.begin(), corners.end()}, kWeighedRings);
    const VertexWeights weights = demand.weights();
    for (const VertexId v : mesh.vertices()) {
      if (around_.frozen[v.index] != 0) free[v] = 0;
    }
    for (const Region& region : regions_of(demand, free)) {
      const RegionChange found = least_violation({demand, weights, kWeighedMargin}, region, *settings_.lp);
      if (found.status != LpStatus::optimal) continue;
      for (std::size_t i = 0; i < region.free.size(); ++i) {
        if (found.change[i] == 0) continue;
        const VertexId v = region.free[i];
        const WeightedPoint from = mesh.point(v);
        work_.mesh.set_point(v,
                             mesh.space().with_weight(from, changed_weight(mesh.space(), weights[v], found.change[i])));
        recorder_.placed(v, from, mesh.point(v), kNoEnergy, kNoEnergy);
      }
    }
  }

  /// Inserts a vertex with the weight that the corners have there.
  bool insert(TriangleId t, const WeightedPoint& place) {
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

  /// Splits an edge, on both of its sides.
  bool split(HalfedgeId h, double part) {
    const Mesh& mesh = work_.mesh;
    const WeightedPoint a = mesh.point(mesh.origin(h)), b = mesh.point(mesh.target(h), a);
    const WeightedPoint p = mesh.is_unflippable(h) ? place_on_line(h, part) : middle_of(a, b);
    for (const HalfedgeId side : {h, mesh.twin(h)}) {
      if (!side.valid()) continue;
      for (const HalfedgeId link : {Mesh::next(side), Mesh::prev(side)}) {
        const WeightedPoint q = mesh.point(mesh.origin(link), p), r = mesh.point(mesh.target(link), p);
        if (inlined::orientation(mesh.space(), q, r, p) != Sign::positive) return false;
      }
    }
    flipper_.split(work_, h, p, kNoEnergy, kNoEnergy);
    limits_.grow();
    return true;
  }
  [[nodiscard]] WeightedPoint middle_of(const WeightedPoint& a, const WeightedPoint& b) const {
    const Space& space = work_.mesh.space();
    return space.with_weight(grid_.snap(middle(space, a, b)), 0.5 * (space.weight(a) + space.weight(b)));
  }
  /// Returns the vertex at a part of the way along an edge of the boundary or of a line, in the plane.
  [[nodiscard]] WeightedPoint place_on_line(HalfedgeId h, double part) const {
    const WeightedPoint a = work_.mesh.point(work_.mesh.origin(h)), b = work_.mesh.point(work_.mesh.target(h));
    const Vec2 along = b.position() - a.position();
    const Vec2 x = work_.divided_by(h).nearest(a.position() + part * along, grid_);
    const double l2 = squared_length(along), t = dot(x - a.position(), along) / l2;
    return {x.x, x.y, split_weight(a.w, b.w, l2, t)};
  }

  /// Splits the lines at v at one distance from v. Pieces of one length do not ask each other for more splits. Returns
  /// false if no line is long enough.
  bool cut_corner(VertexId v, double distance) {
    const Mesh& mesh = work_.mesh;
    std::vector<VertexId> ends;
    for (const HalfedgeId h : lines_at(mesh, v)) ends.push_back(mesh.origin(h) == v ? mesh.target(h) : mesh.origin(h));
    bool any = false;
    for (const VertexId end : ends) {
      HalfedgeId h = mesh.find_halfedge(v, end);
      const bool towards = h.valid();
      if (!towards) h = mesh.find_halfedge(end, v);
      const double part = distance / length(mesh.position(end) - mesh.position(v));
      if (part > 1 - EdgeConflict::kLeastPiece || around_.is_rim(v, end) || mesh.is_diagonal(h)) continue;
      any = split(h, towards ? part : 1 - part) || any;
    }
    return any;
  }

  bool remove(VertexId v) {
    const RemovalPlan plan = plan_removal(work_.mesh, v);
    if (plan.status != RemovalStatus::possible) return false;
    flipper_.remove(EventKind::removal, plan, kNoEnergy, kNoEnergy);
    return true;
  }

  /// Returns false if no vertex was missing, or an edge could not be made regular.
  bool refine(const DelaunayRefinement::Sizes& sizes, bool splits_lines) {
    const Mesh& mesh = work_.mesh;
    DelaunayRefinement refinement(mesh, sizes, [&](HalfedgeId h) {
      return splits_lines && !mesh.is_diagonal(h) && !around_.is_rim(mesh.origin(h), mesh.target(h));
    });
    int inserted = 0;
    for (auto place = refinement.next(); place && inserted < kMostInserted; place = refinement.next()) {
      const bool done = place->edge.valid() ? split(place->edge, 0.5) : insert(place->triangle, place->point);
      if (!done) {
        refinement.refuse(*place);
        continue;
      }
      if (!flipper_.restore_all()) return false;
      refinement.update();
      ++inserted;
    }
    return inserted > 0;
  }

  void remove_free_vertices() {
    for (bool removed = true; removed;) {
      removed = false;
      for (const VertexId v : around_.mesh.vertices()) {
        if (!work_.mesh.is_isolated(v) && may_be_removed(work_.mesh, around_.frozen, around_.divided, v)) {
          removed = remove(v) || removed;
        }
      }
    }
  }

  void sweep() {
    const auto is_good = [this](TriangleId t) { return !is_bad(work_.mesh, t); };
    const auto all = work_.mesh.triangles();
    double gamma = kFirstGamma;
    for (int i = 0; i < kSweeps; ++i) {
      state_.model.gamma = {gamma, LengthScale::relative};
      step_.begin_sweep(i, settings_.options.unknowns);
      for (const VertexId v : work_.mesh.vertices()) {
        if (!work_.mesh.is_isolated(v)) step_.improve(v);
      }
      if (settings_.guard != nullptr && !step_.has_moved()) return;  // it refuses all steps
      gamma = std::max(kLeastGamma, kGammaFactor * gamma);
      if (gamma >= kSharp || settings_.accuracy.keeps_lengths()) continue;
      if (std::all_of(all.begin(), all.end(), is_good)) return;
    }
  }

  const Neighborhood& around_;
  std::vector<TraceEvent> events_;
  const Settings settings_;
  const WorkingUnits& grid_;
  WorkingCopy work_;
  SweepState state_;
  Recorder recorder_;
  Flipper flipper_;
  VertexLimits limits_;
  VertexStep step_;
};

}  // namespace

bool inserts_vertices(const Edit& edit) {
  switch (edit.kind) {
    case Edit::insert:
    case Edit::split:
    case Edit::cut_corner:
    case Edit::refine:
    case Edit::remesh:
    case Edit::only_refine:
      return true;
    default:
      return false;
  }
}

bool may_be_removed(const Mesh& mesh, const std::vector<std::uint8_t>& frozen, const DividedEdges& divided,
                    VertexId v) {
  if (frozen[v.index] != 0 || mesh.is_fixed(v)) return false;
  return divided.contains(v) || lines_at(mesh, v).empty();
}

LocalDefect defect_of(const Mesh& mesh, const AccuracyModel& model) {
  LocalDefect s;
  s.violation = missing_lengths(mesh, model);
  for (const TriangleId t : mesh.triangles()) {
    if (!is_bad(mesh, t)) continue;
    ++s.bad;
    s.violation += violation_of(mesh, t);
  }
  return s;
}

TrialResult try_edit(const Neighborhood& around, const Edit& edit, const Settings& settings, const WorkingUnits& grid,
                     bool with_events) {
  TrialResult result = Trial(around, settings, grid, with_events).run(edit, false);
  const Space& space = around.mesh.space();
  const bool may_level = inserts_vertices(edit) && edit.kind != Edit::only_refine && space.is_plane() &&
                         !space.is_periodic() && settings.options.unknowns != Unknowns::positions;
  if (result.valid || !may_level) return result;
  return Trial(around, settings, grid, with_events).run(edit, true);
}

}  // namespace temper
