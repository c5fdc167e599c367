#include "optimize/sweep/conjugate_gradients.hpp"

namespace temper {
namespace {

// ω. From 1 to 1.3 it makes no difference; 1.4 and more is worse.
constexpr float kOverRelaxation = 1.2F;
// Relative to the first residual. The system is only a model of the energy: a looser solution wastes its Hessian, a
// tighter one is not worth the iterations.
constexpr double kTolerance = 0.1;
constexpr int kMostIterations = 60;

double squared_norm(const std::vector<Float4>& a) {
  double sum = 0;
  for (const Float4& v : a) sum += static_cast<double>(dot(v, v));
  return sum;
}

}  // namespace

/// residual_ = (I/ω + L)⁻¹ b.
void ConjugateGradients::divide_by_lower(const BlockMatrix& a, const std::vector<Float4>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    Float4 sum = b[i];
    for (std::size_t k = a.begin_lower(i); k < a.begin_upper(i); ++k) {
      sum = sum - a.times(k, residual_[a.column[k]]);
    }
    residual_[i] = kOverRelaxation * sum;
  }
}

/// upper_ = (I/ω + U)⁻¹ p.
void ConjugateGradients::divide_by_upper(const BlockMatrix& a, const std::vector<Float4>& p) {
  for (std::size_t i = a.size(); i-- > 0;) {
    Float4 sum = p[i];
    for (std::size_t k = a.begin_upper(i); k < a.end_upper(i); ++k) sum = sum - a.times(k, upper_[a.column[k]]);
    upper_[i] = kOverRelaxation * sum;
  }
}

/// product_ = the split system's matrix times direction_. Returns their scalar product.
double ConjugateGradients::multiply(const BlockMatrix& a) {
  constexpr float kDiagonal = 1 - 2 / kOverRelaxation;
  divide_by_upper(a, direction_);
  for (std::size_t i = 0; i < a.size(); ++i) {
    Float4 sum = direction_[i] + kDiagonal * upper_[i];
    for (std::size_t k = a.begin_lower(i); k < a.begin_upper(i); ++k) {
      sum = sum - a.times(k, product_[a.column[k]]);
    }
    product_[i] = kOverRelaxation * sum;
  }
  double curvature = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    product_[i] = product_[i] + upper_[i];
    curvature += static_cast<double>(dot(direction_[i], product_[i]));
  }
  return curvature;
}

const std::vector<Float4>& ConjugateGradients::solve(const BlockMatrix& a, const std::vector<Float4>& b) {
  const std::size_t n = a.size();
  for (std::vector<Float4>* v : {&residual_, &upper_, &product_}) v->resize(n);
  x_.assign(n, {});
  divide_by_lower(a, b);
  direction_ = residual_;
  double squares = squared_norm(residual_);
  const double enough = kTolerance * kTolerance * squares;
  for (int k = 0; k < kMostIterations && squares > enough; ++k) {
    const double curvature = multiply(a);
    if (!(curvature > 0)) {
      if (k == 0) x_ = direction_;
      break;
    }
    const float step = static_cast<float>(squares / curvature);
    for (std::size_t i = 0; i < n; ++i) {
      x_[i] = x_[i] + step * direction_[i];
      residual_[i] = residual_[i] - step * product_[i];
    }
    const double next = squared_norm(residual_);
    const float back = static_cast<float>(next / squares);
    squares = next;
    for (std::size_t i = 0; i < n; ++i) direction_[i] = residual_[i] + back * direction_[i];
  }
  divide_by_upper(a, x_);
  return upper_;
}

}  // namespace temper
