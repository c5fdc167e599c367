// OFF (Geomview): the word OFF, the numbers of vertices, faces and edges, then vertices "x y z" and faces "3 a b c".
//
// Vertices count from 0. Letters before the word OFF announce more numbers per vertex (C colors, N normals, ST
// texture). These and the colors of faces are dropped with a warning.
#include <algorithm>

#include "io/conversion/globe.hpp"
#include "io/formats/format.hpp"
#include "io/text/scanner.hpp"

namespace temper::io {
namespace {

/// Says whether the word is OFF with none or some of its prefixes, in their order.
bool is_off_word(std::string_view word) {
  for (const std::string_view prefix : {"ST", "C", "N"}) {
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  }
  return word == "OFF";
}

class OffReader {
 public:
  explicit OffReader(Source& source) : scanner_(source.path, source.bytes, '#'), document_(new_document(source.path)) {}
  Document read() {
    scanner_.word("OFF");
    if (scanner_.more_on_line() && scanner_.peek() == "BINARY")
      scanner_.fail_here(ErrorCode::unsupported, "is an OFF file in binary; temper reads text");
    const std::size_t n = scanner_.count("vertices", 6);
    const std::size_t n_faces = scanner_.count("faces", 4);
    if (scanner_.more_on_line()) scanner_.word("the number of edges");
    vertices(n);
    faces(n_faces);
    if (!scanner_.at_end()) {
      scanner_.fail_here(ErrorCode::syntax, "expected the end of the file after ", n_faces, " faces, found ",
                         in_quotes(scanner_.peek()));
    }
    auto& warnings = document_.file.warnings;
    if (more_of_vertices_ > 0)
      warnings.push_back(text(scanner_.path(), ": colors, normals or textures of vertices are dropped"));
    if (more_of_faces_ > 0) warnings.push_back(text(scanner_.path(), ": colors of faces are dropped"));
    document_.names->triangles = RunLength(0, document_.file.triangles.size());
    return std::move(document_);
  }

 private:
  void vertices(std::size_t n) {
    MeshFile& f = document_.file;
    document_.names->points = RunLength(0, n);
    f.points.reserve(n);
    PlaneCheck plane(document_);
    for (std::size_t i = 0; i < n; ++i) {
      const double x = scanner_.real("the x coordinate of a vertex");
      document_.names->point_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
      f.points.push_back({x, scanner_.real("the y coordinate of a vertex")});
      plane.add(i, scanner_.real("the z coordinate of a vertex"));
      skip_rest(more_of_vertices_);
    }
  }
  void faces(std::size_t n) {
    MeshFile& f = document_.file;
    f.triangles.corners.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      const std::int32_t corners = scanner_.integer("the number of corners of a face");
      if (corners != 3 && corners != 4) {
        scanner_.fail_here(corners > 4 ? ErrorCode::unsupported : ErrorCode::syntax, "face ", i, " has ", corners,
                           " corners; temper reads triangles and quadrilaterals");
      }
      document_.names->triangle_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
      const std::int32_t a = scanner_.vertex(0), b = scanner_.vertex(0);
      const std::int32_t c = scanner_.vertex(0);
      document_.add_face({a, b, c}, corners == 4 ? scanner_.vertex(0) : kNoCorner);
      skip_rest(more_of_faces_);
    }
  }
  /// Skips numbers up to the end of the line.
  void skip_rest(std::size_t& dropped) {
    while (scanner_.more_on_line()) {
      static_cast<void>(scanner_.real("a number"));
      ++dropped;
    }
  }

  Scanner scanner_;
  Document document_;
  std::size_t more_of_vertices_ = 0, more_of_faces_ = 0;
};

}  // namespace

// The title of an ADCIRC grid may begin with any word, so numbers have to follow OFF.
bool sniff_off(std::string_view head) {
  Scanner scanner("", head, '#');
  if (!is_off_word(scanner.peek())) return false;
  static_cast<void>(scanner.word("OFF"));
  const std::string_view next = scanner.peek();
  return next == "BINARY" || (!next.empty() && next.find_first_not_of("0123456789") == std::string_view::npos);
}

Document read_off(Source& source) { return OffReader(source).read(); }

void write_off(const WriteJob& job) {
  const MeshFile& f = job.file;
  Output& out = job.outputs.open(job.path);
  out.put("OFF\n", f.points.size(), ' ', f.triangles.size(), " 0\n");
  for (std::size_t i = 0; i < f.points.size(); ++i) {
    const Vec3 p = job.place(i);
    out.put(p.x, ' ', p.y, ' ', p.z, '\n');
  }
  for (const auto& t : f.triangles) out.put("3 ", t[0], ' ', t[1], ' ', t[2], '\n');
}

}  // namespace temper::io
