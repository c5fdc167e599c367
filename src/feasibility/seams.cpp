#include "feasibility/seams.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace temper {
namespace {

using Values = std::vector<double>;

double dot(const Values& a, const Values& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// The equations A w = 0, with weights in units of the squared lengths of their edges, so that A has entries of
/// order 1.
class Equations {
 public:
  Equations(std::vector<LinearForm> forms, std::size_t n_vertices) : forms_(std::move(forms)), units_(n_vertices, 0.0) {
    // A coefficient is 1/(2 ℓ²): a vertex gets the least ℓ² of its edges.
    for (const LinearForm& form : forms_) {
      for (std::size_t k = 0; k < 4; ++k) {
        double& unit = units_[form.vertices[k]];
        const double l2 = 0.5 / std::abs(form.coefficients[k]);
        unit = unit == 0 ? l2 : std::min(unit, l2);
      }
    }
  }
  [[nodiscard]] double unit(VertexId v) const { return units_[v]; }

  /// A w, from differences, in which a large weight common to all loses no digits.
  [[nodiscard]] Values violations(const VertexWeights& weights) const {
    Values result;
    for (const LinearForm& form : forms_) {
      const auto w = [&](std::size_t k) { return weights[form.vertices[k]]; };
      result.push_back(form.coefficients[0] * (w(0) - w(1)) + form.coefficients[2] * (w(2) - w(3)));
    }
    return result;
  }
  /// Units² Aᵀ y.
  [[nodiscard]] VertexWeights spread(const Values& y) const {
    VertexWeights weights(units_.size(), 0.0);
    for (std::size_t i = 0; i < forms_.size(); ++i) {
      for (std::size_t k = 0; k < 4; ++k) weights[forms_[i].vertices[k]] += forms_[i].coefficients[k] * y[i];
    }
    for (std::size_t v = 0; v < weights.size(); ++v) weights[VertexId(v)] *= units_[VertexId(v)] * units_[VertexId(v)];
    return weights;
  }

 private:
  std::vector<LinearForm> forms_;
  VertexWeights units_;
};

double norm(const Values& a) { return std::sqrt(dot(a, a)); }

/// Solves A Units² Aᵀ y = b by conjugate gradients. It is singular where equations follow from others, as those of the
/// three edges of a face do. These agree except for rounding, from which the steps would go away without end. So the
/// least residual counts.
Values solve(const Equations& equations, const Values& b, double tolerance) {
  constexpr double kFarAway = 1e4;  // squared residual over the least one, at which the steps end
  Values y(b.size(), 0.0), r = b, p = b, best = y;
  double rr = dot(r, r), least = rr;
  for (std::size_t step = 0; step < 4 * b.size() && std::sqrt(rr) > tolerance && rr <= kFarAway * least; ++step) {
    const Values q = equations.violations(equations.spread(p));
    const double curvature = dot(p, q);
    if (!(curvature > 0)) break;
    const double a = rr / curvature;
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += a * p[i], r[i] -= a * q[i];
    const double next = dot(r, r), b_factor = next / rr;
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = r[i] + b_factor * p[i];
    rr = next;
    if (rr < least) least = rr, best = y;
  }
  return best;
}

}  // namespace

Seams::Seams(std::size_t n_vertices, std::span<const std::array<VertexId, 2>> copies,
             std::vector<WeightConstraint> equations)
    : equations_(std::move(equations)) {
  if (copies.empty()) return;
  next_.reserve(n_vertices);
  for (const VertexId v : IdRange<VertexId>(n_vertices)) next_.push_back(v);
  for (const auto& [v, copy] : copies) next_[copy] = std::exchange(next_[v], copy);
}

std::vector<WeightConstraint> Seams::equations_among(std::span<const VertexId> sorted) const {
  std::vector<WeightConstraint> found;
  for (const WeightConstraint& c : equations_) {
    const auto has = [&](VertexId v) { return std::binary_search(sorted.begin(), sorted.end(), v); };
    if (has(c.p) && has(c.q) && has(c.r) && has(c.s)) found.push_back(c);
  }
  return found;
}

void Seams::settle(VertexWeights& weights, const std::function<LinearForm(const WeightConstraint&)>& form_of) const {
  if (empty()) return;
  constexpr double kSettled = 1e-17;  // of d/ℓ, in the root of the sum of squares
  constexpr int kSettlings = 3;       // the first leaves the rounding of its own sum
  std::vector<LinearForm> forms;
  for (const WeightConstraint& c : equations_) forms.push_back(form_of(c));
  const Equations equations(std::move(forms), weights.size());
  for (int round = 0; round < kSettlings; ++round) {
    Values violations = equations.violations(weights);
    for (double& v : violations) v = -v;
    const double size = norm(violations);
    if (size <= kSettled * std::sqrt(static_cast<double>(violations.size()))) return;
    VertexWeights settled = equations.spread(solve(equations, violations, 1e-8 * size));
    for (std::size_t v = 0; v < weights.size(); ++v) settled[VertexId(v)] += weights[VertexId(v)];
    if (norm(equations.violations(settled)) >= size) return;
    weights = std::move(settled);
  }
}

}  // namespace temper
