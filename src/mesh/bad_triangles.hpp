// The triangles that are not well-centered: optimization repairs them, explain explains them, and meshing counts them.
// Also obtuse triangles, the erased triangles, which loops over all triangles must skip, and the halves of
// quadrilaterals.
#pragma once

#include <vector>

#include "mesh/predicates.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// is_centered_half says whether the orthocenter of half a quadrilateral is inside its two sides. It may be beyond the
/// diagonal. On a rectangle both halves have it in the middle.
///
///     d-------c
///     | o   / |    o is inside da and cd
///     |   /   |
///     a-------b
[[nodiscard]] inline bool is_centered_half(const Mesh& mesh, TriangleId t) {
  const auto p = mesh.points(t);
  if (inlined::orientation(mesh.space(), p[0], p[1], p[2]) != Sign::positive) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    if (mesh.is_diagonal(Mesh::halfedge(t, static_cast<int>(k)))) continue;
    const WeightedPoint &a = p.at(k), &b = p.at((k + 1) % 3), &c = p.at((k + 2) % 3);
    if (signed_height_sign(mesh.space(), a, b, c) != Sign::positive || !inlined::crosses_edge(mesh.space(), a, b))
      return false;
  }
  return true;
}
/// stays says whether nothing can make t well-centered, exactly. All of its corners keep their places and weights, or
/// two of them do and the dual of the edge between them does not cross it.
[[nodiscard]] inline bool stays(const Mesh& mesh, TriangleId t) {
  int n_frozen = 0, free = 0;
  for (int k = 0; k < 3; ++k) {
    if (mesh.is_frozen(mesh.origin(Mesh::halfedge(t, k))))
      ++n_frozen;
    else
      free = k;
  }
  if (n_frozen < 2) return false;
  const HalfedgeId across = Mesh::halfedge(t, (free + 1) % 3);
  return n_frozen == 3 || !inlined::crosses_edge(mesh.space(), mesh.point(mesh.origin(across)),
                                                 mesh.point(mesh.target(across), mesh.point(mesh.origin(across))));
}
/// is_bad says whether triangle t is not well-centered, exactly. An erased triangle is not bad, nor one that stays.
[[nodiscard]] inline bool is_bad(const Mesh& mesh, TriangleId t) {
  if (mesh.is_erased(t) || inlined::is_well_centered(mesh, t) || stays(mesh, t)) return false;
  return !mesh.is_half(t) || !is_centered_half(mesh, t);
}
/// bad_triangles lists the triangles for which is_bad holds, in ascending order.
[[nodiscard]] inline std::vector<TriangleId> bad_triangles(const Mesh& mesh) {
  std::vector<TriangleId> bad;
  for (const TriangleId t : mesh.triangles()) {
    if (is_bad(mesh, t)) bad.push_back(t);
  }
  return bad;
}

/// is_obtuse says whether triangle t has an angle above 90°, exactly. At a diagonal there is no angle of a cell.
[[nodiscard]] inline bool is_obtuse(const Mesh& mesh, TriangleId t) {
  const auto p = mesh.points(t);
  const auto without_weight = [&](std::size_t k) { return as_point(mesh.space().place(p.at(k % 3))); };
  for (std::size_t k = 0; k < 3; ++k) {
    if (mesh.is_diagonal(Mesh::halfedge(t, static_cast<int>(k)))) continue;
    // Without weights the center is across from an obtuse angle.
    if (signed_height_sign(mesh.space(), without_weight(k), without_weight(k + 1), without_weight(k + 2)) ==
        Sign::negative)
      return true;
  }
  return false;
}

/// Returns true if the mesh has a quadrilateral. O(n).
[[nodiscard]] inline bool has_quadrilaterals(const Mesh& mesh) {
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.joins_halves(h)) return true;
  }
  return false;
}

/// Returns true if a triangle of the mesh is erased: it stays until Mesh::compact drops it. O(n).
[[nodiscard]] inline bool has_erased_triangles(const Mesh& mesh) {
  for (const TriangleId t : mesh.triangles()) {
    if (mesh.is_erased(t)) return true;
  }
  return false;
}

}  // namespace temper
