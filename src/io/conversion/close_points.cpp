// Points that are nearly at one place: cracks in a mesh, and their cure.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "io/conversion/follow.hpp"
#include "io/text/failure.hpp"
#include "temper/detail/file_cures.hpp"

namespace temper::io {
namespace {

std::vector<Vec3> places_of(const MeshFile& file) {
  if (const SpherePoints* sphere = file.sphere()) return sphere->places;
  const SpacePoints* const space = file.in_space();
  std::vector<Vec3> places;
  places.reserve(file.points.size());
  for (std::size_t i = 0; i < file.points.size(); ++i)
    places.push_back({file.points[i].x, file.points[i].y, space != nullptr ? space->heights[i] : 0});
  return places;
}

/// Sorts by a direction in which rows of grids do not coincide.
std::vector<std::pair<std::size_t, std::size_t>> pairs_within(std::span<const Vec3> points, double radius) {
  constexpr Vec3 kDirection = {0.3717, 0.5573, 0.7425};  // shorter than 1
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < points.size(); ++i) order.emplace_back(dot(kDirection, points[i]), i);
  std::sort(order.begin(), order.end());
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = i + 1; j < order.size() && order[j].first - order[i].first <= radius; ++j) {
      const std::pair<std::size_t, std::size_t> pair = std::minmax(order[i].second, order[j].second);
      if (length(points[pair.second] - points[pair.first]) <= radius) pairs.push_back(pair);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// New numbers of the points of a file, after those within the radius are one.
struct MergedPoints {
  std::vector<std::size_t> first;  // the points that stay
  std::vector<std::int32_t> number;
  std::size_t gone = 0;

  MergedPoints(const std::string& path, std::span<const Vec3> places, double radius) : number(places.size()) {
    if (!(radius >= 0)) fail(ErrorCode::invalid_option, path, "expected a radius of at least 0, found ", radius);
    std::vector<std::size_t> same(places.size());  // an earlier point at the same place
    std::iota(same.begin(), same.end(), std::size_t{0});
    const auto root = [&](std::size_t i) {
      while (same[i] != i) i = same[i] = same[same[i]];
      return i;
    };
    for (const auto& [i, j] : pairs_within(places, radius)) {
      const auto [less, more] = std::minmax({root(i), root(j)});
      same[more] = less;
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
      const bool stays = root(i) == i;
      number[i] = stays ? static_cast<std::int32_t>(first.size()) : number[root(i)];
      if (stays) first.push_back(i);
    }
    gone = places.size() - first.size();
  }

  /// A number out of range stays: making the mesh refuses it.
  void renumber(std::int32_t& point) const {
    if (point >= 0 && static_cast<std::size_t>(point) < number.size()) point = number[static_cast<std::size_t>(point)];
  }
  void renumber(auto& cell) const {
    for (std::int32_t& point : cell) renumber(point);
  }
  /// Refuses cells of which two corners would become one. `name`: of cell number i.
  template <int dimension, class Name>
  void expect_corners(const Cells<dimension>& cells, const std::string& path, double radius, const Name& name) const {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      auto corners = cells[i];
      renumber(corners);
      std::ranges::sort(corners);
      if (std::ranges::adjacent_find(corners) == corners.end()) continue;
      fail(ErrorCode::zero_area, path, "--merge ", radius, " makes two corners of ", name(i),
           " one; expected less than its edges");
    }
  }
  void apply(MeshFile& file) const {
    std::apply([&](auto&... cells) { (std::ranges::for_each(cells, [&](auto& cell) { renumber(cell); }), ...); },
               file.cells());
    file.points = at(file.points, first);
    if (auto* sphere = std::get_if<SpherePoints>(&file.points_in)) sphere->places = at(sphere->places, first);
    if (auto* space = std::get_if<SpacePoints>(&file.points_in)) space->heights = at(space->heights, first);
    if (!file.weights.empty()) file.weights = at(file.weights, first);
    take_rows(file.point_data, first);
    file.numbering = nullptr;  // points have other numbers now
  }
};

/// Drops the triangles with two corners at exactly one place, which merging makes one.
void drop_without_area(MeshFile& file) {
  const std::vector<Vec3> places = places_of(file);
  const auto is_point = [&](std::int32_t p) { return p >= 0 && static_cast<std::size_t>(p) < places.size(); };
  const auto at = [&](std::int32_t p) { return places[static_cast<std::size_t>(p)]; };
  std::vector<bool> stays;
  for (const auto& [a, b, c] : file.triangles) {
    const bool known = is_point(a) && is_point(b) && is_point(c);
    stays.push_back(!known || (at(a) != at(b) && at(b) != at(c) && at(c) != at(a)));
  }
  const auto gone = std::ranges::count(stays, false);
  if (gone == 0) return;
  file.warnings.push_back(text(file.path, ": ", gone, gone == 1 ? " triangle is" : " triangles are",
                               " dropped: two corners are at one place"));
  keep_triangles(file, stays);
}

}  // namespace

Expected<std::size_t> merge_points(MeshFile& file, double radius) {
  return guarded<std::size_t>(file.path, [&] {
    const MergedPoints merged(file.path, places_of(file), radius);
    if (merged.gone == 0) return merged.gone;
    if (file.dimension() == 2) {
      drop_without_area(file);
      merged.expect_corners(file.triangles, file.path, radius, [&](std::size_t t) {
        return file.numbering ? file.numbering->triangle(t) : InputNames().triangle(t);
      });
    }
    merged.expect_corners(file.tetrahedra, file.path, radius, [&](std::size_t t) {
      return file.numbering ? file.numbering->tetrahedron(t) : tets::InputNames().tetrahedron(t);
    });
    merged.apply(file);
    return merged.gone;
  });
}

Crack find_crack(const Mesh& mesh) {
  constexpr double kCrack = 1e-6;  // part of the boundary edges at a crack that is wider
  std::vector<VertexId> vertices;
  std::vector<Vec3> places;
  std::vector<double> widths;  // below which a crack is meant
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_boundary(h)) continue;
    const VertexId v = mesh.origin(h);
    const WeightedPoint p = mesh.point(v), q = mesh.point(mesh.target(h), p);
    vertices.push_back(v);
    places.push_back(mesh.space().place(p));
    widths.push_back(kCrack * length(mesh.space().place(q) - places.back()));
  }
  Crack crack;
  if (widths.empty()) return crack;
  for (const auto& [i, j] : pairs_within(places, *std::max_element(widths.begin(), widths.end()))) {
    const double width = length(places[j] - places[i]);
    if (vertices[i] == vertices[j] || width > std::min(widths[i], widths[j])) continue;
    if (crack.pairs++ == 0) crack.first = {vertices[i], vertices[j]};
    crack.widest = std::max(crack.widest, width);
  }
  return crack;
}

}  // namespace temper::io
