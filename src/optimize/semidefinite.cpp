#include "optimize/semidefinite.hpp"

#include <cmath>
#include <cstddef>

namespace temper {
namespace {

constexpr int kMostRounds = 10;      // Jacobi's method converges quadratically: 6 or 7 are made
constexpr double kDiagonal = 1e-20;  // squares beside the diagonal, relative to those on it, that count as nothing

/// Rotates the rows and columns p and q of a so that a_pq is 0, and the columns of v, whose are eigenvectors in the
/// end.
void rotate(Matrix6& a, Matrix6& v, std::size_t p, std::size_t q) {
  const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
  const double c = 1 / std::sqrt(t * t + 1), s = t * c;
  const auto turn = [c, s](double& x, double& y) {
    const double old = x;
    x = c * old - s * y;
    y = s * old + c * y;
  };
  for (std::size_t k = 0; k < 6; ++k) turn(a[k][p], a[k][q]);
  for (std::size_t k = 0; k < 6; ++k) turn(a[p][k], a[q][k]);
  for (std::size_t k = 0; k < 6; ++k) turn(v[k][p], v[k][q]);
}

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
        if (a[p][q] != 0) rotate(a, v, p, q);
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
