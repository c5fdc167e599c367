// Bytes as a list of choices: a triangulation of a square by insertions and flips, with weights, constraints, regions
// and fixed vertices; a value for some rows of the table of options; then optimize(). What comes out is valid and
// regular, or the mesh of before with an error. A trace of the run, written and read, makes the same bytes again. With
// a height for each vertex the mesh is a curved surface, with the laws of those.
#include <algorithm>
#include <cmath>

#include "base/rng.hpp"
#include "files/trace_jsonl.hpp"
#include "property/mesh_of_random_points.hpp"
#include "target.hpp"
#include "temper/detail/optimize_table.hpp"
#include "temper/detail/trace.hpp"
#include "temper/detail/transfer.hpp"
#include "temper/regularity.hpp"
#include "temper/solvers.hpp"
#include "temper/surfaces.hpp"

namespace temper::fuzz {
namespace {

/// Choices, a byte each; zeros when there are no more.
class Choices {
 public:
  explicit Choices(std::string_view bytes) : bytes_(bytes) {}
  std::size_t below(std::size_t n) {
    if (bytes_.empty()) return 0;
    const auto byte = static_cast<unsigned char>(bytes_.front());
    bytes_.remove_prefix(1);
    return byte % n;
  }
  /// −1 to 1, in steps that make ties.
  double coordinate() { return -1 + 0.125 * static_cast<double>(below(17)); }
  bool one_in(std::size_t n) { return below(n) == 1; }

 private:
  std::string_view bytes_;
};

Mesh make_mesh(Choices& choices) {
  Mesh mesh = test::square();
  const std::size_t n = choices.below(24);
  for (std::size_t i = 0; i < n; ++i) {
    const double x = choices.coordinate();
    test::insert_anywhere(mesh, {x, choices.coordinate(), 0});
    const HalfedgeId h(choices.below(mesh.n_halfedges()));
    if (choices.one_in(2) && can_flip(mesh, h) == FlipStatus::possible) flip(mesh, h);
  }
  for (const VertexId v : mesh.vertices()) {
    if (choices.one_in(4)) mesh.set_weight(v, 0.02 * choices.coordinate());
    if (choices.one_in(16)) mesh.set_fixed(v, true);
  }
  for (const TriangleId t : mesh.triangles()) {
    if (choices.one_in(8)) mesh.set_region(t, static_cast<std::int32_t>(choices.below(3)));
  }
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_boundary(h) && choices.one_in(16)) mesh.set_constrained(h, true);
  }
  return mesh;
}

/// Takes the vertices to coordinates that are not round, far from the origin, or with a sign of zero.
void take_elsewhere(Mesh& mesh, Choices& choices) {
  const double scale = choices.one_in(3) ? 0.3 : 1, shift = choices.one_in(4) ? 7.7 : 0;
  const double zero = choices.one_in(2) ? -0.0 : 0;
  for (const VertexId v : mesh.vertices()) {
    const auto place = [&](double x) { return x == 0 && shift == 0 ? zero : scale * x + shift; };
    const auto [x, y, w] = mesh.point(v);
    mesh.set_point(v, {place(x), place(y), scale * scale * w});
  }
}

OptionValue some_value(const OptionRow& row, Choices& choices) {
  const double low = std::max(row.range.low, -4.0), high = std::min(row.range.high, std::max(low, 0.0) + 4);
  const double number = low + (high - low) * static_cast<double>(1 + choices.below(15)) / 16;
  switch (row.kind) {
    case OptionKind::count:
      return static_cast<std::int64_t>(std::max(row.range.low, 0.0)) + static_cast<std::int64_t>(choices.below(8));
    case OptionKind::number:
      return number;
    case OptionKind::choice:
      return row.choices[choices.below(row.choices.size())];
    case OptionKind::length_parameter:
      return LengthParameter{std::max(number, 1e-3)};
    case OptionKind::vertex:
      return VertexId(choices.below(8));
  }
  return {};
}

