// Polygons of cells as files: the table of their formats, the columns that all of them have, and the writers.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "io/disk/files.hpp"
#include "temper/detail/cells.hpp"
#include "temper/io.hpp"

namespace temper::io {

/// A column of the table of cells: numbers or texts, by the cell.
struct CellColumn {
  using Integers = std::function<std::int64_t(std::size_t cell)>;
  using Reals = std::function<double(std::size_t cell)>;
  using Texts = std::function<std::string_view(std::size_t cell)>;

  std::string_view name, is;
  std::variant<Integers, Reals, Texts> of;
};

/// One file of cells to be written.
struct CellJob {
  const std::string& path;
  const MeshFile& file;  ///< of the mesh: point i is vertex i
  const Mesh& mesh;
  const CellPolygons& cells;
  const WriteOptions& options;
  OutputSet& outputs;
  /// Tag and name of each vertex that is a named point, such as a well. Empty for triangles.
  std::vector<std::int32_t> tags;
  std::vector<std::string> names;

  /// The columns without the center. They refer to the job.
  [[nodiscard]] std::vector<CellColumn> columns() const;
};

/// Centers or points in two coordinates: of the plane, or longitude and latitude where the file knows them.
struct FlatPlaces {
  bool in_degrees = false;
  std::vector<Vec2> centers, points;
};
[[nodiscard]] FlatPlaces flat_places(const CellJob& job);

/// The polygons of a cell as rings that are closed, counter-clockwise, for maps. Degrees are from −180 to 180: a
/// polygon across ±180 becomes two, and one around a pole includes the edge of the map there.
using Ring = std::vector<Vec2>;
[[nodiscard]] std::vector<Ring> rings_of(const CellJob& job, const FlatPlaces& places, std::size_t polygon);

/// Visits the cells that have polygons: visit(cell, first polygon, end of its polygons).
template <class Visit>
void for_each_cell_of(const CellPolygons& cells, const Visit& visit) {
  for (std::size_t p = 0, end = 0; p < cells.n_polygons(); p = end) {
    while (end < cells.n_polygons() && cells.cells[end] == cells.cells[p]) ++end;
    visit(cells.cells[p], p, end);
  }
}

void write_cells_geojson(const CellJob& job);
void write_cells_geopackage(const CellJob& job);
void write_cells_vtu(const CellJob& job);
void write_cells_ugrid(const CellJob& job);
/// Defined with the formats in NetCDF: the path, or the reason why it cannot be written.
std::vector<std::string> netcdf_files(const std::string& path);

/// write() and files_to_write() for cells.
[[nodiscard]] Expected<std::vector<std::string>> write_cells(const std::string& path, const MeshFile& file,
                                                             const WriteOptions& options);
[[nodiscard]] std::vector<std::string> files_of_cells(const std::string& path, const std::string& format);
/// ". Next: --cells power …" if the path ends as a file of cells; else empty.
[[nodiscard]] std::string next_for_cells(const std::string& path);

}  // namespace temper::io
