#include "feasibility/margin_simplex.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "temper/feasibility.hpp"

namespace temper {
namespace {

constexpr double kViolated = 1e-10;     // of rows whose largest coefficient is one: far above their rounding
constexpr double kLeastPivot = 1e-9;    // of the same rows
constexpr double kLeastFreed = 1e-6;    // the same, for a weight that was held at zero
constexpr double kSingular = 0x1p-40;   // a pivot of the whole basis
constexpr double kNegative = -1e-7;     // a margin that leaves room for the rounding of multipliers
constexpr double kProgress = 1e-13;     // a step that changes the margin by less does not count
constexpr std::size_t kRefactor = 32;   // steps until the rounding of the inverse is removed
constexpr std::size_t kStalled = 40;    // steps without progress until rows are taken by number, which cannot cycle
constexpr std::size_t kCompared = 8;    // violated rows whose distances are compared
constexpr std::size_t kStopEvery = 64;  // steps until the caller may stop
constexpr std::size_t kMostSteps = 50;  // for each unknown: the usual number is below ten

}  // namespace

MarginSimplex::MarginSimplex(const std::vector<MarginRow>& rows, std::size_t n_weights)
    : rows_(&rows), multipliers_(n_weights + 1), unknowns_(n_weights + 1), expressed_(n_weights + 1) {
  restart();
}

void MarginSimplex::restart() {
  basis_.assign(unknowns_.size(), kFree);
  basis_.back() = kGreatest;
  refactor();
}

MarginRow MarginSimplex::row_of(std::size_t position) const {
  if (basis_[position] == kFree) return {{static_cast<int>(position), -1, -1}, {1, 0, 0}, 0, 0};
  if (basis_[position] == kGreatest) return {{-1, -1, -1}, {0, 0, 0}, kMostMargin, 1};
  return (*rows_)[basis_[position]];
}

double MarginSimplex::slack(const MarginRow& row) const {
  double value = row.constant - row.slope * unknowns_.back();
  for (std::size_t k = 0; k < 3; ++k) value += row.coefficients[k] * weight(row.columns[k]);
  return value;
}

/// Gauss and Jordan, with pivots of columns. Returns false if the matrix is singular.
bool MarginSimplex::invert(std::vector<double> matrix) {
  const std::size_t d = unknowns_.size();
  inverse_.assign(d * d, 0.0);
  for (std::size_t i = 0; i < d; ++i) inverse_[i * d + i] = 1;
  for (std::size_t c = 0; c < d; ++c) {
    std::size_t pivot = c;
    for (std::size_t i = c + 1; i < d; ++i) {
      if (std::abs(matrix[i * d + c]) > std::abs(matrix[pivot * d + c])) pivot = i;
    }
    if (!(std::abs(matrix[pivot * d + c]) > kSingular)) return false;
    for (std::size_t k = 0; pivot != c && k < d; ++k) {
      std::swap(matrix[pivot * d + k], matrix[c * d + k]);
      std::swap(inverse_[pivot * d + k], inverse_[c * d + k]);
    }
    const double scale = 1 / matrix[c * d + c];
    for (std::size_t k = 0; k < d; ++k) matrix[c * d + k] *= scale, inverse_[c * d + k] *= scale;
    for (std::size_t i = 0; i < d; ++i) {
      const double factor = matrix[i * d + c];
      if (i == c || factor == 0) continue;
      for (std::size_t k = 0; k < d; ++k) {
        matrix[i * d + k] -= factor * matrix[c * d + k];
        inverse_[i * d + k] -= factor * inverse_[c * d + k];
      }
    }
  }
  return true;
}

bool MarginSimplex::refactor() {
  const std::size_t d = unknowns_.size();
  std::vector<double> matrix(d * d, 0.0);
  for (std::size_t i = 0; i < d; ++i) {
    const MarginRow row = row_of(i);
    for (std::size_t k = 0; k < 3; ++k) {
      if (row.columns[k] >= 0) matrix[i * d + static_cast<std::size_t>(row.columns[k])] += row.coefficients[k];
    }
    matrix[i * d + d - 1] -= row.slope;
  }
  if (!invert(std::move(matrix))) return false;
  std::fill(unknowns_.begin(), unknowns_.end(), 0.0);
  for (std::size_t j = 0; j < d; ++j) {
    const double constant = row_of(j).constant;
    for (std::size_t v = 0; v < d; ++v) unknowns_[v] -= inverse_[v * d + j] * constant;
  }
  for (std::size_t j = 0; j < d; ++j) multipliers_[j] = std::max(0.0, -inverse_[(d - 1) * d + j]);
  since_refactor_ = 0;
  return true;
}

void MarginSimplex::express(const MarginRow& row) {
  const std::size_t d = unknowns_.size();
  const double* const of_margin = &inverse_[(d - 1) * d];
  for (std::size_t j = 0; j < d; ++j) expressed_[j] = -row.slope * of_margin[j];
  for (std::size_t k = 0; k < 3; ++k) {
    if (row.columns[k] < 0) continue;
    const double* const of_column = &inverse_[static_cast<std::size_t>(row.columns[k]) * d];
    for (std::size_t j = 0; j < d; ++j) expressed_[j] += row.coefficients[k] * of_column[j];
  }
}

/// A weight that was held at zero becomes free. Else Harris's rule: multipliers may become negative by rounding, for
/// the sake of a large pivot.
std::size_t MarginSimplex::leaving_position(bool by_number) const {
  const std::size_t d = unknowns_.size();
  std::size_t freed = d;
  for (std::size_t j = 0; j < d; ++j) {
    if (basis_[j] != kFree || !(std::abs(expressed_[j]) > kLeastFreed)) continue;
    if (freed == d || std::abs(expressed_[j]) > std::abs(expressed_[freed])) freed = j;
  }
  if (freed < d) return freed;
  double most = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < d; ++j) {
    if (basis_[j] != kFree && expressed_[j] > kLeastPivot)
      most = std::min(most, (multipliers_[j] + kNoMultiplier) / expressed_[j]);
  }
  std::size_t leaving = d;
  for (std::size_t j = 0; j < d; ++j) {
    if (basis_[j] == kFree || !(expressed_[j] > kLeastPivot) || multipliers_[j] / expressed_[j] > most) continue;
    const bool better = leaving == d || (by_number ? basis_[j] < basis_[leaving] : expressed_[j] > expressed_[leaving]);
    if (better) leaving = j;
  }
  return leaving;
}

