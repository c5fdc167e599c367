// `temper optimize` of triangles: names, depths, sizes and problems of the mesh, and the run of the library.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "console.hpp"
#include "files/size_options.hpp"
#include "files/trace_jsonl.hpp"
#include "options/ranks.hpp"
#include "reports/quality_report.hpp"
#include "reports/reports.hpp"
#include "temper/draw.hpp"
#include "temper/regularity.hpp"
#include "temper/solvers.hpp"
#include "verbs/optimize_run.hpp"

namespace temper::app {
namespace {

using Viewer = std::function<void(const Mesh&)>;

OptimizeReport run_library(const OptimizeSettings& s, const Input& input, Mesh& mesh, Executor* threads, Tracer tracer,
                           Viewer viewer, bool measures_sizes) {
  ProgressLine line(!is_quiet() && error_is_terminal());
  OptimizeHooks hooks;
  set_hooks(hooks, line, s, input, threads);
  hooks.communicator = communicator();
  hooks.names = input.names.get();
  hooks.exclusive = true;
  hooks.viewer = std::move(viewer);
  hooks.measures_sizes = measures_sizes;
  hooks.solvers = solvers();
  hooks.tracer = std::move(tracer);
  OptimizeOptions options = s.options;
  options.triangle_tensors = tensors_of(s.tensor, input);
  if (!s.tensor.one.empty()) options.tensor = std::exchange(options.triangle_tensors, {}).front();
  if (!options.triangle_tensors.empty()) options.corner_weights = io::corner_weights_of(input.file, input.loaded);
  Expected<OptimizeReport> report = optimize(mesh, options, hooks);
  if (!report) throw as_failure(spell_options(report.error()));
  for (std::string& note : report->notes) note = spell_options(note);
  return *std::move(report);
}

/// The tracer of the trace, if there is one.
Tracer tracer_of(const OptimizeSettings& s, const RunFiles& files, const Input& input) {
  TraceFile* const trace = files.trace;
  if (trace == nullptr && s.traced) return [](const TraceEvent&) {};  // the first rank writes it
  if (trace == nullptr) return {};
  trace->stream.write(trace_header(input));
  return [trace, &input](const TraceEvent& event) {
    trace->stream.write(trace_line(event, input));
    ++trace->events;
  };
}

/// Says whether edges lack flips. Edges that may not be flipped do not count.
bool lacks_flips(const OptimizeOptions& o, const Mesh& mesh, Executor* executor) {
  return o.flips != Flips::none && o.paper.hidden != HiddenPolicy::keep &&
         count_non_regular_edges(mesh, false, executor) > 0;
}

bool has_weights(const Mesh& mesh) {
  for (const VertexId v : mesh.vertices()) {
    if (mesh.weight(v) != 0) return true;
  }
  return false;
}

VertexId find_vertex(const Input& input, std::string_view option, const std::string& number) {
  for (const VertexId v : input.mesh().vertices()) {
    if (input.vertex_number(v) == number) return v;
  }
  throw Failure(Exit::bad_usage, fmt::format("{}: {}: there is no vertex {}", input.path,
                                             spell_options(fmt::format("`{}`", option)), number));
}

/// Finds the vertices that options name, now that vertices have numbers.
void find_vertices(OptimizeSettings& s, const Input& input) {
  for (const Assignment& a : s.assignments) {
    if (a.vertex.empty()) continue;
    const bool none = a.vertex == a.row->absent_name;
    a.row->set(s.options, none ? OptionValue() : OptionValue(find_vertex(input, a.row->name, a.vertex)));
  }
}

}  // namespace

void prepare(const Command& command, OptimizeSettings& s, const Input& input, const RunFiles& files,
             RunResults<Triangles>& results) {
  if (!s.files.page.empty()) expect_plane(input.mesh(), s.input, "--write " + s.files.page);
  find_vertices(s, input);
  warn(results, doubtful_options(command, s));
  if (s.options.unknowns == Unknowns::positions && has_weights(input.mesh())) {
    warn(results,
         std::array{fmt::format("{0}: the mesh has weights, and this run keeps them. If your solver ignores weights, "
                                "set them to zero first. Next: temper weights {0} --zero -o plain.vtu",
                                s.input)});
  }
  if (!s.size.empty()) {
    ReadSizeField sizes = read_size_field(
        read_input(s.size, {same_projection(input.file, s.projection), {}, files.threads, {s.heights.flat}}),
        s.size_data);
    warn(results, sizes.warnings);
    s.options.size_field = std::move(sizes.field);
  }
  if (const auto depth = io::depths_of(input.file)) s.options.guard.depth = at_vertices(input, *depth);
  if (s.problem.given()) {
    s.options.problem = read_problem(command, s.problem, input);
    warn(results, problem_warnings(input.mesh(), *s.options.problem));
  }
}

void improve(const OptimizeSettings& s, Input& input, const RunFiles& files, RunResults<Triangles>& results) {
  QualityOptions measuring;
  measuring.executor = files.threads;
  Mesh& mesh = input.loaded.mesh;
  results.improved = &mesh;
  results.original = &results.second;
  const Mesh* seen = &mesh;
  std::optional<MetricMesh> there;
  const auto look_at = [&](const std::vector<Tensor>& tensors, const std::vector<double>& corner_weights) {
    if (s.tensor.given()) seen = &there.emplace(in_metric(mesh, tensors, corner_weights, input)).mesh;
  };
  warn_without(s.tensor, input);
  std::vector<Tensor> tensors = tensors_of(s.tensor, input);
  look_at(tensors, io::corner_weights_of(input.file, input.loaded));
  if (s.measure_errors || !s.files.picture.empty() || !s.files.page.empty()) results.second = *seen;
  const bool shown = !s.files.report.empty() || !s.files.page.empty() || !s.files.picture.empty();
  const bool brief = !shown && !s.details && s.requirements.empty();
  if (brief) measuring.detail = QualityDetail::brief;
  const bool measured = !is_quiet() || shown || !s.requirements.empty();  // else nobody would see it
  // The run looks at the mesh in an order for which no copy is needed. It has no names for the worst triangles.
  Viewer viewer;
  if (measured && brief && !s.tensor.given()) {
    viewer = [&, first = true](const Mesh& now) mutable {
      results.after = quality(now, measuring);
      if (std::exchange(first, false)) results.before = results.after;
    };
  } else if (measured) {
    results.before = quality(*seen, measuring);
  }
  catch_interrupts();
  on_first_rank([&] {
    print(fmt::format("{}: {}", s.input, mesh_size(mesh)));
    print(s.set_by_target.empty() ? "\n" : fmt::format("; --for {} sets {}\n", s.target, s.set_by_target));
    flush_output();
  });
  const Tracer tracer = tracer_of(s, files, input);
  results.report = run_library(s, input, mesh, files.threads, tracer, viewer, !brief);
  tensors.resize(std::min<std::size_t>(tensors.size(), 1));  // all have it if the report has none
  look_at(results.report.triangle_tensors.empty() ? tensors : results.report.triangle_tensors,
          results.report.corner_weights);
  on_first_rank([&] { add_errors(s, results.second, *seen, files.threads, results); });
  if (files.trace != nullptr) files.trace->stream.write(trace_end(files.trace->events, mesh, input));
  if (measured && !viewer) results.after = quality(*seen, measuring);
  const bool all_regular = measured && results.after.non_regular_edges == 0;  // those that may not be flipped, too
  results.lacks_flips = !all_regular && lacks_flips(s.options, *seen, files.threads);
  results.outcomes = judge(s.requirements, results.after, criterion_of_target(s.target));
  if (!s.files.picture.empty()) results.picture = draw_before_after_svg(results.second, *seen);
}

std::string measures_text(const OptimizeSettings& s, const RunResults<Triangles>& results) {
  const int star = objective_of(s.options) != Objective::energy ? 1 : static_cast<int>(s.options.star);  // that counts
  return comparison_text(results.before, results.after) +
         energies_text(results.before, results.after, star, text_style()) + size_text(results.report.size);
}

}  // namespace temper::app
