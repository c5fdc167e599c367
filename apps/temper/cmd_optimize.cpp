// temper optimize IN -o OUT: reads, improves, writes, reports.
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <utility>

#include "console.hpp"
#include "help.hpp"
#include "input.hpp"
#include "interrupt.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "progress_line.hpp"
#include "report_json.hpp"
#include "report_text.hpp"
#include "size_report.hpp"
#include "temper/draw.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "threads.hpp"
#include "trace_jsonl.hpp"
#ifdef TEMPER_WITH_VERIFY
#include "solver_errors.hpp"
#endif

namespace temper::app {
namespace {

enum class Method { production, paper };

constexpr Choice<Method> kMethods[] = {{"production", Method::production}, {"paper", Method::paper}};
constexpr Choice<Solver> kSolvers[] = {
    {"newton", Solver::newton}, {"golden", Solver::golden}, {"alternating", Solver::alternating}};
constexpr Choice<FlipLimit> kFlipLimits[] = {{"unlimited", FlipLimit::unlimited},
                                             {"before", FlipLimit::before},
                                             {"at", FlipLimit::at},
                                             {"after", FlipLimit::after}};
constexpr Choice<Flips> kFlips[] = {
    {"immediate", Flips::immediate}, {"deferred", Flips::deferred}, {"none", Flips::none}};
constexpr Choice<StoppingRule> kStoppingRules[] = {{"relative", StoppingRule::relative},
                                                   {"paper", StoppingRule::paper}};
constexpr Choice<BoundaryTreatment> kBoundaryTreatments[] = {{"as-is", BoundaryTreatment::as_is},
                                                             {"absolute", BoundaryTreatment::absolute},
                                                             {"mirrored", BoundaryTreatment::mirrored}};
constexpr Choice<WeightUpdates> kWeightUpdates[] = {{"immediate", WeightUpdates::immediate},
                                                    {"deferred", WeightUpdates::deferred}};
constexpr Choice<Removal> kRemovals[] = {{"none", Removal::none}, {"patch", Removal::patch}};
constexpr Choice<RemovalMeasure> kRemovalMeasures[] = {
    {"sum", RemovalMeasure::sum}, {"mean", RemovalMeasure::mean}, {"excess", RemovalMeasure::excess}};
constexpr Choice<SweepOrder> kOrders[] = {{"hilbert", SweepOrder::hilbert},
                                          {"input", SweepOrder::input},
                                          {"reverse", SweepOrder::reverse},
                                          {"random", SweepOrder::random}};
constexpr Choice<BoundaryVertices> kBoundaries[] = {
    {"keep", BoundaryVertices::keep}, {"slide", BoundaryVertices::slide}, {"split", BoundaryVertices::split}};
constexpr Choice<HiddenPolicy> kHiddenPolicies[] = {
    {"undo", HiddenPolicy::undo}, {"remove", HiddenPolicy::remove}, {"keep", HiddenPolicy::keep}};
constexpr Choice<Inversion> kInversions[] = {{"refuse", Inversion::refuse}, {"allow", Inversion::allow}};
constexpr Choice<Objective> kObjectives[] = {{"energy", Objective::energy}, {"accuracy", Objective::accuracy}};
constexpr Choice<Star> kStars[] = {{"0", Star::zero}, {"1", Star::one}, {"2", Star::two}, {"all", Star::all}};

struct Settings {
  std::string input, output, report, history, picture, trace, anchor;
  std::vector<std::string> fix;
  Method method = Method::production;
  OptimizeOptions options;  ///< those of the method, where no option says otherwise
  Objective objective = Objective::energy;
  AccuracyOptions accuracy;
  Star star = Star::one;
  SofteningOptions gamma, h0;
  std::optional<io::Encoding> encoding;
  std::uint64_t threads = 0;
  bool positions_only = false, weights_only = false, no_flips = false, slide = false, quiet = false;
  bool repair = false, no_repair = false, no_newton_passes = false;
  bool verify = false;
  std::string size_field, size_data;
};

/// An energy by its name.
void add_energy_name(Command& command, const std::string& option, const std::vector<std::string_view>& names,
                     EnergyKind& target, const std::string& description) {
  const auto use = [&target](std::string_view name) { target = or_fail(find_energy(name)).kind; };
  add_name(command, option, names, use, description).defaults_to([&target] {
    return std::string(energy_info(target).name);
  });
}

void add_files(Command& command, Settings& s) {
  // Not marked as required: see take_input.
  add_argument(command, "IN", s.input, "the mesh to improve; its content tells the format");
  add_text(command, "-o,--output", "OUT", s.output,
           "where the improved mesh goes; may be IN; its suffix tells the format")
      .require();
  add_choice(
      command, "--encoding", kEncodings, [&s](io::Encoding value) { s.encoding = value; },
      "of formats that have several (default: the compact one; fastest: appended)");
  add_text(command, "--report", "FILE", s.report,
           "a JSON report: before, after, history, and the command to run again");
  add_text(command, "--history", "FILE", s.history, "one line of CSV a sweep");
  add_text(command, "--trace", "FILE", s.trace,
           "every move, flip and removal, one JSON object a line; see temper replay");
  add_text(command, "--draw", "FILE", s.picture, "an SVG picture, before and after side by side");
#ifdef TEMPER_WITH_VERIFY
  command.add_flag(
      "--verify", s.verify,
      "also measure the errors of solvers before and after, as temper verify does; with --objective accuracy "
      "an input that is well-centered and has the smaller ones is returned");
#endif
  command.add_flag("--quiet", s.quiet, "print warnings and errors only");
}

void add_energy(Command& command, Settings& s) {
  std::vector<std::string_view> names;
  for (const EnergyInfo& energy : energies()) names.push_back(energy.name);
  add_energy_name(command, "--energy", names, s.options.energy,
                  "what to minimise: a barrier (BH, BHs, BP) or a HOT energy (F, T, dT)");
  add_choice(
      command, "--star", kStars, s.star,
      "Hodge star of the energy, or of --objective accuracy, whose first sweeps are for star 1 then; all: accuracy "
      "alone");
  add_gamma(command, s.gamma,
            "; without it relative to each edge, shrinking from 0.5, or 1 where many triangles are bad, to 0.003");
  command.option("--gamma").defaults_to([&s] {  // the paper's
    const std::optional<Softening>& gamma = s.options.paper.gamma;
    return gamma && !s.gamma.value() ? fmt::format("{}", gamma->value) : std::string();
  });
  add_h0(command, s.h0, "; without it just beyond the least h of the mesh, following it up");
  add_choice(command, "--boundary-treatment", kBoundaryTreatments, s.options.paper.boundary_treatment,
             "of energy F: the h of boundary edges as it is, |h|, or as if the mesh were mirrored there");
}

void add_accuracy(Command& command, Settings& s) {
  const double most = std::numeric_limits<double>::infinity();
  AccuracyOptions& a = s.accuracy;
  add_choice(
      command, "--objective", kObjectives, s.objective,
      "energy: the one of --energy, to the end; accuracy: only until every triangle is well-centered with a "
      "margin, then how far the middles of edges and duals are apart, which a solver's error is proportional to");
  add_number(command, "--margin", a.margin, {0, 0.25, true},
             "of accuracy: h/l, d/l and 1 - d/l stay above it in every triangle");
  add_number(
      command, "--offset-weight", a.offset_weight, kNotNegative,
      "of accuracy: how many times as much as in HOT the offset of the middles counts; 1: HOT over size squared");
  add_number(
      command, "--boundary-offset-weight", a.boundary_offset_weight, kNotNegative,
      "of accuracy: the same of the height of boundary edges; 0.5 where unknowns are at vertices and the input is "
      "symmetric");
  add_number(command, "--barrier", a.barrier, {0, most, true},
             "of accuracy: factor of the logarithms that keep the margin");
  add_count(command, "--accuracy-sweeps", a.sweeps, 0, "of accuracy: at most this many, after those for the energy");
  add_number(command, "--accuracy-tolerance", a.tolerance, kNotNegative,
             "of accuracy: stop when a sweep gains less than this part");
}

/// After all options, since --method replaces those of the library.
void settle_objective(Settings& s) {
  const bool for_accuracy = s.objective == Objective::accuracy;
  if (!for_accuracy && s.star == Star::all) {
    throw Failure(
        Exit::bad_usage,
        "optimize: --star all is for --objective accuracy; of an energy expected 0, 1 or 2\nSee temper optimize "
        "--help");
  }
  s.options.objective = s.objective;
  s.options.accuracy = s.accuracy;
  s.options.star = s.star;
}

void add_moves(Command& command, Settings& s) {
  add_choice(
      command, "--solver", kSolvers, s.options.paper.solver,
      "Newton steps in position and weight together; the paper's golden section; Newton in position, then weight");
  command.add_flag("--positions-only", s.positions_only, "leave the weights as they are");
  command.add_flag("--weights-only", s.weights_only, "leave the positions as they are").excludes = "--positions-only";
  add_count(command, "--weights-from", s.options.paper.weights_from, 0, "first sweep that changes weights, from 0");
  add_number(command, "--relaxation", s.options.paper.relaxation, {0, 2, true},
             "over-relaxation of Newton steps; without it 1.7, but 1.97 while gamma shrinks from 1");
  command.add_flag(
      "--no-newton-passes", s.no_newton_passes,
      "sweeps alone to the end: no steps of all vertices at once, which barriers make in every other sweep once "
      "every triangle is well-centered");
  add_text(
      command, "--anchor", "VERTEX", s.anchor,
      "shift the weights after each sweep so that this vertex has weight 0 (its number in the file); none: do not");
}

void add_connectivity(Command& command, Settings& s) {
  command.add_flag("--no-flips", s.no_flips, "keep the connectivity; no step may make an edge non-regular");
  add_choice(
      command, "--flips", kFlips, [&s](Flips value) { s.options.flips = value; },
      "flip edges at once, after the inner sweeps, or never, as --no-flips")
      .defaults_to([&s] { return std::string(kFlips[static_cast<std::size_t>(s.options.flips)].name); });
  add_choice(
      command, "--flip-limit", kFlipLimits, [&s](FlipLimit value) { s.options.paper.flip_limit = value; },
      "how far a step may go past the point where an edge flips (default: unlimited for barriers, after for HOT)")
      .defaults_to([&s] {
        if (!s.options.paper.flip_limit) return std::string();
        return std::string(kFlipLimits[static_cast<std::size_t>(*s.options.paper.flip_limit)].name);
      });
  add_number(command, "--overshoot", s.options.paper.overshoot, {1, std::numeric_limits<double>::infinity(), false},
             "of --flip-limit after, at first: it shrinks towards 1 each sweep");
  command.add_flag("--repair", s.repair,
                   "where sweeps leave triangles bad: remove and insert vertices there, too, and keep what cures most");
  command
      .add_flag("--no-repair", s.no_repair,
                "do not even sweep again and kick vertices there, which barriers do by default")
      .excludes = "--repair";
  add_count(command, "--repair-trials", s.options.repair_trials, 0, "at most so many edits are tried, 1 to 3 ms each");
  add_texts(command, "--fix", "TAG ...", Values::words, s.fix,
            "vertices with this tag or physical name stay where they are; several may follow");
  add_choice(
      command, "--boundary", kBoundaries, s.options.boundary,
      "keep: the domain's boundary stays bit for bit; slide: vertices of its straight pieces, never corners, may "
      "move along them; split: edges of boundary and interfaces much longer than one they meet are cut before "
      "the sweeps, and the vertices that were there stay bit for bit");
  add_number(command, "--boundary-ratio", s.options.boundary_ratio, {2, std::numeric_limits<double>::infinity(), false},
             "of --boundary split: how many times as long an edge may be as one it meets");
  command.add_flag("--slide-interfaces", s.slide,
                   "vertices of straight region interfaces and tagged lines may move along them");
}

void add_size(Command& command, Settings& s) {
  add_text(command, "--size-field", "FILE", s.size_field,
           "a mesh file whose point data say how long edges are meant to be where; without it the input's own sizes");
  add_text(command, "--size-field-data", "NAME", s.size_data, "of the point data in that file (default: size)");
  add_number(command, "--size-band", s.options.size_band, {1, std::numeric_limits<double>::infinity(), false},
             "B: no step takes the size at a vertex out of the size field's 1/B to B times; without it sizes are only "
             "reported");
}

void add_paper(Command& command, Settings& s) {
  // At once, before all other options are taken: those given override the method's.
  Option& method = add_choice(
      command, "--method", kMethods,
      [&s](Method value) {
        s.method = value;
        if (value == Method::paper) s.options = paper_method();
      },
      "what all options start from; paper: its Algorithm 1 with golden section, deferred flips, collapses, the patch "
      "test, inversions allowed, the first vertex as anchor and gamma 1");
  method.at_once = true;
  method.default_text = "production";
  add_count(command, "--inner", s.options.paper.inner, 0,
            "with deferred flips: at most so many sweeps before edges are flipped; 0: until they converge");
  add_count(command, "--outer", s.options.paper.outer, 0,
            "with deferred flips: at most so many rounds of sweeps and flips; 0: until no flips are needed");
  add_choice(command, "--weight-updates", kWeightUpdates, s.options.paper.weight_updates,
             "a new weight is seen by its neighbours at once, or after the sweep (not with --solver newton)");
  add_count(command, "--collapse-from", s.options.paper.collapse_from, 0,
            "i_c: first sweep with short-edge collapses, from 0 (Algorithm 2)");
  std::vector<std::string_view> names;
  for (const EnergyInfo& energy : energies()) {
    if (!energy.barrier) names.push_back(energy.name);
  }
  add_energy_name(command, "--collapse-energy", names, s.options.paper.collapse_energy,
                  "E_c, which draws a vertex to an edge");
  add_number(command, "--collapse-ratio", s.options.paper.collapse_ratio, {0, 1, true},
             "collapse a vertex that E_c wants this near its neighbour, relative to that one's shorter edge beside");
  add_choice(command, "--removal", kRemovals, s.options.paper.removal,
             "patch: remove a vertex when its patch is better without it (Algorithm 1, line 15)");
  add_choice(command, "--removal-measure", kRemovalMeasures, s.options.paper.removal_measure,
             "by what patches are compared: energy summed (the paper), per triangle, or above equilateral triangles");
  add_number(command, "--removal-margin", s.options.paper.removal_margin, kNotNegative,
             "by which part the patch must be better");
  add_count(command, "--removal-from", s.options.paper.removal_from, 0, "first sweep with removals, from 0");
  add_choice(command, "--hidden", kHiddenPolicies, s.options.paper.hidden,
             "what weights hide: undo the step, remove the vertex, or keep and report it");
  add_choice(command, "--inversion", kInversions, s.options.paper.inversion,
             "steps that turn a triangle over are refused, or allowed as in the paper (with deferred flips)");
  add_choice(command, "--order", kOrders, s.options.paper.order, "in which a sweep visits the vertices");
}

void add_stopping(Command& command, Settings& s) {
  add_count(command, "--max-sweeps", s.options.max_sweeps, 0, "at most this many sweeps over the vertices");
  add_number(command, "--tolerance", s.options.paper.tolerance, kNotNegative, "stop when a sweep gains less than this");
  add_choice(command, "--stopping", kStoppingRules, s.options.paper.stopping,
             "the gain relative to the energy, or the paper's: mean energy per triangle, absolute");
  add_number(command, "--time-limit", s.options.time_limit, kNotNegative, "stop after this many seconds; 0: no limit");
  add_count(command, "--threads", s.threads, 0, "threads; 0: as many as the machine has; the result is the same");
  add_count(command, "--seed", s.options.paper.seed, 0,
            "of the jitter that frees symmetric grids, of repairs, and of --order random");
}

/// Options added by `add` go under a title in --help.
void add_group(Command& command, Settings& s, const std::string& title, void (*add)(Command&, Settings&)) {
  command.group(title);
  add(command, s);
}

/// `--fix 1 2 IN -o OUT`: --fix takes all words that follow, so the last one is the input when there is none.
void take_input(Command& command, Settings& s) {
  if (!s.input.empty()) return;
  if (s.fix.size() < 2)
    throw Failure(Exit::bad_usage, "optimize: IN is missing: the mesh to improve\nSee temper optimize --help");
  s.input = s.fix.back();
  s.fix.pop_back();
  command.option("--fix").given = s.fix;
}

std::size_t find_vertex(const Input& input, const std::string& number) {
  for (const VertexId v : input.mesh().vertices()) {
    if (input.vertex_number(v) == number) return v.index;
  }
  throw Failure(Exit::bad_usage, fmt::format("{}: --anchor: there is no vertex {}", input.path, number));
}

OptimizeOptions library_options(const Settings& s, const Input& input) {
  OptimizeOptions options = s.options;
  if (s.gamma.value()) options.paper.gamma = s.gamma.value();
  if (s.h0.value()) options.paper.h0 = s.h0.value();
  if (s.positions_only) options.unknowns = Unknowns::positions;
  if (s.weights_only) options.unknowns = Unknowns::weights;
  if (s.repair) options.repair = Repair::vertices;
  if (s.no_repair) options.repair = Repair::none;
  if (s.no_newton_passes) options.paper.newton_passes = false;
  if (s.slide) options.interfaces = InterfaceVertices::sliding;
  if (s.anchor == kNone) {
    options.paper.anchor = {};
  } else if (!s.anchor.empty()) {
    options.paper.anchor = VertexId(find_vertex(input, s.anchor));
  }
  return options;
}

/// Switches that need another one, and are not as they would be anyway: the command of a report gives defaults, too.
std::vector<std::string> idle_switches(const Command& command, const Settings& s, const EnergyInfo& energy) {
  std::vector<std::string> warnings;
  const OptimizeOptions& o = s.options;
  const OptimizeOptions usual = s.method == Method::paper ? paper_method() : OptimizeOptions();
  const auto idle_unless = [&](bool used, std::initializer_list<std::pair<const char*, bool>> options,
                               const char* needed) {
    for (const auto& [option, changed] : options) {
      if (!used && changed && command.was_given(option)) {
        warnings.push_back(fmt::format("{} has no effect {}", option, needed));
      }
    }
  };
  const FlipLimit limit = o.paper.flip_limit.value_or(energy.barrier ? FlipLimit::unlimited : FlipLimit::after);
  idle_unless(limit == FlipLimit::after && o.flips != Flips::none,
              {{"--overshoot", o.paper.overshoot != usual.paper.overshoot}},
              o.flips != Flips::none ? "without --flip-limit after" : "without flips");
  idle_unless(o.paper.solver != Solver::golden, {{"--relaxation", o.paper.relaxation != usual.paper.relaxation}},
              "with --solver golden");
  idle_unless(o.boundary == BoundaryVertices::split, {{"--boundary-ratio", o.boundary_ratio != usual.boundary_ratio}},
              "without --boundary split");
  idle_unless(s.options.flips == Flips::deferred,
              {{"--inner", o.paper.inner != usual.paper.inner}, {"--outer", o.paper.outer != usual.paper.outer}},
              "without --flips deferred");
  idle_unless(o.paper.collapse_from.has_value(),
              {{"--collapse-energy", o.paper.collapse_energy != usual.paper.collapse_energy},
               {"--collapse-ratio", o.paper.collapse_ratio != usual.paper.collapse_ratio}},
              "without --collapse-from");
  idle_unless(o.paper.removal == Removal::patch,
              {{"--removal-measure", o.paper.removal_measure != usual.paper.removal_measure},
               {"--removal-margin", o.paper.removal_margin != usual.paper.removal_margin},
               {"--removal-from", o.paper.removal_from != usual.paper.removal_from}},
              "without --removal patch");
  const AccuracyOptions &a = s.accuracy, &first = usual.accuracy;
  idle_unless(s.objective == Objective::accuracy,
              {{"--margin", a.margin != first.margin},
               {"--offset-weight", a.offset_weight != first.offset_weight},
               {"--boundary-offset-weight", a.boundary_offset_weight != first.boundary_offset_weight},
               {"--barrier", a.barrier != first.barrier},
               {"--accuracy-sweeps", a.sweeps != first.sweeps},
               {"--accuracy-tolerance", a.tolerance != first.tolerance}},
              "without --objective accuracy");
  return warnings;
}

/// Options that were given and cannot have the effect one would expect.
std::vector<std::string> doubtful_options(const Command& command, const Settings& s) {
  const EnergyInfo& energy = energy_info(s.options.energy);
  std::vector<std::string> warnings;
  const auto idle = [&](const char* option) {
    warnings.push_back(fmt::format("{} has no effect on energy {}", option, energy.name));
  };
  if (s.repair && !energy.barrier) idle("--repair");
  if (s.repair && (s.weights_only || s.options.flips == Flips::none)) {
    warnings.push_back("--repair has no effect where " + std::string(s.weights_only ? "positions" : "edges") +
                       " may not change");
  }
  if (s.no_repair && command.was_given("--repair-trials")) {
    warnings.push_back("--repair-trials has no effect with --no-repair");
  }
  if (s.repair && s.options.size_band) {
    warnings.push_back("vertices that --repair removes and inserts are not held to --size-band");
  }
  if (s.gamma.value() && !energy.softened_by_gamma) idle("--gamma");
  if (s.h0.value() && !energy.softened_by_h0) idle("--h0");
  if (s.options.paper.boundary_treatment != BoundaryTreatment::as_is && energy.kind != EnergyKind::F)
    idle("--boundary-treatment");
  if (s.size_field.empty() && command.was_given("--size-field-data")) {
    warnings.push_back("--size-field-data has no effect without --size-field");
  }
  for (std::string& warning : idle_switches(command, s, energy)) warnings.push_back(std::move(warning));
  if (!s.report.empty() && same_file(s.input, s.output)) {
    warnings.push_back("--output replaces the input: the command in the report would start from the improved mesh");
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
  OptimizeReport report;
  std::string picture;                   ///< SVG, when asked for
  std::string errors_text, errors_json;  ///< of solvers, when asked for
  std::vector<std::string> warnings;
};

OptimizeReport run_library(const Settings& s, const Input& input, Mesh& mesh, Executor* executor, Tracer tracer) {
  ProgressLine line(!s.quiet && error_is_terminal());
  const Observer observer = [&line](const Progress& progress) {
    line.show(progress);
    return interrupted() ? Continue::no : Continue::yes;
  };
  OptimizeHooks hooks;
  hooks.executor = executor;
  hooks.names = input.names.get();
  hooks.observer = observer;
  hooks.tracer = std::move(tracer);
  return or_fail(optimize(mesh, library_options(s, input), hooks));
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
  if (s.objective == Objective::accuracy && errors.input_was_better()) {
    return_input(mesh, original, errors.mean_ratio(), results.report, tracer);
    errors.measure_result(mesh);
  }
  results.errors_text = errors.text(text_style());
  results.errors_json = errors.json();
}
#endif

/// Improves the mesh of the input in place: a second copy is made only when the picture or --verify needs one.
void improve(const Settings& s, Input& input, Results& results, io::TextStream* trace, Executor* threads) {
  QualityOptions measuring;
  measuring.executor = threads;
  Mesh& mesh = input.loaded.mesh;
  const bool may_return_input = s.verify && s.objective == Objective::accuracy;
  const Mesh original = s.picture.empty() && !may_return_input ? Mesh() : mesh;
  const bool measured = !s.quiet || !s.report.empty() || !s.picture.empty();  // else nobody would see it
  if (measured) results.before = quality(mesh, measuring);
  catch_interrupts();
  if (!s.quiet) {
    print(fmt::format("{}: {} vertices, {} triangles\n", s.input, results.before.vertices, results.before.triangles));
    flush_output();
  }
  Tracer tracer;
  std::size_t n_events = 0;
  if (trace != nullptr) {
    trace->write(trace_header(input));
    tracer = [trace, &input, &n_events](const TraceEvent& event) {
      trace->write(trace_line(event, input));
      ++n_events;
    };
  }
#ifdef TEMPER_WITH_VERIFY
  std::optional<SolverErrors> errors;
  if (s.verify) errors.emplace(mesh, threads);
  results.report = run_library(s, input, mesh, threads, tracer);
  if (errors) verify_result(s, *errors, mesh, original, results, tracer);
#else
  results.report = run_library(s, input, mesh, threads, tracer);
#endif
  if (trace != nullptr) trace->write(trace_end(n_events, mesh, input));
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
  const bool by_region = !results.report.vertices.empty();  // what is left then is the same all over each region
  if (input.file.cell_data.empty() || flips + reversed == 0 || by_region) return {};
  std::string names;
  for (const io::DataArray& array : input.file.cell_data) names += (names.empty() ? "" : ", ") + array.name;
  return {
      fmt::format("{}: cell data ({}) stay with their triangle's number, but {} edges were flipped and {} triangles "
                  "reversed: check what depends on a triangle's place or on its local edges",
                  input.path, names, flips, reversed)};
}

/// The mesh first: it is what the time went into.
void write_all(const Command& command, const Settings& s, Input& input, Results& results, Outputs& outputs,
               io::TextStream* trace, Executor* threads) {
  const std::size_t known = input.file.warnings.size();
  io::update(input.file, input.loaded, input.loaded.mesh, results.report.vertices);
  warn(results, std::span(input.file.warnings).subspan(known));
  warn(results, cell_data_warnings(input, results));
  io::WriteOptions writing;
  writing.encoding = s.encoding;
  writing.executor = threads;
  warn(results, outputs.write_mesh(s.output, input.file, writing));
  if (trace != nullptr) outputs.commit(s.trace, *trace);
  if (!s.report.empty()) {
    const std::vector<UsedOption> options = used_options(command);
    const std::string again = command_line("optimize", {s.input}, options);
    outputs.write_text(s.report, optimize_json({again, options, results.before, input.points, results.after,
                                                results.report, results.warnings, results.errors_json}));
  }
  if (!s.history.empty()) outputs.write_text(s.history, history_csv(results.report));
  if (!s.picture.empty()) outputs.write_text(s.picture, results.picture);
}

/// The row of energies that is of interest.
int star_shown(const OptimizeOptions& options) {
  return options.objective == Objective::accuracy ? 1 : static_cast<int>(options.star);
}

void print_result(const Settings& s, const Results& results, const Outputs& outputs) {
  print(ending(results.report) + "\n\n" +
        comparison_text(results.before, results.after, star_shown(s.options), text_style()) +
        size_text(results.report.size));
  if (!results.errors_text.empty()) print("\n" + results.errors_text);
  for (const std::string& note : results.report.notes) print("note: " + note + "\n");
  print(fmt::format("\n{}: {}\n", s.output, verdict(results.after)));
  std::string written;
  for (const std::string& path : outputs.written()) written += (written.empty() ? "wrote " : ", ") + path;
  print(written + "\n");
}

Exit optimize_mesh(const Command& command, Settings& s, Outputs& outputs) {
  const std::unique_ptr<Executor> threads = make_threads(s.threads);
  Input input = read_input(s.input, s.fix, threads.get());
  Results results;
  warn(results, input.warnings());
  warn(results, doubtful_options(command, s));
  if (!s.size_field.empty()) {
    ReadSizeField read = read_size_field(s.size_field, s.size_data.empty() ? "size" : s.size_data);
    warn(results, read.warnings);
    s.options.size_field = std::move(read.field);
  }
  // The mesh has its geometry now, and memory is dear on the largest ones; data of new points need that of before.
  if (input.file.point_data.empty()) io::release_geometry(input.file, input.loaded);
  std::optional<io::TextStream> trace;
  if (!s.trace.empty()) trace = outputs.open(s.trace);
  improve(s, input, results, trace ? &*trace : nullptr, threads.get());
  write_all(command, s, input, results, outputs, trace ? &*trace : nullptr, threads.get());
  if (!s.quiet) print_result(s, results, outputs);
  const Stopped stopped = results.report.stopped;
  return stopped == Stopped::time_limit || stopped == Stopped::cancelled ? Exit::stopped_early : Exit::done;
}

}  // namespace

Exit run_optimize(const Arguments& arguments) {
  Command command(
      "optimize",
      "Moves vertices, weights them and flips edges until every triangle is well-centered: its orthocenter "
      "inside, every edge crossed by its dual. The boundary of the domain stays bit for bit, unless --boundary says "
      "otherwise.");
  Settings settings;
  add_group(command, settings, "Files", add_files);
  add_group(command, settings, "Energy", add_energy);
  add_group(command, settings, "Accuracy", add_accuracy);
  add_group(command, settings, "Moves", add_moves);
  add_group(command, settings, "Connectivity and constraints", add_connectivity);
  add_group(command, settings, "Size", add_size);
  add_group(command, settings, "The paper's switches", add_paper);
  add_group(command, settings, "Stopping", add_stopping);
  command.group("Help");
  command.add_help({"IN -o OUT [options]",
                    "  temper optimize in.vtu -o out.vtu\n"
                    "  temper optimize in.vtu -o out.vtu --report report.json --draw before-after.svg\n"
                    "  temper optimize in.vtu -o out.vtu --weights-only --no-flips\n"
                    "  temper optimize in.vtu -o out.vtu --energy F --star 1 --solver golden --max-sweeps 20\n"
                    "  temper optimize in.vtu -o out.vtu --gamma-rel 0.1 --time-limit 60\n"
                    "  temper optimize in.vtu -o out.vtu --objective accuracy --verify\n"
                    "  temper optimize in.vtu -o out.vtu --removal patch --trace trace.jsonl\n"
                    "  temper optimize in.vtu -o out.vtu --method paper --energy dT --removal none\n",
                    {Exit::done, Exit::bad_input, Exit::bad_usage, Exit::stopped_early, Exit::internal}});
  if (!command.parse(arguments)) return Exit::done;
  take_input(command, settings);
  settle_objective(settings);
  if (settings.no_flips) {
    if (command.was_given("--flips") && settings.options.flips != Flips::none) {
      throw Failure(Exit::bad_usage, "optimize: --no-flips contradicts --flips " +
                                         command.option("--flips").given.front() + "\nSee temper optimize --help");
    }
    settings.options.flips = Flips::none;
  }
  command.spell_defaults();  // --method may have changed them

  Outputs outputs("optimize");
  const std::vector<std::string> inputs = {settings.input, settings.size_field};
  outputs.expect_mesh("--output", settings.output, "", {settings.size_field});
  outputs.expect_text("--report", settings.report, inputs);
  outputs.expect_text("--history", settings.history, inputs);
  outputs.expect_text("--trace", settings.trace, inputs);
  outputs.expect_text("--draw", settings.picture, inputs);
  return optimize_mesh(command, settings, outputs);
}

}  // namespace temper::app
