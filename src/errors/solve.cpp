#include "errors/solve.hpp"

#define EIGEN_MPL2_ONLY

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <utility>

#include "base/supernodes.hpp"

namespace temper::error_detail {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;
using Index = Eigen::Index;

// The residual against |A| |x| + |b|: rounding leaves 1e-16 times a small power of n; a failed solution leaves 1.
constexpr double kResidual = 1e-8;
// The bound for the matrix scaled to a diagonal of ±1. Rounding of entries alone gives a singular matrix a condition of
// 1e16; a million unknowns of a sound matrix give 1e7.
constexpr double kSingularCondition = 1e13;
constexpr int kSingularSteps = 8;
constexpr int kPowerSteps = 200;  // largest and least eigenvalue to a few percent

Vector to_vector(const std::vector<double>& values) {
  return Eigen::Map<const Vector>(values.data(), static_cast<Index>(values.size()));
}

/// S with S A S of diagonal ±1, so that a matrix is not called singular for rows of very different sizes.
Vector scaling_of(const LinearSystem& system) {
  Vector diagonal = Vector::Zero(static_cast<Index>(system.unknowns));
  for (const auto& [row, column, value] : system.lower) {
    if (row == column) diagonal[static_cast<Index>(row)] += value;
  }
  return diagonal.unaryExpr([](double d) { return d == 0 ? 1.0 : 1 / std::sqrt(std::abs(d)); });
}

/// S A S, both triangles: products and LU then do not depend on symmetry.
Matrix scaled_matrix(const LinearSystem& system, const Vector& scaling) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(2 * system.lower.size());
  for (const auto& [row, column, value] : system.lower) {
    const int i = static_cast<int>(row), j = static_cast<int>(column);
    const double scaled = value * scaling[i] * scaling[j];
    entries.emplace_back(i, j, scaled);
    if (i != j) entries.emplace_back(j, i, scaled);
  }
  Matrix matrix(scaling.size(), scaling.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

double norm_of(const Matrix& matrix) {
  double most = 0;
  for (Index k = 0; k < matrix.outerSize(); ++k) {
    double sum = 0;
    for (Matrix::InnerIterator entry(matrix, k); entry; ++entry) sum += std::abs(entry.value());
    most = std::max(most, sum);
  }
  return most;
}

/// The limit of |λ| under repeated application, from below. The start has no symmetry of a mesh.
template <class Apply>
double power_iteration(Index n, int steps, const Apply& apply) {
  Vector x(n);
  for (Index i = 0; i < n; ++i) x[i] = 1 + 0.5 * std::sin(1.0 + 2.3 * static_cast<double>(i));
  double value = 0;
  for (int step = 0; step < steps; ++step) {
    x /= x.norm();
    x = apply(x);
    value = x.norm();
    if (!std::isfinite(value) || value == 0) return value;
  }
  return value;
}

/// A system with one factorization of its scaled matrix.
struct Scaled {
  const LinearSystem& system;
  Vector scaling;
  Matrix matrix;
};

template <class Solver>
bool is_singular(const Scaled& scaled, const Solver& solver) {
  const auto apply = [&](const Vector& x) { return Vector(solver.solve(x)); };
  const double inverse = power_iteration(scaled.matrix.rows(), kSingularSteps, apply);
  return !(norm_of(scaled.matrix) * inverse <= kSingularCondition);
}

/// Every right side, or false when the factorization does not solve them.
template <class Solver>
bool solve_all(const Scaled& scaled, const Solver& solver, LinearSolution& result) {
  const double size = norm_of(scaled.matrix);
  result.solutions.clear();
  for (const std::vector<double>& right : scaled.system.right_sides) {
    const Vector b = scaled.scaling.cwiseProduct(to_vector(right));
    const Vector y = solver.solve(b);
    const double rounding = size * y.template lpNorm<Eigen::Infinity>() + b.template lpNorm<Eigen::Infinity>();
    const Vector residual = scaled.matrix * y - b;
    // If a right side overflowed, its solution does, too: the matrix is not at fault.
    const bool overflow = !b.allFinite();
    if (!overflow && !(residual.template lpNorm<Eigen::Infinity>() <= kResidual * rounding)) return false;
    const Vector x = scaled.scaling.cwiseProduct(y);
    result.solutions.emplace_back(x.data(), x.data() + x.size());
  }
  return true;
}

/// The condition number of the unscaled matrix: A x = S⁻¹ (S A S) S⁻¹ x.
template <class Solver>
double condition_of(const Scaled& scaled, const Solver& solver) {
  const Vector& s = scaled.scaling;
  const double largest = power_iteration(s.size(), kPowerSteps, [&](const Vector& x) {
    const Vector product = scaled.matrix * x.cwiseQuotient(s);
    return Vector(product.cwiseQuotient(s));
  });
  const double inverse = power_iteration(s.size(), kPowerSteps, [&](const Vector& x) {
    const Vector solution = solver.solve(Vector(x.cwiseProduct(s)));
    return Vector(solution.cwiseProduct(s));
  });
  const double condition = largest * inverse;
  return std::isfinite(condition) ? condition : std::numeric_limits<double>::infinity();
}

template <class Solver>
bool solve_with(const Scaled& scaled, const Solver& solver, bool with_condition, LinearSolution& result) {
  if (is_singular(scaled, solver) || !solve_all(scaled, solver, result)) return false;
  if (with_condition) result.condition = condition_of(scaled, solver);
  return true;
}

bool all_finite(const LinearSystem& system) {
  return std::all_of(system.lower.begin(), system.lower.end(),
                     [](const MatrixEntry& entry) { return std::isfinite(entry.value); });
}

using Lu = Eigen::SparseLU<Matrix>;

/// When memory runs out, Eigen 3.4 frees a vector twice: before it asks for more, and in the destructor. So a
/// factorization that ran out of memory is never destroyed.
std::unique_ptr<Lu> lu_of(const Matrix& matrix) {
  auto lu = std::make_unique<Lu>();
  try {
    lu->compute(matrix);
  } catch (...) {
    static_cast<void>(lu.release());
    throw;
  }
  return lu;
}

/// Finds the order of elimination of a matrix with these entries of both triangles, for entries of one.
void analyze(SupernodalCholesky& l, const Matrix& whole, std::span<const SupernodalCholesky::Entry> entries) {
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> at_places;
  Eigen::AMDOrdering<int>()(whole, at_places);
  const Eigen::VectorXi order = at_places.inverse().eval().indices();
  l.analyze({order.begin(), order.end()}, entries);
}

/// The factors of a positive definite matrix.
class Definite {
 public:
  explicit Definite(const Matrix& matrix) {
    std::vector<SupernodalCholesky::Entry> entries;
    std::vector<double> values;
    for (Index j = 0; j < matrix.outerSize(); ++j) {
      for (Matrix::InnerIterator entry(matrix, j); entry; ++entry) {
        if (entry.row() < j) continue;
        entries.push_back({static_cast<int>(entry.row()), static_cast<int>(j)});
        values.push_back(entry.value());
      }
    }
    analyze(l_, matrix, entries);
    is_definite_ = l_.factor(values);
  }
  [[nodiscard]] bool is_definite() const { return is_definite_; }
  [[nodiscard]] Vector solve(const Vector& right) const {
    Vector x = right;
    l_.solve({x.data(), static_cast<std::size_t>(x.size())});
    return x;
  }

 private:
  SupernodalCholesky l_;
  bool is_definite_ = false;
};

/// LLᵀ, or LU: false when neither solves it.
bool factor_and_solve(const LinearSystem& system, bool with_condition, LinearSolution& result) {
  const Vector scaling = scaling_of(system);
  const Scaled scaled = {system, scaling, scaled_matrix(system, scaling)};
  const Definite definite(scaled.matrix);
  result.definite = definite.is_definite();
  if (result.definite) return solve_with(scaled, definite, with_condition, result);
  const std::unique_ptr<Lu> lu = lu_of(scaled.matrix);
  return lu->info() == Eigen::Success && solve_with(scaled, *lu, with_condition, result);
}

}  // namespace

struct Cholesky::Factors {
  std::vector<MatrixEntry> entries;  // of the matrix that gave the order
  std::vector<double> values;        // of the present matrix
  SupernodalCholesky l;

