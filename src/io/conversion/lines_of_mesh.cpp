// The edges that the lines of a file are, for triangles of the plane, of the sphere and of surfaces.
#include <algorithm>
#include <utility>

#include "io/conversion/edge_lines.hpp"
#include "io/text/failure.hpp"
#include "io/text/names.hpp"

namespace temper::io {
namespace {

/// Finds the edges of all lines together. At a vertex with very many lines, one search per line would take the square
/// of their number.
std::vector<HalfedgeId> edges_of_lines(const MeshFile& file, const VertexOfPoint& vertex, const Mesh& mesh) {
  using Ends = std::pair<std::int32_t, std::int32_t>;
  std::vector<std::pair<Ends, std::size_t>> wanted;
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    const auto [a, b] = file.lines[i];
    wanted.emplace_back(std::minmax({vertex[static_cast<std::size_t>(a)], vertex[static_cast<std::size_t>(b)]}), i);
  }
  std::sort(wanted.begin(), wanted.end());
  std::vector<HalfedgeId> edges(file.lines.size());
  if (wanted.empty()) return edges;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_edge_representative(h)) continue;
    const auto from = static_cast<std::int32_t>(mesh.origin(h).index),
               to = static_cast<std::int32_t>(mesh.target(h).index);
    const Ends ends = std::minmax({from, to});
    auto line = std::lower_bound(wanted.begin(), wanted.end(), std::pair(ends, std::size_t{0}));
    for (; line != wanted.end() && line->first == ends; ++line) edges[line->second] = h;
  }
  return edges;
}

}  // namespace

LinesOfMesh lines_of_mesh(const MeshFile& file, const VertexOfPoint& vertex, const InputNames& names,
                          const Mesh& mesh) {
  LinesOfMesh lines;
  lines.edges = edges_of_lines(file, vertex, mesh);
  if (std::optional<EdgeLines> found = find_edge_lines(file, vertex, mesh, lines.edges)) {
    lines.edge_lines = std::move(found->lines);
    lines.warnings.push_back(
        text("all ", found->n_inner_edges, " inner edges are lines of tag ", found->tag,
             ": they are taken for the edges of the mesh, not for features, and constrain nothing"));
  }
  std::vector<std::string> lost, dropped;
  std::size_t n_lost = 0, n_dropped = 0;
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    const auto [a, b] = file.lines[i];
    const HalfedgeId h = lines.edges[i];
    if (!h.valid()) {
      const auto from = static_cast<std::size_t>(a), to = static_cast<std::size_t>(b);
      const bool goes = vertex[from] < 0 || vertex[to] < 0;
      if ((goes ? n_dropped : n_lost)++ < kNamed)
        (goes ? dropped : lost).push_back(text(names.point(from), " to ", names.point(to)));
    } else if (lines.edge_lines.empty() && !mesh.is_boundary(h)) {
      lines.constrained.push_back(h);
    }
  }
  if (n_lost > 0)
    lines.warnings.push_back(listed(n_lost,
                                    n_lost == 1 ? "line is no edge of the mesh and constrains nothing"
                                                : "lines are no edges of the mesh and constrain nothing",
                                    lost));
  if (n_dropped > 0)
    lines.warnings.push_back(listed(n_dropped,
                                    n_dropped == 1 ? "line to a point of no triangle is dropped with it"
                                                   : "lines to points of no triangle are dropped with them",
                                    dropped));
  return lines;
}

}  // namespace temper::io
