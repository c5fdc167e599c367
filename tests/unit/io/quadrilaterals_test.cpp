// Quadrilaterals in files: two triangles each in a mesh, which stay, and quadrilaterals again in the next file.
//
//     6---7---8      The squares at the bottom are quadrilaterals, the ones at the top two triangles each. Point 4 and
//     | / | / |      the line 3-4-5 belong to both.
//     3---4---5
//     |   |   |
//     0---1---2
#include "io/conversion/quadrilaterals.hpp"

#include <gtest/gtest.h>

#include <set>

#include "support.hpp"
#include "temper/optimize.hpp"

namespace temper::io {
namespace {

using Tags = std::vector<std::int32_t>;

std::vector<std::string> formats_with_quadrilaterals() {
  std::vector<std::string> names = {"vtu", "vtk", "vtk51", "gmsh22", "gmsh41", "2dm", "adcirc", "mike"};
  if (!netcdf_version().empty()) names.emplace_back("ugrid");
  if (!hdf5_version().empty()) names.emplace_back("vtkhdf");
  return names;
}
std::string file_of(const std::string& format) {
  return format == "ugrid" ? "m.nc" : format == "adcirc" ? "m.gr3" : "m." + format;
}

class Quadrilaterals : public FileTest {
 protected:
  [[nodiscard]] MeshFile read_ok(const std::string& name) const {
    const auto f = read(path(name));
    EXPECT_TRUE(f) << f.error().what();
    return f ? *f : MeshFile();
  }
  /// SCHISM's grid of the drawing; the place of point 4 is given.
  MeshFile grid(const std::string& of_4 = "1.1 1") const {
    make("hgrid.gr3", "squares\n6 9\n1 0 0 1\n2 1 0 2\n3 2 0 3\n4 0 1 4\n5 " + of_4 +
                          " 5\n6 2 1 6\n7 0 2 7\n8 1 2.2 8\n9 2 2 9\n"
                          "1 4 1 2 5 4\n2 4 2 3 6 5\n3 3 4 5 8\n4 3 4 8 7\n5 3 5 6 9\n6 3 5 9 8\n");
    MeshFile f = read_ok("hgrid.gr3");
    f.points_in = PlanePoints();  // such small numbers look like degrees
    return f;
  }
};

/// The corners of each quadrilateral, in a cycle from the first one in order.
std::vector<std::array<std::int32_t, 4>> cycles(MeshFile f) {
  std::vector<std::array<std::int32_t, 4>> all;
  const auto fourth = join_quadrilaterals(f, quadrilaterals_of(f));
  for (std::size_t i = 0; i < fourth.size(); ++i) {
    const auto [a, b, c] = f.triangles[f.triangles.size() - fourth.size() + i];
    std::array cycle = {a, b, c, fourth[i]};
    std::ranges::rotate(cycle, std::ranges::min_element(cycle));
    all.push_back(cycle);
  }
  return all;
}
const std::vector<std::array<std::int32_t, 4>> kCycles = {{0, 1, 4, 3}, {1, 2, 5, 4}};

TEST_F(Quadrilaterals, AreInEveryFormatWhatTheyWere) {
  MeshFile f = grid("1 1");
  EXPECT_EQ(f.triangles.size(), 8u);
  EXPECT_EQ(cycles(f), kCycles);
  EXPECT_EQ(f.numbering->triangle(3), "triangle 2") << "the number of the element";
  EXPECT_EQ(f.numbering->triangle(4), "triangle 3");
  f.triangles.tags = {7, 7, 8, 8, 1, 2, 3, 4};
  f.triangles.data.push_back({"roughness", 1, std::vector<double>{5, 5, 6, 6, 1, 2, 3, 4}});
  const std::vector<double> of_faces = {1, 2, 3, 4, 5, 5, 6, 6};  // triangles come first
  for (const std::string& format : formats_with_quadrilaterals()) {
    for (const auto encoding : {Encoding::ascii, Encoding::base64, Encoding::appended}) {
      SCOPED_TRACE(format);
      ASSERT_TRUE(write(path(file_of(format)), f, {.format = format, .encoding = encoding}));
      const MeshFile again = read_ok(file_of(format));
      EXPECT_EQ(again.points.size(), 9u);
      EXPECT_EQ(cycles(again), kCycles);
      if (format == "adcirc" || format == "mike") continue;  // without regions
      auto regions = again.triangles.tags;
      std::ranges::sort(regions);
      EXPECT_EQ(regions, (Tags{1, 2, 3, 4, 7, 7, 8, 8}));
      for (const auto& a : again.triangles.data) {
        if (a.name != "roughness") continue;
        auto values = std::get<std::vector<double>>(a.values);
        std::ranges::sort(values);
        EXPECT_EQ(values, of_faces);
      }
      ASSERT_TRUE(write(path("again"), again, {.format = format, .encoding = encoding}));
      ASSERT_TRUE(read(path("again")));
      ASSERT_TRUE(write(path("third"), read_ok("again"), {.format = format, .encoding = encoding}));
      EXPECT_EQ(slurp(path("third")), slurp(path("again")));
    }
  }
}

TEST_F(Quadrilaterals, MayBeAlone) {
  make("hgrid.gr3", "two\n2 6\n1 0 0 1\n2 1 0 2\n3 2 0 3\n4 0 1 4\n5 1 1 5\n6 2 1 6\n1 4 1 2 5 4\n2 4 2 3 6 5\n");
  MeshFile f = read_ok("hgrid.gr3");
  f.points_in = PlanePoints();
  for (const std::string& format : formats_with_quadrilaterals()) {
    ASSERT_TRUE(write(path(file_of(format)), f, {.format = format, .encoding = Encoding::ascii}));
    EXPECT_EQ(cycles(read_ok(file_of(format))), kCycles) << format;
  }
}

TEST_F(Quadrilaterals, WithACornerTwiceAreTriangles) {
  for (const char* const corners : {"1 2 3 3", "1 1 2 3", "1 2 2 3", "1 2 3 1"}) {
    make("hgrid.gr3", "one\n2 4\n1 0 0 1\n2 9 0 2\n3 9 9 3\n4 0 9 4\n1 4 " + std::string(corners) + "\n2 3 1 3 4\n");
    const MeshFile f = read_ok("hgrid.gr3");
    ASSERT_EQ(f.triangles.size(), 2u) << corners;
    EXPECT_EQ(quadrilaterals_of(f).size(), 0u);
    const auto [a, b, c] = f.triangles[0];
    EXPECT_TRUE((std::set{a, b, c} == std::set{0, 1, 2})) << corners;
  }
}

TEST_F(Quadrilaterals, AreTwoTrianglesWhereAFormatHasNone) {
  const MeshFile f = grid();
  for (const char* name : {"m.obj", "m.off", "m.mesh", "m.ply", "m.node"}) {
    const auto warnings = write(path(name), f);
    ASSERT_TRUE(warnings) << warnings.error().what();
    EXPECT_TRUE(std::ranges::any_of(*warnings, [](const std::string& w) {
      return w.find(": 2 quadrilaterals are written as two triangles each, ") != std::string::npos;
    })) << name;
    EXPECT_EQ(read_ok(name).triangles.size(), 8u);
  }
}

TEST_F(Quadrilaterals, HaveFourCornersThatExist) {
  const auto error = [&](const std::string& cells) {
    make("m.vtk",
         "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0\n1 0 0\n"
         "1 1 0\n0 1 0\nCELLS 1 5\n4 " +
             cells + "\nCELL_TYPES 1\n9\n");
    const auto f = read(path("m.vtk"));
    return f ? std::to_string(f->triangles.size()) : plain(f.error().what());
  };
  EXPECT_EQ(error("0 1 2 3"), "2");
  for (const char* wrong : {"4", "-1", "-7"}) {
    EXPECT_NE(error(std::string("0 1 2 ") + wrong).find(std::string(" uses vertex ") + wrong), std::string::npos)
        << error(std::string("0 1 2 ") + wrong);
  }
}

// A vertex inside is free to move, quadrilaterals beside it are not. Rectangles are no fault, whose center is on the
// diagonal of the triangles.
TEST_F(Quadrilaterals, StayWhileTheMeshAroundThemIsOptimized) {
  std::string nodes, elements;
  constexpr int kN = 6;
  int n = 0;
  const auto number = [](int i, int j) { return std::to_string(1 + i + (kN + 1) * j); };
  for (int j = 0; j <= kN; ++j) {
    for (int i = 0; i <= kN; ++i) {
      const bool moved = i > 3 && i < kN && j > 0 && j < kN;
      nodes += number(i, j) + " " + std::to_string(i + (moved ? 0.3 * ((i * 5 + j * 3) % 3 - 1) : 0)) + " " +
               std::to_string(j + (moved ? 0.3 * ((i * 3 + j * 7) % 3 - 1) : 0)) + " 0\n";
    }
  }
  for (int j = 0; j < kN; ++j) {
    for (int i = 0; i < kN; ++i) {
      const std::string a = number(i, j), b = number(i + 1, j), c = number(i + 1, j + 1), d = number(i, j + 1);
      if (i < 3) {
        elements += std::to_string(++n) + " 4 " + a + " " + b + " " + c + " " + d + "\n";
      } else {
        elements += std::to_string(++n) + " 3 " + a + " " + b + " " + c + "\n";
        elements += std::to_string(++n) + " 3 " + a + " " + c + " " + d + "\n";
      }
    }
  }
  make("hgrid.gr3", "t\n" + std::to_string(n) + " " + std::to_string((kN + 1) * (kN + 1)) + "\n" + nodes + elements);
  MeshFile f = read_ok("hgrid.gr3");
  const auto before = cycles(f);
  ASSERT_EQ(before.size(), 18u);
  const MeshFile input = f;
  auto loaded = make_mesh(f);
  ASSERT_TRUE(loaded) << loaded.error().what();
  std::size_t halves = 0;
  for (const TriangleId t : loaded->mesh.triangles()) {
    halves += loaded->mesh.is_half(t);
    for (const VertexId v : loaded->mesh.corners(t)) EXPECT_TRUE(!loaded->mesh.is_half(t) || loaded->mesh.is_fixed(v));
  }
  EXPECT_EQ(halves, 36u);
  Mesh mesh = loaded->mesh;
  OptimizeOptions options;
  options.repair = Repair::vertices;
  options.boundary = BoundaryVertices::split;
  const auto report = optimize(mesh, options);
  ASSERT_TRUE(report) << report.error().what();
  update(f, *loaded, mesh, report->vertices);
  EXPECT_TRUE(f.weights.empty());
  EXPECT_FALSE(f.points == input.points);
  const auto places = [](const MeshFile& file) {
    std::vector<std::array<Vec2, 4>> all;
    for (const auto& cycle : cycles(file)) {
      auto& place = all.emplace_back();
      for (std::size_t k = 0; k < 4; ++k) place[k] = file.points[static_cast<std::size_t>(cycle[k])];
    }
    return all;
  };
  EXPECT_EQ(places(f), places(input)) << "bit for bit";
}

}  // namespace
}  // namespace temper::io
