#include "optimize/coarsen/size_limit.hpp"

#include "size/star_area.hpp"

namespace temper {

bool SizeLimit::allows(const Neighborhood& around, const Mesh& local) const {
  for (const VertexId v : local.vertices()) {
    if (local.is_isolated(v)) continue;
    StarArea star = star_area(local, v);
    double before = 0;  // new vertices have no size yet
    if (v.index < around.vertices.size()) {
      // A vertex of the rim has more triangles outside, which stay.
      const StarArea whole = star_area(work_.mesh, around.vertices[v.index]), inside = star_area(around.mesh, v);
      star.doubled += whole.doubled - inside.doubled;
      star.triangles += whole.triangles - inside.triangles;
      before = whole.size();
    }
    const double size = star.size();
    const double field = field_.at(work_.units.to_user(local.point(v))).size / work_.units.scale;
    if (size > factor_ * field && size > before) return false;
  }
  return true;
}

}  // namespace temper
