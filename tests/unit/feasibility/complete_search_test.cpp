// The complete search over connectivities: all triangulations of small point sets are the oracle, and proofs that were
// tampered with must be refused.
#include "feasibility/complete_search.hpp"

#include <gtest/gtest.h>

#include "feasibility/proof_checker.hpp"
#include "feasibility/sight.hpp"
#include "temper/regularity.hpp"
#include "unit/feasibility/all_triangulations.hpp"

namespace temper::test {
namespace {

using End = CompleteSearchResult::End;

constexpr Constraints kBoth[] = {Constraints::well_centered, Constraints::heights_only};

CompleteSearchResult complete(const Mesh& mesh, Constraints constraints = Constraints::well_centered) {
  return search_completely(mesh, constraints, {});
}

/// The regular triangulation of weights that were found.
Mesh regular(const Mesh& mesh, const IdVector<VertexId, double>& weights) {
  Mesh result = with_weights(mesh, weights);
  restore_regularity(result, HiddenPolicy::undo);
  return result;
}

/// The meshes of the tests: convex or not, some with constrained edges.
template <class Use>
void for_each_small_domain(const Use& use) {
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    const std::size_t vertices = 5 + seed % 3;
    use(small_domain(seed, vertices, static_cast<int>(seed % 4), static_cast<int>(seed % 5 == 0)), seed);
  }
  for (std::uint64_t seed = 1; seed <= 20; ++seed) use(jittered_lattice(seed, 3), 1000 + seed);
}

TEST(CompleteSearch, AgreesWithAllTriangulations) {
  for (const Constraints constraints : kBoth) {
    std::size_t found = 0, none = 0, triangulations = 0;
    for_each_small_domain([&](const Mesh& mesh, std::uint64_t seed) {
      SCOPED_TRACE(testing::Message() << name(constraints) << ", domain " << seed);
      const double best = best_of_all(mesh, constraints, triangulations);
      const CompleteSearchResult result = complete(mesh, constraints);
      EXPECT_GE(result.bound, std::min(best, kMostMargin) - 1e-7);
      if (best > 1e-7) {
        ++found;
        ASSERT_EQ(result.end, End::found) << best;
        EXPECT_GT(weight_margin(regular(mesh, result.weights), constraints), 0);
      } else if (best < -1e-7) {
        ++none;
        ASSERT_EQ(result.end, End::none) << best;
        EXPECT_EQ(check_proof(mesh, result.proof), CertificateCheck::proves);
      }
    });
    EXPECT_GT(found, 30u) << name(constraints);
    EXPECT_GT(none, constraints == Constraints::well_centered ? 15u : 3u);
    EXPECT_GT(triangulations, 1000u);
  }
}

// With all edges kept, nothing is searched, and the first program is the one of best_margin(). Rows of triangles that
// are not there add nothing to a positive margin.
TEST(CompleteSearch, HasTheBestMarginOfAMeshWhoseEdgesAllStay) {
  std::size_t found = 0, none = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Mesh mesh = jittered_lattice(seed, 4);
    for (const HalfedgeId h : mesh.halfedges()) mesh.set_constrained(h, true);
    for (const Constraints constraints : kBoth) {
      const double best = margin_of(mesh, constraints).margin;
      const CompleteSearchResult result = complete(mesh, constraints);
      if (best > 1e-7) {
        ++found;
        EXPECT_EQ(result.end, End::found) << seed;
        EXPECT_NEAR(result.bound, best, 1e-8) << seed;
        EXPECT_EQ(result.programs, 1u);
      } else if (best < -1e-7) {
        ++none;
        ASSERT_EQ(result.end, End::none) << seed;
        EXPECT_EQ(result.proof.lemmas.size(), 1u);
      }
    }
  }
  EXPECT_GT(found, 5u);
  EXPECT_GT(none, 5u);
}

