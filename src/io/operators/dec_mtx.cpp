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

void put_positions(const DecJob& job, std::string_view name, const DecPositions& places, std::string_view of_what) {
  const std::string_view axes = places.coordinates == 2 ? "x, y " : "x, y, z ";
  put_columns(job.open(name), places.size, places.coordinates, text(axes, of_what),
              [&](std::size_t row, std::size_t column) { return places.coordinate(row, column); });
}

}  // namespace

void write_dec_mtx(const DecJob& job) {
  const DecComplex& c = job.complex;
  put_matrix(job.open("d0.mtx"), c.d0, "edges x vertices: -1 at the lower vertex, +1 at the higher");
  put_matrix(job.open("d1.mtx"), c.d1, "triangles x edges: +1 where the edge runs counter-clockwise");
  put_diagonal(job.open("star0.mtx"), c.star0.raw(), "signed areas of the dual cells of the vertices");
  put_diagonal(job.open("star1.mtx"), c.star1.raw(), "signed dual length over length of the edges");
  put_diagonal(job.open("star2.mtx"), c.star2.raw(), "1 / area of the triangles");
  put_diagonal(job.open("transmissibility.mtx"), c.transmissibility.raw(),
               "length over signed dual length of the edges");
  put_positions(job, "orthocenters.mtx", orthocenter_positions(c), "of the orthocenters of the triangles");
  put_positions(job, "edge_midpoints.mtx", midpoint_positions(c), "of the weighted midpoints of the edges");
}

}  // namespace temper::io
