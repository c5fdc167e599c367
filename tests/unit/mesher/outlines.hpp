// Outlines for tests: small ones by hand, of every class that has once been hard, and what must hold of any mesh.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "temper/detail/geometry.hpp"
#include "temper/mesher.hpp"

namespace temper::test {

inline void add_line(Outline& o, const std::vector<Vec2>& points, bool closed, std::int32_t tag = 0) {
  const auto first = static_cast<std::int32_t>(o.points.size()), n = static_cast<std::int32_t>(points.size());
  o.points.insert(o.points.end(), points.begin(), points.end());
  for (std::int32_t i = 0; i + (closed ? 0 : 1) < n; ++i) o.segments.push_back({{first + i, first + (i + 1) % n}, tag});
}

inline Outline loop(const std::vector<Vec2>& points, std::int32_t tag = 0) {
  Outline o;
  add_line(o, points, true, tag);
  return o;
}

inline std::vector<Vec2> ring(Vec2 center, double radius, int n) {
  std::vector<Vec2> points;
  for (int i = 0; i < n; ++i) {
    const double t = 2 * std::numbers::pi * i / n;
    points.push_back({center.x + radius * std::cos(t), center.y + radius * std::sin(t)});
  }
  return points;
}

inline Outline square() { return loop({{0, 0}, {1, 0}, {1, 1}, {0, 1}}); }

inline Outline wedge(double degrees) {
  const double t = degrees * std::numbers::pi / 180;
  return loop({{0, 0}, {1, 0}, {std::cos(t), std::sin(t)}});
}

inline Outline star(int n, double inner) {
  std::vector<Vec2> points;
  for (int i = 0; i < 2 * n; ++i) {
    const double t = std::numbers::pi * i / n + 0.1, r = i % 2 == 0 ? 1 : inner;
    points.push_back({r * std::cos(t), r * std::sin(t)});
  }
  return loop(points);
}

inline Outline comb() {
  std::vector<Vec2> points = {{0, -0.5}, {5, -0.5}};
  for (int i = 4; i >= 0; --i) {
    const double width = 0.08 + 0.08 * i;
    points.insert(points.end(),
                  {{i + 0.5 + width, 0}, {i + 0.5 + width / 3, 1.5}, {i + 0.5 - width / 3, 1.4}, {i + 0.5 - width, 0}});
  }
  return loop(points);
}

/// A plate with round holes, one of them near another.
inline Outline holes() {
  Outline o = loop({{0, 0}, {3, 0}, {3, 2}, {0, 2}});
  add_line(o, ring({0.8, 1}, 0.5, 16), true);
  add_line(o, ring({1.7, 1}, 0.35, 5), true);
  add_line(o, ring({2.6, 0.4}, 0.2, 3), true);
  return o;
}

/// Lines that end inside, one that starts on the boundary, and one that branches.
inline Outline slits() {
  Outline o = loop({{0, 0}, {2, 0}, {2, 1}, {0, 1}}, 1);
  add_line(o, {{0, 0.4}, {0.7, 0.55}}, false, 7);
  add_line(o, {{1.2, 0.8}, {1.5, 0.5}, {1.3, 0.2}}, false, 8);
  o.points.push_back({1.8, 0.6});
  o.segments.push_back({{7, 9}, 8});
  return o;
}

inline Outline two_regions() {
  Outline o = loop({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}}, 1);
  o.points.insert(o.points.end(), {{1.2, 0.3}, {0.8, 0.7}});
  for (const auto& ends : {std::array{1, 6}, std::array{6, 7}, std::array{7, 4}})
    o.segments.push_back({{ends[0], ends[1]}, 5});
  o.regions = {{{0.1, 0.5}, 10, {}}, {{1.9, 0.5}, 20, 0.04}};
  return o;
}

inline Outline island_in_lake() {
  Outline o = loop(ring({0, 0}, 1, 40));
  add_line(o, ring({0.1, 0.1}, 0.7, 30), true);
  add_line(o, ring({0.1, 0.2}, 0.4, 11), true);
  return o;
}

struct NamedOutline {
  std::string name;
  Outline outline;
};
inline std::vector<NamedOutline> outlines() {
  return {{"square", square()},
          {"wedge of 5 degrees", wedge(5)},
          {"wedge of 59 degrees", wedge(59)},
          {"star", star(7, 0.25)},
          {"comb", comb()},
          {"holes", holes()},
          {"slits", slits()},
          {"two regions", two_regions()},
          {"island in a lake", island_in_lake()},
          {"spike", loop({{0, 0}, {1, 0}, {1, 1}, {0.51, 1}, {0.5, 0.3}, {0.46, 1}, {0, 1}})},
          {"short edge", loop({{0, 0}, {0.5, 0}, {0.501, 0}, {1, 0}, {1, 1}, {0, 1}})},
          {"strip", loop({{0, 0}, {1, 0}, {1, 0.02}, {0, 0.03}})}};
}

inline double extent(const Outline& o) {
  Vec2 low = o.points[0], high = low;
  for (const Vec2 p : o.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return length(high - low);
}

inline double mesh_area(const Mesh& mesh) {
  double doubled = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    doubled += doubled_area(mesh.position(a), mesh.position(b), mesh.position(c));
  }
  return 0.5 * doubled;
}

inline std::size_t count_bad(const Mesh& mesh) {
  std::size_t bad = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    if (!is_well_centered(mesh.space(), mesh.point(a), mesh.point(b), mesh.point(c))) ++bad;
  }
  return bad;
}

/// Valid, all points where they were, every segment a chain of lines, and the boundary made of lines alone.
inline void expect_kept(const Outline& o, const OutlineMesh& made) {
  const Mesh& mesh = made.mesh;
  EXPECT_EQ(mesh.validate(), std::nullopt);
  ASSERT_EQ(made.vertex_of_point.size(), o.points.size());
  for (std::size_t i = 0; i < o.points.size(); ++i) {
    ASSERT_TRUE(made.vertex_of_point[i].valid()) << "point " << i;
    EXPECT_EQ(mesh.position(made.vertex_of_point[i]), o.points[i]) << "point " << i;
  }
  double lines = 0, segments = 0;
  std::size_t on_boundary = 0, boundary = 0;
  for (const MeshLine& line : made.lines) {
    HalfedgeId h = mesh.find_halfedge(line.a, line.b);
    if (!h.valid()) h = mesh.find_halfedge(line.b, line.a);
    ASSERT_TRUE(h.valid()) << line.a.index << "-" << line.b.index << " is no edge";
    EXPECT_TRUE(mesh.is_boundary(h) || mesh.is_constrained(h));
    on_boundary += mesh.is_boundary(h) ? 1 : 0;
    lines += length(mesh.position(line.b) - mesh.position(line.a));
  }
  for (const HalfedgeId h : mesh.halfedges()) boundary += mesh.is_boundary(h) ? 1 : 0;
  for (const OutlineSegment& s : o.segments) {
    segments += length(o.points[static_cast<std::size_t>(s.ends[1])] - o.points[static_cast<std::size_t>(s.ends[0])]);
  }
  EXPECT_GT(boundary, 0u);
  EXPECT_EQ(on_boundary, boundary);
  EXPECT_NEAR(lines, segments, 1e-12 * segments);
}

inline MesherOptions of_size(double size) {
  MesherOptions options;
  options.size = size;
  return options;
}

}  // namespace temper::test
