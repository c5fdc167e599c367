// Line plots: curves cut at the frame, told apart by dash and marker as well as by color.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "draw/text.hpp"
#include "draw/viewport.hpp"
#include "plot/axes.hpp"
#include "plot/plot.hpp"

namespace temper {
namespace {

constexpr double kCurveWidth = 1.6, kReferenceWidth = 0.8;  // pixels
constexpr double kMarker = 3.2;                             // half its width
constexpr double kPad = 0.05;                               // of the height, above and below the points
constexpr double kSample = 36;                              // of the line in a legend
constexpr double kRow = kPlotFont + 5;                      // of a legend
constexpr double kLegendGap = 8;                            // around it
constexpr double kClipMargin = 4;                           // pixels beyond the frame that a curve is written

// Dark enough for print, in an order in which neighbors differ in gray too; from the palette of meshes.
constexpr std::array<const char*, 7> kColors = {"#005fa3", "#c8320a", "#222222", "#00845f",
                                                "#b0389a", "#e88a00", "#4aa3df"};

struct Dash {
  std::array<double, 6> pixels = {};
  std::size_t n = 0;
};
constexpr std::array<Dash, 6> kDashes = {
    Dash{}, {{7, 3}, 2}, {{2, 2.5}, 2}, {{9, 3, 2, 3}, 4}, {{14, 4}, 2}, {{9, 3, 2, 3, 2, 3}, 6}};

enum class Marker { disc, square, triangle, diamond, ring, cross };
constexpr std::size_t kMarkers = 6;

struct Look {
  std::string color;
  Dash dash;
  Marker marker = Marker::disc;
  bool line = true, markers = false;
};

Look look_of(const Series& series, std::size_t i) {
  Look look;
  look.color = series.color.value_or(kColors[i % kColors.size()]);
  look.dash = kDashes[series.style == SeriesStyle::dashed ? 1 : i % kDashes.size()];
  look.marker = static_cast<Marker>(i % kMarkers);
  look.line = series.style != SeriesStyle::markers;
  look.markers = series.style == SeriesStyle::markers || series.style == SeriesStyle::line_markers;
  return look;
}

void add_polygon(PathText& path, Vec2 at, std::span<const Vec2> corners) {
  path.move_to(plot_grid(at + kMarker * corners[0]));
  for (const Vec2 c : corners.subspan(1)) path.line_to(plot_grid(at + kMarker * c));
  path.close();
}

void add_marker(PathText& path, Marker marker, Vec2 at) {
  constexpr std::array<Vec2, 4> kSquareMark = {Vec2{-0.9, -0.9}, {0.9, -0.9}, {0.9, 0.9}, {-0.9, 0.9}};
  constexpr std::array<Vec2, 3> kTriangle = {Vec2{0, -1.2}, {1.1, 0.8}, {-1.1, 0.8}};
  constexpr std::array<Vec2, 4> kDiamond = {Vec2{0, -1.3}, {1.3, 0}, {0, 1.3}, {-1.3, 0}};
  switch (marker) {
    case Marker::disc:
    case Marker::ring:
      return path.circle(plot_grid(at), std::llround(kMarker / Axes::kUnit));
    case Marker::square:
      return add_polygon(path, at, kSquareMark);
    case Marker::triangle:
      return add_polygon(path, at, kTriangle);
    case Marker::diamond:
      return add_polygon(path, at, kDiamond);
    case Marker::cross:
      path.segment(plot_grid(at + Vec2{-kMarker, -kMarker}), plot_grid(at + Vec2{kMarker, kMarker}));
      return path.segment(plot_grid(at + Vec2{-kMarker, kMarker}), plot_grid(at + Vec2{kMarker, -kMarker}));
  }
}

std::string dash_attribute(const Dash& dash) {
  if (dash.n == 0) return "";
  std::string text = " stroke-dasharray=\"";
  for (std::size_t i = 0; i < dash.n; ++i) text += (i == 0 ? "" : " ") + plot_steps(dash.pixels[i]);
  return text + "\"";
}

std::string curve_svg(const PathText& path, const Look& look, const char* name) {
  if (path.empty()) return "";
  return std::string("<path class=\"") + name + "\" fill=\"none\" stroke=\"" + xml_text(look.color) +
         "\" stroke-width=\"" + plot_steps(kCurveWidth) + "\"" + dash_attribute(look.dash) + " d=\"" + path.text() +
         "\"/>\n";
}

std::string markers_svg(const PathText& path, const Look& look) {
  if (path.empty()) return "";
  const bool open = look.marker == Marker::ring || look.marker == Marker::cross;
  const std::string color = xml_text(look.color);
  return "<path class=\"markers\" fill=\"" + std::string(open ? "#ffffff" : color) + "\" stroke=\"" + color +
         "\" stroke-width=\"" + plot_steps(open ? kCurveWidth : kReferenceWidth) + "\" d=\"" + path.text() + "\"/>\n";
}

bool drawn(const LinePlot& plot, Vec2 p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && (!plot.log_y || p.y > 0);
}

struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void take(double v) {
    low = std::min(low, v);
    high = std::max(high, v);
  }
  [[nodiscard]] PlotRange range() const { return {low, high}; }
};

PlotRange x_range(const LinePlot& plot) {
  if (plot.x_range) return drawable(*plot.x_range, false);
  Extent extent;
  for (const Series& series : plot.series) {
    for (const Vec2 p : series.points) {
      if (drawn(plot, p)) extent.take(p.x);
    }
  }
  return drawable(extent.range(), false);
}

// The range of y that the points within the range of x need, and a little more.
PlotRange y_range(const LinePlot& plot, const PlotRange& x) {
  if (plot.y_range) return drawable(*plot.y_range, plot.log_y);
  Extent extent;
  for (const Series& series : plot.series) {
    for (const Vec2 p : series.points) {
      if (drawn(plot, p) && p.x >= x.low && p.x <= x.high) extent.take(p.y);
    }
  }
  for (const PlotReference& reference : plot.horizontal) {
    if (drawn(plot, {0, reference.value})) extent.take(reference.value);
  }
  const PlotRange range = drawable(extent.range(), plot.log_y);
  if (plot.log_y) {
    const double pad = std::pow(range.high / range.low, kPad);
    return {range.low / pad, range.high * pad};
  }
  const double pad = kPad * (range.high - range.low);
  return {range.low - pad, range.high + pad};
}

class LinePainter {
 public:
  explicit LinePainter(const LinePlot& plot) : plot_(plot) {
    spec_ = {.title = plot.title, .x_label = plot.x_label, .y_label = plot.y_label, .x = x_range(plot)};
    spec_.y = y_range(plot, spec_.x);
    spec_.log_y = plot.log_y;
    spec_.width = plot.width;
    spec_.height = plot.height;
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
      looks_.push_back(look_of(plot.series[i], i));
      if (!plot.series[i].name.empty()) named_.push_back(i);
    }
  }

