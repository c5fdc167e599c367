// Linux: see free_memory.hpp. Each control group limits all groups below it, so the groups up to the root count. In a
// container the path of the group may be the path outside of it; then only the root is there, which has the limit.
#include "io/system/free_memory.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string_view>

namespace temper::io {
namespace {

/// The number behind a word at the beginning of a line; without a word the first number.
std::optional<std::uint64_t> number_in_file(const std::string& path, std::string_view word) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string first = std::string(word);
    std::uint64_t number = 0;
    if (!word.empty()) words >> first;
    if (first == word && words >> number) return number;  // "max" is no limit
  }
  return {};
}

struct GroupFiles {
  const char *root, *limit, *usage, *cache;
};
constexpr GroupFiles kGroups = {"/sys/fs/cgroup", "memory.max", "memory.current", "inactive_file"};
constexpr GroupFiles kGroupsOfVersion1 = {"/sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.usage_in_bytes",
                                          "total_inactive_file"};

void take_least(std::optional<std::uint64_t>& least, std::optional<std::uint64_t> value) {
  if (value) least = std::min(least.value_or(*value), *value);
}

/// The memory that a group leaves. Files in the cache of the system count as used, but make room.
std::optional<std::uint64_t> left_in_group(const std::string& folder, const GroupFiles& files) {
  const auto limit = number_in_file(folder + "/" + files.limit, "");
  if (!limit) return {};
  const std::uint64_t usage = number_in_file(folder + "/" + files.usage, "").value_or(0),
                      cache = number_in_file(folder + "/memory.stat", files.cache).value_or(0);
  const std::uint64_t used = usage - std::min(usage, cache);
  return *limit - std::min(*limit, used);
}

std::optional<std::uint64_t> left_up_to_root(const std::string& root, std::string group, const GroupFiles& files) {
  const std::string all_groups = root + files.root;
  std::optional<std::uint64_t> least;
  for (;; group.erase(group.rfind('/'))) {
    take_least(least, left_in_group(all_groups + group, files));
    if (group.rfind('/') == std::string::npos) return least;
  }
}

}  // namespace

std::optional<std::uint64_t> free_memory_in_files(const std::string& root) {
  constexpr std::uint64_t kUnit = 1024;
  std::optional<std::uint64_t> least;
  if (const auto free = number_in_file(root + "/proc/meminfo", "MemAvailable:")) least = *free * kUnit;
  std::ifstream groups(root + "/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {  // number:controllers:path
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    const std::string group = line.substr(second + 1) == "/" ? "" : line.substr(second + 1);
    if (controllers == ",,") take_least(least, left_up_to_root(root, group, kGroups));
    if (controllers.find(",memory,") != std::string::npos)
      take_least(least, left_up_to_root(root, group, kGroupsOfVersion1));
  }
  return least;
}

}  // namespace temper::io
