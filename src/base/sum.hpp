// Sums that do not depend on the number of threads: fixed blocks, each summed in order, then pairwise.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/assert.hpp"
#include "temper/executor.hpp"
#include "temper/ranks.hpp"

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

/// Gives all ranks the sums of all blocks, where each rank has those of its share.
inline void share_sums(std::vector<double>& of_blocks, std::size_t blocks, std::size_t n_sums, Ranks& ranks) {
  const auto bytes_of = [&](std::size_t rank) {
    const Share share(blocks, rank, ranks.size());
    return std::as_writable_bytes(
        std::span(of_blocks).subspan(share.first * n_sums, (share.last - share.first) * n_sums));
  };
  const std::span<std::byte> own = bytes_of(ranks.rank());
  const auto all = ranks.all_gather({reinterpret_cast<const char*>(own.data()), own.size()});
  for (std::size_t r = 0; r < all.size(); ++r) {
    const std::span<std::byte> place = bytes_of(r);
    TEMPER_ASSERT(all[r].size() == place.size());
    if (!place.empty()) std::memcpy(place.data(), all[r].data(), place.size());
  }
}

/// Several such sums in one walk, for each block: block(b, sums) adds to what begins as zeros, and changes nothing
/// else, since the ranks of an executor share out the blocks. Result: n_sums numbers a block.
template <class Block>
std::vector<double> sums_by_block(std::size_t n, std::size_t n_sums, Executor* executor, Block&& block) {
  const std::size_t blocks = (n + kBlockSize - 1) / kBlockSize;
  std::vector<double> of_blocks(blocks * n_sums, 0.0);
  Ranks* const ranks = executor != nullptr ? executor->ranks() : nullptr;
  const Share own = ranks != nullptr ? Share(blocks, ranks->rank(), ranks->size()) : Share(blocks, 0, 1);
  or_serial(executor).run(own.last - own.first, [&](std::size_t i) {
    const std::size_t b = own.first + i;
    block(b, std::span(of_blocks).subspan(b * n_sums, n_sums));
  });
  if (ranks != nullptr) share_sums(of_blocks, blocks, n_sums, *ranks);
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
std::vector<double> sums_of_blocks(std::size_t n, std::size_t n_sums, Executor* executor, Block&& block) {
  if (n_sums == 0) return {};
  return totals_of(sums_by_block(n, n_sums, executor, std::forward<Block>(block)), n_sums);
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
