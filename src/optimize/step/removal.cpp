#include "optimize/step/removal.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/assert.hpp"
#include "energy/edge_kernels.hpp"
#include "energy/patch.hpp"
#include "geometry/triangle_kernel.hpp"
#include "optimize/step/descent.hpp"
#include "temper/detail/geometry.hpp"

namespace temper {
namespace {

using Corners = std::array<VertexId, 3>;

/// Returns the energy of an equilateral triangle that has this doubled area and zero weights.
double equilateral_energy(const EnergyModel& model, double doubled_area) {
  const double side = std::sqrt(2 * std::abs(doubled_area) / std::sqrt(3.0));
  return triangle_energy(model, {0, 0, 0}, {side, 0, 0}, {side / 2, side * std::sqrt(3.0) / 2, 0});
}

/// The triangles that fill a part of the mesh, now or after the commit of a plan. All others stay.
class Filling {
 public:
  /// `fresh`: the place of the vertex that a plan inserts. As a corner it is invalid.
  Filling(const Mesh& mesh, std::vector<Corners> triangles, const WeightedPoint& fresh = {})
      : mesh_(mesh), space_(mesh.space()), triangles_(std::move(triangles)), fresh_(fresh) {}

  /// Includes the edges around them, whose energy depends on them.
  [[nodiscard]] double energy(const EnergyModel& model) const {
    return with_kernel(model, [&](const auto& kernel) {
      double sum = 0;
      for (const Corners& t : triangles_) {
        if constexpr (std::decay_t<decltype(kernel)>::kBarrier) {
          const auto [a, b, c] = points(t[0], t[1], t[2]);
          sum += triangle_energy(model, a, b, c, space_);
        } else {
          sum += hot_edge(model, kernel, t, 0) + hot_edge(model, kernel, t, 1) + hot_edge(model, kernel, t, 2);
        }
      }
      return sum;
    });
  }

  /// Returns the energy in the measure by which plans are compared.
  [[nodiscard]] double measured(double energy, const EnergyModel& model, RemovalMeasure measure) const {
    if (measure == RemovalMeasure::sum) return energy;
    if (measure == RemovalMeasure::mean) return energy / static_cast<double>(triangles_.size());
    double ideal = 0;  // the energy if all triangles were equilateral, with the same areas
    for (const Corners& t : triangles_) {
      const auto [a, b, c] = points(t[0], t[1], t[2]);
      const double area = space_.is_plane() ? doubled_area(a.position(), b.position(), c.position())
                                            : triangle_shape(space_, a, b, c).doubled_area;
      ideal += equilateral_energy(model, area);
    }
    return energy - ideal;
  }

  /// Says exactly whether all their unconstrained edges are regular.
  [[nodiscard]] bool is_regular() const {
    return std::all_of(triangles_.begin(), triangles_.end(), [&](const Corners& t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Across beyond = across(t[k], t[(k + 1) % 3]);
        if (!beyond.apex.valid() || beyond.constrained) continue;
        const auto [a, b, c] = points(t[k], t[(k + 1) % 3], t[(k + 2) % 3]);
        if (power_test(space_, a, b, c, mesh_.point(beyond.apex, a)) == Sign::positive) return false;
      }
      return true;
    });
  }

 private:
  /// The triangle across the edge a → b of one of these triangles: another of them, or one that stays.
  struct Across {
    VertexId apex = {};  ///< invalid on the boundary
    bool stays = false, constrained = false;
  };
  [[nodiscard]] Across across(VertexId a, VertexId b) const {
    for (const Corners& t : triangles_) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (t[k] == b && t[(k + 1) % 3] == a) return {t[(k + 2) % 3]};
      }
    }
    const HalfedgeId h = a.valid() && b.valid() ? mesh_.find_halfedge(a, b) : HalfedgeId();
    if (!h.valid() || mesh_.is_boundary(h)) return {};
    return {mesh_.opposite(mesh_.twin(h)), true, mesh_.is_constrained(h)};
  }

  /// Returns the share of triangle t in the energy of its edge k. If the triangle beyond stays, its shape stays, too.
  /// For E_T the sign of its share may change: then that share is added, as in patch_energy.
  [[nodiscard]] double hot_edge(const EnergyModel& model, const HotKernel& kernel, const Corners& t,
                                std::size_t k) const {
    const auto [a, b, c] = points(t[k], t[(k + 1) % 3], t[(k + 2) % 3]);
    const Across beyond = across(t[k], t[(k + 1) % 3]);
    const bool inner = beyond.apex.valid();
    const auto [edge, area] = edge_in_triangle(space_, a, b, c);
    const auto [outer, outer_area] =
        inner ? edge_in_triangle(space_, b, a, mesh_.point(beyond.apex, a)) : EdgeInTriangle{{edge.l2, edge.dw, 0}, 1};
    const double factor = hot_factor(model, edge.g, outer.g, !inner);
    const double own = factor * (kernel.value(edge) * kernel.per_area(area));
    const bool shares = energy_info(model.kind).signed_by_dual && beyond.stays;
    return shares ? own + factor * (kernel.value(outer) * kernel.per_area(outer_area)) : own;
  }

  /// Returns the images of the vertices that are near the first one.
  [[nodiscard]] std::array<WeightedPoint, 3> points(VertexId a, VertexId b, VertexId c) const {
    const WeightedPoint first = a.valid() ? mesh_.point(a) : fresh_;
    const auto point = [&](VertexId v) { return v.valid() ? mesh_.point(v, first) : space_.image(fresh_, first); };
    return {first, point(b), point(c)};
  }

  const Mesh& mesh_;
  const Space& space_;
  std::vector<Corners> triangles_;
  WeightedPoint fresh_;
};

