// The one change of connectivity: a cavity is filled by the cone over its faces, from one apex.
//
// A cavity is a tetrahedron, the two at a face, the ring around an edge, or the star of a vertex. The apex is a new
// vertex inside, or a corner, whose own faces need no tetrahedron. So all usual operations are cones:
//
//     cavity         apex                       apex a corner
//
//     tetrahedron    new: 1-4 split
//
//     face           new: split                 d: flip 2-3, which makes the edge de
//
//            d                                         d
//          / | \                                     / | \          before: abcd and the one below, acbe
//         a--|--c                                   a--|--c         after:  abde, bcde, cade
//          \ | /                                     \ | /
//            b      e is below                         e
//
//     edge           new: split                 a: flip 3-2, 4-4, edge removal
//
//         b-----c                                 b-----c           the edge is seen from its end, in the middle;
//        / \   / \                                 \   / \          before: one tetrahedron for each spoke
//       a---edge---d                          a     \ /   d         after:  two for each triangle of the fan at a
//        \ /   \ /
//         f-----e
//
//     vertex v       -                          u, a neighbor: v is merged into u
//
//     face or edge   new, on it: split          -
//     that stays
//                        c                         c
//                      / | \                     / | \           the edge ab of the boundary, seen from outside, with
//                    a---|---b                 a---o---b         its two faces; inside, each tetrahedron around it
//                      \ | /                     \ | /           becomes two; faces and lines with a tag, too
//                        d                         d
//
// A cone is valid if all its tetrahedra are positive, by the exact predicate: then they fill the cavity.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "tets/topology/next_mesh.hpp"

namespace temper::tets {

struct Cavity {
  std::vector<TetId> tetrahedra;
  std::vector<HalffaceId> faces;  ///< Faces around it, of its tetrahedra, without those of `split`
  /// Ends of an edge, or corners of a face, that stays but may be split: a new vertex must lie on it.
  std::vector<VertexId> split = {};
};

/// The cavities of a mesh. No face of the boundary, between regions or with a tag is inside a cavity, and no tagged
/// line. So these parts stay, whatever fills a cavity. to_split() is the exception: a new vertex divides them.
class Cavities {
 public:
  explicit Cavities(const TetMesh& mesh);

  [[nodiscard]] Cavity of_tetrahedron(TetId t) const;
  [[nodiscard]] std::optional<Cavity> of_face(HalffaceId h) const;
  /// The ring around the edge from a to b of t.
  [[nodiscard]] std::optional<Cavity> of_edge(TetId t, VertexId a, VertexId b) const;
  /// The tetrahedra at a face or around an edge that stay, to be split.
  [[nodiscard]] std::optional<Cavity> to_split(HalffaceId h) const;
  [[nodiscard]] std::optional<Cavity> to_split(TetId t, VertexId a, VertexId b) const;
  /// Nothing for vertices on faces or lines that stay.
  [[nodiscard]] std::optional<Cavity> of_vertex(VertexId v) const;

 private:
  [[nodiscard]] bool is_line(VertexId a, VertexId b) const;
  [[nodiscard]] std::pair<std::vector<TetId>, bool> fan(TetId t, VertexId a, VertexId b) const;
  [[nodiscard]] Cavity around(std::vector<TetId> tetrahedra) const;

  const TetMesh& mesh_;
  IdVector<HalffaceId, std::uint8_t> stays_;
  std::vector<std::array<VertexId, 2>> lines_;  // tagged, sorted
  IdVector<VertexId, std::uint8_t> on_line_;
};

/// Fills a cavity.
struct Filling {
  Cavity cavity;
  VertexId apex;             ///< Invalid: a new vertex
  WeightedPoint point = {};  ///< Of a new vertex
  VertexId removed = {};     ///< The vertex inside, if there is one

  /// The faces that get a tetrahedron: those without the apex.
  [[nodiscard]] std::vector<HalffaceId> base(const TetMesh& mesh) const;
};
/// Says whether all new tetrahedra are positive. Exact.
[[nodiscard]] bool is_valid(const TetMesh& mesh, const Filling& filling);

/// The mesh with all cavities filled, and its names. They share no tetrahedron. New vertices come last, in the order of
/// their fillings. Nothing if a tetrahedron is not positive or a coordinate is out of range. O(n).
[[nodiscard]] std::optional<std::pair<TetMesh, Names>> filled(const TetMesh& mesh, std::span<const Filling> fillings,
                                                              const Names& names);

}  // namespace temper::tets
