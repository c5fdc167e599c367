#include "mesher/face_polygons.hpp"

#include <algorithm>

#include "regularity/lawson.hpp"
#include "temper/detail/faces.hpp"

namespace temper::mesher {

FacePolygons::FacePolygons(const Domain& domain, const Corridors& corridors, const Inside& inside)
    : domain_(domain), corridors_(corridors), inside_(inside) {
  if (corridors.polygons.empty()) return;
  weights_.resize(inside.places.size(), 0);
  for (std::uint32_t i = 0; i < corridors.weights.size(); ++i) {
    if (vertex(i) >= 0) weights_[id(i).index] = corridors.weights[i];
  }
}

void FacePolygons::add(Connectivity& connectivity) const {
  for (const auto& polygon : corridors_.polygons) {
    const std::size_t n = polygon.size();
    std::int32_t region = 0;
    for (const std::uint32_t site : polygon) {
      if (corridors_.areas[site] != kOutside) region = domain_.area(corridors_.areas[site]).region;
    }
    for (std::size_t i = 0; i < n; ++i)
      connectivity.constrained.push_back({vertex(polygon[i]), vertex(polygon[(i + 1) % n])});
    for (std::size_t i = 2; i < n; ++i) {
      connectivity.triangles.push_back({vertex(polygon[0]), vertex(polygon[i - 1]), vertex(polygon[i])});
      connectivity.regions.push_back(region);
    }
  }
}

/// All triangulations of a polygon are regular, except for rounding. Exact flips find the one that is.
void FacePolygons::make_regular(Mesh& mesh) const {
  Lawson lawson;
  for (const auto& polygon : corridors_.polygons) {
    for (std::size_t i = 2; i + 1 < polygon.size(); ++i) {
      const HalfedgeId h = mesh.find_halfedge(id(polygon[0]), id(polygon[i]));
      lawson.push(h);
    }
  }
  lawson.run(mesh);
}

void FacePolygons::set_regions(Mesh& mesh) const {
  IdVector<VertexId, std::uint32_t> polygon_of(mesh.n_vertices(), 0);  // from 1
  IdVector<VertexId, std::int32_t> area_of(mesh.n_vertices(), kOutside);
  for (std::uint32_t k = 0; k < corridors_.polygons.size(); ++k) {
    for (const std::uint32_t site : corridors_.polygons[k]) {
      polygon_of[id(site)] = k + 1;
      area_of[id(site)] = corridors_.areas[site];
    }
    for (const std::uint32_t site : corridors_.polygons[k]) {
      for (const HalfedgeId h : mesh.star(id(site))) {
        const auto corners = mesh.corners(Mesh::triangle(h));
        if (!std::ranges::all_of(corners, [&](VertexId v) { return polygon_of[v] == k + 1; })) continue;
        std::array<std::int32_t, 3> areas = {area_of[corners[0]], area_of[corners[1]], area_of[corners[2]]};
        std::ranges::sort(areas);
        // Sorted, two equal ones have the middle. Sites on lines are in no area, and come first.
        const std::int32_t most = areas[1] == areas[0] || areas[1] == areas[2] ? areas[1] : areas[2];
        if (std::max(most, areas[2]) == kOutside) continue;
        mesh.set_region(Mesh::triangle(h), domain_.area(most == kOutside ? areas[2] : most).region);
      }
    }
  }
}

void FacePolygons::append(const SitePair& pair, std::vector<MeshLine>& lines) const {
  const std::vector<std::int32_t>& tags = domain_.arrangement.edges[pair.edge].tags;
  for (const std::int32_t tag : tags) lines.push_back({id(pair.ends[0]), id(pair.ends[1]), tag});
  if (tags.empty()) lines.push_back({id(pair.ends[0]), id(pair.ends[1]), 0});
}

void FacePolygons::settle(Mesh& mesh, std::vector<MeshLine>& lines) const {
  if (corridors_.polygons.empty()) return;
  for (const SitePair& pair : corridors_.chords) {
    HalfedgeId h = mesh.find_halfedge(id(pair.ends[0]), id(pair.ends[1]));
    if (!h.valid()) h = mesh.find_halfedge(id(pair.ends[1]), id(pair.ends[0]));
    if (mesh.is_boundary(h)) mesh.set_constrained(h, false);  // as all of the boundary
  }
  make_regular(mesh);
  set_regions(mesh);
  std::vector<HalfedgeId> faces;
  for (const SitePair& pair : corridors_.faces) {
    faces.push_back(mesh.find_halfedge(id(pair.ends[0]), id(pair.ends[1])));
    append(pair, lines);
  }
  for (const SitePair& pair : corridors_.chords) append(pair, lines);
  keep_faces(mesh, faces);
}

}  // namespace temper::mesher
