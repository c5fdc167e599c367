// PLY (Stanford), ASCII and binary of both byte orders. The header declares elements and their properties.
//
//   vertex   x y [z] (or X Y Z), weight, tag; all other numbers are point data
//   face     vertex_indices (or vertex_index); region and all other numbers are cell data
//   edge     vertex1 vertex2; region is the tag of the line, all other numbers are line data
//
// Faces of two corners or one are lines and marked points, as in meshio. Lists and other elements are dropped with a
// warning.
#include <algorithm>
#include <bit>
#include <cstring>
#include <map>

#include "io/formats/cells.hpp"
#include "io/formats/format.hpp"
#include "io/formats/ply.hpp"
#include "io/text/names.hpp"
#include "io/text/scanner.hpp"

namespace temper::io {

bool sniff_ply(std::string_view head) { return head.starts_with("ply\n") || head.starts_with("ply\r"); }

namespace {

struct PlyProperty {
  std::string name;
  Scalar scalar = Scalar::f64;
  std::optional<Scalar> count;  // of a list
  Values values;                // one for each element; the numbers of lists are not kept
};

struct PlyElement {
  std::string name;
  std::size_t n = 0;
  std::vector<PlyProperty> properties;
  RunLength text_lines;
  std::vector<std::int32_t> corners, ends;  // of vertex_indices: the corners of face i end at ends[i]
};

/// An array that is stored as several properties: name_0, name_1, …
struct PlyJoined {
  std::string name;
  std::size_t components = 1;
};

/// The elements and names of a file, before they make a mesh.
struct PlyContents {
  std::string path;
  bool binary = false;
  std::vector<PlyElement> elements;
  std::map<std::string, std::size_t, std::less<>> element_of_name;
  std::map<std::pair<std::string, std::string>, PlyJoined> joined;  // of an element and a first property
  std::vector<PhysicalName> names;

  [[nodiscard]] PlyElement* find(std::string_view name) {
    const auto it = element_of_name.find(name);
    return it == element_of_name.end() ? nullptr : &elements[it->second];
  }
};

/// Header and numbers of a file.
class PlyScanner {
 public:
  explicit PlyScanner(const Source& source) : scanner_(source.path, source.bytes) { contents_.path = source.path; }
  PlyContents read() {
    header();
    for (PlyElement& e : contents_.elements) body(e);
    if (!contents_.binary && !scanner_.at_end()) {
      scanner_.fail_here(ErrorCode::syntax, "expected the end of the file after all elements of the header, found ",
                         in_quotes(scanner_.peek()));
    }
    return std::move(contents_);
  }

