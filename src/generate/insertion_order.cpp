// Biased randomised insertion order: see Amenta, Choi and Rote, "Incremental constructions con BRIO", 2003.
#include <algorithm>
#include <bit>

#include "base/hilbert.hpp"
#include "base/rng.hpp"
#include "generate/triangulation.hpp"

namespace temper::generate {
namespace {

struct Keyed {
  std::uint64_t key;
  std::uint32_t index;
  friend bool operator<(const Keyed& a, const Keyed& b) { return a.key != b.key ? a.key < b.key : a.index < b.index; }
};

/// `curve`: the place of a point along it, of so many bits.
template <class Point, class Curve>
std::vector<std::uint32_t> order_along(std::span<const Point> points, int bits, const Curve& curve) {
  constexpr int kRounds = 24;  // a first round of one point or none up to 16 million points
  static_assert(kCubeBits + 5 <= 64);
  std::vector<Keyed> keyed;
  keyed.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    // Half of all points have no trailing zero and go last, a quarter have one and go before them, and so on.
    const auto zeros = static_cast<std::uint64_t>(std::min(kRounds, std::countr_zero(mix64(i + 1))));
    keyed.push_back({((kRounds - zeros) << bits) | curve(points[i]), i});
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::uint32_t> order;
  order.reserve(points.size());
  for (const Keyed& k : keyed) order.push_back(k.index);
  return order;
}

}  // namespace

std::vector<std::uint32_t> insertion_order(std::span<const Vec2> points) {
  return order_along(points, 2 * kHilbertBits, HilbertGrid(points));
}

std::vector<std::uint32_t> insertion_order(std::span<const Vec3> points) {
  return order_along(points, kCubeBits, cube_hilbert_index);
}

}  // namespace temper::generate
