#include "tets/mesh/embedding.hpp"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <vector>

#include "base/sort_unique.hpp"

namespace temper::tets {
namespace {

/// Disjoint sets of corners, by the least corner of each.
class CornerSets {
 public:
  explicit CornerSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t i, std::uint32_t j) {
    i = find(i), j = find(j);
    if (i != j) parent_[std::max(i, j)] = std::min(i, j);
  }
  [[nodiscard]] bool is_least(std::uint32_t i) const { return parent_[i] == i; }

 private:
  std::vector<std::uint32_t> parent_;
};

class EmbeddingCheck {
 public:
  EmbeddingCheck(const TetMesh& mesh, const EdgeTable& edges, const InputErrors& errors)
      : mesh_(mesh), edges_(edges), errors_(errors), boundary_(mesh.n_vertices()) {}

  std::optional<InputError> run() {
    for (const auto check :
         {&EmbeddingCheck::check_stars, &EmbeddingCheck::check_edges, &EmbeddingCheck::check_vertices}) {
      if (auto error = (this->*check)()) return error;
    }
    return std::nullopt;
  }

 private:
  static constexpr double kRounded = 1e-6;  // of a whole turn or sphere: above the rounding of a thousand angles

  /// The link of a vertex consists of a triangle for each tetrahedron there, an edge for each face, and a vertex for
  /// each edge. It is a sphere or a disk if it is connected across its edges and its Euler characteristic is 2, or 1
  /// with a boundary: each pinch and each handle would lower this number.
  std::optional<InputError> check_stars() {
    CornerSets sets(mesh_.n_halffaces());
    IdVector<VertexId, std::int32_t> doubled(mesh_.n_vertices(), 0);  // twice the Euler characteristic
    for (const HalffaceId h : mesh_.halffaces()) {
      const HalffaceId other = mesh_.twin(h);
      // A tetrahedron adds 1 to each of its corners, and half of each of its three faces there subtracts 1/2. A face on
      // the boundary has no other half.
      doubled[mesh_.opposite(h)] += 2;
      for (const VertexId v : mesh_.vertices(h)) {
        doubled[v] -= other.valid() ? 1 : 2;
        if (!other.valid()) boundary_[v] = 1;
        if (other.valid() && h < other) sets.join(corner(h, v), corner(other, v));
      }
    }
    IdVector<VertexId, std::uint32_t> parts(mesh_.n_vertices(), 0);
    for (const VertexId v : mesh_.vertices()) {
      doubled[v] += 2 * static_cast<std::int32_t>(edges_.greater(v).size());
      for (const VertexId u : edges_.greater(v)) doubled[u] += 2;
    }
    for (const HalffaceId h : mesh_.halffaces()) parts[mesh_.opposite(h)] += sets.is_least(h.index) ? 1 : 0;
    for (const VertexId v : mesh_.vertices()) {
      if (parts[v] != 1 || doubled[v] != (boundary_[v] != 0 ? 2 : 4)) return wrong_star(v);
    }
    return std::nullopt;
  }
  /// The corner at v of the tetrahedron of h has the number of the halfface opposite it.
  [[nodiscard]] std::uint32_t corner(HalffaceId h, VertexId v) const {
    return mesh_.halfface_opposite(TetMesh::tetrahedron(h), v).index;
  }
  InputError wrong_star(VertexId v) const {
    std::vector<VertexId> neighbors;
    for (const TetId t : mesh_.tetrahedra()) {
      const auto& corners = mesh_.corners(t);
      if (std::find(corners.begin(), corners.end(), v) == corners.end()) continue;
      for (const VertexId u : corners) {
        if (u != v) neighbors.push_back(u);
      }
    }
    sort_unique(neighbors);
    for (const VertexId u : neighbors) {
      if (n_parts({v, u}) < 2) continue;
      return errors_.at(ErrorCode::non_manifold_edge, v,
                        "the mesh touches itself along the edge from " + errors_.name(v) + " to " + errors_.name(u) +
                            ": its tetrahedra are not one fan around it" + errors_.near(std::array{v, u}) +
                            ". Next: separate or join its parts there");
    }
    return errors_.at(ErrorCode::non_manifold_vertex, v,
                      "the mesh touches itself at " + errors_.name(v) +
                          ": its tetrahedra are not one ball or half ball around it, at " +
                          coordinates(mesh_.position(v)) + ". Next: separate or join its parts there");
  }
  /// The number of parts, connected across faces that have both vertices, of the tetrahedra that have both.
  [[nodiscard]] std::size_t n_parts(std::array<VertexId, 2> edge) const {
    const auto has_both = [&](const auto& corners) {
      return std::count(corners.begin(), corners.end(), edge[0]) +
                 std::count(corners.begin(), corners.end(), edge[1]) ==
             2;
    };
    std::vector<TetId> left;
    for (const TetId t : mesh_.tetrahedra()) {
      if (has_both(mesh_.corners(t))) left.push_back(t);
    }
    std::size_t parts = 0;
    while (!left.empty()) {
      ++parts;
      std::vector<TetId> part = {left.back()};
      left.pop_back();
      for (std::size_t i = 0; i < part.size(); ++i) {
        for (int f = 0; f < 4; ++f) {
          const HalffaceId h = TetMesh::halfface(part[i], f), other = mesh_.twin(h);
          if (!other.valid() || !has_both(mesh_.vertices(h))) continue;
          const auto next = std::find(left.begin(), left.end(), TetMesh::tetrahedron(other));
          if (next == left.end()) continue;
          part.push_back(*next);
          left.erase(next);
        }
      }
    }
    return parts;
  }

