#include "optimize/step/cavity.hpp"

#include <algorithm>
#include <optional>

#include "base/assert.hpp"
#include "energy/edge_kernels.hpp"
#include "energy/patch.hpp"
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

}  // namespace

double cavity_energy(const Mesh& mesh, const EnergyModel& model, const RemovalPlan& plan) {
  TEMPER_ASSERT(!mesh.is_boundary(plan.vertex));
  return with_kernel(model, [&](const auto& kernel) {
    double sum = 0;
    for (const Corners& t : plan.triangles) {
      if constexpr (std::decay_t<decltype(kernel)>::kBarrier) {
        const auto [a, b, c] = mesh.points(t[0], t[1], t[2]);
        sum += triangle_energy(model, a, b, c, mesh.space());
      } else {
        sum += hot_edges(mesh, model, kernel, plan, t);
      }
    }
    return sum;
  });
}

double insertion_energy(const Mesh& mesh, const EnergyModel& model, const InsertionPlan& plan) {
  return with_kernel(model, [&](const auto& kernel) {
    double sum = 0;
    for (std::size_t i = 0; i < plan.rim.size(); ++i) {
      if constexpr (std::decay_t<decltype(kernel)>::kBarrier) {
        const VertexId b = plan.link[(i + 1) % plan.link.size()];
        sum += triangle_energy(model, plan.point, mesh.point(plan.link[i], plan.point), mesh.point(b, plan.point),
                               mesh.space());
      } else {
        sum += new_edges(mesh, model, kernel, plan, i);
      }
    }
    return sum;
  });
}

double replaced_energy(const Mesh& mesh, const EnergyModel& model, const InsertionPlan& plan) {
  return with_kernel(model, [&](const auto& kernel) {
    double sum = 0;
    for (const TriangleId t : plan.cavity) {
      if constexpr (std::decay_t<decltype(kernel)>::kBarrier) {
        const auto [a, b, c] = mesh.points(t);
        sum += triangle_energy(model, a, b, c, mesh.space());
      } else {
        sum += replaced_edges(mesh, model, kernel, plan, t);
      }
    }
    return sum;
  });
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

}  // namespace temper
