// The dual for ParaView and similar programs: power cells as polygons or polyhedra, dual edges as lines between
// orthocenters.
#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/formats/cells.hpp"
#include "io/formats/vtk/vtu_write.hpp"
#include "io/operators/dec_files.hpp"

namespace temper::io {
namespace {

/// An array of doubles, or of 32-bit integers.
template <class F>
VtkArray dual_reals(std::string name, std::size_t n, F value) {
  return computed_vtk_array<double>(std::move(name), Scalar::f64, n, std::move(value));
}

template <class F>
VtkArray dual_integers(std::string name, std::size_t n, F value) {
  return computed_vtk_array<std::int32_t>(std::move(name), Scalar::i32, n,
                                          [value](std::size_t i) { return static_cast<std::int32_t>(value(i)); });
}

/// The types of cells when all have the same type.
VtkArray one_type(std::size_t n, int type) {
  return computed_vtk_array<std::uint8_t>("types", Scalar::u8, n,
                                          [type](std::size_t) { return static_cast<std::uint8_t>(type); });
}

/// Three numbers per point; in the plane z is the mesh's.
VtkArray dual_points(const DecPositions& places, double z) {
  return computed_vtk_array<double>(
      "Points", Scalar::f64, 3 * places.size,
      [&places, z](std::size_t i) { return i % 3 < places.coordinates ? places.coordinate(i / 3, i % 3) : z; }, 3);
}

// A cell of several polygons has the same number, area and star on each of them.
void write_cells(const DecJob& job) {
  const PowerCells& cells = job.cells;
  const DecPositions places = corner_positions(cells);
  const std::size_t n = cells.n_polygons(), n_points = places.size;
  const auto owner = [&cells](std::size_t p) { return cells.vertices[p]; };
  const VtuPiece piece = {
      dual_points(places, job.options.z),
      {dual_integers("connectivity", n_points, [](std::size_t i) { return i; }),
       dual_integers("offsets", n, [&cells](std::size_t p) { return cells.starts[p + 1]; }), one_type(n, kVtkPolygon)},
      {},
      {dual_integers("vertex", n, [owner](std::size_t p) { return owner(p).index; }),
       dual_reals("polygon_area", n, [&cells](std::size_t p) { return cells.polygon_areas[p]; }),
       dual_reals("area", n, [&cells, owner](std::size_t p) { return cells.areas[owner(p)]; }),
       dual_reals("star0", n, [&job, owner](std::size_t p) { return job.complex.star0[owner(p)]; }),
       dual_reals("weight", n, [&job, owner](std::size_t p) { return job.mesh.weight(owner(p)); })}};
  write_piece(job.open("dual.vtu"), piece, Encoding::base64, job.options.executor);
}

/// dual_edges.vtu: lines between orthocenters. Points are the orthocenters, then a foot of each line. A line runs from
/// the first element of its pair to the second. On the boundary it runs from the only element to its foot.
template <class IdType>
void write_dual_edges(const DecFolder& folder, const DecPositions& orthocenters, const DecPositions& feet,
                      const char* foot, const std::function<std::array<IdType, 2>(std::size_t)>& pair,
                      const std::vector<VtkArray>& cell_data) {
  const std::size_t n_centers = orthocenters.size, n = feet.size, n_points = n_centers + n;
  const DecPositions places = {orthocenters.coordinates, n_points, [&](std::size_t i) {
                                 return i < n_centers ? orthocenters.at(i) : feet.at(i - n_centers);
                               }};
  const auto end = [&pair, n_centers](std::size_t i) -> std::size_t {
    const auto [first, second] = pair(i / 2);
    if (i % 2 == 0) return first.valid() ? first.index : second.index;
    return first.valid() && second.valid() ? second.index : n_centers + i / 2;
  };
  const VtuPiece piece = {
      dual_points(places, folder.options.z),
      {dual_integers("connectivity", 2 * n, end),
       dual_integers("offsets", n, [](std::size_t i) { return 2 * (i + 1); }), one_type(n, kVtkLine)},
      {dual_integers(foot, n_points, [n_centers](std::size_t i) { return i < n_centers ? 0 : 1; }),
       dual_integers("element", n_points, [n_centers](std::size_t i) { return i < n_centers ? i : i - n_centers; })},
      cell_data};
  write_piece(folder.open("dual_edges.vtu"), piece, Encoding::base64, folder.options.executor);
}

}  // namespace

void write_dec_vtu(const DecJob& job) {
  write_cells(job);
  const DecComplex& c = job.complex;
  const std::size_t n = c.edges.size();
  const auto edge = [&c](std::size_t i) -> const DecEdge& { return c.edges[EdgeId(i)]; };
  write_dual_edges<TriangleId>(
      job, orthocenter_positions(c), midpoint_positions(c), "midpoint",
      [edge](std::size_t i) {
        return std::array{edge(i).left, edge(i).right};
      },
      {dual_integers("from", n, [edge](std::size_t i) { return edge(i).from.index; }),
       dual_integers("to", n, [edge](std::size_t i) { return edge(i).to.index; }),
       dual_integers("boundary", n, [edge](std::size_t i) { return edge(i).is_boundary() ? 1 : 0; }),
       dual_reals("length", n, [edge](std::size_t i) { return edge(i).length; }),
       dual_reals("dual_length", n, [edge](std::size_t i) { return edge(i).dual_length; }),
       dual_reals("star1", n, [&c](std::size_t i) { return c.star1[EdgeId(i)]; })});
}

// dual.vtu of tetrahedra: the dual cell of each vertex, a VTK polyhedron of dual faces.
//
// A dual face has the orthocenters around its edge. On the boundary it also has the orthocenters of two boundary faces
// and the weighted midpoint of the edge. There quadrilaterals close the cell: from the vertex over a midpoint to the
// orthocenter of a face, and back over another midpoint.

namespace {

VtkArray long_integers(std::string name, const std::vector<std::int64_t>& values) {
  return computed_vtk_array<std::int64_t>(std::move(name), Scalar::i64, values.size(),
                                          [&values](std::size_t i) { return values[i]; });
}

class DualCells {
 public:
  explicit DualCells(const TetDecJob& job);
  void write(const TetDecJob& job) const;

