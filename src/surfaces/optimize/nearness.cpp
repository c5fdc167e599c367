#include "surfaces/optimize/nearness.hpp"

#include <algorithm>
#include <cmath>

#include "base/sort_unique.hpp"

namespace temper::surfaces {
namespace {

/// Calls use(place, triangle) for the centers of triangles and the midpoints of edges.
template <class Use>
void for_each_sample(const SurfaceMesh& mesh, const Use& use) {
  const Mesh& connectivity = mesh.connectivity();
  for (const TriangleId t : mesh.triangles()) {
    const auto [p, q, r] = mesh.points(t);
    use((1.0 / 3) * (p.position() + q.position() + r.position()), t);
  }
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!connectivity.is_edge_representative(h)) continue;
    use(0.5 * (mesh.position(connectivity.origin(h)) + mesh.position(connectivity.target(h))), Mesh::triangle(h));
  }
}

}  // namespace

Nearness::Nearness(const SurfaceMesh& input, double most) : closest_(input), most_(most) {
  for (const VertexId v : input.vertices()) samples_.push_back(input.position(v));
  for_each_sample(input, [&](Vec3 p, TriangleId) { samples_.push_back(p); });
}

bool Nearness::is_near(const std::array<Vec3, 3>& triangle) const {
  const auto& [a, b, c] = triangle;
  const Vec3 places[] = {(1.0 / 3) * (a + b + c), 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)};
  return std::all_of(std::begin(places), std::end(places), [&](Vec3 p) { return closest_.is_within(most_, p); });
}

std::vector<VertexId> Nearness::too_far(const SurfaceMesh& mesh) const {
  std::vector<VertexId> vertices;
  const auto add = [&](TriangleId t) {
    for (const VertexId v : mesh.connectivity().corners(t)) vertices.push_back(v);
  };
  for_each_sample(mesh, [&](Vec3 p, TriangleId t) {
    if (!closest_.is_within(most_, p)) add(t);
  });
  const ClosestPoints now(mesh);
  for (const Vec3 p : samples_) {
    const ClosestPoint closest = now.find(p, most_);
    if (closest.squared_distance > most_ * most_) add(TriangleId(closest.triangle));
  }
  sort_unique(vertices);
  return vertices;
}

double Nearness::distance(const SurfaceMesh& mesh) const {
  double most = 0;
  // Points that are closer than others before end their search early.
  const auto add = [&](const ClosestPoints& to, Vec3 p) {
    most = std::max(most, std::sqrt(to.find(p, most).squared_distance));
  };
  for (const VertexId v : mesh.vertices()) add(closest_, mesh.position(v));
  for_each_sample(mesh, [&](Vec3 p, TriangleId) { add(closest_, p); });
  const ClosestPoints now(mesh);
  for (const Vec3 p : samples_) add(now, p);
  return most;
}

}  // namespace temper::surfaces
