// temper explain IN: the reason for every triangle or tetrahedron that is not well-centered, and cures.
#include <fmt/format.h>

#include <cstdio>
#include <type_traits>
#include <utility>
#include <variant>

#include "console.hpp"
#include "files/input.hpp"
#include "files/tensor_option.hpp"
#include "help/help.hpp"
#include "options/options.hpp"
#include "reports/quality_report.hpp"
#include "reports/reports.hpp"
#include "system/system.hpp"
#include "temper/detail/lp.hpp"
#include "temper/detail/optimize_table.hpp"
#include "verbs/optimize_settings.hpp"

namespace temper::app {
namespace {

struct ExplainSettings {
  std::string projection, target = "any";
  Heights heights;
  std::string input;
  std::uint64_t limit = 10;
  std::uint64_t whole = ExplainOptions().whole;
  bool json = false;
  TensorOption tensor;
};

void add_options(Command& command, ExplainSettings& s) {
  command.group("Report");
  add_argument(command, "IN", s.input, "Mesh file. Its content shows the format.").require();
  add_projection(command, s.projection);
  add_heights(command, s.heights);
  add_target(command, s.target, false);
  add_tensor(command, s.tensor, "Explain " + any_elements());
  command.add_flag("--json", s.json, "Print all reasons as JSON, with vertices and elements counted from 0.");
  add_count(command, "--limit", s.limit, 0,
            "Largest number of conflicts to print, and of places for which weights exist. Cures are searched for these "
            "only. For tetrahedra: largest number of bad ones to print.");
  add_count(
      command, "--whole", s.whole, 0,
      "Largest number of " + any_elements() + ", or of bad ones, for which weights of the whole mesh are searched.");
  command.group("Help");
  command.add_help({"IN [options]",
                    "  temper example sparse-horseshoe -o shoe.vtu && temper explain shoe.vtu\n"
                    "  temper explain shoe.vtu --json\n"
                    "  temper explain shoe.vtu --for vertex\n"
                    "  temper explain box.mesh --limit 3\n"
                    "  # a mesh for which weights exist, but have not been found yet\n"
                    "  temper example annulus -o ring.vtu && temper explain ring.vtu --limit 3\n",
                    {Exit::done, Exit::bad_input, Exit::bad_usage, Exit::internal}});
}

/// One line on a terminal; nothing in a pipe.
class Counter {
 public:
  Continue show(std::size_t done, std::size_t all) {
    if (!enabled_) return Continue::yes;
    fmt::print(stderr, "\rexplained {} of {} triangles\x1b[K", done, all);
    std::fflush(stderr);
    return Continue::yes;
  }
  void clear() const {
    if (enabled_) fmt::print(stderr, "\r\x1b[K");
  }

