#include "optimize/flips/grading.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "geometry/bounding_boxes.hpp"
#include "mesh/bad_triangles.hpp"
#include "temper/detail/necessity.hpp"

namespace temper {
namespace {

// Edges whose bounds sum to 1 must be split. Up to this sum they leave so little room that sweeps hardly find it. On
// the outline of a capital A with ratio 4, the value 1 leaves 5 triangles bad. 1.2 to 2 leave none, with 17 cuts at 1.3
// and 27 at 2. Above 1.46 the dense horseshoe, which needs none of these splits, loses margin by them.
constexpr double kLittleRoom = 1.3;
constexpr double kNoConflict = std::numeric_limits<double>::infinity();
// Largest number of splits per edge. Corners with few degrees could need more and more splits.
constexpr std::size_t kMostSplits = 20;
// Largest number of new vertices per vertex of the input, and in small meshes. Public meshes need at most 27 in small
// ones, else 0.2 per vertex. In triangles of 0.004 degrees cuts ask for more cuts without end.
constexpr std::size_t kMostPerVertex = 1, kMostInSmall = 100;

using VertexMarks = IdVector<VertexId, std::uint8_t>;

/// Returns the largest ratio of the lengths of two edges of the boundary or of lines that meet.
double length_ratio(const Mesh& mesh) {
  constexpr double kNoCuts = std::numeric_limits<double>::infinity();
  return plan_boundary_grading(mesh, kNoCuts).ratio_before;
}

/// An edge of the boundary or of a line, given by its ends, which flips do not change.
struct Line {
  VertexId u, v;
  std::size_t whole = 0;  ///< the number of the line before all splits that has this piece
  int splits = 0;         ///< depth: how often its line was split to get this piece
  double sum = kNoConflict;
  double split_at = 0.5;
};

// Lines that meet at less than this angle cut each other into ever smaller pieces, unless they are cut at equal
// distances from their common vertex (J. Ruppert, "A Delaunay refinement algorithm for quality 2-dimensional mesh
// generation", 1995).
constexpr double kSharpCosine = 0.5;  // of 60 degrees
// Depth from which splits are at equal distances. If fewer splits are enough, the best places give wider margins.
constexpr int kSplitsToShells = 2;

/// Returns the line along h, a piece of line `whole`.
Line line_of(const Mesh& mesh, HalfedgeId h, std::size_t whole, int splits = 0) {
  if (const auto c = edge_conflict(mesh, h, kLittleRoom)) {
    return {mesh.origin(c->edge), mesh.target(c->edge), whole, splits, c->sum, c->split_at};
  }
  return {mesh.origin(h), mesh.target(h), whole, splits};
}

/// The vertices where two lines meet at a sharp angle.
class SharpCorners {
 public:
  SharpCorners(const Mesh& mesh, const std::vector<Line>& lines) : is_sharp_(mesh.n_vertices(), 0) {
    std::vector<std::pair<VertexId, VertexId>> ends;  // vertex, other end
    for (const Line& line : lines) {
      ends.emplace_back(line.u, line.v);
      ends.emplace_back(line.v, line.u);
    }
    std::sort(ends.begin(), ends.end());
    const auto to = [&](std::size_t i) { return mesh.position(ends[i].second) - mesh.position(ends[i].first); };
    for (std::size_t i = 0; i < ends.size(); ++i) {
      for (std::size_t j = i + 1; j < ends.size() && ends[j].first == ends[i].first; ++j) {
        const Vec2 p = to(i), q = to(j);
        if (dot(p, q) > kSharpCosine * length(p) * length(q)) is_sharp_[ends[i].first] = 1;
      }
    }
  }

