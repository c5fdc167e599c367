// Energy and barrier of the accuracy objective as a function of one vertex (T = double), or of eight in lanes
// (T = Pack). In is InPlaneOf<T> in the plane, or OnSphereOf<T> on the sphere.
//
//              q2 ------- q1            triangle i = (center, q_i, q_{i+1}), counter-clockwise
//             /  \  t1  /   \           spoke i    = center → q_i, in triangle i on its left, in i − 1 on its right
//            /  t2\    /  t0 \          link edge i = q_i → q_{i+1}; the height of its outer triangle stays
//          q3 ---- center --- q0        closed: q_n is q_0 again, and spoke n is none
//
// Lanes may have different numbers of triangles. Shorter lanes compute with missing triangles, too, and drop the
// results.
#pragma once

#include "energy/accuracy_edge.hpp"
#include "energy/edge_kernels.hpp"
#include "geometry/height_derivatives.hpp"

namespace temper {

template <class In>
struct AccuracySpoke {
  using T = typename In::Scalar;
  typename In::Point q;
  T scale, height;                    ///< of its edge: s_e⁻², q
  LengthBarrier<T> lengths;           ///< if the model has floors of lengths
  typename In::Spoke to;              ///< from here on: with the center where it was asked about last
  T inverse_l2;                       ///< 1/L
  T left, right;                      ///< g in the triangles on its two sides; 0 where there is none
  EdgeSlopes<T> slopes;               ///< of energy and barrier
  CornerVector<T> to_left, to_right;  ///< ∇left, ∇right

  [[nodiscard]] TEMPER_INLINE AccuracyEdge<T> edge() const {
    return {scale, height, to.l2, inverse_l2, to.dw, left, right};
  }
};

template <class In>
struct AccuracyTriangle {
  using T = typename In::Scalar;
  TriangleBarrier<T> barrier;
  AccuracyEdge<T> link;  ///< g in the outer triangle on its right; that on its left changes with the center
  LengthBarrier<T> link_lengths;
  T crossing_room;  ///< (d_ij/ℓ − ε)(d_ji/ℓ − ε) of the link edge
  T inverse_area;   ///< from here on: with the center where it was asked about last
  T room;           ///< its barrier is −½ m ln(room); −1 if a triangle is not above its floor
};

/// A star in views of the storage of all its spokes and triangles.
template <class In>
struct AccuracyStarOf {
  using T = typename In::Scalar;
  using Mask = decltype(T{} < T{});
  const AccuracyModel& model;
  AccuracySpoke<In>* spokes;        ///< most + 1
  AccuracyTriangle<In>* triangles;  ///< most
  std::size_t most;                 ///< triangles, of any lane
  T n_triangles, n_spokes;          ///< of each lane
  Mask open;

