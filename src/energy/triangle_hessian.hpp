// The energy of whole triangles with all three corners free, eight triangles at once: value, gradient and Hessian.
//
// The energy of pqr depends on differences alone, so on six numbers
//
//   u = (q − p, w_q − w_p, r − p, w_r − w_p)
//
// and what belongs to p is minus the sum of what belongs to q and to r.
#pragma once

#include "energy/lanes.hpp"
#include "geometry/height_derivatives.hpp"

namespace temper {

struct TriangleHessians {
  Lane value, doubled_area;
  Lane gradient[6];
  Lane hessian[21];  ///< the lower triangle: see hessian_entry()
};

}  // namespace temper