  /// Returns the place of the split, instead of split_at: from a sharp end, a power of two in working units.
  [[nodiscard]] double split_at(const Mesh& mesh, const Line& line) const {
    if (line.splits < kSplitsToShells) return line.split_at;
    const bool from_u = is_sharp(line.u), from_v = is_sharp(line.v);
    if (from_u == from_v) return from_u ? 0.5 : line.split_at;
    const double l = length(mesh.position(line.v) - mesh.position(line.u));
    int exponent = 0;
    const double mantissa = std::frexp((from_u ? line.split_at : 1 - line.split_at) * l, &exponent);
    double distance = std::ldexp(1.0, mantissa * mantissa < 0.5 ? exponent - 1 : exponent);
    if (distance > (1 - EdgeConflict::kLeastPiece) * l) distance *= 0.5;
    if (distance < EdgeConflict::kLeastPiece * l) distance *= 2;
    return from_u ? distance / l : 1 - distance / l;
  }

 private:
  [[nodiscard]] bool is_sharp(VertexId v) const { return v.index < is_sharp_.size() && is_sharp_[v]; }

  IdVector<VertexId, std::uint8_t> is_sharp_;  // of the vertices before all splits
};

/// Says whether a new vertex at p can matter to the edge: discs at its ends have diameters of kLittleRoom edges.
bool is_near(const Mesh& mesh, const Line& line, Vec2 p) {
  const Vec2 u = mesh.position(line.u), v = mesh.position(line.v);
  return length(p - 0.5 * (u + v)) <= kLittleRoom * length(v - u);
}

/// The lines, worst first. Finds lines near a place.
class Lines {
 public:
  /// `near`: marks of vertices; lines without a marked end are left out. Null: all lines.
  Lines(const Mesh& mesh, const VertexMarks* near) {
    for (const HalfedgeId h : mesh.halfedges()) {
      if (mesh.is_erased(Mesh::triangle(h)) || !mesh.is_edge_representative(h)) continue;
      if (near != nullptr && (*near)[mesh.origin(h)] == 0 && (*near)[mesh.target(h)] == 0) continue;
      if (mesh.is_unflippable(h)) lines_.push_back(line_of(mesh, h, lines_.size()));
    }
    std::vector<BoundingBox> boxes;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const Line& line = lines_[i];
      if (std::isfinite(line.sum)) by_sum_.insert({line.sum, i});
      pieces_.push_back({i});
      // Let r be at least 1/2, and a piece of a line of length L have the length l ≤ L. A place within r l of the
      // piece's midpoint is within L/2 + (r − 1/2) l ≤ r L of the line's midpoint, up to rounding.
      const Vec2 u = mesh.position(line.u), v = mesh.position(line.v), middle = 0.5 * (u + v);
      const Vec3 center = {middle.x, middle.y, 0};
      boxes.push_back(box_of(center, center).grown(1.1 * kLittleRoom * length(v - u)));
    }
    near_ = BoundingBoxTree(boxes);
  }

  [[nodiscard]] const std::vector<Line>& all() const { return lines_; }
  /// Returns the first line with the least sum, or null if no line has a conflict.
  [[nodiscard]] const Line* worst() const { return by_sum_.empty() ? nullptr : &lines_[by_sum_.begin()->second]; }
  /// Drops the worst line, whose conflict no split resolves.
  void give_up_worst() { by_sum_.erase(by_sum_.begin()); }

  /// Replaces the worst line by its pieces at the new vertex. Their conflicts are out of date until renew_near().
  void split_worst(VertexId fresh) {
    const std::size_t i = by_sum_.begin()->second;
    Line first = lines_[i], second = first;
    first.v = second.u = fresh;
    first.splits = ++second.splits;
    first.sum = second.sum = kNoConflict;
    change(i, first);
    pieces_[first.whole].push_back(lines_.size());
    lines_.push_back(second);
  }

  /// Replaces each line near p by renewed(line).
  template <class Renewed>
  void renew_near(const Mesh& mesh, Vec2 p, const Renewed& renewed) {
    const Vec3 place = {p.x, p.y, 0};
    near_.visit(box_of(place, place), [&](std::size_t whole) {
      for (const std::size_t i : pieces_[whole]) {
        if (is_near(mesh, lines_[i], p)) change(i, renewed(lines_[i]));
      }
      return true;
    });
  }

 private:
  void change(std::size_t i, const Line& line) {
    by_sum_.erase({lines_[i].sum, i});
    lines_[i] = line;
    if (std::isfinite(line.sum)) by_sum_.insert({line.sum, i});
  }

