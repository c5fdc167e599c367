// The arrays of a mesh in a file of the VTK family (VTU and legacy): triangles first, then lines, then marked points,
// so that cell i is triangle i. Cell data `region` is the region of a triangle, the tag of a line, the tag of a point.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "io/containers/vtk_array.hpp"
#include "io/formats/format.hpp"

namespace temper::io {

/// The values as text, a tuple a line.
void put_ascii(Output& out, const VtkArray& array);
/// The bytes of the values, of the greatest weight first.
void put_big_endian(Output& out, const VtkArray& array);

[[nodiscard]] inline std::size_t n_vtk_cells(const MeshFile& f) {
  return f.triangles.size() + f.lines.size() + f.marked_points.size();
}
[[nodiscard]] VtkArray vtk_points(const MeshFile& f);
[[nodiscard]] VtkArray vtk_connectivity(const MeshFile& f);
/// The index after the last point of cell i, of so many triangles, lines after them, and then points.
[[nodiscard]] inline std::size_t vtk_cell_end(std::size_t i, std::size_t triangles, std::size_t lines) {
  const std::size_t t = std::min(i + 1, triangles), l = std::min(i + 1 - t, lines);
  return 3 * t + 2 * l + (i + 1 - t - l);
}
/// Those of all cells: in 32 bits, and in 64 where the last one does not fit.
[[nodiscard]] VtkArray vtk_cell_ends(std::size_t triangles, std::size_t lines, std::size_t points);
[[nodiscard]] VtkArray vtk_cell_types(const MeshFile& f);
[[nodiscard]] std::vector<VtkArray> vtk_point_data(const WriteJob& job);
[[nodiscard]] std::vector<VtkArray> vtk_cell_data(const WriteJob& job);
[[nodiscard]] std::vector<VtkArray> vtk_field_data(const MeshFile& f);

}  // namespace temper::io
