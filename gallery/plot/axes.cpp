#include "plot/axes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "draw/text.hpp"
#include "draw/viewport.hpp"

namespace temper {
namespace {

constexpr double kTick = 5, kMinorTick = 3;    // length, pixels
constexpr double kLineWidth = 0.8;             // of the axes
constexpr double kLabelGap = 4;                // between a tick and its label
constexpr double kBorder = 8;                  // free around everything
constexpr double kTitleRoom = kPlotFont + 12;  // above the plot
constexpr double kTicksBelow = kTick + kLabelGap + kPlotFont;
constexpr double kPerXTick = 50, kPerYTick = 36;        // pixels between ticks, at least
constexpr double kBetweenLabels = 14;                   // pixels of white between labels of x, at least
constexpr double kLeastSide = 40;                       // of the plot, whatever has to fit around it
constexpr double kUsualAspect = 0.72;                   // height over width when nothing else decides
constexpr double kSmallest = 1e-280, kLargest = 1e280;  // what ticks can count in without overflow
constexpr double kRelativeSpan = 1e-12;                 // of the magnitude: a shorter range is a point to doubles' eyes

double label_room(const Ticks& ticks) {
  double room = 0;
  for (const Tick& tick : ticks.ticks) room = std::max(room, text_width(tick.label, kPlotFont));
  return room;
}

std::string with_exponent(const std::string& label, int exponent) {
  if (exponent == 0) return label;
  const std::string power = "10^{" + fixed_label(exponent, 0) + "}";
  return label.empty() ? "× " + power : label + "  (" + power + ")";
}

Ticks y_ticks(const AxesSpec& spec, double height) {
  const double most = std::max(2.0, height / kPerYTick);
  return spec.log_y ? log_ticks(spec.y, most) : linear_ticks(spec.y, most);
}

// As many as their labels leave room for.
Ticks x_ticks(const PlotRange& range, double width) {
  for (double most = std::max(2.0, width / kPerXTick);; most *= 0.75) {
    Ticks ticks = linear_ticks(range, std::max(most, 1.0));
    const double apart = width * nice_step(range.high - range.low, std::max(most, 1.0)) / (range.high - range.low);
    if (most <= 1 || label_room(ticks) + kBetweenLabels <= apart) return ticks;
  }
}

// Text no wider than this: smaller when it has to be.
double fitting_size(const std::string& label, double room) {
  const double wide = text_width(label, kPlotFont);
  return wide > room ? kPlotFont * room / wide : kPlotFont;
}

// As a number with the fewest digits: attributes are read by people too.
std::string line(Vec2 a, Vec2 b) {
  return "M" + short_number(a.x) + " " + short_number(a.y) +
         (a.y == b.y ? "H" + short_number(b.x) : "V" + short_number(b.y));
}

}  // namespace

PlotRange drawable(PlotRange range, bool logarithmic) {
  if (range.low > range.high) std::swap(range.low, range.high);
  if (!std::isfinite(range.low) || !std::isfinite(range.high)) return logarithmic ? PlotRange{1, 10} : PlotRange{0, 1};
  if (logarithmic) {
    if (!(range.high > 0)) return {1, 10};
    range.low = std::clamp(range.low, kSmallest, kLargest);
    range.high = std::clamp(range.high, kSmallest, kLargest);
    return range.high > range.low * (1 + kRelativeSpan) ? range : PlotRange{range.high / 10, range.high * 10};
  }
  range = {std::clamp(range.low, -kLargest, kLargest), std::clamp(range.high, -kLargest, kLargest)};
  const double size = std::max(std::abs(range.low), std::abs(range.high));
  if (range.high - range.low > std::max(kSmallest, kRelativeSpan * size)) return range;
  const double half = size > kSmallest ? size / 2 : 0.5;
  return {range.low - half, range.high + half};
}

Axes lay_out_axes(const AxesSpec& spec) {
  Axes axes;
  axes.spec = spec;
  axes.spec.x = drawable(spec.x, false);
  axes.spec.y = drawable(spec.y, spec.log_y);
  const PlotRange x = axes.spec.x, y = axes.spec.y;
  const double top = kBorder + (spec.title.empty() ? kPlotFont / 2 : kTitleRoom);
  const double bottom = kBorder + kTicksBelow + (spec.x_label.empty() ? 0 : kPlotFont + 6);

  // The labels of y need room to the left, which the height of an equal aspect depends on: twice is enough.
  double height = spec.height > 0 ? spec.height - top - bottom : kUsualAspect * spec.width - top - bottom;
  double left = 0, width = 0;
  for (int pass = 0; pass < 3; ++pass) {
    height = std::max(height, kLeastSide);
    axes.y_ticks = y_ticks(axes.spec, height);
    left = kBorder + (spec.y_label.empty() ? 0 : kPlotFont + 6) + label_room(axes.y_ticks) + kTick + kLabelGap;
    width = std::max(kLeastSide, spec.width - left - kBorder - std::max(spec.right_room, kPlotFont));
    if (spec.equal_aspect && spec.height <= 0) height = width * (y.high - y.low) / (x.high - x.low);
  }
  axes.width = spec.width;
  axes.height = spec.height > 0 ? spec.height : top + height + bottom;
  if (spec.equal_aspect && spec.height > 0) {
    const double scale = std::min(width / (x.high - x.low), height / (y.high - y.low));
    width = scale * (x.high - x.low);
    height = scale * (y.high - y.low);
  }
  axes.area = {{left, top}, {left + width, top + height}};
  axes.x_ticks = x_ticks(x, width);
  return axes;
}

Vec2 Axes::pixel(Vec2 p) const {
  const auto part = [](double v, PlotRange r) { return (v - r.low) / (r.high - r.low); };
  double y = part(p.y, spec.y);
  if (spec.log_y) {
    y = p.y > 0 ? std::log(p.y / spec.y.low) / std::log(spec.y.high / spec.y.low)
                : std::numeric_limits<double>::quiet_NaN();
  }
  return {area.low.x + part(p.x, spec.x) * (area.high.x - area.low.x), area.high.y - y * (area.high.y - area.low.y)};
}

std::string Axes::svg() const {
  std::string marks, labels;
  for (const Tick& tick : x_ticks.ticks) {
    const double x = pixel({tick.value, spec.y.low}).x;
    const double end = area.high.y + kTick;
    marks += line({x, area.high.y}, {x, end});
    labels += text_element({x, end + kLabelGap + 0.75 * kPlotFont}, tick.label, {.anchor = "middle"});
  }
  for (const Tick& tick : y_ticks.ticks) {
    const double y = pixel({spec.x.low, tick.value}).y;
    const double end = area.low.x - (tick.label.empty() ? kMinorTick : kTick);
    marks += line({end, y}, {area.low.x, y});
    if (tick.label.empty()) continue;
    labels += text_element({end - kLabelGap, y + 0.36 * kPlotFont}, tick.label, {.anchor = "end"});
  }
  std::string svg = "<path class=\"axes\" fill=\"none\" stroke=\"" + std::string(kPlotInk) + "\" stroke-width=\"" +
                    short_number(kLineWidth) + "\" d=\"M" + short_number(area.low.x) + " " + short_number(area.low.y) +
                    "H" + short_number(area.high.x) + "V" + short_number(area.high.y) + "H" + short_number(area.low.x) +
                    "Z" + marks + "\"/>\n" + labels;

  const double middle_x = (area.low.x + area.high.x) / 2, middle_y = (area.low.y + area.high.y) / 2;
  const std::string x_label = with_exponent(spec.x_label, x_ticks.exponent);
  const std::string y_label = with_exponent(spec.y_label, y_ticks.exponent);
  if (!x_label.empty()) {
    const double y = area.high.y + kTicksBelow + (spec.x_label.empty() ? 0 : kPlotFont + 2);
    const double room = 2 * std::min(middle_x, width - middle_x);
    svg += text_element({middle_x, y}, x_label, {.anchor = "middle", .size = fitting_size(x_label, room)});
  }
  if (!spec.y_label.empty()) {
    const double x = kBorder + 0.8 * kPlotFont;
    const std::string turned = "transform=\"rotate(-90 " + short_number(x) + " " + short_number(middle_y) + ")\"";
    const double room = 2 * std::min(middle_y, height - middle_y);
    svg +=
        text_element({x, middle_y}, y_label, {.anchor = "middle", .size = fitting_size(y_label, room), .more = turned});
  } else if (y_ticks.exponent != 0) {
    svg += text_element({area.low.x, area.low.y - kLabelGap}, y_label, {.size = kPlotSmallFont});
  }
  if (!spec.title.empty()) {
    const double size = fitting_size(spec.title, 2 * std::min(middle_x, width - middle_x));
    svg += text_element({middle_x, kBorder + kPlotFont}, spec.title, {.anchor = "middle", .size = size});
  }
  return svg;
}

GridPoint plot_grid(Vec2 pixel) { return {std::llround(pixel.x / Axes::kUnit), std::llround(pixel.y / Axes::kUnit)}; }

std::string plot_steps(double pixels) { return short_number(pixels / Axes::kUnit); }

std::string clipped_group(const Box& box, const std::string& id, const std::string& content) {
  return "<clipPath id=\"" + id + "\"><rect x=\"" + short_number(box.low.x) + "\" y=\"" + short_number(box.low.y) +
         "\" width=\"" + short_number(box.high.x - box.low.x) + "\" height=\"" + short_number(box.high.y - box.low.y) +
         "\"/></clipPath>\n<g clip-path=\"url(#" + id + ")\">\n<g transform=\"scale(" + short_number(Axes::kUnit) +
         ")\" stroke-linejoin=\"round\">\n" + content + "</g>\n</g>\n";
}

}  // namespace temper
