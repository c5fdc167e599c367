// Diffusion tensors K, and the planes in which they become numbers.
//
// Two-point fluxes of −div(K ∇u) = f need dual edges at right angles to edges in the metric M = K⁻¹: e · K⁻¹ e* = 0.
// With y = B x and B = (det K)^¼ K^−½, this is a right angle of the plane, and
//
//     −div_x(K ∇_x u) = −√(det K) div_y(∇_y u).
//
// So a mesh is mapped to this plane, improved and measured there without any tensor, and mapped back. B changes no
// area. The stars of vertices and triangles do not change, and ★1 and fluxes only need the factor √(det K). Weights
// belong to the metric: mapping does not change them.
//
// Rock has another tensor in each layer. Then each triangle goes to the plane of its own tensor, and the mesh is cut
// along interfaces, where the plane changes. A vertex of an interface has a copy on each side, with its own weight:
//
//      region 0               region 0, in its plane:    a ---- b ---- c
//   a ---- b ---- c     →                                                   one copy of b and c for each side
//      region 1               region 1, in its plane:    a'--- b' ---- c'
//
// The dual edge through bc has one crossing with the interface if the weighted midpoint divides bc and b'c' in one
// ratio. So weights must keep one linear equation for each edge of the interface,
//
//     (w_b − w_c)/|bc|² = (w_b' − w_c')/|b'c'|²,
//
// with the lengths of either plane. Constant weights on each side of an interface always keep it.
//
// In space B = (det K)^⅙ K^−½ changes no volume, the factor is ∛(det K), and temper/tets/tensor.hpp has the rest.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "temper/detail/error.hpp"
#include "temper/detail/ids.hpp"
#include "temper/detail/vec.hpp"
#include "temper/mesh.hpp"

namespace temper {

/// A symmetric tensor of the plane.
struct Tensor {
  double xx = 1, xy = 0, yy = 1;

  using Vector = Vec2;
  static constexpr const char* kNames = "kxx,kxy,kyy";
  [[nodiscard]] std::array<double, 3> components() const { return {xx, xy, yy}; }
  friend Vec2 operator*(const Tensor& k, Vec2 v) { return {k.xx * v.x + k.xy * v.y, k.xy * v.x + k.yy * v.y}; }
  friend bool operator==(const Tensor&, const Tensor&) = default;
};

/// A symmetric tensor of space.
struct Tensor3 {
  double xx = 1, xy = 0, xz = 0, yy = 1, yz = 0, zz = 1;

  using Vector = Vec3;
  static constexpr const char* kNames = "kxx,kxy,kxz,kyy,kyz,kzz";
  [[nodiscard]] std::array<double, 6> components() const { return {xx, xy, xz, yy, yz, zz}; }
  friend Vec3 operator*(const Tensor3& k, Vec3 v) {
    return {k.xx * v.x + k.xy * v.y + k.xz * v.z, k.xy * v.x + k.yy * v.y + k.yz * v.z,
            k.xz * v.x + k.yz * v.y + k.zz * v.z};
  }
  friend bool operator==(const Tensor3&, const Tensor3&) = default;
};

/// The metric of a tensor K: Tensor or Tensor3.
template <class K>
class MetricOf {
 public:
  using Vector = typename K::Vector;

  /// The metric of K = 1.
  MetricOf() = default;
  /// Makes the metric of a tensor. Error: the tensor is not positive definite, not finite, or the ratio of its
  /// eigenvalues is too large for doubles (10⁸).
  [[nodiscard]] static Expected<MetricOf> of(const K& tensor);

  [[nodiscard]] const K& tensor() const { return tensor_; }
  [[nodiscard]] Vector to_metric(Vector x) const { return to_ * x; }
  [[nodiscard]] Vector from_metric(Vector y) const { return from_ * y; }
  /// The factor between ★1 and fluxes of the mapped mesh and those for K: √(det K), in space ∛(det K).
  [[nodiscard]] double strength() const { return strength_; }

  /// Says whether both have one plane: their tensors are multiples of each other, and of one Metrics.
  [[nodiscard]] bool shares_plane(const MetricOf& other) const { return to_ == other.to_; }

 private:
  template <class, class, class>
  friend class MetricsOf;
  K tensor_, to_, from_;  // K, B and its inverse
  double strength_ = 1;
};
using Metric = MetricOf<Tensor>;
template <>
Expected<Metric> Metric::of(const Tensor& tensor);
template <>
Expected<MetricOf<Tensor3>> MetricOf<Tensor3>::of(const Tensor3& tensor);

/// The metric of each cell of a mesh: one for all, or one for each. Names are those of the cells, for errors.
template <class K, class CellId, class Names>
class MetricsOf {
 public:
  using Cell = CellId;

