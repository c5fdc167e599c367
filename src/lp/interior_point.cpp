// A primal-dual interior point method for convex programs (temper/detail/convex.hpp), by sparse Cholesky factors.
//
// With multipliers y of the slacks s, the solution has
//
//     Q x + q = Aᵀ y,    A x + b = s,    s_i y_i = μ,    s, y > 0
//
// with Q x + q the slope of squares and cost, and μ the factor of the logarithms. Newton's method for these equations
// solves (Q + Aᵀ (y/s) A) dx = … in each iteration, a matrix with the sparsity of the mesh. Without logarithms μ falls
// to zero by the predictor and corrector of Mehrotra. A row that may be violated by v at the cost g has
//
//     A x + b = s − v,    y + z = g,    v z = μ,    v, z > 0
//
// and 1/(s/y + v/z) in the matrix. All other rows have v = 0 and z = ∞ in the same formulas.
//
// The start need not satisfy A x + b > 0. If no x does, the residual A x + b − s stays, and the method gives up.
#define EIGEN_MPL2_ONLY

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/supernodes.hpp"
#include "temper/detail/lp.hpp"

namespace temper {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::SparseMatrix<double>;
using Eigen::Index;

constexpr std::size_t kMostIterations = 200;  // 3 to 30 are usual
// The least slack at the start, of slacks that are near one.
constexpr double kFirstSlack = 0.1;
// The part of the way to the nearest s = 0 or y = 0.
constexpr double kOfTheWay = 0.99;
// All equations hold up to this part of their terms: a few hundred roundings.
constexpr double kResidual = 1e-11;
// Σ s y over the objective, at the end. Less is worse: as μ falls, y/s differ more and the slope Q x + q − Aᵀ y loses
// its digits, which count in the gap, too.
constexpr double kGap = 2e-9;
// The largest number of iterations that only make the slope smaller. Rounding keeps it above a bound.
constexpr int kMostPolishing = 4;
// |s y/μ − 1| at the end with logarithms. The gap is half of its square per row.
constexpr double kCentered = 1e-6;
// Steps below this part of the way hardly lower the objective. kMostShortSteps of them end the search.
constexpr double kShortStep = 1e-4;
constexpr int kMostShortSteps = 12;
// The largest y/s over the entries of Q, when the slope is made zero.
constexpr double kLargestRatio = 1e6;
// The search ends if y proves that the objective exceeds this multiple of its first value, or of the squares of what
// rows lack if that value is zero.
constexpr double kHopeless = 1e6;
// An objective as small as the rounding of squares of order one.
constexpr double kZero = 1e-24;
constexpr double kTiny = 1e-300;
// What a pivot gains at least, of the largest entry: only for directions that the rounding leaves without one.
constexpr double kLeastPivot = 1e-14;

Vector to_vector(const std::vector<double>& values) {
  return Eigen::Map<const Vector>(values.data(), static_cast<Index>(values.size()));
}

/// y + factor · rowsᵀ x.
void add_transposed(const SparseRows& rows, const Vector& x, double factor, Vector& y) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double at = factor * x[static_cast<Index>(i)];
    rows.for_each(i, [&](std::size_t k, double a) { y[static_cast<Index>(k)] += a * at; });
  }
}

Vector times(const SparseRows& rows, const Vector& x) {
  Vector result = Vector::Zero(static_cast<Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double sum = 0;
    rows.for_each(i, [&](std::size_t k, double a) { sum += a * x[static_cast<Index>(k)]; });
    result[static_cast<Index>(i)] = sum;
  }
  return result;
}

/// Q + Aᵀ D A: the places of all products are found once.
class NewtonMatrix {
 public:
  NewtonMatrix(const SparseRows& squares, const SparseRows& rows, std::size_t n) : squares_(squares), rows_(rows) {
    std::vector<Eigen::Triplet<double>> entries;
    for (const SparseRows* of : {&squares, &rows}) {
      for_each_product(*of, [&](int i, int j, double) { entries.emplace_back(i, j, 0.0); });
    }
    for (std::size_t i = 0; i < n; ++i) entries.emplace_back(static_cast<int>(i), static_cast<int>(i), 0.0);
    matrix_.resize(static_cast<Index>(n), static_cast<Index>(n));
    matrix_.setFromTriplets(entries.begin(), entries.end());
    entries = {};
    constant_ = Vector::Zero(matrix_.nonZeros());
    for_each_product(squares, [&](int i, int j, double product) { constant_[place_of(i, j)] += product; });
    for_each_product(rows, [&](int i, int j, double) { places_.push_back(static_cast<int>(place_of(i, j))); });
    order();
  }

