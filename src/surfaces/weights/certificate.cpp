// The exact check of a certificate on a surface (feasibility/certificate_sum.hpp). It shares no code with the builder
// of the programs. M is a double. In N of a dual length the areas S and T have square roots: they are rounded, and the
// sum gets what that may add. All else is exact.
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "feasibility/certificate_sum.hpp"
#include "surfaces/weights/demand.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {
namespace {

using namespace certified;

// As for tetrahedra (tets/weights/certificate.cpp): a product of four differences, an area and a multiplier has
// 4 · (75 + 53) + 53 + 200 + 250 + 53 = 1068 bits.
constexpr double kLeastCoordinate = 0x1p-75;
constexpr double kLeastArea = 0x1p-200;
constexpr std::array<int, 6> kDegrees = {4, 2, 6, 0, 0, 0};
// The relative error of an area, far above the roundings of its exact square and of the root.
constexpr double kAreaError = 0x1p-48;

/// The terms of the sum.
class SurfaceTerms : public WeightDifferences {
 public:
  SurfaceTerms(const SurfaceMesh& mesh, const Scale& scale, Constraints constraints)
      : mesh_(mesh), scale_(scale), constraints_(constraints) {}

  [[nodiscard]] Polynomial polynomial_of(const WeightConstraint& c, double margin) const {
    if (c.kind == Kind::crossing) return polynomial_of_crossing(from_to(c.p, c.q), margin);
    Polynomial n = c.kind == Kind::height ? height(c.p, c.q, c.r) : dual(c);
    if (margin != 0) {
      double m = 2 * squared_distance(c.p, c.q).approximation() * doubled_area(c.p, c.q, c.r);
      if (c.kind == Kind::dual) m *= doubled_area(c.q, c.p, c.s);
      n.constant += -(Number(margin) * Number(m));
    }
    return n;
  }
  /// b of an edge of a triangle whose third corner is in `others`; a crossing has none.
  [[nodiscard]] std::optional<Number> bound(VertexId a, VertexId b, std::span<const VertexId> others) const {
    return bound_in_triangle(constraints_, squared_distance(a, b),
                             [&] { return abs(squared_distance(a, others[0]) - squared_distance(b, others[0])); });
  }
  /// Twice the area of pqr, as rounded.
  [[nodiscard]] double doubled_area(VertexId p, VertexId q, VertexId r) const {
    const Vector3 n = cross(from_to(p, q), from_to(p, r));
    return std::sqrt(dot(n, n).approximation());
  }

 private:
  [[nodiscard]] Polynomial height(VertexId p, VertexId q, VertexId r) const {
    return polynomial_of_height(from_to(p, q), from_to(p, r), from_to(q, r));
  }
  [[nodiscard]] Polynomial dual(const WeightConstraint& c) const {
    const Polynomial left = height(c.p, c.q, c.r), right = height(c.q, c.p, c.s);
    const Number s(doubled_area(c.p, c.q, c.r)), t(doubled_area(c.q, c.p, c.s));
    const auto &a = left.coefficients, &b = right.coefficients;
    Polynomial sum = {{a[0] * t + b[1] * s, a[1] * t + b[0] * s, a[2] * t, b[2] * s},
                      left.constant * t + right.constant * s};
    const Number unknown = largest(left, c.p, c.q, c.r) * t + largest(right, c.q, c.p, c.s) * s;
    sum.constant += Number(unknown.approximation() * kAreaError * kRoundedUp);
    return sum;
  }
  /// A bound of |N| over pq in pqr, whose coefficients sum to zero: weights count from the weight of r.
  [[nodiscard]] Number largest(const Polynomial& n, VertexId p, VertexId q, VertexId r) const {
    const Number reach(kWeightReach);
    return abs(n.constant) +
           reach * (abs(n.coefficients[0]) * squared_distance(p, r) + abs(n.coefficients[1]) * squared_distance(q, r));
  }
  [[nodiscard]] Vec3 at(VertexId v) const {
    const Vec3 p = mesh_.position(v);
    return {scale_.coordinate(p.x), scale_.coordinate(p.y), scale_.coordinate(p.z)};
  }
  [[nodiscard]] Vector3 from_to(VertexId a, VertexId b) const {
    const Vec3 p = at(a), q = at(b);
    return {Number::difference(q.x, p.x), Number::difference(q.y, p.y), Number::difference(q.z, p.z)};
  }
  [[nodiscard]] Number squared_distance(VertexId a, VertexId b) const {
    const Vector3 edge = from_to(a, b);
    return dot(edge, edge);
  }

  const SurfaceMesh& mesh_;
  const Scale& scale_;
  Constraints constraints_;
};

/// Says whether no triangle of a constraint is too thin for the products.
bool has_areas(const SurfaceTerms& terms, const Certificate& certificate) {
  return std::all_of(certificate.terms.begin(), certificate.terms.end(), [&](const Certificate::Term& term) {
    const WeightConstraint& c = term.constraint;
    if (c.kind == Kind::crossing) return true;
    return terms.doubled_area(c.p, c.q, c.r) >= kLeastArea &&
           (c.kind == Kind::height || terms.doubled_area(c.q, c.p, c.s) >= kLeastArea);
  });
}

}  // namespace

CertificateCheck check_certificate(const SurfaceMesh& mesh, const Certificate& certificate) {
  if (!has_good_multipliers(certificate)) return CertificateCheck::bad_multiplier;
  if (!are_constraints_of(mesh.connectivity(), certificate)) return CertificateCheck::not_of_this_mesh;
  const Scale scale = scale_of(certificate, kDegrees, kLeastCoordinate, [&](VertexId v) { return mesh.position(v); });
  const SurfaceTerms terms(mesh, scale, certificate.constraints);
  if (!has_areas(terms, certificate)) return CertificateCheck::out_of_range;
  return check_sum(terms, certificate, scale);
}

}  // namespace temper::surfaces
