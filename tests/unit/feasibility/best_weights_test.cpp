// The analytic center and the least offsets: laws of a unique minimum, a formula of another form, and the gap.
#include <algorithm>
#include <cmath>
#include <set>

#include "base/rng.hpp"
#include "support/spheres.hpp"
#include "unit/feasibility/support.hpp"

namespace temper::test {
namespace {

constexpr WeightGoal kConvex[] = {WeightGoal::center, WeightGoal::accuracy};

/// The least relative gap that is asked for.
constexpr double kGap = 1e-8;

WeightReport best_of(const Mesh& mesh, const WeightOptions& options) {
  const auto lp = clp_solver();
  const auto convex = interior_point_solver();
  auto report = find_weights(mesh, *lp, options, convex.get());
  if (!report) ADD_FAILURE() << report.error().what();
  return report ? *std::move(report) : WeightReport();
}

/// Meshes that have weights, with those of the program.
std::vector<Mesh> curable_meshes(std::size_t count) {
  std::vector<Mesh> meshes;
  for (std::uint64_t seed = 1; meshes.size() < count && seed < 200; ++seed) {
    Mesh mesh = jittered_lattice(seed);
    if (weights_of(mesh).solved) meshes.push_back(std::move(mesh));
  }
  EXPECT_EQ(meshes.size(), count);
  return meshes;
}

/// h/ℓ, d/ℓ and 1 − d/ℓ of the plane from orthocenters, not from linear forms. Adds the logarithms of all.
double sum_of_logarithms(const Mesh& mesh) {
  double sum = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [p, q, r] = mesh.points(t);
    const Vec2 o = orthocenter(p, q, r);
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(t, k);
      const Vec2 a = mesh.position(mesh.origin(h)), along = mesh.position(mesh.target(h)) - a;
      const double l2 = squared_length(along);
      sum += std::log(cross(along, o - a) / l2);
      if (mesh.is_edge_representative(h)) {
        const double d = dot(along, o - a) / l2;
        sum += std::log(d) + std::log(1 - d);
      }
    }
  }
  return sum;
}

/// The squared offsets of the plane from orthocenters, with the factors of the proof.
double offsets_of(const Mesh& mesh, const std::vector<OffsetTerm>& terms) {
  double sum = 0;
  const auto center = [&](VertexId p, VertexId q, VertexId r) {
    return orthocenter(mesh.point(p), mesh.point(q), mesh.point(r));
  };
  for (const auto& [at, factor, target] : terms) {
    const Vec2 p = mesh.position(at.p), along = mesh.position(at.q) - p;
    const double l2 = squared_length(along);
    double value = 0;
    if (at.kind == WeightConstraint::Kind::crossing) {
      value = 0.5 + (mesh.weight(at.p) - mesh.weight(at.q)) / (2 * l2);
    } else {
      const Vec2 o = center(at.p, at.q, at.r);
      value = cross(along, o - p) / l2;
      // The middle of the dual edge is (h_r − h_s)/2 to the left of the edge.
      if (at.kind == WeightConstraint::Kind::dual) value = cross(along, 0.5 * (o + center(at.q, at.p, at.s)) - p) / l2;
    }
    sum += factor * (value - target) * (value - target);
  }
  return sum;
}

double objective_of(const Mesh& mesh, const Optimality& proof) {
  return proof.goal == WeightGoal::center ? -sum_of_logarithms(mesh) : offsets_of(mesh, proof.offsets);
}

TEST(BestWeights, AreGoodWithASmallGap) {
  for (const Mesh& mesh : curable_meshes(8)) {
    for (const WeightGoal goal : kConvex) {
      const WeightReport report = best_of(mesh, {.goal = goal});
      ASSERT_TRUE(report.solved);
      EXPECT_EQ(report.verdict, Feasibility::feasible);
      const Mesh weighted = with_weights(mesh, report.weights);
      EXPECT_EQ(bad_triangles(weighted), 0u);
      EXPECT_NEAR(weight_margin(weighted), report.attained, 1e-12);
      EXPECT_GE(report.attained, goal == WeightGoal::accuracy ? 0.01 - 1e-9 : 0);
      ASSERT_TRUE(report.optimality);
      EXPECT_LE(report.optimality->relative_gap(), kGap);
      EXPECT_GE(report.optimality->gap, 0);
    }
  }
}

