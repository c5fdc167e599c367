#include "mesh/mesh_archive.hpp"

#include "mesh/connectivity.hpp"

namespace temper {

void MeshArchive::visit(Archive& archive, Mesh& mesh) {
  auto& [vertices, corners, twins, constrained, regions] = mesh;
  static_assert(sizeof(Mesh::VertexRecord) == 3 * sizeof(double) + 2 * sizeof(std::uint32_t));  // no gaps
  archive.plain(vertices);
  archive(corners, twins, constrained.values_, regions.values_);
  archive.require(!archive.failed() && is_whole(mesh));
  if (archive.failed()) mesh = Mesh();
}

bool MeshArchive::is_whole(const Mesh& mesh) {
  const auto& [vertices, corners, twins, constrained, regions] = mesh;
  return corners.size() % 3 == 0 && twins.size() == corners.size() && constrained.has_size(corners.size()) &&
         regions.has_size(corners.size() / 3) && !broken_connectivity(mesh);
}

}  // namespace temper