  std::string paint() {
    axes_ = lay_out_axes(spec_);
    std::optional<Vec2> corner;
    if (!named_.empty() && plot_.legend != LegendPlace::none) {
      if (plot_.legend == LegendPlace::automatic) corner = free_corner();
      if (!corner) {
        spec_.right_room = legend_width() + kLegendGap;
        axes_ = lay_out_axes(spec_);
        corner = Vec2{axes_.area.high.x + kLegendGap, axes_.area.low.y};
      }
    }
    std::string curves = references();
    for (std::size_t i = 0; i < plot_.series.size(); ++i) curves += draw(plot_.series[i], looks_[i]);
    std::string svg = clipped_group(axes_.area, "plot", curves) + axes_.svg() + reference_labels() + marks();
    if (corner) svg += legend(*corner);
    return picture_document(axes_.width, axes_.height, svg);
  }

 private:
  // Segments of a series in pixels; a step is two of them.
  template <class Visit>
  void for_each_segment(const Series& series, Visit&& visit) const {
    for (std::size_t k = 1; k < series.points.size(); ++k) {
      const Vec2 a = series.points[k - 1], b = series.points[k];
      if (!drawn(plot_, a) || !drawn(plot_, b)) continue;
      const Vec2 from = axes_.pixel(a), to = axes_.pixel(b);
      if (series.style == SeriesStyle::step) {
        visit(Segment{from, {to.x, from.y}});
        visit(Segment{{to.x, from.y}, to});
      } else {
        visit(Segment{from, to});
      }
    }
  }

