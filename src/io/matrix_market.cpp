#include "io/matrix_market.hpp"

namespace temper::io {

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

void put_diagonal(Output& out, const std::vector<double>& diagonal, std::string_view comment) {
  out.put("%%MatrixMarket matrix coordinate real general\n% ", comment, '\n');
  out.put(diagonal.size(), ' ', diagonal.size(), ' ', diagonal.size(), '\n');
  for (std::size_t i = 0; i < diagonal.size(); ++i) out.put(i + 1, ' ', i + 1, ' ', diagonal[i], '\n');
}

void put_columns(Output& out, std::size_t rows, std::size_t columns, std::string_view comment,
                 const std::function<double(std::size_t row, std::size_t column)>& at) {
  out.put("%%MatrixMarket matrix array real general\n% ", comment, '\n');
  out.put(rows, ' ', columns, '\n');
  for (std::size_t column = 0; column < columns; ++column) {
    for (std::size_t row = 0; row < rows; ++row) out.put(at(row, column), '\n');
  }
}

}  // namespace temper::io
