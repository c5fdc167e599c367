#include "size/solver_measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/median.hpp"
#include "geometry/flow_cell.hpp"
#include "geometry/surface.hpp"
#include "mesh/bad_triangles.hpp"
#include "mesh/blocks.hpp"
#include "size/cell_ring.hpp"
#include "size/star_area.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/mesh.hpp"

namespace temper {
namespace {

/// The place of a vertex, without its weight: of its images, the one near a point.
[[nodiscard]] inline Vec3 position_of(const Mesh& mesh, VertexId v, const WeightedPoint& near) {
  return mesh.space().place(mesh.point(v, near));
}

void merge(SolverMeasures& into, const SolverMeasures& from) {
  const auto least = [&](double SolverMeasures::*m) { into.*m = std::min(into.*m, from.*m); };
  const auto largest = [&](double SolverMeasures::*m) { into.*m = std::max(into.*m, from.*m); };
  least(&SolverMeasures::min_edge_over_size);
  least(&SolverMeasures::min_dual_over_size);
  least(&SolverMeasures::min_dual_over_cell_median);
  largest(&SolverMeasures::max_orthogonality);
  largest(&SolverMeasures::max_smoothness);
  least(&SolverMeasures::min_flow_link);
  into.small_flow_links += from.small_flow_links;
  least(&SolverMeasures::min_cell_quality);
  least(&SolverMeasures::min_grid_spacing);
  largest(&SolverMeasures::max_grid_spacing);
  least(&SolverMeasures::min_triangle_quality);
  least(&SolverMeasures::min_triangle_angle_quality);
  into.obtuse_triangles += from.obtuse_triangles;
  largest(&SolverMeasures::max_centroid_offset_over_size);
}

// --- D-Flow FM -----------------------------------------------------------------------------------------------

void add_flow_link(SolverMeasures& m, const Mesh& mesh, HalfedgeId h) {
  const WeightedPoint from = mesh.point(mesh.origin(h));
  const FlowCell left = flow_cell_of(mesh, Mesh::triangle(h), from),
                 right = flow_cell_of(mesh, Mesh::triangle(mesh.twin(h)), from);
  const FlowLink link =
      flow_link(position_of(mesh, mesh.target(h), from) - position_of(mesh, mesh.origin(h), from), left, right);
  const auto [smaller, larger] = std::minmax(left.area, right.area);
  m.max_orthogonality = std::max(m.max_orthogonality, link.orthogonality);
  m.max_smoothness =
      std::max(m.max_smoothness, smaller > 0 ? larger / smaller : std::numeric_limits<double>::infinity());
  m.min_flow_link = std::min(m.min_flow_link, link.length);
  m.small_flow_links += link.length < kSmallFlowLink;
}

// --- MPAS-Tools: their cells are vertices here, and their vertices triangles -----------------------------------------

/// The angle across from a.
double angle_across(double a, double b, double c) {
  return std::acos(std::clamp((b * b + c * c - a * a) / (2 * b * c), -1.0, 1.0));
}

void add_triangle(SolverMeasures& m, const Mesh& mesh, TriangleId t) {
  const auto [p, q, r] = mesh.points(t);
  const double a = distance(mesh.space(), q, r), b = distance(mesh.space(), r, p), c = distance(mesh.space(), p, q);
  m.min_triangle_quality = std::min(m.min_triangle_quality, std::min({a, b, c}) / std::max({a, b, c}));
  const auto [least, largest] = std::minmax({angle_across(a, b, c), angle_across(b, c, a), angle_across(c, a, b)});
  m.min_triangle_angle_quality = std::min(m.min_triangle_angle_quality, least / largest);
  m.obtuse_triangles += is_obtuse(mesh, t);
}

/// Precondition: the ring is closed, the vertex not on the boundary.
void add_closed_cell(SolverMeasures& m, const Space& space, const CellRing& ring, double size) {
  std::vector<double> duals(ring.around.size());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < duals.size(); ++k) {
    const double dual = dual_length(space, ring, k);
    least = std::min(least, dual);
    duals[k] = std::abs(dual);
  }
  m.min_cell_quality = std::min(m.min_cell_quality, cell_quality(space, ring));
  const double median = median_of(std::move(duals));
  m.min_dual_over_cell_median = std::min(m.min_dual_over_cell_median, median > 0 ? least / median : 0);
  m.max_centroid_offset_over_size = std::max(m.max_centroid_offset_over_size, centroid_offset(space, ring) / size);
}

// --- all -----------------------------------------------------------------------------------------------------

void add_triangles(SolverMeasures& m, const Mesh& mesh, const IdVector<VertexId, double>& sizes, bool brief,
                   IdRange<TriangleId> triangles) {
  for (const TriangleId t : triangles) {
    if (mesh.is_erased(t)) continue;
    if (!brief) add_triangle(m, mesh, t);
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(t, k);
      if (mesh.is_boundary(h) || !mesh.is_edge_representative(h) || mesh.is_diagonal(h)) continue;
      const auto [edge, dual] = relative_lengths(mesh, sizes, h);
      m.min_edge_over_size = std::min(m.min_edge_over_size, edge);
      m.min_dual_over_size = std::min(m.min_dual_over_size, dual);
      if (!brief) add_flow_link(m, mesh, h);
    }
  }
}

