// Words and numbers from text, with their line. Every announced count is compared with the rest of the file before
// anything is allocated.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "io/text/failure.hpp"
#include "temper/detail/read_number.hpp"

namespace temper::io {

class Scanner {
 public:
  /// `comment`: the character that starts a comment up to the end of the line; '\0': none does.
  Scanner(std::string path, std::string_view bytes, char comment = '\0')
      : path_(std::move(path)), begin_(bytes.data()), at_(begin_), end_(begin_ + bytes.size()), comment_(comment) {}

  [[nodiscard]] std::size_t line() const { return line_; }
  /// "coast.msh:41"
  [[nodiscard]] std::string where() const { return text(path_, ":", line_); }
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::size_t remaining() const { return static_cast<std::size_t>(end_ - at_); }
  template <class... Parts>
  [[noreturn]] void fail_here(ErrorCode code, const Parts&... message) const {
    fail(code, where(), message...);
  }
  [[noreturn]] void fail_truncated(std::string_view expected) const;

  /// Skips blanks and comments; line() is then the line of the next word.
  void skip_space();
  [[nodiscard]] bool at_end() {
    skip_space();
    return at_ == end_;
  }
  /// The next word; `expected` names the missing word when the file ends before it.
  std::string_view word(std::string_view expected);
  /// The next word, without moving past it; empty at the end.
  [[nodiscard]] std::string_view peek();
  /// Returns the rest of this line, without blanks at its ends, and goes on to the next line.
  std::string_view rest_of_line();
  /// Says whether another word follows on this line.
  [[nodiscard]] bool more_on_line();

  template <class T>
  T number(std::string_view expected) {
    const std::string_view w = word(expected);
    T value{};
    const auto [end, error] = read_number(w.data(), w.data() + w.size(), value);
    if (error == std::errc() && end == w.data() + w.size()) return value;
    return unusual_number<T>(w, expected);
  }
  double real(std::string_view expected) { return number<double>(expected); }
  std::int32_t integer(std::string_view expected) { return number<std::int32_t>(expected); }
  /// Reads the number of things that follow, each of at least `bytes_each` bytes.
  std::size_t count(std::string_view things, std::size_t bytes_each);
  void check_room(std::uint64_t count, std::string_view things, std::size_t bytes_each) const;
  /// The index of a vertex number that counts from `first`; checked against the number of vertices later.
  std::int32_t vertex(std::int32_t first);

  // --- bytes ---------------------------------------------------------------------------------------
  /// The next n bytes as they are.
  std::string_view bytes(std::size_t n, std::string_view expected);
  /// Everything up to `mark`, which is skipped too; nothing when there is none.
  std::optional<std::string_view> until(std::string_view mark);
  /// Moves past the end of this line.
  void next_line();
  [[nodiscard]] const char* position() const { return at_; }
  [[nodiscard]] std::string_view tail() const { return {at_, remaining()}; }

 private:
  template <class T>
  [[nodiscard]] T unusual_number(std::string_view word, std::string_view expected) const;

  std::string path_;
  const char* begin_;
  const char* at_;
  const char* end_;
  std::size_t line_ = 1;
  char comment_;
};

/// Says whether a word may be a number, for guesses at formats. Fortran's numbers count, and values that are not
/// finite.
[[nodiscard]] bool looks_like_number(std::string_view word);

/// The text without blanks and ends of lines at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view s);

/// A word for a message: at most 40 characters, control characters shown as '?'.
[[nodiscard]] std::string in_quotes(std::string_view word);

}  // namespace temper::io
