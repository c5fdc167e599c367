// Which vertices slide, where, and what stays.
#include "tets/optimize/mobility.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "base/sort_unique.hpp"
#include "support/std_threads.hpp"
#include "support/tet_lattice.hpp"
#include "temper/tets/criterion.hpp"
#include "temper/tets/quality.hpp"

namespace temper::tets {
namespace {

constexpr int kSide = 4;

/// A block of cubes: two regions that meet at x = 2, and tags on z = 0 that meet at y = 1. A line of two tags leads
/// through it at x = 1, y = 3; they meet at z = 2. Points are off their places as far as the parts that stay allow.
class Block {
 public:
  explicit Block(double jitter) : arrays_(test::cubes(kSide, test::kSixTets)), exact_(arrays_.points) {
    test::Noise noise(3);
    for (Vec3& p : arrays_.points) {
      const auto [x, y, z] = stays(p);
      p = p + jitter * Vec3{x ? 0 : noise(), y ? 0 : noise(), z ? 0 : noise()};
    }
  }

  /// Says if x, y and z stay at an exact point.
  static std::array<bool, 3> stays(Vec3 p) {
    const auto at_end = [](double x) { return x == 0 || x == kSide; };
    if (p.x == 1 && p.y == 3) return {true, true, at_end(p.z) || p.z == 2};
    return {at_end(p.x) || p.x == 2, at_end(p.y) || (p.z == 0 && p.y == 1), at_end(p.z)};
  }
  [[nodiscard]] const std::vector<Vec3>& exact() const { return exact_; }
  std::vector<Vec3>& points() { return arrays_.points; }

  [[nodiscard]] TetMesh mesh() const {
    TetMeshInput in = arrays_.input();
    std::vector<std::int32_t> regions, face_tags, line_tags;
    std::vector<std::array<std::int32_t, 3>> faces;
    std::vector<std::array<std::int32_t, 2>> lines;
    const auto at = [&](std::int32_t i) { return exact_[std::size_t(i)]; };
    for (const auto& t : arrays_.tetrahedra) {
      double x = 0;
      std::vector<std::int32_t> bottom;
      for (const std::int32_t i : t) {
        x += at(i).x / 4;
        if (at(i).z == 0) bottom.push_back(i);
        for (const std::int32_t j : t) {
          if (at(i).x == 1 && at(i).y == 3 && at(j) == at(i) + Vec3{0, 0, 1}) lines.push_back({i, j});
        }
      }
      regions.push_back(x < 2 ? 1 : 2);
      if (bottom.size() != 3) continue;
      faces.push_back({bottom[0], bottom[1], bottom[2]});
      face_tags.push_back(std::max({at(bottom[0]).y, at(bottom[1]).y, at(bottom[2]).y}) <= 1 ? 5 : 6);
    }
    sort_unique(lines);
    for (const auto& line : lines) line_tags.push_back(at(line[0]).z < 2 ? 7 : 8);
    in.regions = regions, in.faces = faces, in.face_tags = face_tags, in.lines = lines, in.line_tags = line_tags;
    return test::built(in).mesh;
  }

