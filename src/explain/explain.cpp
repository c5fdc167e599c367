// From what is certain and small to what is not:
//
//   edges that stay and leave their dual no place to cross: the bad triangles there      split
//   each bad triangle, worst first: is there a conflict among it and those around it?     edge, fan, patch
//   what is left, by connected groups: is there one within two rings of the group?        edge, fan, patch
//   nothing found, the mesh not too large: the whole mesh                                 edge, fan, patch
//   what is left has weights                                                              weights
//
// A triangle of one reason is left out of all later questions. So conflicts have no bad triangle in common, and each
// needs a cure of its own. Each conflict has at least one bad triangle: the present weights suit any set without one.
#include "temper/explain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/assert.hpp"
#include "base/sort_unique.hpp"
#include "explain/conflict.hpp"
#include "explain/cures.hpp"
#include "feasibility/certify.hpp"
#include "geometry/surface.hpp"
#include "mesh/bad_triangles.hpp"
#include "quality/measure.hpp"
#include "temper/topology.hpp"
#include "topology/rings.hpp"

namespace temper {
namespace {

constexpr int kRings = 2;           // around a group: as find_weights begins
constexpr double kSame = 1e-9;      // margins are known to about this
constexpr std::size_t kBeats = 64;  // bad triangles between two calls of progress

struct BadTriangle {
  double margin = 0;
  Vec2 at;
  TriangleId triangle;
  /// Ties by place, so that numbers do not matter.
  friend bool operator<(const BadTriangle& a, const BadTriangle& b) {
    if (a.margin != b.margin) return a.margin < b.margin;
    if (a.at.x != b.at.x) return a.at.x < b.at.x;
    return a.at.y < b.at.y;
  }
};

std::vector<BadTriangle> worst_first(const Mesh& mesh, const std::vector<TriangleId>& triangles) {
  std::vector<BadTriangle> bad;
  bad.reserve(triangles.size());
  for (const TriangleId t : triangles) {
    bad.push_back({measure_triangle(mesh, t).margin(), middle_of(mesh, t), t});
  }
  std::sort(bad.begin(), bad.end());
  return bad;
}

int rank(const Reason& reason) {
  if (reason.kind == ReasonKind::split) return -1;
  return reason.kind == ReasonKind::weights ? 2 : reason.kind == ReasonKind::undecided ? 1 : 0;
}
/// Rounded: twins of a symmetric mesh are listed in the order of their places, whatever their last digits.
double severity(const Reason& reason) {
  if (reason.must_split) return std::round(reason.must_split->sum / kSame);
  return std::round((rank(reason) == 0 ? reason.margin : reason.least_margin) / kSame);
}

void measure_bad(const Mesh& mesh, Reason& reason) {
  const std::vector<BadTriangle> bad = worst_first(mesh, reason.bad);
  for (std::size_t i = 0; i < bad.size(); ++i) reason.bad[i] = bad[i].triangle;
  reason.least_margin = bad.front().margin;
  reason.at = bad.front().at;
}

Vec2 split_point(const Mesh& mesh, const EdgeConflict& c) {
  const Surface surface(mesh.space());
  const Vec3 u = surface.place(mesh.point(mesh.origin(c.edge))), v = surface.place(mesh.point(mesh.target(c.edge)));
  return mesh.space().as_shown(surface.between(u, v, c.split_at));
}

void add_split(const Mesh& mesh, Reason& reason, bool checked) {
  const EdgeConflict& c = *reason.must_split;
  const VertexId u = mesh.origin(c.edge), v = mesh.target(c.edge);
  Cure cure;
  cure.action = mesh.is_boundary(c.edge) ? Cure::Action::split_boundary : Cure::Action::split_edge;
  cure.edge = {u, v};
  cure.at = split_point(mesh, c);
  reason.cures_searched = checked;
  if (checked) {
    Mesh split = mesh;
    const InsertionPlan plan = plan_split(split, c.edge, c.split_at);
    if (plan.status == InsertionStatus::possible || plan.status == InsertionStatus::not_regular) {
      const VertexId middle = insert_vertex(split, plan);
      const auto is_free = [&](VertexId p, VertexId q) {
        const HalfedgeId h = split.find_halfedge(p, q);
        return !edge_conflict(split, h.valid() ? h : split.find_halfedge(q, p));
      };
      cure.ends_conflict = is_free(u, middle) && is_free(middle, v);
      cure.at = split.space().as_shown(Surface(split.space()).place(split.point(middle)));
    }
  }
  reason.cures.push_back(cure);
}

/// The number of vertices near a reason whose weights these change.
std::size_t changed_near(const Mesh& mesh, const Reason& reason, const IdVector<VertexId, double>& weights) {
  std::vector<VertexId> near;
  for (const TriangleId t : triangles_around(mesh, reason.bad)) {
    for (const VertexId v : mesh.corners(t)) near.push_back(v);
  }
  sort_unique(near);
  return static_cast<std::size_t>(std::count_if(near.begin(), near.end(), [&](VertexId v) { return weights[v] != 0; }));
}

bool has_equations(const Certificate& certificate) {
  return std::any_of(certificate.terms.begin(), certificate.terms.end(),
                     [](const Certificate::Term& term) { return is_equation(term.constraint); });
}

class Explainer {
 public:
  /// `pieces`: null, or what has this mesh.
  Explainer(const Mesh& mesh, const MetricMesh* pieces, LpSolver& solver, const ExplainOptions& options)
      : mesh_(mesh),
        pieces_(pieces),
        seams_(pieces != nullptr ? seams_of(*pieces) : std::vector<SeamEdge>()),
        solver_(solver),
        options_(options),
        demand_(pieces != nullptr ? TriangleDemand(*pieces, Constraints::well_centered)
                                  : TriangleDemand(mesh, Constraints::well_centered)),
        bad_(worst_first(mesh, bad_triangles(mesh))),
        state_(mesh.n_triangles(), kGood) {
    for (const BadTriangle& bad : bad_) state_[bad.triangle] = kUnexplained;
  }

