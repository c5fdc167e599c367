#include "optimize/step/star_energy.hpp"

#include "geometry/predicates_inline.hpp"
#include "optimize/step/line_search.hpp"
#include "optimize/step/search.hpp"

namespace temper {
namespace {

// HOT has no barrier: nothing may come nearer to a neighbour than this part of the patch radius.
constexpr double kShortestEdge = 1e-7;

}  // namespace

bool StarEnergy::gather(VertexId v) {
  origin_ = mesh_.point(v);
  gather_patch(mesh_, v, !is_of_accuracy() && needs_outer(settings_.model.kind), patch_);
  if (!is_of_accuracy()) return true;
  const auto& [sizes, floors] = *settings_.accuracy_domain;
  return accuracy_.gather(mesh_, sizes, floors, settings_.accuracy, v);
}

double StarEnergy::value(const WeightedPoint& p) {
  return is_of_accuracy() ? accuracy_.value(p) : patch_energy(patch_, settings_.model, p);
}

VertexDerivatives StarEnergy::derivatives(const WeightedPoint& p) {
  if (!is_of_accuracy()) return patch_derivatives(patch_, settings_.model, p);
  VertexDerivatives outside;
  outside.value = accuracy_.value(p);
  return outside.value < kInfinity ? accuracy_.derivatives() : outside;
}

double StarEnergy::radius(const WeightedPoint& p) const {
  return is_of_accuracy() ? accuracy_.shortest_spoke(p) : patch_radius(patch_, p);
}

int StarEnergy::trials() const { return is_of_accuracy() ? kTrialsWithMargins : kTrials; }

bool StarEnergy::is_valid(const WeightedPoint& p) const {
  for (std::size_t i = 0; patch_.space.is_periodic() && i < patch_.link.size(); ++i) {
    if (!patch_.space.are_near(p, patch_.q(i))) return false;
  }
  if (is_of_accuracy()) return accuracy_.is_well_centered(p);
  const double nearest = settings_.energy.barrier ? 0 : kShortestEdge * patch_radius(patch_, origin_);
  for (std::size_t i = 0; i < patch_.size(); ++i) {
    const WeightedPoint q = patch_.q(i);
    if (inlined::orientation(patch_.space, p, q, patch_.r(i)) != Sign::positive) return false;
    if (edge_measures(patch_.space, p, q).l2 < nearest * nearest) return false;
  }
  return true;
}

}  // namespace temper
