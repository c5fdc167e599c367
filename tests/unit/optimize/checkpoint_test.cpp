// Checkpoints: a run that is resumed, wherever it was stopped, ends as the run that was not stopped.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/rng.hpp"
#include "support/lattice.hpp"
#include "support/regions.hpp"
#include "support/sanitizers.hpp"
#include "support/shapes.hpp"
#include "support/std_threads.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"

namespace temper::test {
namespace {

/// A state of a run, and how many events were told before it.
struct Stop {
  std::string state;
  std::size_t events = 0;
};

struct Outcome {
  Mesh mesh;
  OptimizeReport report;
  std::vector<TraceEvent> events;
  std::vector<Stop> stops;
};

Outcome run_traced(const Mesh& input, const OptimizeOptions& options, std::string_view resume = {},
                   bool takes_states = false) {
  OptimizeHooks hooks;
  hooks.resume = resume;
  Outcome outcome;
  outcome.mesh = input;
  hooks.tracer = [&](const TraceEvent& e) { outcome.events.push_back(e); };
  if (takes_states) {
    hooks.checkpoints = [&](const auto& state) { outcome.stops.push_back({state(), outcome.events.size()}); };
  }
  Expected<OptimizeReport> report = optimize(outcome.mesh, options, hooks);
  if (report) {
    outcome.report = *std::move(report);
  } else {
    ADD_FAILURE() << report.error().what();
  }
  return outcome;
}

void expect_same(const SizeReport& a, const SizeReport& b) {
  EXPECT_EQ(a.over_field.min, b.over_field.min);
  EXPECT_EQ(a.over_field.max, b.over_field.max);
  EXPECT_EQ(a.gradation.median, b.gradation.median);
  EXPECT_EQ(a.largest_edge_ratio, b.largest_edge_ratio);
}

/// All but the times.
void expect_same(const OptimizeReport& a, const OptimizeReport& b) {
  EXPECT_EQ(a.stopped, b.stopped);
  EXPECT_EQ(a.sweeps, b.sweeps);
  EXPECT_EQ(a.flips, b.flips);
  EXPECT_EQ(a.vertices_removed, b.vertices_removed);
  EXPECT_EQ(a.vertices_inserted, b.vertices_inserted);
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.hidden, b.hidden);
  EXPECT_EQ(a.initial_energy, b.initial_energy);
  EXPECT_EQ(a.final_energy, b.final_energy);
  expect_same(a.size.before, b.size.before);
  expect_same(a.size.after, b.size.after);
  EXPECT_EQ(a.notes, b.notes);
  ASSERT_EQ(a.history.size(), b.history.size());
  for (std::size_t i = 0; i < a.history.size(); ++i) {
    const auto& [sweep, energy, bad, flips, softening, seconds, objective] = a.history[i];
    const SweepRecord& other = b.history[i];
    EXPECT_EQ(sweep, other.sweep);
    EXPECT_EQ(energy, other.energy);
    EXPECT_EQ(bad, other.bad);
    EXPECT_EQ(flips, other.flips);
    EXPECT_EQ(softening, other.softening);
    EXPECT_EQ(objective, other.objective);
  }
}

/// As events are when they are written: kNoEnergy is not equal to itself.
bool same_event(TraceEvent a, TraceEvent b) {
  for (double* energy : {&a.before, &a.after, &b.before, &b.after}) {
    if (std::isnan(*energy)) *energy = 0;
  }
  return a == b;
}

void expect_end_of(const std::vector<TraceEvent>& whole, std::size_t begin, const std::vector<TraceEvent>& end) {
  ASSERT_EQ(begin + end.size(), whole.size());
  for (std::size_t i = 0; i < end.size(); ++i) {
    ASSERT_TRUE(same_event(whole[begin + i], end[i])) << "event " << begin + i;
  }
}

/// Every so many of the stops, so that about a dozen are tried, the last ones among them.
std::vector<Stop> some_of(const std::vector<Stop>& stops) {
  constexpr std::size_t kTried = TEMPER_SANITIZED ? 4 : 12;
  std::vector<Stop> some;
  for (std::size_t i = stops.size(); i > 0; i -= std::min(i, 1 + stops.size() / kTried)) some.push_back(stops[i - 1]);
  return some;
}

struct ResumedCase {
  const char* name;
  Mesh (*mesh)();
  OptimizeOptions options;
};

Mesh random_mesh() { return *random_points({.vertices = 120, .seed = 5}); }
Mesh large_random_mesh() { return *random_points({.vertices = 1200, .seed = 3}); }
Mesh random_torus() { return *random_periodic({.vertices = 120, .seed = 5}); }
Mesh regions() { return mesh_with_regions(150, 3); }
Mesh with_margins() { return lattice({.n = 8, .jitter = 0.1, .weight = 0.06, .seed = 4}); }
/// Two attempts, then repairs.
Mesh hard_mesh() { return *horseshoe(); }
Mesh without_inside() { return *regular_polygon({.corners = 20}); }
Mesh sharp_corner() { return *wedge(); }
Mesh sheared() { return *sheared_grid({.nx = 9, .ny = 8, .shear = 0.3}); }
/// Squares cut by parallel diagonals, without a vertex inside.
Mesh strip() { return *sheared_grid({.nx = 20, .ny = 1, .shear = 0}); }

OptimizeOptions paper_with_regular_edges() {
  OptimizeOptions o = paper_method();
  o.energy = EnergyKind::dT;
  o.paper.inversion = Inversion::refuse;
  o.paper.hidden = HiddenPolicy::undo;
  o.paper.stopping = StoppingRule::relative;
  o.max_sweeps = 12;
  return o;
}

class ResumedRun : public testing::TestWithParam<ResumedCase> {};

TEST_P(ResumedRun, EndsAsTheRunThatWasNotStopped) {
  const Mesh input = GetParam().mesh();
  const OptimizeOptions& options = GetParam().options;
  const Outcome plain = run_traced(input, options);
  const Outcome whole = run_traced(input, options, {}, true);
  EXPECT_TRUE(plain.mesh == whole.mesh);
  expect_same(plain.report, whole.report);
  expect_end_of(plain.events, 0, whole.events);
  ASSERT_GE(whole.stops.size(), static_cast<std::size_t>(3)) << "too few places to stop at";

  std::size_t tried = 0;
  for (const Stop& stop : some_of(whole.stops)) {
    SCOPED_TRACE(testing::Message() << "from " << stop.events << " events on");
    const Outcome rest = run_traced(input, options, stop.state);
    EXPECT_TRUE(rest.mesh == whole.mesh);
    expect_same(rest.report, whole.report);
    expect_end_of(whole.events, stop.events, rest.events);
    ++tried;
  }
  EXPECT_GT(tried, 2u);
}

INSTANTIATE_TEST_SUITE_P(
    Options, ResumedRun,
    testing::Values(
        ResumedCase{"default", random_mesh, {}}, ResumedCase{"batches", large_random_mesh, {.max_sweeps = 25}},
        ResumedCase{"periodic", random_torus, {}},
        ResumedCase{"hot", random_mesh, {.energy = EnergyKind::T, .max_sweeps = 15}},
        ResumedCase{"rising_energy", regions, {.energy = EnergyKind::dT, .max_sweeps = 12}},
        ResumedCase{"shifted_barrier", random_mesh, {.energy = EnergyKind::BHs}},
        ResumedCase{"weights_later", random_mesh, {.paper = {.weights_from = 5}}},
        ResumedCase{"random_order", regions, {.paper = {.order = SweepOrder::random, .seed = 7}}},
        ResumedCase{"deferred_flips", regions, {.flips = Flips::deferred, .paper = {.inner = 2}}},
        ResumedCase{"paper", regions, paper_method()},
        ResumedCase{"paper_regular", regions, paper_with_regular_edges()},
        ResumedCase{"hidden_removed",
                    random_mesh,
                    {.energy = EnergyKind::F, .max_sweeps = 12, .paper = {.hidden = HiddenPolicy::remove}}},
        ResumedCase{"removal", random_mesh, {.paper = {.removal = Removal::patch, .removal_from = 2}}},
        ResumedCase{"insertion",
                    random_mesh,
                    {.energy = EnergyKind::T,
                     .max_sweeps = 8,
                     .paper = {.removal_measure = RemovalMeasure::sum, .insertion_from = 1, .insertion_ratio = 1.5}}},
        ResumedCase{"first_energy", random_mesh, {.paper = {.first_energy = EnergyKind::dT, .switch_at = 4}}},
        ResumedCase{
            "all_deferred",
            random_mesh,
            {.max_sweeps = 8, .paper = {.weight_updates = Updates::deferred, .position_updates = Updates::deferred}}},
        ResumedCase{"size_band", random_mesh, {.size_band = 2}},
        ResumedCase{
            "sliding", regions, {.boundary = BoundaryVertices::slide, .interfaces = InterfaceVertices::sliding}},
        ResumedCase{"split_boundary", letter_a, {.boundary = BoundaryVertices::split}},
        ResumedCase{"attempts", sharp_corner, {.repair = Repair::none}}, ResumedCase{"ties", strip, {}},
        ResumedCase{"ties_among_others", sheared, {}}, ResumedCase{"repair_by_moves", hard_mesh, {.repair_trials = 40}},
        ResumedCase{"repair_by_vertices", without_inside, {.repair = Repair::vertices}},
        ResumedCase{"repair_in_vain", hard_mesh, {.repair = Repair::vertices, .repair_trials = 60}},
        ResumedCase{"accuracy", with_margins, {.objective = Objective::accuracy}},
        ResumedCase{"accuracy_after_attempts",
                    regions,
                    {.objective = Objective::accuracy, .boundary = BoundaryVertices::split}}),
    [](const auto& one) { return std::string(one.param.name); });

TEST(Checkpoints, OfARunOnThreadsAreResumedOnAnyNumberOfThem) {
  const Mesh input =
      *random_points({.vertices = TEMPER_SANITIZED ? 17000 : 30000, .seed = 2});  // two parts, which passes shift
  StdThreads two(2), three(3);
  std::vector<std::string> states;
  OptimizeHooks hooks;
  hooks.executor = &two;
  hooks.checkpoints = [&](const auto& state) { states.push_back(state()); };
  Mesh whole = input;
  const auto report = optimize(whole, {}, hooks);
  ASSERT_TRUE(report);
  ASSERT_GT(states.size(), 12u);
  ASSERT_LT(states.size(), static_cast<std::size_t>(report->sweeps)) << "no Newton passes";
  for (const std::size_t before_end : {2, 5}) {
    if (TEMPER_SANITIZED && before_end == 5) continue;
    for (Executor* executor : {static_cast<Executor*>(nullptr), static_cast<Executor*>(&three)}) {
      OptimizeHooks again;
      again.executor = executor;
      again.resume = states[states.size() - before_end];
      Mesh resumed = input;
      const auto rest = optimize(resumed, {}, again);
      ASSERT_TRUE(rest);
      EXPECT_TRUE(resumed == whole);
      expect_same(*rest, *report);
    }
  }
}

// --- states that cannot be resumed ----------------------------------------------------------------------------------

/// A state in the middle of a run that repairs, and what it is of.
struct Given {
  Mesh mesh = without_inside();
  OptimizeOptions options = {.repair = Repair::vertices};
  std::string state;

