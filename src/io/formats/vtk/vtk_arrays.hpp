// The arrays of a mesh in a file of the VTK family (VTU and legacy). Tetrahedra come first, then triangles,
// quadrilaterals, lines and marked points, so that cell i is triangle i, or tetrahedron i. Cell data `region` is the
// region of a tetrahedron or triangle, the tag of a face, the tag of a line, the tag of a point.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/containers/vtk_array.hpp"
#include "io/formats/format.hpp"

namespace temper::io {

/// The values as text, one tuple per line.
void put_ascii(Output& out, const VtkArray& array);
/// The bytes of the values, most significant first.
void put_big_endian(Output& out, const VtkArray& array);

/// The numbers of cells of each kind, in their order.
struct VtkCells {
  std::size_t tetrahedra = 0, triangles = 0, quadrilaterals = 0, lines = 0, points = 0;
  explicit VtkCells(const WriteJob& job)
      : tetrahedra(job.file.tetrahedra.size()),
        triangles(job.n_triangles()),
        quadrilaterals(job.fourth_corners.size()),
        lines(job.file.lines.size()),
        points(job.file.marked_points.size()) {}
  VtkCells(std::size_t n3, std::size_t n4, std::size_t n2, std::size_t n1)
      : triangles(n3), quadrilaterals(n4), lines(n2), points(n1) {}

  [[nodiscard]] std::size_t size() const { return tetrahedra + triangles + quadrilaterals + lines + points; }
  /// The number of points of the first n cells.
  [[nodiscard]] std::size_t points_of_first(std::size_t n) const {
    const std::size_t s = std::min(n, tetrahedra), t = std::min(n - s, triangles),
                      q = std::min(n - s - t, quadrilaterals), l = std::min(n - s - t - q, lines);
    return 4 * s + 3 * t + 4 * q + 2 * l + (n - s - t - q - l);
  }
};
[[nodiscard]] VtkArray vtk_points(const WriteJob& job);
[[nodiscard]] VtkArray vtk_connectivity(const WriteJob& job);
/// The ends of all cells: in 32 bits, or in 64 if the last one does not fit.
[[nodiscard]] VtkArray vtk_cell_ends(const VtkCells& cells);
[[nodiscard]] VtkArray vtk_cell_types(const WriteJob& job);
[[nodiscard]] std::vector<VtkArray> vtk_point_data(const WriteJob& job);
[[nodiscard]] std::vector<VtkArray> vtk_cell_data(const WriteJob& job);
[[nodiscard]] std::vector<VtkArray> vtk_field_data(const MeshFile& f);

// Measures of well-centeredness for each triangle or tetrahedron, as cell data of VTU and VTKHDF. Each writing computes
// them again; they are no part of the file that was read.

/// One of the arrays: its name is the one in TriangleQuality or TetrahedronQuality, its numbers are floats. They are
/// enough for colors and take half of the room of doubles.
struct QualityArray {
  std::string_view name;
  Scalar scalar;
};
inline constexpr std::array<QualityArray, 4> kTriangleQuality = {{
    {"well_centered", Scalar::u8},
    {"min_h_over_l", Scalar::f32},
    {"min_d_over_l", Scalar::f32},
    {"min_angle_deg", Scalar::f32},
}};
inline constexpr std::array<QualityArray, 3> kTetrahedronQuality = {{
    {"well_centered", Scalar::u8},
    {"min_h_over_l", Scalar::f32},
    {"min_dihedral_deg", Scalar::f32},
}};

struct TypeOfArray {
  Scalar scalar;
  int components;
};
/// The arrays of triangles or of tetrahedra that cell data of these types contain; empty: neither. The function returns
/// nothing for an array that is not there. All of them must be there: a single one of these names is the user's own.
[[nodiscard]] std::span<const QualityArray> quality_among(
    const std::function<std::optional<TypeOfArray>(std::string_view name)>& type_of);

/// The arrays of a mesh; zeros for cells that are tags. None without triangles and tetrahedra, with quadrilaterals, or
/// when points are degrees and lengths therefore unknown. None either when data of the file have one of the names,
/// which a warning says.
[[nodiscard]] std::vector<VtkArray> vtk_quality(const WriteJob& job);

}  // namespace temper::io