  std::vector<Line> lines_;
  std::set<std::pair<double, std::size_t>> by_sum_;  // sum and number of lines with a conflict
  std::vector<std::vector<std::size_t>> pieces_;     // by number of the line before all splits
  BoundingBoxTree near_;  // of the lines before all splits; a place near a piece is near its line
};

class BoundaryCutter {
 public:
  BoundaryCutter(WorkingCopy& work, Flipper& flipper, const std::shared_ptr<const GuardLimits>& guard)
      : work_(work),
        mesh_(work.mesh),
        flipper_(flipper),
        guard_(work.mesh, work.units, guard),
        ratio_before_(length_ratio(work.mesh)) {}

  /// Cuts the edge from a towards b. Each cut splits the rest of the edge.
  void cut(const EdgeSplits& edge) {
    const Vec2 a = mesh_.position(edge.a), along = mesh_.position(edge.b) - a;
    VertexId last = edge.a;
    for (const double t : edge.at) {
      const VertexId v = split(last, edge.b, work_.units.snap(a + t * along));
      if (v.valid()) last = v;
    }
  }

  /// Splits edges that leave their dual little or no room (necessity.hpp), worst first, until no such edge is left.
  /// `near`: marks of vertices; edges without a marked end are left out. Null: all edges.
  void resolve_conflicts(const VertexMarks* near = nullptr) {
    Lines lines(mesh_, near);
    const SharpCorners corners(mesh_, lines.all());
    for (std::size_t left = kMostSplits * lines.all().size(); left > 0; --left) {
      const Line* const worst = lines.worst();
      if (worst == nullptr) return;
      const Vec2 from = mesh_.position(worst->u), to = mesh_.position(worst->v);
      const VertexId fresh =
          split(worst->u, worst->v, work_.units.snap(from + corners.split_at(mesh_, *worst) * (to - from)));
      if (!fresh.valid()) {
        lines.give_up_worst();
        continue;
      }
      ++conflicts_;
      lines.split_worst(fresh);
      lines.renew_near(mesh_, mesh_.position(fresh), [&](const Line& line) {
        return line_of(mesh_, find_edge(line.u, line.v), line.whole, line.splits);
      });
    }
  }

  void halve(VertexId a, VertexId b) { split(a, b, work_.units.snap(0.5 * (mesh_.position(a) + mesh_.position(b)))); }
  [[nodiscard]] bool has_edge(VertexId a, VertexId b) const { return find_edge(a, b).valid(); }
  /// Inserts a vertex at the orthocenter of a triangle that has no free corner.
  void free(const std::array<VertexId, 3>& corners) {
    plan_ = plan_center(mesh_, corners, std::move(plan_));
    if (plan_.status != InsertionStatus::possible) return;
    const Vec2 at = work_.units.snap(plan_.point.position());
    const double w = plan_.point.w;
    const TriangleId near = plan_.triangle;
    plan_ = plan_insertion(mesh_, {at.x, at.y, w}, near, std::move(plan_));
    if (plan_.status != InsertionStatus::possible || !guard_.allows(plan_)) return;
    flipper_.commit(work_, plan_, kNoEnergy, kNoEnergy);
    guard_.grow();
    ++inside_;
  }

  [[nodiscard]] SplitCounts cuts() const {
    return {vertices_, conflicts_, inside_, refused_.size(), ratio_before_, length_ratio(mesh_)};
  }

 private:
  [[nodiscard]] HalfedgeId find_edge(VertexId a, VertexId b) const {
    const HalfedgeId h = mesh_.find_halfedge(a, b);
    return h.valid() ? h : mesh_.find_halfedge(b, a);
  }

