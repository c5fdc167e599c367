#include "optimize/step/dofs.hpp"

#include <cmath>

#include "geometry/triangle_kernel.hpp"
#include "mesh/blocks.hpp"

namespace temper {
namespace {

/// The constrained and boundary edges at a vertex, which must keep their place, and their shape there.
struct FixedLine {
  enum Shape { none, straight, bent } shape = none;
  Vec2 direction;  ///< if straight, as a unit vector
};

FixedLine fixed_line(const Mesh& mesh, VertexId v) {
  int count = 0;
  std::array<Vec2, 2> ends;
  const WeightedPoint p = mesh.point(v);
  const auto add = [&](VertexId end) {
    if (count < 2) ends[static_cast<std::size_t>(count)] = direction_to(mesh.space(), p, mesh.point(end, p));
    ++count;
  };
  for (const HalfedgeId h : mesh.star(v)) {
    if (mesh.is_unflippable(h)) add(mesh.target(h));
    if (mesh.is_boundary(Mesh::prev(h))) add(mesh.opposite(h));  // into v: the other end of a boundary vertex's star
  }
  if (count == 0) return {FixedLine::none, {}};
  if (count != 2) return {FixedLine::bent, {}};
  const double scale = length(ends[0]) * length(ends[1]);
  if (std::abs(cross(ends[0], ends[1])) > kStraight * scale || dot(ends[0], ends[1]) > 0) return {FixedLine::bent, {}};
  const Vec2 along = ends[1] - ends[0];
  return {FixedLine::straight, (1 / length(along)) * along};
}

void add_axis(Dofs& f, std::array<double, 3> axis) { f.axis[static_cast<std::size_t>(f.n++)] = axis; }

}  // namespace

Mobility mobility(const Mesh& mesh, VertexId v, const OptimizeOptions& options) {
  if (mesh.is_frozen(v)) return Mobility::frozen;
  if (mesh.is_fixed(v)) return Mobility::fixed;
  const FixedLine line = fixed_line(mesh, v);
  if (line.shape == FixedLine::none) return Mobility::free;
  if (line.shape == FixedLine::bent) return Mobility::fixed;
  const bool slides = mesh.is_boundary(v) ? options.boundary == BoundaryVertices::slide
                                          : options.interfaces == InterfaceVertices::sliding;
  return slides ? Mobility::sliding : Mobility::fixed;
}

IdVector<VertexId, Mobility> mobilities(const Mesh& mesh, const OptimizeOptions& options, Executor* executor) {
  IdVector<VertexId, Mobility> result(mesh.n_vertices());
  for_each_index(mesh.n_vertices(), executor,
                 [&](std::size_t i) { result[VertexId(i)] = mobility(mesh, VertexId(i), options); });
  return result;
}

Dofs dofs(Vec2 direction, Unknowns unknowns) {
  Dofs f;
  if (unknowns != Unknowns::weights) add_axis(f, {direction.x, direction.y, 0});
  if (unknowns != Unknowns::positions) add_axis(f, {0, 0, 1});
  return f;
}

Dofs dofs(const Mesh& mesh, VertexId v, Mobility mobility, Unknowns unknowns) {
  if (mobility == Mobility::sliding) return dofs(fixed_line(mesh, v).direction, unknowns);
  Dofs f;
  if (mobility == Mobility::frozen) return f;
  if (unknowns != Unknowns::weights) {
    if (mobility == Mobility::free) {
      add_axis(f, {1, 0, 0});
      add_axis(f, {0, 1, 0});
    }
  }
  if (unknowns != Unknowns::positions) add_axis(f, {0, 0, 1});
  return f;
}

}  // namespace temper
