#include "surfaces/optimize/nearness.hpp"

#include <algorithm>

namespace temper::surfaces {

Nearness::Nearness(const SurfaceMesh& input, double most) : closest_(input), most_(most) {}

Nearness::Known Nearness::after_edit(const SurfaceMesh& before, const std::vector<TriangleId>& replaced,
                                     const SurfaceMesh& after) const {
  Known known;
  for (const TriangleId t : after.triangles()) known.triangles.push_back(corners_of(after, t));
  known.is_near.assign(after.n_triangles(), 1);
  known.is_input_near.assign(closest_.targets().size(), 1);
  for (const TriangleId t : replaced) {
    for (const std::uint32_t s : closest_.near(corners_of(before, t), most_)) known.is_input_near[s] = 0;
  }
  return known;
}

std::vector<VertexId> Nearness::too_far(const SurfaceMesh& mesh, Known& known) const {
  std::vector<VertexId> vertices;
  const auto add = [&](std::size_t t) {
    for (const VertexId v : mesh.connectivity().corners(TriangleId(t))) vertices.push_back(v);
  };
  const ClosestPoints now(mesh);
  known.triangles.resize(mesh.n_triangles());
  known.is_near.resize(mesh.n_triangles());
  known.is_input_near.resize(closest_.targets().size());
  for (std::size_t t = 0; t < mesh.n_triangles(); ++t) {
    const ClosestPoints::Triangle& triangle = now.targets()[t].corners;
    if (known.triangles[t] != triangle) {
      for (const std::uint32_t s : closest_.near(known.triangles[t], most_)) known.is_input_near[s] = 0;
      known.triangles[t] = triangle;
      known.is_near[t] = is_near(triangle) ? 1 : 0;
    }
    if (known.is_near[t] == 0) add(t);
  }
  for (std::size_t s = 0; s < closest_.targets().size(); ++s) {
    if (known.is_input_near[s] != 0) continue;
    const DistanceBound bound = now.bound(closest_.targets()[s].corners, most_, most_);
    known.is_input_near[s] = bound.most <= most_ ? 1 : 0;
    if (known.is_input_near[s] == 0) add(now.find(bound.far).triangle);
  }
  return vertices;
}

double Nearness::distance(const SurfaceMesh& mesh) const {
  constexpr double kRounding = 1e-11;  // of the largest allowed distance: less is not told from 0
  double most = kRounding * most_;
  const ClosestPoints now(mesh);
  const auto add = [&](const ClosestPoints& from, const ClosestPoints& to) {
    for (std::size_t t = 0; t < from.targets().size(); ++t) {
      const ClosestPoints::Triangle& corners = from.targets()[t].corners;
      const bool stays = t < to.targets().size() && to.targets()[t].corners == corners;
      if (!stays) most = std::min(most_, to.bound(corners, most, most_).most);
    }
  };
  add(now, closest_);
  add(closest_, now);
  return most;
}

}  // namespace temper::surfaces
