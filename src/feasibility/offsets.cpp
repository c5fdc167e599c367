// The squared offsets of the accuracy objective (energy/accuracy_energy.hpp), as functions of the weights.
//
// E has the terms s⁻² ℓD · 3 (c α δ² + (c or c_b) β η²), cubic in the weights: δ and η are linear, and so is D. A cubic
// is not convex: D δ² falls if a large δ stays and D shrinks. But Σ ℓD over all edges is twice the area of the mesh,
// whatever the weights. So each ℓD is replaced by two thirds of the area of the edge's triangles, as if duals ended at
// centroids. The result is a convex quadratic function:
//
//     Σ_edges s⁻² ⅔ (A_k + A_l) ℓ² 3 (c α (d/ℓ − ½)² + c β ((h_k − h_l)/2ℓ)²)       c_b β (h/2ℓ)² on the boundary
//
// α = β = 1/3, of ★1. The moments of HOT, which hardly depend on the weights, are left out.
#include <cmath>
#include <utility>

#include "feasibility/constraints.hpp"
#include "size/averaged_sizes.hpp"
#include "temper/detail/size.hpp"

namespace temper {
namespace {

using Kind = WeightConstraint::Kind;

constexpr double kAlpha = 1.0 / 3, kBeta = 1.0 / 3;  // of ★1

/// On the sphere the linear part of N/m at equal σ: c + N − c m, with c the value there.
LinearForm linear_part(LinearForm form) {
  const double value = form.constant;
  form = beyond_margin(form, value);
  form.constant = value;
  form.slope = 0;
  return form;
}

/// ½ (left − right), for two heights over one edge or face. The vertices of `right` are, in its order, those of the
/// result at `places`.
LinearForm half_difference(const LinearForm& left, const LinearForm& right, std::span<const int> places,
                           VertexId across) {
  LinearForm form = left;
  form.size = left.size + 1;
  form.vertices[static_cast<std::size_t>(left.size)] = across;
  for (double& x : form.coefficients) x *= 0.5;
  form.constant = 0.5 * (left.constant - right.constant);
  for (std::size_t k = 0; k < places.size(); ++k)
    form.coefficients[static_cast<std::size_t>(places[k])] -= 0.5 * right.coefficients[k];
  return form;
}

}  // namespace

LinearForm offset_form(const Demand& demand, const OffsetTerm& term) {
  const auto part = [&](const WeightConstraint& c) { return linear_part(demand.linear_form(c)); };
  const auto& [kind, p, q, r, s, t] = term.at;
  LinearForm form;
  if (kind == Kind::dual) {
    constexpr int kPlaces[] = {1, 0, 3};
    form = half_difference(part({Kind::height, p, q, r}), part({Kind::height, q, p, s}), kPlaces, s);
  } else if (kind == Kind::dual_of_face) {
    constexpr int kPlaces[] = {0, 2, 1, 4};
    form = half_difference(part({Kind::height_over_face, p, q, r, s}), part({Kind::height_over_face, p, r, q, t}),
                           kPlaces, t);
  } else {
    form = part(term.at);
  }
  form.constant -= term.target;
  return form;
}

std::vector<OffsetTerm> TriangleDemand::offsets(const WeightOptions& options) const {
  const IdVector<VertexId, double> sizes = averaged_sizes(mesh_, local_sizes(mesh_));
  const auto area = [&](HalfedgeId h) {
    const auto [p, q, r] = mesh_.corners(Mesh::triangle(h));
    const double a = squared_distance(mesh_, p, q), b = squared_distance(mesh_, q, r),
                 c = squared_distance(mesh_, r, p);
    return 0.25 * std::sqrt(std::max(4 * a * b - (a + b - c) * (a + b - c), 0.0));
  };
  const std::vector<CellId> cells = all_cells(*this);
  std::vector<OffsetTerm> terms;
  for (const HalfedgeId h : temper::edges_of(mesh_, as_triangles(cells))) {
    const VertexId p = mesh_.origin(h), q = mesh_.target(h);
    const bool on_boundary = mesh_.is_boundary(h);
    const double size = 0.5 * (sizes[p] + sizes[q]), l2 = squared_distance(mesh_, p, q);
    const double dual_area = 2.0 / 3 * (area(h) + (on_boundary ? 0 : area(mesh_.twin(h))));
    const double scale = 3 * dual_area * l2 / (size * size);
    terms.push_back({split_constraint(p, q), options.offset_factor * kAlpha * scale, 0.5});
    if (on_boundary) {
      terms.push_back({height_constraint(mesh_, h), options.boundary_offset_factor * kBeta * scale / 4, 0});
    } else {
      terms.push_back({dual_constraint(mesh_, h), options.offset_factor * kBeta * scale, 0});
    }
  }
  return terms;
}

}  // namespace temper
