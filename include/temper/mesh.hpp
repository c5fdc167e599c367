// The weighted triangle mesh: a copyable value of flat arrays.
//
// Half-edges are based on triangles: halfedge 3 t + k runs from corner k to corner k + 1 of triangle t. So next,
// previous and triangle are arithmetic, and only the origin and the twin are stored. All triangles are
// counter-clockwise. A halfedge without twin lies on the boundary, with the domain on its left.
//
//            c                halfedge h: a → b        opposite(h) = c
//          /   \              next(h):    b → c        prev(h):  c → a
//         /  t  \             twin(h):    b → a in the triangle below, or invalid on the boundary
//        a ----> b
//            h
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "temper/detail/error.hpp"
#include "temper/detail/ids.hpp"
#include "temper/detail/space.hpp"
#include "temper/detail/vec.hpp"

namespace temper {

class Executor;

/// The user's numbers of points and triangles, for errors. The base class counts from 0 and has no file. (It is
/// inline, so that derived classes find its type information wherever they are compiled: the library is built without
/// RTTI.)
class InputNames {
 public:
  virtual ~InputNames() = default;
  [[nodiscard]] virtual std::string point(std::size_t index) const { return "point " + std::to_string(index); }
  [[nodiscard]] virtual std::string triangle(std::size_t index) const { return "triangle " + std::to_string(index); }
  /// The place of the point in its file, such as "coast.msh:7", or nothing.
  [[nodiscard]] virtual std::string point_where(std::size_t /*index*/) const { return {}; }
  [[nodiscard]] virtual std::string triangle_where(std::size_t /*index*/) const { return {}; }
};

/// Arrays that make a mesh. Mesh::build reads the spans only during the call.
struct MeshInput {
  std::span<const Vec2> points = {};     ///< Points of the plane, n of them
  std::span<const double> weights = {};  ///< Weights of the points [length²]; empty: all zero
  /// Corners of the m triangles, 0-based, in either orientation.
  std::span<const std::array<std::int32_t, 3>> triangles = {};
  std::span<const std::array<std::int32_t, 2>> constrained_edges = {};  ///< Edges that must never flip, 0-based
  std::span<const std::int32_t> regions = {};         ///< Region numbers of the triangles; empty: all zero
  std::span<const std::int32_t> fixed_vertices = {};  ///< Vertices that must never move, 0-based
  const InputNames* names = nullptr;                  ///< Numbering of the user, for errors
  Executor* executor = nullptr;                       ///< Threads for the checks; the result does not depend on them
  Space space = {};  ///< Space of the points; for the periodic plane any image of each point
  /// Points of the sphere, n of them, instead of points; at its radius to 1 in 10⁶.
  std::span<const Vec3> sphere_points = {};
};

/// One number per id, usually all zero: the array exists only after a number differs from zero. It does not store the
/// number of ids, so the caller that sets a number passes it.
template <class IdType, class T>
class ZeroUntilSet {
 public:
  [[nodiscard]] T operator[](IdType id) const { return values_.empty() ? T() : values_[id.index]; }
  void set(IdType id, T value, std::size_t size) {
    if (values_.empty()) {
      if (value == T()) return;
      values_.resize(size);
    }
    values_[id.index] = value;
  }
  /// Appends the number of the next id, after `size` others.
  void push_back(T value, std::size_t size) {
    if (values_.empty() && value == T()) return;
    values_.resize(size);
    values_.push_back(value);
  }
  /// Keeps the first `size` numbers.
  void truncate(std::size_t size) {
    if (!values_.empty()) values_.resize(size);
  }
  [[nodiscard]] bool all_zero() const { return values_.empty(); }
  [[nodiscard]] bool has_size(std::size_t size) const { return values_.empty() || values_.size() == size; }
  [[nodiscard]] std::size_t memory_bytes() const { return values_.size() * sizeof(T); }
  /// An array of zeros equals no array.
  friend bool operator==(const ZeroUntilSet& a, const ZeroUntilSet& b) {
    if (a.values_.size() == b.values_.size()) return a.values_ == b.values_;
    return a.is_zero() && b.is_zero();
  }

