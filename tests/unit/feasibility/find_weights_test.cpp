// Weights for whole meshes: what was asked for is there, exactly; what cannot be is proved.
#include "unit/feasibility/support.hpp"

namespace temper::test {
namespace {

// What a margin may lack: the solver's tolerance on its own rows, which differ from h/ℓ by its scaling.
constexpr double kLacking = 1e-7;

void expect_true_report(const Mesh& mesh, const WeightReport& report, double margin) {
  const Mesh weighted = with_weights(mesh, report.weights);
  EXPECT_NEAR(report.attained, weight_margin(weighted), 1e-12);
  switch (report.verdict) {
    case Feasibility::feasible:
      EXPECT_EQ(bad_triangles(weighted), 0u);
      if (report.solved) {
        EXPECT_GE(report.attained, margin - kLacking);
      }
      break;
    case Feasibility::infeasible:
      EXPECT_EQ(report.certificate.margin, 0);
      EXPECT_EQ(check_certificate(mesh, report.certificate), CertificateCheck::proves);
      EXPECT_FALSE(report.solved);
      EXPECT_LE(report.margin, 1e-9);
      break;
    case Feasibility::undecided:
      ADD_FAILURE() << "undecided, margin " << report.margin;
  }
}

TEST(FindWeights, AreRightWhateverTheVerdictOnJitteredLattices) {
  std::size_t feasible = 0, infeasible = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Mesh mesh = jittered_lattice(seed);
    const WeightReport whole = weights_of(mesh), local = weights_of(mesh, {.whole = 0});
    expect_true_report(mesh, whole, 0.01);
    expect_true_report(mesh, local, 0.01);
    EXPECT_EQ(whole.verdict, local.verdict) << seed;
    EXPECT_EQ(whole.solved, local.solved) << seed;
    if (whole.solved) {
      EXPECT_LE(whole.change, local.change * (1 + 1e-3) + kLacking) << seed;
    }
    (whole.verdict == Feasibility::feasible ? feasible : infeasible) += 1;
  }
  EXPECT_GT(feasible, 5u);
  EXPECT_GT(infeasible, 5u);
}

TEST(FindWeights, AreRightOnRandomTriangulations) {
  std::size_t feasible = 0, infeasible = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng(seed);
    const Mesh mesh = mesh_of_random_points(rng, static_cast<int>(seed % 12));
    const WeightReport report = weights_of(mesh, {.goal = WeightGoal::margin});
    expect_true_report(mesh, report, report.asked);
    EXPECT_EQ(report.margin_kind, MarginKind::exact);
    (report.verdict == Feasibility::feasible ? feasible : infeasible) += 1;
  }
  EXPECT_GT(feasible, 0u);
  EXPECT_GT(infeasible, 10u);
}

TEST(FindWeights, ChangeNothingWhereNothingIsBad) {
  const Mesh mesh = lattice({.jitter = 0, .weight = 0});
  for (const std::size_t whole : {std::size_t{0}, std::size_t{3000}}) {
    const WeightReport report = weights_of(mesh, {.whole = whole});
    EXPECT_TRUE(report.solved);
    EXPECT_EQ(report.verdict, Feasibility::feasible);
    EXPECT_EQ(report.moved, 0u);
    EXPECT_EQ(report.change, 0);
    EXPECT_EQ(report.programs, 0u);
  }
}

TEST(FindWeights, OfTheMeshAreWhereChangeStartsWhenAsked) {
  const Mesh mesh = lattice({.jitter = 0.05, .weight = 0.05, .seed = 5});
  ASSERT_EQ(bad_triangles(mesh), 0u);
  const WeightReport from_input = weights_of(mesh, {.margin = 1e-3, .from_input = true});
  EXPECT_EQ(from_input.moved, 0u);
  for (const VertexId v : mesh.vertices()) EXPECT_EQ(from_input.weights[v], mesh.weight(v));
  const WeightReport from_zero = weights_of(mesh, {.margin = 1e-3});
  Mesh forgotten = mesh;
  for (const VertexId v : forgotten.vertices()) forgotten.set_weight(v, 0);
  EXPECT_EQ(from_zero.weights, weights_of(forgotten, {.margin = 1e-3}).weights);
}

