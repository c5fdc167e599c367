// Lines as faces of power cells. The judge measures with its own formulas: which duals of the mesh lie on the lines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "outlines.hpp"
#include "temper/detail/criterion.hpp"
#include "temper/mesher.hpp"
#include "temper/optimize.hpp"

namespace temper::test {
namespace {

constexpr std::int32_t kFault = 7, kRiver = 9;

Outline plate() { return loop({{0, 0}, {10, 0}, {10, 6}, {0, 6}}, 1); }

void add_faces(Outline& o, const std::vector<Vec2>& points, bool closed = false, std::int32_t tag = kFault) {
  const std::size_t first = o.segments.size();
  add_line(o, points, closed, tag);
  for (std::size_t i = first; i < o.segments.size(); ++i) o.segments[i].as = LineKind::faces;
}

Outline with_faces(const std::vector<std::vector<Vec2>>& lines, bool closed = false) {
  Outline o = plate();
  for (const auto& line : lines) add_faces(o, line, closed);
  return o;
}

/// Two lines that cross in the middle.
Outline crossing(double degrees) {
  const double t = degrees * std::numbers::pi / 180;
  const Vec2 u = {2 * std::cos(t), 2 * std::sin(t)}, c = {5.02, 3.01};
  return with_faces({{c - Vec2{2.5, 0}, c + Vec2{2.3, 0}}, {c - u, c + 1.1 * u}});
}

Outline border() {
  Outline o = loop({{0, 0}, {4, 0}, {10, 0}, {10, 6}, {5, 6}, {0, 6}}, 1);
  o.points.push_back({5.5, 3});
  for (const auto& ends : {std::array{1, 6}, std::array{6, 4}})
    o.segments.push_back({{ends[0], ends[1]}, kFault, LineKind::faces});
  o.regions = {{{1, 3}, 10, {}}, {{9, 3}, 20, {}}};
  return o;
}

/// A river that stays edges, and a fault through it.
Outline river(double degrees) {
  Outline o = plate();
  add_line(o, {{0.7, 2.9}, {9.2, 3.1}}, false, kRiver);
  const double t = degrees * std::numbers::pi / 180;
  const Vec2 u = {1.7 * std::cos(t), 1.7 * std::sin(t)}, c = {5, 3};
  add_faces(o, {c - u, c + u});
  return o;
}

/// A river with a bend, and a fault through it.
Outline bend(const std::vector<Vec2>& fault) {
  Outline o = plate();
  add_line(o, {{1, 2}, {5, 3}, {8, 1}}, false, kRiver);
  add_faces(o, fault);
  return o;
}

Outline wells() {
  Outline o = with_faces({{{2, 2}, {8, 4}}});
  o.points.insert(o.points.end(), {{4, 3.1}, {6.1, 3}});
  return o;
}

std::vector<NamedOutline> networks() {
  std::vector<NamedOutline> all = {
      {"straight", with_faces({{{2, 2}, {8, 4}}})},
      {"one kink", with_faces({{{1, 1}, {5, 2}, {8, 5}}})},
      {"sharp kinks", with_faces({{{2, 1}, {7, 1.7}, {3, 3}, {7.5, 4.6}}})},
      {"curve", with_faces({ring({5, 3}, 2, 40)})},
      {"loop", with_faces({ring({5, 3}, 1.8, 5)}, true)},
      {"round loop", with_faces({ring({5, 3}, 2, 30)}, true)},
      {"junction", with_faces({{{2, 3}, {5, 3}, {8, 5}}, {{5, 3}, {7, 1}}})},
      {"star",
       with_faces({{{5, 3}, {8, 3}}, {{5, 3}, {5.5, 5}}, {{5, 3}, {3, 4.5}}, {{5, 3}, {2.5, 2}}, {{5, 3}, {6, 1}}})},
      {"beside each other", with_faces({{{2, 2}, {8, 2}}, {{2.1, 2.2}, {7.9, 2.3}}})},
      {"tip at a line", with_faces({{{2, 2}, {8, 2}}, {{5, 2.1}, {5.3, 4}}})},
      {"tip between two pieces",
       with_faces({{{2.86, 4.15}, {3.48, 2.63}, {3.21, 1.06}}, {{1.75, 3.87}, {2.97, 2.51}}})},
      {"small angles",
       with_faces(
           {{{3.18, 1.32}, {4.02, 3.07}}, {{3.45, 1.3}, {3.93, 3.88}}, {{0.5, 3.41}, {2.84, 1.73}, {3.68, 0.7}}})},
      {"through the domain", with_faces({{{4, 0}, {5, 6}}})},
      {"low on the boundary", with_faces({{{2, 0}, {7, 2}}})},
      {"border", border()},
      {"wells", wells()},
      {"on a bend of a river", bend({{5, 3}, {5, 5}})},
      {"inside a bend of a river", bend({{5, 3}, {5, 1}})},
      {"through a bend of a river", bend({{4.5, 1}, {5, 3}, {6, 5}})},
      {"river across", river(70)},
      {"river at 25 degrees", river(25)}};
  for (const double degrees : {90.0, 60.0, 40.0, 25.0, 15.0})
    all.push_back({"crossing at " + std::to_string(static_cast<int>(degrees)), crossing(degrees)});
  return all;
}

MesherOptions options_for_faces(double size = 0.4) {
  MesherOptions options;
  options.size = size;
  options.split_crossings = true;
  options.enclosed = Enclosed::all;  // a loop of faces is no lake
  options.optimize->scheme = Scheme::vertex;
  return options;
}

OutlineMesh meshed(const Outline& outline, const MesherOptions& options = options_for_faces()) {
  Expected<OutlineMesh> made = mesh_outline(outline, options);
  EXPECT_TRUE(made.has_value()) << made.error().what();
  return made ? *std::move(made) : OutlineMesh();
}

Vec2 orthocenter_of(const Mesh& mesh, TriangleId t) {
  const auto [a, b, c] = mesh.points(t);
  return orthocenter(a, b, c);
}

/// The length of all segments that become faces.
double length_of_faces(const Outline& o) {
  double sum = 0;
  for (const OutlineSegment& s : o.segments) {
    if (s.as != LineKind::faces) continue;
    sum += length(o.points[static_cast<std::size_t>(s.ends[1])] - o.points[static_cast<std::size_t>(s.ends[0])]);
  }
  return sum;
}

/// The length of the duals that lie on one of these segments.
double length_on_faces(const Outline& o, const Mesh& mesh) {
  constexpr double kNear = 1e-10;
  double sum = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_edge_representative(h) || mesh.is_boundary(h)) continue;
    const Vec2 p = orthocenter_of(mesh, Mesh::triangle(h)), q = orthocenter_of(mesh, Mesh::triangle(mesh.twin(h)));
    const auto contains = [&](const OutlineSegment& s) {
      const Vec2 a = o.points[static_cast<std::size_t>(s.ends[0])], b = o.points[static_cast<std::size_t>(s.ends[1])];
      const double whole = length(b - a);
      const auto is_on = [&](Vec2 x) {
        const double along = dot(x - a, b - a) / whole, across = cross(b - a, x - a) / whole;
        return std::abs(across) < kNear && along > -kNear && along < whole + kNear;
      };
      return s.as == LineKind::faces && is_on(p) && is_on(q);
    };
    if (std::ranges::any_of(o.segments, contains)) sum += length(q - p);
  }
  return sum;
}

