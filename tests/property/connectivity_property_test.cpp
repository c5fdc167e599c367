// A thousand random sequences of every operation on connectivity, on constrained meshes with regions, holes and fixed
// vertices. After each operation everything that must hold is checked, exactly: all coordinates are dyadic numbers of
// few bits, so that areas are exact sums and midpoints lie on their edges.
#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "property/mesh_of_random_points.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

using Segment = std::array<double, 4>;  // x and y of its ends, the smaller first

Segment segment(Vec2 p, Vec2 q) {
  if (std::tie(q.x, q.y) < std::tie(p.x, p.y)) std::swap(p, q);
  return {p.x, p.y, q.x, q.y};
}

/// The common end of two segments that lie in one line, one after the other; then their union.
std::optional<Segment> joined(const Segment& s, const Segment& t) {
  const Vec2 s0{s[0], s[1]}, s1{s[2], s[3]}, t0{t[0], t[1]}, t1{t[2], t[3]};
  if (s1 == t0 && orient2d(s0, s1, t1) == Sign::zero) return segment(s0, t1);
  if (t1 == s0 && orient2d(t0, t1, s1) == Sign::zero) return segment(t0, s1);
  return std::nullopt;
}

/// The same set of points as maximal straight segments, sorted: what a line is, however it is cut into edges.
std::vector<Segment> straightened(std::vector<Segment> segments) {
  for (bool again = true; again;) {
    again = false;
    for (std::size_t i = 0; i < segments.size(); ++i) {
      for (std::size_t j = i + 1; j < segments.size();) {
        const auto both = joined(segments[i], segments[j]);
        if (!both) {
          ++j;
          continue;
        }
        segments[i] = *both;
        segments[j] = segments.back();
        segments.pop_back();
        again = true;
      }
    }
  }
  std::sort(segments.begin(), segments.end());
  return segments;
}

/// All that no operation may change.
struct Invariants {
  std::vector<Segment> boundary, lines;
  std::map<std::int32_t, double> doubled_areas;  // by region
  std::vector<std::pair<double, double>> fixed;  // positions of fixed vertices
};

Invariants invariants(const Mesh& mesh) {
  Invariants result;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_erased(Mesh::triangle(h)) || !mesh.is_edge_representative(h)) continue;
    const Segment s = segment(mesh.position(mesh.origin(h)), mesh.position(mesh.target(h)));
    if (mesh.is_boundary(h)) result.boundary.push_back(s);
    if (mesh.is_constrained(h)) result.lines.push_back(s);
  }
  result.boundary = straightened(std::move(result.boundary));
  result.lines = straightened(std::move(result.lines));
  for (const TriangleId t : mesh.triangles()) {
    if (mesh.is_erased(t)) continue;
    const auto [a, b, c] = mesh.corners(t);
    result.doubled_areas[mesh.region(t)] += doubled_area(mesh.position(a), mesh.position(b), mesh.position(c));
  }
  for (const VertexId v : mesh.vertices()) {
    if (mesh.is_isolated(v) || !mesh.is_fixed(v)) continue;
    result.fixed.emplace_back(mesh.position(v).x, mesh.position(v).y);
  }
  std::sort(result.fixed.begin(), result.fixed.end());
  return result;
}

std::size_t live_vertices(const Mesh& mesh) {
  std::size_t n = 0;
  for (const VertexId v : mesh.vertices()) n += mesh.is_isolated(v) ? 0 : 1;
  return n;
}

/// Nine squares, without the middle one (a hole) or without a corner (a bay), each cut in two; three regions, two of
/// them parted by a slanted line.
Mesh blocks(Rng& rng) {
  const std::array<double, 4> at = {-1, -0.5, 0.5, 1};
  const int missing = rng.below(2) == 0 ? 4 : 8;
  std::vector<Vec2> points;
  std::vector<std::int32_t> number(16, -1), regions;
  std::vector<std::array<std::int32_t, 3>> triangles;
  const auto corner = [&](int i, int j) {
    std::int32_t& n = number[static_cast<std::size_t>(4 * j + i)];
    if (n < 0) {
      n = static_cast<std::int32_t>(points.size());
      points.push_back({at[static_cast<std::size_t>(i)], at[static_cast<std::size_t>(j)]});
    }
    return n;
  };
  for (int cell = 0; cell < 9; ++cell) {
    if (cell == missing) continue;
    const int i = cell % 3, j = cell / 3;
    const std::int32_t a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1), d = corner(i, j + 1);
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
    regions.push_back(i == 0 ? 1 : 2);
    regions.push_back(i == 0 ? 1 : cell == 2 ? 7 : 2);
  }
  MeshInput input;
  input.points = points;
  input.triangles = triangles;
  input.regions = regions;
  return Mesh::build(input)->mesh;
}

