#include "optimize/step/removal.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <ranges>

#include "base/assert.hpp"
#include "energy/edge_kernels.hpp"
#include "energy/patch.hpp"
#include "geometry/triangle_kernel.hpp"
#include "optimize/step/line_search.hpp"
#include "temper/detail/geometry.hpp"

namespace temper {
namespace {

using Corners = std::array<VertexId, 3>;

/// The mesh's halfedge on the near side of link edge a → b.
HalfedgeId link_halfedge(const Mesh& mesh, const RemovalPlan& plan, VertexId a, VertexId b) {
  for (const HalfedgeId h : mesh.star(plan.vertex)) {
    const HalfedgeId link = Mesh::next(h);
    if (mesh.origin(link) == a && mesh.target(link) == b) return link;
  }
  return {};
}

/// The corner of the plan's triangle that has the edge b → a, or an invalid one.
VertexId apex_across(const RemovalPlan& plan, VertexId a, VertexId b) {
  for (const Corners& t : plan.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (t[k] == b && t[(k + 1) % 3] == a) return t[(k + 2) % 3];
    }
  }
  return {};
}

/// The triangle across the edge a → b of a new triangle.
struct Across {
  VertexId apex;  ///< invalid on the boundary
  bool is_link = false, constrained = false;
};
Across across(const Mesh& mesh, const RemovalPlan& plan, VertexId a, VertexId b) {
  const VertexId inner = apex_across(plan, a, b);
  if (inner.valid()) return {inner, false, false};
  const HalfedgeId h = link_halfedge(mesh, plan, a, b);
  if (!h.valid() || mesh.is_boundary(h)) return {{}, true, true};
  return {mesh.opposite(mesh.twin(h)), true, mesh.is_constrained(h)};
}

/// An edge as seen from its triangle, h measured towards the third corner, and what the triangle counts.
struct EdgeOfTriangle {
  EdgeShape edge;
  double per_area;
};
EdgeOfTriangle edge_of_triangle(const Space& space, const HotKernel& kernel, const WeightedPoint& a,
                                const WeightedPoint& b, const WeightedPoint& c) {
  const TriangleShape s = triangle_shape(space, a, b, c);
  EdgeShape e = s.edges[0];
  if (s.doubled_area < 0) e.g = -e.g;
  return {e, kernel.per_area(s.doubled_area)};
}

/// The point across an edge, and whether its triangle stays while the one on this side is replaced.
struct Beyond {
  std::optional<WeightedPoint> point;  ///< none on the boundary
  bool stays = false;
};

/// The share of triangle abc in the energy of its edge ab. The triangle beyond keeps its shape when it stays, but for
/// E_T the sign of its share may change: then it is added, as in patch_energy.
double hot_edge(const Space& space, const EnergyModel& model, const HotKernel& kernel,
                const std::array<WeightedPoint, 3>& abc, const Beyond& beyond) {
  const auto& [a, b, c] = abc;
  const auto [edge, per_area] = edge_of_triangle(space, kernel, a, b, c);
  const auto [outer, per_outer_area] =
      beyond.point ? edge_of_triangle(space, kernel, b, a, *beyond.point) : EdgeOfTriangle{{edge.l2, edge.dw, 0}, 1};
  const double factor = hot_factor(model, edge.g, outer.g, !beyond.point);
  const bool shares = energy_info(model.kind).signed_by_dual && beyond.stays && beyond.point;
  return factor * (kernel.value(edge) * per_area) + (shares ? factor * (kernel.value(outer) * per_outer_area) : 0);
}

double hot_edges(const Mesh& mesh, const EnergyModel& model, const HotKernel& kernel, const RemovalPlan& plan,
                 const Corners& t) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const VertexId a = t[k], b = t[(k + 1) % 3];
    const Across side = across(mesh, plan, a, b);
    const std::array<WeightedPoint, 3> abc = mesh.points(a, b, t[(k + 2) % 3]);
    const Beyond beyond = side.apex.valid() ? Beyond{mesh.point(side.apex, abc[0]), side.is_link} : Beyond{};
    sum += hot_edge(mesh.space(), model, kernel, abc, beyond);
  }
  return sum;
}

