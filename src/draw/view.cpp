#include "draw/view.hpp"

#include <cmath>
#include <numbers>

namespace temper {
namespace {

constexpr double kPiece = 0.06;    // radians of an arc: 0.2 pixels from its chord on a disc of 900 pixels
constexpr int kCorners = 36;       // of a circle
constexpr double kOneSided = 0.5;  // length of the mean direction of what keeps to a half of the sphere
constexpr double kDegree = std::numbers::pi / 180;

Vec3 unit(Vec3 p) { return (1 / length(p)) * p; }

/// Where the arc between a point that is seen and one that is not meets the limb.
Vec3 on_limb(Vec3 a, Vec3 b) {
  const Vec3 p = a + (a.z / (a.z - b.z)) * (b - a);
  return unit({p.x, p.y, 0});
}

}  // namespace

View::View(double radius, Vec2 middle) : radius_(radius) {
  const double lon = kDegree * middle.x, lat = kDegree * middle.y;
  towards_ = {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
  right_ = {-std::sin(lon), std::cos(lon), 0};
  up_ = cross(towards_, right_);
}

Vec3 View::seen(const WeightedPoint& p) const {
  const Vec3 d = unit(lifted(p));
  return {dot(right_, d), dot(up_, d), dot(towards_, d)};
}

Vec2 View::at(const WeightedPoint& p) const {
  if (is_flat()) return p.position();
  const Vec3 s = seen(p);
  return {radius_ * s.x, radius_ * s.y};
}

bool View::shows(const WeightedPoint& p) const { return is_flat() || seen(p).z >= 0; }

/// Appends the arc without its end.
void View::add_arc(std::vector<Vec2>& chain, Vec3 a, Vec3 b) const {
  const int pieces = 1 + static_cast<int>(std::atan2(length(cross(a, b)), dot(a, b)) / kPiece);
  for (int i = 0; i < pieces; ++i) {
    const Vec3 p = i == 0 ? a : unit(a + (static_cast<double>(i) / pieces) * (b - a));
    chain.push_back({radius_ * p.x, radius_ * p.y});
  }
}

std::vector<Vec2> View::line(const WeightedPoint& p, const WeightedPoint& q) const {
  if (is_flat()) return {p.position(), q.position()};
  Vec3 a = seen(p), b = seen(q);
  if (!(a.z >= 0) && !(b.z >= 0)) return {};
  if (a.z < 0) a = on_limb(b, a);
  if (b.z < 0) b = on_limb(a, b);
  std::vector<Vec2> chain;
  add_arc(chain, a, b);
  chain.push_back({radius_ * b.x, radius_ * b.y});
  return chain;
}

std::vector<Vec2> View::polygon(const std::array<WeightedPoint, 3>& t) const {
  if (is_flat()) return {t[0].position(), t[1].position(), t[2].position()};
  const std::array<Vec3, 3> corners = {seen(t[0]), seen(t[1]), seen(t[2])};
  std::vector<Vec3> kept;  // of the triangle, before the limb
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 a = corners[i], b = corners[(i + 1) % 3];
    if (a.z >= 0) kept.push_back(a);
    if ((a.z < 0) != (b.z < 0)) kept.push_back(a.z < 0 ? on_limb(b, a) : on_limb(a, b));
  }
  std::vector<Vec2> polygon;
  for (std::size_t i = 0; i < kept.size(); ++i) add_arc(polygon, kept[i], kept[(i + 1) % kept.size()]);
  return polygon;
}

// The circle in the plane that touches the sphere at p, seen from the center.
std::vector<WeightedPoint> View::circle(const WeightedPoint& p, double radius) const {
  const Vec3 d = unit(lifted(p));
  const Vec3 axis = std::abs(d.z) < 0.5 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};  // not along d
  const Vec3 u = unit(cross(axis, d)), v = cross(d, u);
  std::vector<WeightedPoint> around;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    around.push_back(as_point(d + (radius / radius_) * (std::cos(angle) * u + std::sin(angle) * v)));
  }
  return around;
}

View make_view(std::span<const Mesh* const> meshes, const DrawOptions& options) {
  const Space space = meshes.empty() ? Space() : meshes.front()->space();
  if (space.radius() == 0) return {};
  if (options.view) return {space.radius(), *options.view};
  Vec3 sum;
  double count = 0;
  for (const Mesh* mesh : meshes) {
    for (const VertexId v : mesh->vertices()) sum = sum + unit(mesh->lifted_point(v)), ++count;
  }
  if (!(length(sum) > kOneSided * count)) return {space.radius(), {0, 0}};
  return {space.radius(), {std::atan2(sum.y, sum.x) / kDegree, std::atan2(sum.z, std::hypot(sum.x, sum.y)) / kDegree}};
}

}  // namespace temper
