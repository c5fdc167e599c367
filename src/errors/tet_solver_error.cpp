// See make_discretization_error() in temper/tets/errors.hpp: solver_error.cpp, with a dimension more, for
// unknowns at the vertices. d0ᵀ ★1 d0 v = ★0 f for a wave u; J = c Σ ★0 e², e = v − u, and A λ = ∂J/∂e. Then the
// derivative of J is that of J − λᵀ (A v − ★0 f) with v and λ kept. It reaches positions and weights through the parts
// of ★1 and ★0 in each tetrahedron.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <utility>

#include "base/sine_cosine.hpp"
#include "errors/poisson.hpp"
#include "temper/tets/errors.hpp"
#include "temper/tets/operators.hpp"
#include "temper/tets/optimize.hpp"
#include "tets/energy/offset.hpp"
#include "tets/energy/sloped.hpp"
#include "tets/mesh/tables.hpp"

namespace temper::tets {
namespace {

using error_detail::Cholesky;
using error_detail::kLanes;
using error_detail::Lanes;
using error_detail::PointSystem;
using error_detail::vertex_residuals;
using error_detail::vertex_system;

// Wave numbers in radians per half of the bounding box. Each has two blocks of four directions, with a sine and a
// cosine.
constexpr double kTetWaveNumbers[] = {1.5, 3.5};
constexpr std::size_t kTetDirections = kLanes / 2, kBlocksOfNumber = 2;
constexpr std::size_t kTetBlocks = kBlocksOfNumber * std::size(kTetWaveNumbers);

struct SpaceWaves {
  std::array<Vec3, kTetDirections> k = {};
  std::array<double, kTetDirections> phase = {};
  double k2 = 0;     // |k|²
  double share = 0;  // c of J

  [[nodiscard]] Lanes at(Vec3 p) const {
    Lanes values;
    for (std::size_t d = 0; d < kTetDirections; ++d) {
      const auto [sine, cosine] = sine_cosine(dot(k[d], p) + phase[d]);
      values[2 * d] = sine, values[2 * d + 1] = cosine;
    }
    return values;
  }
};

/// Directions on a spiral from one pole to the equator.
std::array<SpaceWaves, kTetBlocks> space_waves(const TetMesh& mesh, double volume) {
  const auto [center, half_size] = field_frame(mesh);
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  std::array<SpaceWaves, kTetBlocks> blocks;
  for (std::size_t b = 0; b < kTetBlocks; ++b) {
    const double in_frame = kTetWaveNumbers[b / kBlocksOfNumber], number = in_frame / half_size;
    blocks[b].k2 = number * number;
    blocks[b].share = 2 / (volume * in_frame * in_frame * in_frame * in_frame * kTetBlocks * kLanes);
    for (std::size_t d = 0; d < kTetDirections; ++d) {
      const auto i = static_cast<double>(kTetBlocks * d + b);
      const double z = (i + 0.5) / (kTetBlocks * kTetDirections), r = std::sqrt(1 - z * z);
      const auto [sine, cosine] = sine_cosine(golden * i);
      blocks[b].k[d] = number * Vec3{r * cosine, r * sine, z};
      blocks[b].phase[d] = -dot(blocks[b].k[d], center);
    }
  }
  return blocks;
}

/// The derivatives of J by the operators, and by the places of vertices with all else kept.
struct TetAdjoint {
  IdVector<VertexId, Vec3> vertex;
  IdVector<VertexId, double> star0;
  IdVector<EdgeId, double> star1;
};

std::array<std::size_t, 4> edge_corners(std::size_t e) {
  const auto& [i, j, k, l] = kEdgeCorners[e];
  return {std::size_t(i), std::size_t(j), std::size_t(k), std::size_t(l)};
}

/// Σ of ★1 and ★0 of one tetrahedron times their derivatives, from the corners in positive order.
struct TetDuals {
  std::array<double, 6> star1;  // by the edges of kEdgeCorners
  std::array<double, 4> star0;