  /// Returns the new vertex on ab, or an invalid one.
  VertexId split(VertexId a, VertexId b, Vec2 at) {
    const Vec2 from = mesh_.position(a), along = mesh_.position(b) - from;
    const double l2 = squared_length(along), t = dot(at - from, along) / l2;
    const double w = split_weight(mesh_.weight(a), mesh_.weight(b), l2, t);
    const HalfedgeId h = find_edge(a, b);
    plan_ = plan_split(mesh_, h, WeightedPoint{at.x, at.y, w}, std::move(plan_));
    const std::pair<VertexId, VertexId> ends = std::minmax(a, b);
    if (mesh_.is_frozen(h) || plan_.status != InsertionStatus::possible || has_most() || !guard_.allows(plan_)) {
      refused_.insert(ends);
      return {};
    }
    refused_.erase(ends);
    ++vertices_;
    const VertexId fresh = flipper_.commit(work_, plan_, kNoEnergy, kNoEnergy);
    guard_.grow();
    return fresh;
  }

  [[nodiscard]] bool has_most() const {
    const std::size_t most = std::max(kMostInSmall, kMostPerVertex * work_.n_input_vertices);
    return work_.n_vertices_named - work_.n_input_vertices >= most;
  }

  WorkingCopy& work_;
  Mesh& mesh_;
  Flipper& flipper_;
  Guard guard_;
  const double ratio_before_;
  InsertionPlan plan_;
  std::size_t vertices_ = 0, conflicts_ = 0, inside_ = 0;
  std::set<std::pair<VertexId, VertexId>> refused_;  // present edges that could not be split
};

using Ends = std::pair<VertexId, VertexId>;

/// The edges of the boundary and of lines that have a corner of t as an end, longest first.
std::vector<Ends> lines_at(const Mesh& mesh, TriangleId t) {
  std::vector<std::pair<double, HalfedgeId>> found;
  for (const VertexId v : mesh.corners(t)) {
    for (const HalfedgeId out : mesh.star(v)) {
      for (const HalfedgeId h : {out, Mesh::prev(out)}) {
        if (mesh.is_unflippable(h))
          found.emplace_back(-squared_length(mesh.position(mesh.target(h)) - mesh.position(mesh.origin(h))), h);
      }
    }
  }
  std::sort(found.begin(), found.end());
  std::vector<Ends> lines;
  lines.reserve(found.size());
  for (const auto& [minus_length2, h] : found) lines.emplace_back(mesh.origin(h), mesh.target(h));
  return lines;
}

}  // namespace

SplitCounts operator+(const SplitCounts& a, const SplitCounts& b) {
  return {a.vertices + b.vertices, a.conflicts + b.conflicts,
          a.inside + b.inside,     a.refused + b.refused,
          a.ratio_before,          b.ratio_after};
}

SplitCounts split_where_bad(WorkingCopy& work, Flipper& flipper, const std::shared_ptr<const GuardLimits>& guard) {
  const Mesh& mesh = work.mesh;
  BoundaryCutter cutter(work, flipper, guard);
  VertexMarks near(mesh.n_vertices(), 0);
  std::vector<std::vector<Ends>> places;  // the lines at each bad triangle, longest first
  for (const TriangleId t : bad_triangles(mesh)) {
    places.push_back(lines_at(mesh, t));
    for (const VertexId v : mesh.corners(t)) near[v] = 1;
  }
  cutter.resolve_conflicts(&near);
  for (const std::vector<Ends>& lines : places) {
    const bool whole =
        std::all_of(lines.begin(), lines.end(), [&](Ends e) { return cutter.has_edge(e.first, e.second); });
    if (whole && !lines.empty()) cutter.halve(lines.front().first, lines.front().second);
  }
  return cutter.cuts();
}

SplitCounts split_boundary(WorkingCopy& work, Flipper& flipper, double ratio,
                           const std::shared_ptr<const GuardLimits>& guard) {
  BoundaryCutter cutter(work, flipper, guard);
  // Conflicts come first: after other cuts more splits are needed, and at sharp corners far more.
  cutter.resolve_conflicts();
  for (int pass = 0; pass < kGradingPasses; ++pass) {
    const GradingPlan plan = plan_boundary_grading(work.mesh, ratio, kWidestBoundaryAngle);
    for (const EdgeSplits& edge : plan.cuts) cutter.cut(edge);
  }
  for (const auto& corners : triangles_without_free_corner(work.mesh)) cutter.free(corners);
  return cutter.cuts();
}

}  // namespace temper
