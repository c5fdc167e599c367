// The operators of surfaces: laws, the plane, spherical harmonics on icospheres and the first eigenvalue of a torus.
#include "temper/dec.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/surface_meshes.hpp"
#include "temper/generate.hpp"

namespace temper::surfaces {
namespace {

using Values = std::vector<double>;

/// d0ᵀ ★1 d0 u.
Values stiffness_times(const DecComplex& c, const Values& u) {
  Values sum(u.size(), 0.0);
  for (std::size_t i = 0; i < c.edges.size(); ++i) {
    const auto& edge = c.edges[EdgeId(i)];
    const double flux = c.star1[EdgeId(i)] * (u[edge.to.index] - u[edge.from.index]);
    sum[edge.to.index] += flux;
    sum[edge.from.index] -= flux;
  }
  return sum;
}
Values mass_times(const DecComplex& c, const Values& u) {
  Values product = u;
  for (std::size_t i = 0; i < u.size(); ++i) product[i] *= c.star0[VertexId(i)];
  return product;
}
double inner(const Values& a, const Values& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}
double rayleigh_quotient(const DecComplex& c, const Values& u) {
  return inner(u, stiffness_times(c, u)) / inner(u, mass_times(c, u));
}

TEST(SurfaceOperators, InThePlaneTheyAreThePlanes) {
  Mesh plane = *random_mesh({.vertices = 200, .seed = 2});
  Rng rng(2);
  for (const VertexId v : plane.vertices()) plane.set_weight(v, rng.uniform(0, 1e-3));
  const DecComplex here = dec_operators(test::mesh_of(test::lifted(plane))), there = temper::dec_operators(plane);
  ASSERT_EQ(here.edges.size(), there.edges.size());
  EXPECT_EQ(here.d0.columns, there.d0.columns);
  EXPECT_EQ(here.d1.columns, there.d1.columns);
  EXPECT_EQ(here.d1.signs, there.d1.signs);
  for (std::size_t i = 0; i < here.edges.size(); ++i) {
    const EdgeId e(i);
    EXPECT_EQ(here.edges[e].left, there.edges[e].left);
    EXPECT_NEAR(here.star1[e], there.star1[e], 1e-9 * std::max(1.0, std::abs(there.star1[e])));
    EXPECT_NEAR(here.edges[e].crossing, there.edges[e].crossing, 1e-12);
    EXPECT_NEAR(here.sphere_midpoints[e].x, there.edges[e].midpoint.x, 1e-12);
    EXPECT_NEAR(here.sphere_midpoints[e].y, there.edges[e].midpoint.y, 1e-12);
  }
  for (const VertexId v : plane.vertices()) EXPECT_NEAR(here.star0[v], there.star0[v], 1e-12);
  for (const TriangleId t : plane.triangles()) {
    EXPECT_NEAR(here.areas[t], there.areas[t], 1e-15);
    const double size = std::max(1.0, length(there.orthocenters[t]));
    EXPECT_NEAR(here.sphere_orthocenters[t].x, there.orthocenters[t].x, 1e-8 * size * size);
    EXPECT_EQ(here.sphere_orthocenters[t].z, 0);
  }
}

TEST(SurfaceOperators, OfFoldedPaperAreThoseOfItsUnfolding) {
  const Mesh strip = test::plane_strip(8, 3);
  const DecComplex here = dec_operators(test::mesh_of(test::folded(strip, 0.6))), there = temper::dec_operators(strip);
  for (std::size_t i = 0; i < here.edges.size(); ++i) EXPECT_NEAR(here.star1[EdgeId(i)], there.star1[EdgeId(i)], 1e-11);
  for (const VertexId v : strip.vertices()) EXPECT_NEAR(here.star0[v], there.star0[v], 1e-12);
}

TEST(SurfaceOperators, DualAreasSumToTheAreaAndSignsAreExact) {
  Rng rng(4);
  test::SurfaceArrays arrays = test::icosphere(2);
  for (Vec3& p : arrays.points) p = rng.uniform(0.7, 1.3) * p;
  for (std::size_t i = 0; i < arrays.points.size(); ++i) arrays.weights.push_back(rng.uniform(-0.1, 0.1));
  const SurfaceMesh mesh = test::mesh_of(arrays);
  const DecComplex c = dec_operators(mesh);
  double areas = 0, duals = 0;
  for (const double a : c.areas) areas += a;
  for (const double a : c.star0) duals += a;
  EXPECT_NEAR(duals, areas, 1e-12 * areas);
  std::size_t negative = 0;
  for (const double x : c.star1) negative += x < 0 ? 1 : 0;
  EXPECT_EQ(negative, quality(mesh).non_regular_edges);
  EXPECT_GT(negative, 0U);
  const Values ones(mesh.n_vertices(), 1);
  for (const double x : stiffness_times(c, ones)) EXPECT_EQ(x, 0);
  // Each orthocenter has equal power to its corners, and is at the heights over the edges.
  for (std::size_t i = 0; i < c.edges.size(); ++i) {
    const auto& edge = c.edges[EdgeId(i)];
    const Vec3 m = c.sphere_midpoints[EdgeId(i)];
    const double height = length(c.sphere_orthocenters[edge.left] - m);
    EXPECT_NEAR(height, std::abs(edge.left_height), 1e-9 * std::max(1.0, height));
    EXPECT_NEAR(edge.left_height + edge.right_height, edge.dual_length, 1e-9 * std::max(1.0, height));
  }
}

TEST(SurfaceOperators, SphericalHarmonicsHaveTheirEigenvaluesToOrderTwo) {
  const std::pair<double, double (*)(Vec3)> harmonics[] = {
      {6, [](Vec3 p) { return p.x * p.y + 0.3 * (3 * p.z * p.z - 1); }},
      {12, [](Vec3 p) { return p.x * p.y * p.z + 0.2 * p.z * (5 * p.z * p.z - 3); }}};
  for (const auto& [eigenvalue, harmonic] : harmonics) {
    double coarser = 0;
    for (const int level : {2, 3, 4}) {
      const test::SurfaceArrays arrays = test::icosphere(level);
      const DecComplex c = dec_operators(test::mesh_of(arrays));
      Values u;
      for (const Vec3 p : arrays.points) u.push_back(harmonic(p));
      const double error = std::abs(rayleigh_quotient(c, u) - eigenvalue);
      if (coarser > 0) {
        EXPECT_NEAR(coarser / error, 4, 0.3) << eigenvalue << " " << level;
      }
      coarser = error;
    }
    EXPECT_LT(coarser, 0.01 * eigenvalue);
  }
}

TEST(SurfaceOperators, CoordinatesAreEigenfunctionsOfAnInscribedSphereWithoutError) {
  // The gradient of a coordinate is constant, and the area vectors of the dual cells are radial.
  const test::SurfaceArrays arrays = test::icosphere(2);
  Values u;
  for (const Vec3 p : arrays.points) u.push_back(p.x + 0.5 * p.z);
  EXPECT_NEAR(rayleigh_quotient(dec_operators(test::mesh_of(arrays)), u), 2, 1e-12);
}

/// Solves d0ᵀ ★1 d0 u = f for f of sum zero, by conjugate gradients. u has the mean zero.
Values solve(const DecComplex& c, const Values& f) {
  Values u(f.size(), 0.0), r = f, p = f;
  double rr = inner(r, r);
  const double first = rr;
  for (int i = 0; i < 2000 && rr > 1e-22 * first; ++i) {
    const Values ap = stiffness_times(c, p);
    const double step = rr / inner(p, ap);
    for (std::size_t k = 0; k < u.size(); ++k) u[k] += step * p[k], r[k] -= step * ap[k];
    const double next = inner(r, r);
    for (std::size_t k = 0; k < u.size(); ++k) p[k] = r[k] + next / rr * p[k];
    rr = next;
  }
  return u;
}

TEST(SurfaceOperators, TheFirstEigenvalueOfATorusHasOrderTwo) {
  // −(a f′)′/(r² a) + f/a² = λ f with a = 1 + 0.4 cos θ, by 81 Fourier modes.
  constexpr double kEigenvalue = 1.028956156015;
  double coarser = 0;
  for (const int n : {12, 24, 48}) {
    const test::SurfaceArrays arrays = test::torus(2 * n, n, true);
    const DecComplex c = dec_operators(test::mesh_of(arrays));
    for (const double x : c.star1) ASSERT_GT(x, 0);
    Values u;
    for (const Vec3 p : arrays.points) u.push_back(p.x);
    for (int i = 0; i < 12; ++i) {
      const Values f = mass_times(c, u);
      u = solve(c, f);
      const double scale = 1 / std::sqrt(inner(u, mass_times(c, u)));
      for (double& x : u) x *= scale;
    }
    const double error = std::abs(rayleigh_quotient(c, u) - kEigenvalue);
    if (coarser > 0) {
      EXPECT_NEAR(coarser / error, 4, 0.3) << n;
    }
    coarser = error;
  }
  EXPECT_LT(coarser, 3e-3);
}

}  // namespace
}  // namespace temper::surfaces
