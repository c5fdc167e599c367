// Vertices inserted and removed for a size field: alone, and in an update of Optimizer.
#include "optimize/loop/resizing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "support/spheres.hpp"
#include "temper/detail/criterion.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/generate.hpp"
#include "temper/optimizer.hpp"
#include "temper/regularity.hpp"

namespace temper::test {
namespace {

Vec3 where_is(const Mesh& mesh, VertexId v) { return mesh.space().place(mesh.point(v)); }

/// Fine at one vertex and coarse far from it: `fine` and `coarse` times the mean size of the mesh.
SizeField field_around(const Mesh& mesh, VertexId center, double fine, double coarse) {
  double mean = 0;
  for (const VertexId v : mesh.vertices()) mean += local_size(mesh, v) / static_cast<double>(mesh.n_vertices());
  std::vector<double> sizes;
  for (const VertexId v : mesh.vertices()) {
    const double far = distance(mesh.space(), mesh.point(center), mesh.point(v, mesh.point(center)));
    sizes.push_back(std::min(coarse * mean, fine * mean + 0.3 * far));
  }
  return *SizeField::from_values(mesh, sizes);
}

struct Start {
  std::string name;
  Mesh mesh;
};

std::vector<Start> starts() {
  return {{"lattice", lattice({.n = 16, .weight = 0.02})},
          {"random", *random_mesh({.vertices = 500, .seed = 3})},
          {"regions", mesh_with_regions(500, 4)},
          {"airfoil", *airfoil()},
          {"sphere", globe(500, 2, 3)},
          {"periodic", *random_periodic({.vertices = 400})}};
}

VertexId middle_vertex(const Mesh& mesh) {
  for (std::size_t v = mesh.n_vertices() / 2;; ++v) {
    if (!mesh.is_boundary(VertexId(v))) return VertexId(v);
  }
}

/// √(4A/√3), by the lengths of the edges.
double size_of(const Mesh& mesh, TriangleId t) {
  const auto [p, q, r] = mesh.points(t);
  const Space& space = mesh.space();
  const double a = length(space.chord(p, q)), b = length(space.chord(q, r)), c = length(space.chord(r, p));
  const double s = (a + b + c) / 2;
  return std::sqrt(4 / std::numbers::sqrt3 * std::sqrt(s * (s - a) * (s - b) * (s - c)));
}

double wanted(const Mesh& mesh, const SizeField& field, TriangleId t) {
  double sum = 0;
  for (const VertexId v : mesh.corners(t)) sum += field.at(mesh.point(v)).size / 3;
  return sum;
}

std::map<std::int32_t, double> areas(const Mesh& mesh) {
  std::map<std::int32_t, double> areas;
  for (const TriangleId t : mesh.triangles()) areas[mesh.region(t)] += size_of(mesh, t) * size_of(mesh, t);
  return areas;
}

double length_over_field(const Mesh& mesh, const SizeField& field, VertexId a, VertexId b) {
  const double wanted = (field.at(mesh.point(a)).size + field.at(mesh.point(b)).size) / 2;
  return distance(mesh.space(), mesh.point(a), mesh.point(b, mesh.point(a))) / wanted;
}

/// Says whether a vertex can be removed, so that no line becomes too long and no triangle too large.
bool may_go(const Mesh& mesh, const SizeField& field, VertexId v) {
  const RemovalPlan plan = plan_removal(mesh, v);
  if (plan.status != RemovalStatus::possible) return false;
  Mesh without = mesh;
  remove_vertex(without, plan);
  for (const auto& [a, b, c] : plan.triangles) {
    const TriangleId t = Mesh::triangle(without.find_halfedge(a, b));
    if (size_of(without, t) > std::numbers::sqrt2 * wanted(without, field, t)) return false;
  }
  std::set<VertexId> ends;
  for (const VertexId u : mesh.vertices()) {
    const HalfedgeId to = mesh.find_halfedge(v, u), from = mesh.find_halfedge(u, v);
    if ((to.valid() && mesh.is_unflippable(to)) || (from.valid() && mesh.is_unflippable(from))) ends.insert(u);
  }
  return ends.empty() || length_over_field(mesh, field, *ends.begin(), *ends.rbegin()) <= std::numbers::sqrt2;
}

/// All numbers of a mesh that has been resized, after it has dropped what was removed.
Mesh resized(Mesh mesh, const SizeField& field) {
  if (resize(mesh, field, mesh.n_vertices())) mesh.compact();
  return mesh;
}

TEST(Resizing, GivesTrianglesAndVerticesTheSizesOfTheField) {
  for (const auto& [name, before] : starts()) {
    SCOPED_TRACE(name);
    const SizeField field = field_around(before, middle_vertex(before), 0.3, 2.5);
    const Mesh mesh = resized(before, field);
    EXPECT_EQ(mesh.validate(), std::nullopt);
    EXPECT_EQ(count_non_regular_edges(mesh, false), 0U);
    for (const TriangleId t : mesh.triangles())
      EXPECT_LE(size_of(mesh, t), (std::numbers::sqrt2 + 1e-9) * wanted(mesh, field, t)) << "triangle " << t.index;
    for (const VertexId v : mesh.vertices()) {
      EXPECT_EQ(mesh.space().in_domain(mesh.point(v)), mesh.point(v));
      const double ratio = local_size(mesh, v) / field.at(mesh.point(v)).size;
      EXPECT_FALSE(ratio < (1 - 1e-9) / std::numbers::sqrt2 && may_go(mesh, field, v)) << v.index;
    }
    for (const HalfedgeId h : mesh.halfedges()) {
      const VertexId a = mesh.origin(h), b = mesh.target(h);
      const double ratio = length_over_field(mesh, field, a, b);
      EXPECT_FALSE(mesh.is_unflippable(h) && ratio > std::numbers::sqrt2) << a.index << " to " << b.index;
    }
    EXPECT_LT(mesh.n_vertices(), before.n_vertices());
    EXPECT_GT(mesh.n_vertices(), before.n_vertices() / 8);
  }
}

TEST(Resizing, PutsNewVerticesFarFromOthers) {
  for (const auto& [name, before] : starts()) {
    SCOPED_TRACE(name);
    const SizeField field = field_around(before, middle_vertex(before), 0.3, 1);
    Mesh mesh = before;
    resize(mesh, field, mesh.n_vertices());
    double least = 1;
    for (std::size_t v = before.n_vertices(); v < mesh.n_vertices(); ++v) {
      for (const HalfedgeId h : mesh.star(VertexId(v)))
        least = std::min(least, length_over_field(mesh, field, VertexId(v), mesh.target(h)));
    }
    EXPECT_GT(least, name == "regions" || name == "airfoil" ? 0.35 : 0.7) << "lines are as near as 0.37";
    EXPECT_LT(least, 1);
  }
}

TEST(Resizing, OnlyRemovesWhereTheFieldIsCoarser) {
  Mesh mesh = lattice({.n = 24, .weight = 0.02});
  const std::size_t n = mesh.n_vertices();
  ASSERT_TRUE(resize(mesh, field_around(mesh, middle_vertex(mesh), 2, 2), n));
  EXPECT_EQ(mesh.n_vertices(), n) << "removals left no triangle that is too large";
  mesh.compact();
  EXPECT_GT(mesh.n_vertices(), n / 3) << "no more than the density asks for";
  EXPECT_LT(mesh.n_vertices(), n / 2);
}

TEST(Resizing, LeavesAMeshThatHasTheSizes) {
  for (const auto& [name, before] : starts()) {
    SCOPED_TRACE(name);
    Mesh mesh = lattice();
    if (name == "lattice") {
      mesh = before;
      EXPECT_FALSE(resize(mesh, input_size_field(before), mesh.n_vertices()));
      EXPECT_EQ(mesh, before);
    }
    const SizeField field = field_around(before, middle_vertex(before), 0.3, 2.5);
    const Mesh once = resized(before, field);
    EXPECT_EQ(resized(once, field), once);
  }
}

TEST(Resizing, KeepsTheShapeOfDomainAndRegions) {
  for (const auto& [name, before] : starts()) {
    if (name == "sphere") continue;  // flat triangles become others
    SCOPED_TRACE(name);
    const Mesh mesh = resized(before, field_around(before, middle_vertex(before), 0.3, 2.5));
    const auto now = areas(mesh);
    for (const auto& [region, area] : areas(before)) EXPECT_NEAR(now.at(region), area, 1e-12 * area);
  }
}

TEST(Resizing, KeepsFixedVerticesAndThoseFromANumberOn) {
  Mesh mesh = lattice({.n = 16});
  const SizeField field = field_around(mesh, middle_vertex(mesh), 3, 3);
  std::vector<VertexId> fixed;
  for (const VertexId v : mesh.vertices()) {
    if (v.index % 5 != 0) continue;
    mesh.set_fixed(v, true);
    fixed.push_back(v);
  }
  const Mesh before = mesh;
  const std::size_t n_kept = mesh.n_vertices() - 40;
  ASSERT_TRUE(resize(mesh, field, n_kept));
  std::size_t gone = 0;
  for (const VertexId v : before.vertices()) {
    gone += mesh.is_isolated(v) ? 1 : 0;
    EXPECT_EQ(mesh.point(v), before.point(v));
    EXPECT_FALSE(mesh.is_isolated(v) && (before.is_fixed(v) || v.index >= n_kept)) << v.index;
  }
  EXPECT_GT(gone, 50U);
}

TEST(Optimizer, FollowsASizeFieldWithAGoodMesh) {
  for (const auto& [name, mesh] : starts()) {
    SCOPED_TRACE(name);
    Optimizer optimizer = *Optimizer::make(mesh);
    ASSERT_TRUE(optimizer.update());
    for (int step = 0; step < 3; ++step) {
      const Mesh before = optimizer.mesh();
      const VertexId center(middle_vertex(before).index + static_cast<std::size_t>(5 * step));
      const SizeField field = field_around(before, center, 0.5, 1.2);
      optimizer.resize(field);
      const auto update = optimizer.update();
      ASSERT_TRUE(update) << update.error().what();
      const Mesh& now = optimizer.mesh();
      EXPECT_EQ(now.validate(), std::nullopt);
      EXPECT_TRUE(meets(now, Criterion::well_centered));
      const SizeReport sizes = measure_size(now, field);
      EXPECT_GT(sizes.over_field.p05, name == "airfoil" ? 0.3 : 0.6);  // its boundary is finer, and stays
      EXPECT_LT(sizes.over_field.p95, 1.5);
      // Old vertices keep their order, and new ones are the last.
      const auto& numbers = update->difference.vertices;
      ASSERT_EQ(numbers.size(), now.n_vertices());
      const auto first_new = std::ranges::find_if(numbers, [](VertexId v) { return !v.valid(); });
      EXPECT_TRUE(std::is_sorted(numbers.begin(), first_new));
      EXPECT_TRUE(std::all_of(first_new, numbers.end(), [](VertexId v) { return !v.valid(); }));
      const auto& moved = update->difference.moved;
      for (const VertexId v : now.vertices()) {
        if (!numbers[v].valid() || std::ranges::binary_search(moved, v)) continue;
        EXPECT_EQ(where_is(now, v), where_is(before, numbers[v]));
      }
    }
  }
}

TEST(Optimizer, KeepsVerticesThatAreInsertedWhereTheFieldWantsFewer) {
  Optimizer optimizer = *Optimizer::make(lattice({.n = 12, .jitter = 0.02, .weight = 0.01}));
  const Vec3 place = where_is(optimizer.mesh(), middle_vertex(optimizer.mesh())) + Vec3{0.3, 0.2, 0};
  optimizer.insert(place);
  optimizer.resize(field_around(optimizer.mesh(), middle_vertex(optimizer.mesh()), 2, 2));
  const auto update = optimizer.update();
  ASSERT_TRUE(update) << update.error().what();
  EXPECT_LT(optimizer.mesh().n_vertices(), 100U);
  EXPECT_FALSE(std::all_of(update->difference.vertices.begin(), update->difference.vertices.end(),
                           [](VertexId v) { return v.valid(); }));
}

TEST(Optimizer, RefusesASizeFieldOfAnotherSpace) {
  Optimizer optimizer = *Optimizer::make(lattice());
  const Mesh before = optimizer.mesh();
  optimizer.resize(input_size_field(globe(100)));
  const auto update = optimizer.update();
  ASSERT_FALSE(update);
  EXPECT_EQ(update.error().code, ErrorCode::invalid_option);
  EXPECT_NE(update.error().message.find("another space"), std::string::npos);
  EXPECT_EQ(optimizer.mesh(), before);
  optimizer.forget();
  EXPECT_TRUE(optimizer.update());
}

}  // namespace
}  // namespace temper::test