  Expected<Explanation> run() {
    result_.triangles = mesh_.n_triangles();
    result_.bad = bad_.size();
    own_edges_to_split();
    if (!ask_rings()) return InputError{ErrorCode::invalid_option, "", "explain: stopped before all was explained"};
    ask_groups();
    ask_whole();
    explain_rest();
    std::stable_sort(result_.reasons.begin(), result_.reasons.end(), [](const Reason& a, const Reason& b) {
      if (rank(a) != rank(b)) return rank(a) < rank(b);
      if (severity(a) != severity(b)) return severity(a) < severity(b);
      return a.at.x != b.at.x ? a.at.x < b.at.x : a.at.y < b.at.y;
    });
    add_cures();
    return std::move(result_);
  }

 private:
  enum State : std::uint8_t { kGood, kUnexplained, kOwned };

  /// The triangles at the corners of these, and at all copies of corners; sorted.
  [[nodiscard]] std::vector<TriangleId> around(std::span<const TriangleId> triangles) const {
    std::vector<CellId> cells;
    for (const TriangleId t : triangles) {
      for (const VertexId v : mesh_.corners(t)) demand_.add_cells_around(v, cells);
    }
    std::vector<TriangleId> all;
    all.reserve(cells.size());
    for (const CellId cell : cells) all.emplace_back(cell.index);
    sort_unique(all);
    return all;
  }
  [[nodiscard]] bool is_on_interface(VertexId v) const {
    if (pieces_ == nullptr) return false;
    std::size_t copies = 0;
    demand_.for_each_copy(v, [&](VertexId) { ++copies; });
    return copies > 1;
  }
  [[nodiscard]] bool is_seam(HalfedgeId h) const {
    return std::any_of(seams_.begin(), seams_.end(), [h](const SeamEdge& s) { return s.one == h || s.other == h; });
  }
  [[nodiscard]] bool touches_interface(std::span<const TriangleId> triangles) const {
    return std::any_of(triangles.begin(), triangles.end(), [&](TriangleId t) {
      const auto corners = mesh_.corners(t);
      return std::any_of(corners.begin(), corners.end(), [&](VertexId v) { return is_on_interface(v); });
    });
  }

  [[nodiscard]] std::vector<TriangleId> without_owned(std::vector<TriangleId> triangles) const {
    std::erase_if(triangles, [&](TriangleId t) { return state_[t] == kOwned; });
    return triangles;
  }

