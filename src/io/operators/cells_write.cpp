// Polygons of cells as files: makes the cells of a mesh file, and calls the writer of the format.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "io/conversion/globe.hpp"
#include "io/operators/cell_files.hpp"
#include "io/text/names.hpp"
#include "io/text/scanner.hpp"
#include "temper/detail/suggest.hpp"

namespace temper::io {

namespace {

constexpr double kWholeTurn = 360, kHalfTurn = 180, kPoleLatitude = 90;  // degrees

std::vector<std::string> path_alone(const std::string& path) { return {path}; }

struct CellFormatRow {
  std::string_view name, description, suffixes;  ///< as in CellFormat
  void (*write)(const CellJob& job);
  std::vector<std::string> (*files)(const std::string& path) = path_alone;
};
constexpr CellFormatRow kCellRows[] = {
    {"geojson", "GeoJSON", ".geojson .json", write_cells_geojson},
    {"gpkg", "GeoPackage", ".gpkg", write_cells_geopackage},
    {"vtu", "VTK XML unstructured grid", ".vtu", write_cells_vtu},
    {"ugrid", "UGRID (NetCDF)", ".ugrid.nc .nc", write_cells_ugrid, netcdf_files},
};

const auto kCellFormats = [] {
  std::array<CellFormat, std::size(kCellRows)> formats;
  for (std::size_t i = 0; i < formats.size(); ++i)
    formats[i] = {kCellRows[i].name, kCellRows[i].description, kCellRows[i].suffixes};
  return formats;
}();

std::vector<std::string_view> column_of_formats(std::string_view CellFormat::*column) {
  std::vector<std::string_view> all;
  all.reserve(kCellFormats.size());
  for (const CellFormat& format : kCellFormats) all.push_back(format.*column);
  return all;
}

/// The row with a suffix that the path ends with, or null.
const CellFormatRow* row_by_suffix(const std::string& path) {
  const auto* const row = std::ranges::find_if(
      kCellRows, [&](const CellFormatRow& each) { return suffix_length(each.suffixes, path, true) > 0; });
  return row == std::end(kCellRows) ? nullptr : row;
}

const CellFormatRow& cell_row(const std::string& path, const std::string& format) {
  if (format.empty()) {
    if (const CellFormatRow* const row = row_by_suffix(path)) return *row;
    fail(ErrorCode::invalid_option, path, "the suffix names no format for polygons of cells; expected one of ",
         join(column_of_formats(&CellFormat::suffixes), " "), ", or a format");
  }
  const auto* const row = std::ranges::find(kCellRows, format, &CellFormatRow::name);
  if (row != std::end(kCellRows)) return *row;
  const std::vector<std::string_view> names = column_of_formats(&CellFormat::name);
  fail(ErrorCode::invalid_option, path, "polygons of cells cannot be written as '", format, "'; expected one of ",
       join(names), did_you_mean(format, names));
}

/// Gives vertices the tags and names of the points that have a name. The names of a vertex are joined.
void name_vertices(CellJob& job) {
  job.tags.assign(job.mesh.n_vertices(), 0);
  job.names.resize(job.mesh.n_vertices());
  for (std::size_t i = 0; i < job.file.marked_points.size(); ++i) {
    for (const PhysicalName& n : job.file.names) {
      if (n.dimension != 0 || n.tag != job.file.marked_points.tags[i]) continue;
      const auto v = static_cast<std::size_t>(job.file.marked_points[i]);
      if (job.tags[v] == 0) job.tags[v] = n.tag;
      job.names[v] += text(job.names[v].empty() ? "" : "; ", n.name);
    }
  }
}

std::vector<std::string> write_cells_or_throw(const std::string& path, const MeshFile& original,
                                              const WriteOptions& options) {
  const CellFormatRow& row = cell_row(path, options.format);
  if (original.dimension() == 3)
    fail(ErrorCode::unsupported, path, "polygons of cells are for triangles, but the mesh has tetrahedra");
  MeshFile file = original;
  file.warnings.clear();
  file.triangles.data.clear();
  std::erase_if(file.point_data, [](const DataArray& a) { return a.name != kLongitude && a.name != kLatitude; });
  auto made = make_mesh(file, {}, options.executor);
  if (!made) fail(made.error().code, path, "cells need a valid mesh: ", made.error().what());
  update(file, *made, made->mesh);  // the points are the vertices from here on
  const CellPolygons cells = cell_polygons(made->mesh, dec_operators(made->mesh), *options.cells);
  OutputSet outputs;
  CellJob job = {path, file, made->mesh, cells, options, outputs, {}, {}};
  if (cells.of == CellsOf::vertices) name_vertices(job);
  row.write(job);
  outputs.commit();
  return made->warnings;
}

/// The part of a ring on one side of a meridian.
Ring clipped_at(const Ring& ring, double longitude, bool east) {
  Ring part;
  const auto is_in = [&](Vec2 p) { return east ? p.x >= longitude : p.x <= longitude; };
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
    if (is_in(a)) part.push_back(a);
    if (is_in(a) == is_in(b) || a.x == longitude || b.x == longitude) continue;
    part.push_back({longitude, a.y + (longitude - a.x) / (b.x - a.x) * (b.y - a.y)});
  }
  return part;
}

/// A ring with longitudes that do not jump by 360°. Around a pole it goes around twice and comes back along the edge of
/// the map, so that it covers a whole sheet from −180° to 180°.
struct UnrolledRing {
  Ring ring;
  bool around_pole = false;
};
UnrolledRing unrolled(const Ring& ring) {
  UnrolledRing result;
  double last = ring.front().x;
  const auto next = [&last](double longitude) {
    return last = longitude + kWholeTurn * std::round((last - longitude) / kWholeTurn);
  };
  for (const Vec2 p : ring) result.ring.push_back({next(p.x), p.y});
  const Ring once = result.ring;
  const Vec2 first = once.front();
  const double turn = next(first.x) - first.x;
  if (turn == 0) return result;
  for (const Vec2 p : once) result.ring.push_back({p.x + turn, p.y});
  const double end = first.x + 2 * turn, pole = turn > 0 ? kPoleLatitude : -kPoleLatitude;
  result.ring.insert(result.ring.end(), {{end, first.y}, {end, pole}, {first.x, pole}});
  result.around_pole = true;
  return result;
}

/// The parts of a ring in degrees that are between −180 and 180.
std::vector<Ring> on_map(const Ring& ring) {
  const UnrolledRing whole = unrolled(ring);
  const auto [least, most] = std::ranges::minmax(whole.ring, {}, &Vec2::x);
  std::vector<Ring> parts;
  const double first = std::floor((least.x + kHalfTurn) / kWholeTurn);
  for (double k = first; k == first || kWholeTurn * k - kHalfTurn < most.x; ++k) {
    const double west = kWholeTurn * k - kHalfTurn, east = kWholeTurn * k + kHalfTurn;
    if (whole.around_pole && (west < least.x || !parts.empty())) continue;  // one whole sheet
    Ring part = clipped_at(clipped_at(whole.ring, west, true), east, false);
    for (Vec2& p : part) p.x -= kWholeTurn * k;
    if (part.size() > 2) parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace

std::vector<CellColumn> CellJob::columns() const {
  const bool power = cells.of == CellsOf::vertices;
  const auto has_name_of = [&](int dimension) {
    return std::ranges::any_of(file.names, [&](const PhysicalName& n) { return n.dimension == dimension; });
  };
  std::vector<CellColumn> all = {
      {power ? "vertex" : "triangle", power ? "number of the vertex, from 0" : "number of the triangle, from 0",
       CellColumn::Integers([](std::size_t cell) { return static_cast<std::int64_t>(cell); })}};
  if (power && has_name_of(0)) {
    all.push_back({"name", "name of the vertex, such as of a well",
                   CellColumn::Texts([this](std::size_t cell) -> std::string_view { return names[cell]; })});
  }
  all.push_back({"region", "region with the largest part of the cell",
                 CellColumn::Integers([this](std::size_t cell) { return cells.regions[cell]; })});
  if (has_name_of(2)) {
    all.push_back({"region_name", "name of the region", CellColumn::Texts([this](std::size_t cell) -> std::string_view {
                     const auto named = std::ranges::find_if(file.names, [&](const PhysicalName& n) {
                       return n.dimension == 2 && n.tag == cells.regions[cell];
                     });
                     return named == file.names.end() ? std::string_view() : std::string_view(named->name);
                   })});
  }
  if (power) {
    all.push_back({"region_share", "part of the cell's area that is in its region",
                   CellColumn::Reals([this](std::size_t cell) { return cells.region_shares[cell]; })});
  }
  all.push_back(
      {"area", "area of the cell", CellColumn::Reals([this](std::size_t cell) { return cells.areas[cell]; })});
  return all;
}

FlatPlaces flat_places(const CellJob& job) {
  const CellPolygons& c = job.cells;
  if (job.file.sphere() != nullptr) {
    FlatPlaces places = {true, {}, {}};
    for (const Vec3 p : c.sphere_centers) places.centers.push_back(lon_lat_of(p));
    for (const Vec3 p : c.sphere_points) places.points.push_back(lon_lat_of(p));
    return places;
  }
  auto of_vertices = lon_lat_of_points(job.file);
  if (!of_vertices) return {false, c.centers, c.points};
  return {true, c.of == CellsOf::vertices ? *std::move(of_vertices) : lon_lat_of_places(job.file, job.mesh, c.centers),
          lon_lat_of_places(job.file, job.mesh, c.points)};
}

std::vector<Ring> rings_of(const CellJob& job, const FlatPlaces& places, std::size_t polygon) {
  Ring ring;
  for (const std::uint32_t corner : job.cells.polygon(polygon)) ring.push_back(places.points[corner]);
  std::vector<Ring> rings = places.in_degrees ? on_map(ring) : std::vector<Ring>{std::move(ring)};
  for (Ring& each : rings) each.push_back(each.front());
  return rings;
}

std::span<const CellFormat> cell_formats() { return kCellFormats; }

Expected<std::vector<std::string>> write_cells(const std::string& path, const MeshFile& file,
                                               const WriteOptions& options) {
  return guarded<std::vector<std::string>>(path, [&] { return write_cells_or_throw(path, file, options); });
}

std::vector<std::string> files_of_cells(const std::string& path, const std::string& format) {
  return cell_row(path, format).files(path);
}

std::string next_for_cells(const std::string& path) {
  const CellFormatRow* const row = row_by_suffix(path);
  return row == nullptr ? std::string() : text(". ", row->description, " holds polygons of cells. Next: --cells power");
}

}  // namespace temper::io
