// Mesh::build against brute force: a soup of triangles is embedded when no two of them share an inner point, decided
// for all pairs exactly. Boundaries that touch (where no inner points are shared) are kept out by the generator's
// random real coordinates, and tested by hand in build_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>

#include "temper/detail/geometry.hpp"
#include "unit/mesh/random_soup.hpp"

namespace temper {
namespace {

using test::Arrays;

using Corners = std::array<Vec2, 3>;

Corners corners(const Arrays& arrays, std::size_t t) {
  Corners c;
  for (std::size_t k = 0; k < 3; ++k) c[k] = arrays.points[static_cast<std::size_t>(arrays.triangles[t][k])];
  if (orient2d(c[0], c[1], c[2]) == Sign::negative) std::swap(c[1], c[2]);
  return c;
}

/// Convex sets without common inner points are separated by a line along an edge of one of them.
bool separated_by_an_edge_of(const Corners& s, const Corners& t) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 a = s[k], b = s[(k + 1) % 3];
    if (std::none_of(t.begin(), t.end(), [&](Vec2 p) { return orient2d(a, b, p) == Sign::positive; })) return true;
  }
  return false;
}

bool brute_force_overlap(const Arrays& arrays) {
  for (std::size_t s = 0; s < arrays.triangles.size(); ++s) {
    for (std::size_t t = 0; t < s; ++t) {
      const Corners a = corners(arrays, s), b = corners(arrays, t);
      if (!separated_by_an_edge_of(a, b) && !separated_by_an_edge_of(b, a)) return true;
    }
  }
  return false;
}

/// A random part of a triangulation: what is left when each triangle goes with some probability.
Arrays random_part(Rng& rng, const Mesh& mesh) {
  const double keep = rng.uniform(0.5, 1);
  std::vector<TriangleId> triangles;
  for (const TriangleId t : mesh.triangles()) {
    if (rng.uniform() < keep) triangles.push_back(t);
  }
  if (triangles.empty()) triangles.push_back(TriangleId(0));
  return test::arrays_of(mesh, triangles);
}

/// Counts of each outcome: a property that never met one of them has not been tested.
struct Outcomes {
  int embedded = 0, overlapping = 0, not_manifold = 0;
};

/// Manifold soups must be told apart as brute force does; the others are refused before.
void compare(const Arrays& arrays, Outcomes& outcomes) {
  const auto result = arrays.build();
  const bool overlaps = brute_force_overlap(arrays);
  if (result.has_value()) {
    EXPECT_FALSE(overlaps);
    EXPECT_EQ(result->mesh.validate(), std::nullopt);
    ++outcomes.embedded;
  } else if (result.error().code == ErrorCode::overlap) {
    EXPECT_TRUE(overlaps) << result.error().what();
    ++outcomes.overlapping;
  } else {
    EXPECT_TRUE(result.error().code == ErrorCode::non_manifold_vertex ||
                result.error().code == ErrorCode::non_manifold_edge)
        << result.error().what();
    ++outcomes.not_manifold;
  }
}

TEST(Embedding, OfPartsOfATriangulationIsNeverRefused) {
  Rng rng(1);
  Outcomes outcomes;
  for (int i = 0; i < 2000; ++i) {
    const Mesh mesh = test::random_triangulation(rng, 3 + static_cast<int>(rng.below(15)));
    compare(random_part(rng, mesh), outcomes);
    if (HasFailure()) FAIL() << "in soup " << i;
  }
  EXPECT_EQ(outcomes.overlapping, 0);
  EXPECT_GT(outcomes.embedded, 300);
  EXPECT_GT(outcomes.not_manifold, 300);
}

// Connectivity stays manifold, places do not: interior stars wind twice or fold, boundaries cross, parts cover parts.
TEST(Embedding, OfFoldedTriangulationsAgreesWithBruteForce) {
  Rng rng(2);
  Outcomes outcomes;
  for (int i = 0; i < 4000; ++i) {
    Arrays arrays = random_part(rng, test::random_triangulation(rng, 2 + static_cast<int>(rng.below(10))));
    const std::uint32_t moves = 1 + rng.below(3);
    for (std::uint32_t move = 0; move < moves; ++move) {
      Vec2& p = arrays.points[rng.below(static_cast<std::uint32_t>(arrays.points.size()))];
      const double by = rng.uniform() < 0.5 ? 0.2 : 2;
      p = p + Vec2{rng.uniform(-by, by), rng.uniform(-by, by)};
    }
    compare(arrays, outcomes);
    if (HasFailure()) FAIL() << "in soup " << i;
  }
  EXPECT_GT(outcomes.embedded, 300);
  EXPECT_GT(outcomes.overlapping, 1000);
}

// Two valid meshes on top of each other, beside each other, or one in a hole of the other.
TEST(Embedding, OfTwoMeshesAgreesWithBruteForce) {
  Rng rng(3);
  Outcomes outcomes;
  int in_holes = 0;
  for (int i = 0; i < 2000; ++i) {
    const Arrays ring = test::squares(3, {-1.5, -1.5}, {{1, 1}});
    Arrays small = random_part(rng, test::random_triangulation(rng, 2));
    const double scale = rng.uniform(0.05, 0.4);
    const Vec2 offset{rng.uniform(-2.5, 2.5), rng.uniform(-0.7, 0.7)};
    for (Vec2& p : small.points) p = scale * p + offset;
    const int embedded_before = outcomes.embedded;
    compare(rng.uniform() < 0.5 ? test::together(ring, small) : test::together(small, ring), outcomes);
    in_holes += outcomes.embedded > embedded_before && length(offset) < 0.5 ? 1 : 0;
    if (HasFailure()) FAIL() << "in soup " << i;
  }
  EXPECT_GT(outcomes.embedded, 300);
  EXPECT_GT(in_holes, 50);
  EXPECT_GT(outcomes.overlapping, 300);
}

