// The rectangle of a plot, what it shows, and the thin axes around it: ticks outside, labels with units.
//
// Two steps, so that a legend or a color key can ask for room: lay out, then draw.
#pragma once

#include <string>

#include "draw/viewport.hpp"
#include "plot/plot.hpp"
#include "plot/ticks.hpp"

namespace temper {

struct AxesSpec {
  std::string title = {}, x_label = {}, y_label = {};
  PlotRange x = {}, y = {};
  bool log_y = false;
  double width = 480;
  double height = 0;      ///< 0: what the aspect asks for
  double right_room = 0;  ///< pixels to the right of the plot, for a legend or a key
  bool equal_aspect = false;
};

struct Axes {
  static constexpr double kUnit = 0.05;  ///< pixels per step of the grid that paths are written on

  AxesSpec spec;
  Box area;  ///< the plot in pixels, y down: low is the upper left corner
  double width = 0, height = 0;
  Ticks x_ticks, y_ticks;

  /// The place on the page of a point of the plot; not finite when y ≤ 0 on a logarithmic axis.
  [[nodiscard]] Vec2 pixel(Vec2 p) const;
  /// Title, frame, ticks and labels.
  [[nodiscard]] std::string svg() const;
};

[[nodiscard]] Axes lay_out_axes(const AxesSpec& spec);

/// Pixels on the grid of paths.
[[nodiscard]] GridPoint plot_grid(Vec2 pixel);
/// A length in pixels as a number of its steps.
[[nodiscard]] std::string plot_steps(double pixels);
/// A group in which paths on that grid are drawn, cut off at the edges of the box. `id` is unique in the document.
[[nodiscard]] std::string clipped_group(const Box& box, const std::string& id, const std::string& content);

/// A range that can be drawn: finite, and of some length, whatever the input.
[[nodiscard]] PlotRange drawable(PlotRange range, bool logarithmic);

}  // namespace temper