  /// The largest entry of Q.
  [[nodiscard]] double largest_square() const { return constant_.cwiseAbs().maxCoeff(); }
  /// Returns false if the matrix has no factors.
  bool factor(const Vector& diagonal) {
    diagonal_ = diagonal;
    Eigen::Map<Vector> values(matrix_.valuePtr(), matrix_.nonZeros());
    values = constant_;
    std::size_t next = 0;
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const double d = diagonal[static_cast<Index>(row)];
      for (std::size_t k = rows_.start[row]; k < rows_.start[row + 1]; ++k) {
        for (std::size_t l = rows_.start[row]; l <= k; ++l)
          values[places_[next++]] += d * rows_.value[k] * rows_.value[l];
      }
    }
    // Rounding of the largest entry must not make a pivot negative.
    double shift = 0;
    for (int tries = 0; tries < kTries; ++tries) {
      if (cholesky_.factor({values.data(), static_cast<std::size_t>(values.size())}, shift)) return true;
      shift = shift == 0 ? kLeastPivot * values.cwiseAbs().maxCoeff() : 100 * shift;
    }
    return false;
  }
  /// Solves with refinement. Its residuals take A x before D: if D is large A x is small, and no digits are lost.
  [[nodiscard]] Vector solve(const Vector& right) const {
    Vector x = solved(right);
    for (int k = 0; k < kRefinements; ++k) {
      Vector left = right;
      add_transposed(squares_, times(squares_, x), -1, left);
      add_transposed(rows_, diagonal_.cwiseProduct(times(rows_, x)), -1, left);
      x += solved(left);
    }
    return x;
  }

 private:
  static constexpr int kTries = 4, kRefinements = 2;

  void order() {
    std::vector<SupernodalCholesky::Entry> entries;
    for (Index j = 0; j < matrix_.outerSize(); ++j) {
      for (Matrix::InnerIterator entry(matrix_, j); entry; ++entry)
        entries.push_back({static_cast<int>(entry.row()), static_cast<int>(j)});
    }
    Matrix whole;
    whole = matrix_.selfadjointView<Eigen::Lower>();
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> at_places;
    Eigen::AMDOrdering<int>()(whole, at_places);
    const Eigen::VectorXi places = at_places.inverse().eval().indices();
    cholesky_.analyze({places.begin(), places.end()}, entries);
  }
  [[nodiscard]] Vector solved(const Vector& right) const {
    Vector x = right;
    cholesky_.solve({x.data(), static_cast<std::size_t>(x.size())});
    return x;
  }

  /// Calls use(i, j, product) for all pairs of entries in a row, i ≥ j.
  template <class Use>
  static void for_each_product(const SparseRows& of, const Use& use) {
    for (std::size_t row = 0; row < of.size(); ++row) {
      for (std::size_t k = of.start[row]; k < of.start[row + 1]; ++k) {
        for (std::size_t l = of.start[row]; l <= k; ++l) {
          const auto [j, i] = std::minmax(of.column[k], of.column[l]);
          use(i, j, of.value[k] * of.value[l]);
        }
      }
    }
  }
  [[nodiscard]] Index place_of(int row, int column) const {
    const int* const rows = matrix_.innerIndexPtr();
    const int* const first = rows + matrix_.outerIndexPtr()[column];
    const int* const last = rows + matrix_.outerIndexPtr()[column + 1];
    return std::lower_bound(first, last, row) - rows;
  }

  const SparseRows &squares_, &rows_;
  Matrix matrix_;
  Vector diagonal_;          // D
  Vector constant_;          // Q, at the places of the matrix
  std::vector<int> places_;  // of the products of Aᵀ D A
  SupernodalCholesky cholesky_;
};

class InteriorPoint {
 public:
  explicit InteriorPoint(const ConvexProblem& problem)
      : p_(problem),
        matrix_(problem.squares, problem.rows, problem.n_columns),
        x_(Vector::Zero(static_cast<Index>(problem.n_columns))),
        s_(to_vector(problem.constants).cwiseMax(kFirstSlack)),
        y_(s_.cwiseInverse() * (problem.barrier > 0 ? problem.barrier : first_barrier())),
        v_(Vector::Zero(s_.size())),
        z_(Vector::Constant(s_.size(), kUnbounded)) {
    for (std::size_t i = 0; i < problem.violation_cost.size(); ++i) {
      const auto k = static_cast<Index>(i);
      if (std::isinf(problem.violation_cost[i])) continue;
      elastic_.push_back(k);
      y_[k] = z_[k] = 0.5 * problem.violation_cost[i];
      v_[k] = kFirstSlack + std::max(0.0, -problem.constants[i]);
    }
  }

