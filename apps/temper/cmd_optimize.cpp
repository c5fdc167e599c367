// temper optimize IN -o OUT: reads, improves, writes, reports.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "console.hpp"
#include "data_report.hpp"
#include "help.hpp"
#include "html_pages.hpp"
#include "input.hpp"
#include "interrupt.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "progress_line.hpp"
#include "projection_option.hpp"
#include "ranks.hpp"
#include "report_json.hpp"
#include "report_text.hpp"
#include "requirement.hpp"
#include "resume.hpp"
#include "size_report.hpp"
#include "table_options.hpp"
#include "temper/checkpoint.hpp"
#include "temper/draw.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "temper/regularity.hpp"
#include "tensor_option.hpp"
#include "threads.hpp"
#include "time_limit.hpp"
#include "trace_jsonl.hpp"
#ifdef TEMPER_WITH_VERIFY
#include "solver_errors.hpp"
#endif

namespace temper::app {
namespace {

struct Settings {
  TimeLimit since;
  std::string projection;
  std::string input, report, html, history, picture, trace;
  MeshOutput output;
  std::vector<std::string> fix, require;
  const Method* method = methods().data();
  TableOptions table;  ///< first those of the method
  std::uint64_t threads = 0;
  bool quiet = false, verify = false;
  bool traced = false;  ///< whoever writes the trace
  std::string checkpoint, resume;
  double every = 600;  ///< seconds between checkpoints
  std::vector<Requirement> requirements;
  std::string size_field, size_data;
  std::optional<Metric> metric;  ///< of the diffusion tensor
  std::vector<std::string> point_data;
  io::DataRules rules;  ///< of point_data

