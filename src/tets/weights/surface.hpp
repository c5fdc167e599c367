// The edges of the surface and of interfaces between regions, with the constraints on weights within their faces.
//
//             r                 h_r, h_s: heights of the orthocenters of the faces pqr and qps over pq
//           /   \               flat:  c h_r + h_s ≥ 0, with c the cosine of the angle between the normals
//          p-----q              ridge: h_r ≥ 0, h_s ≥ 0
//           \   /
//             s
//
// With these constraints, regular faces and heights over the surface that are not negative, no edge of the surface has
// a negative coefficient: its dual ends at the surface, in a line h_r + h_s long.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "temper/feasibility.hpp"
#include "temper/tets/mesh.hpp"

namespace temper::tets {

/// The constraints within surface and interfaces, by the cells that have their faces.
class SurfaceRows {
 public:
  SurfaceRows() = default;
  explicit SurfaceRows(const TetMesh& mesh);

  [[nodiscard]] const WeightConstraint& constraint(std::uint32_t row) const { return rows_[row].constraint; }
  /// The rows of which a tetrahedron has a face.
  [[nodiscard]] std::span<const std::uint32_t> of(TetId t) const {
    if (start_.empty()) return {};
    return {list_.data() + start_[t.index], list_.data() + start_[t.index + 1]};
  }
  /// Says whether tetrahedra with has(t) have all faces of the row.
  template <class Has>
  [[nodiscard]] bool has_all(const TetMesh& mesh, std::uint32_t row, const Has& has) const {
    for (const HalffaceId h : rows_[row].faces) {
      if (!h.valid() || has(TetMesh::tetrahedron(h))) continue;
      if (mesh.is_boundary(h) || !has(TetMesh::tetrahedron(mesh.twin(h)))) return false;
    }
    return true;
  }

 private:
  struct Row {
    WeightConstraint constraint;
    std::array<HalffaceId, 2> faces;  ///< representatives; a ridge has one
  };
  std::vector<Row> rows_;
  std::vector<std::uint32_t> start_, list_;  ///< of the rows of each tetrahedron
};

}  // namespace temper::tets
