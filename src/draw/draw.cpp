// The document around the panels: background, captions, legend, title.
#include "temper/draw.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "draw/panel.hpp"
#include "draw/text.hpp"
#include "draw/viewport.hpp"
#include "temper/detail/read_number.hpp"

namespace temper {
namespace {

constexpr double kLine = 1.6, kTitle = 1.2;  // height of a line of text, size of a title: in font sizes

struct Shown {
  Panel panel;
  std::string name;  // "before", "after" or nothing
  std::string what;  // after the numbers: "triangles bad"
};

std::string triangles_bad(const Viewport& viewport, const DrawOptions& options) {
  return options.zoom || !viewport.view.is_flat() ? "triangles bad (whole mesh)" : "triangles bad";
}

// The legend names bad cells with these words, and has this scale of margins.
struct CellWords {
  std::string bad = "bad triangle";
  ColorScale margins = kMargins;
};

std::string with_commas(std::size_t n) {
  std::string digits = std::to_string(n);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, 1, ',');
  return digits;
}

// The words above a panel, smaller where they would not fit, with a check mark if no triangle is bad.
std::string caption(const Shown& shown, Vec2 at, const Viewport& viewport) {
  const bool good = shown.panel.bad == 0;
  const std::string name = shown.name.empty() ? "" : shown.name + ":", count = with_commas(shown.panel.bad);
  const std::string of = " of " + with_commas(shown.panel.elements) + " " + shown.what;
  const double wide = text_width(name + " " + count + of, viewport.em) + 2 * viewport.em;
  const double size = viewport.em * std::min(1.0, viewport.width / wide);
  std::string svg = "<text x=\"" + short_number(at.x) + "\" y=\"" + short_number(at.y) +
                    "\" text-anchor=\"middle\" font-size=\"" + short_number(size) + "\">";
  if (!name.empty()) svg += "<tspan font-weight=\"bold\">" + name + "</tspan> ";
  svg += std::string("<tspan font-weight=\"bold\" fill=\"") + (good ? Palette::dual : Palette::warning) + "\">" +
         count + "</tspan>" + of + "</text>\n";
  if (!good) return svg;
  const double left = at.x - 0.55 * text_width(name + " " + count + of, size) - 1.4 * size;
  return svg + "<path d=\"M0 0l0.25 0.3 0.5-0.8\" transform=\"translate(" + short_number(left) + " " +
         short_number(at.y - 0.33 * size) + ") scale(" + short_number(size) +
         ")\" fill=\"none\" stroke-width=\"0.16\" stroke-linecap=\"round\" stroke=\"" + Palette::dual + "\"/>\n";
}

// Marks are as wide as two letters m, around y = 0, in font sizes.
struct Key {
  std::string label, mark;
  double width = 1.5;  // of the mark
};

std::string line_mark(const char* color, const char* more = "") {
  return std::string("<path d=\"M0 0h1.5\" fill=\"none\" stroke-width=\"0.15\" stroke=\"") + color + "\" " + more +
         "/>";
}
std::string circle_mark(const char* color, const char* more = "") {
  return std::string("<circle cx=\"0.75\" r=\"0.4\" fill=\"none\" stroke-width=\"0.1\" stroke=\"") + color + "\" " +
         more + "/>";
}

Key scale_key(const std::string& label, const ColorScale& scale) {
  constexpr double kBox = 0.6;
  Key key = {label, "", kBox * static_cast<double>(kScaleColors.size())};
  const auto number = [size = std::max(std::abs(scale.low), std::abs(scale.high))](double value) {
    return number_label(std::abs(value) < 1e-6 * size ? 0 : value);
  };
  if (scale.low <= scale.high) key.label += ": " + number(scale.low) + " to " + number(scale.high);
  for (std::size_t i = 0; i < kScaleColors.size(); ++i) {
    const char* const color = kScaleColors[scale.reversed ? kScaleColors.size() - 1 - i : i];
    key.mark += "<rect x=\"" + short_number(kBox * static_cast<double>(i)) + "\" y=\"-0.45\" width=\"" +
                short_number(kBox) + "\" height=\"0.9\" fill=\"" + color + "\"/>";
  }
  return key;
}

template <class What>
bool any(std::span<const Shown> shown, What what) {
  return std::any_of(shown.begin(), shown.end(), [&](const Shown& s) { return what(s.panel); });
}

bool is_hatched(std::span<const Shown> shown, const DrawOptions& options) {
  return !options.colors && !options.cells && options.fill && any(shown, [](const Panel& p) { return p.bad > 0; });
}

std::string rect_mark(const std::string& fill) {
  return "<rect y=\"-0.45\" width=\"1.5\" height=\"0.9\" fill=\"" + fill + "\"/>";
}

// A key for each region, as long as colors differ.
std::vector<Key> region_keys(const RegionCells& cells) {
  std::vector<Key> keys;
  for (const std::int32_t region : regions_of(cells)) {
    if (keys.size() == kRegionColors.size()) break;
    const auto named = cells.names.find(region);
    std::string label = named == cells.names.end() ? "region " + std::to_string(region) : named->second;
    std::ranges::replace_if(
        label, [](char c) { return c == '_' || c == '^'; }, ' ');  // no indexes
    keys.push_back({label, rect_mark(kRegionColors[keys.size()])});
  }
  return keys;
}

// The legend has only what some panel really shows.
std::vector<Key> legend(std::span<const Shown> shown, const Viewport& viewport, const DrawOptions& options,
                        const CellWords& words) {
  std::vector<Key> keys;
  if (is_hatched(shown, options)) {
    const std::string fill = viewport.shows_detail() ? hatched(viewport, 1 / viewport.em) : Palette::warning;
    keys.push_back({words.bad, rect_mark(fill)});
  }
  if (options.cells) {
    keys = region_keys(*options.cells);
  } else if (options.colors) {
    keys.push_back(scale_key(options.colors->label, scale_of(*options.colors)));
  } else if (options.fill && any(shown, [](const Panel& p) { return p.bad < p.elements; })) {
    keys.push_back(scale_key("margin", words.margins));
  }
  if (any(shown, [](const Panel& p) { return p.faces; }))
    keys.push_back({"line on faces of cells", line_mark(Palette::outline, "stroke-linecap=\"round\"")});
  if (any(shown, [](const Panel& p) { return p.dual; })) keys.push_back({"dual edge", line_mark(Palette::dual)});
  if (any(shown, [](const Panel& p) { return p.negative_dual; })) {
    keys.push_back({"negative dual edge", line_mark(Palette::warning, "stroke-dasharray=\"0.35 0.2\"")});
  }
  if (any(shown, [](const Panel& p) { return p.positive; })) {
    keys.push_back({"weight > 0", circle_mark(Palette::positive)});
  }
  if (any(shown, [](const Panel& p) { return p.negative; })) {
    keys.push_back({"weight < 0", circle_mark(Palette::negative, "stroke-dasharray=\"0.3 0.15\"")});
  }
  if (any(shown, [](const Panel& p) { return p.fixed; }))
    keys.push_back({"fixed point", std::string("<circle cx=\"0.75\" r=\"0.28\" fill=\"") + Palette::outline + "\"/>"});
  if (any(shown, [](const Panel& p) { return p.rings; })) {
    keys.push_back({"nearly coincident", circle_mark(Palette::warning)});
  }
  if (!viewport.shows_detail() && (options.dual || options.weights)) {
    const std::string edges = viewport.shows_edges() ? "" : options.weights ? "edges, " : "edges and ";
    keys.push_back({edges + (options.weights ? "dual and weights" : "dual") + ": zoom in", "", 0});
  }
  return keys;
}

// Rows of keys, each in the middle of the picture.
struct Legend {
  std::string svg;
  double height = 0;
};

Legend legend_at(const std::vector<Key>& keys, double y, double width, double em) {
  constexpr double kAfterMark = 0.5, kBetween = 1.8, kWide = 1.1;  // font sizes; and of the estimate, for wide fonts
  const auto key_width = [&](const Key& key) {
    return (key.width + (key.mark.empty() ? 0 : kAfterMark) + kBetween) * em + kWide * text_width(key.label, em);
  };
  Legend legend;
  for (auto key = keys.begin(); key != keys.end();) {
    auto end = key;
    double row = 0;
    do row += key_width(*end++);
    while (end != keys.end() && row + key_width(*end) - kBetween * em <= width);
    double left = (width - row + kBetween * em) / 2;
    legend.height += kLine * em;
    const double base = y + legend.height;
    for (; key != end; left += key_width(*key++)) {
      if (!key->mark.empty()) {
        legend.svg += "<g transform=\"translate(" + short_number(left) + " " + short_number(base - 0.35 * em) +
                      ") scale(" + short_number(em) + ")\">" + key->mark + "</g>\n";
      }
      const double label = left + (key->width + (key->mark.empty() ? 0 : kAfterMark)) * em;
      legend.svg += text_element({label, base}, key->label, {.size = em});
    }
  }
  return legend;
}

std::string document(std::span<const Shown> shown, const Viewport& viewport, const DrawOptions& options,
                     const CellWords& words = {}) {
  const double panels = static_cast<double>(shown.size()), em = viewport.em, gap = Viewport::kGapEms * em;
  const double width = panels * viewport.width + (panels + 1) * gap;
  std::string body;
  if (is_hatched(shown, options)) {
    body += "<defs>" + hatching(viewport, 1 / viewport.unit) + hatching(viewport, 1 / em) + "</defs>\n";
  }
  double y = 0.3 * em;
  if (!options.title.empty()) {
    const double size = kTitle * em * std::min(1.0, width / text_width(options.title, kTitle * em));
    y += kLine * em;
    body += "<text x=\"" + short_number(width / 2) + "\" y=\"" + short_number(y) +
            "\" text-anchor=\"middle\" font-size=\"" + short_number(size) + "\">" + xml_text(options.title) +
            "</text>\n";
  }
  y += kLine * em;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const double x = gap + static_cast<double>(i) * (viewport.width + gap);
    body += caption(shown[i], {x + viewport.width / 2, y}, viewport);
    body += "<g transform=\"translate(" + short_number(x) + " " + short_number(y + em / 2) + ")\">\n" +
            shown[i].panel.svg + "</g>\n";
  }
  y += em / 2 + viewport.height;
  const Legend keys = legend_at(legend(shown, viewport, options, words), y, width, em);
  return picture_document(width, y + keys.height + em, body + keys.svg);
}

}  // namespace

