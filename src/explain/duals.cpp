// Explanations of duals in the plane and on the sphere.
#include "explain/duals.hpp"

#include <numbers>

#include "base/assert.hpp"
#include "regularity/duals.hpp"

namespace temper {
namespace {

/// One side of an edge.
struct Side {
  VertexId apex;
  double h_over_l, angle_deg;
};

Side side_of(const Mesh& mesh, HalfedgeId h) {
  const auto [a, b, c] = mesh.points(mesh.origin(h), mesh.target(h), mesh.opposite(h));
  const double angle = corner_angle(mesh.space(), c, a, b) * 180 / std::numbers::pi;
  return {mesh.opposite(h), dual_over_length(mesh, h, DualKind::region, height_sign(mesh, h)), angle};
}

std::string text(const Side& side) {
  return height_text(side.h_over_l, side.apex) + ", where the angle is " + degrees(side.angle_deg);
}

/// Without weights a dual is negative if the angles across it are above 180° together, or above 90° alone.
std::string cause(double sum_of_angles, double limit) {
  return sum_of_angles > limit ? "" : "; such angles allow a positive one, so the weights are the cause";
}

std::string why(const Mesh& mesh, const ViolatedEdge& violated) {
  const Side side = side_of(mesh, violated.edge);
  if (violated.kind != DualKind::inside) return text(side) + cause(side.angle_deg, 90);
  const Side other = side_of(mesh, mesh.twin(violated.edge));
  return text(side) + ", and " + text(other) + cause(side.angle_deg + other.angle_deg, 180);
}

}  // namespace

DualExplanation explain_duals(const Mesh& mesh, Criterion criterion, std::size_t most, Executor* executor) {
  TEMPER_ASSERT(criterion != Criterion::well_centered);
  return worst_of(
      criterion, violated_edges(mesh, criterion, executor), most, [](const ViolatedEdge& v) { return v.dual_over_l; },
      [&](const ViolatedEdge& v) {
        const EdgePlace place = place_of(mesh, v.edge);
        return DualReason{{place.vertices.begin(), place.vertices.end()},
                          v.kind,
                          v.dual_over_l,
                          {place.at.x, place.at.y, 0},
                          why(mesh, v)};
      });
}

}  // namespace temper
