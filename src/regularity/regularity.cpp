// The local test of one edge, and the count over a mesh.
#include "temper/regularity.hpp"

#include "regularity/power_tests.hpp"

namespace temper {

bool is_regular(const Mesh& mesh, HalfedgeId h) {
  return mesh.is_boundary(h) || PowerTest()(mesh, inlined::quad(mesh, h)) != Sign::positive;
}

std::size_t count_non_regular_edges(const Mesh& mesh, bool with_constrained) {
  std::size_t count = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_edge_representative(h) || (!with_constrained && mesh.is_constrained(h))) continue;
    if (!is_regular(mesh, h)) ++count;
  }
  return count;
}

}  // namespace temper
