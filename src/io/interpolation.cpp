#include "io/interpolation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace temper::io {
namespace {

using Corners = std::array<std::int32_t, 3>;

// Tolerance of barycentric coordinates: a place this near to an edge, relative to its triangle's height, is on it.
constexpr double kOnEdge = 1e-12;
// So far outside, relative to the triangle's height, rounding puts nothing: the place belongs to another triangle.
constexpr double kOutside = 1e-9;

/// Cells of a grid, each with the triangles whose boxes meet it.
class TriangleGrid {
 public:
  TriangleGrid(std::span<const Vec2> points, std::span<const Corners> triangles)
      : points_(points), triangles_(triangles) {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    Vec2 high{-kInf, -kInf};
    low_ = {kInf, kInf};
    for (const Vec2 p : points) {
      low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    side_ = std::max<std::size_t>(1, static_cast<std::size_t>(std::sqrt(static_cast<double>(triangles.size()))));
    cell_ = {(high.x - low_.x) / static_cast<double>(side_), (high.y - low_.y) / static_cast<double>(side_)};
    start_.assign(side_ * side_ + 1, 0);
    for (std::size_t t = 0; t < triangles.size(); ++t) each_cell(t, [&](std::size_t c) { ++start_[c + 1]; });
    for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
    items_.resize(start_.back());
    std::vector<std::size_t> next = start_;
    for (std::size_t t = 0; t < triangles.size(); ++t) each_cell(t, [&](std::size_t c) { items_[next[c]++] = t; });
  }

  [[nodiscard]] PointMean find(Vec2 p) const {
    Best best;
    const std::size_t c = column(p) + side_ * row(p);
    for (std::size_t i = start_[c]; i < start_[c + 1]; ++i) consider(items_[i], p, best);
    for (std::size_t t = 0; best.least < -kOutside && t < triangles_.size(); ++t) consider(t, p, best);
    return rounded(best.mean);
  }

 private:
  struct Best {
    double least = -std::numeric_limits<double>::infinity();
    PointMean mean;
  };

  [[nodiscard]] std::size_t index(double from_low, double cell) const {
    const double i = cell > 0 ? std::floor(from_low / cell) : 0;
    return static_cast<std::size_t>(std::clamp(i, 0.0, static_cast<double>(side_ - 1)));
  }
  [[nodiscard]] std::size_t column(Vec2 p) const { return index(p.x - low_.x, cell_.x); }
  [[nodiscard]] std::size_t row(Vec2 p) const { return index(p.y - low_.y, cell_.y); }
  [[nodiscard]] Vec2 corner(std::size_t t, std::size_t k) const {
    return points_[static_cast<std::size_t>(triangles_[t][k])];
  }

  template <class Use>
  void each_cell(std::size_t t, Use&& use) const {
    const Vec2 a = corner(t, 0), b = corner(t, 1), c = corner(t, 2);
    const Vec2 low{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y})};
    const Vec2 high{std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y})};
    for (std::size_t j = row(low); j <= row(high); ++j) {
      for (std::size_t i = column(low); i <= column(high); ++i) use(i + side_ * j);
    }
  }

  void consider(std::size_t t, Vec2 p, Best& best) const {
    const Vec2 a = corner(t, 0) - p, b = corner(t, 1) - p, c = corner(t, 2) - p;
    const double area = cross(b - a, c - a);
    const std::array<double, 3> weights = {cross(b, c) / area, cross(c, a) / area, cross(a, b) / area};
    const double least = std::min({weights[0], weights[1], weights[2]});
    if (least > best.least) best = {least, {triangles_[t], weights}};
  }

  static PointMean rounded(PointMean mean) {
    double sum = 0;
    for (double& w : mean.weights) sum += w = w < kOnEdge ? 0 : w;
    for (double& w : mean.weights) w /= sum;
    return mean;
  }

  std::span<const Vec2> points_;
  std::span<const Corners> triangles_;
  Vec2 low_, cell_;
  std::size_t side_ = 1;
  std::vector<std::size_t> start_, items_;
};

template <class T>
T interpolated(const std::vector<T>& values, std::size_t n, std::size_t component, const PointMean& place) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {  // NaN of a point that does not count must not spread
    const double value = values[n * static_cast<std::size_t>(place.points[k]) + component];
    if (place.weights[k] > 0) sum += place.weights[k] * value;
  }
  return static_cast<T>(sum);
}

template <class T>
std::optional<T> in_common(const std::vector<T>& values, std::size_t n, std::size_t component, const PointMean& place) {
  std::optional<T> common;
  for (std::size_t k = 0; k < 3; ++k) {
    if (place.weights[k] == 0) continue;
    const T value = values[n * static_cast<std::size_t>(place.points[k]) + component];
    if (common && *common != value) return std::nullopt;
    common = value;
  }
  return common;
}

}  // namespace

std::vector<PointMean> locate(std::span<const Vec2> points, std::span<const Corners> triangles,
                              std::span<const Vec2> places) {
  if (places.empty()) return {};
  const TriangleGrid grid(points, triangles);
  std::vector<PointMean> result;
  result.reserve(places.size());
  for (const Vec2 p : places) result.push_back(grid.find(p));
  return result;
}

bool append_means(DataArray& array, const std::vector<PointMean>& places) {
  const auto n = static_cast<std::size_t>(array.components);
  return std::visit(
      [&](auto& values) {
        using T = typename std::remove_cvref_t<decltype(values)>::value_type;
        std::vector<T> more;
        for (const PointMean& place : places) {
          for (std::size_t i = 0; i < n; ++i) {
            if constexpr (std::is_floating_point_v<T>) {
              more.push_back(interpolated(values, n, i, place));
            } else {
              const std::optional<T> value = in_common(values, n, i, place);
              if (!value) return false;
              more.push_back(*value);
            }
          }
        }
        values.insert(values.end(), more.begin(), more.end());
        return true;
      },
      array.values);
}

}  // namespace temper::io
