#include "threads.hpp"

#include <limits>

#ifdef TEMPER_WITH_TBB
#include "temper/detail/tbb_executor.hpp"
#endif

namespace temper::app {

#ifdef TEMPER_WITH_TBB

std::size_t most_threads() { return TbbExecutor::most_threads(); }

std::unique_ptr<Executor> make_threads(std::size_t threads) {
  if (threads == 1) return nullptr;
  auto executor = std::make_unique<TbbExecutor>(threads);
  if (executor->threads() == 1) return nullptr;
  return executor;
}

#else

std::size_t most_threads() { return std::numeric_limits<std::size_t>::max(); }  // all of them are one

std::unique_ptr<Executor> make_threads(std::size_t) { return nullptr; }

#endif

}  // namespace temper::app