OptimizeOptions make_options(Choices& choices) {
  OptimizeOptions options = choices.one_in(3) ? *options_for("paper") : OptimizeOptions();
  for (const OptionRow& row : option_rows()) {
    if (!choices.one_in(6)) continue;
    const OptionValue value = some_value(row, choices);
    if (check_option(row, value)) row.set(options, value);
  }
  // What a run may cost: restarts, searches and returns to earlier sweeps need long ones.
  const int most = choices.one_in(8) ? 15 : 1;
  options.max_sweeps = std::min(options.max_sweeps, 4 * most);
  options.accuracy.sweeps = std::min(options.accuracy.sweeps, 2 * most);
  options.solver_error.steps = std::min(options.solver_error.steps, 2 * most);
  options.repair_trials = std::min(options.repair_trials, 30 * most);
  options.time_limit = 0;  // the same at every run
  return options;
}

/// Hidden vertices that are kept have edges that are not regular: no others are, and the report says which and why.
void insist_on_hidden(const Mesh& mesh, const OptimizeReport& report) {
  Mesh copy = mesh;
  const Restoration again = restore_regularity(copy);
  insist(again.flips == 0, "an edge is regular, or no flip can make it so");
  insist(again.hidden == report.hidden_vertices, "the report has all vertices that are hidden");
  const auto says = [](const std::string& note) { return note.find("hidden=keep") != std::string::npos; };
  insist(std::any_of(report.notes.begin(), report.notes.end(), says) == !again.stuck.empty(), "a note says so");
}

// Of a sum, over the sum of the absolute values. Areas of flat triangles are rounded, too.
constexpr double kMostChange = 1e-12;

/// Conserved data of triangles keep their sums over the domain and each region.
void insist_on_conserved_data(const Mesh& before, const Mesh& mesh) {
  std::vector<double> values;
  for (const TriangleId t : before.triangles()) values.push_back(static_cast<double>(t.index % 5) - 1.5);
  const Conserved conserved = conserve(overlaps(before, mesh, CellsOf::triangles), values);
  insist(conserved.values.size() == mesh.n_triangles(), "each triangle has a value");
  insist(conserved.change < kMostChange, "sums of conserved data stay");
}

void insist_on_result(const Mesh& before, const Mesh& mesh, const OptimizeReport& report,
                      const OptimizeOptions& options) {
  const auto wrong = mesh.validate();
  const bool tangled = report.stopped == Stopped::tangled || options.paper.inversion == Inversion::allow;
  insist(!wrong || tangled, wrong.value_or(""));
  insist(report.vertices.empty() || report.vertices.size() == mesh.n_vertices(), "every vertex has a number");
  insist(!report.vertices.empty() || mesh.n_vertices() == before.n_vertices(), "or there are as many as before");
  if (wrong || tangled) return;
  insist_on_conserved_data(before, mesh);
  if (options.flips == Flips::none) return;
  if (options.paper.hidden == HiddenPolicy::keep) return insist_on_hidden(mesh, report);
  // An input comes back as it was if the flips that make it regular would make a measure of the guard worse.
  const GuardOptions& guard = options.guard;
  const bool is_guarded =
      guard.client != Client::none || guard.angle > 0 || guard.edge > 0 || guard.areas || guard.length || guard.step;
  if (is_guarded && mesh == before) return;
  insist(count_non_regular_edges(mesh, false) == 0, "every free edge is regular");
}

/// The mesh as if it came from a file.
app::Input input_of(const Mesh& mesh) {
  app::Input input;
  input.path = "mesh";
  input.loaded.mesh = mesh;
  input.loaded.vertex_of_point = io::VertexOfPoint(mesh.n_vertices());
  input.n_vertices = mesh.n_vertices();
  return input;
}

void run_optimize(std::string_view bytes) {
  Choices choices(bytes);
  Mesh before = make_mesh(choices);
  const OptimizeOptions options = make_options(choices);
  take_elsewhere(before, choices);
  insist(!before.validate(), "the mesh to begin with is valid");
  const app::Input input = input_of(before);
  std::string trace = app::trace_header(input);
  std::size_t events = 0;
  OptimizeHooks hooks;
  hooks.solvers = solvers();
  hooks.tracer = [&](const TraceEvent& event) {
    trace += app::trace_line(event, input);
    ++events;
  };
  Mesh mesh = before;
  const auto report = optimize(mesh, options, hooks);
  if (!report) {
    insist(mesh == before, "an error leaves the mesh as it was");
    return insist(!report.error().message.empty(), "an error has a message");
  }
  insist_on_result(before, mesh, *report, options);
  static const Scratch scratch;
  const app::Trace read = app::read_trace(scratch.make("t.jsonl", trace + app::trace_end(events, mesh, input)), input);
  const auto again = replay(before, read.events);
  insist(again.has_value(), again ? "" : again.error().what());
  insist(*again == mesh && app::is_end_of(read.end, *again), "the trace makes the same bytes");
}

