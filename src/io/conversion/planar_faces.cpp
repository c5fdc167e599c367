#include "io/conversion/planar_faces.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "io/conversion/quadrilaterals.hpp"
#include "io/text/failure.hpp"

namespace temper::io {
namespace {

/// Directed edge 2 e runs along edge e, and 2 e + 1 against it.
class PlanarGraph {
 public:
  PlanarGraph(std::span<const Vec2> points, std::span<const EdgeEnds> edges)
      : points_(points), edges_(edges), turn_(2 * edges.size()), seen_(2 * edges.size()) {
    // The edges out of each point, counter-clockwise.
    std::vector<std::size_t> all(2 * edges.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    std::ranges::sort(all, {}, [this](std::size_t d) { return std::tuple(origin(d), angle(d), d); });
    for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
      while (end < all.size() && origin(all[end]) == origin(all[first])) ++end;
      // Clockwise before it: the next side of the face on the left of the edge that comes in here.
      for (std::size_t i = first; i < end; ++i) turn_[all[i] ^ 1] = all[i == first ? end - 1 : i - 1];
    }
  }

  /// The corners of the face on the left; empty if it was met before.
  [[nodiscard]] std::vector<std::int32_t> face(std::size_t start) {
    std::vector<std::int32_t> corners;
    for (std::size_t d = start; !seen_[d]; d = turn_[d]) {
      seen_[d] = true;
      corners.push_back(origin(d));
    }
    return corners;
  }
  [[nodiscard]] double doubled_area(const std::vector<std::int32_t>& corners) const {
    double sum = 0;
    const Vec2 first = at(corners[0]);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
      sum += cross(at(corners[i]) - first, at(corners[i + 1]) - first);
    return sum;
  }

 private:
  [[nodiscard]] Vec2 at(std::int32_t p) const { return points_[static_cast<std::size_t>(p)]; }
  [[nodiscard]] std::int32_t origin(std::size_t d) const { return edges_[d / 2][d % 2]; }
  [[nodiscard]] double angle(std::size_t d) const {
    Vec2 way = at(origin(d ^ 1)) - at(origin(d));
    return std::atan2(way.y, way.x);
  }

  std::span<const Vec2> points_;
  std::span<const EdgeEnds> edges_;
  std::vector<std::size_t> turn_;  // the side of the face on the left that follows a directed edge
  std::vector<bool> seen_;
};

}  // namespace

std::vector<std::array<std::int32_t, 4>> planar_faces(std::span<const Vec2> points, std::span<const EdgeEnds> edges,
                                                      const InputNames& names, const std::string& path) {
  constexpr std::size_t kMostSides = 6;
  PlanarGraph graph(points, edges);
  std::vector<std::array<std::int32_t, 4>> faces;
  for (std::size_t d = 0; d < 2 * edges.size(); ++d) {
    const std::vector<std::int32_t> corners = graph.face(d);
    if (corners.size() < 3 || corners.size() > kMostSides || !(graph.doubled_area(corners) > 0)) continue;
    if (corners.size() <= 4) {
      faces.push_back({corners[0], corners[1], corners[2], corners.size() == 4 ? corners[3] : kNoCorner});
      continue;
    }
    std::string all;
    for (const std::int32_t p : corners) all += text(all.empty() ? "" : ", ", names.point(static_cast<std::size_t>(p)));
    const Vec2 at = points[static_cast<std::size_t>(corners[0])];
    fail(ErrorCode::unsupported, path, "edges enclose a face with ", corners.size(), " sides, ", all, ", at (", at.x,
         ", ", at.y, "); temper reads triangles and quadrilaterals. Next: cut this face into these");
  }
  return faces;
}

}  // namespace temper::io
