#include "optimize/sweep/sweeper.hpp"

namespace temper {

Sweeper::Sweeper(Mesh& mesh, const Settings& settings, const Frame& frame, Flipper& flipper, const Recorder& recorder,
                 std::size_t part_size)
    : limits_(mesh, settings, frame),
      context_{mesh, settings, frame, limits_, recorder},
      flipper_(flipper),
      improvers_([this] {
        auto improver = std::make_unique<Improver>(context_);
        improver->step().begin_sweep(iteration_);
        return improver;
      }),
      parts_(part_size, improvers_),
      passes_(context_, part_size) {}

bool Sweeper::sweep(int iteration, std::span<const VertexId> sequence, Run& run) {
  iteration_ = iteration;
  improvers_.for_each([&](Improver& improver) { improver.step().begin_sweep(iteration); });
  StopToken stop(run, context_.mesh.n_vertices());
  if (sequence.empty()) {
    parts_.in_parts(context_.mesh.n_vertices(), executor(), stop);
  } else {
    parts_.in_order(sequence, stop);
  }
  improvers_.for_each([](Improver& improver) { improver.step().end_sweep(); });
  add_changes();
  return !stop.stopped();
}

bool Sweeper::newton_pass(int iteration, Run& run) {
  StopToken stop(run, context_.mesh.n_vertices());
  passes_.run(unknowns_of_sweep(context_.settings.options, iteration), stop);
  return !stop.stopped();
}

void Sweeper::shake(double amount, Rng& rng) {
  improvers_.make_room(1);
  improvers_.take()->step().shake(amount, rng);
  add_changes();
}

/// The executor of the options, where steps do no more than sweeper.hpp says of them; else a serial one.
Executor& Sweeper::executor() {
  const OptimizeOptions& o = context_.settings.options;
  const bool told_in_order = context_.recorder.on() || o.paper.weight_updates == WeightUpdates::deferred;
  const bool removes =
      o.paper.hidden == HiddenPolicy::remove || o.paper.collapse_from || o.paper.removal != Removal::none;
  return told_in_order || removes || limits_.band.on() ? in_order_ : or_serial(context_.settings.hooks.executor);
}

void Sweeper::add_changes() {
  improvers_.for_each([this](Improver& improver) { flipper_.add(improver.flipper().take_changes()); });
}

}  // namespace temper
