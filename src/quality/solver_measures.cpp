#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/median.hpp"
#include "geometry/surface.hpp"
#include "mesh/blocks.hpp"
#include "quality/measure.hpp"
#include "size/star_area.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/mesh.hpp"

namespace temper {
namespace {

// Triangles as the finite volumes of D-Flow FM, by the definitions of MeshKernel, the library of its grid editor. It
// has no weights, and its centers of cells are circumcenters kept inside.
//
//        c            The circumcenter o of an obtuse triangle is outside. In its place D-Flow FM takes the point x at
//       / \           which the way from the centroid m to o leaves the triangle. On the sphere all this holds for the
//      / m \          flat triangle. MeshKernel itself has no circumcenters there, except in longitude and latitude.
//     a--x--b
//         o

/// The place of a vertex, without its weight: of its images, the one near a point.
[[nodiscard]] inline Vec3 position_of(const Mesh& mesh, VertexId v, const WeightedPoint& near) {
  return mesh.space().place(mesh.point(v, near));
}

struct FlowCell {
  Vec3 center;
  double area = 0;
};

[[nodiscard]] inline FlowCell flow_cell(Vec3 a, Vec3 b, Vec3 c) {
  const double la = squared_length(c - b), lb = squared_length(a - c), lc = squared_length(b - a);
  // Barycentric coordinates of the circumcenter, times 16 A².
  const std::array<double, 3> at = {la * (lb + lc - la), lb * (lc + la - lb), lc * (la + lb - lc)};
  const double sum = at[0] + at[1] + at[2];
  constexpr double kThird = 1.0 / 3;
  double way = 1;  // from the centroid to the circumcenter, as far as it is inside
  for (const double x : at) {
    if (x < 0) way = std::min(way, kThird / (kThird - x / sum));
  }
  if (!(sum > 0)) way = 0;
  const auto weight = [&](std::size_t k) { return way == 0 ? kThird : kThird + way * (at[k] / sum - kThird); };
  return {a + weight(1) * (b - a) + weight(2) * (c - a), 0.5 * length(cross(b - a, c - a))};
}

constexpr double kSmallFlowLink = 0.1;  // D-Flow FM's default of removeSmallLinksTrsh

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

FlowCell flow_cell_of(const Mesh& mesh, TriangleId t, const WeightedPoint& near) {
  const auto [a, b, c] = mesh.corners(t);
  FlowCell cell = flow_cell(position_of(mesh, a, near), position_of(mesh, b, near), position_of(mesh, c, near));
  // Half a quadrilateral has its own center, but the area of the whole.
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(t, k), other = mesh.twin(h);
    if (!mesh.is_diagonal(h) || !other.valid()) continue;
    const auto at = [&](VertexId v) { return position_of(mesh, v, near); };
    cell.area += flow_cell(at(mesh.origin(other)), at(mesh.target(other)), at(mesh.opposite(other))).area;
  }
  return cell;
}

void add_flow_link(SolverMeasures& m, const Mesh& mesh, HalfedgeId h) {
  // Rounding determines the direction of a shorter edge. It is a small flow link anyway.
  constexpr double kHasDirection = 0x1p-40;  // of the edge
  const WeightedPoint from = mesh.point(mesh.origin(h));
  const FlowCell left = flow_cell_of(mesh, Mesh::triangle(h), from),
                 right = flow_cell_of(mesh, Mesh::triangle(mesh.twin(h)), from);
  const Vec3 edge = position_of(mesh, mesh.target(h), from) - position_of(mesh, mesh.origin(h), from),
             link = right.center - left.center;
  const double edge_length = length(edge), link_length = length(link);
  if (link_length > kHasDirection * edge_length) {
    m.max_orthogonality =
        std::max(m.max_orthogonality, std::min(1.0, std::abs(dot(edge, link)) / (edge_length * link_length)));
  }
  const auto [smaller, larger] = std::minmax(left.area, right.area);
  m.max_smoothness =
      std::max(m.max_smoothness, smaller > 0 ? larger / smaller : std::numeric_limits<double>::infinity());
  const double relative = link_length / (0.5 * (std::sqrt(left.area) + std::sqrt(right.area)));
  m.min_flow_link = std::min(m.min_flow_link, relative);
  m.small_flow_links += relative < kSmallFlowLink;
}

// --- MPAS-Tools: their cells are vertices here, and their vertices triangles -----------------------------------------

/// The angle across from a.
double angle_across(double a, double b, double c) {
  return std::acos(std::clamp((b * b + c * c - a * a) / (2 * b * c), -1.0, 1.0));
}

bool is_obtuse(const Mesh& mesh, TriangleId t) {
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(t, k);
    if (mesh.is_diagonal(h)) continue;
    const WeightedPoint from = mesh.point(mesh.origin(h));
    const Vec3 a = position_of(mesh, mesh.origin(h), from), b = position_of(mesh, mesh.target(h), from),
               c = position_of(mesh, mesh.opposite(h), from);
    // Without weights the center is across from an obtuse angle.
    if (signed_height_sign(mesh.space(), as_point(a), as_point(b), as_point(c)) == Sign::negative) return true;
  }
  return false;
}

void add_triangle(SolverMeasures& m, const Mesh& mesh, TriangleId t) {
  const auto [p, q, r] = mesh.points(t);
  const double a = distance(mesh.space(), q, r), b = distance(mesh.space(), r, p), c = distance(mesh.space(), p, q);
  m.min_triangle_quality = std::min(m.min_triangle_quality, std::min({a, b, c}) / std::max({a, b, c}));
  const auto [least, largest] = std::minmax({angle_across(a, b, c), angle_across(b, c, a), angle_across(c, a, b)});
  m.min_triangle_angle_quality = std::min(m.min_triangle_angle_quality, least / largest);
  m.obtuse_triangles += is_obtuse(mesh, t);
}

