// Tagged faces, lines and points that follow a mesh of tetrahedra with other vertices.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

#include "io/conversion/follow.hpp"
#include "io/conversion/update.hpp"
#include "io/text/failure.hpp"
#include "temper/tets/location.hpp"

namespace temper::io {
namespace {

template <std::size_t N>
bool same_corners(std::array<std::int32_t, N> a, std::array<std::int32_t, N> b) {
  std::ranges::sort(a), std::ranges::sort(b);
  return a == b;
}
/// Says whether a goes through its corners in the direction of b, which has the same.
template <std::size_t N>
bool turn_alike(const std::array<std::int32_t, N>& a, const std::array<std::int32_t, N>& b) {
  const auto first = static_cast<std::size_t>(std::ranges::find(b, a[0]) - b.begin());
  return a[1] == b[(first + 1) % N] && (N > 2 || first == 0);
}

std::vector<std::array<std::int32_t, 3>> faces_of(const tets::TetMesh& mesh) {
  std::vector<std::array<std::int32_t, 3>> faces;
  for (const tets::TaggedFace& f : mesh.tagged_faces()) faces.push_back(numbers(mesh.vertices(f.face)));
  return faces;
}
std::vector<std::array<std::int32_t, 2>> lines_of(const tets::TetMesh& mesh) {
  std::vector<std::array<std::int32_t, 2>> lines;
  for (const tets::TaggedLine& l : mesh.tagged_lines()) lines.push_back(numbers(l.ends));
  return lines;
}

/// The tagged faces or lines of two meshes: each of the second is a piece of one of the first, in the same order.
template <class Corners>
struct Pieces {
  std::vector<Corners> former, now;
  const std::vector<std::uint32_t>& origins;
};
/// Renumbers cells, or puts pieces in their place. Those that are not in the mesh follow their points. Returns the
/// number of those that lost one, which are dropped.
template <int dimension>
std::size_t take(Cells<dimension>& cells, const NewNumbers& number,
                 const Pieces<typename Cells<dimension>::Corners>& pieces) {
  std::vector<typename Cells<dimension>::Corners> taken;
  std::vector<std::size_t> rows;
  std::size_t tag = 0, piece = 0, lost = 0;
  for (std::size_t row = 0; row < cells.size(); ++row) {
    auto cell = cells[row];
    const bool is_tag = tag < pieces.former.size() && same_corners(cell, pieces.former[tag]);
    const bool alike = is_tag && turn_alike(cell, pieces.former[tag]);
    renumber_corners(cell, number);
    const std::size_t first = piece;
    while (is_tag && piece < pieces.now.size() && pieces.origins[piece] == tag) ++piece;
    tag += is_tag ? 1 : 0;
    if (piece - first > 1) {
      for (std::size_t i = first; i < piece; ++i) {
        taken.push_back(pieces.now[i]);
        if (!alike) std::swap(taken.back()[0], taken.back()[1]);
        rows.push_back(row);
      }
    } else if (is_there(cell)) {
      taken.push_back(cell);
      rows.push_back(row);
    } else {
      ++lost;
    }
  }
  cells.corners = std::move(taken);
  take_contents(cells, rows);
  return lost;
}

/// A tag that all corners of a tetrahedron have lists the vertices of a part. A new vertex in it belongs to the part,
/// too. New vertices get numbers after those of the file, until all are renumbered.
void mark_new_vertices(Cells<0>& marked, NewNumbers& number, const tets::TetMesh& before, const tets::TetMesh& mesh,
                       const Former& former) {
  using Mark = std::pair<std::int32_t, std::int32_t>;  // point, tag
  std::map<Mark, std::size_t> marks;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < marked.size(); ++i) {
    marks.emplace(Mark(marked[i], marked.tags[i]), i);
    rows.push_back(i);
  }
  const auto mark = [](VertexId corner, std::int32_t tag) { return Mark(corner.index, tag); };
  for (const VertexId v : mesh.vertices()) {
    if (former[v].valid()) continue;
    const tets::TetId near = tetrahedron_near(before, mesh, former, mesh.incident(v));
    const auto& corners = before.corners(find_tetrahedron(before, mesh.position(v), near));
    for (auto at = marks.lower_bound(mark(corners[0], std::numeric_limits<std::int32_t>::min()));
         at != marks.end() && at->first.first == mark(corners[0], 0).first; ++at) {
      const std::int32_t tag = at->first.second;
      if (!std::ranges::all_of(corners, [&](VertexId c) { return marks.contains(mark(c, tag)); })) continue;
      marked.corners.push_back(static_cast<std::int32_t>(number.size()));
      rows.push_back(at->second);
    }
    number.push_back(static_cast<std::int32_t>(v.index));
  }
  take_contents(marked, rows);
}

}  // namespace

void take_pieces(MeshFile& file, const tets::TetMesh& before, const tets::TetMesh& mesh, const tets::Origins& origins) {
  NewNumbers number(before.n_vertices(), mesh, [&](VertexId v) { return origins.vertices[v]; });
  if (!file.marked_points.empty()) mark_new_vertices(file.marked_points, number, before, mesh, origins.vertices);
  const std::size_t lost = take(file.triangles, number, {faces_of(before), faces_of(mesh), origins.faces}) +
                           take(file.lines, number, {lines_of(before), lines_of(mesh), origins.lines}) +
                           renumber(file.marked_points, number);
  if (lost > 0)
    file.warnings.push_back(text(lost, " tags are dropped, because their faces, lines or points have lost vertices"));
}

}  // namespace temper::io
