// The phase for accuracy. It begins where the sweeps of the pseudo-barrier end, and keeps the connectivity. Steps of
// L-BFGS over all vertices lower
//
//     ln J + κ ln(E + B),
//
// with the error J of a scheme, and the energy E and the barrier B of accuracy_energy.hpp, as in the plane
// (optimize/solver_error). Without a model of J they lower the second term alone. A tetrahedron whose orthocenter is
// inside stays so, by exact predicates. One that is bad stays as it is, with its corners.
#pragma once

#include <vector>

#include "base/descent.hpp"
#include "temper/tets/optimize.hpp"
#include "tets/energy/accuracy_energy.hpp"
#include "tets/energy/star.hpp"
#include "tets/optimize/newton_step.hpp"
#include "tets/optimize/sweeper.hpp"

namespace temper::tets {

/// The factors of E and the barrier for Scheme::vertex or Scheme::cell.
[[nodiscard]] AccuracyModel accuracy_model(Scheme scheme);

/// The edges of regular tetrahedra of the mean volume around each vertex, averaged ten times with the neighbors'.
[[nodiscard]] VertexSizes local_sizes(const TetMesh& mesh);

class Accuracy {
 public:
  /// `error`: J, or null. Then it has no bad tetrahedron.
  Accuracy(TetMesh& mesh, IdVector<VertexId, Mobility> mobility, const AccuracyModel& model,
           const DiscretizationError* error, Executor* executor);

  /// Takes one step. Returns false if there is none, or if it must stop.
  bool descend(const MustStop& must_stop);
  /// √J after the last step, or without a model E.
  [[nodiscard]] double measure() const { return now_.measure; }

 private:
  friend class temper::Descent;                // which takes steps
  static constexpr std::size_t kUnknowns = 4;  // places over the local size, the weight over its square
  struct Value {
    double lowered = 0, measure = 0;
    Descent::Vector gradient;  // of `lowered`, by the scaled unknowns
  };

  [[nodiscard]] Value value() const;
  [[nodiscard]] bool is_inside() const;
  [[nodiscard]] std::size_t n_elements() const { return mesh_.n_tetrahedra(); }
  [[nodiscard]] const auto& corners(std::size_t tetrahedron) const { return mesh_.corners(TetId(tetrahedron)); }
  [[nodiscard]] double room(std::size_t tetrahedron) const {
    return least_height(mesh_, TetId(tetrahedron)) - floors_[TetId(tetrahedron)];
  }
  /// Moves the vertices from before_ by t times the step.
  void place(const Descent::Vector& step, double t);

  TetMesh& mesh_;
  IdVector<VertexId, Mobility> mobility_;
  const DiscretizationError* error_;
  Executor* executor_;
  IdVector<VertexId, WeightedPoint> before_;  // the step
  VertexSizes sizes_;                         // units of positions; their squares are those of weights
  IdVector<TetId, double> floors_;
  AccuracyEnergy energy_;
  Descent descent_;
  Value now_;
  std::vector<double> lowered_;  // after each step
};

}  // namespace temper::tets
