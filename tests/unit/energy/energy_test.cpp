// Values and laws of the energies.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "energy/whole_mesh.hpp"
#include "support/lattice.hpp"
#include "unit/energy/naive.hpp"

namespace temper::test {
namespace {

const WeightedPoint kP{0, 0, 0}, kQ{1, 0, 0}, kR{0.5, std::sqrt(0.75), 0};

TEST(Energy, TableHasOneRowForEachKindInOrder) {
  ASSERT_EQ(energies().size(), kEnergyKinds);
  for (std::size_t i = 0; i < energies().size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(energies()[i].kind), i);
    const auto found = find_energy(energies()[i].name);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->kind, energies()[i].kind);
  }
}

TEST(Energy, UnknownNameIsAnErrorThatListsTheNames) {
  const auto found = find_energy("HOT");
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::invalid_option);
  for (const EnergyInfo& info : energies()) EXPECT_NE(found.error().what().find(info.name), std::string::npos);
}

TEST(Energy, HardBarrierOfTheEquilateralTriangle) {
  // 8 √3 / 9 an edge: h = ℓ/(2√3), d = ℓ/2.
  EXPECT_NEAR(triangle_energy({.kind = EnergyKind::BH}, kP, kQ, kR), 4.618802153517, 1e-12);
  EXPECT_NEAR(triangle_energy({.kind = EnergyKind::BH}, kP, kQ, kR), 8 / std::sqrt(3.0), 1e-14);
}

TEST(Energy, EqualsItsNaiveTwin) {
  int cases = 0;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Mesh mesh = lattice({.jitter = 0.1 * double(seed), .weight = 0.05 * double(seed), .seed = seed});
    const VertexId v(6);
    for (const EnergyModel& model : all_models(1)) {
      const double total = total_energy(mesh, model);
      const double naive = static_cast<double>(naive_total(mesh, model, v, naive_point(mesh, v)));
      if (!std::isfinite(total)) {
        const EnergyInfo& info = energy_info(model.kind);
        EXPECT_TRUE(info.barrier && !info.softened_by_gamma);
        continue;
      }
      EXPECT_NEAR(total, naive, 1e-11 * (1 + std::abs(naive)));
      ++cases;
    }
  }
  EXPECT_GT(cases, 60);
}

TEST(Energy, ChangeOfOneVertexIsTheChangeOfItsPatch) {
  Mesh mesh = lattice({.jitter = 0.3, .weight = 0.1});
  Noise noise(7);
  int cases = 0;
  for (const VertexId v : mesh.vertices()) {
    for (const EnergyModel& model : all_models(1)) {
      const WeightedPoint before = mesh.point(v);
      const double total0 = total_energy(mesh, model), patch0 = vertex_energy(mesh, model, v).value;
      mesh.set_point(v, {before.x + 0.05 * noise(), before.y + 0.05 * noise(), before.w + 0.05 * noise()});
      const double total1 = total_energy(mesh, model), patch1 = vertex_energy(mesh, model, v).value;
      mesh.set_point(v, before);
      if (!std::isfinite(total0) || !std::isfinite(total1)) continue;
      EXPECT_NEAR(total1 - total0, patch1 - patch0, 1e-11 * (std::abs(total0) + std::abs(total1)));
      ++cases;
    }
  }
  EXPECT_GT(cases, 400);
}

TEST(Energy, IsInvariantUnderRotationTranslationAndEqualShiftsOfWeights) {
  const Mesh mesh = lattice();
  Mesh moved = mesh;
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (const VertexId v : mesh.vertices()) {
    const WeightedPoint p = mesh.point(v);
    moved.set_point(v, {c * p.x - s * p.y + 3, s * p.x + c * p.y - 5, p.w + 0.25});
  }
  for (const EnergyModel& model : all_models(1)) {
    const double e = total_energy(mesh, model);
    ASSERT_TRUE(std::isfinite(e));
    EXPECT_NEAR(total_energy(moved, model), e, 1e-12 * std::abs(e));
  }
}

TEST(Energy, ScalesWithThePowerInTheTable) {
  const Mesh mesh = lattice(), large = lattice({.scale = 8});
  for (EnergyModel model : all_models(1)) {
    const EnergyInfo& info = energies()[static_cast<std::size_t>(model.kind)];
    if (info.softened_by_gamma && model.gamma.scale == LengthScale::absolute) continue;
    if (info.softened_by_h0 && model.h0.scale == LengthScale::absolute) continue;
    const int exponent = info.length_exponent;
    const double e = total_energy(mesh, model);
    EXPECT_NEAR(total_energy(large, model), std::pow(8, exponent) * e, 1e-12 * std::pow(8, exponent) * std::abs(e));
  }
}

