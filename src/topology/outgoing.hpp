// outgoing(v), kept canonical: the boundary halfedge of a boundary vertex, the largest halfedge of an inner one.
//
// For a walk, any halfedge out of v would do. But a flip takes a halfedge from two vertices, and forgets if it was
// their outgoing one. A value that the rest of the mesh determines can be found again. So unflip restores a mesh bit
// for bit, from journal entries of one halfedge each.
#pragma once

#include "base/assert.hpp"
#include "mesh/mesh_editor.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// The canonical outgoing halfedge of v, found from any halfedge out of v. O(degree).
inline HalfedgeId canonical_outgoing(const Mesh& mesh, HalfedgeId start) {
  if (!mesh.twin(start).valid()) return start;
  HalfedgeId largest = start;
  for (HalfedgeId h = mesh.rotate(start); h != start; h = mesh.rotate(h)) {
    if (!h.valid()) {  // v is on the boundary: go back clockwise, to the first of its fan
      HalfedgeId first = start;
      while (mesh.twin(first).valid()) first = Mesh::next(mesh.twin(first));
      return first;
    }
    if (largest < h) largest = h;
  }
  return largest;
}

/// Updates outgoing(v) after halfedges out of v have come and gone. `gained`: the largest of the new ones. O(1), except
/// when v has lost its outgoing halfedge, with a chance of one in its degree.
inline void update_outgoing(Mesh& mesh, VertexId v, HalfedgeId gained) {
  TEMPER_ASSERT(mesh.origin(gained) == v);
  const HalfedgeId old = mesh.outgoing(v);
  if (mesh.origin(old) != v) {
    MeshEditor(mesh).set_outgoing(v, canonical_outgoing(mesh, gained));
  } else if (old < gained && mesh.twin(old).valid()) {  // a boundary vertex keeps its boundary halfedge
    MeshEditor(mesh).set_outgoing(v, gained);
  }
  TEMPER_ASSERT(mesh.origin(mesh.outgoing(v)) == v);
}

}  // namespace temper
