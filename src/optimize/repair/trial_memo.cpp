#include "optimize/repair/trial_memo.hpp"

#include "base/bytes.hpp"

namespace temper {
namespace {

std::string bytes_of(const Neighborhood& around, Pace pace) {
  const Mesh& mesh = around.mesh;
  std::string bytes;
  ByteWriter out(bytes);
  out.write(pace);
  out.write(around.seed);
  out.write(mesh.n_vertices());
  for (const VertexId v : mesh.vertices()) {
    out.write(mesh.point(v));
    out.write(mesh.is_fixed(v));
    const OutsideNeighbors& outside = around.outside[v.index];
    out.write(outside.points);
    out.write(outside.is_outside);
    out.write(outside.is_closed);
  }
  out.write(around.frozen);
  for (const HalfedgeId h : mesh.halfedges()) {
    out.write(mesh.origin(h));
    out.write(mesh.twin(h));
    for (const bool flag : {mesh.is_constrained(h), mesh.joins_halves(h), mesh.is_joint(h), mesh.is_face(h)}) {
      out.write(flag);
    }
  }
  for (const TriangleId t : mesh.triangles()) out.write(mesh.region(t));
  out.write(around.beyond);
  out.write(around.region_beyond);
  for (const auto& [v, edge] : around.divided) {
    out.write(v);
    out.write(edge);
  }
  return bytes;
}

}  // namespace

TrialMemo::Results& TrialMemo::at(const Neighborhood& around, Pace pace) {
  if (places_.size() == kMostPlaces) places_.clear();
  return places_[bytes_of(around, pace)];
}

}  // namespace temper
