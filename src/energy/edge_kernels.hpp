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

#include "base/pack.hpp"
#include "geometry/triangle_kernel.hpp"
#include "temper/energy.hpp"

namespace temper {

/// The registry: one row for each kind of energy. Tests, command line, Python and docs iterate over it.
inline constexpr std::array<EnergyInfo, kEnergyKinds> kEnergies = [] {
  using enum EnergyKind;
  using enum BoundaryTreatment;
  return std::array<EnergyInfo, kEnergyKinds>{{
      // kind, name, formula of a half-edge, boundary, barrier, γ, h°, length exponent
      {F, "F", "α d³h + β d h³", as_is, false, false, false, 4},
      {T, "T", "sgn(h_k + h_l) (α d³h + β d h³)", absolute, false, false, false, 4, true},
      {dT, "dT", "α d³h + β d h³, |h| on the boundary", absolute, false, false, false, 4},
      {BH, "BH", "(α d² + β h²) / (√(d_ij d_ji) h)", as_is, true, false, false, 0},
      {BHs, "BHs", "(α d² + β h²) / (√(d_ij d_ji) (h − h°))", as_is, true, false, true, 0},
      {BP, "BP", "(α d² + β h²) / (√(d_ij d_ji) φ), φ = (h + √(h² + γ²))/2", as_is, true, true, false, 0},
      {nF, "nF", "(α d³h + β d h³) / area²", as_is, false, false, false, 0, false, true},
      {nT, "nT", "sgn(h_k + h_l) (α d³h + β d h³) / area²", absolute, false, false, false, 0, true, true},
      {ndT, "ndT", "(α d³h + β d h³) / area², |h| on the boundary", absolute, false, false, false, 0, false, true},
      {ODT, "ODT", "5/12 d³h + 1/4 d h³", as_is, false, false, false, 4, false, false, true},
  }};
}();
static_assert(
    [] {
      for (std::size_t i = 0; i < kEnergyKinds; ++i) {
        if (kEnergies[i].kind != static_cast<EnergyKind>(i)) return false;
      }
      return true;
    }(),
    "each row is at the place of its kind");

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// α and β of ★0, ★1, ★2, of none (★3 is of tetrahedra), and of the three together.
inline constexpr std::array<double, 5> kAlpha = {1.0 / 4, 1.0 / 3, 1.0 / 12, 0, 2.0 / 3};
inline constexpr std::array<double, 5> kBeta = {1.0 / 12, 1.0 / 3, 1.0 / 4, 0, 2.0 / 3};

/// α and β of E_ODT: the interpolation error of |x|² over a triangle is ρ² A − ∫|x − o|², with the circumradius ρ.
inline constexpr double kAlphaOdt = 5.0 / 12, kBetaOdt = 1.0 / 4;

/// Value, gradient and Hessian of an edge energy in (L, w, g).
template <class T>
struct EdgeTerm {
  T f, f_l, f_w, f_g, f_ll, f_lw, f_lg, f_ww, f_wg, f_gg;
};

/// E_F of one edge in one triangle. Odd in g. Factors outside are signs, boundary treatments, and 1/area² of the whole
/// triangle.
struct HotKernel {
  static constexpr bool kBarrier = false;
  double alpha, beta;
  bool normalized = false;

  /// The factor of all edges of a triangle: 1, or 1/area².
  template <class T>
  [[nodiscard]] TEMPER_INLINE T per_area(const T& doubled_area) const {
    return normalized ? 4.0 / (doubled_area * doubled_area) : all<T>(1);
  }

  template <class T>
  [[nodiscard]] TEMPER_INLINE T value(const EdgeShapeOf<T>& e) const {
    return (0.25 * alpha * (e.l2 * e.l2 + 3 * e.dw * e.dw) + beta * e.g * e.g) * e.g / e.l2;
  }

  template <class T>
  [[nodiscard]] TEMPER_INLINE EdgeTerm<T> term(const EdgeShapeOf<T>& e) const {
    const auto& [l, w, g] = e;
    const T inverse = 1.0 / l;
    const T wi = w * inverse, gi = g * inverse, wi2 = wi * wi, gi2 = gi * gi;
    const double a = 0.25 * alpha;
    EdgeTerm<T> t;  // f = a g (L + 3 w²/L) + β g³/L
    t.f = a * g * (l + 3 * (w * wi)) + beta * (g * g * gi);
    t.f_l = a * g * (1 - 3 * wi2) - beta * (g * gi2);
    t.f_w = 6 * a * (g * wi);
    t.f_g = a * (l + 3 * (w * wi)) + 3 * beta * (g * gi);
    t.f_ll = 6 * a * (gi * wi2) + 2 * beta * (gi * gi2);
    t.f_lw = -6 * a * (gi * wi);
    t.f_lg = a * (1 - 3 * wi2) - 3 * beta * gi2;
    t.f_ww = 6 * a * gi;
    t.f_wg = 6 * a * wi;
    t.f_gg = 6 * beta * gi;
    return t;
  }
};

/// x/y, not divided yet.
template <class T>
struct Fraction {
  T x, y;
};

/// 1/Φ and the derivatives of ln Φ.
template <class T>
struct Denominator {
  T inverse;
  T l, g;        // ∂ ln Φ
  T ll, lg, gg;  // ∂² ln Φ
};

/// Φ = g + s₁ ℓ + s₂ L: E_BH with s = 0, E_BHs with s₁ = |h°| or s₂ = |h°|/ℓ. Infeasible at Φ ≤ 0.
struct ShiftedHeight {
  double s1 = 0, s2 = 0;

