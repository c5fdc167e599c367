// Pictures of primal-dual meshes, as SVG text.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "temper/detail/cells.hpp"
#include "temper/detail/tensor.hpp"
#include "temper/mesh.hpp"
#include "temper/quality.hpp"

namespace temper {

/// A rectangle in the user's coordinates.
struct Box {
  Vec2 low, high;
};

/// Colors of triangles by a number, from dark to light over the values in all panels: light is good. Infinite values do
/// not count for the scale and get the color of its nearest end. NaN has no color.
struct TriangleColors {
  std::string label;                                 ///< Label next to the scale
  std::vector<IdVector<TriangleId, double>> values;  ///< Value of each triangle, for each panel
  Preference better = Preference::larger;            ///< With `less` the least values are light, else the greatest
};

/// A line on faces of power cells, such as a fault.
struct FaceLine {
  std::string name;  ///< Name next to the line; may be empty
  std::vector<std::array<Vec2, 2>> pieces;
};

/// Cells filled by their regions, in the place of triangles. Colors repeat after the eighth region.
struct RegionCells {
  std::vector<CellPolygons> panels;                ///< Cells of each panel, in a plane
  std::map<std::int32_t, std::string> names = {};  ///< Names of regions, for the legend
  std::vector<std::vector<FaceLine>> lines = {};   ///< Lines on faces of the cells of each panel; empty: none
};

struct DrawOptions {
  bool primal = true;  ///< Edges of the triangulation; the boundary and constrained edges are thicker
  bool dual = true;    ///< Edges of the power diagram, between orthocenters; dashed where their length is negative
  /// Hatch bad triangles, which are not well-centered, and tint the others by their margin: the least of h/ℓ, d/ℓ and
  /// 1 − d/ℓ.
  bool fill = true;
  bool weights = false;         ///< Circles of radius √|w|: solid for positive, dashed for negative weights
  double weight_scale = 1;      ///< Factor on the radius of weight circles
  bool near_coincident = true;  ///< Draw rings around vertices that nearly coincide with a neighbor
  bool vertex_numbers = false;
  std::optional<TriangleColors> colors = {};  ///< Colors instead of margins and bad triangles
  std::optional<RegionCells> cells = {};      ///< Cells instead of triangles; `fill` and `colors` then have no effect
  /// The meshes in the planes of diffusion tensors, one for each panel: duals and margins are those of the metrics, in
  /// the plane of the mesh. There are no weight circles then. Empty: without tensors.
  std::vector<MetricMesh> pieces = {};
  std::optional<Box> zoom = {};  ///< Box that the picture shows
  /// Middle of the picture for a sphere: longitude and latitude [degrees]. None: the middle of a mesh that is a part of
  /// the sphere, else 0, 0. Parts behind the limb are not drawn. A zoom box is in the plane of the picture [length],
  /// from its middle to the right and up.
  std::optional<Vec2> view = {};
  double width = 900;      ///< Width of one panel [CSS pixels]
  std::string title = {};  ///< Title above the picture
};

/// Draws one panel. Dots mark fixed vertices inside that are on no line, such as wells.
[[nodiscard]] std::string draw_svg(const Mesh& mesh, const DrawOptions& options = {});
/// Draws two panels next to each other, with one scale, one view and one zoom box. Precondition: both meshes lie in the
/// plane, or both on spheres.
[[nodiscard]] std::string draw_before_after_svg(const Mesh& before, const Mesh& after, const DrawOptions& options = {});

/// Puts SVG documents next to each other in rows of `columns`, under a title. Each keeps its size, and a column is as
/// wide as its widest picture. Ids and references get prefixes, so that they stay unique.
[[nodiscard]] std::string grid_svg(std::span<const std::string> svgs, std::size_t columns,
                                   const std::string& title = {});

}  // namespace temper