// The reason why rows of edges hold: the lifted function is convex along segments in the domain.
TEST(CompleteSearch, UsesOnlyConstraintsThatEverySolutionKeeps) {
  std::size_t heights = 0, crossings = 0;
  for_each_small_domain([&](const Mesh& mesh, std::uint64_t seed) {
    const Sight sight(mesh);
    for (const Constraints constraints : kBoth) {
      const CompleteSearchResult result = complete(mesh, constraints);
      if (result.end != End::found) continue;
      const Mesh solution = regular(mesh, result.weights);
      const auto at = [&](VertexId v) { return solution.point(v); };
      for (const HalfedgeId h : solution.halfedges()) {
        for (const VertexId x : solution.vertices()) {
          if (x == solution.origin(h) || x == solution.target(h)) continue;
          if (!sight.holds_triangle(solution.origin(h), solution.target(h), x)) continue;
          ++heights;
          EXPECT_EQ(signed_height_sign(solution.space(), at(solution.origin(h)), at(solution.target(h)), at(x)),
                    Sign::positive)
              << seed;
        }
      }
      for (const VertexId p : solution.vertices()) {
        for (const VertexId q : solution.vertices()) {
          if (p == q || constraints == Constraints::heights_only || !sight.see_each_other(p, q)) continue;
          ++crossings;
          EXPECT_GT(squared_length(at(q).position() - at(p).position()) + at(p).w - at(q).w, 0) << seed;
        }
      }
    }
  });
  EXPECT_GT(heights, 1000u);
  EXPECT_GT(crossings, 500u);
}

TEST(Sight, AllowsTheEdgesAndTrianglesOfAllTriangulationsAndNoOthers) {
  for_each_small_domain([](const Mesh& mesh, std::uint64_t seed) {
    const Sight sight(mesh);
    Edges edges;
    std::set<std::array<VertexId, 3>> triangles;
    for_each_triangulation(mesh, [&](const Mesh& m) {
      edges.merge(edges_of(m, [](HalfedgeId) { return true; }));
      for (const HalfedgeId h : m.halfedges()) triangles.insert({m.origin(h), m.target(h), m.opposite(h)});
    });
    for (const VertexId a : mesh.vertices()) {
      for (const VertexId b : mesh.vertices()) {
        if (a == b) continue;
        EXPECT_EQ(sight.can_be_edge(a, b), edges.count(edge_between(a, b)) > 0) << seed << ": " << a.index << b.index;
        for (const VertexId c : mesh.vertices()) {
          if (c == a || c == b) continue;
          EXPECT_EQ(sight.can_be_triangle(a, b, c), triangles.count({a, b, c}) > 0)
              << seed << ": " << a.index << ' ' << b.index << ' ' << c.index;
        }
      }
    }
  });
}

/// Proofs that have cases, for both constraints.
template <class Use>
void for_each_branched_proof(const Use& use) {
  std::size_t proofs = 0;
  for (std::uint64_t seed = 1; seed <= 60 && proofs < 8; ++seed) {
    for (const Mesh& mesh : {hull_of_random_points(seed, 12), jittered_lattice(seed, 4)}) {
      for (const Constraints constraints : kBoth) {
        const CompleteSearchResult result = complete(mesh, constraints);
        if (result.end != End::none || result.proof.lemmas.size() < 3 || result.proof.lemmas.size() > 60) continue;
        ++proofs;
        use(mesh, result.proof);
      }
    }
  }
  EXPECT_GT(proofs, 3u);
}

