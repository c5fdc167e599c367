// temper check IN...: the quality of meshes in a few lines, in full or as JSON, and requirements on it. The content of
// a file decides of which cells it is.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "console.hpp"
#include "files/input.hpp"
#include "files/outputs.hpp"
#include "files/tensor_option.hpp"
#include "help/help.hpp"
#include "options/options.hpp"
#include "options/requirement.hpp"
#include "reports/quality_report.hpp"
#include "temper/detail/file_cures.hpp"
#include "temper/quality.hpp"
#include "temper/tets/quality.hpp"
#include "threads.hpp"
#include "verbs/optimize_settings.hpp"

namespace temper::app {
namespace {

constexpr OutputKind kCheckOutputs[] = {kReportKind, kPageKind};

/// Says which vertices of the boundary are nearly at one place but not the same, and how to merge them. Empty: none.
std::string crack_warning(const Input& input) {
  const io::Crack crack = io::find_crack(input.mesh());
  if (crack.pairs == 0) return {};
  const auto [a, b] = crack.first;
  const Space& space = input.mesh().space();
  const Vec2 at = space.as_shown(space.place(input.mesh().point(a)));
  const std::string radius = crack.widest > 0 ? fmt::format("{:.0e}", 10 * crack.widest) : "0";
  return fmt::format(
      "{}: {} nearly at one place, as if the mesh had a crack: first {} and {} at ({:.6g}, {:.6g}); "
      "the widest is {:.3g}. Next: join them with temper convert {} --merge {} -o OUT",
      input.path, plural(crack.pairs, "pair of boundary points is", "pairs of boundary points are"),
      input.names->point(a.index), input.names->point(b.index), at.x, at.y, crack.widest, input.path, radius);
}

struct CheckSettings {
  std::string projection, target = "any";
  Heights heights;
  std::vector<std::string> inputs;
  std::vector<std::string> write, require;
  std::optional<LengthParameter> gamma, h0;
  std::uint64_t worst = 5, threads = 0;
  bool json = false, details = false;
  TensorOption tensor;
};

void add_options(Command& command, CheckSettings& s) {
  command.group("Report");
  add_texts(command, "IN", "", Values::words, s.inputs,
            "One or more mesh files, of " + any_elements() +
                ". The content of each file shows its format. '-' reads standard input.")
      .require();
  add_projection(command, s.projection);
  add_heights(command, s.heights);
  add_target(command, s.target, false);
  command.add_flag("--details", s.details,
                   "Print all measures, energies, histograms and the worst " + any_elements() + ".");
  command.add_flag(
      "--json", s.json,
      "Print the report as JSON, with vertices and elements counted from 0. For several meshes, print a list.");
  add_write(command, s.write, kCheckOutputs);
  add_count(command, "--worst", s.worst, 0, "Number of worst " + any_elements() + " to list.");
  add_length_parameter(command, "--gamma", s.gamma, kPositive,
                       "Gamma of E_BP: a multiple of each edge's length, or a length. (default: 1:absolute)")
      .cells = CellKinds::triangles;
  add_length_parameter(
      command, "--h0", s.h0, kNotNegative,
      "Distance below zero to which E_BHs lets h fall, a multiple of each edge's length, or a length. It "
      "is -h0 of the paper. (default: 0)")
      .cells = CellKinds::triangles;
  add_tensor(command, s.tensor, "Take all measures");
  add_threads(command, s.threads);
  command.group("Requirements");
  add_requirements(command, s.require);
  command.group("Help");
  command.add_help({"IN ... [options]",
                    "  temper check in.vtu\n"
                    "  temper check in.vtu --json --worst 20\n"
                    "  temper check in.vtu --details --write report.html\n"
                    "  temper check in.vtu --require inverted=0,\"min_angle>=1\"\n"
                    "  temper check in.vtu --for vertex\n"
                    "  temper check in.vtu in.vtu --require inverted=0\n",
                    {Exit::done, Exit::bad_input, Exit::bad_usage, Exit::requirement, Exit::internal}});
}

/// The metric of an element at a vertex of pieces.
const Metric& metric_at(const MetricMesh& pieces, VertexId v) {
  return pieces.metric(Mesh::triangle(pieces.mesh.outgoing(v)));
}
const tets::Metric& metric_at(const tets::MetricMesh& pieces, VertexId v) {
  return pieces.metric(pieces.mesh.incident(v));
}

/// Takes a place of pieces, if there is one, to the mesh itself.
template <class Pieces>
void move_back(auto& place, const Pieces& pieces) {
  if (const VertexId v = place.vertices[0]; v.valid()) place.at = metric_at(pieces, v).from_metric(place.at);
}

/// Counts that interfaces make larger in pieces, of links and what is on them.
void count_once(Quality& measured, const MetricMesh& pieces, const Mesh& /*plain*/) {
  const std::size_t seams = seams_of(pieces).size();
  measured.edges -= seams;
  measured.boundary_edges -= 2 * seams;
}

/// The number of edges of interfaces in the pieces that are copies of others.
std::size_t count_copied_edges(const tets::MetricMesh& pieces) {
  using Edge = std::pair<VertexId, VertexId>;
  std::set<Edge> copies, edges;
  for (const tets::SeamFace& seam : seams_of(pieces)) {
    for (const tets::HalffaceId h : {seam.one, seam.other}) {
      const auto [a, b, c] = pieces.mesh.vertices(h);
      for (const auto& [p, q] : {Edge(a, b), Edge(b, c), Edge(c, a)}) {
        copies.insert(std::minmax(p, q));
        const VertexId first = pieces.first_copy(p), second = pieces.first_copy(q);
        edges.insert(std::minmax(first, second));
      }
    }
  }
  return copies.size() - edges.size();
}

void count_once(tets::Quality& measured, const tets::MetricMesh& pieces, const tets::TetMesh& plain) {
  move_back(measured.min_distance_place, pieces);
  const auto outer = boundary_vertices(plain);
  measured.inner_vertices = static_cast<std::size_t>(std::count(outer.begin(), outer.end(), std::uint8_t{0}));
  const std::size_t seams = seams_of(pieces).size();
  measured.edges -= count_copied_edges(pieces);
  measured.faces -= seams;
  measured.boundary_faces -= 2 * seams;
  std::set<std::int32_t> regions;
  for (const tets::TetId t : elements_of(plain)) regions.insert(plain.region(t));
  measured.regions = regions.size();
}

TriangleId element_of(const WorstTriangle& worst) { return worst.triangle; }
tets::TetId element_of(const tets::WorstTet& worst) { return worst.tetrahedron; }

/// Counts and places of a mesh itself, for measures of its pieces.
template <class Subject>
void as_in_file(typename Subject::Quality& measured, const MetricViewOf<Subject>& view) {
  for (auto& worst : measured.worst) worst.at = view.pieces.metric(element_of(worst)).from_metric(worst.at);
  move_back(measured.min_coefficient_place, view.pieces);
  measured.vertices = view.plain.n_vertices();
  count_once(measured, view.pieces, view.plain);
}

class Checks {
 public:
  Checks(const Command& command, const CheckSettings& settings)
      : command_(command),
        s_(settings),
        criterion_(criterion_of_target(settings.target)),
        requirements_("check", settings.require),
        threads_(make_threads(settings.threads)) {
    options_.gamma = s_.gamma.value_or(options_.gamma);
    options_.h0 = s_.h0.value_or(options_.h0);
    options_.worst = s_.worst;
    options_.executor = threads_.get();
    if (!s_.details && !s_.json && s_.write.empty() && s_.require.empty()) options_.detail = QualityDetail::brief;
    files_ = sorted_outputs("check", s_.write, kCheckOutputs);
    if (!s_.write.empty() && s_.inputs.size() > 1) {
      refuse_usage("check", fmt::format("--write: expected one mesh, found {}", s_.inputs.size()));
    }
    if (s_.tensor.given() && !files_.page.empty())
      refuse_usage("check", "--tensor: the page of --write is in the plane of the mesh; expected another output");
    outputs_.expect(files_, s_.inputs);
  }

