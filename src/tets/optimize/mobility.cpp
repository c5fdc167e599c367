#include "tets/optimize/mobility.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "base/sort_unique.hpp"
#include "optimize/step/dofs.hpp"

namespace temper::tets {
namespace {

/// The pairs of a key among sorted ones.
template <class Key, class Value>
std::span<const std::pair<Key, Value>> pairs_of(const std::vector<std::pair<Key, Value>>& all, const Key& key) {
  const auto before = [](const auto& a, const auto& b) { return a.first < b.first; };
  const auto [first, last] = std::equal_range(all.begin(), all.end(), std::pair(key, Value()), before);
  return {first, last};
}

/// The tags of faces or lines.
template <class Part>
class TagsOf {
 public:
  explicit TagsOf(std::vector<std::pair<Part, std::int32_t>> all) : all_(std::move(all)) { sort_unique(all_); }
  [[nodiscard]] bool same(const Part& a, const Part& b) const {
    return std::ranges::equal(pairs_of(all_, a), pairs_of(all_, b), {}, &std::pair<Part, std::int32_t>::second,
                              &std::pair<Part, std::int32_t>::second);
  }

 private:
  std::vector<std::pair<Part, std::int32_t>> all_;
};

/// The tags of marked points, without 0, which is none. A tag is of a place that the user chose, such as a well. But if
/// all corners of a tetrahedron, face or edge have it, it lists the vertices of a part, face or line.
class PointTags {
 public:
  explicit PointTags(const TetMesh& mesh) {
    for (const auto& [vertex, tag] : mesh.tagged_points()) {
      if (tag != 0) marks_.emplace(vertex, tag);
    }
    if (marks_.empty()) return;
    for (const TetId t : mesh.tetrahedra()) look_at(mesh.corners(t));
  }

  /// Learns from a simplex what its corners' tags list.
  template <std::size_t N>
  void look_at(const std::array<VertexId, N>& corners) {
    for_common(corners, [this](std::int32_t tag) {
      int& dimension = dimension_[tag];
      dimension = std::max(dimension, int(N) - 1);
    });
  }
  /// Says whether both vertices have a tag that lists the vertices of a line.
  [[nodiscard]] bool on_one_line(VertexId a, VertexId b) const {
    bool found = false;
    for_common(std::array{a, b}, [&](std::int32_t tag) { found |= dimension_of(tag) == 1; });
    return found;
  }
  /// Calls use(vertex, dimension of what the tag lists) for each mark.
  template <class Use>
  void for_each(const Use& use) const {
    for (const auto& [vertex, tag] : marks_) use(vertex, dimension_of(tag));
  }

 private:
  [[nodiscard]] int dimension_of(std::int32_t tag) const {
    const auto found = dimension_.find(tag);
    return found == dimension_.end() ? 0 : found->second;
  }
  template <std::size_t N, class Use>
  void for_common(const std::array<VertexId, N>& corners, const Use& use) const {
    for (auto mark = marks_.lower_bound({corners[0], std::numeric_limits<std::int32_t>::min()});
         mark != marks_.end() && mark->first == corners[0]; ++mark) {
      const std::int32_t tag = mark->second;
      if (std::all_of(corners.begin(), corners.end(), [&](VertexId v) { return marks_.contains({v, tag}); })) use(tag);
    }
  }