  [[nodiscard]] std::string draw(const Series& series, const Look& look) const {
    PathText line, markers;
    const Vec2 margin = {kClipMargin, kClipMargin};
    const Box box = {axes_.area.low - margin, axes_.area.high + margin};
    if (look.line) {
      for_each_segment(series, [&](const Segment& s) {
        if (const auto seen = clip(s, box)) line.segment(plot_grid(seen->from), plot_grid(seen->to));
      });
    }
    if (look.markers) {
      for (const Vec2 p : series.points) {
        if (drawn(plot_, p) && meets(axes_.pixel(p), 0, box)) add_marker(markers, look.marker, axes_.pixel(p));
      }
    }
    return curve_svg(line, look, "curve") + markers_svg(markers, look);
  }

  [[nodiscard]] bool shown(double value, bool vertical) const {
    const PlotRange range = vertical ? axes_.spec.x : axes_.spec.y;
    return value >= range.low && value <= range.high;
  }

  [[nodiscard]] std::string references() const {
    PathText path;
    for (const PlotReference& reference : plot_.vertical) {
      if (!shown(reference.value, true)) continue;
      const double x = axes_.pixel({reference.value, axes_.spec.y.low}).x;
      path.segment(plot_grid({x, axes_.area.low.y}), plot_grid({x, axes_.area.high.y}));
    }
    for (const PlotReference& reference : plot_.horizontal) {
      if (!shown(reference.value, false)) continue;
      const double y = axes_.pixel({axes_.spec.x.low, reference.value}).y;
      path.segment(plot_grid({axes_.area.low.x, y}), plot_grid({axes_.area.high.x, y}));
    }
    if (path.empty()) return "";
    return "<path class=\"reference\" fill=\"none\" stroke=\"#8a8a8a\" stroke-width=\"" + plot_steps(kReferenceWidth) +
           "\"" + dash_attribute({{3, 3}, 2}) + " d=\"" + path.text() + "\"/>\n";
  }

  // On white, so that curves may run below.
  [[nodiscard]] static TextLook halo(const char* anchor) {
    return {.anchor = anchor,
            .size = kPlotSmallFont,
            .more = "paint-order=\"stroke\" stroke=\"#ffffff\" stroke-width=\"3\" stroke-linejoin=\"round\""};
  }

  [[nodiscard]] std::string reference_labels() const {
    std::string svg;
    for (const PlotReference& reference : plot_.vertical) {
      if (reference.label.empty() || !shown(reference.value, true)) continue;
      const double x = axes_.pixel({reference.value, axes_.spec.y.low}).x;
      const bool left = x + 4 + text_width(reference.label, kPlotSmallFont) > axes_.area.high.x;
      svg += text_element({left ? x - 4 : x + 4, axes_.area.low.y + kPlotSmallFont + 3}, reference.label,
                          halo(left ? "end" : "start"));
    }
    for (const PlotReference& reference : plot_.horizontal) {
      if (reference.label.empty() || !shown(reference.value, false)) continue;
      const double y = axes_.pixel({axes_.spec.x.low, reference.value}).y;
      const bool below = y - 4 - kPlotSmallFont < axes_.area.low.y;
      svg +=
          text_element({axes_.area.high.x - 4, below ? y + kPlotSmallFont + 2 : y - 4}, reference.label, halo("end"));
    }
    return svg;
  }

