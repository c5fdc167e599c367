#include "temper/detail/tbb_executor.hpp"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <optional>

namespace temper {

struct TbbExecutor::Arena {
  explicit Arena(std::size_t n) : threads(n), arena(static_cast<int>(n)) {
    // oneTBB has as many workers as the machine has processors, unless the whole program has another limit.
    if (threads > static_cast<std::size_t>(tbb::info::default_concurrency())) {
      more.emplace(tbb::global_control::max_allowed_parallelism, threads);
    }
  }
  std::size_t threads;
  std::optional<tbb::global_control> more;
  tbb::task_arena arena;
};

namespace {

std::size_t processors() { return static_cast<std::size_t>(std::max(1, tbb::info::default_concurrency())); }

}  // namespace

std::size_t TbbExecutor::most_threads() {
  constexpr std::size_t kEnough = 16, kTimes = 4;  // a test of 8 threads has to run on one processor, too
  return std::max(kEnough, kTimes * processors());
}

TbbExecutor::TbbExecutor(std::size_t threads)
    : arena_(std::make_unique<Arena>(threads > 0 ? std::min(threads, most_threads()) : processors())) {}

TbbExecutor::~TbbExecutor() = default;

std::size_t TbbExecutor::threads() const { return arena_->threads; }

void TbbExecutor::run(std::size_t n, const std::function<void(std::size_t)>& block) {
  if (n < 2 || arena_->threads < 2) {
    for (std::size_t i = 0; i < n; ++i) block(i);
    return;
  }
  arena_->arena.execute([&] {
    // Isolated: a thread that waits here takes no block of another run(), whose scratch memory it may be using.
    tbb::this_task_arena::isolate(
        [&] { tbb::parallel_for(std::size_t{0}, n, std::size_t{1}, block, tbb::simple_partitioner()); });
  });
}

}  // namespace temper
