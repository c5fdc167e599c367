// Places of vertices, orthocenters, midpoints and corners of cells, in either space.
#include "io/dec_files.hpp"

namespace temper::io {
namespace {

DecPlaces places_in(const std::vector<Vec2>& plane, const std::vector<Vec3>& sphere) {
  if (!sphere.empty()) return {3, sphere};
  DecPlaces places;
  places.at.reserve(plane.size());
  for (const Vec2 p : plane) places.at.push_back({p.x, p.y, 0});
  return places;
}

}  // namespace

DecPlaces vertex_places(const Mesh& mesh) {
  const Space& space = mesh.space();
  DecPlaces places;
  places.coordinates = space.is_plane() ? 2 : 3;
  for (const VertexId v : mesh.vertices()) {
    const Vec2 p = space.is_plane() ? mesh.position(v) : Vec2{};
    places.at.push_back(space.is_plane() ? Vec3{p.x, p.y, 0} : space.place(mesh.point(v)));
  }
  return places;
}

DecPlaces orthocenter_places(const DecComplex& complex) {
  return places_in(complex.orthocenters.raw(), complex.sphere_orthocenters.raw());
}

DecPlaces midpoint_places(const DecComplex& complex) {
  std::vector<Vec2> midpoints;
  for (const DecEdge& edge : complex.edges) midpoints.push_back(edge.midpoint);
  return places_in(midpoints, complex.sphere_midpoints.raw());
}

DecPlaces corner_places(const PowerCells& cells) { return places_in(cells.corners, cells.sphere_corners); }

}  // namespace temper::io
