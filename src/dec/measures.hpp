// What the operators are made of, in each space: lengths, heights and areas of one edge or one triangle, from quotients
// of accurate determinants.
#pragma once

#include <cmath>

#include "dec/accurate.hpp"
#include "geometry/spherical_area.hpp"
#include "temper/dec.hpp"
#include "temper/detail/geometry.hpp"

namespace temper {

/// With S_k, S_l twice the areas of the triangles of an edge and D the power determinant of their four corners, moving
/// along the dual line from one orthocenter to the other changes the power of the fourth corner from −D / S_k to 0, at
/// the rate 2 S_l / ℓ. So (h_k + h_l) / ℓ = −D / (2 S_k S_l): accurate where the two heights cancel, and 0 for
/// cocircular points.
class PlaneMeasures {
 public:
  using Point = WeightedPoint;
  explicit PlaneMeasures(const Mesh& mesh) : mesh_(mesh) {}
  [[nodiscard]] Point point(VertexId v) const { return mesh_.point(v); }
  [[nodiscard]] Point point(VertexId v, const Point& near) const { return mesh_.point(v, near); }

  void triangle(DecComplex& c, TriangleId t) const {
    const auto [p, q, r] = mesh_.points(t);
    c.areas.push_back(0.5 * accurate::doubled_area(p.position(), q.position(), r.position()));
    c.orthocenters.push_back(orthocenter(p, q, r));
  }
  void line(DecComplex& /*c*/, DecEdge& edge) const {
    const WeightedPoint from = point(edge.from), to = point(edge.to, from);
    const Vec2 along = to.position() - from.position();
    const double l2 = squared_length(along);
    const double lower = accurate::doubled_split(from, to), upper = accurate::doubled_split(to, from);
    edge.length = std::sqrt(l2);
    edge.split = 0.5 * lower / edge.length;
    // From the nearer end: the midpoint is then as accurate as its distance from it.
    edge.midpoint = std::abs(lower) <= std::abs(upper) ? from.position() + (0.5 * lower / l2) * along
                                                       : to.position() - (0.5 * upper / l2) * along;
  }
  /// h over pq in pqr.
  [[nodiscard]] double height(const Point& p, const Point& q, const Point& r, double area, double length) const {
    return 0.5 * (accurate::height_numerator(p, q, r) / (2 * area)) / length;
  }
  /// h/ℓ over pq in pqr.
  [[nodiscard]] double end_ratio(const Point& p, const Point& q, const Point& r, double area, double /*length*/) const {
    const double l2 = squared_length(q.position() - p.position());
    return 0.5 * (accurate::height_numerator(p, q, r) / (2 * area)) / l2;
  }
  /// (h_k + h_l)/ℓ over pq, in pqr and qps, with their areas. 0 − D rather than −D: a tie is +0.
  [[nodiscard]] double dual_ratio(const Point& p, const Point& q, const Point& r, const Point& s,
                                  std::array<double, 2> areas, double /*length*/) const {
    return 0.5 * ((0 - accurate::power_determinant(p, q, r, s)) / (2 * areas[0])) / (2 * areas[1]);
  }

 private:
  const Mesh& mesh_;
};

/// The normals of the faces PQR and QPS are n_k × n_l = −D (Q − P), D their power determinant, so that the arc from one
/// orthocenter to the other has tan(h_k + h_l) = −D |PQ| / (n_k·n_l): accurate where the two heights cancel, and 0 for
/// cocircular points.
class SphereMeasures {
 public:
  using Point = Vec3;
  explicit SphereMeasures(const Mesh& mesh) : mesh_(mesh), radius_(mesh.space().radius()) {}
  [[nodiscard]] Point point(VertexId v) const { return mesh_.lifted_point(v); }
  [[nodiscard]] Point point(VertexId v, const Point& /*near*/) const { return point(v); }

  void triangle(DecComplex& c, TriangleId t) const {
    const auto [i, j, k] = mesh_.corners(t);
    const Vec3 p = point(i), q = point(j), r = point(k);
    c.areas.push_back(radius_ * radius_ * solid_angle(accurate::orientation_determinant(p, q, r), p, q, r));
    c.sphere_orthocenters.push_back(radius_ * orthocenter(p, q, r));
  }
  void line(DecComplex& c, DecEdge& edge) const {
    const Vec3 from = point(edge.from), to = point(edge.to), along = to - from;
    const double l2 = squared_length(along);
    const double lower = accurate::split_product(from, to), upper = accurate::split_product(to, from);
    const double across = length(cross(from, along));
    edge.length = radius_ * arc_length(from, to);
    edge.split = radius_ * std::atan2(lower, across);
    const Vec3 foot = std::abs(lower) <= std::abs(upper) ? from + (lower / l2) * along : to - (upper / l2) * along;
    c.sphere_midpoints.push_back(radius_ / length(foot) * foot);
  }
  [[nodiscard]] double height(const Point& p, const Point& q, const Point& r, double /*area*/,
                              double /*length*/) const {
    const Vec3 n = cross(q - p, r - p), m = cross(p, q - p);
    return radius_ * std::atan2(accurate::height_numerator(p, q, r), length(cross(m, n)));
  }
  [[nodiscard]] double end_ratio(const Point& p, const Point& q, const Point& r, double area, double length) const {
    return height(p, q, r, area, length) / length;
  }
  [[nodiscard]] double dual_ratio(const Point& p, const Point& q, const Point& r, const Point& s,
                                  std::array<double, 2> /*areas*/, double length) const {
    const Vec3 a = q - p, n_k = cross(a, r - p), n_l = cross(s - p, a);
    const double sine = (0 - accurate::power_determinant(p, q, r, s)) * temper::length(a);
    return radius_ * std::atan2(sine, dot(n_k, n_l)) / length;
  }

 private:
  const Mesh& mesh_;
  double radius_;
};

}  // namespace temper
