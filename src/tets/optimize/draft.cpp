#include "tets/optimize/draft.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/sort_unique.hpp"
#include "tets/mesh/rebuild.hpp"

namespace temper::tets {
namespace {

constexpr std::array<std::array<std::size_t, 2>, 6> kEdges = {{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

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

Patch patch_of(const Draft& whole, std::vector<TetId> tetrahedra) {
  const TetMesh& mesh = whole.mesh;
  Patch patch;
  IdVector<TetId, std::uint8_t> inside(mesh.n_tetrahedra());
  for (const TetId t : tetrahedra) inside[t] = 1;
  IdVector<VertexId, std::int32_t> number(mesh.n_vertices(), -1);
  IdVector<VertexId, std::uint8_t> stays(mesh.n_vertices());
  for (const TetId t : mesh.tetrahedra()) {
    for (const VertexId v : mesh.corners(t)) {
      if (inside[t] == 0) {
        stays[v] = 1;
      } else if (number[v] < 0) {
        number[v] = static_cast<std::int32_t>(patch.vertices.size());
        patch.vertices.push_back(v);
      }
    }
  }
  const auto numbers = [&](const auto& corners) {
    std::array<std::int32_t, std::tuple_size_v<std::decay_t<decltype(corners)>>> result;
    for (std::size_t k = 0; k < result.size(); ++k) result[k] = number[corners[k]];
    return result;
  };
  std::vector<Vec3> points;
  std::vector<double> weights;
  IdVector<VertexId, Mobility> mobility;
  for (const VertexId v : patch.vertices) {
    points.push_back(mesh.position(v));
    weights.push_back(mesh.weight(v));
    mobility.push_back(stays[v] != 0 ? Mobility::none : whole.mobility_of(v));
  }
  std::vector<std::array<std::int32_t, 4>> corners;
  std::vector<std::int32_t> regions, face_tags, line_tags, marked, point_tags;
  std::vector<std::array<VertexId, 2>> edges;
  for (const TetId t : tetrahedra) {
    corners.push_back(numbers(mesh.corners(t)));
    regions.push_back(mesh.region(t));
    for (const auto& [i, j] : kEdges) edges.push_back(edge(mesh.corners(t)[i], mesh.corners(t)[j]));
  }
  sort_unique(edges);
  std::vector<std::array<std::int32_t, 3>> faces;
  std::vector<std::array<std::int32_t, 2>> lines;
  for (std::size_t i = 0; i < mesh.tagged_faces().size(); ++i) {
    const TaggedFace& f = mesh.tagged_faces()[i];
    const HalffaceId other = mesh.twin(f.face);
    if (inside[TetMesh::tetrahedron(f.face)] == 0 && !(other.valid() && inside[TetMesh::tetrahedron(other)] != 0))
      continue;
    faces.push_back(numbers(mesh.vertices(f.face)));
    face_tags.push_back(f.tag);
    patch.faces.push_back(static_cast<std::uint32_t>(i));
  }
  for (std::size_t i = 0; i < mesh.tagged_lines().size(); ++i) {
    const TaggedLine& l = mesh.tagged_lines()[i];
    if (!std::binary_search(edges.begin(), edges.end(), edge(l.ends[0], l.ends[1]))) continue;
    lines.push_back(numbers(l.ends));
    line_tags.push_back(l.tag);
    patch.lines.push_back(static_cast<std::uint32_t>(i));
  }
  TetMeshInput input;
  input.points = points, input.weights = weights;
  input.tetrahedra = corners, input.regions = regions;
  input.faces = faces, input.face_tags = face_tags;
  input.lines = lines, input.line_tags = line_tags;
  if (std::optional<TetMesh> built = rebuilt(input)) patch.draft = Draft(*std::move(built), std::move(mobility));
  patch.tetrahedra = std::move(tetrahedra);
  return patch;
}

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
  for (const Patch& patch : patches) {
    const auto& [part, names, mobility_of_part, flips] = patch.draft;
    IdVector<VertexId, NextMesh::Number> number;
    for (const VertexId v : part.vertices()) {
      const VertexId name = names.vertices[v];
      if (name.index < patch.vertices.size()) {
        number.push_back(next.number(patch.vertices[name]));
        next.set_point(number[v], part.point(v));
      } else {
        number.push_back(next.add_vertex(part.point(v)));
        mobility.push_back(mobility_of_part[name]);
      }
    }
    const auto numbers = [&](const auto& corners) {
      std::array<NextMesh::Number, std::tuple_size_v<std::decay_t<decltype(corners)>>> result;
      for (std::size_t k = 0; k < result.size(); ++k) result[k] = number[corners[k]];
      return result;
    };
    for (const TetId t : part.tetrahedra()) next.add_tetrahedron(numbers(part.corners(t)), part.region(t));
    // A tag on the border of two patches is in both, and neither has changed it: the first one brings it.
    std::vector<std::uint8_t> mine;
    for (const std::uint32_t i : patch.faces) mine.push_back(next.drop_face(i) ? 1 : 0);
    for (std::size_t i = 0; i < part.tagged_faces().size(); ++i) {
      const TaggedFace& f = part.tagged_faces()[i];
      const std::uint32_t name = names.faces[i];
      if (mine[name] != 0) next.add_face(numbers(part.vertices(f.face)), f.tag, whole.names.faces[patch.faces[name]]);
    }
    mine.clear();
    for (const std::uint32_t i : patch.lines) mine.push_back(next.drop_line(i) ? 1 : 0);
    for (std::size_t i = 0; i < part.tagged_lines().size(); ++i) {
      const TaggedLine& l = part.tagged_lines()[i];
      const std::uint32_t name = names.lines[i];
      if (mine[name] != 0) next.add_line(numbers(l.ends), l.tag, whole.names.lines[patch.lines[name]]);
    }
  }
  auto made = next.build();
  if (!made) return false;
  std::tie(whole.mesh, whole.names) = *std::move(made);
  whole.mobility = std::move(mobility);
  for (const Patch& patch : patches) whole.flips += patch.draft.flips;
  return true;
}

}  // namespace temper::tets
