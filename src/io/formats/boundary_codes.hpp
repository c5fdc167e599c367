// The boundary of a mesh of triangles as strings of nodes, and codes of its nodes, as in MIKE 21 and TELEMAC.
//
// If the two nodes of a boundary edge have one code, it is the tag of a line there. So codes survive in all formats
// that hold lines, and on the parts of a line that is split. A node whose code no line at it has is a marked point.
// Walls have neither lines nor marks.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "io/formats/format.hpp"

namespace temper::io {

/// Nodes in a row.
using NodeString = std::vector<std::int32_t>;
using DirectedEdge = std::array<std::int32_t, 2>;

/// The edges, each given once, as strings in their given order.
[[nodiscard]] std::vector<NodeString> node_strings(const std::vector<DirectedEdge>& edges);

/// Edges of one face, with the domain on their left. Faces with corners out of range are left out.
[[nodiscard]] std::set<DirectedEdge> boundary_edges(const MeshFile& file,
                                                    const std::vector<std::int32_t>& fourth_corners = {});

/// The nodes of the boundary, each once, in the order that TELEMAC gives them. The domain is on the left. A string
/// begins at the node with the least x + y, and strings follow each other by this sum.
[[nodiscard]] NodeString boundary_nodes(const MeshFile& file, const std::set<DirectedEdge>& edges);

/// The codes of a format.
struct CodeRules {
  std::int32_t wall;      ///< the code of all nodes of the boundary that nothing else is said of
  std::string_view name;  ///< of the tag of a line, before the code
};

/// Makes lines and marked points of the codes of all points. Inside the domain the code 0 says nothing.
void take_codes(Document& document, const std::vector<std::int32_t>& codes, const CodeRules& rules);

/// The codes of all points, 0 inside. A mark says more than lines, and of two lines the larger tag counts. Warns of
/// lines inside the domain, and of names other than those that take_codes() gives.
[[nodiscard]] std::vector<std::int32_t> codes_to_write(const WriteJob& job, const std::set<DirectedEdge>& boundary,
                                                       const CodeRules& rules);

}  // namespace temper::io