TEST(ConnectivityProof, IsRefusedWithoutAnyOfItsParts) {
  for_each_branched_proof([](const Mesh& mesh, const ConnectivityProof& proof) {
    ASSERT_EQ(check_proof(mesh, proof), CertificateCheck::proves);
    const auto refuse = [&](const ConnectivityProof& changed, const char* why) {
      EXPECT_NE(check_proof(mesh, changed), CertificateCheck::proves) << why;
    };
    for (std::size_t i = 0; i < proof.lemmas.size(); ++i) {
      const Lemma& lemma = proof.lemmas[i];
      ConnectivityProof changed = proof;
      for (std::size_t k = 0; k < lemma.cases.size(); ++k) {
        changed.lemmas[i].cases.erase(changed.lemmas[i].cases.begin() + static_cast<std::ptrdiff_t>(k));
        refuse(changed, "a case is missing");
        changed.lemmas[i] = lemma;
        changed.lemmas[i].cases[k].lemma = i;
        refuse(changed, "a case names its own lemma");
        changed.lemmas[i] = lemma;
      }
      for (std::size_t k = 0; k < lemma.terms.size(); ++k) {
        changed.lemmas[i].terms[k].multiplier *= 1.5;
        const bool may_prove = check_proof(mesh, changed) == CertificateCheck::proves;  // if there was room
        changed.lemmas[i].terms[k].multiplier *= 1e6;
        if (!may_prove) refuse(changed, "a multiplier is wrong");
        changed.lemmas[i].terms[k].multiplier = -lemma.terms[k].multiplier;
        refuse(changed, "a multiplier is negative");
        changed.lemmas[i] = lemma;
      }
      for (std::size_t k = 0; k < lemma.edges.size() && !lemma.terms.empty(); ++k) {
        changed.lemmas[i].edges.erase(changed.lemmas[i].edges.begin() + static_cast<std::ptrdiff_t>(k));
        refuse(changed, "a lemma claims more than its terms prove");
        changed.lemmas[i] = lemma;
      }
    }
    ConnectivityProof changed = proof;
    changed.lemmas.pop_back();
    if (!proof.lemmas[proof.lemmas.size() - 2].edges.empty()) refuse(changed, "the last lemma is missing");
    changed.lemmas.clear();
    refuse(changed, "there is no lemma");
    changed = proof;
    changed.constraints = Constraints::regular;
    refuse(changed, "these constraints have no such proofs");
  });
}

TEST(ConnectivityProof, IsAboutPositionsAndNotAboutConnectivity) {
  for_each_branched_proof([](const Mesh& mesh, const ConnectivityProof& proof) {
    Mesh other = mesh;
    for (const HalfedgeId h : other.halfedges()) {
      if (can_flip(other, h) == FlipStatus::possible) flip(other, h);
    }
    EXPECT_EQ(check_proof(other, proof), CertificateCheck::proves);
  });
}

TEST(CompleteSearch, IsTheSameForEachConnectivityOfTheInput) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Mesh mesh = jittered_lattice(seed, 4);
    Mesh other = mesh;
    for (const HalfedgeId h : other.halfedges()) {
      if (can_flip(other, h) == FlipStatus::possible) flip(other, h);
    }
    const CompleteSearchResult one = complete(mesh), two = complete(other);
    EXPECT_EQ(one.end, two.end) << seed;
    EXPECT_NEAR(one.bound, two.bound, 1e-8) << seed;
    EXPECT_EQ(complete(mesh).proof, one.proof) << seed;
  }
}

TEST(CompleteSearch, StopsWhenAsked) {
  const Mesh mesh = hull_of_random_points(3, 40);
  int calls = 0;
  const auto result = search_completely(mesh, Constraints::heights_only, [&] { return ++calls > 20; });
  EXPECT_EQ(result.end, End::stopped);
  EXPECT_TRUE(result.proof.lemmas.empty());
  EXPECT_LT(calls, 30);
}

TEST(BestConnectivity, EndsWithWeightsOrWithAProof) {
  const auto solver = clp_solver();
  for (const Constraints constraints : kBoth) {
    std::size_t complete_steps = 0;
    for (std::uint64_t seed = 1; seed <= 25; ++seed) {
      const Mesh mesh = hull_of_random_points(seed, 10);
      const auto report = best_connectivity(mesh, *solver, {.constraints = constraints});
      ASSERT_TRUE(report);
      const bool none = report->end == SearchEnd::none_exists;
      EXPECT_NE(none, report->margin > 0) << seed;
      EXPECT_EQ(none, !report->proof.lemmas.empty());
      if (none) {
        EXPECT_EQ(check_proof(mesh, report->proof), CertificateCheck::proves) << seed;
      }
      for (const ConnectivityStep& step : report->steps) {
        complete_steps += step.kind == ConnectivityStep::Kind::complete ? 1 : 0;
      }
    }
    if (constraints == Constraints::heights_only) {
      EXPECT_GT(complete_steps, 0u);
    }
  }
}

}  // namespace
}  // namespace temper::test
