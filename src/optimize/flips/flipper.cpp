#include "optimize/flips/flipper.hpp"

#include <utility>

#include "base/sort_unique.hpp"
#include "energy/patch.hpp"
#include "mesh/blocks.hpp"
#include "optimize/flips/guard.hpp"
#include "optimize/flips/size_band.hpp"
#include "regularity/hidden.hpp"

namespace temper {
namespace {

// Largest number of flips in one vertex step. More than a few flips are a cascade that rarely pays.
constexpr std::size_t kMostFlips = 64;

/// Watches the flips of one run of Lawson's algorithm.
struct FlipWatch {
  const EnergyModel& model;
  std::optional<double>& change;     ///< if present, grows by the change of energy
  std::vector<FlipRecord>* records;  ///< of the trace; null without one
  SizeBand* band;                    ///< or null
  Guard* guard;                      ///< or null

  void before(const Mesh& mesh, HalfedgeId h) {
    if (band != nullptr) band->about_to_flip(h);
    if (guard != nullptr) guard->about_to_flip(h);
    if (!change && records == nullptr) return;
    const double energy = flip_energy(mesh, model, h);
    if (change) *change -= energy;
    if (records == nullptr) return;
    const auto [a, b, c, d] = inlined::quad(mesh, h);
    records->push_back({a, b, c, d, energy, 0});
  }
  void after(const Mesh& mesh, HalfedgeId h) {
    if (!change && records == nullptr) return;
    const double energy = flip_energy(mesh, model, h);
    if (change) *change += energy;
    if (records != nullptr) records->back().after = energy;
  }
};

}  // namespace

/// Runs Lawson's algorithm on the queued edges. If `change` is present, the flips' change of energy is added to it.
LawsonRun Flipper::run(std::optional<double>& change, std::size_t max_flips, SizeBand* band, Guard* guard,
                       const Part& part) {
  if (band != nullptr) band->begin_flips();
  if (guard != nullptr) guard->begin_flips(part);
  FlipWatch watch{state_.model, change, recorder_.on() ? &records_ : nullptr, band, guard};
  return lawson_.run(mesh_, watch, max_flips, PowerTest(), part);
}

Flipper::Settled Flipper::settle(const Step& step) {
  lawson_.clear();
  records_.clear();
  bool regular = true;
  for (const HalfedgeId h : mesh_.star(step.v)) {
    for (const HalfedgeId e : {h, Mesh::next(h)}) {
      if (mesh_.is_boundary(e) || mesh_.is_constrained(e)) continue;
      if (PowerTest()(mesh_, inlined::quad(mesh_, e)) == Sign::positive) {
        lawson_.push(e);
        regular = false;
      }
    }
  }
  if (regular) {
    recorder_.placed(step.v, step.origin, mesh_.point(step.v), step.before, step.after);
    return Settled::done;
  }
  std::optional<double> change;
  if (step.must_pay) change = step.after - step.before;
  const LawsonRun result = run(change, kMostFlips, step.band, step.guard, step.part);
  const bool pays = !change || *change < 0;
  const WeightedPoint there = mesh_.point(step.v);
  // In an unfinished run, the quad of a stuck edge may be partly outside.
  const bool hides = result.finished && !lawson_.stuck(mesh_).empty();
  const bool in_limits = result.finished && (step.band == nullptr || step.band->allow_flips()) &&
                         (step.guard == nullptr || step.guard->allow_flips());
  if (!in_limits || !pays || (hides && !accept_hidden())) {
    lawson_.rollback(mesh_);
    mesh_.set_point(step.v, step.origin);
    recorder_.undone(step.v, step.before, change ? step.before + *change : step.after);
    return result.escaped ? Settled::escaped : Settled::undone;
  }
  changes_.flips += result.flips;
  if (log_ != nullptr) log_->insert(log_->end(), lawson_.journal().begin(), lawson_.journal().end());
  recorder_.placed(step.v, step.origin, there, step.before, step.after);
  recorder_.flipped(records_);
  if (hides) treat_hidden();
  return Settled::done;
}

/// Says whether the policy lets flips hide the vertices at stuck edges.
bool Flipper::accept_hidden() {
  if (!settings_.policy.removes_hidden()) return settings_.policy.keeps_hidden();
  for (const VertexId v : hidden_at_stuck_edges()) {
    plan_ = plan_removal(mesh_, v, std::move(plan_));
    if (plan_.status != RemovalStatus::possible) return false;
  }
  return true;
}

std::vector<VertexId> Flipper::hidden_at_stuck_edges() {
  std::vector<VertexId> hidden;
  for (const HalfedgeId h : lawson_.stuck(mesh_)) hidden.push_back(reflex_end(mesh_, h));
  sort_unique(hidden);
  return hidden;
}

/// Treats hidden vertices by the policy, after the flips that hide them.
void Flipper::treat_hidden() {
  std::vector<VertexId> stay = hidden_at_stuck_edges();
  if (settings_.policy.removes_hidden()) {
    RestorationObserver observer;
    observer.flipped = [&](VertexId a, VertexId b, VertexId c, VertexId d) {
      const FlipRecord record{a, b, c, d, kNoEnergy, kNoEnergy};
      recorder_.flipped({&record, 1});
    };
    observer.removing = [&](const RemovalPlan& plan) {
      recorder_.removed(EventKind::removal, plan, kNoEnergy, kNoEnergy);
    };
    const HiddenVertices found = remove_hidden(mesh_, lawson_, &observer);
    changes_.flips += found.flips;
    changes_.removed += found.removed.size();
    stay = hidden_at_stuck_edges();
  }
  for (const VertexId v : stay) recorder_.hidden(v);
}

/// Queues the edges that are not regular, in the order of push_all. The flips are the same as if all edges were queued:
/// Lawson skips regular edges, and queues an edge that a flip makes irregular.
void Flipper::push_irregular() {
  const std::size_t n = mesh_.n_halfedges();
  std::vector<std::vector<HalfedgeId>> found((n + kLoopBlock - 1) / kLoopBlock);
  for_blocks(n, settings_.executor(), [&](std::size_t first, std::size_t last) {
    for (const HalfedgeId h : IdRange<HalfedgeId>(HalfedgeId(first), HalfedgeId(last))) {
      if (mesh_.is_boundary(h) || !mesh_.is_edge_representative(h) || mesh_.is_constrained(h)) continue;
      if (PowerTest()(mesh_, inlined::quad(mesh_, h)) == Sign::positive) found[first / kLoopBlock].push_back(h);
    }
  });
  for (const auto& edges : found) {
    for (const HalfedgeId h : edges) lawson_.push(h);
  }
}

bool Flipper::restore_all() {
  lawson_.clear();
  records_.clear();
  push_irregular();
  std::optional<double> no_price;
  const LawsonRun result = run(no_price, Lawson::kNoCap);
  const bool hides = !lawson_.stuck(mesh_).empty();
  if (hides && settings_.policy.undoes_hidden()) {
    lawson_.rollback(mesh_);
    return false;
  }
  changes_.flips += result.flips;
  recorder_.flipped(records_);
  if (hides) treat_hidden();
  return settings_.policy.keeps_hidden() || lawson_.stuck(mesh_).empty();
}

void Flipper::remove(EventKind kind, const RemovalPlan& plan, double before, double after) {
  recorder_.removed(kind, plan, before, after);
  remove_vertex(mesh_, plan);
  ++changes_.removed;
}

void Flipper::flip(HalfedgeId h, double before, double after) {
  const auto [a, b, c, d] = inlined::quad(mesh_, h);
  const FlipRecord record{a, b, c, d, before, after};
  inlined::flip(mesh_, h);
  recorder_.flipped({&record, 1});
  ++changes_.flips;
}

void Flipper::repeat(std::span<const HalfedgeId> flips) {
  for (const HalfedgeId h : flips) inlined::flip(mesh_, h);
  changes_.flips += flips.size();
}

VertexId Flipper::insert(WorkingCopy& work, TriangleId t, const WeightedPoint& p, double before, double after) {
  const auto corners = mesh_.corners(t);
  const VertexId v = insert_in_triangle(mesh_, t, p);
  work.name_new();
  recorder_.inserted(v, corners, before, after);
  return v;
}

VertexId Flipper::split(WorkingCopy& work, HalfedgeId h, const WeightedPoint& p, double before, double after) {
  const HalfedgeId twin = mesh_.twin(h);
  const std::array quad = {mesh_.origin(h), mesh_.target(h), mesh_.opposite(h),
                           twin.valid() ? mesh_.opposite(twin) : VertexId()};
  const bool divides = mesh_.is_unflippable(h) && mesh_.space().is_plane() && !mesh_.space().is_periodic();
  std::optional<DividedEdge> divided;
  if (divides) divided = work.divided_by(h);
  const VertexId v = split_edge(mesh_, h, p);
  work.name_new();
  if (divided) work.divided.emplace(work.order->vertices[v], *divided);
  recorder_.split(v, quad, before, after);
  return v;
}

VertexId Flipper::commit(WorkingCopy& work, const InsertionPlan& plan, double before, double after) {
  const VertexId v = plan.edge.valid() ? split(work, plan.edge, plan.point, before, after)
                                       : insert(work, plan.triangle, plan.point, before, after);
  for (const auto& [a, b] : plan.flips) flip(mesh_.find_halfedge(a, b), kNoEnergy, kNoEnergy);
  return v;
}

}  // namespace temper
