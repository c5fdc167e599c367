// Sums that do not depend on the number of threads: fixed blocks, each summed in order, then pairwise.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "temper/executor.hpp"

namespace temper {

inline constexpr std::size_t kBlockSize = 4096;  // enough work to be worth a task, small enough to balance

/// Pairwise sum of values, in place of the first: error O(log n) roundings.
inline double pairwise_sum(std::vector<double>& values) {
  for (std::size_t n = values.size(); n > 1; n = (n + 1) / 2) {
    for (std::size_t i = 0; i < n / 2; ++i) values[i] = values[2 * i] + values[2 * i + 1];
    if (n % 2 == 1) values[n / 2] = values[n - 1];
  }
  return values.empty() ? 0.0 : values[0];
}

/// Σ of what block(b) returns for each block of kBlockSize of n; on the executor's threads when there is one.
template <class Block>
double sum_of_blocks(std::size_t n, Executor* executor, Block&& block) {
  std::vector<double> sums((n + kBlockSize - 1) / kBlockSize, 0.0);
  or_serial(executor).run(sums.size(), [&](std::size_t b) { sums[b] = block(b); });
  return pairwise_sum(sums);
}

/// Several such sums in one walk: block(b, sums) adds to what begins as zeros.
template <class Block>
std::vector<double> sums_of_blocks(std::size_t n, std::size_t n_sums, Executor* executor, Block&& block) {
  const std::size_t blocks = (n + kBlockSize - 1) / kBlockSize;
  std::vector<double> of_blocks(blocks * n_sums, 0.0);
  or_serial(executor).run(blocks, [&](std::size_t b) { block(b, std::span(of_blocks).subspan(b * n_sums, n_sums)); });
  std::vector<double> totals(n_sums), one(blocks);
  for (std::size_t k = 0; k < n_sums; ++k) {
    for (std::size_t b = 0; b < blocks; ++b) one[b] = of_blocks[b * n_sums + k];
    totals[k] = pairwise_sum(one);
  }
  return totals;
}

/// Σ term(i), i = 0 … n − 1; on the executor's threads when there is one.
template <class Term>
double blockwise_sum(std::size_t n, Executor* executor, Term&& term) {
  return sum_of_blocks(n, executor, [&](std::size_t b) {
    double sum = 0;
    for (std::size_t i = b * kBlockSize; i < std::min(n, (b + 1) * kBlockSize); ++i) sum += term(i);
    return sum;
  });
}

}  // namespace temper
