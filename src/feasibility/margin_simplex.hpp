// The best margin of a growing set of linear constraints, by a simplex method with a dense basis.
//
//   maximize t   with   g_i(w, t) = c_i + a_i · w − m_i t ≥ 0   for all rows i
//
// A basis is a set of d rows, one per unknown, with multipliers y ≥ 0 for which Σ y a = 0 and Σ y m = 1. Then Σ y c is
// an upper bound of t, and falls with each step: a violated row enters, another leaves. The first basis holds all
// weights at zero, and t at its greatest value. A basis serves for any larger set of rows. So the search over
// connectivities adds rows and goes on, and copies the program before it tries an edge.
//
// The multipliers are the certificate. The caller checks them exactly, so rounding here costs time but never makes an
// answer wrong.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace temper {

/// A row: constant + Σ coefficient · unknown − slope · t ≥ 0. Column −1 stands for a weight that is zero.
struct MarginRow {
  std::array<int, 3> columns = {-1, -1, -1};
  std::array<double, 3> coefficients = {};
  double constant = 0;
  double slope = 0;
};

class MarginSimplex {
 public:
  using RowId = std::size_t;
  struct Range {
    RowId first = 0, last = 0;
  };
  enum class End {
    optimal,
    negative,  ///< The best margin is below zero, by the rows that have multipliers
    failed,    ///< By rounding, or after too many steps
    stopped,   ///< By the caller
  };

  /// Rows may be added later.
  MarginSimplex(const std::vector<MarginRow>& rows, std::size_t n_weights);

  /// Goes on until no row of the ranges is violated, or the margin is negative.
  End solve(std::span<const Range> ranges, const std::function<bool()>& stop);
  /// Goes back to the first basis.
  void restart();

  [[nodiscard]] double margin() const { return unknowns_.back(); }
  [[nodiscard]] double weight(int column) const { return column < 0 ? 0 : unknowns_[static_cast<std::size_t>(column)]; }
  /// Calls use(row, multiplier) for each row with a positive multiplier.
  template <class Use>
  void for_each_multiplier(const Use& use) const {
    for (std::size_t k = 0; k < basis_.size(); ++k) {
      if (basis_[k] < kGreatest && multipliers_[k] > kNoMultiplier) use(basis_[k], multipliers_[k]);
    }
  }

 private:
  static constexpr double kNoMultiplier = 1e-12;  // rows are of the order of one

  static constexpr RowId kGreatest = ~RowId{1};  // the row that t is at most kMostMargin
  static constexpr RowId kFree = ~RowId{0};      // no row: the weight of this position is zero for now

  [[nodiscard]] MarginRow row_of(std::size_t position) const;
  [[nodiscard]] double slack(const MarginRow& row) const;
  /// A violated row; rows_->size() if there is none.
  [[nodiscard]] RowId violated_row(std::span<const Range> ranges);
  [[nodiscard]] RowId first_violated_row(std::span<const Range> ranges) const;
  /// Sets expressed_ to the factors of the basis that make a row of it.
  void express(const MarginRow& row);
  [[nodiscard]] std::size_t leaving_position(bool by_number) const;
  [[nodiscard]] bool step(RowId entering, bool by_number);
  /// Computes all but the basis again. Returns false if the basis is singular.
  bool invert(std::vector<double> matrix);
  bool refactor();

  const std::vector<MarginRow>* rows_;
  std::vector<RowId> basis_;
  std::vector<double> multipliers_, unknowns_, expressed_;
  std::vector<double> inverse_;  ///< of the matrix of the basis, by unknown and position
  std::size_t steps_ = 0, since_refactor_ = 0;
};

}  // namespace temper
