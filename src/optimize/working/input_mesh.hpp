// The caller's mesh while a run works on copies of it.
//
// If nobody else reads the mesh, it is not kept twice: along the curve it becomes the first working copy, and is folded
// meanwhile.
#pragma once

#include "mesh/folded_mesh.hpp"
#include "optimize/working/working_copy.hpp"

namespace temper {

class InputMesh {
 public:
  /// `may_change`: whether nobody else reads the mesh during the life of this object.
  InputMesh(Mesh& mesh, bool may_change, SweepOrder sweeps, Executor* executor);
  InputMesh(const InputMesh&) = delete;
  InputMesh& operator=(const InputMesh&) = delete;
  ~InputMesh() { whole(); }

  /// Returns the mesh as the caller gave it.
  Mesh& whole();
  /// Returns the mesh in an order that may be along the curve, and the caller's number of each vertex; none if all are
  /// equal.
  const Mesh& any_order();
  [[nodiscard]] const IdVector<VertexId, VertexId>& numbers() const { return order_->vertices; }
  /// Says whether the caller's numbers scatter stars over memory.
  [[nodiscard]] bool is_scattered() const { return scattered_; }
  [[nodiscard]] std::size_t n_vertices() const { return n_vertices_; }
  [[nodiscard]] std::size_t n_triangles() const { return n_triangles_; }

  [[nodiscard]] WorkingCopy copy();
  /// Ends with another mesh in its place.
  void replace(WorkingCopy result);

 private:
  void order();

  Mesh& mesh_;
  bool may_change_, scattered_, folded_up_ = false;
  SweepOrder sweeps_;
  Executor* executor_;
  std::size_t n_vertices_, n_triangles_;
  SharedOrder order_;  // of mesh_ and folded_; empty: the caller's
  FoldedMesh folded_;
};

}  // namespace temper
