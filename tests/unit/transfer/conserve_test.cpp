// Data over changes of a mesh: integrals stay, values stay between their bounds, and what has not changed stays.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "support/spheres.hpp"
#include "temper/detail/transfer.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"

namespace temper::test {
namespace {

std::map<std::int32_t, long double> sums_of(const std::vector<CellPart>& parts, const std::vector<double>& values) {
  std::map<std::int32_t, long double> sums;
  for (const CellPart& part : parts) sums[part.region] += static_cast<long double>(part.size) * values[part.cell];
  return sums;
}

/// Moves the inner vertices of a mesh that may move by some of the distance to their nearest neighbor, as far as
/// triangles stay counter-clockwise; then optimizes it.
Mesh disturbed(Mesh mesh, Noise& noise, double share, double of_all = 1) {
  for (const VertexId v : mesh.vertices()) {
    bool may_move = !mesh.is_boundary(v) && (noise() + 1) / 2 < of_all;
    double nearest = std::numeric_limits<double>::infinity();
    for (const HalfedgeId h : mesh.star(v)) {
      may_move = may_move && !mesh.is_constrained(h);
      nearest = std::min(nearest, distance(mesh.space(), mesh.point(v), mesh.point(mesh.target(h), mesh.point(v))));
    }
    if (!may_move) continue;
    const double step = share * nearest;
    const WeightedPoint p = mesh.point(v);
    if (mesh.space().is_plane())
      mesh.set_point(v, mesh.space().in_domain({p.x + step * noise(), p.y + step * noise(), p.w}));
    else
      mesh.set_point(v, mesh.space().vertex_at(mesh.space().radius() / length(as_vector(p)) * as_vector(p) +
                                                   Vec3{step * noise(), step * noise(), step * noise()},
                                               0));
    bool good = true;
    for (const HalfedgeId h : mesh.star(v)) {
      const auto [a, b, c] = mesh.points(Mesh::triangle(h));
      good = good && orientation(mesh.space(), a, b, c) == Sign::positive;
    }
    if (!good) mesh.set_point(v, p);
  }
  OptimizeOptions options;
  options.max_sweeps = 2;
  EXPECT_TRUE(optimize(mesh, options));
  return mesh;
}

/// A bell with a top of 1 on a ground of 0, around a point of the space.
std::vector<double> bell(const Mesh& mesh, CellsOf of, Vec3 top, double width) {
  std::vector<double> values;
  const auto add = [&](Vec3 p) { values.push_back(std::exp(-squared_length(p - top) / (width * width))); };
  if (of == CellsOf::vertices) {
    for (const VertexId v : mesh.vertices()) add(mesh.space().place(mesh.point(v)));
    return values;
  }
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.points(t);
    add((1.0 / 3) * (mesh.space().place(a) + mesh.space().place(b) + mesh.space().place(c)));
  }
  return values;
}

struct Start {
  std::string name;
  Mesh mesh;
  Vec3 top;
  double width;
};

std::vector<Start> starts() {
  std::vector<Start> all;
  all.push_back({"plane", *random_mesh({.vertices = 300, .seed = 2}), {2, 2, 0}, 1});
  all.push_back({"regions", mesh_with_regions(400, 4), {2, 2, 0}, 1});
  all.push_back({"globe", globe(300, 5), {0, 0, 1}, 0.5});
  all.push_back({"periodic", *random_periodic({.vertices = 200}), {0.5, 0.5, 0}, 0.3});
  return all;
}

TEST(Conserve, KeepsSumsAndBoundsOverAHundredSteps) {
  for (const Start& start : starts()) {
    for (const CellsOf of : {CellsOf::triangles, CellsOf::vertices}) {
      const std::string what = start.name + (of == CellsOf::triangles ? ", triangles" : ", vertices");
      Mesh mesh = start.mesh;
      Noise noise(7);
      std::vector<double> values = bell(mesh, of, start.top, start.width);
      const auto [least, most] = std::ranges::minmax(values);
      std::map<std::int32_t, long double> first;
      constexpr int kSteps = 100;
      double largest = 0;
      for (int step = 0; step < kSteps; ++step) {
        const Mesh next = disturbed(mesh, noise, 0.3, 0.05);
        const CellOverlaps table = overlaps(mesh, next, of);
        if (step == 0) first = sums_of(table.former, values);
        Conserved result = conserve(table, values);
        EXPECT_EQ(result.beyond, 0);
        for (const double v : result.values) ASSERT_TRUE(v >= least && v <= most) << what << " step " << step;
        values = std::move(result.values);
        mesh = next;
        largest = std::max(largest, result.change);
        for (const auto& [region, sum] : sums_of(table.parts, values))
          largest = std::max(largest, static_cast<double>(std::abs(sum - first[region]) / first[region]));
      }
      EXPECT_LT(largest, 1e-13) << what;
      RecordProperty(what, std::to_string(largest));
    }
  }
}

TEST(Conserve, LeavesCellsThatHaveNotChangedBitForBit) {
  for (const Start& start : starts()) {
    for (const CellsOf of : {CellsOf::triangles, CellsOf::vertices}) {
      Mesh mesh = start.mesh;
      ASSERT_TRUE(optimize(mesh, {}));
      const std::vector<double> values = bell(mesh, of, start.top, start.width);
      EXPECT_EQ(conserve(overlaps(mesh, mesh, of), values).values, values) << start.name;
      VertexId v(0);
      while (mesh.is_boundary(v) || mesh.is_fixed(v)) v = VertexId(v.index + 1);
      Mesh next = mesh;
      next.set_weight(v, next.weight(v) + 1e-3 * start.width * start.width);
      const std::vector<double> after = conserve(overlaps(mesh, next, of), values).values;
      std::size_t changed = 0;
      for (std::size_t i = 0; i < values.size(); ++i) changed += after[i] == values[i] ? 0 : 1;
      EXPECT_LE(changed, of == CellsOf::triangles ? 0u : 30u) << start.name << ": the star of one vertex";
    }
  }
}

TEST(Conserve, TakesNothingFromAnotherRegionEvenIfTheBorderMoves) {
  Mesh mesh = *sheared_grid({.nx = 6, .ny = 6, .shear = 0});
  for (const TriangleId t : mesh.triangles()) {
    double y = 0;
    for (const VertexId v : mesh.corners(t)) y += mesh.position(v).y / 3;
    mesh.set_region(t, y < 3 ? 0 : 1);
  }
  Mesh next = mesh;
  for (const VertexId v : mesh.vertices()) {
    const Vec2 p = mesh.position(v);
    if (p.y == 3 && !mesh.is_boundary(v)) next.set_position(v, p + Vec2{0, 0.125});
  }
  std::vector<double> values;
  for (const TriangleId t : mesh.triangles()) values.push_back(mesh.region(t) == 0 ? 0 : 1);
  const CellOverlaps table = overlaps(mesh, next, CellsOf::triangles);
  for (std::size_t p = 0; p < table.parts.size(); ++p) {
    for (std::size_t s = table.starts[p]; s < table.starts[p + 1]; ++s)
      EXPECT_EQ(mesh.region(TriangleId(table.shares[s].former)), table.parts[p].region);
  }
  const Conserved result = conserve(table, values);
  for (const TriangleId t : mesh.triangles()) {
    if (mesh.region(t) == 0) {
      EXPECT_EQ(result.values[t.index], 0);
    } else {
      EXPECT_NEAR(result.values[t.index], 1, 0.5);
    }
  }
  EXPECT_LT(result.change, 1e-15) << "all integrals stay";
  EXPECT_GT(result.beyond, 1e-3) << "of regions whose size has changed";
}

TEST(Conserve, KeepsAConstant) {
  for (const Start& start : starts()) {
    Noise noise(3);
    const Mesh next = disturbed(start.mesh, noise, 0.4);
    for (const CellsOf of : {CellsOf::triangles, CellsOf::vertices}) {
      const std::vector<double> values(bell(start.mesh, of, start.top, start.width).size(), 0.1);
      const Conserved result = conserve(overlaps(start.mesh, next, of), values);
      for (const double v : result.values) EXPECT_EQ(v, 0.1) << start.name;
    }
  }
}

}  // namespace
}  // namespace temper::test
