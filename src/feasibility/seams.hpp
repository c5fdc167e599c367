// Interfaces between regions with different tensors (temper/detail/tensor.hpp), as programs for weights see them: the
// copies of a vertex, and one equation for each edge.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "feasibility/demand.hpp"

namespace temper {

class Seams {
 public:
  Seams() = default;
  /// `copies`: pairs of a vertex and another copy of it.
  Seams(std::size_t n_vertices, std::span<const std::array<VertexId, 2>> copies,
        std::vector<WeightConstraint> equations);

  [[nodiscard]] bool empty() const { return equations_.empty(); }
  /// Calls use(copy) for v and all its copies.
  template <class Use>
  void for_each_copy(VertexId v, const Use& use) const {
    VertexId copy = v;
    do {
      use(copy);
      if (!next_.empty()) copy = next_[copy];
    } while (copy != v);
  }
  /// The equations whose vertices are all in this sorted list.
  [[nodiscard]] std::vector<WeightConstraint> equations_among(std::span<const VertexId> sorted) const;
  /// Makes the least change of weights, in units of ℓ², that keeps the equations to rounding.
  void settle(VertexWeights& weights, const std::function<LinearForm(const WeightConstraint&)>& form_of) const;

 private:
  IdVector<VertexId, VertexId> next_;  ///< the next copy of each vertex, in a ring
  std::vector<WeightConstraint> equations_;
};

}  // namespace temper