 private:
  using Polygon = std::vector<std::int64_t>;
  struct Link {  // around an edge, counter-clockwise as seen from its end: from one tetrahedron to the next
    tets::TetId from, to;
    std::int64_t foot;  // point of the face between them, on the boundary
  };

  std::int64_t add_point(Vec3 place) {
    places_.push_back(place);
    return static_cast<std::int64_t>(places_.size() - 1);
  }
  void add_boundary(const TetDecJob& job);
  void add_dual_faces(const tets::DecComplex& c);
  [[nodiscard]] static Polygon ring(std::vector<Link> links, std::int64_t midpoint);
  void add_polygon(VertexId v, const Polygon& polygon, bool reversed);
  void finish();

  std::vector<Vec3> places_;
  std::vector<std::int64_t> face_points_, edge_points_;  // on the boundary
  IdVector<VertexId, Polygon> streams_;                  // size, points, size, points, …: the faces of each cell
  IdVector<VertexId, std::int64_t> n_polygons_;
  std::vector<std::int64_t> connectivity_, ends_, faces_, ends_of_faces_;  // as VTK has them
};

DualCells::DualCells(const TetDecJob& job)
    : places_(job.complex.orthocenters.raw()),
      face_points_(job.complex.faces.size(), -1),
      edge_points_(job.complex.edges.size(), -1),
      streams_(job.mesh.n_vertices()),
      n_polygons_(job.mesh.n_vertices(), 0) {
  add_boundary(job);
  add_dual_faces(job.complex);
  finish();
}

void DualCells::add_polygon(VertexId v, const Polygon& polygon, bool reversed) {
  Polygon& stream = streams_[v];
  stream.push_back(static_cast<std::int64_t>(polygon.size()));
  if (reversed)
    stream.insert(stream.end(), polygon.rbegin(), polygon.rend());
  else
    stream.insert(stream.end(), polygon.begin(), polygon.end());
  ++n_polygons_[v];
}

void DualCells::add_boundary(const TetDecJob& job) {
  const tets::DecComplex& c = job.complex;
  IdVector<VertexId, std::int64_t> vertex_points(job.mesh.n_vertices(), -1);
  for (std::size_t e = 0; e < c.edges.size(); ++e) {
    if (c.edges[EdgeId(e)].is_boundary) edge_points_[e] = add_point(c.edges[EdgeId(e)].midpoint);
  }
  for (std::size_t f = 0; f < c.faces.size(); ++f) {
    const tets::DecFace& face = c.faces[tets::FaceId(f)];
    if (!face.is_boundary()) continue;
    face_points_[f] = add_point(face.orthocenter);
    const auto midpoint = [&](std::size_t k) {
      return edge_points_[static_cast<std::size_t>(c.d1.columns[3 * f + k])];
    };
    // Of ascending vertices p, q, r: midpoints of pq, pr, qr. Counter-clockwise from outside if the normal points out.
    constexpr std::array<std::array<std::size_t, 2>, 3> kSides = {{{0, 1}, {2, 0}, {1, 2}}};
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId v = face.vertices[k];
      if (vertex_points[v] < 0) vertex_points[v] = add_point(job.mesh.position(v));
      const auto [first, second] = kSides[k];
      add_polygon(v, {vertex_points[v], midpoint(first), face_points_[f], midpoint(second)}, face.ahead.valid());
    }
  }
}

/// Around an edge pq, the normal of a face pqr is the way onwards.
void DualCells::add_dual_faces(const tets::DecComplex& c) {
  std::vector<std::vector<Link>> links(c.edges.size());
  for (std::size_t f = 0; f < c.faces.size(); ++f) {
    const tets::DecFace& face = c.faces[tets::FaceId(f)];
    for (std::size_t i = 3 * f; i < 3 * f + 3; ++i) {
      const bool onwards = c.d1.signs[i] > 0;
      links[static_cast<std::size_t>(c.d1.columns[i])].push_back(
          {onwards ? face.behind : face.ahead, onwards ? face.ahead : face.behind, face_points_[f]});
    }
  }
  for (std::size_t e = 0; e < c.edges.size(); ++e) {
    const Polygon polygon = ring(std::move(links[e]), edge_points_[e]);
    add_polygon(c.edges[EdgeId(e)].from, polygon, false);
    add_polygon(c.edges[EdgeId(e)].to, polygon, true);
  }
}

DualCells::Polygon DualCells::ring(std::vector<Link> links, std::int64_t midpoint) {
  const auto first = std::find_if(links.begin(), links.end(), [](const Link& link) { return !link.from.valid(); });
  if (first != links.end()) std::swap(*first, links.front());
  Polygon polygon;
  if (midpoint >= 0) polygon = {midpoint, links.front().foot};
  for (std::size_t i = 1; i < links.size(); ++i) {
    const tets::TetId at = links[i - 1].to;
    polygon.push_back(at.index);
    std::swap(links[i], *std::find_if(links.begin() + static_cast<std::ptrdiff_t>(i), links.end(),
                                      [at](const Link& link) { return link.from == at; }));
  }
  polygon.push_back(midpoint >= 0 ? links.back().foot : std::int64_t{links.back().to.index});
  return polygon;
}

void DualCells::finish() {
  for (std::size_t v = 0; v < streams_.size(); ++v) {
    const Polygon& stream = streams_[VertexId(v)];
    Polygon points;
    for (std::size_t i = 0; i < stream.size(); i += 1 + static_cast<std::size_t>(stream[i]))
      points.insert(points.end(), stream.begin() + static_cast<std::ptrdiff_t>(i + 1),
                    stream.begin() + static_cast<std::ptrdiff_t>(i + 1) + stream[i]);
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    connectivity_.insert(connectivity_.end(), points.begin(), points.end());
    ends_.push_back(static_cast<std::int64_t>(connectivity_.size()));
    faces_.push_back(n_polygons_[VertexId(v)]);
    faces_.insert(faces_.end(), stream.begin(), stream.end());
    ends_of_faces_.push_back(static_cast<std::int64_t>(faces_.size()));
  }
}

void DualCells::write(const TetDecJob& job) const {
  const std::size_t n = streams_.size();
  const DecPositions places = {3, places_.size(), [this](std::size_t i) { return places_[i]; }};
  const VtuPiece piece = {
      dual_points(places, 0),
      {long_integers("connectivity", connectivity_), long_integers("offsets", ends_), one_type(n, kVtkPolyhedron),
       long_integers("faces", faces_), long_integers("faceoffsets", ends_of_faces_)},
      {},
      {dual_integers("vertex", n, [](std::size_t v) { return v; }),
       dual_reals("star0", n, [&job](std::size_t v) { return job.complex.star0[VertexId(v)]; }),
       dual_reals("weight", n, [&job](std::size_t v) { return job.mesh.weight(VertexId(v)); })}};
  write_piece(job.open("dual.vtu"), piece, Encoding::base64, job.options.executor);
}

}  // namespace

