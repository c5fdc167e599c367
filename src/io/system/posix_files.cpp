// Files of POSIX: see system.hpp.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "io/system/system.hpp"

namespace temper::io {

OnDisk look_at(const std::string& path) {
  struct stat found = {};
  const bool exists = stat(path.c_str(), &found) == 0;
  if (exists && S_ISDIR(found.st_mode)) return {OnDisk::Kind::folder};
  if (is_of_process(path)) return {OnDisk::Kind::other};  // a closed one is no place for a file, either
  if (!exists) return {};
  if (!S_ISREG(found.st_mode)) return {OnDisk::Kind::other};
  return {OnDisk::Kind::file, static_cast<std::uint64_t>(found.st_size)};
}

std::string reason(int code) { return std::strerror(code); }

std::FILE* open_to_read(const std::string& path) { return std::fopen(path.c_str(), "rb"); }

bool write_all(int file, const char* bytes, std::size_t n) {
  while (n > 0) {
    const ssize_t written = ::write(file, bytes, n);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes += written;
    n -= static_cast<std::size_t>(written);
  }
  return true;
}

/// Some file systems do not support fsync.
bool reach_disk(int file) { return fsync(file) == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS; }
bool close_file(int file) { return ::close(file) == 0 || errno == EINTR; }

bool make_folder(const std::string& path) { return mkdir(path.c_str(), 0777) == 0; }
void remove_folder(const std::string& path) { rmdir(path.c_str()); }

bool Temporary::rename_to(const std::string& target) {
  if (std::rename(path_.c_str(), target.c_str()) != 0) return false;
  end();
  return true;
}

void Temporary::remove() {
  if (!exists()) return;
  unlink(path_.c_str());
  end();
}

void give_memory_back() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace temper::io
