// From outlines to meshes: what holds of every mesh, what the options do, and what is refused.
#include "temper/mesher.hpp"

#include <algorithm>
#include <set>

#include "outlines.hpp"
#include "temper/generate.hpp"

namespace temper::test {
namespace {

OutlineMesh mesh_of(const Outline& outline, const MesherOptions& options) {
  Expected<OutlineMesh> made = mesh_outline(outline, options);
  EXPECT_TRUE(made.has_value()) << made.error().what();
  return made ? *std::move(made) : OutlineMesh();
}

MesherOptions sized(double size) {
  MesherOptions options;
  options.size = size;
  return options;
}

double mean_edge(const Mesh& mesh) {
  double sum = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_edge_representative(h)) sum += length(mesh.position(mesh.target(h)) - mesh.position(mesh.origin(h)));
  }
  return sum / static_cast<double>(mesh.n_edges());
}

TEST(Mesher, EveryOutlineAtEverySizeBecomesWellCenteredAndKeepsItsPoints) {
  for (const NamedOutline& named : outlines()) {
    for (const double part : {2.0, 0.1, 0.03}) {
      SCOPED_TRACE(named.name + ", size " + std::to_string(part) + " of the extent");
      const OutlineMesh made = mesh_of(named.outline, sized(part * extent(named.outline)));
      EXPECT_EQ(made.bad, 0u);
      EXPECT_EQ(count_bad(made.mesh), 0u);
      expect_kept(named.outline, made);
    }
  }
}

TEST(Mesher, TheAreaIsThatOfTheOutline) {
  const auto area = [](const Outline& outline, MesherOptions options) {
    return mesh_area(mesh_of(outline, options).mesh);
  };
  EXPECT_NEAR(area(square(), sized(0.1)), 1, 1e-12);
  EXPECT_NEAR(area(slits(), sized(0.1)), 2, 1e-12);
  const auto disc = [](double radius, int n) { return 0.5 * n * radius * radius * std::sin(2 * std::numbers::pi / n); };
  EXPECT_NEAR(area(holes(), sized(0.2)), 6 - disc(0.5, 16) - disc(0.35, 5) - disc(0.2, 3), 1e-12);
  const double land = disc(1, 40) - disc(0.7, 30), island = disc(0.4, 11);
  EXPECT_NEAR(area(island_in_lake(), sized(0.2)), land + island, 1e-12);
  MesherOptions all = sized(0.2);
  all.enclosed = Enclosed::all;
  EXPECT_NEAR(area(island_in_lake(), all), disc(1, 40), 1e-12);
}

TEST(Mesher, WarnsThatAnInnerLoopIsAHoleUnlessAnOptionSaysSo) {
  const auto warnings = [](const Outline& outline, Enclosed enclosed) {
    MesherOptions options = sized(0.2);
    options.enclosed = enclosed;
    return mesh_of(outline, options).warnings;
  };
  const std::vector<std::string> given = warnings(island_in_lake(), Enclosed::by_points);
  ASSERT_EQ(given.size(), 1u);
  EXPECT_NE(given[0].find("1 enclosed area is left out as a hole"), std::string::npos) << given[0];
  EXPECT_NE(given[0].find("--enclosed all"), std::string::npos) << given[0];
  EXPECT_TRUE(warnings(island_in_lake(), Enclosed::all).empty());
  EXPECT_TRUE(warnings(island_in_lake(), Enclosed::alternate).empty());
  EXPECT_TRUE(warnings(square(), Enclosed::by_points).empty());
  ASSERT_EQ(warnings(holes(), Enclosed::by_points).size(), 1u);
  Outline with_points = holes();
  with_points.holes = {{-100, -100}};
  EXPECT_FALSE(mesh_outline(with_points, sized(0.2)).has_value()) << "a hole outside is an error, not a warning";
}

MesherOptions few_points(int moves) {
  MesherOptions options;
  options.points = MeshPoints::few;
  options.optimize->coarsen_moves = moves;
  return options;
}

