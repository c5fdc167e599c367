// The next mesh: a mesh without some tetrahedra and vertices, and with others in their place.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "temper/tets/mesh.hpp"

namespace temper::tets {

/// The parts of a mesh through changes of connectivity. A name is the number in the mesh where the changes began.
struct Names {
  /// The name of each vertex. New vertices have names from the number of vertices of that mesh on.
  IdVector<VertexId, VertexId> vertices;
  VertexId next;  ///< Name of the next new vertex
  /// The name of each tagged face and tagged line, in ascending order: pieces of one have the same.
  std::vector<std::uint32_t> faces, lines;

  Names() = default;
  /// All parts are their own.
  explicit Names(const TetMesh& mesh);
};

/// The numbers of corners, by a table.
template <std::size_t N>
[[nodiscard]] std::array<std::int32_t, N> numbers_of(const std::array<VertexId, N>& corners,
                                                     const IdVector<VertexId, std::int32_t>& number) {
  std::array<std::int32_t, N> result;
  for (std::size_t k = 0; k < N; ++k) result[k] = number[corners[k]];
  return result;
}

class NextMesh {
 public:
  using Number = std::int32_t;  ///< of a vertex in the next mesh

  /// Without these tetrahedra and vertices.
  NextMesh(const TetMesh& mesh, const Names& names, const IdVector<TetId, std::uint8_t>& gone,
           const IdVector<VertexId, std::uint8_t>& removed);

  /// The next number of a vertex that stays.
  [[nodiscard]] Number number(VertexId v) const { return number_[v]; }
  template <std::size_t N>
  [[nodiscard]] std::array<Number, N> numbers(const std::array<VertexId, N>& corners) const {
    return numbers_of(corners, number_);
  }
  [[nodiscard]] Number add_vertex(const WeightedPoint& p) { return add_vertex(p, VertexId(names_.next.index++)); }
  void set_point(Number v, const WeightedPoint& p);
  void add_tetrahedron(const std::array<Number, 4>& corners, std::int32_t region);
  /// Takes a tagged face or line away, so that pieces can take its name. False: this was done before.
  bool drop_face(std::size_t i) { return !std::exchange(faces_[i].dropped, true); }
  bool drop_line(std::size_t i) { return !std::exchange(lines_[i].dropped, true); }
  void add_face(const std::array<Number, 3>& corners, std::int32_t tag, std::uint32_t name) {
    faces_.push_back({corners, tag, name});
  }
  void add_line(const std::array<Number, 2>& ends, std::int32_t tag, std::uint32_t name) {
    lines_.push_back({ends, tag, name});
  }
  /// Replaces each tagged face and line with these corners, or among its own, by its pieces around a new vertex.
  void split(const std::vector<VertexId>& corners, Number at);

  /// The mesh, and its names. Nothing if a tetrahedron is not positive.
  [[nodiscard]] std::optional<std::pair<TetMesh, Names>> build();

 private:
  Number add_vertex(const WeightedPoint& p, VertexId name);

  template <std::size_t N>
  struct Tagged {
    std::array<Number, N> corners;
    std::int32_t tag = 0;
    std::uint32_t name = 0;
    bool dropped = false;
  };

  IdVector<VertexId, Number> number_;  // −1: removed
  std::vector<Vec3> points_;
  std::vector<double> weights_;
  std::vector<std::array<Number, 4>> tetrahedra_;
  std::vector<std::int32_t> regions_;
  std::vector<Tagged<3>> faces_;
  std::vector<Tagged<2>> lines_;
  std::vector<Number> marked_, fixed_;
  std::vector<std::int32_t> point_tags_;
  Names names_;
};

}  // namespace temper::tets
