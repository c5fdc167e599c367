#include "selection.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <string_view>

namespace temper::gallery {
namespace {

constexpr int kLastOfPaper = 32;

struct Range {
  int first, last;
};

InputError error(std::string message) { return {ErrorCode::invalid_option, "", std::move(message)}; }

std::optional<int> parse_number(std::string_view text) {
  int number = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool digits = !text.empty() && text[0] >= '0' && text[0] <= '9';
  if (!digits || status != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// "6" is the range 6-6.
std::optional<Range> parse_range(std::string_view text) {
  const std::size_t dash = text.find('-');
  const std::optional<int> first = parse_number(text.substr(0, dash));
  const std::optional<int> last = dash == text.npos ? first : parse_number(text.substr(dash + 1));
  if (!first || !last) return std::nullopt;
  return Range{*first, *last};
}

bool is_among(std::span<const Figure> all, int number) {
  return std::ranges::find(all, number, &Figure::number) != all.end();
}

/// The reason why the figures of this range cannot be made, or nothing.
std::optional<std::string> problem(std::span<const Figure> all, std::string_view text, Range range) {
  if (range.first > range.last) return "'" + std::string(text) + "' is an empty range";
  for (const int number : {range.first, range.last}) {
    if (number < 1 || number > kLastOfPaper) {
      return "there is no figure " + std::to_string(number) + ": the paper has figures 1 to " +
             std::to_string(kLastOfPaper);
    }
  }
  for (int number = range.first; number <= range.last; ++number) {
    if (!is_among(all, number)) return "figure " + std::to_string(number) + " is not in this gallery";
  }
  return std::nullopt;
}

}  // namespace

Expected<std::vector<Figure>> select(std::span<const Figure> all, std::span<const std::string> words) {
  std::set<int> numbers;
  for (std::string_view rest : words) {
    for (bool more = true; more;) {
      const std::size_t comma = rest.find(',');
      const std::string_view item = rest.substr(0, comma);
      more = comma != rest.npos;
      if (more) rest.remove_prefix(comma + 1);

      const std::optional<Range> range = parse_range(item);
      if (!range)
        return error("'" + std::string(item) + "' is not a figure: give a number, a list 6,8 or a range 16-18");
      if (std::optional<std::string> why = problem(all, item, *range)) return error(*std::move(why));
      for (int number = range->first; number <= range->last; ++number) numbers.insert(number);
    }
  }
  std::vector<Figure> chosen;
  std::ranges::copy_if(all, std::back_inserter(chosen),
                       [&](const Figure& figure) { return words.empty() || numbers.contains(figure.number); });
  return chosen;
}

}  // namespace temper::gallery
