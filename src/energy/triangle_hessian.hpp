// The energy of whole triangles with all three corners free, eight triangles at once: value, gradient and Hessian.
//
// The energy of pqr depends on differences alone, so on six numbers
//
//   u = (q − p, w_q − w_p, r − p, w_r − w_p)
//
// and what belongs to p is minus the sum of what belongs to q and to r.
#pragma once

#include <cstddef>

#include "energy/star_kernels.hpp"

namespace temper {

/// Where ∂²/∂u_i ∂u_j is stored, j ≤ i.
[[nodiscard]] TEMPER_INLINE constexpr std::size_t hessian_entry(std::size_t i, std::size_t j) {
  return i * (i + 1) / 2 + j;
}

struct TriangleHessians {
  Lane value, doubled_area;
  Lane gradient[6];
  Lane hessian[21];  ///< the lower triangle, row by row
};

/// Of a barrier. Bit i of the result: triangle i is inside the domain; elsewhere its numbers mean nothing.
using TriangleHessiansOf = unsigned (*)(const EdgeFormula& formula, const TriangleLanes& triangles,
                                        TriangleHessians& result);

/// In the instruction set in use.
[[nodiscard]] TriangleHessiansOf triangle_hessians();

namespace baseline {
unsigned triangle_hessians(const EdgeFormula& formula, const TriangleLanes& triangles, TriangleHessians& result);
}
namespace avx2 {
unsigned triangle_hessians(const EdgeFormula& formula, const TriangleLanes& triangles, TriangleHessians& result);
}
namespace avx512 {
unsigned triangle_hessians(const EdgeFormula& formula, const TriangleLanes& triangles, TriangleHessians& result);
}

}  // namespace temper
