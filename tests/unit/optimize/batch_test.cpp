// Batches of vertices make the steps that each vertex would make alone, with the same bits in every instruction set.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "base/rng.hpp"
#include "energy/accuracy_energy.hpp"
#include "energy/patch.hpp"
#include "energy/star_kernels.hpp"
#include "energy/whole_mesh.hpp"
#include "geometry/predicates_inline.hpp"
#include "optimize/accuracy/accuracy_sizes.hpp"
#include "optimize/batch/star_batch.hpp"
#include "optimize/stages/driver.hpp"
#include "support/lattice.hpp"
#include "temper/detail/instruction_set.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"
#include "temper/regularity.hpp"

namespace temper::test {
namespace {

constexpr std::size_t kBatchVertices = 1500;

/// The instruction set that was in use comes back at the end of a test.
class KeepInstructionSet {
 public:
  ~KeepInstructionSet() { use_instruction_set(set_); }

 private:
  InstructionSet set_ = instruction_set();
};

/// Weighted, and with triangles that are not well-centered, when few sweeps have been made.
Mesh swept_mesh(int sweeps, std::uint64_t seed = 1) {
  Mesh mesh = *random_mesh({.vertices = kBatchVertices, .seed = seed});
  EXPECT_TRUE(optimize(mesh, {.repair = Repair::none, .max_sweeps = sweeps}));
  return mesh;
}

EnergyModel barrier_model(EnergyKind kind, Star star) {
  EnergyModel model;
  model.kind = kind;
  model.star = star;
  model.gamma = {0.1, LengthScale::relative};
  model.h0 = {5, LengthScale::relative};
  return model;
}

/// The model and domain of an accuracy run.
struct AccuracyTask {
  AccuracyModel model;
  AccuracyDomain domain;
};

/// A single vertex of a mesh's working copy, which steps as VertexStep does.
struct Alone {
  Alone(const Mesh& mesh, const AccuracyTask& task) : Alone(mesh, EnergyModel{.kind = EnergyKind::BP}, &task) {}
  Alone(const Mesh& mesh, const EnergyModel& model, const AccuracyTask* task = nullptr)
      : work(WorkingCopy::part(mesh)),
        settings(settings_of(work, model, task)),
        state(settings),
        recorder(settings.hooks.tracer, work, 1),
        flipper(work.mesh, settings, state, recorder),
        limits(work, settings, work.units),
        step({work.mesh, settings, with_domain(state, task), work.units, limits, recorder}, flipper) {}

  static Settings settings_of(const WorkingCopy& work, const EnergyModel& model, const AccuracyTask* task) {
    OptimizeOptions options;
    options.energy = model.kind;
    if (task != nullptr) options.flips = Flips::none;
    Settings settings = *make_settings(options, work.mesh, work.units);
    settings.model = model;
    if (task != nullptr) settings.accuracy = task->model;
    return settings;
  }
  static const SweepState& with_domain(SweepState& state, const AccuracyTask* task) {
    state.flip_limit = FlipLimit::unlimited;
    if (task != nullptr) state.accuracy_domain = &task->domain;
    return state;
  }

