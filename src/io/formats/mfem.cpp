// MFEM mesh v1.0, linear triangles or tetrahedra: sections dimension, elements, boundary, vertices; '#' starts a
// comment.
//
//   elements  count, then a line each: attribute geometry v0 v1 v2 [v3]      vertices count from 0
//   boundary  the same for edges or faces: they become tagged lines or faces
#include "io/formats/format.hpp"
#include "io/text/scanner.hpp"

namespace temper::io {

bool sniff_mfem(std::string_view head) { return head.starts_with("MFEM mesh v1.0"); }

namespace {

constexpr std::string_view kNextForMfem =
    ". Next: in MFEM's mesh-explorer, c sets the order to 1 and V saves it as VTK";
constexpr std::int32_t kSegment = 1, kTriangle = 2, kTetrahedron = 4;
constexpr std::string_view kGeometries[] = {"point",       "segment",    "triangle", "quadrilateral",
                                            "tetrahedron", "hexahedron", "prism",    "pyramid"};

std::string_view geometry_name(std::int32_t geometry) {
  return geometry >= 0 && geometry < 8 ? kGeometries[geometry] : "element of unknown geometry";
}

class MfemReader {
 public:
  explicit MfemReader(Source& source)
      : scanner_(source.path, source.bytes, '#'), document_(new_document(source.path)) {}
  Document read() {
    scanner_.rest_of_line();
    bool has_vertices = false;
    while (!scanner_.at_end()) {
      const std::string_view section = scanner_.word("a section");
      if (section == "dimension") {
        dimension_ = scanner_.integer("the dimension");
        if (dimension_ != 2 && dimension_ != 3)
          scanner_.fail_here(ErrorCode::unsupported, "has elements of dimension ", dimension_, "; expected 2 or 3");
      } else if (section == "elements") {
        elements();
      } else if (section == "boundary") {
        boundary();
      } else if (section == "vertices") {
        vertices();
        has_vertices = true;
      } else if (section == "nodes") {
        scanner_.fail_here(ErrorCode::unsupported, "is a curved mesh (section nodes); temper reads linear elements",
                           kNextForMfem);
      } else {
        scanner_.fail_here(ErrorCode::syntax, "expected a section of an MFEM mesh, found ", in_quotes(section));
      }
    }
    if (!has_vertices) scanner_.fail_truncated("the section vertices");
    return std::move(document_);
  }

 private:
  void elements() {
    MeshFile& f = document_.file;
    FileNames& names = *document_.names;
    if (dimension_ == 0) scanner_.fail_here(ErrorCode::syntax, "expected the section dimension before elements");
    const auto check = [this](std::int64_t i, std::int32_t geometry) {
      if (geometry != (dimension_ == 2 ? kTriangle : kTetrahedron))
        refuse_element(scanner_.where(), i, geometry_name(geometry),
                       dimension_ == 2 ? KindsOfCells::triangles : KindsOfCells::simplices);
    };
    if (dimension_ == 2) return cells("elements", f.triangles, names.triangles, names.triangle_lines, check);
    cells("elements", f.tetrahedra, names.tetrahedra, names.tetrahedron_lines, check);
  }
  void boundary() {
    MeshFile& f = document_.file;
    FileNames& names = *document_.names;
    const auto check = [this](std::int64_t i, std::int32_t geometry) {
      if (geometry != (dimension_ == 2 ? kSegment : kTriangle))
        scanner_.fail_here(ErrorCode::unsupported, "boundary element ", i, " is a ", geometry_name(geometry),
                           "; expected a ", dimension_ == 2 ? "segment" : "triangle");
    };
    if (dimension_ == 2)
      cells("boundary elements", f.lines, names.lines, names.line_lines, check);
    else
      cells("boundary elements", f.triangles, names.triangles, names.triangle_lines, check);
  }
  /// Reads elements of one dimension. `check` refuses a geometry that is not expected.
  template <int dimension, class Check>
  void cells(std::string_view several, Cells<dimension>& cells, RunLength& numbers, RunLength& lines,
             const Check& check) {
    const std::size_t n = scanner_.count(several, 2 * std::size_t{dimension + 3});
    cells.corners.reserve(n);
    cells.tags.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      cells.tags.push_back(scanner_.integer("the attribute of an element"));
      lines.push_back(static_cast<std::int64_t>(scanner_.line()));
      check(static_cast<std::int64_t>(i), scanner_.integer("the geometry of an element"));
      for (std::int32_t& corner : cells.corners.emplace_back()) corner = scanner_.vertex(0);
    }
    numbers = RunLength(0, n);
  }
  void vertices() {
    MeshFile& f = document_.file;
    const std::size_t n = scanner_.count("vertices", 1);
    if (!scanner_.at_end() && scanner_.peek() == "nodes") {
      scanner_.fail_here(ErrorCode::unsupported, "is a curved mesh (section nodes); temper reads linear elements",
                         kNextForMfem);
    }
    const std::int32_t dimension = scanner_.integer("the number of coordinates of a vertex");
    if (dimension != 2 && dimension != 3) {
      scanner_.fail_here(ErrorCode::unsupported, "vertices have ", dimension, " coordinates; expected 2 or 3");
    }
    scanner_.check_room(n, "vertices", dimension == 2 ? 4 : 6);
    f.points.reserve(n);
    PlaneCheck plane(document_);
    document_.names->points = RunLength(0, n);
    for (std::size_t i = 0; i < n; ++i) {
      const double x = scanner_.real("the x coordinate of a vertex");
      document_.names->point_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
      f.points.push_back({x, scanner_.real("the y coordinate of a vertex")});
      if (dimension == 3) plane.add(i, scanner_.real("the z coordinate of a vertex"));
    }
  }
  Scanner scanner_;
  Document document_;
  std::int32_t dimension_ = 0;
};

}  // namespace

Document read_mfem(Source& source) { return MfemReader(source).read(); }

}  // namespace temper::io