 private:
  [[nodiscard]] bool is_zero() const {
    for (const T value : values_) {
      if (value != T()) return false;
    }
    return true;
  }
  std::vector<T> values_;
};

class Mesh {
 public:
  Mesh() = default;

  /// Builds a mesh and checks it. Clockwise triangles are reversed and counted. Edges between different regions become
  /// constrained. Weights need not be regular. O(n log n).
  ///
  /// The checks are:
  ///   - finite coordinates, indices in range, no duplicate or unused point, no triangle of zero area
  ///   - at most two triangles per edge, one fan per vertex
  ///   - every interior star winds once, no crossing boundary, no component on top of another
  ///
  /// On the sphere a mesh may be closed; its edges are arcs of less than half a great circle. In the periodic plane it
  /// may be closed too; there its triangles must fit into half a period along each axis, and it must be connected.
  [[nodiscard]] static Expected<struct BuiltMesh> build(const MeshInput& input);

  // --- sizes: of the arrays, erased triangles and isolated vertices included ------------------------
  [[nodiscard]] std::size_t n_vertices() const { return vertices_.size(); }
  [[nodiscard]] std::size_t n_triangles() const { return corners_.size() / 3; }
  [[nodiscard]] std::size_t n_halfedges() const { return corners_.size(); }
  [[nodiscard]] IdRange<VertexId> vertices() const { return IdRange<VertexId>(n_vertices()); }
  [[nodiscard]] IdRange<TriangleId> triangles() const { return IdRange<TriangleId>(n_triangles()); }
  [[nodiscard]] IdRange<HalfedgeId> halfedges() const { return IdRange<HalfedgeId>(n_halfedges()); }

  /// The space that the mesh lies in.
  [[nodiscard]] const Space& space() const { return space_; }
  /// Sets the space, for other units of length. The caller then sets all points in these units by set_point().
  void set_space(const Space& space) { space_ = space; }

  // --- vertices ----------------------------------------------------------------------------------
  /// The point as it is stored: x, y, w in the plane, and X, Y, Z of the weighted vector on the sphere (space.hpp).
  [[nodiscard]] WeightedPoint point(VertexId v) const { return {record(v).x, record(v).y, record(v).w}; }
  void set_point(VertexId v, WeightedPoint p) { record(v).x = p.x, record(v).y = p.y, record(v).w = p.w; }
  [[nodiscard]] double weight(VertexId v) const { return space_.weight(point(v)); }
  void set_weight(VertexId v, double w) { set_point(v, space_.with_weight(point(v), w)); }
  /// The image of v that is nearest to a point. In spaces without images it is the point of v. If a formula takes
  /// several points of one mesh, get all but the first this way.
  [[nodiscard]] WeightedPoint point(VertexId v, const WeightedPoint& nearby) const {
    return space_.is_periodic() ? space_.image(point(v), nearby) : point(v);
  }
  /// The images of the corners that are near each other, as seen from the first corner.
  [[nodiscard]] std::array<WeightedPoint, 3> points(VertexId a, VertexId b, VertexId c) const {
    const WeightedPoint p = point(a);
    return {p, point(b, p), point(c, p)};
  }
  [[nodiscard]] std::array<WeightedPoint, 3> points(TriangleId t) const {
    const auto [a, b, c] = corners(t);
    return points(a, b, c);
  }
  /// Precondition of the next two functions: the mesh lies in the plane.
  [[nodiscard]] Vec2 position(VertexId v) const { return {record(v).x, record(v).y}; }
  void set_position(VertexId v, Vec2 p) { record(v).x = p.x, record(v).y = p.y; }
  /// The weighted vector P of a vertex. Precondition: the mesh lies on the sphere.
  [[nodiscard]] Vec3 weighted_vector(VertexId v) const { return as_vector(point(v)); }
  /// Says whether the user fixed the vertex at its place. (Boundary vertices stay without this flag.)
  [[nodiscard]] bool is_fixed(VertexId v) const { return (record(v).flags & (kFixed | kFrozen)) != 0; }
  void set_fixed(VertexId v, bool fixed);
  /// Says whether the place and the weight of a vertex stay: a dual that must stay depends on them. It is fixed, too.
  [[nodiscard]] bool is_frozen(VertexId v) const { return (record(v).flags & kFrozen) != 0; }
  void set_frozen(VertexId v, bool frozen = true);
  /// Says whether both ends of the edge of h are frozen: no vertex is inserted on it.
  [[nodiscard]] bool is_frozen(HalfedgeId h) const { return is_frozen(origin(h)) && is_frozen(target(h)); }
  /// Precondition: v is not isolated.
  [[nodiscard]] bool is_boundary(VertexId v) const { return !twin(outgoing(v)).valid(); }
  /// Says whether v is in no triangle: just added, or removed and still there until compact().
  [[nodiscard]] bool is_isolated(VertexId v) const { return !outgoing(v).valid(); }

