// The public functions of temper/tets/weights.hpp.
#include "temper/tets/weights.hpp"

#include <array>

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

Expected<WeightReport> find_weights(const TetMesh& mesh, LpSolver& solver, const WeightOptions& options,
                                    ConvexSolver* convex) {
  if (options.constraints == Constraints::heights_only) {
    return InputError{
        ErrorCode::invalid_option, "",
        "constraints: expected well_centered, completely_well_centered or regular, found heights_only: it "
        "is for triangles. Next: well_centered, which is about heights alone"};
  }
  if (!options.edges.empty())
    return InputError{ErrorCode::invalid_option, "", "edges: they are for triangles; regular is about all faces"};
  if (auto error = expect_goal(options, convex)) return *std::move(error);
  return temper::find_weights(TetDemand(mesh, options.constraints), solver, options, convex);
}

}  // namespace temper::tets
