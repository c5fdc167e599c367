// Contour plots: each band is painted over the one below it, so that no seams show; then lines, levels and key.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "draw/text.hpp"
#include "draw/viewport.hpp"
#include "plot/axes.hpp"
#include "plot/contour.hpp"
#include "plot/levels.hpp"
#include "plot/plot.hpp"
#include "temper/detail/vec.hpp"

namespace temper {
namespace {

struct LabelPlace {
  Vec2 middle;       ///< pixels, y down
  double angle = 0;  ///< degrees, clockwise, in (−90, 90]: text is never upside down
};

/// The places that are drawn on already, in squares of a few pixels. Owners are small numbers: one a level.
class Occupancy {
 public:
  explicit Occupancy(const Box& area);

  void add_line(std::span<const Vec2> points, int owner);
  void add_disc(Vec2 center, double radius, int owner);
  /// Has anybody but `owner` drawn within about 1.5 squares of p? True outside the area.
  [[nodiscard]] bool others_near(Vec2 p, int owner) const;

 private:
  [[nodiscard]] bool find(Vec2 p, std::size_t& column, std::size_t& row) const;
  void add(Vec2 p, int owner);

  Box area_;
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<std::uint64_t> owners_;  // a bit an owner, modulo 64
};

constexpr double kSquare = 4;       // pixels: a side of an occupied square
constexpr double kStraight = 0.97;  // chord over arc along a label, at least
constexpr double kSlack = 1.25;     // room along the line, of the label's width
constexpr double kStride = 8;       // pixels between places tried

// A polyline by arc length.
class ArcLength {
 public:
  explicit ArcLength(std::span<const Vec2> points) : points_(points), lengths_(points.size(), 0) {
    for (std::size_t k = 1; k < points.size(); ++k) lengths_[k] = lengths_[k - 1] + length(points[k] - points[k - 1]);
  }
  [[nodiscard]] double total() const { return lengths_.back(); }
  [[nodiscard]] Vec2 at(double s) const {
    const auto above = std::upper_bound(lengths_.begin(), lengths_.end(), s);
    if (above == lengths_.begin()) return points_.front();
    if (above == lengths_.end()) return points_.back();
    const auto k = static_cast<std::size_t>(above - lengths_.begin());
    const double t = (s - lengths_[k - 1]) / (lengths_[k] - lengths_[k - 1]);
    return points_[k - 1] + t * (points_[k] - points_[k - 1]);
  }

