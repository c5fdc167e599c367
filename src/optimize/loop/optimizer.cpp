#include <algorithm>
#include <utility>

#include "base/sort_unique.hpp"
#include "optimize/loop/update.hpp"
#include "optimize/loop/waiting.hpp"
#include "optimize/options/settings.hpp"

namespace temper {

static CellKinds kinds_of(const Mesh& /*mesh*/) { return CellKinds::triangles; }
static IdVector<VertexId, VertexId>& numbers_of(OptimizeReport& report) { return report.vertices; }

namespace {

/// Compares two meshes. `numbers`: of each vertex of the mesh in the former one.
class Comparison {
 public:
  Comparison(const Mesh& former, const Mesh& mesh, const IdVector<VertexId, VertexId>& numbers)
      : former_(former), mesh_(mesh), numbers_(numbers) {}

  [[nodiscard]] VertexId number(VertexId v) const { return numbers_.empty() ? v : numbers_[v]; }
  [[nodiscard]] bool is_moved(VertexId v) const {
    const Space& space = mesh_.space();
    return number(v).valid() && !(space.place(mesh_.point(v)) == space.place(former_.point(number(v))));
  }
  [[nodiscard]] bool is_weighed(VertexId v) const {
    return number(v).valid() && mesh_.weight(v) != former_.weight(number(v));
  }
  [[nodiscard]] bool is_equal(VertexId v) const {
    return number(v).valid() && mesh_.point(v) == former_.point(number(v));
  }
  /// Says whether the former mesh has the triangle, with corners at the same places.
  [[nodiscard]] bool has(TriangleId t) const {
    const auto [a, b, c] = mesh_.corners(t);
    if (!is_equal(a) || !is_equal(b) || !is_equal(c)) return false;
    const std::array was = {number(a), number(b), number(c)};
    if (t.index < former_.n_triangles() && former_.corners(t) == was) return true;
    const HalfedgeId h = former_.find_halfedge(was[0], was[1]);
    return h.valid() && former_.opposite(h) == was[2];
  }

 private:
  const Mesh &former_, &mesh_;
  const IdVector<VertexId, VertexId>& numbers_;
};

}  // namespace

static MeshDifference<TriangleId> difference(const Mesh& former, const Mesh& mesh,
                                             IdVector<VertexId, VertexId> numbers) {
  MeshDifference<TriangleId> result;
  result.vertices = std::move(numbers);
  const Comparison compared(former, mesh, result.vertices);
  for (const VertexId v : mesh.vertices()) {
    if (compared.is_moved(v)) result.moved.push_back(v);
    if (compared.is_weighed(v)) result.weighed.push_back(v);
  }
  for (const TriangleId t : mesh.triangles()) {
    if (compared.has(t)) continue;
    result.cells.push_back(t);
    for (const VertexId v : mesh.corners(t)) result.rows.push_back(v);
  }
  sort_unique(result.rows);
  return result;
}

template class OptimizerOf<Mesh, OptimizeHooks, OptimizeReport, TriangleId>;

}  // namespace temper
