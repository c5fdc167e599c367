// A mesh of tetrahedra in the spaces of its metrics: cut along interfaces, and joined again.
#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/assert.hpp"
#include "mesh/pieces.hpp"
#include "temper/tets/tensor.hpp"
#include "tets/mesh/rebuild.hpp"
#include "tets/mesh/tables.hpp"

namespace temper::tets {

[[nodiscard]] inline std::pair<std::string, std::string> place_and_name(const InputNames& names, TetId t) {
  return {names.tetrahedron_where(t.index), names.tetrahedron(t.index)};
}

}  // namespace temper::tets

namespace temper {

template Expected<tets::Metrics> MetricsOf<Tensor3, tets::TetId, tets::InputNames>::of(std::span<const Tensor3> tensors,
                                                                                       const tets::InputNames& names);

}  // namespace temper

namespace temper::tets {
namespace {

/// The first tetrahedron that is no longer positive.
Expected<void> expect_upright(const TetMesh& mesh, const InputNames& names) {
  for (const TetId t : mesh.tetrahedra()) {
    const auto [a, b, c, d] = mesh.corners(t);
    if (orientation(mesh.position(a), mesh.position(b), mesh.position(c), mesh.position(d)) == Sign::positive) continue;
    const auto [where, name] = place_and_name(names, t);
    return InputError{ErrorCode::zero_volume, where,
                      name +
                          " is so flat that it turns over when its corners are rounded, in the metric of the tensor or "
                          "back"};
  }
  return {};
}

std::int32_t number_of(VertexId v) { return static_cast<std::int32_t>(v.index); }
template <std::size_t N>
std::array<std::int32_t, N> numbers_of_corners(const std::array<VertexId, N>& corners) {
  std::array<std::int32_t, N> numbers;
  std::transform(corners.begin(), corners.end(), numbers.begin(), number_of);
  return numbers;
}

/// A mesh with the tetrahedra, regions and tags of another one, and other vertices at their corners.
class Renumbered {
 public:
  explicit Renumbered(const TetMesh& mesh) : mesh_(mesh) {
    for (const TetId t : mesh.tetrahedra()) {
      corners_.push_back(mesh.corners(t));
      regions_.push_back(mesh.region(t));
    }
  }

  [[nodiscard]] VertexId& corner(TetId t, std::size_t k) { return corners_[t.index][k]; }

  /// `points`: of the new vertices. `number`: of each vertex as a place with tags. The tetrahedra stay positive.
  template <class Number>
  [[nodiscard]] TetMesh build(const std::vector<WeightedPoint>& points, const Number& number) const {
    std::vector<Vec3> positions;
    std::vector<double> weights;
    for (const WeightedPoint& p : points) positions.push_back(p.position()), weights.push_back(p.w);
    std::vector<std::array<std::int32_t, 4>> tetrahedra;
    for (const auto& corners : corners_) tetrahedra.push_back(numbers_of_corners(corners));
    std::vector<std::array<std::int32_t, 3>> faces;
    std::vector<std::array<std::int32_t, 2>> lines;
    std::vector<std::int32_t> face_tags, line_tags, marked, point_tags, fixed;
    for (const auto& [face, tag] : mesh_.tagged_faces()) {
      faces.push_back(corners_of_face(face));
      face_tags.push_back(tag);
    }
    const VertexStars stars = mesh_.tagged_lines().empty() ? VertexStars() : VertexStars(mesh_);
    for (const auto& [ends, tag] : mesh_.tagged_lines()) {
      lines.push_back(ends_of(stars, ends));
      line_tags.push_back(tag);
    }
    for (const auto& [v, tag] : mesh_.tagged_points())
      marked.push_back(number_of(number(v))), point_tags.push_back(tag);
    for (const VertexId v : mesh_.fixed_points()) fixed.push_back(number_of(number(v)));
    TetMeshInput input;
    input.points = positions, input.weights = weights;
    input.tetrahedra = tetrahedra, input.regions = regions_;
    input.faces = faces, input.face_tags = face_tags;
    input.lines = lines, input.line_tags = line_tags;
    input.marked_points = marked, input.point_tags = point_tags, input.fixed_points = fixed;
    std::optional<TetMesh> made = rebuilt(input);
    TEMPER_ASSERT(made);
    return *std::move(made);
  }

 private:
  [[nodiscard]] std::array<std::int32_t, 3> corners_of_face(HalffaceId h) const {
    const auto& corners = corners_[TetMesh::tetrahedron(h).index];
    const auto [a, b, c] = TetMesh::kFaceCorners[h.index % 4];
    return numbers_of_corners(std::array{corners[std::size_t(a)], corners[std::size_t(b)], corners[std::size_t(c)]});
  }
  /// The ends of a line in the first tetrahedron that has it.
  [[nodiscard]] std::array<std::int32_t, 2> ends_of(const VertexStars& stars,
                                                    const std::array<VertexId, 2>& ends) const {
    TetId first;
    stars.for_each_around(mesh_, ends, [&](TetId t) { first = std::min(first, t); });
    const auto corner = [&](VertexId v) { return corners_[first.index][mesh_.halfface_opposite(first, v).index % 4]; };
    return numbers_of_corners(std::array{corner(ends[0]), corner(ends[1])});
  }

