// Loops over long arrays in blocks, on the executor's threads when there is one. The blocks depend on the length alone.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "temper/executor.hpp"

namespace temper {

inline constexpr std::size_t kLoopBlock = 16384;  // enough work to be worth a task, small enough to balance

/// work(first, last) of each block of 0 … n − 1.
template <class Work>
void for_blocks(std::size_t n, Executor* executor, Work&& work) {
  const std::size_t blocks = (n + kLoopBlock - 1) / kLoopBlock;
  const auto block = [&](std::size_t b) { work(b * kLoopBlock, std::min(n, (b + 1) * kLoopBlock)); };
  if (executor != nullptr && blocks > 1) {
    executor->run(blocks, block);
  } else {
    for (std::size_t b = 0; b < blocks; ++b) block(b);
  }
}

/// work(i) for each i.
template <class Work>
void for_each_index(std::size_t n, Executor* executor, Work&& work) {
  for_blocks(n, executor, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) work(i);
  });
}

/// The least i with wrong(i), where make_test() gives each block a test of its own. Without an executor nothing is
/// asked beyond it.
template <class MakeTest>
std::optional<std::size_t> first_index_by(std::size_t n, Executor* executor, MakeTest&& make_test) {
  const auto first_in = [&](std::size_t first, std::size_t last) {
    auto wrong = make_test();
    std::size_t i = first;
    while (i < last && !wrong(i)) ++i;
    return i;
  };
  std::size_t found = n;
  if (executor == nullptr) {
    found = first_in(0, n);
  } else {
    std::vector<std::size_t> of_block((n + kLoopBlock - 1) / kLoopBlock, n);
    for_blocks(n, executor, [&](std::size_t first, std::size_t last) {
      const std::size_t i = first_in(first, last);
      if (i < last) of_block[first / kLoopBlock] = i;
    });
    for (const std::size_t i : of_block) found = std::min(found, i);
  }
  if (found == n) return std::nullopt;
  return found;
}

template <class Wrong>
std::optional<std::size_t> first_index(std::size_t n, Executor* executor, const Wrong& wrong) {
  return first_index_by(n, executor, [&] { return [&](std::size_t i) { return wrong(i); }; });
}

}  // namespace temper
