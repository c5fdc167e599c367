// Power cells. Most are polygons of orthocenters; the others are put together from the pieces of triangles.
//
// A triangle is plain when each corner surely owns the quadrilateral of the corner, its two weighted midpoints and the
// orthocenter. Conditions: all its h ≥ 0, also all h of the neighbors across its edges. At its corners no dual edge is
// negative and no d < 0. (Then the dual edges around a corner are a convex chain with the quadrilateral on its inner
// side, and the corner is in its own cell.) A vertex is plain when its triangles are and it owns nothing else. Exact
// signs decide all of this.
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "dec/accurate.hpp"
#include "dec/division.hpp"
#include "dec/joint_polygons.hpp"
#include "temper/dec.hpp"
#include "temper/detail/geometry.hpp"

namespace temper {
namespace {

// Corners of one cell nearer to each other than this are merged: they are orthocenters of cocircular triangles.
constexpr double kOnePlace = 1e-14;
// A polygon whose width is this share of its coordinates is lost when they are rounded: four units in the last place.
constexpr double kInvisible = 0x1p-50;

Sign crossing_sign(const Mesh& mesh, VertexId p, VertexId q) {
  const WeightedPoint from = mesh.point(p), to = mesh.point(q, from);
  return mesh.space().is_plane() ? dual_crossing_sign(from, to) : dual_crossing_sign(as_vector(from), as_vector(to));
}

/// The distance from vertex to vertex, on the sphere along an arc.
double length_between(const Mesh& mesh, VertexId p, VertexId q) {
  const WeightedPoint from = mesh.point(p);
  if (mesh.space().is_plane()) return length(mesh.point(q, from).position() - from.position());
  return mesh.space().radius() * arc_length(mesh.weighted_vector(p), mesh.weighted_vector(q));
}

/// The part of a convex polygon on the left of a line.
LocalPolygon left_of(const LocalPolygon& polygon, Vec2 from, Vec2 direction) {
  LocalPolygon part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    const double here = cross(direction, p - from), there = cross(direction, q - from);
    if (here >= 0) part.push_back(p);
    if ((here >= 0) != (there >= 0)) part.push_back(p + (here / (here - there)) * (q - p));
  }
  return part;
}

class CellBuilder {
 public:
  CellBuilder(const Mesh& mesh, const DecComplex& complex)
      : mesh_(mesh), complex_(complex), joints_(mesh), divider_(mesh, joints_) {}
  PowerCells build();

 private:
  void find_plain();
  [[nodiscard]] bool is_plain(TriangleId t) const;
  [[nodiscard]] bool is_plain_alone(TriangleId t) const;
  [[nodiscard]] bool has_special_corner(TriangleId t) const;
  void divide_all();
  [[nodiscard]] LocalPolygon orthocenters_around(VertexId v, const Chart& chart) const;
  [[nodiscard]] Vec2 corner(VertexId v, HalfedgeId h, const Chart& chart) const;
  [[nodiscard]] Vec2 midpoint(VertexId v, HalfedgeId h, const Chart& chart) const;
  void emit_joined(VertexId v, std::span<const CellPiece> pieces);
  void emit(VertexId v, const Chart& chart, const LocalPolygon& polygon);
  void find_region(VertexId v, std::span<const CellPiece> pieces);
  void add_part(TriangleId t, double area);
  void add_parts(const CellPiece& piece);
  [[nodiscard]] double part_in(VertexId v, HalfedgeId h) const;
  void add_faces(const CellPiece& piece);
  void add_plain_faces();
  void join_faces();
  [[nodiscard]] double area_in_space(const Chart& chart, const LocalPolygon& polygon) const;