/// The triangle across h, a side of a triangle that an insertion replaces.
Beyond beyond_replaced(const Mesh& mesh, const InsertionPlan& plan, HalfedgeId h, const WeightedPoint& near) {
  const HalfedgeId g = mesh.twin(h);
  if (!g.valid()) return {};
  const bool stays = std::find(plan.cavity.begin(), plan.cavity.end(), Mesh::triangle(g)) == plan.cavity.end();
  return {mesh.point(mesh.opposite(g), near), stays};
}

/// The edges of a triangle that an insertion replaces.
double replaced_edges(const Mesh& mesh, const EnergyModel& model, const HotKernel& kernel, const InsertionPlan& plan,
                      TriangleId t) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(t, k);
    const std::array<WeightedPoint, 3> abc = mesh.points(mesh.origin(h), mesh.target(h), mesh.opposite(h));
    sum += hot_edge(mesh.space(), model, kernel, abc, beyond_replaced(mesh, plan, h, abc[0]));
  }
  return sum;
}

/// The edges of the new triangle over rim[i].
double new_edges(const Mesh& mesh, const EnergyModel& model, const HotKernel& kernel, const InsertionPlan& plan,
                 std::size_t i) {
  const std::size_t n = plan.link.size();
  const bool open = n > plan.rim.size();
  const auto point = [&](std::size_t j) { return mesh.point(plan.link[j % n], plan.point); };
  const WeightedPoint v = plan.point, a = point(i), b = point(i + 1);
  Beyond outside = beyond_replaced(mesh, plan, plan.rim[i], a);
  outside.stays = true;
  const Beyond after = open && i + 2 == n ? Beyond{} : Beyond{point(i + 2), false};
  const Beyond before = open && i == 0 ? Beyond{} : Beyond{point(i + n - 1), false};
  return hot_edge(mesh.space(), model, kernel, {a, b, v}, outside) +
         hot_edge(mesh.space(), model, kernel, {b, v, a}, after) +
         hot_edge(mesh.space(), model, kernel, {v, a, b}, before);
}

/// The energy of an equilateral triangle of that doubled area, weights zero.
double equilateral_energy(const EnergyModel& model, double doubled_area) {
  const double side = std::sqrt(2 * std::abs(doubled_area) / std::sqrt(3.0));
  return triangle_energy(model, {0, 0, 0}, {side, 0, 0}, {side / 2, side * std::sqrt(3.0) / 2, 0});
}

/// Triangles, and the energy of as many equilateral ones of the same areas.
struct Ideal {
  std::size_t n = 0;
  double energy = 0;
  void add(const EnergyModel& model, const Space& space, const WeightedPoint& a, const WeightedPoint& b,
           const WeightedPoint& c) {
    ++n;
    const double area = space.is_plane() ? doubled_area(a.position(), b.position(), c.position())
                                         : triangle_shape(space, a, b, c).doubled_area;
    energy += equilateral_energy(model, area);
  }
};

double measured(double energy, const Ideal& ideal, RemovalMeasure measure) {
  switch (measure) {
    case RemovalMeasure::sum:
      return energy;
    case RemovalMeasure::mean:
      return energy / static_cast<double>(ideal.n);
    case RemovalMeasure::excess:
      return energy - ideal.energy;
  }
  return energy;
}

/// The point of least E_c that three line searches find.
WeightedPoint best_position(const Patch& patch, const EnergyModel& model, WeightedPoint p,
                            const PaperSwitches& switches) {
  const Freedom plane{2, {{{1, 0, 0}, {0, 1, 0}, {}}}};
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

/// Sums over triangles what each has of a barrier, or of a HOT energy, which asks for its kernel.
template <class Triangles, class OfBarrier, class OfHot>
double sum_of(const EnergyModel& model, const Triangles& triangles, OfBarrier&& of_barrier, OfHot&& of_hot) {
  return with_kernel(model, [&](const auto& kernel) {
    double sum = 0;
    for (const auto& t : triangles) {
      if constexpr (std::decay_t<decltype(kernel)>::kBarrier) {
        sum += of_barrier(t);
      } else {
        sum += of_hot(kernel, t);
      }
    }
    return sum;
  });
}

}  // namespace

