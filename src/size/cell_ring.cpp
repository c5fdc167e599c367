#include "size/cell_ring.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/surface.hpp"
#include "temper/detail/geometry.hpp"

namespace temper {
double grid_spacing(const Space& space, const CellRing& ring) {
  double sum = 0;
  for (const WeightedPoint& p : ring.around) sum += distance(space, ring.center, p);
  return sum / static_cast<double>(ring.around.size());
}

double dual_length(const Space& space, const CellRing& ring, std::size_t k) {
  return dual_length(space, ring.center, ring.around[k], ring.after(k), ring.before(k));
}

double cell_quality(const Space& space, const CellRing& ring) {
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;
  for (std::size_t k = 0; k < ring.around.size(); ++k) {
    const double dual = std::abs(dual_length(space, ring, k));
    shortest = std::min(shortest, dual);
    longest = std::max(longest, dual);
  }
  return longest > 0 ? shortest / longest : 0;
}

double centroid_offset(const Space& space, const CellRing& ring) {
  const Vec3 at = space.place(ring.center), up = space.up(as_point(at));
  Vec3 moment = {0, 0, 0};
  double doubled = 0;
  Vec3 from = as_vector(orthocenter(space, ring.center, ring.before(0), ring.around[0])) - at;
  for (std::size_t k = 0; k < ring.around.size(); ++k) {
    const Vec3 to = as_vector(orthocenter(space, ring.center, ring.around[k], ring.after(k))) - at;
    const double area = dot(up, cross(from, to));
    moment = moment + (area / 3) * (from + to);
    doubled += area;
    from = to;
  }
  if (!(doubled > 0)) return std::numeric_limits<double>::infinity();
  const Vec3 offset = (1 / doubled) * moment;
  const double height = dot(up, offset), across = length(offset - height * up);
  return space.along_surface(across, height);
}

}  // namespace temper
