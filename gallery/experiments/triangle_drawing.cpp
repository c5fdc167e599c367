#include "experiments/triangle_drawing.hpp"

#include <algorithm>
#include <cmath>

#include "experiments/text.hpp"
#include "prose.hpp"
#include "temper/detail/geometry.hpp"

namespace temper::gallery {
namespace {

constexpr double kFont = 14, kSmallFont = 12;
constexpr double kGap = 8;  // between cells and around the table, pixels

// Generous: markup and the bytes of a Greek letter count too.
double width_of(const std::string& text) {
  constexpr double kPerByte = 7.5;
  return kPerByte * static_cast<double>(text.size());
}

std::string text_at(double x, double y, const std::string& text, double size = kFont, const char* anchor = "middle") {
  return "<text x=\"" + pixels(x) + "\" y=\"" + pixels(y) + "\" font-size=\"" + pixels(size) + "\" text-anchor=\"" +
         anchor + "\">" + subscripted(text) + "</text>\n";
}

// One cell: pixels from the triangle's own coordinates.
class TriangleCell {
 public:
  TriangleCell(const TriangleTable& table, double left, double top)
      : scale_(table.cell_width / (table.high.x - table.low.x)),
        left_(left - scale_ * table.low.x),
        top_(top + scale_ * table.high.y) {}

  [[nodiscard]] std::string draw(const Corners& p) const {
    std::string svg;
    for (const WeightedPoint& v : p) svg += circle(v);
    svg += "<path d=\"M" + at(p[0].position()) + "L" + at(p[1].position()) + "L" + at(p[2].position()) +
           "Z\" fill=\"#00000010\" stroke=\"" + kInk + "\" stroke-width=\"1.1\" stroke-linejoin=\"round\"/>\n";
    const Vec2 center = orthocenter(p[0], p[1], p[2]);
    for (std::size_t k = 0; k < 3; ++k) svg += dual(center, p[k], p[(k + 1) % 3]);
    return svg + "<circle cx=\"" + pixels(x(center)) + "\" cy=\"" + pixels(y(center)) + "\" r=\"2\" fill=\"" + kDual +
           "\"/>\n";
  }

 private:
  [[nodiscard]] double x(Vec2 v) const { return left_ + scale_ * v.x; }
  [[nodiscard]] double y(Vec2 v) const { return top_ - scale_ * v.y; }
  [[nodiscard]] std::string at(Vec2 v) const { return pixels(x(v)) + " " + pixels(y(v)); }

  [[nodiscard]] std::string circle(const WeightedPoint& v) const {
    if (v.w == 0) return "";
    const std::string style =
        v.w > 0 ? std::string("stroke=\"") + kPositive : std::string("stroke-dasharray=\"4 2\" stroke=\"") + kNegative;
    return "<circle cx=\"" + pixels(x(v.position())) + "\" cy=\"" + pixels(y(v.position())) + "\" r=\"" +
           pixels(scale_ * std::sqrt(std::abs(v.w))) + "\" fill=\"none\" " + style + "\"/>\n";
  }

  // From the orthocenter to the weighted midpoint of the edge; dashed when that is outside the edge.
  [[nodiscard]] std::string dual(Vec2 center, const WeightedPoint& a, const WeightedPoint& b) const {
    const Vec2 along = b.position() - a.position();
    const double d = dual_crossing(a, b), l = length(along);
    const Vec2 middle = a.position() + (d / l) * along;
    const char* dash = d > 0 && d < l ? "" : " stroke-dasharray=\"3 2\"";
    return "<path d=\"M" + at(center) + "L" + at(middle) + "\" fill=\"none\" stroke=\"" + kDual + "\"" + dash + "/>\n";
  }

  double scale_, left_, top_;
};

}  // namespace

std::string subscripted(const std::string& text) {
  const std::size_t at = text.find("_{"), end = text.find('}');
  if (at == std::string::npos || end == std::string::npos) return escaped(text);
  return escaped(text.substr(0, at)) + "<tspan dy=\"0.3em\" font-size=\"70%\">" +
         escaped(text.substr(at + 2, end - at - 2)) + "</tspan><tspan dy=\"-0.21em\">" + escaped(text.substr(end + 1)) +
         "</tspan>";
}

std::string triangle_table_svg(const TriangleTable& table) {
  std::size_t columns = table.columns.size();
  double label_width = 0;
  bool captions = false;
  for (const TriangleRow& row : table.rows) {
    columns = std::max(columns, row.cells.size());
    label_width = std::max(label_width, width_of(row.label));
    for (const std::string& caption : row.captions) captions = captions || !caption.empty();
  }
  const double cell_height = table.cell_width * (table.high.y - table.low.y) / (table.high.x - table.low.x);
  const double row_height = cell_height + (captions ? kSmallFont + 6 : 0) + kGap;
  const double head = (table.title.empty() ? 0 : kFont + 12) + (table.columns.empty() ? 0 : kFont + 6) + kGap;
  const double left = kGap + label_width;
  const double width = left + static_cast<double>(columns) * (table.cell_width + kGap);
  const double height = head + static_cast<double>(table.rows.size()) * row_height + kGap;

  std::string body = "<defs><clipPath id=\"cell\"><rect width=\"" + pixels(table.cell_width) + "\" height=\"" +
                     pixels(cell_height) + "\"/></clipPath></defs>\n";
  if (!table.title.empty()) body += text_at(width / 2, kGap + kFont, table.title, kFont + 1);
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    const double x = left + (static_cast<double>(k) + 0.5) * (table.cell_width + kGap) - kGap / 2;
    body += text_at(x, head - kGap, table.columns[k]);
  }
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const TriangleRow& row = table.rows[r];
    const double top = head + static_cast<double>(r) * row_height;
    if (!row.label.empty()) body += text_at(kGap, top + cell_height / 2 + 5, row.label, kFont, "start");
    for (std::size_t k = 0; k < row.cells.size(); ++k) {
      const double x = left + static_cast<double>(k) * (table.cell_width + kGap);
      body += "<g transform=\"translate(" + pixels(x) + " " + pixels(top) + ")\">\n<g clip-path=\"url(#cell)\">\n";
      if (row.cells[k]) body += TriangleCell(table, 0, 0).draw(*row.cells[k]);
      body += "</g>\n";
      if (!row.cells[k]) body += text_at(table.cell_width / 2, cell_height / 2 + 4, "no solution", kSmallFont);
      if (k < row.captions.size())
        body += text_at(table.cell_width / 2, cell_height + kSmallFont, row.captions[k], kSmallFont);
      body += "<rect width=\"" + pixels(table.cell_width) + "\" height=\"" + pixels(cell_height) +
              "\" fill=\"none\" stroke=\"#c8c8c8\" stroke-width=\"0.6\"/>\n</g>\n";
    }
  }
  const std::string size = pixels(width) + "\" height=\"" + pixels(height);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + size + "\" viewBox=\"0 0 " + pixels(width) + " " +
         pixels(height) + "\" xml:space=\"preserve\" font-family=\"Helvetica, Arial, sans-serif\" fill=\"" + kInk +
         "\">\n<rect width=\"" + size + "\" fill=\"#ffffff\"/>\n" + body + "</svg>\n";
}

}  // namespace temper::gallery
