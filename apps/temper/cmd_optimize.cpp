// temper optimize IN -o OUT: reads, improves, writes, reports.
#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "console.hpp"
#include "help.hpp"
#include "input.hpp"
#include "interrupt.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "progress_line.hpp"
#include "report_json.hpp"
#include "report_text.hpp"
#include "temper/draw.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "threads.hpp"

namespace temper::app {
namespace {

constexpr Choice<Solver> kSolvers[] = {
    {"newton", Solver::newton}, {"golden", Solver::golden}, {"alternating", Solver::alternating}};
constexpr Choice<FlipLimit> kFlipLimits[] = {{"unlimited", FlipLimit::unlimited},
                                             {"before", FlipLimit::before},
                                             {"at", FlipLimit::at},
                                             {"after", FlipLimit::after}};
constexpr Choice<FlipTiming> kFlipTimings[] = {{"immediate", FlipTiming::immediate},
                                               {"deferred", FlipTiming::deferred}};
constexpr Choice<StoppingRule> kStoppingRules[] = {{"relative", StoppingRule::relative},
                                                   {"paper", StoppingRule::paper}};
constexpr Choice<BoundaryTreatment> kBoundaryTreatments[] = {{"as-is", BoundaryTreatment::as_is},
                                                             {"absolute", BoundaryTreatment::absolute},
                                                             {"mirrored", BoundaryTreatment::mirrored}};
constexpr Choice<int> kStars[] = {{"0", 0}, {"1", 1}, {"2", 2}};

struct Settings {
  std::string input, output, report, history, picture, anchor;
  std::vector<std::string> fix;
  OptimizeOptions options;
  SofteningOptions gamma, h0;
  std::uint64_t threads = 0;
  bool positions_only = false, weights_only = false, no_flips = false, slide = false, quiet = false;
};

void add_files(CLI::App& app, Settings& s) {
  // Not marked as required: see take_input.
  app.add_option("IN", s.input, "the mesh to improve; its content tells the format");
  add_text(app, "-o,--output", "OUT", s.output, "where the improved mesh goes; may be IN; its suffix tells the format")
      ->required();
  add_text(app, "--report", "FILE", s.report, "a JSON report: before, after, history, and the command to run again");
  add_text(app, "--history", "FILE", s.history, "one line of CSV a sweep");
  add_text(app, "--draw", "FILE", s.picture, "an SVG picture, before and after side by side");
  app.add_flag("--quiet", s.quiet, "print warnings and errors only");
}

void add_energy(CLI::App& app, Settings& s) {
  std::vector<std::string_view> names;
  for (const EnergyInfo& energy : energies()) names.push_back(energy.name);
  add_name(
      app, "--energy", names, [&s](std::string_view name) { s.options.energy = or_fail(find_energy(name)).name; },
      "what to minimise: a barrier (BH, BHs, BP) or a HOT energy (F, T, dT)")
      ->default_str(std::string(s.options.energy));
  add_choice(
      app, "--star", kStars, [&s](int star) { s.options.star = star; }, "Hodge star of the energy")
      ->default_str("1");
  add_gamma(app, s.gamma, "; without it relative to each edge, shrinking from 0.5 to 0.003");
  add_h0(app, s.h0, "; without it just beyond the least h of the mesh, following it up");
  add_choice(
      app, "--boundary-treatment", kBoundaryTreatments, [&s](BoundaryTreatment value) { s.options.boundary = value; },
      "of energy F: the h of boundary edges as it is, |h|, or as if the mesh were mirrored there")
      ->default_str("as-is");
}

void add_moves(CLI::App& app, Settings& s) {
  add_choice(
      app, "--solver", kSolvers, [&s](Solver value) { s.options.solver = value; },
      "Newton steps in position and weight together; the paper's golden section; Newton in position, then weight")
      ->default_str("newton");
  CLI::Option* positions = app.add_flag("--positions-only", s.positions_only, "leave the weights as they are");
  CLI::Option* weights = app.add_flag("--weights-only", s.weights_only, "leave the positions as they are");
  positions->excludes(weights);
  add_count(app, "--weights-from", s.options.weights_from, 0, "first sweep that changes weights, from 0");
  add_number(app, "--relaxation", s.options.relaxation, {0, 2, true}, "over-relaxation of Newton steps");
  add_text(app, "--anchor", "VERTEX", s.anchor,
           "shift the weights after each sweep so that this vertex has weight 0 (its number in the file)");
}

void add_connectivity(CLI::App& app, Settings& s) {
  app.add_flag("--no-flips", s.no_flips, "keep the connectivity; no step may make an edge non-regular");
  add_choice(
      app, "--flips", kFlipTimings, [&s](FlipTiming value) { s.options.flip_timing = value; },
      "flip edges at once, or at the end of the sweep")
      ->default_str("immediate");
  add_choice(
      app, "--flip-limit", kFlipLimits, [&s](FlipLimit value) { s.options.flip_limit = value; },
      "how far a step may go past the point where an edge flips (default: unlimited for barriers, after for HOT)");
  add_number(app, "--overshoot", s.options.overshoot, {1, std::numeric_limits<double>::infinity(), false},
             "of --flip-limit after, at first: it shrinks towards 1 each sweep");
  app.add_option("--fix", s.fix, "vertices with this tag or physical name stay where they are; several may follow")
      ->type_name("TAG ...");
  app.add_flag("--slide-interfaces", s.slide,
               "vertices of straight region interfaces and tagged lines may move along them");
}

void add_stopping(CLI::App& app, Settings& s) {
  add_count(app, "--max-sweeps", s.options.max_sweeps, 0, "at most this many sweeps over the vertices");
  add_number(app, "--tolerance", s.options.tolerance, kNotNegative, "stop when a sweep gains less than this");
  add_choice(
      app, "--stopping", kStoppingRules, [&s](StoppingRule value) { s.options.stopping = value; },
      "the gain relative to the energy, or the paper's: mean energy per triangle, absolute")
      ->default_str("relative");
  add_number(app, "--time-limit", s.options.time_limit, kNotNegative, "stop after this many seconds; 0: no limit");
  add_count(app, "--threads", s.threads, 0, "threads; 0: as many as the machine has; the result is the same");
  add_count(app, "--seed", s.options.seed, 0, "of the jitter that frees symmetric grids");
}

/// Options added by `add` go under a title in --help.
void add_group(CLI::App& app, Settings& s, const std::string& title, void (*add)(CLI::App&, Settings&)) {
  app.option_defaults()->group(title);
  add(app, s);
}

/// `--fix 1 2 IN -o OUT`: --fix takes all words that follow, so the last one is the input when there is none.
void take_input(CLI::App& app, Settings& s) {
  if (!s.input.empty()) return;
  if (s.fix.size() < 2)
    throw Failure(Exit::bad_usage, "optimize: IN is missing: the mesh to improve\nSee temper optimize --help");
  s.input = s.fix.back();
  s.fix.pop_back();
  CLI::Option* fix = app.get_option("--fix");
  fix->clear();
  for (const std::string& tag : s.fix) fix->add_result(tag);
}

std::size_t find_vertex(const Input& input, const std::string& number) {
  for (const VertexId v : input.mesh().vertices()) {
    if (input.vertex_number(v) == number) return v.index;
  }
  throw Failure(Exit::bad_usage, fmt::format("{}: --anchor: there is no vertex {}", input.path, number));
}

OptimizeOptions library_options(const Settings& s, const Input& input, Executor* executor) {
  OptimizeOptions options = s.options;
  options.gamma = s.gamma.value();
  options.h0 = s.h0.value();
  if (s.positions_only) options.unknowns = Unknowns::positions;
  if (s.weights_only) options.unknowns = Unknowns::weights;
  options.flips = !s.no_flips;
  if (s.slide) options.interfaces = InterfaceVertices::sliding;
  if (!s.anchor.empty()) options.anchor = find_vertex(input, s.anchor);
  options.names = input.names.get();
  options.executor = executor;
  return options;
}

/// Options that were given and cannot have the effect one would expect.
std::vector<std::string> doubtful_options(const Settings& s) {
  const EnergyInfo energy = or_fail(find_energy(s.options.energy));
  std::vector<std::string> warnings;
  const auto idle = [&](const char* option) {
    warnings.push_back(fmt::format("{} has no effect on energy {}", option, energy.name));
  };
  if (s.gamma.value() && !energy.softened_by_gamma) idle("--gamma");
  if (s.h0.value() && !energy.softened_by_h0) idle("--h0");
  if (s.options.boundary != BoundaryTreatment::as_is && energy.kind != EnergyKind::F) idle("--boundary-treatment");
  if (!s.report.empty() && same_file(s.input, s.output)) {
    warnings.push_back("--output replaces the input: the command in the report would start from the improved mesh");
  }
  return warnings;
}

std::string ending(const OptimizeReport& report) {
  const char* sweeps = report.sweeps == 1 ? "sweep" : "sweeps";
  const std::string work =
      fmt::format("{} {} in {:.3g} s, {} flips", report.sweeps, sweeps, report.seconds, report.flips);
  switch (report.stopped) {
    case Stopped::converged:
      return "converged after " + work;
    case Stopped::max_sweeps:
      return "stopped by --max-sweeps after " + work;
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
  OptimizeReport report;
  std::string picture;  ///< SVG, when asked for
  std::vector<std::string> warnings;
};

OptimizeReport run_library(const Settings& s, const Input& input, Mesh& mesh, Executor* executor) {
  ProgressLine line(!s.quiet && error_is_terminal());
  const Observer observer = [&line](const Progress& progress) {
    line.show(progress);
    return interrupted() ? Continue::no : Continue::yes;
  };
  return or_fail(optimize(mesh, library_options(s, input, executor), observer));
}

/// Improves the mesh of the input in place: a second copy is made only when the picture needs one.
void improve(const Settings& s, Input& input, Results& results) {
  ThreadPool threads(s.threads > 0 ? s.threads : hardware_threads());
  QualityOptions measuring;
  measuring.executor = &threads;
  Mesh& mesh = input.loaded.mesh;
  const Mesh original = s.picture.empty() ? Mesh() : mesh;
  const bool measured = !s.quiet || !s.report.empty() || !s.picture.empty();  // else nobody would see it
  if (measured) results.before = quality(mesh, measuring);
  catch_interrupts();
  if (!s.quiet) {
    print(fmt::format("{}: {} vertices, {} triangles\n", s.input, results.before.vertices, results.before.triangles));
    flush_output();
  }
  results.report = run_library(s, input, mesh, &threads);
  if (measured) results.after = quality(mesh, measuring);
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

/// Cell data stay with the slot of their triangle, which flips give another place and reversal other corner numbers.
std::vector<std::string> cell_data_warnings(const Input& input, const Results& results) {
  const std::size_t flips = results.report.flips, reversed = input.loaded.reversed_triangles;
  if (input.file.cell_data.empty() || flips + reversed == 0) return {};
  std::string names;
  for (const io::DataArray& array : input.file.cell_data) names += (names.empty() ? "" : ", ") + array.name;
  return {
      fmt::format("{}: cell data ({}) stay with their triangle's number, but {} edges were flipped and {} triangles "
                  "reversed: check what depends on a triangle's place or on its local edges",
                  input.path, names, flips, reversed)};
}

/// The mesh first: it is what the time went into.
void write_all(const CLI::App& app, const Settings& s, Input& input, Results& results, Outputs& outputs) {
  const std::size_t known = input.file.warnings.size();
  io::update(input.file, input.loaded, input.loaded.mesh);
  warn(results, std::span(input.file.warnings).subspan(known));
  warn(results, cell_data_warnings(input, results));
  warn(results, outputs.write_mesh(s.output, input.file));
  if (!s.report.empty()) {
    const std::vector<UsedOption> options = used_options(app);
    const std::string command = command_line("optimize", {s.input}, options);
    outputs.write_text(s.report, optimize_json({command, options, results.before, input.points, results.after,
                                                results.report, results.warnings}));
  }
  if (!s.history.empty()) outputs.write_text(s.history, history_csv(results.report));
  if (!s.picture.empty()) outputs.write_text(s.picture, results.picture);
}

void print_result(const Settings& s, const Results& results, const Outputs& outputs) {
  print(ending(results.report) + "\n\n" + comparison_text(results.before, results.after, s.options.star, text_style()));
  for (const std::string& note : results.report.notes) print("note: " + note + "\n");
  print(fmt::format("\n{}: {}\n", s.output, verdict(results.after)));
  std::string written;
  for (const std::string& path : outputs.written()) written += (written.empty() ? "wrote " : ", ") + path;
  print(written + "\n");
}

Exit optimize_mesh(const CLI::App& app, const Settings& s, Outputs& outputs) {
  Input input = read_input(s.input, s.fix);
  Results results;
  warn(results, input.warnings());
  warn(results, doubtful_options(s));
  io::release_geometry(input.file, input.loaded);  // the mesh has it now; memory is dear on the largest ones
  improve(s, input, results);
  write_all(app, s, input, results, outputs);
  if (!s.quiet) print_result(s, results, outputs);
  const Stopped stopped = results.report.stopped;
  return stopped == Stopped::time_limit || stopped == Stopped::cancelled ? Exit::stopped_early : Exit::done;
}

}  // namespace

Exit run_optimize(const Arguments& arguments) {
  CLI::App app(
      "Moves vertices, weights them and flips edges until every triangle is well-centered: its orthocenter "
      "inside, every edge crossed by its dual. The boundary of the domain stays bit for bit.",
      "optimize");
  Settings settings;
  app.set_help_flag();
  add_group(app, settings, "Files", add_files);
  add_group(app, settings, "Energy", add_energy);
  add_group(app, settings, "Moves", add_moves);
  add_group(app, settings, "Connectivity and constraints", add_connectivity);
  add_group(app, settings, "Stopping", add_stopping);
  app.option_defaults()->group("Help");
  app.set_help_flag("-h,--help", "this text");
  set_help(app, {"IN -o OUT [options]",
                 "  temper optimize in.vtu -o out.vtu\n"
                 "  temper optimize in.vtu -o out.vtu --report report.json --draw before-after.svg\n"
                 "  temper optimize in.vtu -o out.vtu --weights-only --no-flips\n"
                 "  temper optimize in.vtu -o out.vtu --energy F --star 1 --solver golden --max-sweeps 20\n"
                 "  temper optimize in.vtu -o out.vtu --gamma-rel 0.1 --time-limit 60\n",
                 {Exit::done, Exit::bad_input, Exit::bad_usage, Exit::stopped_early, Exit::internal}});
  if (!parse(app, arguments)) return Exit::done;
  take_input(app, settings);

  Outputs outputs("optimize");
  outputs.expect_mesh("--output", settings.output);
  outputs.expect_text("--report", settings.report, {settings.input});
  outputs.expect_text("--history", settings.history, {settings.input});
  outputs.expect_text("--draw", settings.picture, {settings.input});
  return optimize_mesh(app, settings, outputs);
}

}  // namespace temper::app
