// The memory that is left, by the files in which Linux gives it: /proc/meminfo and the control groups of containers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace temper::io {

/// Free memory of the machine and of the control groups, versions 1 and 2 [bytes]; nothing if no file gives it.
/// `root`: the folder that has proc and sys.
[[nodiscard]] std::optional<std::uint64_t> free_memory_in_files(const std::string& root);

}  // namespace temper::io
