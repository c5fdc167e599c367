// Operators and cells with diffusion tensors: those of the pieces in the planes of their metrics, mapped back and put
// together at interfaces.
#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "dec/coefficient.hpp"
#include "mesh/pieces.hpp"
#include "temper/dec.hpp"

namespace temper {
namespace {

/// An edge as the triangle on one side has it, from the beginning of its halfedge there.
struct Side {
  HalfedgeId halfedge;
  double length = 0, crossing = 0, height = 0;
  double factor = 1;  ///< K of the triangle, in its plane
  Vec2 midpoint;
};

class MetricDec {
 public:
  MetricDec(const DecComplex& of_pieces, const MetricMesh& pieces, const Mesh& mesh)
      : there_(of_pieces), pieces_(pieces), mesh_(mesh), c_(dec_operators(mesh)) {}

  DecComplex build() {
    c_.half_transmissibility.assign(mesh_.n_halfedges(), 0.0);
    for (const HalfedgeId h : mesh_.halfedges()) {
      if (!mesh_.is_boundary(h) && mesh_.target(h) < mesh_.origin(h)) continue;  // the twin is on the left
      const HalfedgeId other = mesh_.twin(h);
      const EdgeId e = c_.edge_of_halfedge[h];
      const bool is_left = c_.edges[e].from == mesh_.origin(h);
      write(e, is_left ? h : other, is_left ? other : h);
    }
    for (const TriangleId t : mesh_.triangles()) {
      c_.orthocenters[t] = pieces_.metric(t).from_metric(there_.orthocenters[t]);
      c_.areas[t] = there_.areas[t];
      c_.star2[t] = there_.star2[t];
    }
    c_.coefficient = there_.coefficient;
    c_.star0 = sums_of_copies(pieces_, there_.star0, mesh_.n_vertices());
    if (!there_.capacity.empty()) c_.capacity = sums_of_copies(pieces_, there_.capacity, mesh_.n_vertices());
    return std::move(c_);
  }

 private:
  [[nodiscard]] std::optional<Side> side_of(HalfedgeId h) const {
    if (!h.valid()) return std::nullopt;
    const TriangleId t = Mesh::triangle(h);
    const DecEdge& edge = there_.edges[there_.edge_of_halfedge[h]];
    const double factor = pieces_.metric(t).strength() * (there_.coefficient.empty() ? 1 : there_.coefficient[t]);
    const bool forward = edge.from == pieces_.mesh.origin(h);
    return Side{h,
                edge.length,
                forward ? edge.crossing : edge.length - edge.crossing,
                edge.left == t ? edge.left_height : edge.right_height,
                factor,
                pieces_.metric(t).from_metric(edge.midpoint)};
  }

  /// Writes an edge, with its halfedges on the left and on the right; one of them may be invalid. Lengths are those of
  /// the left side, or of the only one.
  void write(EdgeId e, HalfedgeId on_left, HalfedgeId on_right) {
    const std::optional<Side> left = side_of(on_left), right = side_of(on_right);
    const Side& first = left ? *left : *right;
    DecEdge& edge = c_.edges[e];
    edge.length = first.length;
    edge.crossing = left ? first.crossing : first.length - first.crossing;
    edge.midpoint = first.midpoint;
    edge.left_height = left ? left->height : 0;
    edge.right_height = right ? right->height * (first.length / right->length) : 0;
    const bool is_one = !left || !right || there_.edge_of_halfedge[on_left] == there_.edge_of_halfedge[on_right];
    edge.dual_length = is_one ? there_.edges[there_.edge_of_halfedge[first.halfedge]].dual_length
                              : edge.left_height + edge.right_height;
    const double k = left ? left->factor : right->factor, l = right ? right->factor : left->factor;
    const DualEdge dual = {edge.dual_length, edge.left_height, edge.right_height};
    const double resistance = dual.combined(1 / k, 1 / l);
    c_.star1[e] = dual.combined(k, l) / edge.length;
    c_.transmissibility[e] = over_height(edge.length, resistance);
    for (const std::optional<Side>& side : {left, right}) {
      if (side) c_.half_transmissibility[side->halfedge] = over_height(side->factor * side->length, side->height);
    }
  }

