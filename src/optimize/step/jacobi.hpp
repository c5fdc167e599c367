// Jacobi's rotation: the step by which a symmetric matrix becomes diagonal.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace temper {

/// Rotates rows and columns p and q of the first n of a so that a_pq, which is not 0, becomes 0; and the columns of v,
/// whose are eigenvectors in the end.
template <std::size_t N>
void jacobi_rotation(std::array<std::array<double, N>, N>& a, std::array<std::array<double, N>, N>& v, std::size_t n,
                     std::size_t p, std::size_t q) {
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

}  // namespace temper
