// Constraints other than well-centeredness: heights alone, and dual lengths of all edges or of prescribed ones.
#include <map>

#include "feasibility/constraints.hpp"
#include "temper/regularity.hpp"
#include "unit/feasibility/support.hpp"

namespace temper::test {
namespace {

constexpr double kSolved = 1e-9;  // the solver's tolerance on well-scaled programs of a hundred rows

std::vector<HalfedgeId> inner_edges(const Mesh& mesh) {
  std::vector<HalfedgeId> edges;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_edge_representative(h) && !mesh.is_boundary(h)) edges.push_back(h);
  }
  return edges;
}

Mesh rotated(Mesh mesh, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  for (const VertexId v : mesh.vertices()) {
    const Vec2 p = mesh.position(v);
    mesh.set_position(v, {c * p.x - s * p.y, s * p.x + c * p.y});
  }
  return mesh;
}

bool keeps(const Mesh& mesh, Constraints constraints, const std::vector<HalfedgeId>& edges = {}) {
  const TriangleDemand demand(mesh, constraints, edges);
  return std::all_of(demand.cells().begin(), demand.cells().end(),
                     [&](CellId cell) { return demand.is_kept(cell, demand.weights()); });
}

TEST(ConditionsTable, HasARowForEachWithANameOfItsOwn) {
  std::map<std::string_view, int> names;
  for (const ConstraintsInfo& row : constraints_table()) {
    EXPECT_EQ(name(row.constraints), row.name);
    EXPECT_EQ(names[row.name]++, 0);
    EXPECT_FALSE(row.keeps.empty() || row.success.empty() || row.failure.empty());
  }
  EXPECT_EQ(names.size(), 5u);
}

// The naive twin: orthocenters and feet, edge by edge.
TEST(LinearForms, AreTheHeightsCrossingsAndDualLengthsOfTheMesh) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Mesh mesh = lattice({.jitter = 0.3, .weight = 0.4, .scale = 3, .seed = seed});
    const auto value = [&](const WeightConstraint& c) {
      return value_of(linear_form(mesh, c), [&](VertexId v) { return mesh.weight(v); });
    };
    for (const HalfedgeId h : mesh.halfedges()) {
      const WeightedPoint p = mesh.point(mesh.origin(h)), q = mesh.point(mesh.target(h));
      const Vec2 along = q.position() - p.position();
      const double l = length(along);
      const Vec2 left = orthocenter(p, q, mesh.point(mesh.opposite(h)));
      EXPECT_NEAR(value(height_constraint(mesh, h)), cross(along, left - p.position()) / (l * l), 1e-12);
      EXPECT_NEAR(value(split_constraint(mesh.origin(h), mesh.target(h))), dot(along, left - p.position()) / (l * l),
                  1e-12);
      if (mesh.is_boundary(h)) continue;
      const Vec2 right = orthocenter(q, p, mesh.point(mesh.opposite(mesh.twin(h))));
      EXPECT_NEAR(value(dual_constraint(mesh, h)), cross(along, left - right) / (l * l), 1e-12);
    }
  }
}

TEST(Demand, IsKeptAsTheExactPredicatesSay) {
  std::size_t heights = 0, regular = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Mesh mesh = lattice({.n = 3, .jitter = 0.3, .weight = 0.1, .seed = seed});
    EXPECT_EQ(keeps(mesh, Constraints::well_centered), bad_triangles(mesh) == 0);
    EXPECT_EQ(keeps(mesh, Constraints::well_centered), weight_margin(mesh) > 0);
    EXPECT_EQ(keeps(mesh, Constraints::heights_only), weight_margin(mesh, Constraints::heights_only) > 0);
    EXPECT_EQ(keeps(mesh, Constraints::regular), count_non_regular_edges(mesh) == 0);
    EXPECT_EQ(keeps(mesh, Constraints::regular), weight_margin(mesh, Constraints::regular) > 0);
    heights += keeps(mesh, Constraints::heights_only) ? 1 : 0, regular += keeps(mesh, Constraints::regular) ? 1 : 0;
  }
  EXPECT_TRUE(heights > 0 && heights < 20) << heights;
  EXPECT_GE(regular, heights);  // positive heights make positive dual lengths
}

