// See held_mesh.hpp.
#include "held_mesh.hpp"

#include <utility>

namespace temper::wasm {

Expected<std::unique_ptr<HeldMesh>> HeldMesh::of_file(io::MeshFile file, const std::vector<std::string>& fixed_tags,
                                                      std::vector<std::string>& warnings) {
  auto source = std::make_shared<Source>();
  source->file = std::move(file);
  Expected<io::LoadedMesh> loaded = io::make_mesh(source->file, fixed_tags);
  if (!loaded) return loaded.error();
  // Points are pairs of numbers in JavaScript.
  if (auto error = expect_plane(loaded->mesh, "temper in JavaScript")) {
    error->where = source->file.path;
    return *std::move(error);
  }
  source->loaded = *std::move(loaded);
  io::release_geometry(source->file, source->loaded);  // else it would be held twice
  warnings = std::move(source->file.warnings);
  source->file.warnings.clear();
  warnings.insert(warnings.end(), source->loaded.warnings.begin(), source->loaded.warnings.end());
  std::vector<double> corner_weights = io::corner_weights_of(source->file, source->loaded);
  auto held = std::make_unique<HeldMesh>(std::exchange(source->loaded.mesh, Mesh()));
  held->corner_weights = std::move(corner_weights);
  held->source_ = std::move(source);
  return held;
}

/// Numbers in the former state become numbers in the source.
void HeldMesh::replace(Mesh other, const IdVector<VertexId, VertexId>& vertices, std::vector<double> weights) {
  mesh = std::move(other);
  corner_weights = std::move(weights);
  if (vertices.empty() || !source_) return;
  IdVector<VertexId, VertexId> composed = vertices;
  for (VertexId& v : composed) {
    if (v.valid() && !origin_.empty()) v = v.index < origin_.size() ? origin_[v] : VertexId();
  }
  origin_ = std::move(composed);
}

io::MeshFile HeldMesh::file() const {
  io::MeshFile file = source_ ? source_->file : io::from_mesh(mesh);
  if (source_) io::update(file, source_->loaded, mesh, origin_);
  io::set_corner_weights(file, corner_weights);
  return file;
}

}  // namespace temper::wasm
