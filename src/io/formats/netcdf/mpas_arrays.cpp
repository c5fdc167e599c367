// See mpas.hpp. The conventions are the same as in MPAS-Tools' mesh converter.
//
//   edge       cellsOnEdge(1) → cellsOnEdge(2) has verticesOnEdge(1) on its right and verticesOnEdge(2) on its left
//   vertex     edgesOnVertex counter-clockwise; cellsOnVertex(i) is between edges i and i + 1
//   cell       edgesOnCell counter-clockwise; cellsOnCell(i) across edge i; verticesOnCell(i) between edges i and i + 1
//
// At the boundary of the domain an edge has two cells and one vertex: verticesOnEdge(2) = 0. Its cells, cut off by the
// boundary, have one vertex less than edges. dvEdge ends at the boundary, and areaCell is the area inside, as if the
// boundary were a wall. On a sphere left and counter-clockwise are as seen from outside, lengths are lengths of arcs,
// and areas are excess. angleEdge is the angle from east to the normal of the edge, at the point of crossing.
#include <algorithm>
#include <cmath>

#include "io/conversion/globe.hpp"
#include "io/formats/netcdf/mpas.hpp"

namespace temper::io {
namespace {

std::int32_t from_one(std::size_t index) { return static_cast<std::int32_t>(index) + 1; }

class MpasBuilder {
 public:
  MpasBuilder(const Mesh& mesh, const DecComplex& complex) : mesh_(mesh), complex_(complex) {}
  MpasArrays build() {
    edges();
    vertices();
    cells();
    weights();
    return std::move(a_);
  }

