// Reasons: each sort where the answer is known, and the laws that hold of all.
#include "temper/explain.hpp"

#include <numeric>
#include <set>

#include "explain/conflict.hpp"
#include "explain/cures.hpp"
#include "support/spheres.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/lp.hpp"
#include "temper/generate.hpp"
#include "temper/quality.hpp"
#include "temper/regularity.hpp"
#include "temper/topology.hpp"
#include "topology/rings.hpp"
#include "unit/explain/fans.hpp"

namespace temper::test {
namespace {

Explanation why(const Mesh& mesh, const ExplainOptions& options = {}) {
  const auto solver = clp_solver();
  auto explanation = explain(mesh, *solver, options);
  if (!explanation) {
    ADD_FAILURE() << explanation.error().what();
    return {};
  }
  return *std::move(explanation);
}

bool is_conflict(const Reason& reason) {
  return reason.kind == ReasonKind::edge || reason.kind == ReasonKind::fan || reason.kind == ReasonKind::patch;
}

bool is_bad(const Mesh& mesh, TriangleId t) {
  const auto [p, q, r] = mesh.corners(t);
  return !is_well_centered(mesh.point(p), mesh.point(q), mesh.point(r));
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::vector<Mesh> meshes() {
  std::vector<Mesh> all = {sparse_horseshoe(),
                           *horseshoe(),
                           *regular_polygon({.corners = 12}),
                           *random_mesh({.vertices = 60}),
                           *sheared_grid({.nx = 4, .ny = 4, .shear = 0.7}),
                           one_triangle({0, 0}, {4, 0}, {2, 1})};
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    all.push_back(lattice({.n = 6, .jitter = 0.42, .weight = 0, .seed = seed}));
    all.push_back(random_fan(seed, 4));
    all.push_back(random_fan(seed, 5, true));
  }
  return all;
}

/// A rectangle of width 1, with three vertices that divide its far side in four.
Mesh rectangle(double length) {
  const std::vector<Vec2> points = {
      {0, 0}, {length, 0}, {length, 1}, {0.75 * length, 1}, {0.5 * length, 1}, {0.25 * length, 1}, {0, 1}};
  std::vector<std::array<std::int32_t, 2>> segments;
  for (int i = 0; i < 7; ++i) segments.push_back({i, (i + 1) % 7});
  return *constrained_delaunay({.points = points, .segments = segments});
}

TEST(Explain, AnEdgeThatMustBeSplitIsNamedWithTheVerticesThatLeaveNoPlace) {
  const Mesh mesh = rectangle(4);
  const Explanation e = why(mesh, {.cures = 10});
  ASSERT_FALSE(e.reasons.empty());
  const Reason& reason = e.reasons.front();
  ASSERT_EQ(reason.kind, ReasonKind::split);
  EXPECT_EQ(mesh.origin(reason.must_split->edge), VertexId(0));
  EXPECT_EQ(mesh.target(reason.must_split->edge), VertexId(1));
  EXPECT_EQ(reason.must_split->near_u, VertexId(5));
  EXPECT_EQ(reason.must_split->near_v, VertexId(3));
  EXPECT_EQ(e.verdict, Feasibility::infeasible);
  ASSERT_FALSE(reason.cures.empty());
  EXPECT_TRUE(reason.cures.front().ends_conflict);
  EXPECT_EQ(reason.cures.front().at, (Vec2{2, 0}));
  const std::string text = reason_text(mesh, reason);
  EXPECT_TRUE(contains(text, "Boundary edge 0-1 must be split, whatever is done inside.")) << text;
  EXPECT_TRUE(reason_words(mesh, reason).why.starts_with("It is 4 long")) << text;
  for (std::size_t i = 1; i < e.reasons.size(); ++i) EXPECT_NE(e.reasons[i].kind, ReasonKind::split);
}

TEST(Explain, AnEdgeWithRoomForItsDualNeedNotBeSplit) {
  for (const Reason& reason : why(rectangle(3.99)).reasons) EXPECT_NE(reason.kind, ReasonKind::split);
}

TEST(Explain, SaysNothingWhereEveryTriangleIsWellCentered) {
  for (const Mesh& mesh : {lattice({.jitter = 0, .weight = 0}), lattice({.jitter = 0.05, .weight = 0.05, .seed = 5})}) {
    const Explanation e = why(mesh);
    EXPECT_EQ(e.bad, 0u);
    EXPECT_TRUE(e.reasons.empty());
    EXPECT_EQ(e.verdict, Feasibility::feasible);
  }
}

TEST(Explain, GivesEveryBadTriangleOneReasonAndNoOtherAny) {
  std::size_t reasons = 0;
  for (const Mesh& mesh : meshes()) {
    const Explanation e = why(mesh, {.cures = 0});
    std::vector<int> explained(mesh.n_triangles(), 0);
    for (const Reason& reason : e.reasons) {
      ASSERT_FALSE(reason.bad.empty());
      for (const TriangleId t : reason.bad) ++explained[t.index];
      ++reasons;
    }
    std::size_t bad = 0;
    for (const TriangleId t : mesh.triangles()) {
      EXPECT_EQ(explained[t.index], is_bad(mesh, t) ? 1 : 0);
      bad += is_bad(mesh, t);
    }
    EXPECT_EQ(e.bad, bad);
    EXPECT_EQ(e.triangles, mesh.n_triangles());
  }
  EXPECT_GT(reasons, 20u);
}

TEST(Explain, ConflictsAreProvedAndSmallest) {
  const auto solver = clp_solver();
  std::set<ReasonKind> seen;
  for (const Mesh& mesh : meshes()) {
    const Explanation e = why(mesh, {.cures = 0});
    bool infeasible = false;
    for (const Reason& reason : e.reasons) {
      seen.insert(reason.kind);
      if (!is_conflict(reason)) {
        EXPECT_TRUE(reason.certificate.terms.empty());
        continue;
      }
      infeasible = true;
      EXPECT_EQ(check_certificate(mesh, reason.certificate), CertificateCheck::proves);
      EXPECT_EQ(reason.certificate.margin, 0);
      for (const TriangleId t : reason.bad) {
        EXPECT_TRUE(std::binary_search(reason.conflict.begin(), reason.conflict.end(), t));
      }
      for (const TriangleId t : reason.conflict) {
        std::vector<TriangleId> others = reason.conflict;
        std::erase(others, t);
        EXPECT_TRUE(best_margin(mesh, others, *solver).certificate.terms.empty());
      }
      if (!reason.crossing) continue;
      const CrossingConflict& c = *reason.crossing;
      EXPECT_TRUE(c.left.to <= c.right.from || c.right.to <= c.left.from);
      EXPECT_TRUE(mesh.find_halfedge(c.p, c.q).valid());
      EXPECT_EQ(c.left.triangles.size() + c.right.triangles.size(), reason.conflict.size());
    }
    // What weights cannot do, the program for the whole mesh says too.
    const BestMargin whole = best_margin(mesh, *solver);
    EXPECT_EQ(infeasible, !whole.certificate.terms.empty());
    EXPECT_EQ(e.verdict, infeasible ? Feasibility::infeasible : Feasibility::feasible);
  }
  for (const ReasonKind kind : {ReasonKind::edge, ReasonKind::fan, ReasonKind::patch, ReasonKind::weights}) {
    EXPECT_EQ(seen.count(kind), 1u) << name(kind);
  }
}

TEST(Explain, OfTheSparseHorseshoeNamesItsCornersAndEdges) {
  const Mesh mesh = sparse_horseshoe();
  const Explanation e = why(mesh);
  ASSERT_EQ(e.reasons.size(), 2u);
  std::set<std::size_t> crossed;
  for (const Reason& reason : e.reasons) {
    EXPECT_EQ(reason.kind, ReasonKind::edge);
    EXPECT_EQ(reason.bad.size(), 2u);
    EXPECT_NEAR(reason.margin, -8.0 / 135, 1e-9);
    EXPECT_EQ(reason.free, std::vector<VertexId>{VertexId(4)});
    ASSERT_TRUE(reason.crossing);
    const CrossingConflict& c = *reason.crossing;
    EXPECT_TRUE(c.p == VertexId(4) || c.q == VertexId(4));
    crossed.insert((c.p == VertexId(4) ? c.q : c.p).index);
    EXPECT_NEAR(c.length, std::sqrt(13), 1e-12);
    const std::set<std::size_t> widest = {c.left.widest.index, c.right.widest.index};
    EXPECT_EQ(widest, (std::set<std::size_t>{1, 4}));
    EXPECT_NEAR(std::max(c.left.angle_deg, c.right.angle_deg), 146.3, 0.05);
    EXPECT_NEAR(std::min(c.left.angle_deg, c.right.angle_deg), 135, 1e-9);
  }
  EXPECT_EQ(crossed, (std::set<std::size_t>{0, 2}));
}

TEST(Explain, OfAFanAtABoundaryCornerNamesTheCornerAndItsEdges) {
  std::size_t found = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Mesh mesh = random_fan(seed, 4);
    for (const Reason& reason : why(mesh, {.cures = 0}).reasons) {
      if (reason.kind != ReasonKind::fan) continue;
      ++found;
      ASSERT_TRUE(reason.center);
      EXPECT_EQ(reason.center->vertex, VertexId(0));
      EXPECT_TRUE(reason.center->on_boundary);
      EXPECT_GE(reason.conflict.size(), 3u);
      EXPECT_TRUE(reason.free.empty());
      double angle = 0;
      for (std::size_t i = 1; i < 5; ++i) {
        angle += corner_angle({0, 0}, mesh.position(VertexId(i)), mesh.position(VertexId(i + 1))) / kRadians;
      }
      EXPECT_NEAR(reason.center->angle_deg, angle, 1e-9);
      const std::string text = reason_text(mesh, reason);
      EXPECT_TRUE(contains(text, "at the boundary corner of ")) << text;
      EXPECT_TRUE(contains(text, "None of their corners is free to move: all are on the boundary.")) << text;
    }
  }
  EXPECT_GT(found, 3u);
}

TEST(Explain, OfAConflictThatClosesNamesNoEdge) {
  std::size_t found = 0;
  const Mesh mesh = *random_mesh({.vertices = 200});
  for (const Reason& reason : why(mesh, {.cures = 0}).reasons) {
    if (!is_conflict(reason) || reason.crossing) continue;
    ++found;
    EXPECT_EQ(reason.kind, ReasonKind::patch);
    EXPECT_GE(reason.conflict.size(), 3u);
    EXPECT_TRUE(contains(reason_text(mesh, reason), "Any of them can be left out, and weights suit the others"));
  }
  EXPECT_GT(found, 0u);
}

TEST(Explain, OfTrianglesThatOnlyLackWeightsSaysHowManyAndWhatCheckSays) {
  const Mesh mesh = one_triangle({0, 0}, {4, 0}, {2, 1});
  const Explanation e = why(mesh);
  ASSERT_EQ(e.reasons.size(), 1u);
  const Reason& reason = e.reasons[0];
  EXPECT_EQ(reason.kind, ReasonKind::weights);
  EXPECT_EQ(e.verdict, Feasibility::feasible);
  EXPECT_GT(e.changed, 0u);
  EXPECT_TRUE(reason.free.empty());
  ASSERT_EQ(reason.cures.size(), 1u);  // with three boundary vertices nothing can move
  EXPECT_EQ(reason.cures[0].action, Cure::Action::find_weights);
  EXPECT_EQ(reason.cures[0].changed, e.changed);
  EXPECT_TRUE(contains(reason_text(mesh, reason), quality(mesh).worst[0].why)) << reason_text(mesh, reason);
}

/// The triangles of a square beside a quadrilateral have right angles: weights would help, and nobody may change them.
///
///     3---4---5
///     |   | / |
///     0---1---2
TEST(Explain, OfAMeshWithQuadrilateralsAdvisesNoWeights) {
  const std::vector<Vec2> points = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}};
  const std::vector<std::array<std::int32_t, 3>> triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
  Mesh mesh = Mesh::build({.points = points, .triangles = triangles})->mesh;
  const auto advises_weights = [](const Explanation& e) {
    bool any = e.verdict == Feasibility::feasible;
    for (const Reason& reason : e.reasons) {
      for (const Cure& cure : reason.cures) any = any || cure.action == Cure::Action::find_weights;
    }
    return any;
  };
  EXPECT_GT(why(mesh).bad, 0u);
  const bool without_quadrilaterals = advises_weights(why(mesh));
  mesh.set_diagonal(mesh.find_halfedge(VertexId(0), VertexId(4)));
  mesh.set_constrained(mesh.find_halfedge(VertexId(1), VertexId(4)), true);
  const Explanation e = why(mesh);
  EXPECT_EQ(e.bad, 2u);
  EXPECT_TRUE(without_quadrilaterals);
  EXPECT_FALSE(advises_weights(e));
}

