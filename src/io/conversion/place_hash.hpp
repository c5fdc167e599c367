// Places as keys of hash tables, for points that have not moved by a bit.
#pragma once

#include <cstdint>
#include <cstring>

#include "temper/detail/vec2.hpp"
#include "temper/detail/vec3.hpp"

namespace temper::io {

struct PlaceHash {
  std::size_t operator()(Vec2 p) const {
    std::uint64_t x = 0, y = 0;
    p = {p.x + 0.0, p.y + 0.0};  // −0 is the same place as 0
    std::memcpy(&x, &p.x, sizeof x);
    std::memcpy(&y, &p.y, sizeof y);
    return static_cast<std::size_t>((x * 0x9E3779B97F4A7C15u) ^ (y + (x >> 29)) * 0xBF58476D1CE4E5B9u);
  }
  std::size_t operator()(const Vec3& p) const {
    return (*this)(Vec2{p.x, p.y}) ^ (*this)(Vec2{p.z, 0}) * 0x94D049BB133111EBu;
  }
};

}  // namespace temper::io
