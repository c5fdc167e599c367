// The triangles that are not well-centered: what optimisation repairs, explain explains and meshing counts.
#pragma once

#include <vector>

#include "temper/mesh.hpp"

namespace temper {

/// is_bad says whether triangle t is not well-centered, exactly. An erased triangle is not bad.
[[nodiscard]] bool is_bad(const Mesh& mesh, TriangleId t);
/// bad_triangles lists the triangles for which is_bad holds, in ascending order.
[[nodiscard]] std::vector<TriangleId> bad_triangles(const Mesh& mesh);

}  // namespace temper
