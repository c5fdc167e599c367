// Size: how long edges are meant to be where, and how far those of a mesh are from that.
//
// A size field gives a length at every point: linear on the triangles of a mesh, from values at its vertices. The
// size of a mesh at a vertex is the edge of an equilateral triangle that has the mean area of the triangles there. So
// it follows how densely vertices lie, and does not shrink, as the mean length of edges does, where badly shaped
// triangles become better ones. A mesh has a size field of its own: its sizes at its vertices. What an optimization
// does to them is told by the ratio of local size to field, 1 everywhere before it, and by the gradation: how fast
// sizes change from vertex to vertex.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "temper/detail/error.hpp"
#include "temper/mesh.hpp"

namespace temper {

class Executor;

/// √(4/√3 A), A the mean area of the triangles at v. Precondition: v is not isolated. O(degree).
[[nodiscard]] double local_size(const Mesh& mesh, VertexId v);
/// That of each vertex, 0 where it is isolated. O(n).
[[nodiscard]] IdVector<VertexId, double> local_sizes(const Mesh& mesh, Executor* executor = nullptr);

/// A length at every point of the plane or of the sphere: linear on each triangle of a mesh
/// (temper/detail/location.hpp); beyond the mesh, that of its nearest point. An immutable value, cheap to copy, and
/// safe to ask from several threads.
class SizeField {
 public:
  /// The field of these sizes at the vertices of the mesh, which is copied. Errors name the vertex in the user's
  /// numbering: another number of sizes than of vertices; a size that is not finite and positive.
  [[nodiscard]] static Expected<SizeField> from_values(const Mesh& mesh, std::span<const double> sizes,
                                                       const InputNames* names = nullptr);

  /// The value of the field at a point.
  struct Sample {
    double size = 0;
    TriangleId triangle;   ///< of the field's mesh, in or next to which the point is: the hint for a point nearby
    bool outside = false;  ///< beyond the mesh: extended
  };
  /// The field at a point p of its mesh's space, whose weight does not count. Exactly the given value at a vertex; a
  /// function of p alone, whatever the hint. About O(distance from the hint in triangles), O(log n) without or with a
  /// bad one.
  [[nodiscard]] Sample at(const WeightedPoint& p, TriangleId hint = {}) const;
  /// At a point of the plane.
  [[nodiscard]] Sample at(Vec2 p, TriangleId hint = {}) const { return at(WeightedPoint{p.x, p.y, 0}, hint); }

  /// The mesh it is linear on. Its vertices and triangles have the numbers they were given with.
  [[nodiscard]] const Mesh& mesh() const;
  /// The size at a vertex of that mesh.
  [[nodiscard]] double at(VertexId v) const;

 private:
  friend SizeField input_size_field(const Mesh& mesh);
  friend SizeField input_size_field_of(const Mesh& mesh, Executor* executor);
  struct Data;
  explicit SizeField(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

  std::shared_ptr<const Data> data_;
};

/// The field of the mesh's own local sizes. Precondition: no erased triangles. O(n log n).
[[nodiscard]] SizeField input_size_field(const Mesh& mesh);
/// The same, looking at the mesh instead of copying it: valid as long as the mesh is there and is not changed.
[[nodiscard]] SizeField input_size_field_of(const Mesh& mesh, Executor* executor = nullptr);

/// The length of an interior edge and that of its dual, over the mean of the local sizes at its ends: equilateral
/// triangles have 1 and 1/√3. The least of them bound the time steps of explicit schemes.
struct RelativeLengths {
  double edge = 0;
  double dual = 0;  ///< negative where the dual edge is
};
/// Precondition: h is not on the boundary, and `sizes` are local_sizes() of the mesh.
[[nodiscard]] RelativeLengths relative_lengths(const Mesh& mesh, const IdVector<VertexId, double>& sizes, HalfedgeId h);

/// The spread of many numbers: percentiles by nearest rank. All 0 when there are none.
struct Spread {
  double min = 0, p05 = 0, median = 0, p95 = 0, max = 0;
};
[[nodiscard]] Spread spread(std::vector<double> values);

/// One mesh, compared with a size field. No number depends on the unit of length.
struct SizeReport {
  Spread over_field;              ///< at each vertex, local size over field: the band that the sizes are in
  Spread gradation;               ///< at each edge, the greater over the smaller of the local sizes at its two ends
  double largest_edge_ratio = 1;  ///< over triangles, longest over shortest edge
  std::size_t outside = 0;        ///< vertices where the field was extended

  /// B of the least band [1/B, B] that holds all sizes over field.
  [[nodiscard]] double band() const;
};
/// `near`: for each vertex of the mesh a vertex of the field's mesh to look for it from; empty: the same number, when
/// both have as many, else anywhere. Changes the time it takes, nothing else. Precondition: no erased triangles; the
/// mesh and that of the field lie in the plane, or on spheres.
[[nodiscard]] SizeReport measure_size(const Mesh& mesh, const SizeField& field, Executor* executor = nullptr,
                                      const IdVector<VertexId, VertexId>& near = {});

}  // namespace temper
