// Plots as documents: well-formed, deterministic, nothing drawn outside the frame, whatever the numbers are.
#include "plot/plot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "base/rng.hpp"
#include "draw/text.hpp"
#include "plot/axes.hpp"
#include "plot/levels.hpp"
#include "plot/ticks.hpp"
#include "support/lattice.hpp"
#include "temper/draw.hpp"
#include "unit/draw/svg_reading.hpp"

namespace temper {
namespace {

using test::count;
using test::expect_well_formed;

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// The d attributes of all paths of that class.
std::vector<std::string> paths_of(const std::string& svg, const std::string& name) {
  std::vector<std::string> paths;
  const std::string what = "class=\"" + name + "\"";
  for (std::size_t at = svg.find(what); at != std::string::npos; at = svg.find(what, at + 1)) {
    const std::size_t begin = svg.find(" d=\"", at) + 4;
    paths.push_back(svg.substr(begin, svg.find('"', begin) - begin));
  }
  return paths;
}

// The frame of the axes, in pixels, from the clip path.
Box frame_of(const std::string& svg) {
  const std::size_t at = svg.find("<clipPath");
  const auto value = [&](const char* name) {
    const std::size_t begin = svg.find(std::string(name) + "=\"", at) + std::string(name).size() + 2;
    return std::stod(svg.substr(begin));
  };
  const Vec2 low = {value(" x"), value(" y")};
  return {low, low + Vec2{value("width"), value("height")}};
}

LinePlot curves() {
  LinePlot plot;
  plot.title = "E_{F} < \"E_{T}\" & more";
  plot.x_label = "weight w / ℓ²";
  plot.y_label = "energy E_{F}^{1}";
  for (int s = 0; s < 5; ++s) {
    Series series{
        .name = "series " + std::to_string(s), .points = {}, .style = static_cast<SeriesStyle>(s), .color = {}};
    for (int i = 0; i <= 20; ++i) series.points.push_back({i / 10.0, std::exp(0.3 * s * i / 10.0) + s});
    plot.series.push_back(series);
  }
  plot.marks = {{{1, 2}, "here"}};
  plot.vertical = {{0.5, "flip"}};
  plot.horizontal = {{3, "limit"}};
  return plot;
}

ContourPlot landscape() {
  ContourPlot plot;
  plot.title = "x² + y²";
  plot.x_label = "x";
  plot.y_label = "y";
  plot.x_range = {-2, 2};
  plot.y_range = {-1, 1};
  plot.nx = 41;
  plot.ny = 21;
  for (std::size_t j = 0; j < plot.ny; ++j) {
    for (std::size_t i = 0; i < plot.nx; ++i) {
      const double x = -2 + 0.1 * static_cast<double>(i), y = -1 + 0.1 * static_cast<double>(j);
      plot.values.push_back(x < -1.5 ? kNan : x * x + y * y);
    }
  }
  plot.overlays = {{.points = {{-1, 0}, {1, 0}}, .label = "edge"}};
  plot.value_label = "E";
  return plot;
}

TEST(Plot, DocumentsAreWellFormedAndTheSameEachTime) {
  for (const bool log_y : {false, true}) {
    LinePlot plot = curves();
    plot.log_y = log_y;
    expect_well_formed(line_plot_svg(plot));
    EXPECT_EQ(line_plot_svg(plot), line_plot_svg(plot));
  }
  for (const LevelSpacing spacing : {LevelSpacing::linear, LevelSpacing::geometric, LevelSpacing::quantile}) {
    ContourPlot plot = landscape();
    plot.spacing = spacing;
    plot.equal_aspect = spacing == LevelSpacing::linear;
    expect_well_formed(contour_plot_svg(plot));
    EXPECT_EQ(contour_plot_svg(plot), contour_plot_svg(plot));
    EXPECT_GE(paths_of(contour_plot_svg(plot), "band").size(), 4u);
  }
}

TEST(Plot, NothingAtAllIsStillADocument) {
  expect_well_formed(line_plot_svg({}));
  LinePlot one;
  one.series = {{.name = "a", .points = {{3, 4}}}, {.name = "b", .points = {{kNan, kInf}}}, {}};
  one.log_y = true;
  expect_well_formed(line_plot_svg(one));
  ContourPlot nothing;
  nothing.nx = nothing.ny = 2;
  nothing.values = {kNan, kNan, kNan, kNan};
  expect_well_formed(contour_plot_svg(nothing));
  nothing.values = {1, 1, 1, 1};
  expect_well_formed(contour_plot_svg(nothing));
  expect_well_formed(grid_svg(std::vector<std::string>{line_plot_svg({})}, 1));
}

TEST(Plot, ExtremeNumbersAreStillADocument) {
  for (const double size : {1e-310, 1e-200, 1e-9, 1e9, 1e200, 1.7e308}) {
    LinePlot plot;
    plot.series = {{.name = "a", .points = {{-size, size}, {size / 3, -size}, {size, size / 7}}}};
    for (const bool log_y : {false, true}) {
      plot.log_y = log_y;
      SCOPED_TRACE(size);
      expect_well_formed(line_plot_svg(plot));
      plot.x_range = PlotRange{0, 1};
      expect_well_formed(line_plot_svg(plot));
      plot.x_range.reset();
    }
    ContourPlot contour;
    contour.nx = contour.ny = 2;
    contour.x_range = {-size, size};
    contour.y_range = {size, size};
    contour.values = {-size, size, size / 2, size};
    for (const LevelSpacing spacing : {LevelSpacing::linear, LevelSpacing::geometric, LevelSpacing::quantile}) {
      contour.spacing = spacing;
      expect_well_formed(contour_plot_svg(contour));
    }
  }
}

TEST(Plot, CurvesStayInTheFrame) {
  LinePlot plot = curves();
  plot.x_range = PlotRange{0.4, 1.1};
  plot.y_range = PlotRange{1, 4};
  plot.series.push_back({.name = "wild", .points = {{-1e6, -1e9}, {0.7, 1e12}, {0.8, -1e300}, {1e5, 1e300}}});
  const std::string svg = line_plot_svg(plot);
  const Box frame = frame_of(svg);
  constexpr double kMargin = 5;  // pixels that are written beyond the frame, to be cut off
  std::size_t segments = 0;
  for (const std::string& path : paths_of(svg, "curve")) {
    for (const auto& [a, b] : test::read_path(path).segments) {
      for (const GridPoint p : {a, b}) {
        EXPECT_GE(static_cast<double>(p.x) * Axes::kUnit, frame.low.x - kMargin);
        EXPECT_LE(static_cast<double>(p.x) * Axes::kUnit, frame.high.x + kMargin);
        EXPECT_GE(static_cast<double>(p.y) * Axes::kUnit, frame.low.y - kMargin);
        EXPECT_LE(static_cast<double>(p.y) * Axes::kUnit, frame.high.y + kMargin);
      }
      ++segments;
    }
  }
  EXPECT_GT(segments, 10u);
}

TEST(Plot, PointsLandWhereTheAxesSay) {
  LinePlot plot;
  plot.x_range = PlotRange{0, 10};
  plot.y_range = PlotRange{-1, 1};
  plot.series = {{.points = {{0, -1}, {5, 0}, {10, 0.5}}}};
  const std::string svg = line_plot_svg(plot);
  const Box frame = frame_of(svg);
  const auto segments = test::read_path(paths_of(svg, "curve").at(0)).segments;
  ASSERT_EQ(segments.size(), 2u);
  const double w = frame.high.x - frame.low.x, h = frame.high.y - frame.low.y;
  const auto expect_at = [&](GridPoint p, double x, double y) {
    EXPECT_NEAR(static_cast<double>(p.x) * Axes::kUnit, frame.low.x + x * w, Axes::kUnit);
    EXPECT_NEAR(static_cast<double>(p.y) * Axes::kUnit, frame.high.y - y * h, Axes::kUnit);
  };
  expect_at(segments[0].first, 0, 0);
  expect_at(segments[0].second, 0.5, 0.5);
  expect_at(segments[1].second, 1, 0.75);
}

TEST(Plot, APointThatIsNotFiniteBreaksTheLine) {
  LinePlot plot;
  plot.series = {{.points = {{0, 1}, {1, 2}, {2, kNan}, {3, 1}, {4, 2}, {5, 0.5}}}};
  const auto subpaths = [&] { return count(paths_of(line_plot_svg(plot), "curve").at(0), "m"); };
  EXPECT_EQ(subpaths(), 2u);
  plot.series[0].points[2].y = 3;
  EXPECT_EQ(subpaths(), 1u);
  plot.series[0].points[2].y = -3;
  EXPECT_EQ(subpaths(), 1u);
  plot.log_y = true;
  EXPECT_EQ(subpaths(), 2u) << "no logarithm of a negative number";
}

TEST(Plot, AStepIsLevelUntilTheNextPoint) {
  LinePlot plot;
  plot.series = {{.points = {{0, 1}, {1, 2}, {2, 0}}, .style = SeriesStyle::step}};
  const auto segments = test::read_path(paths_of(line_plot_svg(plot), "curve").at(0)).segments;
  ASSERT_EQ(segments.size(), 4u);
  for (std::size_t k = 0; k < 4; k += 2) EXPECT_EQ(segments[k].first.y, segments[k].second.y);
  for (std::size_t k = 1; k < 4; k += 2) EXPECT_EQ(segments[k].first.x, segments[k].second.x);
}

TEST(Plot, SeriesDifferByMoreThanColor) {
  LinePlot plot;
  for (int s = 0; s < 6; ++s)
    plot.series.push_back({.name = std::to_string(s), .points = {{0, 0.0 + s}, {1, 1.0 + s}}});
  const std::string svg = line_plot_svg(plot);
  std::set<std::string> dashes;
  for (std::size_t at = svg.find("class=\"curve\""); at != std::string::npos;
       at = svg.find("class=\"curve\"", at + 1)) {
    const std::string tag = svg.substr(at, svg.find(" d=", at) - at);
    const std::size_t dash = tag.find("dasharray");
    dashes.insert(dash == std::string::npos ? "" : tag.substr(dash));
  }
  EXPECT_EQ(dashes.size(), 6u);
}

TEST(Plot, BandsOfAPlaneAreDrawnAtTheirPlaces) {
  ContourPlot plot;
  plot.x_range = {0, 4};
  plot.y_range = {0, 1};
  plot.nx = 5;
  plot.ny = 2;
  plot.values = {0, 1, 2, 3, 4, 0, 1, 2, 3, 4};
  plot.levels = {1.5, 3};
  const std::string svg = contour_plot_svg(plot);
  const Box frame = frame_of(svg);
  const auto bands = paths_of(svg, "band");
  ASSERT_EQ(bands.size(), 3u);
  const double w = frame.high.x - frame.low.x;
  for (std::size_t band = 1; band < 3; ++band) {
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    for (const auto& [a, b] : test::read_path(bands[band]).segments) least = std::min({least, a.x, b.x});
    EXPECT_NEAR(static_cast<double>(least) * Axes::kUnit, frame.low.x + plot.levels[band - 1] / 4 * w, Axes::kUnit);
  }
  EXPECT_EQ(paths_of(svg, "contour").size(), 2u);
}

TEST(Plot, BandsGrowDarkerInGreyPrint) {
  for (int k = 1; k <= 20; ++k) EXPECT_LT(band_color(k / 20.0).gray(), band_color((k - 1) / 20.0).gray() - 0.01);
  EXPECT_EQ(band_color(0).text().size(), 7u);
}

TEST(Plot, LevelsAreThoseAskedForOrRound) {
  ContourPlot plot = landscape();
  plot.levels = {3, 1, kNan, 2, 2};
  EXPECT_EQ(choose_levels(plot), (std::vector<double>{1, 2, 3}));
  plot.levels.clear();
  plot.n_levels = 10;
  for (const LevelSpacing spacing : {LevelSpacing::linear, LevelSpacing::geometric, LevelSpacing::quantile}) {
    plot.spacing = spacing;
    const std::vector<double> levels = choose_levels(plot);
    EXPECT_GE(levels.size(), 5u);
    EXPECT_LE(levels.size(), 11u);
    for (std::size_t k = 1; k < levels.size(); ++k) EXPECT_LT(levels[k - 1], levels[k]);
  }
  plot.spacing = LevelSpacing::geometric;
  for (const double level : choose_levels(plot)) {
    const double mantissa = level / std::pow(10, std::floor(std::log10(level) + 1e-9));
    EXPECT_TRUE(std::abs(mantissa - 1) < 1e-9 || std::abs(mantissa - 2) < 1e-9 || std::abs(mantissa - 5) < 1e-9);
  }
}

TEST(Ticks, AreMultiplesOfOneTwoOrFiveInTheRange) {
  Rng rng(3);
  for (int round = 0; round < 500; ++round) {
    const double size = std::pow(10, rng.uniform(-12, 12));
    const double low = rng.uniform(-1, 1) * size, high = low + rng.uniform(0.01, 1) * size;
    const double most = rng.uniform(2, 12);
    const Ticks ticks = linear_ticks({low, high}, most);
    const double step = nice_step(high - low, most);
    const double mantissa = step / std::pow(10, std::floor(std::log10(step) + 1e-9));
    EXPECT_TRUE(std::abs(mantissa - 1) < 1e-9 || std::abs(mantissa - 2) < 1e-9 || std::abs(mantissa - 5) < 1e-9);
    EXPECT_LE(ticks.ticks.size(), most + 1);
    EXPECT_GE(static_cast<double>(ticks.ticks.size()), std::floor((high - low) / step)) << "every multiple";
    std::set<std::string> labels;
    for (const Tick& tick : ticks.ticks) {
      EXPECT_GE(tick.value, low - 1e-8 * step);
      EXPECT_LE(tick.value, high + 1e-8 * step);
      EXPECT_NEAR(tick.value / step, std::round(tick.value / step), 1e-6);
      EXPECT_TRUE(labels.insert(tick.label).second) << tick.label << " twice, " << low << " … " << high;
    }
  }
}

TEST(Ticks, OfALogarithmicAxisAreDecades) {
  const auto labels = [](const Ticks& ticks) {
    std::vector<std::string> result;
    for (const Tick& tick : ticks.ticks) {
      if (!tick.label.empty()) result.push_back(tick.label);
    }
    return result;
  };
  EXPECT_EQ(labels(log_ticks({0.05, 200}, 6)), (std::vector<std::string>{"0.1", "1", "10", "100"}));
  EXPECT_EQ(labels(log_ticks({1, 10}, 6)), (std::vector<std::string>{"1", "2", "5", "10"}));
  EXPECT_EQ(labels(log_ticks({1e-12, 1}, 4)), (std::vector<std::string>{"10^{−10}", "10^{−5}", "1"}));
}

TEST(PlotText, NumbersAreShortAndExactEnough) {
  EXPECT_EQ(number_label(0), "0");
  EXPECT_EQ(number_label(-2.5), "−2.5");
  EXPECT_EQ(number_label(1.0 / 3), "0.3333");
  EXPECT_EQ(number_label(1e6), "10^{6}");
  EXPECT_EQ(number_label(-2e-7), "−2·10^{−7}");
  EXPECT_EQ(fixed_label(-0.001, 1), "0.0");
}

TEST(PlotText, LoweredAndRaisedPartsReturnToTheBaseline) {
  EXPECT_EQ(rich_text("a < b"), "a &lt; b");
  const std::string svg = rich_text("E_{F}^{1} x");
  EXPECT_EQ(count(svg, "<tspan"), 3u);
  EXPECT_NE(svg.find(">F</tspan>"), std::string::npos);
  EXPECT_EQ(rich_text("open_{brace"), "open_{brace");
  EXPECT_LT(text_width("E_{F}", 10), text_width("EF", 10));
  EXPECT_LT(text_width("E_{F}", 10), text_width("E_{FF}", 10));
}

TEST(Grid, IdsStayUniqueAndReferencesFindThem) {
  const std::vector<std::string> inner = {line_plot_svg(curves()), contour_plot_svg(landscape()),
                                          draw_svg(test::lattice({.n = 4}))};
  const std::string two = grid_svg(inner, 2, "inner");
  const std::vector<std::string> outer = {two, two, inner[0]};
  const std::string svg = grid_svg(outer, 3, "a < b");
  expect_well_formed(svg);
  std::set<std::string> ids;
  std::size_t references = 0;
  for (std::size_t at = svg.find(" id=\""); at != std::string::npos; at = svg.find(" id=\"", at + 1)) {
    const std::string id = svg.substr(at + 5, svg.find('"', at + 5) - at - 5);
    EXPECT_TRUE(ids.insert(id).second) << id;
    EXPECT_EQ(count(svg, "url(#" + id + ")"), 1u) << id;
  }
  references = count(svg, "url(#");
  EXPECT_EQ(ids.size(), 7u);
  EXPECT_EQ(references, ids.size());
}

TEST(Grid, TextThatLooksLikeAnIdIsLeftAlone) {
  LinePlot plot;
  plot.title = " id=\"plot\" url(#plot)";
  EXPECT_NE(grid_svg(std::vector<std::string>{line_plot_svg(plot)}, 1).find("id=\"plot\" url(#plot)"),
            std::string::npos);
}

TEST(Grid, CellsAreAsLargeAsTheLargestOfTheirRowAndColumn) {
  LinePlot small, wide;
  small.width = 200;
  small.height = 150;
  wide.width = 500;
  wide.height = 100;
  const std::vector<std::string> svgs = {line_plot_svg(small), line_plot_svg(wide), line_plot_svg(wide)};
  const std::string svg = grid_svg(svgs, 2);
  EXPECT_NE(svg.find("viewBox=\"0 0 1000 250\""), std::string::npos) << svg.substr(0, 200);
  EXPECT_NE(svg.find("<svg x=\"150\" y=\"0\""), std::string::npos) << "centered in its column";
}

}  // namespace
}  // namespace temper
