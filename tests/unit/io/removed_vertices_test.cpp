// Putting back a mesh that has fewer vertices than its file, or more: in every format the points that are left keep all
// that they had, and new ones get what is around them.
#include <map>
#include <utility>

#include "io/formats/format.hpp"
#include "support.hpp"
#include "temper/generate.hpp"
#include "temper/topology.hpp"

namespace temper::io {
namespace {

constexpr int kSquares = 6;

/// A grid of 7 × 7 points in two halves, its bottom and the line between the halves tagged, with data on everything.
MeshFile grid() {
  MeshFile f = from_mesh(*sheared_grid({kSquares, kSquares, 0.25}));
  const auto at = [](int x, int y) { return y * (kSquares + 1) + x; };
  f.triangles.tags.clear();
  std::vector<std::int32_t> material, number;
  for (std::size_t t = 0; t < f.triangles.size(); ++t) {
    int low = kSquares;
    for (const std::int32_t p : f.triangles[t]) low = std::min(low, p % (kSquares + 1));
    f.triangles.tags.push_back(low < kSquares / 2 ? 1 : 2);
    material.push_back(10 * f.triangles.tags.back());
    number.push_back(static_cast<std::int32_t>(t));
  }
  f.lines.corners.clear();
  f.lines.tags.clear();
  for (int i = 0; i < kSquares; ++i) {
    f.lines.corners.push_back({at(i, 0), at(i + 1, 0)});
    f.lines.tags.push_back(4);
    f.lines.corners.push_back({at(kSquares / 2, i), at(kSquares / 2, i + 1)});
    f.lines.tags.push_back(9);
  }
  f.marked_points.corners = {at(0, 0), at(2, 2)};
  f.marked_points.tags = {11, 12};
  std::vector<double> temperature, id;
  f.weights.resize(f.points.size());
  for (std::size_t p = 0; p < f.points.size(); ++p) {
    f.weights[p] = 1e-3 * static_cast<double>(p % 5) / 3;
    temperature.push_back(1.0 / (3.0 + static_cast<double>(p)));
    id.push_back(static_cast<double>(p));
  }
  f.point_data = {{"temperature", 1, temperature}, {"id", 1, id}};
  f.triangles.data = {{"material", 1, material}, {"number", 1, number}};
  return f;
}

/// Takes vertices out of the mesh; returns the numbers of those that are left.
IdVector<VertexId, VertexId> remove(Mesh& mesh, const std::vector<std::size_t>& gone) {
  for (const std::size_t v : gone) {
    mesh.set_fixed(VertexId(v), false);  // marked points are
    const RemovalPlan plan = plan_removal(mesh, VertexId(v));
    EXPECT_EQ(plan.status, RemovalStatus::possible) << v;
    if (plan.status == RemovalStatus::possible) remove_vertex(mesh, plan);
  }
  return mesh.compact().vertices;
}

const DataArray* find_data(const std::vector<DataArray>& arrays, const std::string& name) {
  for (const DataArray& a : arrays) {
    if (a.name == name) return &a;
  }
  return nullptr;
}

using Place = std::pair<double, double>;
using Line = std::pair<Place, Place>;
Place place(const MeshFile& f, std::int32_t p) {
  const Vec2 at = f.points[static_cast<std::size_t>(p)];
  return {at.x, at.y};
}
std::map<Line, std::int32_t> tagged_lines(const MeshFile& f) {
  std::map<Line, std::int32_t> lines;
  for (std::size_t i = 0; i < f.lines.size(); ++i) {
    Line line = {place(f, f.lines[i][0]), place(f, f.lines[i][1])};
    if (line.second < line.first) std::swap(line.first, line.second);
    lines[line] = f.lines.tags[i];
  }
  return lines;
}

class RemovedVertices : public FileTest, public ::testing::WithParamInterface<std::string> {};

TEST_P(RemovedVertices, TheOthersKeepTheirDataTagsAndWeights) {
  // A format that has no place for some data loses it in the first writing: what is compared is what it read.
  const WriteOptions options{GetParam(), {}};
  const std::string name = GetParam() == "triangle" ? "m.node" : "m." + GetParam();
  ASSERT_TRUE(write(path(name), grid(), options));
  auto file = read(path(name));
  ASSERT_TRUE(file) << file.error().what();
  const MeshFile before = *file;
  auto loaded = make_mesh(*file);
  ASSERT_TRUE(loaded) << loaded.error().what();
  release_geometry(*file, *loaded);
  constexpr std::size_t kRow = kSquares + 1;
  // Three inner vertices, one of them marked; one on the bottom; one on the straight line between the regions.
  const auto left = remove(loaded->mesh, {kRow + 1, 2 * kRow + 2, 4 * kRow + 5, 2, 3 * kRow + kSquares / 2});
  update(*file, *loaded, loaded->mesh, left);
  ASSERT_TRUE(write(path("out." + name), *file, options));
  const auto again = read(path("out." + name));
  ASSERT_TRUE(again) << again.error().what();

  ASSERT_EQ(again->points.size(), before.points.size() - 5);
  std::map<Place, std::size_t> old;
  for (std::size_t p = 0; p < before.points.size(); ++p) old[place(before, static_cast<std::int32_t>(p))] = p;
  ASSERT_EQ(again->point_data.size(), before.point_data.size());
  for (std::size_t p = 0; p < again->points.size(); ++p) {
    const auto found = old.find(place(*again, static_cast<std::int32_t>(p)));
    ASSERT_NE(found, old.end());
    EXPECT_EQ(again->weights[p], before.weights[found->second]);
    for (const DataArray& a : before.point_data) {
      const DataArray* b = find_data(again->point_data, a.name);
      ASSERT_NE(b, nullptr) << a.name;
      ASSERT_EQ(a.values.index(), b->values.index()) << a.name;
      std::visit(
          [&](const auto& values) {
            using Vector = std::remove_cvref_t<decltype(values)>;
            EXPECT_EQ(std::get<Vector>(b->values)[p], values[found->second]) << a.name;
          },
          a.values);
    }
  }
  if ((find_row(GetParam())->holds & kRegions) != 0) {
    EXPECT_EQ(again->triangles.tags.size(), again->triangles.size());
  }

  auto lines = tagged_lines(before);
  const auto lines_again = tagged_lines(*again);
  const std::int32_t row = kRow, half = kSquares / 2;
  const Line bottom = {place(before, 1), place(before, 3)},
             middle = {place(before, 2 * row + half), place(before, 4 * row + half)},
             inner = {place(before, 2 * row + half), place(before, 3 * row + half)};
  const bool holds_inner = lines.contains(inner);
  EXPECT_EQ(holds_inner, !lines.empty() && !has_boundary_lines(GetParam()));
  const std::int32_t bottom_tag = lines.empty() ? 0 : lines.at({place(before, 1), place(before, 2)});
  if (!lines.empty() && GetParam() != "adcirc") {  // which numbers its boundaries itself
    EXPECT_EQ(bottom_tag, 4);
  }
  for (const auto& [line, tag] : lines_again) {
    if (line == bottom || line == middle) {
      EXPECT_EQ(tag, line == bottom ? bottom_tag : 9);
    } else {
      ASSERT_TRUE(lines.contains(line));
      EXPECT_EQ(tag, lines[line]);
    }
  }
  if (!lines.empty()) {
    EXPECT_EQ(lines_again.size(), lines.size() - (holds_inner ? 2 : 1)) << "two lines are one, twice";
    EXPECT_EQ(lines_again.count(bottom), 1u);
    EXPECT_EQ(lines_again.count(middle), holds_inner ? 1u : 0u);
  }
  if (!before.marked_points.empty()) {
    ASSERT_EQ(again->marked_points.size(), 1u);
    EXPECT_EQ(place(*again, again->marked_points[0]), place(before, 0));
  }
}

std::vector<std::string> written_formats() {
  std::vector<std::string> names;
  for (const Format& format : formats()) {
    if (writes_planes(format)) names.emplace_back(format.name);
  }
  return names;
}

INSTANTIATE_TEST_SUITE_P(Formats, RemovedVertices, ::testing::ValuesIn(written_formats()),
                         [](const auto& test) { return test.param; });

// --- inserted vertices ----------------------------------------------------------------------------------------

/// Splits the bottom and the interface, inserts a vertex, removes two; what OptimizeReport::vertices would say.
struct InsertedAndRemoved {
  IdVector<VertexId, VertexId> vertices;
  Vec2 on_bottom, on_line, inside;
};
InsertedAndRemoved insert_and_remove(Mesh& mesh) {
  constexpr std::size_t kRow = kSquares + 1, kHalf = kSquares / 2;
  const std::size_t n = mesh.n_vertices();
  const auto split = [&](std::size_t a, std::size_t b, double t) {
    HalfedgeId h = mesh.find_halfedge(VertexId(a), VertexId(b));
    if (!h.valid()) h = mesh.find_halfedge(VertexId(b), VertexId(a));
    const InsertionPlan plan = plan_split(mesh, h, t);
    EXPECT_TRUE(plan.status == InsertionStatus::possible || plan.status == InsertionStatus::not_regular);
    return mesh.position(insert_vertex(mesh, plan));
  };
  InsertedAndRemoved changed;
  changed.on_bottom = split(1, 2, 0.5);
  split(n, 2, 0.5);  // the right half once more
  changed.on_line = split(2 * kRow + kHalf, 3 * kRow + kHalf, 0.25);
  const auto [a, b, c] = mesh.corners(Mesh::triangle(mesh.outgoing(VertexId(4 * kRow + 1))));
  const Vec2 middle = (1.0 / 3) * (mesh.position(a) + mesh.position(b) + mesh.position(c));
  const VertexId v =
      insert_in_triangle(mesh, Mesh::triangle(mesh.outgoing(VertexId(4 * kRow + 1))), {middle.x, middle.y, 0.001});
  changed.inside = middle;
  mesh.set_weight(v, 0.001);
  changed.vertices = remove(mesh, {kRow + 1, 4});
  for (VertexId& old : changed.vertices) {
    if (old.index >= n) old = VertexId();
  }
  return changed;
}

std::size_t index_of(const MeshFile& f, Vec2 p) {
  const auto found = std::find(f.points.begin(), f.points.end(), p);
  EXPECT_NE(found, f.points.end());
  return static_cast<std::size_t>(found - f.points.begin());
}

Vec2 end_of(const MeshFile& f, std::int32_t p) { return f.points[static_cast<std::size_t>(p)]; }
Vec2 middle_of(const MeshFile& f, const std::array<std::int32_t, 2>& line) {
  return 0.5 * (end_of(f, line[0]) + end_of(f, line[1]));
}
/// Says whether the file has a line of that tag that the place is on.
bool is_on_a_line_of_tag(const MeshFile& f, Vec2 at, std::int32_t tag) {
  for (std::size_t i = 0; i < f.lines.size(); ++i) {
    const Vec2 a = end_of(f, f.lines[i][0]), b = end_of(f, f.lines[i][1]);
    if (f.lines.tags[i] == tag && length(at - a) + length(b - at) < length(b - a) + 1e-12) return true;
  }
  return false;
}

class InsertedVertices : public FileTest, public ::testing::WithParamInterface<std::string> {};

TEST_P(InsertedVertices, GetDataAndCutLinesKeepTheirTagOnAllPieces) {
  const WriteOptions options{GetParam(), {}};
  const std::string name = GetParam() == "triangle" ? "m.node" : "m." + GetParam();
  MeshFile f = grid();
  std::vector<double> linear;
  for (const Vec2 p : f.points) linear.push_back(2 * p.x - 3 * p.y + 1);
  f.point_data.push_back({"linear", 1, linear});
  ASSERT_TRUE(write(path(name), f, options));
  auto file = read(path(name));
  ASSERT_TRUE(file) << file.error().what();
  const MeshFile before = *file;
  auto loaded = make_mesh(*file);
  ASSERT_TRUE(loaded) << loaded.error().what();
  const InsertedAndRemoved changed = insert_and_remove(loaded->mesh);
  update(*file, *loaded, loaded->mesh, changed.vertices);
  ASSERT_TRUE(write(path("out." + name), *file, options));
  const auto again = read(path("out." + name));
  ASSERT_TRUE(again) << again.error().what();
  ASSERT_EQ(again->points.size(), before.points.size() + 2);
  EXPECT_TRUE(make_mesh(*again));

  for (std::size_t p = 0; p < again->points.size(); ++p) {
    EXPECT_EQ(again->points[p], loaded->mesh.position(VertexId(p)));
    EXPECT_EQ(again->weights[p], loaded->mesh.weight(VertexId(p)));
  }
  if (const DataArray* values = find_data(again->point_data, "linear")) {
    for (std::size_t p = 0; p < again->points.size(); ++p) {
      const Vec2 at = again->points[p];
      EXPECT_NEAR(std::get<std::vector<double>>(values->values)[p], 2 * at.x - 3 * at.y + 1, 1e-12);
    }
  } else {
    EXPECT_EQ(find_data(before.point_data, "linear"), nullptr);
  }
  if (before.lines.empty()) return;
  const bool adcirc = GetParam() == "adcirc";  // numbers its boundaries itself
  const bool boundaries_alone = has_boundary_lines(GetParam());
  const auto lines = tagged_lines(*again);
  EXPECT_EQ(lines.size(), tagged_lines(before).size() + (boundaries_alone ? 2 : 3) - 1)
      << "three pieces more, and one line of two";
  const auto tag_between = [&](std::size_t a, std::size_t b) {
    Line line = {place(*again, static_cast<std::int32_t>(a)), place(*again, static_cast<std::int32_t>(b))};
    if (line.second < line.first) std::swap(line.first, line.second);
    const auto found = lines.find(line);
    return found == lines.end() ? -1 : found->second;
  };
  const std::size_t bottom = index_of(*again, changed.on_bottom), middle = index_of(*again, changed.on_line);
  EXPECT_EQ(tag_between(1, bottom), adcirc ? tagged_lines(before).at({place(before, 1), place(before, 2)}) : 4);
  EXPECT_EQ(tag_between(1, 2), -1);
  if (boundaries_alone) return;
  for (std::size_t i = 0; i < again->lines.size(); ++i) {
    EXPECT_TRUE(is_on_a_line_of_tag(before, middle_of(*again, again->lines[i]), again->lines.tags[i])) << "line " << i;
  }
  constexpr std::size_t kRow = kSquares + 1, kHalf = kSquares / 2;
  EXPECT_EQ(tag_between(index_of(*again, before.points[2 * kRow + kHalf]), middle), 9);
  EXPECT_EQ(tag_between(middle, index_of(*again, before.points[3 * kRow + kHalf])), 9);
}

INSTANTIATE_TEST_SUITE_P(Formats, InsertedVertices, ::testing::ValuesIn(written_formats()),
                         [](const auto& test) { return test.param; });

TEST_F(FileTest, IntegersOfInsertedPointsAreWhatIsCommonAroundOrDroppedAndNamed) {
  MeshFile f = grid();
  const std::size_t n = f.points.size();
  std::vector<std::int32_t> side(n), number(n);
  for (std::size_t p = 0; p < n; ++p) side[p] = 7, number[p] = static_cast<std::int32_t>(p);
  std::vector<std::uint8_t> required(n, 0);
  required[1] = 1;
  f.point_data = {{"side", 1, side}, {"number", 1, number}, {"medit:required", 1, required}};
  auto loaded = make_mesh(f);
  ASSERT_TRUE(loaded);
  const InsertedAndRemoved changed = insert_and_remove(loaded->mesh);
  update(f, *loaded, loaded->mesh, changed.vertices);
  ASSERT_EQ(f.point_data.size(), 2u);
  EXPECT_EQ(std::get<std::vector<std::int32_t>>(f.point_data[0].values), std::vector<std::int32_t>(n + 2, 7));
  const auto& flags = std::get<std::vector<std::uint8_t>>(f.point_data[1].values);
  EXPECT_EQ(flags.size(), n + 2);
  EXPECT_EQ(std::count(flags.begin(), flags.end(), 1), 1);
  EXPECT_EQ(f.warnings.at(0), "data are dropped, because integers differ around a new point: number");
}

TEST_F(FileTest, MarkersOfBoundaryPointsGoToPointsBetweenThemWhereFormatsMarkTheBoundary) {
  for (const char* format : {"triangle", "medit", "gmsh41"}) {
    MeshFile f = grid();
    f.format = format;
    f.marked_points.corners.clear();
    f.marked_points.tags.clear();
    for (int i = 0; i <= kSquares; ++i)
      f.marked_points.corners.push_back(i), f.marked_points.tags.push_back(i < 2 ? 5 : 6);
    f.marked_points.tags[1] = 6;
    auto loaded = make_mesh(f);
    ASSERT_TRUE(loaded);
    const InsertedAndRemoved changed = insert_and_remove(loaded->mesh);
    update(f, *loaded, loaded->mesh, changed.vertices);
    const std::string_view name = format;
    const std::size_t more = name == "gmsh41" ? 0 : 2;
    EXPECT_EQ(f.marked_points.size(), kSquares + more) << format;  // one of the bottom was removed
    EXPECT_EQ(f.marked_points.tags.size(), f.marked_points.size());
    EXPECT_EQ(f.marked_points.tags.back(), 6);
  }
}

// Between them groups would change their shape if it slid.
TEST_F(FileTest, PointsOfStraightBoundariesWhereTagsEndOrChangeAreFixed) {
  MeshFile f = grid();
  f.marked_points.corners.clear(), f.marked_points.tags.clear();
  f.lines.tags[6] = 5;  // bottom and middle alternate: the fourth piece of the bottom
  f.lines.corners.pop_back(), f.lines.tags.pop_back();
  f.lines.corners.pop_back(), f.lines.tags.pop_back();  // the last piece of the bottom
  const auto loaded = make_mesh(f);
  ASSERT_TRUE(loaded) << loaded.error().what();
  std::vector<std::size_t> fixed;
  for (const VertexId v : loaded->mesh.vertices()) {
    if (loaded->mesh.is_fixed(v)) fixed.push_back(v.index);
  }
  EXPECT_EQ(fixed, (std::vector<std::size_t>{3, 4, 5}));
}

/// Adds a second tag to the lines of tag 4: the bottom.
void tag_the_bottom_twice(MeshFile& f) {
  const std::size_t n = f.lines.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (f.lines.tags[i] != 4) continue;
    f.lines.corners.push_back(f.lines[i]);
    f.lines.tags.push_back(6);
  }
}

TEST_F(FileTest, EachTagOfAnEdgeFollowsVerticesThatGoOrCome) {
  MeshFile f = grid();
  tag_the_bottom_twice(f);
  f.marked_points.corners.clear(), f.marked_points.tags.clear();
  auto loaded = make_mesh(f);
  ASSERT_TRUE(loaded);
  for (const VertexId v : loaded->mesh.vertices()) EXPECT_FALSE(loaded->mesh.is_fixed(v)) << "both tags go on";
  const InsertedAndRemoved changed = insert_and_remove(loaded->mesh);
  update(f, *loaded, loaded->mesh, changed.vertices);
  std::map<std::int32_t, std::vector<std::array<std::int32_t, 2>>> lines;
  for (std::size_t i = 0; i < f.lines.size(); ++i) lines[f.lines.tags[i]].push_back(f.lines[i]);
  EXPECT_EQ(lines.at(4).size(), kSquares + 2u - 1) << "two vertices more and one less";
  EXPECT_EQ(lines.at(6), lines.at(4));
}

// --- vertices of which nobody says what they were ----------------------------------------------------------------

/// A sphere with a line of one tag around it, marked points, weights, and data of all kinds.
MeshFile rich_globe() {
  MeshFile f = from_mesh(*icosahedral({.level = 3, .radius = 6371220}));
  std::vector<double> height;
  std::vector<std::int32_t> basin, number;
  f.weights.resize(f.points.size());
  for (std::size_t p = 0; p < f.points.size(); ++p) {
    f.weights[p] = 1e8 * static_cast<double>(p % 7);
    height.push_back(f.sphere()->places[p].z);
    basin.push_back(4);
  }
  for (std::size_t t = 0; t < f.triangles.size(); ++t) number.push_back(static_cast<std::int32_t>(t));
  f.point_data = {{"height", 1, height}, {"basin", 1, basin}};
  f.triangles.data = {{"number", 1, number}};
  f.lines.corners.clear(), f.lines.tags.clear();
  std::vector<double> wall;
  for (std::size_t t = 0; t < 40; ++t) {
    f.lines.corners.push_back({f.triangles[t][0], f.triangles[t][1]});
    f.lines.tags.push_back(static_cast<std::int32_t>(t % 3));
    wall.push_back(static_cast<double>(t));
  }
  f.lines.data = {{"wall", 1, wall}};
  f.marked_points.corners = {f.triangles[7][0], static_cast<std::int32_t>(f.points.size() - 1)};
  f.marked_points.tags = {11, 12};
  return f;
}

/// Takes n vertices out that can be, from the last one on, and puts m in; what OptimizeReport::vertices would say.
IdVector<VertexId, VertexId> remove_and_insert(Mesh& mesh, std::size_t n, std::size_t m) {
  const std::size_t before = mesh.n_vertices();
  for (std::size_t k = 0; k < m; ++k) {
    const TriangleId t(40 * k + 3);
    const auto [a, b, c] = mesh.corners(t);
    const Vec3 middle = mesh.weighted_vector(a) + mesh.weighted_vector(b) + mesh.weighted_vector(c);
    insert_in_triangle(mesh, t, mesh.space().vertex_at(middle, 0));
  }
  for (std::size_t v = before; v-- > 0 && n > 0;) {
    const RemovalPlan plan = plan_removal(mesh, VertexId(v));
    if (plan.status == RemovalStatus::possible) remove_vertex(mesh, plan), --n;
  }
  EXPECT_EQ(n, 0u);
  IdVector<VertexId, VertexId> vertices = mesh.compact().vertices;
  for (VertexId& old : vertices) {
    if (old.index >= before) old = VertexId();
  }
  return vertices;
}

TEST(VerticesOfTheSphere, ThatAreNotToldAreKnownByTheirPlace) {
  for (const auto& [removed, inserted] : {std::pair(5, 0), {0, 4}, {3, 6}, {9, 2}}) {
    MeshFile told = rich_globe(), not_told = told;
    const MeshFile before = told;
    auto loaded = make_mesh(told);
    ASSERT_TRUE(loaded) << loaded.error().what();
    Mesh mesh = loaded->mesh;
    const auto vertices =
        remove_and_insert(mesh, static_cast<std::size_t>(removed), static_cast<std::size_t>(inserted));
    // Other weights round places.
    for (const VertexId v : mesh.vertices())
      mesh.set_weight(v, mesh.weight(v) + 1e7 * static_cast<double>(v.index % 3));
    const DataReport report = update(told, *loaded, mesh, vertices), by_place = update(not_told, *loaded, mesh);
    expect_same_mesh(told, not_told);
    expect_same_data(told, not_told);
    EXPECT_EQ(told.sphere()->places, not_told.sphere()->places);
    EXPECT_EQ(told.warnings, not_told.warnings);
    EXPECT_EQ(by_place.points_inserted, static_cast<std::size_t>(inserted));
    EXPECT_EQ(by_place.points, before.points.size() - static_cast<std::size_t>(removed));
    EXPECT_EQ(by_place.points_moved, 0u);
    EXPECT_EQ(report.triangles_changed, by_place.triangles_changed);

    ASSERT_EQ(not_told.point_data.size(), 2u);
    const auto& heights = std::get<std::vector<double>>(not_told.point_data[0].values);
    ASSERT_EQ(heights.size(), not_told.points.size());
    for (std::size_t p = 0; p < heights.size(); ++p) EXPECT_NEAR(heights[p], not_told.sphere()->places[p].z, 1e5);
    std::map<std::array<double, 6>, std::int32_t> lines;
    const auto ends = [](const MeshFile& f, std::size_t i) {
      const Vec3 a = f.sphere()->places[static_cast<std::size_t>(f.lines[i][0])],
                 b = f.sphere()->places[static_cast<std::size_t>(f.lines[i][1])];
      return std::array{a.x, a.y, a.z, b.x, b.y, b.z};
    };
    for (std::size_t i = 0; i < before.lines.size(); ++i) lines[ends(before, i)] = before.lines.tags[i];
    ASSERT_GT(not_told.lines.size(), 0u);
    for (std::size_t i = 0; i < not_told.lines.size(); ++i) {
      const auto found = lines.find(ends(not_told, i));
      ASSERT_NE(found, lines.end()) << "a line with other ends";
      EXPECT_EQ(found->second, not_told.lines.tags[i]);
    }
    EXPECT_TRUE(make_mesh(not_told));
  }
}

TEST_F(FileTest, AMarkedPointThatWasRemovedIsCounted) {
  MeshFile f = grid();
  auto loaded = make_mesh(f);
  ASSERT_TRUE(loaded);
  const auto left = remove(loaded->mesh, {2 * (kSquares + 1) + 2});
  update(f, *loaded, loaded->mesh, left);
  EXPECT_EQ(f.marked_points.size(), 1u);
  EXPECT_EQ(f.warnings.at(0), "1 lines or marked points have lost their vertices and are dropped");
}

}  // namespace
}  // namespace temper::io
