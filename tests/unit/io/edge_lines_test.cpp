// Files whose lines are all edges of the mesh: these are no features, and the file that is written lists all edges
// again.
#include <set>

#include "support.hpp"
#include "temper/generate.hpp"
#include "temper/topology.hpp"

namespace temper::io {
namespace {

using Line = std::array<std::int32_t, 2>;
constexpr std::int32_t kEdgeTag = 0, kBoundaryTag = 3;

Line sorted(Line line) { return {std::min(line[0], line[1]), std::max(line[0], line[1])}; }

/// The edges of the mesh, the inner ones or those of the boundary.
std::set<Line> edges_of(const Mesh& mesh, bool boundary) {
  std::set<Line> all;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_boundary(h) != boundary || !mesh.is_edge_representative(h)) continue;
    all.insert(
        sorted({static_cast<std::int32_t>(mesh.origin(h).index), static_cast<std::int32_t>(mesh.target(h).index)}));
  }
  return all;
}

std::set<Line> lines_of_tag(const MeshFile& file, std::int32_t tag) {
  std::set<Line> all;
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    if (file.lines.tags[i] != tag) continue;
    EXPECT_TRUE(all.insert(sorted(file.lines[i])).second) << "twice";
  }
  return all;
}

/// A grid whose edges are all lines, those of the boundary among the others, with data on them.
MeshFile listed_grid() {
  const Mesh mesh = *sheared_grid({4, 4, 0.25});
  MeshFile file = from_mesh(mesh);
  file.lines.corners.clear();
  file.lines.tags.clear();
  for (const bool boundary : {false, true}) {
    for (const Line& edge : edges_of(mesh, boundary)) {
      const auto at = static_cast<std::ptrdiff_t>(boundary ? file.lines.size() / 2 : file.lines.size());
      file.lines.corners.insert(file.lines.begin() + at, edge);
      file.lines.tags.insert(file.lines.tags.begin() + at, boundary ? kBoundaryTag : kEdgeTag);
    }
  }
  std::vector<std::int32_t> entity;
  std::vector<double> length;
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    entity.push_back(file.lines.tags[i] == kEdgeTag ? 7 : static_cast<std::int32_t>(i));
    length.push_back(static_cast<double>(i));
  }
  file.lines.data = {{"entity", 1, entity}, {"length", 1, length}};
  return file;
}

std::size_t n_constrained(const Mesh& mesh) {
  std::size_t n = 0;
  for (const HalfedgeId h : mesh.halfedges()) n += mesh.is_constrained(h) && mesh.is_edge_representative(h) ? 1 : 0;
  return n;
}

std::size_t flip_some(Mesh& mesh) {
  std::size_t n = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (h.index % 3 != 0 || can_flip(mesh, h) != FlipStatus::possible) continue;
    flip(mesh, h);
    ++n;
  }
  return n;
}

TEST(EdgeLines, LinesOnAllInnerEdgesConstrainNothingWhichAWarningSays) {
  const auto made = make_mesh(listed_grid());
  ASSERT_TRUE(made) << made.error().what();
  EXPECT_EQ(n_constrained(made->mesh), 0u);
  ASSERT_EQ(made->warnings.size(), 1u);
  EXPECT_EQ(made->warnings[0],
            "all 40 inner edges are lines of tag 0: they are taken for the edges of the mesh, not for features, and "
            "constrain nothing");
}

TEST(EdgeLines, LinesThatTellEdgesApartConstrain) {
  const auto first_edge = [](const MeshFile& f) {
    return std::find(f.lines.tags.begin(), f.lines.tags.end(), kEdgeTag) - f.lines.tags.begin();
  };
  MeshFile one_missing = listed_grid();
  one_missing.lines.data.clear();
  const auto at = first_edge(one_missing);
  one_missing.lines.corners.erase(one_missing.lines.begin() + at);
  one_missing.lines.tags.erase(one_missing.lines.tags.begin() + at);
  MeshFile two_tags = listed_grid();
  two_tags.lines.tags[static_cast<std::size_t>(first_edge(two_tags))] = 5;
  for (const auto& [file, n] : {std::pair(one_missing, 39u), std::pair(two_tags, 40u)}) {
    const auto made = make_mesh(file);
    ASSERT_TRUE(made);
    EXPECT_EQ(n_constrained(made->mesh), n);
    EXPECT_TRUE(made->warnings.empty());
    EXPECT_TRUE(made->edge_lines.empty());
  }
  MeshFile single;
  single.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  single.triangles.corners = {{0, 1, 2}, {0, 2, 3}};
  single.lines.corners = {{0, 2}};
  single.lines.tags = {kEdgeTag};
  EXPECT_EQ(n_constrained(make_mesh(single)->mesh), 1u) << "one inner edge may be a feature";
}

