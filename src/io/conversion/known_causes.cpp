#include "io/conversion/known_causes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "io/conversion/adcirc.hpp"
#include "io/text/failure.hpp"
#include "io/text/values.hpp"

namespace temper::io {
namespace {

// ADCIRC's IBTYPE of vertical element walls: weirs without width, whose sides are nodes at one place.
constexpr std::int32_t kVerticalElementWall = 64;

/// Errors come before all numbers are known to be right, in a mesh that was made by hand.
bool numbers_are_right(const MeshFile& file) {
  const auto right = [&](std::int32_t p) { return p >= 0 && static_cast<std::size_t>(p) < file.points.size(); };
  return !file.points.empty() && file.point_tags.size() == file.marked_points.size() &&
         std::all_of(file.marked_points.begin(), file.marked_points.end(), right) &&
         std::all_of(file.triangles.begin(), file.triangles.end(),
                     [&](const auto& triangle) { return std::all_of(triangle.begin(), triangle.end(), right); });
}

/// Names the first node of a levee or wall that is where its partner is.
std::optional<InputError> sides_at_one_place(const MeshFile& file, const InputNames& names) {
  const DataArray* data = find(file.marked_point_data, kAdcircSide);
  const auto sides = data == nullptr ? std::nullopt : to_int32(data->values);
  if (!sides || sides->size() != file.marked_points.size()) return std::nullopt;
  std::map<std::int32_t, std::string_view> boundaries;
  for (const PhysicalName& n : file.names) {
    if (n.dimension == 1) boundaries.emplace(n.tag, n.name);
  }
  for (std::size_t i = 1; i < sides->size(); ++i) {
    const auto a = static_cast<std::size_t>(file.marked_points[i - 1]);
    const auto b = static_cast<std::size_t>(file.marked_points[i]);
    const bool pair = (*sides)[i - 1] == 0 && (*sides)[i] == 1 && file.point_tags[i - 1] == file.point_tags[i];
    if (!pair || a == b || !(file.points[a] == file.points[b])) continue;
    const auto name = boundaries.find(file.point_tags[i]);
    const auto kind = name == boundaries.end() ? std::nullopt : adcirc_boundary(name->second);
    if (!kind) continue;
    const std::string_view what = kind->type == kVerticalElementWall ? "a vertical element wall" : "a levee";
    return InputError{ErrorCode::duplicate_point, names.point_where(b),
                      text(names.point(a), " and ", names.point(b), " are both at (", file.points[b].x, ", ",
                           file.points[b].y, "): they are the two sides of ", what, " (", name->second,
                           "); expected distinct points: move the sides apart, as those of a levee of type 24, or make "
                           "each pair one node and leave the boundary out")};
  }
  return std::nullopt;
}

/// Degrees from the western to the eastern end of points.
template <class Points>
double width_in_degrees(const MeshFile& file, const Points& points) {
  const auto x = [&](std::int32_t p) { return file.points[static_cast<std::size_t>(p)].x; };
  const auto [west, east] =
      std::minmax_element(points.begin(), points.end(), [&](auto a, auto b) { return x(a) < x(b); });
  return x(*east) - x(*west);
}

/// Triangles over more than half of a mesh that does not go around the globe join its ends, but for meshes of a few.
std::string cyclic_in_longitude(const MeshFile& file) {
  constexpr double kAround = 270;     // degrees: with wide triangles a mesh around the globe may look as narrow
  constexpr std::size_t kFewest = 4;  // times as many triangles as those that join
  const auto [west, east] =
      std::minmax_element(file.points.begin(), file.points.end(), [](Vec2 p, Vec2 q) { return p.x < q.x; });
  const double width = east->x - west->x;
  if (width >= kAround) return {};
  const auto n =
      static_cast<std::size_t>(std::count_if(file.triangles.begin(), file.triangles.end(), [&](const auto& triangle) {
        return width_in_degrees(file, triangle) > width / 2;
      }));
  if (n == 0 || kFewest * n > file.triangles.size()) return {};
  return text("; ", n, n == 1 ? " triangle joins" : " triangles join", " the ends of the mesh in longitude, ", width,
              " degrees apart: it is cyclic, and on the sphere these ends do not meet. temper has such a mesh as a "
              "periodic plane, of MPAS, VTU or VTKHDF files");
}

}  // namespace

InputError with_known_cause(InputError error, const MeshFile& file, const InputNames& names) {
  if (!numbers_are_right(file)) return error;
  if (error.code == ErrorCode::duplicate_point) {
    if (auto sides = sides_at_one_place(file, names)) return *std::move(sides);
  }
  if (file.format == "fesom") error.message += cyclic_in_longitude(file);
  return error;
}

}  // namespace temper::io
