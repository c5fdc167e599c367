// Figure 7: the pseudo-barrier of one edge over (d, h), negative heights included (§4).
#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/edge_energy.hpp"
#include "experiments/minimize.hpp"
#include "experiments/text.hpp"
#include "figures.hpp"

namespace temper::gallery::fig07 {
namespace {

constexpr double kHalfDigits = 1e-6;  // where a minimum is known to
constexpr double kRounding = 1e-9;
constexpr std::array<double, 4> kGammas = {0.1, 0.3, 1, 3};  // of ℓ

Claim unique_minimum(std::size_t starts) {
  double spread = 0;
  bool centered = true;
  std::string found;
  for (const double gamma : kGammas) {
    const MultiStart m = multi_start({EnergyKind::BP, 1, gamma}, -1, 3, starts);
    spread = std::max(spread, m.spread);
    centered = centered && std::abs(m.best.x - 0.5) < kHalfDigits && m.best.y > 0;
    found += (found.empty() ? "" : ", ") + digits(m.best.y, 4) + " at γ = " + digits(gamma, 1);
  }
  return {"7",
          "E_BP^1 of an edge has one minimum",
          "the contours suggest a unique minimum",
          "at d = ℓ/2 and h/ℓ = " + found + "; farthest end of a search " + digits(spread, 1) + " ℓ away",
          centered && spread < kHalfDigits,
          digits(starts) + " random starts for each γ, in (0, ℓ) × (−ℓ, 3 ℓ)"};
}

Claim quasi_convex(std::size_t segments) {
  double worst = -1e300;
  for (const double gamma : kGammas) {
    worst = std::max(worst, sample_convexity({EnergyKind::BP, 1, gamma}, -3, 3, segments).worst_quasi);
  }
  const bool holds = worst <= kRounding;
  return {"7",
          "E_BP^1 is a quasi-convex function of (d, h)",
          "quasi-convex (the Proposition modified)",
          holds ? "on none of " + digits(segments * kGammas.size()) +
                      " random segments a point above the larger end; the "
                      "closest stays " +
                      digits(-worst, 2) + " of it below"
                : "a point of a segment exceeds the larger end by " + digits(worst, 3) + " of it",
          holds,
          "|h| < 3 ℓ, γ = 0.1, 0.3, 1 and 3 ℓ, one random point on each segment"};
}

// φ is convex in h: φ'' = γ²/(2 (h² + γ²)^(3/2)). So B = φ χ has a positive second derivative in h.
Claim hessian_of_denominator() {
  double least_hh = 1e300, most = -1e300;
  std::size_t n = 0;
  for (const double gamma : kGammas) {
    for (int i = 1; i < 20; ++i) {
      for (int j = 1; j <= 40; ++j) {
        const double d = i / 20.0, h = gamma * (1 + j / 10.0), r = std::sqrt(h * h + gamma * gamma);
        const double chi = std::sqrt(d * (1 - d));
        const double phi = (h + r) / 2, phi_h = phi / r, phi_hh = gamma * gamma / (2 * r * r * r);
        const double chi_d = (1 - 2 * d) / (2 * chi), chi_dd = -1 / (4 * chi * chi * chi);
        const double dd = phi * chi_dd, dh = phi_h * chi_d, hh = phi_hh * chi;
        most = std::max(most, (dd + hh) / 2 + std::sqrt((dd - hh) * (dd - hh) / 4 + dh * dh));
        least_hh = std::min({least_hh, hh, (dd + hh) / 2 + std::sqrt((dd - hh) * (dd - hh) / 4 + dh * dh)});
        ++n;
      }
    }
  }
  return {"7",
          "The Hessian of φ(h) χ(d) is negative definite for γ² < h²",
          "negative definite",
          "its larger eigenvalue and its second derivative in h are positive at all " + digits(n) +
              " places tried (at least " + digits(least_hh, 1) + ", up to " + digits(most, 3) + "): indefinite",
          most < 0,
          "grid of d and h > γ for four γ; φ is convex in h, so φ χ curves upwards along h everywhere. That E_BP is "
          "quasi-convex needs another reason than this one"};
}

Claim finite_everywhere() {
  const EdgeEnergy e{EnergyKind::BP, 1, 1};
  bool rising = true;
  double before = e(0.5, 0);
  for (int k = 1; k <= 100; ++k) {
    const double here = e(0.5, -0.1 * k);
    rising = rising && std::isfinite(here) && here > before;
    before = here;
  }
  double least_phi = 1e300;
  for (const double h : {-1e6, -100.0, -1.0, 0.0, 1.0}) least_phi = std::min(least_phi, e.phi(h));
  const Consistency c = consistency(EnergyKind::BP, 5000);
  return {"7",
          "E_BP is finite for any h, positive φ, and grows as h becomes more negative",
          "no hard barrier on h",
          digits(e(0.5, 0), 3) + ", " + digits(e(0.5, -1), 3) + ", " + digits(e(0.5, -10), 3) +
              " at h = 0, −1, −10 ℓ (γ = ℓ, d = ℓ/2); φ(−1e6) = " + digits(least_phi, 2),
          rising && least_phi > 0 && c.worst < kRounding && c.triangles > 100,
          "100 steps of h; edge energies sum to the triangle's to " + digits(c.worst, 1) + " in " +
              digits(c.triangles) + " triangles"};
}

}  // namespace

Page make(Effort effort) {
  const bool full = effort == Effort::full;
  Page page;
  for (const double gamma : {1.0, 0.3}) {
    const EdgeEnergy e{EnergyKind::BP, 1, gamma};
    EdgeLandscape landscape;
    landscape.title = "E_{BP} of an edge, ★1, γ = " + (gamma == 1 ? std::string("ℓ") : digits(gamma, 2) + " ℓ");
    landscape.h_low = -0.5;
    landscape.h_high = 1.5;
    landscape.samples = full ? 161 : 51;
    if (gamma == 1) {
      landscape.levels = {0.55, 0.6, 0.7, 0.8, 1, 1.2, 1.5, 2, 3, 5};
    } else {
      landscape.levels = {1, 1.1, 1.2, 1.4, 1.7, 2, 3, 5, 8, 12, 20};
    }
    landscape.minimum = multi_start(e, 0, 2, 8).best;
    page.pictures.push_back(
        {gamma == 1 ? "fig07" : "fig07_small_gamma", edge_contours(e, landscape),
         gamma == 1 ? "E_BP of an edge over (d, h) with γ = ℓ: finite for negative h, walls at d = 0 and d = ℓ only."
                    : "The same with γ = 0.3 ℓ: steeper below h = 0, the minimum nearer to d = h = ℓ/2."});
  }
  page.claims = {unique_minimum(full ? 200 : 15), quasi_convex(full ? 300000 : 10000), hessian_of_denominator(),
                 finite_everywhere()};
  return page;
}

}  // namespace temper::gallery::fig07