 private:
  std::span<const Vec2> points_;
  std::vector<double> lengths_;
};

double upright_degrees(Vec2 along) {
  double angle = std::atan2(along.y, along.x) * 180 / std::numbers::pi;
  if (angle > 90) angle -= 180;
  if (angle <= -90) angle += 180;
  return angle;
}

Occupancy::Occupancy(const Box& area) : area_(area) {
  const auto squares = [](double pixels) {
    return static_cast<std::size_t>(std::max(1.0, std::ceil(pixels / kSquare)));
  };
  columns_ = squares(area.high.x - area.low.x);
  rows_ = squares(area.high.y - area.low.y);
  owners_.assign(columns_ * rows_, 0);
}

bool Occupancy::find(Vec2 p, std::size_t& column, std::size_t& row) const {
  const double x = (p.x - area_.low.x) / kSquare, y = (p.y - area_.low.y) / kSquare;
  if (!(x >= 0 && y >= 0 && x < static_cast<double>(columns_) && y < static_cast<double>(rows_))) return false;
  column = static_cast<std::size_t>(x);
  row = static_cast<std::size_t>(y);
  return true;
}

void Occupancy::add(Vec2 p, int owner) {
  std::size_t column = 0, row = 0;
  if (find(p, column, row)) owners_[row * columns_ + column] |= std::uint64_t{1} << (owner & 63);
}

void Occupancy::add_line(std::span<const Vec2> points, int owner) {
  for (std::size_t k = 1; k < points.size(); ++k) {
    const Vec2 along = points[k] - points[k - 1];
    const double pieces = std::ceil(length(along) / (kSquare / 2));
    if (!(pieces < 1e5)) continue;  // far outside the area
    for (double i = 0; i <= pieces; ++i) add(points[k - 1] + (pieces > 0 ? i / pieces : 0) * along, owner);
  }
}

void Occupancy::add_disc(Vec2 center, double radius, int owner) {
  for (double y = -radius; y <= radius; y += kSquare / 2) {
    for (double x = -radius; x <= radius; x += kSquare / 2) {
      if (x * x + y * y <= radius * radius) add(center + Vec2{x, y}, owner);
    }
  }
}

bool Occupancy::others_near(Vec2 p, int owner) const {
  std::size_t column = 0, row = 0;
  if (!find(p, column, row)) return true;
  const std::uint64_t others = ~(std::uint64_t{1} << (owner & 63));
  for (std::size_t r = row == 0 ? 0 : row - 1; r <= std::min(row + 1, rows_ - 1); ++r) {
    for (std::size_t c = column == 0 ? 0 : column - 1; c <= std::min(column + 1, columns_ - 1); ++c) {
      if ((owners_[r * columns_ + c] & others) != 0) return true;
    }
  }
  return false;
}

/// The best place on the line for a label of this size; nothing when it fits nowhere.
std::optional<LabelPlace> place_label(std::span<const Vec2> line, double width, const Occupancy& drawn, int owner) {
  if (line.size() < 2) return std::nullopt;
  const ArcLength arc(line);
  const double room = kSlack * width;
  std::optional<LabelPlace> best;
  double best_score = 0;
  for (double s = room / 2; s + room / 2 <= arc.total(); s += kStride) {
    const Vec2 from = arc.at(s - room / 2), to = arc.at(s + room / 2);
    const double straight = length(to - from) / room;
    if (straight < kStraight) continue;
    // Not near either end of an open line, and rather level than steep.
    const double central = std::min(s, arc.total() - s) / arc.total();
    const double level = std::abs(to.x - from.x) / length(to - from);
    const double score = straight + 0.3 * central + 0.2 * level;
    if (score <= best_score) continue;
    bool free = true;
    for (double t = -0.5; free && t <= 0.5; t += kSquare / room) free = !drawn.others_near(arc.at(s + t * room), owner);
    if (!free) continue;
    best_score = score;
    best = LabelPlace{arc.at(s), upright_degrees(to - from)};
  }
  return best;
}

constexpr double kLine = 0.6, kZeroLine = 1.4, kOverlayLine = 1.6;  // widths, pixels
constexpr double kDot = 3.5;                                        // radius
constexpr double kSmooth = 0.08;  // pixels that a path may leave out of a line: less than is seen
constexpr double kDark = 0.45;    // gray below which lines and text on a band are light
constexpr double kKeyWidth = 14, kKeyGap = 14, kKeyTick = 4;
constexpr double kPerKeyLabel = 15;  // pixels between labels of the key, at least
constexpr int kOverlayOwner = 63;    // in the Occupancy

using Polyline = std::vector<Vec2>;

// The point of points (first, last) farthest from the chord between them.
std::pair<std::size_t, double> farthest(const Polyline& points, std::size_t first, std::size_t last) {
  const Vec2 chord = points[last] - points[first];
  const double across = length(chord);
  std::pair<std::size_t, double> result = {first, 0};
  for (std::size_t k = first + 1; k < last; ++k) {
    const Vec2 to = points[k] - points[first];
    const double distance = across > 0 ? std::abs(cross(chord, to)) / across : length(to);
    if (distance > result.second) result = {k, distance};
  }
  return result;
}

// Without the points that nobody would miss (Douglas and Peucker 1973).
Polyline simplified(const Polyline& points) {
  if (points.size() < 3) return points;
  std::vector<bool> keep(points.size(), false);
  keep.front() = keep.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> spans = {{0, points.size() - 1}};
  while (!spans.empty()) {
    const auto [first, last] = spans.back();
    spans.pop_back();
    const auto [k, distance] = farthest(points, first, last);
    if (distance <= kSmooth) continue;
    keep[k] = true;
    spans.push_back({first, k});
    spans.push_back({k, last});
  }
  Polyline result;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (keep[k]) result.push_back(points[k]);
  }
  return result;
}

class ContourPainter {
 public:
  explicit ContourPainter(const ContourPlot& plot)
      : plot_(plot), grid_{plot.nx, plot.ny, plot.values}, levels_(choose_levels(plot)) {
    for (const double v : plot.values) {
      if (!std::isfinite(v)) continue;
      lowest_ = std::min(lowest_, v);
      highest_ = std::max(highest_, v);
    }
    // Bands that hold no value are in neither picture nor key.
    while (!levels_.empty() && levels_.back() > highest_) levels_.pop_back();
    while (!levels_.empty() && levels_.front() < lowest_) levels_.erase(levels_.begin());
  }

