#include "experiments/short_edge.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "experiments/minimize.hpp"
#include "temper/topology.hpp"

namespace temper::gallery {
namespace {

constexpr double kFirstStep = 0.1;  // of the nearest neighbor's distance: small enough to stay in the local minimum

std::vector<VertexId> link_of(const Mesh& mesh, VertexId v) {
  std::vector<VertexId> link;
  for (const HalfedgeId h : mesh.star(v)) link.push_back(mesh.target(h));
  return link;
}

struct Nearest {
  VertexId vertex;
  double distance = 0;
  double ratio = 0;  ///< to the shorter of the link edges at the vertex
};

Nearest nearest_of(const Mesh& mesh, const std::vector<VertexId>& link, Vec2 p) {
  const auto distance = [&](VertexId q) { return length(mesh.position(q) - p); };
  const auto found = std::ranges::min_element(link, {}, distance);
  const std::size_t n = link.size(), i = static_cast<std::size_t>(found - link.begin());
  const auto edge = [&](std::size_t other) { return length(mesh.position(link[other]) - mesh.position(*found)); };
  return {*found, distance(*found), distance(*found) / std::min(edge((i + 1) % n), edge((i + n - 1) % n))};
}

}  // namespace

ShortEdge short_edge(const Mesh& mesh, VertexId v) {
  EnergyModel model;
  model.kind = EnergyKind::F;
  Mesh moved = mesh;
  const auto energy = [&](Vec2 p) {
    moved.set_position(v, p);
    return vertex_energy(moved, model, v).value;
  };
  const std::vector<VertexId> link = link_of(mesh, v);
  const Nearest now = nearest_of(mesh, link, mesh.position(v));
  const Minimum2 best = simplex_minimum(energy, mesh.position(v), kFirstStep * now.distance);
  const Nearest there = nearest_of(mesh, link, best.at);
  return {best.at, there.vertex, there.distance, now.distance, there.ratio};
}

double energy_change_without(const Mesh& mesh, const EnergyModel& model, VertexId v) {
  const RemovalPlan plan = plan_removal(mesh, v);
  if (plan.status != RemovalStatus::possible) return std::numeric_limits<double>::infinity();
  Mesh without = mesh;
  remove_vertex(without, plan);
  without.compact();
  return total_energy(without, model) - total_energy(mesh, model);
}

std::size_t valence(const Mesh& mesh, VertexId v) {
  std::size_t triangles = 0;
  for ([[maybe_unused]] const HalfedgeId h : mesh.star(v)) ++triangles;
  return mesh.is_boundary(v) ? triangles + 1 : triangles;
}

}  // namespace temper::gallery
