// The weighted tetrahedral mesh: a copyable value of flat arrays.
//
// Half-faces are based on tetrahedra, as half-edges of a Mesh are based on triangles: halfface 4 t + f is the face of
// tetrahedron t opposite its corner f. So the tetrahedron and the opposite corner are arithmetic, and only corners and
// twins are stored. All tetrahedra are positive (geometry.hpp). A halfface without twin lies on the boundary.
//
//              d                halfface h = 4 t + 3: face abc of t = abcd
//            / | \              vertices(h):          a, b, c, counter-clockwise as seen from d
//          /   |   \            opposite(h):          d
//         a----|----c           twin(h):              a, c, b in the tetrahedron below, or invalid on the boundary
//          \   |   /            face opposite a: b, d, c   opposite b: a, c, d   opposite c: a, d, b
//            \ | /
//              b
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "temper/detail/error.hpp"
#include "temper/detail/ids.hpp"
#include "temper/detail/vec.hpp"
#include "temper/mesh.hpp"
#include "temper/tets/geometry.hpp"

namespace temper {
class Executor;
}

namespace temper::tets {

using TetId = Id<struct TetTag>;
/// A face as one tetrahedron has it. Halfface 4 t + f is opposite corner f of tetrahedron t.
using HalffaceId = Id<struct HalffaceTag>;

/// The user's numbers of points, tetrahedra, tagged faces and lines, for errors. The base class counts from 0 and has
/// no file.
class InputNames : public temper::InputNames {
 public:
  /// The name of a tagged face, which is a triangle in files.
  [[nodiscard]] std::string triangle(std::size_t index) const override { return "face " + std::to_string(index); }
  [[nodiscard]] virtual std::string tetrahedron(std::size_t index) const {
    return "tetrahedron " + std::to_string(index);
  }
  [[nodiscard]] virtual std::string line(std::size_t index) const { return "line " + std::to_string(index); }
  /// The place of the tetrahedron in its file, such as "box.msh:41", or nothing.
  [[nodiscard]] virtual std::string tetrahedron_where(std::size_t /*index*/) const { return {}; }
};

/// Arrays that make a mesh. TetMesh::build reads the spans only during the call.
struct TetMeshInput {
  std::span<const Vec3> points = {};     ///< Points, n of them
  std::span<const double> weights = {};  ///< Weights of the points [length²]; empty: all zero
  /// Corners of the m tetrahedra, 0-based, in either orientation.
  std::span<const std::array<std::int32_t, 4>> tetrahedra = {};
  std::span<const std::int32_t> regions = {};               ///< Region numbers of the tetrahedra; empty: all zero
  std::span<const std::array<std::int32_t, 3>> faces = {};  ///< Tagged faces, on the boundary or inside
  std::span<const std::int32_t> face_tags = {};             ///< One tag per face
  std::span<const std::array<std::int32_t, 2>> lines = {};  ///< Tagged lines
  std::span<const std::int32_t> line_tags = {};             ///< One tag per line
  std::span<const std::int32_t> marked_points = {};         ///< Points that carry a tag
  std::span<const std::int32_t> point_tags = {};            ///< One tag per marked point
  const InputNames* names = nullptr;                        ///< Numbering of the user, for errors
  Executor* executor = nullptr;                             ///< Threads; the result does not depend on them
};

struct TaggedFace {
  HalffaceId face;  ///< The side with the user's orientation, or its twin if the mesh has not this side
  std::int32_t tag = 0;
  friend bool operator==(const TaggedFace&, const TaggedFace&) = default;
};
struct TaggedLine {
  std::array<VertexId, 2> ends;
  std::int32_t tag = 0;
  friend bool operator==(const TaggedLine&, const TaggedLine&) = default;
};
struct TaggedPoint {
  VertexId vertex;
  std::int32_t tag = 0;
  friend bool operator==(const TaggedPoint&, const TaggedPoint&) = default;
};

class TetMesh {
 public:
  /// Corners of the face opposite each corner, counter-clockwise as seen from that corner.
  static constexpr std::array<std::array<int, 3>, 4> kFaceCorners = {{{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};

  TetMesh() = default;

  /// Builds a mesh and checks it. Negative tetrahedra are reversed and counted: files mix both orientations, and the
  /// order of corners is no geometry. If a tetrahedron is inverted in truth, it lies on top of a neighbor, which is an
  /// error that names it. Weights need not be regular. O(n).
  ///
  /// The checks are:
  ///   - finite coordinates and weights of exact range, indices in range, no duplicate or unused point
  ///   - no flat tetrahedron (exact), none repeated
  ///   - at most two tetrahedra per face, on different sides of it (exact)
  ///   - the tetrahedra around an edge or a vertex are one fan, one ball or one half ball
  ///   - the tetrahedra around an inner edge or vertex make one turn or one sphere, others at most that much
  ///
  /// So the mesh does not overlap itself around any inner vertex. Parts of the boundary that cross far from each other
  /// are not looked for.
  [[nodiscard]] static Expected<struct BuiltTetMesh> build(const TetMeshInput& input);

  // --- sizes -------------------------------------------------------------------------------------
  [[nodiscard]] std::size_t n_vertices() const { return places_.size(); }
  [[nodiscard]] std::size_t n_tetrahedra() const { return corners_.size(); }
  [[nodiscard]] std::size_t n_halffaces() const { return twins_.size(); }
  [[nodiscard]] IdRange<VertexId> vertices() const { return IdRange<VertexId>(n_vertices()); }
  [[nodiscard]] IdRange<TetId> tetrahedra() const { return IdRange<TetId>(n_tetrahedra()); }
  [[nodiscard]] IdRange<HalffaceId> halffaces() const { return IdRange<HalffaceId>(n_halffaces()); }

  // --- vertices ----------------------------------------------------------------------------------
  [[nodiscard]] const WeightedPoint& point(VertexId v) const { return places_[v]; }
  void set_point(VertexId v, const WeightedPoint& p) { places_[v] = p; }
  [[nodiscard]] Vec3 position(VertexId v) const { return places_[v].position(); }
  [[nodiscard]] double weight(VertexId v) const { return places_[v].w; }
  void set_weight(VertexId v, double w) { places_[v].w = w; }

  // --- halffaces ---------------------------------------------------------------------------------
  [[nodiscard]] static constexpr TetId tetrahedron(HalffaceId h) { return TetId(h.index / 4); }
  [[nodiscard]] static constexpr HalffaceId halfface(TetId t, int f) {
    return HalffaceId(4 * std::size_t{t.index} + std::size_t(f));
  }
  [[nodiscard]] HalffaceId twin(HalffaceId h) const { return twins_[h]; }
  [[nodiscard]] bool is_boundary(HalffaceId h) const { return !twin(h).valid(); }
  /// The halfface of t opposite v, which is a corner of t.
  [[nodiscard]] HalffaceId halfface_opposite(TetId t, VertexId v) const {
    int f = 0;
    while (corners_[t][static_cast<std::size_t>(f)] != v) ++f;
    return halfface(t, f);
  }
  /// Says whether only one tetrahedron has the face of h, or two of different regions.
  [[nodiscard]] bool bounds_region(HalffaceId h) const {
    const HalffaceId other = twin(h);
    return !other.valid() || region(tetrahedron(h)) != region(tetrahedron(other));
  }
  /// The corner opposite h in its tetrahedron.
  [[nodiscard]] VertexId opposite(HalffaceId h) const { return corners_[tetrahedron(h)][h.index % 4]; }
  [[nodiscard]] std::array<VertexId, 3> vertices(HalffaceId h) const {
    const auto& corners = corners_[tetrahedron(h)];
    const auto [a, b, c] = kFaceCorners[h.index % 4];
    return {corners[std::size_t(a)], corners[std::size_t(b)], corners[std::size_t(c)]};
  }
  /// Says whether h represents its face: the boundary halfface, or the smaller of two twins.
  [[nodiscard]] bool is_face_representative(HalffaceId h) const { return !twin(h).valid() || h < twin(h); }
  [[nodiscard]] std::size_t n_faces() const;

  // --- tetrahedra --------------------------------------------------------------------------------
  [[nodiscard]] const std::array<VertexId, 4>& corners(TetId t) const { return corners_[t]; }
  [[nodiscard]] std::array<WeightedPoint, 4> points(TetId t) const {
    const auto& [a, b, c, d] = corners_[t];
    return {point(a), point(b), point(c), point(d)};
  }
  [[nodiscard]] std::int32_t region(TetId t) const { return regions_[t]; }
  void set_region(TetId t, std::int32_t region) { regions_.set(t, region, n_tetrahedra()); }
  /// A tetrahedron at v.
  [[nodiscard]] TetId incident(VertexId v) const { return incident_[v]; }

  // --- tags, in the order of the input -----------------------------------------------------------
  [[nodiscard]] const std::vector<TaggedFace>& tagged_faces() const { return faces_; }
  [[nodiscard]] const std::vector<TaggedLine>& tagged_lines() const { return lines_; }
  [[nodiscard]] const std::vector<TaggedPoint>& tagged_points() const { return points_; }

  // --- whole mesh --------------------------------------------------------------------------------
  /// Checks the arrays and the geometry: ids in range, twins mutual and of the same vertices, every tetrahedron
  /// positive (exact). Returns the first fault, or nothing. O(n).
  [[nodiscard]] std::optional<std::string> validate() const;

  // --- as it lies in memory, for views from other languages: valid until the mesh changes ----------
  [[nodiscard]] std::span<const WeightedPoint> point_data() const { return places_.raw(); }
  [[nodiscard]] std::span<const std::array<VertexId, 4>> corner_data() const { return corners_.raw(); }

  friend bool operator==(const TetMesh&, const TetMesh&) = default;

 private:
  friend class TetMeshBuilder;

  IdVector<VertexId, WeightedPoint> places_;
  IdVector<VertexId, TetId> incident_;
  IdVector<TetId, std::array<VertexId, 4>> corners_;
  IdVector<HalffaceId, HalffaceId> twins_;
  ZeroUntilSet<TetId, std::int32_t> regions_;
  std::vector<TaggedFace> faces_;
  std::vector<TaggedLine> lines_;
  std::vector<TaggedPoint> points_;
};

struct BuiltTetMesh {
  TetMesh mesh;
  std::size_t reversed_tetrahedra = 0;  ///< Number of tetrahedra that were negative
  /// Indices of tagged faces and lines that are no face or edge of the mesh. They are not among its tags.
  std::vector<std::size_t> dangling_faces, dangling_lines;
};

/// Marks the vertices of boundary faces. O(n).
[[nodiscard]] IdVector<VertexId, std::uint8_t> boundary_vertices(const TetMesh& mesh);

}  // namespace temper::tets
