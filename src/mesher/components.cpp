// Flooding finds components of triangles between edges; properties of edges then spread from one to the next.
#include "mesher/components.hpp"

#include <algorithm>
#include <iterator>
#include <numbers>

#include "temper/detail/geometry.hpp"

namespace temper::mesher {
namespace {

/// Numbers the components of triangles. Returns how many there are.
std::uint32_t flood(const Hull& hull, IdVector<TriangleId, std::uint32_t>& of) {
  of.resize(hull.mesh.n_triangles(), Components::kNone);
  std::uint32_t n = 0;
  std::vector<TriangleId> stack;
  for (const TriangleId seed : hull.mesh.triangles()) {
    if (of[seed] != Components::kNone) continue;
    of[seed] = n;
    stack.push_back(seed);
    while (!stack.empty()) {
      const TriangleId t = stack.back();
      stack.pop_back();
      each_neighbor(hull, t, [&](TriangleId next) {
        if (of[next] != Components::kNone) return;
        of[next] = n;
        stack.push_back(next);
      });
    }
    ++n;
  }
  return n;
}

}  // namespace

Expected<Components> find_components(const Surface& surface, const Arrangement& arrangement, Deadline& deadline) {
  Expected<Hull> hull = triangulate_hull(surface, arrangement.places, undivided(arrangement).pieces, deadline);
  if (!hull) return hull.error();
  Components components;
  components.hull = *std::move(hull);
  components.neighbors.resize(flood(components.hull, components.of));
  const Mesh& mesh = components.hull.mesh;
  for (const HalfedgeId h : mesh.halfedges()) {
    const std::uint32_t edge = components.hull.piece[h];
    if (mesh.is_boundary(h)) {
      components.from_outside.emplace_back(components.at(h), edge);
    } else if (edge != kNoPiece) {
      components.neighbors[components.at(h)].emplace_back(components.at(mesh.twin(h)), edge);
    }
  }
  return components;
}

std::vector<std::uint32_t> depths(const Components& components) {
  std::vector<std::uint32_t> depth(components.size(), Components::kNone), here, beyond;
  for (const auto& [c, piece] : components.from_outside) (piece == kNoPiece ? here : beyond).push_back(c);
  for (std::uint32_t level = 0; !here.empty() || !beyond.empty(); ++level) {
    while (!here.empty()) {
      const std::uint32_t c = here.back();
      here.pop_back();
      if (depth[c] != Components::kNone) continue;
      depth[c] = level;
      for (const auto& [next, piece] : components.neighbors[c]) beyond.push_back(next);
    }
    std::swap(here, beyond);
  }
  return depth;
}

std::vector<double> parts_of_sphere(const Components& components) {
  std::vector<double> area(components.size(), 0);
  const Mesh& mesh = components.hull.mesh;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    area[components.of[t]] +=
        solid_angle(mesh.weighted_vector(a), mesh.weighted_vector(b), mesh.weighted_vector(c)) / (4 * std::numbers::pi);
  }
  return area;
}

Parts parts_from(const Components& components, const std::vector<Components::Crossed>& first,
                 const std::vector<OutlineEdge>& edges) {
  Parts parts(components.size());
  std::vector<std::uint8_t> known(components.size(), 0);
  std::vector<std::uint32_t> queue;
  const auto enter = [&](std::uint32_t c, const std::vector<std::int32_t>& from, std::uint32_t piece) {
    if (known[c] != 0) return;
    known[c] = 1;
    parts[c] = piece == kNoPiece ? from : odd_ones(from, edges[piece].parts);
    queue.push_back(c);
  };
  for (const auto& [c, piece] : first) enter(c, {}, piece);
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const std::uint32_t c = queue[i];
    for (const auto& [next, piece] : components.neighbors[c]) enter(next, parts[c], piece);
  }
  return parts;
}

std::vector<std::int32_t> odd_ones(const std::vector<std::int32_t>& one, const std::vector<std::int32_t>& other) {
  std::vector<std::int32_t> result;
  std::set_symmetric_difference(one.begin(), one.end(), other.begin(), other.end(), std::back_inserter(result));
  return result;
}

}  // namespace temper::mesher
