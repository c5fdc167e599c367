// Pictures of primal-dual meshes, as SVG text.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "temper/mesh.hpp"

namespace temper {

/// A rectangle in the user's coordinates.
struct Box {
  Vec2 low, high;
};

/// Triangles filled by a number, from dark for the least to light for the greatest of all panels. Values that are not
/// finite do not count for the scale, and have the color of the end that they are beyond; NaN has none.
struct TriangleColors {
  std::string label;                                 ///< under the scale
  std::vector<IdVector<TriangleId, double>> values;  ///< one for each panel
};

struct DrawOptions {
  bool primal = true;           ///< edges of the triangulation
  bool dual = true;             ///< edges of the power diagram, between orthocenters
  bool weights = true;          ///< circles of radius √|w|: green positive, red negative
  double weight_scale = 1;      ///< factor on the radius of weight circles
  bool bad_triangles = true;    ///< fill triangles that are not well-centered
  bool near_coincident = true;  ///< ring vertices that nearly coincide with a neighbor
  bool regions = true;          ///< tint regions, draw constrained edges thicker
  bool vertex_numbers = false;
  std::optional<TriangleColors> colors = {};  ///< instead of bad triangles and regions
  std::optional<Box> zoom = {};               ///< draw only what meets this box
  /// Of a sphere: longitude and latitude of the middle of the picture [degrees]. None: the middle of a mesh that is a
  /// part of the sphere, else 0, 0. What is behind the limb is not drawn. A zoom box is in the picture: [length], from
  /// its middle to the right and up.
  std::optional<Vec2> view = {};
  double width = 900;      ///< of one panel, in CSS pixels
  std::string title = {};  ///< under the picture
};

/// One panel.
[[nodiscard]] std::string draw_svg(const Mesh& mesh, const DrawOptions& options = {});
/// Two panels side by side, to one scale, one view and one zoom box. Precondition: both lie in the plane, or on
/// spheres.
[[nodiscard]] std::string draw_before_after_svg(const Mesh& before, const Mesh& after, const DrawOptions& options = {});

/// Puts SVG documents side by side in rows of `columns`, under a title. Ids and the references to them are prefixed, so
/// that they stay unique; each keeps its size, cells are as wide as the widest of their column.
[[nodiscard]] std::string grid_svg(std::span<const std::string> svgs, std::size_t columns,
                                   const std::string& title = {});

}  // namespace temper
