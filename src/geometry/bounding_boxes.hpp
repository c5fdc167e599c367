// A static tree of bounding boxes: it finds the segments, or other things, near a place.
//
// Boxes are halved by count along the longest side of their union, down to leaves of a few boxes. The tree is an
// implicit array, so it costs one sort and no pointers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "temper/detail/vec.hpp"

namespace temper {

struct BoundingBox {
  Vec3 low, high;

  [[nodiscard]] bool meets(const BoundingBox& other) const {
    return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y && other.low.y <= high.y &&
           low.z <= other.high.z && other.low.z <= high.z;
  }
  [[nodiscard]] BoundingBox grown(double margin) const {
    const Vec3 all = {margin, margin, margin};
    return {low - all, high + all};
  }
  /// The coordinate along which it is longest.
  [[nodiscard]] double Vec3::*longest() const {
    const Vec3 sides = high - low;
    if (sides.x >= sides.y && sides.x >= sides.z) return &Vec3::x;
    return sides.y >= sides.z ? &Vec3::y : &Vec3::z;
  }
};

[[nodiscard]] inline BoundingBox united(const BoundingBox& a, const BoundingBox& b) {
  return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y), std::min(a.low.z, b.low.z)},
          {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y), std::max(a.high.z, b.high.z)}};
}
/// Around two points.
[[nodiscard]] inline BoundingBox box_of(Vec3 a, Vec3 b) { return united({a, a}, {b, b}); }
/// Around some vertices of a mesh in space; the origin if there are none.
template <class AnyMesh, class Vertices>
[[nodiscard]] BoundingBox bounding_box(const AnyMesh& mesh, const Vertices& vertices) {
  if (vertices.begin() == vertices.end()) return {};
  const Vec3 first = mesh.position(*vertices.begin());
  BoundingBox box = {first, first};
  for (const auto v : vertices) box = united(box, {mesh.position(v), mesh.position(v)});
  return box;
}
template <class AnyMesh>
[[nodiscard]] BoundingBox bounding_box(const AnyMesh& mesh) {
  return bounding_box(mesh, mesh.vertices());
}

class BoundingBoxTree {
 public:
  BoundingBoxTree() = default;
  explicit BoundingBoxTree(std::span<const BoundingBox> boxes)
      : boxes_(boxes.begin(), boxes.end()), order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (!boxes_.empty()) build(0, order_.size());
  }

  /// Calls f(i) for every box i that meets `box`, until f returns false. Returns true if f never did.
  template <class F>
  bool visit(const BoundingBox& box, const F& f) const {
    return nodes_.empty() || visit(0, box, f);
  }

 private:
  static constexpr std::size_t kLeaf = 4;  // boxes tested one by one: about what one step down the tree costs

  struct Node {
    BoundingBox box;
    std::uint32_t begin, end;
    std::uint32_t right;  // the left child follows its parent; 0 for a leaf
  };

  std::uint32_t build(std::size_t begin, std::size_t end) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    BoundingBox all = boxes_[order_[begin]];
    for (std::size_t i = begin + 1; i < end; ++i) all = united(all, boxes_[order_[i]]);
    nodes_.push_back({all, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end), 0});
    if (end - begin <= kLeaf) return index;
    double Vec3::*const side = all.longest();
    const std::size_t middle = begin + (end - begin) / 2;
    const auto key = [&](std::uint32_t i) {
      const BoundingBox& b = boxes_[i];
      return b.low.*side + b.high.*side;
    };
    std::nth_element(order_.begin() + static_cast<std::ptrdiff_t>(begin),
                     order_.begin() + static_cast<std::ptrdiff_t>(middle),
                     order_.begin() + static_cast<std::ptrdiff_t>(end),
                     [&](std::uint32_t i, std::uint32_t j) { return key(i) < key(j) || (key(i) == key(j) && i < j); });
    build(begin, middle);
    const std::uint32_t right = build(middle, end);
    nodes_[index].right = right;
    return index;
  }

  template <class F>
  bool visit(std::uint32_t at, const BoundingBox& box, const F& f) const {
    const Node& node = nodes_[at];
    if (!node.box.meets(box)) return true;
    if (node.right != 0) return visit(at + 1, box, f) && visit(node.right, box, f);
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      if (boxes_[order_[i]].meets(box) && !f(order_[i])) return false;
    }
    return true;
  }

  std::vector<BoundingBox> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace temper