 private:
  void header() {
    scanner_.next_line();
    bool has_format = false;
    for (;;) {
      if (scanner_.remaining() == 0) scanner_.fail_truncated("end_header");
      const std::string where = scanner_.where();
      Scanner line(where, scanner_.rest_of_line());
      if (line.at_end()) continue;
      const std::string_view word = line.word("a statement");
      if (word == "end_header") break;
      if (word == "comment") {
        comment(line.rest_of_line());
      } else if (word == "format") {
        format(line);
        has_format = true;
      } else if (word == "element") {
        element(line);
      } else if (word == "property") {
        property(line);
      } else if (word != "obj_info") {
        fail(ErrorCode::syntax, where, "expected a statement of a PLY header, found ", in_quotes(word));
      }
    }
    if (!has_format) fail(ErrorCode::syntax, scanner_.path(), "the header has no format");
  }
  void format(Scanner& line) {
    const std::string_view name = line.word("the name of a format"), version = line.word("the version of the format");
    contents_.binary = name != "ascii";
    endian_ = name == "binary_big_endian" ? std::endian::big : std::endian::little;
    if ((contents_.binary && name != "binary_big_endian" && name != "binary_little_endian") || version != "1.0") {
      fail(ErrorCode::unsupported, line.path(), "is PLY in format ", in_quotes(name), " ", in_quotes(version),
           "; temper reads ascii, binary_little_endian and binary_big_endian 1.0");
    }
  }
  void comment(std::string_view words) {
    const bool array = words.starts_with(kPlyArrayComment), name = words.starts_with(kPlyNameComment);
    if (!array && !name) return;
    Scanner line(scanner_.path(), words.substr((array ? kPlyArrayComment : kPlyNameComment).size()));
    if (array) {
      const std::string owner(line.word("an element"));
      const std::int32_t components = line.integer("a number of components");
      const std::string joined(line.word("the name of an array"));
      if (components > 1)
        contents_.joined.emplace(std::pair(owner, text(joined, "_0")),
                                 PlyJoined{joined, static_cast<std::size_t>(components)});
    } else {
      contents_.names.push_back(read_physical_name(line));
    }
  }
  void element(Scanner& line) {
    PlyElement e;
    e.name = line.word("the name of an element");
    const auto n = line.number<std::int64_t>("the number of elements");
    if (n < 0) fail(ErrorCode::syntax, line.path(), "expected the number of elements, found ", n);
    e.n = static_cast<std::size_t>(n);
    if (!contents_.element_of_name.emplace(e.name, contents_.elements.size()).second)
      fail(ErrorCode::syntax, line.path(), "declares element ", in_quotes(e.name), " a second time");
    contents_.elements.push_back(std::move(e));
  }
  void property(Scanner& line) {
    if (contents_.elements.empty()) fail(ErrorCode::syntax, line.path(), "a property comes before the first element");
    PlyProperty p;
    std::string_view word = line.word("a type");
    if (word == "list") {
      p.count = type(line.word("the type of a count"));
      if (*p.count == Scalar::f64 || *p.count == Scalar::f32)
        fail(ErrorCode::syntax, line.path(), "the count of a list is no integer");
      word = line.word("a type");
    }
    p.scalar = type(word);
    p.name = line.word("the name of a property");
    contents_.elements.back().properties.push_back(std::move(p));
  }
  [[nodiscard]] Scalar type(std::string_view name) const {
    for (const PlyType& row : kPlyTypes) {
      if (name == row.name || name == row.other_name) return row.scalar;
    }
    fail(ErrorCode::unsupported, scanner_.path(), "expected a type of PLY, found ", in_quotes(name));
  }

  void body(PlyElement& e) {
    if (e.n == 0) return;
    std::size_t least = 0;  // bytes an element
    for (const PlyProperty& p : e.properties) least += contents_.binary ? info(p.count.value_or(p.scalar)).bytes : 2;
    if (least == 0) fail(ErrorCode::syntax, scanner_.path(), "elements ", in_quotes(e.name), " have no properties");
    scanner_.check_room(e.n, text("elements ", in_quotes(e.name)), least);
    for (PlyProperty& p : e.properties) {
      if (!p.count) p.values = zeros(p.scalar, e.n);
    }
    for (std::size_t i = 0; i < e.n; ++i) {
      if (!contents_.binary) {
        scanner_.skip_space();
        e.text_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
      }
      for (PlyProperty& p : e.properties) {
        if (p.count) {
          list(e, p);
          continue;
        }
        std::visit([&](auto& v) { v[i] = number<ElementOf<decltype(v)>>(p.name); }, p.values);
      }
    }
  }
  void list(PlyElement& e, const PlyProperty& p) {
    const std::int64_t n = whole_number(*p.count, text("the number of ", p.name));
    if (n < 0) {
      fail(ErrorCode::syntax, contents_.binary ? scanner_.path() : scanner_.where(), "expected the number of ", p.name,
           ", found ", n);
    }
    scanner_.check_room(static_cast<std::uint64_t>(n), p.name, contents_.binary ? info(p.scalar).bytes : 2);
    const bool corners = e.name == "face" && (p.name == "vertex_indices" || p.name == "vertex_index");
    for (std::int64_t k = 0; k < n; ++k) {
      if (!corners) {
        with_scalar(p.scalar, [&](auto zero) { static_cast<void>(number<decltype(zero)>(p.name)); });
        continue;
      }
      const std::int64_t v = whole_number(p.scalar, "a vertex number");
      if (!std::in_range<std::int32_t>(v)) {
        fail(ErrorCode::index_out_of_range, contents_.binary ? scanner_.path() : scanner_.where(), "vertex number ", v,
             " is beyond 32 bits");
      }
      e.corners.push_back(static_cast<std::int32_t>(v));
    }
    if (corners) e.ends.push_back(static_cast<std::int32_t>(e.corners.size()));
  }
  template <class T>
  T number(const std::string& expected) {
    if (!contents_.binary) return scanner_.number<T>(expected);
    char bytes[sizeof(T)];
    std::memcpy(bytes, scanner_.bytes(sizeof(T), expected).data(), sizeof(T));
    if (endian_ != std::endian::native) std::reverse(bytes, bytes + sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }
  std::int64_t whole_number(Scalar scalar, const std::string& expected) {
    return with_scalar(scalar, [&](auto zero) -> std::int64_t {
      using T = decltype(zero);
      const T value = number<T>(expected);
      if constexpr (std::is_integral_v<T>) {
        if (std::in_range<std::int64_t>(value)) return static_cast<std::int64_t>(value);
      }
      fail(ErrorCode::syntax, contents_.binary ? scanner_.path() : scanner_.where(), expected, " is ", value);
    });
  }

  Scanner scanner_;
  PlyContents contents_;
  std::endian endian_ = std::endian::native;
};

/// The mesh that the elements of a file make.
class PlyReader {
 public:
  explicit PlyReader(Source& source)
      : contents_(PlyScanner(source).read()), document_(new_document(source.path)), allocation_(source.allocation) {}
  Document read() {
    document_.file.names = std::move(contents_.names);
    PlyElement* vertex = contents_.find("vertex");
    if (vertex == nullptr) fail(ErrorCode::empty_input, contents_.path, "the file has no element vertex");
    vertices(*vertex);
    if (PlyElement* face = contents_.find("face")) faces(*face);
    if (PlyElement* edge = contents_.find("edge")) edges(*edge);
    for (const PlyElement& e : contents_.elements) {
      if (e.n == 0 || e.name == "vertex" || e.name == "face" || e.name == "edge") continue;
      if (e.name == "tristrips") refuse_element(contents_.path, 0, "triangle strip");
      document_.file.warnings.push_back(text(contents_.path, ": elements ", in_quotes(e.name), " are dropped"));
    }
    return std::move(document_);
  }

