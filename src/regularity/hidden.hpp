// Hidden vertices: their power cell is empty in the regular triangulation of the constrained domain.
#pragma once

#include <cstddef>
#include <vector>

#include "regularity/lawson.hpp"
#include "temper/mesh.hpp"
#include "temper/regularity.hpp"

namespace temper {

/// The hook that reports each flip to an observer, in the vertices' numbers.
struct FlipObserver {
  const RestorationObserver* observer = nullptr;
  void before(const Mesh& mesh, HalfedgeId h) const {
    if (observer == nullptr || !observer->flipped) return;
    const inlined::Quad q = inlined::quad(mesh, h);
    observer->flipped(q.a, q.b, q.c, q.d);
  }
  void after(const Mesh&, HalfedgeId) const {}
};

/// The end at which the quad of a stuck edge is not strictly convex. Exactly one of the two is.
[[nodiscard]] VertexId reflex_end(const Mesh& mesh, HalfedgeId stuck);

/// The result of remove_hidden: the vertices that it found, and their treatment.
struct HiddenVertices {
  std::vector<VertexId> hidden;   ///< all, by number
  std::vector<VertexId> removed;  ///< those that could be, in this order
  std::size_t flips = 0;
};

/// Removes hidden vertices of a mesh on which `lawson` has run to its end, then flips until the mesh is regular.
/// Repeats until edges are stuck only at vertices that cannot be removed. Takes a few removals and flips per hidden
/// vertex.
HiddenVertices remove_hidden(Mesh& mesh, Lawson& lawson, const RestorationObserver* observer = nullptr);

}  // namespace temper
