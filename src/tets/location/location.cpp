// Places by walks through tetrahedra, with exact tests of sides.
#include "temper/tets/location.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <unordered_set>
#include <vector>

#include "temper/detail/executor.hpp"
#include "temper/tets/geometry.hpp"

namespace temper::tets {
namespace {

// The longest walk before all tetrahedra are tried. A vertex step crosses a few, and a walk that circles must end.
constexpr int kLongestWalk = 200;

/// A face of t that has p on its outer side; nothing if p is in t.
std::optional<int> face_towards(const TetMesh& mesh, TetId t, Vec3 p, int first) {
  for (int k = 0; k < 4; ++k) {
    const int f = (first + k) % 4;
    const auto [a, b, c] = mesh.vertices(TetMesh::halfface(t, f));
    if (orientation(mesh.position(a), mesh.position(b), mesh.position(c), p) == Sign::negative) return f;
  }
  return std::nullopt;
}

/// Says whether p is in t, or so close to it that rounding may have moved it outside: a new vertex on the boundary.
bool is_nearly_in(const TetMesh& mesh, TetId t, Vec3 p) {
  constexpr double kRounding = 1e-9;
  for (int f = 0; f < 4; ++f) {
    const HalffaceId h = TetMesh::halfface(t, f);
    const auto corners = mesh.vertices(h);
    const auto volumes = [&](Vec3 q) {
      return six_volumes(mesh.position(corners[0]), mesh.position(corners[1]), mesh.position(corners[2]), q);
    };
    if (volumes(p) < -kRounding * volumes(mesh.position(mesh.opposite(h)))) return false;
  }
  return true;
}

/// The place of p, which is in t.
Place place_in(const TetMesh& mesh, TetId t, Vec3 p) {
  const auto& corners = mesh.corners(t);
  Place place{t};
  double sum = 0;
  for (int f = 0; f < 4; ++f) {
    const VertexId v = corners[static_cast<std::size_t>(f)];
    if (mesh.position(v) == p) return {t, 1, {v}, {1}};
    const auto [a, b, c] = mesh.vertices(TetMesh::halfface(t, f));
    const double share = six_volumes(mesh.position(a), mesh.position(b), mesh.position(c), p);
    if (!(share > 0)) continue;
    const auto to = static_cast<std::size_t>(place.n++);
    place.corners[to] = v;
    sum += place.shares[to] = share;
  }
  if (place.n == 0) return {t, 1, {corners[0]}, {1}};  // in a tetrahedron that is all rounding
  for (double& share : place.shares) share /= sum;
  return place;
}

/// Calls use(i) for each of n items, on threads.
template <class Use>
void for_each(std::size_t n, Executor* executor, const Use& use) {
  constexpr std::size_t kItems = 4096;
  or_serial(executor).run((n + kItems - 1) / kItems, [&](std::size_t block) {
    for (std::size_t i = kItems * block; i < std::min(n, kItems * (block + 1)); ++i) use(i);
  });
}

/// Two meshes, and the numbers of vertices in the former one.
struct Change {
  const TetMesh &before, &after;
  const IdVector<VertexId, VertexId>& vertices;

  [[nodiscard]] VertexId former(VertexId v) const { return vertices.empty() ? v : vertices[v]; }
  [[nodiscard]] bool stays(VertexId v) const {
    const VertexId was = former(v);
    return was.valid() && before.position(was) == after.position(v);
  }
  /// Says whether t has the same corners in the former mesh, at the same places.
  [[nodiscard]] bool is_same(TetId t) const {
    if (t.index >= before.n_tetrahedra()) return false;
    std::array<VertexId, 4> now, then = before.corners(t);
    for (std::size_t k = 0; k < 4; ++k) {
      const VertexId v = after.corners(t)[k];
      if (!stays(v)) return false;
      now[k] = former(v);
    }
    std::ranges::sort(now), std::ranges::sort(then);
    return now == then;
  }
};

}  // namespace

TetId find_tetrahedron(const TetMesh& mesh, Vec3 p, TetId near) {
  TetId t = near;
  for (int steps = 0; steps < kLongestWalk; ++steps) {
    const std::optional<int> face = face_towards(mesh, t, p, steps);
    if (!face) return t;
    const HalffaceId beyond = mesh.twin(TetMesh::halfface(t, *face));
    if (!beyond.valid()) {
      if (is_nearly_in(mesh, t, p)) return t;
      break;  // the domain need not be convex: p may still be inside
    }
    t = TetMesh::tetrahedron(beyond);
  }
  // Ever larger rings around the place where the walk ended.
  std::vector<TetId> reached = {t};
  std::unordered_set<std::uint32_t> seen = {t.index};
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const TetId s = reached[i];
    if (is_nearly_in(mesh, s, p)) return s;
    for (int f = 0; f < 4; ++f) {
      const HalffaceId beyond = mesh.twin(TetMesh::halfface(s, f));
      if (!beyond.valid()) continue;
      const TetId next = TetMesh::tetrahedron(beyond);
      if (seen.insert(next.index).second) reached.push_back(next);
    }
  }
  return near;
}

TetId tetrahedron_near(const TetMesh& before, const TetMesh& after, const IdVector<VertexId, VertexId>& vertices,
                       TetId t) {
  for (const VertexId v : after.corners(t)) {
    const VertexId was = vertices.empty() ? v : vertices[v];
    if (was.valid()) return before.incident(was);
  }
  return TetId(0);
}

IdVector<VertexId, Place> positions_of_vertices(const TetMesh& before, const TetMesh& after,
                                                const IdVector<VertexId, VertexId>& vertices, Executor* executor) {
  const Change change{before, after, vertices};
  IdVector<VertexId, Place> places(after.n_vertices());
  for_each(after.n_vertices(), executor, [&](std::size_t i) {
    const VertexId v(i), was = change.former(v);
    const TetId near =
        was.valid() ? before.incident(was) : tetrahedron_near(before, after, vertices, after.incident(v));
    const Vec3 p = after.position(v);
    places[v] = change.stays(v) ? Place{near, 1, {was}, {1}} : place_in(before, find_tetrahedron(before, p, near), p);
  });
  return places;
}

IdVector<TetId, TetId> sources_of_tetrahedra(const TetMesh& before, const TetMesh& after,
                                             const IdVector<VertexId, VertexId>& vertices, Executor* executor) {
  const Change change{before, after, vertices};
  IdVector<TetId, TetId> sources(after.n_tetrahedra());
  for_each(after.n_tetrahedra(), executor, [&](std::size_t i) {
    const TetId t(i);
    Vec3 sum;
    for (const VertexId v : after.corners(t)) sum = sum + after.position(v);
    sources[t] =
        change.is_same(t) ? t : find_tetrahedron(before, 0.25 * sum, tetrahedron_near(before, after, vertices, t));
  });
  return sources;
}

}  // namespace temper::tets
