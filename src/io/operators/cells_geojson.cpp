// Polygons of cells as GeoJSON (RFC 7946), one feature per line. Degrees are longitude and latitude of WGS 84. In a
// plane the collection has a member "crs", as in the first edition of GeoJSON. Its name is an undefined Cartesian
// system: GDAL takes positions for degrees if it is null.
#include "io/operators/cell_files.hpp"

namespace temper::io {
namespace {

constexpr std::string_view kUndefinedSystem =
    R"("crs":{"type":"name","properties":{"name":"LOCAL_CS[\"Undefined Cartesian SRS\",UNIT[\"metre\",1]]"}},)";

/// In quotes, with the escapes of JSON. Names have no control characters.
std::string json_text(std::string_view value) {
  std::string quoted = "\"";
  for (const char c : value) quoted += c == '"' || c == '\\' ? std::string{'\\', c} : std::string(1, c);
  return quoted + '"';
}

void put_property(Output& out, const CellColumn& column, std::size_t cell) {
  out.put('"', column.name, "\":");
  if (const auto* const integers = std::get_if<CellColumn::Integers>(&column.of)) out.put((*integers)(cell));
  if (const auto* const reals = std::get_if<CellColumn::Reals>(&column.of)) out.put((*reals)(cell));
  if (const auto* const texts = std::get_if<CellColumn::Texts>(&column.of)) {
    const std::string_view value = (*texts)(cell);
    out.put(value.empty() ? std::string("null") : json_text(value));
  }
  out.put(',');
}

void put_ring(Output& out, const Ring& ring) {
  out.put("[[");
  for (std::size_t i = 0; i < ring.size(); ++i) out.put(i == 0 ? "[" : ",[", ring[i].x, ',', ring[i].y, ']');
  out.put("]]");
}

}  // namespace

void write_cells_geojson(const CellJob& job) {
  const FlatPlaces places = flat_places(job);
  const std::vector<CellColumn> columns = job.columns();
  Output& out = job.outputs.open(job.path);
  out.put("{\"type\":\"FeatureCollection\",", places.in_degrees ? std::string_view() : kUndefinedSystem,
          "\"features\":[");
  bool is_first = true;
  for_each_cell_of(job.cells, [&](std::size_t cell, std::size_t begin, std::size_t end) {
    std::vector<Ring> rings;
    for (std::size_t p = begin; p < end; ++p) {
      for (Ring& ring : rings_of(job, places, p)) rings.push_back(std::move(ring));
    }
    out.put(is_first ? "\n" : ",\n", "{\"type\":\"Feature\",\"id\":", cell, ",\"properties\":{");
    is_first = false;
    for (const CellColumn& column : columns) put_property(out, column, cell);
    out.put("\"center_x\":", places.centers[cell].x, ",\"center_y\":", places.centers[cell].y, "},\"geometry\":");
    const bool several = rings.size() != 1;
    out.put("{\"type\":", several ? "\"MultiPolygon\",\"coordinates\":[" : "\"Polygon\",\"coordinates\":");
    for (std::size_t i = 0; i < rings.size(); ++i) {
      if (i > 0) out.put(',');
      put_ring(out, rings[i]);
    }
    out.put(several ? "]}}" : "}}");
  });
  out.put("\n]}\n");
}

}  // namespace temper::io
