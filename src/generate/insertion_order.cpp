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

}  // namespace

std::vector<std::uint32_t> insertion_order(std::span<const Vec2> points) {
  constexpr int kRounds = 24;  // a first round of one point or none up to 16 million points
  static_assert(2 * kHilbertBits + 5 <= 64);
  const HilbertGrid curve(points);
  std::vector<Keyed> keyed;
  keyed.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    // Half of all points have no trailing zero and go last, a quarter have one and go before them, and so on.
    const auto zeros = static_cast<std::uint64_t>(std::min(kRounds, std::countr_zero(mix64(i + 1))));
    keyed.push_back({((kRounds - zeros) << (2 * kHilbertBits)) | curve(points[i]), i});
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::uint32_t> order;
  order.reserve(points.size());
  for (const Keyed& k : keyed) order.push_back(k.index);
  return order;
}

}  // namespace temper::generate
