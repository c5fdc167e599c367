#include "tets/topology/next_mesh.hpp"

#include <algorithm>
#include <numeric>

#include "tets/mesh/rebuild.hpp"

namespace temper::tets {
namespace {

/// Moves the tagged elements that are left to the arrays of an input, by their names.
template <class Tagged, class Elements>
void collect(std::vector<Tagged>& all, Elements& elements, std::vector<std::int32_t>& tags,
             std::vector<std::uint32_t>& names) {
  std::erase_if(all, [](const Tagged& one) { return one.dropped; });
  std::stable_sort(all.begin(), all.end(), [](const Tagged& a, const Tagged& b) { return a.name < b.name; });
  for (const Tagged& one : all) {
    elements.push_back(one.corners);
    tags.push_back(one.tag);
    names.push_back(one.name);
  }
}

std::vector<std::uint32_t> first_numbers(std::size_t n) {
  std::vector<std::uint32_t> all(n);
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

}  // namespace

Names::Names(const TetMesh& mesh)
    : next(mesh.n_vertices()),
      faces(first_numbers(mesh.tagged_faces().size())),
      lines(first_numbers(mesh.tagged_lines().size())) {
  for (const VertexId v : mesh.vertices()) vertices.push_back(v);
}

NextMesh::NextMesh(const TetMesh& mesh, const Names& names, const IdVector<TetId, std::uint8_t>& gone,
                   const IdVector<VertexId, std::uint8_t>& removed)
    : number_(mesh.n_vertices(), -1) {
  names_.next = names.next;
  for (const VertexId v : mesh.vertices()) {
    if (removed[v] == 0) number_[v] = add_vertex(mesh.point(v), names.vertices[v]);
  }
  for (const TetId t : mesh.tetrahedra()) {
    if (gone[t] == 0) add_tetrahedron(numbers(mesh.corners(t)), mesh.region(t));
  }
  for (std::size_t i = 0; i < mesh.tagged_faces().size(); ++i) {
    const TaggedFace& f = mesh.tagged_faces()[i];
    add_face(numbers(mesh.vertices(f.face)), f.tag, names.faces[i]);
  }
  for (std::size_t i = 0; i < mesh.tagged_lines().size(); ++i) {
    const TaggedLine& l = mesh.tagged_lines()[i];
    add_line(numbers(l.ends), l.tag, names.lines[i]);
  }
  for (const auto& [vertex, tag] : mesh.tagged_points()) {
    if (number_[vertex] < 0) continue;
    marked_.push_back(number_[vertex]);
    point_tags_.push_back(tag);
  }
  for (const VertexId v : mesh.fixed_points()) fixed_.push_back(number_[v]);
}

NextMesh::Number NextMesh::add_vertex(const WeightedPoint& p, VertexId name) {
  points_.push_back(p.position());
  weights_.push_back(p.w);
  names_.vertices.push_back(name);
  return static_cast<Number>(points_.size()) - 1;
}

void NextMesh::set_point(Number v, const WeightedPoint& p) {
  points_[static_cast<std::size_t>(v)] = p.position();
  weights_[static_cast<std::size_t>(v)] = p.w;
}

void NextMesh::add_tetrahedron(const std::array<Number, 4>& corners, std::int32_t region) {
  tetrahedra_.push_back(corners);
  regions_.push_back(region);
}

/// Of an element that has all of `corners`, the pieces: each has the new vertex in place of one of them.
template <class Tagged>
void split_elements(std::vector<Tagged>& all, const std::vector<NextMesh::Number>& corners, NextMesh::Number at) {
  const std::size_t n = all.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Tagged whole = all[i];
    const auto place = [&](NextMesh::Number c) { return std::ranges::find(whole.corners, c) - whole.corners.begin(); };
    const auto end = std::ssize(whole.corners);
    if (whole.dropped || std::ranges::any_of(corners, [&](NextMesh::Number c) { return place(c) == end; })) continue;
    all[i].dropped = true;
    for (const NextMesh::Number c : corners) {
      Tagged piece = whole;
      piece.corners[static_cast<std::size_t>(place(c))] = at;
      all.push_back(piece);
    }
  }
}

void NextMesh::split(const std::vector<VertexId>& corners, Number at) {
  std::vector<Number> all;
  all.reserve(corners.size());
  for (const VertexId v : corners) all.push_back(number_[v]);
  split_elements(faces_, all, at);
  split_elements(lines_, all, at);
}

std::optional<std::pair<TetMesh, Names>> NextMesh::build() {
  std::vector<std::array<Number, 3>> faces;
  std::vector<std::array<Number, 2>> lines;
  std::vector<std::int32_t> face_tags, line_tags;
  collect(faces_, faces, face_tags, names_.faces);
  collect(lines_, lines, line_tags, names_.lines);
  TetMeshInput input;
  input.points = points_, input.weights = weights_;
  input.tetrahedra = tetrahedra_, input.regions = regions_;
  input.faces = faces, input.face_tags = face_tags;
  input.lines = lines, input.line_tags = line_tags;
  input.marked_points = marked_, input.point_tags = point_tags_, input.fixed_points = fixed_;
  std::optional<TetMesh> mesh = rebuilt(input);
  if (!mesh) return std::nullopt;
  return std::pair(*std::move(mesh), std::move(names_));
}

}  // namespace temper::tets
