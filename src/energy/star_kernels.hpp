// The kernels of stars, in the fastest instruction set that the machine has.
//
// Every set computes the same operations in the same order (base/pack.hpp), so results do not depend on the choice.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "energy/accuracy_edge.hpp"
#include "energy/edge_kernels.hpp"
#include "temper/detail/space.hpp"
#include "temper/detail/vec.hpp"

namespace temper {

// Input and output of each lane of a pack. Plain arrays without functions, since the code that uses them is compiled
// for several instruction sets.

/// A coordinate: one value for each lane.
using Lane = double[kLanes];
/// A mask: all bits of a lane are set if the condition holds.
using LaneMask = std::int64_t[kLanes];

struct LanePoints {
  Lane x, y, w;
  void set(std::size_t lane, const WeightedPoint& p) { x[lane] = p.x, y[lane] = p.y, w[lane] = p.w; }
  [[nodiscard]] WeightedPoint at(std::size_t lane) const { return {x[lane], y[lane], w[lane]}; }
};

/// Triangles, one for each lane.
struct TriangleLanes {
  LanePoints p, q, r;
  void set(std::size_t lane, const std::array<WeightedPoint, 3>& corners) {
    p.set(lane, corners[0]), q.set(lane, corners[1]), r.set(lane, corners[2]);
  }
};

// Triangles and edges in lanes, for the energy and the barrier of the accuracy objective on whole meshes.

/// Edges of triangles, pq, qr and rp, as EdgeShape has them.
struct ShapeLanes {
  struct alignas(64) Edge {
    Lane l2, dw, g;
    [[nodiscard]] EdgeShape at(std::size_t lane) const { return {l2[lane], dw[lane], g[lane]}; }
  };
  Edge edges[3];
};

/// Edges ab, one for each lane, each seen from a triangle on its left; inner edges have d across.
struct alignas(64) EdgeLanes {
  Lane l2, dw, left;    ///< as that triangle has them
  Lane size_a, size_b;  ///< of the local sizes
  Lane height;          ///< q
  LaneMask inner;       ///< there is a triangle bad
  LanePoints b, a, d;
};

/// The link of a star: triangle i has the corners p, i and i + 1. Readable up to a multiple of kLanes beyond size.
struct LinkArrays {
  const double *x, *y, *w;
  std::size_t size = 0;  ///< triangles
};

/// Value, gradient (x, y, w) and Hessian (xx, xy, xw, yy, yw, ww) of a star, in this order. On the sphere they are in
/// the chart of its center (geometry/triangle_kernel.hpp).
inline constexpr std::size_t kStarSums = 10;

/// The results of hot_edges(), written to a multiple of kLanes. For the edges pq, qr, rp of each triangle: h ℓ on their
/// left, and E_F or E_nF. Then S of the triangle.
struct HotEdges {
  double* g[3];
  double* value[3];
  double* doubled_area;
};

/// The factors of the edges of triangle i; readable as far as the link.
struct EdgeFactors {
  const double *pq, *qr, *rp;
};

/// Bit i: triangle i certainly is well-centered, or certainly is not. Exact predicates decide the rest.
struct WellCentered {
  unsigned yes, no;
};

struct StarKernels {
  /// The sums of a barrier at p. Returns false outside its domain, and then the sums mean nothing.
  bool (*barrier_derivatives)(const EdgeFormula& formula, const LinkArrays& link, const WeightedPoint& p, double* sums);
  /// The value alone; +∞ outside the domain.
  double (*barrier_value)(const EdgeFormula& formula, const LinkArrays& link, const WeightedPoint& p);
  void (*hot_edges)(const EdgeFormula& formula, const LinkArrays& link, const WeightedPoint& p, const HotEdges& edges);
  void (*hot_derivatives)(const EdgeFormula& formula, const LinkArrays& link, const EdgeFactors& factors,
                          const WeightedPoint& p, double* sums);
  /// The values of a barrier of the first n triangles, summed; +∞ when one is outside the domain.
  double (*barrier_sum)(const EdgeFormula& formula, const TriangleLanes& triangles, std::size_t n);
  WellCentered (*well_centered)(const TriangleLanes& triangles);
  /// For the accuracy objective: the shapes of triangles, the logarithms of their barriers, and the energies of edges.
  void (*triangle_shapes)(const TriangleLanes& triangles, ShapeLanes& shapes);
  void (*accuracy_logarithms)(const ShapeLanes& shapes, const Lane& floors, Lane& result);
  void (*accuracy_edges)(const AccuracyModel& model, const EdgeLanes& edges, Lane& result);
};

/// The kernels of a space, compiled for the instruction set in use.
[[nodiscard]] const StarKernels& star_kernels(const Space& space);

namespace baseline {
extern const StarKernels kPlaneKernels, kSphereKernels;
}  // namespace baseline
namespace avx2 {
extern const StarKernels kPlaneKernels, kSphereKernels;
}  // namespace avx2
namespace avx512 {
extern const StarKernels kPlaneKernels, kSphereKernels;
}  // namespace avx512

}  // namespace temper
