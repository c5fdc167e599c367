// Lines that list the edges of a mesh, and no features of it.
//
// Some programs (Fluidity, whose meshes come from Triangle's edges) write each edge of a mesh as a line of tag 0. If
// these were constraints, nothing could flip. So if all inner edges are lines of one tag, these constrain nothing. The
// file that is written again has such a line for each inner edge.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "temper/io.hpp"

namespace temper::io {

/// Lines on all inner edges of a mesh, of one tag.
struct EdgeLines {
  std::vector<bool> lines;  ///< as LoadedMesh::edge_lines
  std::int32_t tag = 0;
  std::size_t n_inner_edges = 0;  ///< of the mesh
};
/// The edge lines of a file. Nothing if not all inner edges are lines of one tag, or there is only one. `edges` has the
/// edge of each line, invalid if it has none. O(n).
[[nodiscard]] std::optional<EdgeLines> find_edge_lines(const MeshFile& file, const VertexOfPoint& vertex_of_point,
                                                       const Mesh& mesh, const std::vector<HalfedgeId>& edges);

/// The lines of a file in its mesh.
struct LinesOfMesh {
  std::vector<HalfedgeId> edges;        ///< The edge of each line, invalid if it has none
  std::vector<bool> edge_lines;         ///< As LoadedMesh::edge_lines
  std::vector<HalfedgeId> constrained;  ///< Edges inside the mesh that must stay
  std::vector<std::string> warnings;    ///< About lines that constrain nothing
};
[[nodiscard]] LinesOfMesh lines_of_mesh(const MeshFile& file, const VertexOfPoint& vertex, const InputNames& names,
                                        const Mesh& mesh);

/// Puts the edges that flips have made into the place of the edges that are gone. The vertices of the lines stay, and
/// edge_lines stays right. O(n log n).
void replace_edge_lines(MeshFile& file, const std::vector<bool>& edge_lines, const Mesh& mesh);

/// For meshes with other vertices: takes the lines out before the rest of the file follows. Afterwards it puts them
/// behind all other lines, one for each inner edge.
class EdgeLinesTakenOut {
 public:
  EdgeLinesTakenOut(MeshFile& file, const std::vector<bool>& edge_lines);
  void put_back(MeshFile& file, const Mesh& mesh) const;

 private:
  std::int32_t tag_ = 0;
  std::vector<Values> rows_;  // of each array of line data
};

}  // namespace temper::io
