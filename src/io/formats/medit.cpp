// medit .mesh, ASCII (INRIA's format, also of Mmg and sfepy, and of BAMG as version 0): a keyword, a count, then that
// many lines.
//
//   Vertices  x y [z] reference        Edges  a b reference        Triangles  a b c reference
//                                                                  Tetrahedra  a b c d reference
//
// Vertices count from 1. The reference of a triangle or tetrahedron is its region, of an edge its tag, and of a vertex,
// when it is not 0, a tag. Corners, Ridges and Required… are lists of numbers; they are kept as uint8 data named
// medit:corner, …
#include <algorithm>

#include "io/conversion/globe.hpp"
#include "io/conversion/known_arrays.hpp"
#include "io/formats/format.hpp"
#include "io/text/scanner.hpp"
#include "io/text/values.hpp"

namespace temper::io {

bool sniff_medit(std::string_view head) {
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && head.substr(first).starts_with("MeshVersionFormatted");
}

namespace {

/// A section that lists elements by number, and the array that remembers it.
struct FlagSection {
  std::string_view keyword;
  Content data;
  std::string_view array;
};
constexpr FlagSection kFlagSections[] = {{"Corners", kPointData, kCorner},
                                         {"RequiredVertices", kPointData, kRequired},
                                         {"Ridges", kLineData, "medit:ridge"},
                                         {"RequiredEdges", kLineData, kRequired},
                                         {"RequiredTriangles", kCellData, kRequired}};

constexpr std::pair<std::string_view, std::string_view> kUnsupported[] = {
    {"Hexahedra", "hexahedron"},
    {"Prisms", "prism"},
    {"Pentahedra", "prism"},
    {"Pyramids", "pyramid"},
    {"TetrahedraP2", "quadratic tetrahedron"},
    {"TrianglesP2", "quadratic triangle"},
    {"EdgesP2", "quadratic edge"},
    {"QuadrilateralsQ2", "quadratic quadrilateral"}};

class MeditReader {
 public:
  explicit MeditReader(Source& source)
      : scanner_(source.path, source.bytes, '#'), document_(new_document(source.path)) {}
  Document read() {
    scanner_.word("MeshVersionFormatted");
    const std::int32_t version = scanner_.integer("the version of the format");
    if (version < 0 || version > 4) {
      scanner_.fail_here(ErrorCode::unsupported, "is medit version ", version, "; temper reads 0 to 4");
    }
    bool ended = false;
    while (!ended && !scanner_.at_end()) {
      const std::string keyword(scanner_.word("a keyword"));
      ended = keyword == "End";
      if (!ended) section(keyword);
    }
    if (!quadrilateral_lines_.empty()) refuse_quadrilaterals();
    if (!ended && document_.file.triangles.empty() && document_.file.tetrahedra.empty())
      scanner_.fail_truncated("the section Triangles or Tetrahedra");
    for (const auto& [flag_section, numbers] : flags_) set_flags(*flag_section, numbers);
    document_.names->points = RunLength(1, document_.file.points.size());
    document_.names->triangles = RunLength(1, document_.file.triangles.size());
    document_.names->lines = RunLength(1, document_.file.lines.size());
    document_.names->tetrahedra = RunLength(1, document_.file.tetrahedra.size());
    return std::move(document_);
  }

