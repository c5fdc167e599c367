// See vtkhdf_pieces.hpp.
#include "io/vtkhdf_pieces.hpp"

#include <unordered_map>

#include "io/place_hash.hpp"

namespace temper::io {

namespace {

struct SpaceHash {
  std::size_t operator()(const Vec3& p) const {
    return PlaceHash()({p.x, p.y}) ^ PlaceHash()({p.z, 0}) * 0x94D049BB133111EBu;
  }
};
struct SamePlace {
  bool operator()(const Vec3& a, const Vec3& b) const { return a.x == b.x && a.y == b.y && a.z == b.z; }
};

}  // namespace

JoinedPoints join_points(const std::vector<std::size_t>& sizes, const std::function<Vec3(std::size_t)>& place) {
  JoinedPoints result;
  std::unordered_map<Vec3, std::int32_t, SpaceHash, SamePlace> former;  // of the pieces before this one
  std::size_t start = 0;
  for (const std::size_t size : sizes) {
    const std::size_t end = start + size;
    for (std::size_t i = start; i < end; ++i) {
      const auto there = former.find(place(i));
      result.number.push_back(there != former.end() ? there->second : static_cast<std::int32_t>(result.kept.size()));
      if (there == former.end()) result.kept.push_back(static_cast<std::int64_t>(i));
    }
    for (std::size_t i = start; i < end; ++i) former.emplace(place(i), result.number[i]);
    start = end;
  }
  return result;
}

}  // namespace temper::io
