// Delaunay triangulation, insertion of the pieces as edges; then areas flood from the pieces.
#include "mesher/triangulated.hpp"

#include <array>
#include <functional>
#include <utility>

#include "generate/triangulation.hpp"

namespace temper::mesher {
namespace {

Expected<generate::Triangulation> delaunay_of(const Surface& surface, const std::vector<Vec3>& places,
                                              const std::function<bool()>& stop) {
  if (surface.space().is_closed()) return generate::triangulate_sphere(places, surface.space().radius(), stop);
  std::vector<Vec2> points;
  points.reserve(places.size());
  for (const Vec3 p : places) points.push_back({p.x, p.y});
  return generate::triangulate_points(points, stop);
}

}  // namespace

Expected<Hull> triangulate_hull(const Surface& surface, const std::vector<Vec3>& points,
                                const std::vector<Piece>& pieces, Deadline& deadline) {
  std::vector<std::array<std::int32_t, 2>> segments;
  segments.reserve(pieces.size());
  for (const Piece& p : pieces) {
    segments.push_back({static_cast<std::int32_t>(p.ends[0]), static_cast<std::int32_t>(p.ends[1])});
  }
  const auto stop = [&] { return deadline.asked_to_stop(); };
  Expected<generate::Triangulation> triangulation = delaunay_of(surface, points, stop);
  if (!triangulation) return triangulation.error();
  if (auto error = generate::insert_segments(*triangulation, segments, stop)) return *error;
  Expected<Mesh> mesh = generate::in_input_order(*std::move(triangulation), [&] { return deadline.ask(); });
  if (!mesh) return mesh.error();
  if (deadline.ask()) return generate::stopped_error();
  Hull hull{*std::move(mesh), {}};
  hull.piece.resize(hull.mesh.n_halfedges(), kNoPiece);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const VertexId a(pieces[i].ends[0]), b(pieces[i].ends[1]);
    for (const HalfedgeId h : {hull.mesh.find_halfedge(a, b), hull.mesh.find_halfedge(b, a)}) {
      if (h.valid()) hull.piece[h] = static_cast<std::uint32_t>(i);
    }
  }
  return hull;
}

Expected<Triangulated> triangulate(const Surface& surface, const DividedOutline& divided,
                                   const std::vector<Vec3>& further,
                                   const std::vector<std::array<std::int32_t, 2>>& sides, Deadline& deadline) {
  std::vector<Vec3> points = divided.points;
  points.insert(points.end(), further.begin(), further.end());
  Expected<Hull> hull = triangulate_hull(surface, points, divided.pieces, deadline);
  if (!hull) return hull.error();
  Triangulated result{*std::move(hull), {}};
  const Mesh& mesh = result.mesh;
  const bool whole_sphere = divided.pieces.empty();
  result.area.resize(mesh.n_triangles(), whole_sphere ? 0 : kOutside);
  IdVector<TriangleId, std::uint8_t> known(mesh.n_triangles(), 0);
  std::vector<TriangleId> stack;
  constexpr std::size_t kAtATime = 1 << 16;  // steps, before the deadline is asked
  for (const HalfedgeId h : mesh.halfedges()) {
    if (h.index % kAtATime == 0 && deadline.ask()) break;
    if (result.piece[h] == kNoPiece) continue;
    const Piece& piece = divided.pieces[result.piece[h]];
    const bool along = mesh.origin(h).index == piece.ends[0];
    const TriangleId t = Mesh::triangle(h);
    if (known[t] == 0) stack.push_back(t);
    known[t] = 1;
    result.area[t] = sides[piece.edge][along ? 0 : 1];
  }
  while (!stack.empty()) {
    const TriangleId t = stack.back();
    stack.pop_back();
    if (t.index % kAtATime == 0 && deadline.ask()) break;
    each_neighbor(result, t, [&](TriangleId next) {
      if (std::exchange(known[next], 1) != 0) return;
      result.area[next] = result.area[t];
      stack.push_back(next);
    });
  }
  if (deadline.stopped()) return generate::stopped_error();
  return result;
}

}  // namespace temper::mesher
