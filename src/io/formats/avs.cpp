// AVS UCD in text, of LaGriT, dfnWorks and PFLOTRAN (.inp): five counts, points, cells, data of points, data of cells.
//
//   4 2 1 0 0                   points, cells, numbers of data per point, per cell, of the model
//   1 0.5 0.25 0                a point: number, x, y, z
//   1 7 tri 1 2 3               a cell: number, material, kind, points: pt, line, tri, quad, tet
//   1 1                         arrays of data of points, and the components of each
//   itetclr, integer            their names and units; LaGriT gives types in place of units
//   1 7                         a point: number, all its numbers
//
// A tetrahedron has its last two points in the other order than here. The material of a cell is its region or tag.
// Lines before the counts may be comments, with '#'.
#include <algorithm>
#include <array>
#include <cmath>

#include "io/formats/cells.hpp"
#include "io/text/scanner.hpp"
#include "io/text/values.hpp"

namespace temper::io {
namespace {

struct AvsKind {
  std::string_view word;
  int vtk;
  std::size_t points;
};
constexpr AvsKind kAvsKinds[] = {{"pt", kVtkVertex, 1},
                                 {"line", kVtkLine, 2},
                                 {"tri", kVtkTriangle, 3},
                                 {"quad", kVtkQuad, 4},
                                 {"tet", kVtkTetrahedron, 4}};
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kAvsOthers = {
    {{"hex", "hexahedron"}, {"prism", "prism"}, {"pyr", "pyramid"}}};

class AvsReader {
 public:
  explicit AvsReader(Source& source)
      : scanner_(source.path, source.bytes, '#'),
        document_(new_document(source.path)),
        sorter_(document_, source.allocation) {}

  Document read() {
    const std::size_t n_points = scanner_.count("points", 8);
    const std::size_t n_cells = scanner_.count("cells", 8);
    const std::size_t of_points = scanner_.count("data of points", 1);
    const std::size_t of_cells = scanner_.count("data of cells", 1);
    const std::size_t of_model = scanner_.count("data of the model", 1);
    points(n_points);
    const NumberLookup lookup(document_.names->points);
    if (const auto twice = lookup.duplicate()) fail(ErrorCode::syntax, scanner_.path(), "has point ", *twice, " twice");
    std::vector<DataArray> data = {{"region", 1, cells(n_cells, lookup)}};
    if (of_points > 0) document_.file.point_data = arrays("point", document_.names->points);
    if (of_cells > 0) {
      for (DataArray& array : arrays("cell", numbers_)) data.push_back(std::move(array));
    }
    if (of_model > 0) document_.file.warnings.push_back(text(scanner_.where(), ": data of the model are dropped"));
    sorter_.distribute(std::move(data));
    name_cells();
    return std::move(document_);
  }

