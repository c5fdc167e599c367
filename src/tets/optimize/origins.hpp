// Origins of the parts of a mesh of tetrahedra over several changes.
#pragma once

#include "optimize/run/numbers.hpp"
#include "temper/tets/mesh.hpp"

namespace temper::tets {

/// As temper::numbers_before_both, of vertices and of tagged faces and lines.
[[nodiscard]] inline Origins numbers_before_both(const Origins& last, const Origins& before) {
  return {temper::numbers_before_both(last.vertices, before.vertices),
          temper::numbers_before_both(last.faces, before.faces), temper::numbers_before_both(last.lines, before.lines)};
}

}  // namespace temper::tets
