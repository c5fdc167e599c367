#include "optimize/cavity.hpp"

#include <algorithm>

#include "energy/edge_kernels.hpp"
#include "energy/patch.hpp"
#include "temper/geometry.hpp"

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

/// What lies across the edge a → b of a new triangle.
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

/// An edge as seen from its triangle, h measured towards the third corner.
EdgeShape edge_shape(const Mesh& mesh, VertexId a, VertexId b, VertexId c) {
  const TriangleShape s = triangle_shape(mesh.point(a), mesh.point(b), mesh.point(c));
  EdgeShape e = s.edges[0];
  if (s.doubled_area < 0) e.g = -e.g;
  return e;
}

double hot_edges(const Mesh& mesh, const EnergyModel& model, const HotKernel& kernel, const RemovalPlan& plan,
                 const Corners& t) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const VertexId a = t[k], b = t[(k + 1) % 3];
    const EdgeShape edge = edge_shape(mesh, a, b, t[(k + 2) % 3]);
    const Across beyond = across(mesh, plan, a, b);
    const double outer_g = beyond.apex.valid() ? edge_shape(mesh, b, a, beyond.apex).g : 0;
    const double factor = hot_factor(model, edge.g, outer_g, !beyond.apex.valid());
    sum += factor * kernel.value(edge);
    // The triangle beyond stays, but for E_T the sign of its share may change: as in patch_energy.
    const bool shares = model.kind == EnergyKind::T && beyond.is_link && beyond.apex.valid();
    if (shares) sum += factor * kernel.value({edge.l2, edge.dw, outer_g});
  }
  return sum;
}

}  // namespace

double cavity_energy(const Mesh& mesh, const EnergyModel& model, const RemovalPlan& plan) {
  return with_kernel(model, [&](const auto& kernel) {
    double sum = 0;
    for (const Corners& t : plan.triangles) {
      if constexpr (std::decay_t<decltype(kernel)>::kBarrier) {
        sum += triangle_energy(model, mesh.point(t[0]), mesh.point(t[1]), mesh.point(t[2]));
      } else {
        sum += hot_edges(mesh, model, kernel, plan, t);
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
      const Sign conflict = power_test(mesh.point(t[0]), mesh.point(t[1]), mesh.point(t[2]), mesh.point(beyond.apex));
      if (conflict == Sign::positive) return false;
    }
    return true;
  });
}

}  // namespace temper
