// The squared offsets of tetrahedra (tets/energy/accuracy_energy.hpp), as functions of the weights. As in the plane
// (feasibility/offsets.cpp), V = |σ||σ*| is replaced by a part of the volumes around: half of each tetrahedron for an
// edge, three quarters for a face. The sums over all edges, and over all faces, are three times the volume, as those of
// V.
//
// An edge has the offset of the crossing from its midpoint. The centroid of the dual face is left out, because it is
// not linear in the weights.
//
// A face has the offset of its orthocenter from its centroid, along an edge and over it, and its own offset from the
// midpoint of its dual edge.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "tets/optimize/accuracy.hpp"
#include "tets/quality/measure.hpp"
#include "tets/weights/demand.hpp"

namespace temper::tets {
namespace {

using Kind = WeightConstraint::Kind;

constexpr double kOfEdge = 0.5, kOfFace = 0.75;

double volume(const TetMesh& mesh, TetId t) {
  const auto [p, q, r, s] = mesh.points(t);
  return six_volumes(p.position(), q.position(), r.position(), s.position()) / 6;
}

/// The sum over the tetrahedra at each edge of a part of their volumes.
std::map<std::array<VertexId, 2>, double> volumes_of_edges(const TetMesh& mesh) {
  std::map<std::array<VertexId, 2>, double> of_edge;
  for (const TetId t : mesh.tetrahedra()) {
    std::array<VertexId, 4> v = mesh.corners(t);
    std::sort(v.begin(), v.end());
    const double part = kOfEdge * volume(mesh, t);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) of_edge[{v[i], v[j]}] += part;
    }
  }
  return of_edge;
}

}  // namespace

std::vector<OffsetTerm> TetDemand::offsets(const WeightOptions& options) const {
  const VertexSizes sizes = local_sizes(mesh_);
  std::vector<OffsetTerm> terms;
  for (const auto& [ends, part] : volumes_of_edges(mesh_)) {
    const auto [p, q] = ends;
    const double s = 0.5 * (sizes[p] + sizes[q]), l2 = squared_length(mesh_.position(q) - mesh_.position(p));
    terms.push_back({split_constraint(p, q), options.offset_factor * part * l2 / (s * s), 0.5});
  }
  for (const TetId t : mesh_.tetrahedra()) {
    for (int f = 0; f < 4; ++f) {
      const HalffaceId h = TetMesh::halfface(t, f);
      const bool on_boundary = mesh_.is_boundary(h);
      if (!on_boundary && !mesh_.is_face_representative(h)) continue;
      const auto [p, q, r] = mesh_.vertices(h);
      const double s = (sizes[p] + sizes[q] + sizes[r]) / 3;
      const double part = kOfFace *
                          (volume(mesh_, t) + (on_boundary ? 0 : volume(mesh_, TetMesh::tetrahedron(mesh_.twin(h))))) /
                          (s * s);
      const Vec3 pq = mesh_.position(q) - mesh_.position(p), pr = mesh_.position(r) - mesh_.position(p);
      const double twice_area = length(cross(pq, pr)), side = length_of_area(0.5 * twice_area);
      const double l2 = squared_length(pq), inside = options.offset_factor * part;
      terms.push_back({split_constraint(p, q), inside * l2, (l2 + dot(pq, pr)) / (3 * l2)});
      terms.push_back({{Kind::height, p, q, r}, inside * l2, twice_area / (3 * l2)});
      if (on_boundary) {
        terms.push_back({over_face(h), options.boundary_offset_factor * part * side * side / 4, 0});
      } else {
        terms.push_back({dual(h), inside * side * side, 0});
      }
    }
  }
  return terms;
}

}  // namespace temper::tets
