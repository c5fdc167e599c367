// The operators of a surface: the plane's builder with the measures of triangles in space.
#include <array>
#include <cmath>

#include "dec/builder.hpp"
#include "regularity/duals.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {
namespace {

class SurfaceMeasures {
 public:
  using Point = WeightedPoint;
  explicit SurfaceMeasures(const SurfaceMesh& mesh) : mesh_(&mesh) {}
  [[nodiscard]] Point point(VertexId v) const { return mesh_->point(v); }
  [[nodiscard]] Point point(VertexId v, const Point& /*near*/) const { return point(v); }

  void triangle(DecComplex& c, TriangleId t) const {
    const auto [p, q, r] = mesh_->points(t);
    c.areas.push_back(0.5 * length(cross(q.position() - p.position(), r.position() - p.position())));
    c.sphere_orthocenters.push_back(orthocenter(p, q, r));
  }
  void line(DecComplex& c, DecEdge& edge) const {
    const Point from = point(edge.from), to = point(edge.to);
    const Vec3 along = to.position() - from.position();
    edge.length = length(along);
    edge.crossing = dual_crossing(from, to);
    c.sphere_midpoints.push_back(from.position() + (edge.crossing / edge.length) * along);
  }
  [[nodiscard]] double height(const Point& p, const Point& q, const Point& r, double /*area*/,
                              double /*length*/) const {
    return signed_height(p, q, r);
  }
  [[nodiscard]] double end_ratio(const Point& p, const Point& q, const Point& r, double /*area*/, double length) const {
    return with_sign(signed_height(p, q, r) / length, signed_height_sign(p, q, r));
  }
  [[nodiscard]] double dual_ratio(const std::array<Point, 4>& quad, std::array<double, 2> /*areas*/,
                                  double /*length*/) const {
    const auto& [p, q, r, s] = quad;
    return dual_over_length(p, q, r, s);
  }

 private:
  const SurfaceMesh* mesh_;
};

}  // namespace

DecComplex dec_operators(const SurfaceMesh& mesh) {
  return DecBuilder(mesh.connectivity(), SurfaceMeasures(mesh)).build();
}

}  // namespace temper::surfaces
