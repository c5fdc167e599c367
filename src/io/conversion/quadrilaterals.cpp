#include "io/conversion/quadrilaterals.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "io/text/values.hpp"
#include "temper/detail/vec.hpp"

namespace temper::io {
namespace {

/// Says whether bd cuts a quadrilateral into better triangles: the lesser area counts. ac is taken if they are alike.
bool is_better_cut(const std::array<Vec3, 4>& p) {
  const auto [a, b, c, d] = p;
  const Vec3 normal = cross(c - a, d - b);
  const double of_ac = std::min(dot(cross(b - a, c - a), normal), dot(cross(c - a, d - a), normal)),
               of_bd = std::min(dot(cross(b - a, d - a), normal), dot(cross(c - b, d - b), normal));
  constexpr double kAlike = 1e-6;
  return of_bd > of_ac + kAlike * std::abs(of_ac);
}

RunLength gathered(const RunLength& numbers, const RunLength& from) {
  RunLength result;
  for (std::size_t i = 0; i < from.size() && !numbers.empty(); ++i)
    result.push_back(numbers[from[static_cast<std::int64_t>(i)]]);
  return result;
}

}  // namespace

void gather_faces(MeshFile& file, const RunLength& from) {
  static_cast<void>(take(file.triangles.data, kQuadrilateral));
  if (!file.triangles.tags.empty())
    file.triangles.tags = std::get<std::vector<std::int32_t>>(gather(file.triangles.tags, 1, from));
  for (DataArray& a : file.triangles.data) a.values = gather(a.values, a.components, from);
}

void cut_quadrilaterals(MeshFile& file, FileNames& names, const std::vector<std::int32_t>& fourth_corners,
                        const std::vector<double>& heights) {
  if (fourth_corners.empty()) return;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> numbers;
  RunLength faces;
  const auto add = [&](std::size_t face, const std::array<std::int32_t, 3>& corners, std::int32_t number) {
    triangles.push_back(corners);
    numbers.push_back(number);
    faces.push_back(static_cast<std::int64_t>(face));
  };
  const auto place = [&](std::int32_t corner, std::int32_t near) {
    const auto i = static_cast<std::size_t>(corner);
    Vec2 p = file.points[i];
    if (file.degrees() != nullptr) p.x -= 360 * std::round((p.x - file.points[static_cast<std::size_t>(near)].x) / 360);
    return Vec3{p.x, p.y, heights.empty() ? 0 : heights[i]};
  };
  std::int32_t n = 0;
  for (std::size_t f = 0; f < file.triangles.size(); ++f) {
    const std::array corners = corners_of_face(file.triangles[f], fourth_corners, f);
    // Some formats write a triangle as a quadrilateral with one corner twice, and so does corners_of_face().
    std::size_t k = 0;
    while (k < 4 && corners[k] != corners[(k + 3) % 4]) ++k;
    if (k < 4) {
      add(f, {corners[k], corners[(k + 1) % 4], corners[(k + 2) % 4]}, 0);
      continue;
    }
    const auto [a, b, c, d] = corners;
    const bool by_bd = is_better_cut({place(a, a), place(b, a), place(c, a), place(d, a)});
    add(f, by_bd ? std::array{a, b, d} : std::array{a, b, c}, ++n);
    add(f, by_bd ? std::array{b, c, d} : std::array{a, c, d}, n);
  }
  file.triangles.corners = std::move(triangles);
  gather_faces(file, faces);
  if (n > 0) file.triangles.data.push_back({std::string(kQuadrilateral), 1, std::move(numbers)});
  names.triangles = gathered(names.triangles, faces);
  names.triangle_lines = gathered(names.triangle_lines, faces);
}

std::vector<Halves> quadrilaterals_of(const MeshFile& file) {
  const DataArray* const data = find(file.triangles.data, kQuadrilateral);
  const auto numbers = data == nullptr || data->components != 1 ? std::nullopt : to_int32(data->values);
  if (!numbers || numbers->size() != file.triangles.size()) return {};
  std::map<std::int32_t, std::vector<std::size_t>> of_number;
  for (std::size_t t = 0; t < numbers->size(); ++t) {
    if ((*numbers)[t] > 0) of_number[(*numbers)[t]].push_back(t);
  }
  std::vector<Halves> all;
  for (const auto& [number, triangles] : of_number) {
    if (triangles.size() != 2) continue;
    const auto &t = file.triangles[triangles[0]], &u = file.triangles[triangles[1]];
    const auto alone = [](const auto& of, const auto& other) {
      std::vector<std::size_t> corners;
      for (std::size_t k = 0; k < 3; ++k) {
        if (std::ranges::find(other, of[k]) == other.end()) corners.push_back(k);
      }
      return corners;
    };
    const auto first = alone(t, u), second = alone(u, t);
    if (first.size() == 1 && second.size() == 1) all.push_back({triangles[0], triangles[1], first[0], u[second[0]]});
  }
  std::ranges::sort(all, {}, &Halves::triangle);
  return all;
}

std::vector<std::int32_t> join_quadrilaterals(MeshFile& file, const std::vector<Halves>& quadrilaterals) {
  std::vector<bool> is_half(file.triangles.size());
  for (const Halves& q : quadrilaterals) is_half[q.triangle] = is_half[q.other] = true;
  std::vector<std::array<std::int32_t, 3>> faces;
  std::vector<std::int32_t> fourth_corners;
  RunLength from;
  for (std::size_t t = 0; t < file.triangles.size(); ++t) {
    if (is_half[t]) continue;
    faces.push_back(file.triangles[t]);
    from.push_back(static_cast<std::int64_t>(t));
  }
  for (const Halves& q : quadrilaterals) {
    const auto& t = file.triangles[q.triangle];
    faces.push_back({t[(q.k + 2) % 3], t[q.k], t[(q.k + 1) % 3]});  // the fourth corner is between the ends
    from.push_back(static_cast<std::int64_t>(q.triangle));
    fourth_corners.push_back(q.fourth);
  }
  file.triangles.corners = std::move(faces);
  gather_faces(file, from);
  return fourth_corners;
}

}  // namespace temper::io