void expect_faces(const std::string& name, const Outline& outline, const Mesh& mesh) {
  EXPECT_NEAR(length_on_faces(outline, mesh) / length_of_faces(outline), 1, 1e-9) << name;
  EXPECT_EQ(violated_edges(mesh, Criterion::coefficients).size(), 0U) << name;
  EXPECT_EQ(mesh.validate(), std::nullopt) << name;
}

TEST(Faces, LieOnTheirLinesAndNoCoefficientIsNegative) {
  for (const auto& [name, outline] : networks()) {
    const OutlineMesh made = meshed(outline);
    expect_faces(name, outline, made.mesh);
    EXPECT_EQ(made.attempts, 1) << name;
    EXPECT_LT(made.report.sweeps, OptimizeOptions().max_sweeps) << name << ": sites that stay need no more restarts";
    double whole = 0;
    for (const MeshLine& line : made.lines) {
      const HalfedgeId h = made.mesh.find_halfedge(line.a, line.b);
      if (line.tag != kFault) continue;
      ASSERT_TRUE(h.valid()) << name;
      EXPECT_TRUE(made.mesh.is_face(h)) << name;
      whole += length(orthocenter_of(made.mesh, Mesh::triangle(h)) -
                      orthocenter_of(made.mesh, Mesh::triangle(made.mesh.twin(h))));
    }
    EXPECT_NEAR(whole / length_of_faces(outline), 1, 1e-9) << name << ": the lines of the mesh are its faces";
  }
}

TEST(Faces, StayWhenTheMeshIsOptimizedAgain) {
  for (const auto& [name, outline] : {NamedOutline{"crossing", crossing(25)}, NamedOutline{"border", border()}}) {
    const OutlineMesh made = meshed(outline);
    for (const Scheme scheme : {Scheme::vertex, Scheme::all}) {
      Mesh mesh = made.mesh;
      OptimizeOptions options;
      options.scheme = scheme;
      options.repair = Repair::vertices;
      options.boundary = BoundaryVertices::split;
      const Expected<OptimizeReport> report = optimize(mesh, options);
      ASSERT_TRUE(report.has_value()) << name << report.error().what();
      EXPECT_NEAR(length_on_faces(outline, mesh) / length_of_faces(outline), 1, 1e-9) << name;
    }
  }
}

