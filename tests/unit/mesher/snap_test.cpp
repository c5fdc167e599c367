// Joins within a tolerance: what holds of any result, and what users see of it.
#include "mesher/snap.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/rng.hpp"
#include "outlines.hpp"
#include "temper/detail/projection.hpp"

namespace temper::test {
namespace {

using mesher::Deadline;
using mesher::SegmentPart;
using mesher::SnapOptions;
using mesher::Snapped;

Snapped snapped(const Surface& surface, const std::vector<Vec3>& places, const std::vector<SegmentPart>& segments,
                const SnapOptions& options) {
  const Observer none;
  Deadline deadline(0, none);
  return mesher::snap(surface, places, segments, options, deadline);
}

std::vector<Vec3> random_places(const Surface& surface, std::size_t n, Rng& rng) {
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 p = {rng.uniform(), rng.uniform()};
    places.push_back(surface.is_plane() ? Vec3{p.x, p.y, 0} : direction_of({40 * p.x, 40 * p.y}));
  }
  return places;
}

TEST(Snap, NothingIsLeftNearerThanTheToleranceAndNothingCrosses) {
  for (const bool plane : {true, false}) {
    const Surface surface(plane ? Space() : Space::sphere(1));
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      Rng rng(seed);
      const std::vector<Vec3> places = random_places(surface, 40, rng);
      std::vector<SegmentPart> segments;
      for (std::int32_t i = 0; i + 1 < 30; ++i) segments.push_back({{i, i + 1}, static_cast<std::uint32_t>(i)});
      const double within = std::pow(10.0, -1.0 - static_cast<double>(seed % 4));
      const Snapped s = snapped(surface, places, segments, {within, true});
      ASSERT_FALSE(s.crossing);
      const auto at = [&](std::int32_t p) { return s.places[static_cast<std::size_t>(p)]; };
      for (std::size_t i = 0; i < s.places.size(); ++i) {
        const auto p = static_cast<std::int32_t>(i);
        if (i < places.size()) {
          EXPECT_EQ(s.places[i], places[i]);  // bit for bit
        }
        EXPECT_LE(s.joined[i], p);
        if (s.joined[i] != p) continue;
        for (std::int32_t q = 0; q < p; ++q) {
          if (s.joined[static_cast<std::size_t>(q)] == q) {
            EXPECT_GT(length(at(p) - at(q)), within);
          }
        }
        for (const SegmentPart& part : s.parts) {
          if (part.ends[0] == p || part.ends[1] == p) continue;
          EXPECT_GT(surface.squared_distance(at(p), at(part.ends[0]), at(part.ends[1])), within * within);
        }
      }
      for (const SegmentPart& one : s.parts) {
        for (const SegmentPart& other : s.parts) {
          const Vec3 a = at(one.ends[0]), b = at(one.ends[1]), c = at(other.ends[0]), d = at(other.ends[1]);
          const Sign of_c = surface.orientation(a, b, c), of_a = surface.orientation(c, d, a);
          EXPECT_FALSE(of_c != Sign::zero && of_a == -of_c && surface.orientation(a, b, d) == -of_c &&
                       surface.orientation(c, d, b) == of_c);
        }
      }
      SnapOptions rest = {within, true};
      for (std::size_t i = 0; i < s.places.size(); ++i) {
        rest.ignored.push_back(s.joined[i] == static_cast<std::int32_t>(i) ? 0 : 1);
      }
      const Snapped again = snapped(surface, s.places, s.parts, rest);
      EXPECT_EQ(again.parts.size(), s.parts.size());  // nothing is left to do
    }
  }
}

/// A line from the outline's segment `side` to the middle, its end moved off the segment.
Outline with_line_beside(double off) {
  Outline o = loop({{0, 0}, {10, 1}, {9, 9}, {1, 8}}, 1);
  const Vec2 end = Vec2{0, 0} + 0.37 * Vec2{10, 1};
  add_line(o, {{end.x, end.y + off}, {5, 5}}, false, 7);
  return o;
}

TEST(Snap, ALineThatEndsBesideABorderCostsNothing) {
  const auto exact = mesh_outline(with_line_beside(0), of_size(1));
  ASSERT_TRUE(exact);
  for (const double off : {1e-16, 6e-15, -6e-15, 1e-11, -1e-11, 5e-9, -5e-9}) {
    const auto made = mesh_outline(with_line_beside(off), of_size(1));
    ASSERT_TRUE(made) << made.error().what();
    EXPECT_EQ(made->bad, 0u);
    EXPECT_LT(made->mesh.n_vertices(), exact->mesh.n_vertices() + 20) << off;
    const VertexId end = made->vertex_of_point[4];
    EXPECT_TRUE(made->mesh.is_boundary(end));
    if (std::abs(off) < 1e-12) continue;
    ASSERT_EQ(made->notes.size(), 1u);
    EXPECT_NE(made->notes[0].find("points joined to a point or segment"), std::string::npos);
  }
}

TEST(Snap, ANarrowPlaceIsNamedWithItsWidthAndCure) {
  Outline o = loop({{0, 0}, {100, 0}, {100, 80}, {0, 80}});
  add_line(o, {{0.001, 0.001}, {40, 0.001}, {40, 30}, {0.001, 30}}, true);
  MesherOptions options = of_size(8);
  const auto refused = mesh_outline(o, options);
  ASSERT_FALSE(refused);
  for (const char* part : {"narrow: 0.001 at (", "between segment", "--snap 0.0011"}) {
    EXPECT_NE(refused.error().what().find(part), std::string::npos) << refused.error().what();
  }
  options.snap = 0.0011;
  const auto made = mesh_outline(o, options);
  ASSERT_TRUE(made) << made.error().what();
  EXPECT_EQ(made->bad, 0u);
  EXPECT_LT(made->mesh.n_vertices(), 400u);
}