  ConvexSolution run() {
    ConvexSolution result;
    if (p_.rows.size() == 0 || p_.n_columns == 0) return result;
    double least_slope = HUGE_VAL;
    int short_steps = 0, polishing = 0;
    for (; result.iterations < kMostIterations && short_steps < kMostShortSteps; ++result.iterations) {
      if (p_.must_stop && p_.must_stop()) return {};
      measure();
      if (has_gap()) {
        const double slope = slope_.cwiseAbs().cwiseQuotient(scale_.cwiseMax(kTiny)).maxCoeff();
        if (slope < least_slope) {
          least_slope = slope;
          result.primal.assign(x_.data(), x_.data() + x_.size());
          result.dual.assign(y_.data(), y_.data() + y_.size());
        }
        if (slope <= kResidual || ++polishing > kMostPolishing) break;
        if (!polish()) break;
        continue;
      }
      if (is_hopeless()) break;
      if (!matrix_.factor(y_.cwiseQuotient(yielding()))) break;
      if (step() < kShortStep) ++short_steps;
    }
    result.solved = !result.primal.empty();
    if (!result.solved) result.dual.assign(y_.data(), y_.data() + y_.size());
    return result;
  }

 private:
  struct Direction {
    Vector x, s, y, v;
  };

  /// y over the diagonal of the matrix: s, and more in rows that may be violated.
  [[nodiscard]] Vector yielding() const { return s_ + y_.cwiseProduct(v_.cwiseQuotient(z_)); }
  /// Σ s y + Σ v z, after t of the way.
  [[nodiscard]] double gap(double t, const Direction& d) const {
    double sum = (s_ + t * d.s).dot(y_ + t * d.y);
    for (const Index i : elastic_) sum += (v_[i] + t * d.v[i]) * (z_[i] - t * d.y[i]);
    return sum;
  }
  [[nodiscard]] double gap() const {
    double sum = s_.dot(y_);
    for (const Index i : elastic_) sum += v_[i] * z_[i];
    return sum;
  }
  [[nodiscard]] double n_products() const {
    return static_cast<double>(s_.size()) + static_cast<double>(elastic_.size());
  }

  /// The squares at the start, or if they are zero the squares of what rows lack.
  [[nodiscard]] double first_squares() const {
    double sum = 0, lacking = 0;
    for (const double c : p_.square_constants) sum += 0.5 * c * c;
    for (const double c : p_.constants) lacking += 0.5 * std::min(c, 0.0) * std::min(c, 0.0);
    return sum > 0 ? sum : lacking / static_cast<double>(std::max<std::size_t>(p_.squares.size(), 1));
  }
  /// The part of them for each slack.
  [[nodiscard]] double first_barrier() const {
    return std::max(first_squares(), kTiny) / static_cast<double>(p_.rows.size());
  }

  void measure() {
    const Vector squares = times(p_.squares, x_) + to_vector(p_.square_constants);
    slope_ = Vector::Zero(x_.size());
    if (!p_.cost.empty()) slope_ = to_vector(p_.cost);
    scale_ = slope_.cwiseAbs();
    const auto add = [&](const SparseRows& rows, std::size_t i, double factor) {
      rows.for_each(i, [&](std::size_t k, double a) {
        slope_[static_cast<Index>(k)] += factor * a;
        scale_[static_cast<Index>(k)] += std::abs(factor * a);
      });
    };
    for (std::size_t i = 0; i < p_.squares.size(); ++i) add(p_.squares, i, squares[static_cast<Index>(i)]);
    for (std::size_t i = 0; i < p_.rows.size(); ++i) add(p_.rows, i, -y_[static_cast<Index>(i)]);
    objective_ = 0.5 * squares.squaredNorm();
    if (!p_.cost.empty()) objective_ += to_vector(p_.cost).dot(x_);
    for (const Index i : elastic_) objective_ += p_.violation_cost[static_cast<std::size_t>(i)] * v_[i];
    lacking_ = times(p_.rows, x_) + to_vector(p_.constants) - s_ + v_;
    sizes_ = Vector::Ones(s_.size());
    for (std::size_t i = 0; i < p_.rows.size(); ++i) {
      p_.rows.for_each(i, [&](std::size_t k, double a) {
        sizes_[static_cast<Index>(i)] += std::abs(a * x_[static_cast<Index>(k)]);
      });
    }
  }

  /// If y proves that the objective is this much greater than at the start, there is most likely no x with s ≥ 0. With
  /// a cost, its unit says nothing about that.
  [[nodiscard]] bool is_hopeless() {
    if (!p_.cost.empty() || !elastic_.empty()) return false;
    if (first_objective_ < 0) first_objective_ = objective_ > 0 ? objective_ : first_squares();
    return p_.barrier == 0 && objective_ - y_.dot(s_ + lacking_) > kHopeless * first_objective_;
  }

