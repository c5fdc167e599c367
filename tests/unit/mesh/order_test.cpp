// hilbert_order: a relabelling that restore_order undoes bit for bit, and that brings neighbors together in memory.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "mesh/curve.hpp"
#include "mesh/folded_mesh.hpp"
#include "support/std_threads.hpp"
#include "temper/generate.hpp"
#include "unit/mesh/random_soup.hpp"

namespace temper {
namespace {

using test::built;

template <class IdType>
void expect_permutation(const IdVector<IdType, IdType>& order, std::size_t n) {
  ASSERT_EQ(order.size(), n);
  std::vector<int> seen(n, 0);
  for (const IdType i : order) {
    ASSERT_LT(i.index, n);
    ++seen[i.index];
  }
  for (const int times : seen) EXPECT_EQ(times, 1);
}

/// A permutation of the arrays' points and triangles, at random.
test::Arrays shuffled(const test::Arrays& arrays, Rng& rng) {
  std::vector<std::int32_t> number(arrays.points.size());
  for (std::size_t i = 0; i < number.size(); ++i) number[i] = static_cast<std::int32_t>(i);
  const auto shuffle = [&](auto& values) {
    for (std::size_t i = values.size(); i > 1; --i) {
      std::swap(values[i - 1], values[rng.below(static_cast<std::uint32_t>(i))]);
    }
  };
  shuffle(number);
  test::Arrays result = arrays;
  for (std::size_t i = 0; i < number.size(); ++i) result.points[static_cast<std::size_t>(number[i])] = arrays.points[i];
  for (auto& corners : result.triangles) {
    for (auto& i : corners) i = number[static_cast<std::size_t>(i)];
  }
  shuffle(result.triangles);
  return result;
}

TEST(HilbertOrder, IsUndoneBitForBit) {
  Rng rng(21);
  std::size_t moved = 0;
  for (int i = 0; i < 50; ++i) {
    Mesh mesh = test::random_triangulation(rng, 1 + static_cast<int>(rng.below(60)));
    for (const TriangleId t : mesh.triangles()) mesh.set_region(t, static_cast<std::int32_t>(rng.below(9)));
    for (const VertexId v : mesh.vertices()) mesh.set_fixed(v, rng.uniform() < 0.5);
    for (const HalfedgeId h : mesh.halfedges()) mesh.set_constrained(h, rng.uniform() < 0.2);
    const Mesh original = mesh;
    const MeshOrder order = hilbert_order(mesh);
    EXPECT_EQ(mesh.validate(), std::nullopt);
    expect_permutation(order.vertices, mesh.n_vertices());
    expect_permutation(order.triangles, mesh.n_triangles());
    for (const VertexId v : mesh.vertices()) {
      EXPECT_EQ(mesh.point(v), original.point(order.vertices[v]));
      EXPECT_EQ(mesh.is_fixed(v), original.is_fixed(order.vertices[v]));
    }
    for (const TriangleId t : mesh.triangles()) {
      EXPECT_EQ(mesh.region(t), original.region(order.triangles[t]));
      for (int k = 0; k < 3; ++k) {
        const HalfedgeId now = Mesh::halfedge(t, k), was = Mesh::halfedge(order.triangles[t], k);
        EXPECT_EQ(order.vertices[mesh.origin(now)], original.origin(was));
        EXPECT_EQ(mesh.is_constrained(now), original.is_constrained(was));
      }
    }
    moved += mesh != original ? 1 : 0;
    restore_order(mesh, order);
    EXPECT_EQ(mesh, original);
  }
  EXPECT_GT(moved, 40u);
}

TEST(HilbertOrder, OfACopyIsThatOfTheMeshForAnyNumberOfThreads) {
  Rng rng(24);
  for (const int n : {2, 20, 150}) {  // the last one is several blocks long
    Mesh mesh = built(shuffled(test::squares(n), rng));
    for (const bool marked : {false, true}) {
      if (marked) mesh.set_constrained(HalfedgeId(7), true), mesh.set_region(TriangleId(3), 5);
      Mesh moved = mesh;
      const MeshOrder order = hilbert_order(moved);
      for (const std::size_t threads : {0u, 1u, 2u, 3u, 8u}) {
        test::StdThreads executor(threads);
        const OrderedMesh copy = hilbert_ordered(mesh, threads > 0 ? &executor : nullptr);
        EXPECT_EQ(copy.mesh, moved);
        EXPECT_EQ(copy.mesh.memory_bytes(), moved.memory_bytes());
        EXPECT_EQ(copy.order.vertices, order.vertices);
        EXPECT_EQ(copy.order.triangles, order.triangles);
      }
    }
  }
}

TEST(FoldedMesh, UnfoldsBitForBit) {
  Rng rng(26);
  Mesh mesh = built(shuffled(test::squares(150), rng));
  const auto folds = [&] {
    test::StdThreads threads(3);
    return FoldedMesh(mesh).unfold(&threads) == mesh;
  };
  EXPECT_TRUE(folds());  // in any order
  hilbert_order(mesh);
  EXPECT_TRUE(folds());
  mesh.set_weight(VertexId(6), -0.0);
  EXPECT_TRUE(std::signbit(FoldedMesh(mesh).unfold(nullptr).weight(VertexId(6))));
  mesh.set_weight(VertexId(5), -0.25), mesh.set_fixed(VertexId(7), true), mesh.set_region(TriangleId(3), -5);
  EXPECT_TRUE(folds());
  mesh.set_constrained(HalfedgeId(7), true), mesh.set_diagonal(HalfedgeId(70));
  EXPECT_TRUE(folds());
}

TEST(HilbertOrder, IsUndoneForAnyNumberOfThreads) {
  Rng rng(25);
  Mesh mesh = built(shuffled(test::squares(150), rng));
  mesh.set_constrained(HalfedgeId(7), true), mesh.set_region(TriangleId(3), 5);
  const OrderedMesh ordered = hilbert_ordered(mesh);
  for (const std::size_t threads : {1u, 2u, 3u, 8u}) {
    test::StdThreads executor(threads);
    Mesh back = ordered.mesh;
    restore_order(back, ordered.order, &executor);
    EXPECT_EQ(back, mesh);
    EXPECT_EQ(back.memory_bytes(), mesh.memory_bytes());
  }
}

TEST(HilbertOrder, KeepsFlipsMadeBetween) {
  Rng rng(22);
  Mesh mesh = test::random_triangulation(rng, 30), flipped = mesh;
  const MeshOrder order = hilbert_order(mesh);
  int flips = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (can_flip(mesh, h) != FlipStatus::possible) continue;
    const TriangleId t = order.triangles[Mesh::triangle(h)];
    flip(flipped, Mesh::halfedge(t, static_cast<int>(h.index % 3)));
    flip(mesh, h);
    ++flips;
  }
  ASSERT_GT(flips, 10);
  restore_order(mesh, order);
  EXPECT_EQ(mesh.validate(), std::nullopt);
  // outgoing() of an inner vertex is any one of its halfedges; all else is the same.
  for (const HalfedgeId h : mesh.halfedges()) {
    EXPECT_EQ(mesh.origin(h), flipped.origin(h));
    EXPECT_EQ(mesh.twin(h), flipped.twin(h));
  }
  for (const VertexId v : mesh.vertices()) EXPECT_EQ(mesh.point(v), flipped.point(v));
}

TEST(HilbertOrder, OfAnOrderedMeshIsTheIdentity) {
  Rng rng(23);
  Mesh mesh = built(shuffled(test::squares(9), rng));
  hilbert_order(mesh);
  const Mesh once = mesh;
  const MeshOrder again = hilbert_order(mesh);
  EXPECT_EQ(mesh, once);
  for (const VertexId v : mesh.vertices()) EXPECT_EQ(again.vertices[v], v);
}

TEST(HilbertOrder, OfPointsOnALineOfOneDirectionWorks) {
  // Extents of very different size, and a single triangle.
  Mesh flat = built({{{0, 0}, {1e9, 0}, {5e8, 1e-9}}, {{0, 1, 2}}});
  const Mesh original = flat;
  restore_order(flat, hilbert_order(flat));
  EXPECT_EQ(flat, original);
}

/// Mean logarithm of the distance in memory between the ends of an edge.
double mean_log_distance(const Mesh& mesh) {
  double sum = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    const double a = mesh.origin(h).index, b = mesh.target(h).index;
    sum += std::log2(std::abs(a - b));
  }
  return sum / static_cast<double>(mesh.n_halfedges());
}

