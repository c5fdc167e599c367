// Drawings of a mesh with marks on it, as the paper has them: vertices that go or stay, cavities that flip.
#pragma once

#include <string>
#include <vector>

#include "experiments/recording.hpp"
#include "temper/draw.hpp"
#include "temper/mesh.hpp"

namespace temper::gallery {

/// A disc on a vertex, with a name beside it.
struct Mark {
  Vec2 at;
  std::string color;
  std::string label = {};
};

/// A triangle filled with a color.
struct Shade {
  TriangleId triangle;
  std::string color;
};

struct MeshPicture {
  std::string title = {};   ///< above the mesh
  std::string footer = {};  ///< below it
  Box box = {{-2.12, -0.12}, {2.12, 4.12}};
  double width = 300;       ///< pixels
  bool dual = true;         ///< edges of the power diagram
  double weight_scale = 0;  ///< factor on the radius √|w| of weight circles, green positive, red negative; 0: none
  bool inverted = true;     ///< fill triangles that are turned over
  std::vector<Shade> shades = {};
  std::vector<Mark> marks = {};
};

/// Colors of marks, as in the paper where it names them.
struct MarkColor {
  static constexpr const char* removed = "#d62728";
  static constexpr const char* kept = "#7b3fa0";
  static constexpr const char* kept_before = "#57c46a";
  static constexpr const char* kept_long_before = "#14672a";
  static constexpr const char* collapses_next = "#f28e1c";
  static constexpr const char* moving = "#1f6fd6";
  static constexpr const char* cavity = "#d9c3ea";
};

[[nodiscard]] std::string mesh_picture_svg(const Mesh& mesh, const MeshPicture& picture);

/// A disc on the vertex with that number in the input, unless it has been removed.
void add_mark(MeshPicture& picture, const Moment& moment, VertexId input, const char* color);

/// The triangles that the other moment has not.
[[nodiscard]] std::vector<Shade> cavities(const Moment& here, const Moment& there);

}  // namespace temper::gallery
