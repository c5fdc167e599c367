// temper optimize IN -o OUT: reads, improves, writes, reports.
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <utility>

#include "console.hpp"
#include "files/input.hpp"
#include "files/outputs.hpp"
#include "files/trace_jsonl.hpp"
#include "options/options.hpp"
#include "options/ranks.hpp"
#include "reports/quality_report.hpp"
#include "reports/reports.hpp"
#include "temper/regularity.hpp"
#include "threads.hpp"
#include "verbs/optimize_run.hpp"
#include "verbs/optimize_settings.hpp"

namespace temper::app {
namespace {

VertexId find_vertex(const Input& input, std::string_view option, const std::string& number) {
  for (const VertexId v : input.mesh().vertices()) {
    if (input.vertex_number(v) == number) return v;
  }
  throw Failure(Exit::bad_usage, fmt::format("{}: {}: there is no vertex {}", input.path,
                                             spell_options(fmt::format("`{}`", option)), number));
}

/// Vertices have numbers now.
void find_vertices(TableOptions& table, const Input& input) {
  for (const auto& [name, number] : table.vertices) {
    const OptionValue value = number == kNone ? OptionValue() : OptionValue(find_vertex(input, name, number));
    find_option(name)->set(table.options, value);
  }
}

std::string ending(const OptimizeReport& report) {
  const char* sweeps = report.sweeps == 1 ? "sweep" : "sweeps";
  std::string work = fmt::format("{} {} in {:.3g} s, {} flips", report.sweeps, sweeps, report.seconds, report.flips);
  const auto add_vertices = [&work](std::size_t n, const char* what) {
    if (n > 0) work += fmt::format(", {} {} {}", n, n == 1 ? "vertex" : "vertices", what);
  };
  add_vertices(report.vertices_removed, "removed");
  add_vertices(report.vertices_inserted, "inserted");
  switch (report.stopped) {
    case Stopped::converged:
      return "converged after " + work;
    case Stopped::max_sweeps:
      return "stopped by --max-sweeps after " + work;
    case Stopped::max_outer:
      return "stopped by --outer after " + work;
    case Stopped::accuracy_sweeps:
      return "made all --accuracy-sweeps after " + work;
    case Stopped::tangled:
      return "stopped by inverted triangles, among which no edges can be flipped, after " + work;
    case Stopped::hidden:
      return "stopped by a vertex that the flips would hide, after " + work;
    case Stopped::time_limit:
      return "stopped early by --time-limit after " + work;
    case Stopped::cancelled:
      return "stopped early by a signal after " + work;
  }
  return work;
}

void warn(RunResults& results, std::span<const std::string> warnings) {
  print_warnings(warnings);
  results.warnings.insert(results.warnings.end(), warnings.begin(), warnings.end());
}

/// The mesh first: it is what the time went into.
void write_all(const Command& command, const OptimizeSettings& s, Input& input, RunResults& results, Outputs& outputs,
               const RunFiles& files) {
  const std::size_t known = input.file.warnings.size();
  results.data =
      io::update(input.file, input.loaded, input.loaded.mesh, results.report.vertices, {s.rules, files.threads});
  warn(results, std::span(input.file.warnings).subspan(known));
  warn(results, outputs.write_mesh(s.output, input.file, files.threads));
  if (files.trace != nullptr) outputs.commit(s.trace, files.trace->stream);
  if (!s.report.empty() || !s.html.empty()) {
    const std::vector<UsedOption> options = used_options(command);
    const std::string again = command_line("optimize", {s.input}, options);
    const OptimizeRecord record = {
        again,          options,      results.before,   input.points,     results.after,
        results.report, results.data, results.outcomes, results.warnings, results.errors_json};
    if (!s.report.empty()) outputs.write_text(s.report, optimize_json(record));
    if (!s.html.empty())
      outputs.write_text(s.html, optimize_html({record, input, results.original, input.loaded.mesh}));
  }
  if (!s.history.empty()) outputs.write_text(s.history, history_csv(results.report));
  if (!s.picture.empty()) outputs.write_picture(s.picture, results.picture);
}

/// The row of energies that is of interest.
int star_shown(const OptimizeOptions& options) {
  return objective_of(options) == Objective::accuracy ? 1 : static_cast<int>(options.star);
}

void print_result(const OptimizeSettings& s, const RunResults& results, const Outputs& outputs) {
  print(ending(results.report) + "\n\n" +
        comparison_text(results.before, results.after, star_shown(s.options()), text_style()) +
        size_text(results.report.size));
  if (const std::string data = data_text(results.data); !data.empty()) print("\n" + data);
  if (!results.errors_text.empty()) print("\n" + results.errors_text);
  for (const std::string& note : results.report.notes) print("note: " + note + "\n");
  print(fmt::format("\n{}: {}\n", s.output.path, verdict(results.after)));
  std::string written;
  for (const std::string& path : outputs.written()) written += (written.empty() ? "wrote " : ", ") + path;
  print(written + "\n");
}

Exit optimize_mesh(const Command& command, OptimizeSettings& s, Outputs& outputs) {
  const std::unique_ptr<Executor> threads = make_threads(s.threads);
  std::optional<TraceFile> trace;
  if (!s.trace.empty()) trace.emplace(TraceFile{outputs.open(s.trace), {}});
  const RunFiles files = {threads.get(), trace ? &*trace : nullptr};
  Input input = read_input(s.input, {s.projection, s.fix, threads.get(), true});
  if (!s.html.empty()) expect_plane(input.mesh(), s.input, "--html");
  RunResults results;
  warn(results, input.warnings());
  find_vertices(s.table, input);
  s.rules = data_rules(s.point_data, input.file);
  warn(results, doubtful_options(command, s));
  if (!s.size_field.empty()) {
    ReadSizeField sizes = read_size_field(s.size_field, s.size_data.empty() ? "size" : s.size_data,
                                          {same_projection(input, s.projection), {}, threads.get(), true});
    warn(results, sizes.warnings);
    s.table.options.size_field = std::move(sizes.field);
  }
  // The mesh has its geometry now, and memory is dear on the largest ones.
  io::release_geometry(input.file, input.loaded);
  agree_to_go_on();
  warn(results, warnings_of_ranks());
  improve(s, input, results, files);
  if (!is_first_rank()) return Exit::done;
  write_all(command, s, input, results, outputs, files);
  if (!s.quiet) print_result(s, results, outputs);
  flush_output();  // before the verdict on standard error
  if (const Exit verdict = report_unmet(results.outcomes, s.output.path); verdict != Exit::done) return verdict;
  return stopped_early(results.report.stopped) || results.lacks_flips ? Exit::stopped_early : Exit::done;
}

/// What the first rank does for all.
void leave_outputs_to_first_rank(OptimizeSettings& s) {
  for (std::string* output : {&s.output.path, &s.report, &s.html, &s.history, &s.picture, &s.trace}) {
    output->clear();
  }
  s.requirements.clear();
  s.save_every.reset();
  s.verify = false;
  s.quiet = true;
}

/// A command that has been parsed.
Exit run_command(Command& command, OptimizeSettings& settings) {
  take_input(command, settings);
  expect_no_contradictions(command);
  command.spell_defaults();  // --method may have changed them
  for (const char* option : {"--size-field", "--html", "--trace"}) expect_without(command, settings.metric, option);
  if (settings.metric) settings.output.options.triangle_quality = false;  // which is of the plane
  settings.requirements = parse_requirements("optimize", settings.require);

  settings.traced = !settings.trace.empty();
  if (!is_first_rank()) leave_outputs_to_first_rank(settings);

  Outputs outputs("optimize");
  const std::vector<std::string> inputs = {settings.input, settings.size_field};
  if (is_first_rank()) outputs.expect_mesh(settings.output, {settings.size_field});
  outputs.expect_text("--report", settings.report, inputs);
  outputs.expect_text("--html", settings.html, inputs);
  outputs.expect_text("--history", settings.history, inputs);
  outputs.expect_text("--trace", settings.trace, inputs);
  outputs.expect_picture("--draw", settings.picture, inputs);
  return optimize_mesh(command, settings, outputs);
}

}  // namespace

Exit run_optimize(const Arguments& arguments) {
  join_ranks();
  OptimizeSettings settings;
  Command command = optimize_command(settings);
  if (!command.parse(arguments)) return Exit::done;
  return run_command(command, settings);
}

}  // namespace temper::app
