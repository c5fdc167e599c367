// The search over connectivities: what it must keep, and what it finds where the answer is known.
#include "temper/detail/connectivity.hpp"

#include "temper/regularity.hpp"
#include "unit/feasibility/all_triangulations.hpp"

namespace temper::test {
namespace {

ConnectivityReport search(const Mesh& mesh, const ConnectivityOptions& options = {}) {
  const auto solver = clp_solver();
  auto report = best_connectivity(mesh, *solver, options);
  if (!report) {
    ADD_FAILURE() << report.error().what();
    return {};
  }
  return *std::move(report);
}

void expect_laws(const Mesh& mesh, Constraints constraints) {
  const ConnectivityReport report = search(mesh, {.constraints = constraints});
  SCOPED_TRACE(testing::Message() << name(constraints) << ", " << mesh.n_vertices() << " vertices, "
                                  << report.steps.size() << " steps, " << report.before << " to " << report.margin);
  EXPECT_EQ(report.end, report.margin > 0 ? SearchEnd::no_better_neighbor : SearchEnd::none_exists);
  EXPECT_EQ(report.mesh.validate(), std::nullopt);
  double last = report.before;
  EXPECT_NEAR(report.before, margin_of(mesh, constraints).margin, 1e-8);
  for (const ConnectivityStep& step : report.steps) {
    EXPECT_GT(step.margin, last);
    EXPECT_GT(step.flips, 0u);
    last = step.margin;
  }
  EXPECT_EQ(report.margin, last);
  EXPECT_NEAR(report.margin, margin_of(report.mesh, constraints).margin, 1e-8);
  EXPECT_NEAR(weight_margin(with_weights(report.mesh, report.weights), constraints), report.margin, 1e-7);
  if (report.margin > 1e-7) {
    EXPECT_EQ(count_non_regular_edges(with_weights(report.mesh, report.weights)), 0u);
  }
  ASSERT_EQ(report.mesh.n_vertices(), mesh.n_vertices());
  for (const VertexId v : mesh.vertices()) EXPECT_EQ(report.mesh.point(v), mesh.point(v));
  const auto boundary = [](const Mesh& m) { return [&m](HalfedgeId h) { return m.is_boundary(h); }; };
  const auto constrained = [](const Mesh& m) { return [&m](HalfedgeId h) { return m.is_constrained(h); }; };
  EXPECT_EQ(edges_of(mesh, boundary(mesh)), edges_of(report.mesh, boundary(report.mesh)));
  EXPECT_EQ(edges_of(mesh, constrained(mesh)), edges_of(report.mesh, constrained(report.mesh)));
}

TEST(BestConnectivity, NeverLosesMarginPointsBoundaryOrLines) {
  for (const Constraints constraints : {Constraints::well_centered, Constraints::heights_only}) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      expect_laws(jittered_lattice(seed, 5), constraints);
      Mesh lined = jittered_lattice(seed, 5);
      for (const HalfedgeId h : lined.halfedges()) {
        if (h.index % 5 == 0 && !lined.is_boundary(h)) lined.set_constrained(h, true);
      }
      expect_laws(lined, constraints);
    }
    expect_laws(sparse_horseshoe(), constraints);
  }
}

TEST(BestConnectivity, OfTheSparseHorseshoeIsTheBestOfAllItsTriangulations) {
  for (const Constraints constraints : {Constraints::well_centered, Constraints::heights_only}) {
    std::size_t triangulations = 0;
    const double best = best_of_all(sparse_horseshoe(), constraints, triangulations);
    EXPECT_NEAR(search(sparse_horseshoe(), {.constraints = constraints}).margin, best, 1e-8) << name(constraints);
    EXPECT_EQ(triangulations, 1u);  // none of its edges can be flipped
  }
}

// A local search: no proof says that it finds the best, and it does not always. What it finds is never more.
TEST(BestConnectivity, IsNoBetterThanTheBestOfAllAndOftenThat) {
  std::size_t tried = 0, found = 0, better = 0, triangulations = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Rng rng(seed);
    const Mesh mesh = mesh_of_random_points(rng, 3);
    if (mesh.n_triangles() > 10) continue;
    const ConnectivityReport report = search(mesh);
    const double best = best_of_all(mesh, Constraints::well_centered, triangulations);
    EXPECT_LE(report.margin, best + 1e-8) << seed;
    ++tried, found += report.margin > best - 1e-6 ? 1 : 0, better += report.margin > report.before + 1e-6 ? 1 : 0;
  }
  EXPECT_GT(tried, 10u);
  EXPECT_GT(better, 0u);
  EXPECT_GT(2 * found, tried) << found << " of " << tried << ", " << triangulations << " triangulations";
}

TEST(BestConnectivity, StopsWhereNothingIsAllowed) {
  const ConnectivityReport none = search(jittered_lattice(1, 5), {.programs = 0});
  EXPECT_TRUE(none.steps.empty());
  EXPECT_EQ(none.end, SearchEnd::limit);
  const ConnectivityReport one = search(jittered_lattice(1, 5), {.programs = 1});
  EXPECT_EQ(one.end, SearchEnd::limit);
  EXPECT_EQ(one.programs, 1u);
  EXPECT_EQ(one.before, one.margin);
  const auto solver = clp_solver();
  EXPECT_FALSE(best_connectivity(sparse_horseshoe(), *solver, {.constraints = Constraints::regular}));
}

}  // namespace
}  // namespace temper::test
