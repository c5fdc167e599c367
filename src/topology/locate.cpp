#include "topology/locate.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "mesh/predicates.hpp"

namespace temper {
namespace {

/// The side of each edge of t on which the point is.
std::array<Sign, 3> sides(const Mesh& mesh, const WeightedPoint& p, TriangleId t) {
  const auto [a, b, c] = mesh.points(t);
  const Space& space = mesh.space();
  const WeightedPoint here = space.image(p, a);
  return {inlined::orientation(space, a, b, here), inlined::orientation(space, b, c, here),
          inlined::orientation(space, c, a, here)};
}

bool is_usable(const Mesh& mesh, TriangleId t) { return t.index < mesh.n_triangles() && !mesh.is_erased(t); }

/// The last triangle of the walk from `near`, or an invalid one if it is stopped.
TriangleId walk(const Mesh& mesh, const WeightedPoint& p, TriangleId near) {
  TriangleId at = near;
  HalfedgeId entered;
  // A walk that visits more triangles than there are goes in circles.
  for (std::size_t step = 0; step <= mesh.n_triangles(); ++step) {
    const std::array<Sign, 3> side = sides(mesh, p, at);
    HalfedgeId across;
    for (int k = 0; k < 3 && !across.valid(); ++k) {
      const HalfedgeId h = Mesh::halfedge(at, k);
      if (side[static_cast<std::size_t>(k)] == Sign::negative && h != entered) across = h;
    }
    if (!across.valid()) return at;
    entered = mesh.twin(across);
    if (!entered.valid()) return {};
    at = Mesh::triangle(entered);
  }
  return {};
}

TriangleId scan(const Mesh& mesh, const WeightedPoint& p) {
  for (const TriangleId t : mesh.triangles()) {
    if (mesh.is_erased(t)) continue;
    const std::array<Sign, 3> side = sides(mesh, p, t);
    if (std::find(side.begin(), side.end(), Sign::negative) == side.end()) return t;
  }
  return {};
}

}  // namespace

Location locate(const Mesh& mesh, const WeightedPoint& p, TriangleId near) {
  TriangleId t = is_usable(mesh, near) ? walk(mesh, p, near) : TriangleId();
  if (!t.valid()) t = scan(mesh, p);
  if (!t.valid()) return {};
  const std::array<Sign, 3> side = sides(mesh, p, t);
  const auto zeros = std::count(side.begin(), side.end(), Sign::zero);
  if (zeros == 0) return {Location::Kind::in_triangle, t, {}};
  if (zeros > 1) return {Location::Kind::at_vertex, t, {}};
  const auto k = std::find(side.begin(), side.end(), Sign::zero) - side.begin();
  HalfedgeId edge = Mesh::halfedge(t, static_cast<int>(k));
  if (!mesh.is_boundary(edge) && mesh.target(edge) < mesh.origin(edge)) edge = mesh.twin(edge);
  return {Location::Kind::on_edge, Mesh::triangle(edge), edge};
}

}  // namespace temper
