#include "optimize/working/divided_edge.hpp"

#include <cmath>

#include "temper/detail/geometry.hpp"

namespace temper {

Vec2 DividedEdge::at(double t, const WorkingUnits& units) const {
  // 2⁻²⁴ of an edge is finer than any margin. Coordinates of 29 bits leave room for so many digits of t.
  constexpr int kMostBits = 24, kLeastBits = 12, kFewerBits = 4;
  for (int bits = kMostBits; bits >= kLeastBits; bits -= kFewerBits) {
    const double rounded = std::ldexp(std::round(std::ldexp(t, bits)), -bits);
    const Vec2 p = a + rounded * along();
    if (rounded <= 0 || rounded >= 1) break;
    if (units.snap(p) == p && orient2d(a, p, b) == Sign::zero) return p;
  }
  return units.snap(a + t * along());
}

}  // namespace temper