TEST(BestWeights, HaveTheObjectiveOfOrthocenters) {
  for (const Mesh& mesh : curable_meshes(4)) {
    for (const WeightGoal goal : kConvex) {
      const WeightReport report = best_of(mesh, {.goal = goal});
      ASSERT_TRUE(report.optimality);
      const double twin = objective_of(with_weights(mesh, report.weights), *report.optimality);
      EXPECT_NEAR(report.optimality->objective, twin, 1e-9 * std::abs(twin));
    }
  }
}

TEST(BestWeights, NoOtherGoodWeightsAreBetterThanTheGap) {
  Rng rng(3);
  for (const Mesh& mesh : curable_meshes(4)) {
    for (const WeightGoal goal : kConvex) {
      const WeightReport best = best_of(mesh, {.goal = goal});
      ASSERT_TRUE(best.optimality);
      const double least = best.optimality->objective - best.optimality->gap;
      const double rounding = 1e-12 * std::abs(least);
      const auto is_allowed = [&](const Mesh& other) {
        return bad_triangles(other) == 0 && weight_margin(other) >= best.optimality->margin;
      };
      std::size_t tried = 0;
      const IdVector<VertexId, double> changed = weights_of(mesh, {.margin = 0.0101}).weights;
      for (int k = 0; k <= 200; ++k) {  // on the way to weights of the linear program, and beside it
        const double way = k / 200.0, step = std::exp2(-5 - k % 20);
        Mesh other = with_weights(mesh, best.weights);
        for (const VertexId v : other.vertices())
          other.set_weight(v, (1 - way) * best.weights[v] + way * changed[v] + step * way * (rng.uniform() - 0.5));
        if (!is_allowed(other)) continue;
        EXPECT_GE(objective_of(other, *best.optimality), least - rounding);
        ++tried;
      }
      EXPECT_GT(tried, 20u);
    }
  }
}

TEST(BestWeights, TheSlopeOfTheCenterIsZero) {
  for (const Mesh& mesh : curable_meshes(3)) {
    const Mesh center = with_weights(mesh, best_of(mesh, {.goal = WeightGoal::center}).weights);
    for (const VertexId v : mesh.vertices()) {
      const auto at = [&](double change) {
        Mesh moved = center;
        moved.set_weight(v, moved.weight(v) + change);
        return sum_of_logarithms(moved);
      };
      constexpr double kStep = 1e-6;
      const double slope = (at(kStep) - at(-kStep)) / (2 * kStep);
      const double curvature = (at(kStep) + at(-kStep) - 2 * at(0)) / (kStep * kStep);
      EXPECT_LT(curvature, 0);
      EXPECT_NEAR(slope / curvature, 0, 1e-7);  // the distance to the maximum
    }
  }
}

TEST(BestWeights, DependOnNothingButTheMesh) {
  for (const Mesh& mesh : curable_meshes(3)) {
    for (const WeightGoal goal : kConvex) {
      const WeightReport report = best_of(mesh, {.goal = goal});
      const WeightReport again = best_of(mesh, {.goal = goal});
      EXPECT_EQ(again.weights, report.weights);
      // Weights of the input are no part of the problem.
      Mesh weighted = mesh;
      Rng rng(9);
      for (const VertexId v : weighted.vertices()) weighted.set_weight(v, rng.uniform());
      EXPECT_EQ(best_of(weighted, {.goal = goal}).weights, report.weights);
      for (const double factor : {0.37, 1e5}) {
        const WeightReport other = best_of(scaled(mesh, factor, {17 * factor, -5 * factor}), {.goal = goal});
        for (const VertexId v : mesh.vertices())
          EXPECT_NEAR(other.weights[v] / (factor * factor), report.weights[v], 1e-6);
      }
    }
  }
}

TEST(BestWeights, ProveOptimalityByTermsOfTheirOwnConstraints) {
  const Mesh mesh = curable_meshes(1).front();
  for (const WeightGoal goal : kConvex) {
    const Optimality proof = *best_of(mesh, {.goal = goal}).optimality;
    std::size_t heights = 0, crossings = 0;
    for (const auto& term : proof.terms) {
      EXPECT_GE(term.multiplier, 0);
      (term.constraint.kind == WeightConstraint::Kind::height ? heights : crossings) += 1;
    }
    EXPECT_EQ(heights, 3 * mesh.n_triangles());
    EXPECT_EQ(crossings, 2 * mesh.n_edges());
    EXPECT_EQ(proof.offsets.size(), goal == WeightGoal::center ? 0u : 2 * mesh.n_edges());
  }
}

