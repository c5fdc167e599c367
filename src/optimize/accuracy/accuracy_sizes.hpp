// The size that edges at each vertex are meant to have, for the accuracy objective: what its energy is over, so that
// grading is kept.
//
// The size field where the vertex is in the input, or without one the input's own local size there; averaged with the
// neighbors' ten times, since the sizes of badly shaped triangles are noise. A size belongs to its vertex and goes
// with it: looked up where the vertex has gone to, errors were larger. A vertex that was inserted has the local size
// that it has.
#pragma once

#include <optional>

#include "energy/accuracy_energy.hpp"
#include "mesh/curve.hpp"
#include "optimize/working/working_copy.hpp"
#include "temper/detail/executor.hpp"
#include "temper/detail/size.hpp"

namespace temper {

class AccuracySizes {
 public:
  /// The sizes of a mesh in the user's terms.
  AccuracySizes(const NearbyCopy& input, const std::optional<SizeField>& field, Executor* executor);

  /// The sizes of the input, in the user's units.
  [[nodiscard]] const VertexSizes& of_input() const { return input_; }
  /// The sizes of a working copy of it, in the units of its units.
  [[nodiscard]] VertexSizes of(const WorkingCopy& work, Executor* executor) const;
  /// The same, for a while: where the copy has all vertices of the input and no others, they are gone from here until
  /// they are given back. Both would count on the largest meshes.
  [[nodiscard]] VertexSizes lend(const WorkingCopy& work, Executor* executor);
  /// `lent`: what lend() gave for this copy, whose vertices are still the same.
  void take_back(VertexSizes lent, const WorkingCopy& work, Executor* executor);
  /// The same in the user's units.
  [[nodiscard]] VertexSizes in_user_units(const WorkingCopy& work, Executor* executor) const;
  /// The sizes of work.in_user_terms(), in the user's units.
  [[nodiscard]] VertexSizes in_user_terms(const WorkingCopy& work, Executor* executor) const;

 private:
  VertexSizes input_;  // by the user's numbers; none while they are lent
};

/// Raises the floors of a domain to what the mesh has now. True when that changes the barrier.
bool raise_floors(AccuracyDomain& domain, const Mesh& mesh, const AccuracyModel& model, Executor* executor);

}  // namespace temper