TEST(Faces, OfABorderLeaveEachCellInOneRegion) {
  const OutlineMesh made = meshed(border());
  const Mesh& mesh = made.mesh;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_face(h)) continue;
    // On each side of a face the triangles that have none belong to one region.
    for (const VertexId v : {mesh.origin(h), mesh.target(h)}) {
      std::set<std::int32_t> regions;
      for (const HalfedgeId out : mesh.star(v)) {
        if (!mesh.is_half(Mesh::triangle(out))) regions.insert(mesh.region(Mesh::triangle(out)));
      }
      EXPECT_LE(regions.size(), 1U);
    }
  }
}

/// Grids of power cells need each face between its two centers.
TEST(Faces, LeaveSitesInTheirOwnCells) {
  for (const auto& [name, outline] : networks()) {
    const OutlineMesh made = meshed(outline);
    const Mesh& mesh = made.mesh;
    int edges = 0;
    for (const HalfedgeId h : mesh.halfedges()) {
      const VertexId a = mesh.origin(h), b = mesh.target(h);
      if (mesh.is_boundary(h) || !mesh.is_frozen(a) || mesh.is_diagonal(h)) continue;
      ++edges;
      EXPECT_LT(std::abs(mesh.weight(a) - mesh.weight(b)), squared_length(mesh.position(b) - mesh.position(a))) << name;
    }
    EXPECT_GT(edges, 0) << name;
  }
}

TEST(Faces, AreTheSameForAnyNumberOfRuns) {
  const Outline outline = crossing(25);
  EXPECT_EQ(meshed(outline).mesh, meshed(outline).mesh);
}

TEST(Faces, KeepVerticesOutOfTheirCircles) {
  for (const auto& [name, outline] : {NamedOutline{"wells", wells()}, NamedOutline{"crossing", crossing(15)}}) {
    const Mesh mesh = meshed(outline).mesh;
    for (const HalfedgeId h : mesh.halfedges()) {
      if (!mesh.is_face(h)) continue;
      const auto corners = mesh.corners(Mesh::triangle(h));
      const Vec2 q = orthocenter_of(mesh, Mesh::triangle(h));
      const auto power = [&](VertexId v) { return squared_length(mesh.position(v) - q) - mesh.weight(v); };
      const double least = power(corners[0]);
      for (const VertexId v : mesh.vertices()) EXPECT_GT(power(v), least - 1e-9) << name;
    }
  }
}

void expect_refusal(const Outline& outline, const std::string& part, MesherOptions options = options_for_faces()) {
  const Expected<OutlineMesh> made = mesh_outline(outline, options);
  ASSERT_FALSE(made.has_value()) << "expected: " << part;
  EXPECT_NE(std::string(made.error().what()).find(part), std::string::npos) << made.error().what();
}

TEST(Faces, ThatCannotBeMadeAreRefusedWithPlaceAndReason) {
  Outline well = with_faces({{{2, 2}, {8, 2}}});
  well.points.push_back({4, 2});
  expect_refusal(well, "at (4, 2)");
  expect_refusal(with_faces({{{0, 0}, {5, 3}}}), "corner of the boundary");
  Outline bend = border();
  bend.points.push_back({8, 3});
  for (OutlineSegment& s : bend.segments) s.as = LineKind::edges;
  bend.segments.push_back({{6, 7}, kRiver, LineKind::faces});
  expect_refusal(bend, "where that bends");
  expect_refusal(with_faces({{{2, 2}, {8, 2}}, {{2, 2}, {7, 2.01}}}), "at an angle of 0.11 degrees");
  MesherOptions few = options_for_faces();
  few.points = MeshPoints::few;
  expect_refusal(crossing(60), "few points", few);
}

TEST(Faces, ByNameAreFacesOfAllSegmentsWithIt) {
  Outline o = plate();
  add_line(o, {{2, 2}, {4, 2}, {6, 3}}, false, kFault);
  o.groups = {{1, kFault, "fault"}};
  Outline by_tag = o;
  ASSERT_TRUE(become_faces(o, std::vector<std::string>{"fault"}).has_value());
  ASSERT_TRUE(become_faces(by_tag, std::vector<std::string>{"7"}).has_value());
  EXPECT_DOUBLE_EQ(length_of_faces(o), 2 + std::sqrt(5.0));
  EXPECT_DOUBLE_EQ(length_of_faces(by_tag), length_of_faces(o));
  const auto unknown = become_faces(o, std::vector<std::string>{"wall"});
  ASSERT_FALSE(unknown.has_value());
  EXPECT_NE(std::string(unknown.error().what()).find("'fault'"), std::string::npos) << unknown.error().what();
}

TEST(Faces, OnTheBoundaryStayEdges) {
  Outline o = plate();
  for (OutlineSegment& s : o.segments) s.as = LineKind::faces;
  Outline plain = plate();
  EXPECT_EQ(meshed(o).mesh, meshed(plain).mesh);
}

}  // namespace
}  // namespace temper::test
