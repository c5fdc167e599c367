// The energy of the accuracy objective: its parts add up to E_F, its derivatives are those of a naive twin, and what
// one vertex changes is what the whole changes.
#include "energy/accuracy_energy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "support/lattice.hpp"
#include "temper/detail/instruction_set.hpp"
#include "unit/energy/naive.hpp"

namespace temper::test {
namespace {

constexpr double kMargin = 0.02, kBarrier = 0.003;

struct StarOf {
  const char* name;
  Real alpha, beta;
};
const StarOf kStarsOf[] = {
    {"0", 1.0L / 4, 1.0L / 12}, {"1", 1.0L / 3, 1.0L / 3}, {"2", 1.0L / 12, 1.0L / 4}, {"all", 2.0L / 3, 2.0L / 3}};

AccuracyModel model_of(const StarOf& star, double offset, double boundary_offset, double barrier = kBarrier) {
  AccuracyModel model =
      AccuracyModel::of(static_cast<double>(star.alpha), static_cast<double>(star.beta), offset, boundary_offset);
  model.margin = kMargin;
  model.barrier = barrier;
  return model;
}

VertexSizes uneven_sizes(const Mesh& mesh, double scale = 1) {
  VertexSizes sizes(mesh.n_vertices());
  Noise noise(7);
  for (double& s : sizes) s = scale * (1 + 0.2 * noise());
  return sizes;
}

struct Twin {
  const StarOf& star;
  Real offset, boundary_offset, barrier;
  const AccuracyFloors* lengths = nullptr;  ///< where those of edges count too
  const AccuracyFloors* floors = nullptr;   ///< of triangles that have less than `margin`
  Real margin = kMargin;
};

/// Moment and offset of an edge as they are defined, from d and h; its barrier from each triangle by itself.
Real twin_total(const Mesh& mesh, const VertexSizes& sizes, const Twin& twin, VertexId v, const NaivePoint& p) {
  const auto at = [&](VertexId u) {
    return u == v ? p : NaivePoint{mesh.point(u).x, mesh.point(u).y, mesh.point(u).w};
  };
  const auto side = [&](HalfedgeId h) {
    return naive_edge(mesh.space(), at(mesh.origin(h)), at(mesh.target(h)), at(mesh.opposite(h)));
  };
  const auto& [name, alpha, beta] = twin.star;
  Real sum = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    const NaiveEdge e = side(h);
    const VertexId i = mesh.origin(h), j = mesh.target(h);
    if (mesh.is_edge_representative(h)) {
      const bool boundary = !mesh.twin(h).valid();
      const Real s = (Real(sizes[i]) + Real(sizes[j])) / 2, delta = e.d_ij - e.l / 2;
      const Real other = boundary ? 0 : side(mesh.twin(h)).h_left, dual = e.h_left + other;
      const Real eta = (e.h_left - other) / 2;
      const Real moment = (alpha * e.l * e.l + beta * dual * dual) / 4;
      const Real weighted =
          twin.offset * alpha * delta * delta + (boundary ? twin.boundary_offset : twin.offset) * beta * eta * eta;
      sum += e.l * dual * (moment + 3 * weighted) / (s * s);
      if (twin.lengths != nullptr && !boundary) {
        const auto [factor, l2, dual2] = twin.lengths->lengths(mesh, h);
        sum -= Real(factor) * (std::log(e.l * e.l - Real(l2)) + std::log(dual * dual - Real(dual2))) / 2;
      }
    }
    const Real s = (Real(sizes[i]) + Real(sizes[j]) + Real(sizes[mesh.opposite(h)])) / 3;
    const Real f = twin.floors != nullptr ? Real((*twin.floors)[Mesh::triangle(h)]) : twin.margin;
    const Real factor = std::min<Real>(1000, 1 + 10 * (twin.margin * twin.margin / (f * f) - 1));
    sum -= twin.barrier * factor * s * s *
           (std::log(e.h_left / e.l - f) + std::log(e.d_ij / e.l - f) / 2 + std::log(e.d_ji / e.l - f) / 2);
  }
  return sum;
}

Mesh small_lattice(double scale = 1, Vec2 offset = {}, double radius = 0) {
  return lattice({.jitter = 0.08, .weight = 0.08, .scale = scale, .offset = offset, .radius = radius});
}

// In the plane, and on spheres of many edges' radius.
constexpr double kRadii[] = {0, 20, 300};

TEST(AccuracyEnergy, WithoutExtraWeightAndAtSizeOneIsHot) {
  const Mesh mesh = small_lattice();
  ASSERT_TRUE(has_margins(mesh, kMargin));
  const VertexSizes ones(mesh.n_vertices(), 1.0);
  for (int star = 0; star < 3; ++star) {
    EnergyModel hot;
    hot.kind = EnergyKind::F;
    hot.star = Star(star);
    const AccuracyModel model = model_of(kStarsOf[star], 1, 1);
    EXPECT_NEAR(accuracy_energy(mesh, ones, model) / total_energy(mesh, hot), 1, 1e-14) << star;
  }
}

TEST(AccuracyEnergy, OfAllStarsIsTheSumOfThreeAndTwiceStarOne) {
  const Mesh mesh = small_lattice();
  const VertexSizes sizes = uneven_sizes(mesh);
  double sum = 0;
  for (int star = 0; star < 3; ++star) sum += accuracy_energy(mesh, sizes, model_of(kStarsOf[star], 10, 18));
  const double all = accuracy_energy(mesh, sizes, model_of(kStarsOf[3], 10, 18));
  EXPECT_NEAR(all / sum, 1, 1e-14);
  EXPECT_NEAR(all / accuracy_energy(mesh, sizes, model_of(kStarsOf[1], 10, 18)), 2, 1e-14);
}

TEST(AccuracyEnergy, IsTheNaiveTwinsInTotalAndByParts) {
  for (const double radius : kRadii) {
    SCOPED_TRACE(radius);
    const Mesh mesh = small_lattice(1, {}, radius);
    ASSERT_TRUE(has_margins(mesh, kMargin));
    // On a sphere the squared length of a weighted vector, of which the weight is a part, is known to rounding.
    const double rounding = 1e-14 + 1e-16 * radius * radius;
    const VertexSizes sizes = uneven_sizes(mesh);
    AccuracyFloors floors;
    floors.raise(mesh, kMargin);
    for (const StarOf& star : kStarsOf) {
      const AccuracyTotal total = accuracy_total(mesh, {sizes, floors}, model_of(star, 10, 18));
      const Real plain = twin_total(mesh, sizes, {star, 10, 18, 0}, {}, {});
      const Real both = twin_total(mesh, sizes, {star, 10, 18, Real(kBarrier)}, {}, {});
      EXPECT_NEAR(total.energy / static_cast<double>(plain), 1, rounding) << star.name;
      EXPECT_NEAR((total.energy + total.barrier) / static_cast<double>(both), 1, rounding) << star.name;
      EXPECT_NEAR(accuracy_energy(mesh, sizes, model_of(star, 10, 18)) / total.energy, 1, 1e-14) << star.name;
    }
  }
}

TEST(AccuracyEnergy, OfWholeMeshesIsTheSameBitsInEveryInstructionSet) {
  const InstructionSet used = instruction_set();
  for (const double radius : kRadii) {
    SCOPED_TRACE(radius);
    const Mesh mesh = small_lattice(1, {}, radius);
    const VertexSizes sizes = uneven_sizes(mesh);
    AccuracyFloors floors;
    floors.raise(mesh, kMargin);
    const AccuracyModel model = model_of(kStarsOf[1], 10, 18);
    ASSERT_TRUE(use_instruction_set(instruction_sets().front()));
    const AccuracyTotal first = accuracy_total(mesh, {sizes, floors}, model);
    for (const InstructionSet set : instruction_sets()) {
      ASSERT_TRUE(use_instruction_set(set));
      const AccuracyTotal other = accuracy_total(mesh, {sizes, floors}, model);
      EXPECT_EQ(other.energy, first.energy) << name(set);
      EXPECT_EQ(other.barrier, first.barrier) << name(set);
      EXPECT_EQ(accuracy_total(mesh, {sizes, floors}, model, nullptr, false).barrier, first.barrier) << name(set);
    }
  }
  use_instruction_set(used);
}

TEST(AccuracyEnergy, ScalesWithTheSquareAndKnowsNeitherPlaceNorTurnNorACommonWeight) {
  const Mesh mesh = small_lattice();
  const VertexSizes sizes = uneven_sizes(mesh);
  const AccuracyModel model = model_of(kStarsOf[1], 10, 18);
  const double energy = accuracy_energy(mesh, sizes, model);
  const auto moved = [&](double scale, double angle, Vec2 by, double shift) {
    Mesh other = mesh;
    const double c = std::cos(angle), s = std::sin(angle);
    for (const VertexId v : mesh.vertices()) {
      const WeightedPoint p = mesh.point(v);
      other.set_point(
          v, {scale * (c * p.x - s * p.y) + by.x, scale * (s * p.x + c * p.y) + by.y, scale * scale * p.w + shift});
    }
    return accuracy_energy(other, uneven_sizes(mesh, scale), model);
  };
  EXPECT_EQ(moved(0.125, 0, {}, 0), energy / 64);  // a power of two: exactly
  EXPECT_NEAR(moved(3, 0, {}, 0), 9 * energy, 1e-12 * energy);
  EXPECT_NEAR(moved(1, 0.7, {}, 0), energy, 1e-12 * energy);
  EXPECT_NEAR(moved(1, 0, {5, -3}, 0), energy, 1e-12 * energy);
  EXPECT_NEAR(moved(1, 0, {}, 2.5), energy, 1e-12 * energy);
  // Sizes as large again make a quarter.
  EXPECT_EQ(accuracy_energy(mesh, uneven_sizes(mesh, 2), model), energy / 4);
}

TEST(AccuracyPatch, ChangesByWhatTheWholeChanges) {
  AccuracyPatch star;
  int cases = 0;
  for (const double radius : kRadii) {
    Mesh mesh = small_lattice(1, {}, radius);
    const VertexSizes sizes = uneven_sizes(mesh);
    AccuracyFloors floors;
    floors.raise(mesh, kMargin);
    for (const StarOf& of : kStarsOf) {
      const AccuracyModel model = model_of(of, 10, 18);
      for (const VertexId v : mesh.vertices()) {
        const WeightedPoint p = mesh.point(v), there = along(mesh.space(), p, {0.02, -0.015, 0.01}, 1);
        ASSERT_TRUE(star.gather(mesh, sizes, floors, model, v));
        const double change = star.value(there) - star.value(p);
        ASSERT_TRUE(std::isfinite(change)) << v.index;
        const auto total = [&] {
          const AccuracyTotal all = accuracy_total(mesh, {sizes, floors}, model);
          return all.energy + all.barrier;
        };
        const double before = total();
        mesh.set_point(v, there);
        EXPECT_NEAR(total() - before, change, (1e-13 + 1e-15 * radius * radius) * before)
            << v.index << " of star " << of.name << ", radius " << radius;
        mesh.set_point(v, p);
        ++cases;
      }
    }
  }
  EXPECT_EQ(cases, 3 * 4 * 25);
}

/// Largest errors of the analytic derivatives against central differences of the twin, in units of the largest ones.
struct AccuracyErrors {
  Real gradient = 0, hessian = 0;
};

AccuracyErrors errors_at(const Mesh& mesh, const VertexSizes& sizes, const Twin& twin, VertexId v,
                         const VertexDerivatives& exact, Real step, Real scale) {
  const Real h[3] = {step * scale, step * scale, step * scale * scale}, unit[3] = {scale, scale, scale * scale};
  const auto at = [&](std::array<int, 3> k) {
    return twin_total(mesh, sizes, twin, v, naive_step(mesh, v, k[0] * h[0], k[1] * h[1], k[2] * h[2]));
  };
  const auto toward = [](std::size_t i, int a, std::size_t j, int b) {
    std::array<int, 3> k = {};
    k[i] += a;
    k[j] += b;
    return k;
  };
  AccuracyErrors e;
  Real size_g = 0, size_h = 0;
  std::size_t entry = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Real g = (at(toward(i, 1, i, 0)) - at(toward(i, -1, i, 0))) / (2 * h[i]);
    e.gradient = std::max(e.gradient, std::abs(g - Real(exact.gradient[i])) * unit[i]);
    size_g = std::max(size_g, std::abs(g) * unit[i]);
    for (std::size_t j = i; j < 3; ++j, ++entry) {
      const Real second = i == j ? (at(toward(i, 1, i, 0)) - 2 * at({}) + at(toward(i, -1, i, 0))) / (h[i] * h[i])
                                 : (at(toward(i, 1, j, 1)) - at(toward(i, 1, j, -1)) - at(toward(i, -1, j, 1)) +
                                    at(toward(i, -1, j, -1))) /
                                       (4 * h[i] * h[j]);
      e.hessian = std::max(e.hessian, std::abs(second - Real(exact.hessian[entry])) * unit[i] * unit[j]);
      size_h = std::max(size_h, std::abs(second) * unit[i] * unit[j]);
    }
  }
  return {e.gradient / (size_g + size_h), e.hessian / size_h};
}

