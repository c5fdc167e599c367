// Triangle's .node and .ele (Shewchuk), and the segments of .poly and .edge if these files exist. TetGen's files are
// the same with a dimension more: points x y z, tetrahedra a b c d, and tagged faces in .face.
//
//   NAME.node   points 2 attributes markers(0|1), then: number x y attributes… [marker]
//   NAME.ele    triangles 3 attributes, then: number a b c attributes…
//   NAME.poly   (points, none when they are in .node), segments markers, then: number a b [marker]
//   NAME.edge   edges markers, then the same; only those with a marker other than 0 are lines
//   NAME.face   faces markers, then: number a b c [marker]; only those with a marker other than 0
//
// Attributes have no names in this format, so temper declares them in comments, which Triangle skips.
//   # temper attribute float64 1 weight        type, components, name: one line for each array, in order
// Undeclared attributes of points are data attribute1, … (Triangle -w takes the first as weight: declare it to have it
// read as weight). The last undeclared attribute of triangles is the region if it is integer throughout (Triangle -A).
// A marker other than 0 is the tag of a point. Numbers start at 0 or 1, as the first point does.
#include <algorithm>
#include <array>
#include <cmath>

#include "io/disk/files.hpp"
#include "io/formats/format.hpp"
#include "io/text/scanner.hpp"
#include "io/text/values.hpp"

namespace temper::io {
namespace {

constexpr std::string_view kDeclaration = "# temper attribute ";
constexpr std::string_view kDeclaredZ = "# temper z ";
constexpr std::string_view kDeclaredName = "# temper name ";

/// The numbers on the first lines that are not comments.
std::vector<std::vector<std::string_view>> first_lines(std::string_view head, std::size_t n) {
  std::vector<std::vector<std::string_view>> lines;
  Scanner scanner("", head, '#');
  while (lines.size() < n && !scanner.at_end()) {
    lines.emplace_back();
    while (scanner.more_on_line()) {
      const std::string_view word = scanner.word("a number");
      if (!looks_like_number(word)) return {};
      lines.back().push_back(word);
    }
  }
  return lines;
}

enum class TriangleFile { none, node, ele };

TriangleFile kind_of(std::string_view head) {
  const auto lines = first_lines(head, 2);
  if (lines.empty()) return TriangleFile::none;
  const auto& first = lines[0];
  const auto plain = [](std::string_view word) {
    return word.find_first_not_of("0123456789") == std::string_view::npos;
  };
  if (first.size() < 2 || first.size() > 4 || !std::all_of(first.begin(), first.end(), plain))
    return TriangleFile::none;
  const bool only_header = lines.size() < 2;
  const std::size_t columns = only_header ? 0 : lines[1].size();
  if (first[1] == "2" && first.size() != 3 && (only_header || columns >= 3)) return TriangleFile::node;
  if (first[1] == "2" && first.size() == 3 && columns >= 4) return TriangleFile::node;
  // Files of TetGen.
  if (first[1] == "3" && first.size() == 4 && columns >= 4) return TriangleFile::node;
  if ((first[1] == "4" || first[1] == "10") && first.size() <= 3 && columns >= 5) return TriangleFile::ele;
  if ((first[1] == "3" || first[1] == "6") && first.size() <= 3 && (only_header || columns >= 4))
    return TriangleFile::ele;
  return TriangleFile::none;
}

/// The declarations in the comments of a file.
struct Declarations {
  std::vector<DataArray> arrays;  // empty values
  double z = 0;
  std::vector<PhysicalName> names;
};

Declarations declarations(std::string_view bytes) {
  Declarations result;
  const auto each_line_with = [&](std::string_view start, auto use) {
    for (std::size_t at = bytes.find(start); at != std::string_view::npos; at = bytes.find(start, at + 1)) {
      if (at > 0 && bytes[at - 1] != '\n') continue;
      const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
      Scanner scanner("", bytes.substr(at + start.size(), end - at - start.size()));
      try {
        use(scanner);
      } catch (const Failure&) {
        // The comment is no declaration of temper's.
      }
    }
  };
  constexpr std::int32_t kMostComponents = 1000;
  each_line_with(kDeclaration, [&](Scanner& s) {
    const auto scalar = scalar_of_text(s.word("a type"));
    const std::int32_t components = s.integer("components");
    if (!scalar || components < 1 || components > kMostComponents) return;
    result.arrays.push_back({std::string(s.rest_of_line()), components, zeros(*scalar, 0)});
  });
  each_line_with(kDeclaredZ, [&](Scanner& s) { result.z = s.real("z"); });
  each_line_with(kDeclaredName, [&](Scanner& s) {
    const std::int32_t dimension = s.integer("a dimension"), tag = s.integer("a tag");
    result.names.push_back({dimension, tag, std::string(s.rest_of_line())});
  });
  return result;
}

/// The numbers of one point or triangle. They are on one line, as many as in the header.
class TriangleRow {
 public:
  TriangleRow(Scanner& scanner, std::string_view kind, std::size_t columns)
      : scanner_(scanner), kind_(kind), columns_(columns), number_(scanner.integer(kind)) {}

