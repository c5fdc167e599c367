// The caller's mesh while a run works on copies of it. What can be found again takes no room meanwhile, where the
// caller says that nobody looks: twins follow from corners.
#pragma once

#include "mesh/mesh_editor.hpp"
#include "mesh/twins.hpp"
#include "temper/mesh.hpp"

namespace temper {

class InputMesh {
 public:
  /// `may_fold`: whether nobody else looks at the mesh while this lives.
  InputMesh(Mesh& mesh, bool may_fold, Executor* executor) : mesh_(mesh), may_fold_(may_fold), executor_(executor) {}
  InputMesh(const InputMesh&) = delete;
  InputMesh& operator=(const InputMesh&) = delete;
  ~InputMesh() { whole(); }

  /// The mesh as the caller gave it.
  Mesh& whole() {
    if (folded_) find_twins(mesh_, executor_);
    folded_ = false;
    return mesh_;
  }
  /// Nobody needs it until whole() is called.
  void fold() {
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
