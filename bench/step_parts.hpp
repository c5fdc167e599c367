// The parts of a step of eight vertices (optimize/batch/star_batch.hpp), each by itself, for each instruction set.
#pragma once

#include <cstddef>

#include "energy/star_kernels.hpp"
#include "optimize/batch/star_batch.hpp"

namespace temper::bench {

/// The results that one part leaves for the next.
struct alignas(64) PartsState {
  Lane sums[kStarSums];  ///< value, gradient, Hessian
  Lane squared_radius;
  Lane step_x, step_y, step_w, predicted;
  Lane limit;  ///< of the way, before a triangle is turned over
  Lane trial;  ///< energy
  unsigned regular = 0;
};

/// Eight stars with nothing but their points: link[0] … link[most_triangles].
struct StarLanes {
  LanePoints p;
  Lane triangles;
  std::size_t most_triangles = 0;
  const LanePoints* link = nullptr;
};

struct StepParts {
  void (*derivatives)(const StepParameters&, const StarBatch&, PartsState&);
  void (*newton)(const StarBatch&, PartsState&);
  void (*inversion_limit)(const StarBatch&, PartsState&);
  void (*trial)(const StepParameters&, const StarBatch&, PartsState&);
  void (*regular)(const StarBatch&, PartsState&);
  /// Sums of stars alone.
  void (*star_sums)(const EdgeFormula&, const StarLanes&, Lane (&)[kStarSums]);
};

/// The parts, compiled for the instruction set in use.
[[nodiscard]] const StepParts& step_parts();

}  // namespace temper::bench