/// A vertex with its neighbors, counter-clockwise; one more than triangles on the boundary.
struct Ring {
  WeightedPoint center;
  std::vector<WeightedPoint> around;

  [[nodiscard]] const WeightedPoint& after(std::size_t k) const { return around[k + 1 < around.size() ? k + 1 : 0]; }
  [[nodiscard]] const WeightedPoint& before(std::size_t k) const { return around[(k > 0 ? k : around.size()) - 1]; }
};

/// Fills the list that `ring` has already.
void gather(Ring& ring, const Mesh& mesh, VertexId v) {
  ring.center = mesh.point(v);
  ring.around.clear();
  for (const HalfedgeId h : mesh.star(v)) {
    ring.around.push_back(mesh.point(mesh.target(h), ring.center));
    if (mesh.is_boundary(Mesh::prev(h))) ring.around.push_back(mesh.point(mesh.opposite(h), ring.center));
  }
}

void add_grid_spacing(SolverMeasures& m, const Space& space, const Ring& ring) {
  double sum = 0;
  for (const WeightedPoint& p : ring.around) sum += distance(space, ring.center, p);
  const double mean = sum / static_cast<double>(ring.around.size());
  m.min_grid_spacing = std::min(m.min_grid_spacing, mean);
  m.max_grid_spacing = std::max(m.max_grid_spacing, mean);
}

/// The distance of the centroid of the power cell from the vertex. It is measured in the plane that touches the sphere
/// there, and mapped back to the sphere; +∞ for a cell that is not counter-clockwise.
double centroid_offset(const Space& space, const Ring& ring) {
  const Vec3 at = space.place(ring.center), up = space.up(as_point(at));
  Vec3 moment = {0, 0, 0};
  double doubled = 0;
  Vec3 from = as_vector(orthocenter(space, ring.center, ring.before(0), ring.around[0])) - at;
  for (std::size_t k = 0; k < ring.around.size(); ++k) {
    const Vec3 to = as_vector(orthocenter(space, ring.center, ring.around[k], ring.after(k))) - at;
    const double area = dot(up, cross(from, to));
    moment = moment + (area / 3) * (from + to);
    doubled += area;
    from = to;
  }
  if (!(doubled > 0)) return std::numeric_limits<double>::infinity();
  const Vec3 offset = (1 / doubled) * moment;
  const double height = dot(up, offset), across = length(offset - height * up);
  return space.along_surface(across, height);
}

/// Precondition: the ring is closed, the vertex not on the boundary.
void add_closed_cell(SolverMeasures& m, const Space& space, const Ring& ring, double size) {
  std::vector<double> duals;
  duals.reserve(ring.around.size());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < ring.around.size(); ++k) {
    const double dual = dual_length(space, ring.center, ring.around[k], ring.after(k), ring.before(k));
    least = std::min(least, dual);
    duals.push_back(std::abs(dual));
  }
  const auto [shortest, longest] = std::minmax_element(duals.begin(), duals.end());
  m.min_cell_quality = std::min(m.min_cell_quality, *longest > 0 ? *shortest / *longest : 0);
  const double median = median_of(std::move(duals));
  m.min_dual_over_cell_median = std::min(m.min_dual_over_cell_median, median > 0 ? least / median : 0);
  m.max_centroid_offset_over_size = std::max(m.max_centroid_offset_over_size, centroid_offset(space, ring) / size);
}

// --- all -----------------------------------------------------------------------------------------------------

void add_triangles(SolverMeasures& m, const Mesh& mesh, const IdVector<VertexId, double>& sizes, bool brief,
                   std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    if (!brief) add_triangle(m, mesh, TriangleId(i));
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(TriangleId(i), k);
      if (mesh.is_boundary(h) || !mesh.is_edge_representative(h) || mesh.is_diagonal(h)) continue;
      const auto [edge, dual] = relative_lengths(mesh, sizes, h);
      m.min_edge_over_size = std::min(m.min_edge_over_size, edge);
      m.min_dual_over_size = std::min(m.min_dual_over_size, dual);
      if (!brief) add_flow_link(m, mesh, h);
    }
  }
}

void add_cell(SolverMeasures& m, Ring& ring, const Mesh& mesh, const IdVector<VertexId, double>& sizes, VertexId v) {
  if (mesh.is_isolated(v)) return;
  gather(ring, mesh, v);
  add_grid_spacing(m, mesh.space(), ring);
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

SolverMeasures solver_measures(const Mesh& mesh, bool brief, Executor* executor) {
  const Walk walk(mesh, executor);
  const IdVector<VertexId, double> sizes = local_sizes(mesh, walk, executor);
  SolverMeasures all = over(mesh.n_triangles(), executor, [&](SolverMeasures& m, std::size_t first, std::size_t last) {
    add_triangles(m, mesh, sizes, brief, first, last);
  });
  if (brief) return all;
  merge(all, over(mesh.n_vertices(), executor, [&](SolverMeasures& m, std::size_t first, std::size_t last) {
          Ring ring;
          for (std::size_t i = first; i < last; ++i) add_cell(m, ring, mesh, sizes, walk[i]);
        }));
  return all;
}

}  // namespace temper
