// The document around the panels: background, captions, legend, title.
#include "temper/draw.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "draw/panel.hpp"
#include "draw/text.hpp"
#include "draw/viewport.hpp"
#include "temper/detail/read_number.hpp"

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

// The legend has only what some panel really shows.
std::vector<Key> legend(std::span<const Shown> shown, const Viewport& viewport, const DrawOptions& options) {
  const auto any = [&](auto what) {
    return std::any_of(shown.begin(), shown.end(), [&](const Shown& s) { return what(s.panel); });
  };
  std::vector<Key> keys;
  if (options.colors) {
    keys.push_back(scale_key(*options.colors));
  } else if (options.bad_triangles && any([](const Panel& p) { return p.bad > 0; })) {
    const char* color = viewport.shows_detail() ? Palette::bad : Palette::bad_dense;
    keys.push_back(
        {"not well-centered", std::string("<rect y=\"-6\" width=\"20\" height=\"12\" fill=\"") + color + "\"/>"});
  }
  if (any([](const Panel& p) { return p.dual; })) keys.push_back({"dual", line_mark(Palette::dual)});
  if (any([](const Panel& p) { return p.positive; })) keys.push_back({"weight > 0", circle_mark(Palette::positive)});
  if (any([](const Panel& p) { return p.negative; })) {
    keys.push_back({"weight < 0", circle_mark(Palette::negative, "stroke-dasharray=\"4 2\"")});
  }
  if (any([](const Panel& p) { return p.rings; })) keys.push_back({"nearly coincident", circle_mark(Palette::ring)});
  if (!viewport.shows_detail() && (options.dual || options.weights)) {
    keys.push_back({viewport.shows_edges() ? "dual and weights: zoom in" : "edges, dual and weights: zoom in", ""});
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

std::string document(std::span<const Shown> shown, const Viewport& viewport, const DrawOptions& options) {
  const double panels = static_cast<double>(shown.size());
  const std::vector<Key> keys = legend(shown, viewport, options);
  const double width = panels * viewport.width + (panels + 1) * kGap;
  double y = kGap + viewport.height;

  std::string body;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const double x = kGap + static_cast<double>(i) * (viewport.width + kGap);
    body += "<g transform=\"translate(" + short_number(x) + " " + short_number(kGap) + ")\">\n" + shown[i].panel.svg +
            "</g>\n";
    body += text_at(x + viewport.width / 2, y + kLine, "middle",
                    caption(shown[i], options.zoom.has_value() || !viewport.view.is_flat()));
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
  const Viewport viewport = make_viewport(meshes, options);
  const std::array<Shown, 1> shown = {Shown{draw_panel(mesh, viewport, options, 0, "panel"), ""}};
  return document(shown, viewport, options);
}

std::string draw_before_after_svg(const Mesh& before, const Mesh& after, const DrawOptions& options) {
  const std::array<const Mesh*, 2> meshes = {&before, &after};
  const Viewport viewport = make_viewport(meshes, options);
  const std::array<Shown, 2> shown = {Shown{draw_panel(before, viewport, options, 0, "before"), "before"},
                                      Shown{draw_panel(after, viewport, options, 1, "after"), "after"}};
  return document(shown, viewport, options);
}

// Several documents in one: nested <svg> elements, with a prefix that makes their ids distinct.

namespace {

constexpr double kTitleRoom = kPlotFont + 14;

// The value of an attribute of a tag; empty when it has none.
std::string_view attribute(std::string_view tag, std::string_view name) {
  const std::string start = " " + std::string(name) + "=\"";
  const std::size_t at = tag.find(start);
  if (at == std::string_view::npos) return {};
  const std::size_t begin = at + start.size(), end = tag.find('"', begin);
  return end == std::string_view::npos ? std::string_view{} : tag.substr(begin, end - begin);
}

double number(std::string_view text) {
  double value = 0;
  read_number(text.data(), text.data() + text.size(), value);
  return value;
}

// A document cut into its root tag and the rest.
struct Document {
  std::string_view root, rest;
  double width = 0, height = 0;
};

Document parse(std::string_view svg) {
  Document document;
  const std::size_t begin = svg.find("<svg");
  const std::size_t end = begin == std::string_view::npos ? begin : svg.find('>', begin);
  if (end == std::string_view::npos) return document;
  document.root = svg.substr(begin, end - begin);
  document.rest = svg.substr(end);
  document.width = number(attribute(document.root, "width"));
  document.height = number(attribute(document.root, "height"));
  return document;
}

// A tag with the prefix before each id and each reference to one.
std::string prefixed(std::string_view tag, const std::string& prefix) {
  std::string result(tag);
  for (const std::string_view where : {" id=\"", "url(#", "href=\"#"}) {
    for (std::size_t at = result.find(where); at != std::string::npos; at = result.find(where, at)) {
      at += where.size();
      result.insert(at, prefix);
    }
  }
  return result;
}

// Text between tags stays as it is: it may look like an id.
std::string with_prefixed_ids(std::string_view svg, const std::string& prefix) {
  std::string result;
  while (!svg.empty()) {
    const std::size_t begin = std::min(svg.find('<'), svg.size());
    result += svg.substr(0, begin);
    svg.remove_prefix(begin);
    if (svg.empty()) break;
    const std::size_t end = std::min(svg.find('>'), svg.size());
    result += prefixed(svg.substr(0, end), prefix);
    svg.remove_prefix(end);
  }
  return result;
}

// The root tag at a place; its other attributes (font, colors, box) stay.
std::string placed(std::string_view root, Vec2 at) {
  std::string tag(root);
  const std::size_t name_end = std::string_view("<svg").size();
  tag.insert(name_end, " x=\"" + short_number(at.x) + "\" y=\"" + short_number(at.y) + "\"");
  return tag;
}

}  // namespace

std::string grid_svg(std::span<const std::string> svgs, std::size_t columns, const std::string& title) {
  columns = std::clamp<std::size_t>(columns, 1, std::max<std::size_t>(svgs.size(), 1));
  const std::size_t rows = (svgs.size() + columns - 1) / columns;
  std::vector<Document> documents;
  std::vector<double> widths(columns, 0), heights(rows, 0);
  for (std::size_t i = 0; i < svgs.size(); ++i) {
    documents.push_back(parse(svgs[i]));
    double &width = widths[i % columns], &height = heights[i / columns];
    width = std::max(width, documents[i].width);
    height = std::max(height, documents[i].height);
  }

  double total = 0;
  for (const double width : widths) total += width;
  double y = title.empty() ? 0 : kTitleRoom;
  std::string body;
  if (!title.empty()) {
    const double wide = text_width(title, kPlotFont + 2);
    const double size = (kPlotFont + 2) * (wide > total ? total / wide : 1);
    body += text_element({total / 2, kPlotFont + 6}, title, {.anchor = "middle", .size = size});
  }
  for (std::size_t row = 0, i = 0; row < rows; ++row) {
    double x = 0;
    for (std::size_t column = 0; column < columns && i < svgs.size(); ++column, ++i) {
      const Vec2 at = {x + (widths[column] - documents[i].width) / 2, y};
      if (!documents[i].root.empty()) {
        const std::string prefix = "g" + std::to_string(i) + "-";
        body += with_prefixed_ids(placed(documents[i].root, at) + std::string(documents[i].rest), prefix);
      }
      x += widths[column];
    }
    y += heights[row];
  }
  return picture_document(std::max(total, 1.0), std::max(y, 1.0), body);
}

}  // namespace temper