double cavity_energy(const Mesh& mesh, const EnergyModel& model, const RemovalPlan& plan) {
  TEMPER_ASSERT(!mesh.is_boundary(plan.vertex));
  return sum_of(
      model, plan.triangles,
      [&](const Corners& t) {
        const auto [a, b, c] = mesh.points(t[0], t[1], t[2]);
        return triangle_energy(model, a, b, c, mesh.space());
      },
      [&](const HotKernel& kernel, const Corners& t) { return hot_edges(mesh, model, kernel, plan, t); });
}

double insertion_energy(const Mesh& mesh, const EnergyModel& model, const InsertionPlan& plan) {
  return sum_of(
      model, std::views::iota(std::size_t{0}, plan.rim.size()),
      [&](std::size_t i) {
        const auto point = [&](std::size_t k) { return mesh.point(plan.link[k % plan.link.size()], plan.point); };
        return triangle_energy(model, plan.point, point(i), point(i + 1), mesh.space());
      },
      [&](const HotKernel& kernel, std::size_t i) { return new_edges(mesh, model, kernel, plan, i); });
}

double replaced_energy(const Mesh& mesh, const EnergyModel& model, const InsertionPlan& plan) {
  return sum_of(
      model, plan.cavity,
      [&](TriangleId t) {
        const auto [a, b, c] = mesh.points(t);
        return triangle_energy(model, a, b, c, mesh.space());
      },
      [&](const HotKernel& kernel, TriangleId t) { return replaced_edges(mesh, model, kernel, plan, t); });
}

bool is_regular(const Mesh& mesh, const RemovalPlan& plan) {
  return std::all_of(plan.triangles.begin(), plan.triangles.end(), [&](const Corners& t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Across beyond = across(mesh, plan, t[k], t[(k + 1) % 3]);
      if (!beyond.apex.valid() || beyond.constrained) continue;
      const auto [a, b, c] = mesh.points(t[k], t[(k + 1) % 3], t[(k + 2) % 3]);
      const Sign conflict = power_test(mesh.space(), a, b, c, mesh.point(beyond.apex, a));
      if (conflict == Sign::positive) return false;
    }
    return true;
  });
}

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

bool PatchComparison::better_without(double margin) const {
  return without < with - margin * std::abs(with) && std::isfinite(without);
}

bool PatchComparison::better_with(double margin) const { return PatchComparison{without, with}.better_without(margin); }

PatchComparison compare_patch(const Mesh& mesh, const Patch& patch, const EnergyModel& model, const RemovalPlan& plan,
                              RemovalMeasure measure) {
  const WeightedPoint p = mesh.point(patch.center);
  Ideal with, without;
  for (std::size_t i = 0; i < patch.size(); ++i) with.add(model, mesh.space(), p, patch.q(i), patch.r(i));
  for (const auto& [i, j, k] : plan.triangles) {
    const auto [a, b, c] = mesh.points(i, j, k);
    without.add(model, mesh.space(), a, b, c);
  }
  return {measured(patch_energy(patch, model, p), with, measure),
          measured(cavity_energy(mesh, model, plan), without, measure)};
}

PatchComparison compare_patch(const Mesh& mesh, const EnergyModel& model, const InsertionPlan& plan,
                              RemovalMeasure measure) {
  Ideal with, without;
  for (std::size_t i = 0; i < plan.rim.size(); ++i) {
    with.add(model, mesh.space(), plan.point, mesh.point(plan.link[i], plan.point),
             mesh.point(plan.link[(i + 1) % plan.link.size()], plan.point));
  }
  for (const TriangleId t : plan.cavity) {
    const auto [a, b, c] = mesh.points(t);
    without.add(model, mesh.space(), a, b, c);
  }
  return {measured(insertion_energy(mesh, model, plan), with, measure),
          measured(replaced_energy(mesh, model, plan), without, measure)};
}

}  // namespace temper
