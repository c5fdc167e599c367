#include "tets/topology/cavity.hpp"

#include <algorithm>
#include <utility>

#include "tets/energy/star.hpp"

namespace temper::tets {
namespace {

template <class T>
bool contains(const std::vector<T>& all, const T& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

template <std::size_t N>
bool has(const std::array<VertexId, N>& corners, VertexId v) {
  return std::find(corners.begin(), corners.end(), v) != corners.end();
}

}  // namespace

Cavities::Cavities(const TetMesh& mesh) : mesh_(mesh), stays_(mesh.n_halffaces()), on_line_(mesh.n_vertices()) {
  for (const HalffaceId h : mesh.halffaces()) stays_[h] = mesh.bounds_region(h) ? 1 : 0;
  for (const TaggedFace& tagged : mesh.tagged_faces()) {
    stays_[tagged.face] = 1;
    if (const HalffaceId other = mesh.twin(tagged.face); other.valid()) stays_[other] = 1;
  }
  for (const TaggedLine& tagged : mesh.tagged_lines()) {
    const auto [a, b] = std::minmax(tagged.ends[0], tagged.ends[1]);
    lines_.push_back({a, b});
    on_line_[a] = on_line_[b] = 1;
  }
  std::sort(lines_.begin(), lines_.end());
}

Cavity Cavities::around(std::vector<TetId> tetrahedra) const {
  Cavity cavity{std::move(tetrahedra), {}};
  for (const TetId t : cavity.tetrahedra) {
    for (int f = 0; f < 4; ++f) {
      const HalffaceId h = TetMesh::halfface(t, f), other = mesh_.twin(h);
      if (!other.valid() || !contains(cavity.tetrahedra, TetMesh::tetrahedron(other))) cavity.faces.push_back(h);
    }
  }
  return cavity;
}

bool Cavities::is_line(VertexId a, VertexId b) const {
  return std::binary_search(lines_.begin(), lines_.end(), std::array{std::min(a, b), std::max(a, b)});
}

Cavity Cavities::of_tetrahedron(TetId t) const { return around({t}); }

std::optional<Cavity> Cavities::of_face(HalffaceId h) const {
  if (stays_[h] != 0) return std::nullopt;
  return around({TetMesh::tetrahedron(h), TetMesh::tetrahedron(mesh_.twin(h))});
}

std::optional<Cavity> Cavities::of_edge(TetId t, VertexId a, VertexId b) const {
  auto [ring, stays] = fan(t, a, b);
  if (stays) return std::nullopt;
  return around(std::move(ring));
}

/// The tetrahedra around an edge, and whether it or a face between them stays.
std::pair<std::vector<TetId>, bool> Cavities::fan(TetId t, VertexId a, VertexId b) const {
  std::vector<TetId> all = {t};
  bool stays = is_line(a, b);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (int f = 0; f < 4; ++f) {
      const HalffaceId h = TetMesh::halfface(all[i], f), other = mesh_.twin(h);
      if (const VertexId across = mesh_.opposite(h); across == a || across == b) continue;  // without the edge
      stays = stays || stays_[h] != 0;
      if (other.valid() && !contains(all, TetMesh::tetrahedron(other))) all.push_back(TetMesh::tetrahedron(other));
    }
  }
  return {std::move(all), stays};
}

std::optional<Cavity> Cavities::to_split(HalffaceId h) const {
  if (stays_[h] == 0) return std::nullopt;
  const auto [a, b, c] = mesh_.vertices(h);
  std::vector<TetId> sides = {TetMesh::tetrahedron(h)};
  if (!mesh_.is_boundary(h)) sides.push_back(TetMesh::tetrahedron(mesh_.twin(h)));
  Cavity cavity = around(std::move(sides));
  std::erase(cavity.faces, h);
  cavity.split = {a, b, c};
  return cavity;
}

std::optional<Cavity> Cavities::to_split(TetId t, VertexId a, VertexId b) const {
  auto [all, stays] = fan(t, a, b);
  if (!stays) return std::nullopt;
  Cavity cavity{std::move(all), {}, {a, b}};
  for (const TetId s : cavity.tetrahedra) {
    cavity.faces.push_back(mesh_.halfface_opposite(s, a));
    cavity.faces.push_back(mesh_.halfface_opposite(s, b));
  }
  return cavity;
}

std::optional<Cavity> Cavities::of_vertex(VertexId v) const {
  if (on_line_[v] != 0) return std::nullopt;
  std::vector<HalffaceId> link;
  collect_link(mesh_, v, link);
  std::vector<TetId> star;
  for (const HalffaceId h : link) {
    const TetId t = TetMesh::tetrahedron(h);
    star.push_back(t);
    for (int f = 0; f < 4; ++f) {
      const HalffaceId side = TetMesh::halfface(t, f);
      if (side != h && stays_[side] != 0) return std::nullopt;
    }
  }
  return around(std::move(star));
}

std::vector<HalffaceId> Filling::base(const TetMesh& mesh) const {
  std::vector<HalffaceId> faces;
  for (const HalffaceId h : cavity.faces) {
    if (!has(mesh.vertices(h), apex)) faces.push_back(h);
  }
  return faces;
}

bool is_valid(const TetMesh& mesh, const Filling& filling) {
  const Vec3 apex = filling.apex.valid() ? mesh.position(filling.apex) : filling.point.position();
  const std::vector<HalffaceId> base = filling.base(mesh);
  return std::all_of(base.begin(), base.end(), [&](HalffaceId h) {
    const auto [a, b, c] = mesh.vertices(h);
    return orientation(mesh.position(a), mesh.position(b), mesh.position(c), apex) == Sign::positive;
  });
}

std::optional<std::pair<TetMesh, Names>> filled(const TetMesh& mesh, std::span<const Filling> fillings,
                                                const Names& names) {
  IdVector<TetId, std::uint8_t> gone(mesh.n_tetrahedra());
  IdVector<VertexId, std::uint8_t> removed(mesh.n_vertices());
  for (const Filling& f : fillings) {
    for (const TetId t : f.cavity.tetrahedra) gone[t] = 1;
    if (f.removed.valid()) removed[f.removed] = 1;
  }
  NextMesh next(mesh, names, gone, removed);
  for (const Filling& f : fillings) {
    const NextMesh::Number apex = f.apex.valid() ? next.number(f.apex) : next.add_vertex(f.point);
    if (!f.cavity.split.empty()) next.split(f.cavity.split, apex);
    for (const HalffaceId h : f.base(mesh)) {
      const auto [a, b, c] = next.numbers(mesh.vertices(h));
      next.add_tetrahedron({a, b, c, apex}, mesh.region(TetMesh::tetrahedron(h)));
    }
  }
  return next.build();
}

}  // namespace temper::tets