/// The mesh with a cure carried out; edges as the change leaves them.
Mesh cured(Mesh mesh, const Cure& cure) {
  const auto halfedge = [&] {
    const HalfedgeId h = mesh.find_halfedge(cure.edge[0], cure.edge[1]);
    return h.valid() ? h : mesh.find_halfedge(cure.edge[1], cure.edge[0]);
  };
  switch (cure.action) {
    case Cure::Action::move_vertex:
      mesh.set_position(cure.vertex, cure.at);
      break;
    case Cure::Action::flip_edge:
      EXPECT_EQ(can_flip(mesh, halfedge()), FlipStatus::possible);
      flip(mesh, halfedge());
      break;
    case Cure::Action::split_edge:
    case Cure::Action::split_boundary:
      split_edge(mesh, halfedge(), {cure.at.x, cure.at.y, 0});
      break;
    case Cure::Action::insert_vertex:
      insert_in_triangle(mesh, cure.triangle, {cure.at.x, cure.at.y, 0});
      break;
    default:
      ADD_FAILURE() << name(cure.action);
  }
  return mesh;
}

TEST(Explain, VerifiedCuresDoCureWhereTheMeshIsTheNeighborhood) {
  const auto solver = clp_solver();
  std::set<Cure::Action> tried;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Mesh mesh = random_fan(seed, 4 + static_cast<int>(seed % 2), seed % 2 == 0);
    const Explanation e = why(mesh);
    if (std::count_if(e.reasons.begin(), e.reasons.end(), is_conflict) != 1) continue;
    EXPECT_TRUE(e.reasons[0].cures_searched);
    ASSERT_FALSE(e.reasons[0].cures.empty());
    for (const Cure& cure : e.reasons[0].cures) {
      if (!cure.verified || cure.conflict_only) continue;
      Mesh after = cured(mesh, cure);
      EXPECT_FALSE(after.validate()) << *after.validate();
      double margin = best_margin(after, *solver).margin;
      if (after.n_vertices() > mesh.n_vertices()) {  // a new vertex: the edges as they are, or Delaunay
        restore_regularity(after);
        margin = std::max(margin, best_margin(after, *solver).margin);
      }
      EXPECT_NEAR(margin, cure.margin, 1e-7) << name(cure.action) << " " << seed;
      EXPECT_GT(cure.margin, 0);
      tried.insert(cure.action);
    }
  }
  for (const Cure::Action action :
       {Cure::Action::flip_edge, Cure::Action::insert_vertex, Cure::Action::split_edge, Cure::Action::split_boundary}) {
    EXPECT_EQ(tried.count(action), 1u) << name(action);
  }
}

