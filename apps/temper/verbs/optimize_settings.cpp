#include "verbs/optimize_settings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "files/input.hpp"
#include "files/options_file.hpp"
#include "help/help.hpp"
#include "options/options.hpp"
#include "reports/reports.hpp"
#include "temper/detail/suggest.hpp"

namespace temper::app {
namespace {

constexpr OutputKind kRunOutputs[] = {kReportKind, kPageKind, kHistoryKind, kTraceKind, kPictureKind};

std::vector<std::string_view> names_of(std::span<const Preset> presets, bool research) {
  std::vector<std::string_view> names;
  for (const Preset& preset : presets) {
    if (research || !preset.research) names.push_back(preset.name);
  }
  return names;
}

/// The presets with their sentences, for the lines below an option.
std::vector<std::pair<std::string, std::string>> meanings_of(std::span<const Preset> presets) {
  std::vector<std::pair<std::string, std::string>> meanings;
  for (const Preset& preset : presets) {
    if (!preset.research) meanings.emplace_back(preset.name, preset.sentence);
  }
  return meanings;
}

/// BadValue if the word is none of these names of presets.
void expect_preset(std::string_view word, const std::vector<std::string_view>& names, std::span<const Preset> presets) {
  if (std::ranges::find(names, word) != names.end()) return;
  throw BadValue(fmt::format("'{}' is none of {}{}", word, join(names), did_you_mean(word, presets)));
}

void add_purpose(Command& command, OptimizeSettings& s) {
  Option& target = add_target(command, s.target, true);
  target.meanings.emplace_back("paper", "Algorithm 1 of the paper, with the switches of --help-paper");
  const auto take = [&s, names = names_of(efforts(), true)](const std::string& text) {
    expect_preset(text, names, efforts());
    s.effort = text;
  };
  command
      .add({.names = "--effort",
            .value_name = join(names_of(efforts(), true), "|"),
            .sentence = "Time to spend on repairs and lower errors.",
            .take = take})
      .defaults_to([&s] { return s.effort; });
}

void add_keep(Command& command, OptimizeSettings& s) {
  const std::vector<std::string_view> names = names_of(keeps(), true);
  const auto take = [&s, names](const std::string& text) {
    for (const std::string& name : separated(text)) {
      expect_name(name, names);
      s.keep.push_back(name);
    }
  };
  command.add({.names = "--keep",
               .value_name = "LIST",
               .sentence = fmt::format("Parts that stay: {}.", join(names, ", ")),
               .take = take,
               .values = Values::repeated});
}

/// The options of a first run.
void add_common(Command& command, OptimizeSettings& s) {
  command.group("Options");
  // These two are not marked as required: see take_input.
  add_argument(command, "IN", s.input, "Mesh file, of " + any_elements() + ". Its content shows the format.");
  add_mesh_output(command, s.output, "OUT");
  command.option("--output").sentence = "File to write; its suffix selects the format. '-': standard output.";
  add_purpose(command, s);
  add_keep(command, s);
  add_flag_of(command, "boundary", s.assignments).sentence =
      "The boundary stays bit for bit, or its vertices slide along it, or its edges are split. Curved surfaces have no "
      "split.";
  add_texts(command, "--fix", "TAG ...", Values::words, s.fix,
            "Tags or physical names of vertices that keep their positions.")
      .cells = CellKinds::all_triangles;
  add_text(command, "--size", "FILE", s.size, "Mesh file with the target edge length at each of its points.").cells =
      CellKinds::triangles;
  add_flag_of(command, "min_edge", s.assignments).sentence = "Least length of interior edges over the local size.";
  add_flag_of(command, "min_dual", s.assignments).sentence = "Least length of their duals over the local size.";
  add_requirements(command, s.require).sentence = "Requirements, such as outside=0. If one is not met, exit with 3.";
  add_flag_of(command, "time_limit", s.assignments).value_name = "SECONDS";
  add_write(command, s.write, kRunOutputs);
}

void add_rare(Command& command, OptimizeSettings& s) {
  const std::size_t first = command.options().size();
  command.group("Further options");
  add_set(command, s.assignments);
  add_flag_of(command, "change", s.assignments).sentence = "Change all, or only places that lack what TARGET needs.";
  add_flag_of(command, "surface_distance", s.assignments);
  add_flag_of(command, "crease_angle", s.assignments);
  add_flag_of(command, "coarsen", s.assignments).sentence =
      "Remove vertices, and keep all triangles well-centered. No removal makes a local size larger than this factor "
      "times the size field.";
  add_text(
      command, "--options", "FILE", s.options_file,
      "JSON file with options, such as {\"for\": \"cell\", \"max_sweeps\": 20}. A report of temper optimize is such a "
      "file. Options of the command line override it.");
  command.add_flag("--details", s.details, "Print all measures, energies, sizes and notes.");
#ifdef TEMPER_WITH_ERRORS
  command.add_flag(
      "--measure-errors", s.measure_errors,
      "Measure the errors of solvers before and after, as temper errors does, and print them. This follows the run and "
      "is not part of its time. A run that --time-limit or a signal ends is not measured.");
#endif
  add_projection(command, s.projection);
  add_heights(command, s.heights);
  add_tensor(command, s.tensor, "Make meshes well-centered");
  add_problem(command, s.problem,
              "Needs --for vertex or --for cell. The run then lowers the error of this problem, -div(K grad u) = f. "
              "Without --dirichlet it lowers the mean error of many smooth solutions with K = 1. Not with --tensor.");
  Option& data = add_text(command, "--size-data", "NAME", s.size_data, "Name of the point data in the file of --size.");
  data.default_text = "size", data.cells = CellKinds::triangles;
  add_data_rules(command, s.data_words);
  add_threads(command, s.threads,
              "Number of threads of each process. 0 uses all threads of the machine, or all that the process may use.");
  add_number(
      command, "--save-every", s.save_every, kNotNegative,
      "Write the best mesh so far to OUT during the run, at most once in this many seconds. 0 writes every new one.");
  for (std::size_t i = first; i < command.options().size(); ++i) command.option_at(i).rare = true;
  for (const char* name : {"--format", "--cells", "--encoding", "--no-triangle-quality"})
    command.option(name).rare = true;
}

/// Solvers by name, which --help-all lists.
HelpPart solvers_by_name() {
  HelpPart part = {"Solvers by name, for --for"};
  for (const SolverName& solver : solver_names()) {
    if (solver.target == solver.name) continue;
    const std::string meaning(solver.target.empty() ? solver.uses : "target " + std::string(solver.target));
    part.rows.push_back({std::string(solver.name), meaning + "."});
  }
  return part;
}

/// Targets of research, which --help-paper lists.
HelpPart research_targets() {
  HelpPart part = {"Targets of research, for --for"};
  for (const Preset& preset : targets()) {
    if (preset.research) part.rows.push_back({std::string(preset.name), std::string(preset.sentence) + "."});
  }
  return part;
}

/// Returns a word of --write or --fix that must be the input; empty: none.
std::string* last_word(OptimizeSettings& s) {
  if (!s.write.empty() && !is_output_of(kRunOutputs, s.write.back())) return &s.write.back();
  return s.fix.size() > 1 ? &s.fix.back() : nullptr;
}

/// Refuses two values for one option.
void expect_one_value(const Assignments& assignments) {
  for (auto a = assignments.begin(); a != assignments.end(); ++a) {
    if (std::any_of(assignments.begin(), a, [a](const Assignment& other) { return other.row == a->row; }))
      refuse_usage("optimize", fmt::format("{} is set more than once", a->row->name));
  }
}

/// Refuses names that are not for these cells.
void refuse_others(const std::string& verb, const std::string& input, const Expected<void>& right, CellKinds cells) {
  if (!right)
    refuse_usage(verb,
                 fmt::format("{} has {}, and {}", input, name_of_mesh(cells), spell_options(right.error().message)));
}

}  // namespace

Option& add_target(Command& command, std::string& target, bool research) {
  const auto take = [&target, names = names_of(targets(), research)](const std::string& text) {
    const Expected<std::string_view> named = target_named(text);
    if (!named && find_solver(text) != nullptr) throw BadValue(named.error().message);
    expect_preset(named ? *named : text, names, targets());
    target = named ? *named : text;
  };
  Option& option = command.add({.names = "--for",
                                .value_name = "TARGET",
                                .sentence = "Purpose of the mesh, or the name of a solver.",
                                .take = take});
  option.meanings = meanings_of(targets());
  option.defaults_to([&target] { return target; });
  return option;
}

Command optimize_command(OptimizeSettings& settings) {
  Command command(
      "optimize",
      "Moves vertices, changes weights, and flips edges and faces, until each orthocenter is inside its " +
          any_element() +
          ". In triangle meshes, each dual edge also crosses its edge. The boundary stays bit for bit, unless "
          "--boundary allows changes.");
  add_common(command, settings);
  add_rare(command, settings);
  command.group("Options");
  VerbHelp help = {
      "IN -o OUT [options]",
      "  temper optimize in.vtu -o out.vtu\n"
      "  temper optimize in.msh -o out.msh --for cell --require outside=0 --write out.html out.svg\n"
      "  temper optimize in.vtu -o out.vtu --keep positions,edges\n"
      "  temper optimize in.vtu -o out.vtu --set energy=F,star=1,solver=golden,max_sweeps=20\n"
      "  temper optimize in.vtu -o out.vtu --options report.json --time-limit 60\n"
      "  temper optimize in.vtu -o out.vtu --for vertex --measure-errors\n"
      "  temper optimize in.vtu -o out.vtu --for paper --set energy=dT,removal=none\n"
      "  temper optimize in.vtu -o out.vtu --coarsen 2 --time-limit 60\n"
      "  temper optimize in.vtu -o out.vtu --save-every 600\n",
      {Exit::done, Exit::bad_input, Exit::bad_usage, Exit::requirement, Exit::stopped_early, Exit::internal}};
  help.all = help_parts(false);
  help.all.insert(help.all.begin(), solvers_by_name());
  help.paper = help_parts(true);
  help.paper.push_back(research_targets());
  help.instead = [](std::string_view name) {
    std::string option(name);
    std::ranges::replace(option, '-', '_');
    return find_option(option) != nullptr ? fmt::format("--set {}=VALUE", option) : std::string();
  };
  command.add_help(std::move(help));
  return command;
}

void take_input(Command& command, OptimizeSettings& s) {
  if (s.input.empty()) {
    if (std::string* const word = last_word(s)) {
      s.input = *word;
      const bool written = !s.write.empty() && word == &s.write.back();
      (written ? s.write : s.fix).pop_back();
      command.option(written ? "--write" : "--fix").given.pop_back();
    }
  }
  if (s.input.empty()) refuse_usage("optimize", "IN is missing: the mesh to improve");
  if (s.output.path.empty()) refuse_usage("optimize", "-o OUT is missing: the file for the result");
  if (s.save_every && io::is_stream(s.output.path))
    throw Failure(
        Exit::bad_usage,
        fmt::format(
            "optimize: --save-every: {} is not a file that can be replaced. Next: give the name of a file to -o",
            s.output.path));
  s.files = sorted_outputs("optimize", s.write, kRunOutputs);
}

void settle_options(Command& command, OptimizeSettings& s) {
  expect_one_value(s.assignments);
  if (!s.options_file.empty()) read_options(command, s.options_file, s.assignments);
  const std::vector<std::string_view> keep(s.keep.begin(), s.keep.end());
  const Expected<OptimizeOptions> options = options_for(s.target, s.effort, keep);
  if (!options) refuse_usage("optimize", options.error().message);
  s.options = *options;
  s.set_by_target = differences(*options_for(s.target), OptimizeOptions());
  assign(s.assignments, s.options);
  for (const auto& checked : {check_target(s.options, s.target), check_kept(s.options, keep)}) {
    if (!checked) refuse_usage("optimize", spell_options(checked.error()).message);
  }
}

void expect_for(const Command& command, const OptimizeSettings& s, CellKinds cells) {
  command.expect_for(cells, s.input);
  const std::vector<std::string_view> keep(s.keep.begin(), s.keep.end());
  std::vector<std::string_view> rows;
  for (const Assignment& a : s.assignments) rows.push_back(a.row->name);
  refuse_others("optimize", s.input, check_cells(s.options, {s.target, keep, rows}, cells), cells);
}

void expect_target_for(const std::string& verb, const std::string& input, std::string_view target, CellKinds cells) {
  refuse_others(verb, input, check_cells({}, {target}, cells), cells);
}

std::string ending(Stopped stopped) {
  switch (stopped) {
    case Stopped::converged:
      return "converged after ";
    case Stopped::max_sweeps:
      return "stopped by max_sweeps after ";
    case Stopped::max_outer:
      return "stopped by outer after ";
    case Stopped::sweep_limit:
      return "finished after ";
    case Stopped::tangled:
      return "stopped by inverted triangles, among which no edges can be flipped, after ";
    case Stopped::hidden:
      return "stopped by a vertex that the flips would hide, after ";
    case Stopped::time_limit:
      return "stopped early by --time-limit after ";
    case Stopped::canceled:
      return "stopped early by a signal after ";
  }
  return {};
}

std::vector<std::string> doubtful_options(const Command& command, const OptimizeSettings& s) {
  std::vector<std::string> warnings = idle_assignments(s.assignments, s.options, *options_for(s.target, s.effort));
  if (s.options.repair == Repair::vertices && s.options.size_band) {
    warnings.emplace_back(
        spell_options("`size_band` does not restrict the vertices that `repair=vertices` removes and inserts"));
  }
  if (s.size.empty() && command.was_given("--size-data")) {
    warnings.emplace_back("--size-data has no effect without --size");
  }
  for (const std::string& warning : warning_of_replaced_input(s)) warnings.push_back(warning);
  return warnings;
}

std::vector<std::string> warning_of_replaced_input(const OptimizeSettings& s) {
  if ((s.files.report.empty() && s.files.page.empty()) || !same_file(s.input, s.output.path)) return {};
  return {"--output replaces the input: the command in the report would start from the improved mesh"};
}

}  // namespace temper::app
