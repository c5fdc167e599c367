// Patch energies. Barriers are sums over triangles. The HOT energies carry a factor per edge, which depends on both its
// triangles (sign of the dual in E_T) and on the boundary.
#include "energy/patch.hpp"

#include <array>

namespace temper {
namespace {

/// HOT measures h towards the third corner: the sign of the left-hand height turns with the triangle.
double same_side(double g, double doubled_area) { return doubled_area < 0 ? -g : g; }

EdgeInTriangle edge_in_triangle(const Mesh& mesh, HalfedgeId h) {
  const auto [p, q, r] = mesh.points(mesh.origin(h), mesh.target(h), mesh.opposite(h));
  return edge_in_triangle(mesh.space(), p, q, r);
}

/// h ℓ = 0 on the boundary.
EdgeInTriangle beyond(const Mesh& mesh, HalfedgeId h) {
  const HalfedgeId other = mesh.twin(h);
  return other.valid() ? edge_in_triangle(mesh, other) : EdgeInTriangle{{1, 0, 0}, 1};
}

template <class Kernel>
double barrier_triangle(const Kernel& kernel, const TriangleShape& s) {
  if (!(s.doubled_area > kernel.least_area)) return kInfinity;
  return kernel.value(s.edges[0]) + kernel.value(s.edges[1]) + kernel.value(s.edges[2]);
}

VertexDerivatives from_sums(const std::array<double, kStarSums>& s) {
  return {s[0], true, {s[1], s[2], s[3]}, {s[4], s[5], s[6], s[7], s[8], s[9]}};
}

/// Room for some numbers of each triangle of a star: on the stack, except for the largest stars.
class StarScratch {
 public:
  explicit StarScratch(std::size_t triangles) {
    length_ = (triangles + kLanes - 1) / kLanes * kLanes;
    if (kArrays * length_ > here_.size()) elsewhere_.resize(kArrays * length_);
  }
  double* array(std::size_t i) { return (elsewhere_.empty() ? here_.data() : elsewhere_.data()) + i * length_; }

 private:
  static constexpr std::size_t kArrays = 10, kUsual = 24;
  std::size_t length_;
  std::array<double, kArrays * kUsual> here_;
  std::vector<double> elsewhere_;
};

/// The edges of a star in a HOT energy, and the factor of each. It has three parts: a sign that depends on both
/// triangles, the treatment of the boundary, and a sign for inverted triangles. The last makes heights on the left of
/// edges same-side heights.
class HotStar {
 public:
  HotStar(const Patch& patch, const EnergyModel& model, const EdgeFormula& formula, const WeightedPoint& p)
      : patch_(patch),
        model_(model),
        formula_(formula),
        shares_(energy_info(model.kind).signed_by_dual),
        scratch_(patch.size()) {
    for (std::size_t k = 0; k < 3; ++k) {
      edges_.g[k] = scratch_.array(k), edges_.value[k] = scratch_.array(3 + k), factor_[k] = scratch_.array(6 + k);
    }
    edges_.doubled_area = scratch_.array(9);
    star_kernels(patch.space).hot_edges(formula, patch.arrays(), p, edges_);
    for (std::size_t i = 0; i < patch.size(); ++i) {
      if (edges_.doubled_area[i] == 0) degenerate_ = true;
      for (double* g : edges_.g) g[i] = same_side(g[i], edges_.doubled_area[i]);
    }
    for (std::size_t i = 0; i < patch.size(); ++i) set_factors(i);
  }

  [[nodiscard]] bool is_degenerate() const { return degenerate_; }
  [[nodiscard]] EdgeFactors factors() const { return {factor_[0], factor_[1], factor_[2]}; }

  [[nodiscard]] double value() const {
    double sum = 0;
    for (std::size_t i = 0; i < patch_.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) sum += factor_[k][i] * edges_.value[k][i];
      sum += outer_share(i);
    }
    return sum;
  }
  /// The part of the triangles across the link: their sign may depend on the center (E_T).
  [[nodiscard]] double outer() const {
    double sum = 0;
    for (std::size_t i = 0; i < patch_.size(); ++i) sum += outer_share(i);
    return sum;
  }