TEST(Explain, VerifiedMovesCureTheNeighborhood) {
  const auto solver = clp_solver();
  std::size_t tried = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Mesh mesh = lattice({.n = 6, .jitter = 0.42, .weight = 0, .seed = seed});
    const Explanation e = why(mesh);
    std::vector<TriangleId> bad;
    for (const Reason& reason : e.reasons) {
      if (is_conflict(reason)) bad.insert(bad.end(), reason.bad.begin(), reason.bad.end());
    }
    for (const Reason& reason : e.reasons) {
      for (const Cure& cure : reason.cures) {
        if (cure.action != Cure::Action::move_vertex || !cure.verified || cure.conflict_only) continue;
        ++tried;
        std::vector<TriangleId> asked = triangles_around(mesh, reason.conflict);
        std::erase_if(asked, [&](TriangleId t) {
          return !std::binary_search(reason.conflict.begin(), reason.conflict.end(), t) &&
                 std::find(bad.begin(), bad.end(), t) != bad.end();
        });
        EXPECT_EQ(asked.size(), cure.triangles);
        const Mesh after = cured(mesh, cure);
        EXPECT_FALSE(after.validate()) << *after.validate();
        EXPECT_NEAR(best_margin(after, asked, *solver).margin, cure.margin, 1e-7);
      }
    }
  }
  EXPECT_GT(tried, 0u);
}

