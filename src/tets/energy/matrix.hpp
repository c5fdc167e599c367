// Vectors and symmetric matrices in (x, y, z, w) of one vertex. T = double: of one tetrahedron.
#pragma once

#include "base/pack.hpp"
#include "tets/geometry/formulas.hpp"

namespace temper::tets {

template <class T>
struct PointVector {
  Vector<T> at;
  T w;
  friend TEMPER_INLINE PointVector operator+(const PointVector& a, const PointVector& b) {
    return {a.at + b.at, a.w + b.w};
  }
  friend TEMPER_INLINE PointVector operator*(const T& s, const PointVector& a) { return {s * a.at, s * a.w}; }
};

/// The upper half of a matrix that becomes symmetric when all terms are added.
template <class T>
struct PointMatrix {
  T xx, xy, xz, xw, yy, yz, yw, zz, zw, ww;

  /// Adds u⊗u times s.
  TEMPER_INLINE void add_square(const T& s, const PointVector<T>& u) { add(s * u, u); }
  /// Adds u⊗v + v⊗u, where u has no part in w.
  TEMPER_INLINE void add_both(const Vector<T>& u, const PointVector<T>& v) {
    add(u, v.at);
    add(v.at, u);
    xw = xw + u.x * v.w, yw = yw + u.y * v.w, zw = zw + u.z * v.w;
  }
  /// Adds s u⊗u, where u has no part in w.
  TEMPER_INLINE void add_square(const T& s, const Vector<T>& u) { add(s * u, u); }
  TEMPER_INLINE PointMatrix& operator+=(const PointMatrix& b) {
    xx = xx + b.xx, xy = xy + b.xy, xz = xz + b.xz, xw = xw + b.xw, yy = yy + b.yy;
    yz = yz + b.yz, yw = yw + b.yw, zz = zz + b.zz, zw = zw + b.zw, ww = ww + b.ww;
    return *this;
  }
  friend PointMatrix operator*(const T& s, const PointMatrix& a) {
    return {s * a.xx, s * a.xy, s * a.xz, s * a.xw, s * a.yy, s * a.yz, s * a.yw, s * a.zz, s * a.zw, s * a.ww};
  }
  /// Adds the unit matrix of the positions times s.
  TEMPER_INLINE void add_in_space(const T& s) { xx = xx + s, yy = yy + s, zz = zz + s; }

 private:
  TEMPER_INLINE void add(const Vector<T>& u, const Vector<T>& v) {
    xx = xx + u.x * v.x, xy = xy + u.x * v.y, xz = xz + u.x * v.z;
    yy = yy + u.y * v.y, yz = yz + u.y * v.z;
    zz = zz + u.z * v.z;
  }
  TEMPER_INLINE void add(const PointVector<T>& u, const PointVector<T>& v) {
    add(u.at, v.at);
    xw = xw + u.at.x * v.w, yw = yw + u.at.y * v.w, zw = zw + u.at.z * v.w;
    ww = ww + u.w * v.w;
  }
};

}  // namespace temper::tets
