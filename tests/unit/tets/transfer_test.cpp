// Overlaps of the cells of two meshes of tetrahedra: they fill every cell of both. Conserved data over many changes.
#include "temper/tets/transfer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "support/std_threads.hpp"
#include "support/tet_lattice.hpp"
#include "temper/tets/geometry.hpp"
#include "temper/tets/operators.hpp"
#include "temper/tets/optimize.hpp"
#include "tets/transfer/polyhedron.hpp"

namespace temper::test {
namespace {

using tets::CellsOf;
using tets::HalfSpace;
using tets::Polyhedron;
using tets::TetMesh;

/// Moves inner vertices that may move, as far as tetrahedra stay positive, and gives them other weights.
void disturb(TetMesh& mesh, Noise& noise, double most, double of_all, double weight = 0.02) {
  const auto on_boundary = tets::boundary_vertices(mesh);
  std::vector<std::vector<tets::TetId>> stars(mesh.n_vertices());
  std::vector<char> between(mesh.n_vertices(), 0);
  for (const tets::TetId t : mesh.tetrahedra()) {
    for (const VertexId v : mesh.corners(t)) {
      stars[v.index].push_back(t);
      if (mesh.region(t) != mesh.region(stars[v.index][0])) between[v.index] = 1;
    }
  }
  for (const VertexId v : mesh.vertices()) {
    if (on_boundary[v] != 0 || between[v.index] != 0 || (noise() + 1) / 2 > of_all) continue;
    const tets::WeightedPoint p = mesh.point(v);
    mesh.set_point(v, {p.x + most * noise(), p.y + most * noise(), p.z + most * noise(), weight * noise()});
    for (const tets::TetId t : stars[v.index]) {
      const auto [a, b, c, d] = mesh.points(t);
      if (tets::orientation(a.position(), b.position(), c.position(), d.position()) != Sign::positive)
        mesh.set_point(v, p);
    }
  }
}

TetMesh two_regions(TetMesh mesh) {
  for (const tets::TetId t : mesh.tetrahedra()) {
    double z = 0;
    for (const VertexId v : mesh.corners(t)) z += 0.25 * mesh.position(v).z;
    mesh.set_region(t, z < 2 ? 1 : 2);
  }
  return mesh;
}

struct TetMeshes {
  std::string name;
  TetMesh before, after;
};

std::vector<TetMeshes> all_meshes() {
  std::vector<TetMeshes> all;
  Noise noise(5);
  TetMesh mesh = mesh_of(body_centered(4));
  TetMesh moved = mesh;
  disturb(moved, noise, 0.3, 1);
  all.push_back({"moved", mesh, moved});
  TetMesh good = moved;
  EXPECT_TRUE(optimize(good));
  all.push_back({"optimized", moved, good});
  all.push_back({"regions", two_regions(mesh_of(cubes(4, kSixTets))), two_regions(mesh_of(cubes(4, kFiveTets)))});
  return all;
}

void expect_near(const std::vector<double>& found, const std::vector<double>& expected, const std::string& what) {
  ASSERT_EQ(found.size(), expected.size());
  double most = 0, largest = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    most = std::max(most, std::abs(found[i] - expected[i]));
    largest = std::max(largest, expected[i]);
  }
  EXPECT_LT(most, 3e-13 * largest) << what;
}

std::vector<double> sizes_of(const std::vector<CellPart>& parts, std::size_t n) {
  std::vector<double> sizes(n, 0.0);
  for (const CellPart& part : parts) sizes[part.cell] += part.size;
  return sizes;
}

TEST(TetPolyhedra, CutByAPlaneAreTwoPartsOfTheWhole) {
  Noise noise(3);
  for (int i = 0; i < 200; ++i) {
    const auto point = [&] { return Vec3{noise(), noise(), noise()}; };
    std::array<Vec3, 4> p = {point(), point(), point(), point()};
    if (tets::orientation(p[0], p[1], p[2], p[3]) != Sign::positive) std::swap(p[0], p[1]);
    Polyhedron body(p);
    EXPECT_NEAR(body.volume(), tets::six_volumes(p[0], p[1], p[2], p[3]) / 6, 1e-15);
    for (int cuts = 0; cuts < 6; ++cuts) {
      // Planes through corners and edges, too.
      const Vec3 at = cuts % 2 == 0 ? p[std::size_t(cuts / 2)] : 0.3 * point();
      const Vec3 normal = cuts == 2 ? cross(p[0] - p[1], point()) : point();
      Polyhedron one = body, other = body;
      one.cut({at, normal}), other.cut({at, -1 * normal});
      EXPECT_NEAR(one.volume() + other.volume(), body.volume(), 1e-14);
      EXPECT_GE(one.volume(), -1e-15);
      if (one.volume() > 1e-3) body = one;
    }
  }
}

TEST(TetOverlaps, FillAllCells) {
  for (const auto& [name, before, after] : all_meshes()) {
    for (const CellsOf of : {CellsOf::tetrahedra, CellsOf::vertices}) {
      const std::string what = name + (of == CellsOf::tetrahedra ? ", tetrahedra" : ", vertices");
      const CellOverlaps table = overlaps(before, after, of);
      const std::size_t m = of == CellsOf::tetrahedra ? before.n_tetrahedra() : before.n_vertices();
      std::vector<double> of_former(m, 0.0), of_now(table.n_cells, 0.0);
      for (std::size_t p = 0; p < table.parts.size(); ++p) {
        for (std::size_t s = table.starts[p]; s < table.starts[p + 1]; ++s) {
          of_former[table.shares[s].former] += table.shares[s].size;
          of_now[table.parts[p].cell] += table.shares[s].size;
        }
      }
      expect_near(of_now, sizes_of(table.parts, table.n_cells), what);
      expect_near(of_former, sizes_of(table.former, m), what);
    }
  }
}

TEST(TetOverlaps, AreOfDualCellsIfTheMeshIsGood) {
  const TetMesh good = all_meshes()[1].after;
  const CellOverlaps table = overlaps(good, good, CellsOf::vertices);
  expect_near(sizes_of(table.parts, good.n_vertices()), dec_operators(good).star0.raw(), "dual cells");
  for (std::size_t p = 0; p < table.parts.size(); ++p) {
    ASSERT_EQ(table.starts[p + 1] - table.starts[p], 1U);
    EXPECT_EQ(table.shares[table.starts[p]].former, table.parts[p].cell);
  }
}

TEST(TetOverlaps, AreOfDualCellsIfTheMeshIsRegularAndCellsReachIntoOtherTetrahedra) {
  Noise noise(11);
  int seen = 0;
  for (int i = 0; i < 200 && seen < 3; ++i) {
    TetMesh mesh = mesh_of(body_centered(3));
    disturb(mesh, noise, 0.35, 0.2, 0.05);
    const tets::DecComplex complex = dec_operators(mesh);
    const tets::DecSummary summary = summarize(complex);
    if (summary.negative_star2 + summary.negative_boundary_star2 > 0 || summary.not_well_centered == 0) continue;
    ++seen;
    const CellOverlaps table = overlaps(mesh, mesh, CellsOf::vertices);
    expect_near(sizes_of(table.parts, mesh.n_vertices()), complex.star0.raw(), "dual cells");
  }
  EXPECT_EQ(seen, 3);
}

TEST(TetOverlaps, AreTheSameForAnyNumberOfThreads) {
  const TetMeshes meshes = all_meshes()[0];
  StdThreads threads(3);
  const CellOverlaps one = overlaps(meshes.before, meshes.after, CellsOf::vertices),
                     several = overlaps(meshes.before, meshes.after, CellsOf::vertices, &threads);
  ASSERT_EQ(one.shares.size(), several.shares.size());
  for (std::size_t s = 0; s < one.shares.size(); ++s) EXPECT_EQ(one.shares[s].size, several.shares[s].size);
}

TEST(TetConserve, KeepsSumsAndBoundsOverAHundredSteps) {
  for (const CellsOf of : {CellsOf::tetrahedra, CellsOf::vertices}) {
    TetMesh mesh = two_regions(mesh_of(cubes(3, kFiveTets)));
    Noise noise(9);
    std::vector<double> values(of == CellsOf::tetrahedra ? mesh.n_tetrahedra() : mesh.n_vertices());
    for (double& value : values) value = 1 + noise();
    const auto [least, most] = std::ranges::minmax(values);
    std::map<std::int32_t, long double> first;
    double largest = 0;
    for (int step = 0; step < 100; ++step) {
      TetMesh next = mesh;
      disturb(next, noise, 0.1, 0.3);
      const CellOverlaps table = overlaps(mesh, next, of);
      const auto sums = [](const std::vector<CellPart>& parts, const std::vector<double>& u) {
        std::map<std::int32_t, long double> result;
        for (const CellPart& part : parts) result[part.region] += static_cast<long double>(part.size) * u[part.cell];
        return result;
      };
      if (step == 0) first = sums(table.former, values);
      Conserved result = conserve(table, values);
      for (const double v : result.values) ASSERT_TRUE(v >= least && v <= most) << step;
      values = std::move(result.values);
      mesh = std::move(next);
      for (const auto& [region, sum] : sums(table.parts, values))
        largest = std::max(largest, static_cast<double>(std::abs(sum - first[region]) / first[region]));
    }
    EXPECT_LT(largest, 1e-13);
    RecordProperty(of == CellsOf::tetrahedra ? "tetrahedra" : "vertices", std::to_string(largest));
  }
}

}  // namespace
}  // namespace temper::test
