#include "experiments/labeled_triangle.hpp"

#include <algorithm>
#include <cmath>

#include "experiments/text.hpp"
#include "experiments/triangle_drawing.hpp"
#include "temper/detail/geometry.hpp"

namespace temper::gallery {
namespace {

constexpr const char *kAlong = "#8a4b00", *kFill = "#dcecf9";
constexpr double kRoom = 40, kNameFont = 15;
constexpr double kBeside = 15;  // of a name from the line that it names
constexpr const char* kNames[3] = {"i", "j", "k"};

class Drawing {
 public:
  explicit Drawing(const LabeledTriangle& drawing) : p_(drawing.corners), center_(orthocenter(p_[0], p_[1], p_[2])) {
    low_ = high_ = center_;
    for (const WeightedPoint& v : p_) {
      const double r = std::sqrt(std::abs(v.w));
      low_ = {std::min(low_.x, v.x - r), std::min(low_.y, v.y - r)};
      high_ = {std::max(high_.x, v.x + r), std::max(high_.y, v.y + r)};
    }
    scale_ = (drawing.width - 2 * kRoom) / (high_.x - low_.x);
    width_ = drawing.width;
    height_ = scale_ * (high_.y - low_.y) + 2 * kRoom;
    middle_ = (1.0 / 3) * (p_[0].position() + p_[1].position() + p_[2].position());
  }

  void all_distances() {
    triangle();
    for (std::size_t k = 0; k < 3; ++k) edge(k, (k + 1) % 3, (k + 2) % 3);
    vertices();
  }

  void sub_triangle() {
    const Vec2 m = midpoint(0, 1);
    body_ += "<path d=\"M" + at(p_[0].position()) + "L" + at(m) + "L" + at(center_) + "Z\" fill=\"" + kFill + "\"/>\n";
    triangle();
    line(p_[0].position(), center_, kDual, " stroke-dasharray=\"3 3\"");
    edge(0, 1, 2);
    vertices();
  }

  [[nodiscard]] std::string svg() const {
    const std::string size = pixels(width_) + "\" height=\"" + pixels(height_);
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + size + "\" viewBox=\"0 0 " + pixels(width_) + " " +
           pixels(height_) + "\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"" + pixels(kNameFont) +
           "\">\n<rect width=\"" + size + "\" fill=\"#ffffff\"/>\n" + body_ + "</svg>\n";
  }

 private:
  [[nodiscard]] Vec2 on_page(Vec2 v) const {
    return {kRoom + scale_ * (v.x - low_.x), kRoom + scale_ * (high_.y - v.y)};
  }
  [[nodiscard]] std::string at(Vec2 v) const {
    const Vec2 q = on_page(v);
    return pixels(q.x) + " " + pixels(q.y);
  }
  [[nodiscard]] Vec2 midpoint(std::size_t i, std::size_t j) const {
    const Vec2 a = p_[i].position(), b = p_[j].position();
    return a + (dual_crossing(p_[i], p_[j]) / length(b - a)) * (b - a);
  }

  void line(Vec2 a, Vec2 b, const char* color, const std::string& style = "") {
    body_ += "<path d=\"M" + at(a) + "L" + at(b) + "\" fill=\"none\" stroke=\"" + color + "\"" + style + "/>\n";
  }
  void dot(Vec2 v, const char* color) {
    const Vec2 q = on_page(v);
    body_ += "<circle cx=\"" + pixels(q.x) + "\" cy=\"" + pixels(q.y) + "\" r=\"3\" fill=\"" + color + "\"/>\n";
  }
  /// Centered at v, moved `pixels_off` pixels along `direction` (of any length).
  void text(Vec2 v, Vec2 direction, double pixels_off, const std::string& name, const char* color) {
    const Vec2 q = on_page(v + (pixels_off / (scale_ * length(direction))) * direction);
    body_ += "<text x=\"" + pixels(q.x) + "\" y=\"" + pixels(q.y + kNameFont / 3) +
             "\" text-anchor=\"middle\" fill=\"" + color + "\">" + subscripted(name) + "</text>\n";
  }

  void triangle() {
    body_ += "<path d=\"M" + at(p_[0].position()) + "L" + at(p_[1].position()) + "L" + at(p_[2].position()) +
             "Z\" fill=\"none\" stroke=\"" + kInk + "\" stroke-width=\"1.5\" stroke-linejoin=\"round\"/>\n";
  }

  /// The dual of edge ij, and the names of its two d and of its h.
  void edge(std::size_t i, std::size_t j, std::size_t k) {
    const Vec2 a = p_[i].position(), b = p_[j].position(), m = midpoint(i, j);
    const Vec2 outwards = {(b - a).y, -(b - a).x};
    const std::string ij = std::string(kNames[i]) + kNames[j], ji = std::string(kNames[j]) + kNames[i];
    line(center_, m, kDual, " stroke-width=\"1.4\"");
    dot(m, kDual);
    text(m, outwards, kBeside + 4, "m_{" + ij + "}", kDual);
    text(0.5 * (a + m), outwards, kBeside, "d_{" + ij + "}", kAlong);
    text(0.5 * (m + b), outwards, kBeside, "d_{" + ji + "}", kAlong);
    text(0.5 * (center_ + m), b - a, kBeside, std::string("h_{") + kNames[k] + "}", kDual);
  }

  void vertices() {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 v = p_[k].position(), q = on_page(v);
      const double r = scale_ * std::sqrt(std::abs(p_[k].w));
      const bool positive = p_[k].w > 0;
      body_ += "<circle cx=\"" + pixels(q.x) + "\" cy=\"" + pixels(q.y) + "\" r=\"" + pixels(r) +
               "\" fill=\"none\" stroke=\"" + (positive ? kPositive : kNegative) +
               (positive ? "\"/>\n" : "\" stroke-dasharray=\"4 2\"/>\n");
      dot(v, kInk);
      text(v, v - middle_, kBeside, kNames[k], kInk);
    }
    dot(center_, kDual);
    text(center_, {0, 1}, kBeside, "o", kDual);
  }

  const Corners p_;
  const Vec2 center_;
  Vec2 low_, high_, middle_;
  double scale_ = 1, width_ = 0, height_ = 0;
  std::string body_;
};

}  // namespace

std::string labeled_triangle_svg(const LabeledTriangle& drawing) {
  Drawing page(drawing);
  drawing.sub_triangle ? page.sub_triangle() : page.all_distances();
  return page.svg();
}

}  // namespace temper::gallery