/// The triangles that an insertion makes, and the triangles that they replace.
Filling inserted(const Mesh& mesh, const InsertionPlan& plan) {
  std::vector<Corners> triangles;
  for (std::size_t i = 0; i < plan.rim.size(); ++i) {
    triangles.push_back({VertexId(), plan.link[i], plan.link[(i + 1) % plan.link.size()]});
  }
  return {mesh, std::move(triangles), plan.point};
}
Filling replaced(const Mesh& mesh, const InsertionPlan& plan) {
  std::vector<Corners> triangles;
  for (const TriangleId t : plan.cavity) triangles.push_back(mesh.corners(t));
  return {mesh, std::move(triangles)};
}

/// Returns the point with the least E_c that three line searches find.
WeightedPoint best_position(const Patch& patch, const EnergyModel& model, WeightedPoint p,
                            const PaperSwitches& switches) {
  const Dofs plane{2, {{{1, 0, 0}, {0, 1, 0}, {}}}};
  for (int i = 0; i < kPositionSearches; ++i) {
    const double energy = patch_energy(patch, model, p);
    const auto direction = steepest_descent(patch, model, p, plane, patch_radius(patch, p, switches.search_radius));
    if (!direction) break;
    const double limit = switches.inversion == Inversion::refuse ? inversion_limit(patch, p, *direction) : 1;
    const WeightedPoint there = along(patch.space, p, *direction, line_minimum(patch, model, p, *direction, limit));
    if (!(patch_energy(patch, model, there) < energy)) break;
    p = there;
  }
  return p;
}

}  // namespace

double cavity_energy(const Mesh& mesh, const EnergyModel& model, const RemovalPlan& plan) {
  TEMPER_ASSERT(!mesh.is_boundary(plan.vertex));
  return Filling(mesh, plan.triangles).energy(model);
}

double insertion_energy(const Mesh& mesh, const EnergyModel& model, const InsertionPlan& plan) {
  return inserted(mesh, plan).energy(model);
}

double replaced_energy(const Mesh& mesh, const EnergyModel& model, const InsertionPlan& plan) {
  return replaced(mesh, plan).energy(model);
}

bool is_regular(const Mesh& mesh, const RemovalPlan& plan) { return Filling(mesh, plan.triangles).is_regular(); }

double relative_lightness(const Patch& patch, const WeightedPoint& p) {
  double sum = 0;
  for (std::size_t i = 0; i < patch.link.size(); ++i) sum += patch.space.weight(patch.q(i));
  const double r = patch_radius(patch, p);
  return (sum / static_cast<double>(patch.link.size()) - patch.space.weight(p)) / (r * r);
}

bool nearly_collapses(const Patch& patch, const EnergyModel& collapse_model, const WeightedPoint& p,
                      const PaperSwitches& switches) {
  TEMPER_ASSERT(patch.closed && (!needs_outer(collapse_model.kind) || patch.outer_g.size() == patch.size()));
  const WeightedPoint best = best_position(patch, collapse_model, p, switches);
  const std::size_t n = patch.link.size();
  std::size_t nearest = 0;
  const auto between2 = [&](const WeightedPoint& a, const WeightedPoint& b) {
    return edge_measures(patch.space, a, b).l2;
  };
  const auto distance2 = [&](std::size_t i) { return between2(best, patch.q(i)); };
  for (std::size_t i = 1; i < n; ++i) {
    if (distance2(i) < distance2(nearest)) nearest = i;
  }
  const WeightedPoint q = patch.q(nearest);
  const double shorter2 =
      std::min(between2(q, patch.q((nearest + n - 1) % n)), between2(q, patch.q((nearest + 1) % n)));
  return distance2(nearest) < switches.collapse_ratio * switches.collapse_ratio * shorter2;
}

bool is_better(double energy, double now, double margin) {
  return energy < now - margin * std::abs(now) && std::isfinite(energy);
}

PatchComparison compare_patch(const Mesh& mesh, const Patch& patch, const EnergyModel& model, const RemovalPlan& plan,
                              RemovalMeasure measure) {
  std::vector<Corners> star;
  for (const HalfedgeId h : patch.spoke) star.push_back({patch.center, mesh.target(h), mesh.opposite(h)});
  const double energy = patch_energy(patch, model, mesh.point(patch.center));
  return {Filling(mesh, std::move(star)).measured(energy, model, measure),
          Filling(mesh, plan.triangles).measured(cavity_energy(mesh, model, plan), model, measure)};
}

PatchComparison compare_patch(const Mesh& mesh, const EnergyModel& model, const InsertionPlan& plan,
                              RemovalMeasure measure) {
  const Filling with = inserted(mesh, plan), without = replaced(mesh, plan);
  return {with.measured(with.energy(model), model, measure), without.measured(without.energy(model), model, measure)};
}

}  // namespace temper