std::string draw_svg(const Mesh& mesh, const DrawOptions& options) {
  const std::array<const Mesh*, 1> meshes = {&mesh};
  const Viewport viewport = make_viewport(meshes, options);
  const std::array<Shown, 1> shown = {
      Shown{draw_panel(mesh, viewport, options, 0, "panel"), "", triangles_bad(viewport, options)}};
  return document(shown, viewport, options);
}

std::string draw_before_after_svg(const Mesh& before, const Mesh& after, const DrawOptions& options) {
  const std::array<const Mesh*, 2> meshes = {&before, &after};
  const Viewport viewport = make_viewport(meshes, options);
  const std::string what = triangles_bad(viewport, options);
  const std::array<Shown, 2> shown = {Shown{draw_panel(before, viewport, options, 0, "before"), "before", what},
                                      Shown{draw_panel(after, viewport, options, 1, "after"), "after", what}};
  return document(shown, viewport, options);
}

std::string draw_sections_svg(std::span<const Section> sections, const DrawOptions& options) {
  DrawOptions how = options;
  how.dual = how.weights = false;
  how.colors.reset();
  how.cells.reset();
  const Viewport viewport = make_viewport(sections, how);
  std::vector<Shown> shown;
  shown.reserve(sections.size());
  for (const Section& section : sections) {
    const std::string id = section.name.empty() ? "panel" : section.name;
    shown.push_back({draw_panel(section, viewport, how, id), section.name, section.where});
  }
  return document(shown, viewport, how, {"bad " + sections.front().element, sections.front().scale});
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
