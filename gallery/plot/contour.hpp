// Contours of samples on a grid: marching squares, joined into whole lines and loops.
//
//     3-----2     A cell whose four corners are finite is a square: a line cuts a side where the linear
//     | \ f<L     interpolant has the level; when it cuts all four (a saddle) the value at the saddle point of the
//     |f≥L \ |    bilinear interpolant says which corners are joined. A cell with three finite corners is a triangle,
//     0-----1     so that a slanted boundary of the domain is no staircase. Others are outside.
//
// Points are joined by the name of the grid edge that they lie on, never by coordinates, so nothing depends on
// rounding.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "temper/detail/vec.hpp"

namespace temper {

/// Samples f(i, j) = values[j nx + i] at the points (i, j) of the plane. Not finite: outside the domain.
struct SampleGrid {
  std::size_t nx = 0, ny = 0;
  std::span<const double> values;
  [[nodiscard]] double at(std::size_t i, std::size_t j) const { return values[j * nx + i]; }
};

/// The lines where f = level: open polylines that end at the boundary of the domain, and loops, which repeat their
/// first point. f ≥ level is on the left. In sample units. O(cells).
[[nodiscard]] std::vector<std::vector<Vec2>> contour_lines(const SampleGrid& grid, double level);

/// The part of the domain where f ≥ level, as loops with the part on their left (each without its first point
/// repeated); −∞ for the whole domain. Nonzero and even-odd filling agree.
[[nodiscard]] std::vector<std::vector<Vec2>> superlevel_loops(const SampleGrid& grid, double level);

}  // namespace temper