  std::string paint() {
    AxesSpec spec = {.title = plot_.title, .x_label = plot_.x_label, .y_label = plot_.y_label};
    spec.x = plot_.x_range;
    spec.y = plot_.y_range;
    spec.width = plot_.width;
    spec.height = plot_.height;
    spec.equal_aspect = plot_.equal_aspect;
    if (has_key()) spec.right_room = key_width();
    axes_ = lay_out_axes(spec);

    std::string content = bands() + lines() + overlay_lines();
    std::string svg = clipped_group(axes_.area, "plot", content) + labels() + axes_.svg() + overlay_labels();
    if (has_key()) svg += key();
    return picture_document(axes_.width, axes_.height, svg);
  }

 private:
  [[nodiscard]] bool has_key() const { return plot_.key && !levels_.empty(); }
  [[nodiscard]] Rgb color(std::size_t band) const {
    return band_color(levels_.empty() ? 0 : static_cast<double>(band) / static_cast<double>(levels_.size()));
  }

  // From samples to pixels.
  [[nodiscard]] Vec2 pixel(Vec2 sample) const {
    const Vec2 part = {sample.x / static_cast<double>(plot_.nx - 1), sample.y / static_cast<double>(plot_.ny - 1)};
    const PlotRange x = axes_.spec.x, y = axes_.spec.y;
    return axes_.pixel({x.low + part.x * (x.high - x.low), y.low + part.y * (y.high - y.low)});
  }
  [[nodiscard]] Polyline pixels(const Polyline& samples) const {
    Polyline result;
    for (const Vec2 p : samples) result.push_back(pixel(p));
    return simplified(result);
  }

  static void add(PathText& path, const Polyline& points, bool closed) {
    path.move_to(plot_grid(points.front()));
    for (std::size_t k = 1; k < points.size(); ++k) path.line_to(plot_grid(points[k]));
    if (closed) path.close();
  }

  [[nodiscard]] std::string bands() const {
    std::string svg;
    for (std::size_t band = 0; band <= levels_.size(); ++band) {
      const double level = band == 0 ? -std::numeric_limits<double>::infinity() : levels_[band - 1];
      PathText path;
      for (Polyline loop : superlevel_loops(grid_, level)) {
        loop.push_back(loop.front());
        const Polyline points = pixels(loop);
        if (points.size() > 3) add(path, points, true);
      }
      if (path.empty()) continue;
      svg += "<path class=\"band\" fill=\"" + color(band).text() + "\" d=\"" + path.text() + "\"/>\n";
    }
    return svg;
  }

  [[nodiscard]] bool on_dark(std::size_t level) const {
    return 0.5 * (color(level).gray() + color(level + 1).gray()) < kDark;
  }

  // Fills lines_ too, which the labels need.
  [[nodiscard]] std::string lines() {
    std::string svg;
    for (std::size_t k = 0; k < levels_.size(); ++k) {
      PathText path;
      lines_.emplace_back();
      for (const Polyline& line : contour_lines(grid_, levels_[k])) {
        Polyline points = pixels(line);
        const bool closed = points.size() > 2 && points.front() == points.back();
        if (points.size() < 2 || (points.size() == 2 && points[0] == points[1])) continue;
        add(path, closed ? Polyline(points.begin(), points.end() - 1) : points, closed);
        lines_.back().push_back(std::move(points));
      }
      if (path.empty()) continue;
      svg += "<path class=\"contour\" fill=\"none\" stroke=\"" + std::string(on_dark(k) ? "#ffffff" : "#333333") +
             "\" stroke-width=\"" + plot_steps(levels_[k] == 0 ? kZeroLine : kLine) + "\" d=\"" + path.text() +
             "\"/>\n";
    }
    return svg;
  }

