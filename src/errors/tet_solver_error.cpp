// See make_discretization_error() in temper/tets/errors.hpp: solver_error.cpp, with a dimension more, for
// unknowns at the vertices. The derivatives reach positions and weights through the parts of ★1 and ★0 in each
// tetrahedron.
#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "errors/lender.hpp"
#include "errors/vertex_error.hpp"
#include "temper/tets/errors.hpp"
#include "temper/tets/operators.hpp"
#include "temper/tets/optimize.hpp"
#include "tets/energy/parts.hpp"
#include "tets/mesh/tables.hpp"

namespace temper::tets {
namespace {

using Gradient = DiscretizationError::Gradient;
using error_detail::Cholesky;
using error_detail::Lender;
using error_detail::PointSystem;
using error_detail::vertex_system;
using Fields = error_detail::FieldBlock<Vec3>;
constexpr std::size_t kBlocksOfNumber = 2;

std::pair<VertexId, VertexId> ends(const TetMesh& mesh, TetId t, std::size_t e) {
  const auto& corners = mesh.corners(t);
  return {corners[std::size_t(kEdgeCorners[e][0])], corners[std::size_t(kEdgeCorners[e][1])]};
}

/// The edges of a mesh. They are found again only if the connectivity is another one.
struct Edges {
  struct Edge {
    VertexId from, to;
  };
  IdVector<EdgeId, Edge> ends_of;
  IdVector<TetId, std::array<EdgeId, 6>> of;
  IdVector<TetId, std::array<VertexId, 4>> corners;

  void find(const TetMesh& mesh) {
    const auto all = mesh.tetrahedra();
    if (corners.size() == mesh.n_tetrahedra() &&
        std::all_of(all.begin(), all.end(), [&](TetId t) { return corners[t] == mesh.corners(t); }))
      return;
    ends_of = {}, of = IdVector<TetId, std::array<EdgeId, 6>>(mesh.n_tetrahedra()), corners = {};
    const EdgeTable table(mesh, nullptr);
    std::vector<EdgeId> number(6 * mesh.n_tetrahedra());
    for (const TetId t : all) {
      corners.push_back(mesh.corners(t));
      for (std::size_t e = 0; e < 6; ++e) {
        const auto [i, j] = ends(mesh, t, e);
        EdgeId& id = number[*table.find(i, j)];
        if (!id.valid()) {
          id = EdgeId(ends_of.size());
          ends_of.push_back({i, j});
        }
        of[t][e] = id;
      }
    }
  }
};

/// ★0 and ★1 as sums over the parts of tetrahedra: ★1 of |e| |e*| over |e|², ★0 of its thirds, by the crossing.
struct VertexScheme {
  const IdVector<EdgeId, Edges::Edge>& edges;
  const IdVector<TetId, std::array<EdgeId, 6>>& edges_of;
  IdVector<TetId, TetParts> parts;
  IdVector<EdgeId, double> star1;
  IdVector<VertexId, double> star0;
  double volume = 0;

  VertexScheme(const TetMesh& mesh, const Edges& of, Executor* executor)
      : edges(of.ends_of),
        edges_of(of.of),
        parts(parts_of(mesh, executor)),
        star1(edges.size(), 0),
        star0(mesh.n_vertices(), 0) {
    for (const TetId t : mesh.tetrahedra()) {
      for (std::size_t e = 0; e < 6; ++e) {
        const auto [i, j] = ends(mesh, t, e);
        const EdgeId id = edges_of[t][e];
        const double v = parts[t].edges[e].volume, along = parts[t].along[e];
        star1[id] += v / parts[t].square[e];
        star0[i] += v * along / 3, star0[j] += v * (1 - along) / 3;
        volume += v / 3;
      }
    }
  }
};

using Adjoint = error_detail::VertexAdjoint<Vec3>;

Gradient pulled_back(const TetMesh& mesh, const VertexScheme& dec, const Adjoint& by, Executor* executor) {
  Gradient gradient(mesh.n_vertices());
  for (const VertexId v : mesh.vertices()) gradient[v] = {by.vertex[v].x, by.vertex[v].y, by.vertex[v].z, 0};
  const auto by_parts = [&](TetId t) {
    TetParts slopes = {};
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [i, j] = ends(mesh, t, e);
      const double volume = dec.parts[t].edges[e].volume, along = dec.parts[t].along[e],
                   square = dec.parts[t].square[e];
      const double by_star1 = by.star1[dec.edges_of[t][e]], at_i = by.star0[i] / 3, at_j = by.star0[j] / 3;
      slopes.edges[e].volume = by_star1 / square + at_i * along + at_j * (1 - along);
      slopes.along[e] = volume * (at_i - at_j);
      slopes.square[e] = -by_star1 * volume / (square * square);
    }
    return slopes;
  };
  add_pulled_back(gradient, mesh, by_parts, executor);
  return gradient;
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
                                           Executor* executor) const override {
    const auto kept = kept_.take();
    kept->edges.find(mesh);
    const VertexScheme dec(mesh, kept->edges, executor);
    std::vector<bool> given;
    for (const std::uint8_t on_boundary : boundary_vertices(mesh)) given.push_back(on_boundary != 0);
    const PointSystem points = vertex_system(dec, given);
    if (!kept->matrix.factor(points.n_unknowns(), points.lower())) return {};
    if (gradients != nullptr) gradients->clear();
    std::vector<double> sums;
    const FieldFrame frame = field_frame(mesh);
    for (const auto& fields :
         {error_detail::waves_of<Vec3>(frame, dec.volume, error_detail::kWaveNumbers, kBlocksOfNumber),
          error_detail::fronts_of<Vec3>(frame, dec.volume)}) {
      std::optional<Adjoint> by;
      if (gradients != nullptr) by.emplace(mesh.n_vertices(), dec.edges.size());
      sums.push_back(sum_over(fields, by ? &*by : nullptr, executor, [&](const Fields& block, Adjoint* part) {
        return vertex_error(mesh, dec, {points, kept->matrix}, block, part);
      }));
      if (by) gradients->push_back(pulled_back(mesh, dec, *by, executor));
    }
    return sums;
  }

 private:
  struct Kept {
    Edges edges;
    Cholesky matrix;  // with its order of elimination
  };
  mutable Lender<Kept> kept_;
};

}  // namespace

std::shared_ptr<const DiscretizationError> make_discretization_error(Scheme scheme) {
  if (scheme == Scheme::vertex || scheme == Scheme::all) return std::make_shared<TetVertexError>();
  if (scheme == Scheme::cell) return std::make_shared<TetCellError>();
  return nullptr;
}

}  // namespace temper::tets
