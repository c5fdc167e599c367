// MFEM mesh v1.0, linear triangles: sections dimension, elements, boundary, vertices; '#' starts a comment.
//
//   elements  count, then a line each: attribute geometry v0 v1 v2      vertices count from 0
//   boundary  the same for edges: they become tagged lines
#include "io/formats/format.hpp"
#include "io/text/scanner.hpp"

namespace temper::io {

bool sniff_mfem(std::string_view head) { return head.starts_with("MFEM mesh v1.0"); }

namespace {

constexpr std::int32_t kSegment = 1, kTriangle = 2;
constexpr std::string_view kGeometries[] = {"point",       "segment", "triangle", "quadrilateral",
                                            "tetrahedron", "cube",    "prism",    "pyramid"};

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
        const std::int32_t dimension = scanner_.integer("the dimension");
        if (dimension != 2)
          scanner_.fail_here(ErrorCode::unsupported, "has elements of dimension ", dimension, "; expected 2",
                             dimension == 3 ? kNextForTetrahedra : "");
      } else if (section == "elements") {
        elements();
      } else if (section == "boundary") {
        boundary();
      } else if (section == "vertices") {
        vertices();
        has_vertices = true;
      } else if (section == "nodes") {
        scanner_.fail_here(ErrorCode::unsupported, "is a curved mesh (section nodes); temper reads linear triangles");
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
    const std::size_t n = scanner_.count("elements", 10);
    f.triangles.corners.reserve(n);
    f.triangles.tags.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      f.triangles.tags.push_back(scanner_.integer("the attribute of an element"));
      document_.names->triangle_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
      const std::int32_t geometry = scanner_.integer("the geometry of an element");
      if (geometry != kTriangle)
        refuse_element(scanner_.where(), static_cast<std::int64_t>(i), geometry_name(geometry),
                       KindsOfCells::triangles);
      const std::int32_t a = scanner_.vertex(0), b = scanner_.vertex(0);
      f.triangles.corners.push_back({a, b, scanner_.vertex(0)});
    }
    document_.names->triangles = RunLength(0, n);
  }
  void boundary() {
    MeshFile& f = document_.file;
    const std::size_t n = scanner_.count("boundary elements", 8);
    for (std::size_t i = 0; i < n; ++i) {
      f.lines.tags.push_back(scanner_.integer("the attribute of a boundary element"));
      document_.names->line_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
      const std::int32_t geometry = scanner_.integer("the geometry of a boundary element");
      if (geometry != kSegment) {
        scanner_.fail_here(ErrorCode::unsupported, "boundary element ", i, " is a ", geometry_name(geometry),
                           "; expected a segment");
      }
      const std::int32_t a = scanner_.vertex(0);
      f.lines.corners.push_back({a, scanner_.vertex(0)});
    }
    document_.names->lines = RunLength(0, n);
  }
  void vertices() {
    MeshFile& f = document_.file;
    const std::size_t n = scanner_.count("vertices", 1);
    if (!scanner_.at_end() && scanner_.peek() == "nodes") {
      scanner_.fail_here(ErrorCode::unsupported, "is a curved mesh (section nodes); temper reads linear triangles");
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
};

}  // namespace

Document read_mfem(Source& source) { return MfemReader(source).read(); }

}  // namespace temper::io