TEST(Mesher, FewPointsAreEnoughForEveryOutline) {
  for (const NamedOutline& named : outlines()) {
    SCOPED_TRACE(named.name);
    const OutlineMesh made = mesh_of(named.outline, few_points(50));
    EXPECT_EQ(made.bad, 0u);
    EXPECT_EQ(count_bad(made.mesh), 0u);
    expect_kept(named.outline, made);
    const OutlineMesh coarse = mesh_of(named.outline, sized(2 * extent(named.outline)));
    EXPECT_LE(made.mesh.n_vertices(), coarse.mesh.n_vertices());
    EXPECT_EQ(mesh_of(named.outline, few_points(50)).mesh, made.mesh) << "the same bytes";
  }
}

TEST(Mesher, FewPointsOfAChannelWithARightAngleOppositeItsBoundaryLeaveNothingBad) {
  const Outline channel = loop({{0, 0}, {9, 0}, {9, 1}, {1, 1}, {1, 8}, {9, 7}, {9, 8}, {0, 9}});
  EXPECT_EQ(count_bad(mesh_of(channel, few_points(50)).mesh), 0u);
}

TEST(Mesher, FewPointsAreRefusedWithoutOptimization) {
  MesherOptions options = few_points(10);
  options.optimize.reset();
  EXPECT_FALSE(mesh_outline(square(), options));
}

TEST(Mesher, TheSameInputGivesTheSameBytes) {
  const OutlineMesh one = mesh_of(comb(), sized(0.2)), other = mesh_of(comb(), sized(0.2));
  EXPECT_EQ(one.mesh, other.mesh);
  ASSERT_EQ(one.lines.size(), other.lines.size());
  for (std::size_t i = 0; i < one.lines.size(); ++i) {
    EXPECT_EQ(one.lines[i].a, other.lines[i].a);
    EXPECT_EQ(one.lines[i].b, other.lines[i].b);
  }
}

TEST(Mesher, AnOutlineTwiceAsLargeGivesTheSameMeshTwiceAsLarge) {
  for (const Outline& outline : {comb(), slits()}) {
    Outline larger = outline;
    for (Vec2& p : larger.points) p = 1024.0 * p;
    MesherOptions options = sized(0.2);
    options.optimize.reset();
    const Mesh one = mesh_of(outline, options).mesh;
    options.size *= 1024;
    const Mesh other = mesh_of(larger, options).mesh;
    ASSERT_EQ(one.n_vertices(), other.n_vertices());
    ASSERT_EQ(one.n_triangles(), other.n_triangles());
    for (const VertexId v : one.vertices()) EXPECT_EQ(1024.0 * one.position(v), other.position(v));
  }
}

TEST(Mesher, EdgesHaveTheSizeAskedForAndTrianglesTheirNumber) {
  for (const double size : {0.1, 0.05, 0.02}) {
    const OutlineMesh made = mesh_of(square(), sized(size));
    EXPECT_NEAR(mean_edge(made.mesh), size, 0.15 * size);
    const double ideal = 1 / (std::sqrt(3.0) / 4 * size * size);
    EXPECT_GT(static_cast<double>(made.mesh.n_triangles()), 0.8 * ideal);
    EXPECT_LT(static_cast<double>(made.mesh.n_triangles()), 1.6 * ideal);
  }
}

TEST(Mesher, RowsOfPointsAreThoseOfEquilateralTriangles) {
  for (const double turn : {0.0, 0.3}) {
    Outline turned = square();
    for (Vec2& p : turned.points)
      p = {std::cos(turn) * p.x - std::sin(turn) * p.y, std::sin(turn) * p.x + std::cos(turn) * p.y};
    MesherOptions options = sized(0.02);
    options.optimize.reset();
    const Mesh mesh = mesh_of(turned, options).mesh;
    EXPECT_LT(10 * count_bad(mesh), mesh.n_triangles());  // where fronts meet
  }
}

TEST(Mesher, ALargeSizeMakesFewTriangles) {
  EXPECT_LE(mesh_of(square(), sized(100)).mesh.n_triangles(), 8u);
  EXPECT_LE(mesh_of(wedge(60), sized(100)).mesh.n_triangles(), 8u);
}

