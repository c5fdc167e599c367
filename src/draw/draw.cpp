// The document around the panels: background, captions, legend, title.
#include "temper/draw.hpp"

#include <algorithm>
#include <array>

#include "draw/frame.hpp"
#include "draw/panel.hpp"
#include "draw/xml.hpp"

namespace temper {
namespace {

constexpr double kGap = 24;   // between panels and around the picture, pixels
constexpr double kLine = 22;  // height of a line of text
constexpr double kFontSize = 14;

struct Shown {
  Panel panel;
  std::string name;  // "before", "after" or nothing
};

std::string text_at(double x, double y, std::string_view anchor, const std::string& content) {
  return "<text x=\"" + short_number(x) + "\" y=\"" + short_number(y) + "\" text-anchor=\"" + std::string(anchor) +
         "\">" + xml_text(content) + "</text>\n";
}

std::string with_commas(std::size_t n) {
  std::string digits = std::to_string(n);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, 1, ',');
  return digits;
}

std::string caption(const Shown& shown, bool zoomed) {
  const std::string all = with_commas(shown.panel.triangles), bad = with_commas(shown.panel.bad);
  std::string text = shown.name.empty() ? "" : shown.name + ": ";
  text += shown.panel.bad == 0 ? "all " + all + " triangles well-centered"
                               : bad + " of " + all + " triangles not well-centered";
  return zoomed ? text + " (whole mesh)" : text;
}

struct Key {
  std::string label, mark;  // mark: SVG around y = 0
  double width = 20;        // of the mark, pixels
};

std::string line_mark(const char* color, const char* more = "") {
  return std::string("<path d=\"M0 0h20\" fill=\"none\" stroke-width=\"1.5\" stroke=\"") + color + "\" " + more + "/>";
}
std::string circle_mark(const char* color, const char* more = "") {
  return std::string("<circle cx=\"12\" r=\"6\" fill=\"none\" stroke-width=\"1.5\" stroke=\"") + color + "\" " + more +
         "/>";
}

Key scale_key(const TriangleColors& colors) {
  constexpr double kBox = 12;
  const ColorScale scale = scale_of(colors);
  Key key = {colors.label, "", kBox * static_cast<double>(kScaleColors.size())};
  if (scale.low <= scale.high) key.label += ": " + short_number(scale.low) + " to " + short_number(scale.high);
  for (std::size_t i = 0; i < kScaleColors.size(); ++i) {
    key.mark += "<rect x=\"" + short_number(kBox * static_cast<double>(i)) + "\" y=\"-6\" width=\"" +
                short_number(kBox) + "\" height=\"12\" fill=\"" + kScaleColors[i] + "\"/>";
  }
  return key;
}

// Only what some panel really shows.
std::vector<Key> legend(std::span<const Shown> shown, const PageFrame& frame, const DrawOptions& options) {
  const auto any = [&](auto what) {
    return std::any_of(shown.begin(), shown.end(), [&](const Shown& s) { return what(s.panel); });
  };
  std::vector<Key> keys;
  if (options.colors) {
    keys.push_back(scale_key(*options.colors));
  } else if (options.bad_triangles && any([](const Panel& p) { return p.bad > 0; })) {
    const char* color = frame.shows_detail() ? Palette::bad : Palette::bad_dense;
    keys.push_back(
        {"not well-centered", std::string("<rect y=\"-6\" width=\"20\" height=\"12\" fill=\"") + color + "\"/>"});
  }
  if (any([](const Panel& p) { return p.dual; })) keys.push_back({"dual", line_mark(Palette::dual)});
  if (any([](const Panel& p) { return p.positive; })) keys.push_back({"weight > 0", circle_mark(Palette::positive)});
  if (any([](const Panel& p) { return p.negative; })) {
    keys.push_back({"weight < 0", circle_mark(Palette::negative, "stroke-dasharray=\"4 2\"")});
  }
  if (any([](const Panel& p) { return p.rings; })) keys.push_back({"nearly coincident", circle_mark(Palette::ring)});
  if (!frame.shows_detail() && (options.dual || options.weights)) {
    keys.push_back({frame.shows_edges() ? "dual and weights: zoom in" : "edges, dual and weights: zoom in", ""});
  }
  return keys;
}

constexpr double kPerLetter = 7.5, kAfterMark = 8, kBetween = 22;  // pixels, generous for any sans-serif

double mark_width(const Key& key) { return key.mark.empty() ? 0 : key.width + kAfterMark; }

double legend_width(const std::vector<Key>& keys) {
  double width = 0;
  for (const Key& key : keys) {
    width += mark_width(key) + kPerLetter * static_cast<double>(key.label.size()) + kBetween;
  }
  return width - kBetween;
}

std::string legend_svg(const std::vector<Key>& keys, double left, double y) {
  std::string svg;
  for (const Key& key : keys) {
    svg += "<g transform=\"translate(" + short_number(left) + " " + short_number(y - 5) + ")\">" + key.mark + "</g>\n";
    left += mark_width(key);
    svg += text_at(left, y, "start", key.label);
    left += kPerLetter * static_cast<double>(key.label.size()) + kBetween;
  }
  return svg;
}

std::string document(std::span<const Shown> shown, const PageFrame& frame, const DrawOptions& options) {
  const double panels = static_cast<double>(shown.size());
  const std::vector<Key> keys = legend(shown, frame, options);
  const double width = panels * frame.width + (panels + 1) * kGap;
  double y = kGap + frame.height;

  std::string body;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const double x = kGap + static_cast<double>(i) * (frame.width + kGap);
    body += "<g transform=\"translate(" + short_number(x) + " " + short_number(kGap) + ")\">\n" + shown[i].panel.svg +
            "</g>\n";
    body += text_at(x + frame.width / 2, y + kLine, "middle",
                    caption(shown[i], options.zoom.has_value() || !frame.view.is_flat()));
  }
  y += kLine;
  if (!options.title.empty()) body += text_at(width / 2, y += kLine, "middle", options.title);
  if (!keys.empty()) body += legend_svg(keys, std::max(kGap, (width - legend_width(keys)) / 2), y += kLine);
  y += kGap;

  const std::string size = short_number(width) + "\" height=\"" + short_number(y);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + size + "\" viewBox=\"0 0 " + short_number(width) + " " +
         short_number(y) + "\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"" + short_number(kFontSize) +
         "\">\n<rect width=\"" + size + "\" fill=\"#ffffff\"/>\n" + body + "</svg>\n";
}

}  // namespace

std::string draw_svg(const Mesh& mesh, const DrawOptions& options) {
  const std::array<const Mesh*, 1> meshes = {&mesh};
  const PageFrame frame = make_frame(meshes, options);
  const std::array<Shown, 1> shown = {Shown{draw_panel(mesh, frame, options, 0, "panel"), ""}};
  return document(shown, frame, options);
}

std::string draw_before_after_svg(const Mesh& before, const Mesh& after, const DrawOptions& options) {
  const std::array<const Mesh*, 2> meshes = {&before, &after};
  const PageFrame frame = make_frame(meshes, options);
  const std::array<Shown, 2> shown = {Shown{draw_panel(before, frame, options, 0, "before"), "before"},
                                      Shown{draw_panel(after, frame, options, 1, "after"), "after"}};
  return document(shown, frame, options);
}

}  // namespace temper
