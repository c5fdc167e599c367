// The file that all readers of outlines fill, and the names of its elements.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "io/disk/files.hpp"
#include "io/outlines/json_tree.hpp"
#include "io/text/file_names.hpp"
#include "temper/io.hpp"

namespace temper::io {

/// Elements in the numbers of their file, on their lines. Segments may be numbered from 1 in each group ("ring 1 of
/// feature 2"): GeoJSON has no numbers of its own.
class OutlineFileNames final : public OutlineNames {
 public:
  struct Group {
    std::string name;       ///< what follows the number of a segment
    std::size_t first = 0;  ///< segment
  };
  explicit OutlineFileNames(std::string of) : path(std::move(of)) {}

  [[nodiscard]] std::string point(std::size_t i) const override;
  [[nodiscard]] std::string segment(std::size_t i) const override;
  [[nodiscard]] std::string hole(std::size_t i) const override;
  [[nodiscard]] std::string region(std::size_t i) const override;
  [[nodiscard]] std::string part(std::size_t i) const override;
  [[nodiscard]] std::string ring(std::size_t i) const override;
  [[nodiscard]] std::string point_where(std::size_t i) const override;
  [[nodiscard]] std::string segment_where(std::size_t i) const override;
  [[nodiscard]] std::string hole_where(std::size_t i) const override;
  [[nodiscard]] std::string region_where(std::size_t i) const override;

  std::string path;
  std::string point_path;                      ///< when points are in another file
  RunLength points, segments, holes, regions;  ///< numbers in the file; empty: counted from 0
  RunLength point_lines, segment_lines, hole_lines, region_lines;
  std::vector<Group> groups;
  std::vector<std::string> parts, rings;            ///< names
  std::map<std::int32_t, std::string> point_names;  ///< of points of their own
};

struct OutlineDocument {
  OutlineFile file;
  std::shared_ptr<OutlineFileNames> names;
};

bool sniff_geojson(std::string_view head);
/// Shapefiles and GeoPackages.
bool sniff_gis(std::string_view head);
bool sniff_jigsaw(std::string_view head);
bool sniff_poly(std::string_view head);

OutlineDocument read_geojson(Source& source);
OutlineDocument read_gis(Source& source);
OutlineDocument read_jigsaw(Source& source);
OutlineDocument read_poly(Source& source);

/// The outline of a FeatureCollection of GeoJSON from a file of any format. If the file has no lines, they are all 0;
/// then the `string` of a feature is its name in messages.
OutlineDocument read_features(const std::string& path, std::string_view format, JsonValue root);

}  // namespace temper::io
