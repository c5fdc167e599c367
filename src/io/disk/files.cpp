#include "io/disk/files.hpp"

#ifdef __linux__
#include <malloc.h>
#endif
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

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

namespace {

struct Closer {
  void operator()(std::FILE* f) const { std::fclose(f); }
};

}  // namespace

std::string without_suffix(const std::string& path, std::string_view suffix) {
  return path.ends_with(suffix) ? path.substr(0, path.size() - suffix.size()) : path;
}

Source load(const std::string& path) {
  const OnDisk there = look_at(path);
  if (there.kind == OnDisk::Kind::folder) fail(ErrorCode::not_found, path, "is a directory, not a mesh file");
  const std::unique_ptr<std::FILE, Closer> file(std::fopen(path.c_str(), "rb"));
  if (!file) fail(ErrorCode::not_found, path, "cannot be read: ", std::strerror(errno));

  Source source{.path = path, .bytes = {}};
  constexpr std::size_t kChunk = 1 << 16;
  const auto size = static_cast<std::size_t>(there.bytes);
  source.bytes.reserve(size + kChunk);  // the last look for more bytes must not move them all
  source.bytes.resize(size);
  std::size_t got = std::fread(source.bytes.data(), 1, source.bytes.size(), file.get());
  source.bytes.resize(got);
  // Pipes have no size, and a file may have grown.
  for (;;) {
    source.bytes.resize(got + kChunk);
    const std::size_t more = std::fread(source.bytes.data() + got, 1, kChunk, file.get());
    source.bytes.resize(got += more);
    if (more == 0) break;
  }
  if (std::ferror(file.get())) fail(ErrorCode::not_found, path, "cannot be read: ", std::strerror(errno));
  if (source.bytes.empty()) fail(ErrorCode::empty_input, path, "the file is empty");
  source.allowance = Allowance(source.bytes.size());
  return source;
}

std::string first_bytes(const std::string& path, std::size_t n) {
  const std::unique_ptr<std::FILE, Closer> file(std::fopen(path.c_str(), "rb"));
  std::string bytes(file ? n : 0, '\0');
  if (file) bytes.resize(std::fread(bytes.data(), 1, n, file.get()));
  return bytes;
}

void give_memory_back() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace temper::io
