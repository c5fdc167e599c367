// Meshes of the sphere, and of what coasts leave of it: what holds of every one, what the size field does, what is
// refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/rng.hpp"
#include "outlines.hpp"
#include "support/std_threads.hpp"
#include "temper/detail/projection.hpp"
#include "temper/detail/size.hpp"
#include "temper/generate.hpp"
#include "temper/regularity.hpp"

namespace temper::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kEarth = 6371000;

OutlineMesh globe_of(const SphereOutline& outline, const MesherOptions& options, const OptimizeHooks& hooks = {}) {
  Expected<OutlineMesh> made = mesh_sphere(outline, options, hooks);
  EXPECT_TRUE(made.has_value()) << made.error().what();
  return made ? *std::move(made) : OutlineMesh();
}

MesherOptions globe_sized(double size) {
  MesherOptions options;
  options.size = size;
  return options;
}

/// Places around a center, at a distance that goes in and out by a part of it [degrees].
std::vector<Vec2> blob(Vec2 center, double radius, int n, double wobble = 0.2) {
  const Vec3 up = direction_of(center), east = direction_of({center.x + 90, 0}), north = cross(up, east);
  std::vector<Vec2> places;
  for (int i = 0; i < n; ++i) {
    const double t = 2 * kPi * i / n, d = radius * (1 + wobble * std::sin(3 * t)) * kPi / 180;
    places.push_back(lon_lat_of(std::cos(d) * up + std::sin(d) * (std::cos(t) * east + std::sin(t) * north)));
  }
  return places;
}

/// As a part of the sphere: of the triangles, and of a loop around the place.
double area_of(const Mesh& mesh) {
  double sum = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    sum += solid_angle(mesh.weighted_vector(a), mesh.weighted_vector(b), mesh.weighted_vector(c));
  }
  return sum / (4 * kPi);
}
double area_of(const std::vector<Vec2>& loop, Vec2 place) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    sum += solid_angle(direction_of(place), direction_of(loop[i]), direction_of(loop[(i + 1) % loop.size()]));
  }
  return std::abs(sum) / (4 * kPi);
}

int euler(const Mesh& mesh) {
  return static_cast<int>(mesh.n_vertices()) - static_cast<int>(mesh.n_edges()) + static_cast<int>(mesh.n_triangles());
}

void expect_good(const OutlineMesh& made, double size) {
  EXPECT_EQ(made.bad, 0u);
  EXPECT_EQ(count_bad(made.mesh), 0u);
  EXPECT_FALSE(made.mesh.validate());
  EXPECT_GT(made.mesh.n_triangles(), 0u);
  const Spread sizes = spread([&] {
    std::vector<double> all;
    for (const VertexId v : made.mesh.vertices()) all.push_back(local_size(made.mesh, v));
    return all;
  }());
  EXPECT_LT(sizes.max, 1.7 * size);
}

/// Lines are edges of the mesh, on the boundary or constrained.
void expect_lines(const OutlineMesh& made) {
  for (const MeshLine& line : made.lines) {
    HalfedgeId h = made.mesh.find_halfedge(line.a, line.b);
    if (!h.valid()) h = made.mesh.find_halfedge(line.b, line.a);
    ASSERT_TRUE(h.valid());
    EXPECT_TRUE(made.mesh.is_boundary(h) || made.mesh.is_constrained(h));
  }
}

/// Points of an outline are at their places, bit for bit. `from`: the number of the first in vertex_of_point.
void expect_places(const OutlineMesh& made, const Outline& outline, std::size_t from) {
  for (std::size_t i = 0; i < outline.points.size(); ++i) {
    const VertexId v = made.vertex_of_point[from + i];
    ASSERT_TRUE(v.valid()) << i;
    const Space& sphere = made.mesh.space();
    EXPECT_TRUE(sphere.same_place(made.mesh.point(v), as_point(sphere.radius() * direction_of(outline.points[i]))));
  }
}

SphereOutline islands_and_rivers() {
  SphereOutline o;
  add_line(o.coasts, blob({40, 10}, 30, 60), true);
  add_line(o.coasts, blob({179, -20}, 15, 30), true);
  add_line(o.coasts, blob({0, -90}, 20, 40), true);
  add_line(o.lines, {{-100, 20}, {-90, 25}, {-80, 24}, {-75, 30}}, false, 7);
  add_line(o.lines, {{170, 50}, {178, 52}, {-175, 50}}, false);
  return o;
}

