// The terminal: errors and warnings in one form, the abilities of the terminal, and text in columns.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace temper::app {

// They print printable text only: names and paths made by others reach no terminal unchanged.
void print_error(std::string_view message);
void print_warnings(std::span<const std::string> messages);

/// Text to standard error. If it cannot be written, it is lost.
void put_to_error(std::string_view text);

/// Text for people to standard output, unless quiet. Throws Failure when it cannot be written. If the reader of a pipe
/// has ended, the text is lost, and the program goes on: its files matter more.
void print(std::string_view text);
/// Data that the user asked for, such as JSON, to standard output, also when quiet. It fails as print() does.
void print_data(std::string_view text);
/// From now on print() prints nothing: --quiet.
void be_quiet();
[[nodiscard]] bool is_quiet();
/// From now on print() writes to standard error: a mesh takes standard output.
void print_to_standard_error();
/// Makes sure that everything printed so far is written. Throws Failure, for example on a full disk behind a
/// redirection.
void flush_output();

/// Columns of the terminal on standard output; 88 when it is none, which pages of the docs show whole.
[[nodiscard]] std::size_t output_width();

/// Columns that UTF-8 text takes, one for each code point.
[[nodiscard]] std::size_t display_width(std::string_view text);
[[nodiscard]] std::string pad_left(std::string_view text, std::size_t width);
[[nodiscard]] std::string pad_right(std::string_view text, std::size_t width);
/// "1 edge", "3 edges"
[[nodiscard]] std::string plural(std::size_t n, std::string_view one, std::string_view several);
/// "4 vertices, 1 triangle"
/// Lines of at most width columns, broken at spaces.
[[nodiscard]] std::vector<std::string> wrap(std::string_view text, std::size_t width);

}  // namespace temper::app
