// The public functions of temper/tets/weights.hpp.
#include "temper/tets/weights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "tets/weights/demand.hpp"

namespace temper::tets {
namespace {

constexpr std::array<ConstraintsInfo, 5> kConditions = {{
    {Constraints::well_centered, "well_centered", "h >= t l over faces", "weights make every tetrahedron well-centered",
     "no weights make every tetrahedron well-centered"},
    {Constraints::completely_well_centered, "completely_well_centered",
     "h >= t l over faces and, in faces, over edges, and t l <= d <= (1 - t) l",
     "weights make every tetrahedron completely well-centered",
     "no weights make every tetrahedron completely well-centered"},
    {Constraints::regular, "regular", "dual length >= t l of faces", "weights make every face regular",
     "no weights make every face regular, if weights differ by less than 2^20 l^2 along edges"},
    {Constraints::coefficients, "coefficients",
     "dual length >= t l of faces inside, h >= 0 over the boundary, both sides of interfaces and, within them, edges",
     "weights make no coefficient of an edge negative",
     "no weights make all dual lengths of faces and all heights over and within the boundary positive or zero, if "
     "weights differ by less than 2^20 l^2 along edges"},
    {Constraints::distances, "distances",
     "dual length >= t l of faces inside, h >= t l over the boundary and over both sides of interfaces",
     "weights make all distances between centers positive",
     "no weights make all distances between centers positive, if weights differ by less than 2^20 l^2 along edges"},
}};

}  // namespace

std::span<const ConstraintsInfo> constraints_table() { return kConditions; }

double weight_margin(const TetMesh& mesh, Constraints constraints) {
  const TetDemand demand(mesh, constraints);
  return least_margin(demand, demand.weights());
}

namespace {

std::optional<InputError> expect_request(const WeightOptions& options, const ConvexSolver* convex) {
  if (options.constraints == Constraints::heights_only) {
    return InputError{
        ErrorCode::invalid_option, "",
        "constraints: expected well_centered, completely_well_centered or regular, found heights_only: it "
        "is for triangles. Next: well_centered, which is about heights alone"};
  }
  if (!options.edges.empty())
    return InputError{ErrorCode::invalid_option, "", "edges: they are for triangles; regular is about all faces"};
  return expect_goal(options, convex);
}

}  // namespace

Expected<WeightReport> find_weights(const TetMesh& mesh, LpSolver& solver, const WeightOptions& options,
                                    ConvexSolver* convex) {
  if (auto error = expect_request(options, convex)) return *std::move(error);
  return temper::find_weights(TetDemand(mesh, options.constraints), solver, options, convex);
}

Expected<WeightReport> find_weights(const MetricMesh& pieces, LpSolver& solver, const WeightOptions& options,
                                    ConvexSolver* convex) {
  if (auto error = expect_request(options, convex)) return *std::move(error);
  if (auto error = expect_goal_across_interfaces(options, pieces.is_cut())) return *std::move(error);
  return temper::find_weights(TetDemand(pieces, options.constraints), solver, options, convex);
}

double largest_gap_of_edges(const MetricMesh& pieces) {
  const TetDemand demand(pieces, Constraints::well_centered);
  const auto weight = [&pieces](VertexId v) { return pieces.mesh.weight(v); };
  double gap = 0;
  for (const WeightConstraint& c : equations_of_seams(pieces))
    gap = std::max(gap, std::abs(value_of(demand.linear_form(c), weight)));
  return gap;
}

double largest_gap(const MetricMesh& pieces) {
  double gap = 0;
  for (const SeamFace& seam : seams_of(pieces)) {
    const auto [one, other] = corners_of(pieces, seam);
    const auto center = [&](const std::array<VertexId, 3>& face, HalffaceId h) {
      const TetMesh& mesh = pieces.mesh;
      const Vec3 there = orthocenter(mesh.point(face[0]), mesh.point(face[1]), mesh.point(face[2]));
      return pieces.metric(TetMesh::tetrahedron(h)).from_metric(there);
    };
    const Metric& metric = pieces.metric(TetMesh::tetrahedron(seam.one));
    std::array<Vec3, 3> at;
    for (std::size_t k = 0; k < 3; ++k) at[k] = metric.from_metric(pieces.mesh.position(one[k]));
    const double longest = std::max({length(at[1] - at[0]), length(at[2] - at[1]), length(at[0] - at[2])});
    gap = std::max(gap, length(center(one, seam.one) - center(other, seam.other)) / longest);
  }
  return gap;
}

}  // namespace temper::tets
