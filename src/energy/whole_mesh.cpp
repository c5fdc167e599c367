// Sums over all triangles, eight at a time. HOT energies go by edges instead: see patch.cpp.
#include "energy/whole_mesh.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <set>
#include <utility>

#include "base/sum.hpp"
#include "energy/patch.hpp"
#include "geometry/predicates_inline.hpp"
#include "mesh/bad_triangles.hpp"

namespace temper {
namespace {

/// Some triangles, as their lanes are filled.
struct Batch {
  TriangleLanes lanes;
  std::size_t size = 0;
};

/// Calls visit with all triangles of a block, in batches. Erased ones are left out, and those that nothing changes:
/// quadrilaterals, and triangles between frozen vertices. Returns how many of their halves are bad. Several batches are
/// filled before the first is visited: reading eight numbers at once waits long for a number that has just been
/// written.
template <class Visit>
std::size_t for_batches(const Mesh& mesh, std::size_t block, Visit&& visit) {
  std::size_t bad_halves = 0;
  std::array<Batch, 4> batches;
  std::size_t filled = 0;
  const auto visit_all = [&] {
    for (std::size_t i = 0; i < batches.size() && i * kLanes < filled; ++i) {
      batches[i].size = std::min(kLanes, filled - i * kLanes);
      visit(batches[i]);
    }
    filled = 0;
  };
  const std::size_t end = std::min(mesh.n_triangles(), (block + 1) * kBlockSize);
  for (std::size_t i = block * kBlockSize; i < end; ++i) {
    const TriangleId t(i);
    if (mesh.is_erased(t)) continue;
    if (mesh.is_half(t) || stays(mesh, t)) {
      bad_halves += is_bad(mesh, t) ? 1 : 0;
      continue;
    }
    batches[filled / kLanes].lanes.set(filled % kLanes, mesh.points(t));
    if (++filled == batches.size() * kLanes) visit_all();
  }
  visit_all();
  return bad_halves;
}

}  // namespace

std::size_t count_bad(const Space& space, const TriangleLanes& triangles, std::size_t n) {
  const auto [yes, no] = star_kernels(space).well_centered(triangles);
  const unsigned used = (1U << n) - 1;
  auto bad = static_cast<std::size_t>(std::popcount(no & used));
  if (((yes | no) & used) == used) return bad;
  for (std::size_t i = 0; i < n; ++i) {
    if (((yes | no) >> i & 1) != 0) continue;
    bad += inlined::is_well_centered(space, triangles.p.at(i), triangles.q.at(i), triangles.r.at(i)) ? 0 : 1;
  }
  return bad;
}

std::size_t count_bad(const Mesh& mesh, Executor* executor) {
  return static_cast<std::size_t>(sum_of_blocks(mesh.n_triangles(), executor, [&](std::size_t block) {
    std::size_t bad = 0;
    const std::size_t bad_halves =
        for_batches(mesh, block, [&](const Batch& batch) { bad += count_bad(mesh.space(), batch.lanes, batch.size); });
    return static_cast<double>(bad + bad_halves);
  }));
}

EnergyAndBad energy_and_bad(const Mesh& mesh, const EnergyModel& model, const Engine& engine) {
  return RunningEnergyAndBad().measure(mesh, model, std::nullopt, engine);
}

EnergyAndBad RunningEnergyAndBad::measure(const Mesh& mesh, const EnergyModel& model,
                                          const std::optional<std::vector<TriangleId>>& changed, const Engine& engine) {
  const EdgeFormula formula = edge_formula(model);
  if (formula.form == EdgeFormula::Form::hot) {
    return {total_energy(mesh, model, &engine.executor()), count_bad(mesh, &engine.executor())};
  }
  const StarKernels& kernels = star_kernels(mesh.space());
  const auto add_block = [&](std::size_t block, std::span<double> of_block) {
    const std::size_t bad_halves = for_batches(mesh, block, [&](const Batch& batch) {
      of_block[0] += kernels.barrier_sum(formula, batch.lanes, batch.size);
      of_block[1] += static_cast<double>(count_bad(mesh.space(), batch.lanes, batch.size));
    });
    of_block[1] += static_cast<double>(bad_halves);
  };
  if (!changed || of_blocks_.empty()) {
    of_blocks_ = sums_by_block(mesh.n_triangles(), 2, engine, add_block);
  } else {
    of_blocks_.resize(2 * ((mesh.n_triangles() + kBlockSize - 1) / kBlockSize));
    std::set<std::size_t> blocks;
    for (const TriangleId t : *changed) blocks.insert(t.index / kBlockSize);
    for (const std::size_t block : blocks) {
      const std::span<double> of_block = std::span(of_blocks_).subspan(2 * block, 2);
      std::fill(of_block.begin(), of_block.end(), 0.0);
      add_block(block, of_block);
    }
  }
  const std::vector<double> sums = totals_of(of_blocks_, 2);
  return {sums[0], static_cast<std::size_t>(sums[1])};
}

std::vector<double> total_energies(const Mesh& mesh, std::span<const EnergyModel> models, Executor* executor) {
  std::vector<std::pair<EdgeFormula, std::size_t>> barriers;  // and their places
  for (std::size_t i = 0; i < models.size(); ++i) {
    const EdgeFormula formula = edge_formula(models[i]);
    if (formula.form != EdgeFormula::Form::hot) barriers.emplace_back(formula, i);
  }
  const StarKernels& kernels = star_kernels(mesh.space());
  const std::size_t n = mesh.n_triangles();
  return sums_of_blocks(n, models.size(), executor, [&](std::size_t block, std::span<double> sums) {
    if (!barriers.empty()) {
      for_batches(mesh, block, [&](const Batch& batch) {
        for (const auto& [formula, i] : barriers) sums[i] += kernels.barrier_sum(formula, batch.lanes, batch.size);
      });
    }
    add_hot_energies(mesh, models, block * kBlockSize, std::min(n, (block + 1) * kBlockSize), sums);
  });
}

double total_energy(const Mesh& mesh, const EnergyModel& model, Executor* executor) {
  return total_energies(mesh, {&model, 1}, executor).front();
}

}  // namespace temper
