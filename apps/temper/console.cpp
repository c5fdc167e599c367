#include "console.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "exit.hpp"
#include "system/system.hpp"
#include "temper/detail/error.hpp"

namespace temper::app {

void put_to_error(std::string_view text) { static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr)); }

void print_error(std::string_view message) { put_to_error(fmt::format("temper: error: {}\n", printable(message))); }

void print_warnings(std::span<const std::string> messages) {
  for (const std::string& message : messages) put_to_error(fmt::format("temper: warning: {}\n", printable(message)));
}

namespace {

struct Printing {
  std::FILE* to = stdout;
  bool is_quiet = false;       // by --quiet
  bool has_no_reader = false;  // the reader of the pipe has ended
};

Printing& printing() {
  static Printing now;
  return now;
}

void expect_printed(bool printed) {
  if (printed) return;
  if (errno != EPIPE)
    throw Failure(Exit::bad_input,
                  fmt::format("standard output: {}", errno == EBADF ? "it is closed" : std::strerror(errno)));
  printing().has_no_reader = true;
}

}  // namespace

void print_to_standard_error() { printing().to = stderr; }
void be_quiet() { printing().is_quiet = true; }
bool is_quiet() { return printing().is_quiet || printing().has_no_reader; }

void print(std::string_view text) {
  if (!is_quiet()) print_data(text);
}

void print_data(std::string_view any_text) {
  if (printing().has_no_reader) return;
  const std::string text = printable(any_text);
  expect_printed(std::fwrite(text.data(), 1, text.size(), printing().to) == text.size());
}

void flush_output() {
  if (!printing().has_no_reader) expect_printed(std::fflush(stdout) == 0);
}

std::size_t output_width() {
  constexpr std::size_t kUsual = 88;
  const std::size_t columns = terminal_columns();
  return columns > 0 ? columns : kUsual;
}

std::size_t display_width(std::string_view text) {
  // Continuation bytes of UTF-8 are 10xxxxxx; temper prints no wide or combining characters.
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; }));
}

std::string pad_left(std::string_view text, std::size_t width) {
  const std::size_t used = display_width(text);
  return std::string(width > used ? width - used : 0, ' ').append(text);
}

std::string pad_right(std::string_view text, std::size_t width) {
  const std::size_t used = display_width(text);
  return std::string(text).append(width > used ? width - used : 0, ' ');
}

std::string plural(std::size_t n, std::string_view one, std::string_view several) {
  return fmt::format("{} {}", n, n == 1 ? one : several);
}

std::vector<std::string> wrap(std::string_view text, std::size_t width) {
  std::vector<std::string> lines = {""};
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    std::string& line = lines.back();
    if (!line.empty() && display_width(line) + 1 + display_width(word) > width) {
      lines.emplace_back(word);
    } else {
      line.append(line.empty() ? "" : " ").append(word);
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

}  // namespace temper::app