void write_dec_vtu(const TetDecJob& job) {
  DualCells(job).write(job);
  const tets::DecComplex& c = job.complex;
  const std::size_t n = c.faces.size();
  const auto face = [&c](std::size_t i) -> const tets::DecFace& { return c.faces[tets::FaceId(i)]; };
  write_dual_edges<tets::TetId>(
      job, orthocenter_positions(c), face_orthocenter_positions(c), "face_orthocenter",
      [face](std::size_t i) {
        return std::array{face(i).behind, face(i).ahead};
      },
      {dual_integers("boundary", n, [face](std::size_t i) { return face(i).is_boundary() ? 1 : 0; }),
       dual_reals("area", n, [face](std::size_t i) { return face(i).area; }),
       dual_reals("dual_length", n, [face](std::size_t i) { return face(i).dual_length; }),
       dual_reals("star2", n, [&c](std::size_t i) { return c.star2[tets::FaceId(i)]; })});
}

// columns.vtu: each active cell is a prism over its polygon, a VTK polyhedron; a cell of several polygons has one prism
// over each. Prisms share no points: their tops and bottoms are flat, at different heights than their neighbors'.

namespace {

/// All prisms, in the order of polygons and, below each, of layers.
struct Prisms {
  std::vector<std::size_t> cells;                        // of the columns
  std::vector<std::size_t> polygons;                     // of the columns as seen from above
  std::vector<double> points;                            // three numbers each: of a prism the bottom, then the top
  std::vector<std::int64_t> ends, faces, ends_of_faces;  // as VTK has them

