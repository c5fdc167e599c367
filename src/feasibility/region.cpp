#include "feasibility/region.hpp"

#include <algorithm>

#include "base/sort_unique.hpp"

namespace temper {
namespace {

/// The vertices near another: corners of the cells around it, and across their outer sides.
class Neighbors {
 public:
  Neighbors(const Demand& demand, bool across) : demand_(demand), across_(across) {}

  /// Valid until the next call.
  const std::vector<VertexId>& of(VertexId v) {
    cells_.clear(), vertices_.clear();
    demand_.add_cells_around(v, cells_);
    for (const CellId cell : cells_) demand_.add_corners(cell, vertices_);
    if (across_) demand_.add_vertices_across(v, vertices_);
    return vertices_;
  }
  /// The cells around the vertex of the last call.
  [[nodiscard]] const std::vector<CellId>& cells() const { return cells_; }

 private:
  const Demand& demand_;
  bool across_;
  std::vector<CellId> cells_;
  std::vector<VertexId> vertices_;
};

Region region_from(Neighbors& neighbors, const VertexMask& free, VertexId seed, VertexMask& seen) {
  Region region;
  region.free = {seed};
  seen[seed] = 1;
  for (std::size_t i = 0; i < region.free.size(); ++i) {
    for (const VertexId u : neighbors.of(region.free[i])) {
      if (free[u] == 0) region.has_rim = true;
      if (free[u] == 0 || seen[u] != 0) continue;
      seen[u] = 1;
      region.free.push_back(u);
    }
    region.cells.insert(region.cells.end(), neighbors.cells().begin(), neighbors.cells().end());
  }
  std::sort(region.free.begin(), region.free.end());
  sort_unique(region.cells);
  return region;
}

}  // namespace

std::vector<Region> regions_of(const Demand& demand, const VertexMask& free, bool across) {
  std::vector<Region> regions;
  VertexMask seen(demand.n_vertices(), 0);
  Neighbors neighbors(demand, across);
  for (const VertexId v : demand.vertices()) {
    if (free[v] == 0 || seen[v] != 0 || neighbors.of(v).empty()) continue;
    regions.push_back(region_from(neighbors, free, v, seen));
  }
  return regions;
}

void grow(const Demand& demand, VertexMask& mask, std::vector<VertexId> front, int rings) {
  Neighbors neighbors(demand, false);
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<VertexId> next;
    for (const VertexId v : front) {
      for (const VertexId u : neighbors.of(v)) {
        if (mask[u] != 0) continue;
        mask[u] = 1;
        next.push_back(u);
      }
    }
    front = std::move(next);
  }
}

std::vector<CellId> ring_of(const Demand& demand, CellId cell) {
  std::vector<VertexId> corners;
  demand.add_corners(cell, corners);
  std::vector<CellId> cells;
  for (const VertexId v : corners) demand.add_cells_around(v, cells);
  sort_unique(cells);
  return cells;
}

std::vector<CellId> cells_of(const Demand& demand, std::span<const WeightConstraint> constraints) {
  std::vector<CellId> found, around;
  std::vector<VertexId> corners;
  for (const auto& [kind, p, q, r, s, t] : constraints) {
    around.clear();
    demand.add_cells_around(p, around);
    for (const CellId cell : around) {
      corners.clear();
      demand.add_corners(cell, corners);
      const auto has = [&](VertexId v) { return std::find(corners.begin(), corners.end(), v) != corners.end(); };
      const bool in_face = kind != WeightConstraint::Kind::dual_of_face || has(r);
      if (has(q) && in_face && (!r.valid() || has(r) || has(s))) found.push_back(cell);
    }
  }
  sort_unique(found);
  return found;
}

std::vector<Region> components_of(const Demand& demand) {
  return regions_of(demand, VertexMask(demand.n_vertices(), 1));
}

}  // namespace temper
