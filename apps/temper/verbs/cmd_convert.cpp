// temper convert IN -o OUT: the same file in another format, with warnings about everything that the format cannot
// hold.
#include <fmt/format.h>

#include <memory>
#include <type_traits>
#include <variant>

#include "console.hpp"
#include "files/input.hpp"
#include "files/outputs.hpp"
#include "help/help.hpp"
#include "options/options.hpp"
#include "temper/detail/file_cures.hpp"
#include "threads.hpp"

namespace temper::app {
namespace {

struct ConvertSettings {
  std::string projection;
  Heights heights;
  std::string input;
  MeshOutput output;
  std::optional<double> merge;
  bool flip_flat = false;
  std::uint64_t threads = 0;
};

void add_options(Command& command, ConvertSettings& s) {
  command.group("Files");
  add_argument(command, "IN", s.input, "File to read, of " + any_elements() + ". Its content shows the format.")
      .require();
  add_projection(command, s.projection);
  add_heights(command, s.heights);
  add_mesh_output(command, s.output, "OUT", "File to write. Its suffix selects the format.");
  command.option("--output").require();
  add_number(command, "--merge", s.merge, kNotNegative,
             "Make points one that are at most this far apart, in the units of IN. This closes cracks.");
  command
      .add_flag("--flip-flat", s.flip_flat,
                "Flip away triangles of zero area or turned over, after --merge. Coordinates with few digits make "
                "them. All points stay.")
      .cells = CellKinds::triangles;
  add_threads(command, s.threads);
  command.group("Help");
  command.add_help({"IN -o OUT [options]",
                    "  temper convert in.vtu -o out.msh\n"
                    "  temper convert in.vtu -o out.vtu --encoding ascii\n"
                    "  temper convert in.vtu -o old.msh --format gmsh22\n"
                    "  temper convert in.vtu -o whole.vtu --merge 1e-8\n"
                    "  temper convert in.off -o out.off --flip-flat\n"
                    "  temper convert hgrid.2dm -o hgrid.gr3 --positive down\n",
                    {Exit::done, Exit::bad_input, Exit::bad_usage, Exit::internal}});
}

}  // namespace

Exit run_convert(const Arguments& arguments) {
  Command command("convert",
                  "Writes a mesh file in another format. Weights, tags, regions, names and data are kept. If the new "
                  "format cannot hold something, a warning names it.");
  ConvertSettings s;
  add_options(command, s);
  if (!command.parse(arguments)) return Exit::done;
  Outputs outputs("convert");
  outputs.expect_mesh(s.output);

  const std::unique_ptr<Executor> threads = make_threads(s.threads);
  io::MeshFile file = read_tried(s.input, s.heights.to_read(threads.get()));
  take_to_sphere(file, s.input, s.projection);
  command.expect_for(cells_of(file), s.input);
  const std::size_t merged = s.merge ? or_fail(io::merge_points(file, *s.merge)) : 0;
  const std::size_t flipped = s.flip_flat ? or_fail(io::flip_flat_triangles(file)) : 0;
  if (!s.projection.empty()) take_to_map(file, s.input, s.projection);
  print_warnings(file.warnings);
  print_warnings(outputs.write_mesh(s.output, file, threads.get()));
  if (s.merge) print(fmt::format("{} merged\n", plural(merged, "point", "points")));
  if (s.flip_flat) print(fmt::format("{} flipped away\n", plural(flipped, "triangle", "triangles")));
  return Exit::done;
}

}  // namespace temper::app