  [[nodiscard]] std::int32_t number() const { return number_; }
  template <class T>
  T next(std::string_view expected) {
    expect_more();
    return scanner_.number<T>(expected);
  }
  std::int32_t next_vertex(std::int32_t first) {
    expect_more();
    return scanner_.vertex(first);
  }
  void end() {
    if (!scanner_.more_on_line()) return;
    const std::string where = scanner_.where();
    for (; scanner_.more_on_line(); ++found_) static_cast<void>(scanner_.word("a number"));
    refuse(where);
  }

 private:
  void expect_more() {
    if (!scanner_.more_on_line()) {
      const std::string where = scanner_.where();
      if (!scanner_.at_end()) refuse(where);  // else the file is cut off
    }
    ++found_;
  }
  [[noreturn]] void refuse(const std::string& where) const {
    fail(ErrorCode::size_mismatch, where, "the row of ", kind_.substr(kind_.rfind(' ') + 1), " ", number_, " has ",
         found_, " numbers, but the header says ", columns_);
  }

  Scanner& scanner_;
  std::string_view kind_;  // "the number of a point"
  std::size_t columns_, found_ = 1;
  std::int32_t number_;
};

/// Columns of a table that become data arrays.
class AttributeColumns {
 public:
  AttributeColumns(std::vector<DataArray> declared, std::size_t columns, const Scanner& scanner)
      : arrays_(std::move(declared)) {
    std::size_t sum = 0;
    for (const DataArray& a : arrays_) sum += static_cast<std::size_t>(a.components);
    if (sum > columns) {
      scanner.fail_here(ErrorCode::size_mismatch, "declares ", sum, " attributes, but the header says ", columns);
    }
    for (std::size_t i = sum; i < columns; ++i) {
      arrays_.push_back({text("attribute", i + 1), 1, std::vector<double>()});
      ++undeclared_;
    }
  }
  void read(TriangleRow& row) {
    for (DataArray& a : arrays_) {
      std::visit(
          [&](auto& v) {
            for (int k = 0; k < a.components; ++k) v.push_back(row.next<ElementOf<decltype(v)>>("an attribute"));
          },
          a.values);
    }
  }
  [[nodiscard]] std::size_t undeclared() const { return undeclared_; }
  std::vector<DataArray> take() { return std::move(arrays_); }

 private:
  std::vector<DataArray> arrays_;
  std::size_t undeclared_ = 0;
};

class TriangleReader {
 public:
  explicit TriangleReader(Source& source) : source_(source), document_(new_document(source.path)) {}
  Document read() {
    const TriangleFile kind = kind_of(std::string_view(source_.bytes).substr(0, kSniffBytes));
    const bool is_node = kind == TriangleFile::node;
    const std::string base = without_suffix(source_.path, is_node ? ".node" : ".ele");
    const std::string other_path = base + (is_node ? ".ele" : ".node");
    if (!exists(other_path)) {
      fail(ErrorCode::not_found, source_.path, "is the ", is_node ? "points" : "elements",
           " of a mesh of Triangle or TetGen; its ", is_node ? "elements" : "points", " are expected in ", other_path,
           ", which does not exist");
    }
    Source other = load(other_path);
    document_.names->path = is_node ? source_.path : other_path;
    document_.names->triangle_path = document_.names->tetrahedron_path = is_node ? other_path : source_.path;
    nodes(is_node ? source_ : other);
    elements(is_node ? other : source_);
    if (dimension_ == 2 && exists(base + ".poly"))
      segments(base + ".poly", false);
    else if (exists(base + ".edge"))
      segments(base + ".edge", true);
    if (dimension_ == 3 && exists(base + ".face")) faces(base + ".face");
    return std::move(document_);
  }

