#include "mesh/mesh_archive.hpp"

#include <cmath>

#include "mesh/connectivity.hpp"

namespace temper {

void visit(Archive& archive, Space& space) {
  double radius = space.radius();
  Vec2 period = space.period();
  archive(radius, period.x, period.y);
  const auto is_length = [](double x) { return std::isfinite(x) && x >= 0; };
  archive.require(is_length(radius) && is_length(period.x) && is_length(period.y));
  const bool periodic = period.x > 0 || period.y > 0;
  archive.require(radius == 0 || !periodic);
  space = Space();
  if (archive.failed()) return;
  if (radius > 0) space = Space::sphere(radius);
  if (periodic) space = Space::periodic(period);
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
