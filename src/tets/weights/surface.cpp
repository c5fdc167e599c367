#include "tets/weights/surface.hpp"

#include <algorithm>
#include <tuple>

#include "base/sort_unique.hpp"

namespace temper::tets {
namespace {

using Kind = WeightConstraint::Kind;

// cos² of the angle between the normals of flat faces: 5.07 degrees. A short number, so that exact arithmetic agrees.
constexpr double kFlatCosineSquared = 127.0 / 128;

bool are_flat(Vec3 normal, Vec3 other) {
  const double both = dot(normal, other);
  return both > 0 && both * both >= kFlatCosineSquared * squared_length(normal) * squared_length(other);
}

/// An edge of a face that bounds a region.
struct SurfaceSide {
  VertexId p, q;  ///< p < q
  VertexId r;     ///< the third corner of the face
  HalffaceId face;
};

std::vector<SurfaceSide> sides_of(const TetMesh& mesh) {
  std::vector<SurfaceSide> sides;
  for (const HalffaceId h : mesh.halffaces()) {
    if (!mesh.bounds_region(h) || !mesh.is_face_representative(h)) continue;
    const auto [a, b, c] = mesh.vertices(h);
    for (const auto& [p, q, r] : {std::tuple(a, b, c), {b, c, a}, {c, a, b}})
      sides.push_back({std::min(p, q), std::max(p, q), r, h});
  }
  std::sort(sides.begin(), sides.end(), [](const SurfaceSide& a, const SurfaceSide& b) {
    return std::tie(a.p, a.q, a.face) < std::tie(b.p, b.q, b.face);
  });
  return sides;
}

}  // namespace

SurfaceRows::SurfaceRows(const TetMesh& mesh) {
  const std::vector<SurfaceSide> sides = sides_of(mesh);
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
    const auto& [p, q, r, face] = sides[first];
    while (last < sides.size() && sides[last].p == p && sides[last].q == q) ++last;
    if (last - first == 2) {
      const auto& [unused_p, unused_q, s, other] = sides[first + 1];
      const Vec3 origin = mesh.position(p), pq = mesh.position(q) - origin;
      const Vec3 up = cross(pq, mesh.position(r) - origin), down = cross(mesh.position(s) - origin, pq);
      if (are_flat(up, down)) {
        rows_.push_back({{Kind::dual, p, q, r, s}, {face, other}});
        // The same row if the faces are coplanar: then c is 1.
        if (orientation(mesh.position(p), mesh.position(q), mesh.position(r), mesh.position(s)) != Sign::zero)
          rows_.push_back({{Kind::dual, q, p, s, r}, {face, other}});
        continue;
      }
    }
    for (std::size_t k = first; k < last; ++k) rows_.push_back({{Kind::height, p, q, sides[k].r}, {sides[k].face}});
  }
  std::vector<std::array<std::uint32_t, 2>> pairs;  // (tetrahedron, row)
  for (std::uint32_t row = 0; row < rows_.size(); ++row) {
    for (const HalffaceId h : rows_[row].faces) {
      if (!h.valid()) continue;
      pairs.push_back({TetMesh::tetrahedron(h).index, row});
      if (!mesh.is_boundary(h)) pairs.push_back({TetMesh::tetrahedron(mesh.twin(h)).index, row});
    }
  }
  sort_unique(pairs);
  start_.assign(mesh.n_tetrahedra() + 1, 0);
  for (const auto& [t, row] : pairs) ++start_[t + 1], list_.push_back(row);
  for (std::size_t t = 0; t < mesh.n_tetrahedra(); ++t) start_[t + 1] += start_[t];
}

}  // namespace temper::tets
