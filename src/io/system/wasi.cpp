// Temporary files of a program that is alone, in the browser's memory. No other run writes the same file or leaves one
// behind, and no signal ends this run. See system.hpp.
#include <fcntl.h>
#include <unistd.h>

#include <cstdint>
#include <optional>
#include <utility>

#include "io/system/system.hpp"
#include "io/text/failure.hpp"
#include "temper/io.hpp"

namespace temper::io {
namespace {

constexpr std::size_t kNoEntry = 0;  // no list
constexpr int kNoLock = -1;

}  // namespace

void discard_unfinished() noexcept {}

Temporary Temporary::beside(const std::string& target) {
  std::string path = text(target, ".tmp0");
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (file < 0) return {};
  close(file);
  return {std::move(path), kNoEntry, kNoLock};
}

int Temporary::open() const { return ::open(path_.c_str(), O_WRONLY); }

void Temporary::take_permissions(const std::string& /*target*/) const {}

void Temporary::end() { path_.clear(); }

std::string without_links(const std::string& path) { return path; }

// No process, and no stream with a name.
bool is_of_process(const std::string& /*path*/) { return false; }
int open_file_of(const std::string& /*path*/) { return -1; }
bool is_open_to_write(int /*file*/) { return true; }
int open_to_write(const std::string& path) { return ::open(path.c_str(), O_WRONLY | O_TRUNC); }

std::optional<std::uint64_t> free_memory() {
  constexpr std::uint64_t kAddresses = std::uint64_t{1} << 32;
  return kAddresses - reinterpret_cast<std::uintptr_t>(sbrk(0));  // the end of the memory so far
}

}  // namespace temper::io
