#include "quality/measure.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/predicates_inline.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/quality.hpp"

namespace temper {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

// d/ℓ = 1/2 + (w_p − w_q) / (2 ℓ²), from the end with the lesser value. A collapsed edge is not crossed at all.
double lesser_crossing(const WeightedPoint& p, const WeightedPoint& q) {
  const double squared = squared_length(q.position() - p.position());
  const double lean = std::abs(p.w - q.w);
  if (squared == 0) return -kUnbounded;
  return 0.5 - lean / (2 * squared);
}

void measure_heights(TriangleMeasure& m, const std::array<WeightedPoint, 3>& p) {
  if (m.orientation != Sign::positive) {
    m.h_over_l.fill(-kUnbounded);
    m.h_sign.fill(Sign::negative);
    return;
  }
  const std::array<double, 3> scaled = scaled_heights(p[0], p[1], p[2]);  // h ℓ of the edge across corner 0, 1, 2
  for (int k = 0; k < 3; ++k) {
    const WeightedPoint &a = p[k], &b = p[corner_after(k)], &c = p[corner_across(k)];
    m.h_sign[k] = inlined::height_numerator_sign(a, b, c);  // the orientation is positive
    const double ratio = scaled[corner_across(k)] / squared_length(b.position() - a.position());
    m.h_over_l[k] = ratio == ratio ? ratio : -kUnbounded;  // 0/0 of a triangle that underflows
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
    m.h_over_l[k] = upright ? signed_height(a, b, c) / l : -kUnbounded;
    m.crossed[k] = dual_crossing_sign(a, b) == Sign::positive && dual_crossing_sign(b, a) == Sign::positive;
    m.d_over_l[k] = std::min(dual_crossing(a, b), dual_crossing(b, a)) / l;
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
  if (!space.is_plane()) return measure_on_sphere({as_vector(p[0]), as_vector(p[1]), as_vector(p[2])});
  TriangleMeasure m;
  m.orientation = inlined::orient2d(p[0].position(), p[1].position(), p[2].position());
  measure_heights(m, p);
  for (int k = 0; k < 3; ++k) {
    const WeightedPoint &a = p[k], &b = p[corner_after(k)], &c = p[corner_across(k)];
    m.crossed[k] = inlined::crosses_edge(a, b);
    m.d_over_l[k] = lesser_crossing(a, b);
    m.angle_deg[k] = std::abs(corner_angle(a.position(), b.position(), c.position())) * (180 / std::numbers::pi);
  }
  return m;
}

TriangleMeasure measure_triangle(const Mesh& mesh, TriangleId t) {
  TriangleMeasure m = measure_triangle(mesh.space(), mesh.points(t));
  for (int k = 0; k < 3 && m.orientation == Sign::positive; ++k) {
    if (!mesh.is_diagonal(Mesh::halfedge(t, k))) continue;
    // No edge of its cell, the quadrilateral: it limits nothing.
    m.h_sign[k] = Sign::positive, m.h_over_l[k] = kUnbounded;
    m.crossed[k] = true, m.d_over_l[k] = kUnbounded;
  }
  return m;
}

// Numbers of single triangles.

namespace {

double least_margin(const Mesh& mesh, TriangleId t) { return measure_triangle(mesh, t).margin(); }

double largest_angle(const Mesh& mesh, TriangleId t) {
  const auto [a, b, c] = mesh.points(t);
  const Space& space = mesh.space();
  const double angle =
      std::max({corner_angle(space, a, b, c), corner_angle(space, b, c, a), corner_angle(space, c, a, b)});
  return angle * 180 / std::numbers::pi;
}

double mean_edge(const Mesh& mesh, TriangleId t) {
  const auto [a, b, c] = mesh.points(t);
  return (distance(mesh.space(), a, b) + distance(mesh.space(), b, c) + distance(mesh.space(), c, a)) / 3;
}

template <class T>
T least(const std::array<T, 3>& of) {
  return *std::min_element(of.begin(), of.end());
}

TriangleQuality summary(const TriangleMeasure& m) {
  return {m.well_centered(), least(m.h_over_l), least(m.d_over_l), least(m.angle_deg)};
}

double region(const Mesh& mesh, TriangleId t) { return mesh.region(t); }

}  // namespace

TriangleQuality triangle_quality(const Mesh& mesh, TriangleId t) { return summary(measure_triangle(mesh, t)); }

TriangleQuality triangle_quality(const Space& space, const std::array<WeightedPoint, 3>& corners) {
  return summary(measure_triangle(space, corners));
}

std::span<const TriangleValue> triangle_values() {
  static constexpr auto kValues = std::to_array<TriangleValue>({
      {"quality", "least of h/ℓ, d/ℓ, 1 − d/ℓ", least_margin},
      {"angle", "largest angle (degrees)", largest_angle, Preference::less},
      {"size", "mean length of edges", mean_edge},
      {"region", "region", region},
  });
  return kValues;
}

namespace {

int least(const std::array<double, 3>& values) {
  return static_cast<int>(std::min_element(values.begin(), values.end()) - values.begin());
}

// One triangle, while the sentence about it is made.
struct Subject {
  const Mesh& mesh;
  TriangleId t;
  TriangleMeasure m;
  std::array<VertexId, 3> v;
  std::array<double, 3> l2;  // squared lengths of the edges
  const InputNames* names = nullptr;

  [[nodiscard]] std::string number(VertexId u) const { return number_of(u, names); }
  [[nodiscard]] std::string edge(int k) const {
    const std::string ends = number(v[k]) + "-" + number(v[corner_after(k)]);
    return (mesh.is_boundary(Mesh::halfedge(t, k)) ? "boundary edge " : "edge ") + ends;
  }
  [[nodiscard]] double weight(int k) const { return mesh.weight(v[k]); }
  [[nodiscard]] bool weights_equal() const { return weight(0) == weight(1) && weight(1) == weight(2); }
  [[nodiscard]] bool all_on_boundary() const {
    return mesh.is_boundary(v[0]) && mesh.is_boundary(v[1]) && mesh.is_boundary(v[2]);
  }
};

std::string why_not_inside(const Subject& s, int k) {
  const int across = corner_across(k);
  const double angle = s.m.angle_deg[across];
  const bool on_edge = s.m.h_sign[k] == Sign::zero;
  std::string why = on_edge ? "orthocenter on " : "orthocenter outside across ";
  why += s.edge(k) + ": ";
  if (s.weights_equal()) {
    why += on_edge ? "right angle at vertex " : "angle of " + degrees(angle) + " at vertex ";
    return why + s.number(s.v[across]);
  }
  why += "angle of " + degrees(angle) + " at vertex " + s.number(s.v[across]);
  why += angle < 90 ? ", but the weights push it there: " : ", and weights of ";
  return why + rounded(s.weight(across)) + " at vertex " + s.number(s.v[across]) + ", " + rounded(s.weight(k)) +
         " and " + rounded(s.weight(corner_after(k))) + " on the edge";
}

std::string why_not_crossed(const Subject& s, int k) {
  int heavy = k, light = corner_after(k);
  if (s.weight(heavy) < s.weight(light)) std::swap(heavy, light);
  return s.edge(k) + " is not crossed by its dual: the weight of vertex " + s.number(s.v[heavy]) +
         " exceeds that of vertex " + s.number(s.v[light]) + " by " + rounded(s.weight(heavy) - s.weight(light)) +
         ", and the edge's squared length is " + rounded(s.l2[k]);
}

std::string least_margin(const Subject& s) {
  const int h = least(s.m.h_over_l), d = least(s.m.d_over_l);
  if (s.m.d_over_l[d] < s.m.h_over_l[h]) {
    return "well-centered; least margin d/ℓ = " + rounded(s.m.d_over_l[d]) + " on " + s.edge(d);
  }
  const int across = corner_across(h);
  return "well-centered; least margin h/ℓ = " + rounded(s.m.h_over_l[h]) + " over " + s.edge(h) + ", angle of " +
         degrees(s.m.angle_deg[across]) + " at vertex " + s.number(s.v[across]);
}

// The edge over which the exact sign is not positive, with the least h/ℓ; −1 when there is none.
int edge_of_outside(const TriangleMeasure& m) {
  int found = -1;
  for (int k = 0; k < 3; ++k) {
    if (m.h_sign[k] == Sign::positive) continue;
    if (found < 0 || m.h_sign[k] < m.h_sign[found] ||
        (m.h_sign[k] == m.h_sign[found] && m.h_over_l[k] < m.h_over_l[found])) {
      found = k;
    }
  }
  return found;
}

std::string explain(const Subject& s) {
  if (s.m.orientation == Sign::negative) return "inverted: its corners turn clockwise";
  if (s.m.orientation == Sign::zero) return "no area: its corners are collinear";
  std::string why;
  const int outside = edge_of_outside(s.m);
  if (outside >= 0) why = why_not_inside(s, outside);
  const auto not_crossed = std::find(s.m.crossed.begin(), s.m.crossed.end(), false);
  if (not_crossed != s.m.crossed.end()) {
    if (!why.empty()) why += "; ";
    why += why_not_crossed(s, static_cast<int>(not_crossed - s.m.crossed.begin()));
  }
  if (why.empty()) return least_margin(s);
  if (s.all_on_boundary()) why += "; all its corners are on the boundary, so only weights and flips can change it";
  return why;
}

}  // namespace

std::string number_of(VertexId v, const InputNames* names) {
  return names == nullptr ? std::to_string(v.index) : last_word(names->point(v.index));
}

std::string number_of(TriangleId t, const InputNames* names) {
  return names == nullptr ? std::to_string(t.index) : last_word(names->triangle(t.index));
}

std::string degrees(double angle) {
  char buffer[64];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, angle, std::chars_format::fixed, 1);
  return std::string(buffer, result.ptr) + "°";
}

Vec2 middle_of(const Mesh& mesh, TriangleId t) {
  const auto [a, b, c] = mesh.points(t);
  const double part = mesh.space().dimension() == 2 ? 1.0 / 3 : 1;  // on the sphere the direction counts
  return mesh.space().as_shown(part * (as_vector(a) + as_vector(b) + as_vector(c)));
}

EdgePlace place_of(const Mesh& mesh, HalfedgeId h) {
  const WeightedPoint a = mesh.point(mesh.origin(h)), b = mesh.point(mesh.target(h), a);
  const double part = mesh.space().dimension() == 2 ? 0.5 : 1;
  return {{mesh.origin(h), mesh.target(h)}, mesh.space().as_shown(part * (as_vector(a) + as_vector(b)))};
}

WorstTriangle describe(const Mesh& mesh, TriangleId t, const InputNames* names) {
  const auto corners = mesh.corners(t);
  std::array<double, 3> l2;
  for (int k = 0; k < 3; ++k) {
    const WeightedPoint a = mesh.point(corners[k]), b = mesh.point(corners[corner_after(k)], a);
    l2[k] = squared_length(mesh.space().chord(a, b));
  }
  WorstTriangle worst = describe(mesh, t, measure_triangle(mesh, t), l2, names);
  worst.at = middle_of(mesh, t);
  return worst;
}

WorstTriangle describe(const Mesh& mesh, TriangleId t, const TriangleMeasure& m,
                       const std::array<double, 3>& squared_lengths, const InputNames* names) {
  const Subject s{mesh, t, m, mesh.corners(t), squared_lengths, names};
  WorstTriangle worst;
  worst.triangle = t;
  worst.vertices = s.v;
  worst.h_over_l = s.m.h_over_l[least(s.m.h_over_l)];
  worst.angle_deg = *std::max_element(s.m.angle_deg.begin(), s.m.angle_deg.end());
  worst.why = explain(s);
  return worst;
}

}  // namespace temper