TEST(Mesher, ASmallerGradeMakesSizesChangeMoreSlowly) {
  const Outline outline = loop({{0, 0}, {0.5, 0}, {0.501, 0}, {1, 0}, {1, 1}, {0, 1}});
  std::size_t before = 0;
  for (const double grade : {0.6, 0.3, 0.15}) {
    MesherOptions options = sized(0.25);
    options.grade = grade;
    const OutlineMesh made = mesh_of(outline, options);
    EXPECT_EQ(made.bad, 0u);
    EXPECT_GT(made.mesh.n_triangles(), before);
    before = made.mesh.n_triangles();
  }
}

TEST(Mesher, RegionsHaveTheirNumbersAndSizesAndAConstrainedBorder) {
  const Outline outline = two_regions();
  const OutlineMesh made = mesh_of(outline, sized(0.2));
  std::array<double, 2> area = {};
  std::array<std::size_t, 2> triangles = {};
  for (const TriangleId t : made.mesh.triangles()) {
    const std::int32_t region = made.mesh.region(t);
    ASSERT_TRUE(region == 10 || region == 20);
    const auto [a, b, c] = made.mesh.corners(t);
    const std::size_t i = region == 10 ? 0 : 1;
    area[i] += 0.5 * doubled_area(made.mesh.position(a), made.mesh.position(b), made.mesh.position(c));
    ++triangles[i];
  }
  EXPECT_NEAR(area[0], 1, 1e-12);
  EXPECT_NEAR(area[1], 1, 1e-12);
  EXPECT_GT(triangles[1], 4 * triangles[0]);
  std::set<std::int32_t> tags;
  for (const MeshLine& line : made.lines) tags.insert(line.tag);
  EXPECT_EQ(tags, (std::set<std::int32_t>{1, 5}));

  MesherOptions finer = sized(0.2);
  finer.region_sizes = {{10, 0.05}};
  EXPECT_GT(mesh_of(outline, finer).mesh.n_triangles(), made.mesh.n_triangles() + 100);
}

TEST(Mesher, SizesMayComeFromAField) {
  // From 0.02 on the left to 0.1 on the right; the field ends before the outline, and goes on as it is there.
  const std::vector<Vec2> points = {{0, -1}, {0.9, -1}, {0.9, 2}, {0, 2}};
  const std::vector<std::array<std::int32_t, 3>> triangles = {{0, 1, 2}, {0, 2, 3}};
  MeshInput input;
  input.points = points;
  input.triangles = triangles;
  MesherOptions options;
  options.field = *SizeField::from_values(Mesh::build(input)->mesh, std::vector<double>{0.02, 0.1, 0.1, 0.02});
  const OutlineMesh made = mesh_of(square(), options);
  EXPECT_EQ(made.bad, 0u);
  expect_kept(square(), made);
  const SizeReport report = measure_size(made.mesh, *options.field);
  EXPECT_NEAR(report.over_field.median, 1, 0.1);
  EXPECT_GT(report.over_field.p05, 0.75);
  EXPECT_LT(report.over_field.p95, 1.35);
  options.size = 0.03;
  EXPECT_GT(mesh_of(square(), options).mesh.n_triangles(), made.mesh.n_triangles());
}

TEST(Mesher, SizesAtPointsAndAlongLinesGrowWithTheDistance) {
  Outline outline = square();
  add_line(outline, {{0.2, 0.3}, {0.7, 0.3}}, false);
  outline.points.push_back({0.4, 0.8});
  outline.sizes = {{{4, 5}, 0.02}, {{6, 6}, 0.01}, {{0, 0}, 7}};  // the last is larger than all
  MesherOptions options = sized(0.2);
  options.grade = 0.25;
  const OutlineMesh made = mesh_of(outline, options);
  EXPECT_EQ(made.bad, 0u);
  const IdVector<VertexId, double> sizes = local_sizes(made.mesh);
  for (const VertexId v : made.mesh.vertices()) {
    const Vec2 p = made.mesh.position(v);
    const double along = length(p - Vec2{std::clamp(p.x, 0.2, 0.7), 0.3}), around = length(p - Vec2{0.4, 0.8});
    const double wanted = std::min({0.2, 0.02 + 0.25 * along, 0.01 + 0.25 * around});
    EXPECT_LT(sizes[v], 1.7 * wanted) << p.x << ' ' << p.y;
    EXPECT_GT(sizes[v], wanted / 2.5) << p.x << ' ' << p.y;
  }
  outline.sizes[1].size = 0;
  EXPECT_EQ(mesh_outline(outline, options).error().message, "point 6 has size 0; expected a finite, positive length");
  outline.sizes[1] = {{7, 7}, 1};
  EXPECT_EQ(mesh_outline(outline, options).error().message, "size 1 is for point 7, but the outline has 7 points");
}

