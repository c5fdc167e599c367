// Overlaps of the cells of two meshes: each triangle of the new mesh with those of the former mesh around its middle.
//
// Both kinds of cells have convex pieces in each triangle. A walk over neighbors finds the former triangles that a new
// one meets. A piece of the new triangle is cut by the former triangle, then by each of its pieces.
#include <algorithm>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/assert.hpp"
#include "location/box_tree.hpp"
#include "mesh/bad_triangles.hpp"
#include "temper/detail/executor.hpp"
#include "temper/detail/location.hpp"
#include "temper/detail/transfer.hpp"
#include "transfer/pieces.hpp"
#include "transfer/table.hpp"

namespace temper {
namespace {

constexpr std::size_t kBlock = 2048;  // triangles at a time: their neighbors are kept meanwhile

std::size_t n_cells_of(const Mesh& mesh, CellsOf of) {
  return of == CellsOf::triangles ? mesh.n_triangles() : mesh.n_vertices();
}

/// The two meshes, and what all blocks use of them.
struct MeshChange {
  MeshChange(const Mesh& former, const Mesh& now, CellsOf cells)
      : before(former), after(now), of(cells), joints_before(before), joints_after(after), locator(before) {}
  const Mesh &before, &after;
  CellsOf of;
  JointPolygons joints_before, joints_after;
  PointLocator locator;
};

/// Finds the overlaps of some triangles of the new mesh.
class OverlapFinder {
 public:
  OverlapFinder(const MeshChange& change, FoundInBlock& found)
      : change_(change),
        before_(change.before, change.joints_before, change.of),
        after_(change.after, change.joints_after, change.of),
        found_(found) {}
  void find(TriangleId t);

 private:
  void meet(TriangleId t, TriangleId s);
  void meet_pieces(std::int32_t region, const CutTriangle& then, Vec3 step);
  void go_on(TriangleId t, TriangleId s, Vec3 step);
  void take_nearest(TriangleId t, const RayPiece& piece);
  [[nodiscard]] const Space& space() const { return change_.after.space(); }
  [[nodiscard]] WeightedPoint middle_of(std::span<const Vec3> polygon) const;
  [[nodiscard]] std::uint32_t nearest_cell(const WeightedPoint& p) const;
  [[nodiscard]] Vec3 step_from(const WeightedPoint& origin) const;

