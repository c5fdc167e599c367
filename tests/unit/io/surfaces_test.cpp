// Files of curved surfaces: round trips through every format that holds them, STL, data that follow, and bad files.
#include <random>

#include "support.hpp"
#include "support/surface_meshes.hpp"

namespace temper::io {
namespace {

using test::places_of;

/// A torus with a bit of everything.
MeshFile surface_sample() {
  const test::SurfaceArrays torus = test::torus(12, 8);
  MeshFile file;
  file.triangles.corners = torus.triangles;
  EXPECT_TRUE(set_points(file, torus.points));
  EXPECT_TRUE(file.is_surface());
  for (std::size_t t = 0; t < file.triangles.size(); ++t) file.triangles.tags.push_back(t < 20 ? 7 : 1);
  file.lines.add({torus.triangles[0][0], torus.triangles[0][1]}, 3);
  file.marked_points.add(torus.triangles[40][2], 5);
  for (std::size_t p = 0; p < file.points.size(); ++p) file.weights.push_back(0.01 * static_cast<double>(p % 7) - 0.02);
  file.names = {{1, 3, "seam"}, {2, 7, "patch"}};
  return file;
}

std::vector<std::string> surface_formats() {
  std::vector<std::string> names;
  for (const Format& format : formats()) {
    if (format.writes && format.holds_surfaces && (!needs_hdf5(format) || !hdf5_version().empty()))
      names.emplace_back(format.name);
  }
  return names;
}

class FilesOfSurfaces : public FileTest {
 protected:
  MeshFile through(const MeshFile& file, const std::string& format, Encoding encoding = Encoding::ascii) {
    const auto written = write(path("m.mesh"), file, {.format = format, .encoding = encoding});
    EXPECT_TRUE(written) << written.error().what();
    auto back = read(path("m.mesh"));
    EXPECT_TRUE(back && back->is_surface()) << format;
    return back ? *std::move(back) : MeshFile();
  }
  std::string error_of(const std::string& name, std::string_view content) {
    const auto file = read(make(name, content));
    if (!file) return plain(file.error().what());
    const auto made = make_surface(*file);
    return made ? std::string() : plain(made.error().what());
  }
};

TEST_F(FilesOfSurfaces, ComeBackFromEveryFormat) {
  const MeshFile sample = surface_sample();
  ASSERT_GE(surface_formats().size(), 10U);
  for (const std::string& format : surface_formats()) {
    for (const Encoding encoding : {Encoding::ascii, Encoding::base64, Encoding::appended}) {
      SCOPED_TRACE(format);
      const MeshFile back = through(sample, format, encoding);
      EXPECT_EQ(places_of(back), places_of(sample));
      EXPECT_EQ(back.weights, sample.weights);
      EXPECT_EQ(back.triangles.corners, sample.triangles.corners);
      if (format == "off") continue;  // which has no tags
      EXPECT_EQ(back.triangles.tags, sample.triangles.tags);
      EXPECT_EQ(back.lines.corners, sample.lines.corners);
      EXPECT_EQ(back.lines.tags, sample.lines.tags);
      EXPECT_EQ(back.marked_points.corners, sample.marked_points.corners);
    }
  }
}

TEST_F(FilesOfSurfaces, WhatWasReadIsWrittenAgainByteForByte) {
  for (const std::string& format : surface_formats()) {
    SCOPED_TRACE(format);
    const MeshFile once = through(through(surface_sample(), format), format);
    const std::string before = slurp(path("m.mesh"));
    static_cast<void>(through(once, format));
    EXPECT_EQ(slurp(path("m.mesh")), before);
  }
}

TEST_F(FilesOfSurfaces, FormatsWithoutAPlaceRefuseThem) {
  const MeshFile sample = surface_sample();
  for (const Format& format : formats()) {
    if (!format.writes || format.holds_surfaces || needs_netcdf(format)) continue;
    const auto written = write(path("x.y"), sample, {std::string(format.name), {}});
    ASSERT_FALSE(written) << format.name;
    EXPECT_EQ(written.error().code, ErrorCode::unsupported);
    EXPECT_NE(written.error().what().find("expected one of vtu, gmsh41"), std::string::npos) << written.error().what();
  }
}

TEST_F(FilesOfSurfaces, LinesAndMarksConstrainTheMesh) {
  const MeshFile file = surface_sample();
  const auto loaded = make_surface(file, std::vector<std::string>{"patch"});
  ASSERT_TRUE(loaded) << loaded.error().what();
  const Mesh& mesh = loaded->mesh.connectivity();
  const auto [a, b] = file.lines[0];
  const auto id = [](std::int32_t p) { return VertexId(static_cast<std::size_t>(p)); };
  const HalfedgeId h =
      mesh.find_halfedge(id(a), id(b)).valid() ? mesh.find_halfedge(id(a), id(b)) : mesh.find_halfedge(id(b), id(a));
  EXPECT_TRUE(mesh.is_constrained(h));
  EXPECT_TRUE(mesh.is_fixed(id(file.marked_points[0])));
  for (const std::int32_t p : file.triangles[3]) EXPECT_TRUE(mesh.is_fixed(id(p))) << "of the fixed region";
  const auto refused = make_mesh(file);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::not_planar);
}

TEST_F(FilesOfSurfaces, PointsWhereTagsOfLinesEndOrChangeAreFixed) {
  MeshFile file = surface_sample();
  file.lines = {};
  file.marked_points = {};
  const auto ring = [](std::int32_t i) { return 8 * i + 5; };  // far from the other region
  for (const auto& [from, tag] : std::vector<std::array<std::int32_t, 2>>{{6, 1}, {7, 1}, {8, 2}, {9, 2}})
    file.lines.add({ring(from), ring(from + 1)}, tag);
  const auto loaded = make_surface(file);
  ASSERT_TRUE(loaded) << loaded.error().what();
  for (std::int32_t i = 0; i < 12; ++i) {
    const VertexId v(static_cast<std::size_t>(ring(i)));
    EXPECT_EQ(loaded->mesh.connectivity().is_fixed(v), i == 6 || i == 8 || i == 10) << i;
  }
}

TEST_F(FilesOfSurfaces, TextAndBinaryStlGiveTheSameMesh) {
  const test::SurfaceArrays torus = test::torus(9, 7);
  std::string text = "solid thing\n", binary(80, 'x');
  const auto put = [&binary](const auto& value) {
    binary.append(reinterpret_cast<const char*>(&value), sizeof value);  // this machine has little ends first
  };
  put(static_cast<std::uint32_t>(torus.triangles.size()));
  for (const auto& triangle : torus.triangles) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (int k = 0; k < 3; ++k) put(0.0F);
    for (const std::int32_t p : triangle) {
      const Vec3 at = torus.points[static_cast<std::size_t>(p)];
      std::ostringstream line;
      line.precision(9);
      line << "   vertex " << static_cast<float>(at.x) << ' ' << static_cast<float>(at.y) << ' '
           << static_cast<float>(at.z) << "\n";
      text += line.str();
      put(static_cast<float>(at.x)), put(static_cast<float>(at.y)), put(static_cast<float>(at.z));
    }
    text += "  endloop\n endfacet\n";
    put(std::uint16_t{0});
  }
  text += "endsolid thing\n";
  const auto one = read(make("one.stl", text)), other = read(make("other.stl", binary));
  ASSERT_TRUE(one) << one.error().what();
  ASSERT_TRUE(other) << other.error().what();
  EXPECT_EQ(one->format, "stl");
  EXPECT_EQ(one->points.size(), torus.points.size());
  EXPECT_EQ(one->triangles.corners, other->triangles.corners);
  const std::vector<Vec3> a = places_of(*one), b = places_of(*other);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT(length(a[i] - b[i]), 1e-7);
  const auto mesh = make_surface(*one);
  ASSERT_TRUE(mesh) << mesh.error().what();
  EXPECT_EQ(mesh->mesh.n_triangles(), torus.triangles.size());
  EXPECT_FALSE(write(path("out.stl"), *one)) << "STL is only read";
  const auto expected = [&](const std::string& found) {
    return "cut.stl: expected 6384 bytes for the 126 triangles of binary STL, found " + found;
  };
  EXPECT_EQ(error_of("cut.stl", binary.substr(0, 1000)), expected("the end of the file after 1000, in triangle 19"));
  EXPECT_EQ(error_of("cut.stl", binary + "xy"), expected("6386"));
  EXPECT_EQ(error_of("cut.stl", binary.substr(0, 50)),
            "cut.stl: expected the 84 bytes with which binary STL begins, found 50");
  EXPECT_EQ(error_of("cut.stl", "solid thing\n"), "cut.stl: expected 'facet' or 'endsolid' in the line after 'solid'");
  EXPECT_EQ(error_of("cut.stl", text.substr(0, 2000)).substr(0, 11), "cut.stl:82:");
  EXPECT_EQ(error_of("cut.bin", binary.substr(0, 1000)).substr(0, 35), "cut.bin: is none of the formats tha");
  EXPECT_EQ(error_of("none.stl", std::string(84, '\0')), "none.stl: binary STL of 0 triangles, expected at least one");
  EXPECT_EQ(error_of("cut.stl", "solid " + std::string(73, 'x') + "\xc3\xa4\xf6\xfc\n facit").substr(0, 34),
            "cut.stl: expected 'facet' or 'ends")
      << "letters of a title can be of any alphabet";
  std::string many = binary;
  many.replace(0, 5, "solid").replace(80, 4, "\xff\xff\xff\xff");
  EXPECT_EQ(
      error_of("many.stl", many),
      "many.stl: expected 214748364834 bytes for the 4294967295 triangles of binary STL, found the end of the file "
      "after 6384, in triangle 127");
  std::string upper = text, nan = binary;
  for (char& c : upper) c = static_cast<char>(std::toupper(c));
  const auto loud = read(make("loud.stl", upper));
  ASSERT_TRUE(loud) << loud.error().what();
  EXPECT_EQ(loud->triangles.corners, one->triangles.corners);
  const float not_a_number = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(nan.data() + 84 + 50 * 4 + 12 + 8, &not_a_number, 4);
  const std::string found = error_of("nan.stl", nan);
  EXPECT_EQ(found.substr(0, 47), "nan.stl: triangle 5: a corner has coordinates (");
  EXPECT_NE(found.find(", nan), expected finite numbers"), std::string::npos) << found;
}

