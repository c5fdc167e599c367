#include "experiments/domain.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "temper/detail/geometry.hpp"
#include "temper/generate.hpp"

namespace temper::gallery {

Vec2 orthocenter_of(const Mesh& mesh, TriangleId t) {
  const auto [a, b, c] = mesh.corners(t);
  return orthocenter(mesh.point(a), mesh.point(b), mesh.point(c));
}

bool is_in_domain(const Mesh& mesh, Vec2 p) {
  const auto triangles = mesh.triangles();
  return std::any_of(triangles.begin(), triangles.end(), [&](TriangleId t) {
    const auto v = mesh.corners(t);
    for (std::size_t i = 0; i < 3; ++i) {
      if (orient2d(mesh.position(v[i]), mesh.position(v[(i + 1) % 3]), p) == Sign::negative) return false;
    }
    return true;
  });
}

double distance_to_boundary(const Mesh& mesh, Vec2 p) {
  double least = std::numeric_limits<double>::infinity();
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_boundary(h)) continue;
    const Vec2 a = mesh.position(mesh.origin(h)), along = mesh.position(mesh.target(h)) - a;
    const double t = std::clamp(dot(p - a, along) / squared_length(along), 0.0, 1.0);
    least = std::min(least, length(p - (a + t * along)));
  }
  return least;
}

std::size_t count_interior(const Mesh& mesh) {
  const auto vertices = mesh.vertices();
  return static_cast<std::size_t>(
      std::count_if(vertices.begin(), vertices.end(), [&](VertexId v) { return !mesh.is_boundary(v); }));
}

const Mesh& dense_horseshoe() {
  static const Mesh mesh = [] {
    auto made = horseshoe();
    return made ? *std::move(made) : Mesh();
  }();
  return mesh;
}

}  // namespace temper::gallery
