#include "optimize/flips/partition.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/box.hpp"
#include "base/hilbert.hpp"
#include "mesh/blocks.hpp"

namespace temper {
namespace {

constexpr std::size_t kVerticesPerSample = 16;  // the keys of the samples give the places of the cuts

/// Keys along a curve whose grid is shifted by a part of the longer side of the box of the mesh, or of its cell.
class ShiftedCurve {
 public:
  ShiftedCurve(const Mesh& mesh, const PlaneBox& box, double part)
      : ShiftedCurve(mesh.space().period(), box, part, longer_side(mesh.space().period(), box)) {}

  std::uint64_t operator()(Vec2 p) const {
    return curve_({along(p.x - low_.x + shift_.x, period_.x), along(p.y - low_.y + shift_.y, period_.y)});
  }

 private:
  // Around a period the curve begins elsewhere, on the grid of the cell.
  ShiftedCurve(Vec2 period, const PlaneBox& box, double part, double side)
      : period_(period),
        low_(box.low),
        shift_{part * (period.x > 0 ? period.x : side), part * (period.y > 0 ? period.y : side)},
        curve_(PlaneBox{{0, 0}, {2 * side, 2 * side}}) {}

  static double longer_side(Vec2 period, const PlaneBox& box) {
    const Vec2 size = box.high - box.low;
    return std::max(period.x > 0 ? period.x : size.x, period.y > 0 ? period.y : size.y);
  }
  static double along(double t, double period) {
    return period > 0 ? std::max(0.0, t - period * std::floor(t / period)) : t;
  }

  Vec2 period_, low_, shift_;
  HilbertGrid curve_;
};

/// Turns p by a radian. Each cut has another axis, since places near one axis hardly turn around it.
Vec3 turned(Vec3 p, std::size_t cut) {
  constexpr std::array<Vec3, ShiftedPartitions::kPartitions> kAxes = {
      {{2, 3, 6}, {6, 2, -3}, {3, -6, 2}}};  // of length 7
  const Vec3 axis = (1.0 / 7) * kAxes[cut];
  const double c = std::cos(1.0), s = std::sin(1.0);
  return c * p + s * cross(axis, p) + (1 - c) * dot(axis, p) * axis;
}

template <class Key>
std::vector<PartNumber> parts_along(const Mesh& mesh, std::size_t count, Executor& executor, const Key& key) {
  const std::size_t n = mesh.n_vertices();
  std::vector<std::uint64_t> keys((n + kVerticesPerSample - 1) / kVerticesPerSample);
  for_each_index(keys.size(), &executor, [&](std::size_t i) { keys[i] = key(VertexId(i * kVerticesPerSample)); });
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint64_t> ends;  // of each part but the last
  for (std::size_t i = 1; i < count; ++i) ends.push_back(keys[i * keys.size() / count]);
  std::vector<PartNumber> part_of(n);
  for_each_index(n, &executor, [&](std::size_t i) {
    const auto end = std::upper_bound(ends.begin(), ends.end(), key(VertexId(i)));
    part_of[i] = static_cast<PartNumber>(end - ends.begin());
  });
  return part_of;
}

}  // namespace

void ShiftedPartitions::cut(const Mesh& mesh, std::size_t count, Executor& executor) {
  n_parts_ = std::min<std::size_t>(count, std::numeric_limits<PartNumber>::max());
  PlaneBox box;
  for (const VertexId v : mesh.vertices()) box.add(mesh.position(v));
  for (std::size_t k = 0; k < kPartitions; ++k) {
    if (mesh.space().is_plane()) {
      const ShiftedCurve curve(mesh, box, static_cast<double>(k + 1) / 5);
      part_of_[k] = parts_along(mesh, n_parts_, executor, [&](VertexId v) { return curve(mesh.position(v)); });
    } else {
      part_of_[k] = parts_along(mesh, n_parts_, executor,
                                [&](VertexId v) { return cube_hilbert_index(turned(mesh.weighted_vector(v), k)); });
    }
  }
}

}  // namespace temper
