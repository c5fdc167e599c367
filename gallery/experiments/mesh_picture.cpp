#include "experiments/mesh_picture.hpp"

#include <algorithm>
#include <cmath>

#include "experiments/domain.hpp"
#include "experiments/text.hpp"
#include "experiments/triangle_drawing.hpp"
#include "prose.hpp"
#include "temper/detail/geometry.hpp"

namespace temper::gallery {
namespace {

constexpr double kLine = 20;  // height of a line of text, pixels
constexpr double kRadius = 4.5;
constexpr double kFar = 20;  // orthocenters of flat triangles lie anywhere: drawn up to so many box widths away
constexpr const char* kPrimal = "#333333";
constexpr const char* kLightDual = "#3d8fd1";
constexpr const char* kInverted = "#f0a3a3";

class Painter {
 public:
  Painter(const Mesh& mesh, const MeshPicture& picture)
      : mesh_(mesh), picture_(picture), scale_(picture.width / (picture.box.high.x - picture.box.low.x)) {}

  std::string paint() {
    const double height = scale_ * (picture_.box.high.y - picture_.box.low.y);
    const double top = picture_.title.empty() ? 0 : kLine, bottom = picture_.footer.empty() ? 0 : kLine;
    const std::string width = pixels(picture_.width), whole = pixels(top + height + bottom);
    fill_triangles();
    if (picture_.dual) draw_dual();
    draw_primal();
    if (picture_.weight_scale > 0) draw_weights();
    for (const Mark& mark : picture_.marks) draw_mark(mark);
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" + whole + "\" viewBox=\"0 0 " +
           width + " " + whole +
           "\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\">\n<clipPath id=\"box\">" +
           "<rect width=\"" + width + "\" height=\"" + pixels(height) + "\"/></clipPath>\n" + text(0, picture_.title) +
           "<g transform=\"translate(0 " + pixels(top) + ")\" clip-path=\"url(#box)\">\n" + body_ + "</g>\n" +
           text(top + height, picture_.footer) + "</svg>\n";
  }

 private:
  [[nodiscard]] std::string text(double above, const std::string& content) const {
    if (content.empty()) return "";
    return "<text x=\"" + pixels(picture_.width / 2) + "\" y=\"" + pixels(above + 0.75 * kLine) +
           "\" text-anchor=\"middle\">" + escaped(content) + "</text>\n";
  }
  [[nodiscard]] std::string at(Vec2 p) const {
    const double far = kFar * picture_.width;
    const double x = scale_ * (p.x - picture_.box.low.x), y = scale_ * (picture_.box.high.y - p.y);
    return pixels(std::clamp(x, -far, far)) + " " + pixels(std::clamp(y, -far, far));
  }
  void stroke(const std::string& path, const char* color, double width) {
    body_ += std::string("<path fill=\"none\" stroke=\"") + color + "\" stroke-width=\"" + pixels(width) +
             "\" stroke-linejoin=\"round\" d=\"" + path + "\"/>\n";
  }
  void fill(TriangleId t, const std::string& color) {
    const auto [a, b, c] = mesh_.corners(t);
    body_ += "<path fill=\"" + color + "\" stroke=\"" + color + "\" stroke-width=\"0.5\" d=\"M" +
             at(mesh_.position(a)) + "L" + at(mesh_.position(b)) + "L" + at(mesh_.position(c)) + "Z\"/>\n";
  }

  void fill_triangles() {
    for (const Shade& shade : picture_.shades) fill(shade.triangle, shade.color);
    if (!picture_.inverted) return;
    for (const TriangleId t : mesh_.triangles()) {
      const auto [a, b, c] = mesh_.corners(t);
      if (orient2d(mesh_.position(a), mesh_.position(b), mesh_.position(c)) == Sign::negative) fill(t, kInverted);
    }
  }

  void draw_primal() {
    std::string inner, boundary;
    for (const HalfedgeId h : mesh_.halfedges()) {
      if (!mesh_.is_edge_representative(h)) continue;
      (mesh_.is_boundary(h) ? boundary : inner) +=
          "M" + at(mesh_.position(mesh_.origin(h))) + "L" + at(mesh_.position(mesh_.target(h)));
    }
    stroke(inner, kPrimal, 0.7);
    stroke(boundary, kPrimal, 1.4);
  }

  [[nodiscard]] Vec2 weighted_midpoint(HalfedgeId h) const {
    const WeightedPoint a = mesh_.point(mesh_.origin(h)), b = mesh_.point(mesh_.target(h));
    const Vec2 along = b.position() - a.position();
    return a.position() + (dual_crossing(a, b) / length(along)) * along;
  }

  void draw_dual() {
    std::string path;
    for (const HalfedgeId h : mesh_.halfedges()) {
      if (!mesh_.is_edge_representative(h)) continue;
      const Vec2 from = orthocenter_of(mesh_, Mesh::triangle(h));
      const Vec2 to =
          mesh_.is_boundary(h) ? weighted_midpoint(h) : orthocenter_of(mesh_, Mesh::triangle(mesh_.twin(h)));
      if (std::isfinite(from.x + from.y + to.x + to.y)) path += "M" + at(from) + "L" + at(to);
    }
    stroke(path, kLightDual, 0.8);
  }

  void draw_weights() {
    for (const VertexId v : mesh_.vertices()) {
      const double radius = picture_.weight_scale * std::sqrt(std::abs(mesh_.weight(v))) * scale_;
      if (!(radius > 0) || radius > kFar * picture_.width) continue;
      const char* color = mesh_.weight(v) > 0 ? kPositive : kNegative;
      circle(mesh_.position(v), radius, std::string("fill=\"none\" stroke-width=\"0.9\" stroke=\"") + color + "\"");
    }
  }
  void circle(Vec2 p, double radius, const std::string& style) {
    const std::string center = at(p);
    const std::size_t space = center.find(' ');
    body_ += "<circle cx=\"" + center.substr(0, space) + "\" cy=\"" + center.substr(space + 1) + "\" r=\"" +
             pixels(radius) + "\" " + style + "/>\n";
  }

  void draw_mark(const Mark& mark) {
    circle(mark.at, kRadius, "stroke=\"#ffffff\" stroke-width=\"0.8\" fill=\"" + mark.color + "\"");
    if (mark.label.empty()) return;
    const double offset = 1.6 * kRadius / scale_;
    const std::string where = at(mark.at + Vec2{offset, offset});
    const std::size_t space = where.find(' ');
    body_ += "<text x=\"" + where.substr(0, space) + "\" y=\"" + where.substr(space + 1) +
             "\" font-size=\"15\" font-style=\"italic\" fill=\"" + mark.color +
             "\" stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\">" + escaped(mark.label) + "</text>\n";
  }

  const Mesh& mesh_;
  const MeshPicture& picture_;
  double scale_;
  std::string body_;
};

}  // namespace

std::string mesh_picture_svg(const Mesh& mesh, const MeshPicture& picture) { return Painter(mesh, picture).paint(); }

void add_mark(MeshPicture& picture, const Moment& moment, VertexId input, const char* color) {
  const VertexId v = moment.find(input);
  if (v.valid()) picture.marks.push_back({moment.mesh.position(v), color});
}

std::vector<Shade> cavities(const Moment& here, const Moment& there) {
  std::vector<Shade> shades;
  for (const TriangleId t : triangles_not_in(here, there)) shades.push_back({t, MarkColor::cavity});
  return shades;
}

}  // namespace temper::gallery