TEST(BestWeights, TakeHalfOfTheBestMarginIfTheRequestedOneIsTooMuch) {
  for (const Mesh& mesh : curable_meshes(3)) {
    const double best = margin_of(mesh).margin;
    const WeightReport report = best_of(mesh, {.goal = WeightGoal::accuracy, .margin = 0.45});
    ASSERT_TRUE(report.solved);
    EXPECT_NEAR(report.asked, best / 2, 1e-9);
    EXPECT_GE(report.attained, report.asked - 1e-9);
    EXPECT_EQ(report.margin_kind, MarginKind::exact);
  }
}

TEST(BestWeights, OffsetsGrowWithTheMargin) {
  for (const Mesh& mesh : curable_meshes(3)) {
    const double best = margin_of(mesh).margin;
    double before = 0;
    for (const double part : {0.01, 0.3, 0.6, 0.9}) {
      const WeightReport report = best_of(mesh, {.goal = WeightGoal::accuracy, .margin = part * best});
      ASSERT_TRUE(report.optimality);
      EXPECT_GE(report.optimality->objective, before * (1 - kGap));
      before = report.optimality->objective;
    }
  }
}

TEST(BestWeights, WithoutWeightsTheProofIsThatOfTheLinearProgram) {
  for (const WeightGoal goal : kConvex) {
    const WeightReport report = best_of(sparse_horseshoe(), {.goal = goal});
    EXPECT_EQ(report.verdict, Feasibility::infeasible);
    EXPECT_FALSE(report.solved);
    EXPECT_FALSE(report.optimality);
    EXPECT_EQ(check_certificate(sparse_horseshoe(), report.certificate), CertificateCheck::proves);
  }
}

TEST(BestWeights, KeepOtherConstraints) {
  for (const Constraints constraints : {Constraints::heights_only, Constraints::regular}) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const Mesh mesh = jittered_lattice(seed);
      if (!weights_of(mesh, {.constraints = constraints}).solved) continue;
      for (const WeightGoal goal : kConvex) {
        const WeightReport report = best_of(mesh, {.goal = goal, .constraints = constraints});
        ASSERT_TRUE(report.solved) << seed;
        EXPECT_GT(weight_margin(with_weights(mesh, report.weights), constraints), 0);
        EXPECT_LE(report.optimality->relative_gap(), kGap);
      }
    }
  }
}

TEST(BestWeights, OfTheSphereHaveASmallGapAndMeanScaleOne) {
  const Mesh ball = *icosahedral({.level = 3});
  for (const WeightGoal goal : kConvex) {
    for (const Constraints constraints :
         {Constraints::well_centered, Constraints::heights_only, Constraints::regular}) {
      const WeightReport report = best_of(ball, {.goal = goal, .constraints = constraints});
      ASSERT_TRUE(report.solved);
      EXPECT_LE(report.optimality->relative_gap(), kGap);
      double sum = 0;
      for (const double w : report.weights) sum += 1 / std::sqrt(1 + w);
      const auto n = static_cast<double>(ball.n_vertices());
      EXPECT_NEAR(sum, n, goal == WeightGoal::center ? 1e-6 : 0.1 * n);
    }
  }
}

TEST(BestWeights, OfThePeriodicPlaneDoNotDependOnTheDomain) {
  const Mesh mesh = *random_periodic({.vertices = 60, .seed = 4});
  const Mesh shifted = [&] {
    Mesh other = mesh;
    for (const VertexId v : other.vertices()) {
      WeightedPoint p = other.point(v);
      p.x += 0.5, p.y += 0.25;
      other.set_point(v, other.space().in_domain(p));
    }
    return other;
  }();
  for (const WeightGoal goal : {WeightGoal::margin, WeightGoal::elastic}) {
    const WeightReport here = best_of(mesh, {.goal = goal}), there = best_of(shifted, {.goal = goal});
    EXPECT_EQ(here.verdict, there.verdict);
    EXPECT_NEAR(here.margin, there.margin, 1e-9);
    if (here.verdict != Feasibility::infeasible) continue;
    EXPECT_EQ(check_certificate(shifted, here.certificate), CertificateCheck::proves);
    EXPECT_EQ(check_certificate(mesh, there.certificate), CertificateCheck::proves);
  }
  for (const WeightGoal goal : kConvex) {
    const WeightReport here = best_of(mesh, {.goal = goal, .constraints = Constraints::regular});
    const WeightReport there = best_of(shifted, {.goal = goal, .constraints = Constraints::regular});
    ASSERT_TRUE(here.solved && there.solved);
    EXPECT_LE(here.optimality->relative_gap(), kGap);
    for (const VertexId v : mesh.vertices()) EXPECT_NEAR(here.weights[v], there.weights[v], 1e-7);
  }
}