TEST(AccuracyPatch, HasDerivativesToWhichDifferencesOfTheTwinConvergeWithOrderTwo) {
  struct Place {
    double scale, radius;
  };
  int cases = 0;
  for (const auto& [scale, radius] :
       {Place{1, 0}, Place{0x1p-30, 0}, Place{1, 20}, Place{0x1p-30, 20}, Place{1, 300}}) {
    const Mesh mesh = small_lattice(scale, {3 * scale, -scale}, radius);
    const VertexSizes sizes = uneven_sizes(mesh, scale);
    AccuracyFloors floors;
    floors.raise(mesh, kMargin);
    AccuracyPatch star;
    for (const StarOf& of : kStarsOf) {
      const AccuracyModel model = model_of(of, 10, 18);
      // Inside, next to the boundary, on it, and a corner of one triangle, of two.
      for (const std::size_t v : {12, 6, 2, 10, 0, 4, 24}) {
        ASSERT_TRUE(star.gather(mesh, sizes, floors, model, VertexId(v)));
        const WeightedPoint p = mesh.point(VertexId(v));
        ASSERT_TRUE(std::isfinite(star.value(p)));
        const VertexDerivatives exact = star.derivatives();
        const Twin twin{of, 10, 18, Real(kBarrier)};
        const auto errors = [&](Real step) { return errors_at(mesh, sizes, twin, VertexId(v), exact, step, scale); };
        const AccuracyErrors coarse = errors(2e-3L), fine = errors(1e-3L);
        const std::string what = "star " + std::string(of.name) + ", vertex " + std::to_string(v);
        EXPECT_NEAR(static_cast<double>(coarse.gradient / fine.gradient), 4, 0.2) << what;
        EXPECT_NEAR(static_cast<double>(coarse.hessian / fine.hessian), 4, 0.2) << what;
        EXPECT_LT(fine.gradient, 1e-3L) << what;
        EXPECT_LT(fine.hessian, 1e-3L) << what;
        ++cases;
      }
    }
  }
  EXPECT_EQ(cases, 5 * 4 * 7);
}

