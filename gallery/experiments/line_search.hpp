// The paper's line search for the position of one vertex (Algorithm 5), by the library's public functions, so that each
// search can be seen: steepest descent, golden section within the patch radius, short of turning a triangle over.
#pragma once

#include <cmath>
#include <vector>

#include "temper/energy.hpp"
#include "temper/mesh.hpp"

namespace temper::gallery {

/// Golden section: where f is least in [0, limit] when it has one minimum there; else a local one.
template <class Function>
double golden_section(Function&& f, double limit) {
  constexpr double kTolerance = 1e-8;  // of the interval: what golden section can tell apart in doubles
  const double ratio = 0.5 * (std::sqrt(5.0) - 1);
  double low = 0, high = limit;
  double a = high - ratio * (high - low), b = low + ratio * (high - low);
  double fa = f(a), fb = f(b);
  while (high - low > kTolerance * limit) {
    if (fb < fa) {
      low = a, a = b, fa = fb;
      b = low + ratio * (high - low), fb = f(b);
    } else {
      high = b, b = a, fb = fa;
      a = high - ratio * (high - low), fa = f(a);
    }
  }
  return fa <= fb ? a : b;
}

/// Root mean square of the distances to v's neighbours.
[[nodiscard]] double patch_radius(const Mesh& mesh, VertexId v);

struct LineSearch {
  Vec2 from, to;
  double part = 0;  ///< of the interval that was searched; 1: stopped by its end, not at a minimum
};

/// So many searches, one after the other, each from where the last one ended; fewer when the energy falls no more.
[[nodiscard]] std::vector<LineSearch> line_searches(Mesh mesh, const EnergyModel& model, VertexId v, int searches = 3);

}  // namespace temper::gallery
