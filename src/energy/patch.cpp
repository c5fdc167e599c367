// Patch energies. Barriers are sums over triangles; the HOT energies carry a factor per edge that looks at
// both its triangles (sign of the dual of E_T) and at the boundary.
#include "energy/patch.hpp"

#include <algorithm>
#include <array>
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

template <class Kernel>
double barrier_triangle(const Kernel& kernel, const TriangleShape& s) {
  return kernel.value(s.edges[0]) + kernel.value(s.edges[1]) + kernel.value(s.edges[2]);
}

constexpr VertexDerivatives outside() {
  VertexDerivatives d;
  d.value = kInfinity;
  return d;
}

VertexDerivatives from_sums(const std::array<double, kStarSums>& sums) {
  VertexDerivatives d;
  d.value = sums[0];
  d.feasible = true;
  std::copy_n(sums.begin() + 1, d.gradient.size(), d.gradient.begin());
  std::copy_n(sums.begin() + 4, d.hessian.size(), d.hessian.begin());
  return d;
}

VertexDerivatives barrier_derivatives(const Patch& patch, const EdgeFormula& formula, const WeightedPoint& p) {
  std::array<double, kStarSums> sums;
  return star_kernels().barrier_derivatives(formula, patch.arrays(), p, sums.data()) ? from_sums(sums) : outside();
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
  return factor * kernel.value(EdgeShape{link.l2, link.dw, patch.outer_g[i]});
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
  const std::size_t n = patch.size();
  std::vector<double> of_edges(3 * (n + kLanes));
  const std::array factor = {of_edges.data(), of_edges.data() + n + kLanes, of_edges.data() + 2 * (n + kLanes)};
  HotFactors factors(patch, model, p);
  double outer = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const TriangleShape s = triangle_shape(p, patch.q(i), patch.r(i));
    if (s.doubled_area == 0) return outside();
    const auto signs = factors.triangle(i);
    const double orientation = s.doubled_area < 0 ? -1 : 1;
    for (std::size_t k = 0; k < 3; ++k) factor[k][i] = orientation * signs[k];
    outer += outer_share(patch, model, kernel, i, s.edges[1], signs[1]);
  }
  std::array<double, kStarSums> sums;
  star_kernels().hot_derivatives(edge_formula(model), patch.arrays(), {factor[0], factor[1], factor[2]}, p,
                                 sums.data());
  sums[0] += outer;
  return from_sums(sums);
}

/// One edge with both its triangles, for the HOT energies.
double full_edge_energy(const Mesh& mesh, const EnergyModel& model, const HotKernel& kernel, HalfedgeId h) {
  const TriangleShape s =
      triangle_shape(mesh.point(mesh.origin(h)), mesh.point(mesh.target(h)), mesh.point(mesh.opposite(h)));
  EdgeShape edge = s.edges[0];
  edge.g = same_side(edge.g, s.doubled_area);
  const double outer = outer_height(mesh, h);
  const double factor = hot_factor(model, edge.g, outer, mesh.is_boundary(h));
  return factor * (kernel.value(edge) + kernel.value(EdgeShape{edge.l2, edge.dw, outer}));
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
  patch.spoke.clear();
  patch.outer_g.clear();
  patch.link_boundary.clear();
  const auto add = [&](VertexId q) {
    const std::size_t i = patch.link.size();
    if (i + 2 + kLanes > patch.x.size()) {  // q_0 again, and what is read beyond
      for (std::vector<double>* c : {&patch.x, &patch.y, &patch.w}) c->resize(2 * (i + 2 + kLanes));
    }
    const WeightedPoint p = mesh.point(q);
    patch.x[i] = p.x, patch.y[i] = p.y, patch.w[i] = p.w;
    patch.link.push_back(q);
  };
  const HalfedgeId first = mesh.outgoing(v);
  HalfedgeId h = first;
  HalfedgeId last = first;
  do {
    patch.spoke.push_back(h);
    add(mesh.target(h));
    if (with_outer) {
      patch.outer_g.push_back(outer_height(mesh, Mesh::next(h)));
      patch.link_boundary.push_back(mesh.is_boundary(Mesh::next(h)) ? 1 : 0);
    }
    last = h;
    h = mesh.rotate(h);
  } while (h.valid() && h != first);
  patch.closed = h.valid();
  if (patch.closed) {
    const std::size_t n = patch.link.size();
    patch.x[n] = patch.x[0], patch.y[n] = patch.y[0], patch.w[n] = patch.w[0];
  } else {
    add(mesh.opposite(last));
  }
}

double patch_energy(const Patch& patch, const EnergyModel& model, const WeightedPoint& p) {
  const EdgeFormula f = edge_formula(model);
  if (f.form != EdgeFormula::Form::hot) return star_kernels().barrier_value(f, patch.arrays(), p);
  return hot_value(patch, model, HotKernel{f.alpha, f.beta}, p);
}

VertexDerivatives patch_derivatives(const Patch& patch, const EnergyModel& model, const WeightedPoint& p) {
  const EdgeFormula f = edge_formula(model);
  if (f.form != EdgeFormula::Form::hot) return barrier_derivatives(patch, f, p);
  return hot_derivatives(patch, model, HotKernel{f.alpha, f.beta}, p);
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

double total_hot_energy(const Mesh& mesh, const EnergyModel& model, Executor* executor) {
  const EdgeFormula formula = edge_formula(model);
  const HotKernel kernel{formula.alpha, formula.beta};
  return blockwise_sum(mesh.n_triangles(), executor, [&](std::size_t i) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(TriangleId(i), k);
      if (mesh.is_edge_representative(h)) sum += full_edge_energy(mesh, model, kernel, h);
    }
    return sum;
  });
}

VertexDerivatives vertex_energy(const Mesh& mesh, const EnergyModel& model, VertexId v) {
  Patch patch;
  gather_patch(mesh, v, needs_outer(model.kind), patch);
  return patch_derivatives(patch, model, mesh.point(v));
}

}  // namespace temper
