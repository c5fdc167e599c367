#include "files/size_hint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "exit.hpp"
#include "temper/detail/projection.hpp"
#include "temper/io.hpp"

namespace temper::app {
namespace {

struct Box {
  Vec2 low, high;
  [[nodiscard]] Vec2 sides() const { return high - low; }
  [[nodiscard]] double longer() const { return std::max(sides().x, sides().y); }
  [[nodiscard]] std::string text(const char* unit) const {
    return fmt::format("{:.4g}{} by {:.4g}{}", sides().x, unit, sides().y, unit);
  }
};

Box box_of_points(const std::vector<Vec2>& points) {
  if (points.empty()) return {};
  Box box = {points[0], points[0]};
  for (const Vec2 p : points) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  return box;
}

using Estimating = std::function<Expected<MeshEstimate>(const MesherOptions&)>;

/// Short edges of the outline make triangles at any size, so the last of some sizes may make more.
std::string usual_size(MesherOptions options, double extent, const std::string& further, const Estimating& estimate) {
  constexpr double kSomeThousand = 4000, kFirst = 50, kCoarsest = 5;  // parts of the extent
  constexpr int kRounds = 4;
  constexpr double kPatience = 2;  // seconds: then a size without a number is better
  options.size = extent / kFirst;
  options.time_limit = kPatience;
  double triangles = 0;
  for (int i = 0; i < kRounds; ++i) {
    if (i > 0) options.size = std::min(options.size * std::sqrt(triangles / kSomeThousand), extent / kCoarsest);
    options.size = std::stod(fmt::format("{:.2g}", options.size));
    const Expected<MeshEstimate> found = estimate(options);
    if (!found && found.error().code == ErrorCode::stopped)
      return fmt::format("Next: --size {}{}", options.size, further);
    triangles = or_fail(found).triangles;
  }
  constexpr double kDigits = 100;
  return fmt::format("Next: --size {}{}, which makes about {} triangles", options.size, further,
                     MeshEstimate{kDigits * std::ceil(triangles / kDigits), 0}.triangles_text());
}

}  // namespace

std::string size_hint(const Outline& outline, bool geographic, const std::string& projection,
                      const MesherOptions& options) {
  const std::string map = projection.empty() && geographic ? "stereographic" : projection;
  const bool projected = !map.empty() && map != io::kNoProjection;
  Outline plane = outline;
  std::string extent = box_of_points(outline.points).text(geographic ? "°" : "");
  if (projected) {
    plane = or_fail(project(outline, or_fail(parse_projection(map, outline.points))));
    extent += ", or " + box_of_points(plane.points).text(" m");
  }
  return "The outline is " + extent + ". " +
         usual_size(options, box_of_points(plane.points).longer(),
                    projected && projection.empty() ? " --projection " + map : "",
                    [&](const MesherOptions& o) { return estimate_outline(plane, o); }) +
         "; or --points few" + (projected && projection.empty() ? " --projection " + map : "");
}

std::string size_hint(const SphereOutline& outline, const MesherOptions& options) {
  return fmt::format("The sphere has the radius {}. ", outline.radius) +
         usual_size(options, 2 * outline.radius, "",
                    [&](const MesherOptions& o) { return estimate_sphere(outline, o); });
}

}  // namespace temper::app
