// Meshes in longitude and latitude: known by what their file says, refused where a plane is needed, put on a map, and
// written in the degrees that they came in.
#include <cmath>
#include <numbers>

#include "io/formats/format.hpp"
#include "support.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"

namespace temper::io {
namespace {

/// A sea of 8° × 4° west of Europe, with depths in meters.
MeshFile sea(double west = -14) {
  MeshFile f = from_mesh(*random_mesh({.vertices = 120, .seed = 2}));
  std::vector<double> depths;
  for (Vec2& p : f.points) {
    p = {west + 2 * p.x, 47 + p.y};
    depths.push_back(3000 + 100 * p.y);
  }
  f.point_data = {{"depth", 1, depths}};
  f.weights.clear();
  return f;
}

/// The same as fort.14, which knows it by its depths.
MeshFile read_sea(const std::string& path, const MeshFile& f = sea()) {
  EXPECT_TRUE(write(path, f, {"adcirc", {}}));
  const auto read_again = read(path);
  EXPECT_TRUE(read_again);
  return *read_again;
}

// 2DM has heights, SCHISM's 2DM depths, and shallow water is not deeper than the mesh is wide in degrees.
TEST_F(FileTest, MeshesOfTheSeaInTheRangeOfDegreesLookLikeDegreesWhateverTheirDepths) {
  for (const double scale : {1.0, -1.0, 1e-6, 0.0}) {
    MeshFile f = sea();
    for (double& depth : std::get<std::vector<double>>(f.point_data[0].values)) depth *= scale;
    for (const char* const name : {"sea.14", "sea.2dm"}) {
      ASSERT_TRUE(write(path(name), f));
      const auto again = read(path(name));
      ASSERT_TRUE(again) << again.error().what();
      ASSERT_TRUE(again->degrees() != nullptr) << name << " " << scale;
      EXPECT_TRUE(again->degrees()->is_guessed);
    }
    for (Vec2& p : f.points) p = 1000.0 * p;
    ASSERT_TRUE(write(path("meters.2dm"), f));
    EXPECT_TRUE(read(path("meters.2dm"))->degrees() == nullptr);
  }
}

TEST_F(FileTest, ZThatBecomesDataShowsAMeshOfTheGroundWhichMayBeInDegrees) {
  const std::string sea = "OFF\n3 1 0\n3 60 1\n4 60 2\n3 61 4\n3 0 1 2\n";
  const auto flat = read(make("sea.off", sea), {.flat = true});
  ASSERT_TRUE(flat) << flat.error().what();
  EXPECT_TRUE(flat->degrees() != nullptr && flat->degrees()->is_guessed);
  const std::string plane = "OFF\n3 1 0\n3 60 1\n4 60 1\n3 61 1\n3 0 1 2\n";
  EXPECT_TRUE(read(make("plane.off", plane), {.flat = true})->degrees() == nullptr) << "no heights, no ground";
  const std::string local = "OFF\n3 1 0\n0 0 1\n4 0 2\n0 3 9\n3 0 1 2\n";
  EXPECT_TRUE(read(make("local.off", local), {.flat = true})->degrees() == nullptr);
}

TEST_F(FileTest, PointsAroundTheOriginOrFromItAreLocalCoordinatesUnlessTheWaterIsDeeperThanTheyAreWide) {
  const auto guessed = [&](Vec2 shift, double depth) {
    MeshFile f = from_mesh(*sheared_grid({4, 4, 0}));
    Vec2 high = {0, 0};
    for (const Vec2 p : f.points) high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    for (Vec2& p : f.points) p = {p.x / high.x + shift.x, p.y / high.y + shift.y};  // a unit square
    f.point_data = {{"depth", 1, std::vector<double>(f.points.size(), depth)}};
    return read_sea(path("square.14"), f).degrees() != nullptr;
  };
  EXPECT_FALSE(guessed({0, 0}, 0.5));
  EXPECT_FALSE(guessed({-0.5, -0.5}, 0));
  EXPECT_TRUE(guessed({0, 0}, 2));
  EXPECT_TRUE(guessed({-0.5, -0.5}, -2));
  EXPECT_TRUE(guessed({3, 60}, 0.5));
  EXPECT_TRUE(guessed({0, 60}, 0.5));
}

TEST_F(FileTest, Fort14OfALocalPlaneIsNotInDegrees) {
  EXPECT_TRUE(read_sea(path("sea.14")).degrees() != nullptr);
  MeshFile square = from_mesh(*sheared_grid({4, 4, 0.1}));
  EXPECT_FALSE(read_sea(path("plain.14"), square).degrees() != nullptr) << "no depths";
  square.point_data = {{"depth", 1, std::vector<double>(square.points.size(), 0.5)}};
  EXPECT_FALSE(read_sea(path("shallow.14"), square).degrees() != nullptr);
  MeshFile meters = sea();
  for (Vec2& p : meters.points) p = 1000.0 * p;
  EXPECT_FALSE(read_sea(path("meters.14"), meters).degrees() != nullptr);
}

TEST_F(FileTest, AMeshInDegreesIsRefusedUntilItIsOnAMapOrCalledPlane) {
  MeshFile f = read_sea(path("sea.14"));
  const auto refused = make_mesh(f);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::geographic);
  EXPECT_EQ(refused.error().message, needs_projection(true));
  MeshFile plane = f;
  ASSERT_TRUE(project(plane, "none"));
  EXPECT_TRUE(make_mesh(plane));
  EXPECT_EQ(plane.points, f.points);
  ASSERT_TRUE(project(f, "stereographic"));
  const auto made = make_mesh(f);
  ASSERT_TRUE(made) << made.error().what();
  EXPECT_NEAR(length(made->mesh.position(VertexId(0)) - made->mesh.position(VertexId(1))), 3e5, 3e5);
}

TEST_F(FileTest, DegreesComeBackBitForBitWhereNothingHasMovedInEveryFormat) {
  for (const double west : {-14.0, 346.0}) {
    MeshFile f = sea(west);
    const std::vector<Vec2> degrees = f.points;
    ASSERT_TRUE(project(f, "mercator"));
    auto made = make_mesh(f);
    ASSERT_TRUE(made);
    OptimizeOptions options;
    options.max_sweeps = 5;
    ASSERT_TRUE(optimize(made->mesh, options));
    update(f, *made, made->mesh);
    const std::vector<Vec2> places = f.points;
    std::size_t stayed = 0;
    for (const Format& format : formats()) {
      if (!writes_planes(format) || format.name == "mpas") continue;
      const std::string name = format.name == "triangle"
                                   ? path("m.node")
                                   : path("m" + std::string(format.suffixes.substr(0, format.suffixes.find(' '))));
      const auto warnings = write(name, f, {std::string(format.name), {}});
      ASSERT_TRUE(warnings) << warnings.error().what();
      const bool warned = std::any_of(warnings->begin(), warnings->end(), [](const std::string& w) {
        return w.find("weights are squared lengths on the map mercator:") != std::string::npos;
      });
      EXPECT_EQ(warned, format.name != "ugrid") << format.name << ": UGRID says it in the file";
      const auto again = read(name);
      ASSERT_TRUE(again) << again.error().what();
      ASSERT_EQ(again->points.size(), degrees.size());
      for (std::size_t p = 0; p < degrees.size(); ++p) {
        const bool same = places[p] == f.map()->places[p];
        stayed += same ? 1 : 0;
        if (same) {
          EXPECT_EQ(again->points[p], degrees[p]) << format.name;
        } else {
          EXPECT_LT(length(forward(f.map()->projection, again->points[p]) - places[p]), 1e-6) << "a micrometer";
          EXPECT_LT(std::abs(again->points[p].x - west), 20) << "on the same turn of the globe";
        }
      }
    }
    EXPECT_GT(stayed, 100u);
  }
}

TEST_F(FileTest, PlacesOffTheMapAreNamed) {
  MeshFile f = sea();
  f.points[7] = {3, 91};
  const auto off = project(f, "stereographic");
  ASSERT_FALSE(off);
  EXPECT_EQ(
      off.error().message,
      "point 7 is at longitude 3.000000 and latitude 91.000000; expected degrees on the globe, and not at the end "
      "of the map");
  f = sea();
  EXPECT_EQ(project(f, "mercator:170").error().message.substr(0, 9), "triangle ");
  EXPECT_FALSE(project(f, "conic"));
}

#if TEMPER_NETCDF
TEST_F(FileTest, UgridSaysDegreesInItsUnitsAndNamesAndKnowsThemAgain) {
  MeshFile f = sea();
  ASSERT_TRUE(project(f, "stereographic:-10,49"));
  ASSERT_TRUE(write(path("m.ugrid.nc"), f));
  const auto again = read(path("m.ugrid.nc"));
  ASSERT_TRUE(again) << again.error().what();
  EXPECT_TRUE(again->degrees() != nullptr);
  const std::string bytes = slurp(path("m.ugrid.nc"));
  for (const char* part : {"degrees_east", "degrees_north", "longitude", "latitude"}) {
    EXPECT_NE(bytes.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(bytes.find("projection_x_coordinate"), std::string::npos);
  MeshFile plane = from_mesh(*sheared_grid({4, 4, 0.1}));
  ASSERT_TRUE(write(path("plane.ugrid.nc"), plane));
  EXPECT_FALSE(read(path("plane.ugrid.nc"))->degrees() != nullptr);
}
#endif

TEST_F(FileTest, Fort14HasLongitudeAndLatitudeOfAMeshInThePlaneThatKnowsThem) {
  MeshFile f = sea();
  const std::vector<Vec2> degrees = f.points;
  std::vector<double> longitude, latitude;
  for (const Vec2 p : degrees) longitude.push_back(p.x), latitude.push_back(p.y);
  for (Vec2& p : f.points) p = 1000.0 * p;
  f.point_data.push_back({"longitude", 1, longitude});
  f.point_data.push_back({"latitude", 1, latitude});
  EXPECT_EQ(read_sea(path("m.14"), f).points, degrees);
}

}  // namespace
}  // namespace temper::io
