#include "temper/detail/tensor.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/text.hpp"
#include "temper/detail/geometry.hpp"

namespace temper {
namespace {

// The largest ratio of eigenvalues. The metric stretches lengths by factors that differ by at most its square root,
// 10⁴, so mapping there and back loses at most about four of a double's 16 digits.
constexpr double kFarthestApart = 1e8;

/// The first triangle that is no longer counter-clockwise.
Expected<void> expect_upright(const Mesh& mesh, const InputNames& names) {
  for (const TriangleId t : mesh.triangles()) {
    if (mesh.is_erased(t)) continue;
    const auto [i, j, k] = mesh.corners(t);
    if (orient2d(mesh.position(i), mesh.position(j), mesh.position(k)) == Sign::positive) continue;
    return InputError{ErrorCode::zero_area, names.triangle_where(t.index),
                      names.triangle(t.index) +
                          " is so flat that it turns over when its corners are rounded, in the metric of the tensor or "
                          "back"};
  }
  return {};
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

Expected<Mesh> mapped(const Mesh& mesh, const Metric& metric, const InputNames& names) {
  if (auto error = expect_plane(mesh, "a diffusion tensor")) return *std::move(error);
  Mesh result = mesh;
  for (const VertexId v : mesh.vertices()) result.set_position(v, metric.to_metric(mesh.position(v)));
  if (const auto upright = expect_upright(result, names); !upright) return upright.error();
  return result;
}

Expected<Mesh> mapped_back(const Mesh& changed, const Mesh& original, const Metric& metric,
                           const IdVector<VertexId, VertexId>& vertices) {
  if (auto error = expect_plane(changed, "a diffusion tensor")) return *std::move(error);
  Mesh result = changed;
  for (const VertexId v : changed.vertices()) {
    const VertexId old = vertices.empty() ? v : vertices[v];
    const bool known = old.valid() && old.index < original.n_vertices();
    const bool stayed = known && metric.to_metric(original.position(old)) == changed.position(v);
    result.set_position(v, stayed ? original.position(old) : metric.from_metric(changed.position(v)));
  }
  if (const auto upright = expect_upright(result, InputNames()); !upright) return upright.error();
  return result;
}

}  // namespace temper
