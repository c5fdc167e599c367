// Gauss-Seidel sweeps over the vertices of a mesh with fixed connectivity, on threads. The bytes of the result do not
// depend on the number of threads.
//
//            1 ------- 2         No two vertices of one color have an edge, so their steps read and write nothing of
//          / | \     / |         each other. Sweeps take color after color, and the vertices of one color in any order.
//         2  |  3 - 1  3         Colors are greedy in the order of the vertices: about ten for any mesh of tetrahedra.
//          \ | /     \ |         If a mesh needs very many colors, the rest of the vertices follow one by one.
//            1 ------- 2
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "temper/detail/executor.hpp"
#include "temper/tets/optimize.hpp"
#include "tets/mesh/tables.hpp"
#include "tets/optimize/kernels.hpp"
#include "tets/optimize/mobility.hpp"

namespace temper::tets {

/// The faces of a link, in room that grows as needed.
[[nodiscard]] Link gather(const TetMesh& mesh, std::span<const HalffaceId> halffaces, std::vector<LinkLanes>& room);

/// Takes one Newton step of p among the faces of its link: over-relaxed, then plain, then halved, until the energy
/// falls. Otherwise p stays as it was. All tetrahedra stay positive, exactly. The faces are gathered in `room`.
[[nodiscard]] WeightedPoint improved(const TetMesh& mesh, std::span<const HalffaceId> link, const WeightedPoint& p,
                                     const Mobility& mobility, const SweepParameters& parameters,
                                     std::vector<LinkLanes>& room);

/// Says whether to stop after this fraction of a sweep or round.
using MustStop = std::function<bool(double)>;

class Sweeper {
 public:
  /// For sweeps over these vertices. O(number of tetrahedra).
  Sweeper(TetMesh& mesh, const IdVector<VertexId, Mobility>& mobility, std::span<const VertexId> vertices,
          Executor* executor = nullptr);

  /// A better place for a vertex among the faces of its link.
  using Step = std::function<WeightedPoint(VertexId, std::span<const HalffaceId>)>;
  /// Takes one step of each vertex, on any thread. `new_step` makes the step of one task, which runs on one thread. So
  /// the step may keep memory of its own. Returns false if it was stopped.
  bool sweep(const std::function<Step()>& new_step, const MustStop& must_stop = {});
  /// The same with the steps of improved().
  bool sweep(const SweepParameters& parameters, const MustStop& must_stop = {});

 private:
  void color(const VertexStars& stars, std::span<const VertexId> vertices);
  void improve(std::size_t first, std::size_t last, const Step& step);

  TetMesh& mesh_;
  const IdVector<VertexId, Mobility>& mobility_;
  Executor* executor_;
  std::vector<VertexId> sequence_;  // the vertices, color by color
  std::vector<std::size_t> end_;    // of each color
  VertexStars stars_;               // by the number in the sequence, so that memory is read from front to back
};

/// Says exactly whether t is positive, with its orthocenter inside.
[[nodiscard]] bool is_good(const TetMesh& mesh, TetId t);
/// Says whether the predicates are exact for p.
[[nodiscard]] bool is_exact(const WeightedPoint& p);

/// The energy of a mesh, and the number of tetrahedra whose orthocenter is not inside, exactly.
struct MeshState {
  double energy = 0;
  std::size_t bad = 0;
};
[[nodiscard]] MeshState state_of(const TetMesh& mesh, double gamma, Executor* executor = nullptr);
[[nodiscard]] std::vector<TetId> bad_tetrahedra(const TetMesh& mesh, Executor* executor = nullptr);

}  // namespace temper::tets
