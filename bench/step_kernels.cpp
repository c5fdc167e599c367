// A vertex step in its parts, and what sweeps ask of stars and triangles, for each instruction set that the machine
// has. Items are vertices.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "energy/patch.hpp"
#include "energy/whole_mesh.hpp"
#include "fixtures.hpp"
#include "star_lanes.hpp"
#include "step_parts.hpp"
#include "temper/detail/instruction_set.hpp"

namespace temper::bench {
namespace {

/// Sets the instruction set named by the argument for as long as it lives.
class WithInstructionSet {
 public:
  explicit WithInstructionSet(benchmark::State& state) : before_(instruction_set()) {
    const InstructionSet set = instruction_sets()[static_cast<std::size_t>(state.range(0))];
    use_instruction_set(set);
    state.SetLabel(std::string(name(set)));
  }
  ~WithInstructionSet() { use_instruction_set(before_); }
  WithInstructionSet(const WithInstructionSet&) = delete;
  WithInstructionSet& operator=(const WithInstructionSet&) = delete;

 private:
  InstructionSet before_;
};

void each_set(benchmark::internal::Benchmark* b) {
  b->DenseRange(0, static_cast<std::int64_t>(instruction_sets().size()) - 1);
}

StepParameters parameters() { return {edge_formula(model_of(EnergyKind::BP)), 1.7, 0, 0}; }

StarBatch batch_of(const Mesh& mesh, const std::array<VertexId, kLanes>& vertices) {
  StarBatch batch;
  for (std::size_t lane = 0; lane < kLanes; ++lane) fill_lane(mesh, vertices[lane], lane, batch);
  return batch;
}

/// Batches that fit into the cache: sweeps find theirs there, just gathered.
std::vector<StarBatch> some_batches() {
  constexpr std::size_t kBatches = 64;
  const Mesh& mesh = good_mesh();
  std::vector<StarBatch> result;
  for (const auto& vertices : alike_vertices(mesh)) {
    result.push_back(batch_of(mesh, vertices));
    if (result.size() == kBatches) break;
  }
  return result;
}

/// Batches, and what the parts before the one that is timed have left for it.
struct Prepared {
  StarBatch batch;
  PartsState state;
};

std::vector<Prepared> prepared() {
  std::vector<Prepared> result;
  const StepParts& parts = step_parts();
  const StepParameters p = parameters();
  for (const StarBatch& batch : some_batches()) {
    Prepared& x = result.emplace_back(Prepared{batch, {}});
    parts.derivatives(p, x.batch, x.state);
    parts.newton(x.batch, x.state);
    parts.inversion_limit(x.batch, x.state);
  }
  return result;
}

template <class Part>
void time_part(benchmark::State& state, Part&& part) {
  const WithInstructionSet set(state);
  std::vector<Prepared> all = prepared();
  std::size_t i = 0;
  for (auto _ : state) {
    part(step_parts(), all[i]);
    benchmark::ClobberMemory();
    if (++i == all.size()) i = 0;
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kLanes));
}

void step_1_gather(benchmark::State& state) {
  const Mesh& mesh = good_mesh();
  const auto eights = alike_vertices(mesh);
  StarBatch batch;
  std::size_t i = 0;
  for (auto _ : state) {
    batch.most_triangles = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) fill_lane(mesh, eights[i][lane], lane, batch);
    benchmark::ClobberMemory();
    if (++i == eights.size()) i = 0;
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kLanes));
}
BENCHMARK(step_1_gather);

void step_2_derivatives(benchmark::State& state) {
  const StepParameters p = parameters();
  time_part(state, [&](const StepParts& parts, Prepared& x) { parts.derivatives(p, x.batch, x.state); });
}
BENCHMARK(step_2_derivatives)->Apply(each_set);

void step_3_newton(benchmark::State& state) {
  time_part(state, [](const StepParts& parts, Prepared& x) { parts.newton(x.batch, x.state); });
}
BENCHMARK(step_3_newton)->Apply(each_set);

void step_4_inversion_limit(benchmark::State& state) {
  time_part(state, [](const StepParts& parts, Prepared& x) { parts.inversion_limit(x.batch, x.state); });
}
BENCHMARK(step_4_inversion_limit)->Apply(each_set);

void step_5_trial(benchmark::State& state) {
  const StepParameters p = parameters();
  time_part(state, [&](const StepParts& parts, Prepared& x) { parts.trial(p, x.batch, x.state); });
}
BENCHMARK(step_5_trial)->Apply(each_set);

void step_6_regular(benchmark::State& state) {
  time_part(state, [](const StepParts& parts, Prepared& x) { parts.regular(x.batch, x.state); });
}
BENCHMARK(step_6_regular)->Apply(each_set);

void step_7_commit(benchmark::State& state) {
  Mesh mesh = good_mesh();
  const auto eights = alike_vertices(mesh);
  const StarBatch batch = batch_of(mesh, eights.front());
  std::size_t i = 0;
  for (auto _ : state) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) mesh.set_point(eights[i][lane], batch.p.at(lane));
    benchmark::ClobberMemory();
    if (++i == eights.size()) i = 0;
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kLanes));
}
BENCHMARK(step_7_commit);

/// Parts 2 to 6 as the library has them, in one function.
void step_2_to_6_at_once(benchmark::State& state) {
  const WithInstructionSet set(state);
  std::vector<StarBatch> batches = some_batches();
  const StepParameters p = parameters();
  const auto step = batch_steps(good_mesh().space()).barrier;
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(step(p, batches[i]));
    if (++i == batches.size()) i = 0;
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kLanes));
}
BENCHMARK(step_2_to_6_at_once)->Apply(each_set);

/// One star after the other, its triangles in the lanes.
template <class Kernel>
void time_star(benchmark::State& state, Kernel&& kernel) {
  const WithInstructionSet set(state);
  const Mesh& mesh = good_mesh();
  const std::vector<Patch> all = patches(mesh, false);
  const StarKernels& kernels = star_kernels(mesh.space());
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(kernel(kernels, all[i].arrays(), mesh.point(all[i].center)));
    if (++i == all.size()) i = 0;
  }
  state.SetItemsProcessed(state.iterations());
}

void star_value(benchmark::State& state) {
  const EdgeFormula formula = edge_formula(model_of(EnergyKind::BP));
  time_star(state, [&](const StarKernels& kernels, const LinkArrays& link, const WeightedPoint& p) {
    return kernels.barrier_value(formula, link, p);
  });
}
BENCHMARK(star_value)->Apply(each_set);

void star_derivatives(benchmark::State& state) {
  const EdgeFormula formula = edge_formula(model_of(EnergyKind::BP));
  time_star(state, [&](const StarKernels& kernels, const LinkArrays& link, const WeightedPoint& p) {
    double sums[kStarSums];
    return kernels.barrier_derivatives(formula, link, p, sums) ? sums[0] + sums[kStarSums - 1] : 0;
  });
}
BENCHMARK(star_derivatives)->Apply(each_set);

void energy_and_bad_triangles(benchmark::State& state) {
  const WithInstructionSet set(state);
  const Mesh& mesh = good_mesh();
  const EnergyModel model = model_of(EnergyKind::BP);
  for (auto _ : state) benchmark::DoNotOptimize(energy_and_bad(mesh, model, nullptr));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.n_vertices()));
}
BENCHMARK(energy_and_bad_triangles)->Apply(each_set)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace temper::bench