/// The model with lengths that some edges have, and others do not.
AccuracyModel with_lengths(AccuracyModel model) {
  model.min_edge = 0.9, model.min_dual = 0.5;
  return model;
}

/// The floors of all, with those of edges.
AccuracyFloors floors_with_lengths(const Mesh& mesh, const VertexSizes& sizes, const AccuracyModel& model) {
  AccuracyFloors floors;
  floors.raise(mesh, kMargin);
  floors.lengths.raise(mesh, sizes, model);
  return floors;
}

/// Expects the twin's total, changes and derivatives, to which its differences converge with order two.
void expect_twin(Mesh mesh, const VertexSizes& sizes, const AccuracyModel& model, const AccuracyFloors& floors,
                 const Twin& twin, double scale) {
  AccuracyPatch star;
  const AccuracyTotal total = accuracy_total(mesh, {sizes, floors}, model);
  EXPECT_NEAR((total.energy + total.barrier) / static_cast<double>(twin_total(mesh, sizes, twin, {}, {})), 1, 1e-12);
  for (const std::size_t v : {12, 6, 2, 10, 0, 4, 24}) {
    const VertexId center(v);
    const WeightedPoint p = mesh.point(center);
    ASSERT_TRUE(star.gather(mesh, sizes, floors, model, center));
    ASSERT_TRUE(std::isfinite(star.value(p)));
    const VertexDerivatives exact = star.derivatives();
    const auto errors = [&](Real step) { return errors_at(mesh, sizes, twin, center, exact, step, scale); };
    const AccuracyErrors coarse = errors(1e-3L), fine = errors(5e-4L);
    EXPECT_NEAR(static_cast<double>(coarse.gradient / fine.gradient), 4, 0.2) << v;
    EXPECT_NEAR(static_cast<double>(coarse.hessian / fine.hessian), 4, 0.2) << v;
    EXPECT_LT(fine.gradient, 1e-3L) << v;
    EXPECT_LT(fine.hessian, 1e-3L) << v;
    const WeightedPoint there = along(mesh.space(), p, {0.01 * scale, -0.008 * scale, 0.005 * scale * scale}, 1);
    const double change = star.value(there) - star.value(p);
    mesh.set_point(center, there);
    const AccuracyTotal after = accuracy_total(mesh, {sizes, floors}, model);
    EXPECT_NEAR((after.energy + after.barrier) - (total.energy + total.barrier), change, 1e-12 * total.energy) << v;
    mesh.set_point(center, p);
  }
}

