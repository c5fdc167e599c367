// Meshes that others made, read in place where they are there.
#include "support.hpp"

namespace temper::io {
namespace {

struct Public {
  const char* file;
  const char* format;
  std::size_t vertices, triangles, reversed, regions;
};

TEST(PublicMeshes, AreReadWithTheirNumbersOfVerticesAndTriangles) {
  if (!std::filesystem::exists(TEMPER_SHARED "/meshes")) GTEST_SKIP() << "no meshes in " << TEMPER_SHARED "/meshes";
  constexpr Public kFiles[] = {{"sfepy_osteonT1_11.mesh", "medit", 1228, 2292, 0, 67},
                               {"sfepy_circle_in_square.mesh", "medit", 1102, 2102, 0, 2},
                               {"sfepy_its2D.mesh", "medit", 55, 83, 0, 1},
                               {"sfepy_circles_in_square.vtk", "vtk", 313, 588, 0, 8},
                               {"skfem_annulus.msh", "gmsh41", 60, 98, 0, 1},
                               {"skfem_cylinder_stokes.msh", "gmsh41", 171, 293, 128, 1},
                               {"skfem_square.msh", "gmsh22", 109, 184, 0, 1},
                               {"mfem_square-disc.mesh", "mfem", 101, 154, 0, 1},
                               {"mfem_beam-tri.mesh", "mfem", 18, 16, 0, 2},
                               {"pydec_ResonantCavity.vtu", "vtu", 191, 336, 0, 1}};
  for (const Public& expected : kFiles) {
    const auto f = read(std::string(TEMPER_SHARED "/meshes") + "/" + expected.file);
    ASSERT_TRUE(f) << f.error().what();
    EXPECT_EQ(f->format, expected.format) << expected.file;
    const auto made = make_mesh(*f);
    ASSERT_TRUE(made) << made.error().what();
    EXPECT_EQ(made->mesh.n_vertices(), expected.vertices) << expected.file;
    EXPECT_EQ(made->mesh.n_triangles(), expected.triangles) << expected.file;
    EXPECT_EQ(made->reversed_triangles, expected.reversed) << expected.file;
    std::vector<std::int32_t> regions = f->triangles.tags;
    std::sort(regions.begin(), regions.end());
    const auto distinct = std::unique(regions.begin(), regions.end()) - regions.begin();
    EXPECT_EQ(std::max<std::ptrdiff_t>(distinct, 1), static_cast<std::ptrdiff_t>(expected.regions)) << expected.file;
  }
}

class PublicFiles : public FileTest {};

TEST_F(PublicFiles, GoThroughEveryFormatWithoutLosingABitOfPointsAndTriangles) {
  if (!std::filesystem::exists(TEMPER_SHARED "/meshes")) GTEST_SKIP() << "no meshes in " << TEMPER_SHARED "/meshes";
  int trips = 0;
  for (const char* name : {"sfepy_circles_in_square.vtk", "sfepy_its2D.mesh", "skfem_annulus.msh",
                           "mfem_square-disc.mesh", "pydec_ResonantCavity.vtu"}) {
    const auto f = read(std::string(TEMPER_SHARED "/meshes") + "/" + name);
    ASSERT_TRUE(f) << f.error().what();
    for (const Format& format : formats()) {
      if (!writes_planes(format)) continue;
      const std::string out = path(format.name == "triangle" ? "m.node" : "m");
      const auto written = write(out, *f, {std::string(format.name), {}});
      ASSERT_TRUE(written) << written.error().what();
      const auto g = read(out);
      ASSERT_TRUE(g) << g.error().what();
      EXPECT_EQ(g->format, format.name);
      EXPECT_EQ(g->points, f->points) << name << " as " << format.name;
      EXPECT_EQ(g->triangles.corners, f->triangles.corners) << name << " as " << format.name;
      ++trips;
    }
  }
  EXPECT_GE(trips, 60);
}

TEST(PublicMeshes, KeepTheirNamesAndLines) {
  if (!std::filesystem::exists(TEMPER_SHARED "/meshes")) GTEST_SKIP() << "no meshes in " << TEMPER_SHARED "/meshes";
  const auto f = read(std::string(TEMPER_SHARED "/meshes") + "/skfem_annulus.msh");
  ASSERT_TRUE(f) << f.error().what();
  ASSERT_EQ(f->names.size(), 3u);
  EXPECT_EQ(f->names[0].name, "exter");
  EXPECT_EQ(f->names[0].tag, 7);
  EXPECT_EQ(f->lines.size(), 22u);
  EXPECT_EQ(std::count(f->lines.tags.begin(), f->lines.tags.end(), 7) +
                std::count(f->lines.tags.begin(), f->lines.tags.end(), 8),
            22);
  const std::string inner[] = {"inter"};
  const auto made = make_mesh(*f, inner);
  ASSERT_TRUE(made) << made.error().what();
  std::size_t fixed = 0;
  for (const VertexId v : made->mesh.vertices()) fixed += made->mesh.is_fixed(v);
  EXPECT_EQ(fixed, 7u);
}

}  // namespace
}  // namespace temper::io
