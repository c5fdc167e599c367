#include "optimize/working/input_mesh.hpp"

#include <utility>

#include "mesh/curve.hpp"

namespace temper {

InputMesh::InputMesh(Mesh& mesh, bool may_change, SweepOrder sweeps, Executor* executor)
    : mesh_(mesh),
      may_change_(may_change && sweeps == SweepOrder::hilbert),
      scattered_(temper::is_scattered(mesh)),
      sweeps_(sweeps),
      executor_(executor),
      n_vertices_(mesh.n_vertices()),
      n_triangles_(mesh.n_triangles()) {
  if (may_change_ && scattered_) order();
}

void InputMesh::order() { order_ = SharedOrder(hilbert_order_in_place(mesh_, executor_)); }

const Mesh& InputMesh::any_order() {
  if (std::exchange(folded_up_, false)) mesh_ = std::exchange(folded_, {}).unfold(executor_);
  return mesh_;
}

Mesh& InputMesh::whole() {
  any_order();
  if (!order_->vertices.empty()) restore_order(mesh_, *std::exchange(order_, {}), executor_);
  return mesh_;
}

WorkingCopy InputMesh::copy() {
  if (!may_change_) return {mesh_, sweeps_, executor_};
  any_order();
  if (order_->vertices.empty()) order();
  folded_ = FoldedMesh(mesh_);
  folded_up_ = true;
  return {std::exchange(mesh_, {}), order_};
}

void InputMesh::replace(WorkingCopy result) {
  folded_ = {};
  folded_up_ = false;
  order_ = {};
  result.take_user_order(executor_);
  mesh_ = std::move(result.mesh);
}

}  // namespace temper
