// The threads of a run: oneTBB behind the library's Executor, or none when the program was built without it.
#pragma once

#include <cstddef>
#include <memory>

#include "temper/detail/executor.hpp"

namespace temper::app {

/// The largest number that make_threads() takes.
[[nodiscard]] std::size_t most_threads();
/// As many threads as requested (0: as many as processors). Null for one thread: then everything runs in the caller.
[[nodiscard]] std::unique_ptr<Executor> make_threads(std::size_t threads);

}  // namespace temper::app
