// The mesh that a run works on: a copy in its own units and order, with the user's number of each vertex and triangle.
//
// Inserted vertices and their triangles get the next number that was never used, as topology gives them slots. In a
// mesh that is never compacted, as in a replay, slots and numbers are equal.
#pragma once

#include "mesh/mesh_editor.hpp"
#include "mesh/twins.hpp"
#include "optimize/working/working_units.hpp"
#include "temper/mesh.hpp"
#include "temper/optimize.hpp"

namespace temper {

/// Returns the values of the elements that a compaction has kept.
template <class Id, class T>
[[nodiscard]] IdVector<Id, T> kept_of(const IdVector<Id, T>& all, const IdVector<Id, Id>& kept) {
  IdVector<Id, T> result;
  result.reserve(kept.size());
  for (const Id i : kept) result.push_back(all[i]);
  return result;
}

struct WorkingCopy {
  Mesh mesh;
  WorkingUnits units;
  MeshOrder order;                    ///< the user's numbers, and further ones for new elements
  bool has_gaps = false;              ///< in the numbers, after vertices have been removed
  std::size_t n_input_vertices = 0;   ///< in the user's mesh; vertices from this number on are inserted
  std::size_t n_vertices_named = 0;   ///< numbers given so far, input included; none is given twice
  std::size_t n_triangles_named = 0;  ///< numbers of triangle slots given so far

  /// An empty copy.
  WorkingCopy() = default;
  WorkingCopy(const Mesh& user, SweepOrder sweeps, Executor* executor = nullptr);
  /// The working copy of a part of a mesh that has the right units already: numbers and coordinates stay.
  [[nodiscard]] static WorkingCopy part(const Mesh& part);

  /// Returns the vertex that has number v in the user's mesh, or an invalid one if it was removed. O(n).
  [[nodiscard]] VertexId from_user(VertexId v) const;
  /// Numbers the elements that topology has appended to the mesh. Call it after each insertion or split, before
  /// recording.
  void name_new();
  [[nodiscard]] bool has_inserted() const { return n_vertices_named > n_input_vertices; }
  /// Drops erased triangles and removed vertices from mesh and order.
  Compaction compact();
  /// Returns the mesh in the user's units and order, then in the order of insertion, without gaps. The copy stays, or
  /// is used up.
  [[nodiscard]] Mesh in_user_terms(Executor* executor = nullptr) const&;
  [[nodiscard]] Mesh in_user_terms(Executor* executor = nullptr) &&;
  /// The two steps of in_user_terms().
  void leave_frame();
  [[nodiscard]] Mesh in_user_order(Executor* executor) &&;
  /// Returns the number in the input of each vertex of in_user_terms(), invalid if inserted.
  [[nodiscard]] IdVector<VertexId, VertexId> user_vertices() const;
};

/// A mesh that a run has reached, and the sweep that made it.
struct Candidate {
  WorkingCopy work;
  int sweep = 0;
};

// The caller's mesh while a run works on copies of it. If the caller says that nobody reads the mesh, its twins take no
// memory meanwhile: they follow from the corners.

class InputMesh {
 public:
  /// `may_fold`: whether nobody else reads the mesh during the life of this object.
  InputMesh(Mesh& mesh, bool may_fold, Executor* executor) : mesh_(mesh), may_fold_(may_fold), executor_(executor) {}
  InputMesh(const InputMesh&) = delete;
  InputMesh& operator=(const InputMesh&) = delete;
  ~InputMesh() { restore_twins(); }

  /// Returns the mesh as the caller gave it.
  Mesh& restore_twins() {
    if (folded_) find_twins(mesh_, executor_);
    folded_ = false;
    return mesh_;
  }
  /// Nobody may read the mesh until restore_twins() is called.
  void drop_twins() {
    if (!may_fold_) return;
    MeshEditor(mesh_).release_twins();
    folded_ = true;
  }

 private:
  Mesh& mesh_;
  bool may_fold_, folded_ = false;
  Executor* executor_;
};

}  // namespace temper
