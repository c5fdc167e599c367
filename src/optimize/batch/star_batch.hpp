// Eight vertices, none of which the step of another looks at, improved at once: a lane of each pack is a vertex.
//
//                 o1                  p: the vertex, moved by the step       p, q_i, q_{i+1}: its triangles
//               /    \                q: its link                            o: across the link
//             q2 ---- q1 -- o0
//            /  \    /  \  /          The step needs the energy of the triangles around p, and then whether the
//          q3 --- p ---- q0           spokes p q_i and the link edges q_i q_{i+1} are still regular. Both depend on
//            \  /   \   /             these points alone.
//
// A lane does the same operations as the Newton step of a single vertex. Rare cases are left to the single step: a
// Hessian that is not positive definite, a barrier to enter, a filter that does not decide, flips.
#pragma once

#include <cstddef>

#include "energy/accuracy_edge.hpp"
#include "energy/star_kernels.hpp"
#include "temper/detail/space.hpp"

namespace temper {

struct alignas(64) StarBatch {
  static constexpr std::size_t kMostTriangles = 14;  // of a star; larger stars make single steps

  // Input.
  std::size_t lanes = 0;           ///< in use
  std::size_t most_triangles = 0;  ///< of a lane
  LanePoints p;
  Lane triangles;                        ///< number of triangles, as a double
  LaneMask open;                         ///< a boundary vertex: the link has one point more than triangles
  LaneMask moves, changes_weight;        ///< position and weight are unknowns; a lane without either stays as it is
  LanePoints link[kMostTriangles + 1];   ///< q_0 … q_n, where q_n is q_0 again in a closed star
  LanePoints across[kMostTriangles];     ///< o_i, if link_flips
  LaneMask spoke_flips[kMostTriangles];  ///< spoke i may flip: it is inside and not constrained
  LaneMask link_flips[kMostTriangles];   ///< link edge i may flip

  // Output.
  LanePoints to;       ///< new place of a lane in `stepped`
  Lane before, after;  ///< its energy
};

struct StepParameters {
  EdgeFormula formula;  ///< of a barrier energy
  double relaxation = 1;
  double rounding_x = 0, rounding_y = 0;  ///< WorkingUnits::rounding
};

/// Bit i: lane i.
struct StepOutcome {
  unsigned stepped = 0;  ///< has a place with lower energy, certainly without inverted triangles
  unsigned regular = 0;  ///< and certainly needs no flip there
  unsigned alone = 0;    ///< needs the step of a single vertex
};

/// The sizes and floors around each vertex, for the accuracy objective.
struct alignas(64) AccuracyLanes {
  Lane size;                                      ///< s at p
  Lane link_size[StarBatch::kMostTriangles + 1];  ///< s at q_i
  Lane floor[StarBatch::kMostTriangles];          ///< ε of triangle i
  LaneMask inner[StarBatch::kMostTriangles];      ///< link edge i has a triangle across it

  struct alignas(64) Lengths {
    Lane factor, l2, dual2;
    void set(std::size_t lane, const LengthBarrier<double>& of) {
      factor[lane] = of.factor, l2[lane] = of.l2, dual2[lane] = of.dual2;
    }
  };
  // Used if the model has floors of lengths.
  Lengths spoke[StarBatch::kMostTriangles + 1];
  Lengths link[StarBatch::kMostTriangles];
};

/// The steps of a batch in one space and one instruction set.
struct BatchSteps {
  /// A step that lowers a barrier energy.
  StepOutcome (*barrier)(const StepParameters& parameters, StarBatch& batch);
  /// A step that lowers the accuracy energy. A star that steps is certainly well-centered, and so regular.
  StepOutcome (*accuracy)(const StepParameters& parameters, const AccuracyModel& model, const AccuracyLanes& lanes,
                          StarBatch& batch);
};

/// Returns the steps of the instruction set in use.
[[nodiscard]] const BatchSteps& batch_steps(const Space& space);

namespace baseline {
extern const BatchSteps kPlaneSteps, kSphereSteps;
}
namespace avx2 {
extern const BatchSteps kPlaneSteps, kSphereSteps;
}
namespace avx512 {
extern const BatchSteps kPlaneSteps, kSphereSteps;
}

}  // namespace temper
