#include "tets/energy/parts.hpp"

#include <cmath>

#include "tets/energy/star_kernel.hpp"
#include "tets/mesh/tables.hpp"

namespace temper::tets {
namespace {

constexpr double kThird = 1.0 / 3;

std::array<std::size_t, 3> face_corners(std::size_t f) {
  const auto [a, b, c] = TetMesh::kFaceCorners[f];
  return {std::size_t(a), std::size_t(b), std::size_t(c)};
}

/// h/ℓ over a face is its volume |σ| |σ*| times this.
double height_of_volume(double area2) { return 2 / (kLengthOfArea * area2 * std::sqrt(area2)); }

/// The derivatives of a function by all that parts are made of.
struct Slopes {
  std::array<Vec3, 4> at = {}, center = {};
  Vec3 orthocenter;
  std::array<double, 4> weight = {};

  /// The corner at p with the barycentric coordinate φ takes its share of `slope`, the derivative by the orthocenter c
  /// of a simplex. In the simplex, c solves 2 (p_k − p_0) · c = |p_k|² − w_k − |p_0|² + w_0. So ½ slope · ∇φ is the
  /// derivative by |p − c|² − w with c kept.
  void add_orthocenter(std::size_t corner, Vec3 slope, Vec3 by_phi, Vec3 p, Vec3 c) {
    const double half = 0.5 * dot(slope, by_phi);
    at[corner] = at[corner] + 2 * half * (p - c);
    weight[corner] -= half;
  }
};

}  // namespace

TetDuals::TetDuals(const TetMesh& mesh, TetId t) {
  const auto points = mesh.points(t);
  for (std::size_t k = 0; k < 4; ++k) {
    at_[k] = points[k].position() - points[0].position();
    weight_[k] = points[k].w;
  }
  for (std::size_t f = 0; f < 4; ++f) {
    const auto [p, q, r] = face_corners(f);
    const Vec3 a = at_[q] - at_[p], b = at_[r] - at_[p], n = cross(a, b);
    const double at_q = dot(a, a) - weight_[q] + weight_[p], at_r = dot(b, b) - weight_[r] + weight_[p];
    normal_[f] = n;
    center_[f] = at_[p] + 0.5 / dot(n, n) * (at_q * cross(b, n) + at_r * cross(n, a));
  }
  const Vec3 u = at_[3], to_center = center_[3];
  volume6_ = dot(normal_[3], u);
  const double power = dot(u, u) - weight_[3] + weight_[0] - 2 * dot(to_center, u);
  orthocenter_ = center_[3] + power / (2 * volume6_) * normal_[3];
}

TetDuals::Edge TetDuals::edge(std::size_t e) const {
  const auto& [i, j, k, l] = kEdgeCorners[e];
  Edge edge = {std::size_t(i), std::size_t(j), std::size_t(l), std::size_t(k), {}, {}, {}, 0, 0};
  edge.vector = at_[edge.j] - at_[edge.i];
  edge.square = dot(edge.vector, edge.vector);
  edge.along = 0.5 + 0.5 * (weight_[edge.i] - weight_[edge.j]) / edge.square;
  edge.crossing = at_[edge.i] + edge.along * edge.vector;
  edge.middle = 0.5 * (at_[edge.i] + at_[edge.j]);
  return edge;
}

TetParts TetDuals::parts() const {
  TetParts parts;
  for (std::size_t e = 0; e < 6; ++e) {
    const Edge s = edge(e);
    const Vec3 a = center_[s.left], b = center_[s.right], x = s.crossing;
    const double first = 0.5 * dot(s.vector, cross(a - x, orthocenter_ - x));
    const double second = 0.5 * dot(s.vector, cross(orthocenter_ - x, b - x));
    const Vec3 both = x + orthocenter_;
    parts.edges[e] = {first + second,
                      first * (kThird * (both + a) - s.middle) + second * (kThird * (both + b) - s.middle)};
    parts.along[e] = s.along;
    parts.square[e] = s.square;
  }
  for (std::size_t f = 0; f < 4; ++f) {
    const auto [p, q, r] = face_corners(f);
    const double volume = 0.5 * dot(normal_[f], orthocenter_ - center_[f]);
    parts.faces[f] = {volume, volume * (0.5 * (center_[f] + orthocenter_) - kThird * (at_[p] + at_[q] + at_[r]))};
    parts.height[f] = volume * height_of_volume(length(normal_[f]));
  }
  return parts;
}

std::array<WeightedPoint, 4> TetDuals::pulled_back(const TetParts& by) const {
  Slopes slopes;
  const auto add = [](Vec3& to, Vec3 what) { to = to + what; };
  for (std::size_t e = 0; e < 6; ++e) {
    const Edge s = edge(e);
    const Vec3 x = s.crossing, to_a = center_[s.left] - x, to_o = orthocenter_ - x, to_b = center_[s.right] - x;
    const double first = 0.5 * dot(s.vector, cross(to_a, to_o)), second = 0.5 * dot(s.vector, cross(to_o, to_b));
    const Vec3 moment = by.edges[e].moment, third = kThird * moment;
    // A sum of two triangles, each with its centroid.
    const double base = by.edges[e].volume + dot(third, x + orthocenter_) - dot(moment, s.middle);
    const double by_first = base + dot(third, center_[s.left]), by_second = base + dot(third, center_[s.right]);
    const Vec3 by_a = 0.5 * by_first * cross(to_o, s.vector), by_b = 0.5 * by_second * cross(s.vector, to_o);
    const Vec3 by_o = 0.5 * cross(s.vector, by_first * to_a - by_second * to_b), volume = (first + second) * third;
    const Vec3 by_x = volume - (by_a + by_b + by_o);
    add(slopes.center[s.left], by_a + first * third);
    add(slopes.center[s.right], by_b + second * third);
    add(slopes.orthocenter, by_o + volume);
    const Vec3 by_vector =
        0.5 * (by_first * cross(to_a, to_o) + by_second * cross(to_o, to_b)) + 2 * by.square[e] * s.vector;
    const Vec3 by_middle = -1.5 * volume;
    // x = p_i + t e, and t = ½ + ½ (w_i − w_j)/|e|².
    const double by_along = (by.along[e] + dot(by_x, s.vector)) / s.square;
    const Vec3 by_ends = by_vector + s.along * by_x - by_along * (2 * s.along - 1) * s.vector;
    add(slopes.at[s.i], by_middle + by_x - by_ends);
    add(slopes.at[s.j], by_middle + by_ends);
    slopes.weight[s.i] += 0.5 * by_along, slopes.weight[s.j] -= 0.5 * by_along;
  }
  for (std::size_t f = 0; f < 4; ++f) {
    const auto corners = face_corners(f);
    const auto [p, q, r] = corners;
    const Vec3 n = normal_[f], c = center_[f], dual = orthocenter_ - c, moment = by.faces[f].moment;
    const double n2 = dot(n, n), volume = 0.5 * dot(n, dual), to_height = height_of_volume(std::sqrt(n2));
    const double by_volume = by.faces[f].volume + by.height[f] * to_height +
                             dot(moment, 0.5 * (c + orthocenter_) - kThird * (at_[p] + at_[q] + at_[r]));
    const Vec3 by_n = 0.5 * by_volume * dual - 1.5 * by.height[f] * volume * to_height / n2 * n;
    const Vec3 by_c = slopes.center[f] - 0.5 * by_volume * n + 0.5 * volume * moment;
    add(slopes.orthocenter, 0.5 * by_volume * n + 0.5 * volume * moment);
    // Across the face, c moves with the corners by its barycentric coordinates.
    const Vec3 across = dot(by_c, n) / n2 * n;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 from = at_[corners[(k + 1) % 3]], to = at_[corners[(k + 2) % 3]], opposite = to - from;
      const double phi = dot(cross(opposite, c - from), n) / n2;
      slopes.add_orthocenter(corners[k], by_c, 1 / n2 * cross(n, opposite), at_[corners[k]], c);
      add(slopes.at[corners[k]], phi * across - kThird * volume * moment + cross(by_n, opposite));
    }
  }
  std::array<WeightedPoint, 4> by_corners;
  for (std::size_t k = 0; k < 4; ++k) {
    slopes.add_orthocenter(k, slopes.orthocenter, 1 / volume6_ * normal_[k], at_[k], orthocenter_);
    const Vec3 by_place = slopes.at[k];
    by_corners[k] = {by_place.x, by_place.y, by_place.z, slopes.weight[k]};
  }
  return by_corners;
}

}  // namespace temper::tets