TEST(SphereMesher, AWholeSphereIsWellCenteredAtAnySize) {
  for (const double size : {0.6, 0.3, 0.1, 0.05}) {
    SCOPED_TRACE(size);
    const OutlineMesh made = globe_of({.radius = 1}, globe_sized(size));
    expect_good(made, size);
    EXPECT_EQ(euler(made.mesh), 2);
    EXPECT_NEAR(area_of(made.mesh), 1, 1e-12);
    const double ideal = 4 * kPi / (std::sqrt(3.0) / 4 * size * size);
    EXPECT_GT(static_cast<double>(made.mesh.n_triangles()), 0.8 * ideal);
    EXPECT_LT(static_cast<double>(made.mesh.n_triangles()), 1.3 * ideal);
  }
}

TEST(SphereMesher, CoastsAreCutOutAndLinesStay) {
  const SphereOutline o = islands_and_rivers();
  for (const double size : {1e6, 4e5}) {
    SCOPED_TRACE(size);
    const OutlineMesh made = globe_of(o, globe_sized(size));
    expect_good(made, size);
    expect_lines(made);
    expect_places(made, o.coasts, 0);
    expect_places(made, o.lines, o.coasts.points.size());
    EXPECT_EQ(euler(made.mesh), 2 - 3);
    const double land = area_of(blob({40, 10}, 30, 60), {40, 10}) + area_of(blob({179, -20}, 15, 30), {179, -20}) +
                        area_of(blob({0, -90}, 20, 40), {0, -90});
    EXPECT_NEAR(area_of(made.mesh), 1 - land, 1e-9);
    EXPECT_GT(std::count_if(made.lines.begin(), made.lines.end(), [](const MeshLine& l) { return l.tag == 7; }), 2);
  }
}

TEST(SphereMesher, EachNameOfSeveralOutlinesHasItsOwnTag) {
  SphereOutline o = islands_and_rivers();
  constexpr std::size_t kIsland = 60;  // segments
  for (std::size_t s = 0; s < kIsland; ++s) o.coasts.segments[s].tag = 3;
  o.coasts.parts = {{1, std::vector<std::int32_t>(kIsland), {}}};
  std::iota(o.coasts.parts[0].segments.begin(), o.coasts.parts[0].segments.end(), 0);
  o.coasts.groups = {{1, 3, "cliff"}, {2, 1, "island"}};
  o.lines.segments.back().tag = 3;
  o.lines.groups = {{1, 3, "Congo"}, {1, 7, "Nile"}, {0, 3, "gauges"}};
  o.lines.point_tags = {{0, 3}, {2, 3}};
  o.lines.further_tags = {{1, 3}};
  const OutlineMesh made = globe_of(o, globe_sized(1e6));
  std::map<std::pair<int, std::int32_t>, std::string> names;
  for (const PhysicalName& g : made.groups) {
    EXPECT_TRUE(names.emplace(std::pair(g.dimension, g.tag), g.name).second) << g.name << " shares its tag";
  }
  std::map<std::string, std::set<std::pair<VertexId, VertexId>>> edges;
  for (const MeshLine& line : made.lines) {
    const std::string name = line.tag == 0 ? "none" : names.at({1, line.tag});
    EXPECT_TRUE(edges[name].emplace(line.a, line.b).second) << name << " has an edge twice";
  }
  EXPECT_EQ(edges.at("island"), edges.at("cliff")) << "the polygon leaves no region, so its edges have its name";
  EXPECT_GE(edges.at("cliff").size(), kIsland);
  for (const auto& edge : edges.at("none")) EXPECT_FALSE(edges.at("cliff").contains(edge));
  std::size_t both = 0;
  for (const auto& edge : edges.at("Congo")) both += edges.at("Nile").contains(edge) ? 1 : 0;
  EXPECT_GT(both, 0u) << "one segment is part of both rivers";
  EXPECT_LT(both, edges.at("Congo").size());
  ASSERT_EQ(made.marked.size(), 2u);
  for (const MarkedVertex& mark : made.marked) {
    EXPECT_EQ(names.at({0, mark.tag}), "gauges");
    EXPECT_TRUE(made.mesh.is_fixed(mark.vertex));
  }
}

