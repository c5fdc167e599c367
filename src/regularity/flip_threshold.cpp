// The flip thresholds of §2.4, for both kinds of edges: F(t) of temper/regularity.hpp and its first crossing.
//
// Everything is seen from p, so that F(0) = −A loses no digits to the origin. Each edge gives one quadratic g(t) that
// is positive when the edge is not regular. A link edge has −F: it is regular while p does not conflict with the
// triangle beyond. A spoke to q has F: it is regular while p conflicts with the triangle of q and its two neighbors on
// the link.
#include "regularity/flip_threshold.hpp"

#include <algorithm>
#include <cmath>

#include "base/assert.hpp"
#include "regularity/lawson.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

/// c₀ + c₁ t + c₂ t².
struct Quadratic {
  double c0, c1, c2;
};

/// −F(t) on the sphere: the height of p(t) above the plane of the face.
Quadratic conflict_on_sphere(const WeightedPoint& p, const WeightedPoint& a, const WeightedPoint& b,
                             const WeightedPoint& c, const std::array<double, 3>& step) {
  const Vec3 from = as_vector(a), n = cross(as_vector(b) - from, as_vector(c) - from);
  return {dot(n, as_vector(p) - from), dot(n, {step[0], step[1], step[2]}), 0};
}

/// −F(t) in the plane, for the lifted points a, b, c seen from p. Positive when p(t) conflicts with the
/// counter-clockwise triangle abc.
Quadratic conflict_in_plane(const WeightedPoint& p, const WeightedPoint& a, const WeightedPoint& b,
                            const WeightedPoint& c, const std::array<double, 3>& step) {
  const auto lift = [&](const WeightedPoint& q) {
    const double x = q.x - p.x, y = q.y - p.y;
    return WeightedPoint{x, y, x * x + y * y - (q.w - p.w)};
  };
  const WeightedPoint u = lift(a), v = lift(b), w = lift(c);
  const auto minor = [](Vec2 i, Vec2 j, Vec2 k) {
    return (i.x * j.y - i.y * j.x) + (j.x * k.y - j.y * k.x) + (k.x * i.y - k.y * i.x);  // det of rows (1, ·, ·)
  };
  const double f0 = u.x * (v.y * w.w - v.w * w.y) - u.y * (v.x * w.w - v.w * w.x) + u.w * (v.x * w.y - v.y * w.x);
  const double bx = -minor({u.y, u.w}, {v.y, v.w}, {w.y, w.w});
  const double cy = minor({u.x, u.w}, {v.x, v.w}, {w.x, w.w});
  const double d = -minor(u.position(), v.position(), w.position());
  const auto [sx, sy, sw] = step;
  return {f0, bx * sx + cy * sy - d * sw, d * (sx * sx + sy * sy)};
}

/// The least t ≥ 0 past which g is positive. The exact g is not positive at 0: a positive c₀ is a rounded zero.
double first_crossing(Quadratic g) {
  if (g.c0 >= 0) {
    if (g.c1 < 0) return g.c2 > 0 ? -g.c1 / g.c2 : kNoThreshold;
    return g.c1 > 0 || g.c2 > 0 ? 0 : kNoThreshold;
  }
  if (g.c2 == 0) return g.c1 > 0 ? -g.c0 / g.c1 : kNoThreshold;
  const double discriminant = g.c1 * g.c1 - 4 * g.c2 * g.c0;
  if (!(discriminant > 0)) return kNoThreshold;  // with c₂ < 0: the line misses the orthocircle, or touches it
  // The stable pair of roots; with c₀ < 0 the least positive one is where g turns positive.
  const double q = -0.5 * (g.c1 + std::copysign(std::sqrt(discriminant), g.c1));
  double least = kNoThreshold;
  for (const double root : {q / g.c2, q != 0 ? g.c0 / q : kNoThreshold}) {
    if (root > 0) least = std::min(least, root);
  }
  return least;
}

/// Says whether g may be positive before t.
bool may_cross(const Quadratic& g, double t) {
  constexpr double kRounded = 1 - 1e-9;  // more than the rounding of a root
  return !(kRounded * g.c0 + t * (std::max(g.c1, 0.0) + t * std::max(g.c2, 0.0)) < 0);
}

template <auto conflict_along>
double flip_threshold_of(const Mesh& mesh, VertexId v, const std::array<double, 3>& step, double threshold) {
  const WeightedPoint p = mesh.point(v);
  const PowerTest test;
  for (const HalfedgeId h : mesh.star(v)) {
    const WeightedPoint q = mesh.point(mesh.target(h), p), r = mesh.point(mesh.opposite(h), p);
    for (const HalfedgeId e : {h, Mesh::next(h)}) {
      if (mesh.is_boundary(e) || mesh.is_constrained(e)) continue;
      const WeightedPoint across = mesh.point(mesh.opposite(mesh.twin(e)), q);
      Quadratic g = e == h ? conflict_along(p, across, q, r, step) : conflict_along(p, r, q, across, step);
      if (e == h) g = {-g.c0, -g.c1, -g.c2};
      if (!may_cross(g, threshold)) continue;
      const double crossing = first_crossing(g);
      if (!(crossing < threshold) || test(mesh, inlined::quad(mesh, e)) == Sign::positive) continue;
      threshold = crossing;  // of an edge that is regular as it is
    }
  }
  return threshold;
}

}  // namespace

double flip_threshold_up_to(const Mesh& mesh, VertexId v, const std::array<double, 3>& step, double most) {
  TEMPER_ASSERT(!mesh.is_isolated(v));
  return mesh.space().is_plane() ? flip_threshold_of<conflict_in_plane>(mesh, v, step, most)
                                 : flip_threshold_of<conflict_on_sphere>(mesh, v, step, most);
}

double flip_threshold(const Mesh& mesh, VertexId v, const std::array<double, 3>& step) {
  return flip_threshold_up_to(mesh, v, step, kNoThreshold);
}

double weight_flip_threshold(const Mesh& mesh, VertexId v, double direction) {
  const double sign = direction > 0 ? 1.0 : direction < 0 ? -1.0 : 0.0;
  if (mesh.space().is_plane()) return flip_threshold(mesh, v, {0, 0, sign});
  // P (1 ± t) has the weight |P|² (1 ± t)² − R²; past the center there is none.
  const Vec3 p = mesh.weighted_vector(v);
  const double t = flip_threshold(mesh, v, {sign * p.x, sign * p.y, sign * p.z});
  if (t == kNoThreshold || (sign < 0 && t >= 1)) return kNoThreshold;
  return squared_length(p) * t * (2 + sign * t);
}

double position_flip_threshold(const Mesh& mesh, VertexId v, Vec2 direction) {
  TEMPER_ASSERT(mesh.space().is_plane());
  return flip_threshold(mesh, v, {direction.x, direction.y, 0});
}

}  // namespace temper