TEST(AccuracyPatch, HasTheBarrierOfLengthsOfTheTwin) {
  struct Place {
    double scale, radius;
  };
  for (const auto& [scale, radius] : {Place{1, 0}, Place{0x1p-30, 0}, Place{1, 20}}) {
    const Mesh mesh = small_lattice(scale, {3 * scale, -scale}, radius);
    const VertexSizes sizes = uneven_sizes(mesh, scale);
    const AccuracyModel model = with_lengths(model_of(kStarsOf[1], 10, 18));
    const AccuracyFloors floors = floors_with_lengths(mesh, sizes, model);
    expect_twin(mesh, sizes, model, floors, {kStarsOf[1], 10, 18, Real(kBarrier), &floors}, scale);
  }
}

TEST(AccuracyGradient, IsThatOfEachPatch) {
  int cases = 0;
  for (const double radius : kRadii) {
    Mesh mesh = small_lattice(1, {}, radius);
    const VertexSizes sizes = uneven_sizes(mesh);
    for (const StarOf& of : kStarsOf) {
      const AccuracyModel plain = model_of(of, 10, 18);
      for (const AccuracyModel& model : {plain, with_lengths(plain)}) {
        const AccuracyDomain domain = {sizes, floors_with_lengths(mesh, sizes, model)};
        const auto gradient = accuracy_gradient(mesh, domain, model, nullptr);
        double largest = 0;
        for (const VertexId v : mesh.vertices()) {
          const WeightedPoint g = gradient[v];
          largest = std::max({largest, std::abs(g.x), std::abs(g.y), std::abs(g.w)});
        }
        AccuracyPatch star;
        for (const VertexId v : mesh.vertices()) {
          ASSERT_TRUE(star.gather(mesh, sizes, domain.floors, model, v));
          ASSERT_TRUE(std::isfinite(star.value(mesh.point(v))));
          const auto expected = star.derivatives().gradient;
          const WeightedPoint g = gradient[v];
          const double rounding = (1e-13 + 1e-15 * radius * radius) * largest;
          EXPECT_NEAR(g.x, expected[0], rounding) << v.index << " of star " << of.name << ", radius " << radius;
          EXPECT_NEAR(g.y, expected[1], rounding) << v.index;
          EXPECT_NEAR(g.w, expected[2], rounding) << v.index;
          ++cases;
        }
      }
    }
  }
  EXPECT_EQ(cases, 3 * 4 * 2 * 25);
}