  [[nodiscard]] const OptimizeOptions& options() const { return table.options; }
  [[nodiscard]] bool for_accuracy() const { return objective_of(options()) == Objective::accuracy; }
};

void add_files(Command& command, Settings& s) {
  command.group("Files");
  // These two are not marked as required: see take_input.
  add_argument(command, "IN", s.input, "the mesh to improve; its content tells the format");
  add_projection(command, s.projection);
  add_mesh_output(command, s.output, "OUT", "where the improved mesh goes; may be IN; its suffix tells the format");
  add_point_data(command, s.point_data);
  add_text(command, "--report", "FILE", s.report,
           "a JSON report: before, after, history, and the command to run again");
  add_text(command, "--html", "FILE", s.html,
           "an HTML report: the mesh before and after, measures, history, and the command to run again");
  add_text(command, "--history", "FILE", s.history, "one line of CSV a sweep");
  add_text(command, "--trace", "FILE", s.trace,
           "every move, flip and removal, one JSON object a line; see temper replay");
  add_text(command, "--draw", "FILE", s.picture, "a picture (.svg, .png, .pdf), before and after side by side");
#ifdef TEMPER_WITH_VERIFY
  command.add_flag(
      "--verify", s.verify,
      "measure the errors of solvers, too, before and after: see temper verify. But for --objective energy the input "
      "is returned when it is well-centered and its errors are the smaller ones");
#endif
  add_requirements(command, s.require).sentence =
      "outside=0,min_h=0.05,...: exit with 3 when the result is not so, with everything written; see temper check";
  command.add_flag("--quiet", s.quiet, "print warnings and errors only");
}

void add_constraints(Command& command, Settings& s) {
  command.group("Constraints and sizes");
  add_texts(command, "--fix", "TAG ...", Values::words, s.fix,
            "vertices with this tag or physical name stay where they are; several may follow");
  add_tensor(command, s.metric, "meshes are made well-centered");
  add_text(command, "--size-field", "FILE", s.size_field,
           "a mesh file whose point data say how long edges are meant to be where; without it the input's own sizes");
  add_text(command, "--size-field-data", "NAME", s.size_data, "of the point data in that file (default: size)");
}

void add_run(Command& command, Settings& s) {
  command.group("The run");
  add_count(command, "--threads", s.threads, 0, "threads; 0: as many as the machine has; the result is the same");
  add_text(command, "--checkpoint", "FILE", s.checkpoint,
           "the state of the run, for --resume: at its beginning, now and then, and when it is stopped early");
  add_number(command, "--every", s.every, kNotNegative, "seconds between checkpoints; 0: as many as there can be");
  add_text(command, "--resume", "FILE", s.resume,
           "go on with the run of a checkpoint, to what it would have ended with; IN and options are those of the run, "
           "but for outputs, --threads, --time-limit (of each run alone), --checkpoint and --every");
  std::vector<std::string_view> names;
  std::string help = "what all options start from";
  for (const Method& method : methods()) {
    names.push_back(method.name);
    help += fmt::format("; {}: {}", method.name, method.sentence);
  }
  // At once, before all other options are taken: those given override the method's.
  const auto take = [&s](std::string_view name) {
    s.method = &*std::find_if(methods().begin(), methods().end(), [&](const Method& m) { return m.name == name; });
    s.table.options = s.method->options();
  };
  Option& option = add_name(command, "--method", names, take, help);
  option.at_once = true;
  option.default_text = std::string(methods().front().name);
}

/// `--fix 1 2 IN -o OUT`: --fix takes all words that follow, so the last one is the input when there is none.
void take_input(Command& command, Settings& s) {
  if (s.output.path.empty())
    throw Failure(Exit::bad_usage, "optimize: --output is required\nSee temper optimize --help");
  if (!s.input.empty()) return;
  if (s.fix.size() < 2)
    throw Failure(Exit::bad_usage, "optimize: IN is missing: the mesh to improve\nSee temper optimize --help");
  s.input = s.fix.back();
  s.fix.pop_back();
  command.option("--fix").given = s.fix;
}

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

/// Options that were given and cannot have the effect one would expect.
std::vector<std::string> doubtful_options(const Command& command, const Settings& s) {
  std::vector<std::string> warnings = idle_options(command, s.table, s.method->options());
  if (s.options().repair == Repair::vertices && s.options().size_band) {
    warnings.emplace_back(
        spell_options("vertices that `repair=vertices` removes and inserts are not held to `size_band`"));
  }
  if (s.size_field.empty() && command.was_given("--size-field-data")) {
    warnings.emplace_back("--size-field-data has no effect without --size-field");
  }
  if (s.checkpoint.empty() && command.was_given("--every")) {
    warnings.emplace_back("--every has no effect without --checkpoint");
  }
  if (!(s.report.empty() && s.html.empty()) && same_file(s.input, s.output.path)) {
    warnings.emplace_back("--output replaces the input: the command in the report would start from the improved mesh");
  }
  return warnings;
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

std::string picture_title(const Input& input, const Quality& before, const Quality& after) {
  return fmt::format("{}: of {} triangles {} were not well-centered, now {}", input.path, before.triangles,
                     bad_triangles(before), bad_triangles(after));
}

/// What a run made, apart from the mesh.
struct Results {
  Quality before, after;
  Mesh original;  ///< when a picture, a page or --verify needs it
  OptimizeReport report;
  std::vector<Outcome> outcomes;  ///< of --require
  bool lacks_flips = false;       ///< edges are not regular that should be
  io::DataReport data;
  std::string picture;                   ///< SVG, when asked for
  std::string errors_text, errors_json;  ///< of solvers, when asked for
  std::vector<std::string> warnings;
};

/// The checkpoint that a run goes on from.
struct Resumed {
  std::string path;
  io::Checkpoint checkpoint;
};

/// A trace that is being written.
struct TraceFile {
  io::TextStream stream;
  io::CheckpointFile::TracePlace place;  ///< how far it is

  void write(std::string_view text) {
    stream.write(text);
    place.bytes += text.size();
  }
};

/// All that a run works with, besides its settings. Null: there is none.
struct RunFiles {
  Executor* threads = nullptr;
  const Resumed* resumed = nullptr;
  TraceFile* trace = nullptr;
  io::CheckpointFile* checkpoint = nullptr;
};

/// A file that the run reads: that of the checkpoint, when it is resumed; and it goes into its own.
io::MeshFile read_file(const RunFiles& files, const std::string& path) {
  io::MeshFile file;
  if (files.resumed != nullptr) {
    const std::vector<io::MeshFile>& inputs = files.resumed->checkpoint.inputs;
    const auto found = std::find_if(inputs.begin(), inputs.end(), [&](const auto& each) { return each.path == path; });
    if (found == inputs.end()) throw Failure(Exit::bad_input, files.resumed->path + ": does not have " + path);
    file = *found;
  } else {
    file = or_fail(io::read(path, {files.threads}));
  }
  if (files.checkpoint != nullptr) files.checkpoint->add_input(file);
  return file;
}

/// A run whose checkpoints cannot be written goes on.
void keep(io::CheckpointFile& file, const std::function<std::string()>& state) {
  if (const Expected<void> kept = file.keep(state); !kept) print_warnings(std::vector{kept.error().what()});
}

OptimizeReport run_library(const Settings& s, const Input& input, Mesh& mesh, const RunFiles& files, Tracer tracer) {
  ProgressLine line(!s.quiet && error_is_terminal());
  const Observer observer = [&line](const Progress& progress) {
    line.show(progress);
    return interrupted() ? Continue::no : Continue::yes;
  };
  OptimizeHooks hooks;
  hooks.executor = files.threads;
  hooks.ranks = joined_ranks();
  hooks.names = input.names.get();
  hooks.exclusive = true;
  hooks.observer = observer;
  hooks.tracer = std::move(tracer);
  if (files.checkpoint != nullptr) hooks.checkpoints = [&](const auto& state) { keep(*files.checkpoint, state); };
  if (files.resumed != nullptr) hooks.resume = files.resumed->checkpoint.state;
  OptimizeOptions options = s.options();
  options.time_limit = s.since.left(options.time_limit);
#ifdef TEMPER_WITH_VERIFY
  if (wants_error_model(options, mesh)) {
    auto model = solver_error_model(mesh, {.scheme = options.for_});
    if (!model) throw as_failure(spell_options(model.error()));
    options.error.model = *std::move(model);
  }
#endif
  Expected<OptimizeReport> report = optimize(mesh, options, hooks);
  if (!report) {
    InputError error = spell_options(report.error());
    if (files.resumed != nullptr && error.where.empty()) error.where = files.resumed->path;
    throw as_failure(error);
  }
  for (std::string& note : report->notes) note = spell_options(note);
  return *std::move(report);
}

#ifdef TEMPER_WITH_VERIFY
/// The input instead of the result, which leaves solvers with larger errors.
void return_input(Mesh& mesh, const Mesh& original, double ratio, OptimizeReport& report, const Tracer& tracer) {
  if (tracer) {
    TraceEvent back;
    back.kind = EventKind::undo;
    back.sweep = report.sweeps;
    back.to_sweep = -1;
    tracer(back);
  }
  mesh = original;
  report.vertices = {};
  report.vertices_removed = report.vertices_inserted = report.flips = 0;
  report.hidden = {};
  report.size.after = report.size.before;
  report.final_energy = report.initial_energy;
  report.notes.push_back(fmt::format(
      "the input was well-centered, and errors of solvers would be {:.3g} times its own in the mean: it is returned as "
      "it was",
      ratio));
}

/// What --verify asks for.
void verify_result(const Settings& s, SolverErrors& errors, Mesh& mesh, const Mesh& original, Results& results,
                   const Tracer& tracer) {
  errors.measure_result(mesh);
  if (s.for_accuracy() && errors.input_was_better()) {
    return_input(mesh, original, errors.mean_ratio(), results.report, tracer);
    errors.measure_result(mesh);
  }
  results.errors_text = errors.text(text_style());
  results.errors_json = errors.json();
}
#endif

/// The tracer of the trace, if there is one. The beginning of a resumed one is written before.
Tracer tracer_of(const Settings& s, const RunFiles& files, const Input& input) {
  TraceFile* const trace = files.trace;
  if (trace == nullptr && s.traced) return [](const TraceEvent&) {};  // the first rank writes it
  if (trace == nullptr) return {};
  const bool begun = files.resumed != nullptr && !files.resumed->checkpoint.trace.empty();
  trace->write(begun ? files.resumed->checkpoint.trace : trace_header(input));
  if (begun) trace->place.events = files.resumed->checkpoint.events;
  return [trace, &input](const TraceEvent& event) {
    trace->write(trace_line(event, input));
    ++trace->place.events;
  };
}

/// Improves the mesh of the input in place: a second copy is made only when something needs one.
void improve(const Settings& s, Input& input, Results& results, const RunFiles& files) {
  QualityOptions measuring;
  measuring.executor = files.threads;
  Mesh& mesh = input.loaded.mesh;
  const bool may_return_input = s.verify && s.for_accuracy();
  const Mesh& original = results.original;
  if (!s.picture.empty() || !s.html.empty() || may_return_input) results.original = mesh;
  const bool shown = !s.report.empty() || !s.html.empty() || !s.picture.empty();
  const bool measured = !s.quiet || shown || !s.requirements.empty();  // else nobody would see it
  if (measured) results.before = quality(mesh, measuring);
  catch_interrupts();
  if (!s.quiet) {
    print(fmt::format("{}: {} vertices, {} triangles\n", s.input, results.before.vertices, results.before.triangles));
    flush_output();
  }
  const Tracer tracer = tracer_of(s, files, input);
#ifdef TEMPER_WITH_VERIFY
  std::optional<SolverErrors> errors;
  if (s.verify) errors.emplace(mesh, files.threads);
  results.report = run_library(s, input, mesh, files, tracer);
  if (errors) verify_result(s, *errors, mesh, original, results, tracer);
#else
  results.report = run_library(s, input, mesh, files, tracer);
#endif
  if (files.trace != nullptr) files.trace->write(trace_end(files.trace->place.events, mesh, input));
  if (measured) results.after = quality(mesh, measuring);
  results.outcomes = judge(s.requirements, results.after);
  if (!s.picture.empty()) {
    DrawOptions drawing;
    drawing.title = picture_title(input, results.before, results.after);
    results.picture = draw_before_after_svg(original, mesh, drawing);
  }
}

void warn(Results& results, std::span<const std::string> warnings) {
  print_warnings(warnings);
  results.warnings.insert(results.warnings.end(), warnings.begin(), warnings.end());
}

bool stopped_early(const OptimizeReport& report) {
  return report.stopped == Stopped::time_limit || report.stopped == Stopped::cancelled;
}

/// The mesh first: it is what the time went into.
void write_all(const Command& command, const Settings& s, Input& input, Results& results, Outputs& outputs,
               const RunFiles& files) {
  const std::size_t known = input.file.warnings.size();
  results.data =
      io::update(input.file, input.loaded, input.loaded.mesh, results.report.vertices, {s.rules, files.threads});
  warn(results, std::span(input.file.warnings).subspan(known));
  warn(results, outputs.write_mesh(s.output, input.file, files.threads));
  if (files.checkpoint != nullptr && stopped_early(results.report)) outputs.write(*files.checkpoint);
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

void print_result(const Settings& s, const Results& results, const Outputs& outputs) {
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
  if (!s.checkpoint.empty() && stopped_early(results.report)) {
    print(fmt::format("to go on: temper optimize --resume {}\n", shell_quote(s.checkpoint)));
  }
}

/// Says whether edges are not regular that should be: `after` counts those that may not be flipped, too.
bool lacks_flips(const Settings& s, const Quality& after, const Mesh& mesh, Executor* executor) {
  const OptimizeOptions& o = s.options();
  return after.non_regular_edges > 0 && o.flips != Flips::none && o.paper.hidden != HiddenPolicy::keep &&
         count_non_regular_edges(mesh, false, executor) > 0;
}

/// From the plane of the metric to that of the file, where `plain` is the mesh as it was.
void take_back(const Settings& s, const Mesh& plain, Input& input, const OptimizeReport& report) {
  auto back = mapped_back(input.loaded.mesh, plain, *s.metric, report.vertices);
  if (!back) {
    InputError error = back.error();
    error.where = s.input;
    throw as_failure(error);
  }
  input.loaded.mesh = *std::move(back);
}

/// The checkpoints that are asked for.
std::optional<io::CheckpointFile> checkpoint_of(const Command& command, const Settings& s, TraceFile* trace) {
  if (s.checkpoint.empty()) return std::nullopt;
  io::CheckpointFile file(s.checkpoint, s.every);
  file.set_command(given_words(command));
  if (trace != nullptr) {
    or_fail(trace->stream.so_far());
    file.set_trace([trace] { return trace->place; }, [trace] { return trace->stream.so_far(); });
  }
  return file;
}

/// As a person would give it: without what is not given.
std::string words_of_run(const Command& command) {
  std::string text = "temper optimize";
  for (const std::string& word : given_words(command)) text += " " + shell_quote(word);
  return text;
}

Exit optimize_mesh(const Command& command, Settings& s, Outputs& outputs, const Resumed* resumed) {
  const std::unique_ptr<Executor> threads = make_threads(s.threads);
  std::optional<TraceFile> trace;
  if (!s.trace.empty()) trace.emplace(TraceFile{outputs.open(s.trace), {}});
  std::optional<io::CheckpointFile> checkpoint = checkpoint_of(command, s, trace ? &*trace : nullptr);
  const RunFiles files = {threads.get(), resumed, trace ? &*trace : nullptr, checkpoint ? &*checkpoint : nullptr};
  const auto read = [&files](const std::string& path) { return read_file(files, path); };
  if (resumed != nullptr && !s.quiet) {
    print(fmt::format("{}: goes on with {}\n", resumed->path, words_of_run(command)));
  }
  Input input = read_input(s.input, {s.projection, s.fix, threads.get(), true, read});
  if (!s.html.empty()) expect_plane(input.mesh(), s.input, "--html");
  Results results;
  warn(results, input.warnings());
  find_vertices(s.table, input);
  s.rules = data_rules(s.point_data, input.file);
  warn(results, doubtful_options(command, s));
  if (!s.size_field.empty()) {
    ReadSizeField sizes = read_size_field(s.size_field, s.size_data.empty() ? "size" : s.size_data,
                                          {same_projection(input, s.projection), {}, threads.get(), true, read});
    warn(results, sizes.warnings);
    s.table.options.size_field = std::move(sizes.field);
  }
  // The mesh has its geometry now, and memory is dear on the largest ones.
  io::release_geometry(input.file, input.loaded);
  const std::optional<Mesh> plain = take_to_metric(input, s.metric);
  agree_to_go_on();
  improve(s, input, results, files);
  if (!is_first_rank()) return Exit::done;
  results.lacks_flips = lacks_flips(s, results.after, input.loaded.mesh, threads.get());
  if (plain) take_back(s, *plain, input, results.report);
  write_all(command, s, input, results, outputs, files);
  if (!s.quiet) print_result(s, results, outputs);
  flush_output();  // before the verdict on standard error
  if (const Exit verdict = report_unmet(results.outcomes, s.output.path); verdict != Exit::done) return verdict;
  return stopped_early(results.report) || results.lacks_flips ? Exit::stopped_early : Exit::done;
}

/// Of this verb's own options those that a first run does without; of the library's the table says it.
constexpr const char* kRare[] = {
    "--projection", "--format",     "--encoding",        "--point-data",          "--history",
    "--trace",      "--threads",    "--method",          "--checkpoint",          "--every",
    "--resume",     "--size-field", "--size-field-data", "--no-triangle-quality", "--tensor"};

Command command_with(Settings& settings) {
  Command command(
      "optimize",
      "Moves vertices, weights them and flips edges until every triangle is well-centered: its orthocenter "
      "inside, every edge crossed by its dual. The boundary of the domain stays bit for bit, unless --boundary says "
      "otherwise.");
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
       "  temper optimize in.vtu -o out.vtu --for vertex --verify\n"
       "  temper optimize in.vtu -o out.vtu --removal patch --trace trace.jsonl\n"
       "  temper optimize in.vtu -o out.vtu --method paper --energy dT --removal none\n"
       "  temper optimize in.vtu -o out.vtu --checkpoint run.ckpt --time-limit 3600\n"
       "  temper optimize --resume run.ckpt\n",
       {Exit::done, Exit::bad_input, Exit::bad_usage, Exit::requirement, Exit::stopped_early, Exit::internal}});
  return command;
}

/// What the first rank does for all.
void leave_outputs_to_first_rank(Settings& s) {
  for (std::string* output : {&s.output.path, &s.report, &s.html, &s.history, &s.picture, &s.trace, &s.checkpoint}) {
    output->clear();
  }
  s.requirements.clear();
  s.verify = false;
  s.quiet = true;
}

/// A command that has been parsed. `resumed`: the run that it goes on with, or null.
Exit run_command(Command& command, Settings& settings, const Resumed* resumed) {
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
  outputs.expect_text("--checkpoint", settings.checkpoint, inputs);
  return optimize_mesh(command, settings, outputs, resumed);
}

/// The command of the checkpoint, with what is given now.
Exit resume(const Command& now, const std::string& path) {
  const Resumed resumed = {path, or_fail(io::read_checkpoint(path))};
  if (resumed.checkpoint.command.empty()) {
    throw Failure(Exit::bad_input, path + ": is a checkpoint of a run that no command started");
  }
  Settings then_settings, settings;
  Command then = command_with(then_settings), command = command_with(settings);
  if (!then.parse(resumed.checkpoint.command) || !command.parse(resumed_words(now, then))) return Exit::done;
  return run_command(command, settings, &resumed);
}

}  // namespace

Exit run_optimize(const Arguments& arguments) {
  join_ranks();
  Settings settings;
  Command command = command_with(settings);
  if (!command.parse(arguments)) return Exit::done;
  return settings.resume.empty() ? run_command(command, settings, nullptr) : resume(command, settings.resume);
}

}  // namespace temper::app
