// The steps one after the other: arrange, divide until all narrow places are resolved, place, triangulate, optimise;
// and again with smaller sizes around what stays bad.
#include "temper/mesher.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "mesh/bad_triangles.hpp"
#include "mesher/areas.hpp"
#include "mesher/narrow.hpp"
#include "mesher/placement.hpp"
#include "temper/geometry.hpp"

namespace temper {
namespace {

using namespace mesher;

InputError invalid(const std::string& message) { return {ErrorCode::invalid_option, "", message}; }

std::optional<InputError> check(const MesherOptions& options) {
  const auto positive = [](double x) { return x > 0 && std::isfinite(x); };
  if (!positive(options.size)) {
    return invalid("expected a size above 0, found " + std::to_string(options.size));
  }
  if (!positive(options.grade)) {
    return invalid("expected a grade above 0, found " + std::to_string(options.grade));
  }
  for (const RegionSize& r : options.region_sizes) {
    if (!positive(r.size)) {
      return invalid("expected a size above 0 for region " + std::to_string(r.region) + ", found " +
                     std::to_string(r.size));
    }
  }
  if (!(options.time_limit >= 0)) return invalid("expected a time limit of 0 or more seconds");
  if (options.attempts < 1) return invalid("expected at least one attempt");
  return {};
}

/// Errors of Mesh::build in the names of the outline: its points come first, in their order.
class MeshNames final : public InputNames {
 public:
  MeshNames(const OutlineNames& names, const std::vector<std::uint32_t>& points) : names_(names), points_(points) {}
  std::string point(std::size_t i) const override {
    return i < points_.size() ? names_.point(points_[i]) : "a point placed on the outline or inside";
  }
  std::string point_where(std::size_t i) const override {
    return i < points_.size() ? names_.point_where(points_[i]) : std::string();
  }

 private:
  const OutlineNames& names_;
  const std::vector<std::uint32_t>& points_;  // of each vertex that is one
};

class Mesher {
 public:
  Mesher(const Outline& outline, const MesherOptions& options, const OptimizeHooks& hooks)
      : outline_(outline), options_(options), hooks_(hooks), deadline_(options.time_limit, hooks_.observer) {}

  Expected<OutlineMesh> run() {
    if (auto error = check(options_)) return *error;
    Expected<std::vector<OutlineEdge>> edges = arrange(outline_);
    if (!edges) return edges.error();
    edges_ = *std::move(edges);
    Expected<Areas> areas = find_areas(outline_, edges_, options_, deadline_);
    if (!areas) return areas.error();
    areas_ = *std::move(areas);
    if (auto error = check_count()) return *error;
    start_sources();
    return best_of_attempts();
  }

 private:
  [[nodiscard]] Vec2 point(std::int32_t i) const { return outline_.points[static_cast<std::size_t>(i)]; }

  /// Refuses what would take all memory, by the area inside.
  [[nodiscard]] std::optional<InputError> check_count() const {
    double triangles = 2 * count_pieces(outline_.points, edges_, options_.size);
    double doubled = 0;
    const Vec2 origin = outline_.points[0];
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const double term = cross(point(edges_[i].ends[0]) - origin, point(edges_[i].ends[1]) - origin);
      const auto [left, right] = areas_.sides[i];
      const auto count = [](double size) { return 1 / (std::sqrt(3.0) / 2 * size * size); };
      if (left != kOutside) doubled += term * count(areas_.areas[static_cast<std::size_t>(left)].size);
      if (right != kOutside) doubled -= term * count(areas_.areas[static_cast<std::size_t>(right)].size);
    }
    triangles += doubled;
    if (triangles <= static_cast<double>(options_.most_triangles)) return {};
    return invalid("a size of " + std::to_string(options_.size) + " would make about " +
                   std::to_string(static_cast<long long>(std::min(triangles, 9e18))) + " triangles; at most " +
                   std::to_string(options_.most_triangles) + " are made");
  }

  /// Short edges, and areas of smaller size.
  void start_sources() {
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const Vec2 a = point(edges_[i].ends[0]), b = point(edges_[i].ends[1]);
      const double whole = length(b - a);
      for (const Vec2 end : {a, b}) sources_.push_back({end, whole});
      for (const std::int32_t area : areas_.sides[i]) {
        const double size = area == kOutside ? options_.size : areas_.areas[static_cast<std::size_t>(area)].size;
        if (size >= options_.size) continue;
        const auto n = static_cast<std::size_t>(std::ceil(whole / size));
        for (std::size_t k = 0; k <= n; ++k) {
          sources_.push_back({a + (static_cast<double>(k) / static_cast<double>(n)) * (b - a), size});
        }
      }
    }
    corners_ = corner_radii(outline_.points, edges_, options_.size);
  }

  [[nodiscard]] GradedSize size() const { return {sources_, options_.size, options_.grade}; }