 private:
  void nodes(Source& source) {
    Scanner scanner(source.path, source.bytes, '#');
    MeshFile& f = document_.file;
    const std::size_t n = scanner.count("points", 6);
    dimension_ = scanner.integer("the dimension");
    if (dimension_ != 2 && dimension_ != 3)
      scanner.fail_here(ErrorCode::unsupported, "has points of dimension ", dimension_, "; expected 2 or 3");
    const std::size_t n_attributes = scanner.more_on_line() ? scanner.count("attributes", 1) : 0;
    const bool markers = scanner.more_on_line() && scanner.count("markers", 1) != 0;
    scanner.check_room(n, "points", 6 + 2 * n_attributes);
    Declarations declared = declarations(source.bytes);
    AttributeColumns columns(std::move(declared.arrays), n_attributes, scanner);
    document_.z = declared.z;
    f.names = std::move(declared.names);
    PlaneCheck plane(document_);
    for (std::size_t i = 0; i < n; ++i) {
      TriangleRow row(scanner, "the number of a point",
                      1 + static_cast<std::size_t>(dimension_) + n_attributes + (markers ? 1 : 0));
      const std::int32_t number = row.number();
      if (i == 0) first_ = number;
      if (number != first_ + static_cast<std::int64_t>(i)) {
        scanner.fail_here(ErrorCode::syntax, "expected point ", first_ + static_cast<std::int64_t>(i), ", found point ",
                          number);
      }
      document_.names->points.push_back(number);
      document_.names->point_lines.push_back(static_cast<std::int64_t>(scanner.line()));
      const auto x = row.next<double>("the x coordinate of a point");
      f.points.push_back({x, row.next<double>("the y coordinate of a point")});
      if (dimension_ == 3) plane.add(i, row.next<double>("the z coordinate of a point"));
      columns.read(row);
      const auto marker = markers ? row.next<std::int32_t>("the marker of a point") : 0;
      row.end();
      if (marker == 0) continue;
      f.marked_points.add(static_cast<std::int32_t>(i), marker);
    }
    if (columns.undeclared() > 0) {
      f.warnings.push_back(text(source.path,
                                ": undeclared attributes are read as data, not as weights; the comment line '",
                                kDeclaration, "float64 1 weight' makes the first one a weight"));
    }
    f.point_data = columns.take();
    if (const DataArray* weight = find(f.point_data, "weight"); weight != nullptr && weight->components == 1) {
      f.weights = to_doubles(std::move(take(f.point_data, "weight")->values));
    }
  }
  void elements(Source& source) {
    Scanner scanner(source.path, source.bytes, '#');
    MeshFile& f = document_.file;
    const bool tets = dimension_ == 3;
    const std::string_view kind = tets ? "tetrahedra" : "triangles";
    const std::size_t n = scanner.count(kind, 8);
    const std::int32_t corners = scanner.integer("the number of corners");
    if (corners == 6) refuse_element(scanner.where(), first_, "quadratic triangle", KindsOfCells::simplices);
    if (corners == 10) refuse_element(scanner.where(), first_, "quadratic tetrahedron", KindsOfCells::simplices);
    if (corners != dimension_ + 1)
      scanner.fail_here(ErrorCode::unsupported, "has elements of ", corners, " corners, and points of dimension ",
                        dimension_, "; expected ", kind, " of ", dimension_ + 1);
    const std::size_t n_attributes = scanner.more_on_line() ? scanner.count("attributes", 1) : 0;
    scanner.check_room(n, kind, 8 + 2 * n_attributes);
    Declarations declared = declarations(source.bytes);
    AttributeColumns columns(std::move(declared.arrays), n_attributes, scanner);
    FileNames& names = *document_.names;
    tets ? document_.file.tetrahedra.corners.reserve(n) : f.triangles.corners.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      TriangleRow row(scanner, tets ? "the number of a tetrahedron" : "the number of a triangle",
                      1 + static_cast<std::size_t>(corners) + n_attributes);
      (tets ? names.tetrahedra : names.triangles).push_back(row.number());
      (tets ? names.tetrahedron_lines : names.triangle_lines).push_back(static_cast<std::int64_t>(scanner.line()));
      const std::int32_t a = row.next_vertex(first_), b = row.next_vertex(first_), c = row.next_vertex(first_);
      if (tets)
        document_.file.tetrahedra.corners.push_back({a, b, c, row.next_vertex(first_)});
      else
        f.triangles.corners.push_back({a, b, c});
      columns.read(row);
      row.end();
    }
    const bool last_is_region = columns.undeclared() > 0;
    std::vector<DataArray>& data = tets ? document_.file.tetrahedra.data : f.triangles.data;
    data = columns.take();
    const std::string region = last_is_region ? data.back().name : "region";
    const DataArray* array = find(data, region);
    if (array == nullptr || array->components != 1) return;
    if (auto regions = to_int32(array->values)) {
      (tets ? document_.file.tetrahedra.tags : f.triangles.tags) = std::move(*regions);
      static_cast<void>(take(data, region));
    }
  }
  void faces(const std::string& path) {
    const Source source = load(path);
    Scanner scanner(path, source.bytes, '#');
    MeshFile& f = document_.file;
    document_.names->triangle_path = path;
    const std::size_t n = scanner.count("faces", 8);
    const bool markers = scanner.more_on_line() && scanner.count("markers", 1) != 0;
    for (std::size_t i = 0; i < n; ++i) {
      const auto number = scanner.integer("the number of a face");
      const auto text_line = static_cast<std::int64_t>(scanner.line());
      const std::int32_t a = scanner.vertex(first_), b = scanner.vertex(first_), c = scanner.vertex(first_);
      const std::int32_t marker = markers ? scanner.integer("the marker of a face") : 0;
      skip_neighbors(scanner);
      if (marker == 0) continue;
      document_.names->triangles.push_back(number);
      document_.names->triangle_lines.push_back(text_line);
      f.triangles.add({a, b, c}, marker);
    }
  }
  /// TetGen -nn adds the numbers of tetrahedra to faces and edges.
  static void skip_neighbors(Scanner& scanner) {
    while (scanner.more_on_line()) static_cast<void>(scanner.word("a number"));
  }
  void segments(const std::string& path, bool edges) {
    const Source source = load(path);
    Scanner scanner(path, source.bytes, '#');
    if (!edges) {
      const std::size_t n_points = scanner.count("points", 1);
      scanner.rest_of_line();
      // An outline with points of its own is the input of Triangle, not the mesh: its numbers do not fit.
      if (n_points > 0) return;
    }
    MeshFile& f = document_.file;
    const std::size_t n = scanner.count("segments", 6);
    const bool markers = scanner.more_on_line() && scanner.count("markers", 1) != 0;
    for (std::size_t i = 0; i < n; ++i) {
      const auto number = scanner.integer("the number of a segment");
      const auto text_line = static_cast<std::int64_t>(scanner.line());
      const std::int32_t a = scanner.vertex(first_), b = scanner.vertex(first_);
      const std::int32_t marker = markers ? scanner.integer("the marker of a segment") : 0;
      if (dimension_ == 3) skip_neighbors(scanner);
      if (edges && (marker == 0 || b + first_ == -1)) continue;
      document_.names->lines.push_back(number);
      document_.names->line_lines.push_back(text_line);
      f.lines.add({a, b}, marker);
    }
  }

