#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

#include "console.hpp"
#include "exit.hpp"
#include "files/input.hpp"
#include "reports/quality_report.hpp"
#include "reports/reports.hpp"

namespace temper::app {
namespace {

const io::DataArray& find_data(const Input& input, const std::string& name) {
  std::string others;
  for (const io::DataArray& array : input.file.point_data) {
    if (array.name == name && array.components == 1) return array;
    others += (others.empty() ? "" : ", ") + array.name;
    if (array.components != 1) others += fmt::format(" ({} components)", array.components);
  }
  throw Failure(
      Exit::bad_input,
      fmt::format("{}: there is no point data \"{}\" of one component to take sizes from; expected one of: {}",
                  input.path, name, others.empty() ? "none in this file" : others));
}

/// The numbers at the mesh's vertices: points of no triangle are not part of the field.
std::vector<double> at_vertices(const Input& input, const io::DataArray& array) {
  return std::visit(
      [&input](const auto& values) {
        std::vector<double> sizes;
        for (const VertexId v : input.mesh().vertices()) {
          const std::size_t point = input.points.empty() ? v.index : input.points[v.index];
          sizes.push_back(static_cast<double>(values[point]));
        }
        return sizes;
      },
      array.values);
}

}  // namespace

ReadSizeField read_size_field(const std::string& path, const std::string& data, const ReadingOptions& options) {
  const Input input = read_input(path, options);
  const std::vector<double> sizes = at_vertices(input, find_data(input, data));
  const auto field = SizeField::from_values(input.mesh(), sizes, input.names.get());
  if (!field) {
    const bool names_file = !field.error().where.empty();
    throw Failure(Exit::bad_input, names_file ? field.error().what() : path + ": " + field.error().message);
  }
  return {*field, input.warnings()};
}

std::optional<SizeField> depth_field(const Input& input) {
  constexpr std::string_view kDepth = "depth";
  constexpr double kLeast = 1;  // on dry land waves need a speed, too
  const auto is_depth = [&](const io::DataArray& array) { return array.name == kDepth && array.components == 1; };
  const auto found = std::ranges::find_if(input.file.point_data, is_depth);
  if (found == input.file.point_data.end()) return std::nullopt;
  std::vector<double> depths = at_vertices(input, *found);
  for (double& depth : depths) depth = std::isfinite(depth) ? std::max(depth, kLeast) : kLeast;
  return *SizeField::from_values(input.mesh(), depths, input.names.get());
}

std::string size_text(const SizeChange& size) {
  const auto row = [&size](const char* label, double (*of)(const SizeReport&)) {
    return pad_right(label, kLabelColumns) + pad_left(fmt::format("{:.6g}", of(size.before)), kNumberColumns) +
           pad_left(fmt::format("{:.6g}", of(size.after)), kNumberColumns) + "\n";
  };
  return row("size over field, least", [](const SizeReport& r) { return r.over_field.min; }) +
         row("size over field, median", [](const SizeReport& r) { return r.over_field.median; }) +
         row("size over field, greatest", [](const SizeReport& r) { return r.over_field.max; }) +
         row("gradation, 95 %", [](const SizeReport& r) { return r.gradation.p95; }) +
         row("gradation, greatest", [](const SizeReport& r) { return r.gradation.max; });
}

}  // namespace temper::app
