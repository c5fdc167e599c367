// The phase for accuracy. It begins where the sweeps of the pseudo-barrier end, and keeps the connectivity. Steps of
// L-BFGS over all vertices lower
//
//     ln J + κ ln(E + B),
//
// with the error J of a scheme, a geometric mean over kinds of fields, and the energy E and the barrier B of
// accuracy_energy.hpp, as in the plane (optimize/solver_error). Without a model of J they lower the second term alone.
// Faces that keep the criterion go on to keep it, by exact predicates. Around others all corners stay. No dihedral
// angle falls below a limit, or below the least one that its tetrahedron has.
#pragma once

#include <vector>

#include "base/descent.hpp"
#include "temper/tets/optimize.hpp"
#include "tets/energy/accuracy_energy.hpp"
#include "tets/energy/star.hpp"
#include "tets/optimize/newton_step.hpp"
#include "tets/optimize/sweeper.hpp"

namespace temper::tets {

/// The factors of E and the barrier for a scheme.
[[nodiscard]] AccuracyModel accuracy_model(Scheme scheme);

/// The edges of regular tetrahedra of the mean volume around each vertex, averaged ten times with the neighbors'.
[[nodiscard]] VertexSizes local_sizes(const TetMesh& mesh);

/// What steps keep.
struct AccuracyLimits {
  Criterion criterion = Criterion::well_centered;
  double most_cosine = 1;  ///< Largest cosine of a dihedral angle
  double margin = 0;       ///< Least h/ℓ of sides that have it
};

/// The errors that are lowered.
struct AccuracyErrors {
  const DiscretizationError* model = nullptr;  ///< J, or null
  std::vector<double> unit;                    ///< Errors that count as 1, one for each error of the model
  bool fronts_count_twice = false;             ///< The second error, of fronts, in the mean with waves

  /// How often error i counts in the mean.
  [[nodiscard]] int count(std::size_t i) const { return i == 1 && fronts_count_twice ? 2 : 1; }
  /// How often all of them count together.
  [[nodiscard]] int counts() const {
    int sum = 0;
    for (std::size_t i = 0; i < unit.size(); ++i) sum += count(i);
    return sum;
  }
  /// The geometric mean of root mean square errors over their units. Precondition: `errors` are squared, one or two.
  [[nodiscard]] double mean_ratio(const std::vector<double>& errors) const;
};

class Accuracy {
 public:
  Accuracy(TetMesh& mesh, IdVector<VertexId, Mobility> mobility, const AccuracyModel& model,
           const AccuracyLimits& limits, AccuracyErrors errors, Executor* executor);

  /// Takes one step. Returns false if there is none, or if it must stop.
  bool descend(const MustStop& must_stop);
  /// The mean ratio of errors after the last step, or without a model E.
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
  /// The least distance to a limit, of a height or of the cosine of an angle.
  [[nodiscard]] double room(std::size_t tetrahedron) const;
  [[nodiscard]] bool keeps_criterion(HalffaceId h) const;
  /// Moves the vertices from before_ by t times the step.
  void place(const Descent::Vector& step, double t);

  TetMesh& mesh_;
  IdVector<VertexId, Mobility> mobility_;
  Criterion criterion_;
  AccuracyErrors errors_;
  Executor* executor_;
  IdVector<VertexId, WeightedPoint> before_;  // the step
  VertexSizes sizes_;                         // units of positions; their squares are those of weights
  AccuracyEnergy::Floors floors_;
  IdVector<TetId, double> most_cosine_;  // of a dihedral angle
  AccuracyEnergy energy_;
  Descent descent_;
  Value now_;
  std::vector<double> lowered_;  // after each step
};

}  // namespace temper::tets
