// The objective of a step as a function of one vertex: an energy of the registry, or the accuracy objective.
#pragma once

#include <memory>

#include "energy/patch.hpp"
#include "optimize/options/settings.hpp"

namespace temper {

/// An objective keeps its storage from one vertex to the next.
class StarObjective {
 public:
  virtual ~StarObjective() = default;

  /// Takes the star of v as it is now. Returns false if v must stay.
  virtual bool gather(VertexId v) = 0;
  [[nodiscard]] virtual double value(const WeightedPoint& p) = 0;
  [[nodiscard]] virtual VertexDerivatives derivatives(const WeightedPoint& p) = 0;
  /// The unit of steps.
  [[nodiscard]] virtual double radius(const WeightedPoint& p) const = 0;
  /// Says exactly whether v may be at p.
  [[nodiscard]] bool is_valid(const WeightedPoint& p) const;

  [[nodiscard]] const Patch& patch() const { return patch_; }

  const int trials;                ///< per search; near a barrier more trials pay
  const bool keeps_edges_regular;  ///< no edge can stop being regular

 protected:
  StarObjective(const Mesh& mesh, int of_search, bool keeps_regular)
      : trials(of_search), keeps_edges_regular(keeps_regular), mesh_(mesh) {}
  [[nodiscard]] virtual bool has_valid_triangles(const WeightedPoint& p) const = 0;

  const Mesh& mesh_;
  Patch patch_;
};

/// The objective of the sweep under way.
[[nodiscard]] std::unique_ptr<StarObjective> make_star_objective(const Mesh& mesh, const Settings& settings,
                                                                 const SweepState& state);

}  // namespace temper
