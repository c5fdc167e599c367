// Operators of a mesh in the metric of a diffusion tensor, brought back to its plane.
#include "temper/detail/tensor.hpp"

#include <utility>

#include "temper/dec.hpp"

namespace temper {

DecComplex mapped_back(DecComplex complex, const Metric& metric) {
  for (DecEdge& edge : complex.edges) edge.midpoint = metric.from_metric(edge.midpoint);
  for (Vec2& place : complex.orthocenters) place = metric.from_metric(place);
  for (double& value : complex.star1) value *= metric.strength();
  for (double& value : complex.flux) value *= metric.strength();
  return complex;
}

PowerCells mapped_back(PowerCells cells, const Metric& metric) {
  for (Vec2& corner : cells.corners) corner = metric.from_metric(corner);
  return cells;
}

}  // namespace temper