 private:
  bool enabled_ = error_is_terminal();
};

using TetView = MetricViewOf<Tetrahedra>;
/// A mesh in its metrics; nothing for kinds of cells without tensors.
template <class Subject>
using ViewOf = std::conditional_t<is_flat_subject<Subject>, std::optional<MetricViewOf<Subject>>, std::nullopt_t>;

surfaces::Explanation explained(const ExplainSettings& s, const SurfaceInput& input, std::nullopt_t /*view*/) {
  return or_fail(
      surfaces::explain(input.mesh(), *clp_solver(), s.json ? input.mesh().n_triangles() : s.limit, s.whole));
}

tets::Explanation explained(const ExplainSettings& s, const TetInput& input, const std::optional<TetView>& view) {
  tets::ExplainOptions options = {.whole = s.whole};
  if (!s.json) options.reasons = s.limit;
  if (!view) return or_fail(explain(input.mesh(), *clp_solver(), options));
  tets::Explanation explanation = or_fail(explain(view->pieces, *clp_solver(), options));
  for (tets::Reason& reason : explanation.reasons) {
    const tets::Metric& metric = view->pieces.metric(reason.tetrahedron);
    reason.at = metric.from_metric(reason.at);
    reason.orthocenter = metric.from_metric(reason.orthocenter);
  }
  return explanation;
}

/// A place that was measured in the metric of a triangle, in the file.
Vec2 place_of(const Input& input, const std::optional<MetricView>& view, TriangleId t, Vec2 at) {
  return place_in_file(input.file, view ? view->pieces.metric(t).from_metric(at) : at);
}

Explanation explained(const ExplainSettings& s, const Input& input, const std::optional<MetricView>& view) {
  const auto solver = clp_solver();
  Counter counter;
  ExplainOptions options;
  options.cures = s.limit;
  options.whole = s.whole;
  options.progress = [&counter](std::size_t done, std::size_t all) { return counter.show(done, all); };
  Explanation explanation =
      or_fail(view ? explain(view->pieces, *solver, options) : explain(input.mesh(), *solver, options));
  for (Reason& reason : explanation.reasons) {
    const TriangleId t = reason.must_split ? Mesh::triangle(reason.must_split->edge) : reason.bad.front();
    reason.at = place_of(input, view, t, reason.at);
    for (Cure& cure : reason.cures) cure.at = place_of(input, view, t, cure.at);
  }
  counter.clear();
  return explanation;
}

/// The violations of a criterion of duals, with places of the file.
template <class Subject>
DualExplanation explained_duals(const ExplainSettings& s, const InputOf<Subject>& input, Criterion criterion,
                                const ViewOf<Subject>& view) {
  const std::size_t most = s.json ? static_cast<std::size_t>(-1) : s.limit;
  DualExplanation explanation = explain_duals(input.mesh(), criterion, most);
  for (DualReason& reason : explanation.reasons) {
    if constexpr (std::is_same_v<Subject, Triangles>) {
      const TriangleId t = Mesh::triangle(input.mesh().outgoing(reason.vertices.front()));
      const Vec2 at = place_of(input, view, t, {reason.at.x, reason.at.y});
      reason.at = {at.x, at.y, 0};
    } else if constexpr (std::is_same_v<Subject, Tetrahedra>) {
      if (!view) continue;
      const tets::TetId t = input.mesh().incident(reason.vertices.front());
      reason.at = view->pieces.metric(t).from_metric(reason.at);
    }
  }
  return explanation;
}

std::string json_of_explanation(const Explanation& e, const Input& input, const std::optional<MetricView>& view) {
  return explanation_json(e, input, view ? number_copies(input, view->pieces) : CopyNumbers{input.points, {}, {}});
}
std::string json_of_explanation(const tets::Explanation& e, const TetInput& input, const std::optional<TetView>&) {
  return explanation_json(e, input);
}

std::string json_of_explanation(const surfaces::Explanation& e, const SurfaceInput& input, std::nullopt_t /*view*/) {
  return explanation_json(e, input);
}

template <class Subject>
void print_explanation(const ExplainSettings& s, const InputOf<Subject>& input, const ViewOf<Subject>& view) {
  if (const Criterion criterion = criterion_of_target(s.target); criterion != Criterion::well_centered) {
    const DualExplanation explanation = explained_duals(s, input, criterion, view);
    if (s.json) return print_data(explanation_json(explanation, input.points));
    print(explanation_text(explanation, input, text_style()));
    if (explanation.violations > 0 && !io::is_stream(input.path))
      print(fmt::format("Next: {} -o OUT --for {}{}\n", command_line("optimize", input.path, s.projection), s.target,
                        s.tensor.spelled));
    return;
  }
  const auto explanation = explained(s, input, view);
  s.json ? print_data(json_of_explanation(explanation, input, view))
         : print(explanation_text(explanation, input, s.limit, text_style()));
}

}  // namespace

Exit run_explain(const Arguments& arguments) {
  Command command(
      "explain",
      "Explains every bad " + any_element() +
          ": what is bad, why, and what cures it. Bad ones are not well-centered. With --for vertex or cell, negative "
          "coefficients of edges are bad, or distances that are not positive. A triangle is bad for one of two "
          "reasons. Either a proof shows a small set of triangles for which no weights exist, or weights exist but "
          "have not been found. temper also tries cures on the triangles around. For a tetrahedron it prints the "
          "orthocenter, the weights, the heights over faces, and what may help. The exit code does not depend on the "
          "result: to test a mesh, use temper check --require.");
  ExplainSettings s;
  add_options(command, s);
  if (!command.parse(arguments)) return Exit::done;

  AnyInput any = read_any(command, s.input, {s.projection, {}, nullptr, s.heights});
  std::visit(
      [&]<class Subject>(InputOf<Subject>& input) {
        expect_target_for("explain", input.path, s.target, Subject::cells);
        print_warnings(input.warnings());
        if constexpr (is_flat_subject<Subject>)
          print_explanation(s, input, take_to_metric(input, s.tensor));
        else
          print_explanation(s, input, std::nullopt);
      },
      any);
  return Exit::done;
}

}  // namespace temper::app
