// The energy of one edge of one triangle (both half-edges together), as a function of ℓ², w_i − w_j and g = h ℓ.
//
// ℓ cancels from every energy. With L = ℓ², d = (L + w)/(2ℓ) and d' = (L − w)/(2ℓ):
//   d² + d'² = (L² + w²)/(2L)     d d' = (L² − w²)/(4L)     d³ + d'³ = ℓ (L² + 3w²)/(4L)
// so that
//   F:                [α (L² + 3 w²)/4 + β g²] g / L
//   BH, BHs, BP:      [α (L² + w²) + 4 β g²] / (√(L² − w²) Φ)
//   with Φ = g (BH),  g + |h°| ℓ (BHs),  (g + √(g² + γ² L))/2 (BP), and γ = c ℓ, h° = −c ℓ when relative.
// Derivatives of the barriers go through their logarithm, which is a sum.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "geometry/triangle_kernel.hpp"
#include "temper/energy.hpp"

namespace temper {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// α and β of ★0, ★1, ★2.
inline constexpr std::array<double, 3> kAlpha = {1.0 / 4, 1.0 / 3, 1.0 / 12};
inline constexpr std::array<double, 3> kBeta = {1.0 / 12, 1.0 / 3, 1.0 / 4};

/// Value, gradient and Hessian of an edge energy in (L, w, g).
struct EdgeTerm {
  double f = 0;
  double f_l = 0, f_w = 0, f_g = 0;
  double f_ll = 0, f_lw = 0, f_lg = 0, f_ww = 0, f_wg = 0, f_gg = 0;
};

/// E_F of one edge in one triangle. Odd in g; signs and boundary treatments are factors applied outside.
struct HotKernel {
  static constexpr bool kBarrier = false;
  double alpha, beta;

  [[nodiscard]] double value(const EdgeShape& e) const {
    return (0.25 * alpha * (e.l2 * e.l2 + 3 * e.dw * e.dw) + beta * e.g * e.g) * e.g / e.l2;
  }

  [[nodiscard]] EdgeTerm term(const EdgeShape& e) const {
    const double l = e.l2, w = e.dw, g = e.g;
    const double inverse = 1.0 / l;
    const double wi = w * inverse, gi = g * inverse;
    const double a = 0.25 * alpha;
    EdgeTerm t;  // f = a g (L + 3 w²/L) + β g³/L
    t.f = a * g * (l + 3 * w * wi) + beta * g * g * gi;
    t.f_l = a * g * (1 - 3 * wi * wi) - beta * g * gi * gi;
    t.f_w = 6 * a * g * wi;
    t.f_g = a * (l + 3 * w * wi) + 3 * beta * g * gi;
    t.f_ll = 6 * a * gi * wi * wi + 2 * beta * gi * gi * gi;
    t.f_lw = -6 * a * gi * wi;
    t.f_lg = a * (1 - 3 * wi * wi) - 3 * beta * gi * gi;
    t.f_ww = 6 * a * gi;
    t.f_wg = 6 * a * wi;
    t.f_gg = 6 * beta * gi;
    return t;
  }
};

/// Φ and the derivatives of ln Φ.
struct Denominator {
  double phi = 0;
  double l = 0, g = 0;            // ∂ ln Φ
  double ll = 0, lg = 0, gg = 0;  // ∂² ln Φ
};

/// Φ = g + s₁ ℓ + s₂ L: E_BH with s = 0, E_BHs with s₁ = |h°| or s₂ = |h°|/ℓ. Infeasible at Φ ≤ 0.
struct ShiftedHeight {
  double s1 = 0, s2 = 0;

  [[nodiscard]] double phi(const EdgeShape& e) const { return e.g + s1 * std::sqrt(e.l2) + s2 * e.l2; }

  [[nodiscard]] Denominator denominator(const EdgeShape& e) const {
    const double root = s1 * std::sqrt(e.l2);
    Denominator d;
    d.phi = e.g + root + s2 * e.l2;
    const double inverse = 1.0 / d.phi;
    const double slope = 0.5 * root / e.l2 + s2;
    d.l = slope * inverse;
    d.g = inverse;
    d.ll = -0.25 * root / (e.l2 * e.l2) * inverse - d.l * d.l;
    d.lg = -d.l * d.g;
    d.gg = -inverse * inverse;
    return d;
  }
};

/// Φ = (g + R)/2, R = √(g² + M), M = m₁ L + m₂ L²: E_BP with m₁ = γ² or m₂ = (γ/ℓ)². Always positive.
struct SmoothedHeight {
  double m1 = 0, m2 = 0;

  [[nodiscard]] double phi(const EdgeShape& e) const {
    const double m = (m1 + m2 * e.l2) * e.l2;
    const double r = std::sqrt(e.g * e.g + m);
    return e.g >= 0 ? 0.5 * (e.g + r) : 0.5 * m / (r - e.g);  // no cancellation when g < 0
  }

