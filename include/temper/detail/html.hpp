// The HTML report: one file that needs nothing from the network. A browser shows in it a mesh, or two meshes to
// compare, next to the numbers of a report (docs/reference/formats/report.md).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "temper/mesh.hpp"
#include "temper/tets/mesh.hpp"

namespace temper::io {

/// A mesh of an HTML report.
struct HtmlMesh {
  const Mesh& mesh;
  const InputNames* names = nullptr;  ///< Numbers of vertices and triangles for the user; null: counted from 0
};

/// A mesh of tetrahedra, which the page shows as cuts by planes.
struct HtmlTets {
  const tets::TetMesh& mesh;
  const tets::InputNames* names = nullptr;  ///< Numbers of vertices and tetrahedra for the user; null: counted from 0
};
using AnyHtmlMesh = std::variant<HtmlMesh, HtmlTets>;

struct HtmlReport {
  AnyHtmlMesh mesh;
  std::optional<AnyHtmlMesh> before = {};  ///< Mesh for comparison, of the same kind
  std::string_view title;                  ///< Title, in UTF-8; wrong bytes are passed on
  /// Further contents of the page as a JSON object. docs/reference/formats/report.md names its keys; each may be
  /// missing.
  std::string_view json = "{}";
};

/// Returns the page as UTF-8. It has the complete arrays of the meshes (doubles to the last bit, compressed by zlib and
/// in base64) and the exact verdict on each element. About 40 bytes per triangle, 20 per tetrahedron. Equal reports
/// give equal bytes. Preconditions: no erased triangles; meshes of triangles lie in the plane. O(n).
[[nodiscard]] std::string html_report(const HtmlReport& report);

}  // namespace temper::io