  /// The bad triangles at each edge that must be split; if these triangles are good, the bad ones near the edge.
  void own_edges_to_split() {
    if (bad_.empty()) return;
    for (const EdgeConflict& c : edges_that_must_be_split(mesh_)) {
      Reason reason;
      reason.kind = ReasonKind::split;
      reason.must_split = c;
      std::vector<TriangleId> at_edge = {Mesh::triangle(c.edge)};
      if (!mesh_.is_boundary(c.edge)) at_edge.push_back(Mesh::triangle(mesh_.twin(c.edge)));
      for (int ring = 0; ring <= kRings && reason.bad.empty(); ++ring) {
        if (ring > 0) at_edge = around(at_edge);
        for (const TriangleId t : at_edge) {
          if (state_[t] != kUnexplained) continue;
          state_[t] = kOwned;
          reason.bad.push_back(t);
        }
      }
      if (!reason.bad.empty()) measure_bad(mesh_, reason);
      reason.at = split_point(mesh_, c);
      reason.at_interface = is_seam(c.edge);
      result_.reasons.push_back(std::move(reason));
      result_.verdict = Feasibility::infeasible;
    }
  }

  void own(Conflict conflict) {
    Reason reason;
    for (const TriangleId t : conflict.triangles) {
      if (state_[t] != kUnexplained) continue;
      reason.bad.push_back(t);
      state_[t] = kOwned;
    }
    measure_bad(mesh_, reason);
    reason.crossing = crossing_conflict(mesh_, conflict.triangles);
    reason.center = fan_center(mesh_, conflict.triangles);
    reason.kind = kind_of(conflict, reason.center.has_value(), reason.crossing.has_value());
    if (has_equations(conflict.best.certificate)) {
      reason.kind = ReasonKind::at_interface;
      reason.crossing.reset();
      reason.center.reset();
    }
    reason.at_interface = touches_interface(conflict.triangles);
    reason.margin = conflict.best.margin;
    reason.checked = conflict.triangles.size();
    reason.free = free_vertices(mesh_, conflict.triangles);
    reason.certificate = std::move(conflict.best.certificate);
    reason.conflict = std::move(conflict.triangles);
    result_.reasons.push_back(std::move(reason));
    result_.verdict = Feasibility::infeasible;
  }

  /// Conflicts among these triangles, until none needs `seed`. Each owns at least one bad triangle.
  void find_conflicts(const std::vector<TriangleId>& region, TriangleId seed) {
    while (state_[seed] == kUnexplained) {
      std::optional<Conflict> conflict = find_conflict({mesh_, demand_}, without_owned(region), seed, solver_);
      if (!conflict) return;
      own(*std::move(conflict));
    }
  }

  /// false: stopped.
  bool ask_rings() {
    for (std::size_t i = 0; i < bad_.size(); ++i) {
      const bool beat = options_.progress && i % kBeats == 0;
      if (beat && options_.progress(i, bad_.size()) == Continue::no) return false;
      find_conflicts(around({&bad_[i].triangle, 1}), bad_[i].triangle);
    }
    return !options_.progress || options_.progress(bad_.size(), bad_.size()) == Continue::yes;
  }

  struct Group {
    std::vector<TriangleId> bad;
    std::vector<TriangleId> region;  ///< some rings around, without what is owned; empty when that is too large
  };

  /// Bad triangles not explained so far, joined where they touch; worst first.
  [[nodiscard]] std::vector<Group> groups() const {
    std::vector<Group> all;
    IdVector<TriangleId, std::uint8_t> seen(mesh_.n_triangles(), 0);
    for (const BadTriangle& bad : bad_) {
      if (state_[bad.triangle] != kUnexplained || seen[bad.triangle] != 0) continue;
      Group group;
      group.bad = {bad.triangle};
      seen[bad.triangle] = 1;
      for (std::size_t i = 0; i < group.bad.size(); ++i) {
        for (const TriangleId t : around({&group.bad[i], 1})) {
          if (state_[t] != kUnexplained || seen[t] != 0) continue;
          seen[t] = 1;
          group.bad.push_back(t);
        }
      }
      if (group.bad.size() <= options_.whole) group.region = group.bad;
      for (int ring = 0; ring < kRings && !group.region.empty(); ++ring) {
        group.region = around(group.region);
        if (group.region.size() > options_.whole) group.region.clear();
      }
      group.region = without_owned(std::move(group.region));
      all.push_back(std::move(group));
    }
    return all;
  }