  // --- halfedges ---------------------------------------------------------------------------------
  [[nodiscard]] static constexpr HalfedgeId next(HalfedgeId h) {
    return HalfedgeId(h.index + (h.index % 3 == 2 ? -2U : 1U));
  }
  [[nodiscard]] static constexpr HalfedgeId prev(HalfedgeId h) {
    return HalfedgeId(h.index + (h.index % 3 == 0 ? 2U : -1U));
  }
  [[nodiscard]] static constexpr TriangleId triangle(HalfedgeId h) { return TriangleId(h.index / 3); }
  [[nodiscard]] static constexpr HalfedgeId halfedge(TriangleId t, int k) {
    return HalfedgeId(3 * std::size_t{t.index} + std::size_t(k));
  }
  [[nodiscard]] HalfedgeId twin(HalfedgeId h) const { return twins_[h]; }
  [[nodiscard]] VertexId origin(HalfedgeId h) const { return corners_[h]; }
  [[nodiscard]] VertexId target(HalfedgeId h) const { return corners_[next(h)]; }
  /// The corner opposite h in its triangle.
  [[nodiscard]] VertexId opposite(HalfedgeId h) const { return corners_[prev(h)]; }
  [[nodiscard]] bool is_boundary(HalfedgeId h) const { return !twin(h).valid(); }
  /// Says whether the edge is a region interface or a user's line: it never flips.
  [[nodiscard]] bool is_constrained(HalfedgeId h) const { return constrained_[h] != 0; }
  /// Says whether the edge of h is on the boundary or constrained: no flip ever removes it.
  [[nodiscard]] bool is_unflippable(HalfedgeId h) const { return is_boundary(h) || is_constrained(h); }
  /// Marks the edge of h on both sides.
  void set_constrained(HalfedgeId h, bool constrained) { mark(h, constrained ? 1 : 0); }
  /// Says whether the edge is a diagonal: of a quadrilateral, or of a polygon around the end of a face. It is
  /// constrained and has no dual.
  [[nodiscard]] bool is_diagonal(HalfedgeId h) const { return joins_halves(h) || is_joint(h); }
  /// Says whether the edge is the diagonal of a quadrilateral. Its two triangles are one cell.
  [[nodiscard]] bool joins_halves(HalfedgeId h) const { return constrained_[h] == kDiagonal; }
  /// Says whether the edge is a diagonal of a polygon around the end of a face: both triangles have one orthocenter.
  [[nodiscard]] bool is_joint(HalfedgeId h) const { return constrained_[h] == kJoint; }
  /// Marks a diagonal on both sides. The caller constrains the sides of the quadrilateral and fixes its corners.
  void set_diagonal(HalfedgeId h) { mark(h, kDiagonal); }
  /// Says whether the dual of the edge is a face that must stay, such as a piece of a fault. The edge is constrained.
  [[nodiscard]] bool is_face(HalfedgeId h) const { return constrained_[h] == kFace; }
  /// Marks an edge with such a dual on both sides. keep_faces() of temper/detail/faces.hpp does the rest.
  void set_face(HalfedgeId h) { mark(h, kFace); }
  void set_joint(HalfedgeId h) { mark(h, kJoint); }
  /// Says whether h represents its edge. Each edge has one representative: the boundary halfedge, or the smaller of two
  /// twins.
  [[nodiscard]] bool is_edge_representative(HalfedgeId h) const { return !twin(h).valid() || h < twin(h); }
  [[nodiscard]] std::size_t n_edges() const;

