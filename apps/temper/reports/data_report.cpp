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
  const std::size_t arrays = r.interpolated.size() + r.kept.size() + r.conserved.size() + r.dropped.size();
  if (r.points_moved + r.points_inserted == 0 || arrays == 0) return {};
  std::string text = fmt::format("point data: {} of {} moved", r.points_moved, plural(r.points, "point", "points"));
  if (r.points_moved > 0)
    text += fmt::format(", by {:.3g} in the median and {:.3g} at most", r.distance.median, r.distance.max);
  if (r.points_inserted > 0) text += fmt::format("; {} new", plural(r.points_inserted, "point is", "points are"));
  return text + "\n" + line(fmt::format("interpolated on the {} of the input", several), r.interpolated) +
         line("kept with their points", r.kept) + line("conserved on power cells", r.conserved) +
         line("dropped", r.dropped);
}

std::string cells_text(const io::DataReport& r, std::string_view one, std::string_view several) {
  if (r.triangles_changed == 0 || r.of_triangles.size() + r.conserved_of_triangles.size() == 0) return {};
  return fmt::format("cell data: {} of {} have changed\n", r.triangles_changed, plural(r.triangles, one, several)) +
         line(fmt::format("taken from the input's {} at the same place", one), r.of_triangles) +
         line(fmt::format("conserved on {}", several), r.conserved_of_triangles);
}

std::string integrals_text(const io::DataReport& r) {
  if (r.conserved.size() + r.conserved_of_triangles.size() == 0) return {};
  std::string text = fmt::format("integrals of conserved data: changed by {:.2g} at most\n", r.integral_change);
  if (r.out_of_range > 0) text += fmt::format("  beyond the range of the input's values by {:.2g}\n", r.out_of_range);
  return text;
}

}  // namespace

void add_data_rules(Command& command, DataWords& words) {
  const auto option = [&command](std::vector<std::string>& target, io::DataOf of, const char* name,
                                 const std::string& usual, const std::string& sentence) {
    const auto take = [&target, of](const std::string& text) {
      target.push_back(text);
      if (const auto rules = io::parse_data_rules(target, of); !rules) throw BadValue(rules.error().message);
    };
    Option& added = command.add(
        {.names = name, .value_name = "RULE[=NAME]", .sentence = sentence, .take = take, .values = Values::repeated});
    added.default_text = usual;
    added.cells_of = [](std::string_view rule) {
      return rule.starts_with("conserve") ? CellKinds::both : CellKinds::all;
    };
  };
  option(
      words.of_points, io::DataOf::points, "--point-data", "interpolate",
      "Rule for floating point data of points when vertices move. 'interpolate' suits data of a place, such as "
      "depths: it is linear on the cells of IN. With 'keep', data move with their point. 'conserve' suits means over "
      "power cells, such as concentrations: integrals over the domain and each region stay. RULE=NAME applies to one "
      "array, and may be repeated. Integers stay with their points.");
  option(words.of_cells, io::DataOf::cells, "--cell-data", "sample",
         "Rule for floating point data of cells when the mesh changes. With 'sample', a cell has the data of IN at its "
         "middle. With 'conserve', it has their mean, and integrals over the domain and each region stay. RULE=NAME "
         "applies to one array, and may be repeated. Integers are sampled.");
}

io::UpdateOptions data_rules(const DataWords& words, const std::string& path,
                             const std::vector<io::DataArray>& point_data,
                             const std::vector<io::DataArray>& cell_data) {
  const auto rules_of = [&](const std::vector<std::string>& texts, io::DataOf of, const char* name,
                            const std::vector<io::DataArray>& arrays) {
    const Expected<io::DataRules> rules = io::parse_data_rules(texts, of);
    if (!rules) throw as_failure(rules.error());
    if (const auto checked = io::check_data_rules(*rules, arrays, of); !checked)
      throw Failure(Exit::bad_usage, fmt::format("{}: {}: {}", path, name, checked.error().message));
    return *rules;
  };
  io::UpdateOptions options;
  options.rules = rules_of(words.of_points, io::DataOf::points, "--point-data", point_data);
  options.cell_rules = rules_of(words.of_cells, io::DataOf::cells, "--cell-data", cell_data);
  return options;
}

std::string data_text(const io::DataReport& report, std::string_view one, std::string_view several) {
  return points_text(report, several) + cells_text(report, one, several) + integrals_text(report);
}

}  // namespace temper::app
