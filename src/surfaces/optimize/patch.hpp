// A copy of the triangles around a bad one, for edits that are tried before one is made.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "surfaces/optimize/draft.hpp"
#include "surfaces/optimize/run.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {

/// An edit of one edge.
struct Edit {
  enum class Kind : std::uint8_t { none, flip, split, collapse } kind = Kind::none;
  VertexId from, to;  ///< Of the patch. A collapse removes `from`
};

/// Triangles with their vertices, numbered by themselves. Vertices whose triangles are not all in it stay.
class Patch {
 public:
  /// The triangles within a number of rings of vertices around one.
  Patch(const State& state, TriangleId center, int rings);

  [[nodiscard]] const std::vector<TriangleId>& cells() const { return cells_; }
  /// The edits of edges of the center, and collapses of edges at its corners.
  [[nodiscard]] std::vector<Edit> edits() const;
  /// Makes an edit. False if it would break or fold the surface.
  [[nodiscard]] bool make(const Edit& edit, const Nearness& nearness);
  /// Lowers the energy with γ from large to small, and projects.
  void descend(const Run& run);
  /// Number of cells at violations, if this is a surface near enough to the input.
  [[nodiscard]] std::optional<std::size_t> bad(const Run& run) const;
  /// The mesh with this patch in place of its triangles; nothing if that is no surface.
  [[nodiscard]] std::optional<State> applied() const;

 private:
  using Corners = std::array<VertexId, 3>;

  [[nodiscard]] Vec3 place(VertexId v) const { return draft_.points[v].position(); }
  [[nodiscard]] Vec3 normal(const Corners& t) const { return normal_of(place(t[0]), place(t[1]), place(t[2])); }
  /// The triangle with the edge from a to b in its direction, and the corner across; none.
  struct Side {
    std::size_t triangle;
    VertexId across;
  };
  [[nodiscard]] std::optional<Side> side(VertexId a, VertexId b) const;
  [[nodiscard]] bool has_edge(VertexId a, VertexId b) const;
  [[nodiscard]] Track track_of(VertexId old) const { return state_.tracks[global_[old.index]]; }
  [[nodiscard]] bool is_locked(VertexId a, VertexId b) const;
  [[nodiscard]] bool is_crease(VertexId a, VertexId b) const;
  [[nodiscard]] std::vector<VertexId> neighbors(VertexId v) const;
  /// The creases of the mesh with this patch, before its vertices are numbered again.
  [[nodiscard]] Edges creases(const std::vector<VertexId>& number_of_local) const;
  [[nodiscard]] bool flip(VertexId a, VertexId b);
  [[nodiscard]] bool split(VertexId a, VertexId b, const Nearness& nearness);
  [[nodiscard]] bool collapse(VertexId a, VertexId b);

  std::vector<TriangleId> cells_;
  Corners center_;
  Draft draft_;
  std::vector<std::int32_t> regions_;           ///< Of the triangles
  std::vector<VertexId> global_;                ///< Numbers in the mesh; invalid for new vertices
  Edges constrained_;                           ///< Edges with creases; ascending
  std::optional<std::array<VertexId, 3>> cut_;  ///< A crease edge that was split: its ends, and the new vertex
  const State& state_;
};

}  // namespace temper::surfaces
