// temper example NAME -o OUT: the generators of generate.hpp, each with its parameters.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "console.hpp"
#include "files/outputs.hpp"
#include "help/help.hpp"
#include "options/options.hpp"
#include "temper/detail/suggest.hpp"
#include "temper/generate.hpp"
#include "temper/io.hpp"
#include "temper/mesher.hpp"

namespace temper::app {
namespace {

constexpr std::uint64_t kLeastVertices = 3;

struct ExampleSettings {
  MeshOutput output;
  bool list = false;
  Horseshoe horseshoe;
  SingleTriangle triangle;
  std::uint64_t vertices = RandomMesh().vertices;
  RandomMesh random;
  Icosahedral icosahedral;
  RandomSphere random_sphere;
  GradedSphere graded_sphere;
  std::uint64_t graded_vertices = GradedSphere().vertices;
  ShearedGrid grid;
  Annulus annulus;
  Airfoil airfoil;
  RegularPolygon polygon;
  Wedge wedge;
  GradedMesh graded;
  RandomPeriodic random_periodic;
  PeriodicHexagons periodic_hexagons;
};

using Range = std::array<double, 2>;

std::function<void(const std::vector<double>&)> into(Range& target) {
  return [&target](const std::vector<double>& values) { target = {values[0], values[1]}; };
}

void add_horseshoe(Command& command, ExampleSettings& s) {
  add_count(command, "--a", s.horseshoe.a, 2, "Number of points along each arch.");
  add_count(command, "--b", s.horseshoe.b, 2, "Number of arches.");
  add_numbers(command, "--x", "X0,X1", 2, into(s.horseshoe.x), "Horizontal semi-axes of the inner and the outer arch.")
      .default_text = "1,2";
  add_numbers(command, "--y", "Y0,Y1", 2, into(s.horseshoe.y), "Vertical semi-axes of the inner and the outer arch.")
      .default_text = "1,4";
}

void add_triangle(Command& command, ExampleSettings& s) {
  add_number(command, "--a", s.triangle.a, kPositive, "Length of one side at vertex 0.");
  add_number(command, "--b", s.triangle.b, kPositive, "Length of the other side at vertex 0.");
  add_number(command, "--angle", s.triangle.angle_deg, {0, 180, true}, "Angle between the two sides, in degrees.");
}

void add_random(Command& command, ExampleSettings& s) {
  add_count(command, "--vertices", s.vertices, kLeastVertices, "Number of vertices.");
  add_count(command, "--seed", s.random.seed, 0, "Seed of the random points.");
  const auto use = [&s](const std::vector<double>& v) {
    s.random.polygon.clear();
    for (std::size_t i = 0; i + 1 < v.size(); i += 2) s.random.polygon.push_back({v[i], v[i + 1]});
  };
  add_numbers(command, "--polygon", "x,y,x,y,...", 0, use, "Outline, counter-clockwise. (default: an L with a notch)");
}

void add_sheared_grid(Command& command, ExampleSettings& s) {
  add_count(command, "--nx", s.grid.nx, 1, "Number of squares across.");
  add_count(command, "--ny", s.grid.ny, 1, "Number of squares up.");
  add_number(command, "--shear", s.grid.shear, kAnyNumber, "Shear s: x becomes x + s y.");
}

void add_annulus(Command& command, ExampleSettings& s) {
  add_number(command, "--inner", s.annulus.inner, kPositive, "Inner radius.");
  add_number(command, "--outer", s.annulus.outer, kPositive, "Outer radius.");
  add_count(command, "--around", s.annulus.around, 3, "Number of points on a ring.");
  add_count(command, "--rings", s.annulus.rings, 2, "Number of rings.");
  add_number(command, "--jitter", s.annulus.jitter, kNotNegative,
             "Jitter of the inner rings, as a fraction of the spacing.");
  add_count(command, "--seed", s.annulus.seed, 0, "Seed of the jitter.");
}

void add_airfoil(Command& command, ExampleSettings& s) {
  add_count(command, "--around", s.airfoil.around, 3, "Number of points on the airfoil.");
  add_number(command, "--growth", s.airfoil.growth, {1, std::numeric_limits<double>::infinity(), true},
             "Ratio of the spacing of a layer to the spacing of the layer before.");
  add_count(command, "--seed", s.airfoil.seed, 0, "Seed of the points between.");
}

void add_polygon(Command& command, ExampleSettings& s) {
  add_count(command, "--corners", s.polygon.corners, 3, "Number of corners.");
}

void add_wedge(Command& command, ExampleSettings& s) {
  add_number(command, "--angle", s.wedge.angle_deg, {0, 180, true}, "Angle of the corner, in degrees.");
  add_count(command, "--pieces", s.wedge.pieces, 1,
            "Number of edges on each of the two sides at the corner, and number of points inside.");
  add_count(command, "--seed", s.wedge.seed, 0, "Seed of the points inside.");
}

void add_graded(Command& command, ExampleSettings& s) {
  add_number(command, "--finest", s.graded.finest, kPositive, "Size of triangles at one corner of the unit square.");
  add_number(command, "--growth", s.graded.growth, kNotNegative,
             "Growth of the size with the distance from that corner.");
  add_count(command, "--seed", s.graded.seed, 0, "Seed of the points.");
}

void add_radius(Command& command, double& radius) {
  add_number(command, "--radius", radius, kPositive, "Radius of the sphere.");
}

void add_icosahedral(Command& command, ExampleSettings& s) {
  add_count(command, "--level", s.icosahedral.level, 0,
            "Number of times that triangles are cut into four. The mesh has 10 4^level + 2 vertices.");
  add_radius(command, s.icosahedral.radius);
}

void add_random_sphere(Command& command, ExampleSettings& s) {
  add_count(command, "--vertices", s.vertices, 20, "Number of vertices.");
  add_count(command, "--seed", s.random_sphere.seed, 0, "Seed of the random points.");
  add_radius(command, s.random_sphere.radius);
}

void add_graded_sphere(Command& command, ExampleSettings& s) {
  add_count(command, "--vertices", s.graded_vertices, 20, "Number of vertices.");
  add_number(command, "--ratio", s.graded_sphere.ratio, {1, 1000, false}, "Ratio of the largest size to the least.");
  add_numbers(
      command, "--at", "LON,LAT", 2,
      [&s](const std::vector<double>& v) {
        s.graded_sphere.at = {v[0], v[1]};
      },
      "Place of the least size, in degrees.")
      .default_text = "0,0";
  add_count(command, "--seed", s.graded_sphere.seed, 0, "Seed of the random points.");
  add_radius(command, s.graded_sphere.radius);
}

Expected<Mesh> make_graded_sphere(ExampleSettings& s) {
  s.graded_sphere.vertices = s.graded_vertices;
  return graded_sphere(s.graded_sphere);
}

Expected<Mesh> make_random_sphere(ExampleSettings& s) {
  s.random_sphere.vertices = s.vertices;
  return random_sphere(s.random_sphere);
}

void add_random_periodic(Command& command, ExampleSettings& s) {
  add_count(command, "--vertices", s.vertices, 16, "Number of vertices.");
  add_count(command, "--seed", s.random_periodic.seed, 0, "Seed of the random points.");
  add_numbers(
      command, "--period", "X,Y", 2,
      [&s](const std::vector<double>& v) {
        s.random_periodic.period = {v[0], v[1]};
      },
      "Periods along x and y.")
      .default_text = "1,1";
}

void add_periodic_hexagons(Command& command, ExampleSettings& s) {
  add_count(command, "--nx", s.periodic_hexagons.nx, 3, "Number of hexagons in a row.");
  add_count(command, "--ny", s.periodic_hexagons.ny, 2,
            "Number of rows. It must be even if the plane is periodic along y.");
  add_number(command, "--distance", s.periodic_hexagons.distance, kPositive, "Distance between neighbors.");
  command.add_flag("--channel", s.periodic_hexagons.channel,
                   "Make a channel without a period along y. The first and the last row are its shores.");
}

Expected<Mesh> make_random_periodic(ExampleSettings& s) {
  s.random_periodic.vertices = s.vertices;
  return random_periodic(s.random_periodic);
}

double size_of_graded_sphere(const ExampleSettings& s, const Mesh& mesh, VertexId v) {
  return graded_sphere_size(s.graded_sphere, mesh.weighted_vector(v));
}

Expected<Mesh> make_random(ExampleSettings& s) {
  s.random.vertices = s.vertices;
  return random_mesh(s.random);
}

double vertices_asked(const ExampleSettings& s) { return static_cast<double>(s.vertices); }

/// At most: some points inside, and four sides in steps of finest + growth r, where r is the distance.
double vertices_of_graded(const ExampleSettings& s) {
  constexpr double kInside = 20'000;
  const double f = s.graded.finest, g = s.graded.growth;
  return kInside + 4 * (g > 0 ? std::log1p(g / f) / g : 1 / f);
}

struct Generator {
  const char* name;
  const char* description;
  void (*add_options)(Command&, ExampleSettings&);
  Expected<Mesh> (*make)(ExampleSettings&);
  double (*vertices)(const ExampleSettings&) = nullptr;                     ///< about, if it has no limit by itself
  double (*size)(const ExampleSettings&, const Mesh&, VertexId) = nullptr;  ///< what its points follow, if anything
};

constexpr Generator kGenerators[] = {
    {"sparse-horseshoe", "the paper's horseshoe of 5 vertices and 4 triangles", [](Command&, ExampleSettings&) {},
     [](ExampleSettings&) -> Expected<Mesh> { return sparse_horseshoe(); }},
    {"horseshoe", "the paper's parameterized horseshoe, constrained Delaunay", add_horseshoe,
     [](ExampleSettings& s) { return horseshoe(s.horseshoe); },
     [](const ExampleSettings& s) { return 1.0 * s.horseshoe.a * s.horseshoe.b; }},
    {"triangle", "a single triangle", add_triangle, [](ExampleSettings& s) { return single_triangle(s.triangle); }},
    {"random", "random points in a polygon, Delaunay: about half of the triangles are bad", add_random, make_random,
     vertices_asked},
    {"sheared-grid", "squares cut along one diagonal, then sheared", add_sheared_grid,
     [](ExampleSettings& s) { return sheared_grid(s.grid); },
     [](const ExampleSettings& s) { return (s.grid.nx + 1.0) * (s.grid.ny + 1.0); }},
    {"annulus", "jittered rings between two circles", add_annulus,
     [](ExampleSettings& s) { return annulus(s.annulus); },
     [](const ExampleSettings& s) { return 1.0 * s.annulus.around * s.annulus.rings; }},
    {"airfoil", "a box with an airfoil-like hole, graded", add_airfoil,
     [](ExampleSettings& s) { return airfoil(s.airfoil); }},
    {"polygon", "a regular polygon without a vertex inside", add_polygon,
     [](ExampleSettings& s) { return regular_polygon(s.polygon); },
     [](const ExampleSettings& s) { return 1.0 * s.polygon.corners; }},
    {"letter-a", "a letter A of 29 triangles without a vertex inside", [](Command&, ExampleSettings&) {},
     [](ExampleSettings&) -> Expected<Mesh> { return letter_a(); }},
    {"wedge", "a triangle with a sharp corner, and random points inside", add_wedge,
     [](ExampleSettings& s) { return wedge(s.wedge); }, [](const ExampleSettings& s) { return 3.0 * s.wedge.pieces; }},
    {"graded", "random points in a square, finer towards one corner", add_graded,
     [](ExampleSettings& s) { return graded_mesh(s.graded); }, vertices_of_graded},
    {"icosahedral", "the bisected icosahedron, a mesh of the sphere", add_icosahedral,
     [](ExampleSettings& s) { return icosahedral(s.icosahedral); },
     [](const ExampleSettings& s) { return 10 * std::exp2(2.0 * s.icosahedral.level) + 2; }},
    {"random-sphere", "random points around the sphere, Delaunay: about half of the triangles are bad",
     add_random_sphere, make_random_sphere, vertices_asked},
    {"graded-sphere", "random points around the sphere, finer towards one place, with their sizes", add_graded_sphere,
     make_graded_sphere, [](const ExampleSettings& s) { return 1.0 * static_cast<double>(s.graded_vertices); },
     size_of_graded_sphere},
    {"random-periodic", "random points in a periodic plane, Delaunay: about half of the triangles are bad",
     add_random_periodic, make_random_periodic, vertices_asked},
    {"periodic-hexagons", "rows of hexagons in a periodic plane or a channel", add_periodic_hexagons,
     [](ExampleSettings& s) { return periodic_hexagons(s.periodic_hexagons); },
     [](const ExampleSettings& s) { return 1.0 * s.periodic_hexagons.nx * s.periodic_hexagons.ny; }},
};

void add_options(Command& command, ExampleSettings& s) {
  command.group("Options");
  add_mesh_output(command, s.output, "OUT");
  command.add_flag("--list", s.list, "List the examples.");
  command.add_help({"NAME -o OUT [options of NAME]",
                    "  temper example --list\n"
                    "  temper example sparse-horseshoe -o sparse.vtu\n"
                    "  temper example horseshoe --a 7 --b 9 --x 1,2 --y 1,4 -o horseshoe.vtu\n"
                    "  temper example random --vertices 500 --seed 7 -o random.msh\n",
                    {Exit::done, Exit::bad_input, Exit::bad_usage, Exit::internal}});
  for (const Generator& generator : kGenerators) {
    generator.add_options(command.add_subcommand(generator.name, generator.description), s);
  }
}

const Generator& chosen(const Command& command) {
  std::vector<std::string_view> names;
  for (const Generator& generator : kGenerators) {
    if (command.chosen() != nullptr && command.chosen()->name() == generator.name) return generator;
    names.emplace_back(generator.name);
  }
  refuse_usage("example", "NAME is missing: one of " + join(names));
}

/// The parser reports a misspelled name only as an unexpected argument: suggest a similar name.
void check_name(const Arguments& arguments) {
  if (arguments.empty() || arguments.front().starts_with("-")) return;
  std::vector<std::string_view> names;
  for (const Generator& generator : kGenerators) names.emplace_back(generator.name);
  if (std::find(names.begin(), names.end(), arguments.front()) == names.end())
    refuse_usage("example", none_of(arguments.front(), names));
}

/// The mesh, with sizes as point data for `--size` and `--size-field`.
io::MeshFile file_of(const Mesh& mesh, const Generator& generator, const ExampleSettings& s) {
  io::MeshFile file = io::from_mesh(mesh);
  if (generator.size == nullptr) return file;
  std::vector<double> sizes;
  for (const VertexId v : mesh.vertices()) sizes.push_back(generator.size(s, mesh, v));
  file.point_data.push_back({"size", 1, std::move(sizes)});
  return file;
}

/// Refuses meshes that do not fit in the memory.
void check_memory(const Generator& generator, const ExampleSettings& s) {
  constexpr double kBytesPerVertex = 300;  // measured: 150 to 250, to make and to write
  const auto free = io::free_memory();
  if (generator.vertices == nullptr || !free) return;
  const double vertices = generator.vertices(s), bytes = kBytesPerVertex * vertices;
  const auto free_bytes = static_cast<double>(*free);
  if (bytes <= free_bytes) return;
  refuse_usage("example",
               fmt::format("{}: about {} vertices need about {} of memory, but {} are free. Next: at most {} vertices",
                           generator.name, MeshEstimate{vertices, 0}.triangles_text(),
                           MeshEstimate{0, bytes}.memory_text(), MeshEstimate{0, free_bytes}.memory_text(),
                           MeshEstimate{free_bytes / kBytesPerVertex, 0}.triangles_text()));
}

}  // namespace

Exit run_example(const Arguments& arguments) {
  Command command("example",
                  "Makes an example mesh: a mesh of the paper, or a mesh of a class that tests a mesh method.");
  ExampleSettings s;
  add_options(command, s);
  check_name(arguments);
  if (!command.parse(arguments)) return Exit::done;
  if (s.list) {
    for (const Generator& generator : kGenerators)
      print(fmt::format("{:<18}{}\n", generator.name, generator.description));
    return Exit::done;
  }
  const Generator& generator = chosen(command);
  if (s.output.path.empty()) refuse_usage("example", "--output is required");
  Outputs outputs("example");
  outputs.expect_mesh(s.output);

  check_memory(generator, s);
  const Expected<Mesh> mesh = generator.make(s);
  if (!mesh)
    refuse_usage("example", std::string(generator.name) + ": " + mesh.error().what());  // options are its only input
  print_warnings(outputs.write_mesh(s.output, file_of(*mesh, generator, s)));
  return Exit::done;
}

}  // namespace temper::app