  /// One metric for all cells.
  MetricsOf(const MetricOf<K>& one = {}) : distinct_{one} {}  // NOLINT(google-explicit-constructor): the usual case
  /// One tensor for each cell. Tensors that are multiples of each other get one plane. Error: of Metric::of, with the
  /// cell.
  [[nodiscard]] static Expected<MetricsOf> of(std::span<const K> tensors, const Names& names = {});

  /// Says whether all cells have one tensor.
  [[nodiscard]] bool is_constant() const { return of_cell_.empty(); }
  /// The number of cells with a tensor of their own; 0 if all have one.
  [[nodiscard]] std::size_t n_cells() const { return of_cell_.size(); }
  /// The number of the metric of a cell among the distinct ones.
  [[nodiscard]] std::uint32_t number(CellId t) const { return is_constant() ? 0 : of_cell_[t]; }
  [[nodiscard]] const MetricOf<K>& operator[](std::uint32_t number) const { return distinct_[number]; }
  [[nodiscard]] const MetricOf<K>& of(CellId t) const { return distinct_[number(t)]; }

 private:
  std::vector<MetricOf<K>> distinct_;
  IdVector<CellId, std::uint32_t> of_cell_;
};
using Metrics = MetricsOf<Tensor, TriangleId, InputNames>;

/// A mesh in the planes of its metrics, cut along interfaces, where the plane changes. Its pieces may lie on top of
/// each other. Without interfaces it has the numbers of the mesh that it was made from. Otherwise cells and their
/// corners do. Vertices, too, and the further copies of interface vertices come after them.
template <class AnyMesh, class AnyMetrics>
struct MetricMeshOf {
  AnyMesh mesh;
  AnyMetrics metrics;
  /// Of each vertex, the first copy of it in `mesh`: its number before the cut. Empty: there are no interfaces.
  IdVector<VertexId, VertexId> first_copies;
  /// The region before the cut, and the metric, of each region number of `mesh`. Empty: the regions stay, and there is
  /// one metric.
  struct Region {
    std::int32_t region;
    std::uint32_t metric;
  };
  std::vector<Region> regions;

  [[nodiscard]] bool is_cut() const { return !first_copies.empty(); }
  [[nodiscard]] VertexId first_copy(VertexId v) const { return is_cut() ? first_copies[v] : v; }
  [[nodiscard]] const auto& metric(typename AnyMetrics::Cell t) const {
    return metrics[regions.empty() ? 0 : regions[static_cast<std::size_t>(mesh.region(t))].metric];
  }
};
using MetricMesh = MetricMeshOf<Mesh, Metrics>;

/// A mesh in its own plane, from its pieces. Tags of faces and lines have the numbers that they have in the pieces.
template <class AnyMesh, class K>
struct WholeMeshOf {
  AnyMesh mesh;
  /// Number of each vertex before the change; empty: the same numbers.
  IdVector<VertexId, VertexId> vertices;
  /// Weight of each corner of each cell; empty without interfaces. The mesh itself has at each vertex the weight of the
  /// first copy.
  std::vector<double> corner_weights;
  std::vector<K> tensors;  ///< Tensor of each cell; empty if all have one
};
using WholeMesh = WholeMeshOf<Mesh, Tensor>;

/// An edge of an interface: its halfedge in the mesh on either side.
struct SeamEdge {
  HalfedgeId one, other;
};
/// The edges of interfaces, each once, ascending by `one` < `other`. O(n log n).
[[nodiscard]] std::vector<SeamEdge> seams_of(const MetricMesh& pieces);

/// Maps a mesh to the planes of its metrics, and cuts it along their interfaces. Flags and weights stay.
/// `corner_weights`: the weight of each corner of each triangle, for meshes with interfaces; empty: those of the
/// vertices. Errors, in the user's numbers: a mesh of the sphere; a triangle that turns over by rounding; not one
/// tensor or not three weights for each triangle. O(n).
[[nodiscard]] Expected<MetricMesh> mapped(const Mesh& mesh, const Metrics& metrics,
                                          std::span<const double> corner_weights = {}, const InputNames& names = {});

/// The pieces after a change of their mesh. `vertices`: number of each vertex before it, as in OptimizeReport; empty:
/// the same numbers.
[[nodiscard]] MetricMesh with_mesh(const MetricMesh& pieces, Mesh changed,
                                   const IdVector<VertexId, VertexId>& vertices = {});

/// Joins the pieces of a changed mesh, and maps them back to the plane of `original`. Vertices that have not moved
/// since mapped(original), such as boundary, fixed and interface vertices, get their place from there, bit for bit.
/// `pieces`: of mapped(original). `vertices`: number there of each vertex of `changed`; empty: the same numbers. Errors
/// as for mapped().
[[nodiscard]] Expected<WholeMesh> mapped_back(const MetricMesh& changed, const Mesh& original, const MetricMesh& pieces,
                                              const IdVector<VertexId, VertexId>& vertices = {});

}  // namespace temper
