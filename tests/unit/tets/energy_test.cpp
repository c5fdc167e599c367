// The energy of a star: laws, a twin from the constructions of geometry.hpp, and differences of order two.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "support/tet_lattice.hpp"
#include "tets/energy/hot.hpp"
#include "tets/energy/sloped.hpp"
#include "tets/energy/star.hpp"
#include "tets/optimize/sweeper.hpp"

namespace temper::tets {
namespace {

struct Star {
  std::vector<LinkFace<long double>> link;
  std::vector<LinkFace<double>> rounded;
  WeightedPoint center;
  std::vector<std::array<WeightedPoint, 4>> tetrahedra;  // the face, then the center
  std::vector<LinkLanes> lanes;

  /// By the kernel of the instruction set in use.
  PointDerivatives<double> rounded_derivatives(double gamma) const {
    std::vector<LinkLanes> room = lanes;
    return kernels().derivatives({room.data(), rounded.size()}, center, gamma);
  }
};

Star star_of(const TetMesh& mesh, VertexId v) {
  Star star;
  star.center = mesh.point(v);
  std::vector<HalffaceId> link;
  collect_link(mesh, v, link);
  static_cast<void>(gather(mesh, link, star.lanes));
  for (const HalffaceId h : link) {
    const auto [q, r, s] = mesh.vertices(h);
    EXPECT_EQ(mesh.opposite(h), v);
    star.link.push_back(link_face<long double>(mesh.point(q), mesh.point(r), mesh.point(s)));
    star.rounded.push_back(link_face(mesh, h));
    star.tetrahedra.push_back({mesh.point(q), mesh.point(r), mesh.point(s), star.center});
  }
  return star;
}

/// Stars of a shaken lattice, of one with nearly flat tetrahedra, and of cospherical ones, at the boundary and inside.
std::vector<Star> stars() {
  std::vector<Star> all;
  for (const test::TetArrays& arrays :
       {test::shaken(test::body_centered(3), 0.1, 0.1), test::shaken(test::cubes(2, test::kSixTets), 0.1, 0.3),
        test::shaken(test::cubes(2, test::kFiveTets), 0, 0)}) {
    test::TetArrays flat = arrays;
    for (Vec3& p : flat.points) p.z *= 1e-3;
    for (const TetMesh& mesh : {test::mesh_of(arrays), test::mesh_of(flat)}) {
      for (const VertexId v : mesh.vertices()) {
        if (v.index % 5 == 3) all.push_back(star_of(mesh, v));
      }
    }
  }
  return all;
}

/// The energy of a tetrahedron by its definition.
double naive_energy(const std::array<WeightedPoint, 4>& t, double gamma) {
  const auto at = [&](std::size_t i) { return t[i].position(); };
  double sum = 0, length2 = 0;
  for (std::size_t f = 0; f < 4; ++f) {
    const auto &p = t[(f + 1) % 4], &q = t[(f + 2) % 4], &r = t[(f + 3) % 4];
    const double area = 0.5 * length(cross(q.position() - p.position(), r.position() - p.position()));
    const double y = signed_height(p, q, r, t[f]) / std::sqrt(4 / std::numbers::sqrt3 * area);
    const double root = std::sqrt(y * y + gamma * gamma);
    sum += y > 0 ? 2 / (root + y) : 2 * (root - y) / (gamma * gamma);  // the same without cancellation
    for (std::size_t g = 0; g < f; ++g) length2 += squared_length(at(f) - at(g));
  }
  const double volume = std::abs(six_volumes(at(0), at(1), at(2), at(3))) / 6;
  return kHeightFactor * sum + kShapeFactor * std::pow(length2, 1.5) / volume;
}

using Sum = PointDerivatives<long double>;
Sum derivatives(const Star& star, const std::array<long double, 4>& p, long double gamma) {
  Sum sum = {};
  for (const auto& face : star.link) sum += tet_derivatives<long double>(face, {p[0], p[1], p[2]}, p[3], gamma);
  return sum;
}
std::array<long double, 4> gradient_of(const Sum& d) {
  return {d.gradient.at.x, d.gradient.at.y, d.gradient.at.z, d.gradient.w};
}
std::array<std::array<long double, 4>, 4> hessian_of(const Sum& d) {
  const auto& [xx, xy, xz, xw, yy, yz, yw, zz, zw, ww] = d.hessian;
  return {{{xx, xy, xz, xw}, {xy, yy, yz, yw}, {xz, yz, zz, zw}, {xw, yw, zw, ww}}};
}

TEST(TetEnergy, IsTheSumOfItsDefinition) {
  std::size_t tried = 0;
  for (const Star& star : stars()) {
    for (const double gamma : {1.0, 0.1}) {
      double naive = 0;
      for (const auto& t : star.tetrahedra) naive += naive_energy(t, gamma);
      EXPECT_NEAR(star_energy(star.rounded, star.center, gamma), naive, 1e-9 * naive);
      EXPECT_NEAR(star.rounded_derivatives(gamma).value, naive, 1e-9 * naive);
      ++tried;
    }
  }
  EXPECT_GT(tried, 50U);
}

TEST(TetEnergy, DifferencesConvergeToGradientAndHessianWithOrderTwo) {
  for (const Star& star : stars()) {
    const std::array<long double, 4> center = {star.center.x, star.center.y, star.center.z, star.center.w};
    for (const long double gamma : {1.0L, 0.05L}) {
      const Sum exact = derivatives(star, center, gamma);
      const auto gradient = gradient_of(exact);
      const auto hessian = hessian_of(exact);
      long double least = HUGE_VALL;  // a length in which the energy is smooth
      for (const auto& t : star.tetrahedra) {
        const Vec3 n = cross(t[1].position() - t[0].position(), t[2].position() - t[0].position());
        least = std::min<long double>(least, dot(n, star.center.position() - t[0].position()) / length(n));
      }
      const std::array<long double, 4> unit = {least, least, least, least * least};
      // The errors of the gradient and of the Hessian, in units of `least`. Single components may cross zero.
      const auto errors = [&](long double step) {
        std::array<long double, 2> sums = {};
        for (std::size_t i = 0; i < 4; ++i) {
          auto high = center, low = center;
          const long double h = step * gamma * unit[i];
          high[i] += h, low[i] -= h;
          const Sum above = derivatives(star, high, gamma), below = derivatives(star, low, gamma);
          sums[0] += unit[i] * std::abs((above.value - below.value) / (2 * h) - gradient[i]);
          for (std::size_t j = 0; j < 4; ++j) {
            const long double slope = (gradient_of(above)[j] - gradient_of(below)[j]) / (2 * h);
            sums[1] += unit[i] * unit[j] * std::abs(slope - hessian[i][j]);
          }
        }
        return sums;
      };
      const auto coarse = errors(0x1p-6L), fine = errors(0x1p-7L);
      // In a symmetric star the errors of the gradient may be rounding alone.
      for (std::size_t k = 0; k < 2; ++k) EXPECT_LT(fine[k], 0.27L * coarse[k] + 1e-14L * exact.value) << k;
    }
  }
}

TEST(TetEnergy, DoesNotChangeWithRotationTranslationScaleAndAnOffsetOfWeights) {
  const test::TetArrays arrays = test::shaken(test::body_centered(3), 0.1, 0.1);
  test::TetArrays moved = arrays;
  for (Vec3& p : moved.points)  // (1, 2, 2)/3 and so on: a rotation
    p = (8.0 / 3) * Vec3{p.x + 2 * p.y + 2 * p.z, 2 * p.x + p.y - 2 * p.z, -2 * p.x + 2 * p.y - p.z} + Vec3{16, -8, 32};
  for (double& w : moved.weights) w = 64 * w + 4;
  const TetMesh a = test::mesh_of(arrays), b = test::mesh_of(moved);
  for (const VertexId v : a.vertices()) {
    const Star at = star_of(a, v), there = star_of(b, v);
    const PointDerivatives<double> before = at.rounded_derivatives(0.1), after = there.rounded_derivatives(0.1);
    EXPECT_NEAR(after.value, before.value, 1e-11 * before.value);
    EXPECT_NEAR(64 * after.gradient.w, before.gradient.w, 1e-9 * (1 + std::abs(before.gradient.w)));
  }
}

TEST(TetEnergy, IsInfiniteUnlessTheTetrahedronIsPositive) {
  const auto face = link_face<double>({0, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0});
  EXPECT_TRUE(std::isfinite(tet_energy<double>(face, {0.3, 0.3, 0.5}, 0, 1)));
  EXPECT_EQ(tet_energy<double>(face, {0.3, 0.3, 0}, 0, 1), HUGE_VAL);
  EXPECT_EQ(tet_energy<double>(face, {0.3, 0.3, -0.5}, 0, 1), HUGE_VAL);
  EXPECT_EQ(tet_derivatives<double>(face, {0.3, 0.3, -0.5}, 0, 1).value, HUGE_VAL);
}

/// The orthocenter of 1 to 4 points.
Vec3 orthocenter_of(std::span<const WeightedPoint> s) {
  if (s.size() == 4) return orthocenter(s[0], s[1], s[2], s[3]);
  if (s.size() == 3) return orthocenter(s[0], s[1], s[2]);
  if (s.size() == 1) return s[0].position();
  const Vec3 e = s[1].position() - s[0].position();
  return s[0].position() + (0.5 + 0.5 * (s[0].w - s[1].w) / squared_length(e)) * e;
}

/// The mean of |x − y|² over two simplices, x and y independent: a cubature that is exact for quadratic polynomials.
double mean_squared_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  const auto nodes = [](const std::vector<Vec3>& s) {
    const double n = double(s.size());
    std::vector<std::pair<Vec3, double>> all;
    Vec3 centroid;
    for (const Vec3& p : s) all.emplace_back(p, 1 / (n * (n + 1))), centroid = centroid + (1 / n) * p;
    all.emplace_back(centroid, n / (n + 1));
    return all;
  };
  double sum = 0;
  for (const auto& [x, of_x] : nodes(a)) {
    for (const auto& [y, of_y] : nodes(b)) sum += of_x * of_y * squared_length(x - y);
  }
  return sum;
}

/// The HOT energy of star k by its definition, and the sum of its absolute terms: the cost of transport between each
/// k-simplex and the signed parts of its dual.
std::pair<double, double> naive_hot_energy(const std::array<WeightedPoint, 4>& corners, std::size_t k) {
  double sum = 0, absolute = 0;
  std::array<std::size_t, 4> order = {0, 1, 2, 3};
  do {
    std::vector<WeightedPoint> chain;
    std::vector<Vec3> simplex, dual, axes;
    double primal_size = 1, dual_size = 1;
    for (std::size_t j = 0; j < 4; ++j) {
      const WeightedPoint& v = corners[order[j]];
      chain.push_back(v);
      const Vec3 center = orthocenter_of(chain);
      if (j > 0) {
        Vec3 axis = v.position() - corners[order[0]].position();
        for (const Vec3& other : axes) axis = axis - dot(axis, other) * other;
        const double height = length(axis);
        axes.push_back((1 / height) * axis);
        const double leg = dot(center - orthocenter_of(std::span(chain).first(j)), axes.back());
        if (j <= k) primal_size *= height / double(j);
        if (j > k) dual_size *= leg / double(j - k);
      }
      if (j <= k) simplex.push_back(v.position());
      if (j >= k) dual.push_back(center);
    }
    constexpr double kOrders[] = {1, 2, 6, 24};  // of the vertices of the simplex
    const double term = primal_size * dual_size * mean_squared_distance(simplex, dual) / kOrders[k];
    sum += term;
    absolute += std::abs(term);
  } while (std::next_permutation(order.begin(), order.end()));
  return {sum, absolute};
}

TEST(TetHotEnergy, IsTheCostOfTransportBetweenSimplicesAndDuals) {
  for (const Star& star : stars()) {
    for (const auto& t : star.tetrahedra) {
      const HotFace face(t[0], t[1], t[2]);
      const Vec3 u = t[3].position() - t[0].position();
      for (std::size_t k = 0; k < 4; ++k) {
        const auto [naive, absolute] = naive_hot_energy(t, k);
        EXPECT_NEAR(hot_energy(kHotEnergies[k], face, Vector<double>{u.x, u.y, u.z}, t[3].w), naive, 1e-9 * absolute)
            << k;
      }
    }
  }
}

TEST(TetHotEnergy, DifferencesConvergeToGradientAndHessianWithOrderTwo) {
  using Real = long double;
  const TetMesh mesh = test::mesh_of(test::shaken(test::body_centered(3), 0.1, 0.1));
  for (const VertexId v : mesh.vertices()) {
    if (v.index % 7 != 3) continue;
    const Star star = star_of(mesh, v);
    std::vector<HalffaceId> link;
    collect_link(mesh, v, link);
    HotStar hot;
    hot.gather(mesh, link);
    for (const HotEnergy& energy : kHotEnergies) {
      const PointDerivatives<double> exact = hot.derivatives(energy, star.center);
      const auto& [xx, xy, xz, xw, yy, yz, yw, zz, zw, ww] = exact.hessian;
      const std::array<double, 4> gradient = {exact.gradient.at.x, exact.gradient.at.y, exact.gradient.at.z,
                                              exact.gradient.w};
      const Real hessian[4][4] = {{xx, xy, xz, xw}, {xy, yy, yz, yw}, {xz, yz, zz, zw}, {xw, yw, zw, ww}};
      EXPECT_NEAR(hot.value(energy, star.center), exact.value, 1e-13 * std::abs(exact.value));
      using Unknown = SlopedOf<Real>;
      const auto moved = [&](std::size_t i, Real h) {
        std::array<Real, 4> p = {star.center.x, star.center.y, star.center.z, star.center.w};
        p[i] += h;
        Unknown sum;
        for (const auto& t : star.tetrahedra) {
          const Vector<Unknown> u = {Unknown(p[0] - t[0].x, 0), Unknown(p[1] - t[0].y, 1), Unknown(p[2] - t[0].z, 2)};
          sum = sum + hot_energy(energy, HotFace(t[0], t[1], t[2]), u, Unknown(p[3], 3));
        }
        return sum;
      };
      EXPECT_NEAR(double(moved(0, 0).value), exact.value, 1e-12 * std::abs(exact.value));
      const auto errors = [&](Real h) {
        std::array<Real, 2> sums = {};
        for (std::size_t i = 0; i < 4; ++i) {
          const Unknown above = moved(i, h), below = moved(i, -h);
          sums[0] += std::abs((above.value - below.value) / (2 * h) - gradient[i]);
          for (std::size_t j = 0; j < 4; ++j)
            sums[1] += std::abs((above.slope[j] - below.slope[j]) / (2 * h) - hessian[i][j]);
        }
        return sums;
      };
      const auto coarse = errors(0x1p-8L), fine = errors(0x1p-9L);
      for (std::size_t k = 0; k < 2; ++k) EXPECT_LT(fine[k], 0.27L * coarse[k] + 1e-11L * std::abs(exact.value)) << k;
    }
  }
}

TEST(TetHotEnergy, OfAMeshIsTheSumOverItsTetrahedraAndGrowsWithTheFifthPowerOfLength) {
  test::TetArrays arrays = test::shaken(test::body_centered(3), 0.1, 0.1);
  const TetMesh mesh = test::mesh_of(arrays);
  for (Vec3& p : arrays.points) p = 2 * p + Vec3{64, -32, 16};
  for (double& w : arrays.weights) w = 4 * w + 8;
  const TetMesh moved = test::mesh_of(arrays);
  for (std::size_t k = 0; k < 4; ++k) {
    double naive = 0;
    for (const TetId t : mesh.tetrahedra()) naive += naive_hot_energy(mesh.points(t), k).first;
    const double sum = hot_energy(mesh, kHotEnergies[k]);
    EXPECT_NEAR(sum, naive, 1e-10 * naive);
    EXPECT_NEAR(hot_energy(moved, kHotEnergies[k]), 32 * sum, 1e-10 * 32 * sum);
  }
}

}  // namespace
}  // namespace temper::tets
