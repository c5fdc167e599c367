// A summary of the operators for the authors of solvers: signs, sums, extremes.
#include <algorithm>
#include <cmath>

#include "base/median.hpp"
#include "temper/dec.hpp"
#include "temper/detail/geometry.hpp"

namespace temper {
namespace {

double largest_of(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

void count_signs(DecSummary& s, const DecComplex& complex) {
  for (std::size_t i = 0; i < complex.edges.size(); ++i) {
    const EdgeId e(i);
    const double value = complex.star1[e];
    if (complex.edges[e].is_boundary()) {
      ++s.boundary_edges;
      s.negative_boundary_star1 += value < 0 ? 1 : 0;
    } else {
      s.negative_star1 += value < 0 ? 1 : 0;
      s.zero_star1 += value == 0 ? 1 : 0;
    }
  }
  for (const double value : complex.star0) s.negative_star0 += value < 0 ? 1 : 0;
}

void find_extremes(DecSummary& s, const DecComplex& complex) {
  std::vector<double> stars, fluxes;
  stars.reserve(complex.edges.size());
  fluxes.reserve(complex.edges.size());
  for (std::size_t i = 0; i < complex.edges.size(); ++i) {
    const EdgeId e(i);
    stars.push_back(std::abs(complex.star1[e]));
    if (!complex.edges[e].is_boundary()) fluxes.push_back(std::abs(complex.flux[e]));
  }
  s.min_star0 = complex.star0.empty() ? 0 : *std::min_element(complex.star0.begin(), complex.star0.end());
  s.min_star1 = complex.star1.empty() ? 0 : *std::min_element(complex.star1.begin(), complex.star1.end());
  s.max_star1 = largest_of(stars);
  s.max_flux = largest_of(fluxes);
  s.median_star1 = median_of(std::move(stars));
  s.median_flux = median_of(std::move(fluxes));
}

}  // namespace

DecSummary summarize(const Mesh& mesh, const DecComplex& complex) {
  DecSummary s;
  s.vertices = mesh.n_vertices();
  s.edges = complex.edges.size();
  s.triangles = mesh.n_triangles();
  count_signs(s, complex);
  find_extremes(s, complex);
  for (const double a : complex.areas) s.area += a;
  for (const double a : complex.star0) s.star0_sum += a;
  for (const TriangleId t : mesh.triangles()) {
    const auto [p, q, r] = mesh.points(t);
    s.not_well_centered += is_well_centered(mesh.space(), p, q, r) ? 0 : 1;
  }
  return s;
}

}  // namespace temper