 private:
  void edges() {
    const std::size_t n = complex_.edges.size();
    a_.cells_on_edge.reserve(2 * n);
    a_.vertices_on_edge.reserve(2 * n);
    for (std::size_t i = 0; i < n; ++i) {
      const DecEdge& e = complex_.edges[EdgeId(i)];
      // An edge with one triangle is turned so that the triangle is on its right.
      const bool turned = !e.right.valid();
      const VertexId first = turned ? e.to : e.from, second = turned ? e.from : e.to;
      a_.cells_on_edge.push_back(from_one(first.index));
      a_.cells_on_edge.push_back(from_one(second.index));
      a_.vertices_on_edge.push_back(from_one(turned ? e.left.index : e.right.index));
      a_.vertices_on_edge.push_back(turned || !e.left.valid() ? 0 : from_one(e.left.index));
      a_.dc_edge.push_back(e.length);
      a_.dv_edge.push_back(e.dual_length);
      a_.angle_edge.push_back(angle(i, first, second));
    }
  }
  // The edge that ends at a corner comes before the corner, so corners keep their order.
  void vertices() {
    for (const TriangleId t : mesh_.triangles()) {
      for (int k = 0; k < 3; ++k) {
        const HalfedgeId out = Mesh::halfedge(t, k), in = Mesh::prev(out);
        const VertexId corner = mesh_.origin(out);
        a_.edges_on_vertex.push_back(from_one(edge_of(in)));
        a_.cells_on_vertex.push_back(from_one(corner.index));
        a_.kite_areas_on_vertex.push_back(half_kite(in, corner) + half_kite(out, corner));
      }
    }
  }
  void cells() {
    for (const VertexId v : mesh_.vertices()) {
      std::int32_t n = mesh_.is_boundary(v) ? 1 : 0;
      for ([[maybe_unused]] const HalfedgeId h : mesh_.star(v)) ++n;
      a_.n_edges_on_cell.push_back(n);
      a_.boundary_cell.push_back(mesh_.is_boundary(v) ? 1 : 0);
      a_.max_edges = std::max(a_.max_edges, static_cast<std::size_t>(n));
    }
    const std::size_t rows = mesh_.n_vertices() * a_.max_edges;
    a_.edges_on_cell.assign(rows, 0);
    a_.cells_on_cell.assign(rows, 0);
    a_.vertices_on_cell.assign(rows, 0);
    for (const VertexId v : mesh_.vertices()) {
      std::size_t at = v.index * a_.max_edges;
      HalfedgeId last;
      for (const HalfedgeId h : mesh_.star(v)) {
        a_.edges_on_cell[at] = from_one(edge_of(h));
        a_.cells_on_cell[at] = from_one(mesh_.target(h).index);
        a_.vertices_on_cell[at] = from_one(Mesh::triangle(h).index);
        ++at;
        last = h;
      }
      if (!mesh_.is_boundary(v)) continue;
      a_.edges_on_cell[at] = from_one(edge_of(Mesh::prev(last)));
      a_.cells_on_cell[at] = from_one(mesh_.opposite(last).index);
    }
  }
  // Thuburn, Ringler, Skamarock and Klemp 2009, eq. 33. From edge to edge, counter-clockwise around each cell of an
  // edge: ±(1/2 − the part of the cell's area passed so far) dv' / dc. Along a wall nothing flows, and no area is
  // passed.
  void weights() {
    const std::size_t n = complex_.edges.size(), width = 2 * a_.max_edges;
    a_.edges_on_edge.reserve(n * width);
    a_.weights_on_edge.reserve(n * width);
    for (std::size_t e = 0; e < n; ++e) {
      for (const std::size_t k : {std::size_t{0}, std::size_t{1}})
        weights_of(e, static_cast<std::size_t>(a_.cells_on_edge[2 * e + k]) - 1, k == 0 ? 1 : -1);
      a_.n_edges_on_edge.push_back(static_cast<std::int32_t>(a_.edges_on_edge.size() - e * width));
      a_.edges_on_edge.resize((e + 1) * width, 0);
      a_.weights_on_edge.resize((e + 1) * width, 0);
    }
  }
  void weights_of(std::size_t edge, std::size_t cell, double sign) {
    const std::int32_t* edges = a_.edges_on_cell.data() + cell * a_.max_edges;
    const std::int32_t* vertices = a_.vertices_on_cell.data() + cell * a_.max_edges;
    const auto n = static_cast<std::size_t>(a_.n_edges_on_cell[cell]);
    const auto start = static_cast<std::size_t>(std::find(edges, edges + n, from_one(edge)) - edges);
    const double area = complex_.star0[VertexId(cell)];
    double passed = 0;
    for (std::size_t step = 1; step < n; ++step) {
      const std::int32_t vertex = vertices[(start + step - 1) % n];
      if (vertex > 0) {
        const std::size_t first = 3 * (static_cast<std::size_t>(vertex) - 1);
        for (std::size_t k = first; k < first + 3; ++k) {
          if (a_.cells_on_vertex[k] == from_one(cell)) passed += a_.kite_areas_on_vertex[k];
        }
      }
      const std::int32_t other = edges[(start + step) % n];
      const auto at = static_cast<std::size_t>(other) - 1;
      const double outwards = a_.cells_on_edge[2 * at] == from_one(cell) ? 1 : -1;
      a_.edges_on_edge.push_back(other);
      a_.weights_on_edge.push_back(sign * outwards * (0.5 - (area != 0 ? passed / area : 0)) * a_.dv_edge[at] /
                                   a_.dc_edge[edge]);
    }
  }
  [[nodiscard]] double angle(std::size_t edge, VertexId from, VertexId to) const {
    if (complex_.sphere_midpoints.empty()) {
      const Vec3 along = mesh_.space().chord(mesh_.point(from), mesh_.point(to, mesh_.point(from)));
      return std::atan2(along.y, along.x);
    }
    const Vec3 at = complex_.sphere_midpoints[EdgeId(edge)];
    const Vec3 p = mesh_.weighted_vector(from), normal = cross(cross(p, mesh_.weighted_vector(to) - p), at);
    const Vec3 east = east_of(at), north = cross(at, east);
    return std::atan2(dot(normal, north) / length(at), dot(normal, east));
  }
  /// The right triangle of d and h on the side of the half-edge's triangle: half of a kite, signed.
  [[nodiscard]] double half_kite(HalfedgeId h, VertexId at) const {
    const DecEdge& e = complex_.edges[complex_.edge_of_halfedge[h]];
    const double d = e.from == at ? e.crossing : e.length - e.crossing;
    return mesh_.space().right_triangle_area(d, e.left == Mesh::triangle(h) ? e.left_height : e.right_height);
  }
  [[nodiscard]] std::size_t edge_of(HalfedgeId h) const { return complex_.edge_of_halfedge[h].index; }

  const Mesh& mesh_;
  const DecComplex& complex_;
  MpasArrays a_;
};

}  // namespace

MpasArrays mpas_arrays(const Mesh& mesh, const DecComplex& complex) { return MpasBuilder(mesh, complex).build(); }

}  // namespace temper::io
