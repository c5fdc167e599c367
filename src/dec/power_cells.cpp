// Power cells. Most of them are polygons of orthocenters; what is not is put together from the pieces of triangles.
//
// A triangle is plain when its corners surely own a quadrilateral each, of the corner, the weighted midpoints beside it
// and the orthocenter: all h ≥ 0, also those of the neighbours over its edges, and at its corners no dual edge negative
// and no d < 0. (The dual edges around a corner are then a convex chain, with the quadrilateral on its inner side, and
// the corner in its own cell.) A vertex is plain when its triangles are and it owns nothing else. Decided by exact
// signs.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "dec/accurate.hpp"
#include "dec/division.hpp"
#include "dec/join.hpp"
#include "temper/dec.hpp"
#include "temper/geometry.hpp"

namespace temper {
namespace {

// Corners of one cell nearer to each other than this are one: the orthocenters of cocircular triangles.
constexpr double kOnePlace = 1e-14;
// A polygon whose width is this share of its coordinates is lost when they are rounded: four units in the last place.
constexpr double kInvisible = 0x1p-50;

class CellBuilder {
 public:
  CellBuilder(const Mesh& mesh, const DecComplex& complex) : mesh_(mesh), complex_(complex), divider_(mesh) {}
  PowerCells build();

 private:
  void find_plain();
  [[nodiscard]] bool is_plain(TriangleId t) const;
  void divide_all();
  [[nodiscard]] LocalPolygon orthocenters_around(VertexId v) const;
  [[nodiscard]] Vec2 midpoint(VertexId v, VertexId other) const;
  void emit(VertexId v, LocalPolygon polygon);

  const Mesh& mesh_;
  const DecComplex& complex_;
  TriangleDivider divider_;
  IdVector<VertexId, char> tame_;     // no negative dual edge at it, no d < 0 from it
  IdVector<TriangleId, char> plain_;  // triangles
  IdVector<VertexId, char> special_;  // vertices: cells to be joined from pieces
  std::vector<CellPiece> pieces_;     // of special vertices, by vertex
  PowerCells cells_;
};

void CellBuilder::find_plain() {
  tame_.assign(mesh_.n_vertices(), 1);
  for (std::size_t i = 0; i < complex_.edges.size(); ++i) {
    const DecEdge& e = complex_.edges[EdgeId(i)];
    const WeightedPoint from = mesh_.point(e.from), to = mesh_.point(e.to);
    const bool negative = complex_.star1[EdgeId(i)] < 0;
    if (negative || edge_split_sign(from, to) == Sign::negative) tame_[e.from] = 0;
    if (negative || edge_split_sign(to, from) == Sign::negative) tame_[e.to] = 0;
  }
  plain_.assign(mesh_.n_triangles(), 0);
  special_.assign(mesh_.n_vertices(), 0);
  for (const TriangleId t : mesh_.triangles()) {
    plain_[t] = is_plain(t) ? 1 : 0;
    if (plain_[t] != 0) continue;
    for (const VertexId v : mesh_.corners(t)) special_[v] = 1;
  }
}

bool CellBuilder::is_plain(TriangleId t) const {
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(t, k);
    const DecEdge& e = complex_.edges[complex_.edge_of_halfedge[h]];
    if (e.left_height < 0 || e.right_height < 0 || tame_[mesh_.origin(h)] == 0) return false;
  }
  return true;
}

void CellBuilder::divide_all() {
  std::vector<CellPiece> found;
  for (const TriangleId t : mesh_.triangles()) {
    if (plain_[t] != 0) continue;
    for (CellPiece& piece : divider_.divide(t)) {
      special_[piece.owner] = 1;
      found.push_back(std::move(piece));
    }
  }
  for (const TriangleId t : mesh_.triangles()) {
    if (plain_[t] == 0) continue;
    const auto corners = mesh_.corners(t);
    if (std::none_of(corners.begin(), corners.end(), [&](VertexId v) { return special_[v] != 0; })) continue;
    for (CellPiece& piece : divider_.divide(t)) {
      if (special_[piece.owner] != 0) found.push_back(std::move(piece));
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const CellPiece& a, const CellPiece& b) { return a.owner < b.owner; });
  pieces_ = std::move(found);
}

/// Relative to v.
Vec2 CellBuilder::midpoint(VertexId v, VertexId other) const {
  const WeightedPoint p = mesh_.point(v), q = mesh_.point(other);
  const Vec2 along = q.position() - p.position();
  return (0.5 * accurate::doubled_split(p, q) / squared_length(along)) * along;
}

/// The dual cell of a plain vertex, relative to it.
LocalPolygon CellBuilder::orthocenters_around(VertexId v) const {
  const WeightedPoint p = mesh_.point(v);
  const auto local = [&](VertexId u) {
    const WeightedPoint q = mesh_.point(u);
    return WeightedPoint{q.x - p.x, q.y - p.y, q.w};
  };
  LocalPolygon polygon;
  const bool boundary = mesh_.is_boundary(v);
  if (boundary) polygon = {{0, 0}, midpoint(v, mesh_.target(mesh_.outgoing(v)))};
  HalfedgeId last;
  for (const HalfedgeId h : mesh_.star(v)) {
    polygon.push_back(orthocenter({0, 0, p.w}, local(mesh_.target(h)), local(mesh_.opposite(h))));
    last = h;
  }
  if (boundary) polygon.push_back(midpoint(v, mesh_.opposite(last)));
  return polygon;
}

void CellBuilder::emit(VertexId v, LocalPolygon polygon) {
  double size = 0;
  for (const Vec2 c : polygon) size = std::max(size, length(c - polygon[0]));
  LocalPolygon clean;
  for (const Vec2 c : polygon) {
    if (clean.empty() || length(c - clean.back()) > kOnePlace * size) clean.push_back(c);
  }
  while (clean.size() > 1 && length(clean.front() - clean.back()) <= kOnePlace * size) clean.pop_back();
  const double area = area_of(clean);
  if (!(area > kInvisible * (length(mesh_.position(v)) + size) * size)) return;
  cells_.vertices.push_back(v);
  for (const Vec2 c : clean) cells_.corners.push_back(mesh_.position(v) + c);
  cells_.starts.push_back(cells_.corners.size());
  cells_.polygon_areas.push_back(area);
  cells_.areas[v] += area;
}

PowerCells CellBuilder::build() {
  find_plain();
  divide_all();
  cells_.areas.assign(mesh_.n_vertices(), 0.0);
  cells_.starts.push_back(0);
  std::size_t first = 0;
  for (const VertexId v : mesh_.vertices()) {
    if (mesh_.is_isolated(v)) continue;  // of no triangle: nothing is owned
    std::size_t end = first;
    while (end < pieces_.size() && pieces_[end].owner == v) ++end;
    if (special_[v] == 0) {
      emit(v, orthocenters_around(v));
    } else {
      for (LocalPolygon& polygon : join_pieces(mesh_, {pieces_.data() + first, end - first})) {
        emit(v, std::move(polygon));
      }
    }
    first = end;
  }
  return std::move(cells_);
}

}  // namespace

PowerCells power_cells(const Mesh& mesh, const DecComplex& complex) { return CellBuilder(mesh, complex).build(); }

}  // namespace temper
