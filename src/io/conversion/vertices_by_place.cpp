// The points of a file at the places of vertices, if nothing else tells which vertex came from which point.
#include <cmath>
#include <unordered_map>

#include "io/conversion/globe.hpp"
#include "io/conversion/update.hpp"

namespace temper::io {
namespace {

/// For each vertex the point at its place in the plane, bit for bit.
Former vertices_by_place_in_plane(const std::vector<Vec2>& points, const Mesh& mesh) {
  std::unordered_map<Vec2, VertexId, PlaceHash> places;
  for (std::size_t p = 0; p < points.size(); ++p) {
    places.emplace(mesh.space().in_domain({points[p].x, points[p].y, 0}).position(), VertexId(p));
  }
  Former former(mesh.n_vertices());
  for (const VertexId v : mesh.vertices()) {
    const auto found = places.find(mesh.position(v));
    if (found != places.end()) former[v] = found->second;
  }
  return former;
}

/// Points of a sphere by their place. Weights round places, so the search uses cells much larger than this rounding.
class PlacesOnSphere {
 public:
  PlacesOnSphere(std::span<const Vec3> points, const Space& space) : points_(points), space_(space) {
    for (std::size_t p = 0; p < points.size(); ++p) cells_.emplace(cell(direction(points[p])), VertexId(p));
  }
  /// The point at the place of p, which is in its cell or just across a side of the cell; invalid: none.
  [[nodiscard]] VertexId find(const Vec3& p) const {
    const Vec3 middle = direction(p);
    for (const double x : {-kRounded, kRounded}) {
      for (const double y : {-kRounded, kRounded}) {
        for (const double z : {-kRounded, kRounded}) {
          const auto [first, last] = cells_.equal_range(cell(middle + Vec3{x, y, z}));
          for (auto it = first; it != last; ++it) {
            if (space_.same_place(as_point(points_[it->second.index]), as_point(p))) return it->second;
          }
        }
      }
    }
    return {};
  }

 private:
  static constexpr double kRounded = 0x1p-46;       // above same_place()'s tolerance and direction()'s rounding
  static constexpr double kCellsOfRadius = 0x1p36;  // on the Earth a cell is a tenth of a millimeter wide
  static Vec3 direction(const Vec3& p) { return (1 / length(p)) * p; }
  static Vec3 cell(const Vec3& p) {
    return {std::floor(kCellsOfRadius * p.x), std::floor(kCellsOfRadius * p.y), std::floor(kCellsOfRadius * p.z)};
  }

  std::span<const Vec3> points_;
  const Space& space_;
  std::unordered_multimap<Vec3, VertexId, PlaceHash> cells_;
};

}  // namespace

Former vertices_by_place(const MeshFile& file, const Mesh& mesh) {
  if (file.sphere() == nullptr) return vertices_by_place_in_plane(file.points, mesh);
  const PlacesOnSphere places(file.sphere()->places, mesh.space());
  Former former(mesh.n_vertices());
  for (const VertexId v : mesh.vertices()) former[v] = places.find(mesh.weighted_vector(v));
  return former;
}

}  // namespace temper::io
