// Names, tags and marked points on their way from an outline to a mesh, to a file, to an optimized mesh: each group has
// the same points, the same length and the same area everywhere, and wells keep their place bit for bit.
#include <map>
#include <set>
#include <utility>

#include "io/formats/format.hpp"
#include "support.hpp"
#include "temper/detail/dec_io.hpp"
#include "temper/generate.hpp"
#include "temper/mesher.hpp"

namespace temper::io {
namespace {

/// Two fields with a common border. On the border a line with its own tag, on the boundary an open sea; a river, wells,
/// and a gauge at the place of a well.
constexpr std::string_view kValley = R"({"type": "FeatureCollection", "crs": "EPSG:25832", "features": [
{"type": "Feature", "properties": {"name": "sand", "tag": 3}, "geometry":
 {"type": "Polygon", "coordinates": [[[0, 0], [8, 0], [8, 9], [0, 9], [0, 0]]]}},
{"type": "Feature", "properties": {"name": "clay"}, "geometry":
 {"type": "Polygon", "coordinates": [[[8, 0], [14, 0], [14, 9], [8, 9], [8, 0]]]}},
{"type": "Feature", "properties": {"name": "fault"}, "geometry":
 {"type": "LineString", "coordinates": [[8, 2], [8, 7]]}},
{"type": "Feature", "properties": {"name": "open sea", "tag": 5}, "geometry":
 {"type": "LineString", "coordinates": [[0, 9], [0, 0]]}},
{"type": "Feature", "properties": {"name": "M\u00fchlbach \ud83d\ude00"}, "geometry":
 {"type": "LineString", "coordinates": [[1, 1], [5, 4.5], [6, 7]]}},
{"type": "Feature", "properties": {"name": "wells", "tag": 7}, "geometry":
 {"type": "MultiPoint", "coordinates": [[3.1, 6.2], [10.3, 4.1], [10.9, 4.4]]}},
{"type": "Feature", "properties": {"name": "gauge"}, "geometry": {"type": "Point", "coordinates": [10.3, 4.1]}},
{"type": "Feature", "properties": {}, "geometry": {"type": "Point", "coordinates": [12.2, 7.3]}}]})";

using Group = std::pair<int, std::int32_t>;  // dimension and tag
/// The number of points, the length or the area of each group.
std::map<Group, double> measures(const MeshFile& f) {
  std::map<Group, double> sums;
  const auto at = [&](std::int32_t p) { return f.points[static_cast<std::size_t>(p)]; };
  for (const std::int32_t tag : f.marked_points.tags) sums[{0, tag}] += 1;
  for (std::size_t i = 0; i < f.lines.size(); ++i)
    sums[{1, f.lines.tags[i]}] += length(at(f.lines[i][1]) - at(f.lines[i][0]));
  for (std::size_t t = 0; t < f.triangles.tags.size(); ++t) {
    const auto [a, b, c] = f.triangles[t];
    sums[{2, f.triangles.tags[t]}] += 0.5 * cross(at(b) - at(a), at(c) - at(a));
  }
  return sums;
}

void expect_near(const std::map<Group, double>& found, const std::map<Group, double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (const auto& [group, measure] : expected) {
    ASSERT_TRUE(found.contains(group)) << group.first << " " << group.second;
    EXPECT_NEAR(found.at(group), measure, 1e-12 * measure) << group.first << " " << group.second;
  }
}

std::set<std::pair<double, double>> marked_places(const MeshFile& f) {
  std::set<std::pair<double, double>> places;
  for (const std::int32_t p : f.marked_points) {
    const Vec2 at = f.points[static_cast<std::size_t>(p)];
    places.emplace(at.x, at.y);
  }
  return places;
}

class Groups : public FileTest, public ::testing::WithParamInterface<std::string> {
 protected:
  MeshFile valley() const {
    const auto outline = read_outline(make("valley.geojson", kValley));
    EXPECT_TRUE(outline) << outline.error().what();
    MesherOptions options;
    options.size = 1;
    options.optimize.reset();
    const auto made = mesh_outline(outline->outline, options);
    EXPECT_TRUE(made) << made.error().what();
    return from_outline(*made);
  }
};