  std::set<std::pair<VertexId, std::int32_t>> marks_;
  std::map<std::int32_t, int> dimension_;
};

/// The lines and planes of vertices on the faces and lines that stay.
class Slides {
 public:
  /// The tags of points learn what they list.
  Slides(const TetMesh& mesh, PointTags& points)
      : mesh_(mesh), face_tags_(tags_of_faces(mesh)), line_tags_(tags_of_lines(mesh)) {
    std::vector<HalffaceId> faces;
    for (const HalffaceId h : mesh.halffaces()) {
      if (mesh.is_face_representative(h) && mesh.bounds_region(h)) faces.push_back(h);
    }
    for (const TaggedFace& f : mesh.tagged_faces()) faces.push_back(representative(mesh, f.face));
    sort_unique(faces);
    std::vector<std::pair<Line, HalffaceId>> edges;
    edges.reserve(3 * faces.size());
    for (const HalffaceId h : faces) {
      const auto [a, b, c] = mesh.vertices(h);
      for (const Line& line : {line_of(a, b), line_of(b, c), line_of(c, a)}) {
        edges.emplace_back(line, h);
        points.look_at(std::array{line.first, line.second});
      }
      for (const VertexId v : {a, b, c}) corners_.emplace_back(v, h);
      points.look_at(std::array{a, b, c});
    }
    std::sort(edges.begin(), edges.end());
    std::sort(corners_.begin(), corners_.end());
    for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
      const Line& line = edges[i].first;
      while (end < edges.size() && edges[end].first == line) ++end;
      if (end - i != 2 || !are_one(edges[i].second, edges[i + 1].second) || points.on_one_line(line.first, line.second))
        add_crease(line);
    }
    for (const TaggedLine& l : mesh.tagged_lines()) add_crease(line_of(l.ends[0], l.ends[1]));
    sort_unique(creases_);
  }

  [[nodiscard]] bool on_face(VertexId v) const { return !pairs_of(corners_, v).empty(); }
  /// The place of v without its weight, if it is on a part that stays.
  [[nodiscard]] Mobility place_of(VertexId v) const {
    const auto faces = pairs_of(corners_, v);
    const auto creases = pairs_of(creases_, v);
    if (creases.empty()) return in_plane(faces);
    return creases.size() == 2 ? on_line(v, creases[0].second, creases[1].second, faces) : Mobility::none;
  }

 private:
  using Line = std::pair<VertexId, VertexId>;  // from the lesser vertex to the greater one
  using Corners = std::span<const std::pair<VertexId, HalffaceId>>;

  static Line line_of(VertexId a, VertexId b) { return std::minmax(a, b); }
  static HalffaceId representative(const TetMesh& mesh, HalffaceId h) {
    return mesh.is_face_representative(h) ? h : mesh.twin(h);
  }
  static TagsOf<HalffaceId> tags_of_faces(const TetMesh& mesh) {
    std::vector<std::pair<HalffaceId, std::int32_t>> all;
    for (const TaggedFace& f : mesh.tagged_faces()) all.emplace_back(representative(mesh, f.face), f.tag);
    return TagsOf(std::move(all));
  }
  static TagsOf<Line> tags_of_lines(const TetMesh& mesh) {
    std::vector<std::pair<Line, std::int32_t>> all;
    for (const TaggedLine& l : mesh.tagged_lines()) all.emplace_back(line_of(l.ends[0], l.ends[1]), l.tag);
    return TagsOf(std::move(all));
  }
  void add_crease(const Line& line) {
    creases_.emplace_back(line.first, line.second);
    creases_.emplace_back(line.second, line.first);
  }
  [[nodiscard]] Vec3 normal(HalffaceId h) const {
    const auto [a, b, c] = mesh_.vertices(h);
    return cross(mesh_.position(b) - mesh_.position(a), mesh_.position(c) - mesh_.position(a));
  }
  /// Exact along an axis.
  static Vec3 unit(Vec3 v) {
    const double l = length(v);
    return {v.x / l, v.y / l, v.z / l};
  }
  static bool are_parallel(Vec3 a, Vec3 b) { return length(cross(a, b)) <= kStraight * length(a) * length(b); }
  /// The regions of both sides, the lesser first; the least number for the outside.
  [[nodiscard]] std::pair<std::int32_t, std::int32_t> regions(HalffaceId h) const {
    const std::int32_t here = mesh_.region(TetMesh::tetrahedron(h));
    if (mesh_.is_boundary(h)) return {std::numeric_limits<std::int32_t>::min(), here};
    return std::minmax(here, mesh_.region(TetMesh::tetrahedron(mesh_.twin(h))));
  }
  /// Says whether two faces are pieces of one: of one plane, with the same tags and regions.
  [[nodiscard]] bool are_one(HalffaceId a, HalffaceId b) const {
    // The two sides of a slit lie on each other, with opposite normals: its front is a crease.
    const bool on_boundary = mesh_.is_boundary(a);
    return on_boundary == mesh_.is_boundary(b) && regions(a) == regions(b) && face_tags_.same(a, b) &&
           are_parallel(normal(a), normal(b)) && (!on_boundary || dot(normal(a), normal(b)) > 0);
  }

