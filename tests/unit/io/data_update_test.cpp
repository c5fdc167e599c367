// Data of points and triangles follow a mesh that changes: what is of the place stays at the place.
#include <cmath>
#include <map>

#include "support.hpp"
#include "temper/detail/transfer.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"
#include "temper/topology.hpp"

namespace temper::io {
namespace {

constexpr double kRounding = 1e-13, kFloatRounding = 1e-6;  // coordinates are up to 5

double depth(Vec2 p) { return 100 + 40 * p.x - 25 * p.y; }

/// Random points with data of several kinds, and what they are after an optimization.
struct Changed {
  MeshFile before, after;
  Mesh mesh;
  OptimizeReport run;
  DataReport report;
};

MeshFile file_with_data(const Mesh& mesh = *random_mesh({.vertices = 150, .seed = 3})) {
  MeshFile f = from_mesh(mesh);
  std::vector<double> depths, id;
  std::vector<float> coarse;
  std::vector<std::int32_t> node, triangle;
  std::vector<double> east;
  for (const Vec2 p : f.points) {
    depths.push_back(depth(p));
    coarse.push_back(static_cast<float>(p.x)), coarse.push_back(static_cast<float>(-p.y));
    node.push_back(static_cast<std::int32_t>(node.size()));
    id.push_back(static_cast<double>(id.size()));
  }
  for (const auto& corners : f.triangles) {
    triangle.push_back(static_cast<std::int32_t>(triangle.size()));
    double sum = 0;
    for (const std::int32_t p : corners) sum += f.points[static_cast<std::size_t>(p)].x;
    east.push_back(sum / 3);
  }
  f.point_data = {{"depth", 1, depths}, {"coarse", 2, coarse}, {"node", 1, node}, {"id", 1, id}};
  f.triangles.data = {{"triangle", 1, triangle}, {"east", 1, east}};
  return f;
}

Changed change(const OptimizeOptions& options = {}, const DataRules& rules = {},
               const MeshFile& file = file_with_data()) {
  Changed c;
  c.before = c.after = file;
  auto loaded = make_mesh(c.before);
  EXPECT_TRUE(loaded);
  auto run = optimize(loaded->mesh, options);
  EXPECT_TRUE(run);
  c.run = *std::move(run);
  c.mesh = loaded->mesh;
  c.report = update(c.after, *loaded, c.mesh, c.run.vertices, {rules});
  return c;
}

template <class T>
const std::vector<T>& values(const std::vector<DataArray>& arrays, std::string_view name) {
  for (const DataArray& a : arrays) {
    if (a.name == name) return std::get<std::vector<T>>(a.values);
  }
  throw std::runtime_error("there is no such array");
}

TEST(PointData, OfFloatingPointAreOfThePlaceAndIntegersOfThePoint) {
  const Changed c = change();
  ASSERT_GT(c.report.points_moved, 50u);
  const auto& depths = values<double>(c.after.point_data, "depth");
  const auto& coarse = values<float>(c.after.point_data, "coarse");
  for (std::size_t p = 0; p < c.after.points.size(); ++p) {
    const Vec2 at = c.after.points[p];
    EXPECT_NEAR(depths[p], depth(at), 100 * kRounding);
    EXPECT_NEAR(coarse[2 * p], at.x, kFloatRounding);
    EXPECT_NEAR(coarse[2 * p + 1], -at.y, kFloatRounding);
    if (at == c.before.points[p]) {
      EXPECT_EQ(depths[p], values<double>(c.before.point_data, "depth")[p]);
    }
  }
  EXPECT_EQ(values<std::int32_t>(c.after.point_data, "node"), values<std::int32_t>(c.before.point_data, "node"));
}

TEST(PointData, AreThoseOfNewVerticesTooAndOfThoseAroundRemovedOnes) {
  OptimizeOptions options;
  options.boundary = BoundaryVertices::split;
  options.paper.removal = Removal::patch;
  options.paper.removal_from = 0;
  const Changed c = change(options, {}, file_with_data(*horseshoe()));
  ASSERT_GT(c.report.points_inserted, 0u);
  ASSERT_LT(c.report.points, c.before.points.size());
  EXPECT_EQ(c.report.points + c.report.points_inserted, c.after.points.size());
  EXPECT_EQ(c.report.dropped, std::vector<std::string>{"node"});
  const auto& depths = values<double>(c.after.point_data, "depth");
  ASSERT_EQ(depths.size(), c.after.points.size());
  for (std::size_t p = 0; p < depths.size(); ++p) EXPECT_NEAR(depths[p], depth(c.after.points[p]), 100 * kRounding);
}

TEST(PointData, StayWithTheirPointsWhenToldToEachByItsName) {
  const auto rules = [](const std::vector<std::string>& words) { return *parse_data_rules(words); };
  const Changed keep = change({}, rules({"keep"}));
  expect_same_data(keep.before.point_data, keep.after.point_data, "point data");
  const Changed but_one = change({}, rules({"keep=id"}));
  EXPECT_EQ(values<double>(but_one.after.point_data, "id"), values<double>(but_one.before.point_data, "id"));
  EXPECT_NE(values<double>(but_one.after.point_data, "depth"), values<double>(but_one.before.point_data, "depth"));
  EXPECT_EQ(but_one.report.interpolated, (std::vector<std::string>{"depth", "coarse"}));
  EXPECT_EQ(but_one.report.kept, (std::vector<std::string>{"node", "id"}));
  const Changed one = change({}, rules({"keep", "interpolate=depth"}));
  EXPECT_EQ(one.report.interpolated, std::vector<std::string>{"depth"});
  EXPECT_EQ(values<double>(one.after.point_data, "depth"), values<double>(but_one.after.point_data, "depth"));
}

TEST(PointData, OfAPlaceThatWasAnotherVertexAreThoseOfThatVertexBitForBit) {
  MeshFile f = file_with_data();
  auto loaded = make_mesh(f);
  ASSERT_TRUE(loaded);
  Mesh& mesh = loaded->mesh;
  // All vertices change their numbers: every place is that of another one.
  const MeshOrder order = hilbert_order(mesh);
  const MeshFile before = f;
  update(f, *loaded, mesh);
  for (const VertexId v : mesh.vertices()) {
    for (const char* name : {"depth", "id"}) {
      EXPECT_EQ(values<double>(f.point_data, name)[v.index],
                values<double>(before.point_data, name)[order.vertices[v].index]);
    }
  }
  for (const TriangleId t : mesh.triangles()) {
    EXPECT_EQ(values<std::int32_t>(f.triangles.data, "triangle")[t.index], static_cast<int>(order.triangles[t].index));
  }
}

TEST(CellData, AreThoseOfTheTriangleThatTheMiddleIsIn) {
  for (const bool flips : {true, false}) {
    OptimizeOptions options;
    if (!flips) options.flips = Flips::none;
    const Changed c = change(options);
    ASSERT_GT(c.report.triangles_changed, 50u);
    EXPECT_EQ(c.report.of_triangles, (std::vector<std::string>{"triangle", "east"}));
    const auto& triangle = values<std::int32_t>(c.after.triangles.data, "triangle");
    const auto& east = values<double>(c.after.triangles.data, "east");
    std::size_t others = 0;
    for (std::size_t t = 0; t < c.after.triangles.size(); ++t) {
      const auto source = static_cast<std::size_t>(triangle[t]);
      EXPECT_EQ(east[t], values<double>(c.before.triangles.data, "east")[source]) << "all arrays from one triangle";
      Vec2 middle;
      for (const std::int32_t p : c.after.triangles[t]) {
        middle = middle + (1.0 / 3) * c.after.points[static_cast<std::size_t>(p)];
      }
      Vec2 last = c.before.points[static_cast<std::size_t>(c.before.triangles[source][2])];
      for (const std::int32_t p : c.before.triangles[source]) {
        const Vec2 next = c.before.points[static_cast<std::size_t>(p)];
        EXPECT_GT(cross(next - last, middle - last), -kRounding);
        last = next;
      }
      others += source != t ? 1 : 0;
    }
    EXPECT_GT(others, 0u);
  }
}

TEST(CellData, StayInTheirRegionWhenVerticesAreRemovedAndNothingIsLost) {
  MeshFile f = from_mesh(*sheared_grid({6, 6, 0.25}));
  std::vector<std::int32_t> material;
  std::vector<float> head;
  f.triangles.tags.clear();
  for (const auto& corners : f.triangles) {
    const int low = std::min({corners[0] % 7, corners[1] % 7, corners[2] % 7});
    f.triangles.tags.push_back(low < 3 ? 1 : 2);
    material.push_back(10 * f.triangles.tags.back());
    head.push_back(static_cast<float>(head.size()));
  }
  f.triangles.data = {{"material", 1, material}, {"head", 1, head}};
  auto loaded = make_mesh(f);
  ASSERT_TRUE(loaded);
  for (const std::size_t v : {8u, 2u, 24u}) {  // inside, on the boundary, between the regions
    const RemovalPlan plan = plan_removal(loaded->mesh, VertexId(v));
    ASSERT_EQ(plan.status, RemovalStatus::possible);
    remove_vertex(loaded->mesh, plan);
  }
  const auto left = loaded->mesh.compact().vertices;
  for (int twice = 0; twice < 2; ++twice) {
    update(f, *loaded, loaded->mesh, left);
    ASSERT_EQ(values<std::int32_t>(f.triangles.data, "material").size(), f.triangles.size());
    for (std::size_t t = 0; t < f.triangles.size(); ++t) {
      EXPECT_EQ(values<std::int32_t>(f.triangles.data, "material")[t], 10 * f.triangles.tags[t]);
    }
    EXPECT_EQ(values<float>(f.triangles.data, "head").size(), f.triangles.size());
    EXPECT_TRUE(f.warnings.empty());
  }
}

TEST(DataReport, CountsPointsAndTrianglesAndSaysHowFarPointsHaveMoved) {
  MeshFile f = file_with_data();
  auto loaded = make_mesh(f);
  ASSERT_TRUE(loaded);
  const std::size_t n = f.points.size(), m = f.triangles.size();
  {
    MeshFile same = f;
    const DataReport nothing = update(same, *loaded, loaded->mesh);
    EXPECT_EQ(nothing.points, n);
    EXPECT_EQ(nothing.points_moved + nothing.points_inserted + nothing.triangles_changed, 0u);
    EXPECT_EQ(nothing.distance.max, 0);
    expect_same_data(same.point_data, f.point_data, "point data");
    expect_same_data(same.triangles.data, f.triangles.data, "cell data");
  }
  VertexId inner(0);
  while (loaded->mesh.is_boundary(inner)) inner = VertexId(inner.index + 1);
  const Vec2 step{0x1p-12, 0};
  loaded->mesh.set_position(inner, loaded->mesh.position(inner) + step);
  std::size_t degree = 0;
  for ([[maybe_unused]] const HalfedgeId h : loaded->mesh.star(inner)) ++degree;
  const DataReport report = update(f, *loaded, loaded->mesh);
  EXPECT_EQ(report.points, n);
  EXPECT_EQ(report.points_moved, 1u);
  EXPECT_NEAR(report.distance.max, 0x1p-12, 1e-15);
  EXPECT_EQ(report.triangles, m);
  EXPECT_EQ(report.triangles_changed, degree);
  MeshFile without = from_mesh(loaded->mesh);
  EXPECT_EQ(update(without, *loaded, loaded->mesh).points, 0u) << "there are no data";
}

TEST(DataRules, ThatMakeNoSenseAreRefusedByName) {
  const auto error = [](const std::vector<std::string>& words) {
    const auto rules = parse_data_rules(words);
    if (!rules) return rules.error().message;
    const auto checked = check_data_rules(*rules, file_with_data().point_data);
    return checked ? std::string() : checked.error().message;
  };
  EXPECT_EQ(error({}), "");
  EXPECT_EQ(error({"keep", "interpolate=depth", "keep=id"}), "");
  EXPECT_EQ(error({"keep=node"}), "");
  EXPECT_EQ(error({"drop"}), "'drop' is not interpolate, keep, conserve, or one of these with =NAME");
  EXPECT_EQ(error({"keep="}), "'keep=' is not interpolate, keep, conserve, or one of these with =NAME");
  EXPECT_EQ(error({"sample"}), "'sample' is not interpolate, keep, conserve, or one of these with =NAME");
  EXPECT_EQ(error({"conserve=node"}),
            "point data 'node' are integers (int32), of which there are no means: only floating point data are "
            "conserved");
  EXPECT_EQ(error({"keep", "interpolate"}), "'interpolate' contradicts what was said before it");
  EXPECT_EQ(error({"keep=id", "interpolate=id"}), "'interpolate=id' contradicts what was said before it");
  EXPECT_EQ(error({"keep=dept"}), "there is no point data 'dept'; there are: depth, coarse, node, id");
  EXPECT_EQ(error({"interpolate=node"}),
            "point data 'node' are integers (int32), which stay with their points: only floating point data are "
            "interpolated");
}

TEST(DataRules, AreMadeAgainFromTheirWords) {
  const auto again = [](const std::vector<std::string>& words, DataOf of) {
    return data_rule_words(*parse_data_rules(words, of));
  };
  using Words = std::vector<std::string>;
  EXPECT_EQ(again({}, DataOf::points), Words{"interpolate"});
  EXPECT_EQ(again({}, DataOf::cells), Words{"sample"});
  const Words points = {"keep", "interpolate=a", "conserve=b=c"}, cells = {"conserve", "sample=d"};
  EXPECT_EQ(again(points, DataOf::points), points);
  EXPECT_EQ(again(cells, DataOf::cells), cells);
}

TEST(DataRules, OfCellsAreSampleAndConserve) {
  MeshFile f = file_with_data();
  const auto error = [&](const std::vector<std::string>& words) {
    const auto rules = parse_data_rules(words, DataOf::cells);
    if (!rules) return rules.error().message;
    const auto checked = check_data_rules(*rules, f.triangles.data, DataOf::cells);
    return checked ? std::string() : checked.error().message;
  };
  EXPECT_EQ(error({"conserve", "sample=east"}), "");
  EXPECT_EQ(error({"keep"}), "'keep' is not sample, conserve, or one of these with =NAME");
  EXPECT_EQ(error({"conserve=west"}), "there is no cell data 'west'; there are: triangle, east");
  EXPECT_EQ(error({"sample=triangle"}), "");
  std::get<std::vector<double>>(f.triangles.data[1].values)[7] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(error({"conserve=east"}),
            "cell data 'east' have a value in row 7, counted from 0, that is not finite, so they have no integral. "
            "Next: sample=east");
}

/// Integrals over each region of cell data, and of point data over power cells.
std::map<std::int32_t, double> integrals_of(const Mesh& mesh, const std::vector<double>& values, bool of_points,
                                            std::size_t n = 1, std::size_t component = 0) {
  const CellOverlaps table = overlaps(mesh, mesh, of_points ? CellsOf::vertices : CellsOf::triangles);
  std::map<std::int32_t, double> sums;
  for (const CellPart& part : table.parts) sums[part.region] += part.size * values[n * part.cell + component];
  return sums;
}

TEST(ConservedData, KeepTheirIntegralsWhateverAnOptimizationDoes) {
  DataRules points, cells;
  points.rule = cells.rule = DataRule::conserve;
  for (const bool splits : {false, true}) {
    MeshFile file = file_with_data(splits ? *horseshoe() : *random_mesh({.vertices = 150, .seed = 3}));
    file.triangles.tags.clear();
    for (const auto& corners : file.triangles) {
      const double middle =
          file.points[static_cast<std::size_t>(corners[0])].x + file.points[static_cast<std::size_t>(corners[1])].x;
      file.triangles.tags.push_back(middle < 4 ? 1 : 2);
    }
    const MeshFile original = file;
    const auto loaded = make_mesh(file);
    ASSERT_TRUE(loaded);
    Mesh mesh = loaded->mesh;
    OptimizeOptions options;
    if (splits) options.boundary = BoundaryVertices::split;
    const auto run = optimize(mesh, options);
    ASSERT_TRUE(run);
    const DataReport report = update(file, *loaded, mesh, run->vertices, {points, nullptr, cells});
    EXPECT_EQ(report.conserved, (std::vector<std::string>{"depth", "coarse", "id"}));
    EXPECT_EQ(report.conserved_of_triangles, std::vector<std::string>{"east"});
    EXPECT_EQ(report.of_triangles, std::vector<std::string>{"triangle"});
    EXPECT_LT(report.integral_change, 1e-14);
    EXPECT_EQ(report.out_of_range, 0);
    const auto expect_same = [](const auto& before, const auto& after, double rounding) {
      ASSERT_EQ(before.size(), after.size());
      for (const auto& [region, sum] : before) EXPECT_NEAR(after.at(region), sum, 1e3 * rounding);  // values to 100
    };
    for (const char* name : {"depth", "id"}) {
      expect_same(integrals_of(loaded->mesh, values<double>(original.point_data, name), true),
                  integrals_of(mesh, values<double>(file.point_data, name), true), kRounding);
    }
    const auto& former = values<float>(original.point_data, "coarse");
    const auto& now = values<float>(file.point_data, "coarse");
    for (const std::size_t k : {0u, 1u}) {
      expect_same(integrals_of(loaded->mesh, {former.begin(), former.end()}, true, 2, k),
                  integrals_of(mesh, {now.begin(), now.end()}, true, 2, k), kFloatRounding);
    }
    expect_same(integrals_of(loaded->mesh, values<double>(original.triangles.data, "east"), false),
                integrals_of(mesh, values<double>(file.triangles.data, "east"), false), kRounding);
    const auto [least, most] = std::ranges::minmax(values<double>(original.triangles.data, "east"));
    for (const double x : values<double>(file.triangles.data, "east")) EXPECT_TRUE(x >= least && x <= most);
  }
}

TEST(ConservedData, WithAMissingValueAreInterpolatedOrSampledWithAWarning) {
  MeshFile file = file_with_data();
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::get<std::vector<double>>(file.point_data[0].values)[3] = kNone;
  std::get<std::vector<double>>(file.triangles.data[1].values)[3] = kNone;
  DataRules rules;
  rules.rule = DataRule::conserve;
  const auto loaded = make_mesh(file);
  Mesh mesh = loaded->mesh;
  ASSERT_TRUE(optimize(mesh, {}));
  const DataReport report = update(file, *loaded, mesh, {}, {rules, nullptr, rules});
  EXPECT_EQ(report.interpolated, std::vector<std::string>{"depth"});
  EXPECT_EQ(report.conserved, (std::vector<std::string>{"coarse", "id"}));
  EXPECT_EQ(report.of_triangles, (std::vector<std::string>{"triangle", "east"}));
  EXPECT_EQ(file.warnings,
            (std::vector<std::string>{
                "'east' has a value that is not finite, so it is sampled, and its integrals change",
                "'depth' has a value that is not finite, so it is interpolated, and its integrals change"}));
}

TEST(DataUpdate, AMissingValueSpreadsHalfWayToTheNextCorners) {
  MeshFile f;
  f.points = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {2, 2}};
  f.triangles.corners = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  f.point_data = {{"depth", 1, std::vector<double>{kNone, 6, 6, 6, 8}}};
  const auto value_at = [&](Vec2 p) {
    MeshFile file = f;
    auto loaded = make_mesh(file);
    loaded->mesh.set_point(VertexId(4), {p.x, p.y, 0});
    update(file, *loaded, loaded->mesh);
    return std::get<std::vector<double>>(file.point_data[0].values)[4];
  };
  EXPECT_EQ(value_at({2, 2}), 8);
  EXPECT_EQ(value_at({3, 2}), 7) << "without the missing corner nothing changes";
  EXPECT_TRUE(std::isnan(value_at({0.9, 0.9}))) << "nearer to the missing corner";
  EXPECT_EQ(value_at({1.1, 1.1}), 8) << "on the edge from it, nearer to the other end";
  EXPECT_TRUE(value_at({2, 1.2}) >= 6 && value_at({2, 1.2}) <= 8) << "a quarter is missing";
}

}  // namespace
}  // namespace temper::io