  // One label a level, on the longest line that has room for it.
  [[nodiscard]] std::string labels() {
    if (!plot_.line_labels) return "";
    Occupancy drawn(axes_.area);
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      for (const Polyline& line : lines_[k]) drawn.add_line(line, static_cast<int>(k));
    }
    for (const PlotOverlay& overlay : plot_.overlays) occupy(drawn, overlay);
    std::string svg;
    for (std::size_t k = 0; k < lines_.size(); ++k) {
      std::stable_sort(lines_[k].begin(), lines_[k].end(),
                       [](const Polyline& a, const Polyline& b) { return arc_length(a) > arc_length(b); });
      const std::string text = number_label(levels_[k]);
      const double width = text_width(text, kPlotSmallFont) + 4;
      for (const Polyline& line : lines_[k]) {
        const auto place = place_label(line, width, drawn, static_cast<int>(k));
        if (!place) continue;
        drawn.add_disc(place->middle, width / 2, kOverlayOwner);
        svg += label(text, *place, k);
        break;
      }
    }
    return svg;
  }

  void occupy(Occupancy& drawn, const PlotOverlay& overlay) const {
    Polyline points;
    for (const Vec2 p : overlay.points) points.push_back(axes_.pixel(p));
    if (overlay.line) drawn.add_line(points, kOverlayOwner);
    for (const Vec2 p : points) drawn.add_disc(p, kDot + 4, kOverlayOwner);
    if (points.empty() || overlay.label.empty()) return;
    const double width = text_width(overlay.label, kPlotSmallFont);
    for (double x = -width; x <= width; x += 8) drawn.add_disc(points.back() + Vec2{x, -8}, 10, kOverlayOwner);
  }

  static double arc_length(const Polyline& line) {
    double sum = 0;
    for (std::size_t k = 1; k < line.size(); ++k) sum += length(line[k] - line[k - 1]);
    return sum;
  }

  // The line is interrupted by a halo in the mean color of its two bands.
  [[nodiscard]] std::string label(const std::string& text, const LabelPlace& place, std::size_t level) const {
    const Rgb a = color(level), b = color(level + 1);
    const Rgb mean = {(a.r + b.r) / 2, (a.g + b.g) / 2, (a.b + b.b) / 2};
    const std::string x = short_number(place.middle.x), y = short_number(place.middle.y);
    TextLook look = {.anchor = "middle", .size = kPlotSmallFont, .color = on_dark(level) ? "#ffffff" : kPlotInk};
    look.more = "class=\"level\" transform=\"rotate(" + short_number(place.angle) + " " + x + " " + y +
                ")\" paint-order=\"stroke\" stroke=\"" + mean.text() +
                "\" stroke-width=\"3\" stroke-linejoin=\"round\"";
    return text_element({place.middle.x, place.middle.y + 0.36 * kPlotSmallFont}, text, look);
  }

  [[nodiscard]] std::string overlay_lines() const {
    std::string svg;
    for (const PlotOverlay& overlay : plot_.overlays) {
      PathText path;
      for (std::size_t k = 1; overlay.line && k < overlay.points.size(); ++k) {
        const Segment s = {axes_.pixel(overlay.points[k - 1]), axes_.pixel(overlay.points[k])};
        if (const auto seen = clip(s, axes_.area)) path.segment(plot_grid(seen->from), plot_grid(seen->to));
      }
      if (path.empty()) continue;
      svg += "<path class=\"overlay\" fill=\"none\" stroke=\"#000000\" stroke-width=\"" + plot_steps(kOverlayLine) +
             "\"" + (overlay.dashed ? " stroke-dasharray=\"" + plot_steps(5) + " " + plot_steps(3) + "\"" : "") +
             " d=\"" + path.text() + "\"/>\n";
    }
    return svg;
  }