/// The mesh of a square with a height for each vertex: a wavy or folded surface. Some have ridges.
std::optional<surfaces::SurfaceMesh> make_surface(Choices& choices) {
  const Mesh plane = make_mesh(choices);
  const double steep = choices.one_in(3) ? 1 : 0.1;
  std::vector<Vec3> points;
  std::vector<std::int32_t> regions;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const VertexId v : plane.vertices())
    points.push_back({plane.position(v).x, plane.position(v).y, steep * choices.coordinate()});
  const auto number = [](VertexId v) { return static_cast<std::int32_t>(v.index); };
  for (const TriangleId t : plane.triangles()) {
    const auto [a, b, c] = plane.corners(t);
    triangles.push_back({number(a), number(b), number(c)});
    regions.push_back(plane.region(t));
  }
  surfaces::SurfaceInput input;
  input.points = points, input.triangles = triangles, input.regions = regions;
  auto built = surfaces::SurfaceMesh::build(input);
  if (!built) return std::nullopt;  // a triangle may be flat
  return std::move(built->mesh);
}

void insist_on_operators(const DecComplex& complex, double area) {
  double sum = 0;
  for (const double star : complex.star0.raw()) sum += star;
  insist(std::abs(sum - area) <= 1e-9 * area, "dual cells fill the surface");
}

void run_on_surface(std::string_view bytes) {
  Choices choices(bytes);
  const auto before = make_surface(choices);
  const Solvers solvers = temper::solvers();
  if (!before || !solvers.lp) return;
  surfaces::SurfaceOptions options;
  options.criterion =
      std::array{Criterion::well_centered, Criterion::coefficients, Criterion::distances}[choices.below(3)];
  options.surface_distance = 0.02 * static_cast<double>(choices.below(4));
  options.crease_angle_deg = 20 * static_cast<double>(1 + choices.below(9));
  options.may_flip = !choices.one_in(4), options.may_insert = !choices.one_in(4), options.may_move = !choices.one_in(4);
  options.repair_trials = 20;
  surfaces::SurfaceMesh mesh = *before;
  const auto report = surfaces::optimize(mesh, *solvers.lp(), options);
  insist(report.has_value(), report ? "" : report.error().what());
  const auto wrong = mesh.validate();
  insist(!wrong, wrong.value_or(""));
  insist(surfaces::cells_at_violations(mesh, options.criterion).size() <=
             surfaces::cells_at_violations(*before, options.criterion).size(),
         "no run makes more triangles bad");
  // A closest point in a thin triangle is rounded.
  insist(report->surface_distance <= (options.surface_distance + 1e-9) * report->diagonal,
         "the result is near the input");
  if (!options.may_insert) insist(mesh.n_vertices() == before->n_vertices(), "no vertex comes or goes");

  double area = 0;
  const DecComplex complex = surfaces::dec_operators(mesh);
  for (const double of_triangle : complex.areas.raw()) area += of_triangle;
  insist_on_operators(complex, area);
  surfaces::IntrinsicMesh intrinsic(mesh);
  const std::size_t bad = surfaces::n_bad_triangles(intrinsic);
  WeightOptions elastic;
  elastic.goal = WeightGoal::elastic;
  elastic.from_input = true;
  const auto found = surfaces::find_intrinsic_weights(intrinsic, *solvers.lp(), elastic);
  if (!found) return insist(!found.error().message.empty(), "an error has a message");
  insist(bad > 0 || surfaces::n_bad_triangles(intrinsic) == 0, "good triangles stay good");
  insist_on_operators(surfaces::dec_operators(intrinsic), area);
}

/// Bytes without meaning: each is a mesh and options.
std::vector<std::string> some_bytes() {
  std::vector<std::string> all;
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    Rng rng(seed);
    std::string bytes(60 + 12 * seed, '\0');
    for (char& c : bytes) c = static_cast<char>(rng.below(256));
    all.push_back(std::move(bytes));
  }
  return all;
}

}  // namespace

std::vector<Target> optimize_targets() {
  return {{"optimize", run_optimize, some_bytes}, {"surfaces", run_on_surface, some_bytes}};
}

}  // namespace temper::fuzz
