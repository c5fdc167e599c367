// Edges and faces with their duals, in parts of one tetrahedron each, and the derivatives of all parts at once.
//
// |σ| |σ*| and |σ| ∫_{σ*} (x − centroid of σ) of an edge or face σ are sums over the tetrahedra around σ, each part
// with the signs of its heights. They are made of orthocenters, and so rational in positions and weights. Kernels
// compute eight tetrahedra at once (parts_kernel.hpp).
//
//       a ──── o      edge σ, seen along it: a and b are the orthocenters of its two faces in the tetrahedron, o is the
//      /       │      orthocenter of the tetrahedron, and x the crossing of σ with the plane of its dual face. The part
//     /        │      is a kite, the triangles x a o and x o b.
//    x ─────── b
//                     face σ: the part of its dual edge leads from the orthocenter of σ to o.
#pragma once

#include <functional>

#include "temper/detail/executor.hpp"
#include "temper/tets/mesh.hpp"
#include "tets/energy/lanes.hpp"

namespace temper::tets {

/// |σ| |σ*|, and |σ| ∫_{σ*} (x − centroid of σ).
template <class T>
struct OffsetOf {
  T volume;
  Vector<T> moment;
  friend TEMPER_INLINE OffsetOf operator+(const OffsetOf& a, const OffsetOf& b) {
    return {a.volume + b.volume, a.moment + b.moment};
  }
};
using Offset = OffsetOf<double>;

/// Quantities of a tetrahedron, or the derivatives of some function by each of them. The edges have
/// the sequence of kEdgeCorners. Face k is opposite corner k.
template <class T>
struct TetPartsOf {
  static constexpr std::size_t kNumbers = 56;
  OffsetOf<T> edges[6];
  T along[6];   ///< the crossing, as a part of the edge from its first corner
  T square[6];  ///< of the length
  OffsetOf<T> faces[4];
  T height[4];  ///< h/ℓ

  /// Calls f(number) for all numbers, in one order.
  template <class F>
  TEMPER_INLINE void for_each(const F& f) {
    const auto offset = [&f](OffsetOf<T>& o) { f(o.volume), f(o.moment.x), f(o.moment.y), f(o.moment.z); };
    for (OffsetOf<T>& edge : edges) offset(edge);
    for (T& number : along) f(number);
    for (T& number : square) f(number);
    for (OffsetOf<T>& face : faces) offset(face);
    for (T& number : height) f(number);
  }
};
using TetParts = TetPartsOf<double>;
using Gradient = IdVector<VertexId, WeightedPoint>;

/// The parts of all tetrahedra, which are positive.
[[nodiscard]] IdVector<TetId, TetParts> parts_of(const TetMesh& mesh, Executor* executor);
/// Adds the derivatives of a function by all vertices, from those by the parts of each tetrahedron.
void add_pulled_back(Gradient& gradient, const TetMesh& mesh, const std::function<TetParts(TetId)>& by,
                     Executor* executor);

/// Parts of eight tetrahedra: for_each() has the order of the numbers.
struct alignas(64) PartsLanes {
  Lane numbers[TetParts::kNumbers];
};
struct PartsKernels {
  void (*parts)(const TetLanes& tetrahedra, PartsLanes& parts);
  void (*pull_back)(const TetLanes& tetrahedra, const PartsLanes& by, TetLanes& by_corners);
};

}  // namespace temper::tets

namespace temper::baseline {
extern const tets::PartsKernels kPartsKernels;
}
namespace temper::avx2 {
extern const tets::PartsKernels kPartsKernels;
}
namespace temper::avx512 {
extern const tets::PartsKernels kPartsKernels;
}
