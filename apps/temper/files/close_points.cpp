#include "files/close_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <variant>

#include "console.hpp"
#include "exit.hpp"
#include "files/flat_triangles.hpp"

namespace temper::app {
namespace {

// A crack is narrower than this part of the boundary edges at it.
constexpr double kCrack = 1e-6;

std::vector<Vec3> places_of(const io::MeshFile& file) {
  if (const io::SpherePoints* sphere = file.sphere()) return sphere->places;
  const io::SpacePoints* const space = file.in_space();
  std::vector<Vec3> places;
  places.reserve(file.points.size());
  for (std::size_t i = 0; i < file.points.size(); ++i)
    places.push_back({file.points[i].x, file.points[i].y, space != nullptr ? space->heights[i] : 0});
  return places;
}

/// Keeps the tuples whose points stay.
template <class T>
void keep(std::vector<T>& values, const std::vector<bool>& stays, std::size_t components = 1) {
  std::size_t to = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (stays[i / components]) values[to++] = values[i];
  }
  values.resize(to);
}

}  // namespace

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

std::string crack_warning(const Input& input) {
  const Mesh& mesh = input.mesh();
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
  if (widths.empty()) return {};
  std::size_t n = 0;
  double widest = 0;
  std::pair<std::size_t, std::size_t> first;
  for (const auto& [i, j] : pairs_within(places, *std::max_element(widths.begin(), widths.end()))) {
    const double width = length(places[j] - places[i]);
    if (vertices[i] == vertices[j] || width > std::min(widths[i], widths[j])) continue;
    if (n++ == 0) first = {i, j};
    widest = std::max(widest, width);
  }
  if (n == 0) return {};
  const Vec2 at = mesh.space().as_shown(places[first.first]);
  const std::string radius = widest > 0 ? fmt::format("{:.0e}", 10 * widest) : "0";
  return fmt::format(
      "{}: {} nearly at one place, as if the mesh had a crack: first {} and {} at ({:.6g}, {:.6g}); "
      "the widest is {:.3g}. Next: join them with temper convert {} --merge {} -o OUT",
      input.path, plural(n, "pair of boundary points is", "pairs of boundary points are"),
      input.names->point(vertices[first.first].index), input.names->point(vertices[first.second].index), at.x, at.y,
      widest, input.path, radius);
}

namespace {

/// New numbers of the points of a file, after those within the radius are one.
struct MergedPoints {
  std::vector<bool> stays;
  std::vector<std::int32_t> number;
  std::size_t gone = 0;

  MergedPoints(std::span<const Vec3> places, double radius) : stays(places.size()), number(places.size()) {
    std::vector<std::size_t> first(places.size());  // of the points at the same place
    std::iota(first.begin(), first.end(), std::size_t{0});
    const auto root = [&](std::size_t i) {
      while (first[i] != i) i = first[i] = first[first[i]];
      return i;
    };
    for (const auto& [i, j] : pairs_within(places, radius)) {
      const auto [less, more] = std::minmax({root(i), root(j)});
      first[more] = less;
    }
    std::int32_t n = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      stays[i] = root(i) == i;
      number[i] = stays[i] ? n++ : number[root(i)];
    }
    gone = places.size() - static_cast<std::size_t>(n);
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
  void expect_corners(const io::Cells<dimension>& cells, const std::string& path, double radius,
                      const Name& name) const {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      auto corners = cells[i];
      renumber(corners);
      std::ranges::sort(corners);
      if (std::ranges::adjacent_find(corners) == corners.end()) continue;
      throw Failure(Exit::bad_input,
                    fmt::format("{}: --merge {} makes two corners of {} one; expected less than its edges", path,
                                radius, name(i)));
    }
  }
  void apply(io::MeshFile& file) const {
    std::apply([&](auto&... cells) { (std::ranges::for_each(cells, [&](auto& cell) { renumber(cell); }), ...); },
               file.cells());
    keep(file.points, stays);
    if (auto* sphere = std::get_if<io::SpherePoints>(&file.points_in)) keep(sphere->places, stays);
    if (auto* space = std::get_if<io::SpacePoints>(&file.points_in)) keep(space->heights, stays);
    if (!file.weights.empty()) keep(file.weights, stays);
    for (io::DataArray& array : file.point_data) {
      std::visit([&](auto& values) { keep(values, stays, static_cast<std::size_t>(array.components)); }, array.values);
    }
    file.numbering = nullptr;  // points have other numbers now
  }
};

/// Drops the triangles with two corners at exactly one place, which merging makes one.
void drop_without_area(io::MeshFile& file) {
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
  file.warnings.push_back(fmt::format("{}: {} dropped: two corners are at one place", file.path,
                                      plural(static_cast<std::size_t>(gone), "triangle is", "triangles are")));
  keep_triangles(file, stays);
}

}  // namespace

std::size_t merge_points(io::MeshFile& file, double radius) {
  const MergedPoints merged(places_of(file), radius);
  if (merged.gone == 0) return 0;
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
}

}  // namespace temper::app