  /// Makes the slope zero by small changes of x and y. If y/s is large, s has lost digits. So it is limited here, since
  /// any D does: the slope changes by Q dx + Aᵀ D A dx.
  bool polish() {
    Vector limited = y_.cwiseQuotient(yielding());
    if (p_.barrier == 0) limited = limited.cwiseMin(kLargestRatio * matrix_.largest_square());
    if (!matrix_.factor(limited)) return false;
    const Vector dx = matrix_.solve(-slope_), ds = times(p_.rows, dx);
    x_ += dx, s_ += ds, y_ -= limited.cwiseProduct(ds);
    for (const Index i : elastic_) {
      z_[i] += limited[i] * ds[i];
      if (v_[i] > s_[i] - ds[i]) s_[i] -= ds[i], v_[i] -= ds[i];
    }
    return s_.minCoeff() > 0 && y_.minCoeff() > 0 && z_.minCoeff() > 0 &&
           std::all_of(elastic_.begin(), elastic_.end(), [this](Index i) { return v_[i] > 0; });
  }

  /// Says whether all is solved, except for the slope.
  [[nodiscard]] bool has_gap() const {
    if ((lacking_.cwiseAbs() - kResidual * sizes_).maxCoeff() > 0) return false;
    if (p_.barrier == 0) return gap() <= kGap * std::max(objective_, kZero);
    return (s_.cwiseProduct(y_).array() / p_.barrier - 1).abs().maxCoeff() <= kCentered;
  }

  /// The direction for s y = v z = target, with the products ds dy and dv dz of the predictor, if there is one.
  [[nodiscard]] Direction direction(double target, const Direction* ahead) const {
    Vector beyond = s_.cwiseProduct(y_), beyond_v = Vector::Zero(s_.size());
    if (ahead != nullptr) beyond += ahead->s.cwiseProduct(ahead->y);
    beyond -= Vector::Constant(s_.size(), target);
    for (const Index i : elastic_)
      beyond_v[i] = v_[i] * z_[i] - (ahead != nullptr ? ahead->v[i] * ahead->y[i] : 0) - target;
    const Vector lacking = lacking_ - beyond_v.cwiseQuotient(z_), yielding = this->yielding();
    const Vector right_rows = (beyond + y_.cwiseProduct(lacking)).cwiseQuotient(yielding);
    Vector right = -slope_;
    add_transposed(p_.rows, right_rows, -1, right);
    Direction d;
    d.x = matrix_.solve(right);
    const Vector change = times(p_.rows, d.x);
    d.y = -(beyond + y_.cwiseProduct(change + lacking)).cwiseQuotient(yielding);
    d.v = (v_.cwiseProduct(d.y) - beyond_v).cwiseQuotient(z_);
    d.s = change + lacking_ + d.v;
    return d;
  }

  /// The largest t ≤ 1 with a + t d ≥ 0.
  [[nodiscard]] static double room(const Vector& a, const Vector& d) {
    double t = 1;
    for (Index i = 0; i < a.size(); ++i) {
      if (d[i] < 0) t = std::min(t, -a[i] / d[i]);
    }
    return t;
  }
  /// The part of the way to the nearest s, y, v or z that is 0, at most 1.
  [[nodiscard]] double room(const Direction& d) const {
    return std::min({room(s_, d.s), room(y_, d.y), room(v_, d.v), room(z_, -d.y)});
  }

  /// Returns the part of the way that was taken.
  double step() {
    Direction d;
    if (p_.barrier > 0) {
      d = direction(p_.barrier, nullptr);
    } else {
      const double mean = gap() / n_products();
      const Direction ahead = direction(0, nullptr);
      const double left = gap(room(ahead), ahead) / n_products();
      const double part = std::pow(left / mean, 3);
      const double least = 0.5 * kGap * std::max(objective_, kZero) / n_products();
      d = direction(std::max(part * mean, least), &ahead);
    }
    double t = room(d);
    if (t < 1) t *= kOfTheWay;
    x_ += t * d.x, s_ += t * d.s, y_ += t * d.y, v_ += t * d.v, z_ -= t * d.y;
    return t;
  }

  const ConvexProblem& p_;
  NewtonMatrix matrix_;
  Vector x_, s_, y_, v_, z_;
  std::vector<Index> elastic_;  // rows that may be violated
  Vector slope_, scale_;        // Q x + q − Aᵀ y, and the size of its terms
  Vector lacking_, sizes_;      // A x + b − s, and the size of its terms
  double objective_ = 0, first_objective_ = -1;
};

class InteriorPointSolver final : public ConvexSolver {
 public:
  ConvexSolution solve(const ConvexProblem& problem) override { return InteriorPoint(problem).run(); }
};

}  // namespace

std::unique_ptr<ConvexSolver> interior_point_solver() { return std::make_unique<InteriorPointSolver>(); }

}  // namespace temper
