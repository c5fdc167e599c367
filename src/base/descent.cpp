#include "base/descent.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/portable_log.hpp"
#include "base/sum.hpp"

namespace temper {
namespace {

constexpr std::size_t kPairs = 20;
constexpr double kFirstStep = 0.05;        // the largest change of an unknown in the first step
constexpr double kLeastCurvature = 1e-12;  // least cosine between step and change

void add(std::vector<double>& to, double factor, const std::vector<double>& of) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += factor * of[i];
}

}  // namespace

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return blockwise_sum(a.size(), nullptr, [&](std::size_t i) { return a[i] * b[i]; });
}

double largest(const std::vector<double>& a) {
  double most = 0;
  for (const double x : a) most = std::max(most, std::abs(x));
  return most;
}

Descent::Vector Descent::direction(const Vector& gradient) const {
  Vector q = gradient;
  if (knows_nothing()) {
    const double most = largest(gradient);
    for (double& x : q) x *= most > 0 ? -kFirstStep / most : 0;
    return q;
  }
  std::vector<double> along(pairs_.size());
  for (std::size_t i = pairs_.size(); i-- > 0;) {
    along[i] = pairs_[i].inverse * dot(pairs_[i].step, q);
    add(q, -along[i], pairs_[i].change);
  }
  const Pair& last = pairs_.back();
  const double scale = 1 / (last.inverse * dot(last.change, last.change));
  for (double& x : q) x *= scale;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    add(q, along[i] - pairs_[i].inverse * dot(pairs_[i].change, q), pairs_[i].step);
  }
  for (double& x : q) x = -x;
  return q;
}

void Descent::learn(Vector step, Vector change) {
  const double curvature = dot(step, change);
  if (!(curvature > kLeastCurvature * std::sqrt(dot(step, step) * dot(change, change)))) return;
  if (pairs_.size() == kPairs) pairs_.erase(pairs_.begin());
  pairs_.push_back({std::move(step), std::move(change), 1 / curvature});
}

LogObjective log_objective(const std::vector<double>& errors, const std::vector<double>& start, double total,
                           double share) {
  const auto n = static_cast<double>(errors.size());
  double sum = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) sum += errors[i] / start[i];
  const double mean = sum / n;
  LogObjective result = {portable_log(mean) + share * portable_log(total), share / total, {}};
  for (const double s : start) result.by_error.push_back(1 / (n * s * mean));
  return result;
}

}  // namespace temper