TEST(EdgeLines, AnUnchangedMeshLeavesTheFileAsItIs) {
  const MeshFile before = listed_grid();
  const auto made = make_mesh(before);
  ASSERT_TRUE(made);
  MeshFile after = before;
  update(after, *made, made->mesh);
  expect_same_mesh(before, after);
  expect_same_data(before.lines.data, after.lines.data, "line data");
}

TEST(EdgeLines, EdgesThatFlipsMakeTakeThePlacesOfThoseThatAreGone) {
  const MeshFile before = listed_grid();
  auto made = make_mesh(before);
  ASSERT_TRUE(made);
  MeshFile after = before;
  for (int k = 0; k < 2; ++k) {  // as for --save-every
    ASSERT_GT(flip_some(made->mesh), 0u);
    update(after, *made, made->mesh);
    EXPECT_EQ(lines_of_tag(after, kEdgeTag), edges_of(made->mesh, false));
    EXPECT_EQ(after.lines.tags, before.lines.tags);
    for (std::size_t i = 0; i < before.lines.size(); ++i) {
      EXPECT_TRUE(before.lines.tags[i] == kEdgeTag || after.lines[i] == before.lines[i]) << i;
    }
    ASSERT_EQ(after.lines.data.size(), 1u) << "nothing says how long new edges are";
    EXPECT_EQ(after.lines.data[0].name, "entity");
    EXPECT_TRUE(after.lines.data[0].values == before.lines.data[0].values);
    EXPECT_EQ(after.warnings,
              std::vector<std::string>{"edges have changed: data of lines on them are dropped: length"});
  }
  const auto again = make_mesh(after);
  ASSERT_TRUE(again);
  EXPECT_EQ(n_constrained(again->mesh), 0u) << "the file still lists all edges";
}

TEST(EdgeLines, AMeshOfFewerVerticesHasItsEdgesListedBehindAllOtherLines) {
  const MeshFile before = listed_grid();
  auto made = make_mesh(before);
  ASSERT_TRUE(made);
  Mesh mesh = made->mesh;
  const RemovalPlan plan = plan_removal(mesh, VertexId(6));  // inside
  ASSERT_EQ(plan.status, RemovalStatus::possible);
  remove_vertex(mesh, plan);
  const auto vertices = mesh.compact().vertices;
  MeshFile after = before;
  update(after, *made, mesh, vertices);
  EXPECT_EQ(lines_of_tag(after, kEdgeTag), edges_of(mesh, false));
  EXPECT_EQ(lines_of_tag(after, kBoundaryTag), edges_of(mesh, true));
  EXPECT_TRUE(std::is_sorted(after.lines.tags.rbegin(), after.lines.tags.rend()));
  ASSERT_EQ(after.lines.data.size(), 1u);
  const auto& entity = std::get<std::vector<std::int32_t>>(after.lines.data[0].values);
  ASSERT_EQ(entity.size(), after.lines.size());
  for (std::size_t i = 0; i < entity.size(); ++i) EXPECT_EQ(entity[i] == 7, after.lines.tags[i] == kEdgeTag) << i;
}

TEST(EdgeLines, PointsOfNoTriangleAndTheirLinesDoNotMatter) {
  MeshFile file = listed_grid();
  file.lines.data.clear();
  for (Line& line : file.lines) line = {line[0] + 1, line[1] + 1};
  for (auto& triangle : file.triangles) {
    for (std::int32_t& p : triangle) ++p;
  }
  file.points.insert(file.points.begin(), Vec2{9, 9});
  file.lines.corners.insert(file.lines.begin(), Line{0, 1});
  file.lines.tags.insert(file.lines.tags.begin(), kEdgeTag);
  auto made = make_mesh(file);
  ASSERT_TRUE(made);
  EXPECT_EQ(n_constrained(made->mesh), 0u);
  ASSERT_GT(flip_some(made->mesh), 0u);
  update(file, *made, made->mesh);
  EXPECT_EQ(lines_of_tag(file, kEdgeTag), edges_of(made->mesh, false));
  EXPECT_EQ(lines_of_tag(file, kBoundaryTag), edges_of(made->mesh, true));
}

}  // namespace
}  // namespace temper::io