  template <class T>
  [[nodiscard]] T sum(const std::array<Weighted<T>, 4>& p) const {
    std::array<Vector<T>, 4> faces;  // the orthocenters of the faces opposite the corners
    for (std::size_t f = 0; f < 4; ++f) faces[f] = orthocenter(p[(f + 1) % 4], p[(f + 2) % 4], p[(f + 3) % 4]);
    const Vector<T> normal = cross(p[1].at - p[0].at, p[2].at - p[0].at), o = orthocenter(p[0], p[3], normal, faces[3]);
    T sum = T(0);
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [i, j, k, l] = edge_corners(e);
      const T volume = edge_part(p[i], p[j], faces[l], o, faces[k]).volume, along = crossing(p[i], p[j]);
      const Vector<T> edge = p[j].at - p[i].at;
      sum = sum + T(star1[e]) * (volume / dot(edge, edge));
      sum = sum + T(1.0 / 3) * volume * (T(star0[i]) * along + T(star0[j]) * (T(1) - along));
    }
    return sum;
  }
};

EdgeId edge_between(const DecComplex& dec, VertexId a, VertexId b) {
  const auto [from, to] = std::minmax(a, b);
  const auto found =
      std::lower_bound(dec.edges.begin(), dec.edges.end(), std::pair(from, to),
                       [](const DecEdge& e, const auto& ends) { return std::pair(e.from, e.to) < ends; });
  return EdgeId(static_cast<std::size_t>(found - dec.edges.begin()));
}

void pull_back(const TetMesh& mesh, const DecComplex& dec, const TetAdjoint& by,
               IdVector<VertexId, WeightedPoint>& gradient) {
  for (const VertexId v : mesh.vertices()) gradient[v] = {by.vertex[v].x, by.vertex[v].y, by.vertex[v].z, 0};
  for (const TetId t : mesh.tetrahedra()) {
    const auto& corners = mesh.corners(t);
    TetDuals duals = {};
    std::array<Weighted<Sloped>, 4> points;
    const Vec3 origin = mesh.position(corners[0]);
    for (std::size_t k = 0; k < 4; ++k) {
      duals.star0[k] = by.star0[corners[k]];
      const Vec3 p = mesh.position(corners[k]) - origin;
      points[k] = {{Sloped(p.x), Sloped(p.y), Sloped(p.z)}, Sloped(mesh.weight(corners[k]))};
    }
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [i, j, k, l] = edge_corners(e);
      duals.star1[e] = by.star1[edge_between(dec, corners[i], corners[j])];
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const Weighted<Sloped> kept = points[k];
      points[k] = {{Sloped(kept.at.x.value, 0), Sloped(kept.at.y.value, 1), Sloped(kept.at.z.value, 2)},
                   Sloped(kept.w.value, 3)};
      const auto [g, w] = duals.sum(points).gradient();
      WeightedPoint& to = gradient[corners[k]];
      to = {to.x + g.x, to.y + g.y, to.z + g.z, to.w + w};
      points[k] = kept;
    }
  }
}

class TetVertexError final : public DiscretizationError {
 public:
  [[nodiscard]] double squared_error(const TetMesh& mesh, IdVector<VertexId, WeightedPoint>* gradient) const override {
    const DecComplex dec = dec_operators(mesh);
    double volume = 0;
    for (const double of_tetrahedron : dec.volumes) volume += of_tetrahedron;
    std::vector<bool> given;
    for (const std::uint8_t on_boundary : boundary_vertices(mesh)) given.push_back(on_boundary != 0);
    const PointSystem points = vertex_system(dec, given);
    const std::lock_guard lock(mutex_);
    if (!matrix_.factor(points.n_unknowns(), points.lower())) return std::numeric_limits<double>::infinity();
    TetAdjoint by = {IdVector<VertexId, Vec3>(mesh.n_vertices()), IdVector<VertexId, double>(mesh.n_vertices()),
                     IdVector<EdgeId, double>(dec.edges.size())};
    double sum = 0;
    for (const SpaceWaves& waves : space_waves(mesh, volume)) {
      sum += error(mesh, dec, points, waves, gradient != nullptr ? &by : nullptr);
    }
    if (gradient != nullptr) pull_back(mesh, dec, by, *gradient);
    return sum;
  }

 private:
  double error(const TetMesh& mesh, const DecComplex& dec, const PointSystem& points, const SpaceWaves& waves,
               TetAdjoint* by) const {
    std::vector<Lanes> value(mesh.n_vertices());
    for (const VertexId v : mesh.vertices()) value[v.index] = waves.at(mesh.position(v));
    std::vector<Lanes> errors = vertex_residuals(dec, waves.k2, value);
    matrix_.solve(points, errors);
    double sum = 0;
    std::vector<Lanes> lambda(errors.size());
    for (const VertexId v : mesh.vertices()) {
      for (std::size_t i = 0; i < kLanes; ++i) {
        const double e = errors[v.index][i], by_error = waves.share * dec.star0[v] * e;
        sum += by_error * e;
        lambda[v.index][i] = 2 * by_error;
      }
    }
    if (by == nullptr) return sum;
    matrix_.solve(points, lambda);
    for (const VertexId v : mesh.vertices()) {
      const std::size_t p = v.index;
      if (points.is_given(p)) continue;
      for (std::size_t i = 0; i < kLanes; ++i) {
        const double by_source = waves.k2 * lambda[p][i], by_error = 2 * waves.share * errors[p][i];
        by->star0[v] += waves.share * errors[p][i] * errors[p][i] + by_source * value[p][i];
        const double slope = i % 2 == 0 ? value[p][i + 1] : -value[p][i - 1];  // of the sine and the cosine
        by->vertex[v] = by->vertex[v] + dec.star0[v] * (by_source - by_error) * slope * waves.k[i / 2];
      }
    }
    for (const VertexId v : mesh.vertices()) {
      for (std::size_t i = 0; i < kLanes; ++i) value[v.index][i] += errors[v.index][i];
    }
    for (std::size_t e = 0; e < dec.edges.size(); ++e) {
      const auto [from, to] = std::pair(dec.edges[EdgeId(e)].from.index, dec.edges[EdgeId(e)].to.index);
      for (std::size_t i = 0; i < kLanes; ++i)
        by->star1[EdgeId(e)] -= (lambda[from][i] - lambda[to][i]) * (value[from][i] - value[to][i]);
    }
    return sum;
  }

  mutable std::mutex mutex_;
  mutable Cholesky matrix_;  // keeps the order of elimination
};

}  // namespace

std::shared_ptr<const DiscretizationError> make_discretization_error(Scheme scheme) {
  if (scheme != Scheme::vertex) return nullptr;
  return std::make_shared<TetVertexError>();
}

}  // namespace temper::tets
