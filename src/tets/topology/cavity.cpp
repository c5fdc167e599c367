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

/// Collects the arrays of the next mesh.
class NextMesh {
 public:
  NextMesh(const TetMesh& mesh, std::span<const Filling> fillings) : mesh_(mesh), number_(mesh.n_vertices(), 0) {
    for (const Filling& f : fillings) {
      if (f.removed.valid()) number_[f.removed.index] = -1;
    }
  }
  void take_vertices(IdVector<VertexId, VertexId>& vertices) {
    for (const VertexId v : mesh_.vertices()) {
      if (number_[v.index] < 0) continue;
      number_[v.index] = static_cast<std::int32_t>(points_.size());
      add_vertex(mesh_.point(v), vertices[v]);
    }
  }
  void take_others(std::span<const Filling> fillings) {
    IdVector<TetId, std::uint8_t> gone(mesh_.n_tetrahedra());
    for (const Filling& f : fillings) {
      for (const TetId t : f.cavity.tetrahedra) gone[t] = 1;
    }
    for (const TetId t : mesh_.tetrahedra()) {
      if (gone[t] != 0) continue;
      tetrahedra_.push_back(numbers(mesh_.corners(t)));
      regions_.push_back(mesh_.region(t));
    }
  }
  void fill(const Filling& f) {
    auto apex = static_cast<std::int32_t>(points_.size());
    if (f.apex.valid()) {
      apex = number_[f.apex.index];
    } else {
      add_vertex(f.point, {});
    }
    for (const HalffaceId h : f.base(mesh_)) {
      const auto [a, b, c] = numbers(mesh_.vertices(h));
      tetrahedra_.push_back({a, b, c, apex});
      regions_.push_back(mesh_.region(TetMesh::tetrahedron(h)));
    }
  }
  std::optional<TetMesh> build(IdVector<VertexId, VertexId>& vertices) {
    std::vector<std::array<std::int32_t, 3>> faces;
    std::vector<std::array<std::int32_t, 2>> lines;
    std::vector<std::int32_t> face_tags, line_tags, marked, point_tags, fixed;
    for (const TaggedFace& f : mesh_.tagged_faces()) {
      faces.push_back(numbers(mesh_.vertices(f.face)));
      face_tags.push_back(f.tag);
    }
    for (const TaggedLine& l : mesh_.tagged_lines()) {
      lines.push_back(numbers(l.ends));
      line_tags.push_back(l.tag);
    }
    for (const TaggedPoint& p : mesh_.tagged_points()) {
      if (number_[p.vertex.index] < 0) continue;
      marked.push_back(number_[p.vertex.index]);
      point_tags.push_back(p.tag);
    }
    for (const VertexId v : mesh_.fixed_points()) fixed.push_back(number_[v.index]);
    TetMeshInput input;
    input.points = points_, input.weights = weights_;
    input.tetrahedra = tetrahedra_, input.regions = regions_;
    input.faces = faces, input.face_tags = face_tags;
    input.lines = lines, input.line_tags = line_tags;
    input.marked_points = marked, input.point_tags = point_tags, input.fixed_points = fixed;
    Expected<BuiltTetMesh> built = TetMesh::build(input);
    if (!built || built->reversed_tetrahedra > 0) return std::nullopt;
    vertices = std::move(vertices_);
    return std::move(built->mesh);
  }

 private:
  void add_vertex(const WeightedPoint& p, VertexId former) {
    points_.push_back(p.position());
    weights_.push_back(p.w);
    vertices_.push_back(former);
  }
  template <std::size_t N>
  [[nodiscard]] std::array<std::int32_t, N> numbers(const std::array<VertexId, N>& corners) const {
    std::array<std::int32_t, N> result;
    for (std::size_t k = 0; k < N; ++k) result[k] = number_[corners[k].index];
    return result;
  }

  const TetMesh& mesh_;
  std::vector<std::int32_t> number_;  // of each vertex in the next mesh; −1: removed
  std::vector<Vec3> points_;
  std::vector<double> weights_;
  IdVector<VertexId, VertexId> vertices_;
  std::vector<std::array<std::int32_t, 4>> tetrahedra_;
  std::vector<std::int32_t> regions_;
};

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

Cavity Cavities::of_tetrahedron(TetId t) const { return around({t}); }

std::optional<Cavity> Cavities::of_face(HalffaceId h) const {
  if (stays_[h] != 0) return std::nullopt;
  return around({TetMesh::tetrahedron(h), TetMesh::tetrahedron(mesh_.twin(h))});
}

std::optional<Cavity> Cavities::of_edge(TetId t, VertexId a, VertexId b) const {
  const auto [first, last] = std::minmax(a, b);
  if (std::binary_search(lines_.begin(), lines_.end(), std::array{VertexId(first), VertexId(last)}))
    return std::nullopt;
  std::vector<TetId> ring = {t};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    for (int f = 0; f < 4; ++f) {
      const HalffaceId h = TetMesh::halfface(ring[i], f);
      const VertexId across = mesh_.opposite(h);
      if (across == a || across == b) continue;  // the other two faces have the edge
      if (stays_[h] != 0) return std::nullopt;
      const TetId next = TetMesh::tetrahedron(mesh_.twin(h));
      if (!contains(ring, next)) ring.push_back(next);
    }
  }
  return around(std::move(ring));
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

std::optional<TetMesh> filled(const TetMesh& mesh, std::span<const Filling> fillings,
                              IdVector<VertexId, VertexId>& vertices) {
  NextMesh next(mesh, fillings);
  next.take_vertices(vertices);
  next.take_others(fillings);
  for (const Filling& f : fillings) next.fill(f);
  return next.build(vertices);
}

}  // namespace temper::tets