 private:
  void points(std::size_t n) {
    document_.file.points.reserve(n);
    PlaneCheck plane(document_);
    for (std::size_t i = 0; i < n; ++i) {
      document_.names->points.push_back(scanner_.number<std::int64_t>("the number of a point"));
      document_.names->point_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
      const double x = scanner_.real("the x coordinate of a point");
      document_.file.points.push_back({x, scanner_.real("the y coordinate of a point")});
      plane.add(i, scanner_.real("the z coordinate of a point"));
    }
  }
  /// Returns the materials.
  std::vector<std::int32_t> cells(std::size_t n, const NumberLookup& lookup) {
    std::vector<std::int32_t> materials;
    materials.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      const auto number = scanner_.number<std::int64_t>("the number of a cell");
      numbers_.push_back(number);
      lines_.push_back(static_cast<std::int64_t>(scanner_.line()));
      materials.push_back(scanner_.integer("the material of a cell"));
      const AvsKind& kind = kind_of(number, scanner_.word("the kind of a cell"));
      std::array<std::int32_t, 4> corners = {};
      for (std::size_t k = 0; k < kind.points; ++k) corners[k] = corner(number, lookup);
      if (kind.vtk == kVtkTetrahedron) std::swap(corners[2], corners[3]);
      sorter_.add(kind.vtk, corners.data(), kind.points, scanner_.where());
    }
    return materials;
  }
  [[nodiscard]] const AvsKind& kind_of(std::int64_t cell, std::string_view word) const {
    const auto* const known = std::ranges::find(kAvsKinds, word, &AvsKind::word);
    if (known != std::end(kAvsKinds)) return *known;
    for (const auto& [other, name] : kAvsOthers) {
      if (word == other) refuse_element(scanner_.where(), cell, name, KindsOfCells::all);
    }
    scanner_.fail_here(ErrorCode::syntax, "cell ", cell, " is of kind ", in_quotes(word),
                       "; expected pt, line, tri, quad or tet");
  }
  std::int32_t corner(std::int64_t cell, const NumberLookup& lookup) {
    const auto point = scanner_.number<std::int64_t>("a point of a cell");
    if (const auto found = lookup.find(point)) return static_cast<std::int32_t>(*found);
    scanner_.fail_here(ErrorCode::index_out_of_range, "cell ", cell, " uses point ", point, ", but the file has ",
                       document_.file.points.size(), " points and not this one");
  }
  /// Data of points or cells, whose numbers come first in each row.
  std::vector<DataArray> arrays(std::string_view kind, const RunLength& numbers) {
    std::vector<DataArray> arrays(scanner_.count(text("arrays of data of a ", kind), 2));
    std::size_t width = 0;
    for (DataArray& array : arrays) {
      array.components = scanner_.integer("the number of components");
      if (array.components < 1) scanner_.fail_here(ErrorCode::syntax, "expected at least one component");
      width += static_cast<std::size_t>(array.components);
    }
    std::vector<bool> are_integers;
    scanner_.next_line();
    are_integers.reserve(arrays.size());
    for (DataArray& array : arrays) are_integers.push_back(name_array(array, scanner_.rest_of_line()));
    scanner_.check_room(numbers.size(), text("rows of data of a ", kind), 2 * (width + 1));
    std::vector<std::vector<double>> values(arrays.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const auto number = scanner_.number<std::int64_t>(text("the number of a ", kind));
      if (number != numbers[static_cast<std::int64_t>(i)])
        scanner_.fail_here(ErrorCode::syntax, "expected the data of ", kind, " ", numbers[static_cast<std::int64_t>(i)],
                           ", found ", number);
      for (std::size_t a = 0; a < arrays.size(); ++a) {
        for (int k = 0; k < arrays[a].components; ++k) values[a].push_back(scanner_.real("a number of data"));
      }
    }
    for (std::size_t a = 0; a < arrays.size(); ++a) {
      const auto integers = are_integers[a] ? to_int32(Values(values[a])) : std::nullopt;
      arrays[a].values = integers ? Values(*integers) : Values(std::move(values[a]));
    }
    return arrays;
  }
  /// Says whether the array has the type of integers.
  static bool name_array(DataArray& array, std::string_view line) {
    const std::size_t comma = std::min(line.find(','), line.size());
    array.name = trimmed(line.substr(0, comma));
    return trimmed(line.substr(std::min(comma + 1, line.size()))) == "integer";
  }
  /// The sorter counts cells from 0. The file has numbers of its own.
  void name_cells() {
    FileNames& names = *document_.names;
    const auto rename = [this](RunLength& cells, RunLength& lines) {
      RunLength numbers;
      for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::int64_t cell = cells[static_cast<std::int64_t>(i)];
        numbers.push_back(numbers_[cell]);
        lines.push_back(lines_[cell]);
      }
      cells = std::move(numbers);
    };
    rename(names.triangles, names.triangle_lines);
    rename(names.lines, names.line_lines);
    rename(names.tetrahedra, names.tetrahedron_lines);
  }

  Scanner scanner_;
  Document document_;
  CellSorter sorter_;
  RunLength numbers_, lines_;  // of all cells
};

}  // namespace

bool sniff_avs(std::string_view head) {
  Scanner scanner("", head, '#');
  const auto count_on_line = [&scanner](std::string_view characters) {
    std::size_t n = 0;
    scanner.skip_space();
    for (; scanner.more_on_line(); ++n) {
      const std::string_view word = scanner.word("a number");
      if (word.find_first_not_of(characters) != std::string_view::npos) return std::size_t{0};
    }
    return n;
  };
  constexpr std::size_t kCounts = 5, kOfPoint = 4;
  return count_on_line("0123456789") == kCounts && count_on_line("0123456789+-.eEdD") == kOfPoint;
}

Document read_avs(Source& source) { return AvsReader(source).read(); }

}  // namespace temper::io