TEST(SphereMesher, BoundariesAreDividedWhereSizesAskForIt) {
  SphereOutline o;
  o.coasts = loop({{0, 0}, {60, 0}, {60, 40}, {0, 40}});
  const OutlineMesh made = globe_of(o, globe_sized(3e5));
  expect_good(made, 3e5);
  for (const MeshLine& line : made.lines) {
    const double edge = kEarth * arc_length(made.mesh.weighted_vector(line.a), made.mesh.weighted_vector(line.b));
    EXPECT_LT(edge, 1.3 * 3e5);
    EXPECT_GT(edge, 0.5 * 3e5);
  }
}

TEST(SphereMesher, SizesGrowAsTheFieldDoes) {
  const GradedSphere shape{.vertices = 8000, .ratio = 30, .at = {-30, 45}, .radius = kEarth};
  const Mesh globe = *graded_sphere(shape);
  std::vector<double> sizes;
  for (const VertexId v : globe.vertices()) sizes.push_back(graded_sphere_size(shape, globe.weighted_vector(v)));
  MesherOptions options;
  options.field = *SizeField::from_values(globe, sizes);
  const OutlineMesh made = globe_of({}, options);
  expect_good(made, graded_sphere_size(shape, -1.0 * direction_of(shape.at)));
  const SizeReport report = measure_size(made.mesh, *options.field);
  EXPECT_NEAR(report.over_field.median, 1, 0.1);
  EXPECT_GT(report.over_field.p05, 0.75);
  EXPECT_LT(report.over_field.p95, 1.25);
  std::vector<double> obtained;
  for (const VertexId v : made.mesh.vertices()) obtained.push_back(local_size(made.mesh, v));
  const auto [least, largest] = std::minmax_element(obtained.begin(), obtained.end());
  EXPECT_GT(*largest / *least, 20);
  EXPECT_LT(*largest / *least, 45);
}

TEST(SphereMesher, ASteepFieldIsGraded) {
  const Mesh globe = *icosahedral({.level = 3, .radius = 1});
  std::vector<double> sizes;
  for (const VertexId v : globe.vertices()) sizes.push_back(globe.weighted_vector(v).z > 0.98 ? 0.02 : 0.4);
  MesherOptions options;
  options.field = *SizeField::from_values(globe, sizes);
  const OutlineMesh made = globe_of({.radius = 1}, options);
  expect_good(made, 0.4);
  const SizeReport report = measure_size(made.mesh, input_size_field(made.mesh));
  EXPECT_LT(report.gradation.p95, 1.5);
}

TEST(SphereMesher, TheNumberBoundsTheField) {
  const Mesh globe = *icosahedral({.level = 2, .radius = 1});
  MesherOptions options = globe_sized(0.2);
  options.field = *SizeField::from_values(globe, std::vector<double>(globe.n_vertices(), 0.5));
  expect_good(globe_of({.radius = 1}, options), 0.2);
}

TEST(SphereMesher, TheSameBytesForAnyNumberOfThreads) {
  const SphereOutline o = islands_and_rivers();
  const Mesh alone = globe_of(o, globe_sized(5e5)).mesh;
  for (const int threads : {2, 3}) {
    StdThreads executor(threads);
    EXPECT_EQ(globe_of(o, globe_sized(5e5), {.executor = &executor}).mesh, alone) << threads;
  }
}

TEST(SphereMesher, ASphereTwiceAsLargeGivesTheSameMeshTwiceAsLarge) {
  SphereOutline o = islands_and_rivers();
  o.radius = 1;
  MesherOptions options = globe_sized(0.1);
  options.optimize.reset();
  const Mesh one = globe_of(o, options).mesh;
  o.radius = 1024;
  options.size *= 1024;
  const Mesh other = globe_of(o, options).mesh;
  ASSERT_EQ(one.n_vertices(), other.n_vertices());
  for (const VertexId v : one.vertices()) EXPECT_EQ(1024.0 * one.weighted_vector(v), other.weighted_vector(v));
}

TEST(SphereMesher, LongitudesMayBeInEitherConvention) {
  SphereOutline o, turned;
  add_line(o.coasts, {{-170, 10}, {-160, 30}, {170, 35}, {165, 12}}, true);
  add_line(turned.coasts, {{190, 10}, {200, 30}, {170, 35}, {165, 12}}, true);
  const OutlineMesh made = globe_of(o, globe_sized(5e5));
  EXPECT_EQ(made.mesh, globe_of(turned, globe_sized(5e5)).mesh);
  EXPECT_NEAR(area_of(made.mesh), 1 - area_of(o.coasts.points, {180, 20}), 1e-9);
}

