#include "optimize/repair/trial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/rng.hpp"
#include "feasibility/constraints.hpp"
#include "mesh/bad_triangles.hpp"
#include "optimize/repair/local_copy.hpp"
#include "optimize/repair/refinement.hpp"
#include "optimize/run/judge.hpp"
#include "optimize/run/run.hpp"
#include "temper/detail/necessity.hpp"
#include "topology/locate.hpp"

namespace temper {
namespace {

// Below this γ/ℓ sweeps rarely make well-centered triangles bad again.
constexpr double kSharp = 0.1;
// Length of a random perturbation, relative to the shortest edge. Most longer ones would turn a triangle over.
constexpr double kPerturbation = 0.4;
// Half of the margin of `temper weights`. With more, one triangle would turn bad for the margins of a few others.
constexpr double kWeighedMargin = 0.005;
// Programs with one more ring take four times as long and cure hardly more.
constexpr int kWeighedRings = 2;
// After these sweeps a quick trial ends if this number of triangles more are bad than before, or the guard refuses.
// Cells and flow links settle later than angles.
constexpr int kSweepsOfDoubt = 3, kSweepsOfDoubtByCells = 4;
constexpr std::size_t kDoubtful = 2;
// More vertices than any neighborhood lacks.
constexpr int kMostInserted = 300;

bool lacks_sweeps(const Edit& edit) {
  const auto* const refine = std::get_if<Refine>(&edit);
  return refine != nullptr && !refine->sweeps;
}

class Trial {
 public:
  /// `settings`: by settings_of_copies().
  Trial(const Neighborhood& around, const Settings& settings, const WorkingUnits& grid, const TrialOptions& options)
      : around_(around),
        settings_(settings),
        grid_(grid),
        pace_(options.pace),
        copy_(around, settings, grid, options.with_events) {}

  TrialResult run(const Edit& edit, bool levels) && {
    if (levels && !level_weights()) return {};
    const bool applied = std::visit([this](const auto& e) { return this->apply(e); }, edit);
    if (!applied || !copy_.make_regular()) return {};
    if (lacks_sweeps(edit)) return {true, defect_of(copy_.mesh()), copy_.take_events()};
    // The first γ of sweeps would undo the weights.
    if (!std::holds_alternative<AssignWeights>(edit) && !sweep()) return {};
    TrialResult result;
    result.defect = defect_of(around_, copy_.mesh(), settings_);
    result.valid = copy_.is_regular() && is_guarded();
    result.events = copy_.take_events();
    return result;
  }

 private:
  /// Says whether the neighborhood may be as it is now, in place of what it was: the worst triangle of the input, and
  /// the guard, are its limits.
  [[nodiscard]] bool is_guarded() const {
    const double worst_before = std::max(settings_.worst_violation, worst_violation(around_.mesh));
    if (count_worse(copy_.mesh(), worst_before) > 0) return false;
    if (settings_.guard == nullptr) return true;
    const Guard guard(copy_.mesh(), grid_, settings_.guard);
    const Guard original(around_.mesh, grid_, settings_.guard);
    const GuardValues now = worst(guard, copy_.mesh());
    return now.are_within(guard.limits()) || now.hold(worst(original, around_.mesh), guard.limits());
  }
  [[nodiscard]] GuardValues worst(const Guard& guard, const Mesh& mesh) const {
    GuardValues v = guard.worst(nullptr, around_.outside);
    for (std::size_t i = 0; i < around_.rim.size(); ++i) {
      const HalfedgeId h = mesh.find_halfedge(around_.rim[i][0], around_.rim[i][1]);
      if (h.valid()) v.take(guard.across(h, around_.beyond[i]));
    }
    return v;
  }

  static bool apply(JustSweep /*edit*/) { return true; }
  bool apply(Perturb edit) {
    Rng rng(edit.seed);
    copy_.shake(kPerturbation, rng);
    return true;
  }
  bool apply(const Insert& edit) { return copy_.insert(edit.triangle, edit.place); }
  bool apply(Split edit) { return copy_.split(edit.edge, edit.part); }
  bool apply(Remove edit) { return copy_.remove(edit.vertex); }

  /// Gives the vertices that are not frozen weights that are linear in their positions, as near as possible to the
  /// weights of frozen vertices. Linear weights hide no vertex, also none that comes between. Returns false if an edge
  /// cannot be made regular.
  bool level_weights() {
    const Mesh& mesh = copy_.mesh();
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
      const Vec2 from = mesh.position(v);
      double sum = 0, sum_of_rest = 0;
      each_frozen([&](Vec2 p, double w) {
        const double near = 1 / (squared_length(p - from) * squared_length(p - from));
        sum += near, sum_of_rest += near * (w - mean - dot(slope, p - center));
      });
      const double rest = sum > 0 ? sum_of_rest / sum : 0;
      copy_.set_weight(v, mean + dot(slope, from - center) + rest);
    }
    return copy_.make_regular();
  }

  /// Assigns weights around the bad triangle.
  bool apply(AssignWeights /*edit*/) {
    const Mesh& mesh = copy_.mesh();
    VertexMask free(mesh.n_vertices(), 0);
    const auto corners = mesh.corners(around_.seed);
    for (const VertexId v : corners) free[v] = 1;
    grow(TriangleDemand(mesh, constraints_of(settings_.criterion)), free, {corners.begin(), corners.end()},
         kWeighedRings);
    copy_.assign_weights(std::move(free), kWeighedMargin);
    return true;
  }

