// Diffusion tensors of tetrahedra: temper/detail/tensor.hpp, with a dimension more.
//
// Each tetrahedron goes to the space of its own tensor by B = (det K)^⅙ K^−½, which changes no volume, and the mesh is
// cut at faces where that space changes. A vertex there has a copy on each side, with its own weight. An interface face
// has one center of the dual edge if the orthocenters of the face from both sides are the image of one place. Weights
// keep the equations of its three edges,
//
//     (w_b − w_c)/|bc|² = (w_b' − w_c')/|b'c'|².
//
// Then the dual face of each edge crosses it at one place, from all sides. The two orthocenters are one place, too, if
// both metrics are multiples of each other within the face: layers whose tensors are isotropic in their plane. Else
// they differ, whatever the weights are, except by chance (largest_gap in temper/tets/weights.hpp).
#pragma once

#include <span>
#include <vector>

#include "temper/detail/tensor.hpp"
#include "temper/tets/mesh.hpp"

namespace temper::tets {

using Metric = MetricOf<Tensor3>;
/// The metric of each tetrahedron of a mesh: one for all, or one for each.
using Metrics = MetricsOf<Tensor3, TetId, InputNames>;
/// A mesh in the spaces of its metrics, cut along interfaces.
using MetricMesh = MetricMeshOf<TetMesh, Metrics>;
/// A mesh in its own space, from its pieces.
using WholeMesh = WholeMeshOf<TetMesh, Tensor3>;

/// A face of an interface: its halfface in the mesh on either side.
struct SeamFace {
  HalffaceId one, other;
};
/// The faces of interfaces, each once, ascending by `one` < `other`. O(n log n).
[[nodiscard]] std::vector<SeamFace> seams_of(const MetricMesh& pieces);

/// The copies of the vertices of an interface face: `one` in the order of its halfface, `other` of the same vertices.
struct SeamCorners {
  std::array<VertexId, 3> one, other;
};
[[nodiscard]] SeamCorners corners_of(const MetricMesh& pieces, const SeamFace& seam);

/// Maps a mesh to the spaces of its metrics, and cuts it along their interfaces. Weights stay. Tags stay with one copy.
/// `corner_weights`: the weight of each corner of each tetrahedron, for meshes with interfaces; empty: those of the
/// vertices. Errors, in the user's numbers: a tetrahedron that turns over by rounding; not one tensor or not four
/// weights for each tetrahedron. O(n).
[[nodiscard]] Expected<MetricMesh> mapped(const TetMesh& mesh, const Metrics& metrics,
                                          std::span<const double> corner_weights = {}, const InputNames& names = {});

/// The pieces after a change of their mesh. `vertices`: number of each vertex before it, as in Origins; empty: the same
/// numbers.
[[nodiscard]] MetricMesh with_mesh(const MetricMesh& pieces, TetMesh changed,
                                   const IdVector<VertexId, VertexId>& vertices = {});

/// Joins the pieces of a changed mesh, and maps them back to the space of `original`. Vertices that have not moved
/// since mapped(original) get their place from there, bit for bit. `pieces`: of mapped(original). `vertices`: number
/// there of each vertex of `changed`; empty: the same numbers. Errors as for mapped().
[[nodiscard]] Expected<WholeMesh> mapped_back(const MetricMesh& changed, const TetMesh& original,
                                              const MetricMesh& pieces,
                                              const IdVector<VertexId, VertexId>& vertices = {});

}  // namespace temper::tets
