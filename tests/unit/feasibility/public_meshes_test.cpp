// Public meshes that nobody here made, read in place: all ten have weights that make them well-centered as they are.
#include <filesystem>
#include <ostream>

#include "temper/detail/necessity.hpp"
#include "temper/io.hpp"
#include "temper/optimize.hpp"
#include "unit/feasibility/support.hpp"

namespace temper::test {
namespace {

struct PublicMesh {
  const char* file;
  double margin;      ///< the best one
  std::size_t moved;  ///< weights that have to change for a margin of 0.01: at most these
  friend void PrintTo(const PublicMesh& mesh, std::ostream* out) { *out << mesh.file; }
};

// Margins to the digits that two solver methods agree on.
const PublicMesh kMeshes[] = {
    {"mfem_beam-tri.mesh", 0.0555555556, 14},          {"mfem_square-disc.mesh", 0.0598247376, 69},
    {"pydec_ResonantCavity.vtu", 0.2122670913, 8},     {"sfepy_circle_in_square.mesh", 0.1323424073, 66},
    {"sfepy_circles_in_square.vtk", 0.0885467044, 20}, {"sfepy_its2D.mesh", 0.1266717498, 3},
    {"sfepy_osteonT1_11.mesh", 0.0274939984, 1000},    {"skfem_annulus.msh", 0.1208702341, 4},
    {"skfem_cylinder_stokes.msh", 0.1406690447, 5},    {"skfem_square.msh", 0.1732528420, 7},
};

class PublicMeshWeights : public testing::TestWithParam<PublicMesh> {};

TEST_P(PublicMeshWeights, ExistAndFewHaveToChange) {
  const std::string path = std::string(TEMPER_SHARED "/meshes") + "/" + GetParam().file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  const auto file = io::read(path);
  ASSERT_TRUE(file) << file.error().what();
  const auto loaded = io::make_mesh(*file);
  ASSERT_TRUE(loaded) << loaded.error().what();
  const Mesh& mesh = loaded->mesh;

  const WeightReport report = weights_of(mesh, {.goal = WeightGoal::margin});
  EXPECT_EQ(report.verdict, Feasibility::feasible);
  EXPECT_TRUE(report.solved);
  EXPECT_EQ(report.margin_kind, MarginKind::exact);
  EXPECT_NEAR(report.margin, GetParam().margin, 1e-8);
  EXPECT_NEAR(report.attained, 0.01, 1e-7);
  EXPECT_LE(report.moved, GetParam().moved);
  EXPECT_GT(report.moved, 0u);
  EXPECT_EQ(bad_triangles(with_weights(mesh, report.weights)), 0u);

  const auto lp = clp_solver();
  const auto convex = interior_point_solver();
  for (const WeightGoal goal : {WeightGoal::center, WeightGoal::accuracy}) {
    const auto best = find_weights(mesh, *lp, {.goal = goal}, convex.get());
    ASSERT_TRUE(best && best->optimality);
    EXPECT_LE(best->optimality->relative_gap(), 1e-8);
    EXPECT_EQ(bad_triangles(with_weights(mesh, best->weights)), 0u);
  }

  const WeightReport local = weights_of(mesh, {.whole = 0});
  EXPECT_TRUE(local.solved);
  EXPECT_EQ(bad_triangles(with_weights(mesh, local.weights)), 0u);
}

INSTANTIATE_TEST_SUITE_P(All, PublicMeshWeights, testing::ValuesIn(kMeshes), [](const auto& mesh) {
  std::string name = mesh.param.file;
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
});

/// Well-centered by their weights: no edge may be said to need a split, whichever edges and vertices are kept.
TEST(PublicGlobes, HaveWeightsThatMakeThemWellCenteredAsTheyAre) {
  struct Row {
    const char* file;
    double margin;
    std::size_t bad, moved;
  };
  for (const Row& row : {Row{"fesom_pi.nod2d.out", 0.01, 104, 173}, Row{"mpas_QU1920km.nc", 0.2, 0, 12}}) {
    const std::string path = std::string(TEMPER_SHARED "/meshes/sphere") + "/" + row.file;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
    const auto file = io::read(path);
    ASSERT_TRUE(file) << file.error().what();
    const auto loaded = io::make_mesh(*file);
    ASSERT_TRUE(loaded) << loaded.error().what();
    const Mesh& mesh = loaded->mesh;
    EXPECT_EQ(bad_triangles(mesh), row.bad);
    const WeightReport report = weights_of(mesh, {.margin = row.margin});
    ASSERT_TRUE(report.solved) << row.file;
    EXPECT_NEAR(report.attained, row.margin, 1e-8);
    EXPECT_EQ(report.moved, row.moved);
    EXPECT_EQ(bad_triangles(with_weights(mesh, report.weights)), 0u);
  }
}

TEST_P(PublicMeshWeights, NeedNoSplit) {
  const std::string path = std::string(TEMPER_SHARED "/meshes") + "/" + GetParam().file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  const auto file = io::read(path);
  ASSERT_TRUE(file) << file.error().what();
  auto loaded = io::make_mesh(*file);
  ASSERT_TRUE(loaded) << loaded.error().what();
  for (const HalfedgeId h : loaded->mesh.halfedges()) loaded->mesh.set_constrained(h, true);
  EXPECT_TRUE(edges_that_must_be_split(loaded->mesh).empty());
}

struct PublicOutline {
  const char* file;
  std::vector<std::array<std::uint32_t, 2>> must_be_split;
};

TEST(PublicOutlines, MustBeSplitAtTheseEdgesAndThenHaveWellCenteredMeshes) {
  const std::string folder = TEMPER_SHARED "/outlines";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
  for (const PublicOutline& outline :
       {PublicOutline{"cdt_Capital_A.poly", {{3, 4}, {5, 6}, {10, 11}, {17, 18}, {24, 28}}},
        PublicOutline{"cdt_ditch.poly", {{9, 10}}}, PublicOutline{"cdt_kidney.poly", {}},
        PublicOutline{"cdt_island.poly", {}}}) {
    const auto file = io::read_outline(folder + "/" + outline.file);
    ASSERT_TRUE(file) << file.error().what();
    std::vector<std::array<std::int32_t, 2>> segments;
    for (const OutlineSegment& segment : file->outline.segments) segments.push_back(segment.ends);
    const auto mesh = constrained_delaunay({.points = file->outline.points, .segments = segments});
    ASSERT_TRUE(mesh) << mesh.error().what();
    std::vector<std::array<std::uint32_t, 2>> edges;
    for (const EdgeConflict& c : edges_that_must_be_split(*mesh)) {
      const auto [u, v] = std::minmax({mesh->origin(c.edge).index, mesh->target(c.edge).index});
      edges.push_back({u, v});
    }
    std::sort(edges.begin(), edges.end());
    EXPECT_EQ(edges, outline.must_be_split) << outline.file;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      Mesh split = *mesh;
      ASSERT_TRUE(
          optimize(split, {.boundary = BoundaryVertices::split, .repair = Repair::vertices, .paper = {.seed = seed}}));
      EXPECT_EQ(bad_triangles(split), 0u) << outline.file << " " << seed;
    }
  }
}

}  // namespace
}  // namespace temper::test
