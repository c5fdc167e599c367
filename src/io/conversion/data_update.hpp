// What of a file follows a mesh that has changed: data of points and triangles, and lines.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "temper/io.hpp"

namespace temper::io {

/// The point of a file that each vertex was, invalid for one that was none; empty: the same numbers.
using Former = IdVector<VertexId, VertexId>;

/// Data of the file for the vertices and triangles of the mesh: see update(). Reads the points, triangles and regions
/// of before, which the file still has.
DataReport update_data(MeshFile& file, const Mesh& mesh, const Former& former, const UpdateOptions& options);

/// Cuts the lines of the file, which are numbered as the mesh is, where the mesh has inserted vertices (`vertices`
/// invalid) on them. In files where every boundary point carries a marker (Triangle, medit), a new point of the
/// boundary gets that of its neighbors when it is the same.
void split_lines(MeshFile& file, const Mesh& mesh, const IdVector<VertexId, VertexId>& vertices);

// Lines that list the edges of a mesh, and no features of it.
//
// Some programs (Fluidity, whose meshes come from Triangle's edges) write each edge of a mesh as a line of tag 0. If
// these were constraints, nothing could flip. So where all inner edges are lines of one tag, these say no more than
// the triangles do: they constrain nothing, and the file that is written has such a line for each inner edge again.

/// Lines on all inner edges of a mesh, of one tag.
struct EdgeLines {
  std::vector<bool> lines;  ///< as LoadedMesh::edge_lines
  std::int32_t tag = 0;
  std::size_t n_inner_edges = 0;  ///< of the mesh
};
/// The edge lines of a file; nothing where not all inner edges are lines of one tag, or there is but one. `edges` has
/// the edge of each line, invalid where there is none. O(n).
[[nodiscard]] std::optional<EdgeLines> find_edge_lines(const MeshFile& file, const VertexOfPoint& vertex_of_point,
                                                       const Mesh& mesh, const std::vector<HalfedgeId>& edges);

/// Puts edges that flips have made into the place of those that are gone. The vertices are those of the lines, and
/// edge_lines stays right. O(n log n).
void replace_edge_lines(MeshFile& file, const std::vector<bool>& edge_lines, const Mesh& mesh);

/// For meshes whose vertices are others: the lines are taken out before the rest of the file follows, and put behind
/// all other lines afterwards, one for each inner edge.
class EdgeLinesTakenOut {
 public:
  EdgeLinesTakenOut(MeshFile& file, const std::vector<bool>& edge_lines);
  void put_back(MeshFile& file, const Mesh& mesh) const;

 private:
  std::int32_t tag_ = 0;
  std::vector<Values> rows_;  // of each array of line data
};

}  // namespace temper::io
