// Warnings of losses: they name what a mesh file has and the format written has no place for, for all formats alike.
#include <algorithm>

#include "io/formats/format.hpp"
#include "io/text/names.hpp"

namespace temper::io {
namespace {

struct KindOfArrays {
  Content content;
  std::string_view name;
  ArraysOf of;
};
constexpr KindOfArrays kKindsOfArrays[] = {{kPointData, "point data", &MeshFile::point_data},
                                           {kCellData, "cell data", &MeshFile::cell_data},
                                           {kLineData, "line data", &MeshFile::line_data},
                                           {kMarkedPointData, "data of marked points", &MeshFile::marked_point_data},
                                           {kFieldData, "field data", &MeshFile::field_data}};

std::string has_no_place_for(const WriteJob& job, std::string_view what) {
  return text(" not written, ", job.row.description, " has no place for ", what);
}

}  // namespace

std::string WriteJob::written(std::string_view name) const {
  if (row.details.name_ends.empty() || name.find_first_of(row.details.name_ends) == std::string_view::npos)
    return std::string(name);
  std::string result;
  for (const char c : name) {
    if (row.details.name_ends.find(c) == std::string_view::npos) {
      result += c;
    } else {
      append_percent(result, c);
    }
  }
  warn(text("the name '", name, "' is written as '", result, "': in ", row.description, " it would end early"));
  return result;
}

void warn_of_losses(const WriteJob& job) {
  const MeshFile& f = job.file;
  const FormatRow& row = job.row;
  const auto lost = [&row](Content content) { return (row.holds & content) == 0; };
  if (lost(kZ) && f.sphere() == nullptr && !is_flat(f))
    job.warn(text("z = ", f.z(), " of the points is", has_no_place_for(job, "it")));
  const bool has_regions = std::any_of(f.regions.begin(), f.regions.end(), [](std::int32_t r) { return r != 0; });
  if (lost(kRegions) && has_regions) job.warn(text("regions are", has_no_place_for(job, "them")));
  if (lost(kLines) && !f.lines.empty()) job.warn(text("lines are", has_no_place_for(job, "them")));
  if (lost(kMarkedPoints) && !f.marked_points.empty())
    job.warn(text("marked points are", has_no_place_for(job, "them")));
  for (const auto& [content, name, of] : kKindsOfArrays) {
    if (!lost(content)) continue;
    std::vector<std::string_view> names;
    for (const DataArray& a : f.*of) {
      if (row.details.keeps == nullptr || !row.details.keeps(of, a)) names.push_back(a.name);
    }
    warn_of_arrays(job, name, names);
  }
  if (lost(kNames)) warn_of_names(job, f.names);
}

void warn_of_arrays(const WriteJob& job, std::string_view kind, const std::vector<std::string_view>& names) {
  if (!names.empty()) job.warn(text(kind, " is", has_no_place_for(job, "it: "), list_of(names)));
}

void warn_of_names(const WriteJob& job, const std::vector<PhysicalName>& lost) {
  if (lost.empty()) return;
  std::vector<std::string_view> names;
  names.reserve(lost.size());
  for (const PhysicalName& n : lost) names.push_back(n.name);
  job.warn(text("physical names are", has_no_place_for(job, "them: "), list_of(names)));
}

std::vector<std::int32_t> one_tag_a_point(const WriteJob& job) {
  const MeshFile& f = job.file;
  std::vector<std::int32_t> tags(f.points.size());
  std::size_t lost = 0;
  for (std::size_t i = 0; i < f.marked_points.size(); ++i) {
    std::int32_t& tag = tags[static_cast<std::size_t>(f.marked_points[i])];
    if (tag == 0)
      tag = f.point_tags[i];
    else
      ++lost;
  }
  if (lost > 0) {
    job.warn(text(lost, " further tags of points that have one already are not written: ", job.row.description,
                  " holds one a point"));
  }
  return tags;
}

}  // namespace temper::io
