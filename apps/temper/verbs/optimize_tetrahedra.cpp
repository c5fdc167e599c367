#include "verbs/optimize_tetrahedra.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "console.hpp"
#include "files/input.hpp"
#include "files/options_file.hpp"
#include "reports/quality_report.hpp"
#include "reports/reports.hpp"
#include "system/system.hpp"
#include "temper/energy.hpp"
#include "temper/solvers.hpp"
#include "temper/tets/draw.hpp"
#include "temper/tets/optimize.hpp"
#include "verbs/progress_line.hpp"
#include "verbs/save_every.hpp"

namespace temper::app {
namespace {

/// The options that have a meaning for tetrahedra. All others are refused by name.
constexpr auto kOptions = std::to_array<std::string_view>(
    {"IN", "--output", "--format", "--encoding", "--for", "--effort", "--keep", "--boundary", "--require",
     "--time-limit", "--write", "--set", "--options", "--details", "--quiet", "--point-data", "--threads",
     "--no-triangle-quality", "--save-every"});

template <class Names>
bool has(const Names& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

void refuse_options(const Command& command, const OptimizeSettings& s) {
  const auto refuse = [&](bool given, const std::string& name) {
    refuse_for_tetrahedra("optimize", s.input, {{given, name}});
  };
  for (const Option& option : command.options()) {
    const std::string name = long_name(option.names);
    refuse(!option.given.empty() && !has(kOptions, name), name);
  }
  refuse(!s.files.trace.empty(), fmt::format("--write {}, a trace,", s.files.trace));
}

tets::OptimizeOptions options_of(const OptimizeSettings& s) {
  const std::vector<std::string_view> keep(s.keep.begin(), s.keep.end());
  std::vector<std::string_view> rows;
  for (const Assignment& a : s.assignments) rows.push_back(a.row->name);
  const Expected<tets::OptimizeOptions> options = tets::options_from(s.options, {s.target, s.effort, keep, rows});
  if (!options)
    refuse_usage("optimize", fmt::format("{} has tetrahedra, and {}", s.input, spell_options(options.error().message)));
  return *options;
}

std::string settings_json(const OptimizeSettings& s, const tets::OptimizeOptions& options) {
  using Json = nlohmann::ordered_json;
  return Json({{"keep_positions", options.keep_positions},
               {"keep_weights", options.keep_weights},
               {"keep_edges", options.keep_edges},
               {"repair_trials", options.repair_trials},
               {"slide_boundary", options.slide_boundary},
               {"split_boundary", options.split_boundary},
               {"search_each", options.search_each},
               {"small_margin", options.small_margin},
               {"target", s.target},
               {"energy", energy_info(s.options.energy).name},
               {"star", options.hot_star ? Json(static_cast<int>(*options.hot_star)) : Json()},
               {"accuracy_steps", options.accuracy_steps},
               {"max_sweeps", options.max_sweeps},
               {"time_limit", options.time_limit}})
      .dump();
}

class TetRun {
 public:
  TetRun(const Command& command, const OptimizeSettings& s, const tets::OptimizeOptions& options, Outputs& outputs,
         TetInput input, Executor* threads)
      : command_(command), s_(s), options_(options), outputs_(outputs), input_(std::move(input)), threads_(threads) {}

  Exit run() {
    warn(input_.warnings());
    warn(warning_of_replaced_input(s_));
    warn(warning_of_effort());
    rules_ = data_rules(s_.point_data, input_.path, input_.file.point_data);
    io::release_geometry(input_.file, input_.loaded);  // the mesh has it
    before_ = quality(input_.mesh(), {kWorst, threads_});
    improve();
    after_ = quality(mesh_, {kWorst, threads_});
    outcomes_ = judge(s_.requirements, after_);
    write();
    if (!is_quiet()) print_result();
    flush_output();  // before the verdict on standard error
    if (const Exit verdict = report_unmet(outcomes_, s_.output.path); verdict != Exit::done) return verdict;
    return stopped_early(report_.stopped) ? Exit::stopped_early : Exit::done;
  }

 private:
  static constexpr std::size_t kWorst = tets::QualityOptions().worst;

  void warn(std::span<const std::string> warnings) {
    print_warnings(warnings);
    warnings_.insert(warnings_.end(), warnings.begin(), warnings.end());
  }
  /// More trials change the connectivity or lower errors. Some runs do neither.
  [[nodiscard]] std::vector<std::string> warning_of_effort() const {
    const bool lowers_errors = options_.scheme == Scheme::vertex || options_.scheme == Scheme::cell;
    if (s_.effort != "high" || !(options_.keep_edges || options_.keep_positions || options_.keep_weights) ||
        lowers_errors)
      return {};
    return {
        fmt::format("--effort high has no effect with --keep {}, which allows no new connectivity. Next: leave one "
                    "of them out",
                    fmt::join(s_.keep, ","))};
  }
  void improve() {
    catch_interrupts();
    print(fmt::format("{}: {}\n", s_.input, mesh_size(before_)));
    flush_output();
    ProgressLine line(!is_quiet() && error_is_terminal(), "tetrahedra");
    tets::OptimizeHooks hooks;
    hooks.executor = threads_;
    hooks.started = s_.started;
    hooks.observer = [&line](const Progress& progress) {
      line.show(progress);
      return interrupted() ? Continue::no : Continue::yes;
    };
    mesh_ = input_.mesh();
    hooks.error = tets::discretization_error(options_.scheme);
    if (s_.save_every) {
      hooks.best_so_far = saver(s_, [this](const tets::BestSoFar& best) {
        io::MeshFile file = input_.file;
        io::update(file, input_.loaded, best.mesh, best.origins, {rules_, threads_});
        return save(s_, file, threads_);
      });
    }
    Expected<tets::OptimizeReport> report = optimize(mesh_, options_, hooks);
    if (!report) throw as_failure(spell_options(report.error()));
    report_ = *std::move(report);
  }
  /// Writes the mesh first, as it took the most time.
  void write() {
    const std::size_t known = input_.file.warnings.size();
    data_ = io::update(input_.file, input_.loaded, mesh_, report_.origins, {rules_, threads_});
    warn(std::span(input_.file.warnings).subspan(known));
    warn(outputs_.write_mesh(s_.output, input_.file, threads_));
    if (!s_.files.report.empty() || !s_.files.page.empty()) {
      const TetOptimizeRecord record = {command_line(command_, {s_.input}),
                                        options_json(command_, s_.assignments),
                                        settings_json(s_, options_),
                                        before_,
                                        input_.points,
                                        after_,
                                        report_,
                                        data_,
                                        outcomes_,
                                        warnings_};
      if (!s_.files.report.empty()) outputs_.write_text(s_.files.report, optimize_json(record));
      if (!s_.files.page.empty())
        outputs_.write_text(s_.files.page, optimize_html(TetOptimizePage{record, input_, input_.mesh(), mesh_}));
    }
    if (!s_.files.picture.empty())
      outputs_.write_picture(s_.files.picture,
                             draw_before_after_svg(input_.mesh(), mesh_, tets::middle_plane(input_.mesh())));
    if (!s_.files.history.empty()) outputs_.write_text(s_.files.history, history_csv(report_.history));
  }
  void print_result() const {
    print(brief_text(before_, after_));
    if (s_.details) print_details();
    print(fmt::format("{}{}\n", ending(report_.stopped), work_done(report_)));
    print(fmt::format("wrote {}\n", fmt::join(outputs_.written(), ", ")));
    if (after_.orthocenters_outside > 0 && !io::is_stream(s_.output.path))
      print(fmt::format("Next: {}\n", command_line("explain", s_.output.path, {})));
  }
  void print_details() const {
    print("\n" + comparison_text(before_, after_));
    if (const std::string data = data_text(data_, "tetrahedron", "tetrahedra"); !data.empty()) print("\n" + data);
    print(fmt::format("objective energy: {:.6g} before, {:.6g} after\n\n", report_.objective_before,
                      report_.objective_after));
  }

  const Command& command_;
  const OptimizeSettings& s_;
  const tets::OptimizeOptions& options_;
  Outputs& outputs_;
  TetInput input_;
  Executor* threads_;
  io::DataRules rules_;
  tets::TetMesh mesh_;
  tets::Quality before_, after_;
  tets::OptimizeReport report_;
  io::DataReport data_;
  std::vector<Outcome> outcomes_;
  std::vector<std::string> warnings_;
};

}  // namespace

Exit optimize_tetrahedra(const Command& command, OptimizeSettings& settings, Outputs& outputs, TetsToOptimize tets) {
  refuse_options(command, settings);
  const tets::OptimizeOptions options = options_of(settings);
  settings.requirements = settings.requirement_lists.of(MeshKind::tetrahedra);
  outputs.expect_place(settings.output, tets.file);
  TetInput input = make_input(settings.input, std::move(tets.file), tets.threads);
  agree_to_go_on();
  if (!is_first_rank()) return Exit::done;
  return TetRun(command, settings, options, outputs, std::move(input), tets.threads).run();
}

}  // namespace temper::app
