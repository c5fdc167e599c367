// The exact check of a certificate. It shares no code with the builder of the programs. From the positions it computes
// each N_c as a polynomial (feasibility.hpp), adds them with their multipliers, and examines the sum:
//
//   Σ m_c (N_c − t M_c)  =  C + Σ R_v w_v        C of degree 4 in the coordinates, R_v of degree 2
//
// The coefficients of each N_c sum to zero, so Σ R_v = 0 over each connected part of the certificate, and R_v w_v can
// be read as R_v (w_v − w_root). Along an edge weights differ by less than some b_pq (feasibility.hpp). Hence
// |w_v − w_root| < W_v, the sum along a path from the root. If C + Σ |R_v| W_v ≤ 0, no weights make every summand
// positive.
//
// On the sphere the sum is Σ R_v σ_v; σ > 0 has a factor of its own for each connected part. Along an edge the two σ
// differ by less than the part b_pq of either, so that σ_v < (1 + W_v) σ_root and σ_root < (1 + W_v) σ_v. Add
// Σ R_v (1 + W_v) over R_v > 0 and Σ R_v / (1 + W_v) over R_v < 0. If this is ≤ 0 in each part, no σ make every summand
// positive.
//
// Everything is exact, except M, a double, and b and W, which are rounded up. Coordinates are scaled by a power of two,
// differences are two-term sums, and the rest is arithmetic of expansions.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

#include "feasibility/certificate_sum.hpp"
#include "feasibility/potential.hpp"
#include "temper/feasibility.hpp"

namespace temper {
namespace {

using namespace certified;

// On the sphere a bound is another factor, a double of 53 bits above 2^-106: 4 · (90 + 53) + 250 + 53 + 159 = 1034 bits
// (compare kLeastInPlane).
constexpr double kLeastOnSphere = 0x1p-90;

Polynomial height_polynomial(Vec2 p, Vec2 q, Vec2 r, double margin) {
  const Vector2 pq = difference(q, p), pr = difference(r, p);
  Polynomial polynomial = polynomial_of_height(pq, pr, difference(r, q));
  if (margin != 0) polynomial.constant += -(Number(2 * margin) * dot(pq, pq) * cross(pq, pr));
  return polynomial;
}

Polynomial dual_polynomial(Vec2 p, Vec2 q, Vec2 r, Vec2 s, double margin) {
  const Vector2 pq = difference(q, p), pr = difference(r, p), ps = difference(s, p);
  const Number at_q = cross(pr, ps), at_r = cross(ps, pq), at_s = cross(pq, pr);
  Polynomial polynomial = {{at_q + at_r + at_s, -at_q, -at_r, -at_s},
                           dot(pq, pq) * at_q + dot(pr, pr) * at_r + dot(ps, ps) * at_s};
  if (margin != 0) polynomial.constant += -(Number(2 * margin) * at_s * at_r);
  return polynomial;
}

// --- on the sphere ------------------------------------------------------------------------------------------------

Vector3 exact_vector(Vec3 p) { return {Number(p.x), Number(p.y), Number(p.z)}; }
Number determinant(Vec3 p, Vec3 q, Vec3 r) { return dot(exact_vector(p), cross(exact_vector(q), exact_vector(r))); }
double volume(Vec3 p, Vec3 q, Vec3 r) { return dot(p, cross(q - p, r - p)); }

/// The term − t M σ, with M (σ_p + σ_q)/2.
void take_margin(Polynomial& polynomial, double margin, double m) {
  if (margin == 0) return;
  for (std::size_t k = 0; k < 2; ++k) polynomial.coefficients[k] += -(Number(margin) * Number(0.5 * m));
}

Polynomial height_polynomial(Vec3 p, Vec3 q, Vec3 r, double radius, double margin) {
  const Vector3 x = exact_vector(p), y = exact_vector(q), z = exact_vector(r), xy = cross(x, y);
  Polynomial polynomial = {{dot(xy, cross(y, z)), dot(xy, cross(z, x)), dot(xy, xy), Number()}, Number()};
  const double m = squared_length(cross(p, q - p)) * volume(p, q, r) / (radius * radius * radius);
  take_margin(polynomial, margin, m);
  return polynomial;
}

Polynomial crossing_polynomial(Vec3 p, Vec3 q, double margin) {
  const Vector3 x = exact_vector(p);
  Polynomial polynomial = {{-dot(x, exact_vector(q)), dot(x, x), Number(), Number()}, Number()};
  take_margin(polynomial, margin, squared_length(q - p));
  return polynomial;
}

Polynomial dual_polynomial(const std::array<Vec3, 4>& at, double radius, double margin) {
  const auto& [p, q, r, s] = at;
  Polynomial polynomial = {{-determinant(q, r, s), determinant(p, r, s), -determinant(p, q, s), determinant(p, q, r)},
                           Number()};
  take_margin(polynomial, margin, volume(p, q, r) * volume(q, p, s) / (radius * radius * radius));
  return polynomial;
}

/// |n/d − 1|, rounded up; nothing if the fraction has no bound.
std::optional<double> distance_from_one(const Number& n, const Number& d) {
  if (d.sign() != Sign::positive) return std::nullopt;
  return abs(n - d).approximation() / d.approximation() * kRoundedUp;
}

bool counts(Constraints constraints, Kind kind) {
  if (kind == Kind::equal_crossing) return constraints != Constraints::heights_only;  // it has no bound there
  switch (constraints) {
    case Constraints::well_centered:
      return kind == Kind::height || kind == Kind::crossing;
    case Constraints::heights_only:
      return kind == Kind::height;
    case Constraints::regular:
      return kind == Kind::dual;
    case Constraints::coefficients:
    case Constraints::distances:
      return kind == Kind::dual || kind == Kind::height;
    case Constraints::completely_well_centered:
      return false;
  }
  return false;
}

/// Says whether h is the only halfedge of its edge, or between two regions.
bool is_outer(const Mesh& mesh, HalfedgeId h, HalfedgeId back) {
  return !back.valid() || mesh.region(Mesh::triangle(h)) != mesh.region(Mesh::triangle(back));
}

/// Says whether c is the equation of one of these edges of interfaces.
bool is_seam(const Mesh& mesh, const WeightConstraint& c, std::span<const SeamEdge> seams) {
  const auto has = [&](HalfedgeId h, VertexId from, VertexId to) {
    return mesh.origin(h) == from && mesh.target(h) == to;
  };
  return !c.t.valid() && std::any_of(seams.begin(), seams.end(), [&](const SeamEdge& seam) {
    return has(seam.one, c.p, c.q) && has(seam.other, c.s, c.r);
  });
}

/// Says whether c is one of the mesh, with no vertex more than its kind has.
bool is_of(const Mesh& mesh, const WeightConstraint& c, bool outer_heights) {
  if (c.t.valid() || (c.s.valid() && c.kind != Kind::dual) || (c.r.valid() && c.kind == Kind::crossing)) return false;
  const auto is_vertex = [&](VertexId v) { return v.index < mesh.n_vertices() && !mesh.is_isolated(v); };
  if (!is_vertex(c.p) || !is_vertex(c.q)) return false;
  const HalfedgeId h = mesh.find_halfedge(c.p, c.q), back = mesh.find_halfedge(c.q, c.p);
  if (c.kind == Kind::crossing) return h.valid() || back.valid();
  if (!h.valid() || mesh.opposite(h) != c.r) return false;
  if (c.kind == Kind::height) return !outer_heights || is_outer(mesh, h, back);
  return back.valid() && mesh.opposite(back) == c.s;
}

/// z is 0 in the plane.
Vec3 place_in(const Mesh& mesh, VertexId v) {
  if (!mesh.space().is_plane()) return position_of(mesh, v);
  const Vec2 p = mesh.position(v);
  return {p.x, p.y, 0};
}

/// The terms of the sum in the plane.
class PlaneTerms : public WeightDifferences {
 public:
  PlaneTerms(const Mesh& mesh, const Scale& scale, Constraints constraints)
      : mesh_(mesh), scale_(scale), constraints_(constraints) {}

