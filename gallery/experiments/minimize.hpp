// Least values of functions of one and two numbers, without derivatives: landscapes are small, and a search that
// knows nothing of the energy is the better witness of its minima.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "temper/detail/vec.hpp"

namespace temper::gallery {

struct Minimum1 {
  double at = 0, value = 0;
};

/// Golden section in [low, high], until that part of it is left: the minimum of a function that falls and then rises,
/// else a local one. Values near a minimum tell half the digits of a double apart, so no part below 1e-8 does better.
template <class F>
[[nodiscard]] Minimum1 golden_minimum(F&& f, double low, double high, double tolerance = 1e-9) {
  constexpr double kGolden = std::numbers::phi - 1;
  const double enough = tolerance * (high - low);
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double fa = f(a), fb = f(b);
  while (high - low > enough) {
    if (fa <= fb) {
      high = b, b = a, fb = fa;
      a = high - kGolden * (high - low), fa = f(a);
    } else {
      low = a, a = b, fa = fb;
      b = low + kGolden * (high - low), fb = f(b);
    }
  }
  return fa <= fb ? Minimum1{a, fa} : Minimum1{b, fb};
}

/// The least of f at n + 1 equal steps, refined between its neighbors. With `inner`, minima at either end do not
/// count. Nothing when f is +∞ or NaN all over, or has no inner minimum.
template <class F>
[[nodiscard]] std::optional<Minimum1> scan_minimum(F&& f, double low, double high, int n, bool inner = false) {
  const auto at = [&](int i) { return low + (high - low) * i / n; };
  std::optional<int> best;
  double least = 0, before = f(at(0)), here = before, after = n > 0 ? f(at(1)) : before;
  for (int i = 0; i <= n; ++i) {
    const bool end = i == 0 || i == n;
    const bool is_minimum = std::isfinite(here) && (end || !(before < here)) && (end || here < after);
    if (is_minimum && !(inner && end) && (!best || here < least)) best = i, least = here;
    before = here;
    here = after;
    if (i + 2 <= n) after = f(at(i + 2));
  }
  if (!best) return std::nullopt;
  return golden_minimum(f, at(std::max(*best - 1, 0)), at(std::min(*best + 1, n)));
}

struct Minimum2 {
  Vec2 at;
  double value = 0;
};

/// Nelder and Mead's simplex from a start, with edges of `size`; f may be +∞. The second run starts where the
/// first ended, which gets it out of a simplex that has collapsed.
template <class F>
[[nodiscard]] Minimum2 simplex_minimum(F&& f, Vec2 start, double size, int steps = 200) {
  struct Corner {
    Vec2 p;
    double value;
  };
  Minimum2 best{start, f(start)};
  for (int run = 0; run < 2; ++run) {
    const auto corner = [&](Vec2 p) { return Corner{p, f(p)}; };
    std::array<Corner, 3> s = {corner(best.at), corner(best.at + Vec2{size, 0}), corner(best.at + Vec2{0, size})};
    for (int step = 0; step < steps; ++step) {
      std::sort(s.begin(), s.end(), [](const Corner& a, const Corner& b) { return a.value < b.value; });
      const Vec2 middle = 0.5 * (s[0].p + s[1].p);
      const auto along = [&](double t) { return corner(middle + t * (s[2].p - middle)); };
      const Corner reflected = along(-1);
      if (reflected.value < s[0].value) {
        const Corner expanded = along(-2);
        s[2] = expanded.value < reflected.value ? expanded : reflected;
      } else if (reflected.value < s[1].value) {
        s[2] = reflected;
      } else {
        const Corner contracted = along(reflected.value < s[2].value ? -0.5 : 0.5);
        if (contracted.value < std::min(reflected.value, s[2].value)) {
          s[2] = contracted;
        } else {
          s[1] = corner(0.5 * (s[0].p + s[1].p));
          s[2] = corner(0.5 * (s[0].p + s[2].p));
        }
      }
    }
    for (const Corner& c : s) {
      if (c.value < best.value) best = {c.p, c.value};
    }
  }
  return best;
}

}  // namespace temper::gallery
