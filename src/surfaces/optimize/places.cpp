// Places on a surface: the closest points to given points.
#include <array>
#include <cmath>

#include "surfaces/optimize/closest_point.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {
namespace {

/// The shares of the corners at a point of a triangle: corners without a share are left out.
Place place_in(const SurfaceMesh& mesh, TriangleId t, Vec3 at) {
  const std::array<VertexId, 3> corners = mesh.connectivity().corners(t);
  const auto [a, b, c] = mesh.points(t);
  const Vec3 p = a.position(), q = b.position(), r = c.position(), normal = cross(q - p, r - p);
  const auto share = [&](Vec3 from, Vec3 to) {
    return dot(cross(from - at, to - at), normal) / squared_length(normal);
  };
  const std::array<double, 3> shares = {share(q, r), share(r, p), share(p, q)};
  constexpr double kRounding = 1e-14;  // of a point on an edge or at a corner
  Place place = {t};
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (shares[k] <= kRounding) continue;
    const auto to = static_cast<std::size_t>(place.n++);
    place.corners[to] = corners[k];
    place.shares[to] = shares[k];
    sum += shares[k];
  }
  for (int k = 0; k < place.n; ++k) place.shares[static_cast<std::size_t>(k)] /= sum;
  return place;
}

}  // namespace

std::vector<Place> closest_places(const SurfaceMesh& mesh, std::span<const Vec3> points) {
  const ClosestPoints closest(mesh);
  std::vector<Place> places;
  places.reserve(points.size());
  for (const Vec3 p : points) {
    const ClosestPoint found = closest.find(p);
    places.push_back(place_in(mesh, TriangleId(found.triangle), found.at));
  }
  return places;
}

}  // namespace temper::surfaces
