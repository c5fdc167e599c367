#include "verbs/optimize_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "files/input.hpp"
#include "help/help.hpp"
#include "options/options.hpp"
#include "reports/reports.hpp"

namespace temper::app {
namespace {

void add_files(Command& command, OptimizeSettings& s) {
  command.group("Files");
  // These two are not marked as required: see take_input.
  add_argument(command, "IN", s.input, "Mesh to improve. Its content shows the format.");
  add_projection(command, s.projection);
  add_mesh_output(command, s.output, "OUT",
                  "File for the improved mesh, which may be IN. Its suffix selects the format.");
  add_point_data(command, s.point_data);
  add_text(command, "--report", "FILE", s.report, "JSON report: mesh before and after, history, command to run again.");
  add_text(command, "--html", "FILE", s.html,
           "HTML report: mesh before and after, measures, history, command to run again.");
  add_text(command, "--history", "FILE", s.history, "CSV file with one line per sweep.");
  add_text(command, "--trace", "FILE", s.trace,
           "File for every move, flip and removal, with one JSON object per line. temper replay reads it.");
  add_text(command, "--draw", "FILE", s.picture, "Picture (.svg, .png, .pdf) of the mesh before and after.");
#ifdef TEMPER_WITH_ERRORS
  command.add_flag("--measure-errors", s.measure_errors,
                   "Also measure the errors of solvers before and after, as temper errors does.");
#endif
  add_requirements(command, s.require).sentence =
      "Requirements, such as outside=0,min_h=0.05. If one is not met, exit with 3 after all files are written. See "
      "temper check --help.";
  command.add_flag("--quiet", s.quiet, "Print warnings and errors only.");
}

void add_constraints(Command& command, OptimizeSettings& s) {
  command.group("Constraints and sizes");
  add_texts(command, "--fix", "TAG ...", Values::words, s.fix,
            "Tags or physical names of vertices that keep their positions. Several may follow.");
  add_tensor(command, s.metric, "Make meshes well-centered");
  add_text(command, "--size-field", "FILE", s.size_field,
           "Mesh file whose point data give the target edge length at each point. Without it, the sizes of the input "
           "are used.");
  add_text(command, "--size-field-data", "NAME", s.size_data,
           "Name of these point data in the file of --size-field. (default: size)");
}

void add_run(Command& command, OptimizeSettings& s) {
  command.group("The run");
  add_count(command, "--threads", s.threads, 0,
            "Number of threads of each process. 0 uses all threads of the machine, or all that the process may use. "
            "The result does not depend on it.");
  add_number(
      command, "--save-every", s.save_every, kNotNegative,
      "Write the best mesh so far to OUT during the run, at most once in this many seconds. 0 writes every new one.");
  std::vector<std::string_view> names;
  std::string help = "Initial values of all options.";
  for (const Method& method : methods()) {
    names.push_back(method.name);
    help += fmt::format(" '{}': {}{}", method.name, method.sentence, method.sentence.ends_with('.') ? "" : ".");
  }
  // At once, before all other options are taken: options that are given override the method's.
  const auto take = [&s](std::string_view name) {
    s.method = &*std::find_if(methods().begin(), methods().end(), [&](const Method& m) { return m.name == name; });
    s.table.options = s.method->options();
  };
  Option& option = add_name(command, "--method", names, take, help);
  option.at_once = true;
  option.default_text = std::string(methods().front().name);
}

/// Rare options of this verb's own, which a first run does not need. The library's table marks its own rare options.
constexpr const char* kRare[] = {"--projection", "--format",     "--encoding",        "--point-data",
                                 "--history",    "--trace",      "--threads",         "--method",
                                 "--save-every", "--size-field", "--size-field-data", "--no-triangle-quality",
                                 "--tensor"};

/// Says whether writing puts a new file there: not on standard output, a pipe or a device.
bool is_replaced(const std::string& path) {
  std::error_code ignored;
  return path != kStandardOutput &&
         (!std::filesystem::exists(path, ignored) || std::filesystem::is_regular_file(path, ignored));
}

}  // namespace

Command optimize_command(OptimizeSettings& settings) {
  Command command("optimize",
                  "Moves vertices, changes weights and flips edges until every triangle is well-centered. The "
                  "orthocenter is then inside the triangle, and each dual edge crosses its edge. The boundary of the "
                  "domain stays bit for bit, unless --boundary allows changes.");
  add_files(command, settings);
  add_run(command, settings);
  add_constraints(command, settings);
  for (const OptionGroup& group : option_groups()) add_group(command, group, settings.table);
  for (const char* name : kRare) command.option(name).rare = true;
  command.group("Help");
  command.add_help(
      {"IN -o OUT [options]",
       "  temper optimize in.vtu -o out.vtu\n"
       "  temper optimize in.vtu -o out.vtu --report report.json --draw before-after.svg\n"
       "  temper optimize in.vtu -o out.vtu --html report.html\n"
       "  temper optimize in.vtu -o out.vtu --require outside=0,not_crossed=0\n"
       "  temper optimize in.vtu -o out.vtu --weights-only --no-flips\n"
       "  temper optimize in.vtu -o out.vtu --energy F --star 1 --solver golden --max-sweeps 20\n"
       "  temper optimize in.vtu -o out.vtu --gamma-rel 0.1 --time-limit 60\n"
       "  temper optimize in.vtu -o out.vtu --for vertex --measure-errors\n"
       "  temper optimize in.vtu -o out.vtu --removal patch --trace trace.jsonl\n"
       "  temper optimize in.vtu -o out.vtu --method paper --energy dT --removal none\n"
       "  temper optimize in.vtu -o out.vtu --save-every 600\n",
       {Exit::done, Exit::bad_input, Exit::bad_usage, Exit::requirement, Exit::stopped_early, Exit::internal}});
  return command;
}

void take_input(Command& command, OptimizeSettings& s) {
  if (s.output.path.empty()) refuse_usage("optimize", "--output is required");
  if (s.save_every && !is_replaced(s.output.path))
    throw Failure(
        Exit::bad_usage,
        fmt::format(
            "optimize: --save-every: {} is not a file that can be replaced. Next: give the name of a file to -o",
            s.output.path));
  if (!s.input.empty()) return;
  if (s.fix.size() < 2) refuse_usage("optimize", "IN is missing: the mesh to improve");
  s.input = s.fix.back();
  s.fix.pop_back();
  command.option("--fix").given = s.fix;
}

std::vector<std::string> doubtful_options(const Command& command, const OptimizeSettings& s) {
  std::vector<std::string> warnings = idle_options(command, s.table, s.method->options());
  if (s.options().repair == Repair::vertices && s.options().size_band) {
    warnings.emplace_back(
        spell_options("`size_band` does not restrict the vertices that `repair=vertices` removes and inserts"));
  }
  if (s.size_field.empty() && command.was_given("--size-field-data")) {
    warnings.emplace_back("--size-field-data has no effect without --size-field");
  }
  if (!(s.report.empty() && s.html.empty()) && same_file(s.input, s.output.path)) {
    warnings.emplace_back("--output replaces the input: the command in the report would start from the improved mesh");
  }
  return warnings;
}

}  // namespace temper::app
