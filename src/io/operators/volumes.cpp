#include "io/operators/volumes.hpp"

#include <map>

namespace temper::io {

FiniteVolumes volumes_of(const DecJob& job) {
  const Columns& c = *job.options.columns;
  FiniteVolumes result;
  result.n_numbers = c.n_cells();
  std::vector<std::size_t> index(c.n_cells());
  const auto center = [&](std::size_t cell) {
    const Vec2 at = c.plan.centers[c.column(cell)];
    return Vec3{at.x, at.y, c.center(cell)};
  };
  for (std::size_t cell = 0; cell < c.n_cells(); ++cell) {
    if (!c.is_active(cell)) continue;
    index[cell] = result.cells.size();
    result.cells.push_back({cell, center(cell), c.volumes[cell], c.layer(cell) + 1});
  }
  result.connections.reserve(c.connections.size());
  for (const ColumnConnection& connection : c.connections) {
    const auto [a, b, is_vertical, to_face, from_face, width, area] = connection;
    const Vec3 from = center(a), to = center(b);
    const Vec3 face =
        is_vertical ? Vec3{from.x, from.y, c.bottoms[a]} : from + (to_face / (to_face + from_face)) * (to - from);
    result.connections.push_back({index[a], index[b], to_face, from_face, area, is_vertical, face});
  }
  return result;
}

FiniteVolumes volumes_of(const TetDecJob& job) {
  const auto& [mesh, complex] = std::tie(job.mesh, job.complex);
  FiniteVolumes result;
  result.n_numbers = mesh.n_vertices();
  IdVector<VertexId, std::map<std::int32_t, double>> shares(mesh.n_vertices());
  for (const tets::TetId t : mesh.tetrahedra()) {
    for (const VertexId v : mesh.corners(t)) shares[v][mesh.region(t)] += complex.volumes[t];
  }
  for (const VertexId v : mesh.vertices()) {
    const auto most = std::ranges::max_element(shares[v], {}, [](const auto& share) { return share.second; });
    const std::int32_t region = most == shares[v].end() ? 0 : most->first;
    result.cells.push_back(
        {v.index, mesh.position(v), complex.star0[v], static_cast<std::size_t>(std::max(region, 0))});
  }
  const bool has_tensor = !complex.half_transmissibility.empty();
  for (std::size_t e = 0; e < complex.edges.size(); ++e) {
    const tets::DecEdge& edge = complex.edges[EdgeId(e)];
    if (edge.dual_area == 0) continue;
    FiniteVolumes::Connection c = {edge.from.index, edge.to.index, edge.crossing, edge.length - edge.crossing,
                                   edge.dual_area,  false,         edge.midpoint};
    if (has_tensor) {  // distances of the file's space, and the area with which a permeability of 1 gives the flux
      const double distance = length(mesh.position(edge.to) - mesh.position(edge.from));
      c.first_distance *= distance / edge.length;
      c.second_distance *= distance / edge.length;
      c.area = complex.star1[EdgeId(e)] * distance;
    }
    result.connections.push_back(c);
  }
  return result;
}

}  // namespace temper::io
