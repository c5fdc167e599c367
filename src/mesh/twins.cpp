#include "mesh/twins.hpp"

#include <algorithm>

#include "mesh/mesh_editor.hpp"
#include "temper/detail/executor.hpp"

namespace temper {

EdgeBuckets::EdgeBuckets(const Mesh& mesh, IdRange<VertexId> lesser)
    : mesh_(mesh), first_((*lesser.begin()).index), end_(lesser.size() + 1, 0) {
  const auto for_sides = [&](auto&& visit) {
    for (const HalfedgeId h : mesh.halfedges()) {
      const std::size_t bucket = std::min(mesh.origin(h), mesh.target(h)).index - first_;
      if (bucket < lesser.size()) visit(bucket, h);
    }
  };
  for_sides([&](std::size_t bucket, HalfedgeId) { ++end_[bucket + 1]; });
  for (std::size_t i = 1; i < end_.size(); ++i) end_[i] += end_[i - 1];
  sorted_.resize(end_.back());
  for_sides([&](std::size_t bucket, HalfedgeId h) { sorted_[end_[bucket]++] = h; });  // from starts to ends
}

void EdgeBuckets::collect(VertexId lesser, std::vector<Side>& sides) const {
  sides.clear();
  const std::size_t bucket = lesser.index - first_;
  for (std::size_t i = bucket == 0 ? 0 : end_[bucket - 1]; i < end_[bucket]; ++i) {
    const HalfedgeId h = sorted_[i];
    sides.push_back({std::max(mesh_.origin(h), mesh_.target(h)), h});
  }
  std::sort(sides.begin(), sides.end());
}

void find_twins(Mesh& mesh, Executor* executor) {
  MeshEditor(mesh).unlink_all();
  or_serial(executor).run(EdgeBuckets::kSlices, [&](std::size_t i) {
    const IdRange<VertexId> slice = EdgeBuckets::slice(mesh, i);
    const EdgeBuckets buckets(mesh, slice);
    std::vector<EdgeBuckets::Side> sides;
    for (const VertexId v : slice) {
      buckets.collect(v, sides);
      for (std::size_t k = 1; k < sides.size(); ++k) {
        if (sides[k - 1].greater == sides[k].greater) {
          MeshEditor(mesh).link(sides[k - 1].halfedge, sides[k].halfedge);
        }
      }
    }
  });
}

}  // namespace temper
