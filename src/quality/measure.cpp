#include "quality/measure.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace temper {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// d/ℓ = 1/2 + (w_p − w_q) / (2 ℓ²), from the end where it is less. A collapsed edge is not crossed at all.
double lesser_split(const WeightedPoint& p, const WeightedPoint& q) {
  const double squared = squared_length(q.position() - p.position());
  const double lean = std::abs(p.w - q.w);
  if (squared == 0) return -kInfinity;
  return 0.5 - lean / (2 * squared);
}

void measure_heights(TriangleMeasure& m, const std::array<WeightedPoint, 3>& p) {
  if (m.orientation != Sign::positive) {
    m.h_over_l.fill(-kInfinity);
    m.h_sign.fill(Sign::negative);
    return;
  }
  const std::array<double, 3> scaled = scaled_heights(p[0], p[1], p[2]);  // h ℓ of the edge across corner 0, 1, 2
  for (int k = 0; k < 3; ++k) {
    const WeightedPoint &a = p[k], &b = p[corner_after(k)], &c = p[corner_across(k)];
    m.h_sign[k] = signed_height_sign(a, b, c);
    const double ratio = scaled[corner_across(k)] / squared_length(b.position() - a.position());
    m.h_over_l[k] = ratio == ratio ? ratio : -kInfinity;  // 0/0 of a triangle that underflows
  }
}

TriangleMeasure measure_on_sphere(const std::array<Vec3, 3>& p) {
  TriangleMeasure m;
  m.orientation = orientation(p[0], p[1], p[2]);
  const bool upright = m.orientation == Sign::positive;
  for (int k = 0; k < 3; ++k) {
    const Vec3 a = p[k], b = p[corner_after(k)], c = p[corner_across(k)];
    const double l = arc_length(a, b);
    m.h_sign[k] = upright ? signed_height_sign(a, b, c) : Sign::negative;
    m.h_over_l[k] = upright ? signed_height(a, b, c) / l : -kInfinity;
    m.crossed[k] = edge_split_sign(a, b) == Sign::positive && edge_split_sign(b, a) == Sign::positive;
    m.d_over_l[k] = std::min(edge_split(a, b), edge_split(b, a)) / l;
    m.angle_deg[k] = corner_angle(a, b, c) * (180 / std::numbers::pi);
  }
  return m;
}

}  // namespace

bool TriangleMeasure::orthocenter_inside() const {
  return std::all_of(h_sign.begin(), h_sign.end(), [](Sign s) { return s == Sign::positive; });
}

bool TriangleMeasure::well_centered() const {
  return orthocenter_inside() && std::all_of(crossed.begin(), crossed.end(), [](bool c) { return c; });
}

double TriangleMeasure::margin() const {
  return std::min(*std::min_element(h_over_l.begin(), h_over_l.end()),
                  *std::min_element(d_over_l.begin(), d_over_l.end()));
}

TriangleMeasure measure_triangle(const Space& space, const std::array<WeightedPoint, 3>& p) {
  if (!space.is_plane()) return measure_on_sphere({lifted(p[0]), lifted(p[1]), lifted(p[2])});
  TriangleMeasure m;
  m.orientation = orient2d(p[0].position(), p[1].position(), p[2].position());
  measure_heights(m, p);
  for (int k = 0; k < 3; ++k) {
    const WeightedPoint &a = p[k], &b = p[corner_after(k)], &c = p[corner_across(k)];
    m.crossed[k] = edge_split_sign(a, b) == Sign::positive && edge_split_sign(b, a) == Sign::positive;
    m.d_over_l[k] = lesser_split(a, b);
    m.angle_deg[k] = std::abs(corner_angle(a.position(), b.position(), c.position())) * (180 / std::numbers::pi);
  }
  return m;
}

TriangleMeasure measure_triangle(const Mesh& mesh, TriangleId t) {
  return measure_triangle(mesh.space(), mesh.points(t));
}

}  // namespace temper
