#include "star_lanes.hpp"

#include <algorithm>

namespace temper::bench {

bool fill_lane(const Mesh& mesh, VertexId v, std::size_t lane, StarBatch& batch) {
  std::size_t i = 0;
  HalfedgeId last;
  for (const HalfedgeId h : mesh.star(v)) {
    if (i == StarBatch::kMostTriangles) return false;
    const HalfedgeId link = Mesh::next(h), across = mesh.twin(link);
    batch.link[i].set(lane, mesh.point(mesh.target(h)));
    batch.across[i].set(lane, mesh.point(across.valid() ? mesh.opposite(across) : mesh.target(h)));
    batch.link_flips[i][lane] = across.valid() && !mesh.is_constrained(link) ? -1 : 0;
    batch.spoke_flips[i][lane] = mesh.twin(h).valid() && !mesh.is_constrained(h) ? -1 : 0;
    last = link;
    ++i;
  }
  batch.link[i].set(lane, mesh.point(mesh.target(last)));
  batch.p.set(lane, mesh.point(v));
  batch.triangles[lane] = static_cast<double>(i);
  batch.open[lane] = mesh.is_boundary(v) ? -1 : 0;
  batch.moves[lane] = mesh.is_boundary(v) || mesh.is_fixed(v) ? 0 : -1;
  batch.changes_weight[lane] = -1;
  batch.most_triangles = std::max(batch.most_triangles, i);
  batch.lanes = std::max(batch.lanes, lane + 1);
  return true;
}

std::vector<std::array<VertexId, kLanes>> alike_vertices(const Mesh& mesh) {
  constexpr std::size_t kKinds = StarBatch::kMostTriangles + 1;
  std::array<std::vector<VertexId>, kKinds> waiting;
  std::vector<std::array<VertexId, kLanes>> result;
  for (const VertexId v : mesh.vertices()) {
    std::size_t triangles = 0;
    for ([[maybe_unused]] const HalfedgeId h : mesh.star(v)) ++triangles;
    if (triangles >= kKinds) continue;
    std::vector<VertexId>& list = waiting[triangles];
    list.push_back(v);
    if (list.size() < kLanes) continue;
    result.emplace_back();
    std::copy(list.begin(), list.end(), result.back().begin());
    list.clear();
  }
  return result;
}

}  // namespace temper::bench