// --- on the sphere ---------------------------------------------------------------------------------------------

/// On a cap so small that it is flat but for 1 in 10⁸.
Mesh nearly_flat(const Mesh& plane) { return on_cap(plane, 1e4); }

TEST(Explain, OnSmallCapsItSaysWhatItSaysInThePlane) {
  std::set<ReasonKind> seen;
  std::vector<Mesh> all = {sparse_horseshoe(), lattice({.n = 4, .jitter = 0.42, .weight = 0, .seed = 2})};
  for (std::uint64_t seed = 1; seed <= 60; ++seed) all.push_back(random_fan(seed, 4));
  for (const Mesh& mesh : all) {
    const Explanation flat = why(mesh, {.cures = 0}), e = why(nearly_flat(mesh), {.cures = 0});
    EXPECT_EQ(e.bad, flat.bad);
    EXPECT_EQ(e.verdict, flat.verdict);
    ASSERT_EQ(e.reasons.size(), flat.reasons.size());
    const auto sorted = [](const Explanation& explanation) {
      std::vector<const Reason*> reasons;
      for (const Reason& r : explanation.reasons) reasons.push_back(&r);
      std::sort(reasons.begin(), reasons.end(), [](const Reason* x, const Reason* y) { return x->bad < y->bad; });
      return reasons;
    };
    const auto here = sorted(e), there = sorted(flat);
    for (std::size_t i = 0; i < here.size(); ++i) {
      const Reason &r = *here[i], &f = *there[i];
      seen.insert(r.kind);
      EXPECT_EQ(r.kind, f.kind);
      EXPECT_EQ(r.bad, f.bad);
      EXPECT_EQ(r.conflict, f.conflict);
      EXPECT_EQ(r.free, f.free);
      EXPECT_NEAR(r.margin, f.margin, 1e-5);
      ASSERT_EQ(r.crossing.has_value(), f.crossing.has_value());
      if (r.crossing) {
        EXPECT_EQ(r.crossing->p, f.crossing->p);
        EXPECT_NEAR(r.crossing->length, f.crossing->length, 1e-6);
        EXPECT_NEAR(r.crossing->left.from, f.crossing->left.from, 1e-5);
        EXPECT_NEAR(r.crossing->right.to, f.crossing->right.to, 1e-5);
        EXPECT_NEAR(r.crossing->left.angle_deg, f.crossing->left.angle_deg, 1e-5);
      }
    }
  }
  for (const ReasonKind kind : {ReasonKind::edge, ReasonKind::fan}) EXPECT_EQ(seen.count(kind), 1u) << name(kind);
}

