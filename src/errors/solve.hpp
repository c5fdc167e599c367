// Sparse symmetric systems, by Eigen, which solve.cpp alone includes.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace temper::error_detail {

/// An entry of the lower triangle, row ≥ column; entries of one place are summed.
struct MatrixEntry {
  std::size_t row = 0, column = 0;
  double value = 0;
};

struct LinearSystem {
  std::size_t unknowns = 0;
  std::vector<MatrixEntry> lower;
  std::vector<std::vector<double>> right_sides;
};

struct LinearSolution {
  bool definite = false;                       ///< all pivots of LDLᵀ positive
  bool singular = false;                       ///< then there are no solutions
  std::vector<std::vector<double>> solutions;  ///< one for each right side
  std::optional<double> condition = {};        ///< |λ| largest over least, from below; +∞ when singular
};

/// LDLᵀ for a positive definite matrix, else LU with pivoting. A matrix is called singular when neither gives solutions
/// with a residual of the size of rounding.
[[nodiscard]] LinearSolution solve(const LinearSystem& system, bool with_condition);

/// A positive definite matrix, factored for many right sides.
class Cholesky {
 public:
  /// Nothing if a pivot is not positive, or an entry not finite.
  [[nodiscard]] static std::optional<Cholesky> of(std::size_t unknowns, const std::vector<MatrixEntry>& lower);
  /// Solves for the right side, in its place.
  void solve(std::vector<double>& right) const;

 private:
  struct Factors;
  std::shared_ptr<const Factors> factors_;
};

}  // namespace temper::error_detail