  [[nodiscard]] bool has_entries(const std::vector<MatrixEntry>& lower) const {
    return std::equal(
        entries.begin(), entries.end(), lower.begin(), lower.end(),
        [](const MatrixEntry& a, const MatrixEntry& b) { return a.row == b.row && a.column == b.column; });
  }
  void order(std::size_t unknowns, const std::vector<MatrixEntry>& lower);
};

void Cholesky::Factors::order(std::size_t unknowns, const std::vector<MatrixEntry>& lower) {
  const auto n = static_cast<Index>(unknowns);
  entries = lower;
  std::vector<Eigen::Triplet<double>> triplets;
  std::vector<SupernodalCholesky::Entry> places;
  for (const auto& [row, column, value] : lower) {
    places.push_back({static_cast<int>(row), static_cast<int>(column)});
    triplets.emplace_back(places.back().row, places.back().column, 1.0);
  }
  Matrix of_entries(n, n);
  of_entries.setFromTriplets(triplets.begin(), triplets.end());
  Matrix whole;
  whole = of_entries.selfadjointView<Eigen::Lower>();
  analyze(l, whole, places);
}

bool Cholesky::factor(std::size_t unknowns, const std::vector<MatrixEntry>& lower) {
  const bool has_order = factors_ && factors_->has_entries(lower);
  if (!factors_) factors_ = std::make_shared<Factors>();
  Factors& f = *factors_;
  if (!has_order) f.order(unknowns, lower);
  f.values.clear();
  for (const MatrixEntry& entry : lower) {
    if (!std::isfinite(entry.value)) return false;
    f.values.push_back(entry.value);
  }
  return f.l.factor(f.values);
}

void Cholesky::solve(std::vector<double>& right) const {
  if (!right.empty()) factors_->l.solve(right);
}

void Cholesky::solve(const PointSystem& points, std::vector<Lanes>& at_points) const {
  std::vector<Lanes> x(points.n_unknowns());
  const auto at = [&](std::size_t point) -> Lanes& { return x[factors_->l.place(points.unknown(point))]; };
  for (std::size_t p = 0; p < at_points.size(); ++p) {
    if (!points.is_given(p)) at(p) = at_points[p];
  }
  if (!x.empty()) factors_->l.solve_lanes(x.front().data());
  for (std::size_t p = 0; p < at_points.size(); ++p) at_points[p] = points.is_given(p) ? Lanes{} : at(p);
}

LinearSolution solve(const LinearSystem& system, bool with_condition) {
  LinearSolution result;
  if (system.unknowns == 0) {
    result.definite = true;
    result.solutions.resize(system.right_sides.size());
    if (with_condition) result.condition = 1;
    return result;
  }
  if (all_finite(system) && factor_and_solve(system, with_condition, result)) return result;
  result.singular = true;
  result.definite = false;
  result.solutions.clear();
  if (with_condition) result.condition = std::numeric_limits<double>::infinity();
  return result;
}

PointSystem::PointSystem(const std::vector<bool>& given) {
  for (const bool is : given) unknowns_.push_back(is ? kGiven : n_unknowns_++);
  for (std::size_t i = 0; i < n_unknowns_; ++i) lower_.push_back({i, i, 0});
}

void PointSystem::connect(std::size_t i, std::size_t j, double c) {
  for (const auto& [here, there] : {std::pair(i, j), std::pair(j, i)}) {
    if (is_given(here)) continue;
    connect_outside(here, c);
    if (is_given(there)) from_given_.push_back({unknowns_[here], there, c});
  }
  if (is_given(i) || is_given(j)) return;
  lower_.push_back({std::max(unknowns_[i], unknowns_[j]), std::min(unknowns_[i], unknowns_[j]), -c});
}

void PointSystem::connect_outside(std::size_t i, double c) {
  if (!is_given(i)) lower_[unknowns_[i]].value += c;
}

std::vector<double> PointSystem::right_side(const std::vector<double>& sources,
                                            const std::vector<double>& values) const {
  std::vector<double> right(n_unknowns_);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (!is_given(i)) right[unknowns_[i]] = sources[i];
  }
  for (const auto& [unknown, given, c] : from_given_) right[unknown] += c * values[given];
  return right;
}

void PointSystem::put(const std::vector<double>& solution, std::vector<double>& values) const {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!is_given(i)) values[i] = solution[unknowns_[i]];
  }
}

}  // namespace temper::error_detail
