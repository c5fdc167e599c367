// Periodic planes in pictures: the domain and a margin, where everything goes on.
#include <gtest/gtest.h>

#include "draw/viewport.hpp"
#include "temper/draw.hpp"
#include "temper/generate.hpp"
#include "unit/draw/svg_reading.hpp"

namespace temper {
namespace {

TEST(DrawPeriodic, TheDomainIsShownAndItsEdgesAreMarked) {
  const Mesh mesh = *random_periodic({.vertices = 200, .period = {2, 1}});
  const std::string svg = draw_svg(mesh);
  test::expect_well_formed(svg);
  EXPECT_NE(svg.find("class=\"period\""), std::string::npos);
  EXPECT_NE(svg.find("class=\"beyond\""), std::string::npos);
  const std::array<const Mesh*, 1> meshes = {&mesh};
  const Viewport frame = make_viewport(meshes, {});
  EXPECT_LT(frame.box.low.x, 0);
  EXPECT_GT(frame.box.high.x, 2);
  EXPECT_LT(frame.box.high.x, 2.2);
  const Mesh plane = *sheared_grid();
  EXPECT_EQ(draw_svg(plane).find("class=\"period\""), std::string::npos);
}

// A hexagon in the margin is as whole as one inside: of each kind of edge there are images until beyond the picture.
TEST(DrawPeriodic, TheMarginIsFull) {
  const Mesh mesh = *periodic_hexagons({.nx = 40, .ny = 40});
  const std::array<const Mesh*, 1> meshes = {&mesh};
  const Viewport frame = make_viewport(meshes, {});
  const Vec2 period = mesh.space().period(), shown = frame.clip.high - frame.clip.low;
  const double times = shown.x * shown.y / (period.x * period.y);
  EXPECT_GT(times, 1.2);
  DrawOptions options;
  options.dual = options.fill = false;
  const std::string svg = draw_svg(mesh, options);
  const std::size_t begin = svg.find("class=\"primal\"");
  const std::string path = svg.substr(begin, svg.find("/>", begin) - begin);
  // Each edge is one segment, to which a move belongs unless it goes on from the one before.
  const auto edges = static_cast<double>(mesh.n_edges());
  EXPECT_GT(static_cast<double>(test::count(path, "m")), 0.4 * times * edges);
}

}  // namespace
}  // namespace temper
