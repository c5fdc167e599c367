// Sparse symmetric systems, by Eigen, which solve.cpp alone includes, and by the supernodes of base.
#pragma once

#include <array>
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
  bool definite = false;                       ///< all pivots of LLᵀ positive
  bool singular = false;                       ///< then there are no solutions
  std::vector<std::vector<double>> solutions;  ///< one for each right side
  std::optional<double> condition = {};        ///< |λ| largest over least, from below; +∞ when singular
};

/// LLᵀ for a positive definite matrix, else LU with pivoting. A matrix is called singular when neither gives solutions
/// with a residual of the size of rounding.
[[nodiscard]] LinearSolution solve(const LinearSystem& system, bool with_condition);

class PointSystem;

/// One number of each of several systems with the same matrix.
inline constexpr std::size_t kLanes = 8;
using Lanes = std::array<double, kLanes>;

/// A positive definite matrix, factored for many right sides.
class Cholesky {
 public:
  Cholesky() = default;
  Cholesky(const Cholesky&) = delete;
  Cholesky& operator=(const Cholesky&) = delete;
  Cholesky(Cholesky&&) = default;
  Cholesky& operator=(Cholesky&&) = default;
  ~Cholesky() = default;

  /// Factors a matrix in place of the last. Returns false if a pivot is not positive, or an entry not finite. A matrix
  /// with the entries of the last in the same order keeps the order of elimination.
  [[nodiscard]] bool factor(std::size_t unknowns, const std::vector<MatrixEntry>& lower);
  /// Solves for the right side, in its place.
  void solve(std::vector<double>& right) const;
  /// Solves for several right sides at once, in their place. They are at points, and given points get 0.
  void solve(const PointSystem& points, std::vector<Lanes>& at_points) const;

 private:
  struct Factors;
  std::shared_ptr<Factors> factors_;
};

/// Equations Σ c_ij (u_i − u_j) = b_i at points. Some points have given values, and the others are unknowns.
class PointSystem {
 public:
  explicit PointSystem(const std::vector<bool>& given);

  /// Adds a flux c (u_i − u_j) between two points.
  void connect(std::size_t i, std::size_t j, double c);
  /// Adds a flux c (u_i − value) to the outside. The sources of i must have c value.
  void connect_outside(std::size_t i, double c);

  [[nodiscard]] bool is_given(std::size_t i) const { return unknowns_[i] == kGiven; }
  /// Precondition: it is not given.
  [[nodiscard]] std::size_t unknown(std::size_t i) const { return unknowns_[i]; }
  [[nodiscard]] std::size_t n_unknowns() const { return n_unknowns_; }
  [[nodiscard]] const std::vector<MatrixEntry>& lower() const { return lower_; }
  /// The numbers at the unknowns: sources, and fluxes from given values. Both have one number per point.
  [[nodiscard]] std::vector<double> right_side(const std::vector<double>& sources,
                                               const std::vector<double>& values) const;
  /// Replaces the values at the unknowns by those of a solution.
  void put(const std::vector<double>& solution, std::vector<double>& values) const;

 private:
  static constexpr std::size_t kGiven = static_cast<std::size_t>(-1);
  struct FromGiven {
    std::size_t unknown, given;
    double c;
  };

  std::size_t n_unknowns_ = 0;
  std::vector<std::size_t> unknowns_;  // of each point, or kGiven
  std::vector<MatrixEntry> lower_;     // first the diagonal
  std::vector<FromGiven> from_given_;
};

}  // namespace temper::error_detail
