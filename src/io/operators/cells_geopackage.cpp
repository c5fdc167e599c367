// Polygons of cells as a GeoPackage (OGC 12-128r15), the table `cells`. Degrees are in WGS 84. A plane is an undefined
// Cartesian system, which users replace by their own.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <utility>

#include "io/containers/sqlite_writer.hpp"
#include "io/operators/cell_files.hpp"

namespace temper::io {
namespace {

constexpr std::uint32_t kGeoPackage = 0x47504b47, kVersion12 = 10200;  // "GPKG"
constexpr std::int64_t kWgs84 = 4326, kUndefinedCartesian = -1;
constexpr std::string_view
    kCellsTable = "cells",
    kWgs84Text =
        "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563,AUTHORITY[\"EPSG\",\"7030\"]],"
        "AUTHORITY[\"EPSG\",\"6326\"]],PRIMEM[\"Greenwich\",0,AUTHORITY[\"EPSG\",\"8901\"]],UNIT[\"degree\","
        "0.0174532925199433,AUTHORITY[\"EPSG\",\"9122\"]],AUTHORITY[\"EPSG\",\"4326\"]]";
// The tables that the standard prescribes.
constexpr std::string_view kSystemsSql =
    "CREATE TABLE gpkg_spatial_ref_sys (srs_name TEXT NOT NULL, srs_id INTEGER NOT NULL PRIMARY KEY, organization TEXT "
    "NOT NULL, organization_coordsys_id INTEGER NOT NULL, definition TEXT NOT NULL, description TEXT)";
constexpr std::string_view kContentsSql =
    "CREATE TABLE gpkg_contents (table_name TEXT NOT NULL PRIMARY KEY, data_type TEXT NOT NULL, identifier TEXT "
    "UNIQUE, "
    "description TEXT DEFAULT '', last_change DATETIME NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ','now')), min_x "
    "DOUBLE, min_y DOUBLE, max_x DOUBLE, max_y DOUBLE, srs_id INTEGER, CONSTRAINT fk_gc_r_srs_id FOREIGN KEY (srs_id) "
    "REFERENCES gpkg_spatial_ref_sys(srs_id))";
constexpr std::string_view kColumnsSql =
    "CREATE TABLE gpkg_geometry_columns (table_name TEXT NOT NULL, column_name TEXT NOT NULL, geometry_type_name TEXT "
    "NOT NULL, srs_id INTEGER NOT NULL, z TINYINT NOT NULL, m TINYINT NOT NULL, CONSTRAINT pk_geom_cols PRIMARY KEY "
    "(table_name, column_name), CONSTRAINT uk_gc_table_name UNIQUE (table_name), CONSTRAINT fk_gc_tn FOREIGN KEY "
    "(table_name) REFERENCES gpkg_contents(table_name), CONSTRAINT fk_gc_srs FOREIGN KEY (srs_id) REFERENCES "
    "gpkg_spatial_ref_sys (srs_id))";

struct Extent {
  Vec2 low = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 high = {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  void add(Vec2 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
};

/// Numbers of a geometry, the least significant byte first.
class GeometryBytes {
 public:
  void word(std::uint64_t value, int n = 4) {
    for (int i = 0; i < n; ++i) bytes_ += static_cast<char>((value >> (8 * i)) & 0xff);
  }
  void real(double value) { word(std::bit_cast<std::uint64_t>(value), 8); }
  void polygon(const Ring& ring) {
    constexpr std::uint32_t kPolygon = 3;
    word(1, 1);
    word(kPolygon);
    word(1);
    word(ring.size());
    for (const Vec2 p : ring) real(p.x), real(p.y);
  }
  [[nodiscard]] SqliteBlob take() { return {std::move(bytes_)}; }

 private:
  std::string bytes_;
};

/// The header of GeoPackage with the extent, then a MultiPolygon.
SqliteBlob geometry_of(const std::vector<Ring>& rings, std::int64_t system) {
  constexpr std::uint32_t kMultiPolygon = 6;
  constexpr int kFlags = 0b0011;  // an extent of x and y; the least significant byte first
  Extent extent;
  for (const Ring& ring : rings) {
    for (const Vec2 p : ring) extent.add(p);
  }
  GeometryBytes bytes;
  for (const int byte : {int{'G'}, int{'P'}, 0, kFlags}) bytes.word(static_cast<std::uint64_t>(byte), 1);
  bytes.word(static_cast<std::uint64_t>(system));
  for (const double value : {extent.low.x, extent.high.x, extent.low.y, extent.high.y}) bytes.real(value);
  bytes.word(1, 1);
  bytes.word(kMultiPolygon);
  bytes.word(rings.size());
  for (const Ring& ring : rings) bytes.polygon(ring);
  return bytes.take();
}

std::string cells_sql(const std::vector<CellColumn>& columns) {
  std::string sql = text("CREATE TABLE ", kCellsTable, " (fid INTEGER PRIMARY KEY NOT NULL, geom MULTIPOLYGON");
  constexpr std::string_view kSqlTypes[] = {"INTEGER", "DOUBLE", "TEXT"};
  for (const CellColumn& column : columns) sql += text(", ", column.name, " ", kSqlTypes[column.of.index()]);
  return sql + ", center_x DOUBLE, center_y DOUBLE)";
}

SqliteValue value_of(const CellColumn& column, std::size_t cell) {
  if (const auto* const integers = std::get_if<CellColumn::Integers>(&column.of)) return (*integers)(cell);
  if (const auto* const reals = std::get_if<CellColumn::Reals>(&column.of)) return (*reals)(cell);
  const std::string_view value = std::get<CellColumn::Texts>(column.of)(cell);
  if (value.empty()) return std::monostate();
  return std::string(value);
}

void write_systems(SqliteWriter& out) {
  const auto row = [](std::string name, std::string organization, std::int64_t id, std::string definition) {
    return SqliteRow{std::move(name),       std::monostate(), std::move(organization), id,
                     std::move(definition), std::monostate()};
  };
  out.begin_table("gpkg_spatial_ref_sys", std::string(kSystemsSql));
  out.add_row(-1, row("Undefined Cartesian SRS", "NONE", -1, "undefined"));
  out.add_row(0, row("Undefined geographic SRS", "NONE", 0, "undefined"));
  out.add_row(kWgs84, row("WGS 84", "EPSG", kWgs84, std::string(kWgs84Text)));
  out.end_table();
}

void write_contents(SqliteWriter& out, const Extent& extent, std::int64_t system) {
  const std::string name(kCellsTable), geometry = "geom";
  out.begin_table("gpkg_contents", std::string(kContentsSql));
  // A constant time: equal meshes make equal bytes.
  out.add_row(1, {name, std::string("features"), name, std::string(), std::string("1970-01-01T00:00:00.000Z"),
                  extent.low.x, extent.low.y, extent.high.x, extent.high.y, system});
  out.end_table();
  out.add_index_of_one_row(1, {name}, 1);
  out.add_index_of_one_row(2, {name}, 1);
  out.begin_table("gpkg_geometry_columns", std::string(kColumnsSql));
  out.add_row(1, {name, geometry, std::string("MULTIPOLYGON"), system, std::int64_t{0}, std::int64_t{0}});
  out.end_table();
  out.add_index_of_one_row(1, {name, geometry}, 1);
  out.add_index_of_one_row(2, {name}, 1);
}

}  // namespace

void write_cells_geopackage(const CellJob& job) {
  const FlatPlaces places = flat_places(job);
  const std::vector<CellColumn> columns = job.columns();
  const std::int64_t system = places.in_degrees ? kWgs84 : kUndefinedCartesian;
  SqliteWriter out;
  write_systems(out);
  Extent extent;
  out.begin_table(std::string(kCellsTable), cells_sql(columns));
  for_each_cell_of(job.cells, [&](std::size_t cell, std::size_t begin, std::size_t end) {
    std::vector<Ring> rings;
    for (std::size_t p = begin; p < end; ++p) {
      for (Ring& ring : rings_of(job, places, p)) rings.push_back(std::move(ring));
    }
    for (const Ring& ring : rings) {
      for (const Vec2 p : ring) extent.add(p);
    }
    SqliteRow row = {std::monostate(), geometry_of(rings, system)};
    for (const CellColumn& column : columns) row.push_back(value_of(column, cell));
    row.emplace_back(places.centers[cell].x);
    row.emplace_back(places.centers[cell].y);
    out.add_row(static_cast<std::int64_t>(cell) + 1, row);
  });
  out.end_table();
  write_contents(out, extent, system);
  job.outputs.open(job.path).put(out.finish(kGeoPackage, kVersion12));
}

}  // namespace temper::io
