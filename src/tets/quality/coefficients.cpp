#include "tets/quality/coefficients.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/loops.hpp"
#include "geometry/dyadic.hpp"
#include "regularity/duals.hpp"
#include "tets/geometry/evaluated.hpp"
#include "tets/quality/measure.hpp"

namespace temper::tets {
namespace {

using exact::Compact;
using exact::Dyadic;

constexpr double kUndecided = std::numeric_limits<double>::quiet_NaN();
// Relative errors: of each of the four factors of a term, and of a sum with its roundings. A smaller one sends more
// factors to exact arithmetic, a larger one more sums.
constexpr double kFactorError = 0x1p-24, kSumError = 0x1p-21;
// Below this magnitude a product may have lost digits.
constexpr double kSmallest = 0x1p-900;

/// Says whether the two sides of the face of h are two terms.
bool is_alone(const TetMesh& mesh, HalffaceId h) { return mesh.bounds_region(h); }
/// Says whether h stands for a term.
bool has_term(const TetMesh& mesh, HalffaceId h) { return is_alone(mesh, h) || mesh.is_face_representative(h); }

/// The polynomials in doubles with a small relative error.
struct Rounded {
  using Number = double;
  template <class Polynomial>
  static double of(const Polynomial& polynomial) {
    return evaluated(kFactorError, polynomial);
  }
};

/// The exact polynomials.
struct Exact {
  using Number = Dyadic;
  template <class Polynomial>
  static Dyadic of(const Polynomial& polynomial) {
    Dyadic sum;
    const Compact number = polynomial(Compact());
    for (int i = 0; i < number.terms().size(); ++i) sum = sum + Dyadic(number.terms()[i]);
    return sum;
  }
};

/// The third vertex of a face.
VertexId third(const TetMesh& mesh, HalffaceId h, VertexId v, VertexId w) {
  for (const VertexId u : mesh.vertices(h)) {
    if (u != v && u != w) return u;
  }
  return {};
}

/// R = numerator/(volume · other). Both factors of the denominator are positive.
template <class Number>
struct Ratio {
  Number numerator, volume, other;
};

template <class Numbers>
Ratio<typename Numbers::Number> ratio(const TetMesh& mesh, HalffaceId h) {
  const FacePoints face = points_of(mesh, h);
  const WeightedPoint &p = face[0], &q = face[1], &r = face[2], d = mesh.point(mesh.opposite(h));
  const auto volume = Numbers::of([&]<class T>(const T&) { return volume_polynomial<T>(p, q, r, d); });
  if (is_alone(mesh, h)) {
    return {Numbers::of([&]<class T>(const T&) { return height_polynomial<T>(p, q, r, d); }), volume,
            Numbers::of([&]<class T>(const T&) { return area_polynomial<T>(p, q, r); })};
  }
  const WeightedPoint e = mesh.point(mesh.opposite(mesh.twin(h)));
  return {-Numbers::of([&]<class T>(const T&) { return power_polynomial<T>(p, q, r, d, e); }), volume,
          Numbers::of([&]<class T>(const T&) { return volume_polynomial<T>(p, r, q, e); })};
}

/// K of the edge vw in the face of h.
template <class Numbers>
typename Numbers::Number height_in_face(const TetMesh& mesh, HalffaceId h, VertexId v, VertexId w) {
  const WeightedPoint p = mesh.point(v), q = mesh.point(w), r = mesh.point(third(mesh, h, v, w));
  return Numbers::of([&]<class T>(const T&) { return height_polynomial<T>(p, q, r); });
}

double rounded_ratio(const TetMesh& mesh, HalffaceId h) {
  const Ratio<double> r = ratio<Rounded>(mesh, h);
  if (r.numerator == 0) return 0;
  const double value = r.numerator / r.volume / r.other;
  return value == 0 ? kUndecided : value;
}

}  // namespace

Coefficients::Coefficients(const TetMesh& mesh, Executor* executor)
    : mesh_(mesh), stars_(mesh), ratios_(mesh.n_halffaces()) {
  for_each_index(mesh.n_halffaces(), executor, [&](std::size_t i) {
    if (has_term(mesh, HalffaceId(i))) ratios_[HalffaceId(i)] = rounded_ratio(mesh, HalffaceId(i));
  });
}

/// K R, and 0 only if one of the factors is.
double Coefficients::term(VertexId v, VertexId w, HalffaceId h) const {
  if (ratios_[h] == 0) return 0;
  const double k = height_in_face<Rounded>(mesh_, h, v, w), product = k * ratios_[h];
  return k == 0 || (std::abs(product) >= kSmallest && std::isfinite(product)) ? product : kUndecided;
}

void Coefficients::append_edges(VertexId v, std::vector<EdgeCoefficient>& found) const {
  std::vector<Term> terms;
  for (const HalffaceId across : stars_.link(v)) {
    const TetId t = TetMesh::tetrahedron(across);
    for (int f = 0; f < 4; ++f) {
      const HalffaceId h = TetMesh::halfface(t, f);
      if (h == across || !has_term(mesh_, h)) continue;
      for (const VertexId end : mesh_.vertices(h)) {
        if (!(v < end)) continue;
        terms.push_back({end, h, mesh_.region(t), term(v, end, h)});
      }
    }
  }
  std::sort(terms.begin(), terms.end());
  for (auto first = terms.begin(); first != terms.end();) {
    const auto last = std::find_if(first, terms.end(), [&](const Term& term) { return term.end != first->end; });
    append_edge(v, {first, last}, found);
    first = last;
  }
}

void Coefficients::append_edge(VertexId v, std::span<const Term> terms, std::vector<EdgeCoefficient>& found) const {
  found.push_back(sum(v, terms));
  const bool boundary = std::ranges::any_of(terms, [&](const Term& term) { return mesh_.is_boundary(term.face); });
  found.back().kind = boundary ? DualKind::boundary : DualKind::inside;
  if (std::ranges::all_of(terms, [&](const Term& term) { return term.region == terms.front().region; })) return;
  std::vector<Term> by_region(terms.begin(), terms.end());
  std::ranges::stable_sort(by_region, {}, &Term::region);
  for (auto first = by_region.begin(); first != by_region.end();) {
    const auto last = std::find_if(first, by_region.end(), [&](const Term& t) { return t.region != first->region; });
    found.push_back(sum(v, {first, last}));
    found.back().kind = DualKind::region;
    found.back().region = first->region;
    first = last;
  }
}

EdgeCoefficient Coefficients::sum(VertexId v, std::span<const Term> terms) const {
  double value = 0, magnitude = 0;
  for (const Term& term : terms) value += term.value, magnitude += std::abs(term.value);
  EdgeCoefficient result = {.vertices = {v, terms.front().end}};
  if (magnitude == 0) return result;
  const double error = kSumError * magnitude;
  result.sign = value > error ? Sign::positive : value < -error ? Sign::negative : exact_sign(v, terms);
  const double l = length(mesh_.position(terms.front().end) - mesh_.position(v));
  result.over_l = with_sign(std::isnan(value) ? 0 : value / (8 * l * l * l), result.sign);
  return result;
}

/// Adds the fractions K numerator/(volume · other) over a common denominator, which is positive.
Sign Coefficients::exact_sign(VertexId v, std::span<const Term> terms) const {
  Dyadic numerator, denominator(1);
  for (const Term& term : terms) {
    const Ratio<Dyadic> r = ratio<Exact>(mesh_, term.face);
    const Dyadic k = height_in_face<Exact>(mesh_, term.face, v, term.end);
    const Dyadic below = r.volume * r.other;
    numerator = numerator * below + k * r.numerator * denominator;
    denominator = denominator * below;
  }
  return numerator.sign();
}

}  // namespace temper::tets
