// Overlaps of the cells of two meshes: they fill every new cell and every former cell.
#include <gtest/gtest.h>

#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "support/spheres.hpp"
#include "support/std_threads.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/transfer.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"

namespace temper::test {
namespace {

struct Meshes {
  std::string name;
  Mesh before, after;
};

Meshes optimized_of(std::string name, Mesh mesh, BoundaryVertices boundary = BoundaryVertices::keep) {
  Meshes meshes = {std::move(name), mesh, std::move(mesh)};
  OptimizeOptions options;
  options.boundary = boundary;
  options.max_sweeps = 5;
  EXPECT_TRUE(optimize(meshes.after, options));
  return meshes;
}

Mesh in_units_of(double unit, Mesh mesh) {
  for (const VertexId v : mesh.vertices()) mesh.set_position(v, unit * mesh.position(v));
  return mesh;
}

/// Meshes of every space, and others of the same domain.
std::vector<Meshes> all_meshes() {
  std::vector<Meshes> all;
  all.push_back(optimized_of("random", *random_mesh({.vertices = 200, .seed = 2})));
  all.push_back(optimized_of("regions", mesh_with_regions(300, 4)));
  all.push_back(optimized_of("split", *horseshoe(), BoundaryVertices::split));
  all.push_back(optimized_of("globe", globe(300, 5, 6371)));
  all.push_back(optimized_of("ocean", ocean(globe(500), 0.7)));
  all.push_back(optimized_of("periodic", *random_periodic({.vertices = 200})));
  all.push_back({"few triangles", *icosahedral({.level = 0}), *icosahedral({.level = 2})});
  all.push_back({"coarse to fine", in_units_of(8, *sheared_grid({.nx = 6, .ny = 6, .shear = 0.5})),
                 *sheared_grid({.nx = 48, .ny = 48, .shear = 0.5})});
  all.push_back({"fine to coarse", all.back().after, all.back().before});
  return all;
}

/// Sizes of cells by parts, over their number of cells.
std::vector<double> sizes_of(const std::vector<CellPart>& parts, std::size_t n) {
  std::vector<double> sizes(n, 0.0);
  for (const CellPart& part : parts) sizes[part.cell] += part.size;
  return sizes;
}

std::vector<double> areas_of(const Mesh& mesh, CellsOf of) {
  const DecComplex complex = dec_operators(mesh);
  return of == CellsOf::triangles ? complex.areas.raw() : power_cells(mesh, complex).areas.raw();
}

void expect_near(const std::vector<double>& found, const std::vector<double>& expected, const std::string& what) {
  ASSERT_EQ(found.size(), expected.size()) << what;
  double most = 0, largest = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    most = std::max(most, std::abs(found[i] - expected[i]));
    largest = std::max(largest, expected[i]);
  }
  EXPECT_LT(most, 3e-13 * largest) << what;
}

TEST(Overlaps, AreOfTheCellsThatUsersHaveAndFillThemAll) {
  for (const auto& [name, before, after] : all_meshes()) {
    for (const CellsOf of : {CellsOf::triangles, CellsOf::vertices}) {
      const std::string what = name + (of == CellsOf::triangles ? ", triangles" : ", vertices");
      const CellOverlaps table = overlaps(before, after, of);
      const std::size_t n = table.n_cells, m = of == CellsOf::triangles ? before.n_triangles() : before.n_vertices();
      expect_near(sizes_of(table.parts, n), areas_of(after, of), what + " now");
      expect_near(sizes_of(table.former, m), areas_of(before, of), what + " before");
      std::vector<double> of_former(m, 0.0), of_now(n, 0.0);
      for (std::size_t p = 0; p < table.parts.size(); ++p) {
        for (std::size_t s = table.starts[p]; s < table.starts[p + 1]; ++s) {
          of_former[table.shares[s].former] += table.shares[s].size;
          of_now[table.parts[p].cell] += table.shares[s].size;
        }
      }
      expect_near(of_now, areas_of(after, of), what + " filled");
      expect_near(of_former, areas_of(before, of), what + " used up");
    }
  }
}

TEST(Overlaps, OfOneMeshWithItselfAreItsCells) {
  for (const auto& [name, before, after] : all_meshes()) {
    for (const CellsOf of : {CellsOf::triangles, CellsOf::vertices}) {
      const CellOverlaps table = overlaps(after, after, of);
      for (std::size_t p = 0; p < table.parts.size(); ++p) {
        double all = 0, own = 0;
        for (std::size_t s = table.starts[p]; s < table.starts[p + 1]; ++s) {
          all += table.shares[s].size;
          own += table.shares[s].former == table.parts[p].cell ? table.shares[s].size : 0;
        }
        EXPECT_GT(own, 0) << name << " cell " << table.parts[p].cell;
        EXPECT_EQ(all, own) << name << " cell " << table.parts[p].cell;
      }
    }
  }
}

TEST(Overlaps, AreTheSameForAnyNumberOfThreads) {
  const Meshes meshes = optimized_of("random", *random_mesh({.vertices = 3000, .seed = 8}));
  StdThreads threads(3);
  const CellOverlaps one = overlaps(meshes.before, meshes.after, CellsOf::vertices),
                     several = overlaps(meshes.before, meshes.after, CellsOf::vertices, &threads);
  EXPECT_GT(threads.runs(), 0u);
  ASSERT_EQ(one.shares.size(), several.shares.size());
  for (std::size_t s = 0; s < one.shares.size(); ++s) {
    EXPECT_EQ(one.shares[s].former, several.shares[s].former);
    EXPECT_EQ(one.shares[s].size, several.shares[s].size);
  }
}

}  // namespace
}  // namespace temper::test