TEST(Constraints, FewerAreNeverHarder) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Mesh mesh = jittered_lattice(seed);
    const double both = margin_of(mesh).margin, heights = margin_of(mesh, Constraints::heights_only).margin;
    EXPECT_GE(heights, both - kSolved);
    if (heights > 1e-6) {
      EXPECT_GT(margin_of(mesh, Constraints::regular).margin, 0.4);
    }
    const std::vector<HalfedgeId> all = inner_edges(mesh), some(all.begin(), all.begin() + 5);
    EXPECT_GE(margin_of(mesh, Constraints::regular, some).margin,
              margin_of(mesh, Constraints::regular).margin - kSolved);
  }
}

TEST(Constraints, HaveMarginsThatDoNotDependOnPlaceTurnSizeOrAConstantOnAllWeights) {
  const auto all_margins = [](const Mesh& mesh) {
    std::vector<double> margins;
    for (const ConstraintsInfo& row : constraints_table()) margins.push_back(margin_of(mesh, row.constraints).margin);
    return margins;
  };
  for (const Mesh& mesh : {*horseshoe(), jittered_lattice(3), pinwheel()}) {
    const std::vector<double> expected = all_margins(mesh);
    Mesh raised = mesh;
    for (const VertexId v : raised.vertices()) raised.set_weight(v, raised.weight(v) + 17);
    for (const Mesh& other :
         {scaled(mesh, 1e-3), scaled(mesh, 1e3), scaled(mesh, 1, {100, -1000}), rotated(mesh, 0.7), raised}) {
      const std::vector<double> margins = all_margins(other);
      for (std::size_t i = 0; i < margins.size(); ++i) EXPECT_NEAR(margins[i], expected[i], 1e-8) << i;
    }
    for (const ConstraintsInfo& row : constraints_table()) {
      EXPECT_NEAR(weight_margin(raised, row.constraints), weight_margin(mesh, row.constraints), 1e-12);
    }
  }
}

TEST(Constraints, RegularOfAllEdgesPrescribedAreThoseOfNone) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    const Mesh mesh = mesh_of_random_points(rng, static_cast<int>(seed % 12));
    const std::vector<HalfedgeId> all = inner_edges(mesh);
    if (all.empty()) continue;
    const BestMargin none = margin_of(mesh, Constraints::regular), each = margin_of(mesh, Constraints::regular, all);
    EXPECT_EQ(none.margin, each.margin);
    EXPECT_EQ(none.certificate, each.certificate);
    const WeightReport a = weights_of(mesh, {.constraints = Constraints::regular});
    const WeightReport b = weights_of(mesh, {.constraints = Constraints::regular, .edges = all});
    EXPECT_EQ(a.verdict, b.verdict);
    EXPECT_EQ(a.weights, b.weights);
  }
}

TEST(Constraints, RegularIsAllOrNothing) {
  EXPECT_NEAR(margin_of(*horseshoe(), Constraints::regular).margin, kMostMargin, kSolved);  // Delaunay
  const BestMargin none = margin_of(pinwheel(), Constraints::regular);
  EXPECT_NEAR(none.margin, 0, kSolved);
  EXPECT_EQ(check_certificate(pinwheel(), none.certificate), CertificateCheck::proves);
  EXPECT_EQ(none.certificate.constraints, Constraints::regular);
}

// The certificate of a vertex of the dual has no term too many: the edges of the others alone can be regular.
TEST(Constraints, RegularNeedsEveryEdgeOfTheCertificateOfThePinwheel) {
  const Mesh mesh = pinwheel();
  const Certificate certificate = margin_of(mesh, Constraints::regular).certificate;
  ASSERT_GE(certificate.terms.size(), 3u);
  std::vector<HalfedgeId> edges;
  for (const auto& term : certificate.terms) edges.push_back(mesh.find_halfedge(term.constraint.p, term.constraint.q));
  EXPECT_EQ(weights_of(mesh, {.constraints = Constraints::regular, .edges = edges}).verdict, Feasibility::infeasible);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    std::vector<HalfedgeId> others = edges;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const WeightReport report = weights_of(mesh, {.constraints = Constraints::regular, .edges = others});
    EXPECT_EQ(report.verdict, Feasibility::feasible);
    const Mesh weighted = with_weights(mesh, report.weights);
    for (const HalfedgeId h : others) EXPECT_TRUE(is_regular(weighted, h));
    EXPECT_FALSE(is_regular(weighted, edges[i]));
  }
}

