// The phases for accuracy. They begin where the sweeps of the pseudo-barrier end, and keep the connectivity. Sweeps
// lower
//
//     E + B, the energy and barrier of accuracy_star.hpp.
//
// Then steps of L-BFGS over all vertices lower, with the error J of a scheme,
//
//     ln J + κ ln(E + B)
//
// as in the plane (optimize/solver_error). A tetrahedron whose orthocenter is inside stays so, by exact predicates. One
// that is bad stays as it is, with its corners.
#pragma once

#include <functional>
#include <vector>

#include "base/descent.hpp"
#include "temper/tets/optimize.hpp"
#include "tets/energy/accuracy_star.hpp"
#include "tets/optimize/newton_step.hpp"

namespace temper::tets {

/// The factors of E and the barrier for Scheme::vertex or Scheme::cell.
[[nodiscard]] AccuracyModel accuracy_model(Scheme scheme);

/// The edges of regular tetrahedra of the mean volume around each vertex, averaged ten times with the neighbors'.
[[nodiscard]] VertexSizes local_sizes(const TetMesh& mesh);

class Accuracy {
 public:
  Accuracy(TetMesh& mesh, IdVector<VertexId, Mobility> mobility, const AccuracyModel& model);

  /// Takes one Newton step of v, over-relaxed if this lowers E + B.
  void improve(VertexId v, double relaxation);
  /// E of the mesh without duals that are not positive, and the barrier, +∞ with bad tetrahedra.
  [[nodiscard]] AccuracyTotal energy();
  /// Takes one step over all vertices. Returns false if there is none, or if it must stop. Precondition: no tetrahedron
  /// is bad.
  bool descend(const DiscretizationError& model, const std::function<bool()>& must_stop);
  /// J after the last step.
  [[nodiscard]] double error() const { return now_.error; }

 private:
  struct Total {
    double lowered = 0, error = 0;
    Descent::Vector gradient;  // of `lowered`, by scaled unknowns: four per vertex
  };

  void gather(VertexId v);
  /// Scales the unknowns by the local size, and less where E + B bends more.
  void find_scales();
  [[nodiscard]] Total total(const DiscretizationError& model);
  void place(const IdVector<VertexId, WeightedPoint>& from, const Descent::Vector& step, double t);
  void shorten(const IdVector<VertexId, WeightedPoint>& from, Descent::Vector& step);

  TetMesh& mesh_;
  IdVector<VertexId, Mobility> mobility_;
  AccuracyModel model_;
  AccuracyDomain domain_;
  std::vector<HalffaceId> link_;  // of the present vertex
  AccuracyStar star_;
  // The steps over all vertices.
  Descent descent_;
  Total now_;
  IdVector<VertexId, std::array<double, 4>> scales_;  // of the unknowns
  bool has_begun_ = false;
};

}  // namespace temper::tets