  const TetMesh& mesh_;
  std::vector<std::array<VertexId, 4>> corners_;
  std::vector<std::int32_t> regions_;
};

/// Cuts a mesh along faces between spaces. Corners of a vertex that faces inside one space connect have one copy of it:
///
///            /|\            t and u have the same space: their corners at v are one. s has another one: its
///          /  |  \          corner is another copy. In space a ring of tetrahedra around an edge may leave a space
///        / t  |  u \        and come back to it, so that corners are joined by pairs, not in an order around v.
///       -----v------
///          \  s  /
class Cutter {
 public:
  explicit Cutter(MetricMesh& pieces) : pieces_(pieces), mesh_(pieces.mesh), same_(4 * mesh_.n_tetrahedra()) {
    std::iota(same_.begin(), same_.end(), std::uint32_t{0});
  }

  void cut() {
    bool has_seams = false;
    for (const HalffaceId h : mesh_.halffaces()) {
      if (mesh_.is_boundary(h)) continue;
      if (is_seam(h))
        has_seams = true;
      else if (mesh_.is_face_representative(h))
        join_across(h);
    }
    if (has_seams) rebuild();
  }

 private:
  [[nodiscard]] bool is_seam(HalffaceId h) const {
    const Metrics& metrics = pieces_.metrics;
    return !metrics.of(TetMesh::tetrahedron(h)).shares_plane(metrics.of(TetMesh::tetrahedron(mesh_.twin(h))));
  }
  [[nodiscard]] std::uint32_t corner_of(TetId t, VertexId v) const {
    return mesh_.halfface_opposite(t, v).index;  // opposite a corner, and numbered as it
  }
  /// The first corner of those that are known to be one with this one.
  std::uint32_t first(std::uint32_t corner) {
    while (same_[corner] != corner) corner = same_[corner] = same_[same_[corner]];
    return corner;
  }
  void join_across(HalffaceId h) {
    const TetId t = TetMesh::tetrahedron(h), u = TetMesh::tetrahedron(mesh_.twin(h));
    for (const VertexId v : mesh_.vertices(h)) {
      const std::uint32_t a = first(corner_of(t, v)), b = first(corner_of(u, v));
      same_[std::max(a, b)] = std::min(a, b);
    }
  }
  /// The first corner of each vertex keeps its number, the others get new ones.
  void rebuild() {
    std::vector<WeightedPoint> points;
    for (const VertexId v : mesh_.vertices()) {
      points.push_back(mesh_.point(v));
      pieces_.first_copies.push_back(v);
    }
    IdVector<VertexId, std::uint8_t> used(points.size(), 0);
    Renumbered cut(mesh_);
    for (const TetId t : mesh_.tetrahedra()) {
      for (std::size_t k = 0; k < 4; ++k) {
        const auto corner = static_cast<std::uint32_t>(4 * std::size_t{t.index} + k);
        const VertexId v = mesh_.corners(t)[k];
        if (const std::uint32_t joined = first(corner); joined != corner) {
          cut.corner(t, k) = cut.corner(TetId(joined / 4), joined % 4);
        } else if (std::exchange(used[v], std::uint8_t{1}) != 0) {
          cut.corner(t, k) = VertexId(points.size());
          points.push_back(mesh_.point(v));
          pieces_.first_copies.push_back(v);
        }
      }
    }
    pieces_.mesh = cut.build(points, [](VertexId v) { return v; });
  }