  // --- triangles ---------------------------------------------------------------------------------
  [[nodiscard]] std::array<VertexId, 3> corners(TriangleId t) const {
    return {corners_[halfedge(t, 0)], corners_[halfedge(t, 1)], corners_[halfedge(t, 2)]};
  }
  /// Says whether t is part of a polygon that stays: half of a quadrilateral, or at the end of a face. No vertex is
  /// inserted there.
  [[nodiscard]] bool is_half(TriangleId t) const {
    return is_inner(halfedge(t, 0)) || is_inner(halfedge(t, 1)) || is_inner(halfedge(t, 2));
  }
  [[nodiscard]] std::int32_t region(TriangleId t) const { return regions_[t]; }
  void set_region(TriangleId t, std::int32_t region) { regions_.set(t, region, n_triangles()); }

  // --- around a vertex ---------------------------------------------------------------------------
  /// One halfedge that leaves v. At a boundary vertex it is the boundary halfedge, so that a walk sees the whole star.
  [[nodiscard]] HalfedgeId outgoing(VertexId v) const { return HalfedgeId(std::size_t{record(v).outgoing}); }
  /// The next halfedge out of origin(h), counter-clockwise; invalid after the last one of a boundary vertex.
  [[nodiscard]] HalfedgeId rotate(HalfedgeId h) const { return twin(prev(h)); }
  /// The halfedges out of v, one per triangle, counter-clockwise. for (HalfedgeId h : mesh.star(v)) …
  [[nodiscard]] auto star(VertexId v) const { return Star(this, outgoing(v)); }
  /// The halfedge from a to b, or invalid. O(the lesser degree).
  [[nodiscard]] HalfedgeId find_halfedge(VertexId a, VertexId b) const;

  // --- whole mesh --------------------------------------------------------------------------------
  /// Checks the arrays and the geometry: ids in range, twins mutual, stars whole, flags equal on both sides, every
  /// triangle counter-clockwise (exact). Returns the first fault, or nothing. It skips erased triangles, and vertices
  /// that became isolated with them. O(n).
  [[nodiscard]] std::optional<std::string> validate() const;

  /// The size of the arrays in bytes.
  [[nodiscard]] std::size_t memory_bytes() const;

  // --- as it lies in memory, for views from other languages: valid until the mesh changes ------------
  /// x, y, w of vertex 0. The next vertex is kVertexStride bytes further. Null without vertices.
  static constexpr std::size_t kVertexStride = 32;
  [[nodiscard]] const double* vertex_data() const { return vertices_.empty() ? nullptr : &vertices_.raw().front().x; }
  /// The corners of the triangles, three each.
  [[nodiscard]] std::span<const VertexId> corner_data() const { return corners_.raw(); }
  /// The twin of each halfedge.
  [[nodiscard]] std::span<const HalfedgeId> twin_data() const { return twins_.raw(); }

  // --- what removals leave behind (connectivity itself is changed by topology.hpp) -------------------
  /// Says whether a removal took the triangle and compact() has not dropped it yet. Loops over triangles() still see
  /// it. Its corners are invalid, and its halfedges are boundary halfedges without flags. n_edges(), regularity, flips
  /// and validate() skip it. Other functions need compact() first.
  [[nodiscard]] bool is_erased(TriangleId t) const { return !corners_[halfedge(t, 0)].valid(); }
  /// Drops erased triangles and vertices of no triangle, keeps the order of the rest, and repairs outgoing(). Returns
  /// the old ids of the remaining elements.
  struct Compaction compact();

  friend bool operator==(const Mesh&, const Mesh&) = default;

 private:
  friend class MeshBuilder;
  friend class MeshEditor;
  friend class MeshPermuter;

  static constexpr std::uint32_t kFixed = 1, kFrozen = 2;
  static constexpr std::uint8_t kDiagonal = 2, kFace = 3, kJoint = 4;