  /// The part that does not depend on g.
  template <class T>
  struct Base {
    T l, root;  ///< s₁ ℓ
  };

  template <class T>
  [[nodiscard]] TEMPER_INLINE Base<T> base(const T& l2) const {
    return {l2, s1 == 0 ? all<T>(0) : s1 * square_root(l2)};
  }

  /// 1/Φ.
  template <class T>
  [[nodiscard]] TEMPER_INLINE Fraction<T> inverse(const Base<T>& b, const T& g) const {
    return {all<T>(1), g + b.root + s2 * b.l};
  }

  template <class T>
  [[nodiscard]] TEMPER_INLINE Denominator<T> denominator(const Base<T>& b, const T& g) const {
    const T inverse_l = s1 == 0 ? all<T>(0) : 1.0 / b.l;
    const T half_root = 0.5 * b.root * inverse_l;
    Denominator<T> d;
    d.inverse = 1.0 / inverse(b, g).y;
    d.g = d.inverse;
    d.l = (half_root + s2) * d.inverse;
    d.gg = -1.0 * (d.inverse * d.inverse);
    d.lg = -1.0 * (d.l * d.g);
    d.ll = -0.5 * (half_root * inverse_l) * d.inverse - d.l * d.l;
    return d;
  }
};

/// Φ = (g + R)/2, R = √(g² + M), M = m₁ L + m₂ L². E_BP has m₁ = γ² or m₂ = (γ/ℓ)². Always positive.
struct SmoothedHeight {
  double m1 = 0, m2 = 0;

  template <class T>
  struct Base {
    T m, slope;  ///< M, M'
  };

  template <class T>
  [[nodiscard]] TEMPER_INLINE Base<T> base(const T& l2) const {
    return {(m1 + m2 * l2) * l2, m1 + 2 * m2 * l2};
  }

  /// 1/Φ is 2/(R + |g|) for g > 0, and 2 (R + |g|)/M below: no cancellation when g < 0.
  template <class T>
  [[nodiscard]] TEMPER_INLINE Fraction<T> inverse(const Base<T>& b, const T& g) const {
    const T sum = square_root(g * g + b.m) + absolute(g);
    const auto above = g >= 0;
    return {select(above, all<T>(2), 2 * sum), select(above, sum, b.m)};
  }

  template <class T>
  [[nodiscard]] TEMPER_INLINE Denominator<T> denominator(const Base<T>& b, const T& g) const {
    const T r = square_root(g * g + b.m), sum = r + absolute(g);
    const auto above = g >= 0;
    // 1/R and 1/Φ, which is 2/sum or 2 sum/M, by one division.
    const T divisor = select(above, sum, b.m);
    const T quotient = 1.0 / (r * divisor);
    const T inverse_r = quotient * divisor;
    const T half_slope_cube = 0.5 * b.slope * (inverse_r * inverse_r * inverse_r);
    Denominator<T> d;
    d.inverse = 2 * (quotient * r) * select(above, all<T>(1), sum);
    const T inverse = inverse_r * d.inverse;  // 1/(R Φ), and ∂(R Φ)/∂L = M' (g + 2R)/(4R)
    d.g = inverse_r;
    d.l = 0.25 * b.slope * inverse;
    d.gg = -1.0 * g * (inverse_r * inverse_r * inverse_r);
    d.lg = -1.0 * half_slope_cube;
    d.ll = 0.5 * m2 * inverse - 0.0625 * (b.slope * b.slope) * (g + 2 * r) * inverse_r * (inverse * inverse);
    return d;
  }
};

/// Computes what does not depend on g, its Base, once for the two triangles of an edge.
template <class Height>
struct BarrierKernel {
  static constexpr bool kBarrier = true;
  double alpha, beta;
  Height height;
  double least_area = -kInfinity;  ///< a triangle must have a larger doubled area

  template <class T>
  struct Base {
    T l, w;
    T squares;  ///< α (L² + w²)
    T q, root;  ///< Q = L² − w², √Q
    typename Height::template Base<T> height;
  };

  template <class T>
  [[nodiscard]] TEMPER_INLINE Base<T> base(const T& l, const T& w) const {
    const T q = (l - w) * (l + w);
    return {l, w, alpha * (l * l + w * w), q, square_root(q), height.base(l)};
  }

  /// The value. Outside 0 < d < ℓ, Φ > 0 the divisor is not positive, or not a number.
  template <class T>
  [[nodiscard]] TEMPER_INLINE Fraction<T> fraction(const Base<T>& edge, const T& g) const {
    const Fraction<T> phi = height.inverse(edge.height, g);
    return {(edge.squares + 4 * beta * (g * g)) * phi.x, edge.root * phi.y};
  }

