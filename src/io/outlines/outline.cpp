// Outlines: the content decides the format.
#include <algorithm>
#include <utility>

#include "io/outlines/outline_input.hpp"
#include "io/text/failure.hpp"
#include "io/text/scanner.hpp"

namespace temper::io {
namespace {

std::string numbered(std::string_view kind, const RunLength& numbers, std::size_t i) {
  return text(kind, numbers[static_cast<std::int64_t>(i)]);
}

using OutlineReader = OutlineDocument (*)(Source&);

OutlineReader reader_of(const std::string& path, std::string_view head) {
  if (sniff_geojson(head)) return read_geojson;
  if (sniff_gis(head)) return read_gis;
  if (sniff_jigsaw(head)) return read_jigsaw;
  if (sniff_poly(head)) return read_poly;
  fail(ErrorCode::unsupported, path,
       "is no outline that temper reads: expected a .poly file of Triangle, a geometry of JIGSAW (MSHID=…), GeoJSON, a "
       "shapefile or a GeoPackage");
}

}  // namespace

std::string OutlineFileNames::point(std::size_t i) const {
  const auto named = point_names.find(static_cast<std::int32_t>(i));
  return named != point_names.end() ? named->second : numbered("point ", points, i);
}
std::string OutlineFileNames::segment(std::size_t i) const {
  if (groups.empty()) return numbered("segment ", segments, i);
  std::size_t group = groups.size() - 1;
  while (group > 0 && groups[group].first > i) --group;
  return text("segment ", i - groups[group].first, " of ", groups[group].name);
}
std::string OutlineFileNames::hole(std::size_t i) const { return numbered("hole ", holes, i); }
std::string OutlineFileNames::region(std::size_t i) const { return numbered("region ", regions, i); }
std::string OutlineFileNames::part(std::size_t i) const { return i < parts.size() ? parts[i] : text("part ", i); }
std::string OutlineFileNames::ring(std::size_t i) const { return i < rings.size() ? rings[i] : text("ring ", i); }

std::string OutlineFileNames::point_where(std::size_t i) const {
  return at_line(point_path.empty() ? path : point_path, point_lines, i);
}
std::string OutlineFileNames::segment_where(std::size_t i) const { return at_line(path, segment_lines, i); }
std::string OutlineFileNames::hole_where(std::size_t i) const { return at_line(path, hole_lines, i); }
std::string OutlineFileNames::region_where(std::size_t i) const { return at_line(path, region_lines, i); }

Expected<OutlineFile> read_outline(const std::string& path) {
  return guarded<OutlineFile>(path, [&] {
    OutlineReader reader = nullptr;
    Source source = load(path, [&](std::string_view head, std::uint64_t) { reader = reader_of(path, head); });
    OutlineDocument document = reader(source);
    document.file.path = path;
    const Outline& o = document.file.outline;
    if (o.points.empty() || o.segments.empty()) {
      fail(ErrorCode::empty_input, path, "has no ", o.points.empty() ? "points" : "segments");
    }
    document.file.outline.names = std::move(document.names);
    return std::move(document.file);
  });
}

}  // namespace temper::io
