// Public meshes that nobody here made, read in place where they are: each ends well-centered with default options.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "support/sanitizers.hpp"
#include "temper/io.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "temper/tets/optimize.hpp"
#include "temper/tets/quality.hpp"

namespace temper::test {
namespace {

struct PublicMesh {
  const char* file;
  std::size_t vertices, triangles;

  friend void PrintTo(const PublicMesh& mesh, std::ostream* out) { *out << mesh.file; }
};

const PublicMesh kMeshes[] = {
    {"mfem_beam-tri.mesh", 18, 16},
    {"mfem_square-disc.mesh", 101, 154},
    {"pydec_ResonantCavity.vtu", 191, 336},
    {"sfepy_circle_in_square.mesh", 1102, 2102},
    {"sfepy_circles_in_square.vtk", 313, 588},
    {"sfepy_its2D.mesh", 55, 83},
    {"sfepy_osteonT1_11.mesh", 1228, 2292},
    {"skfem_annulus.msh", 60, 98},
    {"skfem_cylinder_stokes.msh", 171, 293},
    {"skfem_square.msh", 109, 184},
};

std::string path_of(const PublicMesh& mesh) { return std::string(TEMPER_SHARED "/meshes") + "/" + mesh.file; }

class PublicMeshes : public testing::TestWithParam<PublicMesh> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(path_of(GetParam()))) GTEST_SKIP() << path_of(GetParam()) << " is not here";
  }
};

TEST_P(PublicMeshes, EndWellCenteredWithTheirBoundaryAndInterfacesBitForBit) {
  const auto file = io::read(path_of(GetParam()));
  ASSERT_TRUE(file) << file.error().what();
  const auto loaded = io::make_mesh(*file);
  ASSERT_TRUE(loaded) << loaded.error().what();
  const Mesh& before = loaded->mesh;
  EXPECT_EQ(before.n_vertices(), GetParam().vertices);
  EXPECT_EQ(before.n_triangles(), GetParam().triangles);

  Mesh mesh = before;
  const auto report = optimize(mesh);
  ASSERT_TRUE(report) << report.error().what();
  const Quality q = quality(mesh);
  EXPECT_EQ(q.orthocenters_outside, 0u);
  EXPECT_EQ(q.edges_not_crossed, 0u);
  EXPECT_EQ(q.non_regular_edges, 0u);
  EXPECT_EQ(q.inverted_triangles, 0u);
  EXPECT_EQ(q.well_centered_fraction, 1);
  EXPECT_EQ(mesh.validate(), std::nullopt);

  std::size_t compared = 0;
  for (const HalfedgeId h : before.halfedges()) {
    if (!before.is_boundary(h) && !before.is_constrained(h)) continue;
    const VertexId v = before.origin(h);
    const Vec2 p = before.position(v), q_after = mesh.position(v);
    EXPECT_EQ(std::memcmp(&p, &q_after, sizeof p), 0) << "vertex " << v.index;
    EXPECT_TRUE(mesh.find_halfedge(v, before.target(h)).valid());
    ++compared;
  }
  EXPECT_GT(compared, 0u);
}

INSTANTIATE_TEST_SUITE_P(All, PublicMeshes, testing::ValuesIn(kMeshes), [](const auto& mesh) {
  std::string name = mesh.param.file;
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
});

// --- tetrahedra ------------------------------------------------------------------------------------------------

/// Meshes that end without bad tetrahedra. perfusion_micro3d, cut-cylinder and cylinder_in_box keep some.
/// Sanitizers leave out skfem_box, which takes ten times as long as all others together. It alone is searched in
/// patches, and unit_tets calls each function of that.
constexpr const char* kTets[] = {
#if !TEMPER_SANITIZED
    "skfem_box.msh",
#endif
    "sfepy_cube_medium_tetra.mesh",
    "sfepy_cube_sphere.mesh",
    "sfepy_cylinder.mesh",
    "sfepy_elbow.mesh",
    "sfepy_msh_tetra.msh",
    "sfepy_unit_ball.mesh",
    "skfem_beams.msh",
    "skfem_cube_oriented_sub.msh",
    "skfem_cuubat.msh"};

class PublicTets : public testing::TestWithParam<const char*> {};

TEST_P(PublicTets, EndWellCenteredWithTheirBoundaryAndInterfacesBitForBit) {
  const std::string path = std::string(TEMPER_SHARED "/tets/") + GetParam();
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  const auto file = io::read(path);
  ASSERT_TRUE(file) << file.error().what();
  const auto loaded = io::make_tet_mesh(*file);
  ASSERT_TRUE(loaded) << loaded.error().what();
  const tets::TetMesh& before = loaded->mesh;
  tets::TetMesh mesh = before;
  const auto report = optimize(mesh);
  ASSERT_TRUE(report) << report.error().what();
  const tets::Quality q = tets::quality(mesh);
  EXPECT_EQ(q.orthocenters_outside, 0u);
  EXPECT_EQ(q.non_regular_faces, 0u);
  EXPECT_EQ(mesh.validate(), std::nullopt);

  // The faces that must stay, by the places of their corners, sorted.
  const auto faces_of = [](const tets::TetMesh& m) {
    std::vector<std::array<std::array<double, 3>, 3>> all;
    for (const tets::HalffaceId h : m.halffaces()) {
      const bool inner = !m.is_boundary(h);
      if (inner && m.region(tets::TetMesh::tetrahedron(h)) == m.region(tets::TetMesh::tetrahedron(m.twin(h)))) continue;
      auto& face = all.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 p = m.position(m.vertices(h)[k]);
        face[k] = {p.x, p.y, p.z};
      }
      std::sort(face.begin(), face.end());
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  EXPECT_EQ(faces_of(mesh), faces_of(before));
}

INSTANTIATE_TEST_SUITE_P(All, PublicTets, testing::ValuesIn(kTets), [](const auto& mesh) {
  std::string name = mesh.param;
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
});

}  // namespace
}  // namespace temper::test