 private:
  test::TetArrays arrays_;
  std::vector<Vec3> exact_;
};

OptimizeOptions sliding() {
  OptimizeOptions options;
  options.boundary = BoundaryVertices::slide, options.flips = Flips::none;
  return options;
}

/// A rotation without zeros.
Vec3 turned(Vec3 p) {
  const auto turn = [](double& a, double& b, double angle) {
    const double x = a;
    a = std::cos(angle) * x - std::sin(angle) * b, b = std::sin(angle) * x + std::cos(angle) * b;
  };
  turn(p.x, p.y, 0.7), turn(p.y, p.z, 1.1), turn(p.z, p.x, 0.4);
  return p;
}
Vec3 unit(std::size_t axis) { return {axis == 0 ? 1.0 : 0, axis == 1 ? 1.0 : 0, axis == 2 ? 1.0 : 0}; }

TEST(TetMobility, VerticesSlideInOnePlaneOrAlongOneStraightLine) {
  for (const bool turn : {false, true}) {
    Block block(0.2);
    if (turn) {
      for (Vec3& p : block.points()) p = turned(p);
    }
    const auto all = mobilities(block.mesh(), sliding());
    const auto kept = mobilities(block.mesh());
    std::array<std::size_t, 4> count = {};
    for (const VertexId v : block.mesh().vertices()) {
      const auto stays = Block::stays(block.exact()[v.index]);
      const auto n = std::size_t(3 - std::count(stays.begin(), stays.end(), true));
      EXPECT_EQ(all[v].dimensions, n) << v.index;
      EXPECT_TRUE(all[v].weighs);
      EXPECT_EQ(kept[v], n == 3 ? Mobility::free : Mobility::weight);
      for (std::size_t axis = 0; axis < 3 && all[v].slides(); ++axis) {
        const Vec3 along = turn ? turned(unit(axis)) : unit(axis);
        EXPECT_NEAR(length(all[v].allowed(along) - (stays[axis] ? 0.0 : 1.0) * along), 0, 1e-14);
        if (!turn) {
          EXPECT_EQ(all[v].allowed(along), stays[axis] ? Vec3{} : along);
        }
      }
      ++count[n];
    }
    for (const std::size_t c : count) EXPECT_GT(c, 10U);
  }
}

TEST(TetMobility, ABentFaceAndUserChoicesFixVertices) {
  Block block(0);
  const auto number = [](std::size_t x, std::size_t y, std::size_t z) {
    return (z * (kSide + 1) + y) * (kSide + 1) + x;
  };
  const auto before = mobilities(block.mesh(), sliding());
  block.points()[number(0, 2, 2)].x -= 1e-6;  // bends the faces around it, and creases meet at its neighbors
  const auto bent = mobilities(block.mesh(), sliding());
  for (const auto& [y, z] : {std::pair(2, 2), {1, 2}, {2, 1}, {1, 1}}) {
    EXPECT_EQ(before[VertexId(number(0, y, z))].dimensions, 2);
    EXPECT_EQ(bent[VertexId(number(0, y, z))], Mobility::weight);
  }
  OptimizeOptions options = sliding();
  options.unknowns = Unknowns::positions;
  EXPECT_EQ(mobilities(block.mesh(), options)[VertexId(number(1, 1, 1))], Mobility::position);
  EXPECT_EQ(mobilities(block.mesh(), options)[VertexId(number(0, 0, 0))], Mobility::none);
  options.unknowns = Unknowns::weights;
  for (const Mobility& m : mobilities(block.mesh(), options)) EXPECT_EQ(m, Mobility::weight);
}

TEST(TetMobility, TagsOfPointsMayListTheVerticesOfFacesAndLines) {
  const test::TetArrays arrays = test::cubes(kSide, test::kSixTets);
  TetMeshInput in = arrays.input();
  std::vector<std::int32_t> marked, tags;
  const auto at_end = [](double x) { return x == 0 || x == kSide; };
  const auto tag_of = [&](Vec3 p) {  // of planes, lines along axes and corners, as generators number them
    const std::array<double, 3> at = {p.x, p.y, p.z};
    const auto ends = std::count_if(at.begin(), at.end(), at_end);
    if (p.z == kSide && p.y == 3 && !at_end(p.x)) return 40;  // a line in a plane
    if (p == Vec3{0, 1, 1} || p == Vec3{1, 1, 1}) return 50 + int(p.x);
    int tag = ends == 0 ? 0 : 1 + int(ends);
    for (const double x : at) tag = 5 * tag + (at_end(x) ? 1 + int(x) / kSide : 0);
    return tag;
  };
  for (std::size_t i = 0; i < arrays.points.size(); ++i)
    marked.push_back(int(i)), tags.push_back(tag_of(arrays.points[i]));
  in.marked_points = marked, in.point_tags = tags;
  const TetMesh mesh = test::built(in).mesh;
  const auto all = mobilities(mesh, sliding()), kept = mobilities(mesh);
  for (const VertexId v : mesh.vertices()) {
    const Vec3 p = mesh.position(v);
    const int stays = int(at_end(p.x)) + int(at_end(p.y)) + int(at_end(p.z));
    const bool on_line = p.z == kSide && p.y == 3, is_end = on_line && (p.x == 1 || p.x == kSide - 1);
    const bool is_place = p == Vec3{0, 1, 1} || p == Vec3{1, 1, 1};
    EXPECT_EQ(all[v].dimensions, is_place || is_end ? 0 : on_line && stays == 1 ? 1 : 3 - stays) << v.index;
    EXPECT_EQ(kept[v].dimensions, stays == 0 && !is_place ? 3 : 0);
  }
}

TEST(TetMobility, SlidingKeepsVolumePlanesLinesCornersAndTagsOnAnyThread) {
  for (const bool turn : {false, true}) {
    Block block(0.25);
    if (turn) {
      for (Vec3& p : block.points()) p = turned(p);
    }
    const TetMesh input = block.mesh();
    TetMesh mesh = input, again = input, kept = input;
    ASSERT_TRUE(optimize(mesh, sliding()));
    std::array<std::size_t, 3> moved = {};
    for (const VertexId v : mesh.vertices()) {
      const Vec3 by = mesh.position(v) - input.position(v);
      const auto stays = Block::stays(block.exact()[v.index]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!stays[axis]) continue;
        EXPECT_LE(std::abs(dot(by, turn ? turned(unit(axis)) : unit(axis))), turn ? 1e-14 : 0);
      }
      const auto n = std::size_t(std::count(stays.begin(), stays.end(), true));
      if (n < 3 && length(by) > 0.01) ++moved[n];
      if (n == 3) {
        EXPECT_EQ(by, Vec3{});
      }
    }
    for (const std::size_t n : moved) EXPECT_GT(n, 5U);
    EXPECT_NEAR(quality(mesh).volume, quality(input).volume, 1e-12);
    EXPECT_EQ(mesh.validate(), std::nullopt);
    EXPECT_EQ(mesh.tagged_faces(), input.tagged_faces());
    EXPECT_EQ(mesh.tagged_lines(), input.tagged_lines());
    OptimizeOptions keep = sliding();
    keep.boundary = BoundaryVertices::keep;
    ASSERT_TRUE(optimize(kept, keep));
    EXPECT_LT(quality(mesh).orthocenters_outside, quality(kept).orthocenters_outside);
    test::StdThreads threads(3);
    OptimizeHooks hooks;
    hooks.executor = &threads;
    ASSERT_TRUE(optimize(again, sliding(), hooks));
    EXPECT_EQ(again, mesh);
  }
}

TEST(TetMobility, TheFrontOfASlitStays) {
  // Points of z = 2 at x < 2 have a copy for the tetrahedra above, at a distance that keeps faces in one plane.
  test::TetArrays arrays = test::cubes(kSide, test::kSixTets);
  const std::size_t n = arrays.points.size();
  std::vector<std::int32_t> copy(n, -1);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 p = arrays.points[i];
    if (p.z != 2 || !(p.x < 2)) continue;
    copy[i] = static_cast<std::int32_t>(arrays.points.size());
    arrays.points.push_back(p + Vec3{0, 0, 1e-12});
  }
  arrays.weights.resize(arrays.points.size());
  for (auto& t : arrays.tetrahedra) {
    double z = 0;
    for (const std::int32_t v : t) z += arrays.points[std::size_t(v)].z / 4;
    for (std::int32_t& v : t) v = z > 2 && copy[std::size_t(v)] >= 0 ? copy[std::size_t(v)] : v;
  }
  OptimizeOptions options;
  options.boundary = BoundaryVertices::slide;
  const TetMesh mesh = test::mesh_of(arrays);
  const auto all = mobilities(mesh, options);
  std::size_t front = 0, sides = 0;
  for (const VertexId v : mesh.vertices()) {
    const Vec3 p = mesh.position(v);
    if (std::abs(p.z - 2) > 1e-9 || p.x == 0 || p.x > 2 || p.y == 0 || p.y == kSide) continue;
    EXPECT_EQ(all[v].dimensions, p.x == 2 ? 1 : 2) << p.x << ' ' << p.y;
    ++(p.x == 2 ? front : sides);
  }
  EXPECT_EQ(front, 3U);
  EXPECT_EQ(sides, 6U);
}

