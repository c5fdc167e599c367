// The public functions on weights of surfaces.
#include "surfaces/weights/demand.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {

double weight_margin(const SurfaceMesh& mesh, Constraints constraints, std::span<const HalfedgeId> edges) {
  const SurfaceDemand demand(mesh, constraints, edges);
  return least_margin(demand, demand.weights());
}

double weight_change(const SurfaceMesh& mesh, const VertexWeights& from, const VertexWeights& to) {
  return temper::weight_change(SurfaceDemand(mesh, Constraints::well_centered), from, to);
}

std::optional<InputError> expect_surface_request(const Mesh& mesh, const WeightOptions& options,
                                                 const ConvexSolver* convex) {
  if (auto error = expect_request(mesh, options, convex)) return error;
  if (options.goal != WeightGoal::accuracy) return std::nullopt;
  return InputError{ErrorCode::invalid_option, "",
                    "goal: accuracy is for meshes of the plane, the sphere and tetrahedra. Next: goal center"};
}

Expected<WeightReport> find_weights(const SurfaceMesh& mesh, LpSolver& solver, const WeightOptions& options,
                                    ConvexSolver* convex) {
  if (auto error = expect_surface_request(mesh.connectivity(), options, convex)) return *std::move(error);
  return temper::find_weights(SurfaceDemand(mesh, options.constraints, options.edges), solver, options, convex);
}

}  // namespace temper::surfaces
