// Data of cells over a change of a mesh of tetrahedra: temper/detail/transfer.hpp, with a dimension more.
#pragma once

#include "temper/detail/transfer.hpp"
#include "temper/tets/mesh.hpp"

namespace temper::tets {

/// The elements of a mesh that have a cell each.
enum class CellsOf : std::uint8_t {
  vertices,    ///< Power cells within the domain
  tetrahedra,  ///< Tetrahedra
};

/// Returns the overlaps of the cells of two meshes. A point of a tetrahedron belongs to the candidate to which its
/// power is least. Candidates are the corners, and the neighbors by edges of each candidate that owns a part of the
/// tetrahedron. In a well-centered mesh these cells have the volumes ★0. About O(n), with some dozen microseconds for
/// each tetrahedron.
[[nodiscard]] CellOverlaps overlaps(const TetMesh& before, const TetMesh& after, CellsOf of,
                                    Executor* executor = nullptr);

}  // namespace temper::tets
