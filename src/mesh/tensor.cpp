#include "temper/detail/tensor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "base/text.hpp"

namespace temper {
namespace {

// The largest ratio of eigenvalues. The metric stretches lengths by factors that differ by at most its square root,
// 10⁴, so mapping there and back loses at most about four of a double's 16 digits.
constexpr double kFarthestApart = 1e8;

/// The components of √(det K) K⁻¹, which are the same for multiples of K, as integers in units of 10⁻¹⁰ of their norm.
std::array<std::int64_t, 3> plane_of(const Tensor& k) {
  const double norm = std::hypot(k.xx, k.xy, k.yy), unit = 1e-10;
  return {std::llround(k.xx / norm / unit), std::llround(k.xy / norm / unit), std::llround(k.yy / norm / unit)};
}

}  // namespace

/// Let s = √(det K) and R = √K, which is (K + s)/√(tr K + 2 s). Then B = √s R⁻¹, and B⁻¹ = R/√s.
Expected<Metric> Metric::of(const Tensor& k) {
  const auto shown = [&k] { return to_text(k.xx) + ", " + to_text(k.xy) + ", " + to_text(k.yy); };
  const auto error = [&](const char* expected) {
    return InputError{ErrorCode::invalid_option, "",
                      std::string("tensor: expected ") + expected + ", found " + shown()};
  };
  if (!std::isfinite(k.xx) || !std::isfinite(k.xy) || !std::isfinite(k.yy)) return error("finite numbers");
  const double determinant = k.xx * k.yy - k.xy * k.xy, trace = k.xx + k.yy;
  if (!(k.xx > 0) || !(k.yy > 0) || !(determinant > 0) || !std::isfinite(determinant))
    return error("a positive definite tensor kxx,kxy,kyy, with kxx > 0 and kxx kyy > kxy^2");
  const double larger = 0.5 * (trace + std::hypot(k.xx - k.yy, 2 * k.xy)), smaller = determinant / larger;
  if (larger > kFarthestApart * smaller) return error("eigenvalues that are at most 1e8 times each other");
  Metric metric;
  metric.tensor_ = k;
  const double s = std::sqrt(determinant), scale = 1 / std::sqrt(s * (trace + 2 * s));
  metric.from_ = {scale * (k.xx + s), scale * k.xy, scale * (k.yy + s)};
  metric.to_ = {scale * (k.yy + s), -scale * k.xy, scale * (k.xx + s)};  // its determinant is 1
  metric.strength_ = s;
  return metric;
}

Expected<Metrics> Metrics::of(std::span<const Tensor> tensors, const InputNames& names) {
  std::map<std::array<double, 3>, std::uint32_t> numbers;
  std::map<std::array<std::int64_t, 3>, std::uint32_t> planes;
  Metrics metrics;
  metrics.distinct_.clear();
  metrics.of_triangle_.reserve(tensors.size());
  for (std::size_t t = 0; t < tensors.size(); ++t) {
    const Tensor& k = tensors[t];
    const auto next = static_cast<std::uint32_t>(metrics.distinct_.size());
    const auto [at, is_new] = numbers.try_emplace({k.xx, k.xy, k.yy}, next);
    if (is_new) {
      auto metric = Metric::of(k);
      if (!metric)
        return InputError{metric.error().code, names.triangle_where(t),
                          names.triangle(t) + ": " + metric.error().message};
      const std::uint32_t plane = planes.try_emplace(plane_of(k), next).first->second;
      if (plane != next) metric->to_ = metrics.distinct_[plane].to_, metric->from_ = metrics.distinct_[plane].from_;
      metrics.distinct_.push_back(*metric);
    }
    metrics.of_triangle_.push_back(at->second);
  }
  if (metrics.distinct_.empty()) return Metrics();
  if (metrics.distinct_.size() == 1) metrics.of_triangle_ = {};
  return metrics;
}

}  // namespace temper
