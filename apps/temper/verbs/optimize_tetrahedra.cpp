#include "verbs/optimize_tetrahedra.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <utility>
#include <vector>

#include "console.hpp"
#include "files/input.hpp"
#include "files/options_file.hpp"
#include "reports/quality_report.hpp"
#include "reports/reports.hpp"
#include "system/system.hpp"
#include "temper/solvers.hpp"
#include "temper/tets/draw.hpp"
#include "temper/tets/optimize.hpp"
#include "verbs/progress_line.hpp"
#include "verbs/save_every.hpp"

namespace temper::app {
namespace {

class TetRun {
 public:
  TetRun(const Command& command, const OptimizeSettings& s, Outputs& outputs, TetInput input, Executor* threads)
      : command_(command), s_(s), outputs_(outputs), input_(std::move(input)), threads_(threads) {}

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
    const OptimizeOptions& o = s_.options;
    const bool keeps_connectivity = o.flips == Flips::none || o.unknowns != Unknowns::positions_and_weights;
    if (s_.effort != "high" || !keeps_connectivity || o.scheme != Scheme::all) return {};
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
    hooks.error = tets::discretization_error(s_.options.scheme);
    if (s_.save_every) {
      hooks.best_so_far = saver(s_, [this](const tets::BestSoFar& best) {
        io::MeshFile file = input_.file;
        io::update(file, input_.loaded, best.mesh, best.origins, {rules_, threads_});
        return save(s_, file, threads_);
      });
    }
    Expected<tets::OptimizeReport> report = optimize(mesh_, s_.options, hooks);
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
                                        options_json(s_.options, CellKinds::tetrahedra),
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
  expect_for(command, settings, CellKinds::tetrahedra);
  settings.requirements = settings.requirement_lists.of(CellKinds::tetrahedra);
  outputs.expect_place(settings.output, tets.file);
  TetInput input = make_input(settings.input, std::move(tets.file), tets.threads);
  agree_to_go_on();
  if (!is_first_rank()) return Exit::done;
  return TetRun(command, settings, outputs, std::move(input), tets.threads).run();
}

}  // namespace temper::app
