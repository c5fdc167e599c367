#include "tets/optimize/draft.hpp"

#include <algorithm>
#include <tuple>
#include <unordered_set>
#include <utility>

#include "base/sort_unique.hpp"
#include "tets/mesh/rebuild.hpp"

namespace temper::tets {
namespace {

std::array<VertexId, 2> edge(VertexId a, VertexId b) { return a < b ? std::array{a, b} : std::array{b, a}; }

}  // namespace

IdVector<VertexId, Mobility> Draft::mobilities() const {
  IdVector<VertexId, Mobility> all;
  all.reserve(mesh.n_vertices());
  for (const VertexId v : mesh.vertices()) all.push_back(mobility_of(v));
  return all;
}

bool Draft::fill(std::span<const Filling> fillings) {
  auto made = filled(mesh, fillings, names);
  if (!made) return false;
  std::tie(mesh, names) = *std::move(made);
  for (const Filling& f : fillings) {
    if (!f.apex.valid()) mobility.push_back(f.cavity.split.empty() ? Mobility::free : Mobility::weight);
    flips += f.apex.valid() && !f.removed.valid() ? 1 : 0;
  }
  return true;
}

PatchMaker::PatchMaker(const Draft& whole) : whole_(whole), stars_(whole.mesh), number_(whole.mesh.n_vertices(), -1) {
  const TetMesh& mesh = whole.mesh;
  for (const TaggedFace& f : mesh.tagged_faces()) {
    const auto [a, b, c] = mesh.vertices(f.face);
    faces_.push_back({std::min({a, b, c}), static_cast<std::uint32_t>(faces_.size())});
  }
  for (const TaggedLine& l : mesh.tagged_lines())
    lines_.push_back({std::min(l.ends[0], l.ends[1]), static_cast<std::uint32_t>(lines_.size())});
  for (auto* tags : {&faces_, &lines_})
    std::stable_sort(tags->begin(), tags->end(), [](const Tag& a, const Tag& b) { return a.least < b.least; });
}

/// The tags whose least vertex is in the patch, ascending.
std::vector<std::uint32_t> PatchMaker::at(const Patch& patch, const std::vector<Tag>& tags) const {
  std::vector<std::uint32_t> found;
  for (const VertexId v : patch.vertices) {
    auto tag = std::lower_bound(tags.begin(), tags.end(), v, [](const Tag& t, VertexId u) { return t.least < u; });
    for (; tag != tags.end() && tag->least == v; ++tag) found.push_back(tag->number);
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// What a patch is built from.
struct PatchMaker::Parts {
  std::vector<Vec3> points;
  std::vector<double> weights;
  std::vector<std::array<std::int32_t, 4>> corners;
  std::vector<std::array<std::int32_t, 3>> faces;
  std::vector<std::array<std::int32_t, 2>> lines;
  std::vector<std::int32_t> regions, face_tags, line_tags;
  IdVector<VertexId, Mobility> mobility;
  std::vector<std::array<VertexId, 2>> edges;  // sorted
  std::unordered_set<std::uint32_t> inside;    // tetrahedra

  [[nodiscard]] bool is_inside(HalffaceId h) const {
    return h.valid() && inside.contains(TetMesh::tetrahedron(h).index);
  }
  [[nodiscard]] Draft built() && {
    TetMeshInput input;
    input.points = points, input.weights = weights;
    input.tetrahedra = corners, input.regions = regions;
    input.faces = faces, input.face_tags = face_tags;
    input.lines = lines, input.line_tags = line_tags;
    std::optional<TetMesh> mesh = rebuilt(input);
    return mesh ? Draft(*std::move(mesh), std::move(mobility)) : Draft();
  }
};

Patch PatchMaker::make(std::vector<TetId> tetrahedra) {
  Patch patch;
  Parts parts;
  add_tetrahedra(tetrahedra, patch, parts);
  for (const VertexId v : patch.vertices) {
    const auto link = stars_.link(v);
    const bool is_inner = std::all_of(link.begin(), link.end(), [&](HalffaceId h) { return parts.is_inside(h); });
    parts.points.push_back(whole_.mesh.position(v));
    parts.weights.push_back(whole_.mesh.weight(v));
    parts.mobility.push_back(is_inner ? whole_.mobility_of(v) : Mobility::none);
  }
  add_tags(patch, parts);
  std::vector<std::array<VertexId, 3>> rim = rim_of(tetrahedra, parts);
  patch.draft = std::move(parts).built();
  patch.draft.rim = std::move(rim);
  for (const VertexId v : patch.vertices) number_[v] = -1;
  patch.tetrahedra = std::move(tetrahedra);
  return patch;
}

void PatchMaker::add_tetrahedra(const std::vector<TetId>& tetrahedra, Patch& patch, Parts& parts) {
  for (const TetId t : tetrahedra) {
    const auto& c = whole_.mesh.corners(t);
    for (const VertexId v : c) {
      if (number_[v] >= 0) continue;
      number_[v] = static_cast<std::int32_t>(patch.vertices.size());
      patch.vertices.push_back(v);
    }
    parts.corners.push_back(numbers_of(c, number_));
    parts.regions.push_back(whole_.mesh.region(t));
    for (const auto& ends : kEdgeCorners) parts.edges.push_back(edge(c[std::size_t(ends[0])], c[std::size_t(ends[1])]));
    parts.inside.insert(t.index);
  }
  sort_unique(parts.edges);
}

void PatchMaker::add_tags(Patch& patch, Parts& parts) const {
  const TetMesh& mesh = whole_.mesh;
  for (const std::uint32_t i : at(patch, faces_)) {
    const TaggedFace& f = mesh.tagged_faces()[i];
    if (!parts.is_inside(f.face) && !parts.is_inside(mesh.twin(f.face))) continue;
    parts.faces.push_back(numbers_of(mesh.vertices(f.face), number_));
    parts.face_tags.push_back(f.tag);
    patch.faces.push_back(i);
  }
  for (const std::uint32_t i : at(patch, lines_)) {
    const TaggedLine& l = mesh.tagged_lines()[i];
    if (!std::binary_search(parts.edges.begin(), parts.edges.end(), edge(l.ends[0], l.ends[1]))) continue;
    parts.lines.push_back(numbers_of(l.ends, number_));
    parts.line_tags.push_back(l.tag);
    patch.lines.push_back(i);
  }
}

std::vector<std::array<VertexId, 3>> PatchMaker::rim_of(const std::vector<TetId>& tetrahedra,
                                                        const Parts& parts) const {
  std::vector<std::array<VertexId, 3>> rim;
  for (const TetId t : tetrahedra) {
    for (int f = 0; f < 4; ++f) {
      const HalffaceId h = TetMesh::halfface(t, f);
      if (whole_.mesh.is_boundary(h) || parts.is_inside(whole_.mesh.twin(h))) continue;
      std::array<VertexId, 3> face = whole_.mesh.vertices(h);
      for (VertexId& v : face) v = VertexId(number_[v]);
      std::sort(face.begin(), face.end());
      rim.push_back(face);
    }
  }
  std::sort(rim.begin(), rim.end());
  return rim;
}

namespace {

/// Adds a patch to the mesh that is built next.
void add_patch(const Patch& patch, const Names& of_whole, NextMesh& next, IdVector<VertexId, Mobility>& mobility) {
  const TetMesh& part = patch.draft.mesh;
  const Names& names = patch.draft.names;
  IdVector<VertexId, NextMesh::Number> number;
  for (const VertexId v : part.vertices()) {
    const VertexId name = names.vertices[v];
    if (name.index < patch.vertices.size()) {
      number.push_back(next.number(patch.vertices[name]));
      next.set_point(number[v], part.point(v));
    } else {
      number.push_back(next.add_vertex(part.point(v)));
      mobility.push_back(patch.draft.mobility[name]);
    }
  }
  const auto numbers = [&](const auto& corners) { return numbers_of(corners, number); };
  for (const TetId t : part.tetrahedra()) next.add_tetrahedron(numbers(part.corners(t)), part.region(t));
  // A tag on the border of two patches is in both, and neither has changed it: the first one brings it.
  std::vector<std::uint8_t> mine;
  for (const std::uint32_t i : patch.faces) mine.push_back(next.drop_face(i) ? 1 : 0);
  for (std::size_t i = 0; i < part.tagged_faces().size(); ++i) {
    const TaggedFace& f = part.tagged_faces()[i];
    const std::uint32_t name = names.faces[i];
    if (mine[name] != 0) next.add_face(numbers(part.vertices(f.face)), f.tag, of_whole.faces[patch.faces[name]]);
  }
  mine.clear();
  for (const std::uint32_t i : patch.lines) mine.push_back(next.drop_line(i) ? 1 : 0);
  for (std::size_t i = 0; i < part.tagged_lines().size(); ++i) {
    const TaggedLine& l = part.tagged_lines()[i];
    const std::uint32_t name = names.lines[i];
    if (mine[name] != 0) next.add_line(numbers(l.ends), l.tag, of_whole.lines[patch.lines[name]]);
  }
}

}  // namespace

bool put_back(std::span<const Patch> patches, Draft& whole) {
  const TetMesh& mesh = whole.mesh;
  IdVector<TetId, std::uint8_t> gone(mesh.n_tetrahedra());
  IdVector<VertexId, std::uint8_t> removed(mesh.n_vertices());
  for (const Patch& patch : patches) {
    for (const TetId t : patch.tetrahedra) gone[t] = 1;
    for (const VertexId v : patch.vertices) removed[v] = 1;
    for (const VertexId v : patch.draft.names.vertices) {
      if (v.index < patch.vertices.size()) removed[patch.vertices[v]] = 0;
    }
  }
  NextMesh next(mesh, whole.names, gone, removed);
  IdVector<VertexId, Mobility> mobility = whole.mobility;
  for (const Patch& patch : patches) add_patch(patch, whole.names, next, mobility);
  auto made = next.build();
  if (!made) return false;
  std::tie(whole.mesh, whole.names) = *std::move(made);
  whole.mobility = std::move(mobility);
  for (const Patch& patch : patches) whole.flips += patch.draft.flips;
  return true;
}

}  // namespace temper::tets