TEST(SphereMesher, TheSidesOfALoopAreTakenByTheirSizeNotItsDirection) {
  SphereOutline o, backwards;
  std::vector<Vec2> places = blob({20, 80}, 25, 40);
  add_line(o.coasts, places, true);
  std::reverse(places.begin(), places.end());
  add_line(backwards.coasts, places, true);
  const double water = 1 - area_of(places, {20, 80});
  EXPECT_NEAR(area_of(globe_of(o, globe_sized(6e5)).mesh), water, 1e-9);
  EXPECT_NEAR(area_of(globe_of(backwards, globe_sized(6e5)).mesh), water, 1e-9);
}

TEST(SphereMesher, PolygonsCutAtTheEndOfTheMapAreWhole) {
  // Around the south pole: along the end of the map to it and back; and two halves of an island.
  SphereOutline o;
  std::vector<Vec2> around = {{180, -90}, {-180, -90}};
  for (int lon = -180; lon <= 180; lon += 20) around.push_back({double(lon), -70.0});
  add_line(o.coasts, around, true);
  add_line(o.coasts, {{180, 10}, {180, 0}, {160, 0}, {160, 10}}, true);
  add_line(o.coasts, {{-180, 0}, {-180, 10}, {-165, 10}, {-165, 0}}, true);
  const auto n = static_cast<std::int32_t>(o.coasts.segments.size());
  for (const auto& [from, to] : std::vector<std::array<std::int32_t, 2>>{{0, n - 8}, {n - 8, n - 4}, {n - 4, n}}) {
    OutlinePart part;
    for (std::int32_t s = from; s < to; ++s) part.segments.push_back(s);
    o.coasts.parts.push_back(part);
  }
  const OutlineMesh made = globe_of(o, globe_sized(8e5));
  expect_good(made, 8e5);
  EXPECT_EQ(euler(made.mesh), 2 - 2);
  for (const MeshLine& line : made.lines) EXPECT_TRUE(made.mesh.is_boundary(line.a));
  std::vector<Vec2> ring;
  for (int lon = -180; lon < 180; lon += 20) ring.push_back({double(lon), -70.0});
  const double land =
      area_of(ring, {0, -90}) + area_of({{160, 0}, {180, 0}, {195, 0}, {195, 10}, {180, 10}, {160, 10}}, {178, 5});
  EXPECT_NEAR(area_of(made.mesh), 1 - land, 1e-9);
}

TEST(SphereMesher, BasinsAreWhatIsMeshedAndIslandsInThemAreNot) {
  SphereOutline o;
  add_line(o.basins, blob({10, 40}, 30, 50, 0), true);
  add_line(o.coasts, blob({15, 45}, 8, 20, 0), true);
  const OutlineMesh made = globe_of(o, globe_sized(4e5));
  expect_good(made, 4e5);
  expect_places(made, o.basins, 0);
  expect_places(made, o.coasts, o.basins.points.size());
  EXPECT_EQ(euler(made.mesh), 0);
  EXPECT_NEAR(area_of(made.mesh), area_of(o.basins.points, {10, 40}) - area_of(o.coasts.points, {15, 45}), 1e-9);
  // A basin far smaller than a helper's triangle, without anything else on the sphere.
  SphereOutline pond;
  pond.basins = loop({{7, 50}, {7.1, 50}, {7.1, 50.1}, {7, 50.1}});
  const OutlineMesh small = globe_of(pond, globe_sized(1000));
  expect_good(small, 1000);
  EXPECT_NEAR(area_of(small.mesh) / area_of(pond.basins.points, {7.05, 50.05}), 1, 1e-8);
}

TEST(SphereMesher, LakesInLandAndIslandsInThemTakeTurns) {
  SphereOutline o;
  add_line(o.coasts, blob({0, 0}, 40, 60, 0), true);
  add_line(o.coasts, blob({0, 0}, 20, 40, 0), true);
  add_line(o.coasts, blob({0, 0}, 8, 20, 0), true);
  const OutlineMesh made = globe_of(o, globe_sized(6e5));
  expect_good(made, 6e5);
  const double outer = area_of(blob({0, 0}, 40, 60, 0), {0, 0}), lake = area_of(blob({0, 0}, 20, 40, 0), {0, 0}),
               island = area_of(blob({0, 0}, 8, 20, 0), {0, 0});
  EXPECT_NEAR(area_of(made.mesh), 1 - outer + lake - island, 1e-9);
}

