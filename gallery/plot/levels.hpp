// The levels of a contour plot for which the caller names none, and the colors of the bands between them.
#pragma once

#include <string>
#include <vector>

#include "plot/plot.hpp"

namespace temper {

/// Ascending, without repetition; those that are finite when the caller gave some. Empty when no value is finite or all
/// are equal.
[[nodiscard]] std::vector<double> choose_levels(const ContourPlot& plot);

struct Rgb {
  double r = 0, g = 0, b = 0;  ///< 0 … 1
  /// The brightness of the color in gray print, 0 black … 1 white.
  [[nodiscard]] double gray() const { return 0.299 * r + 0.587 * g + 0.114 * b; }
  [[nodiscard]] std::string text() const;
};

/// The color of a band: from light yellow over green to dark blue, ever darker, for t in [0, 1].
[[nodiscard]] Rgb band_color(double t);

}  // namespace temper
