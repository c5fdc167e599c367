// The way to the connectivity of a surface for the steps of a run.
#pragma once

#include "temper/surfaces.hpp"

namespace temper::surfaces {

/// As MeshEditor: it checks nothing.
class SurfaceEditor {
 public:
  explicit SurfaceEditor(SurfaceMesh& mesh) : mesh_(mesh) {}
  [[nodiscard]] Mesh& connectivity() { return mesh_.mesh_; }

 private:
  SurfaceMesh& mesh_;
};

}  // namespace temper::surfaces