 private:
  static std::optional<Values> take(PlyElement& e, std::string_view name) {
    const auto it = std::find_if(e.properties.begin(), e.properties.end(),
                                 [&](const PlyProperty& p) { return p.name == name && !p.count; });
    if (it == e.properties.end()) return std::nullopt;
    Values values = std::move(it->values);
    e.properties.erase(it);
    return values;
  }
  /// The remaining properties; properties of one array are joined.
  std::vector<DataArray> take_data(PlyElement& e) const {
    std::vector<DataArray> arrays;
    if (e.n == 0) return arrays;
    const auto& properties = e.properties;
    for (std::size_t i = 0; i < properties.size(); ++i) {
      if (properties[i].count) continue;
      const PlyJoined* joined = joined_at(e, i);
      const std::size_t n = joined == nullptr ? 1 : joined->components;
      DataArray array{joined == nullptr ? properties[i].name : joined->name, static_cast<int>(n),
                      zeros(properties[i].scalar, e.n * n)};
      std::visit(
          [&](auto& v) {
            for (std::size_t k = 0; k < n; ++k) {
              const auto& column = std::get<std::remove_cvref_t<decltype(v)>>(properties[i + k].values);
              for (std::size_t row = 0; row < e.n; ++row) v[row * n + k] = column[row];
            }
          },
          array.values);
      arrays.push_back(std::move(array));
      i += n - 1;
    }
    return arrays;
  }
  /// The array that begins with property i of the element, when its properties are consecutive; else null.
  [[nodiscard]] const PlyJoined* joined_at(const PlyElement& e, std::size_t i) const {
    const auto it = contents_.joined.find({e.name, e.properties[i].name});
    if (it == contents_.joined.end()) return nullptr;
    for (std::size_t n = 1; n < it->second.components; ++n) {
      if (i + n >= e.properties.size()) return nullptr;
      const PlyProperty& next = e.properties[i + n];
      const bool follows =
          !next.count && next.scalar == e.properties[i].scalar && next.name == text(it->second.name, "_", n);
      if (!follows) return nullptr;
    }
    return &it->second;
  }
  void vertices(PlyElement& e) {
    MeshFile& f = document_.file;
    FileNames& names = *document_.names;
    names.points = RunLength(0, e.n);
    names.point_lines = e.text_lines;
    const auto coordinate = [&](std::string_view name, std::string_view upper) {
      auto values = take(e, name);
      return values ? values : take(e, upper);
    };
    auto x = coordinate("x", "X"), y = coordinate("y", "Y"), z = coordinate("z", "Z");
    if (!x || !y) fail(ErrorCode::syntax, contents_.path, "vertices have no property ", x ? "y" : "x");
    if (e.n == 0) return;
    const auto xs = to_doubles(std::move(*x)), ys = to_doubles(std::move(*y));
    const auto zs = z ? to_doubles(std::move(*z)) : std::vector<double>();
    f.points.reserve(e.n);
    PlaneCheck plane(document_);
    for (std::size_t i = 0; i < e.n; ++i) {
      f.points.push_back({xs[i], ys[i]});
      if (z) plane.add(i, zs[i]);
    }
    if (auto weight = take(e, kPlyWeight)) f.weights = to_doubles(std::move(*weight));
    f.point_data = take_data(e);
    const DataArray* tag = find(f.point_data, kPlyTag);
    const auto tags = tag != nullptr && tag->components == 1 ? to_int32(tag->values) : std::nullopt;
    if (!tags) return;
    static_cast<void>(temper::io::take(f.point_data, kPlyTag));
    for (std::size_t i = 0; i < e.n; ++i) {
      if ((*tags)[i] == 0) continue;
      f.marked_points.add(static_cast<std::int32_t>(i), (*tags)[i]);
    }
  }
  void faces(PlyElement& e) {
    if (e.n > 0 && e.ends.size() != e.n)
      fail(ErrorCode::syntax, contents_.path, "faces have no list vertex_indices, or have two");
    for (const PlyProperty& p : e.properties) {
      if (p.count && p.name != "vertex_indices" && p.name != "vertex_index")
        document_.file.warnings.push_back(text(contents_.path, ": lists ", in_quotes(p.name), " of faces are dropped"));
    }
    const auto tags = document_.file.marked_points.tags;  // of vertices
    CellSorter sorter(document_, allocation_);
    sorter.reserve(e.n);
    std::int32_t start = 0;
    for (std::size_t i = 0; i < e.n; ++i) {
      const auto n = static_cast<std::size_t>(e.ends[i] - start);
      const std::int64_t line = e.text_lines[static_cast<std::int64_t>(i)];
      sorter.add(n == 0   ? 0
                 : n == 1 ? kVtkVertex
                 : n == 2 ? kVtkLine
                          : kVtkPolygon,
                 e.corners.data() + start, n, contents_.binary ? contents_.path : text(contents_.path, ":", line));
      if (n == 3 && !contents_.binary) document_.names->triangle_lines.push_back(line);
      if (n == 2 && !contents_.binary) document_.names->line_lines.push_back(line);
      start = e.ends[i];
    }
    if (!tags.empty() && document_.file.marked_points.size() > tags.size())
      fail(ErrorCode::unsupported, contents_.path,
           "has marked points both as vertices with tags and as faces of one corner");
    sorter.distribute(take_data(e));
    if (!tags.empty()) document_.file.marked_points.tags = tags;
  }
  void edges(PlyElement& e) {
    MeshFile& f = document_.file;
    const auto from = ends_of_edges(e, "vertex1"), to = ends_of_edges(e, "vertex2");
    if (e.n == 0) return;
    if (!f.lines.empty())
      fail(ErrorCode::unsupported, contents_.path, "has edges both as elements and as faces of two corners");
    for (std::size_t i = 0; i < e.n; ++i) f.lines.corners.push_back({from[i], to[i]});
    f.lines.data = take_data(e);
    f.lines.tags = tags_of(f.lines.data, contents_.path);
    f.lines.tags.resize(e.n);
    document_.names->lines = RunLength(0, e.n);
    document_.names->line_lines = e.text_lines;
  }
  std::vector<std::int32_t> ends_of_edges(PlyElement& e, std::string_view name) const {
    const auto values = e.n > 0 ? take(e, name) : Values(std::vector<std::int32_t>());
    const auto ends = values ? to_int32(*values) : std::nullopt;
    if (!ends) fail(ErrorCode::syntax, contents_.path, "edges have no property ", name, " of 32-bit integers");
    return *ends;
  }

  PlyContents contents_;
  Document document_;
  AllocationLimits& allocation_;
};

}  // namespace

Document read_ply(Source& source) { return PlyReader(source).read(); }

}  // namespace temper::io