  Given() {
    const Outcome whole = run_traced(mesh, options, {}, true);
    state = whole.stops[whole.stops.size() - 4].state;
  }
  [[nodiscard]] InputError refusal(std::string_view changed) const { return refusal(changed, options); }
  [[nodiscard]] InputError refusal(std::string_view changed, const OptimizeOptions& other) const {
    OptimizeHooks hooks;
    hooks.resume = changed;
    Mesh copy = mesh;
    const auto report = optimize(copy, other, hooks);
    EXPECT_TRUE(copy == mesh);
    if (!report) return report.error();
    ADD_FAILURE() << "was resumed";
    return {};
  }
};

TEST(Checkpoints, ThatAreDamagedCutOffOrForeignAreRefused) {
  const Given given;
  const std::string& state = given.state;
  EXPECT_EQ(given.refusal("# vtk DataFile Version 3.0\n").code, ErrorCode::syntax);
  EXPECT_EQ(given.refusal("temper run state, version 0.0.1\nabc").code, ErrorCode::unsupported);
  EXPECT_EQ(given.refusal(state + "x").code, ErrorCode::syntax);
  Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    const std::size_t at = rng.below(static_cast<std::uint32_t>(state.size()));
    EXPECT_NE(given.refusal(std::string_view(state).substr(0, std::max<std::size_t>(1, at))).code,
              ErrorCode::checkpoint_mismatch);
    std::string changed = state;
    changed[at] = static_cast<char>(changed[at] ^ (1 << rng.below(8)));
    EXPECT_FALSE(given.refusal(changed).message.empty());
  }
}