double dyadic(Rng& rng, std::uint32_t cells) { return -1 + 2.0 * rng.below(cells + 1) / cells; }

/// Weights far smaller than edges in most cases, so that few vertices hide; large in some.
double random_weight(Rng& rng) { return (rng.below(16) == 0 ? 0.5 : 0.002) * rng.uniform(-1, 1); }

Mesh random_constrained_mesh(Rng& rng) {
  Mesh mesh = blocks(rng);
  for (int i = 0; i < 12; ++i) test::insert_anywhere(mesh, {dyadic(rng, 16), dyadic(rng, 16), random_weight(rng)});
  test::shuffle_flips(mesh, rng, 40);
  for (const HalfedgeId h : mesh.halfedges()) {  // feature lines, dangling and branching
    if (!mesh.is_boundary(h) && rng.below(30) == 0) mesh.set_constrained(h, true);
  }
  for (const VertexId v : mesh.vertices()) {
    if (rng.below(12) == 0) mesh.set_fixed(v, true);
  }
  return mesh;
}

VertexId random_vertex(const Mesh& mesh, Rng& rng) {
  for (;;) {
    const VertexId v(std::size_t{rng.below(static_cast<std::uint32_t>(mesh.n_vertices()))});
    if (!mesh.is_isolated(v)) return v;
  }
}

HalfedgeId random_halfedge(const Mesh& mesh, Rng& rng) {
  for (;;) {
    const HalfedgeId h(std::size_t{rng.below(static_cast<std::uint32_t>(mesh.n_halfedges()))});
    if (!mesh.is_erased(Mesh::triangle(h))) return h;
  }
}

bool is_on_line(const Mesh& mesh, VertexId v) {
  for (const HalfedgeId h : mesh.star(v)) {
    if (mesh.is_constrained(h)) return true;
  }
  return false;
}

/// A mesh, what must stay of it, and how often each thing was done to it.
class Sequence {
 public:
  using Counts = std::map<std::string, std::size_t>;

  Sequence(std::uint64_t seed, Counts& counts)
      : rng_(seed), mesh_(random_constrained_mesh(rng_)), keep_(invariants(mesh_)), counts_(counts) {
    vertices_ = live_vertices(mesh_);
  }

  void step() {
    switch (rng_.below(7)) {
      case 0:
        return flip_edge();
      case 1:
        return insert();
      case 2:
        return split();
      case 3:
        return remove(plan_removal(mesh_, random_vertex(mesh_, rng_)), "remove ");
      case 4:
        return collapse();
      case 5:
        return move();
      default:
        return rare();
    }
  }

  void check() const {
    ASSERT_EQ(mesh_.validate(), std::nullopt);
    ASSERT_TRUE(test::has_canonical_outgoing(mesh_));
    ASSERT_EQ(live_vertices(mesh_), vertices_);
    const Invariants now = invariants(mesh_);
    ASSERT_EQ(now.boundary, keep_.boundary);
    ASSERT_EQ(now.lines, keep_.lines);
    ASSERT_EQ(now.doubled_areas, keep_.doubled_areas);
    ASSERT_EQ(now.fixed, keep_.fixed);
  }

 private:
  void flip_edge() {
    const HalfedgeId h = random_halfedge(mesh_, rng_);
    if (can_flip(mesh_, h) != FlipStatus::possible) return;
    const Mesh before = mesh_;
    unflip(mesh_, flip(mesh_, h));
    ASSERT_EQ(mesh_, before);
    flip(mesh_, h);
    ++counts_["flip"];
  }

  void insert() {
    const WeightedPoint p{dyadic(rng_, 32), dyadic(rng_, 32), random_weight(rng_)};
    const InsertionPlan plan = plan_insertion(mesh_, p, Mesh::triangle(random_halfedge(mesh_, rng_)));
    switch (plan.status) {
      case InsertionStatus::outside:
        ++counts_["insert refused: outside"];
        return;
      case InsertionStatus::at_vertex:
        ++counts_["insert refused: at a vertex"];
        return;
      case InsertionStatus::on_boundary:
        ++counts_["insert refused: on the boundary"];
        return;
      case InsertionStatus::on_constrained:
        ++counts_["insert refused: on a line"];
        return;
      case InsertionStatus::hidden:
        ++counts_["insert refused: hidden"];
        return;
      case InsertionStatus::inverted:
        FAIL() << "only splits are rounded";
      case InsertionStatus::in_quadrilateral:
        FAIL() << "the mesh has none";
      case InsertionStatus::not_regular:
        ++counts_["insert leaves an edge not regular"];
        break;
      case InsertionStatus::possible:
        break;
    }
    commit(plan);
    ++counts_[plan.edge.valid() ? "insert on an edge" : "insert in a triangle"];
  }