  [[nodiscard]] TEMPER_INLINE Mask has_triangle(std::size_t i) const {
    return n_triangles > all<T>(static_cast<double>(i));
  }
  [[nodiscard]] TEMPER_INLINE Mask has_spoke(std::size_t i) const { return n_spokes > all<T>(static_cast<double>(i)); }
};

/// The factor s_e⁻² of an edge between vertices of sizes s and t.
template <class T>
[[nodiscard]] TEMPER_INLINE T edge_scale(const T& s, const T& t) {
  return 4.0 / ((s + t) * (s + t));
}

/// The factor μ k s_t² of a triangle's barrier, with its floor f ≤ ε. k = 1 + 10 (ε²/f² − 1), but at most 1000: the
/// thinnest triangles gain most. Where edges must become longer, k = 1: their barriers are the urgent ones.
template <class T>
[[nodiscard]] TEMPER_INLINE T barrier_factor(const AccuracyModel& model, const T& s, const T& t, const T& u,
                                             const T& floor) {
  const T most = all<T>(1000), lack = all<T>(model.margin) / floor, k = 10 * (lack * lack) - all<T>(9);
  const T scale = (model.barrier / 9) * ((s + t + u) * (s + t + u));
  return model.keeps_lengths() ? scale : scale * select(k < most, k, most);
}

/// A point of the mesh and its size.
template <class In>
struct SizedPoint {
  typename In::Point at;
  typename In::Scalar size;
};

/// Sets the given values of spoke i, which leads to q. The ends of an open star are on the boundary.
template <class In>
TEMPER_INLINE void set_spoke(const AccuracyStarOf<In>& star, std::size_t i, const typename In::Scalar& size,
                             const SizedPoint<In>& q) {
  using T = typename In::Scalar;
  AccuracySpoke<In>& s = star.spokes[i];
  const auto is_end = i == 0 ? star.open : star.open & (all<T>(static_cast<double>(i)) >= star.n_triangles);
  s.q = q.at;
  s.scale = edge_scale(size, q.size);
  s.height = select(is_end, all<T>(star.model.boundary_height), all<T>(star.model.height));
}

/// Sets the given values of triangle i, with q and r. `inner`: there is o across its link edge.
template <class In, class Mask>
TEMPER_INLINE void set_triangle(const AccuracyStarOf<In>& star, std::size_t i, const typename In::Scalar& size,
                                const SizedPoint<In>& q, const SizedPoint<In>& r, const typename In::Scalar& floor,
                                Mask inner, const typename In::Point& o) {
  using T = typename In::Scalar;
  const AccuracyModel& model = star.model;
  const typename In::Center from = seen_from(r.at);
  const typename In::Spoke back = spoke(from, q.at);
  const T outer = triangle_shape(back, spoke(from, o), q.at, o).pq.g, inverse_l2 = 1.0 / back.l2;
  AccuracyTriangle<In>& t = star.triangles[i];
  t.barrier = {barrier_factor(model, size, q.size, r.size, floor), floor};
  t.crossing_room = crossing_room(back.dw * inverse_l2, floor);
  t.link.scale = edge_scale(q.size, r.size);
  t.link.height = select(inner, all<T>(model.height), all<T>(model.boundary_height));
  t.link.l2 = back.l2, t.link.inverse_l2 = inverse_l2, t.link.dw = back.dw;
  t.link.right = select(inner, outer, all<T>(0));
}

template <class In>
TEMPER_INLINE void place_spoke(AccuracySpoke<In>& s, const typename In::Center& p) {
  s.to = spoke(p, s.q);
  s.inverse_l2 = 1.0 / s.to.l2;
}

/// Finds the heights of triangle i and the room above its floor.
template <class In>
TEMPER_INLINE void place_triangle(const AccuracyStarOf<In>& star, std::size_t i) {
  using T = typename In::Scalar;
  AccuracySpoke<In>&a = star.spokes[i], &b = star.spokes[i + 1];
  AccuracyTriangle<In>& t = star.triangles[i];
  const T floor = t.barrier.floor;
  const TriangleShapeOf<T> shape = triangle_shape(a.to, b.to, a.q, b.q);
  t.inverse_area = shape.inverse_area;
  a.left = shape.pq.g, b.right = shape.rp.g, t.link.left = shape.qr.g;
  const T ha = a.left * a.inverse_l2 - floor, hb = b.right * b.inverse_l2 - floor;
  const T hc = t.link.left * t.link.inverse_l2 - floor, heights = ha * hb * hc;
  const T da = crossing_room(a.to.dw * a.inverse_l2, floor), db = crossing_room(b.to.dw * b.inverse_l2, floor);
  const T zero = all<T>(0);
  const auto inside = (shape.doubled_area > zero) & (ha > zero) & (hb > zero) & (hc > zero) & (da > zero) & (db > zero);
  t.room = select(inside, heights * heights * (da * db * t.crossing_room), all<T>(-1));
}

/// Returns the barrier of triangle i, which has been placed, and the energy of its link edge, or +∞.
template <class In>
[[nodiscard]] TEMPER_INLINE auto triangle_value(const AccuracyStarOf<In>& star, std::size_t i) {
  using T = typename In::Scalar;
  const AccuracyTriangle<In>& t = star.triangles[i];
  T value = edge_value(star.model, t.link) - 0.5 * t.barrier.factor * portable_log(t.room);
  if (star.model.keeps_lengths()) value = value + length_barrier(t.link_lengths, t.link);
  return select(t.room > all<T>(0), value, all<T>(kInfinity));
}

/// Energy and barrier with the center at p; +∞ if a triangle turns over or is not above its floor.
template <class In>
[[nodiscard]] TEMPER_INLINE auto accuracy_value(const AccuracyStarOf<In>& star, const typename In::Center& p) {
  using T = typename In::Scalar;
  const T zero = all<T>(0);
  T sum = zero, last_right = zero;
  place_spoke(star.spokes[0], p);
  for (std::size_t i = 0; i < star.most; ++i) {
    const auto here = star.has_triangle(i);
    place_spoke(star.spokes[i + 1], p);
    place_triangle(star, i);
    star.spokes[i].left = select(here, star.spokes[i].left, zero);
    last_right = select(here, star.spokes[i + 1].right, last_right);
  }
  star.spokes[0].right = select(star.open, zero, last_right);
  star.spokes[star.most].left = zero;
  // A logarithm is a long chain of operations. In a separate loop the processor computes several of them at once.
  for (std::size_t i = 0; i < star.most; ++i) {
    sum = sum + select(star.has_triangle(i), triangle_value(star, i), zero);
  }
  for (std::size_t i = 0; i <= star.most; ++i) {
    const AccuracySpoke<In>& s = star.spokes[i];
    T value = edge_value(star.model, s.edge());
    if (star.model.keeps_lengths()) value = value + length_barrier(s.lengths, s.edge());
    sum = sum + select(star.has_spoke(i), value, zero);
  }
  return select(sum < all<T>(kInfinity), sum, all<T>(kInfinity));
}

/// Finds the derivatives of all that belongs to spoke i in its own terms, with the barriers of the triangles on its
/// sides. A factor of 0 is no barrier, whatever the floor: such lengths are below it.
template <class In, class T>
TEMPER_INLINE void find_slopes(const AccuracyStarOf<In>& star, std::size_t i, const TriangleBarrier<T>& left,
                               const TriangleBarrier<T>& right) {
  AccuracySpoke<In>& a = star.spokes[i];
  EdgeSlopes<T>& s = a.slopes;
  s = edge_slopes(star.model, a.edge());
  add_height_barrier(left, a.to.l2, a.inverse_l2, a.left, s, s.left);
  add_height_barrier(right, a.to.l2, a.inverse_l2, a.right, s, s.right);
  add_crossing_barrier(left, a.to.l2, a.inverse_l2, a.to.dw, s);
  add_crossing_barrier(right, a.to.l2, a.inverse_l2, a.to.dw, s);
  if (star.model.keeps_lengths()) add_length_barrier(a.lengths, a.edge(), s);
}

/// Finds the gradients of the heights of triangle i; adds the terms of their Hessians and of the link edge.
template <class In, class T>
TEMPER_INLINE void add_triangle(const AccuracyStarOf<In>& star, std::size_t i, CornerDerivatives<T>& sum) {
  AccuracySpoke<In>&a = star.spokes[i], &b = star.spokes[i + 1];
  const AccuracyTriangle<In>& t = star.triangles[i];
  const typename In::Heights g = heights_at_corner(a.to, b.to, t.inverse_area);
  a.to_left = g.pq, b.to_right = g.rp;
  EdgeSlopes<T> link = edge_slopes(star.model, t.link);
  add_height_barrier(t.barrier, t.link.l2, t.link.inverse_l2, t.link.left, link, link.left);
  if (star.model.keeps_lengths()) add_length_barrier(t.link_lengths, t.link, link);
  // In a closed star the last triangle has spoke 0 on its right.
  const T right = select(star.has_spoke(i + 1), b.slopes.right.g, star.spokes[0].slopes.right.g);
  auto h = CornerMatrix<T>::product(g.qr, link.left.gg * g.qr);
  g.add_hessian(a.slopes.left.g, link.left.g, right, h);
  sum.add(star.has_triangle(i), link.left.g * g.qr, h);
}

/// Adds spoke i by the chain rule in L, left, right and δw.
template <class In, class T>
TEMPER_INLINE void add_spoke(const AccuracyStarOf<In>& star, std::size_t i, CornerDerivatives<T>& sum) {
  const AccuracySpoke<In>& a = star.spokes[i];
  const EdgeSlopes<T>& s = a.slopes;
  const CornerVector<T>&left = a.to_left, &right = a.to_right;
  const auto to_l = gradient_of_l2(a.to);
  CornerVector<T> by_l = s.left.lg * left + s.right.lg * right;
  CornerVector<T> by_left = s.left.gg * left + s.left_right * right;
  CornerVector<T> by_right = s.left_right * left + s.right.gg * right;
  by_l = by_l + by_l2_and_dw(s.l_l, to_l, s.l_dw);
  by_left = by_left + by_l2_and_dw(s.left.lg, to_l, s.side_dw);
  by_right = by_right + by_l2_and_dw(s.right.lg, to_l, s.side_dw);
  auto h = CornerMatrix<T>::product(left, by_left);
  h.add(right, by_right);
  h.add(to_l, by_l);
  h.ww = h.ww + along_w(s.l_dw, to_l, s.side_dw * (left.w + right.w) + s.dw_dw);
  add_curvature(a.to, s.l, s.dw, h);
  sum.add(star.has_spoke(i), by_l2_and_dw(s.l, to_l, s.dw) + (s.left.g * left + s.right.g * right), h);
}

/// All derivatives at p, the point of the last call of accuracy_value(), which was finite.
template <class In>
[[nodiscard]] TEMPER_INLINE auto accuracy_derivatives(const AccuracyStarOf<In>& star, const typename In::Center& p) {
  using T = typename In::Scalar;
  const T zero = all<T>(0), below = all<T>(-1);
  const CornerVector<T> none = {zero, zero, zero};
  const TriangleBarrier<T> no_barrier = {zero, below};
  const auto where = [](auto mask, const TriangleBarrier<T>& x, const TriangleBarrier<T>& y) {
    return TriangleBarrier<T>{select(mask, x.factor, y.factor), select(mask, x.floor, y.floor)};
  };
  TriangleBarrier<T> right = no_barrier;
  for (std::size_t i = 0; i < star.most; ++i) right = where(star.has_triangle(i), star.triangles[i].barrier, right);
  right = where(star.open, no_barrier, right);
  for (std::size_t i = 0; i <= star.most; ++i) {
    const bool is_last = i == star.most;
    const TriangleBarrier<T> left =
        is_last ? no_barrier : where(star.has_triangle(i), star.triangles[i].barrier, no_barrier);
    find_slopes(star, i, left, right);
    if (!is_last) right = star.triangles[i].barrier;
  }
  CornerDerivatives<T> sum = {};
  CornerVector<T> last = none;
  for (std::size_t i = 0; i < star.most; ++i) {
    const auto here = star.has_triangle(i);
    add_triangle(star, i, sum);
    star.spokes[i].to_left = select(here, star.spokes[i].to_left, none);
    last = select(here, star.spokes[i + 1].to_right, last);
  }
  star.spokes[0].to_right = select(star.open, none, last);
  star.spokes[star.most].to_left = none;
  for (std::size_t i = 0; i <= star.most; ++i) add_spoke(star, i, sum);
  bend(p, sum);
  return sum;
}

}  // namespace temper
