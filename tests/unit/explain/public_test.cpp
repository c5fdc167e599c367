// Meshes and outlines that nobody here made, read in place: what is said of them, and that it covers them.
#include <filesystem>

#include "temper/detail/geometry.hpp"
#include "temper/detail/lp.hpp"
#include "temper/explain.hpp"
#include "temper/generate.hpp"
#include "temper/io.hpp"
#include "unit/explain/fans.hpp"

namespace temper::test {
namespace {

void expect_covered(const Mesh& mesh, const Explanation& e) {
  std::vector<int> explained(mesh.n_triangles(), 0);
  for (const Reason& reason : e.reasons) {
    for (const TriangleId t : reason.bad) ++explained[t.index];
    if (!reason.conflict.empty()) {
      EXPECT_EQ(check_certificate(mesh, reason.certificate), CertificateCheck::proves);
    }
  }
  for (const TriangleId t : mesh.triangles()) {
    const auto [p, q, r] = mesh.corners(t);
    const bool good = is_well_centered(mesh.point(p), mesh.point(q), mesh.point(r));
    EXPECT_EQ(explained[t.index], good ? 0 : 1);
  }
}

/// All ten have weights (unit_feasibility_public_meshes): so no conflict may be named.
TEST(ExplainPublic, MeshesOnlyLackWeights) {
  const std::string folder = TEMPER_SHARED "/meshes";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
  const auto solver = clp_solver();
  std::size_t read = 0;
  for (const char* name : {"mfem_beam-tri.mesh", "mfem_square-disc.mesh", "sfepy_its2D.mesh", "skfem_annulus.msh",
                           "skfem_cylinder_stokes.msh", "skfem_square.msh", "sfepy_circles_in_square.vtk"}) {
    const auto file = io::read(folder + "/" + name);
    ASSERT_TRUE(file) << file.error().what();
    const auto loaded = io::make_mesh(*file);
    ASSERT_TRUE(loaded) << loaded.error().what();
    const auto e = explain(loaded->mesh, *solver);
    ASSERT_TRUE(e);
    ++read;
    EXPECT_EQ(e->verdict, Feasibility::feasible) << name;
    EXPECT_GT(e->bad, 0u) << name;
    for (const Reason& reason : e->reasons) EXPECT_EQ(reason.kind, ReasonKind::weights) << name;
    expect_covered(loaded->mesh, *e);
  }
  EXPECT_EQ(read, 7u);
}

/// Without inner vertices everything is on the boundary: conflicts whose corners are not free, and what would help.
TEST(ExplainPublic, OutlinesWithoutInnerVerticesHaveConflictsOfFixedCorners) {
  const std::string folder = TEMPER_SHARED "/outlines";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
  const auto solver = clp_solver();
  for (const char* name : {"cdt_Capital_A.poly", "cdt_ditch.poly"}) {
    const auto file = io::read_outline(folder + "/" + name);
    ASSERT_TRUE(file) << file.error().what();
    std::vector<std::array<std::int32_t, 2>> segments;
    for (const OutlineSegment& segment : file->outline.segments) segments.push_back(segment.ends);
    const auto mesh = constrained_delaunay({.points = file->outline.points, .segments = segments});
    ASSERT_TRUE(mesh) << mesh.error().what();
    const auto e = explain(*mesh, *solver, {.cures = 2});
    ASSERT_TRUE(e);
    EXPECT_EQ(e->verdict, Feasibility::infeasible) << name;
    expect_covered(*mesh, *e);
    std::size_t conflicts = 0, splits = 0;
    for (const Reason& reason : e->reasons) {
      splits += reason.must_split ? 1 : 0;
      if (reason.conflict.empty()) continue;
      ++conflicts;
      EXPECT_TRUE(reason.free.empty());
      EXPECT_FALSE(reason.cures.empty());
      EXPECT_NE(reason_text(*mesh, reason).find("None of their corners is free to move"), std::string::npos);
    }
    const bool letter = std::string_view(name) == "cdt_Capital_A.poly";
    EXPECT_EQ(splits, letter ? 5u : 1u);
    EXPECT_EQ(conflicts > 0, letter);  // the ditch has no others
  }
}

}  // namespace
}  // namespace temper::test