  [[nodiscard]] std::string marks() const {
    std::string svg;
    for (const PlotMark& mark : plot_.marks) {
      const Vec2 at = axes_.pixel(mark.at);
      if (!drawn(plot_, mark.at) || !meets(at, 0, axes_.area)) continue;
      svg += "<circle class=\"mark\" cx=\"" + short_number(at.x) + "\" cy=\"" + short_number(at.y) +
             "\" r=\"3.5\" stroke=\"#ffffff\"/>\n";
      const bool left = at.x + 7 + text_width(mark.label, kPlotSmallFont) > axes_.area.high.x;
      const bool below = at.y - 5 - kPlotSmallFont < axes_.area.low.y;
      svg += text_element({left ? at.x - 7 : at.x + 7, below ? at.y + 5 + 0.8 * kPlotSmallFont : at.y - 5}, mark.label,
                          halo(left ? "end" : "start"));
    }
    return svg;
  }

  [[nodiscard]] double legend_width() const {
    double width = 0;
    for (const std::size_t i : named_) width = std::max(width, text_width(plot_.series[i].name, kPlotFont));
    return kSample + 6 + width;
  }
  [[nodiscard]] double legend_height() const { return kRow * static_cast<double>(named_.size()); }

  // The corner of the plot that no curve runs through, upper right first; nothing when there is none.
  [[nodiscard]] std::optional<Vec2> free_corner() const {
    const Vec2 size = {legend_width(), legend_height()};
    const Box inner = {axes_.area.low + Vec2{kLegendGap, kLegendGap},
                       axes_.area.high - Vec2{kLegendGap, kLegendGap} - size};
    if (inner.low.x > inner.high.x || inner.low.y > inner.high.y) return std::nullopt;
    for (const Vec2 corner : {Vec2{inner.high.x, inner.low.y}, inner.low, inner.high, {inner.low.x, inner.high.y}}) {
      const Vec2 margin = {kLegendGap / 2, kLegendGap / 2};
      if (is_free({corner - margin, corner + size + margin})) return corner;
    }
    return std::nullopt;
  }

  [[nodiscard]] bool is_free(const Box& box) const {
    bool free = true;
    for (const Series& series : plot_.series) {
      for_each_segment(series, [&](const Segment& s) { free = free && !clip(s, box); });
      for (const Vec2 p : series.points) free = free && !(drawn(plot_, p) && meets(axes_.pixel(p), kMarker, box));
    }
    for (const PlotMark& mark : plot_.marks) {
      const double reach = 14 + text_width(mark.label, kPlotSmallFont);
      free = free && !(drawn(plot_, mark.at) && meets(axes_.pixel(mark.at), reach, box));
    }
    for (const PlotReference& reference : plot_.vertical) {
      const double x = axes_.pixel({reference.value, axes_.spec.y.low}).x;
      free = free && (x < box.low.x || x > box.high.x);
    }
    for (const PlotReference& reference : plot_.horizontal) {
      const double y = axes_.pixel({axes_.spec.x.low, reference.value}).y;
      free = free && (y + kPlotSmallFont < box.low.y || y - kPlotSmallFont > box.high.y);
    }
    return free;
  }

  [[nodiscard]] std::string legend(Vec2 corner) const {
    std::string samples, names;
    double y = corner.y + kRow / 2;
    for (const std::size_t i : named_) {
      const Look& look = looks_[i];
      PathText line, markers;
      if (look.line) line.segment(plot_grid({corner.x, y}), plot_grid({corner.x + kSample, y}));
      if (look.markers) add_marker(markers, look.marker, {corner.x + kSample / 2, y});
      samples += curve_svg(line, look, "sample") + markers_svg(markers, look);
      names += text_element({corner.x + kSample + 6, y + 0.36 * kPlotFont}, plot_.series[i].name);
      y += kRow;
    }
    return "<g class=\"legend\">\n<g transform=\"scale(" + short_number(Axes::kUnit) + ")\">\n" + samples + "</g>\n" +
           names + "</g>\n";
  }

  const LinePlot& plot_;
  AxesSpec spec_;
  Axes axes_;
  std::vector<Look> looks_;
  std::vector<std::size_t> named_;  // series in the legend
};

}  // namespace

std::string line_plot_svg(const LinePlot& plot) { return LinePainter(plot).paint(); }

}  // namespace temper
