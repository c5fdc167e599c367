// temper draw IN -o P.svg: one mesh, or two side by side.
#include <fmt/format.h>

#include "console.hpp"
#include "help.hpp"
#include "input.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "temper/draw.hpp"

namespace temper::app {
namespace {

struct Settings {
  std::string input, before, output;
  DrawOptions options;
  bool no_primal = false, no_dual = false, no_weights = false, no_bad = false, no_rings = false, no_regions = false;
};

void add_options(CLI::App& app, Settings& s) {
  app.set_help_flag();
  app.option_defaults()->group("Files");
  app.add_option("IN", s.input, "the mesh to draw")->required();
  add_text(app, "-o,--output", "FILE", s.output, "where the SVG goes")->required();
  add_text(app, "--before", "IN0", s.before, "a mesh to draw to the left of it, to the same scale");
  app.option_defaults()->group("Picture");
  app.add_flag("--no-primal", s.no_primal, "without the triangles' edges");
  app.add_flag("--no-dual", s.no_dual, "without the dual edges, between orthocenters");
  app.add_flag("--no-weights", s.no_weights, "without the weight circles (green positive, red negative)");
  app.add_flag("--no-bad", s.no_bad, "do not fill triangles that are not well-centered");
  app.add_flag("--no-rings", s.no_rings, "do not ring vertices that nearly coincide with a neighbour");
  app.add_flag("--no-regions", s.no_regions, "do not tint regions");
  app.add_flag("--numbers", s.options.vertex_numbers, "number the vertices, from 0");
  add_number(app, "--weight-scale", s.options.weight_scale, kPositive, "factor on the radius of weight circles");
  add_numbers(
      app, "--zoom", "x0,y0,x1,y1", 4,
      [&s](const std::vector<double>& v) {
        s.options.zoom = Box{{v[0], v[1]}, {v[2], v[3]}};
      },
      "draw only what meets this rectangle");
  add_number(app, "--width", s.options.width, kPositive, "of one panel, in CSS pixels");
  add_text(app, "--title", "TEXT", s.options.title, "under the picture");
  app.option_defaults()->group("Help");
  app.set_help_flag("-h,--help", "this text");
  set_help(app, {"IN -o FILE [options]",
                 "  temper draw in.vtu -o mesh.svg\n"
                 "  temper draw out.vtu --before in.vtu -o both.svg --title \"before and after\"\n"
                 "  temper draw in.vtu -o corner.svg --zoom 0,0,0.5,0.5 --numbers --no-weights\n",
                 {Exit::done, Exit::bad_input, Exit::bad_usage, Exit::internal}});
}

void check_zoom(const DrawOptions& options) {
  if (!options.zoom) return;
  const Box& box = *options.zoom;
  if (box.low.x < box.high.x && box.low.y < box.high.y) return;
  throw Failure(Exit::bad_usage, "draw: --zoom: it must have x0 < x1 and y0 < y1\nSee temper draw --help");
}

}  // namespace

Exit run_draw(const Arguments& arguments) {
  CLI::App app("Draws triangles, the dual between orthocenters, and weights as circles, as SVG.", "draw");
  Settings s;
  add_options(app, s);
  if (!parse(app, arguments)) return Exit::done;
  s.options.primal = !s.no_primal;
  s.options.dual = !s.no_dual;
  s.options.weights = !s.no_weights;
  s.options.bad_triangles = !s.no_bad;
  s.options.near_coincident = !s.no_rings;
  s.options.regions = !s.no_regions;
  check_zoom(s.options);
  Outputs outputs("draw");
  outputs.expect_text("--output", s.output, s.before.empty() ? Arguments{s.input} : Arguments{s.input, s.before});

  const Input input = read_input(s.input);
  print_warnings(input.warnings());
  if (s.before.empty()) {
    outputs.write_text(s.output, draw_svg(input.mesh(), s.options));
  } else {
    const Input before = read_input(s.before);
    print_warnings(before.warnings());
    outputs.write_text(s.output, draw_before_after_svg(before.mesh(), input.mesh(), s.options));
  }
  return Exit::done;
}

}  // namespace temper::app
