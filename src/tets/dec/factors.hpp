// Operators with a factor on each tetrahedron.
#pragma once

#include "temper/tets/operators.hpp"

namespace temper::tets {

struct WithFactors {
  IdVector<EdgeId, double> star1;
  IdVector<VertexId, double> star0;
  IdVector<FaceId, double> transmissibility;
};
/// ★1 and ★0 with a factor on the part in each tetrahedron, and the transmissibility with its sides one after the
/// other. Precondition: `complex` has the faces of dec_operators(mesh).
[[nodiscard]] WithFactors with_factors(const TetMesh& mesh, const DecComplex& complex,
                                       const IdVector<TetId, double>& factors);

}  // namespace temper::tets
