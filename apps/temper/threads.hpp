// The threads of a run: oneTBB behind the library's Executor, or none when the program was built without it.
#pragma once

#include <cstddef>
#include <memory>

#include "temper/detail/executor.hpp"

namespace temper::app {

/// As many threads as asked for (0: as the machine has). Null when that is one: then everything runs in the caller.
[[nodiscard]] std::unique_ptr<Executor> make_threads(std::size_t threads);

}  // namespace temper::app
