// erase() and compact(): what is left is the same mesh as one built without the erased triangles.
#include <gtest/gtest.h>

#include "mesh/mesh_editor.hpp"
#include "unit/mesh/random_soup.hpp"

namespace temper {
namespace {

using test::Arrays;
using test::built;

/// A random triangulation with flags and regions that tell its parts apart.
Mesh marked_mesh(Rng& rng) {
  Mesh mesh = test::random_triangulation(rng, 25);
  for (const TriangleId t : mesh.triangles()) mesh.set_region(t, static_cast<std::int32_t>(rng.below(1000)));
  for (const VertexId v : mesh.vertices()) mesh.set_fixed(v, rng.uniform() < 0.3);
  for (const HalfedgeId h : mesh.halfedges()) {
    if (rng.uniform() < 0.1) mesh.set_constrained(h, true);
  }
  return mesh;
}

/// Expects the new mesh to be what compact() says it kept of the old one.
void expect_same_where_kept(const Mesh& old, const Mesh& mesh, const Compaction& kept) {
  ASSERT_EQ(kept.vertices.size(), mesh.n_vertices());
  ASSERT_EQ(kept.triangles.size(), mesh.n_triangles());
  for (const VertexId v : mesh.vertices()) {
    EXPECT_EQ(mesh.point(v), old.point(kept.vertices[v]));
    EXPECT_EQ(mesh.is_fixed(v), old.is_fixed(kept.vertices[v]));
    EXPECT_TRUE(v.index == 0 || kept.vertices[VertexId(v.index - 1u)] < kept.vertices[v]);
  }
  for (const TriangleId t : mesh.triangles()) {
    const TriangleId from = kept.triangles[t];
    EXPECT_EQ(mesh.region(t), old.region(from));
    EXPECT_TRUE(t.index == 0 || kept.triangles[TriangleId(t.index - 1u)] < from);
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(t, k), was = Mesh::halfedge(from, k);
      EXPECT_EQ(kept.vertices[mesh.origin(h)], old.origin(was));
      EXPECT_EQ(mesh.is_constrained(h), old.is_constrained(was));
      if (!mesh.twin(h).valid()) continue;
      const HalfedgeId twin = old.twin(was);
      ASSERT_TRUE(twin.valid());
      EXPECT_EQ(kept.triangles[Mesh::triangle(mesh.twin(h))], Mesh::triangle(twin));
      EXPECT_EQ(mesh.twin(h).index % 3, twin.index % 3);
    }
  }
}

TEST(Compact, OfRandomPartsKeepsOrderFlagsAndTwins) {
  Rng rng(11);
  int valid = 0, touching = 0;
  for (int i = 0; i < 600; ++i) {
    const Mesh old = marked_mesh(rng);
    Mesh mesh = old;
    std::vector<TriangleId> left;
    const double keep = rng.uniform(0.7, 1);
    for (const TriangleId t : old.triangles()) {
      if (rng.uniform() < keep) {
        left.push_back(t);
      } else {
        MeshEditor(mesh).erase(t);
        EXPECT_TRUE(mesh.is_erased(t));
      }
    }
    if (left.empty()) continue;
    const std::size_t edges_before = mesh.n_edges();
    const Compaction kept = mesh.compact();
    ASSERT_EQ(kept.triangles.raw(), left);
    EXPECT_EQ(mesh.n_edges(), edges_before);
    expect_same_where_kept(old, mesh, kept);
    const auto rebuilt = test::arrays_of(old, left).build();
    // A vertex where what is left touches itself makes neither a mesh.
    EXPECT_EQ(mesh.validate().has_value(), !rebuilt.has_value());
    if (rebuilt.has_value()) {
      EXPECT_EQ(mesh.n_edges(), rebuilt->mesh.n_edges());
      EXPECT_EQ(mesh.n_vertices(), rebuilt->mesh.n_vertices());
      EXPECT_EQ(test::boundary_loops(mesh), test::boundary_loops(rebuilt->mesh));
    }
    ++(rebuilt.has_value() ? valid : touching);
    if (HasFailure()) FAIL() << "in mesh " << i;
  }
  EXPECT_GT(valid, 50);
  EXPECT_GT(touching, 50);
}

TEST(Compact, OfAWholeMeshChangesNothingAndTwiceIsOnce) {
  // Two erased triangles; compacting again finds nothing to do.
  Mesh mesh = built(test::squares(6));
  MeshEditor(mesh).erase(TriangleId(0));
  MeshEditor(mesh).erase(TriangleId(40));
  mesh.compact();
  ASSERT_EQ(mesh.validate(), std::nullopt);
  const Mesh once = mesh;
  const Compaction kept = mesh.compact();
  EXPECT_EQ(mesh, once);
  for (const VertexId v : mesh.vertices()) EXPECT_EQ(kept.vertices[v], v);
  for (const TriangleId t : mesh.triangles()) EXPECT_EQ(kept.triangles[t], t);
}

TEST(Compact, DropsVerticesWithoutTriangles) {
  Mesh mesh = built(test::squares(2));
  MeshEditor(mesh).erase(TriangleId(0));
  MeshEditor(mesh).erase(TriangleId(1));  // the square at vertex 0, whose only triangles these are
  const Compaction kept = mesh.compact();
  EXPECT_EQ(mesh.n_vertices(), 8u);
  EXPECT_EQ(kept.vertices[VertexId(0)], VertexId(1));
  EXPECT_EQ(mesh.validate(), std::nullopt);
}

TEST(Compact, OfAllErasedLeavesTheEmptyMesh) {
  Mesh mesh = built(test::fan());
  for (const TriangleId t : mesh.triangles()) MeshEditor(mesh).erase(t);
  mesh.compact();
  EXPECT_EQ(mesh, Mesh());
}

}  // namespace
}  // namespace temper