  [[nodiscard]] Polynomial polynomial_of(const WeightConstraint& c, double margin) const {
    switch (c.kind) {
      case Kind::height:
        return height_polynomial(at(c.p, c.p), at(c.q, c.p), at(c.r, c.p), margin);
      case Kind::dual:
        return dual_polynomial(at(c.p, c.p), at(c.q, c.p), at(c.r, c.p), at(c.s, c.p), margin);
      case Kind::equal_crossing:
        return polynomial_of_equal_crossing(difference(at(c.q, c.p), at(c.p, c.p)),
                                            difference(at(c.s, c.r), at(c.r, c.r)));
      default:
        return polynomial_of_crossing(difference(at(c.q, c.p), at(c.p, c.p)), margin);
    }
  }
  /// b of an edge of a triangle whose third corner is in `others`; a crossing has none.
  [[nodiscard]] std::optional<Number> bound(VertexId a, VertexId b, std::span<const VertexId> others) const {
    return bound_in_triangle(constraints_, squared_distance(a, b),
                             [&] { return abs(squared_distance(a, others[0]) - squared_distance(b, others[0])); });
  }

 private:
  /// The image of v near another vertex. It is exact, and less than 2 away from the scaled coordinates.
  [[nodiscard]] Vec2 at(VertexId v, VertexId near) const {
    const WeightedPoint p = mesh_.point(v, mesh_.point(near));
    return {scale_.coordinate(p.x), scale_.coordinate(p.y)};
  }
  [[nodiscard]] Number squared_distance(VertexId a, VertexId b) const {
    const Vector2 edge = difference(at(a, a), at(b, a));
    return dot(edge, edge);
  }

  const Mesh& mesh_;
  const Scale& scale_;
  Constraints constraints_;
};

/// The terms of the sum on the sphere.
class SphereTerms {
 public:
  SphereTerms(const Mesh& mesh, const Scale& scale, Constraints constraints)
      : mesh_(mesh), scale_(scale), constraints_(constraints), radius_(scale.coordinate(mesh.space().radius())) {}

