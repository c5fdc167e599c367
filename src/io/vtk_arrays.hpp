// The arrays of a mesh in a file of the VTK family (VTU and legacy): triangles first, then lines, then marked points,
// so that cell i is triangle i. Cell data `region` is the region of a triangle, the tag of a line, the tag of a point.
#pragma once

#include <algorithm>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "io/format.hpp"
#include "io/values.hpp"

namespace temper::io {

/// One array to be written: `fill` puts the bytes of its values first … first + n − 1 to a buffer.
struct VtkArray {
  std::string name;
  Scalar scalar = Scalar::f64;
  int components = 1;
  std::size_t n_values = 0;
  std::function<void(std::size_t first, std::size_t n, char* to)> fill;

  [[nodiscard]] std::size_t bytes() const { return n_values * info(scalar).bytes; }
};

/// The array of value(i), of type T, for each i.
template <class T, class F>
[[nodiscard]] VtkArray computed_vtk_array(std::string name, Scalar scalar, std::size_t n_values, F value,
                                          int components = 1) {
  return {std::move(name), scalar, components, n_values, [value](std::size_t first, std::size_t n, char* to) {
            for (std::size_t i = 0; i < n; ++i) {
              const T v = value(first + i);
              std::memcpy(to + i * sizeof(T), &v, sizeof(T));
            }
          }};
}

/// Field data of VTU: the periods of a plane along x and y.
inline constexpr std::string_view kPlanePeriod = "plane_period";

inline constexpr std::size_t kVtkBlockBytes = std::size_t{1} << 18;  ///< of an array, made at a time
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