  /// The dihedral angles at an inner edge add up to 2 π times its number of turns. If an inner vertex is covered once,
  /// so are its edges_. So only edges between vertices of the boundary are looked at.
  std::optional<InputError> check_edges() {
    struct Part {
      std::uint32_t edge;
      TetId tetrahedron;
      double angle;
    };
    std::vector<Part> parts;
    for (const TetId t : mesh_.tetrahedra()) {
      const auto& c = mesh_.corners(t);
      for (const auto& [i, j, k, l] : kEdgeCorners) {
        const VertexId a = c[std::size_t(i)], b = c[std::size_t(j)];
        if (boundary_[a] == 0 || boundary_[b] == 0) continue;
        parts.push_back({*edges_.find(a, b), t,
                         dihedral_angle(mesh_.position(a), mesh_.position(b), mesh_.position(c[std::size_t(k)]),
                                        mesh_.position(c[std::size_t(l)]))});
      }
    }
    std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
      return a.edge != b.edge ? a.edge < b.edge : a.tetrahedron < b.tetrahedron;
    });
    for (std::size_t i = 0, end = 0; i < parts.size(); i = end) {
      double turns = 0;
      for (end = i; end < parts.size() && parts[end].edge == parts[i].edge; ++end)
        turns += parts[end].angle / (2 * std::numbers::pi);
      if (turns > 1 + kRounded) return wrong_turns(parts[i].tetrahedron, parts[i].edge, turns);
    }
    return std::nullopt;
  }
  InputError wrong_turns(TetId t, std::uint32_t edge, double turns) const {
    const auto& c = mesh_.corners(t);
    const auto found = std::find_if(kEdgeCorners.begin(), kEdgeCorners.end(), [&](const auto& e) {
      return edges_.find(c[std::size_t(e[0])], c[std::size_t(e[1])]) == edge;
    });
    const std::array<VertexId, 2> ends = {c[std::size_t((*found)[0])], c[std::size_t((*found)[1])]};
    return errors_.at(ErrorCode::overlap, t,
                      "the tetrahedra around the edge from " + errors_.name(ends[0]) + " to " + errors_.name(ends[1]) +
                          " overlap: together they make " + rounded(turns, 3) + " turns around it" +
                          errors_.near(ends) + ". Next: mesh this place again");
  }

  /// The solid angles at an inner vertex add up to 4 π times the number of layers on top of each other.
  std::optional<InputError> check_vertices() {
    constexpr double kSphere = 4 * std::numbers::pi;
    IdVector<VertexId, double> angle(mesh_.n_vertices(), 0);
    for (const TetId t : mesh_.tetrahedra()) {
      const auto& c = mesh_.corners(t);
      std::array<Vec3, 4> p;
      for (std::size_t k = 0; k < 4; ++k) p[k] = mesh_.position(c[k]);
      angle[c[0]] += solid_angle(p[0], p[1], p[2], p[3]);
      angle[c[1]] += solid_angle(p[1], p[2], p[0], p[3]);
      angle[c[2]] += solid_angle(p[2], p[0], p[1], p[3]);
      angle[c[3]] += solid_angle(p[3], p[0], p[2], p[1]);
    }
    for (const VertexId v : mesh_.vertices()) {
      const double most = boundary_[v] != 0 ? (1 + kRounded) * kSphere : 1.5 * kSphere;
      if (angle[v] <= most) continue;
      return errors_.at(ErrorCode::overlap, v,
                        "the tetrahedra around " + errors_.name(v) + " overlap: together they fill " +
                            rounded(100 * angle[v] / kSphere) + " % of the sphere around " +
                            coordinates(mesh_.position(v)) + ". Next: mesh this place again");
    }
    return std::nullopt;
  }

  const TetMesh& mesh_;
  const EdgeTable& edges_;
  const InputErrors& errors_;
  IdVector<VertexId, std::uint8_t> boundary_;  // from check_stars on
};

}  // namespace

std::optional<InputError> check_embedding(const TetMesh& mesh, const EdgeTable& edges, const InputErrors& errors) {
  return EmbeddingCheck(mesh, edges, errors).run();
}

}  // namespace temper::tets
