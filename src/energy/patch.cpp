// Patch energies. Barriers are sums over triangles; the HOT energies carry a factor per edge that looks at
// both its triangles (sign of the dual of E_T) and at the boundary.
#include "energy/patch.hpp"

#include <cmath>

#include "base/sum.hpp"

namespace temper {
namespace {

/// HOT measures h towards the third corner: the sign of the left-hand height turns with the triangle.
double same_side(double g, double doubled_area) { return doubled_area < 0 ? -g : g; }

double outer_height(const Mesh& mesh, HalfedgeId h) {
  const HalfedgeId other = mesh.twin(h);
  if (!other.valid()) return 0;
  const TriangleShape s =
      triangle_shape(mesh.point(mesh.origin(other)), mesh.point(mesh.target(other)), mesh.point(mesh.opposite(other)));
  return same_side(s.edges[0].g, s.doubled_area);
}

/// Adds factor × the edge term of a link edge: only g depends on the center.
[[gnu::always_inline]] inline void add_term(VertexDerivatives& sum, const EdgeTerm& t, double factor, const Jet& g) {
  const double f_g = factor * t.f_g, f_gg = factor * t.f_gg;
  const auto& [gx, gy, gw] = g.gradient;
  sum.gradient[0] += f_g * gx;
  sum.gradient[1] += f_g * gy;
  sum.gradient[2] += f_g * gw;
  sum.hessian[0] += f_gg * gx * gx + f_g * g.hessian[0];
  sum.hessian[1] += f_gg * gx * gy + f_g * g.hessian[1];
  sum.hessian[2] += f_gg * gx * gw + f_g * g.hessian[2];
  sum.hessian[3] += f_gg * gy * gy + f_g * g.hessian[3];
  sum.hessian[4] += f_gg * gy * gw + f_g * g.hessian[4];
  sum.hessian[5] += f_gg * gw * gw;
}

/// The same for a spoke, whose ℓ² has gradient −2e (e from the center to the link) and whose w has (0, 0, 1).
[[gnu::always_inline]] inline void add_spoke_term(VertexDerivatives& sum, const EdgeTerm& t, double factor,
                                                  const Jet& g, Vec2 e) {
  add_term(sum, t, factor, g);
  const double lx = -2 * e.x, ly = -2 * e.y;
  const auto& [gx, gy, gw] = g.gradient;
  const double f_l = factor * t.f_l, f_w = factor * t.f_w, f_ll = factor * t.f_ll, f_lw = factor * t.f_lw;
  const double f_lg = factor * t.f_lg, f_ww = factor * t.f_ww, f_wg = factor * t.f_wg;
  sum.gradient[0] += f_l * lx;
  sum.gradient[1] += f_l * ly;
  sum.gradient[2] += f_w;
  sum.hessian[0] += f_ll * lx * lx + 2 * f_lg * lx * gx + 2 * f_l;
  sum.hessian[1] += f_ll * lx * ly + f_lg * (lx * gy + ly * gx);
  sum.hessian[2] += f_lw * lx + f_lg * lx * gw + f_wg * gx;
  sum.hessian[3] += f_ll * ly * ly + 2 * f_lg * ly * gy + 2 * f_l;
  sum.hessian[4] += f_lw * ly + f_lg * ly * gw + f_wg * gy;
  sum.hessian[5] += f_ww + 2 * f_wg * gw;
}

template <class Kernel>
double barrier_triangle(const Kernel& kernel, const TriangleShape& s) {
  return kernel.value(s.edges[0]) + kernel.value(s.edges[1]) + kernel.value(s.edges[2]);
}

template <class Kernel>
double barrier_value(const Patch& patch, const Kernel& kernel, const WeightedPoint& p) {
  double sum = 0;
  for (std::size_t i = 0; i < patch.size(); ++i) {
    const TriangleShape s = triangle_shape(p, patch.q(i), patch.r(i));
    if (!(s.doubled_area > 0)) return kInfinity;
    sum += barrier_triangle(kernel, s);
  }
  return sum;
}

/// A barrier is positive and finite exactly in its domain; outside, the formula gives a negative number, ∞ or NaN.
bool is_inside(const EdgeTerm& t) { return t.f > 0 && t.f < kInfinity; }

template <class Kernel>
VertexDerivatives barrier_derivatives(const Patch& patch, const Kernel& kernel, const WeightedPoint& p) {
  VertexDerivatives sum;
  for (std::size_t i = 0; i < patch.size(); ++i) {
    const TriangleJet jet = triangle_jet(p, patch.q(i), patch.r(i));
    const auto& [pq, qr, rp] = jet.shape.edges;
    const EdgeTerm t_pq = kernel.term(pq), t_qr = kernel.term(qr), t_rp = kernel.term(rp);
    if (!(jet.shape.doubled_area > 0 && is_inside(t_pq) && is_inside(t_qr) && is_inside(t_rp))) {
      VertexDerivatives outside;
      outside.value = kInfinity;
      return outside;
    }
    sum.value += t_pq.f + t_qr.f + t_rp.f;
    add_spoke_term(sum, t_pq, 1, jet.g[0], jet.a);
    add_term(sum, t_qr, 1, jet.g[1]);
    add_spoke_term(sum, t_rp, 1, jet.g[2], jet.b);
  }
  sum.feasible = true;
  return sum;
}

/// Same-side heights of a triangle's three edges: pq, qr, rp.
struct Heights {
  std::array<double, 3> g;
};

Heights heights(const TriangleShape& s) {
  return {{same_side(s.edges[0].g, s.doubled_area), same_side(s.edges[1].g, s.doubled_area),
           same_side(s.edges[2].g, s.doubled_area)}};
}

/// Signs and boundary factors of a patch's edges: each spoke is shared by the triangles before and after it.
class HotFactors {
 public:
  HotFactors(const Patch& patch, const EnergyModel& model, const WeightedPoint& p)
      : patch_(patch), model_(model), p_(p), last_(at(patch.size() - 1)), here_(at(0)), first_(here_) {}