struct Tally {
  std::size_t feasible = 0, infeasible = 0;
};

/// Every verdict is what exact arithmetic says of it.
void expect_true(const Mesh& mesh, const WeightReport& report, const WeightOptions& options, Tally& tally) {
  const Mesh weighted = with_weights(mesh, report.weights);
  EXPECT_NEAR(report.attained, weight_margin(weighted, options.constraints, options.edges), 1e-12);
  EXPECT_NE(report.verdict, Feasibility::undecided) << report.margin;
  if (report.verdict == Feasibility::feasible) {
    ++tally.feasible;
    EXPECT_TRUE(keeps(weighted, options.constraints, options.edges));
    if (report.solved && options.constraints != Constraints::coefficients) {  // there, a small one may stay as it is
      EXPECT_GE(report.attained, report.asked - 1e-7);
    }
  } else {
    ++tally.infeasible;
    EXPECT_EQ(report.certificate.constraints, options.constraints);
    EXPECT_EQ(check_certificate(mesh, report.certificate), CertificateCheck::proves);
  }
}

TEST(FindWeights, AreRightUnderEveryConditionForTheWholeAndByNeighborhoods) {
  for (const ConstraintsInfo& row : constraints_table()) {
    Tally tally;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      Rng rng(seed);
      for (const Mesh& mesh : {mesh_of_random_points(rng, static_cast<int>(seed % 12)), jittered_lattice(seed)}) {
        WeightOptions options = {.constraints = row.constraints};
        const WeightReport whole = weights_of(mesh, options);
        expect_true(mesh, whole, options, tally);
        options.whole = 0;
        const WeightReport local = weights_of(mesh, options);
        expect_true(mesh, local, options, tally);
        EXPECT_EQ(whole.verdict, local.verdict) << row.name << " " << seed;
        EXPECT_EQ(whole.solved, local.solved) << row.name << " " << seed;
        options.goal = WeightGoal::margin;
        expect_true(mesh, weights_of(mesh, options), options, tally);
      }
    }
    EXPECT_GT(tally.feasible, 20u) << row.name;
    if (!TriangleDemand(pinwheel(), row.constraints).has_duals()) {
      EXPECT_GT(tally.infeasible, 20u) << row.name;
    }
  }
}

TEST(FindWeights, AreRightForPrescribedEdgesOfRandomTriangulations) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng(seed);
    const Mesh mesh = mesh_of_random_points(rng, 12);
    WeightOptions options = {.constraints = Constraints::regular};
    for (const HalfedgeId h : inner_edges(mesh)) {
      if (rng.below(3) != 0) options.edges.push_back(h);
    }
    for (const std::size_t whole : {std::size_t{0}, std::size_t{3000}}) {
      options.whole = whole;
      expect_true(mesh, weights_of(mesh, options), options, tally);
    }
  }
  EXPECT_GT(tally.feasible, 10u);
}

TEST(FindWeights, ElasticViolationsAreOfTheConditionsAsked) {
  for (const ConstraintsInfo& row : constraints_table()) {
    const bool with_duals = TriangleDemand(pinwheel(), row.constraints).has_duals();
    const Mesh mesh = with_duals ? pinwheel() : *horseshoe();
    const WeightReport report = weights_of(mesh, {.goal = WeightGoal::elastic, .constraints = row.constraints});
    EXPECT_EQ(report.verdict, Feasibility::infeasible) << row.name;
    EXPECT_TRUE(report.solved) << row.name;
    ASSERT_FALSE(report.violations.empty()) << row.name;
    for (const Violation& violation : report.violations) {
      using Kind = WeightConstraint::Kind;
      const Kind kind = violation.constraint.kind;
      EXPECT_TRUE(with_duals ? kind != Kind::crossing : kind != Kind::dual);
      EXPECT_TRUE(row.constraints != Constraints::regular || kind == Kind::dual);
      if (row.constraints == Constraints::heights_only) {
        EXPECT_EQ(kind, Kind::height);
      }
    }
  }
}

