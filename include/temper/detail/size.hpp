// Size: the desired length of edges at each place, and how far the edges of a mesh differ from it.
//
// A size field gives a length at every point. It is linear on the triangles of a mesh, between values at its vertices.
// The size of a mesh at a vertex is the edge of an equilateral triangle with the mean area of the triangles there. So
// it follows the density of vertices. It does not shrink when badly shaped triangles become better, as the mean length
// of edges does. A mesh has its own size field: its sizes at its vertices. Two numbers describe how an optimization
// changes sizes. One is the ratio of local size to field, which is 1 everywhere before. The other is the gradation: how
// fast sizes change from vertex to vertex.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "temper/detail/error.hpp"
#include "temper/mesh.hpp"

namespace temper {

class Executor;
struct ReportTable;

/// The local size √(4/√3 A), with A the mean area of the triangles at v. Precondition: v is not isolated. O(degree).
[[nodiscard]] double local_size(const Mesh& mesh, VertexId v);
/// The local size of each vertex, 0 for isolated vertices. O(n).
[[nodiscard]] IdVector<VertexId, double> local_sizes(const Mesh& mesh, Executor* executor = nullptr);

/// A length at every point of the plane or of the sphere. It is linear on each triangle of a mesh
/// (temper/detail/location.hpp); outside the mesh it is the value at the nearest point. It is immutable and cheap to
/// copy, and several threads may use it.
class SizeField {
 public:
  /// Makes the field of these sizes at the vertices of the mesh, which is copied. Errors name the vertex in the user's
  /// numbering: the numbers of sizes and vertices differ; a size is not finite and positive.
  [[nodiscard]] static Expected<SizeField> from_values(const Mesh& mesh, std::span<const double> sizes,
                                                       const InputNames* names = nullptr);

  /// The value of the field at a point.
  struct Sample {
    double size = 0;
    TriangleId triangle;   ///< Triangle of the field's mesh in or next to which the point is: a hint for a point nearby
    bool outside = false;  ///< The point is outside the mesh: the field is extended
  };
  /// The field at a point p of its mesh's space. At a vertex it is exactly the given value. It depends on p alone: the
  /// hint and the weight of p do not count. About O(distance from the hint in triangles), O(log n) without a hint or
  /// with a bad one.
  [[nodiscard]] Sample at(const WeightedPoint& p, TriangleId hint = {}) const;
  /// The field at a point of the plane.
  [[nodiscard]] Sample at(Vec2 p, TriangleId hint = {}) const { return at(WeightedPoint{p.x, p.y, 0}, hint); }

  /// The mesh on which the field is linear. Its vertices and triangles have their original numbers.
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
/// The field of the local sizes without a copy of the mesh: the mesh must exist and not change.
[[nodiscard]] SizeField input_size_field_of(const Mesh& mesh, Executor* executor = nullptr);

inline constexpr double kGravity = 9.81;  ///< g [m/s²]: long waves have the speed √(g H) in water of depth H

/// Rules that make sizes from depths of water. A wave of the period T in water of depth H has the length T √(g H); in a
/// time step Δt it goes √(g H) Δt.
struct DepthSizes {
  double per_wavelength = 0;  ///< Least number of edges per wavelength; 0: no rule
  double period = 44714.16;   ///< Period of the wave [s]: by default of the principal lunar tide M2, 12.4206 h
  double time_step = 0;       ///< Edges are at least √(g H) Δt / courant long, with this Δt [s]; 0: no rule
  double courant = 1;         ///< Largest Courant number of the time step
  double least = 0;           ///< Least size, > 0 [m]
  double largest = 0;         ///< Largest size [m]; 0: no bound
};
/// The size at each depth H [m], positive down: T √(g H) / per_wavelength, between `least` and `largest`, and not below
/// √(g H) Δt / courant, which counts most. Land (H ≤ 0) and missing depths (NaN) have the least size.
/// Errors: no rule; numbers that are not positive or not finite; `largest` below `least`. O(n).
[[nodiscard]] Expected<std::vector<double>> sizes_from_depths(std::span<const double> depths, const DepthSizes& rules);

/// The lengths of an interior edge and of its dual, over the mean of the local sizes at its ends. Equilateral triangles
/// have 1 and 1/√3. The least of them bound the time steps of explicit schemes.
struct RelativeLengths {
  double edge = 0;
  double dual = 0;  ///< Relative length of the dual edge, negative if its length is
};
/// Precondition: h is not on the boundary, and `sizes` are local_sizes() of the mesh.
[[nodiscard]] RelativeLengths relative_lengths(const Mesh& mesh, const IdVector<VertexId, double>& sizes, HalfedgeId h);
/// Computes the local sizes of both ends itself, with the same bits. O(degree).
[[nodiscard]] RelativeLengths relative_lengths(const Mesh& mesh, HalfedgeId h);

/// The distribution of many numbers: percentiles by nearest rank. All are 0 if there are no numbers.
struct Spread {
  double min = 0, p05 = 0, median = 0, p95 = 0, max = 0;
};
[[nodiscard]] const ReportTable& table_of(const Spread*);
[[nodiscard]] Spread spread(std::vector<double> values);

/// The comparison of a mesh with a size field. No number depends on the unit of length.
struct SizeReport {
  Spread over_field;              ///< Local size over field at the vertices: the band that holds the sizes
  Spread gradation;               ///< Ratio of the greater to the smaller local size at the two ends of each edge
  double largest_edge_ratio = 1;  ///< Largest ratio of the longest to the shortest edge of a triangle
  std::size_t vertices_outside_field = 0;  ///< Number of vertices outside the field's mesh

  /// B of the smallest band [1/B, B] that holds all ratios of size to field.
  [[nodiscard]] double band() const;
};
[[nodiscard]] const ReportTable& table_of(const SizeReport*);
/// Compares the sizes of a mesh with a field. `nearby`: for each vertex a vertex of the field's mesh from which the
/// search begins. If it is empty and both meshes have the same number of vertices, it is the same number; else
/// anywhere. It affects only the time. Preconditions: no erased triangles; the mesh and the field's mesh lie in the
/// plane, or on spheres.
[[nodiscard]] SizeReport measure_size(const Mesh& mesh, const SizeField& field, Executor* executor = nullptr,
                                      const IdVector<VertexId, VertexId>& nearby = {});

}  // namespace temper
