// temper optimize IN -o OUT: reads, improves, writes, reports.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "console.hpp"
#include "exit.hpp"
#include "files/input.hpp"
#include "files/options_file.hpp"
#include "files/outputs.hpp"
#include "options/options.hpp"
#include "options/ranks.hpp"
#include "options/requirement.hpp"
#include "reports/quality_report.hpp"
#include "reports/reports.hpp"
#include "system/system.hpp"
#include "threads.hpp"
#include "verbs/optimize_run.hpp"
#include "verbs/optimize_settings.hpp"

namespace temper::app {
namespace {

/// Writes the page, for the kinds that have one.
template <class Subject>
void write_page(const std::string& path, const RunPage<Subject>& page, Outputs& outputs) {
  if constexpr (is_flat_subject<Subject>) outputs.write_text(path, optimize_html(page));
}

/// Writes the report and the page.
template <class Subject>
void write_reports(const Command& command, const OptimizeSettings& s, const InputOf<Subject>& input,
                   const RunResults<Subject>& results, Outputs& outputs) {
  if (s.files.report.empty() && s.files.page.empty()) return;
  const RunRecord<Subject> record = {command_line(command, {s.input}),
                                     options_json(command, s.assignments),
                                     options_json(s.options, Subject::cells),
                                     results.before,
                                     input.points,
                                     results.after,
                                     results.report,
                                     results.data,
                                     results.outcomes,
                                     results.warnings,
                                     results.errors_json};
  if (!s.files.report.empty()) outputs.write_text(s.files.report, optimize_json(record));
  if (!s.files.page.empty())
    write_page(s.files.page, RunPage<Subject>{record, input, *results.original, *results.improved}, outputs);
}

/// Writes the mesh first, as it took the most time.
template <class Subject>
void write_all(const Command& command, const OptimizeSettings& s, InputOf<Subject>& input, const RunFiles& files,
               RunResults<Subject>& results, Outputs& outputs) {
  const std::size_t known = input.file.warnings.size();
  return_freed_memory();
  results.data = io::update(input.file, input.loaded, *results.improved, parts_of(results.report),
                            with_threads(s.data, files.threads));
  add_corner_weights(results.report, input.file);
  if (s.files.page.empty()) release_mesh(input, results);
  warn(results, std::span(input.file.warnings).subspan(known));
  warn(results, outputs.write_mesh(s.output, input.file, files.threads));
  if (files.trace != nullptr) outputs.commit(s.files.trace, files.trace->stream);
  write_reports(command, s, input, results, outputs);
  if (!s.files.history.empty()) outputs.write_text(s.files.history, history_csv(results.report.history));
  if (!s.files.picture.empty()) outputs.write_picture(s.files.picture, results.picture);
}

/// What --details adds.
template <class Subject>
std::string details_text(const OptimizeSettings& s, const RunResults<Subject>& results) {
  const auto& report = results.report;
  std::string text = "\n" + measures_text(s, results);
  if (const std::string data = data_text(results.data, Subject::element, Subject::elements); !data.empty())
    text += "\n" + data;
  text += labeled_text(view_of(report), {kLabelColumns, kNumberColumns});
  for (const std::string& note : report.notes) text += "note: " + note + "\n";
  return text + "\n";
}

template <class Subject>
void print_result(const OptimizeSettings& s, const RunResults<Subject>& results, const Outputs& outputs) {
  print(brief_text(results.before, results.after));
  if constexpr (requires { results.report.turns_after; })
    print(turns_text(results.report.turns_before, results.report.turns_after));
  if (s.details) print(details_text(s, results));
  if (!results.errors_text.empty()) print("\n" + results.errors_text + "\n");
  const auto& report = results.report;
  std::string end = ending(report.stopped) + work_done(report);
  if (last_objective(report) == Objective::solver_error && std::isfinite(report.objective_before) &&
      report.objective_before > 0)
    end += fmt::format("; solver error {:.3g} times the input's", report.objective_after / report.objective_before);
  if (const std::size_t notes = report.notes.size(); !s.details && notes > 0)
    end += fmt::format("; --details has {}", plural(notes, "note", "notes"));
  const Criterion criterion = criterion_of_target(s.target);
  const std::size_t bad = violations(results.after, criterion);
  if (criterion != Criterion::well_centered) print(count_of_duals(bad, criterion) + "\n");
  print(fmt::format("{}\nwrote {}\n", end, fmt::join(outputs.written(), ", ")));
  if (!s.tensor.given() && bad > 0) print(next_step(s.output.path, s.projection, criterion, s.target));
}

template <class Subject>
Exit optimize_mesh(const Command& command, OptimizeSettings& s, InputOf<Subject>& input, const RunFiles& files,
                   Outputs& outputs) {
  s.requirements = s.requirement_lists.of(Subject::cells);
  outputs.expect_place(s.output, input.file);
  RunResults<Subject> results;
  warn(results, input.warnings());
  s.data = data_rules(s.data_words, input.path, input.file.point_data, (input.file.*Subject::cells_of_file).data);
  prepare(command, s, input, files, results);
  // The mesh has its geometry now, and on the largest meshes memory is scarce.
  io::release_geometry(input.file, input.loaded);
  agree_to_go_on();
  if (!Subject::runs_on_all_ranks && !is_first_rank()) return Exit::done;
  if (Subject::runs_on_all_ranks) warn(results, warnings_of_ranks());
  improve(s, input, files, results);
  if (!is_first_rank()) return Exit::done;
  write_all(command, s, input, files, results, outputs);
  if (!is_quiet()) print_result(s, results, outputs);
  flush_output();  // before the verdict on standard error
  if (const Exit verdict = report_unmet(results.outcomes, s.output.path); verdict != Exit::done) return verdict;
  return stopped_early(results.report.stopped) || results.lacks_flips ? Exit::stopped_early : Exit::done;
}

/// The outputs that the first rank writes for all.
void leave_outputs_to_first_rank(OptimizeSettings& s) {
  s.output.path.clear();
  s.files = {};
  s.requirement_lists = {};
  s.save_every.reset();
  s.measure_errors = false;
  be_quiet();
}

/// A command that has been parsed.
Exit run_command(Command& command, OptimizeSettings& settings) {
  take_input(command, settings);
  settle_options(command, settings);
  expect_without(command, settings.tensor, "--size");
  expect_without(command, settings.tensor, "--dirichlet");
  expect_complete(command, settings.problem);
  if (settings.tensor.given() && !(settings.files.page.empty() && settings.files.trace.empty()))
    refuse_usage("optimize",
                 "--tensor: the page and the trace of --write are in the plane of the mesh; expected neither");
  if (settings.tensor.given()) settings.output.options.triangle_quality = false;  // which is of the plane
  settings.requirement_lists = RequirementLists("optimize", settings.require);
  settings.traced = !settings.files.trace.empty();
  if (!is_first_rank()) leave_outputs_to_first_rank(settings);

  Outputs outputs("optimize");
  if (is_first_rank()) outputs.expect_mesh(settings.output, {settings.size, settings.options_file});
  outputs.expect(settings.files, {settings.input, settings.size, settings.options_file});

  const std::unique_ptr<Executor> threads = make_threads(settings.threads);
  std::optional<TraceFile> trace;
  if (!settings.files.trace.empty()) trace.emplace(TraceFile{outputs.open(settings.files.trace), {}});
  const RunFiles files = {threads.get(), trace ? &*trace : nullptr};
  const auto expect = [&](CellKinds cells) { expect_for(command, settings, cells); };
  AnyInput any = read_any(settings.input, {settings.projection, settings.fix, threads.get(), settings.heights, expect});
  return std::visit([&](auto& input) { return optimize_mesh(command, settings, input, files, outputs); }, any);
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