  /// Divides the outline, finer where that shows pieces that face each other, until nothing changes.
  Expected<DividedOutline> resolve() {
    constexpr int kRounds = 20;  // each finds what the last one's longer pieces hid; three or four do nearly always
    DividedOutline divided = divide(outline_.points, edges_, size(), corners_, deadline_);
    if (deadline_.stopped()) return stopped("divided");
    if (divided.pieces.size() > options_.most_triangles) return too_many();
    for (int round = 0; round < kRounds; ++round) {
      const Expected<Triangulated> triangulated = triangulate(divided, {}, areas_, deadline_);
      if (deadline_.stopped()) return stopped("divided");
      if (!triangulated) return too_fine(triangulated.error());
      const std::vector<SizeSource> narrow = narrow_places(divided, *triangulated, size(), deadline_);
      if (narrow.empty()) break;
      sources_.insert(sources_.end(), narrow.begin(), narrow.end());
      divided = divide(outline_.points, edges_, size(), corners_, deadline_);
      if (deadline_.stopped()) return stopped("divided");
      if (divided.pieces.size() > options_.most_triangles) return too_many();
    }
    return divided;
  }

  [[nodiscard]] static InputError stopped(const std::string& doing) {
    return {ErrorCode::stopped, "",
            "there is no mesh yet: it was time to stop while the outline was " + doing +
                "; sizes far below the outline's, and narrow places along its long edges, take many triangles"};
  }
  /// Division points that meet or cross others: the outline is narrower there than its coordinates can say.
  [[nodiscard]] static InputError too_fine(const InputError& error) {
    return {
        ErrorCode::out_of_scale, "",
        "the outline has places too narrow for the precision of its coordinates (dividing it, " + error.message + ")"};
  }
  [[nodiscard]] InputError too_many() const {
    return invalid("short edges and narrow places of the outline, with this grade, would make more than " +
                   std::to_string(options_.most_triangles) + " triangles");
  }

  Expected<OutlineMesh> make(const DividedOutline& divided) {
    const std::size_t most_points = options_.most_triangles / 2;  // two triangles a vertex
    const std::vector<Vec2> placed = place_points(divided, areas_, size(), most_points, deadline_);
    if (placed.size() >= most_points) return too_many();
    const Expected<Triangulated> triangulated = triangulate(divided, placed, areas_, deadline_);
    if (deadline_.stopped()) return stopped("filled with points");
    if (!triangulated) return too_fine(triangulated.error());
    return build(divided, placed, *triangulated);
  }

  Expected<OutlineMesh> build(const DividedOutline& divided, const std::vector<Vec2>& placed, const Triangulated& all) {
    const std::size_t n = divided.points.size() + placed.size();
    std::vector<std::int32_t> vertex(n, -1);
    for (const TriangleId t : all.mesh.triangles()) {
      if (all.area[t] == kOutside) continue;
      for (const VertexId v : all.mesh.corners(t)) vertex[v.index] = 0;
    }
    std::vector<Vec2> points;
    std::vector<std::uint32_t> outline_points;
    for (std::size_t i = 0; i < n; ++i) {
      if (vertex[i] < 0) continue;
      vertex[i] = static_cast<std::int32_t>(points.size());
      points.push_back(i < divided.points.size() ? divided.points[i] : placed[i - divided.points.size()]);
      if (i < outline_.points.size()) outline_points.push_back(static_cast<std::uint32_t>(i));
    }
    std::vector<std::array<std::int32_t, 3>> triangles;
    std::vector<std::int32_t> regions;
    for (const TriangleId t : all.mesh.triangles()) {
      if (all.area[t] == kOutside) continue;
      const auto [a, b, c] = all.mesh.corners(t);
      triangles.push_back({vertex[a.index], vertex[b.index], vertex[c.index]});
      regions.push_back(areas_.areas[static_cast<std::size_t>(all.area[t])].region);
    }
    OutlineMesh result;
    std::vector<std::array<std::int32_t, 2>> constrained;
    for (const Piece& piece : divided.pieces) {
      const auto [left, right] = areas_.sides[piece.edge];
      if (left == kOutside && right == kOutside) continue;
      const std::int32_t a = vertex[piece.ends[0]], b = vertex[piece.ends[1]];
      if (left != kOutside && right != kOutside) constrained.push_back({a, b});
      result.lines.push_back(
          {VertexId(static_cast<std::size_t>(a)), VertexId(static_cast<std::size_t>(b)), edges_[piece.edge].tag});
    }
    const MeshNames names(names_of(outline_), outline_points);
    MeshInput input;
    input.points = points;
    input.triangles = triangles;
    input.regions = regions;
    input.constrained_edges = constrained;
    input.names = &names;
    Expected<BuiltMesh> built = Mesh::build(input);
    if (!built) return built.error();
    result.mesh = std::move(built->mesh);
    result.vertex_of_point.resize(outline_.points.size());
    for (const std::uint32_t p : outline_points) {
      result.vertex_of_point[p] = VertexId(static_cast<std::size_t>(vertex[p]));
    }
    if (const std::size_t outside = outline_.points.size() - outline_points.size(); outside > 0) {
      result.notes.push_back("points of the outline outside, or of segments outside, are not in the mesh: " +
                             std::to_string(outside));
    }
    fix_points(result);
    return result;
  }

