// Files whose points are on a sphere: in three coordinates, and in degrees.
#include "libraries.hpp"
#include "temper/generate.hpp"
#include "unit/io/support.hpp"

namespace temper::io {
namespace {

class SphereFiles : public FileTest {};

MeshFile globe(double radius = 6371220) {
  const auto mesh = icosahedral({.level = 2, .radius = radius});
  EXPECT_TRUE(mesh) << mesh.error().what();
  return from_mesh(*mesh);
}

MeshFile read_back(const std::string& path) {
  auto file = read(path);
  EXPECT_TRUE(file) << file.error().what();
  return *std::move(file);
}

TEST_F(SphereFiles, EveryFormatHasTheirPlacesOrSaysThatItCannot) {
  MeshFile file = globe();
  file.weights.assign(file.points.size(), 0);
  int in_space = 0, in_degrees = 0, refused = 0;
  for (const Format& format : formats()) {
    if (!format.writes) continue;
    SCOPED_TRACE(format.name);
    const std::string to =
        path(std::string("globe") + std::string(format.suffixes.substr(0, format.suffixes.find(' '))));
    const auto written = write(to, file, {std::string(format.name), {}});
    EXPECT_EQ(static_cast<bool>(written), format.holds_spheres);
    if (!written) {
      EXPECT_NE(written.error().what().find("points are on a sphere, which "), std::string::npos)
          << written.error().what();
      EXPECT_TRUE(files().empty());
      ++refused;
      continue;
    }
    MeshFile back = read_back(to);
    EXPECT_EQ(back.triangles.corners, file.triangles.corners);
    if (format.name == "ugrid") {
      ++in_degrees;
      EXPECT_TRUE(back.degrees() != nullptr);
      EXPECT_EQ(back.points, file.points);
      ASSERT_EQ(written->size(), 1U);
      EXPECT_NE((*written)[0].find("--projection sphere:radius=6371220"), std::string::npos) << (*written)[0];
      ASSERT_TRUE(project(back, "sphere:radius=6371220"));
    } else if (format.name == "adcirc") {
      ++in_degrees;
      EXPECT_EQ(back.points, file.points);
      ASSERT_TRUE(project(back, "sphere"));
    } else if (format.name == "fesom") {
      ++in_degrees;
      EXPECT_EQ(back.points, file.points);
      EXPECT_EQ(back.space().radius(), 6371000);
    } else {
      ++in_space;
      EXPECT_EQ(back.sphere()->places, file.sphere()->places);
      EXPECT_EQ(back.space().radius(), 6371220);
    }
    const auto made = make_mesh(back);
    ASSERT_TRUE(made) << made.error().what();
    EXPECT_FALSE(made->mesh.validate());
    EXPECT_EQ(made->mesh.space().radius(), back.space().radius());
    for (const std::string& name : files()) std::filesystem::remove(path(name));
  }
  EXPECT_GE(in_space, 10 + expects_netcdf() + expects_hdf5());
  EXPECT_EQ(in_degrees, expects_netcdf() ? 3 : 2);
  EXPECT_GE(refused, 2);  // Triangle, 2DM
}

TEST_F(SphereFiles, AMeshWithoutWeightsComesBackBitForBit) {
  const auto mesh = random_sphere({.vertices = 300, .radius = 6371220});
  ASSERT_TRUE(mesh) << mesh.error().what();
  ASSERT_TRUE(write(path("globe.vtu"), from_mesh(*mesh)));
  const auto made = make_mesh(read_back(path("globe.vtu")));
  ASSERT_TRUE(made) << made.error().what();
  EXPECT_EQ(made->mesh, *mesh);
}

TEST_F(SphereFiles, AnotherRadiusScalesWeightsAlong) {
  MeshFile file = globe(1);
  const double from = file.space().radius();
  file.weights.resize(file.points.size());
  for (std::size_t i = 0; i < file.points.size(); ++i) file.weights[i] = 1e-3 * static_cast<double>(i % 5);
  MeshFile larger = file;
  ASSERT_TRUE(project(larger, "sphere:radius=4"));
  EXPECT_EQ(larger.space().radius(), 4);
  for (std::size_t i = 0; i < file.points.size(); ++i) {
    EXPECT_DOUBLE_EQ(larger.weights[i], file.weights[i] * (4 / from) * (4 / from));
  }
  const auto warnings = write(path("globe.nod2d.out"), file);
  ASSERT_TRUE(warnings) << warnings.error().what();
  EXPECT_NE(warnings->front().find("the radius is 6371000 in FESOM nod2d.out and elem2d.out, not 1;"),
            std::string::npos)
      << warnings->front();
  const MeshFile back = read_back(path("globe.nod2d.out"));
  for (std::size_t i = 0; i < file.points.size(); ++i) {
    EXPECT_NEAR(back.weights[i], file.weights[i] * (6371000 / from) * (6371000 / from), 1e-15);
  }
}

TEST_F(SphereFiles, WeightsComeBack) {
  MeshFile file = globe(1);
  file.weights.resize(file.points.size());
  for (std::size_t i = 0; i < file.points.size(); ++i) file.weights[i] = 1e-3 * static_cast<double>(i % 5);
  ASSERT_TRUE(write(path("globe.vtu"), file));
  const MeshFile back = read_back(path("globe.vtu"));
  EXPECT_EQ(back.weights, file.weights);
  const auto made = make_mesh(back);
  ASSERT_TRUE(made);
  for (const VertexId v : made->mesh.vertices()) EXPECT_NEAR(made->mesh.weight(v), file.weights[v.index], 1e-15);
  // Of vertices that have not moved the coordinates are written as they came.
  MeshFile again = back;
  update(again, *made, made->mesh);
  EXPECT_EQ(again.sphere()->places, back.sphere()->places);
}

TEST_F(SphereFiles, FesomKeepsDegreesOfWhatHasNotMoved) {
  make("x.nod2d.out", "5\n1 299.5 10 1\n2 310 10 1\n3 -50 -20.25 1\n4 300 -20 1\n5 304 -3 0\n");
  make("x.elem2d.out", "4\n1 5 2\n2 5 3\n3 5 4\n4 5 1\n");
  MeshFile file = read_back(path("x.elem2d.out"));
  EXPECT_EQ(file.format, "fesom");
  auto made = make_mesh(file);
  ASSERT_TRUE(made) << made.error().what();
  Mesh mesh = made->mesh;
  const VertexId inner(4);
  const Vec3 p = mesh.weighted_vector(inner);
  mesh.set_point(inner, as_point({p.x, p.y, p.z + 1000}));
  mesh.set_weight(VertexId(1), 5e8);
  update(file, *made, mesh);
  ASSERT_TRUE(write(path("y.nod2d.out"), file));
  const std::string written = slurp(path("y.nod2d.out"));
  EXPECT_EQ(written.substr(0, written.find("5 304")), "5\n1 299.5 10 1\n2 310 10 1\n3 -50 -20.25 1\n4 300 -20 1\n");
  EXPECT_NE(written.find("\n5 304"), std::string::npos) << written;  // from 0 to 360, as it was
  EXPECT_EQ(slurp(path("y.elem2d.out")), "4\n1 5 2\n2 5 3\n3 5 4\n4 5 1\n");
  EXPECT_NE(slurp(path("y.nod2d.out.weights.csv")).find("5"), std::string::npos);
}

TEST_F(SphereFiles, FesomMarksTheCoastAndCarriesDepths) {
  const auto whole = icosahedral({.level = 1});
  ASSERT_TRUE(whole);
  MeshFile file = from_mesh(*whole);
  file.triangles.corners.erase(file.triangles.begin());
  file.point_data.push_back({"depth", 1, std::vector<double>(file.points.size(), 4000)});
  file.field_data.push_back({"levels", 1, std::vector<double>{0, -10, -5000}});
  ASSERT_TRUE(write(path("nod2d.out"), file));
  EXPECT_EQ(slurp(path("aux3d.out")).substr(0, 20), "3\n0\n-10\n-5000\n-4000\n");  // FESOM's sign
  EXPECT_EQ(files(), (std::vector<std::string>{"aux3d.out", "elem2d.out", "nod2d.out"}));
  const MeshFile back = read_back(path("nod2d.out"));
  ASSERT_EQ(back.point_data.size(), 2U);
  const auto& flags = std::get<std::vector<std::int32_t>>(back.point_data[0].values);
  EXPECT_EQ(std::count(flags.begin(), flags.end(), 1), 3);
  EXPECT_EQ(back.point_data[1].name, "depth");
  EXPECT_EQ(back.field_data[0].name, "levels");
  EXPECT_EQ(back.point_data[1].values, file.point_data[0].values);
}

TEST_F(SphereFiles, DegreesGoOntoTheSphereAndOntoMaps) {
  MeshFile file;
  file.points = {{0, 0}, {90, 0}, {0, 90}, {180, 0}, {-90, 0}, {0, -90}};
  file.triangles.corners = {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
  file.points_in = DegreePoints{};
  MeshFile sphere = file;
  ASSERT_TRUE(project(sphere, "sphere:radius=2"));
  EXPECT_EQ(sphere.sphere()->places[1], (Vec3{0, 2, 0}));  // exactly, on the axes
  EXPECT_EQ(sphere.sphere()->places[2], (Vec3{0, 0, 2}));
  EXPECT_EQ(sphere.sphere()->places[3], (Vec3{-2, 0, 0}));
  const auto made = make_mesh(sphere);
  ASSERT_TRUE(made) << made.error().what();
  ASSERT_TRUE(project(sphere, "none"));
  EXPECT_EQ(sphere.space().radius(), 0);
  EXPECT_EQ(sphere.points, file.points);
  for (const char* words : {"sphere:radius=0", "sphere:radius=x", "sphere:", "spheres"}) {
    const auto projected = project(file, words);
    ASSERT_FALSE(projected) << words;
    EXPECT_EQ(projected.error().code, ErrorCode::invalid_option);
  }
}

TEST_F(SphereFiles, WhatIsWrongIsNamedByFileAndLine) {
  const std::string octahedron = "v 1 0 0\nv 0 1 0\nv 0 0 1\nv -1 0 0\nv 0 -1 0\n";
  const std::string faces = "f 1 2 3\nf 2 4 3\nf 4 5 3\nf 5 1 3\nf 2 1 6\nf 4 2 6\nf 5 4 6\nf 1 5 6\n";
  const auto obj = [&](const std::string& content) {
    auto file = read(make("m.obj", content));
    if (!file) return plain(file.error().what());
    const auto made = make_mesh(*file);
    return made ? std::string() : plain(made.error().what());
  };
  EXPECT_EQ(obj(octahedron + "v 0 0 -1\n" + faces), "");
  EXPECT_EQ(
      obj(octahedron + "v 0 0 -1.01\n" + faces),
      "m.obj:6: point 6 is 1.01 from the origin, but most points are 1; expected all on one sphere around the origin, "
      "or in a plane of constant z");
  EXPECT_EQ(obj(octahedron + "v 0 0 1\n" + faces).substr(0, 48), "m.obj:6: point 3 and point 6 are both at (0, 0, ");
  EXPECT_EQ(obj(octahedron + "v 0 0 -1\nf 1 4 3\n" + faces),
            "m.obj:7: triangle 1 has zero area: its corners point 1, point 4 and point 3 are on one great circle");
  EXPECT_EQ(obj(octahedron + "v 0 0 nan\n" + faces),
            "m.obj:6: point 6 has z = nan, expected a finite number. Next: give its place");

  const auto fesom = [&](const std::string& points, const std::string& triangles) {
    std::filesystem::remove(path("elem2d.out"));
    if (!triangles.empty()) make("elem2d.out", triangles);
    auto file = read(make("nod2d.out", points));
    if (!file) return plain(file.error().what());
    const auto made = make_mesh(*file);
    return made ? std::string() : plain(made.error().what());
  };
  EXPECT_EQ(fesom("3\n1 0 0 1\n2 10 0 1\n3 0 10 1\n", "1\n1 2 3\n"), "");
  EXPECT_EQ(fesom("3\n1 0 0 1\n2 10 0 1\n3 0 90.5 1\n", "1\n1 2 3\n"),
            "nod2d.out:4: point 3 has longitude 0 and latitude 90.5; expected degrees, a latitude between -90 and 90");
  EXPECT_EQ(fesom("3\n1 0 0 1\n3 10 0 1\n3 0 10 1\n", "1\n1 2 3\n"), "nod2d.out:3: expected point 2, found point 3");
  EXPECT_EQ(fesom("3\n1 0 0 1\n2 10 0 1\n3 0 10 1\n", "1\n1 2 4\n"),
            "elem2d.out:2: triangle 1 uses vertex 4, but the file has 3 vertices, numbered from 1");
  EXPECT_EQ(fesom("4\n1 0 0 1\n2 10 0 1\n3 0 90 1\n4 50 90 1\n", "2\n1 2 3\n2 4 1\n").substr(0, 59),
            "nod2d.out:5: point 3 and point 4 are both at (0, 0, 6371000");
  EXPECT_EQ(fesom("3\n1 0 0 1\n2 10 0 1\n3 0 10 1\n", ""),
            "nod2d.out: is the points of a FESOM mesh; its triangles are expected in elem2d.out, which does not exist");
  EXPECT_EQ(
      fesom("3\n1 0 0 1\n2 1000 0 1\n3 0 10 1\n", "1\n1 2 3\n"),
      "nod2d.out:3: point 2 has longitude 1000 and latitude 0; expected degrees, a longitude between -720 and 720");
  // 180 and −180, and longitudes in both conventions, are the same places.
  EXPECT_EQ(fesom("4\n1 170 0 1\n2 180 10 1\n3 -170 0 1\n4 540 -10 1\n", "2\n1 3 2\n1 4 3\n"), "");
}

TEST_F(SphereFiles, FesomThatIsCyclicInLongitudeSaysSo) {
  // A channel of 5 × 1 squares, whose last column of points is the first one again.
  std::string points = "10\n", triangles = "10\n";
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 2; ++j)
      points += std::to_string(2 * i + j + 1) + " " + std::to_string(i) + " " + std::to_string(j) + " 1\n";
    const std::string a = std::to_string(2 * i + 1), b = std::to_string((2 * i + 2) % 10 + 1),
                      c = std::to_string((2 * i + 3) % 10 + 1), d = std::to_string(2 * i + 2);
    triangles += a + " " + b + " " + c + "\n" + a + " " + c + " " + d + "\n";
  }
  make("elem2d.out", triangles);
  const auto file = read(make("nod2d.out", points));
  ASSERT_TRUE(file) << file.error().what();
  const auto made = make_mesh(*file);
  ASSERT_FALSE(made);
  const std::string message = plain(made.error().what());
  EXPECT_TRUE(message.starts_with("elem2d.out:")) << message;
  EXPECT_TRUE(
      message.ends_with("; 2 triangles join the ends of the mesh in longitude, 4 degrees apart: it is cyclic, "
                        "and on the sphere these ends do not meet. temper has such a mesh as a periodic "
                        "plane, of MPAS, VTU or VTKHDF files"))
      << message;
}

TEST_F(SphereFiles, PointsOrTrianglesAloneSayHowFesomNamesThem) {
  const auto refused = [&](const std::string& name, const std::string& content) {
    const auto file = read(make(name, content));
    EXPECT_FALSE(file);
    return file ? std::string() : plain(file.error().what());
  };
  EXPECT_EQ(refused("p.txt", "3\n1 0 0 1\n2 10 0 1\n3 0 10 1\n"),
            "p.txt: has points without triangles, as FESOM has them; expected a name that ends with nod2d.out, and the "
            "triangles in elem2d.out beside it");
  EXPECT_EQ(refused("a.elem2d.out", "1\n1 2 3\n"),
            "a.elem2d.out: is the triangles of a FESOM mesh; its points are expected in a.nod2d.out, which does not "
            "exist");
}

TEST_F(SphereFiles, OneParallelIsTakenForAPlaneWithAWarning) {
  const auto warnings = [&](const char* z) {
    const std::string at = std::string(" ") + z + "\n";
    const auto file = read(make("p.obj", "v 3 0" + at + "v 0 3" + at + "v -3 0" + at + "f 1 2 3\n"));
    EXPECT_TRUE(file);
    EXPECT_EQ(file->space().radius(), 0);
    return file->warnings;
  };
  ASSERT_EQ(warnings("4").size(), 1U);
  EXPECT_EQ(plain(warnings("4")[0]),
            "p.obj: all points have z = 4 and are 5 from the origin: taken for a mesh in a "
            "plane, though they are also on one parallel of a sphere");
  EXPECT_TRUE(warnings("0").empty());  // the equator bounds no triangle of a sphere
}

TEST_F(SphereFiles, PointsOfNoTriangleAreOfNoPlaneAndNoSphere) {
  const std::string faces = "f 2 3 4\nf 3 5 4\nf 5 6 4\nf 6 2 4\nf 3 2 7\nf 5 3 7\nf 6 5 7\nf 2 6 7\n";
  const auto globe = read(make("g.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv -1 0 0\nv 0 -1 0\nv 0 0 -1\n" + faces));
  ASSERT_TRUE(globe) << globe.error().what();
  EXPECT_EQ(globe->space().radius(), 1);
  const auto made = make_mesh(*globe);
  ASSERT_TRUE(made) << made.error().what();
  EXPECT_EQ(made->mesh.n_vertices(), 6U);

  const auto plane = read(make("p.obj", "v 9 9 5\nv 0 0 2\nv 1 0 2\nv 0 1 2\nv 7 7 -1\nf 2 3 4\n"));
  ASSERT_TRUE(plane) << plane.error().what();
  EXPECT_EQ(plane->z(), 2);
  ASSERT_EQ(plane->warnings.size(), 1U);
  EXPECT_EQ(plain(plane->warnings[0]),
            "p.obj:1: point 1 is of no triangle and has z = 5, and so have 1 more: put into the plane of z = 2");
}

TEST_F(SphereFiles, PlanesOfSevenDigitsArePlanesWithAWarning) {
  const auto at = [&](const std::string& z) {
    return read(make("p.obj", "v 0 0 -50\nv 200 0 -50\nv 0 100 " + z + "\nf 1 2 3\n"));
  };
  const auto plane = at("-50.0000114");
  ASSERT_TRUE(plane) << plane.error().what();
  EXPECT_EQ(plane->space().radius(), 0);
  EXPECT_EQ(plane->z(), -50);
  ASSERT_EQ(plane->warnings.size(), 1U);
  EXPECT_EQ(
      plain(plane->warnings[0]),
      "p.obj:3: point 3 has z = -50.0000114, but point 1 has z = -50: within 1e-06 of the extent, so all are taken "
      "for a plane of this z");
  EXPECT_TRUE(at("-50.001")->is_surface());
}

TEST_F(SphereFiles, SmallPiecesOfSpheresAreNoPlanes) {
  // A meter on the Earth, about a pole: flat to a ten millionth of it, and on the sphere to the last digits.
  MeshFile f;
  for (const double lon : {0.0, 120.0, 240.0}) f.points.push_back({lon, 90 - 1e-5});
  f.triangles.corners = {{0, 1, 2}};
  ASSERT_TRUE(project(f, "sphere"));
  std::get<SpherePoints>(f.points_in).places[0] = f.space().radius() * direction_of(Vec2{0, 90});
  ASSERT_TRUE(write(path("m.obj"), f));
  const auto again = read(path("m.obj"));
  ASSERT_TRUE(again);
  EXPECT_EQ(again->space().radius(), f.space().radius());
}

TEST_F(SphereFiles, ASmallSurfaceFarFromTheOriginIsNone) {
  // A pyramid: its points are equally far from the origin to 1e-7, but not over its size.
  const auto pyramid = read(make("m.obj",
                                 "v 7000000 0 0\nv 7000000 1 0\nv 7000000 1 1\nv 7000000 0 1\nv 7000000.7 0.5 0.5\n"
                                 "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n"));
  ASSERT_TRUE(pyramid) << pyramid.error().what();
  EXPECT_TRUE(pyramid->is_surface());
  EXPECT_TRUE(pyramid->warnings.empty());
  // A small part of a sphere is one.
  const auto part = read(make("m.obj",
                              "v 7000000 0 0\nv 6999999.928571428 1000 0\nv 6999999.857142856 1000 1000\n"
                              "v 6999999.928571428 0 1000\nf 1 2 3\nf 1 3 4\n"));
  ASSERT_TRUE(part) << part.error().what();
  EXPECT_NE(part->sphere(), nullptr);
}

TEST_F(SphereFiles, OfWhatIsNearlyASphereTheWorstPointIsNamed) {
  auto f = read(make("m.obj",
                     "v 1 0 0\nv 0 1 0\nv 0 0 1.00001\nv -1.00002 0 0\nv 0 -1.00001 0\nf 1 2 3\nf 2 4 3\n"
                     "f 4 5 3\nf 5 1 3\n"));
  ASSERT_TRUE(f) << f.error().what();
  EXPECT_TRUE(f->is_surface());
  ASSERT_EQ(f->warnings.size(), 1U);
  EXPECT_EQ(
      plain(f->warnings[0]),
      "m.obj: all points are on a sphere around the origin to 1e-05 of its radius and 5e-06 of their extent. A mesh of "
      "the sphere has at most 1e-06 and 0.001, so they are a curved surface. Next: --projection sphere moves them to "
      "the sphere (projection=\"sphere\" in Python)");
  const auto refused = make_mesh(*f);
  ASSERT_FALSE(refused);
  EXPECT_EQ(plain(refused.error().what()),
            "m.obj:1: point 1 is 1 from the origin, but the median of all is 1.00001: off by 1e-05 of it, and 1e-06 is "
            "allowed; expected all on one sphere around the origin, or in a plane of constant z");
  ASSERT_TRUE(project(*f, "sphere"));
  ASSERT_NE(f->sphere(), nullptr);
  EXPECT_EQ(f->sphere()->radius, 1.00001);
  EXPECT_EQ(plain(f->warnings.back()),
            "m.obj: points are moved to the sphere of radius 1.00001, by 1e-05 of the radius at most");
  for (const Vec3 p : f->sphere()->places) EXPECT_NEAR(length(p), 1.00001, 1e-15);
  EXPECT_TRUE(make_mesh(*f));
}

TEST_F(SphereFiles, JigsawEllipsoidsAreSpheresOrRefused) {
  const auto ellipsoid = [&](const std::string& radii, const std::string& dimension, const std::string& points) {
    return read(make("e.jigsaw.msh", "MSHID=3;ELLIPSOID-MESH\n" + radii + dimension + "POINT=3\n" + points +
                                         "POWER=3;1\n0.5\n0\n0\nTRIA3=1\n0;1;2;0\n"));
  };
  const std::string radians = "0;0;0\n1.5707963267948966;0;0\n0;1.5707963267948966;0\n";
  const auto degrees = ellipsoid("RADII=2;2;2\n", "NDIMS=2\n", radians);
  ASSERT_TRUE(degrees) << degrees.error().what();
  EXPECT_EQ(degrees->space().radius(), 2);
  EXPECT_EQ(degrees->sphere()->places, (std::vector<Vec3>{{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}));
  EXPECT_EQ(degrees->weights, (std::vector<double>{0.5, 0, 0}));
  const auto in_space = ellipsoid("RADII=2;2;2\n", "NDIMS=3\n", "2;0;0;0\n0;2;0;0\n0;0;2;0\n");
  ASSERT_TRUE(in_space) << in_space.error().what();
  EXPECT_EQ(in_space->sphere()->places, degrees->sphere()->places);
  const auto flat = ellipsoid("RADII=2;2;1\n", "NDIMS=2\n", radians);
  ASSERT_FALSE(flat);
  EXPECT_EQ(plain(flat.error().what()),
            "e.jigsaw.msh:2: has the radius 1 beside 2; expected a sphere: equal radii above 0");
  const auto none = ellipsoid("", "NDIMS=2\n", radians);
  ASSERT_FALSE(none);
  EXPECT_EQ(plain(none.error().what()), "e.jigsaw.msh: is an ELLIPSOID-MESH without RADII");
}

TEST_F(SphereFiles, MpasGlobesAreRead) {
  const std::string file = TEMPER_SHARED "/meshes/sphere/mpas_QU1920km.nc";
  if (!std::filesystem::exists(file) || netcdf_version().empty()) GTEST_SKIP() << "not there";
  const MeshFile mpas = read_back(file);
  EXPECT_EQ(mpas.points.size(), 162U);
  const auto made = make_mesh(mpas);
  ASSERT_TRUE(made) << made.error().what();
  EXPECT_EQ(made->mesh.n_triangles(), 320U);
  EXPECT_EQ(made->reversed_triangles, 0U);
  const auto written = write(path("x.node"), mpas);
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().what().find("expected one of vtu,"), std::string::npos) << written.error().what();
}

}  // namespace
}  // namespace temper::io
