// The dual for ParaView and its like: power cells as polygons, dual edges as lines between orthocenters.
#include <cstdint>

#include "io/formats/cells.hpp"
#include "io/formats/vtk/vtu_document.hpp"
#include "io/operators/dec_files.hpp"

namespace temper::io {
namespace {

/// Three numbers a point; z is the mesh's in the plane.
VtkArray dual_points(const DecPlaces& places, double z) {
  return computed_vtk_array<double>(
      "Points", Scalar::f64, 3 * places.size(),
      [&places, z](std::size_t i) { return i % 3 < places.coordinates ? places.coordinate(i / 3, i % 3) : z; }, 3);
}

// A cell of several polygons has the same number, area and star on each of them.
void write_cells(const DecJob& job) {
  const PowerCells& cells = job.cells;
  const DecPlaces places = corner_places(cells);
  const std::size_t n = cells.n_polygons(), n_points = places.size();
  const auto owner = [&cells](std::size_t p) { return cells.vertices[p]; };
  VtuDocument vtu(job.open("dual.vtu"), Encoding::base64, job.options.executor);
  vtu.begin_piece(n_points, n);
  vtu.section("Points", {dual_points(places, job.options.z)});
  vtu.section("Cells", {dual_integers("connectivity", n_points, [](std::size_t i) { return i; }),
                        dual_integers("offsets", n, [&cells](std::size_t p) { return cells.starts[p + 1]; }),
                        one_type(n, kVtkPolygon)});
  vtu.section("PointData", {});
  vtu.section("CellData",
              {dual_integers("vertex", n, [owner](std::size_t p) { return owner(p).index; }),
               dual_reals("polygon_area", n, [&cells](std::size_t p) { return cells.polygon_areas[p]; }),
               dual_reals("area", n, [&cells, owner](std::size_t p) { return cells.areas[owner(p)]; }),
               dual_reals("star0", n, [&job, owner](std::size_t p) { return job.complex.star0[owner(p)]; }),
               dual_reals("weight", n, [&job, owner](std::size_t p) { return job.mesh.weight(owner(p)); })});
  vtu.finish();
}

// Points are the orthocenters, then the weighted midpoints. An interior line runs from the triangle on the left of its
// edge to the one on the right, a boundary line from the orthocenter to the midpoint.
void write_dual_edges(const DecJob& job) {
  const DecComplex& c = job.complex;
  DecPlaces places = orthocenter_places(c);
  const std::size_t n_triangles = places.size(), n = c.edges.size(), n_points = n_triangles + n;
  const DecPlaces midpoints = midpoint_places(c);
  places.at.insert(places.at.end(), midpoints.at.begin(), midpoints.at.end());
  const auto edge = [&c](std::size_t i) -> const DecEdge& { return c.edges[EdgeId(i)]; };
  const auto end = [edge, n_triangles](std::size_t i) -> std::size_t {
    const DecEdge& e = edge(i / 2);
    const TriangleId first = e.left.valid() ? e.left : e.right;
    if (i % 2 == 0) return first.index;
    return e.is_boundary() ? n_triangles + i / 2 : e.right.index;
  };
  VtuDocument vtu(job.open("dual_edges.vtu"), Encoding::base64, job.options.executor);
  vtu.begin_piece(n_points, n);
  vtu.section("Points", {dual_points(places, job.options.z)});
  vtu.section("Cells", {dual_integers("connectivity", 2 * n, end),
                        dual_integers("offsets", n, [](std::size_t i) { return 2 * (i + 1); }), one_type(n, kVtkLine)});
  vtu.section("PointData",
              {dual_integers("midpoint", n_points, [n_triangles](std::size_t i) { return i < n_triangles ? 0 : 1; }),
               dual_integers("element", n_points,
                             [n_triangles](std::size_t i) { return i < n_triangles ? i : i - n_triangles; })});
  vtu.section("CellData",
              {dual_integers("from", n, [edge](std::size_t i) { return edge(i).from.index; }),
               dual_integers("to", n, [edge](std::size_t i) { return edge(i).to.index; }),
               dual_integers("boundary", n, [edge](std::size_t i) { return edge(i).is_boundary() ? 1 : 0; }),
               dual_reals("length", n, [edge](std::size_t i) { return edge(i).length; }),
               dual_reals("dual_length", n, [edge](std::size_t i) { return edge(i).dual_length; }),
               dual_reals("star1", n, [&c](std::size_t i) { return c.star1[EdgeId(i)]; })});
  vtu.finish();
}

}  // namespace

void write_dec_vtu(const DecJob& job) {
  write_cells(job);
  write_dual_edges(job);
}

}  // namespace temper::io
