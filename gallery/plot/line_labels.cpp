#include "plot/line_labels.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace temper {
namespace {

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

}  // namespace

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

}  // namespace temper
