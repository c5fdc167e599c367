// The target edge length at each place: size(x) = min(wanted(x), min over sources of s + grade · |x − p|).
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/bounding_boxes.hpp"
#include "geometry/surface.hpp"
#include "temper/detail/size.hpp"

namespace temper::mesher {

// Sources are the ends of short edges, places where two pieces of the outline face each other, and corners. The minimum
// over all of them is the largest function that is at most s at each and grows no faster than `grade`. If a given size
// field grows faster, its vertices are sources.

struct SizeSource {
  Vec3 at;
  double size = 0;
};

/// The size before grading: the size of a field, with an upper bound.
struct WantedSize {
  double most = 0;
  const SizeField* field = nullptr;  ///< or none

  [[nodiscard]] double at(Vec3 x, const Surface& surface) const {
    return field == nullptr ? most : std::min(most, field->at(surface.vertex(x)).size);
  }
};

class GradedSize {
 public:
  GradedSize(const Surface& surface, std::span<const SizeSource> sources, const WantedSize& wanted, double grade);
  /// O(log n) if sources are spread evenly.
  [[nodiscard]] double operator()(Vec3 x) const;
  [[nodiscard]] bool has_field() const { return wanted_.field != nullptr; }
  [[nodiscard]] const Surface& surface() const { return surface_; }
  /// A place of the sphere: with a field the first one of its least size.
  [[nodiscard]] Vec3 start() const;

 private:
  struct Node {
    BoundingBox box;   // of the sources below
    double least = 0;  // size among them
    std::uint32_t begin = 0, end = 0;
    std::uint32_t right = 0;  // the left child follows its parent; 0 for a leaf
  };
  std::uint32_t build(std::size_t begin, std::size_t end);
  [[nodiscard]] double bound(const Node& node, Vec3 x) const;
  void lower(std::uint32_t at, Vec3 x, double& best) const;

  std::vector<SizeSource> sources_;
  std::vector<Node> nodes_;
  const Surface& surface_;
  WantedSize wanted_;
  double grade_;
};

}  // namespace temper::mesher
