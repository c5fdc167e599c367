// The search along a Newton step. T = double: a step of one vertex, or of all in a part. T = Pack: of eight vertices.
#pragma once

#include "base/pack.hpp"
#include "geometry/height_derivatives.hpp"

namespace temper {

// The trust radius of the scaled unknowns: half a patch radius in position, half a squared one in weight.
inline constexpr double kTrustRadius = 0.5;
// Eigenvalues below this part of the largest are raised to it. The trust radius cuts such a step anyway.
inline constexpr double kEigenvalueFloor = 1e-6;

template <class T>
struct NewtonStepOf {
  T x, y, w;
  T predicted;                   ///< −∇E · step: twice the decrease of the quadratic model
  decltype(T{} < T{}) definite;  ///< whether the Hessian is; if not, this is no step
};

/// Returns the step (x, y, w) of the scaled unknowns, cut to the trust radius; g is −∇E.
template <class T>
[[nodiscard]] TEMPER_INLINE NewtonStepOf<T> within_trust_radius(const T& x, const T& y, const T& w,
                                                                const CornerVector<T>& g,
                                                                decltype(T{} < T{}) definite) {
  const T norm2 = x * x + y * y + w * w, far = all<T>(kTrustRadius * kTrustRadius);
  const T shrink = select(norm2 > far, kTrustRadius / square_root(norm2), all<T>(1));
  return {shrink * x, shrink * y, shrink * w, shrink * (x * g.x + y * g.y + w * g.w), definite};
}

/// Returns the step H⁻¹ g by LDLᵀ, cut to the trust radius, if all pivots are safely positive. A coordinate that is no
/// unknown has a curvature on the diagonal only.
template <class T>
[[nodiscard]] TEMPER_INLINE NewtonStepOf<T> scaled_newton_step(const CornerMatrix<T>& h, const CornerVector<T>& g) {
  const auto larger = [](const T& a, const T& b) { return select(a > b, a, b); };
  const T floor = kEigenvalueFloor * larger(larger(absolute(h.xx), absolute(h.yy)), absolute(h.ww));
  const T inverse_0 = 1.0 / h.xx;
  const T l10 = h.xy * inverse_0, l20 = h.xw * inverse_0;
  const T pivot_1 = h.yy - l10 * h.xy, inverse_1 = 1.0 / pivot_1;
  const T below = h.yw - l20 * h.xy;
  const T l21 = below * inverse_1;
  const T pivot_2 = h.ww - l20 * h.xw - l21 * below, inverse_2 = 1.0 / pivot_2;
  const T b1 = g.y - l10 * g.x, b2 = g.w - l20 * g.x - l21 * b1;
  const T w = b2 * inverse_2, y = b1 * inverse_1 - l21 * w, x = g.x * inverse_0 - l10 * y - l20 * w;
  return within_trust_radius(x, y, w, g, (h.xx > floor) & (pivot_1 > floor) & (pivot_2 > floor));
}

// Trials per Newton step: over-relaxed, plain, then halved.
inline constexpr int kTrials = 6;
// Trials per Newton step with margins, since a margin is usually near.
inline constexpr int kTrialsWithMargins = 12;
// A model decrease below this part of the patch energy is rounding, not progress.
inline constexpr double kNoGain = 1e-15;
// A step goes at most this part of the way to the first triangle's inversion.
inline constexpr double kInversionFraction = 0.9;

TEMPER_INLINE bool any(bool condition) { return condition; }
template <class Mask>
TEMPER_INLINE bool any(const Mask& mask) {
  return mask.bits() != 0;
}

/// Calls attempt(t, shorter, searching) until it is no longer searching. An attempt multiplies t by `shorter`, or by
/// another factor that it prefers. The first `shorter` makes the over-relaxed step plain.
template <class T, class Mask, class Attempt>
TEMPER_INLINE void damped_search(double relaxation, int trials, T t, Mask searching, Attempt&& attempt) {
  for (int trial = 0; trial < trials && any(searching); ++trial) {
    searching = attempt(t, trial == 0 && relaxation > 1 ? 1 / relaxation : 0.5, searching);
  }
}

/// Returns `limit`, cut so that the step of p keeps the triangle p, p + a, p + b away from its inversion. Signed areas
/// are linear along the step. Lanes in which `here` is not set keep `limit`.
template <class T, class Mask>
TEMPER_INLINE T before_inversion(T limit, const T (&a)[2], const T (&b)[2], const T (&step)[2], Mask here) {
  const T area = a[0] * b[1] - a[1] * b[0];
  const T slope = step[0] * (a[1] - b[1]) + step[1] * (b[0] - a[0]);
  const auto cut = here & (area + limit * slope < (1 - kInversionFraction) * area);
  return select(cut, -kInversionFraction * area / slope, limit);
}

}  // namespace temper