  void split() {
    const HalfedgeId h = random_halfedge(mesh_, rng_);
    // Only edges so long that coordinates keep few bits.
    if (squared_length(mesh_.position(mesh_.target(h)) - mesh_.position(mesh_.origin(h))) < 0x1p-12) return;
    const InsertionPlan plan = plan_split(mesh_, h, 0.25 * (1 + rng_.below(3)));
    if (plan.status == InsertionStatus::hidden) return;
    ASSERT_TRUE(plan.status == InsertionStatus::possible || plan.status == InsertionStatus::not_regular);
    const bool on_line = mesh_.is_constrained(h);
    ++counts_[mesh_.is_boundary(h) ? "split the boundary" : on_line ? "split a line" : "split an inner edge"];
    commit(plan);
  }

  /// Commits, and does what an observer saw again on a copy.
  void commit(const InsertionPlan& plan) {
    Mesh again = mesh_;
    VertexId seen;
    InsertionObserver observer;
    observer.inserting = [&](const InsertionPlan& p) {
      seen = p.edge.valid() ? split_edge(again, p.edge, p.point) : insert_in_triangle(again, p.triangle, p.point);
    };
    observer.flipped = [&](VertexId a, VertexId b, VertexId c, VertexId d) {
      const HalfedgeId h = again.find_halfedge(a, b);
      ASSERT_EQ(again.opposite(h), c);
      ASSERT_EQ(again.opposite(again.twin(h)), d);
      flip(again, h);
      ++counts_["flip of an insertion"];
    };
    const VertexId v = insert_vertex(mesh_, plan, &observer);
    ++vertices_;
    ASSERT_EQ(v, seen);
    ASSERT_EQ(mesh_, again);
    std::size_t spokes = 0;
    for (const HalfedgeId h : mesh_.star(v)) {
      ASSERT_NE(std::count(plan.link.begin(), plan.link.end(), mesh_.target(h)), 0);
      ++spokes;
    }
    ASSERT_EQ(spokes, plan.rim.size());
  }

  void collapse() {
    const VertexId v = random_vertex(mesh_, rng_);
    std::vector<VertexId> around;
    for (const HalfedgeId h : mesh_.star(v)) {
      if (mesh_.is_constrained(h)) around.assign(4, mesh_.target(h));  // along lines, where there are
      around.push_back(mesh_.target(h));
      around.push_back(mesh_.opposite(h));
    }
    const VertexId into = around[rng_.below(static_cast<std::uint32_t>(around.size()))];
    const RemovalPlan plan = plan_collapse(mesh_, v, into);
    if (plan.status == RemovalStatus::possible) {
      for (const auto& t : plan.triangles) ASSERT_NE(std::count(t.begin(), t.end(), into), 0);
    }
    remove(plan, "collapse ");
  }

  /// Commits a removal, and does the same from its numbers on a copy.
  void remove(const RemovalPlan& plan, const std::string& what) {
    if (plan.status != RemovalStatus::possible) return;
    const VertexId v = plan.vertex;
    ASSERT_FALSE(mesh_.is_fixed(v));
    ++counts_[what + (mesh_.is_boundary(v) ? "on the boundary" : is_on_line(mesh_, v) ? "on a line" : "inside")];
    Mesh again = mesh_;
    remove_vertex(again, removal_from_names(again, v, plan.link[0], plan.triangles));
    remove_vertex(mesh_, plan);
    ASSERT_EQ(mesh_, again);
    --vertices_;
  }

  void move() {
    const VertexId v = random_vertex(mesh_, rng_);
    mesh_.set_weight(v, random_weight(rng_));
    if (mesh_.is_boundary(v) || mesh_.is_fixed(v) || is_on_line(mesh_, v)) return;
    const Vec2 to = mesh_.position(v) + 0.25 * Vec2{dyadic(rng_, 64), dyadic(rng_, 64)};
    for (const HalfedgeId h : mesh_.star(v)) {
      const Vec2 a = mesh_.position(mesh_.target(h)), b = mesh_.position(mesh_.opposite(h));
      if (orient2d(to, a, b) != Sign::positive) return;
    }
    mesh_.set_position(v, to);
    ++counts_["move"];
  }

