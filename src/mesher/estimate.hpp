// The number of triangles and the memory of a mesh, before the work: the integral of the density of triangles, 1/size²,
// over the inside.
#pragma once

#include <cstdint>

#include "mesher/areas.hpp"
#include "mesher/deadline.hpp"
#include "mesher/triangulated.hpp"

namespace temper::mesher {

/// The number of equilateral triangles of a size in an area.
[[nodiscard]] double count_in(double area, double size);

/// The number of triangles of these sizes inside the outline. `outline`: the triangulation of `points` and edges alone.
/// It takes a limited number of steps, with at most `per_triangle` of them for each. Then it counts too many triangles,
/// if any. More than 1 make the estimate no better.
[[nodiscard]] double count_triangles(const Triangulated& outline, const Areas& areas, const GradedSize& size,
                                     double per_triangle, Deadline& deadline);

/// The least number of triangles of a size field inside the outline: it sees each triangle of the field.
[[nodiscard]] double count_field(const Surface& surface, const Triangulated& outline, const WantedSize& wanted,
                                 Deadline& deadline);

[[nodiscard]] MeshEstimate estimate_of(double triangles);
/// The number of triangles for which the memory is enough.
[[nodiscard]] double triangles_within(std::uint64_t bytes);

}  // namespace temper::mesher