  void add(const std::string& path) {
    AnyInput any = read_any(command_, path, {s_.projection, {}, threads_.get(), s_.heights});
    std::visit([this](auto& input) { check(input); }, any);
  }

  /// An error in one mesh does not stop the check of the others.
  void add_of_several(const std::string& path) {
    try {
      add(path);
    } catch (const Failure& failure) {
      print_error(failure.what());
      exit_ = failure.exit;
    }
  }

  Exit end() {
    if (s_.json) print_data(s_.inputs.size() == 1 ? reports_.front() : json_list(reports_));
    return exit_;
  }

 private:
  template <class Subject>
  void check(InputOf<Subject>& input) {
    expect_target_for("check", input.path, s_.target, Subject::cells);
    const std::vector<Requirement>& requirements = requirements_.of(Subject::cells);
    print_warnings(input.warnings());
    typename Subject::Quality measured = measure(input);
    const std::vector<Outcome> outcomes = judge(requirements, measured, criterion_);
    if constexpr (is_flat_subject<Subject>) {
      if (!files_.page.empty())
        outputs_.write_text(files_.page, check_html(command_line(command_, {input.path}), input, measured));
    }
    show_places_of_file(measured, input);
    const Verdict verdict = {s_.target, criterion_, violations(measured, criterion_)};
    report(input.path, outcomes, check_json(input.path, measured, input.points, verdict, outcomes),
           s_.details ? quality_text(measured, input, text_style()) + details_of_target(input, measured)
                      : short_text(input, measured));
  }
  [[nodiscard]] Quality measure(Input& input) const {
    if (const std::string crack = crack_warning(input); !crack.empty()) print_warnings(std::vector{crack});
    if (files_.page.empty()) {
      io::release_geometry(input.file, input.loaded);
    } else {
      expect_plane(input.mesh(), input.path, "--write " + files_.page);
    }
    const std::optional<MetricView> view = take_to_metric(input, s_.tensor);
    Quality measured = quality_in_place(input.loaded.mesh, options_);
    if (view) as_in_file(measured, *view);
    return measured;
  }
  [[nodiscard]] tets::Quality measure(TetInput& input) const {
    const auto view = take_to_metric(input, s_.tensor);
    tets::Quality measured = quality(input.mesh(), {s_.worst, threads_.get()});
    if (view) as_in_file(measured, *view);
    return measured;
  }
  [[nodiscard]] surfaces::Quality measure(SurfaceInput& input) const { return quality(input.mesh(), s_.worst); }
  /// Prints or keeps the report, writes it where --write asks for it, and gives the verdict on the requirements.
  void report(const std::string& path, const std::vector<Outcome>& outcomes, const std::string& json,
              const std::string& text) {
    if (!files_.report.empty()) outputs_.write_text(files_.report, json);
    if (s_.json) {
      reports_.push_back(json);
    } else {
      print(std::exchange(first_, false) ? "" : "\n");
      print(text);
      flush_output();  // before the verdict on standard error
    }
    if (const Exit verdict = report_unmet(outcomes, path); exit_ == Exit::done) exit_ = verdict;
  }

