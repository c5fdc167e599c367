#include "optimize/coarsen/moves.hpp"

#include <utility>

#include "mesh/bad_triangles.hpp"

namespace temper {
namespace {

/// Removes vertices, and inserts others at bad triangles until none is bad. Returns false if that is impossible.
bool exchange(SearchCopy& copy, const Move& move, Rng& rng, MoveResult& result) {
  for (const VertexId v : move.removed) {
    if (!copy.remove(v)) return false;
    --result.more_vertices;
  }
  result.defect = copy.improve();
  for (int i = 0; i < move.most_inserted && result.defect.bad > 0; ++i) {
    if (!copy.insert_near(rng.any_of(bad_triangles(copy.mesh())), rng)) return false;
    ++result.more_vertices;
    result.defect = copy.improve();
  }
  return true;
}

/// Inserts vertices. Then removes the old vertices that are not needed any more, and last the new ones.
bool crowd(SearchCopy& copy, const Move& move, Rng& rng, MoveResult& result) {
  std::vector<VertexId> candidates;
  for (const VertexId v : copy.mesh().vertices()) {
    if (copy.may_be_removed(v)) candidates.push_back(v);
  }
  for (std::size_t i = candidates.size(); i > 1; --i) {
    std::swap(candidates[i - 1], candidates[rng.below(static_cast<std::uint32_t>(i))]);
  }
  const std::size_t old = candidates.size();
  for (int i = 0; i < move.most_inserted; ++i) {
    std::vector<TriangleId> all;
    for (const TriangleId t : copy.mesh().triangles()) {
      if (!copy.mesh().is_erased(t)) all.push_back(t);
    }
    candidates.emplace_back(copy.mesh().n_vertices());
    if (!copy.insert_near(rng.any_of(all), rng)) return false;
    ++result.more_vertices;
  }
  result.defect = copy.improve();
  if (result.defect.bad > 0) return false;
  int removed_old = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (i == old && removed_old == 0) return false;
    const SearchCopy::State before = copy.state();
    if (copy.may_be_removed(candidates[i]) && copy.remove(candidates[i]) && copy.improve().bad == 0) {
      --result.more_vertices;
      removed_old += i < old ? 1 : 0;
    } else {
      copy.return_to(before);
    }
  }
  return true;
}

}  // namespace

MoveResult try_move(const Neighborhood& around, const Move& move, const Settings& settings, const WorkingUnits& grid,
                    bool with_events) {
  SearchCopy copy(around, settings, grid, with_events);
  Rng rng(move.seed);
  MoveResult result;
  const bool made = move.kind == Move::crowd ? crowd(copy, move, rng, result) : exchange(copy, move, rng, result);
  result.valid = made && copy.is_valid();
  if (with_events) {
    result.events = copy.take_events();
    result.mesh = copy.mesh();
  }
  return result;
}

}  // namespace temper
