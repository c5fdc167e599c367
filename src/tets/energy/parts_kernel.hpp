// The parts of one tetrahedron and their derivatives (parts.hpp), written once for all packs. Each instruction set
// needs tables of its own, so they are plain arrays of the class.
#pragma once

#include <cstddef>

#include "tets/energy/parts.hpp"
#include "tets/energy/star_kernel.hpp"
#include "tets/mesh/tables.hpp"

namespace temper::tets {

/// A positive tetrahedron, with its orthocenters.
template <class T>
class TetDuals {
 public:
  TEMPER_INLINE explicit TetDuals(const PointVector<T> (&points)[4]) {
    for (std::size_t k = 0; k < 4; ++k) {
      at_[k] = points[k].at - points[0].at;
      weight_[k] = points[k].w;
    }
    for (std::size_t f = 0; f < 4; ++f) {
      const auto& [p, q, r] = kPlain.faces[f];
      const V a = at_[q] - at_[p], b = at_[r] - at_[p], n = cross(a, b);
      const T at_q = dot(a, a) - weight_[q] + weight_[p], at_r = dot(b, b) - weight_[r] + weight_[p];
      normal_[f] = n;
      center_[f] = at_[p] + 0.5 / dot(n, n) * (at_q * cross(b, n) + at_r * cross(n, a));
    }
    const V u = at_[3];
    volume6_ = dot(normal_[3], u);
    const T power = dot(u, u) - weight_[3] + weight_[0] - 2 * dot(center_[3], u);
    orthocenter_ = center_[3] + power / (2 * volume6_) * normal_[3];
  }

  [[nodiscard]] TEMPER_INLINE TetPartsOf<T> parts() const {
    TetPartsOf<T> parts;
    for (std::size_t e = 0; e < 6; ++e) {
      const Edge s = edge(e);
      const V a = center_[s.left], b = center_[s.right], x = s.crossing;
      const T first = 0.5 * dot(s.vector, cross(a - x, orthocenter_ - x));
      const T second = 0.5 * dot(s.vector, cross(orthocenter_ - x, b - x));
      const V both = x + orthocenter_;
      parts.edges[e] = {first + second,
                        first * (third_ * (both + a) - s.middle) + second * (third_ * (both + b) - s.middle)};
      parts.along[e] = s.along;
      parts.square[e] = s.square;
    }
    for (std::size_t f = 0; f < 4; ++f) {
      const auto& [p, q, r] = kPlain.faces[f];
      const T volume = 0.5 * dot(normal_[f], orthocenter_ - center_[f]);
      parts.faces[f] = {volume, volume * (half_ * (center_[f] + orthocenter_) - third_ * (at_[p] + at_[q] + at_[r]))};
      parts.height[f] = volume * height_of_volume(square_root(dot(normal_[f], normal_[f])));
    }
    return parts;
  }

  /// The derivatives of a function by the corners, from those by the parts.
  TEMPER_INLINE void pull_back(const TetPartsOf<T>& by, PointVector<T> (&by_corners)[4]) const {
    Slopes slopes;
    const auto add = [](V& to, const V& what) { to = to + what; };
    for (std::size_t e = 0; e < 6; ++e) {
      const Edge s = edge(e);
      const V x = s.crossing, to_a = center_[s.left] - x, to_o = orthocenter_ - x, to_b = center_[s.right] - x;
      const T first = 0.5 * dot(s.vector, cross(to_a, to_o)), second = 0.5 * dot(s.vector, cross(to_o, to_b));
      const V moment = by.edges[e].moment, third = third_ * moment;
      // A sum of two triangles, each with its centroid.
      const T base = by.edges[e].volume + dot(third, x + orthocenter_) - dot(moment, s.middle);
      const T by_first = base + dot(third, center_[s.left]), by_second = base + dot(third, center_[s.right]);
      const V by_a = 0.5 * by_first * cross(to_o, s.vector), by_b = 0.5 * by_second * cross(s.vector, to_o);
      const V by_o = half_ * cross(s.vector, by_first * to_a - by_second * to_b), volume = (first + second) * third;
      const V by_x = volume - (by_a + by_b + by_o);
      add(slopes.center[s.left], by_a + first * third);
      add(slopes.center[s.right], by_b + second * third);
      add(slopes.orthocenter, by_o + volume);
      const V by_vector =
          half_ * (by_first * cross(to_a, to_o) + by_second * cross(to_o, to_b)) + 2 * by.square[e] * s.vector;
      const V by_middle = all<T>(-1.5) * volume;
      // x = p_i + t e, and t = ½ + ½ (w_i − w_j)/|e|².
      const T by_along = (by.along[e] + dot(by_x, s.vector)) / s.square;
      const V by_ends = by_vector + s.along * by_x - by_along * (2 * s.along - all<T>(1)) * s.vector;
      add(slopes.at[s.i], by_middle + by_x - by_ends);
      add(slopes.at[s.j], by_middle + by_ends);
      slopes.weight[s.i] = slopes.weight[s.i] + 0.5 * by_along;
      slopes.weight[s.j] = slopes.weight[s.j] - 0.5 * by_along;
    }
    for (std::size_t f = 0; f < 4; ++f) {
      const std::size_t(&corners)[3] = kPlain.faces[f];
      const auto& [p, q, r] = corners;
      const V n = normal_[f], c = center_[f], dual = orthocenter_ - c, moment = by.faces[f].moment;
      const T n2 = dot(n, n), volume = 0.5 * dot(n, dual), to_height = height_of_volume(square_root(n2));
      const T by_volume = by.faces[f].volume + by.height[f] * to_height +
                          dot(moment, half_ * (c + orthocenter_) - third_ * (at_[p] + at_[q] + at_[r]));
      const V by_n = 0.5 * by_volume * dual - 1.5 * by.height[f] * volume * to_height / n2 * n;
      const V by_c = slopes.center[f] - 0.5 * by_volume * n + 0.5 * volume * moment;
      add(slopes.orthocenter, 0.5 * by_volume * n + 0.5 * volume * moment);
      // Across the face, c moves with the corners by its barycentric coordinates.
      const V across = dot(by_c, n) / n2 * n;
      for (std::size_t k = 0; k < 3; ++k) {
        const V from = at_[corners[(k + 1) % 3]], to = at_[corners[(k + 2) % 3]], opposite = to - from;
        const T phi = dot(cross(opposite, c - from), n) / n2;
        slopes.add_orthocenter(corners[k], by_c, 1 / n2 * cross(n, opposite), at_[corners[k]], c);
        add(slopes.at[corners[k]], phi * across - 1.0 / 3 * volume * moment + cross(by_n, opposite));
      }
    }
    for (std::size_t k = 0; k < 4; ++k) {
      slopes.add_orthocenter(k, slopes.orthocenter, 1 / volume6_ * normal_[k], at_[k], orthocenter_);
      by_corners[k] = {slopes.at[k], slopes.weight[k]};
    }
  }