TEST_F(Groups, OfAnOutlineHaveTheirMeasuresInItsMesh) {
  const MeshFile f = valley();
  const std::map<Group, double> expected = {{{0, 7}, 3},
                                            {{0, 10}, 1},
                                            {{0, 12}, 1},  // wells, gauge, the point without a tag
                                            {{1, 1}, 21},
                                            {{1, 3}, 34},
                                            {{1, 5}, 9},
                                            {{1, 8}, 5},  // boundary, sand, open sea, fault
                                            {{1, 9}, std::hypot(4, 3.5) + std::hypot(1, 2.5)},  // river
                                            {{2, 1}, 72},
                                            {{2, 2}, 54}};  // sand, clay
  expect_near(measures(f), expected);
  std::map<Group, std::string> names;
  for (const PhysicalName& n : f.names) names[{n.dimension, n.tag}] = n.name;
  EXPECT_EQ(names, (std::map<Group, std::string>{{{0, 7}, "wells"},
                                                 {{0, 10}, "gauge"},
                                                 {{1, 3}, "sand"},
                                                 {{1, 5}, "open sea"},
                                                 {{1, 8}, "fault"},
                                                 {{1, 9}, "M\u00fchlbach \U0001F600"},
                                                 {{2, 1}, "sand"},
                                                 {{2, 2}, "clay"}}));
  EXPECT_EQ(marked_places(f), (std::set<std::pair<double, double>>{{3.1, 6.2}, {10.3, 4.1}, {10.9, 4.4}, {12.2, 7.3}}));
}

TEST_P(Groups, SurviveWritingReadingAndOptimizing) {
  const FormatRow& row = *find_row(GetParam());
  const std::string name = "m" + std::string(row.suffixes.substr(0, row.suffixes.find(' ')));
  const MeshFile before = valley();
  std::string warnings;
  const auto write_and_read = [&](const MeshFile& f) {
    const auto written = write(path(name), f, {GetParam(), {}});
    EXPECT_TRUE(written) << written.error().what();
    for (const std::string& warning : *written) warnings += warning + "\n";
    return *read(path(name));
  };
  MeshFile f = write_and_read(before);
  auto loaded = make_mesh(f);
  ASSERT_TRUE(loaded) << loaded.error().what();
  OptimizeOptions options;
  options.max_sweeps = 20;
  const Mesh was = loaded->mesh;
  const auto report = optimize(loaded->mesh, options);
  ASSERT_TRUE(report) << report.error().what();
  std::size_t moved = 0;
  for (const VertexId v : was.vertices()) moved += was.position(v) == loaded->mesh.position(v) ? 0 : 1;
  EXPECT_GT(moved, 20u);
  update(f, *loaded, loaded->mesh, report->vertices);
  const MeshFile after = write_and_read(f);

  const bool boundaries_alone = has_boundary_lines(GetParam()), one_tag = warnings.find("gauge; ") != std::string::npos;
  std::map<Group, double> expected = measures(before);
  if (one_tag) expected.erase({0, 10});  // the gauge at a well
  for (const auto& [dimension, content] : {std::pair(0, kMarkedPoints), std::pair(1, kLines), std::pair(2, kRegions)}) {
    const bool lost = (row.holds & content) == 0 || (boundaries_alone && (dimension == 1 || GetParam() != "mike"));
    if (lost) std::erase_if(expected, [d = dimension](const auto& each) { return each.first.first == d; });
  }
  std::map<Group, double> found = measures(after);
  std::erase_if(
      found, [&](const auto& each) { return (boundaries_alone && each.first.first == 1) || each.first.second == 0; });
  expect_near(found, expected);
  if (expected.contains({0, 7})) {
    EXPECT_EQ(marked_places(after), marked_places(before));
  }
  for (const PhysicalName& n : before.names) {
    const bool same = std::any_of(after.names.begin(), after.names.end(), [&](const PhysicalName& m) {
      return m.dimension == n.dimension && m.tag == n.tag && m.name == n.name;
    });
    EXPECT_TRUE(same || warnings.find(n.name) != std::string::npos) << n.name << "\n" << warnings;
  }
}

