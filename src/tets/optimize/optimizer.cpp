#include "temper/tets/optimizer.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "base/sort_unique.hpp"
#include "optimize/loop/update.hpp"
#include "tets/optimize/origins.hpp"
#include "tets/optimize/waiting.hpp"

namespace temper {
namespace tets {

static CellKinds kinds_of(const TetMesh& /*mesh*/) { return CellKinds::tetrahedra; }
static Origins& numbers_of(OptimizeReport& report) { return report.origins; }

namespace {

using Corners = std::array<VertexId, 4>;

Corners ascending(Corners corners) {
  std::ranges::sort(corners);
  return corners;
}

/// Finds tetrahedra of a mesh by their corners. As long as it is asked in the order of the mesh, nothing is searched.
class Finder {
 public:
  explicit Finder(const TetMesh& mesh) : mesh_(mesh) {}
  [[nodiscard]] bool has(const Corners& corners) {
    if (next_ < mesh_.n_tetrahedra() && mesh_.corners(TetId(next_)) == corners) {
      ++next_;
      return true;
    }
    if (numbers_.empty()) {
      for (const TetId t : mesh_.tetrahedra()) numbers_.emplace_back(ascending(mesh_.corners(t)), t);
      std::ranges::sort(numbers_);
    }
    const auto found = std::ranges::lower_bound(numbers_, ascending(corners), {}, &std::pair<Corners, TetId>::first);
    if (found == numbers_.end() || found->first != ascending(corners)) return false;
    next_ = found->second.index + 1;
    return true;
  }

 private:
  const TetMesh& mesh_;
  std::size_t next_ = 0;
  std::vector<std::pair<Corners, TetId>> numbers_;
};

}  // namespace

static MeshDifference<TetId> difference(const TetMesh& former, const TetMesh& mesh, const Origins& origins) {
  const auto number = [&](VertexId v) { return origins.vertices.empty() ? v : origins.vertices[v]; };
  MeshDifference<TetId> result;
  result.vertices = origins.vertices;
  for (const VertexId v : mesh.vertices()) {
    if (!number(v).valid()) continue;
    if (mesh.position(v) != former.position(number(v))) result.moved.push_back(v);
    if (mesh.weight(v) != former.weight(number(v))) result.weighed.push_back(v);
  }
  IdVector<VertexId, std::uint8_t> is_equal(mesh.n_vertices(), 0);
  for (const VertexId v : mesh.vertices())
    is_equal[v] = number(v).valid() && mesh.point(v) == former.point(number(v)) ? 1 : 0;
  Finder finder(former);
  for (const TetId t : mesh.tetrahedra()) {
    Corners was = mesh.corners(t);
    const bool all_old = std::ranges::all_of(was, [&](VertexId v) { return number(v).valid(); });
    const bool all_equal = std::ranges::all_of(was, [&](VertexId v) { return is_equal[v] != 0; });
    for (VertexId& v : was) v = number(v);
    const bool was_there = all_old && finder.has(was);
    if (was_there && all_equal) continue;
    result.cells.push_back(t);
    for (const VertexId v : mesh.corners(t)) result.rows.push_back(v);
  }
  sort_unique(result.rows);
  return result;
}

}  // namespace tets

template class OptimizerOf<tets::TetMesh, tets::OptimizeHooks, tets::OptimizeReport, tets::TetId>;

}  // namespace temper
