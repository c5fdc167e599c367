// Where the vertices and tetrahedra of a changed mesh take their data from.
#include "temper/tets/location.hpp"

#include <gtest/gtest.h>

#include "support/std_threads.hpp"
#include "support/tet_lattice.hpp"
#include "temper/detail/location.hpp"
#include "temper/tets/geometry.hpp"

namespace temper::test {
namespace {

double linear(Vec3 p) { return 3 + 0.25 * p.x - 0.125 * p.y + 2 * p.z; }

/// A lattice, and the same with its inner vertices off their places.
struct Moved {
  tets::TetMesh before = mesh_of(body_centered(4)), after = before;
  Moved() {
    const TetArrays shaken_points = shaken(body_centered(4), 0.3, 0);
    const auto on_boundary = tets::boundary_vertices(before);
    for (const VertexId v : before.vertices()) {
      const Vec3 p = shaken_points.points[v.index];
      if (on_boundary[v] == 0) after.set_point(v, {p.x, p.y, p.z, 0});
    }
  }
};

TEST(PlacesOfTetrahedra, ReproduceLinearDataWhereverVerticesMove) {
  const Moved m;
  const auto places = positions_of_vertices(m.before, m.after);
  std::size_t moved = 0;
  for (const VertexId v : m.after.vertices()) {
    const Vec3 p = m.after.position(v);
    EXPECT_NEAR(interpolated(places[v], [&](VertexId u) { return linear(m.before.position(u)); }), linear(p), 1e-13);
    if (m.before.position(v) == p) {
      EXPECT_EQ(places[v].n, 1);
      EXPECT_EQ(places[v].corners[0], v);
    } else {
      ++moved;
    }
  }
  EXPECT_GT(moved, 20U);
}

TEST(PlacesOfTetrahedra, SourcesContainTheMiddleAndUnchangedOnesAreThemselves) {
  const Moved m;
  const auto sources = sources_of_tetrahedra(m.before, m.after);
  std::size_t same = 0;
  for (const tets::TetId t : m.after.tetrahedra()) {
    Vec3 middle;
    bool stays = true;
    for (const VertexId v : m.after.corners(t)) {
      middle = middle + 0.25 * m.after.position(v);
      stays = stays && m.before.position(v) == m.after.position(v);
    }
    if (stays) {
      EXPECT_EQ(sources[t], t);
      ++same;
    }
    for (int f = 0; f < 4; ++f) {
      const auto [a, b, c] = m.before.vertices(tets::TetMesh::halfface(sources[t], f));
      EXPECT_NE(tets::orientation(m.before.position(a), m.before.position(b), m.before.position(c), middle),
                Sign::negative);
    }
  }
  EXPECT_GT(m.after.n_tetrahedra(), same);
}

TEST(PlacesOfTetrahedra, DoNotDependOnThreads) {
  const Moved m;
  StdThreads threads(3);
  const auto places = positions_of_vertices(m.before, m.after),
             again = positions_of_vertices(m.before, m.after, {}, &threads);
  for (const VertexId v : m.after.vertices()) {
    EXPECT_EQ(places[v].tetrahedron, again[v].tetrahedron);
    EXPECT_EQ(places[v].shares, again[v].shares);
  }
  EXPECT_EQ(sources_of_tetrahedra(m.before, m.after), sources_of_tetrahedra(m.before, m.after, {}, &threads));
}

TEST(PlacesOfTetrahedra, OfAPointOutsideAreTheTetrahedronNearby) {
  const Moved m;
  EXPECT_EQ(find_tetrahedron(m.before, {-9, 0, 0}, tets::TetId(7)), tets::TetId(7));
}

}  // namespace
}  // namespace temper::test