  const DecComplex& there_;
  const MetricMesh& pieces_;
  const Mesh& mesh_;
  DecComplex c_;
};

/// The metric of each vertex of pieces: that of its triangles.
IdVector<VertexId, const Metric*> metrics_of(const MetricMesh& pieces) {
  IdVector<VertexId, const Metric*> metrics(pieces.mesh.n_vertices(), &pieces.metrics[0]);
  for (const TriangleId t : pieces.mesh.triangles()) {
    for (const VertexId v : pieces.mesh.corners(t)) metrics[v] = &pieces.metric(t);
  }
  return metrics;
}

/// The polygons of all copies of a vertex, one after the other.
void join_polygons(PowerCells& cells, const MetricMesh& pieces) {
  std::vector<std::size_t> order(cells.n_polygons());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto owner = [&](std::size_t p) { return pieces.first_copy(cells.vertices[p]); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return owner(a) < owner(b); });
  PowerCells sorted;
  sorted.starts.push_back(0);
  for (const std::size_t p : order) {
    sorted.vertices.push_back(owner(p));
    sorted.polygon_areas.push_back(cells.polygon_areas[p]);
    for (std::size_t i = cells.starts[p]; i < cells.starts[p + 1]; ++i) sorted.corners.push_back(cells.corners[i]);
    sorted.starts.push_back(sorted.corners.size());
  }
  cells.vertices = std::move(sorted.vertices);
  cells.starts = std::move(sorted.starts);
  cells.corners = std::move(sorted.corners);
  cells.polygon_areas = std::move(sorted.polygon_areas);
}

/// Adds the areas of all copies. The region is that of the copy with the largest part.
void join_areas(PowerCells& cells, const MetricMesh& pieces) {
  IdVector<VertexId, double> parts;  // of the region of each copy
  for (const VertexId v : pieces.mesh.vertices()) {
    parts.push_back(cells.region_shares[v] * cells.areas[v]);
    cells.regions[v] = pieces.regions[static_cast<std::size_t>(cells.regions[v])].region;
  }
  for (const VertexId v : pieces.mesh.vertices()) {
    const VertexId first = pieces.first_copy(v);
    if (first == v) continue;
    cells.areas[first] += cells.areas[v];
    if (cells.regions[v] == cells.regions[first]) {
      parts[first] += parts[v];
    } else if (parts[v] > parts[first]) {
      parts[first] = parts[v];
      cells.regions[first] = cells.regions[v];
    }
  }
  for (const VertexId v : pieces.mesh.vertices())
    cells.region_shares[v] = cells.areas[v] > 0 ? std::min(1.0, parts[v] / cells.areas[v]) : 0;
  std::size_t n = 0;
  while (n < pieces.mesh.n_vertices() && pieces.first_copy(VertexId(n)) == VertexId(n)) ++n;
  cells.areas.resize(n), cells.regions.resize(n), cells.region_shares.resize(n);
}

/// Faces along an interface have a part on each side.
void join_faces(PowerCells& cells, const MetricMesh& pieces) {
  for (PowerFace& face : cells.faces) {
    const VertexId a = pieces.first_copy(face.first), b = pieces.first_copy(face.second);
    face.first = std::min(a, b);
    face.second = std::max(a, b);
  }
  const auto before = [](const PowerFace& a, const PowerFace& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  };
  std::stable_sort(cells.faces.begin(), cells.faces.end(), before);
  std::vector<PowerFace> joined;
  for (const PowerFace& face : cells.faces) {
    if (joined.empty() || before(joined.back(), face))
      joined.push_back(face);
    else
      joined.back().width += face.width;
  }
  cells.faces = std::move(joined);
}

}  // namespace

DecComplex mapped_back(DecComplex complex, const MetricMesh& pieces, const Mesh& mesh) {
  if (!pieces.regions.empty()) return MetricDec(complex, pieces, mesh).build();
  const Metric& metric = pieces.metrics[0];
  for (DecEdge& edge : complex.edges) edge.midpoint = metric.from_metric(edge.midpoint);
  for (Vec2& place : complex.orthocenters) place = metric.from_metric(place);
  for (double& value : complex.star1) value *= metric.strength();
  for (double& value : complex.transmissibility) value *= metric.strength();
  return complex;
}

PowerCells mapped_back(PowerCells cells, const MetricMesh& pieces) {
  const IdVector<VertexId, const Metric*> metrics = metrics_of(pieces);
  for (std::size_t p = 0; p < cells.n_polygons(); ++p) {
    const Metric& metric = *metrics[cells.vertices[p]];
    for (std::size_t i = cells.starts[p]; i < cells.starts[p + 1]; ++i)
      cells.corners[i] = metric.from_metric(cells.corners[i]);
  }
  if (!pieces.is_cut()) return cells;
  join_polygons(cells, pieces);
  join_areas(cells, pieces);
  join_faces(cells, pieces);
  return cells;
}

}  // namespace temper