TEST(Checkpoints, OfAnotherMeshOrOtherOptionsAreRefused) {
  Given given;
  OptimizeOptions other = given.options;
  other.paper.seed = 2;
  EXPECT_EQ(given.refusal(given.state, other).code, ErrorCode::checkpoint_mismatch);
  other = given.options;
  other.time_limit = 1000;  // the only option that a result does not depend on
  OptimizeHooks hooks;
  hooks.resume = given.state;
  Mesh copy = given.mesh;
  EXPECT_TRUE(optimize(copy, other, hooks));
  given.mesh.set_weight(VertexId(0), 1e-9);
  EXPECT_EQ(given.refusal(given.state).code, ErrorCode::checkpoint_mismatch);
}

TEST(Checkpoints, AddUpTheTimesOfRunsAndLimitEachOne) {
  const Mesh input = random_mesh();
  OptimizeHooks hooks;
  std::string state;
  hooks.checkpoints = [&](const auto& now) { state = now(); };
  hooks.observer = [](const Progress&) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(20);
    while (std::chrono::steady_clock::now() < until) continue;
    return Continue::yes;
  };
  Mesh mesh = input;
  const auto whole = optimize(mesh, {}, hooks);
  ASSERT_TRUE(whole);
  const double limit = 0.75 * whole->seconds;  // the last sweep alone takes less
  OptimizeHooks again;
  again.resume = state;
  mesh = input;
  const auto rest = optimize(mesh, {.time_limit = limit}, again);
  ASSERT_TRUE(rest);
  EXPECT_EQ(rest->stopped, whole->stopped);
  EXPECT_GT(rest->seconds, limit);
}

}  // namespace
}  // namespace temper::test
