// Orders of convergence, and the refinement that they are measured on.
#include <gtest/gtest.h>

#include <cmath>

#include "errors/poisson.hpp"
#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "temper/dec.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/errors.hpp"
#include "temper/regularity.hpp"

namespace temper::test {
namespace {

using error_detail::refined;

TEST(ErrorRefine, KeepsTheDomainItsRegionsAndItsConstrainedEdges) {
  const Mesh mesh = mesh_with_regions(60, 3);
  const Mesh finer = *refined(mesh);
  EXPECT_FALSE(finer.validate().has_value());
  EXPECT_EQ(finer.n_vertices(), mesh.n_vertices() + mesh.n_edges());
  EXPECT_EQ(finer.n_triangles(), 4 * mesh.n_triangles());
  EXPECT_NEAR(area(finer), area(mesh), 1e-14 * area(mesh));
  const auto constrained = [](const Mesh& m) {
    double sum = 0;
    for (const HalfedgeId h : m.halfedges()) {
      if (m.is_edge_representative(h) && m.is_constrained(h)) {
        sum += length(m.position(m.origin(h)) - m.position(m.target(h)));
      }
    }
    return sum;
  };
  const auto area_of_region_1 = [](const Mesh& m) {
    double sum = 0;
    for (const TriangleId t : m.triangles()) {
      const auto [a, b, c] = m.corners(t);
      if (m.region(t) == 1) sum += 0.5 * doubled_area(m.position(a), m.position(b), m.position(c));
    }
    return sum;
  };
  EXPECT_GT(constrained(mesh), 0);
  EXPECT_NEAR(constrained(finer), constrained(mesh), 1e-12);
  EXPECT_NEAR(area_of_region_1(finer), area_of_region_1(mesh), 1e-12);
  EXPECT_EQ(count_non_regular_edges(finer, false), 0u);
}

TEST(ErrorRefine, HalvesOfEdgesHaveHalfOfTheDualAndCornersAreSimilar) {
  const Mesh mesh = lattice({.n = 5, .jitter = 0.03, .weight = 0.04});  // acute: no flips
  const Mesh finer = *refined(mesh);
  const DecComplex coarse = dec_operators(mesh), fine = dec_operators(finer);
  const std::size_t n = mesh.n_vertices();
  for (std::size_t e = 0; e < coarse.edges.size(); ++e) {
    const DecEdge& edge = coarse.edges[EdgeId(e)];
    const VertexId middle(n + e);
    for (const VertexId end : {edge.from, edge.to}) {
      const HalfedgeId h = finer.find_halfedge(end, middle);
      ASSERT_TRUE(h.valid() || finer.find_halfedge(middle, end).valid());
      const EdgeId half = fine.edge_of_halfedge[h.valid() ? h : finer.find_halfedge(middle, end)];
      EXPECT_NEAR(fine.edges[half].dual_length, 0.5 * edge.dual_length, 1e-14);
      EXPECT_NEAR(fine.edges[half].crossing, 0.5 * (end == edge.from ? edge.crossing : edge.length - edge.crossing),
                  1e-14);
    }
  }
}

TEST(ErrorOrders, AreTwoOnWellCenteredFamilies) {
  const Mesh mesh = lattice({.n = 5, .jitter = 0.1, .weight = 0});
  const auto report = measure_errors(mesh, {.refine = 4});
  ASSERT_TRUE(report) << report.error().what();
  ASSERT_EQ(report->levels.size(), 5u);
  for (const ErrorLevel& level : report->levels) EXPECT_EQ(level.not_well_centered, 0u);
  EXPECT_EQ(report->levels[0].triangles, report->triangles);
  EXPECT_EQ(report->levels[4].triangles, 256 * report->triangles);
  const OperatorErrors orders = arithmetic_mean(report->orders);
  EXPECT_NEAR(orders.poisson.l2, 2, 0.1);
  EXPECT_NEAR(orders.flux.l2, 2, 0.1);
  // Second order inside of the first triangles, where a refined mesh is symmetric; first on their edges and on the
  // boundary, whose share falls as the length: one and a half in L2, one in the maximum.
  EXPECT_NEAR(orders.star[1].l2, 1.5, 0.15);
  EXPECT_NEAR(orders.star[1].max, 1, 0.15);
}

TEST(ErrorOrders, AreThoseOfTheEdgeLengthByLeastSquares) {
  std::vector<ErrorLevel> levels(4);
  const double noise[] = {1, 1.1, 1, 1.1};
  for (std::size_t i = 0; i < levels.size(); ++i) {
    OperatorErrors errors;
    errors.poisson = {3 * std::pow(0.25, static_cast<double>(i)), noise[i]};
    errors.flux = {0, i == 2 ? HUGE_VAL : std::pow(0.5, static_cast<double>(i))};
    errors.star[0] = {i == 1 ? 1.0 : 0.0, 1};
    levels[i].fields = {{error_fields()[0], errors}};
  }
  const OperatorErrors orders = error_detail::convergence_orders(levels)[0].errors;
  EXPECT_NEAR(orders.poisson.l2, 2, 1e-14);
  EXPECT_NEAR(orders.poisson.max, -0.2 * std::log2(1.1), 1e-14);  // Σ (i − 3/2) y / 5
  EXPECT_TRUE(std::isnan(orders.flux.l2));                        // no error at all
  EXPECT_NEAR(orders.flux.max, 1, 1e-14);                         // from the levels that could be solved
  EXPECT_TRUE(std::isnan(orders.star[0].l2));                     // one level is none
}

}  // namespace
}  // namespace temper::test
