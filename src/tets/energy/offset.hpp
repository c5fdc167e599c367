// Edges and faces with their duals, in parts of one tetrahedron each. T: a number, maybe with slopes.
//
// |σ| |σ*| and |σ| ∫_{σ*} (x − centroid of σ) of an edge or face σ are sums over the tetrahedra around σ, each part
// with the signs of its heights. They are made of the orthocenters, and so rational in positions and weights.
//
//       a ──── o      edge σ, seen along it: a and b are the orthocenters of its two faces in the tetrahedron, o is the
//      /       │      orthocenter of the tetrahedron, and x the crossing of σ with the plane of its dual face. The part
//     /        │      is a kite, the triangles x a o and x o b.
//    x ─────── b
//                     face σ: the part of its dual edge leads from the orthocenter of σ to o.
#pragma once

#include <array>
#include <cstddef>

#include "tets/geometry/formulas.hpp"

namespace temper::tets {

/// |σ| |σ*|, and |σ| ∫_{σ*} (x − centroid of σ).
template <class T>
struct Offset {
  T volume;
  Vector<T> moment;
  friend Offset operator+(const Offset& a, const Offset& b) { return {a.volume + b.volume, a.moment + b.moment}; }
};

/// A place and its weight.
template <class T>
struct Weighted {
  Vector<T> at;
  T w;
};

/// The crossing of edge pq, as a part of it from p.
template <class T>
T crossing(const Weighted<T>& p, const Weighted<T>& q) {
  const Vector<T> e = q.at - p.at;
  return T(0.5) + T(0.5) * (p.w - q.w) / dot(e, e);
}

/// The orthocenter of the face pqr.
template <class T>
Vector<T> orthocenter(const Weighted<T>& p, const Weighted<T>& q, const Weighted<T>& r) {
  const Vector<T> a = q.at - p.at, b = r.at - p.at, n = cross(a, b);
  const T half = T(0.5) / dot(n, n);
  return p.at + half * ((dot(a, a) - q.w + p.w) * cross(b, n) + (dot(b, b) - r.w + p.w) * cross(n, a));
}

/// The orthocenter of pqrs, from the `normal` (q − p) × (r − p) and the orthocenter `center` of pqr.
template <class T>
Vector<T> orthocenter(const Weighted<T>& p, const Weighted<T>& s, const Vector<T>& normal, const Vector<T>& center) {
  const Vector<T> u = s.at - p.at, to_center = center - p.at;
  return center + (dot(u, u) - s.w + p.w - T(2) * dot(to_center, u)) / (T(2) * dot(normal, u)) * normal;
}

/// The part of edge pq of the positive tetrahedron pqrs; a and b: the orthocenters of pqr and pqs.
template <class T>
Offset<T> edge_part(const Weighted<T>& p, const Weighted<T>& q, const Vector<T>& a, const Vector<T>& o,
                    const Vector<T>& b) {
  const T along = crossing(p, q);
  const Vector<T> e = q.at - p.at, x = p.at + along * e, to_a = a - x, to_o = o - x, to_b = b - x;
  const T first = T(0.5) * dot(e, cross(to_a, to_o)), second = T(0.5) * dot(e, cross(to_o, to_b));
  const T volume = first + second, third = T(1.0 / 3);
  return {volume, third * first * (to_a + to_o) + third * second * (to_o + to_b) + volume * (along - T(0.5)) * e};
}

/// The part of a face; `normal`: twice its area, into the tetrahedron.
template <class T>
Offset<T> face_part(const Vector<T>& normal, const Vector<T>& center, const Vector<T>& centroid, const Vector<T>& o) {
  const T volume = T(0.5) * dot(normal, o - center);
  return {volume, volume * (T(0.5) * (center + o) - centroid)};
}

}  // namespace temper::tets