  const Mesh& mesh_;
  const DecComplex& complex_;
  const JointPolygons joints_;
  TriangleDivider divider_;
  IdVector<VertexId, char> tame_;     // no negative dual edge at it, no d < 0 from it
  IdVector<TriangleId, char> plain_;  // triangles
  IdVector<VertexId, char> special_;  // vertices: cells to be joined from pieces
  std::vector<CellPiece> pieces_;     // of special vertices, by vertex
  struct RegionPart {
    std::int32_t region;
    double area;
  };
  std::vector<RegionPart> parts_;  // of the cell at hand
  PowerCells cells_;
};

void CellBuilder::find_plain() {
  tame_.assign(mesh_.n_vertices(), 1);
  for (std::size_t i = 0; i < complex_.edges.size(); ++i) {
    const DecEdge& e = complex_.edges[EdgeId(i)];
    if (joints_.are_one(e.left, e.right)) continue;  // inside a polygon
    const bool negative = complex_.star1[EdgeId(i)] < 0;
    if (negative || crossing_sign(mesh_, e.from, e.to) == Sign::negative) tame_[e.from] = 0;
    if (negative || crossing_sign(mesh_, e.to, e.from) == Sign::negative) tame_[e.to] = 0;
  }
  plain_.assign(mesh_.n_triangles(), 0);
  special_.assign(mesh_.n_vertices(), 0);
  for (const TriangleId t : mesh_.triangles()) {
    plain_[t] = is_plain(t) ? 1 : 0;
    if (plain_[t] != 0) continue;
    for (const VertexId v : mesh_.corners(t)) special_[v] = 1;
  }
}

/// The triangles of a polygon are plain together. Regions divide cells along triangles, so it must be in one.
bool CellBuilder::is_plain(TriangleId t) const {
  if (!joints_.has(t)) return is_plain_alone(t);
  return joints_.has_one_region(t) &&
         std::ranges::all_of(joints_.triangles(t), [&](TriangleId other) { return is_plain_alone(other); });
}

bool CellBuilder::is_plain_alone(TriangleId t) const {
  constexpr double kOnSide = 1e-7;  // of a polygon's side, as in keep_faces(): then its orthocenter is there
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(t, k);
    if (tame_[mesh_.origin(h)] == 0) return false;
    if (joints_.is_inside(h)) continue;
    const DecEdge& e = complex_.edges[complex_.edge_of_halfedge[h]];
    const bool at_polygon = (e.left.valid() && joints_.has(e.left)) || (e.right.valid() && joints_.has(e.right));
    const double least = at_polygon ? -kOnSide * e.length : 0;
    if (e.left_height < least || e.right_height < least) return false;
  }
  return true;
}

bool CellBuilder::has_special_corner(TriangleId t) const {
  const auto has = [&](TriangleId triangle) {
    return std::ranges::any_of(mesh_.corners(triangle), [&](VertexId v) { return special_[v] != 0; });
  };
  return joints_.has(t) ? std::ranges::any_of(joints_.triangles(t), has) : has(t);
}

void CellBuilder::divide_all() {
  std::vector<CellPiece> found;
  for (const TriangleId t : mesh_.triangles()) {
    if (plain_[t] != 0 || joints_.whole(t) != t) continue;
    for (CellPiece& piece : divider_.divide(t)) {
      add_faces(piece);
      special_[piece.owner] = 1;
      found.push_back(std::move(piece));
    }
  }
  for (const TriangleId t : mesh_.triangles()) {
    if (plain_[t] == 0 || joints_.whole(t) != t || !has_special_corner(t)) continue;
    for (CellPiece& piece : divider_.divide(t)) {
      if (special_[piece.owner] != 0) found.push_back(std::move(piece));
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const CellPiece& a, const CellPiece& b) { return a.owner < b.owner; });
  pieces_ = std::move(found);
}

/// The weighted midpoint of the edge of h, at v.
Vec2 CellBuilder::midpoint(VertexId v, HalfedgeId h, const Chart& chart) const {
  if (mesh_.is_joint(h)) return corner(v, h, chart);  // on the boundary
  if (!mesh_.space().is_plane()) return chart.of(complex_.sphere_midpoints[complex_.edge_of_halfedge[h]]);
  const WeightedPoint p = mesh_.point(v), q = mesh_.point(mesh_.origin(h) == v ? mesh_.target(h) : mesh_.origin(h), p);
  const Vec2 along = q.position() - p.position();
  return (0.5 * accurate::doubled_crossing(p, q) / squared_length(along)) * along;
}

/// The orthocenter of the triangle of h, out of v; the same for all triangles of a polygon.
Vec2 CellBuilder::corner(VertexId v, HalfedgeId h, const Chart& chart) const {
  const TriangleId whole = joints_.whole(Mesh::triangle(h));
  if (!mesh_.space().is_plane()) return chart.of(complex_.sphere_orthocenters[whole]);
  if (joints_.has(whole)) {
    const auto [i, j, k] = mesh_.corners(whole);
    return orthocenter(chart.of(mesh_, i), chart.of(mesh_, j), chart.of(mesh_, k));
  }
  return orthocenter({0, 0, mesh_.weight(v)}, chart.of(mesh_, mesh_.target(h)), chart.of(mesh_, mesh_.opposite(h)));
}

/// The dual cell of a plain vertex, in the chart around it.
LocalPolygon CellBuilder::orthocenters_around(VertexId v, const Chart& chart) const {
  LocalPolygon polygon;
  const bool boundary = mesh_.is_boundary(v);
  if (boundary) polygon = {{0, 0}, midpoint(v, mesh_.outgoing(v), chart)};
  HalfedgeId last;
  for (const HalfedgeId h : mesh_.star(v)) {
    polygon.push_back(corner(v, h, chart));
    last = h;
  }
  if (boundary) polygon.push_back(midpoint(v, Mesh::prev(last), chart));
  return polygon;
}

