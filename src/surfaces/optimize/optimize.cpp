// optimize(): checks the options, marks creases, and compares runs.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "base/text.hpp"
#include "geometry/bounding_boxes.hpp"
#include "optimize/options/settings.hpp"
#include "optimize/run/end_of_run.hpp"
#include "optimize/run/judge.hpp"
#include "surfaces/mesh/surface_editor.hpp"
#include "surfaces/optimize/run.hpp"
#include "temper/detail/optimize_table.hpp"

namespace temper::surfaces {
namespace {

// Rounding leaves a plane by less, in parts of the diagonal: with less room no vertex could move.
constexpr double kRoundedDistance = 1e-12;

std::optional<InputError> expect_options(const SurfaceOptions& o) {
  const auto error = [](const std::string& name, const std::string& expected, double found) {
    return InputError{ErrorCode::invalid_option, "", name + ": expected " + expected + ", found " + to_text(found)};
  };
  if (!(o.margin > 0 && o.margin < 0.5)) return error("margin", "a number above 0 and below 0.5", o.margin);
  if (!(o.surface_distance >= 0 && o.surface_distance <= 1))
    return error("surface_distance", "a number from 0 to 1", o.surface_distance);
  if (!(o.crease_angle_deg >= 1 && o.crease_angle_deg <= 180))
    return error("crease_angle_deg", "an angle from 1 to 180 degrees", o.crease_angle_deg);
  if (o.repair_trials < 0) return error("repair_trials", "a number from 0 on", o.repair_trials);
  if (!(o.time_limit >= 0)) return error("time_limit", "a number from 0 on", o.time_limit);
  return std::nullopt;
}

double diagonal_of(const SurfaceMesh& mesh) {
  const BoundingBox box = bounding_box(mesh);
  return length(box.high - box.low);
}

/// The turn at an edge; 0 on the boundary.
double turn_at(const SurfaceMesh& mesh, HalfedgeId h) {
  if (mesh.connectivity().is_boundary(h)) return 0;
  return turn_deg(normal_at(mesh, Mesh::triangle(h)), normal_at(mesh, Mesh::triangle(mesh.connectivity().twin(h))));
}

/// The halfedges of creases that are not constrained yet. A thin triangle with two such edges stands off the surface:
/// its normal says nothing about it.
std::vector<HalfedgeId> creases_of(const SurfaceMesh& mesh, double angle_deg) {
  const Mesh& connectivity = mesh.connectivity();
  const auto is_sharp = [&](HalfedgeId h) { return turn_at(mesh, h) > angle_deg; };
  const auto stands_off = [&](TriangleId t) {
    const auto [a, b, c] = mesh.points(t);
    if (width_of({a.position(), b.position(), c.position()}) >= kThin) return false;
    int sharp = 0;
    for (int k = 0; k < 3; ++k) sharp += is_sharp(Mesh::halfedge(t, k)) ? 1 : 0;
    return sharp >= 2;
  };
  std::vector<HalfedgeId> creases;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (connectivity.is_unflippable(h) || !connectivity.is_edge_representative(h) || !is_sharp(h)) continue;
    if (!stands_off(Mesh::triangle(h)) && !stands_off(Mesh::triangle(connectivity.twin(h)))) creases.push_back(h);
  }
  return creases;
}

/// The state of an input, in which creases are constrained.
State with_creases(const SurfaceMesh& mesh, double angle_deg) {
  State state{mesh, nullptr, {}, {}, {}};
  Mesh& connectivity = SurfaceEditor(state.mesh).connectivity();
  for (const HalfedgeId h : creases_of(mesh, angle_deg)) {
    state.creases.push_back(ascending(connectivity.origin(h), connectivity.target(h)));
    connectivity.set_constrained(h, true);
  }
  std::sort(state.creases.begin(), state.creases.end());
  for (const VertexId v : mesh.vertices()) state.origins.push_back(v);
  return state;
}

}  // namespace

Turns turns_of(const SurfaceMesh& mesh, double sharp_deg) {
  Turns turns;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.connectivity().is_edge_representative(h)) continue;
    const double turn = turn_at(mesh, h);
    turns.sharp += turn > sharp_deg ? 1 : 0;
    turns.largest_deg = std::max(turns.largest_deg, turn);
  }
  return turns;
}

Expected<SurfaceOptions> surface_options(const OptimizeOptions& options) {
  if (auto right = check_together(options, CellKinds::surfaces); !right) return right.error();
  constexpr int kEditsPerTrial = 33;  // an edit moves the vertices of a patch again and again
  SurfaceOptions made;
  made.criterion = criterion_of(options);
  made.scheme = options.scheme;
  made.surface_distance = options.surfaces.distance;
  made.crease_angle_deg = options.surfaces.crease_angle;
  made.may_move = options.unknowns != Unknowns::weights;
  made.may_flip = made.may_insert = options.flips != Flips::none;
  made.may_slide = options.boundary == BoundaryVertices::slide;
  made.repair_trials = options.repair_trials / kEditsPerTrial;
  made.time_limit = options.time_limit;
  return made;
}