TEST(FindWeights, RefuseEdgesThatAreNoneOrForOtherConditions) {
  const auto solver = clp_solver();
  const Mesh mesh = sparse_horseshoe();
  const auto other = find_weights(mesh, *solver, {.edges = {HalfedgeId(std::size_t{0})}});
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().code, ErrorCode::invalid_option);
  EXPECT_EQ(other.error().what(), "edges: only constraints regular are about some edges");
  const HalfedgeId end(mesh.n_halfedges());
  const auto none = find_weights(mesh, *solver, {.constraints = Constraints::regular, .edges = {end}});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::index_out_of_range);
  EXPECT_EQ(none.error().what(),
            "edges: expected halfedges 0 to " + std::to_string(end.index - 1) + ", found " + std::to_string(end.index));
}

TEST(Certificate, OfHeightsAloneProvesAndIsOfHeightsAlone) {
  for (const Mesh& mesh : {*horseshoe(), scaled(*horseshoe(), 1e6), scaled(*horseshoe(), 1, {100, -1000})}) {
    const BestMargin best = margin_of(mesh, Constraints::heights_only);
    ASSERT_FALSE(best.certificate.terms.empty());
    EXPECT_EQ(check_certificate(mesh, best.certificate), CertificateCheck::proves);
    Certificate other = best.certificate;
    other.constraints = Constraints::regular;  // heights do not count there
    EXPECT_EQ(check_certificate(mesh, other), CertificateCheck::not_of_this_mesh);
    other = best.certificate;
    other.terms.push_back(
        {{WeightConstraint::Kind::crossing, other.terms[0].constraint.p, other.terms[0].constraint.q, VertexId()}, 1});
    EXPECT_EQ(check_certificate(mesh, other), CertificateCheck::not_of_this_mesh);
    for (std::size_t i = 0; i < best.certificate.terms.size(); ++i) {
      Certificate corrupted = best.certificate;
      corrupted.terms[i].multiplier *= 1e12;  // as if it were alone
      EXPECT_EQ(check_certificate(mesh, corrupted), CertificateCheck::proves_nothing) << i;
    }
  }
}

TEST(Certificate, OfDualLengthsProvesNothingWhenAMultiplierOrAVertexIsChanged) {
  const Mesh mesh = pinwheel();
  const Certificate certificate = margin_of(mesh, Constraints::regular).certificate;
  ASSERT_FALSE(certificate.terms.empty());
  for (std::size_t i = 0; i < certificate.terms.size(); ++i) {
    Certificate corrupted = certificate;
    corrupted.terms[i].multiplier *= 1.01;
    EXPECT_EQ(check_certificate(mesh, corrupted), CertificateCheck::proves_nothing) << i;
    corrupted = certificate;
    std::swap(corrupted.terms[i].constraint.r, corrupted.terms[i].constraint.s);
    EXPECT_EQ(check_certificate(mesh, corrupted), CertificateCheck::not_of_this_mesh);
    corrupted.terms[i].constraint.s = VertexId();
    EXPECT_EQ(check_certificate(mesh, corrupted), CertificateCheck::not_of_this_mesh);
  }
}

// The bound on what rounding leaves of the weights is that of the constraints: an orthocenter in its triangle.
TEST(Certificate, OfHeightsAloneBoundsWeightsByTheirTriangle) {
  Rng rng(7);
  std::size_t beyond = 0, tried = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto point = [&] { return Vec2{rng.uniform(-1, 1), rng.uniform(-1, 1)}; };
    const std::array<Vec2, 3> x = {point(), point(), point()};
    // Any point of the triangle is its orthocenter, with these weights.
    const double a = rng.uniform(0, 1), b = rng.uniform(0, 1 - a);
    const Vec2 o = x[0] + a * (x[1] - x[0]) + b * (x[2] - x[0]);
    for (int k = 0; k < 3; ++k) {
      const Vec2 p = x[k], q = x[(k + 1) % 3], r = x[(k + 2) % 3];
      const double difference = std::abs(squared_length(p - o) - squared_length(q - o));
      const double edge = squared_length(p - q), across = std::abs(squared_length(p - r) - squared_length(q - r));
      EXPECT_LE(difference, std::max(edge, across) * (1 + 1e-12));
      beyond += difference > edge ? 1 : 0;
      ++tried;
    }
  }
  EXPECT_GT(beyond, 0u);  // the crossing's own bound would not have held
  EXPECT_EQ(tried, 6000u);
}

}  // namespace
}  // namespace temper::test
