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

/// Triangles of points in space.
class PointMetric {
 public:
  PointMetric(const SurfaceMesh& mesh, const Scale& scale) : mesh_(mesh), scale_(scale) {}
  [[nodiscard]] Number squared_distance(VertexId a, VertexId b) const {
    const Vector3 edge = from_to(a, b);
    return dot(edge, edge);
  }
  [[nodiscard]] Polynomial height(VertexId p, VertexId q, VertexId r) const {
    return polynomial_of_height(from_to(p, q), from_to(p, r), from_to(q, r));
  }
  [[nodiscard]] Number squared_doubled_area(VertexId p, VertexId q, VertexId r) const {
    const Vector3 n = cross(from_to(p, q), from_to(p, r));
    return dot(n, n);
  }

 private:
  [[nodiscard]] Vec3 at(VertexId v) const {
    const Vec3 p = mesh_.position(v);
    return {scale_.coordinate(p.x), scale_.coordinate(p.y), scale_.coordinate(p.z)};
  }
  [[nodiscard]] Vector3 from_to(VertexId a, VertexId b) const {
    const Vec3 p = at(a), q = at(b);
    return {Number::difference(q.x, p.x), Number::difference(q.y, p.y), Number::difference(q.z, p.z)};
  }

  const SurfaceMesh& mesh_;
  const Scale& scale_;
};

/// Triangles of squared lengths. A squared length has as many bits as the square of a coordinate, at most.
class LengthMetric {
 public:
  LengthMetric(const IntrinsicMesh& mesh, const Scale& scale) : mesh_(mesh), scale_(scale) {}
  [[nodiscard]] Number squared_distance(VertexId a, VertexId b) const {
    const Mesh& mesh = mesh_.connectivity();
    const HalfedgeId h = mesh.find_halfedge(a, b);
    return Number(scaled(mesh_.squared_length(h.valid() ? h : mesh.find_halfedge(b, a))));
  }
  [[nodiscard]] Polynomial height(VertexId p, VertexId q, VertexId r) const {
    const Number l2 = squared_distance(p, q), at_p = dot_at(p, q, r), at_q = dot_at(q, p, r);
    return {{at_q, at_p, -l2}, l2 * dot_at(r, p, q)};
  }
  [[nodiscard]] Number squared_doubled_area(VertexId p, VertexId q, VertexId r) const {
    const Number at_p = dot_at(p, q, r);
    return squared_distance(p, q) * squared_distance(p, r) - at_p * at_p;
  }

 private:
  [[nodiscard]] double scaled(double l2) const { return scale_.coordinate(scale_.coordinate(l2)); }
  /// pq·pr.
  [[nodiscard]] Number dot_at(VertexId p, VertexId q, VertexId r) const {
    return Number(0.5) * (squared_distance(p, q) + squared_distance(p, r) - squared_distance(q, r));
  }

  const IntrinsicMesh& mesh_;
  const Scale& scale_;
};

/// The terms of the sum.
template <class Metric>
class SurfaceTerms : public WeightDifferences {
 public:
  SurfaceTerms(Metric metric, Constraints constraints) : metric_(metric), constraints_(constraints) {}

  [[nodiscard]] Polynomial polynomial_of(const WeightConstraint& c, double margin) const {
    if (c.kind == Kind::crossing) return polynomial_of_crossing(squared_distance(c.p, c.q), margin);
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
    return std::sqrt(metric_.squared_doubled_area(p, q, r).approximation());
  }

 private:
  [[nodiscard]] Polynomial height(VertexId p, VertexId q, VertexId r) const { return metric_.height(p, q, r); }
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
  [[nodiscard]] Number squared_distance(VertexId a, VertexId b) const { return metric_.squared_distance(a, b); }

  Metric metric_;
  Constraints constraints_;
};

/// Says whether no triangle of a constraint is too thin for the products.
template <class Terms>
bool has_areas(const Terms& terms, const Certificate& certificate) {
  return std::all_of(certificate.terms.begin(), certificate.terms.end(), [&](const Certificate::Term& term) {
    const WeightConstraint& c = term.constraint;
    if (c.kind == Kind::crossing) return true;
    return terms.doubled_area(c.p, c.q, c.r) >= kLeastArea &&
           (c.kind == Kind::height || terms.doubled_area(c.q, c.p, c.s) >= kLeastArea);
  });
}

/// `place_of(v)` is for the scale alone.
template <class Metric, class Surface, class PlaceOf>
CertificateCheck check(const Surface& mesh, const Certificate& certificate, const PlaceOf& place_of) {
  if (!has_good_multipliers(certificate)) return CertificateCheck::bad_multiplier;
  if (!are_constraints_of(mesh.connectivity(), certificate)) return CertificateCheck::not_of_this_mesh;
  const Scale scale = scale_of(certificate, kDegrees, kLeastCoordinate, place_of);
  const SurfaceTerms<Metric> terms(Metric(mesh, scale), certificate.constraints);
  if (!has_areas(terms, certificate)) return CertificateCheck::out_of_range;
  return check_sum(terms, certificate, scale);
}

}  // namespace

CertificateCheck check_certificate(const SurfaceMesh& mesh, const Certificate& certificate) {
  return check<PointMetric>(mesh, certificate, [&](VertexId v) { return mesh.position(v); });
}

CertificateCheck check_certificate(const IntrinsicMesh& mesh, const Certificate& certificate) {
  return check<LengthMetric>(mesh, certificate, [&](VertexId v) {
    Vec3 lengths = {kUnbounded, 0, 0};
    for (const HalfedgeId h : mesh.connectivity().star(v)) {
      for (const HalfedgeId side : {h, Mesh::prev(h)}) {
        const double l = std::sqrt(mesh.squared_length(side));
        lengths = {std::min(lengths.x, l), std::max(lengths.y, l), 0};
      }
    }
    return lengths;
  });
}

}  // namespace temper::surfaces
