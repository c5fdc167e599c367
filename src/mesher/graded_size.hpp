// The target edge length at each place: size(x) = min(wanted(x), min over sources of s + grade · |x − p|).
#pragma once

#include <algorithm>
#include <array>
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
  [[nodiscard]] double most() const { return wanted_.most; }
  [[nodiscard]] double grade() const { return grade_; }
  [[nodiscard]] bool has_field() const { return wanted_.field != nullptr; }
  [[nodiscard]] const Surface& surface() const { return surface_; }
  /// A place of the sphere: with a field the first one of its least size.
  [[nodiscard]] Vec3 start() const;

 private:
  static constexpr std::size_t kChildren = 4;
  using Lanes = std::array<double, kChildren>;
  /// Children side by side, so that their bounds are computed at once.
  struct Node {
    std::array<Lanes, 3> low, high;                 // boxes of the sources below
    Lanes least;                                    // size among them; infinity without any
    std::array<std::uint32_t, kChildren + 1> ends;  // of the sources of each child
    std::array<std::uint32_t, kChildren> child;     // 0 for a leaf
  };
  std::uint32_t build(std::size_t begin, std::size_t end);
  void sort_by_halves(std::size_t begin, std::size_t middle, std::size_t end);
  [[nodiscard]] double lower(std::uint32_t at, Vec3 x, double best) const;

  std::vector<SizeSource> sources_;
  std::vector<Node> nodes_;
  const Surface& surface_;
  WantedSize wanted_;
  double grade_;
};

}  // namespace temper::mesher
