#include "surfaces/optimize/lines.hpp"

#include <algorithm>
#include <utility>

#include "surfaces/optimize/draft.hpp"

namespace temper::surfaces {
namespace {

// Vertices where a line bends more are corners. Gmsh takes 40 degrees, too. Circles of twelve edges have none.
constexpr double kCornerDeg = 40;

enum class Kind : std::uint8_t { boundary, crease, constrained };

/// The edges of lines at a vertex. More than two are only counted.
struct EdgesAtVertex {
  std::size_t n = 0;
  std::array<VertexId, 2> ends;
  std::array<Kind, 2> kinds = {};
  void add(VertexId end, Kind kind) {
    if (n < 2) ends[n] = end, kinds[n] = kind;
    ++n;
  }
  [[nodiscard]] VertexId beyond(VertexId end) const { return ends[0] == end ? ends[1] : ends[0]; }
};

IdVector<VertexId, EdgesAtVertex> edges_of_lines(const SurfaceMesh& mesh, const Edges& creases) {
  const Mesh& connectivity = mesh.connectivity();
  IdVector<VertexId, EdgesAtVertex> edges(mesh.n_vertices());
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!connectivity.is_unflippable(h) || !connectivity.is_edge_representative(h)) continue;
    const VertexId a = connectivity.origin(h), b = connectivity.target(h);
    const bool is_crease = std::binary_search(creases.begin(), creases.end(), ascending(a, b));
    const Kind kind = connectivity.is_boundary(h) ? Kind::boundary : is_crease ? Kind::crease : Kind::constrained;
    edges[a].add(b, kind), edges[b].add(a, kind);
  }
  return edges;
}

}  // namespace

Lines::Lines(const SurfaceMesh& mesh, const Edges& creases, bool may_slide) {
  const IdVector<VertexId, EdgesAtVertex> edges = edges_of_lines(mesh, creases);
  const auto is_inside = [&](VertexId v) {
    const EdgesAtVertex& e = edges[v];
    if (!may_slide || e.n != 2 || e.kinds[0] != e.kinds[1] || mesh.connectivity().is_fixed(v)) return false;
    const Vec3 p = mesh.position(v);
    return turn_deg(p - mesh.position(e.ends[0]), mesh.position(e.ends[1]) - p) <= kCornerDeg;
  };
  for (const VertexId v : mesh.vertices())
    tracks_.push_back(edges[v].n > 0 || mesh.connectivity().is_fixed(v) ? kHeld : kFree);
  for (const VertexId v : mesh.vertices()) {
    if (tracks_[v] != kHeld || !is_inside(v)) continue;
    // To the end of the line, or around a closed one. Then back.
    VertexId last = v, end = edges[v].ends[0];
    while (end != v && is_inside(end)) last = std::exchange(end, edges[end].beyond(last));
    std::vector<VertexId> line = {end};
    VertexId to = last;
    for (; to != end && is_inside(to); to = edges[to].beyond(line[line.size() - 2])) line.push_back(to);
    line.push_back(to);
    for (const VertexId u : line) {
      if (is_inside(u)) tracks_[u] = static_cast<Track>(lines_.size());
    }
    add(mesh, line);
  }
}

void Lines::add(const SurfaceMesh& mesh, const std::vector<VertexId>& vertices) {
  Line line;
  for (const VertexId v : vertices) line.points.push_back(mesh.position(v));
  std::vector<std::array<Vec3, 3>> segments;
  const std::size_t n = vertices.size() - 1;
  const bool is_closed = vertices.front() == vertices.back();
  for (std::size_t i = 0; i <= n; ++i) {
    const std::size_t before = i > 0 ? i - 1 : is_closed ? n - 1 : 0, after = i < n ? i + 1 : is_closed ? 1 : n;
    line.directions.push_back(unit(line.points[after] - line.points[before]));
    if (i < n) segments.push_back({line.points[i], line.points[i + 1], line.points[i]});
  }
  line.segments = ClosestPoints(segments);
  lines_.push_back(std::move(line));
}

Vec3 Lines::direction(Track line, Vec3 p) const {
  const Line& l = at(line);
  const ClosestPoint found = l.segments.find(p);
  const std::size_t i = found.triangle;
  const double part = length(found.at - l.points[i]) / length(l.points[i + 1] - l.points[i]);
  return unit((1 - part) * l.directions[i] + part * l.directions[i + 1]);
}

std::vector<VertexId> Lines::too_far(const SurfaceMesh& mesh, const IdVector<VertexId, Track>& tracks,
                                     double most) const {
  std::vector<VertexId> vertices;
  if (lines_.empty()) return vertices;
  const Mesh& connectivity = mesh.connectivity();
  std::vector<std::vector<ClosestPoints::Triangle>> segments(lines_.size());
  std::vector<Edges> edges(lines_.size());
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!connectivity.is_unflippable(h) || !connectivity.is_edge_representative(h)) continue;
    const VertexId a = connectivity.origin(h), b = connectivity.target(h);
    const Track track = std::max(tracks[a], tracks[b]);
    if (track < 0) continue;
    segments[static_cast<std::size_t>(track)].push_back({mesh.position(a), mesh.position(b), mesh.position(a)});
    edges[static_cast<std::size_t>(track)].push_back({a, b});
  }
  const auto add = [&](const std::array<VertexId, 2>& edge) {
    vertices.insert(vertices.end(), edge.begin(), edge.end());
  };
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    if (edges[i].empty()) continue;  // its vertices are held
    const ClosestPoints now(segments[i]);
    for (std::size_t e = 0; e < edges[i].size(); ++e) {
      if (lines_[i].segments.bound(segments[i][e], most, most).most > most) add(edges[i][e]);
    }
    for (const Target& t : lines_[i].segments.targets()) {
      const DistanceBound bound = now.bound(t.corners, most, most);
      if (bound.most > most) add(edges[i][now.find(bound.far).triangle]);
    }
  }
  return vertices;
}

}  // namespace temper::surfaces