  /// +∞ outside 0 < d < ℓ, Φ > 0.
  [[nodiscard]] double value(const EdgeShape& e) const {
    const auto [x, y] = fraction(base(e.l2, e.dw), e.g);
    return y > 0 ? x / y : kInfinity;
  }

  /// Outside the domain f is not positive and finite, and the rest means nothing.
  template <class T>
  [[nodiscard]] TEMPER_INLINE EdgeTerm<T> term(const EdgeShapeOf<T>& e) const {
    return term(base(e.l2, e.dw), e.g);
  }

  template <class T>
  [[nodiscard]] TEMPER_INLINE EdgeTerm<T> term(const Base<T>& edge, const T& g) const {
    const T &l = edge.l, &w = edge.w, &q = edge.q, t = edge.squares + 4 * beta * (g * g);
    const T quotient = 1.0 / (t * q), ti = quotient * q, qi = quotient * t;
    const Denominator<T> d = height.denominator(edge.height, g);
    // f = T Q^(−1/2) / Φ: ∂ ln f, then ∂²f = f (∂ ln f ∂ ln f + ∂² ln f).
    const T tl = 2 * alpha * (l * ti), tw = 2 * alpha * (w * ti), tg = 8 * beta * (g * ti);
    const T ql = l * qi, qw = w * qi;  // of ln √Q, qw with its sign turned
    const T fl = tl - ql - d.l, fw = tw + qw, fg = tg - d.g;
    EdgeTerm<T> term;
    term.f = t * edge.root * qi * d.inverse;
    term.f_l = term.f * fl;
    term.f_w = term.f * fw;
    term.f_g = term.f * fg;
    term.f_ll = term.f * (fl * fl + 2 * alpha * ti - tl * tl - qi + 2 * (ql * ql) - d.ll);
    term.f_lw = term.f * (fl * fw - tl * tw - 2 * (ql * qw));
    term.f_lg = term.f * (fl * fg - tl * tg - d.lg);
    term.f_ww = term.f * (fw * fw + 2 * alpha * ti - tw * tw + qi + 2 * (qw * qw));
    term.f_wg = term.f * (fw * fg - tw * tg);
    term.f_gg = term.f * (fg * fg + 8 * beta * ti - tg * tg - d.gg);
    return term;
  }
};

/// The formula that a model's name stands for, and its constants.
struct EdgeFormula {
  enum class Form { hot, shifted, smoothed } form = Form::hot;
  double alpha = 0, beta = 0;
  double first = 0, second = 0;    ///< s₁, s₂ or m₁, m₂
  bool normalized = false;         ///< of hot
  double least_area = -kInfinity;  ///< of the others
};

/// The one place where an energy's name becomes its formula.
[[nodiscard]] inline EdgeFormula edge_formula(const EnergyModel& model) {
  const EnergyInfo& info = kEnergies[static_cast<std::size_t>(model.kind)];
  const std::size_t star = static_cast<std::size_t>(model.star);
  EdgeFormula f{EdgeFormula::Form::hot, kAlpha[star], kBeta[star]};
  f.normalized = info.normalized;
  if (model.wall) f.least_area = 0;
  const auto soften = [&f](const LengthParameter& s, double value) {
    (s.scale == LengthScale::absolute ? f.first : f.second) = value;
  };
  if (info.barrier) f.form = info.softened_by_gamma ? EdgeFormula::Form::smoothed : EdgeFormula::Form::shifted;
  if (info.softened_by_gamma) soften(model.gamma, model.gamma.value * model.gamma.value);
  if (info.softened_by_h0) soften(model.h0, model.h0.value);
  if (model.kind == EnergyKind::ODT) f.alpha = kAlphaOdt, f.beta = kBetaOdt;
  return f;
}

/// The kernel of a formula that is no barrier.
TEMPER_INLINE HotKernel hot_kernel(const EdgeFormula& f) { return {f.alpha, f.beta, f.normalized}; }

/// Calls visit with the kernel of a formula that is a barrier.
template <class Visit>
TEMPER_INLINE auto with_barrier(const EdgeFormula& f, Visit&& visit) {
  using enum EdgeFormula::Form;
  switch (f.form) {
    case shifted:
      return visit(BarrierKernel<ShiftedHeight>{f.alpha, f.beta, {f.first, f.second}, f.least_area});
    case smoothed:
    case hot:  // is no barrier: callers have asked
      break;
  }
  return visit(BarrierKernel<SmoothedHeight>{f.alpha, f.beta, {f.first, f.second}, f.least_area});
}

/// Calls visit with the kernel of the model.
template <class Visit>
TEMPER_INLINE auto with_kernel(const EnergyModel& model, Visit&& visit) {
  const EdgeFormula f = edge_formula(model);
  if (f.form == EdgeFormula::Form::hot) return visit(hot_kernel(f));
  return with_barrier(f, visit);
}

}  // namespace temper
