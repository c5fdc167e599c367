// Loops over long arrays in blocks, on the executor's threads when there is one. The blocks depend on the length alone.
#pragma once

#include <algorithm>
#include <cstddef>

#include "temper/detail/executor.hpp"

namespace temper {

inline constexpr std::size_t kLoopBlock = 16384;  // enough work to be worth a task, small enough to balance

/// work(first, last) of each block of 0 … n − 1.
template <class Work>
void for_blocks(std::size_t n, Executor* executor, Work&& work) {
  const std::size_t blocks = (n + kLoopBlock - 1) / kLoopBlock;
  or_serial(executor).run(blocks, [&](std::size_t b) { work(b * kLoopBlock, std::min(n, (b + 1) * kLoopBlock)); });
}

/// work(i) for each i.
template <class Work>
void for_each_index(std::size_t n, Executor* executor, Work&& work) {
  for_blocks(n, executor, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) work(i);
  });
}

}  // namespace temper
