// Operations on connectivity. Ask, price, commit: can_flip, then flip. None mutates to find out.
//
// All keep twins, flags, regions and outgoing() right. They leave outgoing() as Mesh::build makes it: the boundary
// halfedge of a boundary vertex, the largest halfedge of an inner one. A value that the rest of the mesh determines
// is what lets a flip be undone bit for bit.
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

/// Undoes flip(mesh, h), bit for bit. `flipped` is what flip returned; later flips must have been undone first.
void unflip(Mesh& mesh, HalfedgeId flipped);

/// Splits a triangle into three at p. Precondition: p is strictly inside. Returns the new vertex. O(1).
VertexId insert_in_triangle(Mesh& mesh, TriangleId t, WeightedPoint p);

/// Splits the edge of h, and its one or two triangles, at p on the edge: so near that the new triangles are
/// counter-clockwise. Flags of the edge go to both halves. Returns the new vertex. O(1).
VertexId split_edge(Mesh& mesh, HalfedgeId h, WeightedPoint p);

}  // namespace temper