TEST(AccuracyGradient, IsZeroWhereATriangleHasNoFloor) {
  Mesh mesh = small_lattice();
  const VertexSizes sizes = uneven_sizes(mesh);
  const AccuracyModel model = model_of(kStarsOf[1], 10, 18);
  mesh.set_weight(VertexId(12), mesh.weight(VertexId(12)) + 2);  // its triangles are not well-centered
  AccuracyDomain domain = {sizes, {}};
  domain.floors.raise(mesh, kMargin);
  const auto gradient = accuracy_gradient(mesh, domain, model, nullptr);
  AccuracyPatch star;
  int stays = 0;
  for (const VertexId v : mesh.vertices()) {
    const bool may = star.gather(mesh, sizes, domain.floors, model, v);
    const WeightedPoint g = gradient[v];
    EXPECT_EQ(g.x == 0 && g.y == 0 && g.w == 0, !may) << v.index;
    stays += may ? 0 : 1;
  }
  EXPECT_GT(stays, 6);
  EXPECT_LT(stays, 25);
}

TEST(AccuracyPatch, HasTheFactorsOfThinTrianglesOfTheTwin) {
  for (const double radius : {0.0, 20.0}) {
    const Mesh mesh = small_lattice(1, {}, radius);
    const VertexSizes sizes = uneven_sizes(mesh);
    AccuracyModel model = model_of(kStarsOf[1], 10, 18);
    for (const double margin : {0.3, 8.0}) {  // with the second, factors have their upper limit
      model.margin = margin;
      AccuracyFloors floors;
      floors.raise(mesh, margin);
      expect_twin(mesh, sizes, model, floors, {kStarsOf[1], 10, 18, Real(kBarrier), nullptr, &floors, margin}, 1);
    }
  }
}

