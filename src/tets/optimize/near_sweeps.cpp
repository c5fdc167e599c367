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

std::vector<VertexId> corners_of(const TetMesh& mesh, const std::vector<TetId>& tetrahedra, int rings) {
  std::vector<VertexId> corners;
  for (const TetId t : tetrahedra) {
    for (const VertexId v : mesh.corners(t)) corners.push_back(v);
  }
  sort_unique(corners);
  if (rings == 0) return corners;
  const VertexStars stars(mesh);
  for (int i = 0; i < rings; ++i) {
    std::vector<VertexId> wider = corners;
    for (const VertexId v : corners) {
      for (const HalffaceId h : stars.link(v)) {
        for (const VertexId u : mesh.vertices(h)) wider.push_back(u);
      }
    }
    sort_unique(wider);
    corners = std::move(wider);
  }
  return corners;
}

}  // namespace

bool sweep_near_violations(Draft& draft, const NearOptions& options, const MustStop& must_stop, Executor* executor) {
  for (const NearStep& step : kNearSteps) {
    std::vector<TetId> bad = violating(draft, options.criterion, executor);
    if (bad.empty()) return true;
    const std::vector<VertexId> vertices =
        step.rings < 0 ? centers(draft, bad, step.only_weights) : corners_of(draft.mesh, bad, step.rings);
    IdVector<VertexId, Mobility> mobility = draft.mobilities();
    if (step.only_weights) {
      for (const VertexId v : vertices) mobility[v] = mobility[v].weighs ? Mobility::weight : Mobility::none;
    }
    Sweeper sweeper(draft.mesh, mobility, vertices, executor);
    double gamma = kFirstNearGamma;
    for (int i = 0; i < step.most_sweeps && !bad.empty(); ++i) {
      if (!sweeper.sweep({gamma, kNearRelaxation, options.most_cosine}, must_stop)) return false;
      bad = violating(draft, options.criterion, executor);
      gamma = std::max(kLeastNearGamma, kNearFactor * gamma);
    }
  }
  return true;
}

}  // namespace temper::tets