  WorkingCopy work;
  Settings settings;
  SweepState state;
  Recorder recorder;
  Flipper flipper;
  VertexLimits limits;
  VertexStep step;
};

/// Puts the star of v into a lane of a batch. All data come from the patch.
void put(const Mesh& mesh, VertexId v, StarBatch& batch) {
  const std::size_t lane = batch.lanes++;
  Patch patch;
  gather_patch(mesh, v, false, patch);
  batch.p.set(lane, mesh.point(v));
  batch.triangles[lane] = static_cast<double>(patch.size());
  batch.open[lane] = patch.closed ? 0 : -1;
  batch.moves[lane] = patch.closed ? -1 : 0;
  batch.changes_weight[lane] = -1;
  batch.most_triangles = std::max(batch.most_triangles, patch.size());
  for (std::size_t i = 0; i <= patch.size(); ++i) batch.link[i].set(lane, patch.q(i));
  for (std::size_t i = 0; i < patch.size(); ++i) {
    const HalfedgeId spoke = patch.spoke[i], across = mesh.twin(Mesh::next(spoke));
    batch.across[i].set(lane, across.valid() ? mesh.point(mesh.opposite(across)) : WeightedPoint{});
    batch.link_flips[i][lane] = across.valid() ? -1 : 0;
    batch.spoke_flips[i][lane] = mesh.twin(spoke).valid() ? -1 : 0;
  }
}

void leave_empty(StarBatch& batch, std::size_t from) {
  for (std::size_t lane = from; lane < kLanes; ++lane) {
    batch.triangles[lane] = 0;
    batch.open[lane] = batch.moves[lane] = batch.changes_weight[lane] = 0;
  }
}

bool edges_around_are_regular(const Mesh& mesh, VertexId v) {
  for (const HalfedgeId h : mesh.star(v)) {
    if (!is_regular(mesh, h) || !is_regular(mesh, Mesh::next(h))) return false;
  }
  return true;
}

class BatchOfBarrier : public testing::TestWithParam<std::tuple<EnergyKind, int>> {};

TEST_P(BatchOfBarrier, MakesTheStepsThatVerticesMakeAlone) {
  const auto [kind, star] = GetParam();
  const EnergyModel model = barrier_model(kind, Star(star));
  const Mesh mesh = swept_mesh(kind == EnergyKind::BH ? 40 : 3);
  const StepParameters parameters{edge_formula(model), kRelaxation, 0, 0};
  std::size_t stepped = 0, regular = 0;
  for (std::size_t first = 0; first + kLanes <= mesh.n_vertices(); first += kLanes) {
    StarBatch batch;
    for (std::size_t i = 0; i < kLanes - 1; ++i) put(mesh, VertexId(first + i), batch);
    leave_empty(batch, batch.lanes);
    const StepOutcome outcome = batch_steps(Space()).barrier(parameters, batch);
    EXPECT_EQ(outcome.stepped & outcome.alone, 0U);
    EXPECT_EQ(outcome.regular & ~outcome.stepped, 0U);
    EXPECT_EQ((outcome.stepped | outcome.alone) >> batch.lanes, 0U);
    for (std::size_t lane = 0; lane < batch.lanes; ++lane) {
      if ((outcome.stepped >> lane & 1) == 0) continue;
      const VertexId v(first + lane);
      Patch patch;
      gather_patch(mesh, v, false, patch);
      const double before = patch_energy(patch, model, mesh.point(v));
      const double after = patch_energy(patch, model, batch.to.at(lane));
      EXPECT_NEAR(batch.before[lane], before, 1e-12 * before);
      EXPECT_NEAR(batch.after[lane], after, 1e-12 * after);
      EXPECT_LT(batch.after[lane], batch.before[lane]);
      ++stepped;
      Alone alone(mesh, model);
      alone.work.mesh.set_point(v, batch.to.at(lane));
      const bool certain = (outcome.regular >> lane & 1) != 0;
      EXPECT_TRUE(!certain || edges_around_are_regular(alone.work.mesh, v));
      if (!certain) continue;
      ++regular;
      alone.work.mesh.set_point(v, mesh.point(v));
      ASSERT_TRUE(alone.step.improve(v));
      const WeightedPoint expected = alone.work.mesh.point(v), to = batch.to.at(lane);
      const double radius = std::sqrt(
          std::abs(cross(patch.q(1).position() - patch.q(0).position(), mesh.position(v) - patch.q(0).position())));
      EXPECT_NEAR(to.x, expected.x, 1e-7 * radius);
      EXPECT_NEAR(to.y, expected.y, 1e-7 * radius);
      EXPECT_NEAR(to.w, expected.w, 1e-7 * radius * radius);
    }
  }
  EXPECT_GT(regular, mesh.n_vertices() / 3);
  EXPECT_GE(stepped, regular);
}

INSTANTIATE_TEST_SUITE_P(All, BatchOfBarrier,
                         testing::Combine(testing::Values(EnergyKind::BH, EnergyKind::BHs, EnergyKind::BP),
                                          testing::Values(0, 1, 2)));

/// Puts the sizes and floors of the star in the last lane.
void put_domain(const Mesh& mesh, VertexId v, const AccuracyTask& task, const StarBatch& batch, AccuracyLanes& lanes) {
  const AccuracyDomain& domain = task.domain;
  const std::size_t lane = batch.lanes - 1;
  Patch patch;
  gather_patch(mesh, v, false, patch);
  lanes.size[lane] = domain.sizes[v];
  for (std::size_t i = 0; i <= patch.size(); ++i) {
    lanes.link_size[i][lane] = domain.sizes[patch.link[i == patch.link.size() ? 0 : i]];
  }
  for (std::size_t i = 0; i < patch.size(); ++i) {
    lanes.floor[i][lane] = domain.floors[Mesh::triangle(patch.spoke[i])];
    lanes.inner[i][lane] = mesh.twin(Mesh::next(patch.spoke[i])).valid() ? -1 : 0;
    const auto length = [&](HalfedgeId h) {
      return !task.model.keeps_lengths() || mesh.is_boundary(h) ? LengthBarrier<double>{}
                                                                : domain.floors.lengths(mesh, h);
    };
    lanes.spoke[i].set(lane, length(patch.spoke[i]));
    lanes.spoke[i + 1].set(lane, length(Mesh::prev(patch.spoke[i])));
    lanes.link[i].set(lane, length(Mesh::next(patch.spoke[i])));
  }
}

AccuracyTask task_of(const Mesh& mesh, double min_edge = 0, double min_dual = 0) {
  AccuracyTask task{AccuracyModel::of(2.0 / 3, 2.0 / 3, 10, 18), {VertexSizes(mesh.n_vertices()), {}}};
  task.model.margin = 0.02, task.model.barrier = 0.003;
  task.model.min_edge = min_edge, task.model.min_dual = min_dual;
  Noise noise(7);
  for (double& s : task.domain.sizes) s = 1 + 0.2 * noise();
  raise_floors(task.domain, mesh, task.model, nullptr);
  return task;
}

struct AccuracyBatch {
  StarBatch stars;
  AccuracyLanes lanes;
  StepOutcome outcome;
};

/// A step of all lanes but one, of vertices from `first` on.
AccuracyBatch accuracy_batch(const Mesh& mesh, const AccuracyTask& task, std::size_t first) {
  AccuracyBatch b;
  for (std::size_t i = 0; i < kLanes - 1; ++i) {
    put(mesh, VertexId(first + i), b.stars);
    put_domain(mesh, VertexId(first + i), task, b.stars, b.lanes);
  }
  leave_empty(b.stars, b.stars.lanes);
  b.outcome = batch_steps(Space()).accuracy({{}, kRelaxation, 0, 0}, task.model, b.lanes, b.stars);
  return b;
}

class BatchOfAccuracy : public testing::TestWithParam<bool> {};

TEST_P(BatchOfAccuracy, MakesTheStepsThatVerticesMakeAlone) {
  const Mesh mesh = lattice({.n = 16, .jitter = 0.1, .weight = 0.06, .seed = 3});
  const AccuracyTask task = GetParam() ? task_of(mesh, 0.9, 0.5) : task_of(mesh);
  std::size_t stepped = 0, on_boundary = 0;
  for (std::size_t first = 0; first + kLanes <= mesh.n_vertices(); first += kLanes) {
    const auto [stars, lanes, outcome] = accuracy_batch(mesh, task, first);
    EXPECT_EQ(outcome.stepped, outcome.regular);
    EXPECT_EQ(outcome.stepped & outcome.alone, 0U);
    EXPECT_EQ((outcome.stepped | outcome.alone) >> stars.lanes, 0U);
    for (std::size_t lane = 0; lane < stars.lanes; ++lane) {
      const VertexId v(first + lane);
      AccuracyPatch patch;
      ASSERT_TRUE(patch.gather(mesh, task.domain.sizes, task.domain.floors, task.model, v));
      const WeightedPoint to = stars.to.at(lane);
      EXPECT_EQ(stars.before[lane], patch.value(mesh.point(v)));  // to the last bit
      EXPECT_EQ(stars.after[lane], patch.value(to));
      if ((outcome.alone >> lane & 1) != 0) continue;
      Alone alone(mesh, task);
      ASSERT_TRUE(alone.step.improve(v));
      const WeightedPoint expected = alone.work.mesh.point(v);
      EXPECT_NEAR(to.x, expected.x, 1e-10);
      EXPECT_NEAR(to.y, expected.y, 1e-10);
      EXPECT_NEAR(to.w, expected.w, 1e-10);
      if ((outcome.stepped >> lane & 1) == 0) continue;
      EXPECT_LT(stars.after[lane], stars.before[lane]);
      EXPECT_TRUE(patch.is_well_centered(to));
      ++stepped;
      on_boundary += mesh.is_boundary(v) ? 1 : 0;
    }
  }
  EXPECT_GT(stepped, mesh.n_vertices() / 2);
  EXPECT_GT(on_boundary, 10U);
}

INSTANTIATE_TEST_SUITE_P(WithoutAndWithLengths, BatchOfAccuracy, testing::Bool());

TEST(BatchesOfAccuracy, MakeTheSameStepsInEveryInstructionSet) {
  const KeepInstructionSet keep;
  const Mesh mesh = lattice({.n = 16, .jitter = 0.15, .weight = 0.1, .seed = 4});
  const AccuracyTask task = task_of(mesh);
  for (std::size_t first = 0; first + kLanes <= mesh.n_vertices(); first += kLanes) {
    std::optional<AccuracyBatch> expected;
    for (const InstructionSet set : instruction_sets()) {
      ASSERT_TRUE(use_instruction_set(set));
      const AccuracyBatch batch = accuracy_batch(mesh, task, first);
      if (!expected) expected = batch;
      EXPECT_EQ(batch.outcome.stepped, expected->outcome.stepped);
      EXPECT_EQ(batch.outcome.alone, expected->outcome.alone);
      for (std::size_t lane = 0; lane < batch.stars.lanes; ++lane) {
        EXPECT_EQ(batch.stars.to.x[lane], expected->stars.to.x[lane]) << name(set);
        EXPECT_EQ(batch.stars.to.y[lane], expected->stars.to.y[lane]) << name(set);
        EXPECT_EQ(batch.stars.to.w[lane], expected->stars.to.w[lane]) << name(set);
        EXPECT_EQ(batch.stars.after[lane], expected->stars.after[lane]) << name(set);
      }
    }
  }
}

TEST(InstructionSets, TheBaselineIsAlwaysThereAndTheFastestIsUsed) {
  ASSERT_FALSE(instruction_sets().empty());
  EXPECT_EQ(instruction_sets().front(), InstructionSet::baseline);
  EXPECT_EQ(instruction_set(), instruction_sets().back());
}

TEST(InstructionSets, RunsOfEveryEnergyGiveTheSameBytes) {
  const KeepInstructionSet keep;
  for (const EnergyInfo& energy : energies()) {
    for (int star = 0; star <= 2; ++star) {
      Mesh start = swept_mesh(30, 2);
      for (const VertexId v : start.vertices()) start.set_weight(v, energy.positions_alone ? 0 : start.weight(v));
      std::optional<Mesh> first;
      for (const InstructionSet set : instruction_sets()) {
        ASSERT_TRUE(use_instruction_set(set));
        Mesh mesh = start;
        const auto report = optimize(
            mesh, {.objective = Objective::energy, .energy = energy.kind, .star = Star(star), .max_sweeps = 2});
        ASSERT_TRUE(report) << energy.name;
        EXPECT_GT(report->sweeps, 0);
        if (!first) first = mesh;
        EXPECT_TRUE(mesh == *first) << energy.name << " in " << name(set);
      }
      EXPECT_FALSE(*first == start);
    }
  }
}

TEST(InstructionSets, RandomPointsBecomeWellCenteredWithTheSameBytes) {
  const KeepInstructionSet keep;
  const Mesh start = *random_mesh({.vertices = 3000, .seed = 5});
  std::optional<Mesh> first;
  for (const InstructionSet set : instruction_sets()) {
    ASSERT_TRUE(use_instruction_set(set));
    Mesh mesh = start;
    const auto report = optimize(mesh);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->history.back().bad, 0U);
    EXPECT_EQ(count_non_regular_edges(mesh), 0U);
    EXPECT_EQ(mesh.validate(), std::nullopt);
    if (!first) first = mesh;
    EXPECT_TRUE(mesh == *first) << name(set);
  }
}

TEST(InstructionSets, RunsForAccuracyGiveTheSameBytes) {
  const KeepInstructionSet keep;
  Mesh start = *random_mesh({.vertices = kBatchVertices, .seed = 3});
  ASSERT_TRUE(optimize(start));
  OptimizeOptions options;
  options.objective = Objective::accuracy;
  options.scheme = Scheme::stars;
  options.accuracy.sweeps = 5;
  std::optional<Mesh> first;
  for (const InstructionSet set : instruction_sets()) {
    ASSERT_TRUE(use_instruction_set(set));
    Mesh mesh = start;
    ASSERT_TRUE(optimize(mesh, options));
    if (!first) first = mesh;
    EXPECT_TRUE(mesh == *first) << name(set);
  }
  EXPECT_FALSE(*first == start);
}

TEST(InstructionSets, BadTrianglesAreCountedAsExactPredicatesDo) {
  const KeepInstructionSet keep;
  for (const Mesh& mesh : {swept_mesh(0), swept_mesh(2), *random_mesh({.vertices = 300, .seed = 3})}) {
    std::size_t expected = 0;
    for (const TriangleId t : mesh.triangles()) {
      const auto [p, q, r] = mesh.corners(t);
      expected += inlined::is_well_centered(mesh.point(p), mesh.point(q), mesh.point(r)) ? 0 : 1;
    }
    const EnergyModel model = barrier_model(EnergyKind::BP, Star::one);
    for (const InstructionSet set : instruction_sets()) {
      ASSERT_TRUE(use_instruction_set(set));
      EXPECT_EQ(count_bad(mesh, nullptr), expected);
      EXPECT_EQ(energy_and_bad(mesh, model, nullptr).bad, expected);
      EXPECT_EQ(energy_and_bad(mesh, model, nullptr).energy, total_energy(mesh, model));
    }
  }
}

/// As repairs change a mesh: a few triangles at a time, and now and then the number of triangles.
TEST(RunningEnergyAndBad, IsThatOfTheWholeMeshToTheBit) {
  Rng rng(31);
  Mesh mesh = swept_mesh(2);
  for (const EnergyKind kind : {EnergyKind::BP, EnergyKind::BHs}) {
    const EnergyModel model = barrier_model(kind, Star::one);
    RunningEnergyAndBad running;
    const auto expect_whole = [&](const std::optional<std::vector<TriangleId>>& changed) {
      const EnergyAndBad now = running.measure(mesh, model, changed, nullptr),
                         whole = energy_and_bad(mesh, model, nullptr);
      EXPECT_EQ(now.energy, whole.energy);
      EXPECT_EQ(now.bad, whole.bad);
    };
    expect_whole(std::vector<TriangleId>{});  // the first measure
    for (int i = 0; i < 50; ++i) {
      const VertexId v(rng.below(static_cast<std::uint32_t>(mesh.n_vertices())));
      std::vector<TriangleId> changed;
      for (const HalfedgeId h : mesh.star(v)) changed.push_back(Mesh::triangle(h));
      WeightedPoint p = mesh.point(v);
      p.x += 1e-3 * (rng.uniform() - 0.5), p.w += 1e-6 * (rng.uniform() - 0.5);
      mesh.set_point(v, p);
      expect_whole(changed);
    }
    mesh.set_point(VertexId(3), {mesh.point(VertexId(3)).x, mesh.point(VertexId(3)).y, 1e-7});
    expect_whole(std::nullopt);
  }
}

}  // namespace
}  // namespace temper::test