TEST(Mesher, AFieldOutsideTheDomainIsSaid) {
  for (const double shift : {0.0, 100.0}) {
    Mesh far = *random_mesh({50, 1, {}});
    for (const VertexId v : far.vertices()) far.set_point(v, {far.point(v).x + shift, far.point(v).y, 0});
    MesherOptions options;
    options.field = *SizeField::from_values(far, std::vector<double>(far.n_vertices(), 0.3));
    const OutlineMesh made = mesh_of(square(), options);
    const bool said = std::any_of(made.notes.begin(), made.notes.end(), [](const std::string& note) {
      return note.starts_with("the sizes are all outside");
    });
    EXPECT_EQ(said, shift > 0);
  }
}

TEST(Mesher, PartsSayWhatIsInside) {
  // Two squares that share a border, and a hole in the second.
  Outline o;
  o.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {2, 1}};
  o.segments = {{{0, 1}, 0}, {{1, 2}, 0}, {{2, 3}, 0}, {{3, 0}, 0}, {{1, 4}, 0}, {{4, 5}, 0}, {{5, 2}, 0}, {{2, 1}, 0}};
  add_line(o, {{1.4, 0.4}, {1.6, 0.4}, {1.6, 0.6}, {1.4, 0.6}}, true);
  o.parts = {{4, {0, 1, 2, 3}, {}}, {5, {4, 5, 6, 7, 8, 9, 10, 11}, {}}};
  const OutlineMesh made = mesh_of(o, sized(0.2));
  EXPECT_EQ(made.bad, 0u);
  EXPECT_NEAR(mesh_area(made.mesh), 2 - 0.04, 1e-12);
  for (const TriangleId t : made.mesh.triangles()) {
    const double x = made.mesh.position(made.mesh.corners(t)[0]).x + made.mesh.position(made.mesh.corners(t)[1]).x +
                     made.mesh.position(made.mesh.corners(t)[2]).x;
    EXPECT_EQ(made.mesh.region(t), x < 3 ? 4 : 5);
  }
}

TEST(Mesher, HolesAreWhereTheirPointsAre) {
  Outline o = holes();
  o.holes = {{0.8, 1}};
  const auto disc = [](double radius, int n) { return 0.5 * n * radius * radius * std::sin(2 * std::numbers::pi / n); };
  EXPECT_NEAR(mesh_area(mesh_of(o, sized(0.3)).mesh), 6 - disc(0.5, 16), 1e-12);
}

TEST(Mesher, PointsOfNoSegmentBecomeFixedVertices) {
  Outline o = square();
  o.points.insert(o.points.end(), {{0.31, 0.42}, {0.7, 0.7}, {0.75, 0.7}});
  const OutlineMesh made = mesh_of(o, sized(0.2));
  EXPECT_EQ(made.bad, 0u);
  for (std::size_t i = 4; i < 7; ++i) {
    ASSERT_TRUE(made.vertex_of_point[i].valid());
    EXPECT_TRUE(made.mesh.is_fixed(made.vertex_of_point[i]));
    EXPECT_EQ(made.mesh.position(made.vertex_of_point[i]), o.points[i]);
  }
}

TEST(Mesher, WhatLiesOutsideIsLeftOutAndSaid) {
  Outline o = square();
  add_line(o, {{2, 0}, {3, 1}}, false);
  const OutlineMesh made = mesh_of(o, sized(0.5));
  EXPECT_NEAR(mesh_area(made.mesh), 1, 1e-12);
  EXPECT_FALSE(made.vertex_of_point[5].valid());
  ASSERT_EQ(made.notes.size(), 1u);
  EXPECT_NE(made.notes[0].find("are outside: 2"), std::string::npos);
}

