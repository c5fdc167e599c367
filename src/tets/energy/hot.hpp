// The HOT energies of tetrahedra (Mullen et al. 2011), which bound the errors of the diagonal ★0 to ★3:
//
//     E = Σ_σ |σ| |σ*| W₂(σ, σ*)²        over the vertices, edges, faces or tetrahedra σ
//
// A simplex σ and its dual σ* are at right angles. So all transports between them cost the same: the mean of |x − c|²
// over σ and that over σ*, where c is their crossing. Both are sums over orthoschemes.
//
//               o        The orthoscheme of a vertex v, the crossing x of an edge, the orthocenter c of a face, and the
//             ⁄ |        orthocenter o of the tetrahedron. Its legs vx, xc and co are at right angles. Their lengths
//           ⁄   | d₃     d₁, d₂ and d₃ have signs, and so has its volume V = d₁ d₂ d₃/6. With S_i = Σ V d_i²,
//     v --- x   |
//       d₁   \  |            E = α S₁ + β S₂ + γ S₃.
//         d₂  \ |
//               c
//
// A tetrahedron has 24 orthoschemes, but needs few of them. The legs at a face and an edge e of it have the volume
// ⅙ ℓ d₂ d₃ of a kite, so that S₁ = Σ ⅙ ℓ d₂ d₃ λ over these, λ = d³/ℓ + d'³/ℓ = (ℓ⁴ + 3 δ²)/(4 ℓ²), where δ is the
// difference of the weights. S₃ is Σ A d₃³/3 over faces. S₂ follows from the second moment of the tetrahedron about o,
// with its centroid g:
//
//     S₁/10 + 3 S₂/10 + 3 S₃/5 = ∫ |x − o|² = |pqrs| (Σ ℓ²/80 + |g − o|²)
//
// All is rational in p, with the names of star_kernel.hpp. At a face of p, d₃ |m| = g, and S = |m|². A leg d₂ is
// |m| ℓ d₂ = m·(d × (o − x)) over an edge from x along d: a product of two cross products, and so of dot products with
// v, e and o − x. These are known: o − x has the part (ℓ² + δ)/(2ℓ) along any edge from x.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "temper/tets/mesh.hpp"
#include "tets/energy/star_kernel.hpp"

namespace temper::tets {

/// The registry of energies for tetrahedra: α, β and γ of each star.
struct HotEnergy {
  double alpha, beta, gamma;
};
inline constexpr std::array<HotEnergy, 4> kHotEnergies = {
    {{3.0 / 5, 3.0 / 10, 1.0 / 10}, {1, 3.0 / 2, 1.0 / 2}, {1.0 / 2, 3.0 / 2, 1}, {1.0 / 10, 3.0 / 10, 3.0 / 5}}};

/// The face qrs opposite p, as LinkFace has it, and what else the energies need.
struct HotFace {
  LinkFace<double> link;
  std::array<double, 3> weight, lambda, along;  ///< of q, r and s; λ and e·(o − x_i) of the edges
  double kites = 0;                             ///< Σ λ |n| ℓ d₂ of the edges in this face
  double length2 = 0;                           ///< |n|²
  Vector<double> to_center;                     ///< center − (r + s)/4, from q

  HotFace(const WeightedPoint& q, const WeightedPoint& r, const WeightedPoint& s);
};

/// The energy of the positive tetrahedron pqrs; u: p − q.
template <class T>
T hot_energy(const HotEnergy& energy, const HotFace& face, const Vector<T>& u, const T& w) {
  const auto along = [](const Vector<double>& a, const Vector<T>& b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
  const auto from = [](const Vector<T>& a, const Vector<double>& b) {
    return Vector<T>{a.x - T(b.x), a.y - T(b.y), a.z - T(b.z)};
  };
  const auto& edges = face.link.edges;
  struct Spoke {
    Vector<T> v;
    T length2, reach, lambda;  // |v|², v·(o − x_i), λ
  };
  const auto spoke = [&](std::size_t i) {
    const Vector<T> v = from(u, edges[i].from);
    const T l = dot(v, v), dw = T(face.weight[i]) - w;
    return Spoke{v, l, 0.5 * (l + dw), 0.25 * l + 0.75 * (dw * dw) / l};
  };
  const std::array<Spoke, 3> spokes = {spoke(0), spoke(1), spoke(2)};
  const T volume6 = along(face.link.normal, u);
  const T t = (spokes[0].reach - along(face.link.center, u)) / volume6;
  T first = face.kites * t, third = (face.length2 * face.length2) * (t * t * t), length2 = T(face.link.length2);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& e = edges[i];
    const auto& [v, l, reach, lambda] = spokes[i];
    const auto& [next_v, next_l, next_reach, next_lambda] = spokes[(i + 1) % 3];
    const double along_e = face.along[i];
    const T ve = along(e.along, v), next_ve = ve - T(e.length2);
    const T g = along(e.plane, v) + t * along(e.turn, v), over = g / (e.length2 * l - ve * ve);
    const T kites = face.lambda[i] * (e.length2 * reach - along_e * ve) + lambda * (along_e * l - reach * ve) +
                    next_lambda * (next_reach * next_ve - (along_e - e.length2) * next_l);
    first = first + over * kites;
    third = third + over * (g * g);
    length2 = length2 + l;
  }
  const Vector<T> to_o = from(T(0.25) * u, face.to_center);
  const T moment = volume6 * ((1.0 / 80) * length2 + dot(to_o, to_o) - 0.5 * (t * volume6) + face.length2 * (t * t));
  const auto& [alpha, beta, gamma] = energy;  // 6 S₁, 6 S₃ and 6 ∫ |x − o|²
  return (alpha - beta / 3) / 6 * first + (gamma - 2 * beta) / 6 * third + 10 * beta / 18 * moment;
}

/// The energy of the tetrahedra around a vertex, as a function of this vertex. Storage is kept from vertex to vertex.
class HotStar {
 public:
  /// `link`: the halffaces opposite v in the tetrahedra around v.
  void gather(const TetMesh& mesh, std::span<const HalffaceId> link);
  [[nodiscard]] double value(const HotEnergy& energy, const WeightedPoint& p) const;
  [[nodiscard]] PointDerivatives<double> derivatives(const HotEnergy& energy, const WeightedPoint& p) const;

 private:
  std::vector<HotFace> faces_;
};

/// The energy of a mesh. O(n)
[[nodiscard]] double hot_energy(const TetMesh& mesh, const HotEnergy& energy, Executor* executor = nullptr);

}  // namespace temper::tets
