// Sums that do not depend on the number of threads and ranks: fixed blocks, each summed in order, then pairwise.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "base/engine.hpp"

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

/// Σ of the results of block(b) for each block of kBlockSize of n; on the executor's threads when there is one.
template <class Block>
double sum_of_blocks(std::size_t n, Executor* executor, Block&& block) {
  std::vector<double> sums((n + kBlockSize - 1) / kBlockSize, 0.0);
  or_serial(executor).run(sums.size(), [&](std::size_t b) { sums[b] = block(b); });
  return pairwise_sum(sums);
}

/// Several such sums in one walk, for each block: block(b, sums) adds to zeros. It changes nothing else, since each
/// rank does some of the blocks. Result: n_sums numbers for each block.
template <class Block>
std::vector<double> sums_by_block(std::size_t n, std::size_t n_sums, const Engine& engine, Block&& block) {
  const std::size_t blocks = (n + kBlockSize - 1) / kBlockSize;
  std::vector<double> of_blocks(blocks * n_sums, 0.0);
  const auto sums_of = [&](std::size_t b) { return std::span(of_blocks).subspan(b * n_sums, n_sums); };
  const auto write = [&](ByteWriter& writer, std::size_t b) {
    for (const double sum : sums_of(b)) writer.write(sum);
  };
  const auto read = [&](ByteReader& reader, std::size_t b) {
    for (double& sum : sums_of(b)) reader.read(sum);
  };
  engine.run(blocks, [&](std::size_t b) { block(b, sums_of(b)); });
  engine.exchange(blocks, write, read);
  return of_blocks;
}

/// The sums of all blocks together. Precondition: n_sums > 0.
inline std::vector<double> totals_of(const std::vector<double>& of_blocks, std::size_t n_sums) {
  const std::size_t blocks = of_blocks.size() / n_sums;
  std::vector<double> totals(n_sums), one(blocks);
  for (std::size_t k = 0; k < n_sums; ++k) {
    for (std::size_t b = 0; b < blocks; ++b) one[b] = of_blocks[b * n_sums + k];
    totals[k] = pairwise_sum(one);
  }
  return totals;
}

/// Both of these.
template <class Block>
std::vector<double> sums_of_blocks(std::size_t n, std::size_t n_sums, const Engine& engine, Block&& block) {
  if (n_sums == 0) return {};
  return totals_of(sums_by_block(n, n_sums, engine, std::forward<Block>(block)), n_sums);
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
