#include "optimize/stages/near_sweeps.hpp"

#include <algorithm>
#include <map>

#include "base/sort_unique.hpp"
#include "mesh/bad_triangles.hpp"
#include "optimize/step/dofs.hpp"
#include "optimize/sweep/sweeper.hpp"
#include "topology/rings.hpp"

namespace temper {
namespace {

// γ/ℓ of the first sweep, its factor from sweep to sweep, and its least value, as in trials of repairs.
constexpr double kFirstNearGamma = 0.5, kNearFactor = 0.7, kLeastNearGamma = 0.003;
// A flip may change triangles beside those of the swept vertices. A check after a sweep includes this many more rings.
constexpr int kRingsOfFlips = 1;

constexpr NearStep kNearSteps[] = {{-1, true, 4}, {-1, false, 8}, {0, false, 8}, {1, false, 16}};

}  // namespace

bool NearSweeps::allows(const NearStep& step) const {
  return step.only_weights ? settings_.options.unknowns != Unknowns::positions
                           : settings_.options.unknowns != Unknowns::weights;
}

bool NearSweeps::run() {
  const Policy& policy = settings_.policy;
  if (settings_.criterion != Criterion::well_centered || policy.removes_hidden() || policy.changes_vertices())
    return false;
  const EnergyModel model = state_.model;
  const double relaxation = state_.relaxation;
  for (const NearStep& step : kNearSteps) {
    if (!allows(step)) continue;
    bad_ = bad_triangles(work_.mesh);
    if (bad_.empty() || run_.stopped_early()) break;
    sweep(step);
  }
  state_.model = model;
  state_.relaxation = relaxation;
  return true;
}

void NearSweeps::sweep(const NearStep& step) {
  Settings settings = settings_;
  if (step.only_weights) settings.options.unknowns = Unknowns::weights;
  Flipper flipper(work_.mesh, settings, state_, flipper_.recorder());
  Sweeper sweeper(work_, flipper, kPartSize);
  state_.relaxation = kRelaxation;
  double gamma = kFirstNearGamma;
  for (int i = 0; i < step.most_sweeps && !bad_.empty(); ++i) {
    state_.model.gamma = {gamma, LengthScale::relative};
    const std::vector<VertexId> vertices = near(step);
    if (vertices.empty() || !sweeper.sweep(i, vertices, run_)) break;
    find_bad(vertices);
    gamma = std::max(kLeastNearGamma, kNearFactor * gamma);
  }
  flipper_.add(flipper.take_changes());
}

std::vector<VertexId> NearSweeps::near(const NearStep& step) const {
  if (step.rings < 0) return centers(step.only_weights);
  std::vector<TriangleId> triangles = bad_;
  for (int i = 0; i < step.rings; ++i) triangles = triangles_around(work_.mesh, triangles);
  std::vector<VertexId> corners;
  for (const TriangleId t : triangles) {
    for (const VertexId v : work_.mesh.corners(t)) corners.push_back(v);
  }
  sort_unique(corners);
  return corners;
}

/// Returns of each bad triangle the corner of most bad triangles, of equals the first, without those that stay.
std::vector<VertexId> NearSweeps::centers(bool only_weights) const {
  const Mesh& mesh = work_.mesh;
  std::map<VertexId, int> n_bad;
  for (const TriangleId t : bad_) {
    for (const VertexId v : mesh.corners(t)) ++n_bad[v];
  }
  for (auto& [v, n] : n_bad) {
    const Mobility has = mobility(mesh, v, settings_.options);
    if (only_weights ? has == Mobility::frozen : has != Mobility::free) n = 0;
  }
  std::vector<VertexId> centers;
  for (const TriangleId t : bad_) {
    VertexId center;
    int most = 0;
    for (const VertexId v : mesh.corners(t)) {
      const int n = n_bad[v];
      if (n < most || n == 0 || (n == most && center < v)) continue;
      center = v;
      most = n;
    }
    if (center.valid()) centers.push_back(center);
  }
  sort_unique(centers);
  return centers;
}

/// Looks at the triangles that a sweep over these vertices can have changed, and at those that were bad.
void NearSweeps::find_bad(const std::vector<VertexId>& swept) {
  std::vector<TriangleId> changed = triangles_at(work_.mesh, swept);
  for (int i = 0; i < kRingsOfFlips; ++i) changed = triangles_around(work_.mesh, changed);
  changed.insert(changed.end(), bad_.begin(), bad_.end());
  sort_unique(changed);
  std::erase_if(changed, [&](TriangleId t) { return !is_bad(work_.mesh, t); });
  bad_ = std::move(changed);
}

}  // namespace temper
