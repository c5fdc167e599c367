// temper example NAME -o OUT: the generators of generate.hpp, each with its parameters.
#include <fmt/format.h>

#include "console.hpp"
#include "help.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "temper/generate.hpp"

namespace temper::app {
namespace {

constexpr std::uint64_t kLeastVertices = 3;

struct Settings {
  std::string output;
  bool list = false;
  Horseshoe horseshoe;
  SingleTriangle triangle;
  std::uint64_t vertices = RandomPoints().vertices;
  RandomPoints random;
  ShearedGrid grid;
  Annulus annulus;
  Airfoil airfoil;
  RegularPolygon polygon;
  Wedge wedge;
  GradedPoints graded;
};

using Range = std::array<double, 2>;

std::function<void(const std::vector<double>&)> into(Range& target) {
  return [&target](const std::vector<double>& values) { target = {values[0], values[1]}; };
}

void add_horseshoe(CLI::App& app, Settings& s) {
  add_count(app, "--a", s.horseshoe.a, 2, "points along each arch");
  add_count(app, "--b", s.horseshoe.b, 2, "arches");
  add_numbers(app, "--x", "X0,X1", 2, into(s.horseshoe.x), "horizontal semi-axes of the inner and the outer arch")
      ->default_str("1,2");
  add_numbers(app, "--y", "Y0,Y1", 2, into(s.horseshoe.y), "vertical semi-axes of the inner and the outer arch")
      ->default_str("1,4");
}

void add_triangle(CLI::App& app, Settings& s) {
  add_number(app, "--a", s.triangle.a, kPositive, "one side at vertex 0");
  add_number(app, "--b", s.triangle.b, kPositive, "the other side");
  add_number(app, "--angle", s.triangle.angle_deg, {0, 180, true}, "between them, in degrees");
}

void add_random(CLI::App& app, Settings& s) {
  add_count(app, "--vertices", s.vertices, kLeastVertices, "vertices in all");
  add_count(app, "--seed", s.random.seed, 0, "of the random points");
  const auto use = [&s](const std::vector<double>& v) {
    s.random.polygon.clear();
    for (std::size_t i = 0; i + 1 < v.size(); i += 2) s.random.polygon.push_back({v[i], v[i + 1]});
  };
  add_numbers(app, "--polygon", "x,y,x,y,...", 0, use, "the outline, counter-clockwise (default: an L with a notch)");
}

void add_sheared_grid(CLI::App& app, Settings& s) {
  add_count(app, "--nx", s.grid.nx, 1, "squares across");
  add_count(app, "--ny", s.grid.ny, 1, "squares up");
  add_number(app, "--shear", s.grid.shear, kAnyNumber, "x += shear * y");
}

void add_annulus(CLI::App& app, Settings& s) {
  add_number(app, "--inner", s.annulus.inner, kPositive, "inner radius");
  add_number(app, "--outer", s.annulus.outer, kPositive, "outer radius");
  add_count(app, "--around", s.annulus.around, 3, "points on a ring");
  add_count(app, "--rings", s.annulus.rings, 2, "rings");
  add_number(app, "--jitter", s.annulus.jitter, kNotNegative, "of inner rings, times the spacing");
  add_count(app, "--seed", s.annulus.seed, 0, "of the jitter");
}

void add_airfoil(CLI::App& app, Settings& s) {
  add_count(app, "--around", s.airfoil.around, 3, "points on the foil");
  add_number(app, "--growth", s.airfoil.growth, {1, std::numeric_limits<double>::infinity(), true},
             "ratio of one layer's spacing to the one before");
  add_count(app, "--seed", s.airfoil.seed, 0, "of the points between");
}

void add_polygon(CLI::App& app, Settings& s) { add_count(app, "--corners", s.polygon.corners, 3, "of the polygon"); }

void add_wedge(CLI::App& app, Settings& s) {
  add_number(app, "--angle", s.wedge.angle_deg, {0, 180, true}, "of the corner, in degrees");
  add_count(app, "--pieces", s.wedge.pieces, 1, "edges on each of the two sides at the corner, and points inside");
  add_count(app, "--seed", s.wedge.seed, 0, "of the points inside");
}

void add_graded(CLI::App& app, Settings& s) {
  add_number(app, "--finest", s.graded.finest, kPositive, "size of triangles at one corner of the unit square");
  add_number(app, "--growth", s.graded.growth, kNotNegative, "of the size with the distance from there");
  add_count(app, "--seed", s.graded.seed, 0, "of the points");
}

Expected<Mesh> make_random(Settings& s) {
  s.random.vertices = s.vertices;
  return random_points(s.random);
}

struct Generator {
  const char* name;
  const char* description;
  void (*add_options)(CLI::App&, Settings&);
  Expected<Mesh> (*make)(Settings&);
};

constexpr Generator kGenerators[] = {
    {"sparse-horseshoe", "the paper's horseshoe of 5 vertices and 4 triangles", [](CLI::App&, Settings&) {},
     [](Settings&) -> Expected<Mesh> { return sparse_horseshoe(); }},
    {"horseshoe", "the paper's parameterised horseshoe, constrained Delaunay", add_horseshoe,
     [](Settings& s) { return horseshoe(s.horseshoe); }},
    {"triangle", "a single triangle", add_triangle, [](Settings& s) { return single_triangle(s.triangle); }},
    {"random", "random points in a polygon, Delaunay: about half of the triangles are bad", add_random, make_random},
    {"sheared-grid", "squares cut along one diagonal, then sheared", add_sheared_grid,
     [](Settings& s) { return sheared_grid(s.grid); }},
    {"annulus", "jittered rings between two circles", add_annulus, [](Settings& s) { return annulus(s.annulus); }},
    {"airfoil", "a box with an airfoil-like hole, graded", add_airfoil, [](Settings& s) { return airfoil(s.airfoil); }},
    {"polygon", "a regular polygon without a vertex inside", add_polygon,
     [](Settings& s) { return regular_polygon(s.polygon); }},
    {"letter-a", "a letter A of 29 triangles without a vertex inside", [](CLI::App&, Settings&) {},
     [](Settings&) -> Expected<Mesh> { return letter_a(); }},
    {"wedge", "a triangle with a sharp corner, and random points inside", add_wedge,
     [](Settings& s) { return wedge(s.wedge); }},
    {"graded", "random points in a square, finer towards one corner", add_graded,
     [](Settings& s) { return graded_points(s.graded); }},
};

void add_options(CLI::App& app, Settings& s) {
  app.set_help_flag();
  app.option_defaults()->group("Options");
  add_text(app, "-o,--output", "OUT", s.output, "where the mesh goes; its suffix tells the format");
  app.add_flag("--list", s.list, "list the examples");
  app.set_help_flag("-h,--help", "this text");
  set_help(app, {"NAME -o OUT [options of NAME]",
                 "  temper example --list\n"
                 "  temper example sparse-horseshoe -o sparse.vtu\n"
                 "  temper example horseshoe --a 7 --b 9 --x 1,2 --y 1,4 -o horseshoe.vtu\n"
                 "  temper example random --vertices 500 --seed 7 -o random.msh\n",
                 {Exit::done, Exit::bad_input, Exit::bad_usage, Exit::internal}});
  app.require_subcommand(0, 1);
  for (const Generator& generator : kGenerators) {
    CLI::App* inner = app.add_subcommand(generator.name, generator.description);
    inner->set_help_flag();
    inner->option_defaults()->group("Options");
    generator.add_options(*inner, s);
    inner->fallthrough();
  }
}

[[noreturn]] void bad_usage(const std::string& message) {
  throw Failure(Exit::bad_usage, "example: " + message + "\nSee temper example --help");
}

const Generator& chosen(const CLI::App& app) {
  std::vector<std::string_view> names;
  const std::vector<CLI::App*> inner = app.get_subcommands();
  for (const Generator& generator : kGenerators) {
    if (!inner.empty() && inner.front()->get_name() == generator.name) return generator;
    names.push_back(generator.name);
  }
  bad_usage("NAME is missing: one of " + join(names));
}

/// CLI11 knows a misspelt name only as an unexpected argument: say what could have been meant.
void check_name(const Arguments& arguments) {
  if (arguments.empty() || arguments.front().starts_with("-")) return;
  std::vector<std::string_view> names;
  for (const Generator& generator : kGenerators) names.push_back(generator.name);
  if (std::find(names.begin(), names.end(), arguments.front()) == names.end())
    bad_usage(none_of(arguments.front(), names));
}

}  // namespace

Exit run_example(const Arguments& arguments) {
  CLI::App app("Makes an example mesh: the paper's, and the classes that a mesh method should be tried on.", "example");
  Settings s;
  add_options(app, s);
  check_name(arguments);
  if (!parse(app, arguments)) return Exit::done;
  if (s.list) {
    for (const Generator& generator : kGenerators)
      print(fmt::format("{:<18}{}\n", generator.name, generator.description));
    return Exit::done;
  }
  const Generator& generator = chosen(app);
  if (s.output.empty()) bad_usage("--output is required");
  Outputs outputs("example");
  outputs.expect_mesh("--output", s.output);

  const Expected<Mesh> mesh = generator.make(s);
  if (!mesh) bad_usage(std::string(generator.name) + ": " + mesh.error().what());  // options are its only input
  print_warnings(outputs.write_mesh(s.output, io::from_mesh(*mesh)));
  return Exit::done;
}

}  // namespace temper::app
