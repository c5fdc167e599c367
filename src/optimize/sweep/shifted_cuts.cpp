#include "optimize/sweep/shifted_cuts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/hilbert.hpp"
#include "mesh/blocks.hpp"

namespace temper {
namespace {

constexpr std::size_t kVerticesPerSample = 16;  // of those whose keys say where to cut

/// The box of a mesh of the plane, or the cell of a periodic one.
struct Extent {
  Vec2 low{}, size{};

  explicit Extent(const Mesh& mesh) {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    low = {kInf, kInf};
    Vec2 high{-kInf, -kInf};
    for (const VertexId v : mesh.vertices()) {
      const Vec2 p = mesh.position(v);
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    size = high - low;
    if (mesh.space().is_periodic()) {
      const Vec2 period = mesh.space().period();
      if (period.x > 0) size.x = period.x;
      if (period.y > 0) size.y = period.y;
    }
  }
};

/// Keys along a curve whose grid is shifted by a part of the longer side.
class ShiftedCurve {
 public:
  ShiftedCurve(const Mesh& mesh, const Extent& extent, double part)
      : period_(mesh.space().is_periodic() ? mesh.space().period() : Vec2{}),
        low_(extent.low),
        shift_{part * side(extent), part * side(extent)},
        curve_({0, 0}, {2 * side(extent), 2 * side(extent)}) {
    // Around a period the curve begins elsewhere; its grid is that of the cell.
    if (period_.x > 0) shift_.x = part * period_.x;
    if (period_.y > 0) shift_.y = part * period_.y;
  }

  std::uint64_t operator()(Vec2 p) const {
    return curve_({along(p.x - low_.x + shift_.x, period_.x), along(p.y - low_.y + shift_.y, period_.y)});
  }

 private:
  static double side(const Extent& extent) { return std::max(extent.size.x, extent.size.y); }
  static double along(double t, double period) {
    return period > 0 ? std::max(0.0, t - period * std::floor(t / period)) : t;
  }

  Vec2 period_, low_, shift_;
  HilbertGrid curve_;
};

/// Turned by a radian around an axis, another one for each cut: near one axis the other two turn.
Vec3 turned(Vec3 p, std::size_t cut) {
  constexpr std::array<Vec3, ShiftedCuts::kCuts> kAxes = {{{2, 3, 6}, {6, 2, -3}, {3, -6, 2}}};  // of length 7
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

void ShiftedCuts::cut(const Mesh& mesh, std::size_t count, Executor& executor) {
  n_parts_ = std::min<std::size_t>(count, std::numeric_limits<PartNumber>::max());
  const Extent extent(mesh);
  for (std::size_t k = 0; k < kCuts; ++k) {
    if (mesh.space().is_plane()) {
      const ShiftedCurve curve(mesh, extent, static_cast<double>(k + 1) / 5);
      part_of_[k] = parts_along(mesh, n_parts_, executor, [&](VertexId v) { return curve(mesh.position(v)); });
    } else {
      part_of_[k] = parts_along(mesh, n_parts_, executor,
                                [&](VertexId v) { return cube_hilbert_index(turned(mesh.lifted_point(v), k)); });
    }
  }
}

}  // namespace temper
