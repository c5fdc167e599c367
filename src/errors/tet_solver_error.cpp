// See make_discretization_error() in temper/tets/errors.hpp: solver_error.cpp, with a dimension more, for
// unknowns at the vertices. d0ᵀ ★1 d0 v = ★0 f for a wave u; J = c Σ ★0 e², e = v − u, and A λ = ∂J/∂e. Then the
// derivative of J is that of J − λᵀ (A v − ★0 f) with v and λ kept. It reaches positions and weights through the parts
// of ★1 and ★0 in each tetrahedron.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "errors/lender.hpp"
#include "errors/poisson.hpp"
#include "errors/waves.hpp"
#include "temper/tets/errors.hpp"
#include "temper/tets/operators.hpp"
#include "temper/tets/optimize.hpp"
#include "tets/energy/parts.hpp"
#include "tets/mesh/tables.hpp"

namespace temper::tets {
namespace {

using Gradient = DiscretizationError::Gradient;
using error_detail::Cholesky;
using error_detail::kLanes;
using error_detail::Lanes;
using error_detail::Lender;
using error_detail::PointSystem;
using error_detail::vertex_residuals;
using error_detail::vertex_system;

using Waves = error_detail::WaveBlock<Vec3>;
constexpr std::size_t kBlocksOfNumber = 2;

/// ★0 and ★1 as sums over the parts of tetrahedra: ★1 of |e| |e*| over |e|², ★0 of its thirds, by the crossing.
struct VertexScheme {
  struct Edge {
    VertexId from, to;
  };
  IdVector<EdgeId, Edge> edges;
  IdVector<TetId, std::array<EdgeId, 6>> edges_of;
  IdVector<TetId, TetParts> parts;
  IdVector<EdgeId, double> star1;
  IdVector<VertexId, double> star0;
  double volume = 0;

  explicit VertexScheme(const TetMesh& mesh)
      : edges_of(mesh.n_tetrahedra()), parts(mesh.n_tetrahedra()), star0(mesh.n_vertices(), 0) {
    const EdgeTable table(mesh, nullptr);
    std::vector<EdgeId> number(6 * mesh.n_tetrahedra());
    for (const TetId t : mesh.tetrahedra()) {
      parts[t] = TetDuals(mesh, t).parts();
      for (std::size_t e = 0; e < 6; ++e) {
        const auto [i, j] = ends(mesh, t, e);
        EdgeId& id = number[*table.find(i, j)];
        if (!id.valid()) {
          id = EdgeId(edges.size());
          edges.push_back({i, j});
          star1.push_back(0);
        }
        edges_of[t][e] = id;
        const double v = parts[t].edges[e].volume, along = parts[t].along[e];
        star1[id] += v / parts[t].square[e];
        star0[i] += v * along / 3, star0[j] += v * (1 - along) / 3;
        volume += v / 3;
      }
    }
  }
  static std::pair<VertexId, VertexId> ends(const TetMesh& mesh, TetId t, std::size_t e) {
    const auto& corners = mesh.corners(t);
    return {corners[std::size_t(kEdgeCorners[e][0])], corners[std::size_t(kEdgeCorners[e][1])]};
  }
};

/// The derivatives of J by the operators, and by the places of vertices with all else kept.
struct TetAdjoint {
  IdVector<VertexId, Vec3> vertex;
  IdVector<VertexId, double> star0;
  IdVector<EdgeId, double> star1;
};

void pull_back(const TetMesh& mesh, const VertexScheme& dec, const TetAdjoint& by,
               IdVector<VertexId, WeightedPoint>& gradient) {
  for (const VertexId v : mesh.vertices()) gradient[v] = {by.vertex[v].x, by.vertex[v].y, by.vertex[v].z, 0};
  for (const TetId t : mesh.tetrahedra()) {
    TetParts slopes;
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [i, j] = VertexScheme::ends(mesh, t, e);
      const double volume = dec.parts[t].edges[e].volume, along = dec.parts[t].along[e],
                   square = dec.parts[t].square[e];
      const double by_star1 = by.star1[dec.edges_of[t][e]], at_i = by.star0[i] / 3, at_j = by.star0[j] / 3;
      slopes.edges[e].volume = by_star1 / square + at_i * along + at_j * (1 - along);
      slopes.along[e] = volume * (at_i - at_j);
      slopes.square[e] = -by_star1 * volume / (square * square);
    }
    add_to(gradient, mesh.corners(t), TetDuals(mesh, t).pulled_back(slopes));
  }
}

/// Measures two-point fluxes as measure_errors() does.
class TetCellError final : public DiscretizationError {
 public:
  [[nodiscard]] bool has_gradient() const override { return false; }
  [[nodiscard]] std::vector<double> errors(const TetMesh& mesh, std::vector<Gradient>* /*gradients*/,
                                           Executor* /*executor*/) const override {
    const auto report = measure_errors(mesh, {.fields = {"chosen"}});
    if (!report) return {};
    double sum = 0;
    for (const FieldErrors& f : report->fields) sum += f.errors.flux.l2 * f.errors.flux.l2;
    return {sum / static_cast<double>(report->fields.size())};
  }
};

class TetVertexError final : public DiscretizationError {
 public:
  [[nodiscard]] std::vector<double> errors(const TetMesh& mesh, std::vector<Gradient>* gradients,
                                           Executor* /*executor*/) const override {
    const VertexScheme dec(mesh);
    std::vector<bool> given;
    for (const std::uint8_t on_boundary : boundary_vertices(mesh)) given.push_back(on_boundary != 0);
    const PointSystem points = vertex_system(dec, given);
    const auto matrix = last_.take();
    if (!matrix->factor(points.n_unknowns(), points.lower())) return {};
    if (gradients != nullptr) gradients->clear();
    TetAdjoint by = {IdVector<VertexId, Vec3>(mesh.n_vertices()), IdVector<VertexId, double>(mesh.n_vertices()),
                     IdVector<EdgeId, double>(dec.edges.size())};
    double sum = 0;
    for (const Waves& waves : error_detail::waves_of<Vec3>(field_frame(mesh), dec.volume, kBlocksOfNumber)) {
      sum += error(*matrix, mesh, dec, points, waves, gradients != nullptr ? &by : nullptr);
    }
    if (gradients != nullptr) pull_back(mesh, dec, by, gradients->emplace_back(mesh.n_vertices()));
    return {sum};
  }

 private:
  static double error(const Cholesky& matrix, const TetMesh& mesh, const VertexScheme& dec, const PointSystem& points,
                      const Waves& waves, TetAdjoint* by) {
    std::vector<Lanes> value(mesh.n_vertices());
    for (const VertexId v : mesh.vertices()) value[v.index] = waves.at(mesh.position(v));
    std::vector<Lanes> errors = vertex_residuals(dec, waves.k2, value);
    matrix.solve(points, errors);
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
    matrix.solve(points, lambda);
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

  mutable Lender<Cholesky> last_;  // which keeps the order of elimination
};

}  // namespace

std::shared_ptr<const DiscretizationError> make_discretization_error(Scheme scheme) {
  if (scheme == Scheme::vertex) return std::make_shared<TetVertexError>();
  if (scheme == Scheme::cell) return std::make_shared<TetCellError>();
  return nullptr;
}

}  // namespace temper::tets
