// The triangles around triangles.
#pragma once

#include <span>
#include <vector>

#include "temper/mesh.hpp"

namespace temper {

/// The triangles at the corners of these, themselves included; sorted. Precondition: none is erased.
[[nodiscard]] std::vector<TriangleId> triangles_around(const Mesh& mesh, std::span<const TriangleId> triangles);

}  // namespace temper