TEST(SphereMesher, PointsOfNoSegmentBecomeFixedVertices) {
  SphereOutline o;
  o.lines.points = {{10, 20}, {180, -5}, {0, 90}};
  const OutlineMesh made = globe_of(o, globe_sized(1e6));
  expect_good(made, 1e6);
  expect_places(made, o.lines, 0);
  for (const VertexId v : made.vertex_of_point) EXPECT_TRUE(made.mesh.is_fixed(v));
}

TEST(SphereMesher, WithoutOptimizationTheMeshIsDelaunay) {
  MesherOptions options = globe_sized(5e5);
  options.optimize.reset();
  const OutlineMesh made = globe_of(islands_and_rivers(), options);
  EXPECT_EQ(made.report.sweeps, 0);
  EXPECT_EQ(made.bad, made.delaunay_bad);
  EXPECT_EQ(count_non_regular_edges(made.mesh, false), 0u);
}

TEST(SphereMesher, RegionsOfBasinsHaveTheirNumbersAndSizes) {
  SphereOutline o;
  add_line(o.basins, {{0, 0}, {20, 0}, {20, 20}, {0, 20}}, true);
  add_line(o.basins, {{20, 0}, {40, 0}, {40, 20}, {20, 20}}, true);
  o.basins.parts = {{4, {0, 1, 2, 3}, {}}, {5, {4, 5, 6, 7}, 1e5}};
  const OutlineMesh made = globe_of(o, globe_sized(4e5));
  EXPECT_EQ(made.bad, 0u);
  expect_lines(made);
  std::array<std::size_t, 2> triangles = {};
  for (const TriangleId t : made.mesh.triangles()) {
    ASSERT_TRUE(made.mesh.region(t) == 4 || made.mesh.region(t) == 5);
    ++triangles[made.mesh.region(t) == 4 ? 0 : 1];
  }
  EXPECT_GT(triangles[1], 3 * triangles[0]);
  EXPECT_NEAR(area_of(made.mesh), area_of({{0, 0}, {20, 0}, {40, 0}, {40, 20}, {20, 20}, {0, 20}}, {20, 10}), 1e-9);
}

TEST(SphereMesher, ManyPointsThatFaceAnEmptyHalfCostNoMoreThanOthers) {
  std::vector<Vec3> points;
  for (const Vec2 p : blob({40, 30}, 20, 4000, 0.1)) points.push_back(kEarth * direction_of(p));
  EXPECT_FALSE(spherical_delaunay(points, kEarth));
  for (const Vec2 p : {Vec2{160, -20}, Vec2{-100, -30}, Vec2{30, -80}}) points.push_back(kEarth * direction_of(p));
  const auto mesh = spherical_delaunay(points, kEarth);
  ASSERT_TRUE(mesh) << mesh.error().what();
  EXPECT_EQ(mesh->n_vertices(), points.size());
  EXPECT_EQ(count_non_regular_edges(*mesh, false), 0u);
}

TEST(SphereMesher, RandomIslandsAreNoTrouble) {
  Rng rng(5);
  std::size_t meshed = 0;
  for (int ocean = 0; ocean < 12; ++ocean) {
    SphereOutline o;
    for (int k = 0; k < 3; ++k) {
      const double lon = rng.uniform(-180, 180), z = rng.uniform(-1, 1), radius = std::exp(rng.uniform(0, 3.4));
      const int corners = 3 + static_cast<int>(rng.uniform(0, 40));
      add_line(o.coasts, blob({lon, std::asin(z) * 180 / kPi}, radius, corners, rng.uniform(0, 0.5)), true);
    }
    const Expected<OutlineMesh> made = mesh_sphere(o, globe_sized(8e5));
    if (!made) {
      EXPECT_EQ(made.error().code, ErrorCode::overlap) << made.error().what();  // islands that cross
      continue;
    }
    ++meshed;
    EXPECT_EQ(made->bad, 0u) << ocean;
    EXPECT_FALSE(made->mesh.validate());
  }
  EXPECT_GT(meshed, 6u);
}

// --- what is refused -----------------------------------------------------------------------------------------------