TEST(FindWeights, ScaleWithTheMesh) {
  const Mesh mesh = *horseshoe({.a = 9, .b = 4, .x = {1, 2}, .y = {1, 2}});
  const WeightReport report = weights_of(mesh, {.goal = WeightGoal::elastic});
  for (const double factor : {1e-6, 1e6}) {
    const WeightReport other = weights_of(scaled(mesh, factor), {.goal = WeightGoal::elastic});
    EXPECT_EQ(other.verdict, report.verdict);
    EXPECT_NEAR(other.margin, report.margin, 1e-8);
    EXPECT_NEAR(other.change / factor, report.change, 1e-6 * (1 + report.change));
  }
}

TEST(FindWeights, TakeHalfOfTheBestMarginWhenLessIsThereThanAskedFor) {
  std::size_t tried = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Mesh mesh = jittered_lattice(seed);
    const double best = margin_of(mesh).margin;
    if (best < 0.001) continue;
    ++tried;
    const double asked = std::min(2 * best, 0.49);
    const WeightReport feasible = weights_of(mesh, {.goal = WeightGoal::margin, .margin = asked});
    EXPECT_TRUE(feasible.solved);
    EXPECT_NEAR(feasible.margin, best, 1e-8);
    EXPECT_NEAR(feasible.attained, best / 2, kLacking);
    const WeightReport minimal = weights_of(mesh, {.margin = asked});
    EXPECT_FALSE(minimal.solved);
    EXPECT_EQ(minimal.verdict, Feasibility::feasible);
    EXPECT_NEAR(minimal.margin, best, 1e-8);
    EXPECT_EQ(minimal.certificate.margin, asked);
    EXPECT_EQ(check_certificate(mesh, minimal.certificate), CertificateCheck::proves);
    for (const std::size_t whole : {3000, 8}) {
      const WeightReport elastic = weights_of(mesh, {.goal = WeightGoal::elastic, .margin = asked, .whole = whole});
      EXPECT_EQ(elastic.verdict, Feasibility::feasible) << seed;
      EXPECT_GE(elastic.attained, elastic.margin / 2 - kLacking) << "elastic weights make nothing bad " << seed;
      EXPECT_FALSE(elastic.violations.empty());
    }
  }
  EXPECT_GT(tried, 3u);
}

TEST(FindWeights, ElasticViolatesNothingWhereWeightsExist) {
  std::size_t tried = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Mesh mesh = jittered_lattice(seed);
    const WeightReport minimal = weights_of(mesh);
    const WeightReport elastic = weights_of(mesh, {.goal = WeightGoal::elastic});
    EXPECT_EQ(elastic.violations.empty(), minimal.solved) << seed;
    if (minimal.solved) {
      EXPECT_EQ(elastic.weights, minimal.weights);
    }
    ++tried;
  }
  EXPECT_GT(tried, 0u);
}

TEST(FindWeights, ElasticNamesTheTrianglesThatGiveWay) {
  const Mesh mesh = sparse_horseshoe();
  const WeightReport report = weights_of(mesh, {.goal = WeightGoal::elastic, .margin = 0});
  EXPECT_EQ(report.verdict, Feasibility::infeasible);
  EXPECT_TRUE(report.solved);
  ASSERT_FALSE(report.violations.empty());
  double last = kUnbounded, total = 0;
  for (const Violation& violation : report.violations) {
    EXPECT_LE(violation.shortfall, last);
    last = violation.shortfall;
    total += violation.shortfall;
    EXPECT_NEAR(violation.value, -violation.shortfall, 1e-15);
    if (violation.constraint.kind == WeightConstraint::Kind::height) {
      EXPECT_GT(violation.angle_deg, 0);
    }
  }
  // No weights do better: those of the best margin, and zero, among many.
  Noise noise(1);
  for (int i = 0; i < 200; ++i) {
    Mesh other = with_weights(mesh, report.weights);
    for (const VertexId v : other.vertices()) other.set_weight(v, other.weight(v) + std::pow(0.9, i) * noise());
    double violated = 0;
    for (const HalfedgeId h : other.halfedges()) {
      const WeightedPoint p = other.point(other.origin(h)), q = other.point(other.target(h));
      const double l = length(q.position() - p.position());
      violated += std::max(0.0, -signed_height(p, q, other.point(other.opposite(h))) / l);
      if (!other.is_edge_representative(h)) continue;
      violated += std::max(0.0, -dual_crossing(p, q) / l) + std::max(0.0, -dual_crossing(q, p) / l);
    }
    EXPECT_GE(violated, total - kLacking);
  }
}

