// Repairs by weights from a linear program, for triangles that sweeps leave bad and weights can cure.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "optimize/repair/trial.hpp"
#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "temper/detail/criterion.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"
#include "temper/regularity.hpp"
#include "temper/solvers.hpp"

namespace temper {
namespace {

TEST(RepairByProgram, CuresWhatSweepsLeave) {
  const Mesh input = *horseshoe({.a = 6, .b = 7});
  Mesh swept = input, reweighted = input;
  const auto without = optimize(swept), with = optimize(reweighted, {}, {.solvers = solvers()});
  ASSERT_TRUE(without && with);
  EXPECT_GT(defect_of(swept).bad, 0u);
  EXPECT_EQ(defect_of(reweighted).bad, 0u);
  EXPECT_EQ(count_non_regular_edges(reweighted), 0u);
  EXPECT_EQ(reweighted.validate(), std::nullopt);
  const auto says_so = [](const std::string& note) { return note.starts_with("repairs had no solver of linear"); };
  EXPECT_EQ(std::count_if(without->notes.begin(), without->notes.end(), says_so), 1);
  EXPECT_EQ(std::count_if(with->notes.begin(), with->notes.end(), says_so), 0);
}

TEST(RepairByProgram, IsTracedLikeAllElse) {
  const Mesh input = *horseshoe({.a = 6, .b = 7});
  std::vector<TraceEvent> events;
  Mesh mesh = input;
  OptimizeHooks hooks;
  hooks.solvers = solvers();
  hooks.tracer = [&](const TraceEvent& e) { events.push_back(e); };
  ASSERT_TRUE(optimize(mesh, {}, hooks));
  const auto again = replay(input, events);
  ASSERT_TRUE(again) << again.error().what();
  EXPECT_EQ(*again, mesh);
}

TEST(RepairByProgram, OfAPlaceChangesWeightsNearItAndNoneOfTheRim) {
  const Mesh mesh = test::layers({.columns = 10, .rows = 20, .growth = 1.7});
  const OptimizeOptions options;
  auto settings = make_settings(options, mesh, WorkingUnits::of(mesh), {.solvers = solvers()});
  ASSERT_TRUE(settings);
  std::size_t cured = 0;
  for (std::size_t t = 0; t < mesh.n_triangles(); t += 37) {
    const Neighborhood around = neighborhood_of(WorkingCopy::part(mesh), TriangleId(t), 3);
    const TrialResult result =
        try_edit(around, AssignWeights{}, *settings, WorkingUnits::of(mesh), {.with_events = true});
    if (!result.valid) continue;
    cured += result.defect < defect_of(around.mesh) ? 1 : 0;
    for (const TraceEvent& e : result.events) {
      if (e.kind != EventKind::weight) continue;
      EXPECT_EQ(around.frozen[e.vertex.index], 0);
      EXPECT_EQ(e.point.position(), around.mesh.position(e.vertex));
    }
  }
  EXPECT_GT(cured, 0u);
}

// With the least change, weights come before moves.
TEST(RepairByProgram, ChangesWeightsBeforePositions) {
  Mesh input = test::lattice({.n = 40, .jitter = 0, .weight = 0});
  for (std::size_t i = 85; i < 1500; i += 97) {
    const VertexId v(i);
    if (!input.is_boundary(v)) input.set_position(v, input.position(v) + Vec2{0.3, 0.25});
  }
  for (const Scheme scheme : {Scheme::all, Scheme::vertex, Scheme::cell}) {
    SCOPED_TRACE(static_cast<int>(scheme));
    const OptimizeOptions options = {.scheme = scheme, .change = Change::least};
    Mesh moved = input, weighed = input;
    const auto without = optimize(moved, options), with = optimize(weighed, options, {.solvers = solvers()});
    ASSERT_TRUE(without && with);
    EXPECT_TRUE(meets(weighed, criterion_of(scheme)));
    EXPECT_EQ(with->changed->vertices_moved, 0u);
    const bool flips_are_enough = without->changed->vertices_moved == 0 && without->changed->weights_changed == 0;
    EXPECT_EQ(with->changed->weights_changed == 0, flips_are_enough);
  }
}

}  // namespace
}  // namespace temper
