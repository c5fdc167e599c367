// The energies of the paper: one table with one row each, for ★0, ★1 and ★2.
//
// With α = (1/4, 1/3, 1/12), β = (1/12, 1/3, 1/4) by star, the half-edge energy of edge ij in triangle ijk is
//
//   F    α d³h + β d h³                        eq. 2;  may be negative, 0 for a collapsed edge
//   T    sgn(h_k + h_l) · F per full edge      eq. 3;  ≥ 0, |h| on the boundary
//   dT   F inside, |h| on the boundary         the paper's E_∂T
//   BH   (α d² + β h²) / (χ h),  χ² = d_ij d_ji            eq. 4;  needs h > 0 and 0 < d < ℓ
//   BHs  (α d² + β h²) / (χ (h − h°)),  h° ≤ 0             eq. 6;  needs h > h° and 0 < d < ℓ
//   BP   (α d² + β h²) / (χ φ),  φ = (h + √(h² + γ²))/2    eq. 7;  needs 0 < d < ℓ
//   nF, nT, ndT   F, T and dT of each triangle over its squared area    Mousley et al. 2011; no unit
//   ODT  5/12 d³h + 1/4 d h³, with zero weights S Σℓ²/24 for a triangle of doubled area S: the error of |x|²
//        interpolated there, which optimal Delaunay triangulations (Chen and Xu 2004) minimize; for no star
//
// summed over the six half-edges of each triangle. The paper's eqs. 11, 17, 18 leave out the factor 1/3 of ★1: there
// the least E_BH of an edge is 4, here 4/3. A barrier is +∞ outside its domain, never NaN.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "temper/detail/error.hpp"
#include "temper/detail/executor.hpp"
#include "temper/detail/space.hpp"
#include "temper/mesh.hpp"

namespace temper {

enum class EnergyKind { F, T, dT, BH, BHs, BP, nF, nT, ndT, ODT };
/// The number of kinds: the number of rows of energies().
inline constexpr std::size_t kEnergyKinds = static_cast<std::size_t>(EnergyKind::ODT) + 1;

/// The Hodge star of an energy: it sets α and β, and for tetrahedra γ.
enum class Star {
  zero,   ///< ★0: α = 1/4, β = 1/12
  one,    ///< ★1: α = β = 1/3
  two,    ///< ★2: α = 1/12, β = 1/4
  three,  ///< ★3, only of tetrahedra
  all,  ///< Sum of the three stars, only for Objective::accuracy: α = β = 2/3, twice ★1. So the barrier counts half as
        ///< much
};

/// The dual of a boundary edge: the value of h for the missing triangle (§3.2.1 of the paper).
enum class BoundaryTreatment {
  as_is,     ///< Value 0 for h of the missing triangle; the h inside may be negative
  absolute,  ///< |h|: the paper's theory-based choice
  mirrored,  ///< The triangle is mirrored at the edge (Mullen et al. 2011): the edge counts twice
};

/// The unit of γ and h°.
enum class LengthScale {
  absolute,  ///< A length in the user's units
  relative,  ///< A multiple of the length of the edge: exactly scale-free
};

/// A parameter of E_BP (γ > 0) or E_BHs (−h° ≥ 0).
struct LengthParameter {
  double value = 0;
  LengthScale scale = LengthScale::relative;
  friend bool operator==(const LengthParameter&, const LengthParameter&) = default;
};

/// A row of the table of energies.
struct EnergyInfo {
  EnergyKind kind;
  std::string_view name;                 ///< "F", "T", "dT", …
  std::string_view formula;              ///< Formula for help texts and docs
  BoundaryTreatment boundary_treatment;  ///< Boundary treatment of its definition
  bool barrier;                          ///< Energy is +∞ outside 0 < d < ℓ
  bool softened_by_gamma;                ///< Energy has a γ
  bool softened_by_h0;                   ///< Energy has an h°
  int length_exponent;                   ///< Exponent p: E(s·mesh) = s^p · E(mesh) with a relative length parameter
  bool signed_by_dual = false;           ///< Sign of an edge is the sign of its dual length
  bool normalized = false;               ///< Energy of each triangle is divided by its squared area
  bool positions_alone = false;          ///< Energy is for meshes without weights, which stay without

  /// Says whether this is a barrier that nothing softens: a run has to begin inside it.
  [[nodiscard]] constexpr bool is_hard() const { return barrier && !softened_by_gamma && !softened_by_h0; }
};

/// All energies, in the order of the table above.
[[nodiscard]] std::span<const EnergyInfo> energies();
/// The row of an energy.
[[nodiscard]] const EnergyInfo& energy_info(EnergyKind kind);
/// The row with this name, or an error that lists the names.
[[nodiscard]] Expected<EnergyInfo> find_energy(std::string_view name);

/// An energy with all its parameters.
struct EnergyModel {
  EnergyKind kind = EnergyKind::BP;
  Star star = Star::one;  ///< Star: zero, one or two
  /// Boundary treatment of F and nF; the other energies define their own.
  BoundaryTreatment boundary_treatment = BoundaryTreatment::as_is;
  LengthParameter gamma = {1.0, LengthScale::absolute};  ///< Parameter γ of E_BP; the paper's examples use 1, absolute
  LengthParameter h0 = {0.0, LengthScale::absolute};     ///< Parameter −h° of E_BHs, ≥ 0
  /// Make a barrier +∞ on inverted triangles too. The paper's are finite there: E_BP for any h, E_BHs for all h > h°.
  bool wall = false;
};

/// Energy of one triangle alone, all its edges boundary edges. On the sphere all energies are computed on the flat
/// triangles of the weighted vectors (space.hpp), where signs are the same as on the sphere.
[[nodiscard]] double triangle_energy(const EnergyModel& model, const WeightedPoint& p, const WeightedPoint& q,
                                     const WeightedPoint& r, const Space& space = {});
/// Total energy; +∞ if any term is outside its domain. Sums have fixed blocks, so the result does not depend on the
/// executor. O(n).
[[nodiscard]] double total_energy(const Mesh& mesh, const EnergyModel& model, Executor* executor = nullptr);

/// The energy as a function of one vertex: value, gradient and Hessian in (x, y, w). On the sphere a step (x, y, w)
/// turns P to the direction of P + x e₁ + y e₂ and adds w to its weight. e₁ and e₂ are unit vectors at right angles to
/// P.
struct VertexDerivatives {
  double value = 0;                     ///< Value; +∞ if not feasible
  bool feasible = false;                ///< Vertex is inside the domain of the energy; else the rest is zero
  std::array<double, 3> gradient = {};  ///< ∂E/∂x, ∂E/∂y, ∂E/∂w
  std::array<double, 6> hessian = {};   ///< xx, xy, xw, yy, yw, ww
};
/// The part of the total energy that depends on v: the edges of its star, and for E_T also the dual edges across the
/// link. If only v changes, total(after) − total(before) = value(after) − value(before).
[[nodiscard]] VertexDerivatives vertex_energy(const Mesh& mesh, const EnergyModel& model, VertexId v);

}  // namespace temper
