#include <fmt/format.h>
#include <fmt/ranges.h>

#include "console.hpp"
#include "reports/reports.hpp"

namespace temper::app {
namespace {

std::string line(const std::string& what, const std::vector<std::string>& names) {
  return names.empty() ? std::string() : fmt::format("  {}: {}\n", what, fmt::join(names, ", "));
}

std::string points_text(const io::DataReport& r, std::string_view several) {
  if (r.points_moved + r.points_inserted == 0 || r.interpolated.size() + r.kept.size() + r.dropped.size() == 0)
    return {};
  std::string text = fmt::format("point data: {} of {} moved", r.points_moved, plural(r.points, "point", "points"));
  if (r.points_moved > 0)
    text += fmt::format(", by {:.3g} in the median and {:.3g} at most", r.distance.median, r.distance.max);
  if (r.points_inserted > 0) text += fmt::format("; {} new", plural(r.points_inserted, "point is", "points are"));
  return text + "\n" + line(fmt::format("interpolated on the {} of the input", several), r.interpolated) +
         line("kept with their points", r.kept) + line("dropped", r.dropped);
}

std::string cells_text(const io::DataReport& r, std::string_view one, std::string_view several) {
  if (r.triangles_changed == 0 || r.of_triangles.empty()) return {};
  return fmt::format("cell data: {} of {} have changed\n", r.triangles_changed, plural(r.triangles, one, several)) +
         line(fmt::format("taken from the input's {} at the same place", one), r.of_triangles);
}

}  // namespace

void add_point_data(Command& command, std::vector<std::string>& words) {
  const auto take = [&words](const std::string& text) {
    words.push_back(text);
    if (const auto rules = io::parse_data_rules(words); !rules) throw BadValue(rules.error().message);
  };
  const std::string sentence =
      "Rule for floating point data of points when vertices move. 'interpolate' suits data of a place, such as depths: "
      "it is linear on the triangles of IN. With 'keep', data move with their point. RULE=NAME applies to one array, "
      "and may be repeated. Integers stay with their points, and data of triangles stay at their place.";
  command
      .add({.names = "--point-data",
            .value_name = "RULE[=NAME]",
            .sentence = sentence,
            .take = take,
            .values = Values::repeated})
      .default_text = "interpolate";
}

io::DataRules data_rules(const std::vector<std::string>& words, const std::string& path,
                         const std::vector<io::DataArray>& point_data) {
  const Expected<io::DataRules> rules = io::parse_data_rules(words);
  if (!rules) throw as_failure(rules.error());
  if (const auto checked = io::check_data_rules(*rules, point_data); !checked) {
    throw Failure(Exit::bad_usage, fmt::format("{}: --point-data: {}", path, checked.error().message));
  }
  return *rules;
}

std::string data_text(const io::DataReport& report, std::string_view one, std::string_view several) {
  return points_text(report, several) + cells_text(report, one, several);
}

}  // namespace temper::app