TEST(BestWeights, NeedTheirSolverAndGoodFactors) {
  const auto lp = clp_solver();
  const auto convex = interior_point_solver();
  for (const WeightGoal goal : kConvex) {
    const auto report = find_weights(sparse_horseshoe(), *lp, {.goal = goal});
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::invalid_option);
  }
  for (const double factor : {-1.0, HUGE_VAL, static_cast<double>(NAN)}) {
    WeightOptions options = {.goal = WeightGoal::accuracy};
    options.offset_factor = factor;
    EXPECT_FALSE(find_weights(sparse_horseshoe(), *lp, options, convex.get()));
  }
}

// --- the solver -----------------------------------------------------------------------------------------------

TEST(InteriorPoint, FindsTheCenterOfAnInterval) {
  ConvexProblem problem;  // −ln x − ln(2 − x) − ln(2 − x): x = 2/3
  problem.n_columns = 1;
  problem.barrier = 1;
  for (const double a : {1.0, -1.0, -1.0}) {
    problem.rows.add_entry(0, a);
    problem.rows.end_row();
    problem.constants.push_back(a > 0 ? 0 : 2);
  }
  const ConvexSolution solution = interior_point_solver()->solve(problem);
  ASSERT_TRUE(solution.solved);
  EXPECT_NEAR(solution.primal[0], 2.0 / 3, 1e-9);
  EXPECT_NEAR(solution.dual[0], 1.5, 1e-6);
}

TEST(InteriorPoint, FindsTheNearestPointOfAHalfPlane) {
  ConvexProblem problem;  // ½ (x − 3)² + ½ (y − 1)² with x + y ≤ 2: (2, 0)
  problem.n_columns = 2;
  for (int k = 0; k < 2; ++k) {
    problem.squares.add_entry(k, 1);
    problem.squares.end_row();
    problem.rows.add_entry(k, -1);
  }
  problem.square_constants = {-3, -1};
  problem.rows.end_row();
  problem.constants = {2};
  const ConvexSolution solution = interior_point_solver()->solve(problem);
  ASSERT_TRUE(solution.solved);
  EXPECT_NEAR(solution.primal[0], 2, 1e-7);
  EXPECT_NEAR(solution.primal[1], 0, 1e-7);
  EXPECT_NEAR(solution.dual[0], 1, 1e-7);
}

TEST(InteriorPoint, ViolatesRowsWhereThatCostsLess) {
  for (const auto& [cost, x] : {std::pair(0.5, 2.5), {2.0, 2.0}, {0.05, 2.6}}) {
    ConvexProblem problem;  // ½ (x − 3)² with x ≤ 2, or at a cost, and x ≤ 2.6
    problem.n_columns = 1;
    problem.squares.add_entry(0, 1), problem.squares.end_row();
    problem.square_constants = {-3};
    for (const double most : {2.0, 2.6}) {
      problem.rows.add_entry(0, -1), problem.rows.end_row();
      problem.constants.push_back(most);
    }
    problem.violation_cost = {cost, kUnbounded};
    const ConvexSolution solution = interior_point_solver()->solve(problem);
    ASSERT_TRUE(solution.solved);
    EXPECT_NEAR(solution.primal[0], x, 1e-6);
    EXPECT_NEAR(solution.dual[0], std::min(cost, 3 - x), 1e-6);
    EXPECT_NEAR(solution.dual[1], 3 - x - solution.dual[0], 1e-6);
  }
}

TEST(InteriorPoint, GivesUpIfThereIsNoPoint) {
  ConvexProblem problem;  // x ≥ 1 and x ≤ −1
  problem.n_columns = 1;
  for (const double a : {1.0, -1.0}) {
    problem.rows.add_entry(0, a);
    problem.rows.end_row();
    problem.constants.push_back(-1);
  }
  problem.barrier = 1;
  EXPECT_FALSE(interior_point_solver()->solve(problem).solved);
  problem.barrier = 0;
  problem.squares.add_entry(0, 1);
  problem.squares.end_row();
  problem.square_constants = {-0.5};
  EXPECT_FALSE(interior_point_solver()->solve(problem).solved);
}

}  // namespace
}  // namespace temper::test
