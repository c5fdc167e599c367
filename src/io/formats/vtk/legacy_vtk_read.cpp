// Legacy VTK, versions 2.0 to 5.1, ASCII and binary (big-endian): UNSTRUCTURED_GRID and POLYDATA of triangles.
//
// Attributes of points and cells in all their forms (SCALARS, VECTORS, FIELD, …) are kept as data.
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "io/formats/cells.hpp"
#include "io/formats/format.hpp"
#include "io/text/names.hpp"
#include "io/text/scanner.hpp"
#include "io/text/values.hpp"

namespace temper::io {

bool sniff_vtk51(std::string_view head) { return head.starts_with("# vtk DataFile Version 5"); }
bool sniff_legacy_vtk(std::string_view head) { return head.starts_with("# vtk DataFile") && !sniff_vtk51(head); }

namespace {

/// A type of legacy VTK. vtkIdType is written as int.
struct LegacyType {
  std::string_view name;
  Scalar scalar;
};
constexpr LegacyType kTypes[] = {{"float", Scalar::f32},
                                 {"double", Scalar::f64},
                                 {"int", Scalar::i32},
                                 {"vtkidtype", Scalar::i32},
                                 {"long", Scalar::i64},
                                 {"vtktypeint64", Scalar::i64},
                                 {"vtktypeint32", Scalar::i32},
                                 {"vtktypeuint32", Scalar::u32},
                                 {"vtktypeint16", Scalar::i16},
                                 {"vtktypeuint16", Scalar::u16},
                                 {"vtktypeint8", Scalar::i8},
                                 {"vtktypeuint8", Scalar::u8},
                                 {"vtktypefloat64", Scalar::f64},
                                 {"vtktypefloat32", Scalar::f32},
                                 {"unsigned_char", Scalar::u8},
                                 {"char", Scalar::i8},
                                 {"signed_char", Scalar::i8},
                                 {"short", Scalar::i16},
                                 {"unsigned_short", Scalar::u16},
                                 {"unsigned_int", Scalar::u32},
                                 {"unsigned_long", Scalar::u64},
                                 {"vtktypeuint64", Scalar::u64},
                                 {"long_long", Scalar::i64},
                                 {"unsigned_long_long", Scalar::u64}};

/// Names of arrays encode blanks and similar characters as %20.
std::string decoded(std::string_view name) {
  std::string result;
  for (std::size_t i = 0; i < name.size(); ++i) {
    unsigned code = 0;
    if (name[i] == '%' && i + 2 < name.size() &&
        std::from_chars(name.data() + i + 1, name.data() + i + 3, code, 16).ptr == name.data() + i + 3) {
      result += static_cast<char>(code);
      i += 2;
    } else {
      result += name[i];
    }
  }
  return result;
}

class LegacyVtkReader {
 public:
  explicit LegacyVtkReader(Source& source)
      : scanner_(source.path, source.bytes), document_(new_document(source.path)), allocation_(source.allocation) {}
  Document read() {
    header();
    while (!scanner_.at_end()) keyword(lower_case(scanner_.word("a keyword")));
    if (!has_points_) scanner_.fail_truncated("POINTS");
    finish_cells();
    take_point_data(document_, std::move(point_data_));
    take_physical_names(document_);
    return std::move(document_);
  }

 private:
  /// Points of cells, one after the other; the points of cell i end at ends[i].
  struct CellArray {
    std::vector<std::int32_t> points, ends;
    RunLength text_lines;
  };
  enum class Attributes { none, points, cells };

