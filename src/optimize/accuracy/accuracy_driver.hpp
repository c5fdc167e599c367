// The second phase of the accuracy objective: sweeps that lower the energy of accuracy_energy.hpp on a mesh whose
// triangles are well-centered, as far as the first phase could make them so. The connectivity stays.
#pragma once

#include <cstddef>

#include "optimize/accuracy/accuracy_sizes.hpp"
#include "optimize/run.hpp"
#include "optimize/sweep/accuracy_sweeper.hpp"
#include "optimize/sweep/sweeper.hpp"

namespace temper {

class AccuracyDriver {
 public:
  AccuracyDriver(WorkingCopy& work, const Settings& settings, Run& run, const AccuracySizes& sizes,
                 std::size_t part_size = kPartSize);

  /// `sweep`: whose mesh the working copy is. Returns the sweep whose mesh it is then.
  int optimize(int sweep);

 private:
  struct Best {
    IdVector<VertexId, WeightedPoint> points;
    double energy = 0;
    int sweep = 0;
  };

  void shift_weights_to_anchor();
  void sweep_until_it_is_enough();
  [[nodiscard]] bool converged(const AccuracyTotal& before, const AccuracyTotal& after) const;
  [[nodiscard]] AccuracyTotal total() const;
  void record(const AccuracyTotal& total);
  void keep_if_best(const AccuracyTotal& total, int sweep);
  void return_best();
  void show(Snapshot::Moment moment) const;

  WorkingCopy& work_;
  Mesh& mesh_;
  const Settings& settings_;
  const AccuracyOptions& options_;
  Run& run_;
  double energy_unit_;  // the user's energy of one unit in the frame
  Recorder recorder_;
  AccuracyGround ground_;
  AccuracySweeper sweeper_;
  std::size_t bad_;  // all through the phase
  AccuracyTotal now_;
  Best best_;
};

}  // namespace temper
