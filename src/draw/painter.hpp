// What the painters of meshes and of sections share: fills by color, strokes by class.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "draw/panel.hpp"
#include "draw/text.hpp"
#include "draw/viewport.hpp"

namespace temper {

/// Paints cells of any kind: it fills them by color and draws edges, with one path for each class.
class Painter {
 public:
  Painter(const Viewport& viewport, const DrawOptions& options)
      : viewport_(viewport), options_(options), detailed_(viewport.shows_detail()) {}

 protected:
  // Widths, from the median edge: thin enough to see through, thick enough to print.
  static constexpr double kPrimalWidth = 0.018, kLeastPrimal = 0.018, kMostPrimal = 0.07;  // of an edge; of the font
  static constexpr double kDenseWidth = 0.2;  // pixels, where edges are close: bad triangles show through
  static constexpr double kConstrainedTimes = 2.5, kOutlineWidth = 0.08;  // of a plain edge; of the font size
  static constexpr double kSeam = 0.3;  // pixels: hides the hairlines between filled neighbors
  static constexpr double kSpot = 3;    // pixels added around bad triangles too small and too few to be seen
  static constexpr double kFew = 0.02;  // of all triangles

  /// Paths of filled cells: one for each color of the scale, and one for bad cells.
  struct Fills {
    std::array<PathText, kScaleColors.size()> colors;
    PathText bad;
  };

  [[nodiscard]] double primal_width() const {
    const double em = viewport_.em;
    return detailed_ ? std::clamp(kPrimalWidth * viewport_.edge, kLeastPrimal * em, kMostPrimal * em) : kDenseWidth;
  }
  void add_segment(PathText& path, const Segment& segment) const {
    const auto seen = clip(segment, viewport_.clip);
    if (seen) path.segment(viewport_.grid(seen->from), viewport_.grid(seen->to));
  }
  void add_polygon(PathText& path, std::vector<Vec2> polygon) const {
    polygon = clip(std::move(polygon), viewport_.clip);
    if (polygon.empty()) return;
    path.move_to(viewport_.grid(polygon[0]));
    for (std::size_t i = 1; i < polygon.size(); ++i) path.line_to(viewport_.grid(polygon[i]));
    path.close();
  }

  /// The place in the picture of a visible point that is in the box, or within `radius` of it.
  [[nodiscard]] std::optional<Vec2> seen(const WeightedPoint& p, double radius = 0) const {
    const Vec2 at = viewport_.view.at(p);
    if (!viewport_.view.shows(p) || !meets(at, radius, viewport_.box)) return std::nullopt;
    return at;
  }
  // Dashes distinguish the signs without color.
  [[nodiscard]] std::string dashes(double width) const {
    return "stroke-dasharray=\"" + short_number(4 * width / viewport_.unit) + " " +
           short_number(2 * width / viewport_.unit) + "\" ";
  }

  void stroke(const PathText& path, const char* name, const char* color, double width, const char* more = "") {
    if (path.empty()) return;
    panel_.svg += std::string("<path class=\"") + name + "\" fill=\"none\" stroke=\"" + color + "\" stroke-width=\"" +
                  short_number(width / viewport_.unit) + "\" " + more + "d=\"" + path.text() + "\"/>\n";
  }
  void fill(const PathText& path, const char* name, const std::string& color, double stroke_width = kSeam) {
    if (path.empty()) return;
    panel_.svg += std::string("<path class=\"") + name + "\" fill=\"" + color + "\" stroke=\"" + color +
                  "\" stroke-width=\"" + short_number(stroke_width / viewport_.unit) + "\" d=\"" + path.text() +
                  "\"/>\n";
  }
  void fill(const Fills& fills) {
    for (std::size_t i = 0; i < fills.colors.size(); ++i)
      fill(fills.colors[i], options_.colors ? "value" : "margin", kScaleColors[i]);
    const bool few = static_cast<double>(panel_.bad) < kFew * static_cast<double>(panel_.elements);
    fill(fills.bad, "bad", detailed_ ? hatched(viewport_, 1 / viewport_.unit) : Palette::warning,
         few && !detailed_ ? kSpot : kSeam);
  }
  /// The domain boundary and what else the optimizer keeps is thicker.
  void stroke_edges(const PathText& plain, const PathText& kept) {
    stroke(plain, "primal", Palette::primal, primal_width());
    stroke(kept, "constrained", Palette::outline,
           std::max(kConstrainedTimes * primal_width(), kOutlineWidth * viewport_.em), "stroke-linecap=\"round\" ");
  }

  const Viewport& viewport_;
  const DrawOptions& options_;
  bool detailed_;
  Panel panel_;
};

}  // namespace temper
