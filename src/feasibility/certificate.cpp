// The exact check of a certificate. It shares no code with what makes the programmes: from the positions it computes
// each N_c anew, as a polynomial (feasibility.hpp), adds them with their multipliers, and looks at what is left:
//
//   Σ m_c (N_c − t M_c)  =  C + Σ R_v w_v        C of degree 4 in the coordinates, R_v of degree 2
//
// The coefficients of each N_c sum to zero, so Σ R_v = 0 over each connected part of the certificate and R_v w_v may
// be read as R_v (w_v − w_root). A well-centered mesh has |w_p − w_q| < ℓ_pq² on every edge, hence |w_v − w_root| <
// W_v, the sum along a path from the root. If C + Σ |R_v| W_v ≤ 0, no weights make every summand positive.
//
// Everything is exact: coordinates are scaled by a power of two, differences are two-term sums, and the rest is
// arithmetic of expansions.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

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
  std::array<Number, 3> coefficients;
  Number constant;
};

Polynomial height_polynomial(Vec2 p, Vec2 q, Vec2 r, double margin) {
  const Vector pq = difference(q, p), pr = difference(r, p), qr = difference(r, q);
  const Number at_p = dot(pq, pr), at_q = -dot(pq, qr), at_r = dot(pr, qr);
  const Number l2 = at_p + at_q;
  Polynomial polynomial = {{at_q, at_p, -l2}, l2 * at_r};
  if (margin != 0) polynomial.constant += -(Number(2 * margin) * l2 * cross(pq, pr));
  return polynomial;
}

Polynomial split_polynomial(Vec2 p, Vec2 q, double margin) {
  const Vector pq = difference(q, p);
  const Number l2 = dot(pq, pq);
  Polynomial polynomial = {{Number(1), Number(-1), Number()}, l2};
  if (margin != 0) polynomial.constant += -(Number(2 * margin) * l2);
  return polynomial;
}

bool is_of(const Mesh& mesh, const WeightConstraint& c) {
  const auto is_vertex = [&](VertexId v) { return v.index < mesh.n_vertices() && !mesh.is_isolated(v); };
  if (!is_vertex(c.p) || !is_vertex(c.q)) return false;
  const HalfedgeId h = mesh.find_halfedge(c.p, c.q);
  if (c.kind == Kind::height) return h.valid() && mesh.opposite(h) == c.r;
  return h.valid() || mesh.find_halfedge(c.q, c.p).valid();
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
  /// The scale of N: degree 4 for heights and 2 for splits, so that the sum stays the same up to a factor.
  [[nodiscard]] double of(const Certificate::Term& term) const {
    const int shift = term.constraint.kind == Kind::height ? 4 * length : 2 * length;
    return std::ldexp(term.multiplier, shift - multiplier);
  }
};

template <class Use>
void for_each_vertex(const WeightConstraint& c, const Use& use) {
  use(c.p), use(c.q);
  if (c.kind == Kind::height) use(c.r);
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
    exponent += term.constraint.kind == Kind::height ? 4 * scale.length : 2 * scale.length;
    most = std::max(most, exponent), fewest = std::min(fewest, exponent);
  }
  scale.multiplier = most;
  scale.in_range = std::ldexp(least, -scale.length) >= kLeastCoordinate &&
                   std::ldexp(1.0, std::max(fewest - most, -1000)) >= kLeastMultiplier &&
                   (certificate.margin == 0 || certificate.margin >= 0x1p-20);  // 20 + 53 bits more: 1068 in all
  return scale;
}

/// The sum, vertex by vertex, and the edges that bound differences of weights.
struct Sum {
  struct Node {
    Number residual;
    std::vector<VertexId> neighbours;
  };
  Number constant;
  std::map<VertexId, Node> nodes;  // ordered: the same path whatever the order of the terms
};

void join(Sum& sum, VertexId a, VertexId b) {
  sum.nodes[a].neighbours.push_back(b);
  sum.nodes[b].neighbours.push_back(a);
}

void add(Sum& sum, const Mesh& mesh, const Certificate::Term& term, const Scale& scale, double margin) {
  const auto [kind, p, q, r] = term.constraint;
  const auto at = [&](VertexId v) { return scale.position(mesh.position(v)); };
  const Polynomial polynomial =
      kind == Kind::height ? height_polynomial(at(p), at(q), at(r), margin) : split_polynomial(at(p), at(q), margin);
  const Number multiplier(scale.of(term));
  sum.constant += multiplier * polynomial.constant;
  int k = 0;
  for_each_vertex(term.constraint, [&](VertexId v) {
    sum.nodes[v].residual += multiplier * polynomial.coefficients[static_cast<std::size_t>(k++)];
  });
  join(sum, p, q);
  if (kind == Kind::height) join(sum, q, r), join(sum, r, p);
}

/// Σ |R_v| W_v, W_v along a breadth-first tree of each connected part.
Number residual_bound(const Sum& sum, const Mesh& mesh, const Scale& scale) {
  Number bound;
  std::map<VertexId, Number> reach;  // W_v
  for (const auto& [root, unused] : sum.nodes) {
    if (reach.count(root) > 0) continue;
    reach[root] = Number();
    std::vector<VertexId> queue = {root};
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const VertexId v = queue[i];
      bound += abs(sum.nodes.at(v).residual) * reach[v];
      for (const VertexId u : sum.nodes.at(v).neighbours) {
        if (reach.count(u) > 0) continue;
        const Vector edge = difference(scale.position(mesh.position(u)), scale.position(mesh.position(v)));
        reach[u] = reach[v] + dot(edge, edge);
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
  if (!has_good_multipliers(certificate)) return CertificateCheck::bad_multiplier;
  for (const auto& term : certificate.terms) {
    if (!is_of(mesh, term.constraint)) return CertificateCheck::not_of_this_mesh;
  }
  const Scale scale = scale_of(mesh, certificate);
  if (!scale.in_range) return CertificateCheck::out_of_range;
  Sum sum;
  for (const auto& term : certificate.terms) {
    if (term.multiplier > 0) add(sum, mesh, term, scale, certificate.margin);
  }
  const Number total = sum.constant + residual_bound(sum, mesh, scale);
  return total.sign() == Sign::positive ? CertificateCheck::proves_nothing : CertificateCheck::proves;
}

}  // namespace temper
