// The local test of one edge, and the count over a mesh.
#include "temper/regularity.hpp"

#include "base/sum.hpp"
#include "regularity/power_tests.hpp"

namespace temper {

bool is_regular(const Mesh& mesh, HalfedgeId h) {
  return mesh.is_boundary(h) || PowerTest()(mesh, inlined::quad(mesh, h)) != Sign::positive;
}

std::size_t count_non_regular_edges(const Mesh& mesh, bool with_constrained, Executor* executor) {
  return static_cast<std::size_t>(blockwise_sum(mesh.n_halfedges(), executor, [&](std::size_t i) {
    const HalfedgeId h(i);
    if (!mesh.is_edge_representative(h) || (!with_constrained && mesh.is_constrained(h))) return 0.0;
    return is_regular(mesh, h) ? 0.0 : 1.0;
  }));
}

}  // namespace temper
