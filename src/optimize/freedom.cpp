#include "optimize/freedom.hpp"

#include <cmath>

namespace temper {
namespace {

// Two constrained edges are one straight line when they turn by less than this (radians): coordinates read from a
// file, or rounded by earlier sliding, are collinear only so far.
constexpr double kStraight = 1e-9;

/// How constrained edges pass through a vertex.
struct ConstrainedLine {
  enum Shape { none, straight, bent } shape = none;
  Vec2 direction;  ///< of a straight one, unit length
};

ConstrainedLine constrained_line(const Mesh& mesh, VertexId v) {
  int count = 0;
  std::array<Vec2, 2> ends;
  for (const HalfedgeId h : mesh.star(v)) {
    if (!mesh.is_constrained(h)) continue;
    if (count < 2) ends[static_cast<std::size_t>(count)] = mesh.position(mesh.target(h)) - mesh.position(v);
    ++count;
  }
  if (count == 0) return {ConstrainedLine::none, {}};
  if (count != 2) return {ConstrainedLine::bent, {}};
  const double scale = length(ends[0]) * length(ends[1]);
  if (std::abs(cross(ends[0], ends[1])) > kStraight * scale || dot(ends[0], ends[1]) > 0) {
    return {ConstrainedLine::bent, {}};
  }
  const Vec2 along = ends[1] - ends[0];
  return {ConstrainedLine::straight, (1 / length(along)) * along};
}

void add_axis(Freedom& f, std::array<double, 3> axis) { f.axis[static_cast<std::size_t>(f.n++)] = axis; }

}  // namespace

Freedom weight_only() {
  Freedom f;
  add_axis(f, {0, 0, 1});
  return f;
}

Freedom position_part(const Freedom& all) {
  Freedom f;
  for (int i = 0; i < all.n; ++i) {
    const auto& axis = all.axis[static_cast<std::size_t>(i)];
    if (axis[2] == 0) add_axis(f, axis);
  }
  return f;
}

IdVector<VertexId, Mobility> mobilities(const Mesh& mesh, InterfaceVertices interfaces) {
  IdVector<VertexId, Mobility> result(mesh.n_vertices(), Mobility::fixed);
  for (const VertexId v : mesh.vertices()) {
    if (mesh.is_boundary(v) || mesh.is_fixed(v)) continue;
    const ConstrainedLine line = constrained_line(mesh, v);
    if (line.shape == ConstrainedLine::none) result[v] = Mobility::free;
    if (line.shape == ConstrainedLine::straight && interfaces == InterfaceVertices::sliding) {
      result[v] = Mobility::sliding;
    }
  }
  return result;
}

Freedom freedom(const Mesh& mesh, VertexId v, Mobility mobility, Unknowns unknowns) {
  Freedom f;
  if (unknowns != Unknowns::weights) {
    if (mobility == Mobility::free) {
      add_axis(f, {1, 0, 0});
      add_axis(f, {0, 1, 0});
    } else if (mobility == Mobility::sliding) {
      const Vec2 direction = constrained_line(mesh, v).direction;
      add_axis(f, {direction.x, direction.y, 0});
    }
  }
  if (unknowns != Unknowns::positions) add_axis(f, {0, 0, 1});
  return f;
}

}  // namespace temper
