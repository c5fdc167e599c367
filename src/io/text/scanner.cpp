#include "io/text/scanner.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

namespace temper::io {
namespace {

bool is_space(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

}  // namespace

bool looks_like_number(std::string_view word) {
  if (word == "inf" || word == "-inf" || word == "nan" || word == "-nan") return true;
  return word.find_first_of("0123456789") != std::string_view::npos &&
         word.find_first_not_of("0123456789+-.eEdD") == std::string_view::npos;
}

std::string_view trimmed(std::string_view s) {
  const std::size_t first = s.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(" \t\r\n") - first + 1);
}

std::string in_quotes(std::string_view word) {
  constexpr std::size_t kMost = 40;
  std::string result = "'";
  for (const char c : word.substr(0, kMost)) result += static_cast<unsigned char>(c) < 32 || c == 127 ? '?' : c;
  if (word.size() > kMost) result += "…";
  return result + "'";
}

void Scanner::fail_truncated(std::string_view expected) const {
  fail_here(ErrorCode::truncated, "the file ends where ", expected, " was expected");
}

void Scanner::skip_space() {
  while (at_ != end_) {
    if (*at_ == '\n') {
      ++line_;
      ++at_;
    } else if (is_space(*at_)) {
      ++at_;
    } else if (comment_ != '\0' && *at_ == comment_) {
      while (at_ != end_ && *at_ != '\n') ++at_;
    } else {
      return;
    }
  }
}

std::string_view Scanner::word(std::string_view expected) {
  skip_space();
  const char* start = at_;
  while (at_ != end_ && !is_space(*at_)) ++at_;
  if (start == at_) fail_truncated(expected);
  return {start, static_cast<std::size_t>(at_ - start)};
}

std::string_view Scanner::peek() {
  skip_space();
  const char* stop = at_;
  while (stop != end_ && !is_space(*stop)) ++stop;
  return {at_, static_cast<std::size_t>(stop - at_)};
}

std::string_view Scanner::rest_of_line() {
  while (at_ != end_ && *at_ != '\n' && is_space(*at_)) ++at_;
  const char* start = at_;
  while (at_ != end_ && *at_ != '\n') ++at_;
  const char* stop = at_;
  while (stop != start && is_space(stop[-1])) --stop;
  next_line();
  return {start, static_cast<std::size_t>(stop - start)};
}

bool Scanner::more_on_line() {
  while (at_ != end_ && *at_ != '\n' && is_space(*at_)) ++at_;
  return at_ != end_ && *at_ != '\n' && !(comment_ != '\0' && *at_ == comment_);
}

void Scanner::next_line() {
  while (at_ != end_ && *at_ != '\n') ++at_;
  if (at_ == end_) return;
  ++at_;
  ++line_;
}

std::size_t Scanner::count(std::string_view things, std::size_t bytes_each) {
  const auto n = number<std::int64_t>(text("the number of ", things));
  if (n < 0) fail_here(ErrorCode::syntax, "expected the number of ", things, ", found ", n);
  check_room(static_cast<std::uint64_t>(n), things, bytes_each);
  return static_cast<std::size_t>(n);
}

void Scanner::check_room(std::uint64_t n, std::string_view things, std::size_t bytes_each) const {
  // The last item needs no blank behind it.
  if (n <= (remaining() + 1) / bytes_each) return;
  fail_here(ErrorCode::truncated, "announces ", n, " ", things, ", but only ", remaining(), " bytes follow");
}

std::int32_t Scanner::vertex(std::int32_t first) {
  const auto n = number<std::int64_t>("a vertex number");
  if (n < std::numeric_limits<std::int32_t>::min() + 1 || n > std::numeric_limits<std::int32_t>::max()) {
    fail_here(ErrorCode::index_out_of_range, "vertex number ", n, " is beyond 32 bits");
  }
  return static_cast<std::int32_t>(n - first);
}

std::string_view Scanner::bytes(std::size_t n, std::string_view expected) {
  if (n > remaining()) fail(ErrorCode::truncated, path_, "the file ends within ", expected);
  const char* start = at_;
  at_ += n;
  return {start, n};
}

std::optional<std::string_view> Scanner::until(std::string_view mark) {
  const std::size_t found = tail().find(mark);
  if (found == std::string_view::npos) return std::nullopt;
  const std::string_view before(at_, found);
  line_ += static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  at_ += found + mark.size();
  return before;
}

// Numbers that from_chars does not take: a leading plus, a Fortran exponent (1.0D+00), doubles out of range.
template <class T>
T Scanner::unusual_number(std::string_view w, std::string_view expected) const {
  std::string plain(w.substr(w.starts_with('+') && !w.starts_with("+-") ? 1 : 0));
  if constexpr (std::is_floating_point_v<T>) {
    if (plain.find_first_not_of("0123456789+-.dDeE") == std::string::npos) {
      std::replace_if(
          plain.begin(), plain.end(), [](char c) { return c == 'd' || c == 'D'; }, 'e');
    }
  }
  T value{};
  const auto [end, error] = read_number(plain.data(), plain.data() + plain.size(), value);
  if (end == plain.data() + plain.size()) {
    if (error == std::errc()) return value;
    if constexpr (std::is_floating_point_v<T>) {
      // Out of range: a number that is too small is zero, one that is too large is infinite and is refused later.
      const std::size_t exponent = plain.find_first_of("eE");
      const std::size_t digit = plain.find_first_of("123456789");
      const bool tiny = exponent == std::string::npos ? plain.find('.') < digit : plain[exponent + 1] == '-';
      const T magnitude = tiny ? T(0) : std::numeric_limits<T>::infinity();
      return plain.starts_with('-') ? -magnitude : magnitude;
    } else {
      fail_here(ErrorCode::syntax, "expected ", expected, ", found ", in_quotes(w), ", which is out of range");
    }
  }
  fail_here(ErrorCode::syntax, "expected ", expected, ", found ", in_quotes(w));
}

template double Scanner::unusual_number(std::string_view, std::string_view) const;
template float Scanner::unusual_number(std::string_view, std::string_view) const;
template std::int64_t Scanner::unusual_number(std::string_view, std::string_view) const;
template std::int32_t Scanner::unusual_number(std::string_view, std::string_view) const;
template std::int16_t Scanner::unusual_number(std::string_view, std::string_view) const;
template std::int8_t Scanner::unusual_number(std::string_view, std::string_view) const;
template std::uint64_t Scanner::unusual_number(std::string_view, std::string_view) const;
template std::uint32_t Scanner::unusual_number(std::string_view, std::string_view) const;
template std::uint16_t Scanner::unusual_number(std::string_view, std::string_view) const;
template std::uint8_t Scanner::unusual_number(std::string_view, std::string_view) const;

}  // namespace temper::io
