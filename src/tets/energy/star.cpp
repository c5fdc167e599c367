#include "tets/energy/star.hpp"

#include <algorithm>

#include "temper/tets/optimize.hpp"

namespace temper::tets {

void collect_link(const TetMesh& mesh, VertexId v, std::vector<HalffaceId>& link) {
  link.assign(1, mesh.halfface_opposite(mesh.incident(v), v));
  for (std::size_t i = 0; i < link.size(); ++i) {
    const HalffaceId here = link[i];
    for (int f = 0; f < 4; ++f) {
      const HalffaceId side = TetMesh::halfface(TetMesh::tetrahedron(here), f);
      if (side == here || mesh.is_boundary(side)) continue;
      const HalffaceId next = mesh.halfface_opposite(TetMesh::tetrahedron(mesh.twin(side)), v);
      if (std::find(link.begin(), link.end(), next) == link.end()) link.push_back(next);
    }
  }
}

LinkFace<double> link_face(const TetMesh& mesh, HalffaceId h) {
  const auto [q, r, s] = mesh.vertices(h);
  return link_face<double>(mesh.point(q), mesh.point(r), mesh.point(s));
}

double star_energy(std::span<const LinkFace<double>> link, const WeightedPoint& p, double gamma) {
  double sum = 0;
  for (const LinkFace<double>& face : link) sum += tet_energy<double>(face, {p.x, p.y, p.z}, p.w, gamma);
  return sum;
}

double energy_of(const TetMesh& mesh, TetId t, double gamma) { return tetrahedron_energy(mesh.points(t), gamma); }

double tetrahedron_energy(const std::array<WeightedPoint, 4>& corners, double gamma) {
  const auto& [p, q, r, s] = corners;
  const LinkFace<double> face = link_face<double>(q, s, r);
  return star_energy({&face, 1}, p, gamma);
}

}  // namespace temper::tets
