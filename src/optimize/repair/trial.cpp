#include "optimize/repair/trial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <vector>

#include "base/rng.hpp"
#include "feasibility/change.hpp"
#include "feasibility/constraints.hpp"
#include "feasibility/potential.hpp"
#include "geometry/predicates_inline.hpp"
#include "geometry/surface.hpp"
#include "geometry/triangle_kernel.hpp"
#include "mesh/bad_triangles.hpp"
#include "optimize/run/judge.hpp"
#include "optimize/run/run.hpp"
#include "optimize/step/vertex_step.hpp"
#include "temper/regularity.hpp"
#include "topology/locate.hpp"

namespace temper {
namespace {

// Circumradius over size above which a triangle is large. An equilateral triangle of the right size has 0.58.
constexpr double kLarge = 0.75;
// A vertex nearer to an edge than this part of the edge's length, or of the size, makes flat triangles.
constexpr double kClearance = 0.4;

double distance_to_segment(Vec3 x, Vec3 a, Vec3 b) {
  const Vec3 along = b - a;
  const double t = std::clamp(dot(x - a, along) / squared_length(along), 0.0, 1.0);
  return length(x - (a + t * along));
}

/// Delaunay refinement of a place that has too few vertices. New vertices go to circumcenters of triangles that are too
/// large.
///
/// The boundary never changes: vertices too near to it are not inserted. The target size at x is the least s_v + g |x −
/// v| over the vertices v of boundary, constrained edges and rim. Here s_v is the mean length of these edges at v.
class DelaunayRefinement {
 public:
  /// `gradation`: g, the growth of the size with distance.
  DelaunayRefinement(const Mesh& mesh, double gradation) : mesh_(mesh), gradation_(gradation) {
    std::vector<double> sum(mesh.n_vertices(), 0);
    std::vector<int> count(mesh.n_vertices(), 0);
    for (const HalfedgeId h : mesh.halfedges()) {
      if (mesh.is_erased(Mesh::triangle(h)) || !mesh.is_unflippable(h) || !mesh.is_edge_representative(h)) continue;
      const VertexId a = mesh.origin(h), b = mesh.target(h);
      segments_.push_back({place(a), place(b)});
      for (const VertexId v : {a, b}) {
        sum[v.index] += length(place(b) - place(a));
        ++count[v.index];
      }
    }
    for (const VertexId v : mesh.vertices()) {
      if (count[v.index] > 0) sources_.push_back({place(v), sum[v.index] / count[v.index]});
    }
  }

  /// The place of a new vertex and the triangle strictly around it. If no triangle is too large, next() returns none.
  struct Place {
    TriangleId triangle;
    WeightedPoint point;  ///< without a weight
  };

  std::optional<Place> next() {
    double worst = kLarge;
    std::optional<Place> found;
    for (const TriangleId t : mesh_.triangles()) {
      if (mesh_.is_erased(t)) continue;
      const auto [a, b, c] = mesh_.corners(t);
      const Space& space = mesh_.space();
      const auto bare = [&](VertexId v) { return space.with_weight(mesh_.point(v), 0); };
      const WeightedPoint o = orthocenter(space, bare(a), bare(b), bare(c));
      if (!std::isfinite(o.x) || !std::isfinite(o.y) || !std::isfinite(o.w)) continue;
      const Vec3 x = position_in_space(space, o);
      const double relative = length(x - place(a)) / size(x);
      if (relative <= worst || refused_.count({o.x, o.y, o.w}) > 0) continue;
      const Location at = too_near_to_edges(x) ? Location() : locate(mesh_, o, t);
      if (at.kind != Location::Kind::in_triangle) {
        refuse(o);
        continue;
      }
      worst = relative;
      found = {at.triangle, o};
    }
    return found;
  }

  /// Refuses a place at which no vertex can be inserted.
  void refuse(const WeightedPoint& p) { refused_.insert({p.x, p.y, p.w}); }

 private:
  struct Source {
    Vec3 at;
    double size;
  };
  struct Segment {
    Vec3 a, b;
  };