  const MeshChange& change_;
  TriangleCuts before_, after_;
  FoundInBlock& found_;
  CutTriangle now_;                                        // the triangle at hand
  std::vector<char> has_met_;                              // of its pieces
  std::size_t first_ = 0;                                  // of its overlaps
  std::vector<TriangleId> reached_;                        // former triangles, in the order of the walk
  std::unordered_map<std::uint32_t, std::uint32_t> seen_;  // former triangles, and the last new one that has seen them
  TriangleId near_;
  PolygonCutter cutter_;
  RayPolygon common_, of_pieces_;
};

WeightedPoint OverlapFinder::middle_of(std::span<const Vec3> polygon) const {
  Vec3 sum;
  for (const Vec3 p : polygon) sum = sum + p;
  const Vec3 mean = (1 / static_cast<double>(polygon.size())) * sum;
  if (!space().is_plane()) return as_point(mean);
  return {now_.origin.x + mean.x, now_.origin.y + mean.y, 0};
}

std::uint32_t OverlapFinder::nearest_cell(const WeightedPoint& p) const {
  const Place place = change_.locator.find(p, near_);
  if (change_.of == CellsOf::triangles) return place.triangle.index;
  const auto most = std::max_element(place.shares.begin(), place.shares.begin() + place.n);
  return place.corners.at(static_cast<std::size_t>(most - place.shares.begin())).index;
}

/// The step from another origin to that of the triangle at hand.
Vec3 OverlapFinder::step_from(const WeightedPoint& origin) const {
  if (!space().is_plane()) return {};
  const Vec2 step = space().image(origin, now_.origin).position() - now_.origin.position();
  return {step.x, step.y, 0};
}

void OverlapFinder::find(TriangleId t) {
  now_ = after_.cut(t);
  for (const RayPiece& piece : now_.pieces)
    found_.add(piece.cell, change_.after.region(t), area_of(space(), now_.polygon(piece)));
  first_ = found_.overlaps.size();
  has_met_.assign(now_.pieces.size(), 0);
  near_ = change_.locator.find(middle_of(now_.triangle), near_).triangle;
  reached_.assign(1, near_);
  seen_[near_.index] = t.index;
  for (std::size_t i = 0; i < reached_.size(); ++i) meet(t, reached_[i]);
  for (std::size_t k = 0; k < now_.pieces.size(); ++k) {
    if (has_met_[k] == 0) take_nearest(t, now_.pieces[k]);
  }
}

/// The former triangle s, and then those across the sides that the new triangle reaches over.
void OverlapFinder::meet(TriangleId t, TriangleId s) {
  const CutTriangle& then = before_.kept(s);
  const Vec3 step = step_from(then.origin);
  common_ = now_.triangle;
  cutter_.cut(common_, then.triangle, step);
  if (common_.empty()) return;
  go_on(t, s, step);
  if (change_.before.region(s) == change_.after.region(t)) meet_pieces(change_.after.region(t), then, step);
}

void OverlapFinder::meet_pieces(std::int32_t region, const CutTriangle& then, Vec3 step) {
  for (std::size_t k = 0; k < now_.pieces.size(); ++k) {
    const RayPiece& piece = now_.pieces[k];
    for (const RayPiece& former : then.pieces) {
      if (!piece.circle.may_meet(former.circle, step)) continue;
      const auto polygon = now_.polygon(piece);
      of_pieces_.assign(polygon.begin(), polygon.end());
      cutter_.cut(of_pieces_, then.polygon(former), step);
      const double area = area_of(space(), of_pieces_);
      if (!(area > std::min(piece.negligible, former.negligible))) continue;
      has_met_[k] = 1;
      found_.add(first_, {piece.cell, {former.cell, area}, region});
    }
  }
}

/// Across a side that the common part of both triangles has corners on.
void OverlapFinder::go_on(TriangleId t, TriangleId s, Vec3 step) {
  const CutTriangle& then = before_.kept(s);
  constexpr double kOnSide = 1e-9;  // of the triangle's height: more than rounding
  for (std::size_t k = 0; k < 3; ++k) {
    const HalfedgeId twin = change_.before.twin(Mesh::halfedge(s, static_cast<int>(k)));
    if (!twin.valid()) continue;
    const Vec3 a = then.triangle[k] + step, b = then.triangle[(k + 1) % 3] + step,
               c = then.triangle[(k + 2) % 3] + step, normal = cross(a, b - a);
    const double near = kOnSide * dot(normal, c - a);
    const bool reaches_over = std::ranges::any_of(now_.triangle, [&](Vec3 p) { return dot(normal, p - a) < 0; });
    if (!reaches_over || std::ranges::none_of(common_, [&](Vec3 p) { return dot(normal, p - a) <= near; })) continue;
    const TriangleId beyond = Mesh::triangle(twin);
    const auto [at, is_new] = seen_.try_emplace(beyond.index, t.index);
    if (is_new || at->second != t.index) reached_.push_back(beyond);
    at->second = t.index;
  }
}

/// A piece outside the former domain, where vertices slid along a curved boundary, or as narrow as rounding.
void OverlapFinder::take_nearest(TriangleId t, const RayPiece& piece) {
  const std::uint32_t cell = nearest_cell(middle_of(now_.polygon(piece)));
  found_.add(first_, {piece.cell, {cell, 0}, change_.after.region(t)});
}

/// The parts of the cells of a mesh.
std::vector<CellPart> parts_of(const Mesh& mesh, const JointPolygons& joints, CellsOf of, Executor* executor) {
  std::vector<FoundInBlock> blocks((mesh.n_triangles() + kBlock - 1) / kBlock);
  or_serial(executor).run(blocks.size(), [&](std::size_t b) {
    TriangleCuts cuts(mesh, joints, of);
    for (std::size_t i = b * kBlock; i < std::min(mesh.n_triangles(), (b + 1) * kBlock); ++i) {
      const CutTriangle cut = cuts.cut(TriangleId(i));
      for (const RayPiece& piece : cut.pieces)
        blocks[b].add(piece.cell, mesh.region(TriangleId(i)), area_of(mesh.space(), cut.polygon(piece)));
    }
  });
  return joined_parts(n_cells_of(mesh, of), blocks);
}

/// Vertices without a power cell take the value of their place.
void add_hidden(const MeshChange& change, std::vector<FoundInBlock>& blocks) {
  if (change.of == CellsOf::triangles) return;
  std::vector<char> has_cell(change.after.n_vertices(), 0);
  for (const FoundInBlock& block : blocks) {
    for (const CellPart& part : block.parts) has_cell[part.cell] = 1;
  }
  FoundInBlock hidden;
  for (const VertexId v : change.after.vertices()) {
    if (has_cell[v.index] != 0 || change.after.is_isolated(v)) continue;
    const Place place = change.locator.find(change.after.point(v));
    const std::int32_t region = change.after.region(Mesh::triangle(change.after.outgoing(v)));
    hidden.add(v.index, region, 0);
    hidden.overlaps.push_back({v.index, {place.corners[0].index, 0}, region});
  }
  blocks.push_back(std::move(hidden));
}

}  // namespace

CellOverlaps overlaps(const Mesh& before, const Mesh& after, CellsOf of, Executor* executor) {
  TEMPER_ASSERT_SLOW(!has_erased_triangles(before) && !has_erased_triangles(after));
  TEMPER_ASSERT(before.space().kind() == after.space().kind());
  const MeshChange change(before, after, of);
  const std::vector<TriangleId> order = along_curve(after);
  std::vector<FoundInBlock> blocks((order.size() + kBlock - 1) / kBlock);
  or_serial(executor).run(blocks.size(), [&](std::size_t b) {
    OverlapFinder finder(change, blocks[b]);
    for (std::size_t i = b * kBlock; i < std::min(order.size(), (b + 1) * kBlock); ++i) finder.find(order[i]);
  });
  add_hidden(change, blocks);
  CellOverlaps table;
  table.n_cells = n_cells_of(after, of);
  table.former = parts_of(before, change.joints_before, of, executor);
  fill_table(table, blocks);
  return table;
}

}  // namespace temper
