#include "tets/optimize/local_search.hpp"

#include <algorithm>
#include <array>
#include <unordered_set>
#include <utility>

#include "tets/optimize/accuracy.hpp"
#include "tets/optimize/repair.hpp"
#include "tets/quality/measure.hpp"

namespace temper::tets {
namespace {

// γ falls from the first to the last one by a factor. The last one is smaller than in a whole mesh: some tetrahedra are
// good only by a margin of 0.001.
constexpr double kFirstSettlingGamma = 0.3, kSettlingFactor = 0.7, kLastSettlingGamma = 0.0005;
constexpr int kSettlingSweeps = 2, kLastSettlingSweeps = 10;
constexpr double kSettlingRelaxation = 1.7;
// Searches compare energies at this γ. A gain below this part of it is none.
constexpr double kScoreGamma = 0.003, kLeastGainOfSearch = 0.01;
// Changes in a row before the mesh is better.
constexpr int kLongestChain = 4;
// Rings of tetrahedra whose vertices move when many cavities change at once.
constexpr int kRingsOfAll = 2;
// Rings of tetrahedra around a place, one more for each search in vain, and the most searches.
constexpr int kRings = 2, kTriesOfPlace = 4;

/// The tetrahedra that need a change: the violating ones, or else those with a small margin, the smallest first.
std::vector<TetId> to_change(const Draft& draft, const SearchOptions& options, Executor* executor = nullptr) {
  const TetMesh& mesh = draft.mesh;
  const double small_margin = options.small_margin;
  std::vector<TetId> result = violating(draft, options.criterion, executor);
  if (!result.empty() || small_margin == 0) return result;
  std::vector<std::pair<double, TetId>> small;
  for (const TetId t : mesh.tetrahedra()) {
    if (const double margin = measure_tetrahedron(mesh.points(t)).margin(); margin < small_margin)
      small.emplace_back(margin, t);
  }
  std::sort(small.begin(), small.end());
  for (const auto& [margin, t] : small) result.push_back(t);
  return result;
}

/// Some tetrahedra, and those within some rings around them.
std::vector<TetId> with_rings(const TetMesh& mesh, const VertexStars& stars, std::vector<TetId> tetrahedra, int rings) {
  std::unordered_set<std::uint32_t> seen, reached;
  for (const TetId t : tetrahedra) seen.insert(t.index);
  for (int ring = 0; ring < rings; ++ring) {
    for (std::size_t i = 0, n = tetrahedra.size(); i < n; ++i) {
      const auto corners = mesh.corners(tetrahedra[i]);
      for (const VertexId v : corners) {
        if (!reached.insert(v.index).second) continue;
        for (const HalffaceId h : stars.link(v)) {
          if (const TetId t = TetMesh::tetrahedron(h); seen.insert(t.index).second) tetrahedra.push_back(t);
        }
      }
    }
  }
  std::sort(tetrahedra.begin(), tetrahedra.end());
  return tetrahedra;
}

/// Sweeps over some vertices, with γ from large to small. False: it must stop.
bool settle(Draft& draft, const std::vector<VertexId>& vertices, double most_cosine, const MustStop& must_stop,
            Executor* executor = nullptr) {
  const IdVector<VertexId, Mobility> mobility = draft.mobilities();
  Sweeper sweeper(draft.mesh, mobility, vertices, executor);
  for (double gamma = kFirstSettlingGamma;; gamma = std::max(gamma * kSettlingFactor, kLastSettlingGamma)) {
    const bool last = gamma == kLastSettlingGamma;
    for (int i = 0; i < (last ? kLastSettlingSweeps : kSettlingSweeps); ++i) {
      if (!sweeper.sweep({gamma, kSettlingRelaxation, most_cosine}, must_stop)) return false;
    }
    if (last) return true;
  }
}

/// The first changes of the k-th chain: the best at each place together, or one alone.
std::vector<Filling> first_changes(const Draft& draft, std::size_t k, const SearchOptions& options,
                                   const MustStop& must_stop) {
  constexpr std::array<double, 4> kAllowances = {2 * kAllowance, kAllowance, 4 * kAllowance, kAllowance / 2};
  const std::vector<TetId> places = to_change(draft, options);
  if (places.empty()) return {};
  if (k % 2 == 1) return repairs(draft, places, {kAllowances[k / 2 % 4], k / 8, options.split_boundary}, must_stop);
  const std::size_t i = k / 2;
  return repairs(draft, {places[i % places.size()]}, {2 * kAllowance, i / places.size(), options.split_boundary},
                 must_stop);
}

/// A mesh is better with fewer bad tetrahedra, or with as many and less energy, by more than rounding can make it.
bool is_better(const MeshState& now, const MeshState& before) {
  return now.bad != before.bad ? now.bad < before.bad : now.energy < (1 - kLeastGainOfSearch) * before.energy;
}

/// Keeps the corners of all tetrahedra at the rim of a patch: so faces and edges there stay as they are, for those
/// beyond, too.
void keep_rim(Draft& patch) {
  IdVector<VertexId, std::uint8_t> at_rim(patch.mesh.n_vertices());
  for (const auto& face : patch.rim) {
    for (const VertexId v : face) at_rim[v] = 1;
  }
  for (const TetId t : patch.mesh.tetrahedra()) {
    const auto& corners = patch.mesh.corners(t);
    if (std::none_of(corners.begin(), corners.end(), [&](VertexId v) { return at_rim[v] != 0; })) continue;
    for (const VertexId v : corners) patch.mobility[v] = Mobility::none;
  }
}

/// Says whether all tetrahedra around some corners are in the patch: other tetrahedra than its place are tried along
/// with it then.
template <class IsInPatch>
bool may_all_change(const TetMesh& mesh, const VertexStars& stars, const std::array<VertexId, 4>& corners,
                    const IsInPatch& is_in_patch) {
  return std::all_of(corners.begin(), corners.end(), [&](VertexId v) {
    const auto link = stars.link(v);
    return std::all_of(link.begin(), link.end(), [&](HalffaceId h) { return is_in_patch(mesh.tetrahedron(h)); });
  });
}

/// The corners of a tetrahedron by name.
std::array<VertexId, 4> names_of(const Draft& draft, TetId t) {
  std::array<VertexId, 4> corners = draft.mesh.corners(t);
  for (VertexId& v : corners) v = draft.names.vertices[v];
  std::sort(corners.begin(), corners.end());
  return corners;
}

}  // namespace

bool change_all(Draft& draft, const SearchOptions& options, const MustStop& must_stop, Executor* executor) {
  const std::vector<Filling> fillings = repairs(draft, to_change(draft, options, executor),
                                                {kAllowance, options.rank, options.split_boundary}, must_stop);
  std::vector<TetId> changed;
  for (const Filling& f : fillings)
    changed.insert(changed.end(), f.cavity.tetrahedra.begin(), f.cavity.tetrahedra.end());
  IdVector<VertexId, std::uint8_t> near(draft.names.next.index);  // by name
  for (const TetId t : with_rings(draft.mesh, VertexStars(draft.mesh), std::move(changed), kRingsOfAll)) {
    for (const VertexId v : draft.mesh.corners(t)) near[draft.names.vertices[v]] = 1;
  }
  if (fillings.empty() || !draft.fill(fillings)) return false;
  near.resize(draft.names.next.index, 1);
  std::vector<VertexId> moving;
  for (const VertexId v : draft.mesh.vertices()) {
    if (near[draft.names.vertices[v]] != 0) moving.push_back(v);
  }
  return settle(draft, moving, options.most_cosine, must_stop, executor);
}

SearchResult search(Draft& draft, const SearchOptions& options, const MustStop& must_stop) {
  const MeshState start = state_of(draft, options.criterion, kScoreGamma);
  const double most_cosine = std::max(options.most_cosine, largest_dihedral_cosine(draft.mesh, nullptr));
  MeshState best = start;
  SearchResult result;
  for (int in_vain = 0; in_vain < options.most_in_vain;) {
    Draft trial = draft;
    std::vector<Filling> changes = first_changes(trial, static_cast<std::size_t>(in_vain++), options, must_stop);
    for (int length = 0; length < kLongestChain && !changes.empty() && trial.fill(changes); ++length) {
      const auto all = trial.mesh.vertices();
      result.work += trial.mesh.n_tetrahedra();
      if (!settle(trial, {all.begin(), all.end()}, options.most_cosine, must_stop)) return result;
      if (const MeshState state = state_of(trial, options.criterion, kScoreGamma);
          is_better(state, best) && largest_dihedral_cosine(trial.mesh, nullptr) <= most_cosine) {
        best = state;
        in_vain = 0;
        draft = std::move(trial);
        result.is_better = is_better(best, start);
        break;
      }
      changes = repairs(trial, to_change(trial, options), {kAllowance, 0, options.split_boundary}, must_stop);
    }
  }
  return result;
}

std::vector<Patch> Places::choose(const Draft& draft, Executor* executor) {
  const TetMesh& mesh = draft.mesh;
  chosen_.clear();
  std::vector<Patch> patches;
  const std::vector<TetId> needy = to_change(draft, options_, executor);
  PatchMaker maker(draft);
  const VertexStars& stars = maker.stars();
  IdVector<TetId, std::uint8_t> is_needy(mesh.n_tetrahedra());
  for (const TetId t : needy) is_needy[t] = 1;
  IdVector<TetId, std::size_t> patch_of_tet(mesh.n_tetrahedra());  // from 1; 0: none
  for (const TetId t : needy) {
    const auto tried = tries_.find(names_of(draft, t));
    const int tries = tried == tries_.end() ? 0 : tried->second;
    if (tries >= kTriesOfPlace) continue;
    const bool has_rim = options_.criterion != Criterion::well_centered;
    std::vector<TetId> around = with_rings(mesh, stars, {t}, kRings + tries + (has_rim ? 1 : 0));
    if (std::any_of(around.begin(), around.end(), [&](TetId s) { return patch_of_tet[s] != 0; })) continue;
    const std::size_t work = std::min(work_, around.size() * static_cast<std::size_t>(options_.most_in_vain));
    if (work == 0) break;
    work_ -= work;
    patches.push_back(maker.make(around));
    if (has_rim) keep_rim(patches.back().draft);
    for (const TetId s : around) patch_of_tet[s] = patches.size();
    const bool alone = options_.search_each && patches.back().tetrahedra.size() < mesh.n_tetrahedra();
    chosen_.push_back({{}, work});
    std::vector<Corners>& along = chosen_.back().along;
    for (const TetId s : around) {
      const bool is_tried = !alone && is_needy[s] != 0 && may_all_change(mesh, stars, mesh.corners(s), [&](TetId u) {
        return patch_of_tet[u] == patches.size();
      });
      if (s == t || is_tried) along.push_back(names_of(draft, s));
    }
    for (const Corners& corners : along) ++tries_[corners];
  }
  return patches;
}

}  // namespace temper::tets
