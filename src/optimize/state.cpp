// The state of a run, class by class. Each visit() names all members of its class, so that a new one does not compile
// before it is named here, and keeps those that the sweeps to come depend on. What is not kept is made again from mesh
// and options, or is storage that a sweep fills before it reads it.
#include <algorithm>

#include "mesh/mesh_archive.hpp"
#include "optimize/accuracy/accuracy_phase.hpp"
#include "optimize/driver.hpp"
#include "optimize/error/error_phase.hpp"
#include "optimize/repair/repair_search.hpp"
#include "optimize/report.hpp"

namespace temper {
namespace {

template <class IdType, class T>
bool all_below(const IdVector<IdType, T>& ids, std::size_t end) {
  return std::all_of(ids.begin(), ids.end(), [end](const auto& id) { return id.index < end; });
}

}  // namespace

// --- of the library's interface -------------------------------------------------------------------------------------

void visit(Archive& archive, SweepRecord& record) {
  auto& [sweep, energy, bad, flips, softening, seconds, objective] = record;
  archive(sweep, energy, bad, flips, softening, seconds, objective);
}

void visit(Archive& archive, OptimizeReport& report) {
  auto& [stopped, sweeps, flips, removed, inserted, vertices, hidden, seconds, initial_energy, final_energy, size,
         history, notes] = report;  // vertices to size, and notes: give_back() fills them in
  archive(stopped, sweeps, flips, removed, inserted, history);
}

void visit(Archive& archive, Softening& softening) {
  auto& [value, scale] = softening;
  archive(value, scale);
}

void visit(Archive& archive, EnergyModel& model) {
  auto& [kind, star, boundary_treatment, gamma, h0, wall] = model;
  archive(kind, star, boundary_treatment, gamma, h0, wall);
}

void visit(Archive& archive, AccuracyTotal& total) {
  auto& [energy, barrier] = total;
  archive(energy, barrier);
}

// --- of a run -------------------------------------------------------------------------------------------------------

void visit(Archive& archive, BoundaryCuts& cuts) {
  auto& [vertices, conflicts, inside, refused, ratio_before, ratio_after] = cuts;
  archive(vertices, conflicts, inside, refused, ratio_before, ratio_after);
}

void visit(Archive& archive, RunFacts& facts) {
  auto& [input_flips, boundary_cuts, cuts_where_bad, stays_uncut, weights_shrunk, energy_rose] = facts;
  archive(input_flips, boundary_cuts, cuts_where_bad, stays_uncut, weights_shrunk, energy_rose);
}

void visit(Archive& archive, Settings& settings) {
  auto& [energy, model, collapse_model, accuracy, accuracy_domain, relaxation, flip_limit, options, hooks, size_field] =
      settings;
  archive(model, relaxation);
  if (archive.reads()) set_energy(settings, model.kind);
}

void visit(Archive& archive, Attempt& attempt) {
  auto& [start, factor, relaxation, level_sweeps, level_fall, until_good, jitter, fewer, tie_weight, first_energy,
         cuts] = attempt;
  archive(start, factor, relaxation, level_sweeps, level_fall, until_good, jitter, fewer, tie_weight, first_energy,
          cuts);
}

void visit(Archive& archive, Run& run) {
  auto& [report, facts, repair_trials_left, checkpoints, options, observer, ranks, apart, start, earlier_seconds,
         ending_seconds] = run;
  double seconds = run.seconds();
  archive(report, facts, repair_trials_left, seconds);
  archive.require(!report.history.empty());
  if (archive.reads()) earlier_seconds = seconds;
}

void visit(Archive& archive, Frame& frame) {
  auto& [center, rounding, scale, space] = frame;
  archive(center, rounding, scale, space);
}

void visit(Archive& archive, WorkingCopy& work) {
  auto& [mesh, frame, order, has_gaps, n_input_vertices, n_vertices_named, n_triangles_named] = work;
  archive(mesh, frame, order, has_gaps, n_input_vertices, n_vertices_named, n_triangles_named);
  archive.require(order.vertices.size() == mesh.n_vertices() && order.triangles.size() == mesh.n_triangles());
  archive.require(all_below(order.vertices, n_vertices_named) && all_below(order.triangles, n_triangles_named));
  if (archive.failed()) work = WorkingCopy();
}

void visit(Archive& archive, Candidate& candidate) {
  auto& [work, sweep] = candidate;
  archive(work, sweep);
}

// --- of the driver --------------------------------------------------------------------------------------------------

void Driver::visit(Archive& archive) {
  auto& [work, mesh, settings, run, recorder, flipper, sweeper, sequence, inner, outer, best, best_points, best_energy,
         best_sweep, regular, regular_sweep] = *this;  // work and settings are those of the callers
  archive(recorder, flipper, sweeper, sequence, inner, outer, best, best_points, best_energy, best_sweep, regular,
          regular_sweep);
  const auto is_there = [n = mesh_.n_vertices()](VertexId v) { return v.index < n; };
  archive.require(std::all_of(sequence.begin(), sequence.end(), is_there));
  archive.require(best_points.empty() || best_points.size() == mesh_.n_vertices());
}

void Recorder::visit(Archive& archive) {
  auto& [tracer, work, energy_unit, sweep] = *this;
  archive(energy_unit, sweep);
}

void Flipper::visit(Archive& archive) {
  auto& [mesh, settings, recorder, lawson, records, plan, changes, log] = *this;
  auto& [flips, removed, inserted] = changes;
  archive(flips, removed, inserted);
}

void Sweeper::visit(Archive& archive) {
  auto& [limits, context, flipper, improvers, parts, passes, iteration, unknowns, in_order] = *this;
  archive(limits, parts, passes, iteration);
}

void visit(Archive& archive, VertexLimits& limits) {
  auto& [mobility, degree, band, mesh, settings] = limits;
  archive(mobility, degree, band);
  archive.require(mobility.size() == mesh.n_vertices() && degree.size() == mesh.n_vertices());
  archive.require(std::all_of(mobility.begin(), mobility.end(), [](Mobility m) { return m <= Mobility::free; }));
}

void SizeBand::visit(Archive& archive) {
  auto& [mesh, frame, field, squared_band, squared_field, triangle, there_squared, there, touched] = *this;
  archive(squared_field, triangle);
  archive.require(squared_field.size() == (on() ? mesh.n_vertices() : 0) && triangle.size() == squared_field.size());
  archive.require(!on() || all_below(triangle, field->mesh().n_triangles()));
}

void NewtonPass::visit(Archive& archive) {
  auto& [mesh, settings, frame, limits, recorder, part_size, passes, workers, in_order] = *this;
  archive(passes);
}

// --- of phases and searches -----------------------------------------------------------------------------------------

void EnergyPhase::visit(Archive& archive) {
  auto& [mesh, settings, run, frame, attempt, energy_unit, iteration, before_switch, softener, may_give_up, before,
         least_bad, sweeps_since_fewer_bad, least_energy, sweeps_since_lower, infinite_sweeps, fall, passes_pay] =
      *this;
  if (archive.reads()) softener = Softener(attempt, settings.energy, settings.options);
  archive(energy_unit, iteration, before_switch, softener, before, least_bad, sweeps_since_fewer_bad, least_energy,
          sweeps_since_lower, infinite_sweeps, fall, passes_pay);
}

void Softener::visit(Archive& archive) {
  auto& [attempt, gamma_shrinks, h0_shrinks, settled, sweeps_at_level] = *this;
  archive(settled, sweeps_at_level);
}

void AccuracyPhase::visit(Archive& archive) {
  auto& [mesh, domain, settings, run, energy_unit, iteration, bad, before, now] = *this;
  auto& [sizes, floors] = domain;
  archive(sizes, floors, iteration, bad, before, now);
  archive.require(sizes.size() == mesh.n_vertices() && floors.size() == mesh.n_triangles());
}

void ErrorPhase::visit(Archive& archive) {
  auto& [mesh, frame, domain, settings, run, freedom, iteration, bad, start, now, descent, stuck, history] = *this;
  auto& [sizes, floors] = domain;
  auto& [lowered, error, gradient] = now;
  archive(sizes, floors, iteration, bad, start, lowered, error, gradient, descent, stuck, history);
  archive.require(sizes.size() == mesh.n_vertices() && floors.size() == mesh.n_triangles());
  archive.require(gradient.empty() || gradient.size() == 3 * mesh.n_vertices());
}

void RepairSearch::visit(Archive& archive) {
  auto& [work, settings, run, flipper, recorder, rng, asks_programmes, failures, weighed, bad, changed] = *this;
  archive(rng, failures, weighed);
}

}  // namespace temper
