// Temporary files beside the files whose place they take, and what becomes of them when a run does not end well.
//
//   OUT.tmp0   new bytes, locked by the run that writes them; renamed to OUT when they are whole
//
// A run that fails removes its own, and so does a signal that ends the program (io::discard_unfinished). A run that is
// killed leaves them. They are in nobody's way: the lock ended with its owner, so the next run that writes OUT removes
// OUT.tmp0 and makes its own.
#pragma once

#include <cstddef>
#include <string>
#include <utility>

namespace temper::io {

class Temporary {
 public:
  Temporary() = default;
  /// Made empty beside `target`, for this run alone. On failure there is none, and errno says why.
  static Temporary beside(const std::string& target);
  Temporary(Temporary&& other) noexcept { *this = std::move(other); }
  Temporary& operator=(Temporary&& other) noexcept;
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary() { remove(); }

  [[nodiscard]] bool exists() const { return !path_.empty(); }
  [[nodiscard]] const std::string& path() const { return path_; }
  /// The file, open for writing, to be closed by the caller; −1: errno says why. (What holds the lock stays here.)
  [[nodiscard]] int open() const;
  /// Gives it the permissions of the file whose place it is to take, as far as it may have them.
  void take_permissions(const std::string& target) const;
  /// Puts it in the place of `target`. False: errno says why, and nothing has changed.
  bool rename_to(const std::string& target);
  void remove();

 private:
  Temporary(std::string path, std::size_t entry, int lock);
  void end();

  std::string path_;
  std::size_t entry_ = 0;  // of the list that discard_unfinished() goes through
  int lock_ = -1;          // the open file that has it
};

/// The path of the file itself, where links lead to it.
[[nodiscard]] std::string without_links(const std::string& path);

}  // namespace temper::io
