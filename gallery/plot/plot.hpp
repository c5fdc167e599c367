// Line plots and contour plots as SVG text, for the landscapes of energies and the histories of runs.
//
// Made for print at 8 cm: series differ by dash and marker as well as by color, bands of a contour plot by
// lightness. The same input gives the same bytes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "temper/detail/vec.hpp"

namespace temper {

struct PlotRange {
  double low = 0, high = 1;
  friend bool operator==(const PlotRange&, const PlotRange&) = default;
};

enum class SeriesStyle {
  line,          ///< solid, or with the dashes of its place among the series
  dashed,        ///< dashed wherever it stands
  markers,       ///< points alone
  line_markers,  ///< both
  step,          ///< constant from each point to the next
};

struct Series {
  std::string name = {};          ///< for the legend; an unnamed series is not in it
  std::vector<Vec2> points = {};  ///< in order; one that is not finite breaks the line
  SeriesStyle style = SeriesStyle::line;
  std::optional<std::string> color = {};  ///< "#rrggbb"; else the next of a color-blind safe list
};

/// A point with a name beside it.
struct PlotMark {
  Vec2 at = {};
  std::string label = {};
};

/// A thin line across the plot, at a value of x (vertical) or of y (horizontal).
struct PlotReference {
  double value = 0;
  std::string label = {};
};

enum class LegendPlace {
  automatic,  ///< the corner with the fewest points, or outside when no corner is free
  outside,    ///< to the right
  none,
};

struct LinePlot {
  std::string title = {};
  std::string x_label = {}, y_label = {};  ///< with units: "sweep", "x / ℓ". _{…} and ^{…} lower and raise
  std::vector<Series> series = {};
  std::optional<PlotRange> x_range = {}, y_range = {};  ///< else what holds all points
  bool log_y = false;                                   ///< points with y ≤ 0 break the line
  double width = 480, height = 340;                     ///< of the document, CSS pixels
  std::vector<PlotMark> marks = {};
  std::vector<PlotReference> vertical = {}, horizontal = {};
  LegendPlace legend = LegendPlace::automatic;
};

/// The plot as a document of its own. O(points).
[[nodiscard]] std::string line_plot_svg(const LinePlot& plot);

/// An overlay of a contour plot: a polyline (not closed unless it ends where it began), dots at its points.
struct PlotOverlay {
  std::vector<Vec2> points = {};
  bool line = true;
  bool dots = true;
  bool dashed = false;
  std::string label = {};  ///< beside the last point
};

enum class LevelSpacing {
  linear,     ///< at round numbers, equally far apart
  geometric,  ///< at 1, 2, 5, 10, … times a power of ten on both sides of zero, up to the extremes
  quantile,   ///< round numbers with about as many samples between each two: for landscapes with steep walls
};

struct ContourPlot {
  std::string title = {};
  std::string x_label = {}, y_label = {};
  PlotRange x_range = {}, y_range = {};
  std::size_t nx = 0, ny = 0;       ///< samples, at both ends of the ranges too; at least 2 each
  std::vector<double> values = {};  ///< value of sample (i, j) at [j nx + i]; not finite: outside, left white
  std::vector<double> levels = {};  ///< ascending; empty: chosen
  LevelSpacing spacing = LevelSpacing::linear;  ///< of chosen levels
  std::size_t n_levels = 12;                    ///< of chosen levels, about
  std::vector<PlotOverlay> overlays = {};
  std::string value_label = {};  ///< of the key
  bool key = true;
  bool line_labels = true;    ///< levels written into the contour lines
  bool equal_aspect = false;  ///< one unit as long in y as in x
  double width = 480;         ///< of the document, CSS pixels
  double height = 0;          ///< 0: from the aspect, or 0.75 of the width
};

/// Filled bands between levels, light to dark upwards, with labeled contour lines, axes and a key.
/// Marching squares on the bilinear surface through the samples. Precondition: values.size() = nx ny. O(values.size() ·
/// levels crossed).
[[nodiscard]] std::string contour_plot_svg(const ContourPlot& plot);

}  // namespace temper