  [[nodiscard]] Vec3 place(VertexId v) const { return position_in_space(mesh_.space(), mesh_.point(v)); }

  [[nodiscard]] double size(Vec3 x) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Source& s : sources_) least = std::min(least, s.size + gradation_ * length(x - s.at));
    return least;
  }

  [[nodiscard]] bool too_near_to_edges(Vec3 x) const {
    const double wanted = size(x);
    return std::any_of(segments_.begin(), segments_.end(), [&](const Segment& s) {
      return distance_to_segment(x, s.a, s.b) < kClearance * std::min(length(s.b - s.a), wanted);
    });
  }

  const Mesh& mesh_;
  double gradation_;
  std::vector<Source> sources_;
  std::vector<Segment> segments_;
  std::set<std::array<double, 3>> refused_;
};

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
        work_(WorkingCopy::part(around.mesh)),
        state_(settings_),
        recorder_(settings_.hooks.tracer, work_, 1),
        flipper_(work_.mesh, settings_, state_, recorder_),
        limits_(work_.mesh, settings_, grid),
        step_({work_.mesh, settings_, state_, grid, limits_, recorder_}, flipper_) {
    for (const VertexId v : around.mesh.vertices()) {
      if (around.frozen[v.index] != 0) limits_.freeze(v);
    }
  }
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;
  ~Trial() = default;

  TrialResult run(const Edit& edit) && {
    if (!apply(edit) || !flipper_.restore_all()) return {};
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
        return split(edit.edge);
      case Edit::remove:
        return remove(edit.vertex);
      case Edit::remesh:
        remove_free_vertices();
        return refine(edit.gradation);
      case Edit::refine:
        return refine(edit.gradation);
    }
    return false;
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

  bool split(HalfedgeId h) {
    const Mesh& mesh = work_.mesh;
    const auto [a, b, c, d] = inlined::quad(mesh, h);
    const WeightedPoint half = grid_.snap(middle(mesh.space(), mesh.point(a), mesh.point(b, mesh.point(a))));
    const WeightedPoint p = mesh.space().with_weight(half, 0.5 * (mesh.weight(a) + mesh.weight(b)));
    for (const auto& [q, r] : {std::pair(b, c), std::pair(c, a), std::pair(a, d), std::pair(d, b)}) {
      if (inlined::orientation(mesh.space(), mesh.point(q, p), mesh.point(r, p), p) != Sign::positive) return false;
    }
    flipper_.split(work_, h, p, kNoEnergy, kNoEnergy);
    limits_.grow();
    return true;
  }

  bool remove(VertexId v) {
    const RemovalPlan plan = plan_removal(work_.mesh, v);
    if (plan.status != RemovalStatus::possible) return false;
    flipper_.remove(EventKind::removal, plan, kNoEnergy, kNoEnergy);
    return true;
  }

  /// Returns false if no vertex was missing, or an edge could not be made regular.
  bool refine(double gradation) {
    DelaunayRefinement refinement(work_.mesh, gradation);
    int inserted = 0;
    for (auto place = refinement.next(); place && inserted < kMostInserted; place = refinement.next()) {
      if (!insert(place->triangle, place->point)) {
        refinement.refuse(place->point);
        continue;
      }
      if (!flipper_.restore_all()) return false;
      ++inserted;
    }
    return inserted > 0;
  }

  void remove_free_vertices() {
    for (bool removed = true; removed;) {
      removed = false;
      for (const VertexId v : around_.mesh.vertices()) {
        if (!work_.mesh.is_isolated(v) && may_be_removed(work_.mesh, around_.frozen, v)) removed = remove(v) || removed;
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

bool may_be_removed(const Mesh& mesh, const std::vector<std::uint8_t>& frozen, VertexId v) {
  if (frozen[v.index] != 0 || mesh.is_boundary(v)) return false;
  for (const HalfedgeId h : mesh.star(v)) {
    if (mesh.is_constrained(h)) return false;
  }
  return !mesh.is_fixed(v);
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
  return Trial(around, settings, grid, with_events).run(edit);
}

}  // namespace temper