  /// Points of no segment are the user's all the same.
  void fix_points(OutlineMesh& made) const {
    std::vector<std::uint8_t> on_edge(outline_.points.size(), 0);
    for (const OutlineEdge& e : edges_) {
      for (const std::int32_t end : e.ends) on_edge[static_cast<std::size_t>(end)] = 1;
    }
    for (std::size_t i = 0; i < on_edge.size(); ++i) {
      if (on_edge[i] == 0 && made.vertex_of_point[i].valid()) made.mesh.set_fixed(made.vertex_of_point[i], true);
    }
  }

  Expected<OutlineMesh> attempt() {
    const Expected<DividedOutline> divided = resolve();
    if (!divided) return divided.error();
    Expected<OutlineMesh> made = make(*divided);
    if (!made) return made;
    made->delaunay_bad = made->bad = bad_triangles(made->mesh).size();
    if (!options_.optimize) return made;
    // Another division of the outline is a better cure than repairs of this one: those are for the last.
    OptimizeOptions options = *options_.optimize;
    options.repair = Repair::none;
    if (auto error = improve(*made, options)) return *error;
    return made;
  }

  std::optional<InputError> improve(OutlineMesh& made, OptimizeOptions options) const {
    const double left = deadline_.time_left();
    if (left > 0 && !(options.time_limit > 0 && options.time_limit < left)) options.time_limit = left;
    Expected<OptimizeReport> report = optimize(made.mesh, options, hooks_);
    if (!report) return report.error();
    if (!report->vertices.empty()) renumber(made, report->vertices);
    made.report = *std::move(report);
    made.bad = bad_triangles(made.mesh).size();
    return {};
  }

  /// Lines and points of the outline after vertices were removed or inserted; theirs never are.
  static void renumber(OutlineMesh& made, const IdVector<VertexId, VertexId>& old_numbers) {
    std::vector<VertexId> now;
    for (std::size_t v = 0; v < old_numbers.size(); ++v) {
      const VertexId old = old_numbers[VertexId(v)];
      if (!old.valid()) continue;
      if (old.index >= now.size()) now.resize(old.index + std::size_t{1});
      now[old.index] = VertexId(v);
    }
    for (MeshLine& line : made.lines) line.a = now[line.a.index], line.b = now[line.b.index];
    for (VertexId& v : made.vertex_of_point) {
      if (v.valid()) v = now[v.index];
    }
  }

  /// Sizes around the triangles that stay bad become smaller.
  void refine_around_bad(const Mesh& mesh) {
    constexpr double kSmaller = 0.7;
    const GradedSize now = size();
    for (const TriangleId t : bad_triangles(mesh)) {
      for (const VertexId v : mesh.corners(t)) sources_.push_back({mesh.position(v), kSmaller * now(mesh.position(v))});
    }
  }

  [[nodiscard]] bool stopped_early(const OutlineMesh& made) const {
    return deadline_.stopped() || made.report.stopped == Stopped::cancelled ||
           made.report.stopped == Stopped::time_limit;
  }

  Expected<OutlineMesh> best_of_attempts() {
    Expected<OutlineMesh> best = attempt();
    if (!best || !options_.optimize) return best;
    Mesh last = best->mesh;
    int attempts = 1;
    for (; best->bad > 0 && attempts < options_.attempts && !stopped_early(*best); ++attempts) {
      refine_around_bad(last);
      Expected<OutlineMesh> next = attempt();
      if (!next) break;  // no time, or sizes too small for the coordinates: the best so far stays
      last = next->mesh;
      const bool last_stopped_early = stopped_early(*next);
      if (next->bad < best->bad) best = std::move(next);
      if (last_stopped_early) break;
    }
    if (best->bad > 0 && options_.optimize->repair != Repair::none && !stopped_early(*best)) {
      if (auto error = improve(*best, *options_.optimize)) return *error;
    }
    best->attempts = attempts;
    if (deadline_.stopped()) best->report.stopped = deadline_.out_of_time() ? Stopped::time_limit : Stopped::cancelled;
    return best;
  }

  const Outline& outline_;
  const MesherOptions& options_;
  const OptimizeHooks& hooks_;
  Deadline deadline_;
  std::vector<OutlineEdge> edges_;
  Areas areas_;
  CornerRadii corners_;
  std::vector<SizeSource> sources_;
};

}  // namespace

Expected<OutlineMesh> mesh_outline(const Outline& outline, const MesherOptions& options, const OptimizeHooks& hooks) {
  return Mesher(outline, options, hooks).run();
}

}  // namespace temper
