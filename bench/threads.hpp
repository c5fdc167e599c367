// Threads of oneTBB where temper has been built with it; else there is one.
#pragma once

#include <cstddef>
#include <memory>

#include "temper/detail/executor.hpp"
#ifdef TEMPER_WITH_TBB
#include "temper/detail/tbb_executor.hpp"
#endif

namespace temper::bench {

#ifdef TEMPER_WITH_TBB
inline constexpr bool kHasThreads = true;
#else
inline constexpr bool kHasThreads = false;
#endif

/// Nothing for one thread.
[[nodiscard]] inline std::unique_ptr<Executor> make_executor([[maybe_unused]] std::size_t threads) {
#ifdef TEMPER_WITH_TBB
  if (threads > 1) return std::make_unique<TbbExecutor>(threads);
#endif
  return nullptr;
}

}  // namespace temper::bench