void expect_globe_error(const SphereOutline& outline, const MesherOptions& options, ErrorCode code,
                        const std::string& part) {
  const Expected<OutlineMesh> made = mesh_sphere(outline, options);
  ASSERT_FALSE(made.has_value()) << "expected: " << part;
  EXPECT_EQ(made.error().code, code) << made.error().what();
  EXPECT_NE(made.error().what().find(part), std::string::npos) << made.error().what();
}

SphereOutline coast(const std::vector<Vec2>& places) {
  SphereOutline o;
  add_line(o.coasts, places, true);
  return o;
}

TEST(SphereMesherErrors, PlacesAreLongitudeAndLatitude) {
  expect_globe_error(coast({{0, 0}, {10, 0}, {10, 91}}), globe_sized(1e6), ErrorCode::geographic,
                     "point 2 (segment 1) has longitude 10 and latitude 91");
  expect_globe_error(coast({{0, 0}, {10, 0}, {std::nan(""), 9}}), globe_sized(1e6), ErrorCode::geographic, "point 2");
  expect_globe_error(coast({{0, 0}, {180, 0}, {90, 30}}), globe_sized(1e6), ErrorCode::geographic, "opposite places");
  expect_globe_error(coast({{-120, 0}, {-100, 0}, {200, 20}}), globe_sized(1e6), ErrorCode::geographic,
                     "segment 1 goes from longitude -100 to 200");
}

TEST(SphereMesherErrors, CoastsAreClosedAndDoNotCross) {
  SphereOutline open;
  add_line(open.coasts, {{0, 0}, {20, 0}, {20, 20}}, false);
  expect_globe_error(open, globe_sized(1e6), ErrorCode::empty_input,
                     "segment 0 ends at (0, 0), but no other segment goes on there");
  expect_globe_error(coast({{0, 0}, {20, 20}, {20, 0}, {0, 20}}), globe_sized(1e6), ErrorCode::overlap,
                     "segment 2 (point 2 to point 3) crosses segment 0 (point 0 to point 1)");
  SphereOutline two = coast(blob({0, 0}, 20, 20));
  add_line(two.lines, {{0, 1}, {50, 3}}, false);
  expect_globe_error(two, globe_sized(1e6), ErrorCode::overlap, "crosses");
}

TEST(SphereMesherErrors, HalvesAndNothingAreNoSides) {
  expect_globe_error(coast({{0, 0}, {90, 0}, {180, 0}, {-90, 0}}), globe_sized(1e6), ErrorCode::out_of_scale,
                     "into halves");
  expect_globe_error(coast({{-180, -90}, {180, -90}, {180, -60}, {-180, -60}}), globe_sized(1e6), ErrorCode::zero_area,
                     "encloses nothing");
  SphereOutline nothing;
  add_line(nothing.basins, blob({0, 0}, 10, 20), true);
  add_line(nothing.coasts, blob({0, 0}, 20, 30), true);
  expect_globe_error(nothing, globe_sized(1e6), ErrorCode::empty_input, "nothing of the sphere is left");
}

TEST(SphereMesherErrors, SizesFitTheSphere) {
  expect_globe_error({}, globe_sized(0), ErrorCode::invalid_option, "expected a size above 0");
  expect_globe_error({.radius = 0}, globe_sized(1), ErrorCode::invalid_option, "radius");
  expect_globe_error({}, globe_sized(10), ErrorCode::invalid_option, "triangles; at most");
  expect_globe_error({}, globe_sized(1e8), ErrorCode::invalid_option, "too long for a sphere");
  MesherOptions options;
  const Mesh globe = *icosahedral({.level = 1, .radius = 1});
  options.field = *SizeField::from_values(globe, std::vector<double>(globe.n_vertices(), 0.5));
  expect_globe_error({}, options, ErrorCode::invalid_option, "the size field is for a sphere of radius 1");
  options.field = *SizeField::from_values(globe, std::vector<double>(globe.n_vertices(), 1e-6));
  expect_globe_error({.radius = 1}, options, ErrorCode::invalid_option, "the size field would make about");
  const Mesh flat = sparse_horseshoe();
  options.field = *SizeField::from_values(flat, std::vector<double>(flat.n_vertices(), 0.5));
  expect_globe_error({.radius = 1}, options, ErrorCode::invalid_option, "the size field is for the plane");
}

}  // namespace
}  // namespace temper::test