TEST(Mesher, SegmentsMayMeetOnOneAnother) {
  Outline o = square();
  o.points.insert(o.points.end(), {{0.5, 0}, {0.5, 0.5}});
  o.segments.push_back({{4, 5}, 3});  // from the middle of the first segment
  o.segments.push_back({{0, 1}, 9});  // the first segment once more
  const OutlineMesh made = mesh_of(o, sized(0.25));
  EXPECT_EQ(made.bad, 0u);
  EXPECT_NEAR(mesh_area(made.mesh), 1, 1e-12);
}

TEST(Mesher, WithoutOptimizationTheMeshIsConstrainedDelaunay) {
  MesherOptions options = sized(0.1);
  options.optimize.reset();
  for (const Outline& outline : {slits(), comb()}) {
    const OutlineMesh made = mesh_of(outline, options);
    EXPECT_EQ(made.report.sweeps, 0);
    EXPECT_EQ(made.bad, made.delaunay_bad);
    std::size_t tested = 0;
    for (const HalfedgeId h : made.mesh.halfedges()) {
      const Mesh& m = made.mesh;
      if (m.is_boundary(h) || m.is_constrained(h)) continue;
      ++tested;
      EXPECT_NE(power_test(m.point(m.origin(h)), m.point(m.target(h)), m.point(m.opposite(h)),
                           m.point(m.opposite(m.twin(h)))),
                Sign::positive);
    }
    EXPECT_GT(tested, 0u);
  }
}

TEST(Mesher, StoppingEarlyStillGivesAMesh) {
  const auto stop = [](const Progress&) { return Continue::no; };
  const Expected<OutlineMesh> made = mesh_outline(comb(), sized(0.1), {.observer = stop});
  ASSERT_TRUE(made.has_value()) << made.error().what();
  EXPECT_EQ(made->report.stopped, Stopped::canceled);
  EXPECT_EQ(made->mesh.validate(), std::nullopt);
}

// --- what is refused -----------------------------------------------------------------------------------------------

void expect_error(const Outline& outline, const MesherOptions& options, ErrorCode code, const std::string& part) {
  const Expected<OutlineMesh> made = mesh_outline(outline, options);
  ASSERT_FALSE(made.has_value()) << "expected: " << part;
  EXPECT_EQ(made.error().code, code) << made.error().what();
  EXPECT_NE(made.error().what().find(part), std::string::npos) << made.error().what();
}

TEST(MesherErrors, BadOptionsAreNamed) {
  for (const double size : {0.0, -1.0, std::nan("")}) {
    expect_error(square(), sized(size), ErrorCode::invalid_option, "expected a size above 0");
  }
  MesherOptions options = sized(1);
  options.grade = 0;
  expect_error(square(), options, ErrorCode::invalid_option, "grade");
  options = sized(1);
  options.attempts = 0;
  expect_error(square(), options, ErrorCode::invalid_option, "attempt");
  options = sized(1);
  options.region_sizes = {{3, 0.01}};
  expect_error(two_regions(), options, ErrorCode::invalid_option,
               "a size is given for region 3; expected one of the regions of the outline: 10, 20");
  options.region_sizes = {{3, -1}};
  expect_error(square(), options, ErrorCode::invalid_option, "region 3");
  expect_error(square(), sized(1e-9), ErrorCode::invalid_option, "triangles");
  options = sized(1);
  options.most_triangles = 100;  // not for the size, but for a short edge and a grade that hardly grows
  options.grade = 0.01;
  expect_error(loop({{0, 0}, {0.5, 0}, {0.501, 0}, {1, 0}, {1, 1}, {0, 1}}), options, ErrorCode::invalid_option,
               "short edges and narrow places");
}