  Source& source_;
  Document document_;
  std::int32_t first_ = 0;      // number of the first point
  std::int32_t dimension_ = 2;  // of points: 3 in TetGen's files
};

// --- writing ---------------------------------------------------------------------------------------------

void declare(Output& out, std::string_view type, int components, std::string_view name) {
  out.put(kDeclaration, type, ' ', components, ' ', name, '\n');
}

/// Names and types of the arrays as comments; returns the number of columns.
std::size_t declare_all(Output& out, const std::vector<DataArray>& arrays) {
  std::size_t columns = 0;
  for (const DataArray& a : arrays) {
    declare(out, type_name(a.values), a.components, a.name);
    columns += static_cast<std::size_t>(a.components);
  }
  return columns;
}

void put_row(Output& out, const std::vector<DataArray>& arrays, std::size_t row) {
  for (const DataArray& a : arrays) {
    std::visit(
        [&](const auto& v) {
          const auto c = static_cast<std::size_t>(a.components);
          for (std::size_t k = 0; k < c; ++k) out.put(' ', v[row * c + k]);
        },
        a.values);
  }
}

/// Numbers of points, with a blank between two.
template <std::size_t N>
void put_corners(Output& out, const std::array<std::int32_t, N>& corners) {
  for (std::size_t k = 0; k < N; ++k) {
    if (k > 0) out.put(' ');
    out.put(corners[k] + 1);
  }
}

std::vector<DataArray> without(const std::vector<DataArray>& arrays, std::string_view name, const WriteJob& job) {
  std::vector<DataArray> result;
  for (const DataArray& a : arrays) {
    if (a.name == name)
      job.warn("data '", name, "' is not written: other data have this name");
    else
      result.push_back(a);
  }
  return result;
}

void write_node(const WriteJob& job, const std::string& base) {
  const MeshFile& f = job.file;
  Output& out = job.outputs.open(base + ".node");
  const auto markers = one_tag_a_point(job);
  const auto arrays = f.weights.empty() ? f.point_data : without(f.point_data, "weight", job);
  if (!f.weights.empty()) declare(out, "float64", 1, "weight");
  const std::size_t columns = declare_all(out, arrays) + (f.weights.empty() ? 0 : 1);
  const bool in_space = f.dimension() == 3;
  if (!in_space && !is_flat(f)) out.put(kDeclaredZ, f.z(), '\n');
  for (const PhysicalName& n : f.names) out.put(kDeclaredName, n.dimension, ' ', n.tag, ' ', n.name, '\n');
  const bool marked = !f.marked_points.empty();
  out.put(f.points.size(), in_space ? " 3 " : " 2 ", columns, ' ', marked ? 1 : 0, '\n');
  for (std::size_t i = 0; i < f.points.size(); ++i) {
    out.put(i + 1, ' ', f.points[i].x, ' ', f.points[i].y);
    if (in_space) out.put(' ', job.place(i).z);
    if (!f.weights.empty()) out.put(' ', f.weights[i]);
    put_row(out, arrays, i);
    if (marked) out.put(' ', markers[i]);
    out.put('\n');
  }
}

template <int dimension>
void write_ele(const WriteJob& job, const std::string& base, const Cells<dimension>& elements) {
  const auto& [corners, regions, data] = elements;
  Output& out = job.outputs.open(base + ".ele");
  const auto arrays = regions.empty() ? data : without(data, "region", job);
  std::size_t columns = declare_all(out, arrays);
  if (!regions.empty()) {
    declare(out, "int32", 1, "region");
    ++columns;
  }
  out.put(elements.size(), ' ', dimension + 1, ' ', columns, '\n');
  for (std::size_t i = 0; i < elements.size(); ++i) {
    out.put(i + 1, ' ');
    put_corners(out, elements[i]);
    put_row(out, arrays, i);
    if (!regions.empty()) out.put(' ', regions[i]);
    out.put('\n');
  }
}

/// The file of tagged faces or edges of a mesh of TetGen. An old one would give its tags to this mesh, so it has to be
/// replaced. `kind`: of the elements, for the warning on those that the reader will not take for tagged.
template <int dimension>
void write_tagged(const WriteJob& job, const std::string& path, const Cells<dimension>& elements,
                  std::string_view kind) {
  const std::vector<std::int32_t>& tags = elements.tags;
  if (elements.empty() && !exists(path)) return;
  if (const auto n = std::count(tags.begin(), tags.end(), 0); n > 0)
    job.warn(n, " ", kind, n == 1 ? " has" : "s have", " tag 0, which is no tag in files of TetGen: nobody can read ",
             n == 1 ? "it" : "them", " again");
  Output& out = job.outputs.open(path);
  out.put(elements.size(), " 1\n");
  for (std::size_t i = 0; i < elements.size(); ++i) {
    out.put(i + 1, ' ');
    put_corners(out, elements[i]);
    out.put(' ', tags[i], '\n');
  }
}

void write_poly(const WriteJob& job, const std::string& base) {
  const MeshFile& f = job.file;
  // An old .poly would give its segments to this mesh, so it has to be replaced.
  if (f.lines.empty() && !exists(base + ".poly") && !exists(base + ".edge")) return;
  Output& out = job.outputs.open(base + ".poly");
  out.put("0 2 0 0\n", f.lines.size(), " 1\n");
  for (std::size_t i = 0; i < f.lines.size(); ++i) {
    out.put(i + 1, ' ', f.lines[i][0] + 1, ' ', f.lines[i][1] + 1, ' ', f.lines.tags[i], '\n');
  }
  out.put("0\n", "");
}

std::string base_path(const std::string& path) { return without_suffix(without_suffix(path, ".node"), ".ele"); }

}  // namespace

bool sniff_triangle(std::string_view head) { return kind_of(head) != TriangleFile::none; }

Document read_triangle(Source& source) { return TriangleReader(source).read(); }

std::vector<std::string> triangle_files(const std::string& path) {
  const std::string base = base_path(path);
  return {base + ".node", base + ".ele", base + ".poly", base + ".face", base + ".edge"};
}

std::vector<std::string> triangle_files_to_read(const std::string& path) {
  const std::string base = base_path(path);
  return {base + ".node", base + ".ele", base + (exists(base + ".poly") ? ".poly" : ".edge"), base + ".face"};
}

void write_triangle(const WriteJob& job) {
  const std::string base = base_path(job.path);
  const MeshFile& f = job.file;
  write_node(job, base);
  if (f.dimension() == 2) {
    write_ele(job, base, f.triangles);
    return write_poly(job, base);
  }
  write_ele(job, base, f.tetrahedra);
  write_tagged(job, base + ".face", f.triangles, "face");
  write_tagged(job, base + ".edge", f.lines, "line");
}

}  // namespace temper::io
