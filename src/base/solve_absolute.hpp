// |H|⁻¹ g for a small symmetric matrix H: a descent direction where H is not positive definite.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace temper {

template <std::size_t N>
using SquareMatrix = std::array<std::array<double, N>, N>;

/// Rotates rows and columns p and q of the first n of a so that a_pq, which is not 0, becomes 0. Rotates the columns of
/// v, too, which become the eigenvectors.
template <std::size_t N>
void jacobi_rotation(SquareMatrix<N>& a, SquareMatrix<N>& v, std::size_t n, std::size_t p, std::size_t q) {
  const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
  const double c = 1 / std::sqrt(t * t + 1), s = t * c;
  const auto turn = [c, s](double& x, double& y) {
    const double old = x;
    x = c * old - s * y;
    y = s * old + c * y;
  };
  for (std::size_t k = 0; k < n; ++k) turn(a[k][p], a[k][q]);
  for (std::size_t k = 0; k < n; ++k) turn(a[p][k], a[q][k]);
  for (std::size_t k = 0; k < n; ++k) turn(v[k][p], v[k][q]);
}

/// Eigenvectors of the first n rows of a symmetric matrix as columns of v; a becomes diagonal (cyclic Jacobi).
template <std::size_t N>
void diagonalize(std::size_t n, SquareMatrix<N>& a, SquareMatrix<N>& v) {
  constexpr int kSweeps = 8;  // they converge quadratically: six of them reach rounding for n = 4
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) v[i][j] = i == j ? 1 : 0;
  }
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t p = 0; p < n; ++p) {
      for (std::size_t q = p + 1; q < n; ++q) {
        if (a[p][q] != 0) jacobi_rotation<N>(a, v, n, p, q);
      }
    }
  }
}

/// Returns |H|⁻¹ g for the first n unknowns. Eigenvalues below `floor` of the largest are raised to it. Without any
/// curvature it returns g: the caller's trust radius then decides how far to go.
template <std::size_t N>
std::array<double, N> solve_absolute(std::size_t n, SquareMatrix<N> h, const std::array<double, N>& g, double floor) {
  SquareMatrix<N> v;
  diagonalize<N>(n, h, v);
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::abs(h[i][i]));
  if (!(largest > 0)) return g;
  std::array<double, N> x = {};
  for (std::size_t i = 0; i < n; ++i) {
    double along = 0;
    for (std::size_t k = 0; k < n; ++k) along += v[k][i] * g[k];
    along /= std::max(std::abs(h[i][i]), floor * largest);
    for (std::size_t k = 0; k < n; ++k) x[k] += along * v[k][i];
  }
  return x;
}

}  // namespace temper