  void ask_groups() {
    for (const Group& group : groups()) {
      for (const TriangleId t : group.bad) {
        if (group.region.empty() || state_[t] != kUnexplained) continue;
        find_conflicts(group.region, t);
        if (state_[t] == kUnexplained) break;  // no conflict is left in this region
      }
    }
  }

  void ask_whole() {
    if (bad_.empty()) result_.verdict = Feasibility::feasible;
    if (bad_.empty() || !result_.reasons.empty() || keeps_weights_) return;
    if (mesh_.n_triangles() > options_.whole && bad_.size() > options_.whole) return;
    WeightOptions weights;
    weights.goal = WeightGoal::margin;
    weights.whole = options_.whole;
    auto report = pieces_ != nullptr ? find_weights(*pieces_, solver_, weights) : find_weights(mesh_, solver_, weights);
    if (!report) return;
    result_.verdict = report->verdict;
    result_.changed = report->moved;
    result_.margin = report->asked;
    if (report->verdict == Feasibility::feasible) weights_ = std::move(report->weights);
    if (report->verdict != Feasibility::infeasible) return;
    if (auto conflict = shrink({mesh_, demand_}, report->certificate, bad_.front().triangle, solver_))
      own(*std::move(conflict));
  }

  void explain_rest() {
    for (Group& group : groups()) {
      Reason reason;
      reason.bad = std::move(group.bad);
      reason.free = free_vertices(mesh_, reason.bad);
      measure_bad(mesh_, reason);
      find_margin(reason, group.region);
      result_.reasons.push_back(std::move(reason));
    }
  }

  /// Says whether weights exist that suit these triangles together; measures their margin.
  bool have_weights(Reason& reason, const std::vector<TriangleId>& triangles) {
    const BestMargin best = best_margin_of(demand_, as_cells(triangles), solver_);
    reason.margin = std::min(reason.margin, best.margin);
    reason.checked = std::max(reason.checked, triangles.size());
    return best.status == LpStatus::optimal && suits(mesh_, triangles, best);
  }

  /// Finds the margin of the region. If the region is too large or close to a conflict, finds the margins of each bad
  /// triangle with the triangles that touch it.
  void find_margin(Reason& reason, const std::vector<TriangleId>& region) {
    reason.margin = kUnbounded;
    bool found = !region.empty() && have_weights(reason, region);
    if (!found) {
      reason.each = true;
      reason.margin = kUnbounded, reason.checked = 0;
      found = true;
      for (const TriangleId t : reason.bad) found = have_weights(reason, without_owned(around({&t, 1}))) && found;
    }
    reason.kind = found || result_.verdict == Feasibility::feasible ? ReasonKind::weights : ReasonKind::undecided;
  }

  void add_cures() {
    std::vector<Reason*> conflicts;
    std::size_t splits = 0;
    for (Reason& reason : result_.reasons) {
      if (reason.kind == ReasonKind::split) {
        add_split(mesh_, reason, splits++ < options_.cures && !reason.at_interface);
        if (reason.at_interface) reason.cures.back().action = Cure::Action::split_interface;
        continue;
      }
      if (reason.kind == ReasonKind::at_interface)
        add_split_of_interface(reason);
      else if (rank(reason) == 0)
        conflicts.push_back(&reason);
      if (reason.kind == ReasonKind::weights && !keeps_weights_) add_find_weights(reason);
      if (rank(reason) != 0 && !reason.free.empty()) reason.cures.emplace_back();  // optimize
    }
    for (std::size_t i = 0; i < conflicts.size(); ++i) {
      Reason& reason = *conflicts[i];
      const Conflict conflict = {reason.conflict, {}};
      reason.cures_searched = i < options_.cures;
      if (!reason.cures_searched) {
        reason.cures = suggested_cures(mesh_, conflict);
        continue;
      }
      reason.cures = find_cures(mesh_, conflict, others_near(reason), solver_);
      if (!touches_interface(around(conflict.triangles))) continue;
      for (Cure& cure : reason.cures) cure.verified = false;  // trials do not know the equations
    }
  }

