#include "transfer/pieces.hpp"

#include <utility>

namespace temper {
namespace {

Vec3 ray_of(const Space& space, const WeightedPoint& p, const WeightedPoint& origin) {
  if (!space.is_plane()) return (1 / length(as_vector(p))) * as_vector(p);
  const Vec2 at = space.image(p, origin).position() - origin.position();
  return {at.x, at.y, 1};
}

}  // namespace

CutTriangle TriangleCuts::cut(TriangleId t) {
  const auto corners = mesh_.points(t);
  CutTriangle cut = {corners[0], {}, {}, {}};
  for (const WeightedPoint& p : corners) cut.triangle.push_back(ray_of(mesh_.space(), p, cut.origin));
  if (of_ == CellsOf::triangles)
    add(cut, t.index, cut.triangle);
  else
    cut_for_vertices(t, cut);
  return cut;
}

void TriangleCuts::add(CutTriangle& cut, std::uint32_t cell, const RayPolygon& polygon) const {
  const auto begin = static_cast<std::uint32_t>(cut.corners.size());
  cut.corners.insert(cut.corners.end(), polygon.begin(), polygon.end());
  cut.pieces.push_back({cell, begin, static_cast<std::uint32_t>(cut.corners.size()),
                        negligible_area(mesh_.space(), polygon), RayCircle(mesh_.space(), polygon)});
}

/// A polygon around the end of a face is divided as one, and each of its triangles has a part of the pieces.
void TriangleCuts::cut_for_vertices(TriangleId t, CutTriangle& cut) {
  const TriangleId whole = joints_.whole(t);
  const Chart chart = Chart::of_triangle(mesh_, whole);
  const WeightedPoint from = mesh_.point(mesh_.corners(whole)[0]);
  const bool plane = mesh_.space().is_plane();
  const Vec3 shift = plane ? ray_of(mesh_.space(), from, cut.origin) : Vec3();
  for (const CellPiece& piece : divider_.divide(t)) {
    polygon_.clear();
    for (const PieceCorner& corner : piece.corners) {
      const Vec3 ray = plane ? shift + Vec3{corner.at.x, corner.at.y, 0} : chart.ray(corner.at);
      polygon_.push_back(plane ? ray : (1 / length(ray)) * ray);
    }
    if (joints_.has(t)) cutter_.cut(polygon_, cut.triangle);
    if (!polygon_.empty()) add(cut, piece.owner.index, polygon_);
  }
}

}  // namespace temper
