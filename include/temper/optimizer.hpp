// A mesh that changes a little at a time, as in a simulation, and stays good.
//
//     auto optimizer = *Optimizer::make(std::move(mesh), *options_for("vertex"));
//     auto first = optimizer.update();                    // makes the mesh good, by a run over all of it if needed
//     for (int step = 0; step < n; ++step) {
//       for (VertexId v : front) optimizer.move(v, place_of(v, step));
//       auto update = optimizer.update();                 // makes good what the moves have spoiled
//       for (VertexId v : update->difference.rows) assemble(optimizer.mesh(), v);
//     }
//
// An update makes the changes that wait, and then runs with Change::least (temper/optimize.hpp). This run changes only
// places that violate the criterion of the target. All else keeps its bits. The update lists what is different.
#pragma once

#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "temper/detail/error.hpp"
#include "temper/detail/ids.hpp"
#include "temper/detail/size.hpp"
#include "temper/detail/vec.hpp"
#include "temper/mesh.hpp"
#include "temper/optimize.hpp"

namespace temper {

/// Where a mesh differs from a former one. Numbers are those of the present mesh, ascending.
template <class CellId>
struct MeshDifference {
  /// Number of each vertex in the former mesh, invalid for new ones. Empty: all have the same numbers.
  IdVector<VertexId, VertexId> vertices;
  std::vector<VertexId> moved;    ///< Vertices at another place
  std::vector<VertexId> weighed;  ///< Vertices with another weight
  /// Triangles or tetrahedra that the former mesh did not have, or of which a corner is among `moved` or `weighed`.
  std::vector<CellId> cells;
  /// Corners of `cells`: the rows to compute again of a matrix of vertices. All others have the same numbers in them.
  std::vector<VertexId> rows;
};

/// The changes that wait for an update, in the order in which it makes them.
struct WaitingChanges {
  std::vector<std::pair<VertexId, Vec3>> moved;
  std::vector<std::pair<VertexId, double>> weighed;
  std::vector<VertexId> removed;
  std::vector<Vec3> inserted;
  std::optional<SizeField> sizes;

  [[nodiscard]] bool empty() const {
    return moved.empty() && weighed.empty() && removed.empty() && inserted.empty() && !sizes;
  }
};

/// The result of an update.
template <class Report, class CellId>
struct UpdateOf {
  /// Report of the run. Its input is the mesh with the changes that waited. But where the report lists former numbers
  /// of vertices, faces and lines, they are those of the mesh after the last update.
  Report report;
  MeshDifference<CellId> difference;  ///< From the mesh after the last update, changes that waited included
};

/// Mesh, Hooks and Report are of triangles here, and of tetrahedra in temper::tets.
template <class MeshOf, class Hooks, class Report, class CellId>
class OptimizerOf {
 public:
  using Update = UpdateOf<Report, CellId>;

  /// Takes a mesh. The options are those of a run with Change::least. Errors: options that contradict each other, or
  /// that this change does not allow.
  [[nodiscard]] static Expected<OptimizerOf> make(MeshOf mesh, OptimizeOptions options = {});

  /// The mesh after the last update, without the changes that wait.
  [[nodiscard]] const MeshOf& mesh() const { return mesh_; }

  // --- changes: they wait for update() --------------------------------------------------------------
  // Vertices have the numbers of mesh(). In the plane z has no meaning, and on the sphere the distance from its center.

  /// Moves a vertex. With triangles the distance may be any. With tetrahedra it is an error if one would turn over. If
  /// the vertex lies on the boundary or on a line, the boundary or the line moves with it.
  void move(VertexId v, Vec3 place) { waiting_.moved.emplace_back(v, place); }
  /// Gives a vertex a weight [length²].
  void set_weight(VertexId v, double weight) { waiting_.weighed.emplace_back(v, weight); }
  void remove(VertexId v) { waiting_.removed.push_back(v); }
  /// Inserts a vertex. After the update new vertices are the last ones, in the order of these calls.
  void insert(Vec3 place) { waiting_.inserted.push_back(place); }
  /// Gives the mesh the sizes of a field. Where vertices are more than twice as dense as the field says, some are
  /// removed. Where they are less than half as dense, vertices are inserted, after those of insert(). Lines and the
  /// boundary keep their shape, and fixed vertices stay.
  void resize(SizeField field) requires std::is_same_v<MeshOf, Mesh> { waiting_.sizes = std::move(field); }
  /// Forgets the changes that wait.
  void forget() { waiting_ = {}; }

  /// Makes the changes that wait, then makes the mesh good again. O(n) for a few passes, and time for each place that
  /// violates the criterion. A mesh that needs nothing costs one check.
  ///
  /// Errors name the vertex, by `names`: a number that the mesh has not; a place that is not finite, outside the mesh,
  /// or behind its boundary or a line; a vertex that cannot be removed; a size field of another space. The mesh then
  /// stays as it was, and all changes still wait.
  [[nodiscard]] Expected<Update> update(const Hooks& hooks = {}, const InputNames* names = nullptr);

 private:
  OptimizerOf(MeshOf mesh, OptimizeOptions options) : mesh_(std::move(mesh)), options_(std::move(options)) {}

  MeshOf mesh_;
  OptimizeOptions options_;
  WaitingChanges waiting_;
};

using Optimizer = OptimizerOf<Mesh, OptimizeHooks, OptimizeReport, TriangleId>;
extern template class OptimizerOf<Mesh, OptimizeHooks, OptimizeReport, TriangleId>;

}  // namespace temper