TEST(Snap, CrossingLinesAreDividedAndClippedIfAskedFor) {
  Outline o = square();
  add_line(o, {{-1, 0.3}, {2, 0.7}}, false, 5);
  add_line(o, {{0.2, 0.8}, {0.8, 0.2}}, false, 6);
  MesherOptions options = of_size(0.3);
  const auto refused = mesh_outline(o, options);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what().find("crosses"), std::string::npos);
  EXPECT_NE(refused.error().what().find(" at ("), std::string::npos) << refused.error().what();
  EXPECT_NE(refused.error().what().find("--split-crossings"), std::string::npos);
  options.split_crossings = true;
  const auto made = mesh_outline(o, options);
  ASSERT_TRUE(made) << made.error().what();
  EXPECT_EQ(made->bad, 0u);
  double inside = 0;
  for (const MeshLine& line : made->lines) {
    if (line.tag == 5) inside += length(made->mesh.position(line.b) - made->mesh.position(line.a));
  }
  EXPECT_NEAR(inside, std::hypot(1, 0.4 / 3), 1e-9);
  EXPECT_FALSE(made->vertex_of_point[4].valid());
}

TEST(Snap, DomainsThatTouchAtAPointAreDividedThere) {
  Outline o = loop({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  add_line(o, {{1, 1}, {2, 1}, {2, 2}, {1, 2}}, true);
  const auto made = mesh_outline(o, of_size(0.3));
  ASSERT_TRUE(made) << made.error().what();
  EXPECT_EQ(made->bad, 0u);
  EXPECT_NE(made->notes.back().find("touched itself, and was divided: 1; the first is (1, 1)"), std::string::npos);
}

TEST(Snap, SmallIslandsAreLeftOutIfAskedFor) {
  Outline o = loop({{0, 0}, {4, 0}, {4, 4}, {0, 4}});
  add_line(o, ring({2, 2}, 0.01, 5), true);
  for (const auto& [first, last, shell] : {std::array{0, 4, -1}, std::array{4, 9, 0}}) {
    OutlineRing r;
    for (int s = first; s < last; ++s) r.segments.push_back(s);
    r.shell = shell;
    o.rings.push_back(r);
  }
  OutlinePart part;
  for (std::int32_t s = 0; s < 9; ++s) part.segments.push_back(s);
  o.parts = {part};
  MesherOptions options = of_size(1);
  options.drop_below = 0.1;
  const auto made = mesh_outline(o, options);
  ASSERT_TRUE(made) << made.error().what();
  EXPECT_LT(made->mesh.n_vertices(), 60u);
  EXPECT_FALSE(made->vertex_of_point[4].valid());
  EXPECT_NE(made->notes[0].find("rings left out, because their extent is below 0.1"), std::string::npos);
  options.drop_below = 0;
  options.snap = 0.1;
  const auto refused = mesh_outline(o, options);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what().find("encloses nothing after joins within 0.1"), std::string::npos);
}

TEST(Snap, LinesOfWhichJoinsLeaveNothingAreNamed) {
  Outline o = square();
  add_line(o, {{0.5, 0.5}, {0.51, 0.5}, {0.52, 0.5}}, false, 5);  // whole
  add_line(o, {{0.7, 0.2}, {0.71, 0.2}, {0.9, 0.2}}, false, 6);   // its first segment
  add_line(o, {{0.2, 0.8}, {0.21, 0.8}}, false, 6);               // another line of that tag
  o.groups = {{1, 5, "brook"}};
  MesherOptions options = of_size(0.2);
  EXPECT_TRUE(mesh_outline(o, options)->warnings.empty());
  options.snap = 0.03;
  const auto made = mesh_outline(o, options);
  ASSERT_TRUE(made) << made.error().what();
  ASSERT_EQ(made->warnings.size(), 2u);
  EXPECT_EQ(made->warnings[0],
            "joins within 0.03 (--snap) remove the whole line at (0.5, 0.5), segment 4, 'brook': its points become "
            "one. Next: a smaller --snap "
            "keeps it");
  EXPECT_NE(made->warnings[1].find("at (0.2, 0.8), segment 8, tag 6:"), std::string::npos);
  EXPECT_NE(made->notes.back().find("lines of 'brook'"), std::string::npos);
}

TEST(Snap, CoastPointsThatNearlyCoincideAreNoTrouble) {
  std::vector<Vec2> coast;
  for (int i = 0; i < 30; ++i)
    coast.push_back({20 + 15 * std::cos(std::numbers::pi * i / 15), 10 + 12 * std::sin(std::numbers::pi * i / 15)});
  for (const double off : {1e-12, 1e-9, 1e-8, 1e-7}) {
    SphereOutline o;
    std::vector<Vec2> moved = coast;
    moved.insert(moved.begin() + 1, {coast[0].x - off, coast[0].y + 3 * off});
    add_line(o.coasts, moved, true);
    add_line(o.lines, {{coast[0].x + off, coast[0].y}, {45, 12}, {60, 20}}, false);
    const auto made = mesh_sphere(o, of_size(1e6));
    ASSERT_TRUE(made) << made.error().what();
    EXPECT_EQ(made->bad, 0u);
    EXPECT_EQ(made->vertex_of_point[0], made->vertex_of_point[1]);
    EXPECT_EQ(made->vertex_of_point[0], made->vertex_of_point[31]);
  }
}

}  // namespace
}  // namespace temper::test
