// Symmetric 6 × 6 matrices without negative eigenvalues.
#pragma once

#include <array>

namespace temper {

using Matrix6 = std::array<std::array<double, 6>, 6>;

/// Raises the negative eigenvalues of a symmetric matrix to 0, to 1e-10 of the largest: adds |λ| v⊗v for each, and
/// exactly nothing when there are none.
void make_semidefinite(Matrix6& matrix);

}  // namespace temper
