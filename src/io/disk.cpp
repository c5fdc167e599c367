// See disk.hpp.
#include "io/disk.hpp"

#include <sys/stat.h>

namespace temper::io {

OnDisk look_at(const std::string& path) {
  struct stat found = {};
  if (stat(path.c_str(), &found) != 0) return {};
  if (S_ISDIR(found.st_mode)) return {OnDisk::Kind::folder};
  if (!S_ISREG(found.st_mode)) return {OnDisk::Kind::other};
  return {OnDisk::Kind::file, static_cast<std::uint64_t>(found.st_size)};
}

bool is_stream(const std::string& path) {
  return path.starts_with("/dev/std") || path.starts_with("/dev/fd/") || look_at(path).kind == OnDisk::Kind::other;
}

}  // namespace temper::io
