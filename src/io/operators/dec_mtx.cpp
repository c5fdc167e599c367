// Operators as Matrix Market files (Boisvert, Pozo, Remington 1996). Rows and columns count from 1. Numbers are the
// shortest text that reads back to the same bits.
#include <functional>
#include <vector>

#include "io/operators/dec_files.hpp"
#include "io/text/failure.hpp"

namespace temper::io {
namespace {

/// `coordinate real general`. The comment is one line.
void put_matrix(Output& out, const IncidenceMatrix& matrix, std::string_view comment) {
  out.put("%%MatrixMarket matrix coordinate real general\n% ", comment, '\n');
  out.put(matrix.n_rows(), ' ', matrix.n_columns, ' ', matrix.columns.size(), '\n');
  for (std::size_t row = 0; row < matrix.n_rows(); ++row) {
    for (auto i = static_cast<std::size_t>(matrix.starts[row]); i < static_cast<std::size_t>(matrix.starts[row + 1]);
         ++i) {
      out.put(row + 1, ' ', matrix.columns[i] + 1, ' ', static_cast<int>(matrix.signs[i]), '\n');
    }
  }
}

/// Writes a diagonal matrix. Zeros are entries, too.
void put_diagonal(Output& out, const std::vector<double>& diagonal, std::string_view comment) {
  out.put("%%MatrixMarket matrix coordinate real general\n% ", comment, '\n');
  out.put(diagonal.size(), ' ', diagonal.size(), ' ', diagonal.size(), '\n');
  for (std::size_t i = 0; i < diagonal.size(); ++i) out.put(i + 1, ' ', i + 1, ' ', diagonal[i], '\n');
}

/// `array real general`, which has column after column.
void put_columns(Output& out, std::size_t rows, std::size_t columns, std::string_view comment,
                 const std::function<double(std::size_t row, std::size_t column)>& at) {
  out.put("%%MatrixMarket matrix array real general\n% ", comment, '\n');
  out.put(rows, ' ', columns, '\n');
  for (std::size_t column = 0; column < columns; ++column) {
    for (std::size_t row = 0; row < rows; ++row) out.put(at(row, column), '\n');
  }
}

void put_positions(Output& out, const DecPositions& places, std::string_view of_what) {
  const std::string_view axes = places.coordinates == 2 ? "x, y " : "x, y, z ";
  put_columns(out, places.size, places.coordinates, text(axes, of_what),
              [&](std::size_t row, std::size_t column) { return places.coordinate(row, column); });
}

}  // namespace

void write_dec_mtx(const DecFolder& folder, const DecMatrices& matrices) {
  const auto open = [&](std::string_view name) -> Output& { return folder.open(text(name, ".mtx")); };
  for (const auto& [name, is, matrix] : matrices.incidence) put_matrix(open(name), matrix, is);
  for (const auto& [name, is, values] : matrices.stars) put_diagonal(open(name), values, is);
  const auto& [name, is, values] = matrices.transmissibility;
  put_diagonal(open(name), values, is);
  for (const DecMatrices::Places& places : matrices.places) put_positions(open(places.name), places.at, places.is);
}

DecMatrices matrices_of(const DecComplex& c) {
  return {{{"d0", "edges x vertices: -1 at the lower vertex, +1 at the higher", c.d0},
           {"d1", "triangles x edges: +1 where the edge runs counter-clockwise", c.d1}},
          {{"star0", "signed areas of the dual cells of the vertices", c.star0.raw()},
           {"star1", "signed dual length over length of the edges", c.star1.raw()},
           {"star2", "1 / area of the triangles", c.star2.raw()}},
          {"transmissibility", "length over signed dual length of the edges", c.transmissibility.raw()},
          {{"orthocenters", "of the orthocenters of the triangles", orthocenter_positions(c)},
           {"edge_midpoints", "of the weighted midpoints of the edges", midpoint_positions(c)}}};
}

DecMatrices matrices_of(const tets::DecComplex& c) {
  return {{{"d0", "edges x vertices: -1 at the lower vertex, +1 at the higher", c.d0},
           {"d1", "faces x edges: +1 where the edge runs as in the face, from lower to higher vertices", c.d1},
           {"d2", "tetrahedra x faces: +1 where the normal of the face points out of the tetrahedron", c.d2}},
          {{"star0", "signed volumes of the dual cells of the vertices", c.star0.raw()},
           {"star1", "signed dual area over length of the edges", c.star1.raw()},
           {"star2", "signed dual length over area of the faces", c.star2.raw()},
           {"star3", "1 / volume of the tetrahedra", c.star3.raw()}},
          {"transmissibility", "area over signed dual length of the faces", c.transmissibility.raw()},
          {{"orthocenters", "of the orthocenters of the tetrahedra", orthocenter_positions(c)},
           {"edge_midpoints", "of the weighted midpoints of the edges", midpoint_positions(c)},
           {"face_orthocenters", "of the orthocenters of the faces", face_orthocenter_positions(c)}}};
}

}  // namespace temper::io
