// Vertices inserted and removed until a mesh has the sizes of a field.
//
// The size of a triangle of area A is √(4A/√3), the edge of an equilateral triangle. A vertex has the size of the mean
// area around it. The field's size h of a triangle is the mean at its corners.
//
//      size / h          1/√2               1                √2
//     -------------------|------------------|------------------|-------------------→
//      removed: twice as                                         one is inserted: half as
//      many vertices as wanted        all stays                  many vertices as wanted
//
// A removal that would leave a triangle too large is refused. So no change makes room for the opposite one, and a mesh
// that has the sizes already stays as it is, bit for bit.
#pragma once

#include <cstddef>

#include "temper/detail/size.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// Removes vertices and inserts others, as the field wants. Domain, regions and lines keep their shape. Fixed vertices
/// stay, and so do vertices from the number `first_kept` on. New vertices come last. All edges that may flip stay
/// regular. Returns true if vertices were removed: they are isolated, until Mesh::compact() drops them. Precondition:
/// the field is one of the space of the mesh. O(n log n).
bool resize(Mesh& mesh, const SizeField& field, std::size_t first_kept);

}  // namespace temper