  MetricMesh& pieces_;
  const TetMesh mesh_;  // a copy: the first copies of vertices are known at the end
  std::vector<std::uint32_t> same_;
};

/// Makes one vertex of all copies. Returns the vertices that are kept.
IdVector<VertexId, VertexId> join(MetricMesh& now) {
  IdVector<VertexId, VertexId> kept, number(now.mesh.n_vertices());
  std::vector<WeightedPoint> points;
  for (const VertexId v : now.mesh.vertices()) {
    if (now.first_copy(v) != v) continue;
    number[v] = VertexId(points.size());
    points.push_back(now.mesh.point(v));
    kept.push_back(v);
  }
  const auto joined = [&](VertexId v) { return number[now.first_copy(v)]; };
  Renumbered whole(now.mesh);
  for (const TetId t : now.mesh.tetrahedra()) {
    for (std::size_t k = 0; k < 4; ++k) whole.corner(t, k) = joined(now.mesh.corners(t)[k]);
  }
  now.mesh = whole.build(points, joined);
  return kept;
}

/// Maps the vertices of changed pieces back, and gives tetrahedra their regions.
void move_back(MetricMesh& now, const TetMesh& original, const MetricMesh& pieces,
               const IdVector<VertexId, VertexId>& vertices) {
  TetMesh& mesh = now.mesh;
  for (const VertexId v : mesh.vertices()) {
    const VertexId old = vertices.empty() ? v : vertices[v];
    const bool stayed =
        old.valid() && old.index < pieces.mesh.n_vertices() && pieces.mesh.position(old) == mesh.position(v);
    const Vec3 at =
        stayed ? original.position(pieces.first_copy(old)) : now.metric(mesh.incident(v)).from_metric(mesh.position(v));
    mesh.set_point(v, {at.x, at.y, at.z, mesh.weight(v)});
  }
  if (pieces.regions.empty()) return;
  for (const TetId t : mesh.tetrahedra())
    mesh.set_region(t, pieces.regions[static_cast<std::size_t>(mesh.region(t))].region);
}

}  // namespace

std::vector<SeamFace> seams_of(const MetricMesh& pieces) {
  std::vector<SeamFace> seams;
  if (!pieces.is_cut()) return seams;
  std::vector<std::pair<std::array<VertexId, 3>, HalffaceId>> open;
  for (const HalffaceId h : pieces.mesh.halffaces()) {
    if (!pieces.mesh.is_boundary(h)) continue;
    std::array<VertexId, 3> corners = pieces.mesh.vertices(h);
    for (VertexId& v : corners) v = pieces.first_copy(v);
    std::sort(corners.begin(), corners.end());
    open.emplace_back(corners, h);
  }
  std::sort(open.begin(), open.end());
  for (std::size_t i = 0; i + 1 < open.size(); ++i) {
    if (open[i].first == open[i + 1].first) seams.push_back({open[i].second, open[i + 1].second});
  }
  std::sort(seams.begin(), seams.end(), [](const SeamFace& a, const SeamFace& b) { return a.one < b.one; });
  return seams;
}

SeamCorners corners_of(const MetricMesh& pieces, const SeamFace& seam) {
  SeamCorners corners = {pieces.mesh.vertices(seam.one), {}};
  const std::array<VertexId, 3> there = pieces.mesh.vertices(seam.other);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto same = [&](VertexId v) { return pieces.first_copy(v) == pieces.first_copy(corners.one[k]); };
    corners.other[k] = *std::find_if(there.begin(), there.end(), same);
  }
  return corners;
}

Expected<MetricMesh> mapped(const TetMesh& mesh, const Metrics& metrics, std::span<const double> corner_weights,
                            const InputNames& names) {
  const auto sizes = expect_sizes(metrics, corner_weights, mesh.n_tetrahedra(), mesh.n_halffaces(), "tetrahedra");
  if (!sizes) return sizes.error();
  MetricMesh pieces = {mesh, metrics, {}, {}};
  if (!metrics.is_constant()) {
    Cutter(pieces).cut();
    number_regions(pieces, mesh.tetrahedra());
  }
  TetMesh& there = pieces.mesh;
  for (const VertexId v : there.vertices()) {
    const Vec3 at = metrics.of(there.incident(v)).to_metric(there.position(v));
    there.set_point(v, {at.x, at.y, at.z, there.weight(v)});
  }
  if (pieces.is_cut() && !corner_weights.empty()) {
    for (const TetId t : there.tetrahedra()) {
      for (std::size_t k = 0; k < 4; ++k)
        there.set_weight(there.corners(t)[k], corner_weights[std::size_t{4} * t.index + k]);
    }
  }
  if (const auto upright = expect_upright(there, names); !upright) return upright.error();
  return pieces;
}

MetricMesh with_mesh(const MetricMesh& pieces, TetMesh changed, const IdVector<VertexId, VertexId>& vertices) {
  return with_other_mesh(pieces, std::move(changed), vertices);
}

Expected<WholeMesh> mapped_back(const MetricMesh& changed, const TetMesh& original, const MetricMesh& pieces,
                                const IdVector<VertexId, VertexId>& vertices) {
  MetricMesh now = changed;
  WholeMesh whole;
  whole.vertices = vertices;
  for (const TetId t : now.mesh.tetrahedra()) {
    if (!now.regions.empty()) whole.tensors.push_back(now.metric(t).tensor());
    if (!now.is_cut()) continue;
    for (const VertexId v : now.mesh.corners(t)) whole.corner_weights.push_back(now.mesh.weight(v));
  }
  move_back(now, original, pieces, vertices);
  if (const auto upright = expect_upright(now.mesh, InputNames()); !upright) return upright.error();
  if (now.is_cut()) whole.vertices = numbers_before_cut(join(now), pieces, vertices);
  whole.mesh = std::move(now.mesh);
  return whole;
}

}  // namespace temper::tets