 private:
  void set_factors(std::size_t i) {
    const std::size_t n = patch_.size();
    const auto& [pq, qr, rp] = edges_.g;
    const bool first = i == 0, last = i + 1 == n, opens = !patch_.closed && first, closes = !patch_.closed && last;
    const double before = opens ? 0 : rp[first ? n - 1 : i - 1], after = closes ? 0 : pq[last ? 0 : i + 1];
    const double orientation = edges_.doubled_area[i] < 0 ? -1 : 1;
    factor_[0][i] = orientation * hot_factor(model_, pq[i], before, opens);
    factor_[1][i] = orientation * hot_factor(model_, qr[i], patch_.outer_g[i], patch_.link_boundary[i] != 0);
    factor_[2][i] = orientation * hot_factor(model_, rp[i], after, closes);
  }

  [[nodiscard]] double outer_share(std::size_t i) const {
    if (!shares_ || patch_.link_boundary[i] != 0) return 0;
    const auto [l2, dw] = edge_measures(patch_.space, patch_.q(i), patch_.r(i));
    const EdgeShape link{l2, dw, patch_.outer_g[i]};
    const double orientation = edges_.doubled_area[i] < 0 ? -1 : 1;
    const HotKernel kernel = hot_kernel(formula_);
    return orientation * factor_[1][i] * (kernel.value(link) * kernel.per_area(patch_.outer_doubled_area[i]));
  }

  const Patch& patch_;
  const EnergyModel& model_;
  const EdgeFormula& formula_;
  const bool shares_;  // triangles across the link have a part in it
  StarScratch scratch_;
  HotEdges edges_;
  std::array<double*, 3> factor_;
  bool degenerate_ = false;
};

struct FullEdge {
  FullEdge(const Mesh& mesh, HalfedgeId h)
      : here(edge_in_triangle(mesh, h)), across(beyond(mesh, h)), boundary(mesh.is_boundary(h)) {}

  [[nodiscard]] double energy(const EnergyModel& model, const HotKernel& kernel) const {
    const EdgeShape& edge = here.edge;
    const double factor = hot_factor(model, edge.g, across.edge.g, boundary);
    return factor * (kernel.value(edge) * kernel.per_area(here.doubled_area) +
                     kernel.value(EdgeShape{edge.l2, edge.dw, across.edge.g}) * kernel.per_area(across.doubled_area));
  }

  EdgeInTriangle here, across;
  bool boundary;
};

}  // namespace

EdgeInTriangle edge_in_triangle(const Space& space, const WeightedPoint& p, const WeightedPoint& q,
                                const WeightedPoint& r) {
  const TriangleShape s = triangle_shape(space, p, q, r);
  const auto [l2, dw, g] = s.edges[0];
  return {{l2, dw, same_side(g, s.doubled_area)}, s.doubled_area};
}

double hot_factor(const EnergyModel& model, double g, double g_other, bool boundary) {
  const EnergyInfo& info = energy_info(model.kind);
  const auto sign = [](double x) { return x < 0 ? -1.0 : 1.0; };
  if (boundary) {
    if (info.positions_alone) return 1;
    const bool asks_model = info.boundary_treatment == BoundaryTreatment::as_is;
    if (asks_model && model.boundary_treatment == BoundaryTreatment::as_is) return 1;
    if (asks_model && model.boundary_treatment == BoundaryTreatment::mirrored) return 2;
    return sign(g);
  }
  return info.signed_by_dual ? sign(g + g_other) : 1;
}