TEST_F(FilesOfSurfaces, BadFilesAreNamed) {
  const std::string begin = "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
  EXPECT_EQ(error_of("m.stl", begin + "vertex 0 1\nendloop\nendfacet\nendsolid\n"),
            "m.stl:7: expected the z coordinate of a vertex, found 'endloop'");
  EXPECT_EQ(error_of("m.stl", begin + "endloop\n"), "m.stl:6: expected 'vertex', found 'endloop'");
  EXPECT_EQ(error_of("m.stl", begin), "m.stl:6: the file ends where vertex was expected");
  EXPECT_EQ(error_of("m.stl", begin + "vertex 0 1 inf\nendloop\nendfacet\nendsolid\n"),
            "m.stl:6: a corner has coordinates (0, 1, inf), expected finite numbers. Next: give its place");
  EXPECT_EQ(
      error_of("m.stl", begin + "vertex 0 1 0\nendloop\nendfacet\nfacet normal 0 0 1\nouter loop\nvertex 0 1 0\n" +
                            "vertex 1 0 0\nvertex 1 1 1e70\nendloop\nendfacet\nendsolid\n")
          .substr(0, 34),
      "m.stl:13: point 4 has coordinates ");
  EXPECT_EQ(error_of("m.obj", "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n"),
            "m.obj:2: point 2 has z = nan, expected a finite number. Next: give its place");
  EXPECT_EQ(error_of("m.obj", "v 0 0 0\nv nan 0 1\nv 0 1 0\nf 1 2 3\n"),
            "m.obj:2: point 2 has coordinates (nan, 0, 1), expected finite numbers. Next: give its place");
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 1.5\n";
  EXPECT_EQ(error_of("m.obj", points + "f 1 2 3\nf 2 1 4\nf 1 2 5\n"),
            "m.obj:8: the edge from point 1 to point 2 belongs to 3 triangles (triangle 1 and triangle 3 among them); "
            "expected at most 2. Next: give a sheet of the surface its own copies of the two points");
  EXPECT_EQ(error_of("m.obj", points + "f 1 2 3\nf 1 4 5\n"),
            "m.obj:1: the surface touches itself at point 1: its triangles are not one fan around it. Next: give each "
            "fan its own copy of the point");
  EXPECT_EQ(error_of("m.obj", points + "f 1 2 3\nf 2 1 9\n"),
            "m.obj:7: triangle 2 uses vertex 9, but the file has 5 vertices, numbered from 1");
  EXPECT_EQ(error_of("m.obj", points + "f 1 2 3\nf 1 5 1\nf 1 4 5\n").substr(0, 34),
            "m.obj:7: triangle 2 has zero area:");
}