  [[nodiscard]] Denominator denominator(const EdgeShape& e) const {
    const double m = (m1 + m2 * e.l2) * e.l2, slope = m1 + 2 * m2 * e.l2, curvature = 2 * m2;
    const double r = std::sqrt(e.g * e.g + m);
    const double inverse_r = 1.0 / r, cube = inverse_r * inverse_r * inverse_r;
    Denominator d;
    d.phi = e.g >= 0 ? 0.5 * (e.g + r) : 0.5 * m / (r - e.g);
    const double inverse = inverse_r / d.phi;  // 1/(R Φ), and ∂(R Φ)/∂L = M' (g + 2R)/(4R)
    d.g = inverse_r;
    d.l = 0.25 * slope * inverse;
    d.gg = -e.g * cube;
    d.lg = -0.5 * slope * cube;
    d.ll = 0.25 * curvature * inverse - 0.0625 * slope * slope * (e.g + 2 * r) * inverse_r * inverse * inverse;
    return d;
  }
};

template <class Height>
struct BarrierKernel {
  static constexpr bool kBarrier = true;
  double alpha, beta;
  Height height;

  /// +∞ outside 0 < d < ℓ, Φ > 0.
  [[nodiscard]] double value(const EdgeShape& e) const {
    const double q = (e.l2 - e.dw) * (e.l2 + e.dw), phi = height.phi(e);
    if (!(q > 0 && phi > 0)) return kInfinity;
    return (alpha * (e.l2 * e.l2 + e.dw * e.dw) + 4 * beta * e.g * e.g) / (std::sqrt(q) * phi);
  }

  /// Outside the domain f is not positive and finite, and the rest means nothing.
  [[nodiscard]] EdgeTerm term(const EdgeShape& e) const {
    const double l = e.l2, w = e.dw, g = e.g;
    const double t = alpha * (l * l + w * w) + 4 * beta * g * g, q = (l - w) * (l + w);
    const double ti = 1.0 / t, qi = 1.0 / q;
    const Denominator d = height.denominator(e);
    // f = T Q^(−1/2) / Φ: ∂ ln f, then ∂²f = f (∂ ln f ∂ ln f + ∂² ln f).
    const double tl = 2 * alpha * l * ti, tw = 2 * alpha * w * ti, tg = 8 * beta * g * ti;
    const double ql = 2 * l * qi, qw = -2 * w * qi;
    const double fl = tl - 0.5 * ql - d.l, fw = tw - 0.5 * qw, fg = tg - d.g;
    EdgeTerm term;
    term.f = t * std::sqrt(qi) / d.phi;
    term.f_l = term.f * fl;
    term.f_w = term.f * fw;
    term.f_g = term.f * fg;
    term.f_ll = term.f * (fl * fl + 2 * alpha * ti - tl * tl - qi + 0.5 * ql * ql - d.ll);
    term.f_lw = term.f * (fl * fw - tl * tw + 0.5 * ql * qw);
    term.f_lg = term.f * (fl * fg - tl * tg - d.lg);
    term.f_ww = term.f * (fw * fw + 2 * alpha * ti - tw * tw + qi + 0.5 * qw * qw);
    term.f_wg = term.f * (fw * fg - tw * tg);
    term.f_gg = term.f * (fg * fg + 8 * beta * ti - tg * tg - d.gg);
    return term;
  }
};

/// Calls visit with the kernel of the model: the one place where an energy's name becomes its formula.
template <class Visit>
auto with_kernel(const EnergyModel& model, Visit&& visit) {
  const std::size_t star = static_cast<std::size_t>(model.star);
  const double alpha = kAlpha[star], beta = kBeta[star];
  const auto split = [](const Softening& s, double power) -> std::array<double, 2> {
    const double value = power == 2 ? s.value * s.value : s.value;
    return s.scale == LengthScale::absolute ? std::array{value, 0.0} : std::array{0.0, value};
  };
  switch (model.kind) {
    case EnergyKind::BH:
      return visit(BarrierKernel<ShiftedHeight>{alpha, beta, {}});
    case EnergyKind::BHs: {
      const auto [s1, s2] = split(model.h0, 1);
      return visit(BarrierKernel<ShiftedHeight>{alpha, beta, {s1, s2}});
    }
    case EnergyKind::BP: {
      const auto [m1, m2] = split(model.gamma, 2);
      return visit(BarrierKernel<SmoothedHeight>{alpha, beta, {m1, m2}});
    }
    case EnergyKind::F:
    case EnergyKind::T:
    case EnergyKind::dT:
      break;
  }
  return visit(HotKernel{alpha, beta});
}

}  // namespace temper
