#include "mesh/mesh_archive.hpp"

#include <cmath>

#include "mesh/connectivity.hpp"

namespace temper {

void visit(Archive& archive, Space& space) {
  double radius = space.radius();
  archive(radius);
  archive.require(std::isfinite(radius) && radius >= 0);
  space = radius > 0 && !archive.failed() ? Space::sphere(radius) : Space();
}

void MeshArchive::visit(Archive& archive, Mesh& mesh) {
  auto& [space, vertices, corners, twins, constrained, regions] = mesh;
  static_assert(sizeof(Mesh::VertexRecord) == 3 * sizeof(double) + 2 * sizeof(std::uint32_t));  // no gaps
  archive(space);
  archive.plain(vertices);
  archive(corners, twins, constrained.values_, regions.values_);
  archive.require(!archive.failed() && is_whole(mesh));
  if (archive.failed()) mesh = Mesh();
}

bool MeshArchive::is_whole(const Mesh& mesh) {
  const auto& [space, vertices, corners, twins, constrained, regions] = mesh;
  return corners.size() % 3 == 0 && twins.size() == corners.size() && constrained.has_size(corners.size()) &&
         regions.has_size(corners.size() / 3) && !broken_connectivity(mesh);
}

}  // namespace temper