  /// Factors of pq, qr, rp of triangle i; call with i = 0, 1, … in order.
  std::array<double, 3> triangle(std::size_t i) {
    const std::size_t n = patch_.size();
    const bool first_open = !patch_.closed && i == 0, last_open = !patch_.closed && i + 1 == n;
    const Heights after = i + 1 < n ? at(i + 1) : first_;
    const double before_g = first_open ? 0 : last_.g[2];
    const double after_g = last_open ? 0 : after.g[0];
    const std::array<double, 3> factors = {
        hot_factor(model_, here_.g[0], before_g, first_open),
        hot_factor(model_, here_.g[1], patch_.outer_g[i], patch_.link_boundary[i] != 0),
        hot_factor(model_, here_.g[2], after_g, last_open)};
    last_ = here_;
    here_ = after;
    return factors;
  }

 private:
  [[nodiscard]] Heights at(std::size_t i) const { return heights(triangle_shape(p_, patch_.q(i), patch_.r(i))); }

  const Patch& patch_;
  const EnergyModel& model_;
  const WeightedPoint& p_;
  Heights last_, here_, first_;
};

/// The outer triangle's share of link edge i, whose sign may depend on the center (E_T).
double outer_share(const Patch& patch, const EnergyModel& model, const HotKernel& kernel, std::size_t i,
                   const EdgeShape& link, double factor) {
  if (model.kind != EnergyKind::T || patch.link_boundary[i] != 0) return 0;
  return factor * kernel.value({link.l2, link.dw, patch.outer_g[i]});
}

double hot_value(const Patch& patch, const EnergyModel& model, const HotKernel& kernel, const WeightedPoint& p) {
  HotFactors factors(patch, model, p);
  double sum = 0;
  for (std::size_t i = 0; i < patch.size(); ++i) {
    const TriangleShape s = triangle_shape(p, patch.q(i), patch.r(i));
    if (s.doubled_area == 0) return kInfinity;
    const auto factor = factors.triangle(i);
    const double orientation = s.doubled_area < 0 ? -1 : 1;
    for (std::size_t k = 0; k < 3; ++k) sum += orientation * factor[k] * kernel.value(s.edges[k]);
    sum += outer_share(patch, model, kernel, i, s.edges[1], factor[1]);
  }
  return sum;
}

VertexDerivatives hot_derivatives(const Patch& patch, const EnergyModel& model, const HotKernel& kernel,
                                  const WeightedPoint& p) {
  HotFactors factors(patch, model, p);
  VertexDerivatives sum;
  for (std::size_t i = 0; i < patch.size(); ++i) {
    const TriangleJet jet = triangle_jet(p, patch.q(i), patch.r(i));
    const TriangleShape& s = jet.shape;
    if (s.doubled_area == 0) {
      VertexDerivatives outside;
      outside.value = kInfinity;
      return outside;
    }
    const auto factor = factors.triangle(i);
    const double orientation = s.doubled_area < 0 ? -1 : 1;
    const EdgeTerm t_pq = kernel.term(s.edges[0]), t_qr = kernel.term(s.edges[1]), t_rp = kernel.term(s.edges[2]);
    sum.value += orientation * (factor[0] * t_pq.f + factor[1] * t_qr.f + factor[2] * t_rp.f) +
                 outer_share(patch, model, kernel, i, s.edges[1], factor[1]);
    add_spoke_term(sum, t_pq, orientation * factor[0], jet.g[0], jet.a);
    add_term(sum, t_qr, orientation * factor[1], jet.g[1]);
    add_spoke_term(sum, t_rp, orientation * factor[2], jet.g[2], jet.b);
  }
  sum.feasible = true;
  return sum;
}

/// One edge with both its triangles, for the HOT energies.
double full_edge_energy(const Mesh& mesh, const EnergyModel& model, const HotKernel& kernel, HalfedgeId h) {
  const TriangleShape s =
      triangle_shape(mesh.point(mesh.origin(h)), mesh.point(mesh.target(h)), mesh.point(mesh.opposite(h)));
  EdgeShape edge = s.edges[0];
  edge.g = same_side(edge.g, s.doubled_area);
  const double outer = outer_height(mesh, h);
  const double factor = hot_factor(model, edge.g, outer, mesh.is_boundary(h));
  return factor * (kernel.value(edge) + kernel.value({edge.l2, edge.dw, outer}));
}

}  // namespace

double hot_factor(const EnergyModel& model, double g, double g_other, bool boundary) {
  const auto sign = [](double x) { return x < 0 ? -1.0 : 1.0; };
  if (boundary) {
    if (model.kind == EnergyKind::F && model.boundary == BoundaryTreatment::as_is) return 1;
    if (model.kind == EnergyKind::F && model.boundary == BoundaryTreatment::mirrored) return 2;
    return sign(g);
  }
  return model.kind == EnergyKind::T ? sign(g + g_other) : 1;
}

void gather_patch(const Mesh& mesh, VertexId v, bool with_outer, Patch& patch) {
  patch.center = v;
  patch.link.clear();
  patch.link_vertex.clear();
  patch.spoke.clear();
  patch.outer_g.clear();
  patch.link_boundary.clear();
  const HalfedgeId first = mesh.outgoing(v);
  HalfedgeId h = first;
  HalfedgeId last = first;
  do {
    patch.spoke.push_back(h);
    patch.link_vertex.push_back(mesh.target(h));
    patch.link.push_back(mesh.point(mesh.target(h)));
    if (with_outer) {
      patch.outer_g.push_back(outer_height(mesh, Mesh::next(h)));
      patch.link_boundary.push_back(mesh.is_boundary(Mesh::next(h)) ? 1 : 0);
    }
    last = h;
    h = mesh.rotate(h);
  } while (h.valid() && h != first);
  patch.closed = h.valid();
  if (!patch.closed) {
    patch.link_vertex.push_back(mesh.opposite(last));
    patch.link.push_back(mesh.point(mesh.opposite(last)));
  }
}

double patch_energy(const Patch& patch, const EnergyModel& model, const WeightedPoint& p) {
  return with_kernel(model, [&](const auto& kernel) {
    if constexpr (std::decay_t<decltype(kernel)>::kBarrier) {
      return barrier_value(patch, kernel, p);
    } else {
      return hot_value(patch, model, kernel, p);
    }
  });
}

VertexDerivatives patch_derivatives(const Patch& patch, const EnergyModel& model, const WeightedPoint& p) {
  return with_kernel(model, [&](const auto& kernel) {
    if constexpr (std::decay_t<decltype(kernel)>::kBarrier) {
      return barrier_derivatives(patch, kernel, p);
    } else {
      return hot_derivatives(patch, model, kernel, p);
    }
  });
}

double flip_energy(const Mesh& mesh, const EnergyModel& model, HalfedgeId h) {
  const HalfedgeId t = mesh.twin(h);
  return with_kernel(model, [&](const auto& kernel) {
    if constexpr (std::decay_t<decltype(kernel)>::kBarrier) {
      const WeightedPoint a = mesh.point(mesh.origin(h)), b = mesh.point(mesh.target(h));
      return barrier_triangle(kernel, triangle_shape(a, b, mesh.point(mesh.opposite(h)))) +
             barrier_triangle(kernel, triangle_shape(b, a, mesh.point(mesh.opposite(t))));
    } else {
      double sum = full_edge_energy(mesh, model, kernel, h);
      for (const HalfedgeId outer : {Mesh::next(h), Mesh::prev(h), Mesh::next(t), Mesh::prev(t)}) {
        sum += full_edge_energy(mesh, model, kernel, outer);
      }
      return sum;
    }
  });
}

double triangle_energy(const EnergyModel& model, const WeightedPoint& p, const WeightedPoint& q,
                       const WeightedPoint& r) {
  const TriangleShape s = triangle_shape(p, q, r);
  if (s.doubled_area == 0) return kInfinity;
  return with_kernel(model, [&](const auto& kernel) {
    if constexpr (std::decay_t<decltype(kernel)>::kBarrier) {
      return barrier_triangle(kernel, s);
    } else {
      double sum = 0;
      for (EdgeShape edge : s.edges) {
        edge.g = same_side(edge.g, s.doubled_area);
        sum += hot_factor(model, edge.g, 0, true) * kernel.value(edge);
      }
      return sum;
    }
  });
}

double total_energy(const Mesh& mesh, const EnergyModel& model, Executor* executor) {
  return with_kernel(model, [&](const auto& kernel) {
    return blockwise_sum(mesh.n_triangles(), executor, [&](std::size_t i) {
      const TriangleId t(i);
      if constexpr (std::decay_t<decltype(kernel)>::kBarrier) {
        const auto [p, q, r] = mesh.corners(t);
        return barrier_triangle(kernel, triangle_shape(mesh.point(p), mesh.point(q), mesh.point(r)));
      } else {
        double sum = 0;
        for (int k = 0; k < 3; ++k) {
          const HalfedgeId h = Mesh::halfedge(t, k);
          if (mesh.is_edge_representative(h)) sum += full_edge_energy(mesh, model, kernel, h);
        }
        return sum;
      }
    });
  });
}

VertexDerivatives vertex_energy(const Mesh& mesh, const EnergyModel& model, VertexId v) {
  Patch patch;
  gather_patch(mesh, v, needs_outer(model.kind), patch);
  return patch_derivatives(patch, model, mesh.point(v));
}

}  // namespace temper