  [[nodiscard]] Polynomial polynomial_of(const WeightConstraint& c, double margin) const {
    switch (c.kind) {
      case Kind::height:
        return height_polynomial(at(c.p), at(c.q), at(c.r), radius_, margin);
      case Kind::dual:
        return dual_polynomial({at(c.p), at(c.q), at(c.r), at(c.s)}, radius_, margin);
      default:
        return crossing_polynomial(at(c.p), at(c.q), margin);
    }
  }
  /// The bound b. Crossings give p·q/|p|² < σ_q/σ_p < |q|²/p·q. With heights alone the orthocenter o is in the
  /// triangle, and σ_q/σ_p = q·o/p·o is between the least and the greatest of these two and r·q/r·p. Returns nothing if
  /// cells are so large that no bound exists.
  [[nodiscard]] std::optional<Number> bound(VertexId a, VertexId b, std::span<const VertexId> others) const {
    const Vector3 p = exact_vector(at(a)), q = exact_vector(at(b));
    const Number pq = dot(p, q);
    std::optional<double> most = larger(distance_from_one(pq, dot(p, p)), distance_from_one(dot(q, q), pq));
    if (most && assumes_reach(constraints_)) return Number(std::min(kWeightReach * *most, 1.0));
    if (constraints_ == Constraints::heights_only) {
      const Vector3 across = exact_vector(at(others[0]));
      most = larger(most, distance_from_one(dot(across, q), dot(across, p)));
    }
    if (!most) return std::nullopt;
    return Number(*most);
  }
  [[nodiscard]] static Number reach_beyond(const Number& reach, const Number& bound) {
    return Number((reach + bound + bound * reach).approximation() * kRoundedUp);
  }
  /// The greatest value of R σ relative to σ_root. Near one 1/(1 + W) > 1 − W is exact enough.
  [[nodiscard]] static Number most(const Number& residual, const Number& reach) {
    constexpr double kNear = 0.5, kRoundedDown = 1 - 0x1p-40;
    if (residual.sign() == Sign::positive) return residual + residual * reach;
    const double w = reach.approximation();
    if (w < kNear) return residual - residual * reach;
    return residual * Number(kRoundedDown / (1 + w));
  }
  static constexpr bool kPartsHaveFactors = true;
  static constexpr Kind kInnerDual = Kind::dual;

 private:
  [[nodiscard]] Vec3 at(VertexId v) const {
    const Vec3 p = position_of(mesh_, v);
    return {scale_.coordinate(p.x), scale_.coordinate(p.y), scale_.coordinate(p.z)};
  }
  static std::optional<double> larger(std::optional<double> a, std::optional<double> b) {
    if (!a || !b) return std::nullopt;
    return std::max(*a, *b);
  }

  const Mesh& mesh_;
  const Scale& scale_;
  Constraints constraints_;
  double radius_;
};

bool are_of(const Mesh& mesh, std::span<const SeamEdge> seams, const Certificate& certificate) {
  const bool outer = assumes_reach(certificate.constraints);
  return std::all_of(certificate.terms.begin(), certificate.terms.end(), [&](const Certificate::Term& term) {
    const WeightConstraint& c = term.constraint;
    const bool known = c.kind == Kind::equal_crossing ? is_seam(mesh, c, seams) : is_of(mesh, c, outer);
    return known && counts(certificate.constraints, c.kind);
  });
}

}  // namespace

bool certified::are_constraints_of(const Mesh& mesh, const Certificate& certificate) {
  return are_of(mesh, {}, certificate);
}

std::string_view name(CertificateCheck check) {
  constexpr std::array<std::string_view, 5> kNames = {"proves", "proves_nothing", "not_of_this_mesh", "bad_multiplier",
                                                      "out_of_range"};
  return kNames[static_cast<std::size_t>(check)];
}

namespace {

CertificateCheck check_with(const Mesh& mesh, std::span<const SeamEdge> seams, const Certificate& certificate) {
  if (!has_good_multipliers(certificate)) return CertificateCheck::bad_multiplier;
  if (!are_of(mesh, seams, certificate)) return CertificateCheck::not_of_this_mesh;
  const bool in_plane = mesh.space().is_plane();
  const Scale scale =
      scale_of(certificate, {4, 2, in_plane ? 4 : 3, 0, 0, 4}, in_plane ? kLeastInPlane : kLeastOnSphere,
               [&](VertexId v) { return place_in(mesh, v); });
  if (in_plane) return check_sum(PlaneTerms(mesh, scale, certificate.constraints), certificate, scale);
  return check_sum(SphereTerms(mesh, scale, certificate.constraints), certificate, scale);
}

}  // namespace

CertificateCheck check_certificate(const Mesh& mesh, const Certificate& certificate) {
  return check_with(mesh, {}, certificate);
}

CertificateCheck check_certificate(const MetricMesh& pieces, const Certificate& certificate) {
  return check_with(pieces.mesh, seams_of(pieces), certificate);
}

}  // namespace temper
