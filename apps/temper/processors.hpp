// The processors of the machine that this process may run on: mpirun and job schedulers bind each process to its own.
#pragma once

#include <cstddef>
#include <string>

namespace temper::app {

/// One bit each, from the lowest of the first byte. Empty where the system does not say.
[[nodiscard]] std::string own_processors();
/// Lets this process, and threads that it will start, run on these. False, and all is as before, when the system does
/// not let it run on all.
[[nodiscard]] bool run_on(const std::string& processors);

/// Those of either.
[[nodiscard]] std::string both(std::string a, const std::string& b);
[[nodiscard]] std::size_t count_processors(const std::string& processors);

}  // namespace temper::app