  void header() {
    const std::string_view first = scanner_.rest_of_line();
    const std::size_t at = first.rfind(' ');
    const std::string_view number = first.substr(at == std::string_view::npos ? 0 : at + 1);
    if (read_number(number.data(), number.data() + number.size(), version_).ec != std::errc() || version_ < 1 ||
        version_ >= 6) {
      fail(ErrorCode::unsupported, text(scanner_.path(), ":1"), "is legacy VTK version ", in_quotes(number),
           "; temper reads 2.0 to 5.1");
    }
    scanner_.rest_of_line();
    const std::string encoding = lower_case(scanner_.word("ASCII or BINARY"));
    if (encoding != "ascii" && encoding != "binary")
      scanner_.fail_here(ErrorCode::syntax, "expected ASCII or BINARY, found ", in_quotes(encoding));
    binary_ = encoding == "binary";
  }
  void keyword(const std::string& word) {
    if (word == "dataset") {
      const std::string kind = lower_case(scanner_.word("the kind of data set"));
      if (kind != "unstructured_grid" && kind != "polydata") {
        scanner_.fail_here(ErrorCode::unsupported, "is a data set of kind ", in_quotes(kind),
                           "; temper reads UNSTRUCTURED_GRID and POLYDATA");
      }
      poly_ = kind == "polydata";
    } else if (word == "points") {
      points();
    } else if (word == "cells" && !poly_) {
      cells_ = cells();
    } else if (word == "cell_types" && !poly_) {
      cell_types();
    } else if (poly_ && (word == "vertices" || word == "lines" || word == "polygons" || word == "triangle_strips")) {
      polydata(word);
    } else if (word == "point_data" || word == "cell_data") {
      attributes_ = word == "point_data" ? Attributes::points : Attributes::cells;
      n_tuples_ = scanner_.count("tuples", 1);
    } else if (word == "metadata") {
      skip_metadata();
    } else if (word == "field") {
      field();
    } else {
      attribute(word);
    }
  }
  void points() {
    // Data may have been read already, one tuple for each point.
    if (has_points_) scanner_.fail_here(ErrorCode::syntax, "has a second section POINTS");
    const std::size_t n = scanner_.count("points", 3);
    const Scalar scalar = type(scanner_.word("a type"), "POINTS");
    MeshFile& f = document_.file;
    FileNames& names = *document_.names;
    names.points = RunLength(0, n);
    PlaneCheck plane(document_);
    if (binary_) {
      const std::vector<double> all = to_doubles(values(scalar, 3 * n, "POINTS"));
      f.points.reserve(n);
      for (std::size_t i = 0; i < n; ++i) {
        f.points.push_back({all[3 * i], all[3 * i + 1]});
        plane.add(i, all[3 * i + 2]);
      }
    } else {
      scanner_.check_room(n, "points", 6);
      f.points.reserve(n);
      for (std::size_t i = 0; i < n; ++i) {
        const double x = scanner_.real("the x coordinate of a point");
        names.point_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
        f.points.push_back({x, scanner_.real("the y coordinate of a point")});
        plane.add(i, scanner_.real("the z coordinate of a point"));
      }
    }
    has_points_ = true;
  }
  CellArray cells() {
    const std::size_t n = scanner_.count("cells", 1);
    const std::size_t size = scanner_.count("cell numbers", 1);
    return version_ >= 5 ? cells_with_offsets(n, size) : cells_with_counts(n, size);
  }
  CellArray cells_with_counts(std::size_t n, std::size_t size) {
    CellArray result;
    std::vector<std::int32_t> all;
    if (binary_) all = integers(Scalar::i32, size, "CELLS");
    std::size_t at = 0;
    const auto next = [&]() -> std::int32_t {
      if (!binary_) return scanner_.integer("the number of a point");
      if (at == all.size())
        fail(ErrorCode::syntax, scanner_.path(), "the cells need more than the ", size, " numbers announced");
      return all[at++];
    };
    scanner_.check_room(binary_ ? 0 : n, "cells", 4);
    for (std::size_t i = 0; i < n; ++i) {
      const std::int32_t count = next();
      if (!binary_) result.text_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
      if (count < 0 || static_cast<std::size_t>(count) > size) {
        fail(ErrorCode::syntax, where(), "element ", i, " has ", count, " points");
      }
      for (std::int32_t k = 0; k < count; ++k) result.points.push_back(next());
      result.ends.push_back(static_cast<std::int32_t>(result.points.size()));
    }
    return result;
  }
  CellArray cells_with_offsets(std::size_t n_offsets, std::size_t n_points) {
    CellArray result;
    for (const std::string_view expected : {"offsets", "connectivity"}) {
      const std::string found = lower_case(scanner_.word(expected));
      if (found != expected) scanner_.fail_here(ErrorCode::syntax, "expected ", expected, ", found ", in_quotes(found));
      const Scalar scalar = type(scanner_.word("a type"), found);
      auto all = integers(scalar, expected == "offsets" ? n_offsets : n_points, found);
      (expected == "offsets" ? result.ends : result.points) = std::move(all);
    }
    std::int32_t last = 0;
    for (const std::int32_t offset : result.ends) {
      if (offset < last || static_cast<std::size_t>(offset) > result.points.size()) {
        fail(ErrorCode::index_out_of_range, where(), "a cell ends at ", offset, " of ", result.points.size(),
             " numbers, and starts at ", last);
      }
      last = offset;
    }
    if (!result.ends.empty()) {
      if (result.ends.front() != 0)
        fail(ErrorCode::syntax, where(), "offsets start at ", result.ends.front(), ", expected 0");
      result.ends.erase(result.ends.begin());
    }
    return result;
  }
  void cell_types() {
    const std::size_t n = scanner_.count("cell types", 1);
    types_ = integers(Scalar::i32, n, "CELL_TYPES");
  }
  void polydata(const std::string& word) {
    CellArray read = cells();
    if (word == "triangle_strips") {
      if (!read.ends.empty()) refuse_element(where(), 0, "triangle strip");
      return;
    }
    poly_cells_[word == "vertices" ? 0 : word == "lines" ? 1 : 2] = std::move(read);
  }
  void attribute(const std::string& word) {
    if (attributes_ == Attributes::none)
      scanner_.fail_here(ErrorCode::syntax, "expected a keyword of legacy VTK, found ", in_quotes(word));
    if (word == "scalars") return scalars();
    const auto plain = [&](int components) {
      const std::string name = decoded(scanner_.word("a name"));
      const Scalar scalar = type(scanner_.word("a type"), name);
      add_attribute({name, components, values(scalar, n_tuples_ * static_cast<std::size_t>(components), name)});
    };
    if (word == "vectors" || word == "normals") return plain(3);
    if (word == "tensors") return plain(9);
    if (word == "tensors6") return plain(6);
    if (word == "global_ids" || word == "pedigree_ids" || word == "edge_flags") return plain(1);
    constexpr std::size_t kMostComponents = 4096;
    if (word == "texture_coordinates" || word == "color_scalars") {
      const std::string name = decoded(scanner_.word("a name"));
      const std::size_t n = scanner_.count("components", 1);
      if (n < 1 || n > kMostComponents)
        scanner_.fail_here(ErrorCode::syntax, "array ", in_quotes(name), " has ", n, " components");
      // Colors are bytes in binary files and fractions in text.
      const Scalar scalar =
          word == "color_scalars" ? (binary_ ? Scalar::u8 : Scalar::f32) : type(scanner_.word("a type"), name);
      add_attribute({name, static_cast<int>(n), values(scalar, n_tuples_ * n, name)});
      return;
    }
    if (word == "lookup_table") {
      scanner_.word("a name");
      const std::size_t n = scanner_.count("colors", 1);
      static_cast<void>(values(binary_ ? Scalar::u8 : Scalar::f32, 4 * n, "LOOKUP_TABLE"));
      return;
    }
    scanner_.fail_here(ErrorCode::syntax, "expected an attribute, found ", in_quotes(word));
  }
  void scalars() {
    const std::string name = decoded(scanner_.word("a name"));
    const Scalar scalar = type(scanner_.word("a type"), name);
    const bool has_components = scanner_.more_on_line();
    const std::int32_t components = has_components ? scanner_.integer("the number of components") : 1;
    constexpr std::int32_t kMost = 4;
    if (components < 1 || components > kMost) {
      scanner_.fail_here(ErrorCode::syntax, "array ", in_quotes(name), " has ", components,
                         " components; expected 1 to 4");
    }
    if (lower_case(scanner_.peek()) == "lookup_table") {
      scanner_.word("LOOKUP_TABLE");
      scanner_.word("a name");
    }
    add_attribute({name, components, values(scalar, n_tuples_ * static_cast<std::size_t>(components), name)});
  }
  void field() {
    scanner_.word("the name of a field");
    const std::size_t n = scanner_.count("arrays", 4);
    for (std::size_t i = 0; i < n; ++i) {
      if (lower_case(scanner_.peek()) == "metadata") {
        scanner_.word("METADATA");
        skip_metadata();
      }
      const std::string name = decoded(scanner_.word("the name of an array"));
      const std::size_t components = scanner_.count("components", 0 + 1);
      const std::size_t tuples = scanner_.count("tuples", 1);
      const std::string_view type_word = scanner_.word("a type");
      if (components > 0 && tuples > scanner_.remaining() / components) {
        scanner_.fail_here(ErrorCode::truncated, "array ", in_quotes(name), " announces more than the file holds");
      }
      if (lower_case(type_word) == "string") {
        scanner_.next_line();
        for (std::size_t k = 0; k < components * tuples && !binary_; ++k) scanner_.next_line();
        if (binary_) scanner_.fail_here(ErrorCode::unsupported, "array ", in_quotes(name), " is text in binary");
        document_.file.warnings.push_back(
            text(scanner_.where(), ": array ", in_quotes(name), " is text and is dropped"));
        continue;
      }
      const Scalar scalar = type(type_word, name);
      Values all = values(scalar, components * tuples, name);
      if (components > 0) add_attribute({name, static_cast<int>(components), std::move(all)});
    }
  }
  // Lines of information up to an empty one.
  void skip_metadata() {
    scanner_.next_line();
    while (scanner_.remaining() > 0 && !scanner_.rest_of_line().empty()) {
    }
  }
  void add_attribute(DataArray&& array) {
    if (attributes_ == Attributes::none) {
      document_.file.field_data.push_back(std::move(array));
      return;
    }
    const std::size_t n = n_tuples_;
    const std::size_t expected_tuples = attributes_ == Attributes::points ? document_.file.points.size() : n;
    if (size(array.values) != expected_tuples * static_cast<std::size_t>(array.components)) {
      fail(ErrorCode::size_mismatch, where(), "array ", in_quotes(array.name), " has ", size(array.values),
           " values, expected ", expected_tuples, " times ", array.components);
    }
    auto& list = attributes_ == Attributes::points ? point_data_ : cell_data_;
    list.push_back(std::move(array));
  }
  void finish_cells() {
    if (!poly_ && types_.size() != cells_.ends.size()) {
      fail(ErrorCode::size_mismatch, scanner_.path(), "has ", cells_.ends.size(), " CELLS and ", types_.size(),
           " CELL_TYPES");
    }
    CellSorter sorter(document_, allocation_);
    RunLength tet_lines, triangle_lines, line_lines;
    const auto add_all = [&](const CellArray& array, auto type_of) {
      std::int32_t start = 0;
      for (std::size_t i = 0; i < array.ends.size(); ++i) {
        const std::int64_t line = array.text_lines[static_cast<std::int64_t>(i)];
        const std::string here = array.text_lines.empty() ? scanner_.path() : text(scanner_.path(), ":", line);
        sorter.add(type_of(i), array.points.data() + start, static_cast<std::size_t>(array.ends[i] - start), here);
        start = array.ends[i];
        while (!array.text_lines.empty() && tet_lines.size() < document_.file.tetrahedra.corners.size())
          tet_lines.push_back(line);
        while (!array.text_lines.empty() && triangle_lines.size() < document_.file.triangles.size())
          triangle_lines.push_back(line);
        while (!array.text_lines.empty() && line_lines.size() < document_.file.lines.size()) line_lines.push_back(line);
      }
    };
    if (poly_) {
      constexpr int kTypesOfPoly[] = {kVtkPolyVertex, kVtkPolyLine, kVtkPolygon};
      for (std::size_t k = 0; k < 3; ++k) add_all(poly_cells_[k], [&](std::size_t) { return kTypesOfPoly[k]; });
    } else {
      add_all(cells_, [&](std::size_t i) { return types_[i]; });
    }
    for (const DataArray& a : cell_data_) {
      const std::size_t expected = sorter.n_cells() * static_cast<std::size_t>(a.components);
      if (size(a.values) == expected) continue;
      fail(ErrorCode::size_mismatch, scanner_.path(), "cell data ", in_quotes(a.name), " has ", size(a.values),
           " values, expected ", sorter.n_cells(), " times ", a.components);
    }
    sorter.distribute(std::move(cell_data_));
    document_.names->tetrahedron_lines = std::move(tet_lines);
    document_.names->triangle_lines = std::move(triangle_lines);
    document_.names->line_lines = std::move(line_lines);
  }