TEST_F(FilesOfSurfaces, TextMayBeginWithAMarkAndEndItsLinesInOtherWays) {
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nf 1 2 3\nf 2 4 3\n";
  const std::string stl =
      "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 1\nendloop\nendfacet\n"
      "facet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 1\nendloop\nendfacet\nendsolid s\n";
  for (const std::string& text : {obj, stl}) {
    const std::string name = text == obj ? "m.obj" : "m.stl";
    const auto usual = read(make(name, text));
    ASSERT_TRUE(usual) << usual.error().what();
    std::string returns = text, both;
    std::replace(returns.begin(), returns.end(), '\n', '\r');
    for (const char c : text) both += c == '\n' ? "\r\n" : std::string(1, c);
    for (const std::string& other : {returns, both, "\xEF\xBB\xBF" + text, "\xEF\xBB\xBF" + returns}) {
      const auto found = read(make(name, other));
      ASSERT_TRUE(found) << found.error().what();
      EXPECT_EQ(found->points, usual->points);
      EXPECT_EQ(found->triangles.corners, usual->triangles.corners);
    }
  }
}

TEST_F(FilesOfSurfaces, DataFollowTheSurface) {
  MeshFile file = surface_sample();
  std::vector<double> heights, regions;
  for (std::size_t p = 0; p < file.points.size(); ++p) heights.push_back(file.place(p).z);
  for (std::size_t t = 0; t < file.triangles.size(); ++t) regions.push_back(static_cast<double>(t));
  file.point_data = {{"height", 1, heights}};
  file.triangles.data = {{"number", 1, regions}};
  const auto loaded = make_surface(file);
  ASSERT_TRUE(loaded) << loaded.error().what();
  surfaces::SurfaceMesh mesh = loaded->mesh;
  MeshFile same = file;
  update(same, *loaded, mesh);
  EXPECT_EQ(same.point_data[0].values, file.point_data[0].values);
  EXPECT_EQ(places_of(same), places_of(file));
  // A vertex goes to the middle of an edge.
  const Mesh& connectivity = mesh.connectivity();
  const HalfedgeId h = connectivity.outgoing(VertexId(10));
  const Vec3 middle = 0.5 * (mesh.position(connectivity.origin(h)) + mesh.position(connectivity.target(h)));
  mesh.set_position(VertexId(10), middle);
  const DataReport report = update(file, *loaded, mesh);
  EXPECT_EQ(report.points_moved, 1U);
  EXPECT_EQ(report.interpolated, std::vector<std::string>{"height"});
  const auto& after = std::get<std::vector<double>>(file.point_data[0].values);
  EXPECT_NEAR(after[10], middle.z, 1e-14);
  for (std::size_t p = 0; p < heights.size(); ++p) EXPECT_TRUE(p == 10 || after[p] == heights[p]);
  EXPECT_EQ(file.place(10), middle);
}

TEST_F(FilesOfSurfaces, QuadrilateralsAreCut) {
  const auto file = read(make("m.vtk",
                              "# vtk DataFile Version 2.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 double\n"
                              "0 0 0 1 0 0 1 1 0 0 1 0 1 0 1 1 1 1\nCELLS 2 10\n4 0 1 2 3\n4 1 4 5 2\n"
                              "CELL_TYPES 2\n9\n9\n"));
  ASSERT_TRUE(file) << file.error().what();
  EXPECT_TRUE(file->is_surface());
  EXPECT_EQ(file->triangles.size(), 4U);
  EXPECT_TRUE(file->triangles.data.empty());
  ASSERT_EQ(file->warnings.size(), 1U);
  EXPECT_EQ(file->warnings[0], "2 quadrilaterals of a curved surface are cut into two triangles each");
  EXPECT_TRUE(make_surface(*file));
}

}  // namespace
}  // namespace temper::io
