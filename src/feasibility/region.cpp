#include "feasibility/region.hpp"

#include <algorithm>

#include "topology/rings.hpp"

namespace temper {
namespace {

/// Calls use(u) for each corner of each triangle around v, and across their outer edges.
template <class Use>
void for_each_near(const Mesh& mesh, VertexId v, bool across_edges, const Use& use) {
  for (const HalfedgeId h : mesh.star(v)) {
    use(mesh.target(h));
    use(mesh.opposite(h));
    const HalfedgeId outer = Mesh::next(h);
    if (across_edges && !mesh.is_boundary(outer)) use(mesh.opposite(mesh.twin(outer)));
  }
}

Region region_from(const Mesh& mesh, const VertexMask& free, bool across_edges, VertexId seed, VertexMask& seen) {
  Region region;
  region.free = {seed};
  seen[seed] = 1;
  for (std::size_t i = 0; i < region.free.size(); ++i) {
    const VertexId v = region.free[i];
    for_each_near(mesh, v, across_edges, [&](VertexId u) {
      if (free[u] == 0) region.has_rim = true;
      if (free[u] == 0 || seen[u] != 0) return;
      seen[u] = 1;
      region.free.push_back(u);
    });
    for (const HalfedgeId h : mesh.star(v)) region.triangles.push_back(Mesh::triangle(h));
  }
  std::sort(region.free.begin(), region.free.end());
  std::sort(region.triangles.begin(), region.triangles.end());
  region.triangles.erase(std::unique(region.triangles.begin(), region.triangles.end()), region.triangles.end());
  return region;
}

}  // namespace

std::vector<Region> regions_of(const Mesh& mesh, const VertexMask& free, bool across_edges) {
  std::vector<Region> regions;
  VertexMask seen(mesh.n_vertices(), 0);
  for (const VertexId v : mesh.vertices()) {
    if (free[v] == 0 || seen[v] != 0 || mesh.is_isolated(v)) continue;
    regions.push_back(region_from(mesh, free, across_edges, v, seen));
  }
  return regions;
}

void grow(const Mesh& mesh, VertexMask& mask, std::vector<VertexId> front, int rings) {
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<VertexId> next;
    for (const VertexId v : front) {
      for_each_near(mesh, v, false, [&](VertexId u) {
        if (mask[u] != 0) return;
        mask[u] = 1;
        next.push_back(u);
      });
    }
    front = std::move(next);
  }
}

std::vector<TriangleId> ring_of(const Mesh& mesh, TriangleId t) { return triangles_around(mesh, {&t, 1}); }

std::vector<Region> components_of(const Mesh& mesh) { return regions_of(mesh, VertexMask(mesh.n_vertices(), 1)); }

}  // namespace temper