std::vector<std::string> written_formats() {
  std::vector<std::string> names;
  for (const Format& format : formats()) {
    if (writes_planes(format)) names.emplace_back(format.name);
  }
  return names;
}

INSTANTIATE_TEST_SUITE_P(Formats, Groups, ::testing::ValuesIn(written_formats()),
                         [](const auto& each) { return each.param; });

TEST_F(Groups, OfAnOutlineAreTheBoundariesOfFort14) {
  MeshFile f = valley();
  for (PhysicalName& n : f.names) {
    if (n.name == "sand" && n.dimension == 1) n.name = "dike";
  }
  const auto warnings = write(path("m.14"), f);
  ASSERT_TRUE(warnings) << warnings.error().what();
  std::string all;
  for (const std::string& warning : *warnings) all += warning + "\n";
  EXPECT_NE(
      all.find("tag 3, dike is not written for 10 edges of another boundary: fort.14 has an edge in one boundary"),
      std::string::npos)
      << all;
  const MeshFile g = *read(path("m.14"));
  std::map<std::string, double> lengths;
  const auto sums = measures(g);
  for (const PhysicalName& n : g.names) lengths[n.name] = sums.at({n.dimension, n.tag});
  EXPECT_NEAR(lengths.at("open boundary 1"), 9, 1e-12);
  double land = 0;
  for (const auto& [name, part] : lengths) land += name.starts_with("land boundary ") ? part : 0;
  EXPECT_NEAR(land, 2 * 8 + 21, 1e-12);
  ASSERT_TRUE(write(path("again.14"), g));
  EXPECT_EQ(slurp(path("again.14")), slurp(path("m.14")));
}

// --- marked points that are read ---------------------------------------------------------------------------------

std::vector<std::size_t> fixed_points(const MeshFile& f) {
  const auto loaded = make_mesh(f);
  EXPECT_TRUE(loaded) << loaded.error().what();
  std::vector<std::size_t> fixed;
  for (const VertexId v : loaded->mesh.vertices()) {
    if (loaded->mesh.is_fixed(v)) fixed.push_back(v.index);
  }
  return fixed;
}

TEST(MarkedPoints, AreFixedUnlessTheyListVertices) {
  MeshFile plain = from_mesh(*sheared_grid({4, 4, 0.25}));  // 5 × 5 points
  std::vector<std::int32_t> all, boundary;
  for (std::int32_t p = 0; p < 25; ++p) {
    all.push_back(p);
    if (p % 5 == 0 || p % 5 == 4 || p < 5 || p >= 20) boundary.push_back(p);
  }
  const auto with = [&](std::vector<std::int32_t> points, std::vector<std::int32_t> tags) {
    MeshFile f = plain;
    f.marked_points.corners = std::move(points);
    f.marked_points.tags = std::move(tags);
    return f;
  };
  using Fixed = std::vector<std::size_t>;
  EXPECT_EQ(fixed_points(with({12, 7}, {3, 4})), (Fixed{7, 12}));
  EXPECT_EQ(fixed_points(with({12, 7}, {3, 0})), (Fixed{12})) << "0 is no tag";
  EXPECT_EQ(fixed_points(with(all, std::vector<std::int32_t>(25, 1))), Fixed{}) << "gmsh -save_all";
  std::vector<std::int32_t> different;
  for (std::int32_t p = 0; p < 25; ++p) different.push_back(p % 3 + 1);
  EXPECT_EQ(fixed_points(with(all, different)), Fixed{});
  std::vector<std::int32_t> points = boundary, tags(boundary.size(), 1);
  points.insert(points.end(), {12, 6});
  tags.insert(tags.end(), {2, 1});
  EXPECT_EQ(fixed_points(with(points, tags)), (Fixed{12})) << "Triangle marks the boundary, and the user a well";
  MeshFile levee = with({6, 7, 8}, {9, 9, 9});
  levee.lines.corners = {{5, 6}, {6, 11}};
  levee.lines.tags = {9, 9};
  EXPECT_EQ(fixed_points(levee), Fixed{}) << "the points of a line";
  levee.names = {{0, 9, "gauges"}};
  EXPECT_EQ(fixed_points(levee), (Fixed{6, 7, 8})) << "their own name says otherwise";
}