  void add(std::size_t polygon, std::span<const Vec2> corners, const Columns& columns, std::size_t cell);
  [[nodiscard]] std::size_t size() const { return cells.size(); }
};

void Prisms::add(std::size_t polygon, std::span<const Vec2> corners, const Columns& columns, std::size_t cell) {
  const std::size_t n = corners.size();
  const auto bottom = [base = static_cast<std::int64_t>(points.size() / 3), n](std::size_t i) {
    return base + static_cast<std::int64_t>(i % n);
  };
  const auto top = [bottom, n](std::size_t i) { return bottom(i) + static_cast<std::int64_t>(n); };
  for (const double z : {columns.bottoms[cell], columns.tops[cell]}) {
    for (const Vec2 corner : corners) points.insert(points.end(), {corner.x, corner.y, z});
  }
  // Seen from outside, corners of faces are counter-clockwise.
  faces.push_back(static_cast<std::int64_t>(n + 2));
  faces.push_back(static_cast<std::int64_t>(n));
  for (std::size_t i = n; i-- > 0;) faces.push_back(bottom(i));
  faces.push_back(static_cast<std::int64_t>(n));
  for (std::size_t i = 0; i < n; ++i) faces.push_back(top(i));
  for (std::size_t i = 0; i < n; ++i) faces.insert(faces.end(), {4, bottom(i), bottom(i + 1), top(i + 1), top(i)});
  cells.push_back(cell);
  polygons.push_back(polygon);
  ends.push_back(static_cast<std::int64_t>(points.size() / 3));
  ends_of_faces.push_back(static_cast<std::int64_t>(faces.size()));
}

/// The corners of a polygon: of a power cell with the rounding of this cell, as in dual.vtu.
std::vector<Vec2> corners_of(const DecJob& job, std::size_t polygon) {
  const CellPolygons& plan = job.options.columns->plan;
  if (plan.of == CellsOf::vertices) {
    const auto at = [&](std::size_t p) {
      return job.cells.corners.begin() + static_cast<std::ptrdiff_t>(job.cells.starts[p]);
    };
    return {at(polygon), at(polygon + 1)};
  }
  std::vector<Vec2> corners;
  for (const std::uint32_t corner : plan.polygon(polygon)) corners.push_back(plan.points[corner]);
  return corners;
}

}  // namespace

void write_columns_vtu(const DecJob& job) {
  const Columns& c = *job.options.columns;
  Prisms prisms;
  for (std::size_t p = 0; p < c.plan.n_polygons(); ++p) {
    const std::vector<Vec2> corners = corners_of(job, p);
    for (std::size_t layer = 0; layer < c.n_layers; ++layer) {
      const std::size_t cell = c.cell(c.plan.cells[p], layer);
      if (c.is_active(cell)) prisms.add(p, corners, c, cell);
    }
  }
  const std::size_t n = prisms.size(), n_points = prisms.points.size() / 3;
  const auto thickness = [&](std::size_t i) { return c.tops[prisms.cells[i]] - c.bottoms[prisms.cells[i]]; };
  const VtuPiece piece = {computed_vtk_array<double>(
                              "Points", Scalar::f64, 3 * n_points, [&](std::size_t i) { return prisms.points[i]; }, 3),
                          {computed_vtk_array<std::int64_t>("connectivity", Scalar::i64, n_points,
                                                            [](std::size_t i) { return static_cast<std::int64_t>(i); }),
                           long_integers("offsets", prisms.ends), one_type(n, kVtkPolyhedron),
                           long_integers("faces", prisms.faces), long_integers("faceoffsets", prisms.ends_of_faces)},
                          {},
                          {dual_integers(c.plan.of == CellsOf::vertices ? "vertex" : "triangle", n,
                                         [&](std::size_t i) { return c.column(prisms.cells[i]); }),
                           dual_integers("layer", n, [&](std::size_t i) { return c.layer(prisms.cells[i]) + 1; }),
                           dual_reals("thickness", n, thickness), dual_reals("volume", n, [&](std::size_t i) {
                             return c.plan.polygon_areas[prisms.polygons[i]] * thickness(i);
                           })}};
  write_piece(job.open("columns.vtu"), piece, Encoding::base64, job.options.executor);
}

}  // namespace temper::io
