// The search along a Newton step: of one vertex or of the vertices of a part (T = double), or of eight (T = Pack).
#pragma once

#include "base/pack.hpp"

namespace temper {

// Trials a Newton step: over-relaxed, plain, then halved.
inline constexpr int kTrials = 6;
// The same with margins, of which one is near more often than not.
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

/// Tries t, then less of it, until attempt(t, shorter, searching) is no longer searching. It makes t `shorter` times as
/// long, the over-relaxed step first plain, or whatever else it finds better.
template <class T, class Mask, class Attempt>
TEMPER_INLINE void damped_search(double relaxation, int trials, T t, Mask searching, Attempt&& attempt) {
  for (int trial = 0; trial < trials && any(searching); ++trial) {
    searching = attempt(t, trial == 0 && relaxation > 1 ? 1 / relaxation : 0.5, searching);
  }
}

/// `limit`, cut to where the step of p takes the triangle p, p + a, p + b too near to its inversion: signed areas are
/// linear along it. Only where `here` is set.
template <class T, class Mask>
TEMPER_INLINE T before_inversion(T limit, const T (&a)[2], const T (&b)[2], const T (&step)[2], Mask here) {
  const T area = a[0] * b[1] - a[1] * b[0];
  const T slope = step[0] * (a[1] - b[1]) + step[1] * (b[0] - a[0]);
  const auto cut = here & (area + limit * slope < (1 - kInversionFraction) * area);
  return select(cut, -kInversionFraction * area / slope, limit);
}

}  // namespace temper