bool MarginSimplex::step(RowId entering, bool by_number) {
  const std::size_t d = unknowns_.size();
  const MarginRow& row = (*rows_)[entering];
  express(row);
  const std::size_t leaving = leaving_position(by_number);
  if (leaving == d) return false;
  const double pivot = expressed_[leaving], moved = -slack(row) / pivot, multiplier = multipliers_[leaving] / pivot;
  for (std::size_t j = 0; j < d; ++j) {
    if (basis_[j] != kFree) multipliers_[j] = std::max(0.0, multipliers_[j] - multiplier * expressed_[j]);
  }
  multipliers_[leaving] = multiplier;
  for (std::size_t v = 0; v < d; ++v) {
    double* const of_v = &inverse_[v * d];
    const double factor = of_v[leaving];
    if (factor == 0) continue;
    unknowns_[v] += moved * factor;
    const double scaled = factor / pivot;
    for (std::size_t j = 0; j < d; ++j) of_v[j] -= scaled * expressed_[j];
    of_v[leaving] = scaled;
  }
  basis_[leaving] = entering;
  ++steps_;
  return ++since_refactor_ < kRefactor || refactor();
}

MarginSimplex::RowId MarginSimplex::first_violated_row(std::span<const Range> ranges) const {
  for (const Range& range : ranges) {
    for (RowId i = range.first; i < range.last; ++i) {
      if (slack((*rows_)[i]) < -kViolated) return i;
    }
  }
  return rows_->size();
}

/// Returns one of the most violated rows: the row at the greatest distance in terms of the basis.
MarginSimplex::RowId MarginSimplex::violated_row(std::span<const Range> ranges) {
  std::array<std::pair<double, RowId>, kCompared> most;  // by slack
  std::size_t n = 0;
  for (const Range& range : ranges) {
    for (RowId i = range.first; i < range.last; ++i) {
      const double value = slack((*rows_)[i]);
      if (value >= -kViolated || (n == kCompared && value >= most.back().first)) continue;
      std::size_t at = n < kCompared ? n++ : n - 1;
      for (; at > 0 && most[at - 1].first > value; --at) most[at] = most[at - 1];
      most[at] = {value, i};
    }
  }
  RowId farthest = rows_->size();
  double greatest = 0;
  for (std::size_t k = 0; k < n; ++k) {
    express((*rows_)[most[k].second]);
    double sum = 1;
    for (const double factor : expressed_) sum += factor * factor;
    const double distance = most[k].first * most[k].first / sum;
    if (distance > greatest) greatest = distance, farthest = most[k].second;
  }
  return farthest;
}

MarginSimplex::End MarginSimplex::solve(std::span<const Range> ranges, const std::function<bool()>& stop) {
  const std::size_t most_steps = steps_ + kMostSteps * unknowns_.size();
  double least = margin();
  std::size_t stalled = 0;
  while (steps_ < most_steps) {
    if (margin() < kNegative) return End::negative;
    if (steps_ % kStopEvery == 0 && stop && stop()) return End::stopped;
    const bool by_number = stalled > kStalled;
    const RowId entering = by_number ? first_violated_row(ranges) : violated_row(ranges);
    if (entering == rows_->size()) {
      if (since_refactor_ == 0) return End::optimal;
      if (!refactor()) return End::failed;
      continue;  // rounding may have hidden a violated row
    }
    if (!step(entering, by_number)) return End::failed;
    stalled = margin() < least - kProgress ? 0 : stalled + 1;
    least = std::min(least, margin());
  }
  return End::failed;
}

}  // namespace temper
