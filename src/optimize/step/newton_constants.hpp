// The constants of a Newton step of one vertex, alone or in a batch.
#pragma once

namespace temper {

// The trust radius of the scaled unknowns: half a patch radius in position, half a squared one in weight.
inline constexpr double kTrustRadius = 0.5;
// Eigenvalues below this part of the largest are raised to it: the step is then cut by the trust radius anyway.
inline constexpr double kEigenvalueFloor = 1e-6;

}  // namespace temper
