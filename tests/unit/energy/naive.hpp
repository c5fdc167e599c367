// The naive twin: the energies as the paper prints them, half-edge by half-edge, in long double.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "geometry/triangle_kernel.hpp"
#include "temper/energy.hpp"
#include "temper/mesh.hpp"

namespace temper::test {

using Real = long double;

struct NaivePoint {
  Real x, y, w;
};

/// d_ij, ℓ, the same-side and left-hand signed heights of edge ij in triangle ijk, and the triangle's area.
struct NaiveEdge {
  Real d_ij, d_ji, l, h_same, h_left, area;
};

inline NaiveEdge naive_edge(const NaivePoint& i, const NaivePoint& j, const NaivePoint& k) {
  const Real ax = j.x - i.x, ay = j.y - i.y, bx = k.x - i.x, by = k.y - i.y;
  const Real area2 = ax * by - ay * bx;
  const Real ra = (ax * ax + ay * ay + i.w - j.w) / 2, rb = (bx * bx + by * by + i.w - k.w) / 2;
  const Real ox = (ra * by - rb * ay) / area2, oy = (ax * rb - bx * ra) / area2;  // orthocenter − i, by Cramer
  NaiveEdge e{};
  e.l = std::sqrt(ax * ax + ay * ay);
  e.d_ij = e.l / 2 + (i.w - j.w) / (2 * e.l);
  e.d_ji = e.l - e.d_ij;
  e.h_left = (ax * oy - ay * ox) / e.l;
  e.h_same = area2 > 0 ? e.h_left : -e.h_left;
  e.area = area2 / 2;
  return e;
}

/// The same on the sphere, of weighted vectors: the flat triangle with the weights |P|², turned into the plane.
inline NaiveEdge naive_sphere_edge(const NaivePoint& i, const NaivePoint& j, const NaivePoint& k) {
  using Vector = std::array<Real, 3>;  // NaivePoint's three numbers
  const auto minus = [](const NaivePoint& p, const NaivePoint& q) { return Vector{p.x - q.x, p.y - q.y, p.w - q.w}; };
  const auto product = [](const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  const auto norm2 = [&](const NaivePoint& p) { return product({p.x, p.y, p.w}, {p.x, p.y, p.w}); };
  const Vector a = minus(j, i), b = minus(k, i);
  const Vector n = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  const Real side = product(n, {i.x, i.y, i.w}) < 0 ? -1 : 1;  // seen from outside
  const Real l = std::sqrt(product(a, a)), along = product(a, b) / l;
  return naive_edge({0, 0, norm2(i)}, {l, 0, norm2(j)}, {along, side * std::sqrt(product(n, n)) / l, norm2(k)});
}

inline Real naive_half(const EnergyModel& m, Real d, Real d_other, Real h, Real l) {
  const std::array<Real, 3> alphas = {Real(1) / 4, Real(1) / 3, Real(1) / 12},
                            betas = {Real(1) / 12, Real(1) / 3, Real(1) / 4};
  const bool odt = m.kind == EnergyKind::ODT;  // of no star
  const Real alpha = odt ? Real(5) / 12 : alphas[static_cast<std::size_t>(m.star)];
  const Real beta = odt ? Real(1) / 4 : betas[static_cast<std::size_t>(m.star)];
  const auto length_of = [&](const LengthParameter& s) {
    return s.scale == LengthScale::relative ? s.value * l : Real(s.value);
  };
  const Real top = alpha * d * d + beta * h * h, chi = std::sqrt(d * d_other);
  switch (m.kind) {
    case EnergyKind::BH:
      return top / (chi * h);
    case EnergyKind::BHs:
      return top / (chi * (h + length_of(m.h0)));
    case EnergyKind::BP: {
      const Real gamma = length_of(m.gamma);
      return top / (chi * (h + std::sqrt(h * h + gamma * gamma)) / 2);
    }
    default:
      return alpha * d * d * d * h + beta * d * h * h * h;
  }
}

/// An edge in the space of its mesh.
inline NaiveEdge naive_edge(const Space& space, const NaivePoint& i, const NaivePoint& j, const NaivePoint& k) {
  return space.is_plane() ? naive_edge(i, j, k) : naive_sphere_edge(i, j, k);
}

/// Total energy, by full edges; vertex v is replaced by p.
inline Real naive_total(const Mesh& mesh, const EnergyModel& m, VertexId v, const NaivePoint& p) {
  const auto at = [&](VertexId u) -> NaivePoint {
    if (u == v) return p;
    const WeightedPoint q = mesh.point(u);
    return {q.x, q.y, q.w};
  };
  const bool barrier = energies()[static_cast<std::size_t>(m.kind)].barrier;
  const bool normalized = m.kind == EnergyKind::nF || m.kind == EnergyKind::nT || m.kind == EnergyKind::ndT;
  const bool by_dual_sign = m.kind == EnergyKind::T || m.kind == EnergyKind::nT;
  const bool asks_for_treatment = m.kind == EnergyKind::F || m.kind == EnergyKind::nF;
  const auto side = [&](HalfedgeId h) {
    return naive_edge(mesh.space(), at(mesh.origin(h)), at(mesh.target(h)), at(mesh.opposite(h)));
  };
  const auto both_halves = [&](const NaiveEdge& e, Real height) {
    const Real both = naive_half(m, e.d_ij, e.d_ji, height, e.l) + naive_half(m, e.d_ji, e.d_ij, height, e.l);
    return normalized ? both / (e.area * e.area) : both;
  };
  Real sum = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_edge_representative(h)) continue;
    const NaiveEdge e = side(h);
    if (barrier) {
      sum += both_halves(e, e.h_left);
      if (mesh.twin(h).valid()) sum += both_halves(e, side(mesh.twin(h)).h_left);
    } else if (!mesh.twin(h).valid()) {
      const bool as_is =
          m.kind == EnergyKind::ODT || (asks_for_treatment && m.boundary_treatment == BoundaryTreatment::as_is);
      const bool mirrored = asks_for_treatment && m.boundary_treatment == BoundaryTreatment::mirrored;
      sum += as_is      ? both_halves(e, e.h_same)
             : mirrored ? 2 * both_halves(e, e.h_same)
                        : both_halves(e, std::abs(e.h_same));
    } else {
      const NaiveEdge other = side(mesh.twin(h));
      const Real sign = by_dual_sign && e.h_same + other.h_same < 0 ? -1 : 1;
      sum += sign * (both_halves(e, e.h_same) + both_halves(other, other.h_same));
    }
  }
  return sum;
}

