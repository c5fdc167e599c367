// Edits next to bad triangles: the best one of a copy of a few rings is made in the mesh.
#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

#include "surfaces/optimize/patch.hpp"
#include "surfaces/optimize/run.hpp"

namespace temper::surfaces {
namespace {

constexpr int kRings[] = {2, 4, 8};

using Center = std::array<double, 3>;

/// Says where a triangle is: the sum of its corners.
Center center_of(const SurfaceMesh& mesh, TriangleId t) {
  const auto [p, q, r] = mesh.points(t);
  const Vec3 sum = p.position() + q.position() + r.position();
  return {sum.x, sum.y, sum.z};
}

/// The mesh with the best edit around a triangle, if one leaves fewer bad cells.
std::optional<State> best_edit(Run& run, const State& state, TriangleId center, int rings) {
  const Patch patch(state, center, rings);
  const std::optional<std::size_t> now = patch.bad(run);
  std::optional<Patch> best;
  std::size_t least = now.value_or(patch.cells().size());
  for (const Edit& edit : patch.edits()) {
    if (least == 0 || !run.may_try() || run.must_stop()) break;
    Patch trial = patch;
    if (!trial.make(edit, run.nearness)) continue;
    ++run.trials;
    trial.descend(run);
    const std::optional<std::size_t> left = trial.bad(run);
    if (!left || *left >= least) continue;
    least = *left;
    best.emplace(std::move(trial));
  }
  if (!best) return std::nullopt;
  std::optional<State> next = best->applied();
  if (!next) return std::nullopt;
  for (const VertexId v : next->mesh.vertices()) {
    if (run.without_tiny(next->mesh.position(v)) != next->mesh.position(v)) return std::nullopt;
  }
  next->bad = run.bad(next->mesh);
  if (next->bad >= state.bad || turns_of(next->mesh, 0).largest_deg > run.limit.sharpest) return std::nullopt;
  Nearness::Known known = run.nearness.after_edit(state.mesh, patch.cells(), next->mesh);
  if (!run.too_far(*next, known).empty()) return std::nullopt;
  return next;
}

}  // namespace

void Run::repair(State& state) {
  trials = 0;
  for (const int rings : kRings) {
    std::set<Center> hopeless;
    bool changed = true;
    while (changed && state.bad > 0 && may_try() && !must_stop()) {
      changed = false;
      for (const TriangleId t : cells_at_violations(state.mesh, options.criterion)) {
        const Center center = center_of(state.mesh, t);
        if (hopeless.count(center) > 0) continue;
        if (std::optional<State> next = best_edit(*this, state, t, rings)) {
          state = *std::move(next);
          ++state.repairs;
          offer(state);
          trials = 0;
          changed = true;
          break;
        }
        hopeless.insert(center);
        if (!may_try() || must_stop()) break;
      }
    }
  }
  find_weights(state);
  offer(state);
}

}  // namespace temper::surfaces