  template <class Subject>
  [[nodiscard]] std::string short_text(const InputOf<Subject>& input, const typename Subject::Quality& measured) const {
    std::string text = fmt::format("{}: {}\n{}{}{}\n", input.path, mesh_size(measured), halves_text(input.mesh()),
                                   brief_text(measured), target_verdict(measured, input, criterion_));
    if (violations(measured, criterion_) == 0 || input.path == kStandardInput) return text;
    const std::string target = (command_.was_given("--for") ? " --for " + s_.target : "") + s_.tensor.spelled;
    return text + fmt::format("Next: {} -o OUT{}, or {}{}\n", command_line("optimize", input.path, s_.projection),
                              target, command_line("explain", input.path, s_.projection), target);
  }
  /// The verdict for the target, if it is not the one above all measures.
  template <class Subject>
  [[nodiscard]] std::string details_of_target(const InputOf<Subject>& input,
                                              const typename Subject::Quality& measured) const {
    if (criterion_ == Criterion::well_centered) return {};
    return "\n" + target_verdict(measured, input, criterion_) + "\n";
  }

  const Command& command_;
  const CheckSettings& s_;
  Criterion criterion_;
  FurtherOutputs files_;
  Outputs outputs_ = Outputs("check");
  RequirementLists requirements_;
  std::unique_ptr<Executor> threads_;
  QualityOptions options_;
  std::vector<std::string> reports_;
  bool first_ = true;
  Exit exit_ = Exit::done;
};

}  // namespace

Exit run_check(const Arguments& arguments) {
  Command command("check", "Reports the quality of a mesh: exact tests, margins, energies and the worst triangles.");
  CheckSettings s;
  add_options(command, s);
  if (!command.parse(arguments)) return Exit::done;
  if (std::ranges::find(s.inputs, "") != s.inputs.end())
    refuse_usage("check", "IN is missing: expected the name of a file, found an empty one");
  std::ranges::replace(s.inputs, "-", kStandardInput);
  Checks checks(command, s);
  if (s.inputs.size() == 1) {
    checks.add(s.inputs.front());
  } else {
    for (const std::string& path : s.inputs) checks.add_of_several(path);
  }
  return checks.end();
}

}  // namespace temper::app
