// The energy that a step lowers, as a function of one vertex: that of the registry, or of the accuracy objective.
#pragma once

#include "energy/accuracy_energy.hpp"
#include "energy/patch.hpp"
#include "optimize/settings.hpp"

namespace temper {

/// Storage is kept from one vertex to the next.
class StarEnergy {
 public:
  StarEnergy(const Mesh& mesh, const Settings& settings) : mesh_(mesh), settings_(settings) {}

  /// Takes the star of v as it is now. False when v must stay: a triangle around it has no floor.
  bool gather(VertexId v);

  [[nodiscard]] double value(const WeightedPoint& p);
  [[nodiscard]] VertexDerivatives derivatives(const WeightedPoint& p);
  /// The unit of steps: the patch radius, or of the accuracy objective the shortest spoke.
  [[nodiscard]] double radius(const WeightedPoint& p) const;
  /// The number of trials of a search: near a barrier more of them pay.
  [[nodiscard]] int trials() const;
  /// Says whether with the vertex at p all triangles of the star are counter-clockwise, for accuracy well-centered too.
  /// Exact. An energy without barrier keeps its edges a little apart besides.
  [[nodiscard]] bool is_valid(const WeightedPoint& p) const;
  /// Says whether no edge can stop being regular. The dual of an edge between two triangles is h_k + h_l long, and the
  /// edge is regular where that is not negative. The accuracy objective has the triangles of the star and those across
  /// its link well-centered before a step, and those of the star, which alone change, after it.
  [[nodiscard]] bool keeps_edges_regular() const { return is_of_accuracy(); }

  [[nodiscard]] const Patch& patch() const { return patch_; }

 private:
  /// Says whether it is that of the accuracy objective.
  [[nodiscard]] bool is_of_accuracy() const { return settings_.accuracy_domain != nullptr; }

  const Mesh& mesh_;
  const Settings& settings_;
  Patch patch_;
  AccuracyPatch accuracy_;
  WeightedPoint origin_;
};

}  // namespace temper
