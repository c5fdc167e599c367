#include "io/conversion/bed.hpp"

#include <algorithm>
#include <type_traits>
#include <variant>

#include "io/conversion/format_traits.hpp"
#include "io/conversion/globe.hpp"
#include "io/text/values.hpp"

namespace temper::io {
namespace {

bool has_name_of_level(std::string_view name) { return name.ends_with("_node_z") || name == kHeight; }

bool is_bed(const MeshFile& file, const DataArray& a) {
  if (a.components != 1 || !is_floating(a.values)) return false;
  const std::string said = netcdf_attribute(file, a.name, "standard_name").value_or("");
  const bool is_height = a.name == kHeight;
  if (is_height && said.empty()) return file.positive.has_value();
  return a.name == kDepth || has_name_of_level(a.name) || said == "altitude" || said == "bedrock_altitude" ||
         said.starts_with("sea_floor_");
}

bool is_level(const MeshFile& file, const DataArray& a) {
  if (file.positive) return *file.positive == Positive::up;
  const std::string positive = netcdf_attribute(file, a.name, "positive").value_or("");
  if (!positive.empty()) return positive == "up";
  const std::string said = netcdf_attribute(file, a.name, "standard_name").value_or("");
  return said.empty() ? has_name_of_level(a.name) : said.find("altitude") != std::string::npos;
}

/// The index of the bed among point data, or the number of these; `depth` comes first.
std::size_t index_of_bed(const MeshFile& file) {
  const auto& all = file.point_data;
  const auto named = std::ranges::find_if(all, [&](const auto& a) { return a.name == kDepth && is_bed(file, a); });
  const auto found =
      named != all.end() ? named : std::ranges::find_if(all, [&](const auto& a) { return is_bed(file, a); });
  return static_cast<std::size_t>(found - all.begin());
}

void negate(DataArray& a) {
  std::visit(
      [](auto& values) {
        if constexpr (std::is_floating_point_v<ElementOf<decltype(values)>>)
          std::ranges::for_each(values, [](auto& x) { x = -x; });
      },
      a.values);
}

}  // namespace

const DataArray* bed_of(const MeshFile& file) {
  const std::size_t at = index_of_bed(file);
  return at == file.point_data.size() ? nullptr : &file.point_data[at];
}

bool needs_turned_bed(Bed bed, const MeshFile& file) {
  const DataArray* const found = bed == Bed::as_it_came ? nullptr : bed_of(file);
  if (found == nullptr) return false;
  const DataArray& a = *found;
  if (bed == Bed::depth) return a.name != kDepth || is_level(file, a);
  const auto is_free = [&](std::string_view name) { return a.name == name || find(file.point_data, name) == nullptr; };
  if (bed == Bed::z) return !file.z_is_data && is_free(kHeight);
  const bool keeps_name = traits_of(file).keeps_bed_names || netcdf_attribute(file, a.name, "units");
  return (a.name == kHeight || a.name == kDepth) && !keeps_name && is_free(kBedLevel);
}

std::optional<DataArray> depths_of(const MeshFile& file) {
  const DataArray* const bed = bed_of(file);
  if (bed == nullptr || bed->components != 1) return std::nullopt;
  DataArray depths = *bed;
  if (is_level(file, *bed)) negate(depths);
  return depths;
}

void turn_bed(MeshFile& file, Bed bed) {
  DataArray& a = file.point_data[index_of_bed(file)];
  if (is_level(file, a) != (bed != Bed::depth)) negate(a);
  a.name = bed == Bed::level ? kBedLevel : bed == Bed::depth ? kDepth : kHeight;
  file.z_is_data = bed == Bed::z;
  file.positive.reset();  // its new name says it
}

}  // namespace temper::io
