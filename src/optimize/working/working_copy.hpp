// The mesh being worked on: a copy in its units and in an order of its own, that knows every name of the user's.
//
// Vertices that are inserted, and triangles that come with them, get names as topology gives them slots: the next one
// that was never used. A mesh that is never compacted, as in a replay, has them in the slots of these numbers.
#pragma once

#include "mesh/mesh_editor.hpp"
#include "mesh/twins.hpp"
#include "optimize/working/working_units.hpp"
#include "temper/mesh.hpp"
#include "temper/optimize.hpp"

namespace temper {

/// The values of what a compaction has kept.
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
  MeshOrder order;                    ///< the user's numbers, and those after them
  bool has_gaps = false;              ///< in them, once vertices have been removed
  std::size_t n_input_vertices = 0;   ///< in the user's mesh: from this number on vertices are inserted ones
  std::size_t n_vertices_named = 0;   ///< numbers given so far, input included; never given again
  std::size_t n_triangles_named = 0;  ///< the same of the user's triangle slots

  /// Of no mesh.
  WorkingCopy() = default;
  WorkingCopy(const Mesh& user, SweepOrder sweeps, Executor* executor = nullptr);
  /// The working copy of a part of a mesh that is in its units already: every number and coordinate is its own name.
  [[nodiscard]] static WorkingCopy part(const Mesh& part);

  /// The vertex of that number in the user's mesh; invalid when it was removed. O(n).
  [[nodiscard]] VertexId from_user(VertexId v) const;
  /// Names what topology has appended to mesh: after each insertion or split, before the recorder hears of it.
  void name_new();
  [[nodiscard]] bool has_inserted() const { return n_vertices_named > n_input_vertices; }
  /// Drops erased triangles and removed vertices from mesh and order.
  Compaction compact();
  /// Out of the units, and in the user's order, then in the order of insertion; what was removed leaves no gap. The
  /// copy stays as it is, or is used up.
  [[nodiscard]] Mesh in_user_terms(Executor* executor = nullptr) const&;
  [[nodiscard]] Mesh in_user_terms(Executor* executor = nullptr) &&;
  /// The two steps of that.
  void leave_frame();
  [[nodiscard]] Mesh in_user_order(Executor* executor) &&;
  /// The number in the input of each vertex of in_user_terms(); invalid for inserted ones.
  [[nodiscard]] IdVector<VertexId, VertexId> user_vertices() const;
};

/// A mesh that a run has come to, and the sweep whose mesh it is.
struct Candidate {
  WorkingCopy work;
  int sweep = 0;
};

// The caller's mesh while a run works on copies of it. What can be found again takes no room meanwhile, where the
// caller says that nobody looks: twins follow from corners.

class InputMesh {
 public:
  /// `may_fold`: whether nobody else looks at the mesh while this lives.
  InputMesh(Mesh& mesh, bool may_fold, Executor* executor) : mesh_(mesh), may_fold_(may_fold), executor_(executor) {}
  InputMesh(const InputMesh&) = delete;
  InputMesh& operator=(const InputMesh&) = delete;
  ~InputMesh() { restore_twins(); }

  /// The mesh as the caller gave it.
  Mesh& restore_twins() {
    if (folded_) find_twins(mesh_, executor_);
    folded_ = false;
    return mesh_;
  }
  /// Nobody needs it until restore_twins() is called.
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
