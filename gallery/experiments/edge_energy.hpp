// The barrier energies of one edge in one triangle as functions of (d, h), §4 of the paper:
//
//   e(d, h) = (1/3) T / (χ φ),   T = d² + (ℓ − d)² + 2 h²,   χ = √(d (ℓ − d))
//   φ = h (BH, eq. 11),   h − h° (BHs, eq. 17),   (h + √(h² + γ²))/2 (BP, eq. 18)
//
// The library's energies are of whole triangles; the three edges of one sum to them, which consistency() measures. The
// paper leaves out the factor 1/3 of ★1.
#pragma once

#include <string>

#include "gallery.hpp"
#include "temper/detail/vec.hpp"
#include "temper/energy.hpp"

namespace temper::gallery {

struct EdgeEnergy {
  EnergyKind kind = EnergyKind::BH;  ///< BH, BHs or BP
  double length = 1;                 ///< ℓ
  double length_parameter = 0;       ///< γ, or −h° ≥ 0

  /// +∞ outside the domain.
  [[nodiscard]] double operator()(double d, double h) const;
  [[nodiscard]] double operator()(Vec2 dh) const { return (*this)(dh.x, dh.y); }
  /// φ, the denominator's part that depends on h.
  [[nodiscard]] double phi(double h) const;
};

/// The largest relative difference between the sum of edge energies over a triangle and triangle_energy, over
/// random weighted triangles inside the domain.
struct Consistency {
  double worst = 0;
  std::size_t triangles = 0;
};
[[nodiscard]] Consistency consistency(EnergyKind kind, std::size_t tries);

/// Random segments between two points of the domain (0, ℓ) × (h_low, h_high).
struct ConvexityTest {
  std::size_t segments = 0;
  double worst_quasi = 0;   ///< the most that e on a segment exceeds the larger of its ends, relative to that
  double worst_convex = 0;  ///< the most that e on a segment exceeds the chord, relative to the larger end
  Vec2 a, b;                ///< the segment of worst_convex …
  double at = 0;            ///< … and where on it, 0 … 1
};
[[nodiscard]] ConvexityTest sample_convexity(const EdgeEnergy& e, double h_low, double h_high, std::size_t segments);

/// Minima found from many random starts.
struct MultiStart {
  std::size_t starts = 0;
  Vec2 best;  ///< the least
  double value = 0;
  double spread = 0;  ///< the largest distance of a minimum found from the best
  double rise = 0;    ///< the largest value found, above the least
};
[[nodiscard]] MultiStart multi_start(const EdgeEnergy& e, double h_low, double h_high, std::size_t starts);

/// e on a grid over (0, ℓ) × [h_low, h_high], cut off at `cap` times the minimum.
struct EdgeLandscape {
  std::string title;
  double h_low = 0, h_high = 1.5;
  std::size_t samples = 161;  ///< along d; as many along h a unit
  std::vector<double> levels;
  Vec2 minimum;
};
[[nodiscard]] std::string edge_contours(const EdgeEnergy& e, const EdgeLandscape& landscape);

}  // namespace temper::gallery
