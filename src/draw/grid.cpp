// Several documents in one: nested <svg> elements, their ids told apart by a prefix.
#include <algorithm>
#include <string_view>

#include "draw/text.hpp"
#include "draw/xml.hpp"
#include "temper/draw.hpp"
#include "temper/detail/read_number.hpp"

namespace temper {
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

// Text between tags is left alone: it may look like an id.
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

// The root tag at a place; whatever else it says (font, colours, box) stays.
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