 private:
  void section(std::string_view keyword) {
    MeshFile& f = document_.file;
    FileNames& names = *document_.names;
    if (keyword == "Dimension") {
      dimension_ = scanner_.integer("the dimension");
      if (dimension_ != 2 && dimension_ != 3) {
        scanner_.fail_here(ErrorCode::unsupported, "has dimension ", dimension_, "; expected 2 or 3");
      }
    } else if (keyword == "Vertices") {
      vertices();
    } else if (keyword == "Edges") {
      elements("edges", "the reference of an edge", f.lines.corners, f.lines.tags, names.line_lines);
    } else if (keyword == "Triangles") {
      elements("triangles", "the reference of a triangle", f.triangles.corners, f.triangles.tags, names.triangle_lines);
    } else if (keyword == "Quadrilaterals") {
      std::vector<std::array<std::int32_t, 4>> corners;
      std::vector<std::int32_t> references;
      elements("quadrilaterals", "the reference of a quadrilateral", corners, references, quadrilateral_lines_);
    } else if (keyword == "Tetrahedra") {
      Cells<3>& t = f.tetrahedra;
      elements("tetrahedra", "the reference of a tetrahedron", t.corners, t.tags, names.tetrahedron_lines);
    } else {
      for (const FlagSection& flag_section : kFlagSections) {
        if (flag_section.keyword != keyword) continue;
        std::vector<std::int32_t>& numbers = flags_of(flag_section);
        for (std::size_t n = scanner_.count("entries", 2); n > 0; --n)
          numbers.push_back(scanner_.integer("the number of an element"));
        return;
      }
      refuse_or_skip(keyword);
    }
  }
  void vertices() {
    if (dimension_ == 0) scanner_.fail_here(ErrorCode::syntax, "expected Dimension before Vertices");
    MeshFile& f = document_.file;
    if (!f.points.empty()) scanner_.fail_here(ErrorCode::syntax, "expected one section Vertices, found a second one");
    const std::size_t n = scanner_.count("vertices", dimension_ == 2 ? 6 : 8);
    f.points.reserve(n);
    PlaneCheck plane(document_);
    for (std::size_t i = 0; i < n; ++i) {
      const double x = scanner_.real("the x coordinate of a vertex");
      document_.names->points.push_back(static_cast<std::int64_t>(i) + 1);
      document_.names->point_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
      f.points.push_back({x, scanner_.real("the y coordinate of a vertex")});
      if (dimension_ == 3) plane.add(i, scanner_.real("the z coordinate of a vertex"));
      const std::int32_t reference = scanner_.integer("the reference of a vertex");
      if (reference == 0) continue;
      f.marked_points.add(static_cast<std::int32_t>(i), reference);
    }
  }
  /// Reads elements of N vertices; a row has the vertices and the reference.
  template <std::size_t N>
  void elements(std::string_view several, std::string_view reference, std::vector<std::array<std::int32_t, N>>& corners,
                std::vector<std::int32_t>& references, RunLength& lines) {
    const std::size_t n = scanner_.count(several, 2 * (N + 1));
    corners.reserve(n);
    references.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      std::array<std::int32_t, N> row;
      for (std::size_t k = 0; k < N; ++k) {
        row[k] = scanner_.vertex(1);
        if (k == 0) lines.push_back(static_cast<std::int64_t>(scanner_.line()));
      }
      corners.push_back(row);
      references.push_back(scanner_.integer(reference));
    }
  }
  void refuse_or_skip(std::string_view keyword) {
    const bool known_keyword =
        !keyword.empty() && ((keyword[0] >= 'A' && keyword[0] <= 'Z') || (keyword[0] >= 'a' && keyword[0] <= 'z'));
    if (!known_keyword) scanner_.fail_here(ErrorCode::syntax, "expected a keyword, found ", in_quotes(keyword));
    for (const auto& [unsupported, kind] : kUnsupported) {
      if (keyword != unsupported) continue;
      if (scanner_.count("elements", 2) == 0) return;
      scanner_.skip_space();
      refuse_element(scanner_.where(), 1, kind, KindsOfCells::simplices);
    }
    document_.file.warnings.push_back(text(scanner_.where(), ": section ", in_quotes(keyword), " is dropped"));
    for (std::string_view next = scanner_.peek(); !next.empty(); next = scanner_.peek()) {
      if (next.starts_with('"')) {
        static_cast<void>(scanner_.bytes(1, "a quoted text"));
        if (!scanner_.until("\"")) scanner_.fail_truncated("the end of a quoted text");
        continue;
      }
      const bool number = next.find_first_of("0123456789") != std::string_view::npos;
      if (!number) return;
      scanner_.word("a number");
    }
  }
  /// Tetrahedra may come after quadrilaterals, and the cure depends on them.
  [[noreturn]] void refuse_quadrilaterals() const {
    const std::string where = at_line(scanner_.path(), quadrilateral_lines_, 0);
    if (!document_.file.tetrahedra.empty()) refuse_beside_tetrahedra(where, "element 1");
    refuse_element(where, 1, "quadrilateral", KindsOfCells::simplices);
  }
  /// The numbers that sections of this row have listed so far.
  std::vector<std::int32_t>& flags_of(const FlagSection& flag_section) {
    for (auto& [row, numbers] : flags_) {
      if (row == &flag_section) return numbers;
    }
    return flags_.emplace_back(&flag_section, std::vector<std::int32_t>()).second;
  }
  void set_flags(const FlagSection& flag_section, const std::vector<std::int32_t>& numbers) {
    const std::size_t n = count_of(flag_section.data);
    std::vector<std::uint8_t> flags(n);
    for (const std::int32_t number : numbers) {
      if (number < 1 || static_cast<std::size_t>(number) > n) {
        fail(ErrorCode::index_out_of_range, scanner_.path(), flag_section.keyword, " lists number ", number,
             ", but the file has only ", n);
      }
      flags[static_cast<std::size_t>(number) - 1] = 1;
    }
    if (numbers.empty()) return;
    data_of(document_.file, flag_section.data).push_back({std::string(flag_section.array), 1, std::move(flags)});
  }
  [[nodiscard]] std::size_t count_of(Content data) const {
    const MeshFile& f = document_.file;
    return data == kPointData ? f.points.size() : data == kLineData ? f.lines.size() : f.triangles.size();
  }

