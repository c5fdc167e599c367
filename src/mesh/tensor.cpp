// The plane of a tensor's metric, and the way there and back.
#include "temper/detail/tensor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/text.hpp"
#include "mesh/pieces.hpp"

namespace temper {
namespace {

// The largest ratio of eigenvalues. The metric stretches lengths by factors that differ by at most its square root,
// 10⁴, so mapping there and back loses at most about four of a double's 16 digits.
constexpr double kFarthestApart = 1e8;

template <class K>
InputError wrong_tensor(const K& k, const std::string& expected) {
  std::string shown;
  for (const double c : k.components()) shown += (shown.empty() ? "" : ", ") + to_text(c);
  return {ErrorCode::invalid_option, "", "tensor: expected " + expected + ", found " + shown};
}

using Matrix = std::array<std::array<double, 3>, 3>;

/// A rotation in the plane of the axes p and q that makes the entry pq of a symmetric matrix zero (Jacobi). The columns
/// of `axes` turn with it.
void rotate(Matrix& a, Matrix& axes, std::size_t p, std::size_t q) {
  if (a[p][q] == 0) return;
  const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::hypot(theta, 1.0));
  const double c = 1 / std::hypot(t, 1.0), s = t * c;
  const std::size_t r = 3 - p - q;
  const double pq = a[p][q], rp = a[r][p], rq = a[r][q];
  a[p][p] -= t * pq, a[q][q] += t * pq;
  a[p][q] = a[q][p] = 0;
  a[r][p] = a[p][r] = c * rp - s * rq;
  a[r][q] = a[q][r] = s * rp + c * rq;
  for (auto& row : axes) {
    const double at_p = row[p], at_q = row[q];
    row[p] = c * at_p - s * at_q;
    row[q] = s * at_p + c * at_q;
  }
}

/// The axes of a tensor, as columns, and its eigenvalues in `values`. A diagonal tensor keeps its entries, bit for bit.
struct Axes {
  Matrix columns = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::array<double, 3> values;

  explicit Axes(const Tensor3& k) {
    constexpr int kSweeps = 12;  // each squares the entries that are left; 6 are enough for doubles
    const double unit = std::max({std::abs(k.xx), std::abs(k.yy), std::abs(k.zz)});
    Matrix a = {{{k.xx / unit, k.xy / unit, k.xz / unit},
                 {k.xy / unit, k.yy / unit, k.yz / unit},
                 {k.xz / unit, k.yz / unit, k.zz / unit}}};
    for (int i = 0; i < kSweeps; ++i) rotate(a, columns, 0, 1), rotate(a, columns, 0, 2), rotate(a, columns, 1, 2);
    values = {unit * a[0][0], unit * a[1][1], unit * a[2][2]};
  }
  /// The tensor with these axes and other eigenvalues.
  [[nodiscard]] Tensor3 with(const std::array<double, 3>& eigenvalues) const {
    const auto entry = [&](std::size_t i, std::size_t j) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += columns[i][k] * eigenvalues[k] * columns[j][k];
      return sum;
    };
    return {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
  }
};

}  // namespace

/// Let s = √(det K) and R = √K, which is (K + s)/√(tr K + 2 s). Then B = √s R⁻¹, and B⁻¹ = R/√s.
template <>
Expected<Metric> Metric::of(const Tensor& k) {
  if (!is_finite(k)) return wrong_tensor(k, "finite numbers");
  const double determinant = k.xx * k.yy - k.xy * k.xy, trace = k.xx + k.yy;
  if (!(k.xx > 0) || !(k.yy > 0) || !(determinant > 0) || !std::isfinite(determinant))
    return wrong_tensor(k, "a positive definite tensor kxx,kxy,kyy, with kxx > 0 and kxx kyy > kxy^2");
  const double larger = 0.5 * (trace + std::hypot(k.xx - k.yy, 2 * k.xy)), smaller = determinant / larger;
  if (larger > kFarthestApart * smaller) return wrong_tensor(k, "eigenvalues that are at most 1e8 times each other");
  Metric metric;
  metric.tensor_ = k;
  const double s = std::sqrt(determinant), scale = 1 / std::sqrt(s * (trace + 2 * s));
  metric.from_ = {scale * (k.xx + s), scale * k.xy, scale * (k.yy + s)};
  metric.to_ = {scale * (k.yy + s), -scale * k.xy, scale * (k.xx + s)};  // its determinant is 1
  metric.strength_ = s;
  return metric;
}

/// Let λ be the eigenvalues of K, and s = ∛(λ₁ λ₂ λ₃). Then B has the eigenvalues √(s/λ), and B⁻¹ has √(λ/s).
template <>
Expected<MetricOf<Tensor3>> MetricOf<Tensor3>::of(const Tensor3& k) {
  if (!is_finite(k)) return wrong_tensor(k, "finite numbers");
  const std::string definite = std::string("a positive definite tensor ") + Tensor3::kNames;
  if (!(k.xx > 0) || !(k.yy > 0) || !(k.zz > 0)) return wrong_tensor(k, definite);
  const Axes axes(k);
  const auto [smaller, larger] = std::ranges::minmax(axes.values);
  if (!(smaller > 0)) return wrong_tensor(k, definite);
  if (larger > kFarthestApart * smaller) return wrong_tensor(k, "eigenvalues that are at most 1e8 times each other");
  const auto& [a, b, c] = axes.values;
  const double s = a * std::cbrt((b / a) * (c / a));
  const auto root = [](double x, double y) { return std::sqrt(x / y); };
  MetricOf<Tensor3> metric;
  metric.tensor_ = k;
  metric.from_ = axes.with({root(a, s), root(b, s), root(c, s)});
  metric.to_ = axes.with({root(s, a), root(s, b), root(s, c)});
  metric.strength_ = s;
  return metric;
}

template Expected<Metrics> MetricsOf<Tensor, TriangleId, InputNames>::of(std::span<const Tensor> tensors,
                                                                         const InputNames& names);

}  // namespace temper