void gather_patch(const Mesh& mesh, VertexId v, bool with_outer, Patch& patch) {
  patch.space = mesh.space();
  patch.center = v;
  const WeightedPoint center = mesh.point(v);
  patch.clear();
  const auto add = [&](VertexId q) {
    const std::size_t i = patch.link.size();
    if (i + 2 + kLanes > patch.x.size()) {  // q_0 again, and what is read beyond
      for (std::vector<double>* c : {&patch.x, &patch.y, &patch.w}) c->resize(2 * (i + 2 + kLanes));
    }
    const WeightedPoint p = mesh.point(q, center);
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
      const EdgeInTriangle outer = beyond(mesh, Mesh::next(h));
      patch.outer_g.push_back(outer.edge.g);
      patch.outer_doubled_area.push_back(outer.doubled_area);
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
  if (f.form != EdgeFormula::Form::hot) return star_kernels(patch.space).barrier_value(f, patch.arrays(), p);
  const HotStar star(patch, model, f, p);
  return star.is_degenerate() ? kInfinity : star.value();
}

VertexDerivatives patch_derivatives(const Patch& patch, const EnergyModel& model, const WeightedPoint& p) {
  const EdgeFormula f = edge_formula(model);
  constexpr VertexDerivatives kOutside = {.value = kInfinity};
  const StarKernels& kernels = star_kernels(patch.space);
  std::array<double, kStarSums> sums;
  if (f.form != EdgeFormula::Form::hot) {
    return kernels.barrier_derivatives(f, patch.arrays(), p, sums.data()) ? from_sums(sums) : kOutside;
  }
  const HotStar star(patch, model, f, p);
  if (star.is_degenerate()) return kOutside;
  kernels.hot_derivatives(f, patch.arrays(), star.factors(), p, sums.data());
  sums[0] += star.outer();
  return from_sums(sums);
}

double flip_energy(const Mesh& mesh, const EnergyModel& model, HalfedgeId h) {
  const HalfedgeId t = mesh.twin(h);
  return with_kernel(model, [&](const auto& kernel) {
    if constexpr (std::decay_t<decltype(kernel)>::kBarrier) {
      const auto [a, b, c] = mesh.points(mesh.origin(h), mesh.target(h), mesh.opposite(h));
      return barrier_triangle(kernel, triangle_shape(mesh.space(), a, b, c)) +
             barrier_triangle(kernel, triangle_shape(mesh.space(), b, a, mesh.point(mesh.opposite(t), a)));
    } else {
      double sum = FullEdge(mesh, h).energy(model, kernel);
      for (const HalfedgeId outer : {Mesh::next(h), Mesh::prev(h), Mesh::next(t), Mesh::prev(t)}) {
        sum += FullEdge(mesh, outer).energy(model, kernel);
      }
      return sum;
    }
  });
}

double triangle_energy(const EnergyModel& model, const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r,
                       const Space& space) {
  const TriangleShape s = triangle_shape(space, p, q, r);
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
      return sum * kernel.per_area(s.doubled_area);
    }
  });
}

void add_hot_energies(const Mesh& mesh, std::span<const EnergyModel> models, std::size_t first, std::size_t last,
                      std::span<double> sums) {
  struct Term {
    const EnergyModel* model;
    HotKernel kernel;
    double* sum;
    double of_triangle;
  };
  std::vector<Term> terms;
  for (std::size_t i = 0; i < models.size(); ++i) {
    const EdgeFormula f = edge_formula(models[i]);
    if (f.form == EdgeFormula::Form::hot) terms.push_back({&models[i], hot_kernel(f), &sums[i], 0});
  }
  if (terms.empty()) return;
  for (std::size_t i = first; i < last; ++i) {
    for (Term& term : terms) term.of_triangle = 0;
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(TriangleId(i), k);
      if (!mesh.is_edge_representative(h)) continue;
      const FullEdge edge(mesh, h);
      for (Term& term : terms) term.of_triangle += edge.energy(*term.model, term.kernel);
    }
    for (const Term& term : terms) *term.sum += term.of_triangle;
  }
}

VertexDerivatives vertex_energy(const Mesh& mesh, const EnergyModel& model, VertexId v) {
  Patch patch;
  gather_patch(mesh, v, needs_outer(model.kind), patch);
  return patch_derivatives(patch, model, mesh.point(v));
}

}  // namespace temper