TEST(FindWeights, LocalProgramsDoNotTouchWhatIsFarAway) {
  // A large good lattice with one vertex pushed out of place.
  Mesh mesh = lattice({.n = 60, .jitter = 0, .weight = 0});
  const VertexId pushed(std::size_t{30 * 60 + 30});
  mesh.set_position(pushed, mesh.position(pushed) + Vec2{0.45, 0.1});
  ASSERT_GT(bad_triangles(mesh), 0u);
  const WeightReport report = weights_of(mesh, {.whole = 100});
  EXPECT_TRUE(report.solved);
  EXPECT_EQ(report.programs, 1u);
  EXPECT_LT(report.largest, 200u);
  EXPECT_GT(report.moved, 0u);
  EXPECT_EQ(bad_triangles(with_weights(mesh, report.weights)), 0u);
  for (const VertexId v : mesh.vertices()) {
    if (length(mesh.position(v) - mesh.position(pushed)) > 8) {
      EXPECT_EQ(report.weights[v], 0);
    }
  }
}

TEST(FindWeights, ProveInfeasibilityFromANeighborhood) {
  // Pushed so far that its own triangles cannot be cured.
  Mesh mesh = lattice({.n = 40, .jitter = 0, .weight = 0});
  const VertexId pushed(std::size_t{20 * 40 + 20});
  mesh.set_position(pushed, mesh.position(pushed) + Vec2{0.85, 0.0});
  ASSERT_EQ(mesh.validate(), std::nullopt);
  const WeightReport report = weights_of(mesh, {.whole = 100});
  EXPECT_EQ(report.verdict, Feasibility::infeasible);
  EXPECT_EQ(report.margin_kind, MarginKind::at_most);
  EXPECT_LT(report.largest, 400u);
  EXPECT_EQ(check_certificate(mesh, report.certificate), CertificateCheck::proves);
  EXPECT_GE(report.margin, margin_of(mesh).margin - 1e-8);
}

TEST(FindWeights, RefuseMarginsThatMakeNoSense) {
  const auto solver = clp_solver();
  for (const double margin : {-1.0, 0.0, 0.5, std::numeric_limits<double>::quiet_NaN()}) {
    const auto report = find_weights(sparse_horseshoe(), *solver, {.margin = margin});
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::invalid_option);
  }
}

/// A solver that always gives up.
class Failing final : public LpSolver {
 public:
  LpSolution solve(const LpProblem&) override { return {}; }
};

TEST(FindWeights, DecideNothingWithASolverThatFails) {
  Failing solver;
  for (const WeightGoal goal : {WeightGoal::margin, WeightGoal::change, WeightGoal::elastic}) {
    for (const std::size_t whole : {std::size_t{0}, std::size_t{3000}}) {
      const auto report = find_weights(*horseshoe(), solver, {.goal = goal, .whole = whole});
      ASSERT_TRUE(report);
      EXPECT_EQ(report->verdict, Feasibility::undecided);
      EXPECT_FALSE(report->solved);
      EXPECT_TRUE(report->certificate.terms.empty());
    }
  }
}

}  // namespace
}  // namespace temper::test
