// PATH.corner_weights.csv: weights for each vertex and region, of a mesh whose own format has no place for cell data. A
// title line, then a row for each triangle or tetrahedron with the weights of its corners.
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "io/conversion/known_arrays.hpp"
#include "io/disk/files.hpp"
#include "io/formats/format.hpp"
#include "io/text/scanner.hpp"
#include "io/text/values.hpp"

namespace temper::io {
namespace {

constexpr std::string_view kCornerColumns[] = {"first", "second", "third", "fourth"};

struct CornerTable {
  std::vector<DataArray>& data;  ///< of the cells
  std::string_view cell;
  std::size_t cells;
  int corners;
};
CornerTable corner_table_of(MeshFile& f) {
  if (f.tetrahedra.empty()) return {f.triangles.data, "triangle", f.triangles.size(), 3};
  return {f.tetrahedra.data, "tetrahedron", f.tetrahedra.size(), 4};
}

void expect_column(Scanner& scanner, std::string_view column) {
  const std::string_view found = scanner.word("a title line");
  if (found != column)
    scanner.fail_here(ErrorCode::syntax, "expected '", column, "' in the title line, found ", in_quotes(found));
}

const DataArray* corner_weights_in(const MeshFile& f) {
  return find(f.tetrahedra.empty() ? f.triangles.data : f.tetrahedra.data, kCornerWeights);
}

}  // namespace

std::string corner_file_path(const std::string& path) { return path + ".corner_weights.csv"; }

bool has_corner_weights(const MeshFile& file) { return corner_weights_in(file) != nullptr; }

void read_corner_file(Document& document) {
  const std::string path = corner_file_path(document.names->path);
  if (has_corner_weights(document.file) || is_stream(document.names->path) || !exists(path)) return;
  Source source = load(path);
  for (char& c : source.bytes) {
    if (c == ',' || c == ';') c = ' ';
  }
  Scanner scanner(path, source.bytes);
  const CornerTable table = corner_table_of(document.file);
  expect_column(scanner, table.cell);
  for (int k = 0; k < table.corners; ++k) expect_column(scanner, kCornerColumns[k]);
  if (scanner.at_end()) return;  // it has replaced an old one
  std::vector<double> weights;
  for (std::size_t i = 0; i < table.cells; ++i) {
    if (scanner.at_end())
      scanner.fail_here(ErrorCode::size_mismatch, "has ", i, " rows, but ", document.names->path, " has ", table.cells,
                        " cells");
    const auto number = scanner.number<std::int64_t>("the number of a cell");
    for (int k = 0; k < table.corners; ++k) {
      weights.push_back(scanner.real("a weight"));
      if (!std::isfinite(weights.back()))
        scanner.fail_here(ErrorCode::not_finite, table.cell, " ", number, " has weight ", weights.back(),
                          ", expected a finite number");
    }
  }
  if (!scanner.at_end())
    scanner.fail_here(ErrorCode::size_mismatch, "has more rows than ", document.names->path, " has cells (",
                      table.cells, ")");
  table.data.push_back({std::string(kCornerWeights), table.corners, std::move(weights)});
}

void write_corner_file(const WriteJob& job) {
  const DataArray* const array = corner_weights_in(job.file);
  const std::string path = corner_file_path(job.path);
  if (is_stream(job.path)) {
    if (array != nullptr)
      job.warn(
          "the format has no place for weights of regions, and a stream has no file next to it: they are left out");
    return;
  }
  // An old file would give its weights to this mesh, so it has to be replaced.
  if (array == nullptr && !exists(path)) return;
  Output& out = job.outputs.open(path);
  const bool tets = !job.file.tetrahedra.empty();
  out.put(tets ? "tetrahedron,first,second,third,fourth\n" : "triangle,first,second,third\n", "");
  if (array == nullptr) return;
  const auto& weights = std::get<std::vector<double>>(array->values);
  const auto corners = static_cast<std::size_t>(array->components);
  for (std::size_t i = 0; i * corners < weights.size(); ++i) {
    out.put(job.row.details.first_point + static_cast<std::int64_t>(i), "");
    for (std::size_t k = 0; k < corners; ++k) out.put(',', weights[corners * i + k]);
    out.put('\n', "");
  }
  job.warn("the format has no place for weights of regions; they are in ", path);
}

}  // namespace temper::io
