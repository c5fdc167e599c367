// A smallest set of triangles that no weights suit: found by the programme, cut down by leaving out one at a time.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "temper/explain.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// Triangles whose every proper part admits weights, and the proof that together they admit none.
struct Conflict {
  std::vector<TriangleId> triangles;  ///< sorted
  BestMargin best;                    ///< of these, with certificate
};

/// A conflict among these triangles, when the checker accepts a certificate of one. Of several, one with `kept` is
/// preferred, when it is valid; then one whose triangles are bad now. O(k) programmes for k terms of the certificate.
[[nodiscard]] std::optional<Conflict> find_conflict(const Mesh& mesh, std::span<const TriangleId> triangles,
                                                    TriangleId kept, LpSolver& solver);
/// The same, from a certificate about the mesh that the checker has accepted.
[[nodiscard]] std::optional<Conflict> shrink(const Mesh& mesh, const Certificate& certificate, TriangleId kept,
                                             LpSolver& solver);

/// The vertex that all these triangles have, when there is one: of two, that of the largest angle.
[[nodiscard]] std::optional<FanCenter> fan_center(const Mesh& mesh, std::span<const TriangleId> triangles);

/// edge, fan or patch.
[[nodiscard]] ReasonKind kind_of(const Conflict& conflict, bool has_center, bool has_crossing);

/// The vertices of these triangles that an optimisation may move: inside, not fixed, on no constrained edge.
[[nodiscard]] std::vector<VertexId> free_vertices(const Mesh& mesh, std::span<const TriangleId> triangles);

}  // namespace temper