  /// Splits the lines at v at one distance from v. Pieces of one length do not ask each other for more splits. Returns
  /// false if no line is long enough.
  bool apply(CutCorner edit) {
    const Mesh& mesh = copy_.mesh();
    const VertexId v = edit.vertex;
    std::vector<VertexId> ends;
    for (const HalfedgeId h : lines_at(mesh, v)) ends.push_back(mesh.origin(h) == v ? mesh.target(h) : mesh.origin(h));
    bool any = false;
    for (const VertexId end : ends) {
      HalfedgeId h = mesh.find_halfedge(v, end);
      const bool towards = h.valid();
      if (!towards) h = mesh.find_halfedge(end, v);
      const double part = edit.distance / length(mesh.position(end) - mesh.position(v));
      if (part > 1 - EdgeConflict::kLeastPiece || around_.is_rim(v, end) || mesh.is_diagonal(h)) continue;
      any = copy_.split(h, towards ? part : 1 - part) || any;
    }
    return any;
  }

  /// Returns false if no vertex was missing, or an edge could not be made regular.
  bool apply(const Refine& edit) {
    if (edit.anew) remove_free_vertices();
    const Mesh& mesh = copy_.mesh();
    DelaunayRefinement refinement(
        mesh, edit.sizes, [&](HalfedgeId h) { return edit.splits_lines && !mesh.is_diagonal(h) && !copy_.is_rim(h); });
    int inserted = 0;
    for (auto place = refinement.next(); place && inserted < kMostInserted; place = refinement.next()) {
      const bool done =
          place->edge.valid() ? copy_.split(place->edge, 0.5) : copy_.insert(place->triangle, place->point);
      if (!done) {
        refinement.refuse(*place);
        continue;
      }
      if (!copy_.make_regular()) return false;
      refinement.update();
      ++inserted;
    }
    return inserted > 0;
  }

  void remove_free_vertices() {
    for (bool removed = true; removed;) {
      removed = false;
      for (const VertexId v : around_.mesh.vertices()) {
        if (copy_.may_be_removed(v)) removed = copy_.remove(v) || removed;
      }
    }
  }

  /// Says whether too many triangles are bad after the first sweeps.
  [[nodiscard]] bool is_hopeless() const {
    const std::size_t before = defect_of(around_, around_.mesh, settings_).bad;
    const std::size_t bad = defect_of(around_, copy_.mesh(), settings_).bad;
    return before > 0 && (bad >= before + kDoubtful || !is_guarded());
  }

  /// Returns false if the trial was given up.
  bool sweep() {
    const Mesh& mesh = copy_.mesh();
    bool hopeless = false;
    const bool by_cells = settings_.guard != nullptr && settings_.guard->has_cells_or_flow();
    const int doubt = by_cells ? kSweepsOfDoubtByCells : kSweepsOfDoubt;
    const auto is_good = [&](TriangleId t) { return !is_bad(mesh, t); };
    const auto all = mesh.triangles();
    copy_.sweep(pace_, [&](int i, double gamma) {
      if (pace_ == Pace::quick && i + 1 == doubt && is_hopeless()) return hopeless = true;
      if (settings_.guard != nullptr && !copy_.has_moved()) return true;  // it refuses all steps
      if (settings_.criterion != Criterion::well_centered)
        return violated_edges(around_, mesh, settings_.criterion).empty();
      if (gamma >= kSharp || settings_.accuracy.keeps_lengths()) return false;
      return std::all_of(all.begin(), all.end(), is_good);
    });
    return !hopeless;
  }

  const Neighborhood& around_;
  const Settings& settings_;
  const WorkingUnits& grid_;
  const Pace pace_;
  LocalCopy copy_;
};

}  // namespace

bool inserts_vertices(const Edit& edit) {
  return std::holds_alternative<Insert>(edit) || std::holds_alternative<Split>(edit) ||
         std::holds_alternative<CutCorner>(edit) || std::holds_alternative<Refine>(edit);
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

LocalDefect defect_of(const Neighborhood& around, const Mesh& local, const Settings& settings) {
  if (settings.criterion == Criterion::well_centered) return defect_of(local, settings.accuracy);
  LocalDefect s;
  for (const ViolatedEdge& violated : violated_edges(around, local, settings.criterion)) {
    ++s.bad;
    s.violation -= violated.dual_over_l;
  }
  return s;
}

TrialResult try_edit(const Neighborhood& around, const Edit& edit, const Settings& settings, const WorkingUnits& grid,
                     const TrialOptions& options) {
  const Settings of_trial = settings_of_copies(settings);
  TrialResult result = Trial(around, of_trial, grid, options).run(edit, false);
  const Space& space = around.mesh.space();
  const bool may_level = inserts_vertices(edit) && !lacks_sweeps(edit) && space.is_plane() && !space.is_periodic() &&
                         settings.options.unknowns != Unknowns::positions;
  if (result.valid || !may_level) return result;
  return Trial(around, of_trial, grid, options).run(edit, true);
}

}  // namespace temper
