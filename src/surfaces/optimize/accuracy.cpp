// A descent of this energy lowers the errors of a scheme on a surface.
#include "surfaces/optimize/accuracy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/portable_log.hpp"
#include "energy/accuracy_energy.hpp"
#include "surfaces/optimize/triangle_side.hpp"

namespace temper::surfaces {
namespace {

constexpr int kSmoothings = 10;
// Smaller margins are not certain in doubles.
constexpr double kLeastMargin = 1e-9;

/// The edges of equilateral triangles of the mean area around each vertex, averaged with the neighbors'.
IdVector<VertexId, double> local_sizes(const Draft& draft) {
  IdVector<VertexId, double> sizes(draft.points.size(), 0.0), counts(draft.points.size(), 0.0);
  for (const std::array<VertexId, 3>& t : draft.triangles) {
    const auto& [a, b, c] = t;
    const double twice_area =
        length(normal_of(draft.points[a].position(), draft.points[b].position(), draft.points[c].position()));
    for (const VertexId v : t) sizes[v] += twice_area, counts[v] += 1;
  }
  for (const VertexId v : IdRange<VertexId>(sizes.size())) {
    if (counts[v] > 0) sizes[v] = std::sqrt(2 / std::numbers::sqrt3 * sizes[v] / counts[v]);
  }
  for (int k = 0; k < kSmoothings; ++k) {
    IdVector<VertexId, double> sums(sizes.size(), 0.0);
    for (const auto& [a, b, c] : draft.triangles) {
      const double mean = (sizes[a] + sizes[b] + sizes[c]) / 3;
      for (const VertexId v : {a, b, c}) sums[v] += mean;
    }
    for (const VertexId v : IdRange<VertexId>(sizes.size())) {
      if (counts[v] > 0) sizes[v] = sums[v] / counts[v];
    }
  }
  return sizes;
}

double margin_of(const std::array<WeightedPoint, 3>& triangle) {
  double least = kInfinity;
  for (std::size_t c = 0; c < 3; ++c) {
    const TriangleSide side(triangle, c);
    if (side.s2 == 0) return 0;
    least = std::min({least, side.height, 0.5 * (1 - std::abs(side.dw) / side.l2)});
  }
  return least;
}

}  // namespace

DraftAccuracy::DraftAccuracy(const Draft& draft, const AccuracyModel& model)
    : model_(model), sizes_(local_sizes(draft)), edges_(edges_of(draft.triangles)) {
  for (std::size_t t = 0; t < draft.triangles.size(); ++t) {
    const auto [p, q, r] = draft.corners(t);
    const double now = margin_of({p, q, r});
    TriangleBarrier<double> barrier = {0, 0};
    if (now > kLeastMargin && is_well_centered(p, q, r)) {
      const auto& [a, b, c] = draft.triangles[t];
      barrier.floor = now > model.margin ? model.margin : kept_margin(now, model.margin);
      barrier.factor = barrier_factor(model, sizes_[a], sizes_[b], sizes_[c], barrier.floor);
    }
    barriers_.push_back(barrier);
  }
}

double DraftAccuracy::room(const Draft& draft, std::size_t triangle) const {
  return margin_of(draft.corners(triangle)) - barriers_[triangle].floor;
}

double DraftAccuracy::value(const Draft& draft, std::vector<CornerSlopes>& slopes) const {
  slopes.assign(draft.triangles.size(), {});
  double sum = 0;
  for (const DraftEdge& e : edges_) {
    const std::size_t n_sides = e.is_boundary ? 1 : 2;
    const std::array<TriangleSide, 2> sides = {TriangleSide(draft.corners(e.sides[0].triangle), e.sides[0].corner),
                                               TriangleSide(draft.corners(e.sides[1].triangle), e.sides[1].corner)};
    const std::array<VertexId, 3>& first = draft.triangles[e.sides[0].triangle];
    AccuracyEdge<double> edge = {};
    edge.scale = edge_scale(sizes_[first[sides[0].i]], sizes_[first[sides[0].j]]);
    edge.height = e.is_boundary ? model_.boundary_height : model_.height;
    edge.l2 = sides[0].l2, edge.inverse_l2 = 1 / edge.l2, edge.dw = sides[0].dw;
    edge.left = sides[0].height * edge.l2, edge.right = e.is_boundary ? 0 : sides[1].height * edge.l2;
    sum += edge_value(model_, edge);
    EdgeSlopes<double> slopes_of_edge = edge_slopes(model_, edge);
    const std::array<EdgeSlopes<double>::Side*, 2> of = {&slopes_of_edge.left, &slopes_of_edge.right};
    for (std::size_t k = 0; k < n_sides; ++k) {
      const TriangleBarrier<double>& barrier = barriers_[e.sides[k].triangle];
      if (!(barrier.floor > 0)) continue;
      const double g = sides[k].height * edge.l2, y = edge.dw * edge.inverse_l2;
      sum -= barrier.factor *
             (portable_log(sides[k].height - barrier.floor) + 0.5 * portable_log(crossing_room(y, barrier.floor)));
      add_height_barrier(barrier, edge.l2, edge.inverse_l2, g, slopes_of_edge, *of[k]);
      add_crossing_barrier(barrier, edge.l2, edge.inverse_l2, edge.dw, slopes_of_edge);
    }
    for (std::size_t k = 0; k < n_sides; ++k) {
      SideSlopes by = sides[k].slopes_of_height(of[k]->g * edge.l2);
      by.l2 += of[k]->g * sides[k].height;  // g = ℓ² h/ℓ
      if (k == 0) by.l2 += slopes_of_edge.l, by.i += slopes_of_edge.dw, by.j -= slopes_of_edge.dw;
      sides[k].add(by, slopes[e.sides[k].triangle]);
    }
  }
  return sum;
}

}  // namespace temper::surfaces
