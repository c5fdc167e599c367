// These functions ask the operating system. posix.cpp has them for Linux and macOS, windows.cpp for Windows, and
// wasi.cpp for browsers. posix.cpp and wasi.cpp share posix_files.cpp. (libc++ for WebAssembly has no std::filesystem.)
//
// Paths are UTF-8. A function that fails sets errno.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

namespace temper::io {

struct OnDisk {
  enum class Kind { nothing, file, folder, other };  ///< links followed; other: a stream, as is_stream() says
  Kind kind = Kind::nothing;
  std::uint64_t bytes = 0;  ///< of a file

  [[nodiscard]] bool exists() const { return kind != Kind::nothing; }
};

/// Says whether the path stands for an open file of this process or another one, links followed. It may be closed.
[[nodiscard]] bool is_of_process(const std::string& path);
/// A path that cannot be examined counts as nothing: opening it gives the reason.
[[nodiscard]] OnDisk look_at(const std::string& path);
/// Follows links from file to file. Returns the path of the file itself, which need not exist. If the links go in
/// circles, the path is empty, and errno has the reason.
[[nodiscard]] std::string without_links(const std::string& path);
/// Why an operation on a file failed, from errno.
[[nodiscard]] std::string reason(int code);

/// A file or stream of bytes, or null.
[[nodiscard]] std::FILE* open_to_read(const std::string& path);
/// A stream, or −1. An open file of this process is written on from where it is.
[[nodiscard]] int open_to_write(const std::string& path);
[[nodiscard]] bool write_all(int file, const char* bytes, std::size_t n);
/// False on a full or broken disk, which may become known only now.
[[nodiscard]] bool reach_disk(int file);
bool close_file(int file);

[[nodiscard]] bool make_folder(const std::string& path);
/// Does nothing if the folder is not empty.
void remove_folder(const std::string& path);

/// Returns freed memory to the system if the C library keeps it between blocks in use. Otherwise the memory for reading
/// a large file would add to all later memory.
void give_memory_back();

// Temporary files next to their targets, and their fate when a run does not end well.
//
//   OUT.tmp0   new bytes, locked by the run that writes them; renamed to OUT when they are whole
//
// A run that fails removes its own, and so does a signal that ends the program (io::discard_unfinished). A run that is
// killed leaves them, without harm: the lock ended with its owner. So the next run that writes OUT removes OUT.tmp0 and
// makes its own. (Windows removes the files of a run that ends in any way.)

class Temporary {
 public:
  Temporary() = default;
  /// Makes an empty file next to `target`, for this run alone. On failure there is none, and errno has the reason.
  static Temporary beside(const std::string& target);
  Temporary(Temporary&& other) noexcept { *this = std::move(other); }
  Temporary& operator=(Temporary&& other) noexcept {
    if (this == &other) return *this;
    remove();
    path_ = std::exchange(other.path_, {});
    entry_ = other.entry_;
    lock_ = other.lock_;
    return *this;
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary() { remove(); }

  [[nodiscard]] bool exists() const { return !path_.empty(); }
  [[nodiscard]] const std::string& path() const { return path_; }
  /// The file, open for writing, to be closed by the caller; −1: errno has the reason. (The lock stays here.)
  [[nodiscard]] int open() const;
  /// Gives it the permissions of the target, as far as it may have them.
  void take_permissions(const std::string& target) const;
  /// Puts it in the place of `target`. False: errno has the reason, and nothing has changed.
  bool rename_to(const std::string& target);
  void remove();

 private:
  Temporary(std::string path, std::size_t entry, int lock) : path_(std::move(path)), entry_(entry), lock_(lock) {}
  void end();

  std::string path_;
  std::size_t entry_ = 0;  // of the list that discard_unfinished() goes through
  int lock_ = -1;          // the open file that has it
};

/// A library that is loaded until the process ends, or null.
[[nodiscard]] void* load_library(const std::string& file);
/// The symbol of that name in the library, or null.
[[nodiscard]] void* symbol_of(void* library, const char* name);
/// Frees memory that a library has taken from its malloc.
void free_of_library(void* memory);
/// The program or library that holds this code, or empty.
[[nodiscard]] std::string file_of_this_code();

}  // namespace temper::io