/// Share of edges whose ends are within one page (128 records of 32 bytes) of each other.
double share_within_page(const Mesh& mesh) {
  std::size_t near = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    near += std::abs(static_cast<double>(mesh.origin(h).index) - mesh.target(h).index) < 128 ? 1 : 0;
  }
  return static_cast<double>(near) / static_cast<double>(mesh.n_halfedges());
}

TEST(HilbertOrder, BringsNeighborsTogether) {
  Rng rng(24);
  Mesh mesh = built(shuffled(test::squares(100), rng));
  EXPECT_LT(share_within_page(mesh), 0.05);
  const double before = mean_log_distance(mesh);
  hilbert_order(mesh);
  EXPECT_GT(share_within_page(mesh), 0.8);
  EXPECT_LT(mean_log_distance(mesh), before - 6);  // 64 times nearer, in the geometric mean
  // Triangles follow their vertices.
  std::size_t near = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    const double vertex = mesh.origin(h).index, triangle = Mesh::triangle(h).index;
    near += std::abs(2 * vertex - triangle) < 512 ? 1 : 0;
  }
  EXPECT_GT(static_cast<double>(near) / static_cast<double>(mesh.n_halfedges()), 0.7);
}

TEST(Walk, SeesEachVertexOnceAndTakesTheCurveWhereStarsAreScattered) {
  Mesh mesh = *random_mesh({.vertices = 100000, .seed = 3});  // more than a cache holds
  const Walk scattered(mesh);
  EXPECT_FALSE(scattered.is_by_number());
  IdVector<VertexId, VertexId> seen(mesh.n_vertices());
  for (std::size_t i = 0; i < mesh.n_vertices(); ++i) seen[VertexId(i)] = scattered[i];
  expect_permutation(seen, mesh.n_vertices());
  hilbert_order(mesh);
  EXPECT_TRUE(Walk(mesh).is_by_number());
}

TEST(NearbyCopy, IsTheMeshItselfUnlessThatIsScattered) {
  const Mesh scattered = *random_mesh({.vertices = 100000, .seed = 3});
  const NearbyCopy copy(scattered, nullptr);
  ASSERT_FALSE(copy.is_original());
  for (const VertexId v : copy.mesh().vertices()) {
    ASSERT_EQ(copy.mesh().point(v), scattered.point(copy.original(v)));
  }
  for (const TriangleId t : copy.mesh().triangles()) {
    const auto here = copy.mesh().corners(t), there = scattered.corners(copy.original_triangles()[t]);
    for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(copy.original(here[k]), there[k]);
  }
  const NearbyCopy again(copy.mesh(), nullptr);
  EXPECT_TRUE(again.is_original());
  EXPECT_EQ(&again.mesh(), &copy.mesh());
  EXPECT_EQ(again.original(VertexId(5)), VertexId(5));
}

}  // namespace
}  // namespace temper