/// If a cell reaches a quarter turn away from its vertex, in a mesh of few triangles, its pieces stay apart.
void CellBuilder::emit_joined(VertexId v, std::span<const CellPiece> pieces) {
  const Chart chart = Chart::around(mesh_, v);
  const bool together = std::all_of(pieces.begin(), pieces.end(), [&](const CellPiece& piece) {
    const Chart plane = Chart::of_triangle(mesh_, piece.triangle);
    return std::all_of(piece.corners.begin(), piece.corners.end(),
                       [&](const PieceCorner& c) { return chart.has(plane, c.at); });
  });
  if (together) {
    for (const LocalPolygon& polygon : join_pieces(mesh_, chart, pieces)) emit(v, chart, polygon);
    return;
  }
  for (const CellPiece& piece : pieces) {
    LocalPolygon polygon;
    for (const PieceCorner& c : piece.corners) polygon.push_back(c.at);
    emit(v, Chart::of_triangle(mesh_, piece.triangle), polygon);
  }
}

/// The signed area of a polygon of great circles on the sphere: triangles from its first corner.
double CellBuilder::area_in_space(const Chart& chart, const LocalPolygon& polygon) const {
  if (mesh_.space().is_plane()) return area_of(polygon);
  double sum = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    sum += solid_angle(chart.ray(polygon[0]), chart.ray(polygon[i - 1]), chart.ray(polygon[i]));
  }
  return mesh_.space().radius() * mesh_.space().radius() * sum;
}

void CellBuilder::emit(VertexId v, const Chart& chart, const LocalPolygon& polygon) {
  const bool plane = mesh_.space().is_plane();
  double size = 0;
  for (const Vec2 c : polygon) size = std::max(size, length(c - polygon[0]));
  LocalPolygon clean;
  for (const Vec2 c : polygon) {
    if (clean.empty() || length(c - clean.back()) > kOnePlace * size) clean.push_back(c);
  }
  while (clean.size() > 1 && length(clean.front() - clean.back()) <= kOnePlace * size) clean.pop_back();
  const double area = area_in_space(chart, clean);
  const double far = plane ? length(mesh_.position(v)) : mesh_.space().radius();
  if (!(area > kInvisible * (far + size) * size)) return;
  cells_.vertices.push_back(v);
  for (const Vec2 c : clean) {
    if (plane) {
      cells_.corners.push_back(mesh_.position(v) + c);
    } else {
      const Vec3 ray = chart.ray(c);
      cells_.sphere_corners.push_back(mesh_.space().radius() / length(ray) * ray);
    }
  }
  cells_.starts.push_back(plane ? cells_.corners.size() : cells_.sphere_corners.size());
  cells_.polygon_areas.push_back(area);
  cells_.areas[v] += area;
}

/// The area that a plain cell has in the triangle of h, which begins at v: two right triangles.
double CellBuilder::part_in(VertexId v, HalfedgeId h) const {
  double area = 0;
  for (const HalfedgeId side : {h, Mesh::prev(h)}) {
    if (joints_.is_inside(side)) continue;  // what one triangle has too much, the other has too little
    const DecEdge& e = complex_.edges[complex_.edge_of_halfedge[side]];
    const double d = e.from == v ? e.crossing : e.length - e.crossing;
    area += mesh_.space().right_triangle_area(d, e.left == Mesh::triangle(h) ? e.left_height : e.right_height);
  }
  return area;
}

void CellBuilder::add_part(TriangleId t, double area) {
  const auto known = std::ranges::find(parts_, mesh_.region(t), &RegionPart::region);
  if (known == parts_.end())
    parts_.push_back({mesh_.region(t), area});
  else
    known->area += area;
}

/// The part of a piece in each triangle of a polygon is on the left of its sides.
void CellBuilder::add_parts(const CellPiece& piece) {
  const Chart chart = Chart::of_triangle(mesh_, piece.triangle);
  LocalPolygon whole;
  for (const PieceCorner& c : piece.corners) whole.push_back(c.at);
  if (!joints_.has(piece.triangle) || joints_.has_one_region(piece.triangle))
    return add_part(piece.triangle, area_in_space(chart, whole));
  for (const TriangleId t : joints_.triangles(piece.triangle)) {
    LocalPolygon part = whole;
    const auto corners = mesh_.corners(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 from = chart.of(mesh_, corners.at(k)).position();
      part = left_of(part, from, chart.of(mesh_, corners.at((k + 1) % 3)).position() - from);
    }
    add_part(t, area_in_space(chart, part));
  }
}

