// The exact sum of a certificate, and what weights can add to it: of triangles (certificate.cpp) and of tetrahedra
// (tets/weights).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "feasibility/exact_number.hpp"
#include "temper/detail/vec.hpp"
#include "temper/feasibility.hpp"

namespace temper::certified {

using exact::Number;
using Kind = WeightConstraint::Kind;

struct Vector2 {
  Number x, y;
};
inline Vector2 difference(Vec2 a, Vec2 b) { return {Number::difference(a.x, b.x), Number::difference(a.y, b.y)}; }
inline Number dot(const Vector2& a, const Vector2& b) { return a.x * b.x + a.y * b.y; }
inline Number cross(const Vector2& a, const Vector2& b) { return a.x * b.y - a.y * b.x; }

struct Vector3 {
  Number x, y, z;
};
inline Number dot(const Vector3& a, const Vector3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// N − t M of one constraint: coefficients of the weights of its vertices, and the rest.
struct Polynomial {
  std::array<Number, 5> coefficients;
  Number constant;
};

/// N of the height over the edge pq of pqr, from its edges in any dimension.
template <class Vector>
Polynomial polynomial_of_height(const Vector& pq, const Vector& pr, const Vector& qr) {
  const Number at_p = dot(pq, pr), at_q = -dot(pq, qr), at_r = dot(pr, qr);
  const Number l2 = at_p + at_q;
  return {{at_q, at_p, -l2}, l2 * at_r};
}

/// N of the equal crossings of pq and rs.
template <class Vector>
Polynomial polynomial_of_equal_crossing(const Vector& pq, const Vector& rs) {
  const Number here = dot(rs, rs), there = dot(pq, pq);
  return {{here, -here, -there, there}, Number()};
}

/// N − t M of the crossing of pq, from its squared length or its vector.
inline Polynomial polynomial_of_crossing(const Number& l2, double margin) {
  Polynomial polynomial = {{Number(1), Number(-1)}, l2};
  if (margin != 0) polynomial.constant += -(Number(2 * margin) * l2);
  return polynomial;
}

template <class Vector>
Polynomial polynomial_of_crossing(const Vector& pq, double margin) {
  return polynomial_of_crossing(dot(pq, pq), margin);
}

/// Says whether only kWeightReach bounds the differences of weights.
constexpr bool assumes_reach(Constraints constraints) {
  return constraints == Constraints::regular || constraints == Constraints::coefficients ||
         constraints == Constraints::distances;
}

/// A bound of the difference of the weights of an edge of a triangle, whose squared length is `l2`. `across` gives the
/// difference of the squared distances of its ends from the third corner, without its sign.
template <class Across>
Number bound_in_triangle(Constraints constraints, const Number& l2, const Across& across) {
  if (assumes_reach(constraints)) return Number(kWeightReach) * l2;
  if (constraints != Constraints::heights_only) return l2;
  Number most = across();
  return (most - l2).sign() == Sign::positive ? most : l2;
}

inline bool has_good_multipliers(const Certificate& certificate) {
  const auto good = [](const Certificate::Term& term) {
    return std::isfinite(term.multiplier) && (term.multiplier >= 0 || term.constraint.kind == Kind::equal_crossing);
  };
  const auto positive = [](const Certificate::Term& term) { return term.multiplier > 0; };
  return certificate.margin >= 0 && certificate.margin < 0.5 &&
         std::all_of(certificate.terms.begin(), certificate.terms.end(), good) &&
         std::any_of(certificate.terms.begin(), certificate.terms.end(), positive);
}

/// Says whether all terms are constraints of a mesh of triangles, by its connectivity and regions alone.
[[nodiscard]] bool are_constraints_of(const Mesh& mesh, const Certificate& certificate);

/// Exponents that bring coordinates into [−1, 1] and the multiplier 1 into the middle of its range.
struct Scale {
  std::array<int, 6> degrees = {};  ///< of N, by its kind
  int length = 0, multiplier = 0;
  bool in_range = true;

  [[nodiscard]] double coordinate(double x) const { return std::ldexp(x, -length); }
  /// The scale of N, by its degree, so that the sum stays the same up to a factor.
  [[nodiscard]] int shift(Kind kind) const { return length * degrees[static_cast<std::size_t>(kind)]; }
  [[nodiscard]] double of(const Certificate::Term& term) const {
    return std::ldexp(term.multiplier, shift(term.constraint.kind) - multiplier);
  }
};

template <class Use>
void for_each_vertex(const WeightConstraint& c, const Use& use) {
  for (const VertexId v : {c.p, c.q, c.r, c.s, c.t}) {
    if (v.valid()) use(v);
  }
}

constexpr double kLeastMultiplier = 0x1p-250;
// After scaling, coordinates of the plane are below 1 and multiples of 2^-53 times the least of them. The product of
// four differences and a multiplier must be a multiple of 2^-1074: 4 · (120 + 53) + 250 + 53 = 995 bits.
constexpr double kLeastInPlane = 0x1p-120;
constexpr double kRoundedUp = 1 + 0x1p-40;  // far above the rounding of approximation() and a few operations

/// `place_of(v)` is the place of a vertex; 0 or at least `least_coordinate` times the largest coordinate.
template <class PlaceOf>
Scale scale_of(const Certificate& certificate, const std::array<int, 6>& degrees, double least_coordinate,
               const PlaceOf& place_of) {
  Scale scale;
  scale.degrees = degrees;
  double largest = 0, least = kUnbounded;
  for (const auto& term : certificate.terms) {
    for_each_vertex(term.constraint, [&](VertexId v) {
      const Vec3 place = place_of(v);
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
  scale.in_range = std::ldexp(least, -scale.length) >= least_coordinate &&
                   std::ldexp(1.0, std::max(fewest - most, -1000)) >= kLeastMultiplier &&
                   (certificate.margin == 0 || certificate.margin >= 0x1p-20);  // 20 + 53 bits more: 1068 in all
  return scale;
}

/// What weights can add to a sum, if they differ along an edge by less than a bound.
struct WeightDifferences {
  /// W beyond an edge.
  [[nodiscard]] static Number reach_beyond(const Number& reach, const Number& bound) { return reach + bound; }
  /// The greatest value of R w relative to w_root.
  [[nodiscard]] static Number most(const Number& residual, const Number& reach) { return abs(residual) * reach; }
  static constexpr bool kPartsHaveFactors = false;
  static constexpr Kind kInnerDual = Kind::dual;
};

/// The sum, vertex by vertex, and the edges along which weights, or σ, differ by a bound.
template <class Terms>
class Sum {
 public:
  Sum(const Terms& terms, const Certificate& certificate, const Scale& scale)
      : terms_(terms), scale_(scale), constraints_(certificate.constraints) {
    for (const auto& term : certificate.terms) {
      if (term.multiplier != 0) add(term, certificate.margin);
    }
  }
  /// C plus the upper bound of each part; if parts have factors of their own, the largest of these sums.
  [[nodiscard]] Number upper_bound() const;

 private:
  struct Node {
    Number residual;
    std::vector<std::pair<VertexId, Number>> neighbors;  ///< with b_pq
  };

  /// Joins two corners of a cell, whose other corners are `others`.
  void join_edge(VertexId a, VertexId b, std::initializer_list<VertexId> others) {
    const std::optional<Number> bound = terms_.bound(a, b, {others.begin(), others.size()});
    if (!bound) return;
    nodes_[a].neighbors.emplace_back(b, *bound);
    nodes_[b].neighbors.emplace_back(a, *bound);
  }
  void join_triangle(VertexId a, VertexId b, VertexId c) {
    join_edge(a, b, {c}), join_edge(b, c, {a}), join_edge(c, a, {b});
  }
  void join_tetrahedron(VertexId a, VertexId b, VertexId c, VertexId d) {
    join_edge(a, b, {c, d}), join_edge(a, c, {b, d}), join_edge(a, d, {b, c});
    join_edge(b, c, {a, d}), join_edge(b, d, {a, c}), join_edge(c, d, {a, b});
  }
  void join(const WeightConstraint& c) {
    switch (c.kind) {
      case Kind::crossing:
        return join_edge(c.p, c.q, {});
      case Kind::height:
        return join_triangle(c.p, c.q, c.r);
      case Kind::dual:
        return join_triangle(c.p, c.q, c.r), join_triangle(c.q, c.p, c.s);
      case Kind::equal_crossing:
        return join_edge(c.p, c.q, {}), join_edge(c.r, c.s, {});
      case Kind::height_over_face:
        return join_tetrahedron(c.p, c.q, c.r, c.s);
      case Kind::dual_of_face:
        return join_tetrahedron(c.p, c.q, c.r, c.s), join_tetrahedron(c.p, c.r, c.q, c.t);
    }
  }

  /// Of coefficients, only dual lengths inside have a margin.
  [[nodiscard]] bool has_margin(const WeightConstraint& c) const {
    return constraints_ != Constraints::coefficients || c.kind == Terms::kInnerDual;
  }

  void add(const Certificate::Term& term, double margin) {
    const Polynomial polynomial = terms_.polynomial_of(term.constraint, has_margin(term.constraint) ? margin : 0);
    const Number multiplier(scale_.of(term));
    constant_ += multiplier * polynomial.constant;
    int k = 0;
    for_each_vertex(term.constraint, [&](VertexId v) {
      nodes_[v].residual += multiplier * polynomial.coefficients[static_cast<std::size_t>(k++)];
    });
    join(term.constraint);
  }

  /// The upper bound of the root's part, W_v along a breadth-first tree. Notes the vertices in it.
  [[nodiscard]] Number part_bound(VertexId root, std::map<VertexId, Number>& reach) const;

  const Terms& terms_;
  const Scale& scale_;
  Constraints constraints_;
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

/// The verdict on a certificate whose terms are constraints of the mesh.
template <class Terms>
CertificateCheck check_sum(const Terms& terms, const Certificate& certificate, const Scale& scale) {
  if (!scale.in_range) return CertificateCheck::out_of_range;
  const Sign sign = Sum<Terms>(terms, certificate, scale).upper_bound().sign();
  const bool may_be_zero = certificate.constraints != Constraints::coefficients;
  const bool proves = sign == Sign::negative || (may_be_zero && sign == Sign::zero);
  return proves ? CertificateCheck::proves : CertificateCheck::proves_nothing;
}

}  // namespace temper::certified