TEST(Explain, ArcsThatMustBeSplitAreNamedAndSplittingThemIsEnough) {
  for (const double radius : {1e4, 5.0}) {
    const Mesh mesh = on_cap(rectangle(5), radius);
    const Explanation e = why(mesh);
    ASSERT_FALSE(e.reasons.empty());
    const Reason& reason = e.reasons.front();
    ASSERT_EQ(reason.kind, ReasonKind::split);
    EXPECT_EQ(reason.must_split->near_u, VertexId(5));
    EXPECT_EQ(reason.must_split->near_v, VertexId(3));
    EXPECT_TRUE(reason.cures.front().ends_conflict);
    const auto [what, why_so] = reason_words(mesh, reason);
    EXPECT_TRUE(what.starts_with("Boundary edge 0-1 must be split, whatever is done inside.")) << what;
    EXPECT_TRUE(why_so.starts_with("It is ")) << why_so;
    EXPECT_EQ(reason_text(mesh, reason), what + " " + why_so);
  }
}

TEST(Explain, OfGlobesEveryBadTriangleHasOneReasonAndConflictsAreProved) {
  std::size_t crossings = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    // From 30 points on, edges of up to 60 degrees.
    const Mesh mesh = seed % 2 == 0 ? ocean(globe(40 * seed, seed, 1000), 300) : globe(30 * seed, seed, 1000);
    const Explanation e = why(mesh, {.cures = 0});
    std::vector<int> explained(mesh.n_triangles(), 0);
    for (const Reason& reason : e.reasons) {
      for (const TriangleId t : reason.bad) ++explained[t.index];
      if (!is_conflict(reason)) continue;
      EXPECT_EQ(check_certificate(mesh, reason.certificate), CertificateCheck::proves);
      if (!reason.crossing) continue;
      ++crossings;
      const CrossingConflict& c = *reason.crossing;
      EXPECT_TRUE(c.left.to <= c.right.from || c.right.to <= c.left.from);
      EXPECT_EQ(c.left.triangles.size() + c.right.triangles.size(), reason.conflict.size());
    }
    for (const TriangleId t : mesh.triangles()) {
      const auto [p, q, r] = mesh.corners(t);
      EXPECT_EQ(explained[t.index],
                is_well_centered(mesh.space(), mesh.point(p), mesh.point(q), mesh.point(r)) ? 0 : 1);
    }
  }
  EXPECT_GT(crossings, 5u);
}