TEST(LengthFloors, AreWhatIsAskedForWhereItIsThereElseALittleLessAndNeverFall) {
  const Mesh mesh = lattice({.jitter = 0.3, .weight = 0.1, .seed = 5});
  const VertexSizes sizes(mesh.n_vertices(), 1.0);
  const AccuracyModel model = with_lengths(model_of(kStarsOf[1], 10, 18));
  LengthFloors floors;
  EXPECT_GT(floors.raise(mesh, sizes, model), 0U);
  double asked_for = 0;
  int there = 0, shorter = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_boundary(h) || !mesh.is_edge_representative(h)) continue;
    const auto [factor, l2, dual2] = floors(mesh, h);
    EXPECT_EQ(floors(mesh, mesh.twin(h)).l2, l2);
    const double edge = length(mesh.position(mesh.target(h)) - mesh.position(mesh.origin(h)));
    asked_for = std::max(asked_for, std::sqrt(l2));
    EXPECT_LT(l2, edge * edge);
    ++(edge > 0.96 ? there : shorter);
    if (edge <= 0.95) {
      EXPECT_NEAR(std::sqrt(l2), 0.9 * edge, 1e-15);
      EXPECT_GT(factor, kBarrier);
    }
  }
  EXPECT_GE(asked_for, model.min_edge);
  EXPECT_GT(there, 0);
  EXPECT_GT(shorter, 0);
  const LengthFloors before = floors;
  floors.raise(lattice({.jitter = 0, .weight = 0, .scale = 0.5}), sizes, model);
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_boundary(h)) continue;
    EXPECT_GE(floors(mesh, h).l2, before(mesh, h).l2);
  }
}

