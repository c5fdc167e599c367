#include "optimize/sweep/sweeper.hpp"

namespace temper {

Sweeper::Sweeper(WorkingCopy& work, const Settings& settings, const SweepState& state, Flipper& flipper,
                 const Recorder& recorder, std::size_t part_size)
    : limits_(work.mesh, settings, work.frame),
      context_{work.mesh, settings, state, work.frame, limits_, recorder},
      flipper_(flipper),
      improvers_([this] {
        auto improver = std::make_unique<Improver>(context_);
        improver->step().begin_sweep(iteration_, unknowns_);
        return improver;
      }),
      parts_(part_size, improvers_) {}

bool Sweeper::sweep(int iteration, std::span<const VertexId> sequence, Run& run) {
  const Unknowns all = unknowns_of_sweep(context_.settings, context_.state.energy, iteration);
  if (context_.settings.policy.visits == Visits::once || all != Unknowns::positions_and_weights) {
    return visit_all(iteration, all, sequence, run);
  }
  return visit_all(iteration, Unknowns::positions, sequence, run) &&
         visit_all(iteration, Unknowns::weights, sequence, run);
}

bool Sweeper::visit_all(int iteration, Unknowns unknowns, std::span<const VertexId> sequence, Run& run) {
  iteration_ = iteration;
  unknowns_ = unknowns;
  improvers_.for_each([&](Improver& improver) { improver.step().begin_sweep(iteration, unknowns); });
  StopToken stop(run, context_.mesh.n_vertices());
  if (sequence.empty()) {
    parts_.in_parts(context_.mesh, engine(), stop);
  } else {
    parts_.in_order(sequence, stop);
  }
  improvers_.for_each([](Improver& improver) { improver.step().end_sweep(); });
  add_changes();
  return !stop.stopped();
}

void Sweeper::shake(double amount, Rng& rng) {
  improvers_.make_room(1);
  improvers_.take()->step().shake(amount, rng);
  add_changes();
}

/// That of the caller, where steps do no more than sweeper.hpp says of them; else one part after another, on each rank.
Engine Sweeper::engine() {
  const Policy& policy = context_.settings.policy;
  const bool told_in_order = context_.recorder.on() || policy.defers_updates();
  const bool removes = policy.removes_hidden() || policy.changes_vertices();
  if (told_in_order || removes || limits_.band.on()) return &in_order_;
  return engine_of(context_.settings.hooks);
}

void Sweeper::add_changes() {
  improvers_.for_each([this](Improver& improver) { flipper_.add(improver.flipper().take_changes()); });
}

}  // namespace temper