  Scanner scanner_;
  Document document_;
  int dimension_ = 0;
  RunLength quadrilateral_lines_;
  // Flags may come before the elements that they flag.
  std::vector<std::pair<const FlagSection*, std::vector<std::int32_t>>> flags_;
};

// --- writing ---------------------------------------------------------------------------------------------

void write_flags(Output& out, const MeshFile& f) {
  for (const FlagSection& s : kFlagSections) {
    const DataArray* array = find(data_of(f, s.data), s.array);
    const auto* flags = array == nullptr ? nullptr : std::get_if<std::vector<std::uint8_t>>(&array->values);
    if (flags == nullptr) continue;
    out.put('\n', s.keyword, '\n',
            flags->size() - static_cast<std::size_t>(std::count(flags->begin(), flags->end(), 0)), '\n');
    for (std::size_t i = 0; i < flags->size(); ++i) {
      if ((*flags)[i] != 0) out.put(i + 1, '\n');
    }
  }
}

}  // namespace

Document read_medit(Source& source) { return MeditReader(source).read(); }

bool medit_keeps(Content of, const DataArray& array) {
  return std::any_of(std::begin(kFlagSections), std::end(kFlagSections), [&](const FlagSection& s) {
    return s.data == of && s.array == array.name && scalar_of(array.values) == Scalar::u8;
  });
}

void write_medit(const WriteJob& job) {
  const MeshFile& f = job.file;
  Output& out = job.outputs.open(job.path);
  const bool flat = job.is_flat();
  out.put("MeshVersionFormatted 2\nDimension ", flat ? 2 : 3, "\n\nVertices\n", f.points.size(), '\n');
  const auto references = one_tag_a_point(job);
  for (std::size_t i = 0; i < f.points.size(); ++i) {
    const Vec3 p = job.place(i);
    out.put(p.x, ' ', p.y, ' ');
    if (!flat) out.put(p.z, ' ');
    out.put(references[i], '\n');
  }
  if (!f.lines.empty()) {
    out.put("\nEdges\n", f.lines.size(), '\n');
    for (std::size_t i = 0; i < f.lines.size(); ++i)
      out.put(f.lines[i][0] + 1, ' ', f.lines[i][1] + 1, ' ', f.lines.tags[i], '\n');
  }
  if (f.dimension() == 2 || !f.triangles.empty()) out.put("\nTriangles\n", f.triangles.size(), '\n');
  for (std::size_t i = 0; i < f.triangles.size(); ++i) {
    const auto& t = f.triangles[i];
    out.put(t[0] + 1, ' ', t[1] + 1, ' ', t[2] + 1, ' ', f.triangles.tags.empty() ? 0 : f.triangles.tags[i], '\n');
  }
  if (f.dimension() == 3) {
    out.put("\nTetrahedra\n", f.tetrahedra.size(), '\n');
    const auto& [corners, regions, data] = f.tetrahedra;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto& [a, b, c, d] = corners[i];
      out.put(a + 1, ' ', b + 1, ' ', c + 1, ' ', d + 1, ' ', regions.empty() ? 0 : regions[i], '\n');
    }
  }
  write_flags(out, f);
  out.put("\nEnd\n", "");
}

}  // namespace temper::io