TEST(Energy, OfABarrierIsInfiniteOutsideItsDomainAndNeverNaN) {
  const WeightedPoint heavy{0, 0, 1.5};  // d from q towards p is negative
  for (const EnergyInfo& info : energies()) {
    for (int star = 0; star < 3; ++star) {
      const double e = triangle_energy({.kind = info.kind, .star = Star(star)}, heavy, kQ, kR);
      EXPECT_EQ(std::isinf(e), info.barrier) << info.name;
      EXPECT_FALSE(std::isnan(e));
    }
  }
  const WeightedPoint obtuse{0.5, 0.1, 0};
  EXPECT_TRUE(std::isinf(triangle_energy({.kind = EnergyKind::BH}, kP, kQ, obtuse)));
  EXPECT_TRUE(
      std::isinf(triangle_energy({.kind = EnergyKind::BHs, .h0 = {0.1, LengthScale::absolute}}, kP, kQ, obtuse)));
  EXPECT_TRUE(
      std::isfinite(triangle_energy({.kind = EnergyKind::BHs, .h0 = {2, LengthScale::relative}}, kP, kQ, obtuse)));
  EXPECT_TRUE(std::isfinite(triangle_energy({.kind = EnergyKind::BP}, kP, kQ, obtuse)));
}

/// One vertex is pushed across its link, so that triangles around it turn over; weights leave 0 < d < ℓ.
Mesh inverted_lattice() {
  Mesh mesh = lattice({.jitter = 0.1, .weight = 0.05});
  const WeightedPoint p = mesh.point(VertexId(12));
  mesh.set_point(VertexId(12), {p.x + 1.2, p.y + 0.1, p.w});
  return mesh;
}

TEST(Energy, OfTheSoftenedBarriersIsFiniteOnInvertedTrianglesUnlessThereIsAWall) {
  const Mesh mesh = inverted_lattice();
  const VertexId v(12);
  int finite = 0;
  for (EnergyModel model : all_models(1)) {
    model.h0 = {100, LengthScale::relative};
    const EnergyInfo& info = energy_info(model.kind);
    if (!info.barrier) continue;
    const double total = total_energy(mesh, model), naive = double(naive_total(mesh, model, v, naive_point(mesh, v)));
    const VertexDerivatives star = vertex_energy(mesh, model, v);
    EXPECT_EQ(std::isfinite(total), !info.is_hard());
    EXPECT_EQ(star.feasible, !info.is_hard());
    if (std::isfinite(total)) {
      EXPECT_NEAR(total, naive, 1e-11 * naive);
      ++finite;
    }
    model.wall = true;
    EXPECT_TRUE(std::isinf(total_energy(mesh, model)));
    EXPECT_TRUE(std::isinf(vertex_energy(mesh, model, v).value));
    EXPECT_TRUE(std::isinf(triangle_energy(model, kQ, kP, kR)));
  }
  EXPECT_EQ(finite, 12);  // BP and BHs, three stars, both scales
}

TEST(Energy, DifferencesBehindNoWallAreTheDerivatives) {
  const Mesh mesh = inverted_lattice();
  const VertexId v(12);
  int cases = 0;
  for (EnergyModel model : all_models(1)) {
    model.h0 = {100, LengthScale::relative};
    const VertexDerivatives exact = vertex_energy(mesh, model, v);
    if (!exact.feasible) continue;
    const NaivePoint p = naive_point(mesh, v);
    const auto at = [&](Real x, Real y, Real w) { return naive_total(mesh, model, v, {p.x + x, p.y + y, p.w + w}); };
    const auto error = [&](Real h) {
      const std::array<Real, 3> rise = {at(h, 0, 0) - at(-h, 0, 0), at(0, h, 0) - at(0, -h, 0),
                                        at(0, 0, h) - at(0, 0, -h)};
      Real largest = 0;
      for (std::size_t i = 0; i < 3; ++i) largest = std::max(largest, std::abs(exact.gradient[i] - rise[i] / (2 * h)));
      return largest;
    };
    EXPECT_NEAR(double(error(2e-5L) / error(1e-5L)), 4, 0.1) << energy_info(model.kind).name;
    ++cases;
  }
  EXPECT_GT(cases, 25);
}

