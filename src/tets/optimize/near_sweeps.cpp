#include "tets/optimize/near_sweeps.hpp"

#include <algorithm>
#include <map>

#include "base/sort_unique.hpp"
#include "tets/optimize/violations.hpp"

namespace temper::tets {
namespace {

// γ of the first sweep, its factor from sweep to sweep, and its least value, as where patches settle.
constexpr double kFirstNearGamma = 0.3, kNearFactor = 0.7, kLeastNearGamma = 0.0005;
constexpr double kNearRelaxation = 1.7;

/// Some vertices of violating tetrahedra, and sweeps over them.
struct NearStep {
  int rings;  ///< around the tetrahedra; −1: of each the corner of most of them alone
  bool only_weights;
  int most_sweeps;
};
constexpr NearStep kNearSteps[] = {{-1, true, 4}, {-1, false, 12}, {0, false, 12}, {1, false, 20}};

/// Returns of each tetrahedron the corner that most of them have, of equals the first, without those that stay.
std::vector<VertexId> centers(const Draft& draft, const std::vector<TetId>& tetrahedra, bool only_weights) {
  std::map<VertexId, int> count;
  for (const TetId t : tetrahedra) {
    for (const VertexId v : draft.mesh.corners(t)) ++count[v];
  }
  for (auto& [v, n] : count) {
    const Mobility& m = draft.mobility_of(v);
    if (only_weights ? !m.weighs : !m.moves()) n = 0;
  }
  std::vector<VertexId> centers;
  for (const TetId t : tetrahedra) {
    VertexId center;
    int most = 0;
    for (const VertexId v : draft.mesh.corners(t)) {
      const int n = count[v];
      if (n < most || n == 0 || (n == most && center < v)) continue;
      center = v;
      most = n;
    }
    if (center.valid()) centers.push_back(center);
  }
  sort_unique(centers);
  return centers;
}

/// Adds the vertices of all tetrahedra around some vertices.
std::vector<VertexId> with_neighbors(const TetMesh& mesh, const VertexStars& stars, std::vector<VertexId> vertices) {
  const std::size_t n = vertices.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (const HalffaceId h : stars.link(vertices[i])) {
      for (const VertexId u : mesh.vertices(h)) vertices.push_back(u);
    }
  }
  sort_unique(vertices);
  return vertices;
}

std::vector<VertexId> corners_of(const TetMesh& mesh, const VertexStars& stars, const std::vector<TetId>& tetrahedra,
                                 int rings) {
  std::vector<VertexId> corners;
  for (const TetId t : tetrahedra) {
    for (const VertexId v : mesh.corners(t)) corners.push_back(v);
  }
  sort_unique(corners);
  for (int i = 0; i < rings; ++i) corners = with_neighbors(mesh, stars, std::move(corners));
  return corners;
}

/// The tetrahedra around some vertices and their neighbors. No other has a dual that depends on these vertices.
Patch patch_around(PatchMaker& maker, const TetMesh& mesh, const std::vector<VertexId>& vertices) {
  std::vector<TetId> tetrahedra;
  for (const VertexId v : with_neighbors(mesh, maker.stars(), vertices)) {
    for (const HalffaceId h : maker.stars().link(v)) tetrahedra.push_back(TetMesh::tetrahedron(h));
  }
  sort_unique(tetrahedra);
  return maker.make(std::move(tetrahedra));
}

}  // namespace

bool sweep_near_violations(Draft& draft, const NearOptions& options, const MustStop& must_stop, Executor* executor) {
  for (const NearStep& step : kNearSteps) {
    const std::vector<TetId> bad = violating(draft, options.criterion, executor);
    if (bad.empty()) return true;
    PatchMaker maker(draft);
    const std::vector<VertexId> vertices = step.rings < 0 ? centers(draft, bad, step.only_weights)
                                                          : corners_of(draft.mesh, maker.stars(), bad, step.rings);
    Patch patch = patch_around(maker, draft.mesh, vertices);
    TetMesh& mesh = patch.draft.mesh;
    IdVector<VertexId, Mobility> mobility = patch.draft.mobilities();
    std::vector<VertexId> in_patch;
    for (const VertexId v : mesh.vertices()) {
      if (!std::ranges::binary_search(vertices, patch.vertices[v])) continue;
      in_patch.push_back(v);
      if (step.only_weights) mobility[v] = mobility[v].weighs ? Mobility::weight : Mobility::none;
    }
    Sweeper sweeper(mesh, mobility, in_patch, executor);
    double gamma = kFirstNearGamma;
    bool goes_on = true;
    for (int i = 0; i < step.most_sweeps && goes_on; ++i) {
      goes_on = sweeper.sweep({gamma, kNearRelaxation, options.most_cosine}, must_stop);
      if (violating(patch.draft, options.criterion, executor).empty()) break;
      gamma = std::max(kLeastNearGamma, kNearFactor * gamma);
    }
    for (const VertexId v : in_patch) draft.mesh.set_point(patch.vertices[v], mesh.point(v));
    if (!goes_on) return false;
  }
  return true;
}

}  // namespace temper::tets
