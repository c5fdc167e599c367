// columns.vtu: each active cell as a prism over its power cell, a VTK polyhedron; over each of its polygons when these
// are several. Prisms share no points: their tops and bottoms are flat, and at another height than their neighbours'.
#include <cstdint>

#include "io/formats/cells.hpp"
#include "io/formats/vtk/vtu_document.hpp"
#include "io/operators/dec_files.hpp"

namespace temper::io {
namespace {

VtkArray long_integers(std::string name, const std::vector<std::int64_t>& values) {
  return computed_vtk_array<std::int64_t>(std::move(name), Scalar::i64, values.size(),
                                          [&values](std::size_t i) { return values[i]; });
}

/// All prisms, in the order of polygons and, below each, of layers.
struct Prisms {
  std::vector<std::size_t> cells;                        // of the columns
  std::vector<std::size_t> polygons;                     // of the power cells
  std::vector<double> points;                            // three numbers each: of a prism the bottom, then the top
  std::vector<std::int64_t> ends, faces, ends_of_faces;  // as VTK has them

  void add(const PowerCells& power_cells, std::size_t polygon, const Columns& columns, std::size_t cell);
  [[nodiscard]] std::size_t size() const { return cells.size(); }
};

void Prisms::add(const PowerCells& power_cells, std::size_t polygon, const Columns& columns, std::size_t cell) {
  const std::size_t first = power_cells.starts[polygon], n = power_cells.starts[polygon + 1] - first;
  const auto bottom = [base = static_cast<std::int64_t>(points.size() / 3), n](std::size_t i) {
    return base + static_cast<std::int64_t>(i % n);
  };
  const auto top = [bottom, n](std::size_t i) { return bottom(i) + static_cast<std::int64_t>(n); };
  for (const double z : {columns.bottoms[cell], columns.tops[cell]}) {
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 corner = power_cells.corners[first + i];
      points.insert(points.end(), {corner.x, corner.y, z});
    }
  }
  // Seen from outside, corners of faces are counter-clockwise.
  faces.push_back(static_cast<std::int64_t>(n + 2));
  faces.push_back(static_cast<std::int64_t>(n));
  for (std::size_t i = n; i-- > 0;) faces.push_back(bottom(i));
  faces.push_back(static_cast<std::int64_t>(n));
  for (std::size_t i = 0; i < n; ++i) faces.push_back(top(i));
  for (std::size_t i = 0; i < n; ++i) faces.insert(faces.end(), {4, bottom(i), bottom(i + 1), top(i + 1), top(i)});
  cells.push_back(cell);
  polygons.push_back(polygon);
  ends.push_back(static_cast<std::int64_t>(points.size() / 3));
  ends_of_faces.push_back(static_cast<std::int64_t>(faces.size()));
}

}  // namespace

void write_columns_vtu(const DecJob& job) {
  const Columns& c = *job.options.columns;
  Prisms prisms;
  for (std::size_t p = 0; p < job.cells.n_polygons(); ++p) {
    for (std::size_t layer = 0; layer < c.n_layers; ++layer) {
      const std::size_t cell = c.cell(job.cells.vertices[p], layer);
      if (c.is_active(cell)) prisms.add(job.cells, p, c, cell);
    }
  }
  const std::size_t n = prisms.size(), n_points = prisms.points.size() / 3;
  const auto thickness = [&](std::size_t i) { return c.tops[prisms.cells[i]] - c.bottoms[prisms.cells[i]]; };
  VtuDocument vtu(job.open("columns.vtu"), Encoding::base64, job.options.executor);
  vtu.begin_piece(n_points, n);
  vtu.section("Points", {computed_vtk_array<double>(
                            "Points", Scalar::f64, 3 * n_points, [&](std::size_t i) { return prisms.points[i]; }, 3)});
  vtu.section("Cells", {computed_vtk_array<std::int64_t>("connectivity", Scalar::i64, n_points,
                                                         [](std::size_t i) { return static_cast<std::int64_t>(i); }),
                        long_integers("offsets", prisms.ends), one_type(n, kVtkPolyhedron),
                        long_integers("faces", prisms.faces), long_integers("faceoffsets", prisms.ends_of_faces)});
  vtu.section("PointData", {});
  vtu.section("CellData", {dual_integers("vertex", n, [&](std::size_t i) { return c.vertex(prisms.cells[i]).index; }),
                           dual_integers("layer", n, [&](std::size_t i) { return c.layer(prisms.cells[i]) + 1; }),
                           dual_reals("thickness", n, thickness), dual_reals("volume", n, [&](std::size_t i) {
                             return job.cells.polygon_areas[prisms.polygons[i]] * thickness(i);
                           })});
  vtu.finish();
}

}  // namespace temper::io