  [[nodiscard]] Mobility in_plane(Corners faces) const {
    const Vec3 expected = normal(faces[0].second);
    Vec3 sum;
    for (const auto& [v, h] : faces) {
      const Vec3 n = normal(h);
      if (!are_parallel(n, expected)) return Mobility::none;
      sum = sum + (dot(n, expected) < 0 ? -1.0 : 1.0) * n;
    }
    return Mobility::in_plane(unit(sum));
  }
  [[nodiscard]] Mobility on_line(VertexId v, VertexId a, VertexId b, Corners faces) const {
    const Vec3 to_a = mesh_.position(a) - mesh_.position(v), to_b = mesh_.position(b) - mesh_.position(v);
    if (!are_parallel(to_a, to_b) || dot(to_a, to_b) > 0) return Mobility::none;
    if (!line_tags_.same(line_of(v, a), line_of(v, b))) return Mobility::none;
    const Vec3 direction = unit(to_b - to_a);
    for (const auto& [u, h] : faces) {
      const Vec3 n = normal(h);
      if (std::abs(dot(n, direction)) > kStraight * length(n)) return Mobility::none;
    }
    return Mobility::along_line(direction);
  }

  const TetMesh& mesh_;
  TagsOf<HalffaceId> face_tags_;
  TagsOf<Line> line_tags_;
  std::vector<std::pair<VertexId, HalffaceId>> corners_;  // of the faces
  std::vector<std::pair<VertexId, VertexId>> creases_;    // from each end
};

}  // namespace

IdVector<VertexId, Mobility> mobilities(const TetMesh& mesh, const OptimizeOptions& options,
                                        std::span<const VertexId> frozen) {
  IdVector<VertexId, Mobility> all(mesh.n_vertices());
  for (const VertexId v : mesh.vertices()) all[v] = Mobility::free;
  const auto fix = [&](HalffaceId h) {
    for (const VertexId v : mesh.vertices(h)) all[v] = Mobility::weight;
  };
  for (const HalffaceId h : mesh.halffaces()) {
    if (mesh.bounds_region(h)) fix(h);
  }
  for (const TaggedFace& tagged : mesh.tagged_faces()) fix(tagged.face);
  for (const TaggedLine& tagged : mesh.tagged_lines()) {
    for (const VertexId v : tagged.ends) all[v] = Mobility::weight;
  }
  PointTags points(mesh);
  std::optional<Slides> slides;
  if (options.boundary == BoundaryVertices::slide) slides.emplace(mesh, points);
  for (const VertexId v : mesh.vertices()) {
    if (!slides || all[v].moves()) continue;
    all[v] = slides->place_of(v);
    all[v].weighs = true;
  }
  points.for_each([&](VertexId v, int dimension) {
    const bool is_place = dimension == 0 || !slides || !slides->on_face(v);
    if (dimension < 3 && is_place) all[v] = Mobility::weight;
  });
  for (const VertexId v : mesh.fixed_points()) all[v] = Mobility::weight;
  for (const VertexId v : mesh.vertices()) {
    if (options.unknowns == temper::Unknowns::weights) all[v] = Mobility::weight;
    if (options.unknowns == temper::Unknowns::positions) all[v].weighs = false;
  }
  for (const VertexId v : frozen) all[v] = Mobility::none;
  return all;
}

}  // namespace temper::tets
