// The operators of a surface: the plane's builder with the measures of triangles in space.
#include <array>
#include <cmath>

#include "dec/builder.hpp"
#include "dec/summary.hpp"
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

/// Points are vertices: lengths are those of the edges between them.
class IntrinsicMeasures {
 public:
  using Point = VertexId;
  explicit IntrinsicMeasures(const IntrinsicMesh& mesh) : mesh_(&mesh) {}
  [[nodiscard]] Point point(VertexId v) const { return v; }
  [[nodiscard]] Point point(VertexId v, Point /*near*/) const { return v; }

  void triangle(DecComplex& c, TriangleId t) const {
    c.areas.push_back(0.5 * doubled_area(mesh_->triangle(Mesh::halfedge(t, 0))));
  }
  void line(DecComplex& /*c*/, DecEdge& edge) const {
    const MetricTriangle t = at(edge.from, edge.to);
    edge.length = std::sqrt(t.pq);
    edge.crossing = dual_crossing(t);
  }
  [[nodiscard]] double height(Point p, Point q, Point /*r*/, double /*area*/, double /*length*/) const {
    return signed_height(at(p, q));
  }
  [[nodiscard]] double end_ratio(Point p, Point q, Point /*r*/, double /*area*/, double length) const {
    return with_sign(signed_height(at(p, q)) / length, signed_height_sign(at(p, q)));
  }
  [[nodiscard]] double dual_ratio(const std::array<Point, 4>& quad, std::array<double, 2> /*areas*/,
                                  double /*length*/) const {
    return dual_over_length(at(quad[0], quad[1]), at(quad[1], quad[0]));
  }

 private:
  /// The triangle on the left of pq, or with the ends of a boundary edge swapped the one on its right.
  [[nodiscard]] MetricTriangle at(VertexId p, VertexId q) const {
    const Mesh& mesh = mesh_->connectivity();
    const HalfedgeId h = mesh.find_halfedge(p, q);
    return h.valid() ? mesh_->triangle(h) : mesh_->triangle(mesh.find_halfedge(q, p)).mirrored();
  }

  const IntrinsicMesh* mesh_;
};

}  // namespace

DecComplex dec_operators(const IntrinsicMesh& mesh) {
  return DecBuilder(mesh.connectivity(), IntrinsicMeasures(mesh)).build();
}

DecComplex dec_operators(const SurfaceMesh& mesh) {
  return DecBuilder(mesh.connectivity(), SurfaceMeasures(mesh)).build();
}

DecSummary summarize(const SurfaceMesh& mesh, const DecComplex& complex) {
  DecSummary s = summary_of_operators(mesh.connectivity(), complex);
  for (const TriangleId t : mesh.triangles()) {
    const auto [p, q, r] = mesh.points(t);
    s.not_well_centered += is_well_centered(p, q, r) ? 0 : 1;
  }
  return s;
}

PowerCells dual_cells(const SurfaceMesh& mesh, const DecComplex& complex) {
  const Mesh& connectivity = mesh.connectivity();
  PowerCells cells;
  cells.areas = complex.star0;
  cells.starts.push_back(0);
  for (const TriangleId t : mesh.triangles()) {
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId out = Mesh::halfedge(t, k), in = Mesh::prev(out);
      const VertexId v = connectivity.origin(out);
      // The two right triangles at v, along its two edges in t.
      double area = 0;
      for (const HalfedgeId h : {out, in}) {
        const DecEdge& edge = complex.edges[complex.edge_of_halfedge[h]];
        const double d = edge.from == v ? edge.crossing : edge.length - edge.crossing;
        area += 0.5 * d * (edge.left == t ? edge.left_height : edge.right_height);
      }
      cells.vertices.push_back(v);
      cells.sphere_corners.push_back(mesh.position(v));
      cells.sphere_corners.push_back(complex.sphere_midpoints[complex.edge_of_halfedge[out]]);
      cells.sphere_corners.push_back(complex.sphere_orthocenters[t]);
      cells.sphere_corners.push_back(complex.sphere_midpoints[complex.edge_of_halfedge[in]]);
      cells.polygon_areas.push_back(area);
      cells.starts.push_back(cells.sphere_corners.size());
    }
  }
  return cells;
}

}  // namespace temper::surfaces