inline NaivePoint naive_point(const Mesh& mesh, VertexId v) {
  const WeightedPoint p = mesh.point(v);
  return {p.x, p.y, p.w};
}

/// The end of a step of v, on the sphere in its chart: unit vectors of doubles are such to 1e-16, which moves the end
/// in second order alone.
inline NaivePoint naive_step(const Mesh& mesh, VertexId v, Real x, Real y, Real w) {
  const NaivePoint p = naive_point(mesh, v);
  if (mesh.space().is_plane()) return {p.x + x, p.y + y, p.w + w};
  const Chart<double> chart = seen_from(weighted_vector(mesh.point(v)));
  const NaivePoint q{p.x + x * chart.e1.x + y * chart.e2.x, p.y + x * chart.e1.y + y * chart.e2.y,
                     p.w + x * chart.e1.z + y * chart.e2.z};
  const Real rho2 = p.x * p.x + p.y * p.y + p.w * p.w;
  const Real factor = std::sqrt((rho2 + w) / (q.x * q.x + q.y * q.y + q.w * q.w));
  return {factor * q.x, factor * q.y, factor * q.w};
}

/// Every energy × star × boundary treatment or kind of length_parameter, with γ and h° a fraction of `length`.
inline std::vector<EnergyModel> all_models(double length) {
  std::vector<EnergyModel> models;
  for (const EnergyInfo& info : energies()) {
    for (int star = 0; star < 3; ++star) {
      EnergyModel m;
      m.kind = info.kind;
      m.star = Star(star);
      if (info.kind == EnergyKind::F || info.kind == EnergyKind::nF) {
        for (const auto b : {BoundaryTreatment::as_is, BoundaryTreatment::absolute, BoundaryTreatment::mirrored}) {
          m.boundary_treatment = b;
          models.push_back(m);
        }
      } else if (info.softened_by_gamma || info.softened_by_h0) {
        for (const auto scale : {LengthScale::absolute, LengthScale::relative}) {
          const double unit = scale == LengthScale::absolute ? length : 1;
          m.gamma = {0.3 * unit, scale};
          m.h0 = {0.7 * unit, scale};
          models.push_back(m);
        }
      } else {
        models.push_back(m);
      }
    }
  }
  return models;
}

}  // namespace temper::test
