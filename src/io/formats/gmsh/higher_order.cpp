#include "io/formats/gmsh/higher_order.hpp"

#include <algorithm>
#include <iterator>

#include "io/conversion/kept_points.hpp"
#include "io/formats/gmsh/gmsh.hpp"
#include "io/text/values.hpp"

namespace temper::io {

GmshElementType gmsh_element_type(std::int32_t type) {
  constexpr GmshElementType kHigherOrder[] = {{8, kGmshLine, 1},
                                              {26, kGmshLine, 2},
                                              {27, kGmshLine, 3},
                                              {28, kGmshLine, 4},
                                              {9, kGmshTriangle, 3},
                                              {20, kGmshTriangle, 6},
                                              {21, kGmshTriangle, 7},
                                              {23, kGmshTriangle, 12},
                                              {25, kGmshTriangle, 18},
                                              {16, kGmshQuadrilateral, 4},
                                              {10, kGmshQuadrilateral, 5},
                                              {36, kGmshQuadrilateral, 12},
                                              {37, kGmshQuadrilateral, 21},
                                              {11, kGmshTetrahedron, 6},
                                              {29, kGmshTetrahedron, 16},
                                              {30, kGmshTetrahedron, 31},
                                              {31, kGmshTetrahedron, 52}};
  const auto* const found = std::ranges::find(kHigherOrder, type, &GmshElementType::type);
  return found == std::end(kHigherOrder) ? GmshElementType{type, type} : *found;
}

std::int32_t gmsh_dimension(std::int32_t type) {
  const std::int32_t linear = gmsh_element_type(type).linear;
  return linear == kGmshPoint ? 0 : linear == kGmshLine ? 1 : linear == kGmshTetrahedron ? 3 : 2;
}

std::string gmsh_element_name(std::int32_t type) {
  constexpr std::pair<std::int32_t, std::string_view> kSolids[] = {{5, "hexahedron"},
                                                                   {6, "prism"},
                                                                   {7, "pyramid"},
                                                                   {12, "quadratic hexahedron"},
                                                                   {17, "quadratic hexahedron"},
                                                                   {13, "quadratic prism"},
                                                                   {18, "quadratic prism"},
                                                                   {14, "quadratic pyramid"},
                                                                   {19, "quadratic pyramid"}};
  for (const auto& [solid, name] : kSolids) {
    if (solid == type) return std::string(name);
  }
  return "element of an unknown type";
}

namespace {

/// Returns the points that are kept.
RunLength keep_names(FileNames& names, const std::vector<bool>& keep) {
  RunLength rows, numbers, lines;
  for (std::size_t p = 0; p < keep.size(); ++p) {
    if (!keep[p]) continue;
    const auto row = static_cast<std::int64_t>(p);
    rows.push_back(row);
    numbers.push_back(names.points[row]);
    if (!names.point_lines.empty()) lines.push_back(names.point_lines[row]);
  }
  names.points = std::move(numbers);
  names.point_lines = std::move(lines);
  return rows;
}

}  // namespace

void drop_nodes_between_corners(Document& d, const std::vector<bool>& between) {
  MeshFile& f = d.file;
  std::vector<bool> keep = between;
  keep.resize(f.points.size());
  keep.flip();
  const auto keep_corner = [&keep](std::int32_t p) {
    if (p != kNoCorner) keep[static_cast<std::size_t>(p)] = true;
  };
  std::ranges::for_each(f.marked_points.corners, keep_corner);
  for (const auto& line : f.lines) std::ranges::for_each(line, keep_corner);
  for (const auto& triangle : f.triangles) std::ranges::for_each(triangle, keep_corner);
  for (const auto& tetrahedron : f.tetrahedra) std::ranges::for_each(tetrahedron, keep_corner);
  std::ranges::for_each(d.fourth_corners, keep_corner);

  const VertexOfPoint left(keep);
  const RunLength rows = keep_names(*d.names, keep);
  f.points = kept(f.points, left);
  f.weights = kept(f.weights, left);
  d.heights = kept(d.heights, left);
  for (DataArray& array : f.point_data) array.values = gather(array.values, array.components, rows);
  const auto renumber = [&left](std::int32_t& p) {
    if (p != kNoCorner) p = left[static_cast<std::size_t>(p)];
  };
  std::ranges::for_each(f.marked_points.corners, renumber);
  std::ranges::for_each(d.fourth_corners, renumber);
  f.lines.corners = renumbered(std::move(f.lines.corners), left);
  f.triangles.corners = renumbered(std::move(f.triangles.corners), left);
  f.tetrahedra.corners = renumbered(std::move(f.tetrahedra.corners), left);
  f.warnings.push_back(text(d.names->path,
                            ": elements of higher order are read by their corners: edges become straight, "
                            "and nodes between corners are left out"));
}

}  // namespace temper::io