  // Over the axes: a dot on the frame is whole.
  [[nodiscard]] std::string overlay_labels() const {
    std::string svg;
    for (const PlotOverlay& overlay : plot_.overlays) {
      std::optional<Vec2> last;
      for (const Vec2 p : overlay.points) {
        const Vec2 at = axes_.pixel(p);
        if (!meets(at, kDot, axes_.area)) continue;
        last = at;
        if (!overlay.dots) continue;
        svg += "<circle class=\"dot\" cx=\"" + short_number(at.x) + "\" cy=\"" + short_number(at.y) + "\" r=\"" +
               short_number(kDot) + "\" fill=\"#000000\" stroke=\"#ffffff\"/>\n";
      }
      if (last && !overlay.label.empty()) svg += overlay_label(*last, overlay.label);
    }
    return svg;
  }

  [[nodiscard]] std::string overlay_label(Vec2 at, const std::string& label) const {
    const bool left = at.x + 8 + text_width(label, kPlotSmallFont) > axes_.area.high.x;
    const bool below = at.y - 6 - kPlotSmallFont < axes_.area.low.y;
    TextLook look = {.anchor = left ? "end" : "start", .size = kPlotSmallFont};
    look.more = "paint-order=\"stroke\" stroke=\"#ffffff\" stroke-width=\"3\" stroke-linejoin=\"round\"";
    return text_element({at.x + (left ? -6 : 6), below ? at.y + 6 + 0.8 * kPlotSmallFont : at.y - 6}, label, look);
  }

  [[nodiscard]] double key_width() const {
    double labels = 0;
    for (const double level : levels_) labels = std::max(labels, text_width(number_label(level), kPlotSmallFont));
    const double bar = kKeyWidth + kKeyTick + 3 + labels;
    return kKeyGap + std::max(bar, text_width(plot_.value_label, kPlotSmallFont));
  }

  // Boxes of equal height, lowest band at the bottom, the levels between them.
  [[nodiscard]] std::string key() const {
    const double left = axes_.area.high.x + kKeyGap;
    const double top = axes_.area.low.y + (plot_.value_label.empty() ? 0 : kPlotSmallFont + 6);
    const double bottom = axes_.area.high.y;
    // A lowest band without values in it has no box.
    const std::size_t first = lowest_ < levels_.front() ? 0 : 1, n = levels_.size() + 1 - first;
    const double box = (bottom - top) / static_cast<double>(n);
    const auto stride = static_cast<std::size_t>(std::max(1.0, std::ceil(kPerKeyLabel / box)));
    std::string svg = "<g class=\"key\">\n", labels;
    if (!plot_.value_label.empty()) {
      svg +=
          text_element({left, axes_.area.low.y + 0.75 * kPlotSmallFont}, plot_.value_label, {.size = kPlotSmallFont});
    }
    for (std::size_t band = first; band <= levels_.size(); ++band) {
      const double y = bottom - box * static_cast<double>(band + 1 - first);
      svg += "<rect x=\"" + short_number(left) + "\" y=\"" + short_number(y) + "\" width=\"" + short_number(kKeyWidth) +
             "\" height=\"" + short_number(box) + "\" fill=\"" + color(band).text() + "\"/>\n";
      if (band == levels_.size() || band % stride != 0) continue;
      labels += "<path stroke=\"" + std::string(kPlotInk) + "\" stroke-width=\"0.8\" d=\"M" +
                short_number(left + kKeyWidth) + " " + short_number(y) + "h" + short_number(kKeyTick) + "\"/>\n" +
                text_element({left + kKeyWidth + kKeyTick + 3, y + 0.36 * kPlotSmallFont}, number_label(levels_[band]),
                             {.size = kPlotSmallFont});
    }
    return svg + "<rect x=\"" + short_number(left) + "\" y=\"" + short_number(top) + "\" width=\"" +
           short_number(kKeyWidth) + "\" height=\"" + short_number(bottom - top) + "\" fill=\"none\" stroke=\"" +
           kPlotInk + "\" stroke-width=\"0.8\"/>\n" + labels + "</g>\n";
  }

  const ContourPlot& plot_;
  SampleGrid grid_;
  std::vector<double> levels_;
  double lowest_ = std::numeric_limits<double>::infinity(), highest_ = -std::numeric_limits<double>::infinity();
  Axes axes_;
  std::vector<std::vector<Polyline>> lines_;  // of each level, pixels
};

}  // namespace

std::string contour_plot_svg(const ContourPlot& plot) { return ContourPainter(plot).paint(); }

}  // namespace temper
