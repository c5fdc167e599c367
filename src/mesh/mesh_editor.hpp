// The only way to write a mesh's connectivity entry by entry; users of the library have topology.hpp instead.
#pragma once

#include "temper/mesh.hpp"

namespace temper {

/// MeshEditor writes single entries of a mesh's arrays and checks nothing: between two of its calls the mesh may be
/// broken. Its users must leave a mesh in which validate() finds nothing. Making one costs nothing.
class MeshEditor {
 public:
  explicit MeshEditor(Mesh& mesh) : mesh_(mesh) {}

  /// A mesh of that many isolated vertices at 0 and triangles without corners.
  [[nodiscard]] static Mesh blank(const Space& space, std::size_t n_vertices, std::size_t n_triangles);
  /// The new vertex is in no triangle.
  VertexId add_vertex(WeightedPoint p);
  /// Three halfedges without twins; the caller links them.
  TriangleId add_triangle(std::array<VertexId, 3> corners, std::int32_t region);
  void set_corner(HalfedgeId h, VertexId v) { mesh_.corners_[h] = v; }
  /// Makes a and b twins; b may be invalid (a becomes boundary). Flags stay as they are.
  void link(HalfedgeId a, HalfedgeId b) {
    mesh_.twins_[a] = b;
    if (b.valid()) mesh_.twins_[b] = a;
  }
  /// Makes every halfedge a boundary halfedge.
  void unlink_all() { mesh_.twins_.assign(mesh_.n_halfedges(), HalfedgeId()); }
  void repair_outgoing() { mesh_.repair_outgoing(); }
  void set_outgoing(VertexId v, HalfedgeId h) { mesh_.record(v).outgoing = h.index; }
  /// Marks a triangle for compact(). Its neighbors get a boundary there; the caller must repair outgoing() of its
  /// corners.
  void erase(TriangleId t);

 private:
  Mesh& mesh_;
};

}  // namespace temper
