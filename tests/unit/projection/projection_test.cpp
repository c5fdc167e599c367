// Projections: the book's numbers, the way back, and that angles stay.
#include "temper/detail/projection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace temper {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Projection unit_sphere(ProjectionKind kind, Vec2 center) { return {kind, center, 1}; }

std::vector<Projection> all_kinds() {
  std::vector<Projection> projections;
  for (const auto kind :
       {ProjectionKind::stereographic, ProjectionKind::mercator, ProjectionKind::transverse_mercator}) {
    for (const Vec2 center : {Vec2{0, 0}, Vec2{7.5, 51}, Vec2{-160, -35}, Vec2{179, 65}}) {
      projections.push_back(unit_sphere(kind, center));
    }
  }
  projections.push_back(unit_sphere(ProjectionKind::stereographic, {0, 90}));
  projections.push_back(unit_sphere(ProjectionKind::stereographic, {0, -90}));
  return projections;
}

std::vector<Vec2> places_around(Vec2 center) {
  std::vector<Vec2> places;
  for (double lon = -40; lon <= 40; lon += 8) {
    for (double lat = -30; lat <= 30; lat += 7.5) {
      if (std::abs(center.y + lat) < 89) places.push_back({center.x + lon, center.y + lat});
    }
  }
  return places;
}

// J. P. Snyder, Map Projections: A Working Manual (USGS Professional Paper 1395), appendix A: the numerical examples
// for the sphere of radius 1 (Mercator p. 266, transverse Mercator p. 268, stereographic p. 312), to the digits
// printed.
TEST(Projection, TheNumericalExamplesOfSnyderComeOut) {
  const Projection mercator = unit_sphere(ProjectionKind::mercator, {-180, 0});
  EXPECT_NEAR(forward(mercator, {-75, 35}).x, 1.8325957, 5e-8);
  EXPECT_NEAR(forward(mercator, {-75, 35}).y, 0.6528366, 5e-8);
  EXPECT_NEAR(scale_factor(mercator, {-75, 35}), 1.2207746, 5e-8);
  const Projection transverse = unit_sphere(ProjectionKind::transverse_mercator, {-75, 0});
  EXPECT_NEAR(forward(transverse, {-73.5, 40.5}).x, 0.0199077, 5e-8);
  EXPECT_NEAR(forward(transverse, {-73.5, 40.5}).y, 0.7070276, 5e-8);
  const Projection stereographic = unit_sphere(ProjectionKind::stereographic, {-100, 40});
  EXPECT_NEAR(forward(stereographic, {-75, 30}).x, 0.3807224, 5e-8);
  EXPECT_NEAR(forward(stereographic, {-75, 30}).y, -0.1263802, 5e-8);
  EXPECT_NEAR(scale_factor(stereographic, {-75, 30}), 1.0402304, 5e-8);
}

TEST(Projection, ThereAndBackIsWhereOneStarted) {
  std::size_t tested = 0;
  for (const Projection& p : all_kinds()) {
    for (const Vec2 place : places_around(p.center)) {
      const Vec2 back = inverse(p, forward(p, place));
      // Longitudes of places near a pole are worth less: compared as arcs.
      EXPECT_NEAR(std::remainder(back.x - place.x, 360) * kDegree * std::cos(place.y * kDegree), 0, 1e-12);
      EXPECT_NEAR((back.y - place.y) * kDegree, 0, 1e-12);
      ++tested;
    }
  }
  EXPECT_GT(tested, 500u);
}

TEST(Projection, AnglesStayAndLengthsGrowByTheScale) {
  for (const Projection& p : all_kinds()) {
    for (const Vec2 place : places_around(p.center)) {
      constexpr double kStep = 1e-4;  // degrees: differences are good to about 1e-9
      const double east_arc = 2 * kStep * kDegree * std::cos(place.y * kDegree), north_arc = 2 * kStep * kDegree;
      const Vec2 east =
          (1 / east_arc) * (forward(p, {place.x + kStep, place.y}) - forward(p, {place.x - kStep, place.y}));
      const Vec2 north =
          (1 / north_arc) * (forward(p, {place.x, place.y + kStep}) - forward(p, {place.x, place.y - kStep}));
      // Cauchy-Riemann: north is east turned by a right angle.
      const double scale = scale_factor(p, place);
      EXPECT_NEAR(north.x / scale, -east.y / scale, 1e-7);
      EXPECT_NEAR(north.y / scale, east.x / scale, 1e-7);
      EXPECT_NEAR(length(north), scale, 1e-7 * scale);
    }
  }
}

TEST(Projection, TheCenterIsTheOriginAndTrueToScale) {
  for (const Projection& p : all_kinds()) {
    EXPECT_NEAR(length(forward(p, p.center)), 0, 1e-15);
    EXPECT_NEAR(scale_factor(p, p.center), 1, 1e-15);
  }
}