TEST(Energy, OfOptimalDelaunayTriangulationsIsTheInterpolationErrorOfTheSquare) {
  Noise noise(3);
  int acute_ones = 0, obtuse_ones = 0;
  for (int i = 0; i < 200; ++i) {
    const auto point = [&] { return WeightedPoint{noise(), noise(), 0}; };
    const WeightedPoint p = point(), q = point(), r = point();
    const Vec2 a = q.position() - p.position(), b = r.position() - p.position();
    const double s = cross(a, b), squares = squared_length(a) + squared_length(b) + squared_length(b - a);
    const bool acute = dot(a, b) > 0 && dot(b, b - a) > 0 && dot(a, a - b) > 0;
    if (!(s > 0.01 * squares)) continue;  // far orthocenters cancel
    EXPECT_NEAR(triangle_energy({.kind = EnergyKind::ODT}, p, q, r), s * squares / 24, 1e-10 * squares * squares);
    ++(acute ? acute_ones : obtuse_ones);
  }
  EXPECT_GT(acute_ones, 5);
  EXPECT_GT(obtuse_ones, 20);
}

TEST(Energy, OverSquaredAreaGrowsWithoutBoundWhereAnEdgeCollapses) {
  for (const double e : {0.1, 0.01, 0.001}) {
    const WeightedPoint near{e, 0, 0};
    const double energy = triangle_energy({.kind = EnergyKind::nF}, kP, near, kR);
    const double hot = triangle_energy({.kind = EnergyKind::F}, kP, near, kR), area = 0.5 * e * kR.y;
    EXPECT_NEAR(energy, hot / (area * area), 1e-10 * energy);
    EXPECT_GT(energy, 0.3 / e);
    EXPECT_LT(hot, e);
  }
}

TEST(Energy, OfPseudoBarrierTendsToTheHardBarrier) {
  const double hard = triangle_energy({.kind = EnergyKind::BH}, kP, kQ, kR);
  double last = std::numeric_limits<double>::infinity();
  for (const double gamma : {1e-2, 1e-3, 1e-4}) {
    const double error =
        std::abs(triangle_energy({.kind = EnergyKind::BP, .gamma = {gamma, LengthScale::relative}}, kP, kQ, kR) - hard);
    EXPECT_LT(error, 0.011 * last);  // second order in γ
    last = error;
  }
}

TEST(Energy, OfPseudoBarrierKeepsItsDigitsFarOutside) {
  // h ≈ −5e5 ℓ: φ = γ²/(4 |h|) to eight digits; the naive sum h + √(h² + γ²) would have none.
  const WeightedPoint flat{0.5, 1e-6, 0};
  const double e = triangle_energy({.kind = EnergyKind::BP, .gamma = {1e-3, LengthScale::absolute}}, kP, kQ, flat);
  const Real gamma = 1e-3L;
  Real naive = 0;
  const std::array<NaivePoint, 3> t = {{{0, 0, 0}, {1, 0, 0}, {0.5L, 1e-6L, 0}}};
  for (std::size_t i = 0; i < 3; ++i) {
    const NaiveEdge n = naive_edge(t[i], t[(i + 1) % 3], t[(i + 2) % 3]);
    const Real root = std::sqrt(n.h_left * n.h_left + gamma * gamma);
    const Real phi = n.h_left > 0 ? (n.h_left + root) / 2 : gamma * gamma / (2 * (root - n.h_left));
    naive += 2 * (n.d_ij * n.d_ij + n.h_left * n.h_left) / (3 * n.d_ij * phi);
  }
  EXPECT_NEAR(e / static_cast<double>(naive), 1.0, 1e-9);
}

TEST(Energy, TheoryExtrapolationIsNeverNegative) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Mesh mesh = lattice({.n = 4, .jitter = 0.25, .weight = 1, .seed = seed});
    for (int star = 0; star < 3; ++star) EXPECT_GE(total_energy(mesh, {.kind = EnergyKind::T, .star = Star(star)}), 0);
  }
}

TEST(Energy, TotalDoesNotDependOnTheExecutor) {
  class Backwards final : public Executor {
   public:
    void run(std::size_t n, const std::function<void(std::size_t)>& block) override {
      for (std::size_t i = n; i > 0; --i) block(i - 1);
    }
  } backwards;
  const Mesh mesh = lattice({.n = 80});
  for (const EnergyModel& model : all_models(1)) {
    EXPECT_EQ(total_energy(mesh, model), total_energy(mesh, model, &backwards));
  }
}

TEST(Energy, TotalsOfOneWalkAreThoseOfEachModelAlone) {
  const Mesh mesh = lattice({.n = 80, .jitter = 0.3, .weight = 0.3});
  const std::vector<EnergyModel> models = all_models(1);
  const std::vector<double> totals = total_energies(mesh, models, nullptr);
  ASSERT_EQ(totals.size(), models.size());
  for (std::size_t i = 0; i < models.size(); ++i) EXPECT_EQ(totals[i], total_energy(mesh, models[i]));
  EXPECT_TRUE(total_energies(mesh, {}, nullptr).empty());
}

}  // namespace
}  // namespace temper::test