  void rare() {
    switch (rng_.below(4)) {
      case 0:
        mesh_.compact();
        ++counts_["compact"];
        return;
      case 1:
        counts_["flip to be regular"] += restore_regularity(mesh_).flips;
        return;
      case 2: {
        const Restoration restored = restore_regularity(mesh_, HiddenPolicy::remove);
        vertices_ -= restored.removed.size();
        counts_["remove because hidden"] += restored.removed.size();
        return;
      }
      default:
        return;
    }
  }

  Rng rng_;
  Mesh mesh_;
  Invariants keep_;
  Counts& counts_;
  std::size_t vertices_ = 0;
};

TEST(ConnectivityProperty, AThousandRandomSequencesOfAllOperationsKeepEveryInvariant) {
  Sequence::Counts counts;
  std::size_t cases = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed, ++cases) {
    Sequence sequence(seed, counts);
    for (int i = 0; i < 40; ++i) {
      sequence.step();
      sequence.check();
      ASSERT_FALSE(::testing::Test::HasFailure()) << "seed " << seed << ", operation " << i;
    }
  }
  EXPECT_EQ(cases, 1000u);
  for (const char* what : {"flip",
                           "insert in a triangle",
                           "insert on an edge",
                           "flip of an insertion",
                           "split the boundary",
                           "split a line",
                           "split an inner edge",
                           "remove inside",
                           "remove on the boundary",
                           "remove on a line",
                           "collapse inside",
                           "collapse on the boundary",
                           "collapse on a line",
                           "move",
                           "compact",
                           "flip to be regular",
                           "remove because hidden",
                           "insert refused: outside",
                           "insert refused: at a vertex",
                           "insert refused: on the boundary",
                           "insert refused: on a line",
                           "insert refused: hidden",
                           "insert leaves an edge not regular"}) {
    EXPECT_GE(counts[what], 100u) << what;
  }
}

// What an insertion must be, found without its plan: put the vertex in and run Lawson's algorithm over the whole mesh.
TEST(ConnectivityProperty, AnInsertionIntoARegularMeshIsWhatItsPlanSaysAndRegular) {
  std::size_t inserted = 0, flips = 0, hidden = 0, not_regular = 0;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    Rng rng(seed);
    Mesh mesh = test::mesh_of_random_points(rng, 25, seed % 3 == 0 ? 16 : 0);
    for (const HalfedgeId h : mesh.halfedges()) {
      if (!mesh.is_boundary(h) && rng.below(20) == 0) mesh.set_constrained(h, true);
    }
    for (const VertexId v : mesh.vertices()) mesh.set_weight(v, 0.004 * rng.uniform(-1, 1));
    if (!restore_regularity(mesh, HiddenPolicy::remove).regular()) continue;
    InsertionPlan plan;
    for (int i = 0; i < 15; ++i) {
      const WeightedPoint p{rng.uniform(-1, 1), rng.uniform(-1, 1), 0.05 * rng.uniform(-1, 1)};
      plan = plan_insertion(mesh, p, Mesh::triangle(random_halfedge(mesh, rng)), std::move(plan));
      hidden += plan.status == InsertionStatus::hidden ? 1 : 0;
      not_regular += plan.status == InsertionStatus::not_regular ? 1 : 0;
      if (plan.status != InsertionStatus::possible) continue;
      Mesh naive = mesh;
      ASSERT_TRUE(test::insert_anywhere(naive, p));
      ASSERT_TRUE(restore_regularity(naive).regular());
      const VertexId v = insert_vertex(mesh, plan);
      ASSERT_EQ(mesh.validate(), std::nullopt);
      ASSERT_EQ(count_non_regular_edges(mesh, false), 0u) << "seed " << seed;
      if (seed % 3 != 0) {
        ASSERT_EQ(test::edge_set(mesh), test::edge_set(naive)) << "seed " << seed;
      }
      std::vector<VertexId> around;
      for (const HalfedgeId h : mesh.star(v)) around.push_back(mesh.target(h));
      const auto first = std::find(around.begin(), around.end(), plan.link[0]);
      std::rotate(around.begin(), first, around.end());
      ASSERT_EQ(around, plan.link);
      flips += plan.flips.size();
      ++inserted;
    }
  }
  EXPECT_GT(inserted, 1000u);
  EXPECT_GT(flips, 1000u);
  EXPECT_GT(hidden, 50u);
  EXPECT_GT(not_regular, 20u);
}

}  // namespace
}  // namespace temper
