// AVS UCD as LaGriT and other programs write it.
#include "support.hpp"

namespace temper::io {
namespace {

class Avs : public FileTest {
 protected:
  MeshFile read_ok(const std::string& content) const {
    auto f = read(make("m.inp", content));
    EXPECT_TRUE(f) << f.error().what();
    return f ? *f : MeshFile{};
  }
  std::string refused(const std::string& content) const {
    const auto f = read(make("m.inp", content));
    EXPECT_FALSE(f) << content;
    return f ? "" : plain(f.error().what());
  }
};

using Tags = std::vector<std::int32_t>;
const std::string kPoints = "10 0 0 0\n20 1 0 0\n30 0 1 0\n40 1 1 0\n";

TEST_F(Avs, FacesLinesAndPointsHaveTheirMaterialsAndData) {
  const MeshFile f = read_ok("# by hand\n4 4 3 2 0\n" + kPoints +
                             "7 1 quad 10 20 40 30\n8 5 line 10 20\n9 6 pt 40\n11 2 tri 10 20 40\n"
                             "2 1 2\nimt1, integer\nflow field, m/s\n10 3 0.5 1\n20 3 1.5 1\n30 4 2.5 1\n40 4 3.5 1\n"
                             "2 1 1\nitetclr, integer\nphi,\n7 1 0.1\n8 5 0.2\n9 6 0.3\n11 2 0.4\n");
  EXPECT_EQ(f.format, "avs");
  EXPECT_EQ(f.triangles.size(), 3u);
  EXPECT_EQ(f.triangles.tags, (Tags{1, 1, 2}));
  EXPECT_EQ(f.lines.tags, Tags{5});
  EXPECT_EQ(f.marked_points.tags, Tags{6});
  ASSERT_EQ(f.point_data.size(), 2u);
  EXPECT_EQ(f.point_data[0].name, "imt1");
  EXPECT_EQ(f.point_data[0].values, Values(Tags{3, 3, 4, 4}));
  EXPECT_EQ(f.point_data[1].name, "flow field");
  EXPECT_EQ(f.point_data[1].components, 2);
  ASSERT_GE(f.triangles.data.size(), 2u);
  EXPECT_EQ(f.triangles.data[1].values, Values(std::vector<double>{0.1, 0.1, 0.4}));
  EXPECT_EQ(f.numbering->triangle(2), "triangle 11");
}

TEST_F(Avs, TetrahedraHaveTaggedFaces) {
  const MeshFile f = read_ok("4 2 0 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n1 3 tet 1 2 4 3\n2 8 tri 1 2 3\n");
  EXPECT_EQ(f.tetrahedra[0], (std::array<std::int32_t, 4>{0, 1, 2, 3})) << "in the order of VTK";
  EXPECT_EQ(f.tetrahedra.tags, Tags{3});
  EXPECT_EQ(f.triangles.tags, Tags{8});
  EXPECT_EQ(f.dimension(), 3);
}

TEST_F(Avs, WhatIsWrongIsNamedWithItsLine) {
  const std::string head = "4 1 0 0 0\n" + kPoints;
  EXPECT_EQ(refused(head + "1 1 hex 10 20 30 40 10 20 30 40\n"),
            "m.inp:6: element 1 is a hexahedron; temper reads linear triangles, quadrilaterals and tetrahedra, with "
            "lines and points as tags. Next: split it into tetrahedra, as triangulate() of PyVista does");
  EXPECT_EQ(refused(head + "1 1 blob 10\n"), "m.inp:6: cell 1 is of kind 'blob'; expected pt, line, tri, quad or tet");
  EXPECT_EQ(refused(head + "1 1 tri 10 20 3\n"),
            "m.inp:6: cell 1 uses point 3, but the file has 4 points and not this one");
  EXPECT_EQ(refused("4 1 0 0 0\n10 0 0 0\n10 1 0 0\n30 0 1 0\n40 1 1 0\n1 1 tri 10 20 30\n"),
            "m.inp: has point 10 twice");
  EXPECT_EQ(refused("4 1 1 0 0\n" + kPoints + "1 1 tri 10 20 30\n1 1\na, real\n10 1\n30 2\n20 3\n40 1\n"),
            "m.inp:10: expected the data of point 20, found 30");
  EXPECT_EQ(refused("4 1 1 0 0\n" + kPoints + "1 1 tri 10 20 30\n1 0\na, real\n"),
            "m.inp:7: expected at least one component");
  EXPECT_EQ(refused("4 1 1 0 0\n" + kPoints + "1 1 tri 10 20 30\n1 1\na, real\n10 1\n20 2\n"),
            "m.inp:9: announces 4 rows of data of a point, but only 10 bytes follow");
}

}  // namespace
}  // namespace temper::io
