// The pieces that cells have in a tetrahedron: those of power cells are cut by the planes between vertices.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "temper/tets/transfer.hpp"
#include "tets/transfer/polyhedron.hpp"

namespace temper::tets {

struct TetPiece {
  std::uint32_t cell = 0;
  Polyhedron body;
  std::vector<HalfSpace> cuts;  ///< planes between this cell and others
  double volume = 0, negligible = 0;
  Vec3 center;  ///< of a sphere around it
  double radius = 0;
};

/// A tetrahedron of a mesh and its pieces, as seen from its first corner.
struct CutTet {
  Vec3 origin;
  std::array<Vec3, 4> corners;
  std::array<HalfSpace, 4> sides;  ///< inner sides of the faces opposite the corners
  std::vector<TetPiece> pieces;
};

/// The neighbors of each vertex, ascending.
class VertexNeighbors {
 public:
  explicit VertexNeighbors(const TetMesh& mesh);
  [[nodiscard]] std::span<const VertexId> operator[](VertexId v) const {
    return std::span(all_).subspan(starts_[v.index], starts_[v.index + 1] - starts_[v.index]);
  }

 private:
  std::vector<std::size_t> starts_;
  std::vector<VertexId> all_;
};

/// Cuts the tetrahedra of a mesh, and keeps what it has cut: neighbors ask for the same ones.
class TetCuts {
 public:
  /// `neighbors` are needed for power cells.
  TetCuts(const TetMesh& mesh, CellsOf of, const VertexNeighbors* neighbors)
      : mesh_(mesh), of_(of), neighbors_(neighbors) {}

  [[nodiscard]] CutTet cut(TetId t);
  [[nodiscard]] const CutTet& kept(TetId t) {
    const auto [at, is_new] = kept_.try_emplace(t.index);
    if (is_new) at->second = cut(t);
    return at->second;
  }

 private:
  struct Candidate {
    VertexId vertex;
    Vec3 at;
    double weight = 0;
    TetPiece piece;
  };
  void cut_for_vertices(TetId t, CutTet& cut);
  void add(VertexId v, Vec3 origin);
  [[nodiscard]] bool wins_anywhere(const Candidate& added) const;
  static void divide(TetPiece& piece, const Candidate& owner, const Candidate& other);

  const TetMesh& mesh_;
  CellsOf of_;
  const VertexNeighbors* neighbors_;
  Polyhedron whole_;
  std::vector<Candidate> candidates_;  // of the tetrahedron at hand
  std::unordered_map<std::uint32_t, CutTet> kept_;
};

}  // namespace temper::tets