/// An error that is less the nearer all vertices are to a point inside, off the planes.
class Pull final : public DiscretizationError {
 public:
  [[nodiscard]] std::vector<double> errors(const TetMesh& mesh, std::vector<Gradient>* gradients,
                                           Executor* /*executor*/) const override {
    if (gradients != nullptr) gradients->assign(1, Gradient(mesh.n_vertices()));
    double sum = 1;
    for (const VertexId v : mesh.vertices()) {
      const Vec3 by = mesh.position(v) - Vec3{1.8, 2.1, 1.9};
      sum += squared_length(by);
      if (gradients != nullptr) gradients->front()[v] = {2 * by.x, 2 * by.y, 2 * by.z, 0};
    }
    return {sum};
  }
};

TEST(TetMobility, RepairsAndSweepsForErrorsSlideToo) {
  for (const Scheme scheme : {Scheme::all, Scheme::vertex}) {
    Block block(0.25);
    const TetMesh input = block.mesh();
    TetMesh mesh = input;
    OptimizeOptions options;
    options.boundary = BoundaryVertices::slide;
    options.scheme = scheme, options.tets.repair_trials = 2, options.tets.accuracy_steps = 2;
    OptimizeHooks hooks;
    hooks.solvers.error = std::make_shared<Pull>();
    const auto report = optimize(mesh, options, hooks);
    ASSERT_TRUE(report);
    const auto area = [](const TetMesh& of) {  // of the boundary planes
      std::array<double, 3> sums = {};
      for (const HalffaceId h : of.halffaces()) {
        if (!of.is_boundary(h)) continue;
        const auto [a, b, c] = of.vertices(h);
        const Vec3 n = cross(of.position(b) - of.position(a), of.position(c) - of.position(a));
        sums[0] += std::abs(n.x), sums[1] += std::abs(n.y), sums[2] += std::abs(n.z);
      }
      return sums;
    };
    for (const double a : area(mesh)) EXPECT_NEAR(a, 4 * kSide * kSide, 1e-12);
    EXPECT_NEAR(quality(mesh).volume, kSide * kSide * kSide, 1e-12);
    EXPECT_TRUE(meets(mesh, criterion_of(scheme)));
    std::size_t slid = 0;
    for (const VertexId v : mesh.vertices()) {
      const VertexId before = report->origins.vertices.empty() ? v : report->origins.vertices[v];
      if (!before.valid()) continue;
      const Vec3 by = mesh.position(v) - input.position(before);
      const auto [x, y, z] = Block::stays(block.exact()[before.index]);
      EXPECT_TRUE((!x || by.x == 0) && (!y || by.y == 0) && (!z || by.z == 0)) << before.index;
      slid += (x || y || z) && length(by) > 0.01;
    }
    EXPECT_GT(slid, 20U);
  }
}

}  // namespace
}  // namespace temper::tets
