#include "dec/joint_polygons.hpp"

#include <algorithm>

#include "temper/detail/geometry.hpp"

namespace temper {

JointPolygons::JointPolygons(const Mesh& mesh) : mesh_(mesh) {
  const auto halfedges = mesh.halfedges();
  if (std::none_of(halfedges.begin(), halfedges.end(), [&](HalfedgeId h) { return mesh.is_joint(h); })) return;
  number_.assign(mesh.n_triangles(), -1);
  for (const HalfedgeId h : halfedges) {
    if (mesh.is_joint(h) && !has(Mesh::triangle(h))) add(Mesh::triangle(h));
  }
}

bool JointPolygons::has_one_region(TriangleId t) const {
  return std::ranges::all_of(triangles(t), [&](TriangleId other) { return mesh_.region(other) == mesh_.region(t); });
}

void JointPolygons::add(TriangleId t) {
  const auto number = static_cast<std::int32_t>(polygons_.size());
  Polygon polygon = {t, {t}, {}};
  number_[t] = number;
  double most = 0;
  for (std::size_t i = 0; i < polygon.triangles.size(); ++i) {
    const TriangleId here = polygon.triangles[i];
    const auto [a, b, c] = mesh_.points(here);
    const double area = mesh_.space().is_plane() ? cross(b.position() - a.position(), c.position() - a.position()) : 0;
    if (area > most) most = area, polygon.largest = here;
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(here, k);
      if (!is_inside(h) || has(Mesh::triangle(mesh_.twin(h)))) continue;
      polygon.triangles.push_back(Mesh::triangle(mesh_.twin(h)));
      number_[polygon.triangles.back()] = number;
    }
  }
  polygon.sides = sides_of(polygon.triangles);
  polygons_.push_back(std::move(polygon));
}

/// Each side is followed by the one that begins at its end.
std::vector<HalfedgeId> JointPolygons::sides_of(std::span<const TriangleId> triangles) const {
  std::vector<HalfedgeId> all, sides;
  for (const TriangleId t : triangles) {
    for (int k = 0; k < 3; ++k) {
      if (!is_inside(Mesh::halfedge(t, k))) all.push_back(Mesh::halfedge(t, k));
    }
  }
  for (HalfedgeId h = all.front(); sides.size() < all.size();) {
    sides.push_back(h);
    h = *std::ranges::find(all, mesh_.target(h), [&](HalfedgeId side) { return mesh_.origin(side); });
  }
  return sides;
}

}  // namespace temper
