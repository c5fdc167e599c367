// From a triangulation of the divided outline to the mesh of its inside, with lines and marked vertices.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mesher/deadline.hpp"
#include "mesher/domain.hpp"
#include "mesher/triangulated.hpp"

namespace temper::mesher {

/// A divided outline, the points placed inside, and the triangulation of both.
struct Filled {
  DividedOutline divided;
  std::vector<Vec3> placed;
  Triangulated all;
};

/// The points inside, which are the vertices of the mesh.
struct Inside {
  std::vector<Vec3> places;
  std::vector<std::int32_t> vertex;           ///< of each point of the triangulation, or -1
  std::vector<std::uint32_t> outline_places;  ///< of the vertices that are one, which come first
};

/// Nothing if a vertex that surrounds the sphere is still needed.
[[nodiscard]] std::optional<Inside> find_inside(const Domain& domain, const Filled& filled);

/// The mesh, with notes and warnings. Errors: those of Mesh::build, and ErrorCode::stopped when it is time to stop.
[[nodiscard]] Expected<OutlineMesh> build_inside(const Problem& problem, const Domain& domain, const Filled& filled,
                                                 const Inside& inside, Deadline& deadline);

/// Renumbers lines and points of the outline after vertices were removed or inserted. Their own vertices never are
/// removed, but lines may be split. `old_numbers`: of each vertex of the mesh, or invalid.
void renumber(OutlineMesh& made, const IdVector<VertexId, VertexId>& old_numbers);

}  // namespace temper::mesher
