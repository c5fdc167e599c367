// The edge length wanted at each place: size(x) = min(cap, min over sources of s + grade · |x − p|).
//
// Sources are the ends of short edges, places where two pieces of the outline face each other, corners. The minimum
// over all of them is the largest function that is no more than s at each and grows no faster than `grade`.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "temper/vec2.hpp"

namespace temper::mesher {

struct SizeSource {
  Vec2 at;
  double size = 0;
};

class GradedSize {
 public:
  GradedSize(std::span<const SizeSource> sources, double cap, double grade);
  /// O(log n) where sources are spread evenly.
  [[nodiscard]] double operator()(Vec2 x) const;
  [[nodiscard]] double cap() const { return cap_; }

 private:
  struct Node {
    Vec2 low, high;    // of the sources below
    double least = 0;  // size among them
    std::uint32_t begin = 0, end = 0;
    std::uint32_t right = 0;  // the left child follows its parent; 0 for a leaf
  };
  std::uint32_t build(std::size_t begin, std::size_t end);
  [[nodiscard]] double bound(const Node& node, Vec2 x) const;
  void lower(std::uint32_t at, Vec2 x, double& best) const;

  std::vector<SizeSource> sources_;
  std::vector<Node> nodes_;
  double cap_, grade_;
};

}  // namespace temper::mesher