void add_cell(SolverMeasures& m, CellRing& ring, const Mesh& mesh, const IdVector<VertexId, double>& sizes,
              VertexId v) {
  if (mesh.is_isolated(v)) return;
  gather(ring, mesh, v, [&](VertexId u, const WeightedPoint& near) { return mesh.point(u, near); });
  const double spacing = grid_spacing(mesh.space(), ring);
  m.min_grid_spacing = std::min(m.min_grid_spacing, spacing);
  m.max_grid_spacing = std::max(m.max_grid_spacing, spacing);
  if (!mesh.is_boundary(v)) add_closed_cell(m, mesh.space(), ring, sizes[v]);
}

/// add(measures, first, last) of blocks that are merged in their order.
template <class Add>
SolverMeasures over(std::size_t n, Executor* executor, Add&& add) {
  std::vector<SolverMeasures> blocks((n + kLoopBlock - 1) / kLoopBlock);
  for_blocks(n, executor, [&](std::size_t first, std::size_t last) { add(blocks[first / kLoopBlock], first, last); });
  SolverMeasures all;
  for (const SolverMeasures& m : blocks) merge(all, m);
  return all;
}

}  // namespace

FlowCell flow_cell_of(const Mesh& mesh, TriangleId t, const WeightedPoint& near) {
  const auto at = [&](VertexId v) { return position_of(mesh, v, near); };
  const auto has_neighbor = [&](HalfedgeId h) { return mesh.twin(h).valid(); };
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(t, k), other = mesh.twin(h);
    if (!mesh.joins_halves(h) || !other.valid()) continue;
    const HalfedgeId next = Mesh::next(h), last = Mesh::prev(h), first = Mesh::next(other), second = Mesh::prev(other);
    return flow_cell({at(mesh.origin(first)), at(mesh.origin(second)), at(mesh.origin(next)), at(mesh.origin(last))},
                     {has_neighbor(first), has_neighbor(second), has_neighbor(next), has_neighbor(last)});
  }
  const auto [a, b, c] = mesh.corners(t);
  return flow_cell(at(a), at(b), at(c));
}

SolverMeasures solver_measures(const Mesh& mesh, bool brief, Executor* executor) {
  const Walk walk(mesh, executor);
  const IdVector<VertexId, double> sizes = local_sizes(mesh, walk, executor);
  SolverMeasures all = over(mesh.n_triangles(), executor, [&](SolverMeasures& m, std::size_t first, std::size_t last) {
    add_triangles(m, mesh, sizes, brief, {TriangleId(first), TriangleId(last)});
  });
  if (brief) return all;
  merge(all, over(mesh.n_vertices(), executor, [&](SolverMeasures& m, std::size_t first, std::size_t last) {
          CellRing ring;
          for (std::size_t i = first; i < last; ++i) add_cell(m, ring, mesh, sizes, walk[i]);
        }));
  return all;
}

}  // namespace temper
