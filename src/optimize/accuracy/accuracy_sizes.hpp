// The target size of edges at each vertex. The accuracy objective divides its energy by it, so that the grading stays.
//
// It is the size field at the vertex's place in the input, or the input's local size without a field. It is averaged
// with the neighbors' sizes ten times, since sizes of badly shaped triangles are noisy. A size moves with its vertex:
// sizes taken at the new place give larger errors. An inserted vertex has its local size.
#pragma once

#include <optional>

#include "energy/accuracy_energy.hpp"
#include "optimize/working/working_copy.hpp"
#include "temper/detail/executor.hpp"
#include "temper/detail/size.hpp"

namespace temper {

class AccuracySizes {
 public:
  /// Computes the sizes of the input. `numbers`: the user's number of each vertex; empty if all numbers are equal.
  AccuracySizes(const Mesh& mesh, const IdVector<VertexId, VertexId>& numbers, const std::optional<SizeField>& field,
                Executor* executor);

  /// Returns the sizes of the input in the user's units.
  [[nodiscard]] const VertexSizes& of_input() const { return input_; }
  /// Returns the sizes of a working copy of the input, in working units.
  [[nodiscard]] VertexSizes of(const WorkingCopy& work, Executor* executor) const;
  /// Lends the sizes of a working copy. If the copy has exactly the vertices of the input, this object has no sizes
  /// until take_back(), and then the sizes of such copies alone. For the largest meshes, two arrays would take too much
  /// memory.
  [[nodiscard]] VertexSizes lend(const WorkingCopy& work, Executor* executor);
  /// `lent`: the sizes that lend() gave for this copy, whose vertices have not changed.
  void take_back(VertexSizes lent);
  /// Ends with the sizes of a working copy in the user's units.
  [[nodiscard]] VertexSizes in_user_units(const WorkingCopy& work, Executor* executor) &&;
  /// Ends with the sizes of work.in_user_terms() in the user's units.
  [[nodiscard]] VertexSizes in_user_terms(const WorkingCopy& work, Executor* executor) &&;

 private:
  VertexSizes input_;    // by the user's numbers; empty after lend()
  VertexSizes working_;  // in place of them, of working copies
};

/// Raises the floors of a domain to the present values of the mesh. Returns true if the barrier changes.
bool raise_floors(AccuracyDomain& domain, const Mesh& mesh, const AccuracyModel& model, Executor* executor);

}  // namespace temper