  Scalar type(std::string_view name, const std::string& array) {
    const std::string plain = lower_case(name);
    for (const LegacyType& row : kTypes) {
      if (row.name == plain) return row.scalar;
    }
    scanner_.fail_here(ErrorCode::unsupported, "array ", in_quotes(array), " has the type ", in_quotes(name));
  }
  Values values(Scalar scalar, std::size_t n, const std::string& name) {
    const std::string expected = text("a number of ", name);
    return with_scalar(scalar, [&](auto zero) -> Values {
      using T = decltype(zero);
      if (!binary_) {
        scanner_.check_room(n, text("numbers of ", name), 2);
        std::vector<T> result(n);
        for (T& value : result) value = scanner_.number<T>(expected);
        return result;
      }
      scanner_.next_line();
      scanner_.check_room(n, text("numbers of ", name), sizeof(T));
      const std::string_view bytes = scanner_.bytes(n * sizeof(T), expected);
      std::vector<T> result(n);
      if (n > 0) std::memcpy(result.data(), bytes.data(), bytes.size());
      if constexpr (std::endian::native == std::endian::little) {
        for (T& value : result) {
          auto* raw = reinterpret_cast<char*>(&value);
          std::reverse(raw, raw + sizeof(T));
        }
      }
      return result;
    });
  }
  std::vector<std::int32_t> integers(Scalar scalar, std::size_t n, const std::string& name) {
    Values all = values(scalar, n, name);
    if (auto* same = std::get_if<std::vector<std::int32_t>>(&all)) return std::move(*same);
    auto converted = to_int32(all);
    if (!converted) fail(ErrorCode::index_out_of_range, where(), name, " have a value that is no 32-bit integer");
    return std::move(*converted);
  }
  std::string where() const { return binary_ ? scanner_.path() : scanner_.where(); }

  Scanner scanner_;
  Document document_;
  AllocationLimits& allocation_;
  double version_ = 0;
  bool binary_ = false, poly_ = false, has_points_ = false;
  CellArray cells_;
  std::vector<std::int32_t> types_;
  std::array<CellArray, 3> poly_cells_;  // vertices, lines, polygons: the order of their data
  Attributes attributes_ = Attributes::none;
  std::size_t n_tuples_ = 0;
  std::vector<DataArray> point_data_, cell_data_;
};

}  // namespace

Document read_legacy_vtk(Source& source) { return LegacyVtkReader(source).read(); }

}  // namespace temper::io
