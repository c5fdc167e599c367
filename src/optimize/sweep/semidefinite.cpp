#include "optimize/sweep/semidefinite.hpp"

#include <cstddef>

#include "optimize/step/jacobi.hpp"

namespace temper {
namespace {

constexpr int kMostRounds = 10;      // Jacobi's method converges quadratically: 6 or 7 are made
constexpr double kDiagonal = 1e-20;  // squares beside the diagonal, relative to those on it, that count as nothing

bool is_diagonal(const Matrix6& a) {
  double on = 0, beside = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    on += a[i][i] * a[i][i];
    for (std::size_t j = i + 1; j < 6; ++j) beside += a[i][j] * a[i][j];
  }
  return !(beside > kDiagonal * on);
}

}  // namespace

void make_semidefinite(Matrix6& matrix) {
  Matrix6 a = matrix, v{};
  for (std::size_t i = 0; i < 6; ++i) v[i][i] = 1;
  for (int round = 0; round < kMostRounds && !is_diagonal(a); ++round) {
    for (std::size_t p = 0; p < 6; ++p) {
      for (std::size_t q = p + 1; q < 6; ++q) {
        if (a[p][q] != 0) jacobi_rotation(a, v, 6, p, q);
      }
    }
  }
  for (std::size_t k = 0; k < 6; ++k) {
    if (!(a[k][k] < 0)) continue;
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < 6; ++j) matrix[i][j] -= a[k][k] * v[i][k] * v[j][k];
    }
  }
}

}  // namespace temper
