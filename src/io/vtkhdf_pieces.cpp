// See vtkhdf_pieces.hpp.
#include "io/vtkhdf_pieces.hpp"

#include <unordered_map>

#include "io/place_hash.hpp"

namespace temper::io {

JoinedPoints join_points(const std::vector<std::size_t>& sizes, const std::function<Vec3(std::size_t)>& place) {
  JoinedPoints result;
  std::unordered_map<Vec3, std::int32_t, PlaceHash> former;  // of the pieces before this one
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