TEST(MesherErrors, BadOutlinesAreNamedByTheirElements) {
  expect_error(loop({{0, 0}, {1, 0}, {2, 0}}), sized(1), ErrorCode::zero_area,
               "all points lie on one line; expected an outline that encloses an area");
  const double nan = std::nan("");
  const auto changed = [](auto change) {
    Outline o = square();
    change(o);
    return o;
  };
  const MesherOptions options = sized(0.5);
  expect_error(Outline(), options, ErrorCode::empty_input, "no points");
  expect_error(changed([](Outline& o) { o.segments.clear(); }), options, ErrorCode::empty_input, "no segments");
  expect_error(changed([&](Outline& o) { o.points[2].y = nan; }), options, ErrorCode::not_finite, "point 2");
  expect_error(changed([](Outline& o) { o.points[2].y = 1e200; }), options, ErrorCode::out_of_scale, "point 2");
  expect_error(changed([](Outline& o) { o.segments[1].ends[1] = 4; }), options, ErrorCode::index_out_of_range,
               "segment 1 uses point 4, but the outline has 4 points");
  expect_error(changed([](Outline& o) { o.segments[1].ends[1] = 1; }), options, ErrorCode::zero_area, "segment 1");
  MesherOptions exact = options;
  exact.snap = 0;
  expect_error(changed([](Outline& o) {
                 o.points.push_back({1, 1});
               }),
               exact, ErrorCode::duplicate_point, "point 4 is at the same place as point 2, (1, 1)");
  expect_error(loop({{0, 0}, {1, 1}, {1, 0}, {0, 1}}), options, ErrorCode::overlap, "segment 2");
  expect_error(changed([](Outline& o) { o.segments.pop_back(); }), options, ErrorCode::empty_input,
               "the outline is not closed: it encloses nothing, and at point 0 at (0, 0) only one segment ends");
  expect_error(changed([](Outline& o) {
                 o.holes = {{3, 3}};
               }),
               options, ErrorCode::unused_point, "hole 0 lies outside");
  expect_error(changed([](Outline& o) { o.holes = {{0.5, 0.5}}; }), options, ErrorCode::empty_input, "but holes");
  expect_error(changed([](Outline& o) {
                 o.regions = {{{3, 3}, 1, {}}};
               }),
               options, ErrorCode::unused_point, "region 0 lies outside");
  expect_error(changed([](Outline& o) {
                 o.regions = {{{0.3, 0.3}, 1, {}}, {{0.6, 0.6}, 2, {}}};
               }),
               options, ErrorCode::unused_point, "region 1 lies in the same area as region 0");
  expect_error(changed([](Outline& o) {
                 o.parts = {{0, {0, 1, 2, 7}, {}}};
               }),
               options, ErrorCode::index_out_of_range, "part 0 uses segment 7");
  expect_error(changed([](Outline& o) {
                 o.parts = {{0, {0, 1, 2, 3}, {}}, {1, {0, 1, 2, 3}, {}}};
               }),
               options, ErrorCode::overlap, "part 0 and part 1 overlap");
  Outline touching = loop({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  add_line(touching, {{1, 1}, {2, 1}, {2, 2}, {1, 2}}, true);
  touching.points.erase(touching.points.begin() + 4);
  for (std::size_t i = 4; i < 8; ++i) {
    for (std::int32_t& end : touching.segments[i].ends) end = end == 4 ? 2 : end - 1;
  }
  expect_error(touching, exact, ErrorCode::non_manifold_vertex, "the domain touches itself at (1, 1)");
}

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// 10⁹ by 10: whatever the size, some 10⁸ pieces or none are right for it.
TEST(Mesher, EndsInTimeWhereScalesDiffer) {
  const Outline narrow = loop({{0, 0}, {1e9, 0}, {1e9, 10}, {0, 10}});
  const Outline spike = loop({{0, 0}, {1e9, 0}, {3, 5}, {0, 4}});
  for (const Outline& outline : {narrow, spike}) {
    for (const double size : {1e2, 1e5, 1e12}) {
      MesherOptions options;
      options.size = size;
      options.time_limit = 0.2;
      const double seconds = seconds_of([&] {
        const auto made = mesh_outline(outline, options);
        ASSERT_FALSE(made);
        const bool refused = made.error().code == ErrorCode::out_of_scale;  // too many pieces, for a narrow place
        EXPECT_TRUE(refused || made.error().code == ErrorCode::stopped) << made.error().what();
        if (refused) {
          EXPECT_NE(made.error().what().find("the outline "), std::string::npos);
        }
      });
      EXPECT_LT(seconds, 5);
    }
  }
}

TEST(Mesher, StopsWhenItsCallerSaysSoBeforeThereIsAMesh) {
  MesherOptions options;
  options.size = 0.01;
  const Observer no = [](const Progress&) { return Continue::no; };
  const auto made = mesh_outline(square(), options, {.observer = no});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::stopped);
}

}  // namespace
}  // namespace temper::test
