#include "threads.hpp"

#ifdef TEMPER_WITH_TBB
#include "temper/detail/tbb_executor.hpp"
#endif

namespace temper::app {

#ifdef TEMPER_WITH_TBB

std::unique_ptr<Executor> make_threads(std::size_t threads) {
  if (threads == 1) return nullptr;
  auto executor = std::make_unique<TbbExecutor>(threads);
  if (executor->threads() == 1) return nullptr;
  return executor;
}

#else

std::unique_ptr<Executor> make_threads(std::size_t) { return nullptr; }

#endif

}  // namespace temper::app
