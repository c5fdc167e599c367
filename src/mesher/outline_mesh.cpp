#include "mesher/outline_mesh.hpp"

#include <array>
#include <set>
#include <string>
#include <utility>

#include "generate/triangulation.hpp"
#include "mesh/input_positions.hpp"
#include "mesh/stoppable_build.hpp"
#include "mesher/face_polygons.hpp"

namespace temper::mesher {
namespace {

/// Errors of Mesh::build in the names of the outline: its points come first, in their order.
class MeshNames final : public InputNames {
 public:
  MeshNames(const OutlineNames& names, const std::vector<std::uint32_t>& points) : names_(names), points_(points) {}
  std::string point(std::size_t i) const override {
    return is_given(i) ? names_.point(points_[i]) : "a point placed on the outline or inside";
  }
  std::string point_where(std::size_t i) const override {
    return is_given(i) ? names_.point_where(points_[i]) : std::string();
  }

 private:
  [[nodiscard]] bool is_given(std::size_t i) const { return i < points_.size() && points_[i] != Arrangement::kNoPoint; }

  const OutlineNames& names_;
  const std::vector<std::uint32_t>& points_;  // of each vertex that is one
};

std::size_t place_of(const Arrangement& arrangement, std::size_t point) {
  return static_cast<std::size_t>(arrangement.place_of_point[point]);
}

void number_points(const Problem& problem, const Arrangement& arrangement, const Inside& inside, OutlineMesh& made) {
  const Outline& outline = problem.outline;
  made.vertex_of_point.resize(outline.points.size());
  const std::vector<std::uint8_t> is_alone = alone(outline);
  std::size_t outside = 0;
  for (std::size_t i = 0; i < outline.points.size(); ++i) {
    const std::int32_t v = arrangement.place_of_point[i] < 0 ? -1 : inside.vertex[place_of(arrangement, i)];
    if (v >= 0) made.vertex_of_point[i] = VertexId(static_cast<std::size_t>(v));
    const bool is_outside = v < 0 && arrangement.place_of_point[i] != Arrangement::kOnFace;
    outside += is_outside ? 1 : 0;
    if (is_outside && is_alone[i] != 0) {
      made.warnings.push_back(problem.names.point(i) + " at " + problem.text(problem.points[i]) +
                              " is outside, and not in the mesh");
    }
  }
  if (outside > 0) {
    made.notes.push_back(
        "points of the outline that are not in the mesh, because they or their segments are outside: " +
        std::to_string(outside));
  }
}

/// Tells of tags that the outline has and the mesh has not.
void note_lost_groups(const Outline& outline, OutlineMesh& made) {
  std::set<std::pair<int, std::int32_t>> lost;  // dimension and tag
  for (const OutlineTag& p : outline.point_tags) lost.emplace(0, p.tag);
  for (const OutlineSegment& s : outline.segments) {
    if (s.tag != 0) lost.emplace(1, s.tag);
  }
  for (const OutlineTag& s : outline.further_tags) lost.emplace(1, s.tag);
  for (const MarkedVertex& m : made.marked) lost.erase({0, m.tag});
  for (const MeshLine& line : made.lines) lost.erase({1, line.tag});
  if (lost.empty()) return;
  std::string list;
  for (const auto& [dimension, tag] : lost) {
    list += (list.empty() ? "" : ", ") + std::string(dimension == 0 ? "points of " : "lines of ") +
            name_of_tag(outline, dimension, tag);
  }
  made.notes.push_back("these tags of the outline are missing in the mesh (outside, left out or joined): " + list);
}

/// Points with a tag and points of no segment stay, too: they are the user's.
void fix_points(const Outline& outline, const Arrangement& arrangement, OutlineMesh& made) {
  std::vector<std::uint8_t> known(arrangement.places.size(), 0);  // on an edge, or marked
  for (const OutlineEdge& e : arrangement.edges) {
    for (const std::int32_t end : e.ends) {
      if (end >= 0) known[static_cast<std::size_t>(end)] = 1;  // else it is on a face
    }
  }
  const auto mark = [&](std::size_t point, std::int32_t tag) {
    const VertexId v = made.vertex_of_point[point];
    if (!v.valid()) return;
    const bool was_known = std::exchange(known[place_of(arrangement, point)], 1) != 0;
    if (was_known && tag == 0) return;
    made.mesh.set_fixed(v, true);
    made.marked.push_back({v, tag});
  };
  for (const OutlineTag& p : outline.point_tags) mark(static_cast<std::size_t>(p.element), p.tag);
  for (std::size_t i = 0; i < outline.points.size(); ++i) mark(i, 0);
  made.groups = outline.groups;
  note_lost_groups(outline, made);
}

/// Ends early when it is time to stop.
void add_triangles(const Domain& domain, const Triangulated& all, const Inside& inside, Connectivity& result,
                   Deadline& deadline) {
  constexpr std::size_t kAtATime = 1 << 16;  // triangles, before the deadline is asked
  for (const TriangleId t : all.mesh.triangles()) {
    if (t.index % kAtATime == 0 && deadline.ask()) return;
    if (all.area[t] == kOutside) continue;
    const auto [a, b, c] = all.mesh.corners(t);
    result.triangles.push_back({inside.vertex[a.index], inside.vertex[b.index], inside.vertex[c.index]});
    result.regions.push_back(domain.area(all.area[t]).region);
  }
}

/// Adds the constrained edges. Returns the lines.
std::vector<MeshLine> add_lines(const Domain& domain, const DividedOutline& divided, const Inside& inside,
                                Connectivity& result) {
  std::vector<MeshLine> lines;
  for (const Piece& piece : divided.pieces) {
    const auto [left, right] = domain.areas.sides[piece.edge];
    if (left == kOutside && right == kOutside) continue;
    if (domain.arrangement.edges[piece.edge].as == LineKind::faces) continue;  // a side of a polygon
    const std::int32_t a = inside.vertex[piece.ends[0]], b = inside.vertex[piece.ends[1]];
    if (left != kOutside && right != kOutside) result.constrained.push_back({a, b});
    const VertexId from(static_cast<std::size_t>(a)), to(static_cast<std::size_t>(b));
    const std::vector<std::int32_t>& tags = domain.arrangement.edges[piece.edge].tags;
    for (const std::int32_t tag : tags) lines.push_back({from, to, tag});
    if (tags.empty()) lines.push_back({from, to, 0});
  }
  return lines;
}

/// Returns the next vertex on the way from `from` to `end` along a line: the end, or the new vertex that is nearest
/// to the straight way.
VertexId next_on_line(const Mesh& mesh, VertexId from, VertexId end, const IdVector<VertexId, VertexId>& old_numbers) {
  if (mesh.find_halfedge(from, end).valid() || mesh.find_halfedge(end, from).valid()) return end;
  const Vec2 way = mesh.position(end) - mesh.position(from);
  VertexId next;
  double straightest = 0;
  const auto look = [&](VertexId v) {
    if (old_numbers[v].valid()) return;
    const Vec2 step = mesh.position(v) - mesh.position(from);
    const double cosine = dot(step, way) / length(step);
    if (cosine > straightest) straightest = cosine, next = v;
  };
  for (const HalfedgeId h : mesh.star(from)) {
    if (mesh.is_unflippable(h)) look(mesh.target(h));
    if (mesh.is_boundary(Mesh::prev(h))) look(mesh.opposite(h));
  }
  return next;
}

/// Returns the lines with each one replaced by its pieces, which meet at vertices without an old number.
std::vector<MeshLine> pieces_of(const std::vector<MeshLine>& lines, const Mesh& mesh,
                                const IdVector<VertexId, VertexId>& old_numbers) {
  std::vector<MeshLine> pieces;
  for (const MeshLine& line : lines) {
    VertexId from = line.a;
    for (VertexId to = next_on_line(mesh, from, line.b, old_numbers); to.valid() && to != line.b;
         to = next_on_line(mesh, from, line.b, old_numbers)) {
      pieces.push_back({from, to, line.tag});
      from = to;
    }
    pieces.push_back({from, line.b, line.tag});
  }
  return pieces;
}

}  // namespace

std::optional<Inside> find_inside(const Domain& domain, const Filled& filled) {
  const auto& [divided, placed, all] = filled;
  const std::size_t n = divided.points.size() + placed.size();
  Inside inside;
  inside.vertex.assign(n, -1);
  for (const TriangleId t : all.mesh.triangles()) {
    if (all.area[t] == kOutside) continue;
    for (const VertexId v : all.mesh.corners(t)) {
      if (v.index >= n) return {};
      inside.vertex[v.index] = 0;
    }
  }
  for (const auto& polygon : divided.corridors.polygons) {
    for (const std::uint32_t i : polygon) inside.vertex[i] = 0;
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (inside.vertex[i] < 0) continue;
    inside.vertex[i] = static_cast<std::int32_t>(inside.places.size());
    inside.places.push_back(i < divided.points.size() ? divided.points[i] : placed[i - divided.points.size()]);
    if (i < domain.arrangement.places.size()) inside.outline_places.push_back(static_cast<std::uint32_t>(i));
  }
  return inside;
}

Expected<OutlineMesh> build_inside(const Problem& problem, const Domain& domain, const Filled& filled,
                                   const Inside& inside, Deadline& deadline) {
  Connectivity connectivity;
  add_triangles(domain, filled.all, inside, connectivity, deadline);
  OutlineMesh result;
  result.lines = add_lines(domain, filled.divided, inside, connectivity);
  FacePolygons polygons(domain, filled.divided.corridors, inside);
  polygons.add(connectivity);
  std::vector<std::uint32_t> points;
  for (const std::uint32_t p : inside.outline_places) points.push_back(domain.arrangement.point[p]);
  const MeshNames names(problem.names, points);
  InputPositions places(problem.surface.space());
  for (const Vec3 p : inside.places) places.add(p);
  MeshInput input = places.input();
  input.triangles = connectivity.triangles;
  input.regions = connectivity.regions;
  input.constrained_edges = connectivity.constrained;
  input.weights = polygons.weights();
  input.names = &names;
  input.executor = problem.hooks.executor;
  if (deadline.ask()) return generate::stopped_error();
  Expected<BuiltMesh> built = build_or_stop(input, [&deadline] { return deadline.ask(); });
  if (!built) return built.error();
  result.mesh = std::move(built->mesh);
  polygons.settle(result.mesh, result.lines);
  result.notes = domain.arrangement.notes;
  result.warnings = domain.arrangement.warnings;
  if (domain.areas.warning) result.warnings.push_back(*domain.areas.warning);
  number_points(problem, domain.arrangement, inside, result);
  fix_points(problem.outline, domain.arrangement, result);
  return result;
}

void renumber(OutlineMesh& made, const IdVector<VertexId, VertexId>& old_numbers) {
  std::vector<VertexId> now;
  for (std::size_t v = 0; v < old_numbers.size(); ++v) {
    const VertexId old = old_numbers[VertexId(v)];
    if (!old.valid()) continue;
    if (old.index >= now.size()) now.resize(old.index + std::size_t{1});
    now[old.index] = VertexId(v);
  }
  for (MeshLine& line : made.lines) line.a = now[line.a.index], line.b = now[line.b.index];
  made.lines = pieces_of(made.lines, made.mesh, old_numbers);
  for (MarkedVertex& m : made.marked) m.vertex = now[m.vertex.index];
  for (VertexId& v : made.vertex_of_point) {
    if (v.valid()) v = now[v.index];
  }
}

}  // namespace temper::mesher
