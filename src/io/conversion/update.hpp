// The steps of update(): what differs between triangles and tetrahedra.
#pragma once

#include <array>
#include <cstdint>

#include "io/conversion/data_update.hpp"
#include "temper/io.hpp"

namespace temper::io {

/// Says whether some weight is not 0. A mesh without weights is a file without them, for which some programs have no
/// place (DEVSIM).
[[nodiscard]] bool is_weighted(const MeshFile& file);
void drop_zero_weights(MeshFile& file);

/// Gives the file the vertices of the mesh, in its space.
void copy_vertices(MeshFile& file, const Mesh& mesh, const Former& former);

void copy_vertices(MeshFile& file, const surfaces::SurfaceMesh& mesh);

/// Renumbers the lines and marked points of a file with n points for the mesh. `edge_lines`: as in LoadedMesh.
void update_lines(MeshFile& file, std::size_t n, const std::vector<bool>& edge_lines, const Mesh& mesh,
                  const Former& former);

/// For each vertex of the mesh the point of the file at its place, if there is one.
[[nodiscard]] Former vertices_by_place(const MeshFile& file, const Mesh& mesh);

/// Lines and marked points of n points get the vertices that these points have become. At a removed point two lines of
/// one tag are joined. At inserted vertices lines are cut. If the format marks every boundary point, a new one
/// gets the marker of its neighbors, if both have the same.
void follow_lines(MeshFile& file, std::size_t n, const Mesh& mesh, const Former& former);

/// Tagged faces, lines and points of a mesh of tetrahedra: pieces take the place of what they are pieces of.
void take_pieces(MeshFile& file, const tets::TetMesh& before, const tets::TetMesh& mesh, const tets::Origins& origins);

/// Numbers of vertices, as a file has them.
template <std::size_t n>
[[nodiscard]] std::array<std::int32_t, n> numbers(const std::array<VertexId, n>& corners) {
  std::array<std::int32_t, n> result;
  std::ranges::transform(corners, result.begin(), [](VertexId v) { return static_cast<std::int32_t>(v.index); });
  return result;
}

}  // namespace temper::io