TEST(Projection, ItIsReadFromItsNameAndCenter) {
  const std::vector<Vec2> places = {{10, 40}, {20, 40}};
  const auto stereographic = parse_projection("stereographic", places);
  ASSERT_TRUE(stereographic.has_value());
  EXPECT_NEAR(stereographic->center.x, 15, 1e-12);
  // On the great circle between, north of the parallel.
  EXPECT_NEAR(stereographic->center.y, std::atan(std::tan(40 * kDegree) / std::cos(5 * kDegree)) / kDegree, 1e-12);
  const auto given = parse_projection("transverse-mercator:9,-3.5", places);
  ASSERT_TRUE(given.has_value());
  EXPECT_EQ(given->kind, ProjectionKind::transverse_mercator);
  EXPECT_EQ(given->center, (Vec2{9, -3.5}));
  EXPECT_EQ(parse_projection("mercator:9", places)->center.x, 9);
  for (const char* bad : {"", "lambert", "mercator:", "mercator:x", "mercator:1,2,3", "mercator:1,", "mercator:0,90",
                          "stereographic:0,91", "stereographic:nan,0", "stereographic:400,0"}) {
    const auto projection = parse_projection(bad, places);
    ASSERT_FALSE(projection.has_value()) << bad;
    EXPECT_EQ(projection.error().code, ErrorCode::invalid_option);
  }
}

TEST(Projection, AnUnknownNameIsAnsweredWithTheProjectionThatItMeans) {
  const auto answer = [](const char* name) { return parse_projection(name, {}).error().message; };
  const auto ends = [&](const char* name, const char* end) {
    EXPECT_TRUE(answer(name).ends_with(end)) << answer(name);
  };
  ends("utm", ". Next: for UTM take transverse-mercator:LON, with the middle longitude of the zone (9 in zone 32)");
  ends("UTM:99", "(9 in zone 32)");
  ends("utm32", ". Next: for this zone of UTM take transverse-mercator:9");
  ends("UTM-1S", "transverse-mercator:-177");
  ends("EPSG:32760", "transverse-mercator:177");
  ends("EPSG:4326", "found 'EPSG:4326'");
  ends("stereografic:9", "did you mean 'stereographic'?");
  ends("lambert", "found 'lambert'");
}

TEST(Projection, TheMiddleOfPlacesDoesNotMindTheDateLine) {
  const std::vector<Vec2> places = {{179, 0}, {-179, 0}};
  EXPECT_NEAR(std::abs(mean_place(places).x), 180, 1e-9);
}

TEST(Projection, PlacesOffTheGlobeOrTheMapAreNamed) {
  Outline o;
  o.points = {{0, 0}, {10, 0}, {5, 95}};
  o.segments = {{{0, 1}, 0}, {{1, 2}, 0}, {{2, 0}, 0}};
  const Projection at_zero = {ProjectionKind::stereographic, {0, 0}};
  const auto off_globe = project(o, at_zero);
  ASSERT_FALSE(off_globe.has_value());
  EXPECT_NE(off_globe.error().what().find("point 2 is at longitude 5"), std::string::npos);
  o.points[2] = {180, 0};
  EXPECT_FALSE(project(o, at_zero).has_value());
  o.points[2] = {5, 90};
  EXPECT_FALSE(project(o, {ProjectionKind::mercator, {0, 0}}).has_value());
  o.points[2] = {175, 5};
  o.points[1] = {-175, 5};
  const auto torn = project(o, {ProjectionKind::mercator, {0, 0}});
  ASSERT_FALSE(torn.has_value());
  EXPECT_NE(torn.error().what().find("segment 1 crosses the end of the map"), std::string::npos);
}

TEST(Projection, TextsGiveTheSameProjectionBack) {
  for (const Projection& p : all_kinds()) {
    const auto again = parse_projection(projection_text(p), {});
    ASSERT_TRUE(again.has_value()) << again.error().what();
    EXPECT_EQ(again->kind, p.kind);
    EXPECT_EQ(again->center, p.center);
  }
  EXPECT_EQ(projection_text({ProjectionKind::transverse_mercator, {9, -0.5}}), "transverse-mercator:9,-0.5");
}

TEST(Projection, MeshesThatTheEndOfTheMapTearsAreRefusedByTheirNames) {
  const std::vector<Vec2> places = {{-1, 50}, {1, 50}, {0, 52}};
  const std::vector<std::array<std::int32_t, 3>> triangles = {{0, 1, 2}};
  EXPECT_TRUE(project(places, triangles, {ProjectionKind::mercator, {0, 50}}, InputNames()).has_value());
  const auto torn = project(places, triangles, {ProjectionKind::mercator, {180, 50}}, InputNames());
  ASSERT_FALSE(torn.has_value());
  EXPECT_EQ(torn.error().message,
            "triangle 0 crosses the end of the map, 180 degrees from its center; choose another center");
  EXPECT_TRUE(project(places, triangles, {ProjectionKind::stereographic, {180, 50}}, InputNames()).has_value());
}

TEST(LongitudeTurn, PutsLongitudesOnTheTurnOfThoseGiven) {
  const std::vector<Vec2> pacific = {{150, 0}, {230, 10}};
  const LongitudeTurn turn(pacific);
  EXPECT_EQ(turn({-170, 5}), (Vec2{190, 5}));
  EXPECT_EQ(turn({170, 5}), (Vec2{170, 5}));
  EXPECT_EQ(LongitudeTurn(std::span<const Vec2>())({12, 3}), (Vec2{12, 3}));
}

}  // namespace
}  // namespace temper