void CellBuilder::find_region(VertexId v, std::span<const CellPiece> pieces) {
  parts_.clear();
  for (const CellPiece& piece : pieces) add_parts(piece);
  const bool is_empty = special_[v] != 0 && pieces.empty();
  for (const HalfedgeId h : mesh_.star(v)) {
    if (is_empty || special_[v] == 0) add_part(Mesh::triangle(h), is_empty ? 0 : part_in(v, h));
  }
  double sum = 0;
  RegionPart most = parts_.front();
  for (const RegionPart& part : parts_) {
    sum += part.area;
    if (part.area > most.area || (part.area == most.area && part.region < most.region)) most = part;
  }
  cells_.regions[v] = most.region;
  cells_.region_shares[v] = is_empty ? 0 : parts_.size() == 1 ? 1 : most.area / sum;
}

/// The sides of a piece with other cells beyond. Two pieces have the side; the piece of the lower vertex adds it.
void CellBuilder::add_faces(const CellPiece& piece) {
  const bool plane = mesh_.space().is_plane();
  const Chart chart = plane ? Chart() : Chart::of_triangle(mesh_, piece.triangle);
  for (std::size_t i = 0; i < piece.corners.size(); ++i) {
    const PieceCorner& from = piece.corners[i];
    const PieceCorner& to = piece.corners[(i + 1) % piece.corners.size()];
    if (!from.against.valid() || from.against < piece.owner) continue;
    const double width =
        plane ? length(to.at - from.at) : mesh_.space().radius() * arc_length(chart.ray(from.at), chart.ray(to.at));
    cells_.faces.push_back({piece.owner, from.against, width});
  }
}

/// In a plain triangle the cells of its corners meet on the heights of the orthocenter.
void CellBuilder::add_plain_faces() {
  cells_.faces.reserve(cells_.faces.size() + complex_.edges.size());
  for (const DecEdge& edge : complex_.edges) {
    if (joints_.are_one(edge.left, edge.right)) continue;
    double width = 0;
    if (edge.left.valid() && plain_[edge.left] != 0) width += edge.left_height;
    if (edge.right.valid() && plain_[edge.right] != 0) width += edge.right_height;
    cells_.faces.push_back({edge.from, edge.to, width});
  }
}

/// Joins the parts that triangles have of a face. Cells that only touch have no face.
void CellBuilder::join_faces() {
  std::vector<PowerFace>& faces = cells_.faces;
  const auto before = [](const PowerFace& a, const PowerFace& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  };
  if (!std::is_sorted(faces.begin(), faces.end(), before)) std::stable_sort(faces.begin(), faces.end(), before);
  std::size_t n = 0;
  for (std::size_t i = 0; i < faces.size();) {
    PowerFace face = faces[i++];
    while (i < faces.size() && !before(face, faces[i])) face.width += faces[i++].width;
    if (face.width > kOnePlace * length_between(mesh_, face.first, face.second)) faces[n++] = face;
  }
  faces.resize(n);
}

PowerCells CellBuilder::build() {
  find_plain();
  divide_all();
  add_plain_faces();
  join_faces();
  cells_.areas.assign(mesh_.n_vertices(), 0.0);
  cells_.regions.assign(mesh_.n_vertices(), 0);
  cells_.region_shares.assign(mesh_.n_vertices(), 0.0);
  const std::size_t n = mesh_.n_vertices(),
                    n_sides = mesh_.n_halfedges() + 3 * (2 * complex_.edges.size() - mesh_.n_halfedges());
  cells_.vertices.reserve(n);
  cells_.starts.reserve(n + 1);
  cells_.polygon_areas.reserve(n);
  // One corner in each triangle, and three at each boundary vertex. Cells in pieces may have more.
  if (mesh_.space().is_plane())
    cells_.corners.reserve(n_sides);
  else
    cells_.sphere_corners.reserve(n_sides);
  cells_.starts.push_back(0);
  std::size_t first = 0;
  for (const VertexId v : mesh_.vertices()) {
    if (mesh_.is_isolated(v)) continue;  // of no triangle: nothing is owned
    std::size_t end = first;
    while (end < pieces_.size() && pieces_[end].owner == v) ++end;
    if (special_[v] == 0) {
      const Chart chart = Chart::around(mesh_, v);
      emit(v, chart, orthocenters_around(v, chart));
    } else {
      emit_joined(v, {pieces_.data() + first, end - first});
    }
    find_region(v, {pieces_.data() + first, end - first});
    first = end;
  }
  return std::move(cells_);
}

}  // namespace

PowerCells power_cells(const Mesh& mesh, const DecComplex& complex) { return CellBuilder(mesh, complex).build(); }

}  // namespace temper
