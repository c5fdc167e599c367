// See input.hpp.
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "exit.hpp"
#include "files/input.hpp"
#include "system/system.hpp"
#include "temper/detail/path.hpp"

namespace temper::app {
namespace {

/// Many times the need of reading and unpacking a file of that size, and of the libraries that do it.
Budget budget_of(std::uint64_t file_bytes) {
  constexpr std::uint64_t kMegabyte = 1 << 20;
  return {static_cast<unsigned>(3 + file_bytes / kMegabyte), 768 * kMegabyte + 256 * file_bytes};
}

/// The size of a file; 0 for pipes.
std::uint64_t size_of(const std::string& path) {
  std::error_code none;
  return std::filesystem::is_regular_file(path_of(path), none) ? std::filesystem::file_size(path_of(path), none) : 0;
}

bool is_hdf5(const std::string& path) {
  char head[8] = {};
  std::ifstream(path_of(path), std::ios::binary).read(head, sizeof head);
  return std::memcmp(head, "\x89HDF\r\n\x1a\n", sizeof head) == 0;
}

/// Nothing, or the code of the error, its place, a zero, and its message.
std::string packed(const Expected<io::MeshFile>& file) {
  if (file) return {};
  const InputError& error = file.error();
  return static_cast<char>(error.code) + error.where + '\0' + error.message;
}

InputError unpacked(const std::string& text) {
  const std::size_t end = text.find('\0', 1);
  return {static_cast<ErrorCode>(text[0]), text.substr(1, end - 1), text.substr(end + 1)};
}

/// The reason not to read the file here; nothing when the child could read it, or when there can be no child.
Expected<void> read_in_child(const std::string& path, const Budget& budget, const io::ReadOptions& options) {
  const auto tried = try_in_child(budget, [&] { return packed(io::read(path, {.flat = options.flat})); });
  if (!tried) return {};
  switch (tried->end) {
    case Tried::End::done:
      if (tried->answer.empty()) return {};
      return unpacked(tried->answer);
    case Tried::End::crashed:
      return InputError{ErrorCode::syntax, path, "libhdf5 crashes: the file is damaged"};
    case Tried::End::too_slow:
      return InputError{ErrorCode::syntax, path,
                        "libhdf5 does not finish within " + std::to_string(budget.seconds) +
                            " s: the file is damaged or slow to read. Next: write it without compression, or as "
                            "classic NetCDF (nccopy -k cdf5)"};
    case Tried::End::not_started:
      break;
  }
  return InputError{
      ErrorCode::unsupported, path,
      std::string("cannot be read: the process that reads it first could not be started: ") + std::strerror(errno)};
}

}  // namespace

io::MeshFile read_tried(const std::string& path, const io::ReadOptions& options) {
  const std::uint64_t size = size_of(path);
  prepare_for_file(size);
  if (size > 0 && is_hdf5(path)) or_fail(read_in_child(path, budget_of(size), options));
  return or_fail(io::read(path, options));
}

}  // namespace temper::app
