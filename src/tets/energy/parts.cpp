#include "tets/energy/parts.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "base/instruction_set_choice.hpp"

namespace temper::tets {
namespace {

const PartsKernels& kernels() { return *TEMPER_IN_USE(kPartsKernels); }

/// Calls work(first, n, lanes) for each eight tetrahedra, of which n are left, on threads.
template <class Work>
void for_blocks(const TetMesh& mesh, Executor* executor, const Work& work) {
  constexpr std::size_t kTetsPerTask = 256;
  const std::size_t n = mesh.n_tetrahedra(), tasks = (n + kTetsPerTask - 1) / kTetsPerTask;
  or_serial(executor).run(tasks, [&](std::size_t i) {
    for (std::size_t t = i * kTetsPerTask; t < std::min(n, (i + 1) * kTetsPerTask); t += kLanes) {
      work(t, std::min(kLanes, n - t), lanes_of(mesh, t, n));
    }
  });
}

}  // namespace

IdVector<TetId, TetParts> parts_of(const TetMesh& mesh, Executor* executor) {
  IdVector<TetId, TetParts> all(mesh.n_tetrahedra());
  for_blocks(mesh, executor, [&](std::size_t first, std::size_t n, const TetLanes& lanes) {
    PartsLanes parts;
    kernels().parts(lanes, parts);
    for (std::size_t lane = 0; lane < n; ++lane) {
      const Lane* from = parts.numbers;
      all[TetId(first + lane)].for_each([&](double& number) { number = (*from++)[lane]; });
    }
  });
  return all;
}

void add_pulled_back(Gradient& gradient, const TetMesh& mesh, const std::function<TetParts(TetId)>& by,
                     Executor* executor) {
  IdVector<TetId, std::array<WeightedPoint, 4>> slopes(mesh.n_tetrahedra());
  for_blocks(mesh, executor, [&](std::size_t first, std::size_t n, const TetLanes& lanes) {
    PartsLanes by_parts;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      TetParts parts = by(TetId(first + std::min(lane, n - 1)));
      Lane* to = by_parts.numbers;
      parts.for_each([&](const double& number) { (*to++)[lane] = number; });
    }
    TetLanes by_corners;
    kernels().pull_back(lanes, by_parts, by_corners);
    for (std::size_t lane = 0; lane < n; ++lane) {
      for (std::size_t k = 0; k < 4; ++k) slopes[TetId(first + lane)][k] = by_corners.corners[k].at(lane);
    }
  });
  for (const TetId t : mesh.tetrahedra()) {
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& [x, y, z, w] = slopes[t][k];
      WeightedPoint& to = gradient[mesh.corners(t)[k]];
      to = {to.x + x, to.y + y, to.z + z, to.w + w};
    }
  }
}

}  // namespace temper::tets