/// Two triangles have weights just when their sides of the edge agree: the crossings are held against the program.
TEST(Explain, OnTheSphereTwoTrianglesExcludeEachOtherJustWhereTheirCrossingsDoNotMeet) {
  const auto solver = clp_solver();
  std::size_t with = 0, without = 0;
  for (std::uint64_t seed = 1; seed <= 80; ++seed) {
    const Mesh mesh = on_cap(random_fan(seed, 5), 3);
    for (const HalfedgeId h : mesh.halfedges()) {
      if (!mesh.is_edge_representative(h) || mesh.is_boundary(h)) continue;
      std::vector<TriangleId> two = {Mesh::triangle(h), Mesh::triangle(mesh.twin(h))};
      std::sort(two.begin(), two.end());
      const double margin = best_margin(mesh, two, *solver).margin;
      if (std::abs(margin) < 1e-6) continue;
      const bool disagree = crossing_conflict(mesh, two).has_value();
      EXPECT_EQ(disagree, margin < 0) << h.index << " " << margin;
      ++(disagree ? without : with);
    }
  }
  EXPECT_GT(with, 50u);
  EXPECT_GT(without, 10u);
}

WeightedPoint vertex_at(const Mesh& mesh, Vec2 lon_lat) {
  const Vec2 a = kRadians * lon_lat;
  const Vec3 p = {std::cos(a.y) * std::cos(a.x), std::cos(a.y) * std::sin(a.x), std::sin(a.y)};
  return as_point(mesh.space().radius() * p);
}

TEST(Explain, VerifiedCuresOfTheSphereDoCureWhereTheMeshIsTheNeighborhood) {
  const auto solver = clp_solver();
  std::set<Cure::Action> tried;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    // Fans of edges of about a third of the radius.
    const Mesh mesh = on_cap(random_fan(seed, 4 + static_cast<int>(seed % 2), seed % 2 == 0), 3);
    const Explanation e = why(mesh);
    if (std::count_if(e.reasons.begin(), e.reasons.end(), is_conflict) != 1) continue;
    for (const Cure& cure : e.reasons[0].cures) {
      if (!cure.verified || cure.conflict_only) continue;
      Mesh after = mesh;
      const auto halfedge = [&] {
        const HalfedgeId h = mesh.find_halfedge(cure.edge[0], cure.edge[1]);
        return h.valid() ? h : mesh.find_halfedge(cure.edge[1], cure.edge[0]);
      };
      using Action = Cure::Action;
      if (cure.action == Action::move_vertex) after.set_point(cure.vertex, vertex_at(mesh, cure.at));
      if (cure.action == Action::flip_edge) flip(after, halfedge());
      if (cure.action == Action::insert_vertex) insert_in_triangle(after, cure.triangle, vertex_at(mesh, cure.at));
      if (cure.action == Action::split_edge || cure.action == Action::split_boundary) {
        split_edge(after, halfedge(), vertex_at(mesh, cure.at));
      }
      EXPECT_FALSE(after.validate()) << *after.validate();
      double margin = best_margin(after, *solver).margin;
      if (after.n_vertices() > mesh.n_vertices()) {
        restore_regularity(after);
        margin = std::max(margin, best_margin(after, *solver).margin);
      }
      EXPECT_NEAR(margin, cure.margin, 1e-7) << name(cure.action) << " " << seed;
      EXPECT_GT(cure.margin, 0);
      tried.insert(cure.action);
    }
  }
  EXPECT_GE(tried.size(), 3u);
}

using Canonical = std::set<std::pair<std::vector<std::size_t>, std::vector<std::size_t>>>;