// A ribbon of random turns: its stars are all good, only its boundary or its ends tell.
TEST(Embedding, OfRibbonsAgreesWithBruteForce) {
  Rng rng(4);
  Outcomes outcomes;
  for (int i = 0; i < 2000; ++i) {
    Arrays ribbon;
    Vec2 at{0, 0};
    double heading = 0;
    const int length = 4 + static_cast<int>(rng.below(40));
    for (int k = 0; k < length; ++k) {
      const Vec2 along{std::cos(heading), std::sin(heading)}, left{-along.y, along.x};
      ribbon.points.push_back(at + -0.2 * left);
      ribbon.points.push_back(at + 0.2 * left);
      heading += rng.uniform(-0.5, 0.9);
      at = at + along;
      if (k == 0) continue;
      const auto n = static_cast<std::int32_t>(ribbon.points.size());
      ribbon.triangles.push_back({n - 4, n - 2, n - 1});
      ribbon.triangles.push_back({n - 4, n - 1, n - 3});
    }
    compare(ribbon, outcomes);
    if (HasFailure()) FAIL() << "in ribbon " << i;
  }
  EXPECT_GT(outcomes.embedded, 300);
  EXPECT_GT(outcomes.overlapping, 300);
  EXPECT_EQ(outcomes.not_manifold, 0);
}

/// Convex sets without any common point are separated by a line along an edge of one of them, which misses the other.
bool strictly_separated_by_an_edge_of(const Corners& s, const Corners& t) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 a = s[k], b = s[(k + 1) % 3];
    if (std::all_of(t.begin(), t.end(), [&](Vec2 p) { return orient2d(a, b, p) == Sign::negative; })) return true;
  }
  return false;
}

bool brute_force_contact(const Arrays& arrays) {
  for (std::size_t s = 0; s < arrays.triangles.size(); ++s) {
    for (std::size_t t = 0; t < s; ++t) {
      const Corners a = corners(arrays, s), b = corners(arrays, t);
      if (!strictly_separated_by_an_edge_of(a, b) && !strictly_separated_by_an_edge_of(b, a)) return true;
    }
  }
  return false;
}

Vec2 lattice_point(Rng& rng, std::uint32_t side) {
  return {static_cast<double>(rng.below(side)), static_cast<double>(rng.below(side))};
}

// Ends on edges, edges on edges and under each other, several edges through one point.
TEST(Embedding, OfSeparateTrianglesOnALatticeAgreesWithBruteForce) {
  Rng rng(5);
  int embedded = 0, refused = 0;
  for (int i = 0; i < 20000; ++i) {
    Arrays arrays;
    const std::uint32_t side = 4 + rng.below(9), n = 2 + rng.below(5);
    while (arrays.triangles.size() < n) {
      const Corners c = {lattice_point(rng, side), lattice_point(rng, side), lattice_point(rng, side)};
      if (orient2d(c[0], c[1], c[2]) == Sign::zero) continue;
      const auto first = static_cast<std::int32_t>(arrays.points.size());
      arrays.points.insert(arrays.points.end(), c.begin(), c.end());
      arrays.triangles.push_back({first, first + 1, first + 2});
    }
    const bool builds = arrays.build().has_value();
    EXPECT_EQ(builds, !brute_force_contact(arrays)) << "in soup " << i;
    if (HasFailure()) return;
    ++(builds ? embedded : refused);
  }
  EXPECT_GT(embedded, 1000);
  EXPECT_GT(refused, 10000);
}

// A search for each component among all edges, or for pairs of edges with boxes that meet, would take minutes.
TEST(Embedding, OfManyComponentsAndLongEdgesTakesNoTime) {
  constexpr int kRings = 20000, kTeeth = 50000;
  Arrays nested;  // each ring in the hole of the next one
  for (int k = 0; k < kRings; ++k) {
    for (const double r : {2.0 * k + 1, 2.0 * k + 2})
      nested.points.insert(nested.points.end(), {{r, r}, {-r, r}, {-r, -r}, {r, -r}});
    for (std::int32_t i = 0; i < 4; ++i) {
      const std::int32_t a = 8 * k + i, b = 8 * k + (i + 1) % 4;
      nested.triangles.insert(nested.triangles.end(), {{a, a + 4, b + 4}, {a, b + 4, b}});
    }
  }
  EXPECT_TRUE(nested.build().has_value());
  Arrays comb;  // teeth that lean over all that follow them
  for (int k = 0; k < kTeeth; ++k) {
    const auto first = static_cast<std::int32_t>(comb.points.size());
    comb.points.insert(comb.points.end(), {{1.0 * k, 0}, {k + 0.5, 0}, {k + 1.0 * kTeeth, 1.0 * kTeeth}});
    comb.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_TRUE(comb.build().has_value());
  comb.points.back() = {0.5 * kTeeth, 0.25 * kTeeth};  // the last one falls on the others
  ASSERT_FALSE(comb.build().has_value());
  EXPECT_EQ(comb.build().error().code, ErrorCode::overlap);
}

}  // namespace
}  // namespace temper
