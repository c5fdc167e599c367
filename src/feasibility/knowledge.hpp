// Pairs of vertices and lemmas about them, for the complete search (complete_search.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "feasibility/proof_checker.hpp"
#include "feasibility/sight.hpp"

namespace temper {

using LemmaId = std::size_t;

/// The left side of the edge from the first vertex to the second.
using Side = std::array<VertexId, 2>;

/// What the search knows of pairs of vertices and their lemmas, while it chooses edges and takes them back.
class Knowledge {
 public:
  enum class Tested : std::uint8_t { no, alive, dead };

  /// The knowledge about two vertices: about their edge, and about the left side from the first to the second.
  struct Pair {
    bool is_known = false;              ///< an edge
    Tested tested = Tested::no;         ///< without the rows of other chosen edges
    std::vector<LemmaId> lemmas;        ///< that name the edge
    bool has_apexes = false;            ///< whether `apexes` was made
    std::vector<VertexId> apexes = {};  ///< that the triangle on this side has in some triangulation
  };

  Knowledge(const Mesh& mesh, const Sight& sight)
      : mesh_(mesh), sight_(sight), pairs_(mesh.n_vertices() * mesh.n_vertices()) {}

  /// Edges of all triangulations, then the chosen edges in their order.
  [[nodiscard]] const std::vector<ProofEdge>& known() const { return known_; }
  [[nodiscard]] std::vector<Lemma>& lemmas() { return lemmas_; }

  [[nodiscard]] Pair& pair(VertexId a, VertexId b) { return pairs_[a.index * mesh_.n_vertices() + b.index]; }
  [[nodiscard]] const Pair& pair(VertexId a, VertexId b) const {
    return pairs_[a.index * mesh_.n_vertices() + b.index];
  }
  [[nodiscard]] Pair& pair(const ProofEdge& e) { return pair(e[0], e[1]); }
  [[nodiscard]] bool is_known(const ProofEdge& e) const { return pair(e[0], e[1]).is_known; }

  void push(const ProofEdge& e) {
    pair(e).is_known = true;
    known_.push_back(e);
  }
  void pop() {
    pair(known_.back()).is_known = false;
    known_.pop_back();
  }

  const std::vector<VertexId>& apexes(const Side& side) {
    Pair& of_side = pair(side[0], side[1]);
    if (!std::exchange(of_side.has_apexes, true)) {
      for (const VertexId x : mesh_.vertices()) {
        if (x != side[0] && x != side[1] && sight_.can_be_triangle(side[0], side[1], x)) of_side.apexes.push_back(x);
      }
    }
    return of_side.apexes;
  }

  [[nodiscard]] bool is_open(const Side& side) {
    const auto& [a, b] = side;
    if (!mesh_.find_halfedge(a, b).valid() && mesh_.find_halfedge(b, a).valid()) return false;  // outside
    const std::vector<VertexId>& all = apexes(side);
    return std::none_of(all.begin(), all.end(), [&](VertexId x) {
      return is_known(edge_between(side[0], x)) && is_known(edge_between(side[1], x));
    });
  }

  LemmaId store(Lemma lemma) {
    for (const ProofEdge& e : lemma.edges) pair(e).lemmas.push_back(lemmas_.size());
    lemmas_.push_back(std::move(lemma));
    return lemmas_.size() - 1;
  }

  /// Returns a lemma that excludes the triangle with the apex x, and has at most `most_edges` edges.
  [[nodiscard]] std::optional<LemmaId> lemma_against(const Side& side, VertexId x, std::size_t most_edges) const {
    const ProofEdge ax = edge_between(side[0], x), bx = edge_between(side[1], x);
    const auto holds = [&](const ProofEdge& e) { return is_known(e) || e == ax || e == bx; };
    for (const ProofEdge& added : {ax, bx}) {
      if (is_known(added)) continue;
      for (const LemmaId i : pair(added[0], added[1]).lemmas) {
        const std::vector<ProofEdge>& edges = lemmas_[i].edges;
        if (edges.size() <= most_edges && std::all_of(edges.begin(), edges.end(), holds)) return i;
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<ProofEdge> known_across(const ProofEdge& e) const {
    if (is_known(e)) return std::nullopt;
    const auto at = std::find_if(known_.begin(), known_.end(),
                                 [&](const ProofEdge& other) { return sight_.cross(e[0], e[1], other[0], other[1]); });
    return at == known_.end() ? std::nullopt : std::optional(*at);
  }

 private:
  const Mesh& mesh_;
  const Sight& sight_;
  std::vector<Pair> pairs_;
  std::vector<ProofEdge> known_;
  std::vector<Lemma> lemmas_;
};

}  // namespace temper
