// Matrix Market exchange format (Boisvert, Pozo, Remington 1996): rows and columns count from 1, numbers are the
// shortest text that reads back to the same bits.
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>
#include <vector>

#include "io/output.hpp"
#include "temper/dec.hpp"

namespace temper::io {

/// `coordinate real general`. The comment is one line.
void put_matrix(Output& out, const IncidenceMatrix& matrix, std::string_view comment);
/// The same, of a diagonal. Zeros are entries, too.
void put_diagonal(Output& out, const std::vector<double>& diagonal, std::string_view comment);
/// `array real general`, which the format wants column after column.
void put_columns(Output& out, std::size_t rows, std::size_t columns, std::string_view comment,
                 const std::function<double(std::size_t row, std::size_t column)>& at);

}  // namespace temper::io