/// Conflicts and bad triangles of each reason, in the numbers of the mesh that this one was made from.
Canonical canonical(const Explanation& e, const std::vector<std::size_t>& original) {
  Canonical result;
  const auto renumbered = [&](const std::vector<TriangleId>& triangles) {
    std::vector<std::size_t> numbers;
    for (const TriangleId t : triangles) numbers.push_back(original[t.index]);
    std::sort(numbers.begin(), numbers.end());
    return numbers;
  };
  for (const Reason& reason : e.reasons) result.insert({renumbered(reason.bad), renumbered(reason.conflict)});
  return result;
}

TEST(Explain, DoesNotDependOnNumbers) {
  std::size_t reasons = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Mesh mesh = lattice({.n = 6, .jitter = 0.4, .weight = 0, .seed = seed});
    const std::size_t n = mesh.n_vertices(), m = mesh.n_triangles();
    Noise noise(seed);
    const auto shuffled = [&](std::size_t size) {
      std::vector<std::size_t> order(size);
      std::iota(order.begin(), order.end(), 0);
      for (std::size_t i = size; i > 1; --i) {
        std::swap(order[i - 1], order[static_cast<std::size_t>(std::abs(noise()) * static_cast<double>(i)) % i]);
      }
      return order;
    };
    const std::vector<std::size_t> vertex_order = shuffled(n), triangle_order = shuffled(m);  // new → old
    std::vector<std::int32_t> new_vertex(n);
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < n; ++i) {
      new_vertex[vertex_order[i]] = static_cast<std::int32_t>(i);
      points.push_back(mesh.position(VertexId(vertex_order[i])));
    }
    std::vector<std::array<std::int32_t, 3>> triangles;
    for (const std::size_t t : triangle_order) {
      const auto [a, b, c] = mesh.corners(TriangleId(t));
      triangles.push_back({new_vertex[b.index], new_vertex[c.index], new_vertex[a.index]});
    }
    std::vector<std::size_t> same(m);
    std::iota(same.begin(), same.end(), 0);
    const Explanation e = why(mesh, {.cures = 0});
    EXPECT_EQ(canonical(e, same), canonical(why(mesh_of(points, triangles), {.cures = 0}), triangle_order)) << seed;
    reasons += e.reasons.size();
  }
  EXPECT_GT(reasons, 10u);
}

TEST(Explain, DoesNotDependOnScaleAndPlace) {
  const Mesh mesh = *horseshoe();
  const Explanation e = why(mesh, {.cures = 0});
  for (const double factor : {0x1p-20, 0x1p20}) {
    Mesh other = mesh;
    for (const VertexId v : other.vertices()) other.set_position(v, factor * mesh.position(v));
    const Explanation scaled = why(other, {.cures = 0});
    ASSERT_EQ(scaled.reasons.size(), e.reasons.size());
    for (std::size_t i = 0; i < e.reasons.size(); ++i) {
      EXPECT_EQ(scaled.reasons[i].kind, e.reasons[i].kind);
      EXPECT_NEAR(scaled.reasons[i].margin, e.reasons[i].margin, 1e-8);
    }
  }
}

TEST(Explain, CanBeStopped) {
  const auto solver = clp_solver();
  std::size_t calls = 0;
  ExplainOptions options;
  options.progress = [&calls](std::size_t, std::size_t) { return ++calls, Continue::no; };
  EXPECT_FALSE(explain(*horseshoe(), *solver, options));
  EXPECT_EQ(calls, 1u);
}

class Doubled final : public InputNames {
 public:
  [[nodiscard]] std::string point(std::size_t i) const override { return "node " + std::to_string(1000 + i); }
  [[nodiscard]] std::string triangle(std::size_t i) const override { return "element " + std::to_string(2000 + i); }
};

TEST(Explain, SpeaksTheUsersNumbers) {
  const Mesh mesh = sparse_horseshoe();
  const Explanation e = why(mesh);
  const Doubled names;
  ASSERT_FALSE(e.reasons.empty());
  const std::string text = reason_text(mesh, e.reasons[0], &names);
  EXPECT_TRUE(contains(text, "Triangles 2000 and 2003") || contains(text, "Triangles 2001 and 2002")) << text;
  EXPECT_TRUE(contains(text, "at vertex 1004")) << text;
  for (const Cure& cure : e.reasons[0].cures) EXPECT_TRUE(contains(cure_text(mesh, cure, &names), " 100"));
}

}  // namespace
}  // namespace temper::test
