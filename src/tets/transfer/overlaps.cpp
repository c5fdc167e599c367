// Overlaps of the cells of two meshes of tetrahedra, as those of triangles (transfer/overlaps.cpp).
#include <algorithm>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/assert.hpp"
#include "geometry/bounding_boxes.hpp"
#include "temper/detail/executor.hpp"
#include "temper/tets/location.hpp"
#include "temper/tets/transfer.hpp"
#include "tets/transfer/pieces.hpp"
#include "transfer/table.hpp"

namespace temper::tets {
namespace {

constexpr std::size_t kCutBlock = 1024;  // tetrahedra at a time: their neighbors are kept meanwhile

std::size_t n_cells_of(const TetMesh& mesh, CellsOf of) {
  return of == CellsOf::tetrahedra ? mesh.n_tetrahedra() : mesh.n_vertices();
}

Vec3 middle_of(const TetMesh& mesh, TetId t) {
  Vec3 sum;
  for (const VertexId v : mesh.corners(t)) sum = sum + 0.25 * mesh.position(v);
  return sum;
}

/// Every third bit of a number below 2¹⁰, as for one axis of a Z-shaped curve.
std::uint32_t spread_bits(std::uint32_t x) {
  x = (x | (x << 16)) & 0x030000ffu;
  x = (x | (x << 8)) & 0x0300f00fu;
  x = (x | (x << 4)) & 0x030c30c3u;
  return (x | (x << 2)) & 0x09249249u;
}

/// The tetrahedra of a mesh along a curve, so that blocks are compact.
std::vector<TetId> along_curve(const TetMesh& mesh) {
  static constexpr double kMost = 1023;  // of ten bits
  const BoundingBox box = bounding_box(mesh);
  const auto cell = [](double x, double low, double high) {
    return static_cast<std::uint32_t>(high > low ? std::clamp(kMost * (x - low) / (high - low), 0.0, kMost) : 0);
  };
  std::vector<std::pair<std::uint32_t, TetId>> keyed;
  for (const TetId t : mesh.tetrahedra()) {
    const Vec3 p = middle_of(mesh, t);
    keyed.emplace_back(spread_bits(cell(p.x, box.low.x, box.high.x)) |
                           (spread_bits(cell(p.y, box.low.y, box.high.y)) << 1) |
                           (spread_bits(cell(p.z, box.low.z, box.high.z)) << 2),
                       t);
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<TetId> order;
  order.reserve(keyed.size());
  for (const auto& [key, t] : keyed) order.push_back(t);
  return order;
}

/// The two meshes, and what all blocks use of them.
struct TetChange {
  TetChange(const TetMesh& former, const TetMesh& now, CellsOf cells) : before(former), after(now), of(cells) {
    if (of != CellsOf::vertices) return;
    neighbors_before.emplace(before);
    neighbors_after.emplace(after);
  }
  [[nodiscard]] TetCuts cuts_before() const { return {before, of, neighbors_before ? &*neighbors_before : nullptr}; }
  [[nodiscard]] TetCuts cuts_after() const { return {after, of, neighbors_after ? &*neighbors_after : nullptr}; }

  const TetMesh &before, &after;
  CellsOf of;
  std::optional<VertexNeighbors> neighbors_before, neighbors_after;
};

/// Finds the overlaps of some tetrahedra of the new mesh.
class OverlapFinder {
 public:
  OverlapFinder(const TetChange& change, FoundInBlock& found)
      : change_(change), before_(change.cuts_before()), after_(change.cuts_after()), found_(found) {}
  void find(TetId t);

 private:
  void meet(TetId t, TetId s);
  void meet_pieces(std::int32_t region, const CutTet& then, Vec3 step);
  void go_on(TetId t, TetId s, Vec3 step);
  [[nodiscard]] std::uint32_t nearest_cell(Vec3 p) const;

  const TetChange& change_;
  TetCuts before_, after_;
  FoundInBlock& found_;
  CutTet now_;                                             // the tetrahedron at hand
  std::vector<char> has_met_;                              // of its pieces
  std::size_t first_ = 0;                                  // of its overlaps
  std::vector<TetId> reached_;                             // former tetrahedra, in the order of the walk
  std::unordered_map<std::uint32_t, std::uint32_t> seen_;  // former tetrahedra, and the last new one that has seen them
  TetId near_;
  Polyhedron common_, in_then_, of_pieces_;
};

std::uint32_t OverlapFinder::nearest_cell(Vec3 p) const {
  const TetId t = find_tetrahedron(change_.before, p, near_);
  if (change_.of == CellsOf::tetrahedra) return t.index;
  VertexId nearest = change_.before.corners(t)[0];
  for (const VertexId v : change_.before.corners(t)) {
    const auto distance = [&](VertexId w) { return squared_length(change_.before.position(w) - p); };
    if (distance(v) < distance(nearest)) nearest = v;
  }
  return nearest.index;
}

void OverlapFinder::find(TetId t) {
  now_ = after_.cut(t);
  const std::int32_t region = change_.after.region(t);
  for (const TetPiece& piece : now_.pieces) found_.add(piece.cell, region, piece.volume);
  first_ = found_.overlaps.size();
  has_met_.assign(now_.pieces.size(), 0);
  // Most tetrahedra keep their numbers.
  if (!near_.valid()) near_ = TetId(std::min<std::size_t>(t.index, change_.before.n_tetrahedra() - 1));
  near_ = find_tetrahedron(change_.before, middle_of(change_.after, t), near_);
  reached_.assign(1, near_);
  seen_[near_.index] = t.index;
  for (std::size_t i = 0; i < reached_.size(); ++i) meet(t, reached_[i]);
  for (std::size_t k = 0; k < now_.pieces.size(); ++k) {
    if (has_met_[k] != 0) continue;
    const TetPiece& piece = now_.pieces[k];
    found_.add(first_, {piece.cell, {nearest_cell(now_.origin + piece.center), 0}, region});
  }
}

/// The former tetrahedron s, and then those across the faces that the new one reaches over.
void OverlapFinder::meet(TetId t, TetId s) {
  const CutTet& then = before_.kept(s);
  const Vec3 step = then.origin - now_.origin;
  common_ = Polyhedron(now_.corners);
  for (const HalfSpace& side : then.sides) {
    if (!common_.empty()) common_.cut(side.moved(step));
  }
  if (common_.empty()) return;
  go_on(t, s, step);
  if (change_.before.region(s) == change_.after.region(t)) meet_pieces(change_.after.region(t), then, step);
}

void OverlapFinder::meet_pieces(std::int32_t region, const CutTet& then, Vec3 step) {
  for (std::size_t k = 0; k < now_.pieces.size(); ++k) {
    const TetPiece& piece = now_.pieces[k];
    in_then_ = piece.body;
    for (const HalfSpace& side : then.sides) {
      if (!in_then_.empty()) in_then_.cut(side.moved(step));
    }
    for (const TetPiece& former : then.pieces) {
      if (in_then_.empty()) break;
      if (length(former.center + step - piece.center) > (piece.radius + former.radius) * (1 + 1e-6)) continue;
      of_pieces_ = in_then_;
      for (const HalfSpace& cut : former.cuts) {
        if (!of_pieces_.empty()) of_pieces_.cut(cut.moved(step));
      }
      const double volume = of_pieces_.volume();
      if (!(volume > std::min(piece.negligible, former.negligible))) continue;
      has_met_[k] = 1;
      found_.add(first_, {piece.cell, {former.cell, volume}, region});
    }
  }
}

/// Across a face that the common part of both has corners on.
void OverlapFinder::go_on(TetId t, TetId s, Vec3 step) {
  constexpr double kOnFace = 1e-9;  // of the height over the face: more than rounding
  const CutTet& then = before_.kept(s);
  for (int f = 0; f < 4; ++f) {
    const HalffaceId twin = change_.before.twin(TetMesh::halfface(s, f));
    if (!twin.valid()) continue;
    const auto k = static_cast<std::size_t>(f);
    const HalfSpace side = then.sides[k].moved(step);
    const double near = kOnFace * then.sides[k].side(then.corners[k]);
    if (std::ranges::none_of(now_.corners, [&](Vec3 p) { return side.side(p) < 0; })) continue;
    if (std::ranges::none_of(common_.corners(), [&](const auto& c) { return side.side(c.at) <= near; })) continue;
    const TetId beyond = TetMesh::tetrahedron(twin);
    const auto [at, is_new] = seen_.try_emplace(beyond.index, t.index);
    if (is_new || at->second != t.index) reached_.push_back(beyond);
    at->second = t.index;
  }
}

/// The parts of the cells of the former mesh.
std::vector<CellPart> former_parts(const TetChange& change, Executor* executor) {
  const TetMesh& mesh = change.before;
  std::vector<FoundInBlock> blocks((mesh.n_tetrahedra() + kCutBlock - 1) / kCutBlock);
  or_serial(executor).run(blocks.size(), [&](std::size_t b) {
    TetCuts cuts = change.cuts_before();
    for (std::size_t i = b * kCutBlock; i < std::min(mesh.n_tetrahedra(), (b + 1) * kCutBlock); ++i) {
      for (const TetPiece& piece : cuts.cut(TetId(i)).pieces)
        blocks[b].add(piece.cell, mesh.region(TetId(i)), piece.volume);
    }
  });
  return joined_parts(n_cells_of(mesh, change.of), blocks);
}

/// Vertices without a power cell take the value of their place.
void add_hidden(const TetChange& change, std::vector<FoundInBlock>& blocks) {
  if (change.of == CellsOf::tetrahedra) return;
  std::vector<char> has_cell(change.after.n_vertices(), 0);
  for (const FoundInBlock& block : blocks) {
    for (const CellPart& part : block.parts) has_cell[part.cell] = 1;
  }
  FoundInBlock hidden;
  for (const VertexId v : change.after.vertices()) {
    if (has_cell[v.index] != 0) continue;
    const TetId t = change.after.incident(v);
    const TetId near(std::min<std::size_t>(t.index, change.before.n_tetrahedra() - 1));
    const TetId there = find_tetrahedron(change.before, change.after.position(v), near);
    hidden.add(v.index, change.after.region(t), 0);
    hidden.overlaps.push_back({v.index, {change.before.corners(there)[0].index, 0}, change.after.region(t)});
  }
  blocks.push_back(std::move(hidden));
}

}  // namespace

CellOverlaps overlaps(const TetMesh& before, const TetMesh& after, CellsOf of, Executor* executor) {
  const TetChange change(before, after, of);
  const std::vector<TetId> order = along_curve(after);
  std::vector<FoundInBlock> blocks((order.size() + kCutBlock - 1) / kCutBlock);
  or_serial(executor).run(blocks.size(), [&](std::size_t b) {
    OverlapFinder finder(change, blocks[b]);
    for (std::size_t i = b * kCutBlock; i < std::min(order.size(), (b + 1) * kCutBlock); ++i) finder.find(order[i]);
  });
  add_hidden(change, blocks);
  CellOverlaps table;
  table.n_cells = n_cells_of(after, of);
  table.former = former_parts(change, executor);
  fill_table(table, blocks);
  return table;
}

}  // namespace temper::tets