TEST(AccuracyPatch, IsInfiniteOutsideOfItsMargins) {
  const Mesh mesh = small_lattice();
  const VertexSizes sizes = uneven_sizes(mesh);
  const AccuracyModel model = model_of(kStarsOf[1], 10, 18);
  AccuracyFloors floors;
  floors.raise(mesh, kMargin);
  AccuracyPatch star;
  ASSERT_TRUE(star.gather(mesh, sizes, floors, model, VertexId(12)));
  const WeightedPoint p = mesh.point(VertexId(12));
  int finite = 0, infinite = 0;
  Noise noise(3);
  Mesh there = mesh;
  for (int i = 0; i < 2000; ++i) {
    const WeightedPoint q{p.x + noise(), p.y + noise(), p.w + 0.5 * noise()};
    there.set_point(VertexId(12), q);
    double margin = 1;
    for (const HalfedgeId h : there.star(VertexId(12))) {
      margin = std::min(margin, triangle_margin(there, Mesh::triangle(h)));
    }
    if (std::abs(margin - kMargin) < 1e-12) continue;  // rounding may decide
    EXPECT_EQ(std::isfinite(star.value(q)), margin > kMargin) << margin;
    ++(margin > kMargin ? finite : infinite);
  }
  EXPECT_GT(finite, 20);
  EXPECT_GT(infinite, 20);
}

TEST(AccuracyFloors, AreOfEachTriangleAndNeverFall) {
  Mesh mesh = lattice({.jitter = 0.3, .weight = 0.1, .seed = 5});
  AccuracyFloors floors;
  floors.raise(mesh, 0.2);
  int whole = 0, part = 0, none = 0;
  for (const TriangleId t : mesh.triangles()) {
    const double margin = triangle_margin(mesh, t);
    EXPECT_EQ(floors.has(t), margin > 0);
    if (margin > 0.2) {
      EXPECT_EQ(floors[t], 0.2);
    } else if (margin > 0) {
      EXPECT_NEAR(floors[t], 0.9 * margin * std::min(1.0, std::sqrt(margin / 0.1)), 1e-15);
    }
    ++(margin > 0.2 ? whole : margin > 0 ? part : none);
  }
  EXPECT_GT(whole, 0);
  EXPECT_GT(part, 0);
  EXPECT_GT(none, 0);
  const AccuracyFloors before = floors;
  const Mesh regular = lattice({.jitter = 0, .weight = 0});
  floors.raise(regular, 0.2);
  for (const TriangleId t : mesh.triangles())
    EXPECT_EQ(floors[t], before.has(t) ? 0.2 : 0) << "raised, or none for ever";
  AccuracyFloors again = floors;
  again.raise(mesh, 0.2);
  for (const TriangleId t : mesh.triangles()) EXPECT_EQ(again[t], floors[t]);
}

TEST(PortableLog, IsTheLogarithm) {
  Noise noise(11);
  for (int i = 0; i < 20000; ++i) {
    const double x = std::ldexp(1 + 0.5 * (noise() + 1), static_cast<int>(500 * noise()));
    EXPECT_NEAR(portable_log(x), std::log(x), 4e-16 * (1 + std::abs(std::log(x)))) << x;
  }
  EXPECT_EQ(portable_log(1.0), 0);
}

}  // namespace
}  // namespace temper::test
