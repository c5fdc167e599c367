// The HTML report: one file without anything from the network, in which a browser shows a mesh, or two to compare, with
// the numbers of a report beside them (docs/report.md).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "temper/mesh.hpp"

namespace temper::io {

/// A mesh of an HTML report.
struct HtmlMesh {
  const Mesh& mesh;
  const InputNames* names = nullptr;  ///< the user's numbers of vertices and triangles; null: counted from 0
};

struct HtmlReport {
  HtmlMesh mesh;
  std::optional<HtmlMesh> before = {};  ///< to compare the mesh with
  std::string_view title;               ///< UTF-8 or nearly so
  /// A JSON object of what the page shows besides the meshes; docs/report.md names its keys, each of which may be
  /// missing.
  std::string_view json = "{}";
};

/// The page, as UTF-8. The arrays of the meshes are in it whole: doubles to the last bit, compressed by zlib and in
/// base64; with them the exact verdict on each triangle. About 40 bytes a triangle. The same bytes for the same report.
/// Precondition: no erased triangles; the meshes lie in the plane. O(n).
[[nodiscard]] std::string html_report(const HtmlReport& report);

}  // namespace temper::io