  // 32 bytes: a vertex is one half of a cache line and never lies in two.
  struct alignas(kVertexStride) VertexRecord {
    double x = 0, y = 0, w = 0;
    std::uint32_t outgoing = HalfedgeId::kInvalid;
    std::uint32_t flags = 0;
    friend bool operator==(const VertexRecord&, const VertexRecord&) = default;
  };

  class Star {
   public:
    class Iterator {
     public:
      Iterator(const Mesh* mesh, HalfedgeId h) : mesh_(mesh), first_(h), at_(h) {}
      HalfedgeId operator*() const { return at_; }
      Iterator& operator++() {
        at_ = mesh_->rotate(at_);
        if (at_ == first_) at_ = HalfedgeId();
        return *this;
      }
      friend bool operator==(const Iterator& a, const Iterator& b) { return a.at_ == b.at_; }

     private:
      const Mesh* mesh_;
      HalfedgeId first_, at_;
    };
    Star(const Mesh* mesh, HalfedgeId first) : mesh_(mesh), first_(first) {}
    [[nodiscard]] Iterator begin() const { return {mesh_, first_}; }
    [[nodiscard]] Iterator end() const { return {mesh_, HalfedgeId()}; }

   private:
    const Mesh* mesh_;
    HalfedgeId first_;
  };

  void repair_outgoing();
  [[nodiscard]] bool is_inner(HalfedgeId h) const { return constrained_[h] >= kDiagonal; }
  void mark(HalfedgeId h, std::uint8_t value) {
    constrained_.set(h, value, n_halfedges());
    if (twin(h).valid()) constrained_.set(twin(h), value, n_halfedges());
  }
  VertexRecord& record(VertexId v) { return vertices_[v]; }
  [[nodiscard]] const VertexRecord& record(VertexId v) const { return vertices_[v]; }

  Space space_;
  IdVector<VertexId, VertexRecord> vertices_;
  IdVector<HalfedgeId, VertexId> corners_;  // origin of each halfedge
  IdVector<HalfedgeId, HalfedgeId> twins_;  // invalid on the boundary
  // Most meshes have no constrained edge and a single region 0. This saves 14 bytes per vertex.
  ZeroUntilSet<HalfedgeId, std::uint8_t> constrained_;  // 1, kDiagonal, kFace or kJoint
  ZeroUntilSet<TriangleId, std::int32_t> regions_;
};

/// The result of Mesh::build, with its repairs.
struct BuiltMesh {
  Mesh mesh;
  std::size_t reversed_triangles = 0;  ///< Number of triangles that were clockwise in the input
};

/// The error of functions for meshes of the plane only, if the mesh is on the sphere or in a periodic plane. Else
/// nothing. `what`: name of the function for the user, such as "explain()".
[[nodiscard]] std::optional<InputError> expect_plane(const Mesh& mesh, std::string_view what);
/// The error of functions for meshes of the plane and of the sphere, if the plane is periodic. Else nothing.
[[nodiscard]] std::optional<InputError> expect_no_period(const Mesh& mesh, std::string_view what);

/// The vertices and triangles that compact() kept: new id → old id.
struct Compaction {
  IdVector<VertexId, VertexId> vertices;
  IdVector<TriangleId, TriangleId> triangles;
};

/// A new numbering: new id → old id.
struct MeshOrder {
  IdVector<VertexId, VertexId> vertices;
  IdVector<TriangleId, TriangleId> triangles;
};

/// Renumbers vertices and triangles along a Hilbert curve, so that neighbors in the plane are neighbors in memory.
/// Returns the order, for restore_order. O(n).
MeshOrder hilbert_order(Mesh& mesh);
/// Undoes hilbert_order: every vertex gets its former number again, and every triangle its former slot.
void restore_order(Mesh& mesh, const MeshOrder& order, Executor* executor = nullptr);

/// A copy of a mesh in the order of a Hilbert curve, and its order.
struct OrderedMesh {
  Mesh mesh;
  MeshOrder order;
};
/// Copies the mesh and orders the copy as hilbert_order does.
[[nodiscard]] OrderedMesh hilbert_ordered(const Mesh& mesh, Executor* executor = nullptr);

}  // namespace temper
