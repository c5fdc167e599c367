// Weights alone for tetrahedra: can a mesh become well-centered, or regular, if neither its positions nor its
// connectivity may change? Constraints, programs, reports and certificates are as in temper/feasibility.hpp.
//
// The length ℓ of a face is the side of the equilateral triangle with its area. The constraints for a margin t are:
//   well_centered              height of the orthocenter of each tetrahedron over each face ≥ tℓ
//   completely_well_centered   the same; height of the orthocenter of each face over each edge ≥ tℓ; tℓ ≤ d ≤ (1 − t)ℓ
//   regular                    dual length of each interior face ≥ tℓ
//   coefficients               the same, or as small as it was; height ≥ 0 of orthocenters over the boundary and over
//                              both sides of interfaces between regions. Within these faces, at each edge pq with pqr
//                              and qps: c h_r + h_s ≥ 0 and h_r + c h_s ≥ 0 if their normals are at most 5.07° apart
//                              (c² = cos² ≥ 127/128). At other edges each h ≥ 0
//   distances                  dual length of each interior face ≥ tℓ, and all these heights over faces ≥ tℓ
//
// The polynomials N_c and M_c of certificates are linear in the weights:
//
//   height_over_face   N = n · Σ λ_v n_v = 4 h_s A V,       M = 4 ℓ A V
//   height, crossing   as in the plane, M with twice the area of the face for S
//   dual_of_face       N = the power determinant of pqrs and t = (h_s + h_t) V U / A, M = ℓ V U / A
//   dual               N as for height_over_face = 2 (c h_r + h_s) S² T / ℓ, with S and T twice the areas of pqr and
//   qps
//
// Here λ_v = |v − p|² − w_v + w_p, A is the area of the face pqr, and V and U are six times the volumes of pqrs and
// prqt. n = (q − p) × (r − p), and n_q = (r − p) × (s − p), n_r = (s − p) × (q − p), n_s = n. M is a double.
#pragma once

#include <span>

#include "temper/feasibility.hpp"
#include "temper/tets/mesh.hpp"
#include "temper/tets/tensor.hpp"

namespace temper::tets {

/// Rows for all but heights_only.
[[nodiscard]] std::span<const ConstraintsInfo> constraints_table();

/// The margin of the mesh's own weights, in doubles: the least of the ratios that the constraints have.
[[nodiscard]] double weight_margin(const TetMesh& mesh, Constraints constraints = Constraints::well_centered);

/// Finds weights for a mesh with fixed positions and connectivity, as temper::find_weights does. Errors: a margin out
/// of range, constraints or edges that are for triangles.
[[nodiscard]] Expected<WeightReport> find_weights(const TetMesh& mesh, LpSolver& solver,
                                                  const WeightOptions& options = {}, ConvexSolver* convex = nullptr);

/// Verifies a certificate in exact arithmetic, from the positions alone. Along an edge of a tetrahedron pqrs weights
/// differ by at most:
///   - completely_well_centered: ℓ²
///   - well_centered: the greatest of ℓ², ||r − p|² − |r − q|²| and ||s − p|² − |s − q|²|
///   - regular, coefficients, distances: kWeightReach ℓ², an assumption
[[nodiscard]] CertificateCheck check_certificate(const TetMesh& mesh, const Certificate& certificate);

// --- in the spaces of several tensors (temper/tets/tensor.hpp) ---------------------------------------------------

/// The same with one weight for each vertex and region, and the equations of the edges of interfaces, as
/// temper::find_weights. Error also: center, accuracy and least across interfaces.
[[nodiscard]] Expected<WeightReport> find_weights(const MetricMesh& pieces, LpSolver& solver,
                                                  const WeightOptions& options = {}, ConvexSolver* convex = nullptr);
/// The same with equations of interfaces as terms.
[[nodiscard]] CertificateCheck check_certificate(const MetricMesh& pieces, const Certificate& certificate);

/// The largest difference between the crossings d/ℓ of an interface edge, as two of its pieces have them; 0 without
/// interfaces. With rounding alone, the weights keep all equations.
[[nodiscard]] double largest_gap_of_edges(const MetricMesh& pieces);
/// The largest distance between the orthocenters of an interface face, as its two sides have them, in the space of the
/// mesh and over the longest edge of the face; 0 without interfaces. With rounding alone, dual edges have one crossing
/// with each interface, and two-point fluxes are exact for a linear pressure on each side.
[[nodiscard]] double largest_gap(const MetricMesh& pieces);

}  // namespace temper::tets
