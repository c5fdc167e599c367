// restore_regularity against CGAL's Regular_triangulation_2: on a convex domain and without ties the regular
// triangulation is unique, hidden vertices included, whatever mesh one starts from.
#include "temper/regularity.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_2.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "property/mesh_of_random_points.hpp"
#include "regularity/lawson.hpp"
#include "unit/geometry/degenerate_families.hpp"

namespace temper {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using RegularTriangulation = CGAL::Regular_triangulation_2<Kernel>;
using Edges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Kernel::Weighted_point_2 to_cgal(const WeightedPoint& p) { return {Kernel::Point_2(p.x, p.y), p.w}; }

/// CGAL's answer, in the numbers of the mesh's vertices.
struct Oracle {
  Edges edges;
  std::vector<VertexId> hidden;
};

Oracle regular_triangulation(const Mesh& mesh) {
  std::map<Kernel::Point_2, VertexId> ids;
  std::vector<Kernel::Weighted_point_2> points;
  for (const VertexId v : mesh.vertices()) {
    if (mesh.is_isolated(v)) continue;  // removed
    points.push_back(to_cgal(mesh.point(v)));
    ids[points.back().point()] = v;
  }
  const RegularTriangulation triangulation(points.begin(), points.end());
  Oracle oracle;
  for (const auto& [face, i] : triangulation.finite_edges()) {
    const VertexId a = ids.at(face->vertex((i + 1) % 3)->point().point());
    const VertexId b = ids.at(face->vertex((i + 2) % 3)->point().point());
    oracle.edges.push_back(std::minmax(a.index, b.index));
  }
  std::sort(oracle.edges.begin(), oracle.edges.end());
  for (auto v = triangulation.hidden_vertices_begin(); v != triangulation.hidden_vertices_end(); ++v) {
    oracle.hidden.push_back(ids.at(v->point().point()));
  }
  std::sort(oracle.hidden.begin(), oracle.hidden.end());
  return oracle;
}

/// Random weights of an amplitude relative to the mean squared spacing of n vertices in [−1, 1]².
Mesh weighted_mesh(Rng& rng, int n, double amplitude) {
  Mesh mesh = test::mesh_of_random_points(rng, n);
  for (const VertexId v : mesh.vertices()) mesh.set_weight(v, amplitude * 4 / n * rng.uniform(-1, 1));
  return mesh;
}

TEST(RegularTriangulationOracle, RestoringFindsTheUniqueRegularTriangulation) {
  Rng rng(1);
  std::size_t compared = 0;
  std::size_t flips = 0;
  for (int round = 0; round < 120; ++round) {
    Mesh mesh = weighted_mesh(rng, 5 + 2 * round, round % 3 == 0 ? 0 : 0.02);
    const Restoration restoration = restore_regularity(mesh);
    const Oracle oracle = regular_triangulation(mesh);
    EXPECT_EQ(restoration.regular(), oracle.hidden.empty());
    EXPECT_EQ(restoration.hidden, oracle.hidden);
    if (!oracle.hidden.empty()) continue;
    ++compared;
    flips += restoration.flips;
    EXPECT_EQ(count_non_regular_edges(mesh), 0u);
    EXPECT_EQ(test::edge_set(mesh), oracle.edges);
  }
  EXPECT_GT(compared, 60u);
  EXPECT_GT(flips, 1000u);
}

TEST(RegularTriangulationOracle, HiddenVerticesAreTheSame) {
  Rng rng(2);
  std::size_t hidden = 0;
  for (int round = 0; round < 120; ++round) {
    Mesh mesh = weighted_mesh(rng, 10 + round, round % 2 == 0 ? 0.3 : 2.0);
    const Restoration restoration = restore_regularity(mesh);
    const Oracle oracle = regular_triangulation(mesh);
    EXPECT_EQ(restoration.regular(), oracle.hidden.empty());
    EXPECT_EQ(restoration.hidden, oracle.hidden);
    hidden += oracle.hidden.size();
  }
  EXPECT_GT(hidden, 500u);
}

TEST(RegularTriangulationOracle, RemovingAVertexIsTheTriangulationOfTheOthers) {
  Rng rng(3);
  std::size_t removed = 0, flips = 0;
  Lawson lawson;
  for (int round = 0; round < 40; ++round) {
    Mesh mesh = weighted_mesh(rng, 20 + round, round % 3 == 0 ? 0 : 0.02);
    if (!restore_regularity(mesh).regular()) continue;
    for (int i = 0; i < 12; ++i) {
      const RemovalPlan plan = plan_removal(mesh, VertexId(4 + rng.below(20)));  // 0 … 3 are the corners
      if (plan.status != RemovalStatus::possible) continue;
      remove_vertex(mesh, plan);
      lawson.clear();
      lawson.push_removal(mesh, plan);
      flips += lawson.run(mesh).flips;
      const Oracle oracle = regular_triangulation(mesh);
      EXPECT_TRUE(oracle.hidden.empty());
      EXPECT_EQ(test::edge_set(mesh), oracle.edges);
      ++removed;
    }
  }
  EXPECT_GT(removed, 200u);
  EXPECT_EQ(flips, 0u);  // the plan alone is regular where there are no ties
}

TEST(RegularTriangulationOracle, WithHiddenVerticesRemovedItIsTheWholeAnswer) {
  Rng rng(4);
  std::size_t removed = 0;
  for (int round = 0; round < 60; ++round) {
    Mesh mesh = weighted_mesh(rng, 10 + round, round % 2 == 0 ? 0.3 : 2.0);
    const Oracle oracle = regular_triangulation(mesh);
    const Restoration restoration = restore_regularity(mesh, HiddenPolicy::remove);
    EXPECT_TRUE(restoration.regular());
    EXPECT_EQ(restoration.hidden, oracle.hidden);
    EXPECT_EQ(restoration.removed.size(), oracle.hidden.size());
    EXPECT_EQ(test::edge_set(mesh), oracle.edges);
    EXPECT_EQ(mesh.validate(), std::nullopt);
    removed += restoration.removed.size();
  }
  EXPECT_GT(removed, 300u);
}

TEST(KernelOracle, PowerTestAndOrientationAreThoseOfCgal) {
  const auto power_side = Kernel().power_side_of_oriented_power_circle_2_object();
  const auto orientation = Kernel().orientation_2_object();
  int ties = 0;
  for (const testing::Family& family : testing::degenerate_families()) {
    SCOPED_TRACE(family.name);
    testing::Random random(4);
    int wrong = 0;
    for (int round = 0; round < 200; ++round) {
      const auto [a, b, c, d] = family.draw(random);
      const auto truth = power_side(to_cgal(a), to_cgal(b), to_cgal(c), to_cgal(d));
      const auto turn = orientation(to_cgal(a).point(), to_cgal(b).point(), to_cgal(c).point());
      ties += truth == CGAL::ON_ORIENTED_BOUNDARY;
      wrong += static_cast<int>(power_test(a, b, c, d)) != static_cast<int>(truth);
      wrong += static_cast<int>(orient2d(a.position(), b.position(), c.position())) != static_cast<int>(turn);
    }
    EXPECT_EQ(wrong, 0);
  }
  EXPECT_GT(ties, 200);
}

}  // namespace
}  // namespace temper