  /// Halves the interface edge whose equation counts most in the proof, in the piece of the worst triangle.
  void add_split_of_interface(Reason& reason) const {
    const auto squared = [&](VertexId p, VertexId q) { return squared_length(mesh_.position(q) - mesh_.position(p)); };
    const WeightConstraint* most = nullptr;
    double largest = -1;
    for (const auto& [c, multiplier] : reason.certificate.terms) {
      if (!is_equation(c)) continue;
      const double size = std::abs(multiplier) * squared(c.p, c.q) * squared(c.r, c.s);
      if (size > largest) most = &c, largest = size;
    }
    const auto is_here = [&](VertexId v) {
      return mesh_.region(Mesh::triangle(mesh_.outgoing(v))) == mesh_.region(reason.bad.front());
    };
    const bool here = is_here(most->p) || !is_here(most->r);
    Cure cure;
    cure.action = Cure::Action::split_interface;
    cure.edge = here ? std::vector{most->p, most->q} : std::vector{most->r, most->s};
    cure.at = 0.5 * (mesh_.position(cure.edge[0]) + mesh_.position(cure.edge[1]));
    reason.cures.push_back(cure);
    if (!reason.free.empty()) reason.cures.emplace_back();  // optimize
  }

  /// Bad triangles near a conflict that have a reason of their own.
  [[nodiscard]] std::vector<TriangleId> others_near(const Reason& reason) const {
    std::vector<TriangleId> others = around(reason.conflict);
    std::erase_if(others, [&](TriangleId t) {
      const bool own = std::binary_search(reason.conflict.begin(), reason.conflict.end(), t);
      return own || state_[t] != kOwned;
    });
    return others;
  }

  void add_find_weights(Reason& reason) const {
    Cure cure;
    cure.action = Cure::Action::find_weights;
    cure.verified = true;
    const bool whole = result_.verdict == Feasibility::feasible;
    cure.triangles = whole ? mesh_.n_triangles() : reason.checked;
    cure.margin = whole ? result_.margin : reason.margin;
    cure.changed = weights_.empty() ? 0 : changed_near(mesh_, reason, weights_);
    reason.cures.push_back(cure);
  }

  const Mesh& mesh_;
  const MetricMesh* const pieces_;  ///< null without tensors
  const std::vector<SeamEdge> seams_;
  LpSolver& solver_;
  const ExplainOptions& options_;
  const TriangleDemand demand_;
  const bool keeps_weights_ = has_quadrilaterals(mesh_);  ///< each of these has one center
  const std::vector<BadTriangle> bad_;
  IdVector<TriangleId, std::uint8_t> state_;
  IdVector<VertexId, double> weights_;  ///< that cure the whole mesh; empty when there are none, or nobody asked
  Explanation result_;
};

}  // namespace

std::span<const std::string_view> words_of(ReasonKind) {
  static constexpr std::string_view kNames[] = {"split", "edge", "fan", "patch", "interface", "weights", "undecided"};
  return kNames;
}
std::string_view name(ReasonKind kind) { return words_of(kind)[static_cast<std::size_t>(kind)]; }

std::span<const std::string_view> words_of(Cure::Action) {
  static constexpr std::string_view kNames[] = {"find_weights",  "optimize",   "move_vertex",    "flip_edge",
                                                "insert_vertex", "split_edge", "split_boundary", "split_interface"};
  return kNames;
}
std::string_view name(Cure::Action action) { return words_of(action)[static_cast<std::size_t>(action)]; }

Expected<Explanation> explain(const Mesh& mesh, LpSolver& solver, const ExplainOptions& options) {
  TEMPER_ASSERT_SLOW(!has_erased_triangles(mesh));
  if (auto error = expect_no_period(mesh, "explain()")) return *std::move(error);
  return Explainer(mesh, nullptr, solver, options).run();
}

Expected<Explanation> explain(const MetricMesh& pieces, LpSolver& solver, const ExplainOptions& options) {
  return Explainer(pieces.mesh, pieces.is_cut() ? &pieces : nullptr, solver, options).run();
}

}  // namespace temper
