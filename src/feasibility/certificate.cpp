// The exact check of a certificate. It shares no code with what makes the programmes: from the positions it computes
// each N_c anew, as a polynomial (feasibility.hpp), adds them with their multipliers, and looks at what is left:
//
//   Σ m_c (N_c − t M_c)  =  C + Σ R_v w_v        C of degree 4 in the coordinates, R_v of degree 2
//
// The coefficients of each N_c sum to zero, so Σ R_v = 0 over each connected part of the certificate and R_v w_v may
// be read as R_v (w_v − w_root). Along an edge weights differ by less than some b_pq (feasibility.hpp), hence
// |w_v − w_root| < W_v, the sum along a path from the root. If C + Σ |R_v| W_v ≤ 0, no weights make every summand
// positive.
//
// Everything is exact: coordinates are scaled by a power of two, differences are two-term sums, and the rest is
// arithmetic of expansions.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include "base/assert.hpp"
#include "feasibility/exact_number.hpp"
#include "temper/feasibility.hpp"

namespace temper {
namespace {

using exact::Number;
using Kind = WeightConstraint::Kind;

// After scaling coordinates are below 1 and multiples of 2^-53 times the least of them; the product of four differences
// and a multiplier must be a multiple of 2^-1074: 4 · (120 + 53) + 250 + 53 = 995 bits.
constexpr double kLeastCoordinate = 0x1p-120;
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

Polynomial split_polynomial(Vec2 p, Vec2 q, double margin) {
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

bool counts(Conditions conditions, Kind kind) {
  switch (conditions) {
    case Conditions::well_centered:
      return kind == Kind::height || kind == Kind::split;
    case Conditions::heights_only:
      return kind == Kind::height;
    case Conditions::regular:
      return kind == Kind::dual;
  }
  return false;
}

bool is_of(const Mesh& mesh, const WeightConstraint& c) {
  const auto is_vertex = [&](VertexId v) { return v.index < mesh.n_vertices() && !mesh.is_isolated(v); };
  if (!is_vertex(c.p) || !is_vertex(c.q)) return false;
  const HalfedgeId h = mesh.find_halfedge(c.p, c.q), back = mesh.find_halfedge(c.q, c.p);
  if (c.kind == Kind::split) return h.valid() || back.valid();
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

  [[nodiscard]] Vec2 position(Vec2 p) const { return {std::ldexp(p.x, -length), std::ldexp(p.y, -length)}; }
  /// The scale of N: degree 2 for splits, else 4, so that the sum stays the same up to a factor.
  [[nodiscard]] int shift(Kind kind) const { return kind == Kind::split ? 2 * length : 4 * length; }
  [[nodiscard]] double of(const Certificate::Term& term) const {
    return std::ldexp(term.multiplier, shift(term.constraint.kind) - multiplier);
  }
};

template <class Use>
void for_each_vertex(const WeightConstraint& c, const Use& use) {
  use(c.p), use(c.q);
  if (c.kind != Kind::split) use(c.r);
  if (c.kind == Kind::dual) use(c.s);
}

Scale scale_of(const Mesh& mesh, const Certificate& certificate) {
  Scale scale;
  double largest = 0, least = kUnbounded;
  for (const auto& term : certificate.terms) {
    for_each_vertex(term.constraint, [&](VertexId v) {
      for (const double x : {std::abs(mesh.position(v).x), std::abs(mesh.position(v).y)}) {
        largest = std::max(largest, x);
        if (x > 0) least = std::min(least, x);
      }
    });
  }
  std::frexp(largest, &scale.length);
  // Exponents as integers: the shifted multipliers themselves might not be doubles.
  int most = -100000, fewest = 100000;
  for (const auto& term : certificate.terms) {
    if (term.multiplier == 0) continue;
    int exponent = 0;
    std::frexp(term.multiplier, &exponent);
    exponent += scale.shift(term.constraint.kind);
    most = std::max(most, exponent), fewest = std::min(fewest, exponent);
  }
  scale.multiplier = most;
  scale.in_range = std::ldexp(least, -scale.length) >= kLeastCoordinate &&
                   std::ldexp(1.0, std::max(fewest - most, -1000)) >= kLeastMultiplier &&
                   (certificate.margin == 0 || certificate.margin >= 0x1p-20);  // 20 + 53 bits more: 1068 in all
  return scale;
}

/// The sum, vertex by vertex, and the edges along which differences of weights are bounded.
class Sum {
 public:
  Sum(const Mesh& mesh, const Certificate& certificate, const Scale& scale)
      : mesh_(mesh), scale_(scale), conditions_(certificate.conditions) {
    for (const auto& term : certificate.terms) {
      if (term.multiplier > 0) add(term, certificate.margin);
    }
  }
  /// C + Σ |R_v| W_v.
  [[nodiscard]] Number upper_bound() const { return constant_ + residual_bound(); }

 private:
  struct Node {
    Number residual;
    std::vector<std::pair<VertexId, Number>> neighbours;  ///< with b_pq
  };

  [[nodiscard]] Vec2 at(VertexId v) const { return scale_.position(mesh_.position(v)); }
  [[nodiscard]] Number squared_distance(VertexId a, VertexId b) const {
    const Vector edge = difference(at(a), at(b));
    return dot(edge, edge);
  }

  void join(VertexId a, VertexId b, const Number& bound) {
    nodes_[a].neighbours.emplace_back(b, bound);
    nodes_[b].neighbours.emplace_back(a, bound);
  }
  /// An edge of a triangle whose third corner is r; of a split there is none.
  void join_edge(VertexId a, VertexId b, VertexId r) {
    Number bound = squared_distance(a, b);
    if (conditions_ == Conditions::regular) bound = Number(kWeightReach) * bound;
    if (conditions_ == Conditions::heights_only) {
      const Number across = abs(squared_distance(a, r) - squared_distance(b, r));
      if ((across - bound).sign() == Sign::positive) bound = across;
    }
    join(a, b, bound);
  }
  void join_triangle(VertexId a, VertexId b, VertexId c) { join_edge(a, b, c), join_edge(b, c, a), join_edge(c, a, b); }

  void add(const Certificate::Term& term, double margin) {
    const auto [kind, p, q, r, s] = term.constraint;
    const Polynomial polynomial = polynomial_of(term.constraint, margin);
    const Number multiplier(scale_.of(term));
    constant_ += multiplier * polynomial.constant;
    int k = 0;
    for_each_vertex(term.constraint, [&](VertexId v) {
      nodes_[v].residual += multiplier * polynomial.coefficients[static_cast<std::size_t>(k++)];
    });
    if (kind == Kind::split) join_edge(p, q, VertexId());
    if (kind != Kind::split) join_triangle(p, q, r);
    if (kind == Kind::dual) join_triangle(q, p, s);
  }

  [[nodiscard]] Polynomial polynomial_of(const WeightConstraint& c, double margin) const {
    switch (c.kind) {
      case Kind::height:
        return height_polynomial(at(c.p), at(c.q), at(c.r), margin);
      case Kind::split:
        return split_polynomial(at(c.p), at(c.q), margin);
      case Kind::dual:
        return dual_polynomial(at(c.p), at(c.q), at(c.r), at(c.s), margin);
    }
    return {};
  }

  [[nodiscard]] Number residual_bound() const;

  const Mesh& mesh_;
  const Scale& scale_;
  Conditions conditions_;
  Number constant_;
  std::map<VertexId, Node> nodes_;  // ordered: the same path whatever the order of the terms
};

/// Σ |R_v| W_v, W_v along a breadth-first tree of each connected part.
Number Sum::residual_bound() const {
  Number bound;
  std::map<VertexId, Number> reach;  // W_v
  for (const auto& [root, unused] : nodes_) {
    if (reach.count(root) > 0) continue;
    reach[root] = Number();
    std::vector<VertexId> queue = {root};
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const VertexId v = queue[i];
      bound += abs(nodes_.at(v).residual) * reach[v];
      for (const auto& [u, difference] : nodes_.at(v).neighbours) {
        if (reach.count(u) > 0) continue;
        reach[u] = reach[v] + difference;
        queue.push_back(u);
      }
    }
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
  TEMPER_ASSERT(mesh.space().is_plane());
  if (!has_good_multipliers(certificate)) return CertificateCheck::bad_multiplier;
  for (const auto& term : certificate.terms) {
    if (!counts(certificate.conditions, term.constraint.kind) || !is_of(mesh, term.constraint)) {
      return CertificateCheck::not_of_this_mesh;
    }
  }
  const Scale scale = scale_of(mesh, certificate);
  if (!scale.in_range) return CertificateCheck::out_of_range;
  const Number total = Sum(mesh, certificate, scale).upper_bound();
  return total.sign() == Sign::positive ? CertificateCheck::proves_nothing : CertificateCheck::proves;
}

}  // namespace temper