// --- cells of groups -----------------------------------------------------------------------------------------------

/// The vertex with the least power distance.
VertexId owner(const Mesh& mesh, Vec2 at) {
  VertexId best(0);
  const auto power = [&](VertexId v) { return squared_length(mesh.position(v) - at) - mesh.weight(v); };
  for (const VertexId v : mesh.vertices()) {
    if (power(v) < power(best)) best = v;
  }
  return best;
}

TEST_F(Groups, HaveTheCellsThatTheirPointsAndLinesAreIn) {
  const MeshFile f = valley();
  const auto loaded = make_mesh(f);
  ASSERT_TRUE(loaded);
  const Mesh& mesh = loaded->mesh;
  const std::vector<GroupCell> cells = cells_of_groups(f, *loaded, mesh);
  std::map<std::string, double> lengths, expected;
  std::map<std::pair<std::string, VertexId>, double> sampled, found;
  std::set<VertexId> wells;
  for (const GroupCell& cell : cells) {
    if (cell.kind == GroupKind::point) {
      if (cell.name == "wells") wells.insert(VertexId(cell.cell));
      continue;
    }
    lengths[cell.name] += cell.length;
    found[{cell.name, VertexId(cell.cell)}] += cell.length;
    if (cell.name == "sand") continue;  // on the boundary and inside
    EXPECT_EQ(cell.kind == GroupKind::boundary, cell.name == "open sea" || cell.name == "1") << cell.name;
  }
  constexpr int kSamples = 400;
  for (std::size_t i = 0; i < f.lines.size(); ++i) {
    const Vec2 a = f.points[static_cast<std::size_t>(f.lines[i][0])],
               b = f.points[static_cast<std::size_t>(f.lines[i][1])];
    std::string name = std::to_string(f.lines.tags[i]);
    for (const PhysicalName& n : f.names) name = n.dimension == 1 && n.tag == f.lines.tags[i] ? n.name : name;
    expected[name] += length(b - a);
    for (int k = 0; k < kSamples; ++k)
      sampled[{name, owner(mesh, a + ((k + 0.5) / kSamples) * (b - a))}] += length(b - a) / kSamples;
  }
  ASSERT_EQ(lengths.size(), expected.size());
  for (const auto& [name, whole] : expected) EXPECT_NEAR(lengths[name], whole, 1e-12 * whole) << name;
  for (const auto& [cell, part] : sampled)
    EXPECT_NEAR(found[cell], part, 0.02) << cell.first << " " << cell.second.index;
  EXPECT_EQ(wells, (std::set<VertexId>{owner(mesh, {3.1, 6.2}), owner(mesh, {10.3, 4.1}), owner(mesh, {10.9, 4.4})}));
}

//            2              The long edge passes through the cell of the obtuse corner: up to t = 17/16 it is nearer
//     0 ---------- 1        to point 0 at (0, 0), and then to point 2 at (2, 1/2).
//            3
TEST_F(Groups, HaveTheCellsOfThirdVerticesThatALinePasses) {
  MeshFile f;
  f.points = {{0, 0}, {4, 0}, {2, 0.5}, {2, -9}};
  f.triangles.corners = {{0, 1, 2}, {1, 0, 3}};
  f.lines.corners = {{1, 0}};
  f.lines.tags = {5};
  const auto loaded = make_mesh(f);
  ASSERT_TRUE(loaded);
  const std::vector<GroupCell> cells = cells_of_groups(f, *loaded, loaded->mesh);
  ASSERT_EQ(cells.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(cells[i].cell, i);
    EXPECT_EQ(cells[i].name, "5");
    EXPECT_NEAR(cells[i].length, i < 2 ? 17.0 / 16 : 30.0 / 16, 1e-12);
  }
}

}  // namespace
}  // namespace temper::io
