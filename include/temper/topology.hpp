// Operations on connectivity. Ask, price, commit: can_flip, then flip. None mutates to find out.
#pragma once

#include "temper/mesh.hpp"

namespace temper {

/// Why an edge cannot be flipped, or that it can.
enum class FlipStatus { possible, boundary, constrained, not_convex };
/// Decided by exact predicates.
[[nodiscard]] FlipStatus can_flip(const Mesh& mesh, HalfedgeId h);

/// Replaces the edge of h by the other diagonal. Precondition: can_flip(mesh, h) == possible. O(1), no allocation.
/// Returns the halfedge of the new edge in triangle(h)'s slot; flipping it three more times restores every slot.
HalfedgeId flip(Mesh& mesh, HalfedgeId h);

/// Undoes flip(mesh, h), bit for bit. `flipped` is what flip returned.
void unflip(Mesh& mesh, HalfedgeId flipped);

/// Splits a triangle into three at p, strictly inside. Returns the new vertex.
VertexId insert_in_triangle(Mesh& mesh, TriangleId t, WeightedPoint p);

/// Splits the edge of h, and its one or two triangles, at p on the edge. Flags of the edge go to both halves.
VertexId split_edge(Mesh& mesh, HalfedgeId h, WeightedPoint p);

}  // namespace temper
