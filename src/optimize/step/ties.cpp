#include "optimize/step/ties.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

#include "mesh/edge_lengths.hpp"
#include "optimize/step/dofs.hpp"
#include "topology/flip_inline.hpp"

namespace temper {
namespace {

// A dual shorter than this part of its edge is a tie, since coordinates in files have seven digits or more.
constexpr double kTiedDual = 1e-6;

bool is_tie(const Mesh& mesh, HalfedgeId h) {
  if (mesh.is_unflippable(h)) return false;
  const auto [edge, dual] = edge_lengths(mesh, h);
  return std::abs(dual) < kTiedDual * edge;
}

/// Calls use(quad) once for each tied quad, until it returns false. A triangle with two ties is in no quad: its circle
/// has more than four vertices.
template <class Use>
void for_tied_quads(const Mesh& mesh, const OptimizeOptions& options, Use&& use) {
  if (options.unknowns == Unknowns::positions || options.flips == Flips::none) return;
  const auto mobility = mobilities(mesh, options);
  const auto stays = [&](VertexId v) {
    return options.unknowns == Unknowns::weights || mobility[v] == Mobility::fixed;
  };
  const auto has_other_tie = [&](HalfedgeId h) { return is_tie(mesh, Mesh::next(h)) || is_tie(mesh, Mesh::prev(h)); };
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_boundary(h) || !mesh.is_edge_representative(h) || mesh.is_constrained(h)) continue;
    const inlined::Quad q = inlined::quad(mesh, h);
    if (!(stays(q.a) && stays(q.b) && stays(q.c) && stays(q.d)) || !is_tie(mesh, h)) continue;
    if (!has_other_tie(h) && !has_other_tie(mesh.twin(h)) && !use(q)) return;
  }
}

/// Two colors for the vertices. A tree holds vertices whose colors depend on each other. After a swap of the two colors
/// in one tree the coloring is still valid.
class Coloring {
 public:
  explicit Coloring(std::size_t n) : parent_(n), differs_(n, 0) {
    for (const VertexId v : IdRange<VertexId>(n)) parent_[v] = v;
  }

  struct Place {
    VertexId root;
    bool differs;  ///< from the root
  };
  [[nodiscard]] Place place(VertexId v) {
    VertexId root = v;
    bool differs = false;
    for (; parent_[root] != root; root = parent_[root]) differs ^= differs_[root] != 0;
    for (bool here = differs; v != root;) {  // shorten the path
      const VertexId next = std::exchange(parent_[v], root);
      here ^= std::exchange(differs_[v], here ? 1 : 0) != 0;
      v = next;
    }
    return {root, differs};
  }

  /// Gives u and v equal or different colors, unless their colors depend on each other already.
  void relate(VertexId u, VertexId v, bool differ) {
    Place a = place(u), b = place(v);
    if (a.root == b.root) return;
    if (b.root < a.root) std::swap(a, b);
    parent_[b.root] = a.root;
    differs_[b.root] = (a.differs != b.differs) != differ ? 1 : 0;
  }

 private:
  IdVector<VertexId, VertexId> parent_;
  IdVector<VertexId, std::uint8_t> differs_;  // from the parent
};

}  // namespace

bool has_tied_quads(const Mesh& mesh, const OptimizeOptions& options) {
  bool found = false;
  for_tied_quads(mesh, options, [&](const inlined::Quad&) { return !(found = true); });
  return found;
}

std::vector<TieEnd> heavier_ends_of_ties(const Mesh& mesh, const OptimizeOptions& options) {
  Coloring coloring(mesh.n_vertices());
  std::vector<inlined::Quad> quads;
  for_tied_quads(mesh, options, [&](const inlined::Quad& q) {
    coloring.relate(q.a, q.b, false);
    coloring.relate(q.c, q.d, false);
    coloring.relate(q.a, q.c, true);
    quads.push_back(q);
    return true;
  });
  // At the root of each set: the number of diagonals with the color of the root, minus the number with the other color.
  IdVector<VertexId, std::int32_t> majority(mesh.n_vertices(), 0);
  IdVector<VertexId, std::uint8_t> of_quads(mesh.n_vertices(), 0);
  for (const inlined::Quad& q : quads) {
    const auto a = coloring.place(q.a);
    majority[a.root] += a.differs ? -1 : 1;
    for (const VertexId v : {q.a, q.b, q.c, q.d}) of_quads[v] = 1;
  }
  std::vector<TieEnd> heavier;
  for (const VertexId v : mesh.vertices()) {
    if (of_quads[v] == 0) continue;
    const auto p = coloring.place(v);
    if (p.differs == (majority[p.root] < 0)) heavier.push_back({v, squared_shortest_edge(mesh, v)});
  }
  return heavier;
}

}  // namespace temper
