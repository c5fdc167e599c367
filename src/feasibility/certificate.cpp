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

#include "base/assert.hpp"
#include "feasibility/exact_number.hpp"
#include "feasibility/potential.hpp"
#include "temper/feasibility.hpp"

namespace temper {
namespace {

using exact::Number;
using Kind = WeightConstraint::Kind;

// After scaling coordinates are below 1 and multiples of 2^-53 times the least of them. The product of four differences
// and a multiplier must be a multiple of 2^-1074: 4 · (120 + 53) + 250 + 53 = 995 bits. On the sphere a bound is
// another factor, a double of 53 bits above 2^-106: 4 · (90 + 53) + 250 + 53 + 159 = 1034.
constexpr double kLeastCoordinate = 0x1p-120, kLeastOnSphere = 0x1p-90;
constexpr double kLeastMultiplier = 0x1p-250;

struct Vector {
  Number x, y;
};
Vector difference(Vec2 a, Vec2 b) { return {Number::difference(a.x, b.x), Number::difference(a.y, b.y)}; }
Number dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y; }
Number cross(const Vector& a, const Vector& b) { return a.x * b.y - a.y * b.x; }

/// N − t M of one constraint: coefficients of the weights of its vertices, and the rest.
struct Polynomial {
  std::array<Number, 4> coefficients;
  Number constant;
};

Polynomial height_polynomial(Vec2 p, Vec2 q, Vec2 r, double margin) {
  const Vector pq = difference(q, p), pr = difference(r, p), qr = difference(r, q);
  const Number at_p = dot(pq, pr), at_q = -dot(pq, qr), at_r = dot(pr, qr);
  const Number l2 = at_p + at_q;
  Polynomial polynomial = {{at_q, at_p, -l2, Number()}, l2 * at_r};
  if (margin != 0) polynomial.constant += -(Number(2 * margin) * l2 * cross(pq, pr));
  return polynomial;
}

Polynomial crossing_polynomial(Vec2 p, Vec2 q, double margin) {
  const Vector pq = difference(q, p);
  const Number l2 = dot(pq, pq);
  Polynomial polynomial = {{Number(1), Number(-1), Number(), Number()}, l2};
  if (margin != 0) polynomial.constant += -(Number(2 * margin) * l2);
  return polynomial;
}

Polynomial dual_polynomial(Vec2 p, Vec2 q, Vec2 r, Vec2 s, double margin) {
  const Vector pq = difference(q, p), pr = difference(r, p), ps = difference(s, p);
  const Number at_q = cross(pr, ps), at_r = cross(ps, pq), at_s = cross(pq, pr);
  Polynomial polynomial = {{at_q + at_r + at_s, -at_q, -at_r, -at_s},
                           dot(pq, pq) * at_q + dot(pr, pr) * at_r + dot(ps, ps) * at_s};
  if (margin != 0) polynomial.constant += -(Number(2 * margin) * at_s * at_r);
  return polynomial;
}

// --- on the sphere ------------------------------------------------------------------------------------------------

struct Vector3 {
  Number x, y, z;
};
Number dot(const Vector3& a, const Vector3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
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

Polynomial crossing_polynomial(Vec3 p, Vec3 q, double /*radius*/, double margin) {
  const Vector3 x = exact_vector(p);
  Polynomial polynomial = {{-dot(x, exact_vector(q)), dot(x, x), Number(), Number()}, Number()};
  take_margin(polynomial, margin, squared_length(q - p));
  return polynomial;
}

Polynomial dual_polynomial(Vec3 p, Vec3 q, Vec3 r, Vec3 s, double radius, double margin) {
  Polynomial polynomial = {{-determinant(q, r, s), determinant(p, r, s), -determinant(p, q, s), determinant(p, q, r)},
                           Number()};
  take_margin(polynomial, margin, volume(p, q, r) * volume(q, p, s) / (radius * radius * radius));
  return polynomial;
}

constexpr double kRoundedUp = 1 + 0x1p-40;  // far above the rounding of approximation() and a quotient
/// |n/d − 1|, rounded up; nothing if the fraction has no bound.
std::optional<double> distance_from_one(const Number& n, const Number& d) {
  if (d.sign() != Sign::positive) return std::nullopt;
  return abs(n - d).approximation() / d.approximation() * kRoundedUp;
}

bool counts(Constraints constraints, Kind kind) {
  switch (constraints) {
    case Constraints::well_centered:
      return kind == Kind::height || kind == Kind::crossing;
    case Constraints::heights_only:
      return kind == Kind::height;
    case Constraints::regular:
      return kind == Kind::dual;
  }
  return false;
}

bool is_of(const Mesh& mesh, const WeightConstraint& c) {
  const auto is_vertex = [&](VertexId v) { return v.index < mesh.n_vertices() && !mesh.is_isolated(v); };
  if (!is_vertex(c.p) || !is_vertex(c.q)) return false;
  const HalfedgeId h = mesh.find_halfedge(c.p, c.q), back = mesh.find_halfedge(c.q, c.p);
  if (c.kind == Kind::crossing) return h.valid() || back.valid();
  if (!h.valid() || mesh.opposite(h) != c.r) return false;
  return c.kind == Kind::height || (back.valid() && mesh.opposite(back) == c.s);
}

bool has_good_multipliers(const Certificate& certificate) {
  const auto good = [](const Certificate::Term& term) {
    return std::isfinite(term.multiplier) && term.multiplier >= 0;
  };
  const auto positive = [](const Certificate::Term& term) { return term.multiplier > 0; };
  return certificate.margin >= 0 && certificate.margin < 0.5 &&
         std::all_of(certificate.terms.begin(), certificate.terms.end(), good) &&
         std::any_of(certificate.terms.begin(), certificate.terms.end(), positive);
}

/// Exponents that bring coordinates into [−1, 1] and the multiplier 1 into the middle of its range.
struct Scale {
  int length = 0, multiplier = 0;
  bool in_range = true;

  int degree_of_dual = 4;

  [[nodiscard]] double coordinate(double x) const { return std::ldexp(x, -length); }
  /// The scale of N, by its degree, so that the sum stays the same up to a factor.
  [[nodiscard]] int shift(Kind kind) const {
    return length * (kind == Kind::crossing ? 2 : kind == Kind::height ? 4 : degree_of_dual);
  }
  [[nodiscard]] double of(const Certificate::Term& term) const {
    return std::ldexp(term.multiplier, shift(term.constraint.kind) - multiplier);
  }
};

/// z is 0 in the plane.
Vec3 place_in(const Mesh& mesh, VertexId v) {
  if (!mesh.space().is_plane()) return position_of(mesh, v);
  const Vec2 p = mesh.position(v);
  return {p.x, p.y, 0};
}

template <class Use>
void for_each_vertex(const WeightConstraint& c, const Use& use) {
  use(c.p), use(c.q);
  if (c.kind != Kind::crossing) use(c.r);
  if (c.kind == Kind::dual) use(c.s);
}

Scale scale_of(const Mesh& mesh, const Certificate& certificate) {
  Scale scale;
  scale.degree_of_dual = mesh.space().is_plane() ? 4 : 3;
  double largest = 0, least = kUnbounded;
  for (const auto& term : certificate.terms) {
    for_each_vertex(term.constraint, [&](VertexId v) {
      const Vec3 place = place_in(mesh, v);
      for (const double x : {std::abs(place.x), std::abs(place.y), std::abs(place.z)}) {
        largest = std::max(largest, x);
        if (x > 0) least = std::min(least, x);
      }
    });
  }
  std::frexp(largest, &scale.length);
  // Exponents are integers, as the shifted multipliers themselves might not be doubles.
  int most = -100000, fewest = 100000;
  for (const auto& term : certificate.terms) {
    if (term.multiplier == 0) continue;
    int exponent = 0;
    std::frexp(term.multiplier, &exponent);
    exponent += scale.shift(term.constraint.kind);
    most = std::max(most, exponent), fewest = std::min(fewest, exponent);
  }
  scale.multiplier = most;
  scale.in_range = std::ldexp(least, -scale.length) >= (mesh.space().is_plane() ? kLeastCoordinate : kLeastOnSphere) &&
                   std::ldexp(1.0, std::max(fewest - most, -1000)) >= kLeastMultiplier &&
                   (certificate.margin == 0 || certificate.margin >= 0x1p-20);  // 20 + 53 bits more: 1068 in all
  return scale;
}

/// The terms of the sum in the plane.
class PlaneTerms {
 public:
  PlaneTerms(const Mesh& mesh, const Scale& scale, Constraints constraints)
      : mesh_(mesh), scale_(scale), constraints_(constraints) {}

  [[nodiscard]] Polynomial polynomial_of(const WeightConstraint& c, double margin) const {
    switch (c.kind) {
      case Kind::height:
        return height_polynomial(at(c.p), at(c.q), at(c.r), margin);
      case Kind::crossing:
        return crossing_polynomial(at(c.p), at(c.q), margin);
      case Kind::dual:
        return dual_polynomial(at(c.p), at(c.q), at(c.r), at(c.s), margin);
    }
    return {};
  }
  /// b of an edge of a triangle whose third corner is r; a crossing has no r.
  [[nodiscard]] std::optional<Number> bound(VertexId a, VertexId b, VertexId r) const {
    const Number length = squared_distance(a, b);
    if (constraints_ == Constraints::regular) return Number(kWeightReach) * length;
    if (constraints_ != Constraints::heights_only) return length;
    Number across = abs(squared_distance(a, r) - squared_distance(b, r));
    return (across - length).sign() == Sign::positive ? across : length;
  }
  /// W beyond an edge.
  [[nodiscard]] static Number reach_beyond(const Number& reach, const Number& bound) { return reach + bound; }
  /// The greatest value of R w relative to w_root.
  [[nodiscard]] static Number most(const Number& residual, const Number& reach) { return abs(residual) * reach; }
  static constexpr bool kPartsHaveFactors = false;

 private:
  [[nodiscard]] Vec2 at(VertexId v) const {
    const Vec2 p = mesh_.position(v);
    return {scale_.coordinate(p.x), scale_.coordinate(p.y)};
  }
  [[nodiscard]] Number squared_distance(VertexId a, VertexId b) const {
    const Vector edge = difference(at(a), at(b));
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
      case Kind::crossing:
        return crossing_polynomial(at(c.p), at(c.q), radius_, margin);
      case Kind::dual:
        return dual_polynomial(at(c.p), at(c.q), at(c.r), at(c.s), radius_, margin);
    }
    return {};
  }
  /// The bound b. Crossings give p·q/|p|² < σ_q/σ_p < |q|²/p·q. With heights alone the orthocenter o is in the
  /// triangle, and σ_q/σ_p = q·o/p·o is between the least and the greatest of these two and r·q/r·p. Returns nothing if
  /// cells are so large that no bound exists.
  [[nodiscard]] std::optional<Number> bound(VertexId a, VertexId b, VertexId r) const {
    const Vector3 p = exact_vector(at(a)), q = exact_vector(at(b));
    const Number pq = dot(p, q);
    std::optional<double> most = larger(distance_from_one(pq, dot(p, p)), distance_from_one(dot(q, q), pq));
    if (most && constraints_ == Constraints::regular) return Number(std::min(kWeightReach * *most, 1.0));
    if (constraints_ == Constraints::heights_only) {
      const Vector3 across = exact_vector(at(r));
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

/// The sum, vertex by vertex, and the edges along which weights, or σ, differ by a bound.
template <class Terms>
class Sum {
 public:
  Sum(const Mesh& mesh, const Certificate& certificate, const Scale& scale)
      : terms_(mesh, scale, certificate.constraints), scale_(scale) {
    for (const auto& term : certificate.terms) {
      if (term.multiplier > 0) add(term, certificate.margin);
    }
  }
  /// C plus the upper bound of each part; if parts have factors of their own, the largest of these sums.
  [[nodiscard]] Number upper_bound() const;

 private:
  struct Node {
    Number residual;
    std::vector<std::pair<VertexId, Number>> neighbors;  ///< with b_pq
  };

  void join_edge(VertexId a, VertexId b, VertexId r) {
    const std::optional<Number> bound = terms_.bound(a, b, r);
    if (!bound) return;
    nodes_[a].neighbors.emplace_back(b, *bound);
    nodes_[b].neighbors.emplace_back(a, *bound);
  }
  void join_triangle(VertexId a, VertexId b, VertexId c) { join_edge(a, b, c), join_edge(b, c, a), join_edge(c, a, b); }

  void add(const Certificate::Term& term, double margin) {
    const auto [kind, p, q, r, s] = term.constraint;
    const Polynomial polynomial = terms_.polynomial_of(term.constraint, margin);
    const Number multiplier(scale_.of(term));
    constant_ += multiplier * polynomial.constant;
    int k = 0;
    for_each_vertex(term.constraint, [&](VertexId v) {
      nodes_[v].residual += multiplier * polynomial.coefficients[static_cast<std::size_t>(k++)];
    });
    if (kind == Kind::crossing) join_edge(p, q, VertexId());
    if (kind != Kind::crossing) join_triangle(p, q, r);
    if (kind == Kind::dual) join_triangle(q, p, s);
  }

  /// The upper bound of the root's part, W_v along a breadth-first tree. Notes the vertices in it.
  [[nodiscard]] Number part_bound(VertexId root, std::map<VertexId, Number>& reach) const;

  Terms terms_;
  const Scale& scale_;
  Number constant_;
  std::map<VertexId, Node> nodes_;  // ordered: the same path whatever the order of the terms
};

template <class Terms>
Number Sum<Terms>::part_bound(VertexId root, std::map<VertexId, Number>& reach) const {
  Number bound;
  reach[root] = Number();
  std::vector<VertexId> queue = {root};
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const VertexId v = queue[i];
    const Node& node = nodes_.at(v);
    bound += Terms::most(node.residual, reach[v]);
    for (const auto& [u, difference] : node.neighbors) {
      if (reach.count(u) > 0) continue;
      reach[u] = Terms::reach_beyond(reach[v], difference);
      queue.push_back(u);
    }
  }
  return bound;
}

template <class Terms>
Number Sum<Terms>::upper_bound() const {
  Number bound = constant_;
  std::map<VertexId, Number> reach;  // W_v
  bool first = true;
  for (const auto& [root, unused] : nodes_) {
    if (reach.count(root) > 0) continue;
    const Number part = part_bound(root, reach);
    if (!Terms::kPartsHaveFactors) {
      bound += part;
    } else if (first || (part - bound).sign() == Sign::positive) {
      bound = part;
    }
    first = false;
  }
  return bound;
}

}  // namespace

std::string_view name(CertificateCheck check) {
  constexpr std::array<std::string_view, 5> kNames = {"proves", "proves_nothing", "not_of_this_mesh", "bad_multiplier",
                                                      "out_of_range"};
  return kNames[static_cast<std::size_t>(check)];
}

CertificateCheck check_certificate(const Mesh& mesh, const Certificate& certificate) {
  if (!has_good_multipliers(certificate)) return CertificateCheck::bad_multiplier;
  for (const auto& term : certificate.terms) {
    if (!counts(certificate.constraints, term.constraint.kind) || !is_of(mesh, term.constraint)) {
      return CertificateCheck::not_of_this_mesh;
    }
  }
  const Scale scale = scale_of(mesh, certificate);
  if (!scale.in_range) return CertificateCheck::out_of_range;
  const Number total = mesh.space().is_plane() ? Sum<PlaneTerms>(mesh, certificate, scale).upper_bound()
                                               : Sum<SphereTerms>(mesh, certificate, scale).upper_bound();
  return total.sign() == Sign::positive ? CertificateCheck::proves_nothing : CertificateCheck::proves;
}

}  // namespace temper
