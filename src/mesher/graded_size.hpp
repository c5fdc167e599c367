// The edge length wanted at each place: size(x) = min(wanted(x), min over sources of s + grade · |x − p|).
//
// Sources are the ends of short edges, places where two pieces of the outline face each other, corners. The minimum
// over all of them is the largest function that is no more than s at each and grows no faster than `grade`. Where a
// size field that is wanted grows faster, its vertices are sources.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/ground.hpp"
#include "temper/detail/size.hpp"

namespace temper::mesher {

struct SizeSource {
  Vec3 at;
  double size = 0;
};

/// The size before grading: of a field, and nowhere more than a number.
struct WantedSize {
  double most = 0;
  const SizeField* field = nullptr;  ///< or none

  [[nodiscard]] double at(Vec3 x, const Ground& ground) const {
    return field == nullptr ? most : std::min(most, field->at(ground.vertex(x)).size);
  }
};

class GradedSize {
 public:
  GradedSize(const Ground& ground, std::span<const SizeSource> sources, const WantedSize& wanted, double grade);
  /// O(log n) where sources are spread evenly.
  [[nodiscard]] double operator()(Vec3 x) const;

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
  const Ground& ground_;
  WantedSize wanted_;
  double grade_;
};

}  // namespace temper::mesher
