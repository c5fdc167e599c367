#include "optimize/step/star_objective.hpp"

#include "geometry/predicates_inline.hpp"
#include "optimize/step/descent.hpp"
#include "optimize/step/search.hpp"

namespace temper {
namespace {

// HOT has no barrier. So a vertex must not come nearer to a neighbor than this part of the patch radius.
constexpr double kShortestEdge = 1e-7;

/// An energy of the registry. A place is valid if all triangles of the star are counter-clockwise. Without a barrier,
/// edges must also keep a least length.
class EnergyStar final : public StarObjective {
 public:
  EnergyStar(const Mesh& mesh, const SweepState& state) : StarObjective(mesh, kTrials, false), state_(state) {}

  bool gather(VertexId v) override {
    origin_ = mesh_.point(v);
    gather_patch(mesh_, v, needs_outer(state_.model.kind), patch_);
    return true;
  }
  double value(const WeightedPoint& p) override { return patch_energy(patch_, state_.model, p); }
  VertexDerivatives derivatives(const WeightedPoint& p) override { return patch_derivatives(patch_, state_.model, p); }
  [[nodiscard]] double radius(const WeightedPoint& p) const override { return patch_radius(patch_, p); }

 private:
  [[nodiscard]] bool has_valid_triangles(const WeightedPoint& p) const override {
    const double nearest = state_.energy.barrier ? 0 : kShortestEdge * patch_radius(patch_, origin_);
    for (std::size_t i = 0; i < patch_.size(); ++i) {
      const WeightedPoint q = patch_.q(i);
      if (inlined::orientation(patch_.space, p, q, patch_.r(i)) != Sign::positive) return false;
      if (edge_measures(patch_.space, p, q).l2 < nearest * nearest) return false;
    }
    return true;
  }

  const SweepState& state_;
  WeightedPoint origin_;
};

/// The accuracy objective. A vertex stays if a triangle around it has no floor. A place is valid if all triangles are
/// well-centered. No edge stops being regular: the dual of an inner edge has the length h_k + h_l, and is regular if
/// this is not negative. Before a step all triangles in and around the star are well-centered. The step changes the
/// star alone, whose triangles stay well-centered.
class AccuracyStar final : public StarObjective {
 public:
  AccuracyStar(const Mesh& mesh, const AccuracyModel& model, const AccuracyDomain& domain)
      : StarObjective(mesh, kTrialsWithMargins, true), model_(model), domain_(domain) {}

  bool gather(VertexId v) override {
    gather_patch(mesh_, v, false, patch_);
    return accuracy_.gather(mesh_, domain_.sizes, domain_.floors, model_, v);
  }
  double value(const WeightedPoint& p) override { return accuracy_.value(p); }
  VertexDerivatives derivatives(const WeightedPoint& p) override {
    const double value = accuracy_.value(p);
    return value < kInfinity ? accuracy_.derivatives() : VertexDerivatives{.value = value};
  }
  [[nodiscard]] double radius(const WeightedPoint& p) const override { return accuracy_.shortest_spoke(p); }

 private:
  [[nodiscard]] bool has_valid_triangles(const WeightedPoint& p) const override {
    return accuracy_.is_well_centered(p);
  }

  const AccuracyModel& model_;
  const AccuracyDomain& domain_;
  AccuracyPatch accuracy_;
};

}  // namespace

bool StarObjective::is_valid(const WeightedPoint& p) const {
  for (std::size_t i = 0; patch_.space.is_periodic() && i < patch_.link.size(); ++i) {
    if (!patch_.space.are_near(p, patch_.q(i))) return false;
  }
  return has_valid_triangles(p);
}

std::unique_ptr<StarObjective> make_star_objective(const Mesh& mesh, const Settings& settings,
                                                   const SweepState& state) {
  if (state.accuracy_domain == nullptr) return std::make_unique<EnergyStar>(mesh, state);
  return std::make_unique<AccuracyStar>(mesh, settings.accuracy, *state.accuracy_domain);
}

}  // namespace temper