 private:
  using V = Vector<T>;
  struct Tables {
    std::size_t edges[6][4];  ///< kEdgeCorners
    std::size_t faces[4][3];  ///< TetMesh::kFaceCorners
  };
  static constexpr Tables plain_tables() {
    Tables tables = {};
    for (std::size_t e = 0; e < 6; ++e) {
      for (std::size_t k = 0; k < 4; ++k) tables.edges[e][k] = static_cast<std::size_t>(kEdgeCorners[e][k]);
    }
    for (std::size_t f = 0; f < 4; ++f) {
      for (std::size_t k = 0; k < 3; ++k) tables.faces[f][k] = static_cast<std::size_t>(TetMesh::kFaceCorners[f][k]);
    }
    return tables;
  }
  static constexpr Tables kPlain = plain_tables();

  struct Edge {
    std::size_t i, j, left, right;  // its ends, and the faces of a and b
    V vector, crossing, middle;
    T square, along;
  };
  /// The derivatives of a function by all that parts are made of.
  struct Slopes {
    V at[4], center[4], orthocenter;
    T weight[4];

    TEMPER_INLINE Slopes() {
      const V zero = {all<T>(0), all<T>(0), all<T>(0)};
      for (std::size_t k = 0; k < 4; ++k) at[k] = center[k] = zero, weight[k] = all<T>(0);
      orthocenter = zero;
    }
    /// The corner at p with the barycentric coordinate φ takes its share of `slope`, the derivative by the orthocenter
    /// c of a simplex. In the simplex, c solves 2 (p_k − p_0) · c = |p_k|² − w_k − |p_0|² + w_0. So ½ slope · ∇φ is the
    /// derivative by |p − c|² − w with c kept.
    TEMPER_INLINE void add_orthocenter(std::size_t corner, const V& slope, const V& by_phi, const V& p, const V& c) {
      const T half = 0.5 * dot(slope, by_phi);
      at[corner] = at[corner] + 2 * half * (p - c);
      weight[corner] = weight[corner] - half;
    }
  };

  [[nodiscard]] TEMPER_INLINE Edge edge(std::size_t e) const {
    const auto& [i, j, k, l] = kPlain.edges[e];
    Edge edge;
    edge.i = i, edge.j = j, edge.left = l, edge.right = k;
    edge.vector = at_[j] - at_[i];
    edge.square = dot(edge.vector, edge.vector);
    edge.along = 0.5 + 0.5 * (weight_[i] - weight_[j]) / edge.square;
    edge.crossing = at_[i] + edge.along * edge.vector;
    edge.middle = half_ * (at_[i] + at_[j]);
    return edge;
  }
  /// h/ℓ over a face is its volume |σ| |σ*| times this.
  TEMPER_INLINE static T height_of_volume(const T& area2) { return 2 / (kLengthOfArea * area2 * square_root(area2)); }

  V at_[4];      // from the first corner
  V normal_[4];  // twice the areas of the faces, inward
  V center_[4];  // orthocenters of the faces
  V orthocenter_;
  T volume6_;
  T weight_[4];
  const T half_ = all<T>(0.5), third_ = all<T>(1.0 / 3);
};

}  // namespace temper::tets
