// The energy of one edge for the accuracy objective (accuracy_energy.hpp), the barrier behind it, and their
// derivatives. Everything is for one edge (T = double) or for eight at once (T = Pack).
//
//     W(L, G, H, δw) = s_e⁻² (G/L) (a L² + b G² + p δw² + q H²) = s_e⁻² (a G L + K/L),    K = G (b G² + p δw² + q H²)
//
// Domain L > 0. Scaling exponent 4, without s_e. Odd in G and H together, even in δw.
#pragma once

#include "base/pack.hpp"
#include "base/portable_log.hpp"
#include "energy/edge_kernels.hpp"

namespace temper {

struct AccuracyModel {
  double length = 0, dual = 0, crossing = 0, height = 0;  ///< a, b, p, q
  double boundary_height = 0;                             ///< q of an edge on the boundary
  double margin = 0;                                      ///< ε
  double barrier = 0;                                     ///< μ
  double min_edge = 0, min_dual = 0;                      ///< of edge and dual edge, over the local size

  /// Says whether there is a barrier of edges too.
  [[nodiscard]] bool keeps_lengths() const { return min_edge > 0 || min_dual > 0; }

  /// α and β of the star, c, c_b.
  [[nodiscard]] static AccuracyModel of(double alpha, double beta, double offset, double boundary_offset);
};

/// The barrier of an edge: its factor m, and the lower bounds of its squared length and its dual's squared length.
template <class T>
struct LengthBarrier {
  T factor, l2, dual2;
};

/// An edge: all that its energy depends on.
template <class T>
struct AccuracyEdge {
  T scale, height;   ///< s_e⁻², q
  T l2, inverse_l2;  ///< L, 1/L
  T dw;              ///< δw
  T left, right;     ///< g on its two sides: G = left + right, H = left − right
};

template <class T>
[[nodiscard]] TEMPER_INLINE T edge_value(const AccuracyModel& k, const AccuracyEdge<T>& e) {
  const T sum = e.left + e.right, difference = e.left - e.right;
  const T rest = k.crossing * (e.dw * e.dw) + e.height * difference * difference;
  return e.scale * (sum * (k.length * e.l2 + (k.dual * sum * sum + rest) * e.inverse_l2));
}

/// The derivatives ∂ and ∂² of W in L, in g on the left and on the right, and in δw.
template <class T>
struct EdgeSlopes {
  struct Side {
    T g, gg, lg;
  };
  Side left, right;
  T l, dw, l_l, l_dw, dw_dw;
  T left_right, side_dw;  // side: left or right, the same
};

template <class T>
[[nodiscard]] TEMPER_INLINE EdgeSlopes<T> edge_slopes(const AccuracyModel& model, const AccuracyEdge<T>& e) {
  const T length = model.length * e.scale, dual = model.dual * e.scale, crossing = model.crossing * e.scale;
  const T height = e.height * e.scale;
  const T g = e.left + e.right, h = e.left - e.right, inverse2 = e.inverse_l2 * e.inverse_l2;
  const T rest = crossing * (e.dw * e.dw) + height * h * h;
  const T cubic = g * (dual * g * g + rest), by_g = 3 * (dual * g * g) + rest;  // K, ∂K
  const T by_h = 2 * (height * g * h), by_dw = 2 * (crossing * g * e.dw);
  const T w_g = length * e.l2 + by_g * e.inverse_l2, w_h = by_h * e.inverse_l2;
  const T w_lg = length - by_g * inverse2, w_lh = by_h * inverse2;
  const T w_gg = 6 * (dual * g * e.inverse_l2), w_hh = 2 * (height * g * e.inverse_l2);
  const T w_gh = 4 * (height * h * e.inverse_l2);  // twice
  EdgeSlopes<T> s;
  s.left = {w_g + w_h, w_gg + w_hh + w_gh, w_lg - w_lh};
  s.right = {w_g - w_h, w_gg + w_hh - w_gh, w_lg + w_lh};
  s.left_right = w_gg - w_hh;
  s.l = length * g - cubic * inverse2;
  s.l_l = 2 * (cubic * (inverse2 * e.inverse_l2));
  s.dw = by_dw * e.inverse_l2;
  s.l_dw = -by_dw * inverse2;
  s.side_dw = 2 * (crossing * e.dw * e.inverse_l2);
  s.dw_dw = 2 * (crossing * g * e.inverse_l2);
  return s;
}

/// A triangle's barrier: its factor m and its floor.
template <class T>
struct TriangleBarrier {
  T factor, floor;
};

/// Adds − m ln(g/L − ε) of the triangle on one side.
template <class T>
TEMPER_INLINE void add_height_barrier(const TriangleBarrier<T>& of, const T& l2, const T& inverse_l2, const T& g,
                                      EdgeSlopes<T>& s, typename EdgeSlopes<T>::Side& side) {
  const T room = 1.0 / (g - of.floor * l2), by_g = -of.factor * room, by_gg = of.factor * room * room;
  const T m_over_l = of.factor * inverse_l2;
  side.g = side.g + by_g;
  side.gg = side.gg + by_gg;
  side.lg = side.lg - of.floor * by_gg;
  s.l = s.l + (m_over_l - of.floor * by_g);
  s.l_l = s.l_l + (of.floor * of.floor * by_gg - m_over_l * inverse_l2);
}

/// Adds − ½ m ln((½ − ε)² − δw²/4L²), with Q = (½ − ε)² L² − δw²/4.
template <class T>
TEMPER_INLINE void add_crossing_barrier(const TriangleBarrier<T>& of, const T& l2, const T& inverse_l2, const T& dw,
                                        EdgeSlopes<T>& s) {
  const T most = 0.5 - of.floor, kl = most * most * l2, dw4 = 0.25 * dw;
  const T inverse_q = 1.0 / (kl * l2 - dw4 * dw), m_q = of.factor * inverse_q, m_qq = m_q * inverse_q;
  const T m_over_l = of.factor * inverse_l2;
  s.l = s.l + (m_over_l - m_q * kl);
  s.dw = s.dw + m_q * dw4;
  s.l_l = s.l_l + (2 * (m_qq * kl * kl) - m_q * (most * most) - m_over_l * inverse_l2);
  s.l_dw = s.l_dw - 2 * (m_qq * kl * dw4);
  s.dw_dw = s.dw_dw + (0.25 * m_q + 2 * (m_qq * dw4 * dw4));
}

/// Adds − ½ m ln[(L − L₀)(G² − D₀ L)/L], for an edge longer than √L₀ whose dual is longer than √D₀.
template <class T>
TEMPER_INLINE void add_length_barrier(const LengthBarrier<T>& of, const AccuracyEdge<T>& e, EdgeSlopes<T>& s) {
  const T g = e.left + e.right;
  const T by_room = 1.0 / (e.l2 - of.l2), by_dual = 1.0 / (g * g - of.dual2 * e.l2), half = 0.5 * of.factor;
  const T l_over = of.dual2 * by_dual, g_over = of.factor * g * by_dual;
  s.l = s.l + half * (e.inverse_l2 + l_over - by_room);
  s.l_l = s.l_l + half * (by_room * by_room + l_over * l_over - e.inverse_l2 * e.inverse_l2);
  const T by_gg = 2 * (g_over * g * by_dual) - of.factor * by_dual, by_lg = -g_over * l_over;
  for (typename EdgeSlopes<T>::Side* side : {&s.left, &s.right}) {
    side->g = side->g - g_over;
    side->gg = side->gg + by_gg;
    side->lg = side->lg + by_lg;
  }
  s.left_right = s.left_right + by_gg;
}

/// (d_ij/ℓ − ε)(d_ji/ℓ − ε), y = δw/ℓ²; both are positive where this is, for an ε below ½ and |y| < 1.
template <class T>
[[nodiscard]] TEMPER_INLINE T crossing_room(const T& y, const T& floor) {
  const T most = 0.5 - floor;
  return most * most - 0.25 * y * y;
}

/// The barrier of add_length_barrier(); +∞ outside its domain. Precondition: G > 0.
template <class T>
[[nodiscard]] TEMPER_INLINE T length_barrier(const LengthBarrier<T>& of, const AccuracyEdge<T>& e) {
  const T g = e.left + e.right, zero = all<T>(0);
  const T length = e.l2 - of.l2, dual = g * g - of.dual2 * e.l2;
  const T value = -0.5 * of.factor * portable_log(length * dual * e.inverse_l2);
  return select((length > zero) & (dual > zero), value, all<T>(kInfinity));
}

}  // namespace temper