namespace {

bool measures_errors(const SurfaceMesh& mesh, const SurfaceOptions& options) {
  return options.squared_errors && mesh.n_vertices() <= static_cast<std::size_t>(kMostJudgedVertices);
}

SurfaceReport run_for(SurfaceMesh& mesh, LpSolver& solver, const SurfaceOptions& options) {
  SurfaceReport report;
  const auto begin = std::chrono::steady_clock::now();
  report.before = quality(mesh);
  report.diagonal = diagonal_of(mesh);
  const double unit = std::exp2(std::ilogb(report.diagonal));
  State input = with_creases(scaled(mesh, 1 / unit), options.crease_angle_deg);
  const double most = std::max(kRoundedDistance, options.surface_distance) * report.diagonal / unit;
  const Nearness nearness(input.mesh, most);
  Run run{options, nearness, solver, report, unit};
  run.start = options.started.value_or(begin);

  input.bad = run.bad(mesh);
  if (measures_errors(mesh, options)) run.judged = &mesh;
  report.crease_edges = input.creases.size();
  const Lines lines(input.mesh, input.creases, options.may_slide);
  input.lines = &lines;
  input.tracks = lines.tracks();

  report.objective = Objective::energy;
  report.bad_before = violations(report.before, Criterion::well_centered);
  report.objective_before = energy_of(input.mesh, kLastGamma);
  run.record({.energy = report.objective_before, .bad = input.bad, .length_parameter = kLastGamma});
  State weighted = input;
  run.find_weights(weighted);
  const double sharp = options.crease_angle_deg;
  const Turns turns = turns_of(input.mesh, sharp);
  const TurnLimit first = {sharp, sharp, std::max(sharp, turns.largest_deg)};
  const State best = run.best_of_tracks(input, weighted, first);
  report.turns_before = report.turns_after = turns;
  report.after = report.before;
  report.objective_after = report.objective_before;
  if (best.bad < input.bad) {
    mesh = run.result(best);
    report.after = quality(mesh);
    report.turns_after = turns_of(best.mesh, sharp);
    report.surface_distance = unit * nearness.distance(best.mesh);
    report.objective_after = energy_of(best.mesh, kLastGamma);
  }
  report.violations_before = violations(report.before, options.criterion);
  report.violations_after = violations(report.after, options.criterion);
  report.bad_after = violations(report.after, Criterion::well_centered);
  report.repairs = best.repairs;
  if (report.repairs > 0) report.vertices = best.origins;
  count_vertices(report, report.vertices, report.before.vertices);
  report.seconds = run.seconds();
  return report;
}

}  // namespace

Expected<SurfaceReport> optimize(SurfaceMesh& mesh, LpSolver& solver, const SurfaceOptions& options) {
  if (auto error = expect_options(options)) return *std::move(error);
  if (options.criterion == Criterion::well_centered) return run_for(mesh, solver, options);
  // A well-centered mesh meets all criteria, so its run is a rival of the run for the criterion. If errors decide, the
  // run for the criterion comes first: a stop leaves its mesh.
  SurfaceOptions of_run = options;
  of_run.started = options.started.value_or(std::chrono::steady_clock::now());
  const auto run = [&](SurfaceMesh& of, Criterion criterion) {
    of_run.criterion = criterion;
    SurfaceReport report = run_for(of, solver, of_run);
    report.violations_before = violations(report.before, options.criterion);
    report.violations_after = violations(report.after, options.criterion);
    return report;
  };
  const bool decides = measures_errors(mesh, options);
  const SurfaceMesh input = mesh;
  SurfaceMesh good = mesh;
  std::optional<SurfaceReport> own;
  if (decides) {
    own = run(mesh, options.criterion);
    if (stopped_early(own->stopped)) return *std::move(own);
    of_run.best_so_far = {};
  }
  SurfaceReport other = run(good, Criterion::well_centered);
  if (!own) {
    const bool is_enough = other.violations_after == 0 || stopped_early(other.stopped);
    if (is_enough && other.violations_after < other.violations_before) {
      mesh = std::move(good);
      return other;
    }
    own = run(mesh, options.criterion);
  }
  const Stopped stopped = stopped_early(other.stopped) ? other.stopped : own->stopped;
  const auto is_better = [&] {
    if (own->violations_after != other.violations_after) return own->violations_after < other.violations_after;
    if (!decides || stopped_early(other.stopped)) return own->bad_after <= other.bad_after;
    const auto errors = [&](const SurfaceMesh& of) { return options.squared_errors(of, options.scheme); };
    const std::vector<double> before = errors(input);
    return largest_ratio(errors(mesh), before) < largest_ratio(errors(good), before);
  };
  const double seconds = std::max(own->seconds, other.seconds);
  if (!is_better()) {
    mesh = std::move(good);
    own = std::move(other);
  }
  own->seconds = seconds;
  own->stopped = stopped;
  return *std::move(own);
}

}  // namespace temper::surfaces
