// The mean squared error of a scheme over blocks of fields, and its derivatives by the discrete adjoint. For unknowns
// at the vertices of triangles or tetrahedra: d0ᵀ ★1 d0 u = ★0 f.
//
// A scheme solves A v = b(u) for a field u. The squared error is J = c Σ m e², e = v − u at the unknowns and m their
// sizes. The adjoint λ solves A λ = 2 c m e. Now v depends on A, b, m and u. The total derivative
// of J by any of them is the derivative of J − λᵀ(A v − b) with v and λ kept.
#pragma once

#include <cstddef>
#include <vector>

#include "errors/adjoint.hpp"
#include "errors/poisson.hpp"
#include "errors/waves.hpp"
#include "temper/detail/executor.hpp"

namespace temper::error_detail {

[[nodiscard]] inline double squared(const Lanes& a) {
  double sum = 0;
  for (const double x : a) sum += x * x;
  return sum;
}

/// J = c Σ m e². At given points e is 0.
template <class Masses>
[[nodiscard]] double squared_error(double c, const Masses& masses, const std::vector<Lanes>& errors) {
  Lanes sums = {};
  for (std::size_t p = 0; p < errors.size(); ++p) {
    for (std::size_t i = 0; i < kLanes; ++i) sums[i] += masses.begin()[p] * errors[p][i] * errors[p][i];
  }
  double sum = 0;
  for (const double part : sums) sum += part;
  return c * sum;
}

/// The matrix of a scheme, factored.
struct FactoredPoints {
  const PointSystem& points;
  const Cholesky& matrix;

  /// The adjoint λ of J.
  template <class Masses>
  [[nodiscard]] std::vector<Lanes> adjoint(double c, const Masses& masses, const std::vector<Lanes>& errors) const {
    std::vector<Lanes> lambda(errors.size());
    for (std::size_t p = 0; p < errors.size(); ++p) {
      for (std::size_t i = 0; i < kLanes; ++i) lambda[p][i] = 2 * c * masses.begin()[p] * errors[p][i];
    }
    matrix.solve(points, lambda);
    return lambda;
  }
};

/// The derivative of −λᵀ A v by the coefficient between two points.
[[nodiscard]] inline double by_coefficient(const Lanes& lambda_a, const Lanes& lambda_b, const Lanes& a,
                                           const Lanes& b) {
  double sum = 0;
  for (std::size_t i = 0; i < kLanes; ++i) sum -= (lambda_a[i] - lambda_b[i]) * (a[i] - b[i]);
  return sum;
}

/// The squared error of a block of fields at the vertices. If `by` is not null, adds its derivatives there. It solves
/// for e directly: A e = b − A u.
template <class AnyMesh, class Dec, class Vec>
[[nodiscard]] double vertex_error(const AnyMesh& mesh, const Dec& dec, const FactoredPoints& scheme,
                                  const FieldBlock<Vec>& fields, VertexAdjoint<Vec>* by) {
  std::vector<Lanes> value(mesh.n_vertices());
  for (const VertexId v : mesh.vertices()) value[v.index] = fields.at(mesh.position(v));
  std::vector<Lanes> errors = vertex_residuals(dec, fields, value);
  scheme.matrix.solve(scheme.points, errors);
  const double sum = squared_error(fields.share, dec.star0, errors);
  if (by == nullptr) return sum;
  const std::vector<Lanes> lambda = scheme.adjoint(fields.share, dec.star0, errors);
  for (const VertexId v : mesh.vertices()) {
    const std::size_t p = v.index;
    if (scheme.points.is_given(p)) continue;
    const Lanes slopes = fields.slopes(value[p]), source = fields.source(value[p]),
                by_value = fields.source_by_value(value[p]);
    Lanes by_angle;
    double by_size = 0;
    for (std::size_t i = 0; i < kLanes; ++i) {
      const double by_source = lambda[p][i], by_error = 2 * fields.share * errors[p][i];
      by_size += by_source * source[i];
      by_angle[i] = dec.star0[v] * (by_source * by_value[i] - by_error) * slopes[i];
      value[p][i] += errors[p][i];
    }
    by->star0[v] += fields.share * squared(errors[p]) + by_size;
    by->vertex[v] = by->vertex[v] + fields.by_place(by_angle);
  }
  for (std::size_t e = 0; e < dec.edges.size(); ++e) {
    const std::size_t from = dec.edges[EdgeId(e)].from.index, to = dec.edges[EdgeId(e)].to.index;
    by->star1[EdgeId(e)] += by_coefficient(lambda[from], lambda[to], value[from], value[to]);
  }
  return sum;
}

/// The sum of error(block, by) over all blocks, and over their derivatives, in an order independent of the
/// number of threads. `by` has zeros, or is null.
template <class Waves, class By, class Error>
[[nodiscard]] double sum_over(const std::vector<Waves>& blocks, By* by, Executor* executor, const Error& error) {
  std::vector<double> sums(blocks.size(), 0.0);
  std::vector<By> parts;
  if (by != nullptr) parts.assign(blocks.size(), *by);
  or_serial(executor).run(blocks.size(),
                          [&](std::size_t b) { sums[b] = error(blocks[b], by != nullptr ? &parts[b] : nullptr); });
  double sum = 0;
  for (const double part : sums) sum += part;
  for (const By& part : parts) by->add(part);
  return sum;
}

}  // namespace temper::error_detail
