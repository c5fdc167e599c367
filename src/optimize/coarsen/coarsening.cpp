#include "optimize/coarsen/coarsening.hpp"

#include <algorithm>
#include <deque>
#include <utility>

#include "base/assert.hpp"
#include "mesh/bad_triangles.hpp"
#include "mesh/edge_lengths.hpp"

namespace temper {
namespace {

// Random neighborhoods have one of kRingChoices numbers of rings, from kLeastRings on. Wide ones give more room, and
// narrow ones take less time.
constexpr int kLeastRings = 3;
constexpr std::uint32_t kRingChoices = 3;
constexpr int kMovesOfRound = 500;
// A cure that leaves as many triangles bad lowers the violation to this part of it, with one more vertex at most.
constexpr double kHelpsCure = 0.9;
constexpr std::uint32_t kMostRemovedByCure = 4, kMostAddedByCure = 4;
// After each so many moves without fewer bad triangles, a cure may add one more vertex, up to the most.
constexpr int kMovesBeforeFiner = 300;
constexpr int kMostAddedLater = 40;
// An exchange removes at most so many vertices; and a crowd begins with at most so many new ones.
constexpr std::uint32_t kMostExchanged = 4, kMostCrowded = 2;
// Part of random moves that are crowds: most removals that exchanges miss follow from those.
constexpr double kCrowds = 0.3;
// Part of exchanges that may go sideways.
constexpr double kSideways = 0.33;

}  // namespace

Coarsening::Coarsening(WorkingCopy& work, Run& run, Flipper& flipper, int moves_of_cure)
    : work_(work),
      settings_(settings_of_copies(flipper.settings())),
      run_(run),
      flipper_(flipper),
      sizes_(work, *flipper.settings().size_field, *flipper.settings().options.coarsen),
      rng_(flipper.settings().policy.seed),
      moves_left_(flipper.settings().options.coarsen_moves),
      moves_of_cure_(moves_of_cure) {}

bool Coarsening::improve() {
  if (const std::vector<TriangleId> bad = bad_triangles(work_.mesh); !bad.empty()) return cure(bad);
  if (!std::exchange(has_removed_singly_, true)) return remove_one_by_one();
  return move_at_random();
}

/// Makes one move that helps bad triangles. Other neighborhoods stay as they are.
bool Coarsening::cure(const std::vector<TriangleId>& bad) {
  if (bad.size() < least_bad_) {
    least_bad_ = bad.size();
    moves_since_fewer_bad_ = 0;
  }
  while (++moves_since_fewer_bad_ <= moves_of_cure_ && !run_.asked_to_stop(0)) {
    const Neighborhood around = random_neighborhood(rng_.any_of(bad));
    Move move = {.kind = Move::exchange, .removed = removable_near(around, around.mesh.corners(around.seed)[0])};
    move.removed.resize(std::min<std::size_t>(move.removed.size(), rng_.below(kMostRemovedByCure + 1)));
    const int later = std::min((moves_since_fewer_bad_ - 1) / kMovesBeforeFiner, kMostAddedLater);
    const std::uint32_t more = rng_.below(kMostAddedByCure + static_cast<std::uint32_t>(later) + 1);
    move.most_inserted = static_cast<int>(move.removed.size() + more);
    move.seed = rng_.next();
    if (make(around, move, more == 0 ? Sideways::allowed : Sideways::refused)) return true;
  }
  return false;
}

/// Removes each vertex that can go, those with short edges first. After a removal its neighbors are tried again.
bool Coarsening::remove_one_by_one() {
  const Mesh& mesh = work_.mesh;
  std::vector<std::pair<double, VertexId>> order;
  for (const VertexId v : removable()) order.emplace_back(squared_shortest_edge(mesh, v), v);
  std::sort(order.begin(), order.end());
  std::deque<VertexId> queue;
  std::vector<std::uint8_t> waits(mesh.n_vertices(), 0);
  const auto push = [&](VertexId v) {
    if (std::exchange(waits[v.index], 1) == 0) queue.push_back(v);
  };
  for (const auto& [length, v] : order) push(v);
  while (!queue.empty()) {
    if (run_.asked_to_stop(0)) return false;
    const VertexId v = queue.front();
    queue.pop_front();
    waits[v.index] = 0;
    if (mesh.is_isolated(v)) continue;
    const Changed there = remove(v);
    if (!there) continue;
    for (const VertexId u : *there) {
      if (may_be_removed(work_, u)) push(u);
    }
  }
  return true;
}

Coarsening::Changed Coarsening::remove(VertexId v) {
  const Neighborhood around = neighborhood_of(work_, Mesh::triangle(work_.mesh.outgoing(v)), kLeastRings);
  const auto at = std::find(around.vertices.begin(), around.vertices.end(), v);
  const VertexId local(static_cast<std::size_t>(at - around.vertices.begin()));
  if (around.frozen[local.index] != 0) return std::nullopt;
  return make(around, {.kind = Move::exchange, .removed = {local}}, Sideways::refused);
}

bool Coarsening::move_at_random() {
  const Mesh& mesh = work_.mesh;
  std::vector<VertexId> own = removable();
  for (int i = 0; i < kMovesOfRound && !own.empty(); ++i) {
    if (--moves_left_ < 0 || run_.asked_to_stop(0)) return false;
    VertexId& chosen = own[rng_.below(static_cast<std::uint32_t>(own.size()))];
    if (mesh.is_isolated(chosen)) {
      chosen = own.back();
      own.pop_back();
      continue;
    }
    const Neighborhood around = random_neighborhood(Mesh::triangle(mesh.outgoing(chosen)));
    Move move;
    auto sideways = Sideways::allowed;
    if (rng_.uniform() < kCrowds) {
      move = {.kind = Move::crowd, .most_inserted = 1 + static_cast<int>(rng_.below(kMostCrowded))};
    } else {
      const auto at = std::find(around.vertices.begin(), around.vertices.end(), chosen);
      move.kind = Move::exchange;
      move.removed = removable_near(around, VertexId(static_cast<std::size_t>(at - around.vertices.begin())));
      move.removed.resize(std::min<std::size_t>(move.removed.size(), 1 + rng_.below(kMostExchanged)));
      if (move.removed.empty()) continue;
      const bool fewer = move.removed.size() > 1 && rng_.uniform() > kSideways;
      if (fewer) sideways = Sideways::refused;
      move.most_inserted = static_cast<int>(move.removed.size()) - (fewer ? 1 : 0);
    }
    move.seed = rng_.next();
    const Changed there = make(around, move, sideways);
    if (!there) continue;
    own = removable();
  }
  return !own.empty();
}

/// Makes the move if it cures triangles or leaves fewer vertices, or if it may and does go sideways.
Coarsening::Changed Coarsening::make(const Neighborhood& around, const Move& move, Sideways sideways) {
  const LocalDefect before = defect_of(around.mesh);
  const MoveResult tried = try_move(around, move, settings_, work_.units, false);
  if (!tried.valid || tried.defect.bad > before.bad) return std::nullopt;
  const bool fewer = before.bad == 0 && tried.more_vertices < 0;
  const bool helps = tried.more_vertices <= 1 && tried.defect.violation < kHelpsCure * before.violation;
  const bool cures = tried.defect.bad < before.bad || (before.bad > 0 && helps);
  const bool goes_sideways = sideways == Sideways::allowed && tried.more_vertices <= 0;
  if (!fewer && !cures && !goes_sideways) return std::nullopt;
  const MoveResult result = try_move(around, move, settings_, work_.units, true);
  TEMPER_ASSERT(result.valid && result.defect == tried.defect);  // as without events
  const bool coarsens = !cures || !move.removed.empty();
  if (coarsens && !sizes_.allows(around, result.mesh)) return std::nullopt;
  return splice(work_, flipper_, around, result.events);
}

std::vector<VertexId> Coarsening::removable() const {
  std::vector<VertexId> own;
  for (const VertexId v : work_.mesh.vertices()) {
    if (may_be_removed(work_, v)) own.push_back(v);
  }
  return own;
}

/// Returns the vertices that a move may remove, by local number, the nearest to the local v first.
std::vector<VertexId> Coarsening::removable_near(const Neighborhood& around, VertexId v) const {
  std::vector<std::pair<double, VertexId>> found;
  const Vec2 place = around.mesh.position(v);
  for (const VertexId u : around.mesh.vertices()) {
    if (around.frozen[u.index] != 0 || !may_be_removed(work_, around.vertices[u.index])) continue;
    found.emplace_back(squared_length(around.mesh.position(u) - place), u);
  }
  std::sort(found.begin(), found.end());
  std::vector<VertexId> nearest_first;
  nearest_first.reserve(found.size());
  for (const auto& [distance, u] : found) nearest_first.push_back(u);
  return nearest_first;
}

Neighborhood Coarsening::random_neighborhood(TriangleId t) {
  return neighborhood_of(work_, t, kLeastRings + static_cast<int>(rng_.below(kRingChoices)));
}

}  // namespace temper
