// The steps of the mesher: arrange, divide until all narrow places are resolved, place, triangulate, optimize. Then it
// repeats them with smaller sizes around triangles that stay bad.
#include "temper/mesher.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include "base/text.hpp"
#include "mesh/bad_triangles.hpp"
#include "mesh/input_positions.hpp"
#include "mesh/stoppable_build.hpp"
#include "mesher/areas.hpp"
#include "mesher/estimate.hpp"
#include "mesher/placement.hpp"
#include "mesher/sphere_outline.hpp"
#include "temper/detail/geometry.hpp"

namespace temper {
namespace {

using namespace mesher;

InputError invalid(const std::string& message) { return {ErrorCode::invalid_option, "", message}; }

std::string kind_of(const Space& space) {
  switch (space.kind()) {
    case SpaceKind::plane:
      return "the plane";
    case SpaceKind::periodic_plane:
      return "a periodic plane";
    default:
      return "a sphere of radius " + to_text(space.radius());
  }
}

std::optional<InputError> check(const MesherOptions& options, const Space& space) {
  const auto positive = [](double x) { return x > 0 && std::isfinite(x); };
  if (options.field && !(options.field->mesh().space() == space)) {
    return invalid("the size field is for " + kind_of(options.field->mesh().space()) + ", but the outline is for " +
                   kind_of(space));
  }
  const bool few = options.points == MeshPoints::few;
  if (few && !space.is_plane())
    return invalid("meshes with few points are for the plane; on the sphere expected a size");
  if (few && !options.optimize)
    return invalid("a mesh with few points needs the optimization; expected options for it");
  if (!few && !positive(options.size) && !(options.field && options.size == 0)) {
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
  if (options.snap && !(*options.snap >= 0 && std::isfinite(*options.snap))) {
    return invalid("expected a tolerance of joins of 0 or more, found " + std::to_string(*options.snap));
  }
  if (!(options.drop_below >= 0)) return invalid("expected an extent of 0 or more to drop rings below");
  if (!(options.time_limit >= 0)) return invalid("expected a time limit of 0 or more seconds");
  if (options.attempts < 1) return invalid("expected at least one attempt");
  return {};
}

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

class Mesher {
 public:
  /// `places`: of the points of the outline.
  Mesher(const Space& space, const Outline& outline, std::vector<Vec3> places, const MesherOptions& options,
         const OptimizeHooks& hooks)
      : surface_(space),
        outline_(outline),
        given_places_(std::move(places)),
        options_(options),
        hooks_(hooks),
        deadline_(options.time_limit, hooks_.observer) {}

  Expected<OutlineMesh> run() {
    expected_ = 2 * static_cast<double>(given_places_.size());
    if (!(expected_ <= most_triangles())) return too_many_points();
    if (auto error = prepare()) return *error;
    if (auto error = check_expected()) return *error;
    tell_estimate();
    if (options_.points == MeshPoints::few) return few_points();
    Expected<OutlineMesh> made = best_of_attempts();
    if (made) note_distant_field(*made);
    return made;
  }

  Expected<MeshEstimate> estimate() {
    if (auto error = prepare()) return *error;
    return estimate_of(expected_);
  }

 private:
  /// All steps before the work whose cost `expected_` tells.
  std::optional<InputError> prepare() {
    if (auto error = check(options_, surface_.space())) return *error;
    if (auto error = check_sizes(outline_)) return *error;
    wanted_ = wanted();
    deadline_.begin("joining points");
    Expected<Arrangement> arrangement = arrange(
        surface_, outline_, given_places_, {tolerance(), options_.split_crossings}, options_.drop_below, deadline_);
    if (deadline_.stopped()) return stopped("joined");
    if (!arrangement) return arrangement.error();
    arrangement_ = *std::move(arrangement);
    deadline_.begin("finding areas");
    Expected<Areas> areas = find_areas(surface_, outline_, arrangement_, options_, wanted_.most, deadline_);
    if (deadline_.stopped()) return stopped("searched for areas");
    if (!areas) return areas.error();
    areas_ = *std::move(areas);
    leave_out_edges();
    if (auto error = split_touching(surface_, arrangement_, areas_, tolerance(), names_of(outline_))) return *error;
    if (options_.points == MeshPoints::few) {
      expected_ = 2 * static_cast<double>(places_.size());
      return {};
    }
    if (auto error = start_sources()) return *error;
    if (auto error = triangulate_undivided()) return *error;
    return count_expected();
  }

  [[nodiscard]] Vec3 point(std::int32_t i) const { return places_[static_cast<std::size_t>(i)]; }
  /// The place of a point of the outline before joins.
  [[nodiscard]] Vec3 given(std::int32_t p) const { return given_places_[static_cast<std::size_t>(p)]; }

  /// The tolerance of joins. On a sphere the square of a weighted vector has no digits for shorter edges.
  [[nodiscard]] double tolerance() const {
    constexpr double kOfExtent = 1e-9, kOfRadius = 1e-7;
    if (surface_.space().is_closed()) {
      return std::max(rounding(), options_.snap.value_or(kOfRadius * surface_.space().radius()));
    }
    if (given_places_.empty() || (options_.snap == 0 && !options_.split_crossings)) return 0;
    const BoundingBox box = box_of_places();
    return std::max(rounding(), options_.snap.value_or(kOfExtent * length(box.high - box.low)));
  }
  /// The least tolerance that joins what rounding moved apart.
  [[nodiscard]] double rounding() const {
    constexpr double kLeastOfRadius = 1e-8, kOfCoordinate = 1e-15;
    if (surface_.space().is_closed()) return kLeastOfRadius * surface_.space().radius();
    const BoundingBox box = box_of_places();
    return kOfCoordinate *
           std::max({std::abs(box.low.x), std::abs(box.low.y), std::abs(box.high.x), std::abs(box.high.y)});
  }
  [[nodiscard]] BoundingBox box_of_places() const {
    BoundingBox box = box_of(given_places_[0], given_places_[0]);
    for (const Vec3 p : given_places_) box = temper::united(box, box_of(p, p));
    return box;
  }

  /// Leaves out edges with nothing to mesh on either side.
  void leave_out_edges() {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < arrangement_.edges.size(); ++i) {
      if (areas_.sides[i][0] == kOutside && areas_.sides[i][1] == kOutside) continue;
      if (kept != i) arrangement_.edges[kept] = std::move(arrangement_.edges[i]);
      areas_.sides[kept++] = areas_.sides[i];
    }
    arrangement_.edges.resize(kept);
    areas_.sides.resize(kept);
  }

  [[nodiscard]] WantedSize wanted() const {
    if (options_.points == MeshPoints::few) {  // nothing is divided for its size
      const BoundingBox box = box_of_places();
      return {length(box.high - box.low), nullptr};
    }
    if (!options_.field) return {options_.size, nullptr};
    double most = 0;
    for (const VertexId v : options_.field->mesh().vertices()) most = std::max(most, options_.field->at(v));
    return {options_.size > 0 ? std::min(options_.size, most) : most, &*options_.field};
  }

  /// The number of triangles along lines and areas with sizes of their own.
  [[nodiscard]] double count_on_lines() const {
    double triangles = 0;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const double whole = surface_.distance(point(edges_[i].ends[0]), point(edges_[i].ends[1]));
      for (const std::int32_t area : areas_.sides[i]) {
        if (area == kOutside) continue;
        const double size = areas_.areas[static_cast<std::size_t>(area)].size;
        if (size < wanted_.most) triangles += whole / size;
      }
    }
    for (const OutlineSize& s : outline_.sizes)
      triangles += 2 * surface_.distance(given(s.points[0]), given(s.points[1])) / s.size;
    return triangles;
  }

  /// The number of triangles by the sizes so far, if the largest size were `most`.
  double count(double most) {
    const WantedSize wanted = {most, wanted_.field};
    Areas areas = areas_;
    for (Area& a : areas.areas) {
      if (a.size == wanted_.most) a.size = most;
    }
    const GradedSize size(surface_, sources_, wanted, options_.grade);
    double triangles = std::max(count_triangles(surface_, *undivided_, areas, size, deadline_),
                                2 * count_pieces(surface_, places_, edges_, most));
    if (wanted.field != nullptr) triangles = std::max(triangles, count_field(surface_, *undivided_, wanted, deadline_));
    return triangles;
  }

  std::optional<InputError> count_expected() {
    deadline_.begin("estimating the number of triangles");
    expected_ = count(wanted_.most);
    counted_sources_ = sources_.size();
    if (deadline_.stopped()) return stopped("measured");
    return {};
  }

  /// Tells the caller, again if narrow places make it much more.
  void tell_estimate() {
    constexpr double kMuchMore = 2;
    if (!options_.estimated || expected_ < kMuchMore * told_) return;
    told_ = expected_;
    options_.estimated(estimate_of(expected_));
  }

  /// Refuses meshes that would take all memory.
  [[nodiscard]] std::optional<InputError> check_expected() {
    if (!(expected_ <= most_triangles())) return too_many_triangles();
    return {};
  }

  /// The largest number of triangles that the option, the memory, and halfedges with numbers of 32 bits allow.
  [[nodiscard]] double most_triangles() const {
    constexpr double kMostOfMesh = 1.4e9;
    const double most = std::min(static_cast<double>(options_.most_triangles), kMostOfMesh);
    return options_.memory ? std::min(most, triangles_within(*options_.memory)) : most;
  }

  [[nodiscard]] InputError too_many_triangles() {
    const std::optional<std::string> advice = sizes_that_fit();
    if (!advice) return too_many();
    return refused(options_.field && !(options_.size > 0) ? "the size field" : "a size of " + to_text(options_.size),
                   *advice);
  }
  [[nodiscard]] InputError too_many_points() const {
    return refused("an outline of " + quantity(given_places_.size(), "points"),
                   "an outline with fewer points, or more memory");
  }
  /// `what` would make `expected_` triangles.
  [[nodiscard]] InputError refused(const std::string& what, const std::string& advice) const {
    const MeshEstimate estimate = estimate_of(expected_);
    const bool no_memory = options_.memory && !(expected_ <= triangles_within(*options_.memory));
    return invalid(what + " would make about " + estimate.triangles_text() + " triangles" +
                   (no_memory ? ", which need about " + estimate.memory_text() + " of memory, but " +
                                    MeshEstimate{0, static_cast<double>(*options_.memory)}.memory_text() + " are free"
                              : "; at most " + estimate_of(most_triangles()).triangles_text() + " are made") +
                   ". Next: " + advice);
  }

  /// What makes fewer triangles, after `expected_` are too many. Nothing if it is not the size.
  [[nodiscard]] std::optional<std::string> sizes_that_fit() {
    constexpr double kRoom = 0.8;      // of the largest number: the estimate has errors
    constexpr double kAtLeast = 1.05;  // times, for each try
    constexpr double kFine = 1e-3;     // of the extent: short edges matter less
    constexpr int kTries = 8;
    const double most = kRoom * most_triangles();
    if (most < 1) return "more memory";
    if (options_.field) {
      return std::isfinite(expected_) ? "sizes " + rounded(std::sqrt(expected_ / most)) + " times as large"
                                      : std::string("larger sizes");
    }
    const double fine =
        kFine * (surface_.is_plane() ? length(box_of_places().high - box_of_places().low) : surface_.space().radius());
    // The least of two guesses: short edges make triangles at any size.
    double size = std::max(wanted_.most,
                           std::min(fine * std::sqrt(count(fine) / most), wanted_.most * std::sqrt(expected_ / most)));
    for (int i = 0; i < kTries && std::isfinite(size) && !deadline_.stopped(); ++i) {
      const double triangles = count(size);
      if (triangles <= most) return "a size of " + rounded(size) + " or more";
      size *= std::max(kAtLeast, std::sqrt(triangles / most));
    }
    return {};
  }

  /// Adds sources for short edges, for areas of smaller size, and at places where the size field grows faster than the
  /// grade.
  std::optional<InputError> start_sources() {
    expected_ = count_on_lines();
    if (!(expected_ <= most_triangles())) {
      return invalid("sizes of regions and lines would make about " + estimate_of(expected_).triangles_text() +
                     " triangles along them; at most " + estimate_of(most_triangles()).triangles_text() +
                     " are made. Next: larger sizes there");
    }
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const Vec3 a = point(edges_[i].ends[0]), b = point(edges_[i].ends[1]);
      const double whole = surface_.distance(a, b);
      const auto edge = static_cast<std::uint32_t>(i);
      if (!narrowest_ || whole < narrowest_->width) narrowest_ = {whole, a, {edge, edge}};
      for (const Vec3 end : {a, b}) sources_.push_back({end, whole});
      for (const std::int32_t area : areas_.sides[i]) {
        const double size = area == kOutside ? wanted_.most : areas_.areas[static_cast<std::size_t>(area)].size;
        add_sources(a, b, size);
      }
    }
    for (const OutlineSize& s : outline_.sizes) add_sources(given(s.points[0]), given(s.points[1]), s.size);
    if (options_.field) grade_field(*options_.field);
    corners_ = corner_radii(surface_, arrangement_, wanted_.most);
    return {};
  }

  /// The outline with its edges as pieces.
  [[nodiscard]] DividedOutline undivided() const {
    DividedOutline whole{places_, {}};
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const auto [a, b] = edges_[e].ends;
      whole.pieces.push_back(
          {{static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)}, static_cast<std::uint32_t>(e)});
    }
    return whole;
  }

  std::optional<InputError> triangulate_undivided() {
    Expected<Triangulated> triangulated = triangulate(surface_, undivided(), {}, areas_, deadline_);
    if (deadline_.stopped()) return stopped("triangulated");
    if (!triangulated) return too_fine(triangulated.error());
    undivided_ = *std::move(triangulated);
    return {};
  }

  /// Sources of a size along a line, or at a point.
  void add_sources(Vec3 a, Vec3 b, double size) {
    if (size >= wanted_.most) return;
    const double n = std::max(1.0, std::ceil(surface_.distance(a, b) / size));
    for (double k = 0; k <= n; ++k) sources_.push_back({surface_.between(a, b, k / n), size});
  }

  void grade_field(const SizeField& field) {
    const Mesh& mesh = field.mesh();
    for (const VertexId v : mesh.vertices()) {
      const Vec3 p = surface_.place(mesh.point(v));
      const double here = field.at(v);
      const auto is_steep = [&](VertexId u) {
        return field.at(u) > here + options_.grade * length(surface_.place(mesh.point(u)) - p);
      };
      bool steep = false;
      for (const HalfedgeId h : mesh.star(v)) steep = steep || is_steep(mesh.target(h)) || is_steep(mesh.opposite(h));
      if (steep) sources_.push_back({p, here});
    }
  }

  /// The beginning of the front on a sphere without an outline: at the least size.
  [[nodiscard]] Vec3 start() const {
    if (!options_.field) return {surface_.space().radius(), 0, 0};
    VertexId least(0);
    for (const VertexId v : options_.field->mesh().vertices()) {
      if (options_.field->at(v) < options_.field->at(least)) least = v;
    }
    return surface_.place(options_.field->mesh().point(least));
  }

  [[nodiscard]] GradedSize size() const { return {surface_, sources_, wanted_, options_.grade}; }

  /// Divides the outline, finer at pieces that face each other, until nothing changes.
  Expected<DividedOutline> resolve() {
    constexpr int kRounds = 20;  // each finds what the last one's longer pieces hid; three or four do nearly always
    const std::size_t most = most_pieces();
    deadline_.begin("dividing the outline");
    DividedOutline divided = divide(surface_, places_, edges_, size(), corners_, most, deadline_);
    for (int round = 0; round < kRounds; ++round) {
      if (deadline_.stopped()) return stopped("divided");
      if (divided.pieces.size() > most) return too_many();
      const Expected<Triangulated> triangulated = triangulate(surface_, divided, {}, areas_, deadline_);
      if (deadline_.stopped()) return stopped("divided");
      if (!triangulated) return too_fine(triangulated.error());
      const NarrowPlaces narrow = narrow_places(divided, *triangulated, size(), deadline_);
      if (narrow.narrowest && (!narrowest_ || narrow.narrowest->width < narrowest_->width)) {
        narrowest_ = narrow.narrowest;
      }
      if (narrow.sources.empty()) break;
      sources_.insert(sources_.end(), narrow.sources.begin(), narrow.sources.end());
      divided = divide(surface_, places_, edges_, size(), corners_, most, deadline_);
    }
    if (deadline_.stopped()) return stopped("divided");
    if (divided.pieces.size() > most) return too_many();
    return divided;
  }

  /// Narrow places may make many more pieces than the sizes alone; more than this is a mistake in the outline.
  [[nodiscard]] std::size_t most_pieces() const {
    constexpr double kTimes = 20, kAtLeast = 50'000;
    const double pieces = kAtLeast + kTimes * count_pieces(surface_, places_, edges_, wanted_.most);
    return static_cast<std::size_t>(std::min(pieces, most_triangles()));
  }

  /// The narrowest place, if it is far below the sizes: where, how wide, between what, and the tolerance that closes
  /// it.
  [[nodiscard]] std::string narrow_text(double far = 1e-3) const {
    if (!narrowest_ || narrowest_->width > far * wanted_.most) return {};
    const OutlineNames& names = names_of(outline_);
    const auto side = [&](std::uint32_t s) {
      if (s < Gap::kPoint) return names.segment(edges_[s].segment);
      const std::uint32_t point = arrangement_.point[s - Gap::kPoint];
      return point == Arrangement::kNoPoint ? std::string("a crossing") : names.point(point);
    };
    const auto [one, other] = narrowest_->sides;
    const bool edge = one == other;
    return "the outline " + (edge ? "has an edge of " : std::string("is narrow: ")) + rounded(narrowest_->width) +
           " at " + text_of(surface_, names, narrowest_->at) + ", " +
           (edge ? side(one) : "between " + side(one) + " and " + side(other)) +
           ". Next: if that is a mistake, join it by --snap " + rounded(closing_tolerance(narrowest_->width));
  }
  /// A place below the tolerance is in a sharp corner. Its width grows with the tolerance, and five times that is
  /// enough.
  [[nodiscard]] double closing_tolerance(double width) const {
    const double within = tolerance(),
                 corner = width < within ? std::min(5 * within * (within / width), wanted_.most) : 0;
    return std::max({1.05 * width, 4 * within, 4 * rounding(), corner});
  }
  /// Two digits, not less than the value.
  [[nodiscard]] static std::string rounded(double value) {
    if (value == 0) return "0";
    const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1);
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", std::ceil(value / unit) * unit);
    return to_text(std::strtod(text, nullptr));  // 20000 rather than 2e+04
  }

  [[nodiscard]] InputError stopped(const std::string& doing) const {
    const std::string narrow = narrow_text();
    return {ErrorCode::stopped, "",
            "the run stopped without a mesh, while the outline was " + doing + "; " +
                (narrow.empty() ? "sizes far below the sizes of the outline, and narrow places along its long edges, "
                                  "take many triangles. Next: larger sizes, or more time"
                                : narrow + "; or more time")};
  }
  /// Division points meet or cross others: the outline is too narrow there for its coordinates.
  [[nodiscard]] InputError too_fine(const InputError& error) {
    find_narrowest();
    const std::string narrow = narrow_text(std::numeric_limits<double>::infinity());
    return {ErrorCode::out_of_scale, "",
            "the outline has places too narrow for the precision of its coordinates (" + error.message + "); " +
                (narrow.empty() ? "Next: larger sizes" : narrow)};
  }
  /// Looks for a place that is nearer to an edge than the narrowest one so far.
  void find_narrowest() {
    const BoundingBoxTree tree = tree_of_edges(surface_, arrangement_);
    for (std::size_t p = 0; p < places_.size() && narrowest_; ++p) {
      const NearEdge near = nearest_edge(surface_, arrangement_, tree, p, narrowest_->width);
      if (near.edge == NearEdge::kNone) continue;
      narrowest_ = {near.distance, places_[p], {near.edge, Gap::kPoint + static_cast<std::uint32_t>(p)}};
    }
  }
  [[nodiscard]] InputError too_coarse() const {
    return invalid("edges of " + to_text(wanted_.most) + " are too long for a sphere of radius " +
                   to_text(surface_.space().radius()));
  }
  [[nodiscard]] InputError too_many() const {
    const std::string narrow = narrow_text();
    return {narrow.empty() ? ErrorCode::invalid_option : ErrorCode::out_of_scale, "",
            "short edges and narrow places of the outline, with this grade, would make too many edges and triangles" +
                (narrow.empty() ? std::string() : "; " + narrow)};
  }

  Expected<OutlineMesh> make(const DividedOutline& divided) {
    const auto most_points = static_cast<std::size_t>(most_triangles() / 2);  // two triangles per vertex
    deadline_.begin("placing points", expected_ / 2);
    const std::vector<Vec3> placed = place_points(surface_, divided, areas_, size(), start(), most_points, deadline_);
    if (placed.size() >= most_points) return too_many();
    deadline_.begin("triangulating",
                    static_cast<double>(divided.points.size() + placed.size() + divided.pieces.size()));
    const Expected<Triangulated> triangulated = triangulate(surface_, divided, placed, areas_, deadline_);
    if (deadline_.stopped()) return stopped("filled with points");
    if (!triangulated) return too_fine(triangulated.error());
    return build(divided, placed, *triangulated);
  }

  /// The points inside, which are the vertices of the mesh.
  struct Inside {
    std::vector<Vec3> places;
    std::vector<std::int32_t> vertex;           ///< of each point of the triangulation, or -1
    std::vector<std::uint32_t> outline_places;  ///< of the vertices that are one, which come first
  };

  /// Nothing if a vertex that surrounds the sphere is still needed.
  [[nodiscard]] std::optional<Inside> find_inside(const DividedOutline& divided, const std::vector<Vec3>& placed,
                                                  const Triangulated& all) const {
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
    for (std::size_t i = 0; i < n; ++i) {
      if (inside.vertex[i] < 0) continue;
      inside.vertex[i] = static_cast<std::int32_t>(inside.places.size());
      inside.places.push_back(i < divided.points.size() ? divided.points[i] : placed[i - divided.points.size()]);
      if (i < places_.size()) inside.outline_places.push_back(static_cast<std::uint32_t>(i));
    }
    return inside;
  }

  Expected<OutlineMesh> build(const DividedOutline& divided, const std::vector<Vec3>& placed, const Triangulated& all) {
    constexpr std::size_t kAtATime = 1 << 16;  // triangles, before the deadline is asked
    deadline_.begin("building the mesh");
    const std::optional<Inside> inside = find_inside(divided, placed, all);
    if (deadline_.ask()) return stopped("made a mesh");
    if (!inside) return too_coarse();
    const std::vector<std::int32_t>& vertex = inside->vertex;
    std::vector<std::array<std::int32_t, 3>> triangles;
    std::vector<std::int32_t> regions;
    for (const TriangleId t : all.mesh.triangles()) {
      if (t.index % kAtATime == 0 && deadline_.ask()) return stopped("made a mesh");
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
      const VertexId from(static_cast<std::size_t>(a)), to(static_cast<std::size_t>(b));
      const std::vector<std::int32_t>& tags = edges_[piece.edge].tags;
      for (const std::int32_t tag : tags) result.lines.push_back({from, to, tag});
      if (tags.empty()) result.lines.push_back({from, to, 0});
    }
    std::vector<std::uint32_t> points;
    for (const std::uint32_t p : inside->outline_places) points.push_back(arrangement_.point[p]);
    const MeshNames names(names_of(outline_), points);
    InputPositions places(surface_.space());
    for (const Vec3 p : inside->places) places.add(p);
    MeshInput input = places.input();
    input.triangles = triangles;
    input.regions = regions;
    input.constrained_edges = constrained;
    input.names = &names;
    input.executor = hooks_.executor;
    if (deadline_.ask()) return stopped("made a mesh");
    Expected<BuiltMesh> built = build_or_stop(input, [this] { return deadline_.ask(); });
    if (deadline_.stopped()) return stopped("made a mesh");
    if (!built) return too_fine(built.error());
    result.mesh = std::move(built->mesh);
    number_points(*inside, result);
    fix_points(result);
    return result;
  }

  void number_points(const Inside& inside, OutlineMesh& made) const {
    made.notes = arrangement_.notes;
    made.warnings = arrangement_.warnings;
    if (areas_.warning) made.warnings.push_back(*areas_.warning);
    made.vertex_of_point.resize(outline_.points.size());
    std::vector<std::uint8_t> is_alone(outline_.points.size(), 1);
    for (const OutlineSegment& s : outline_.segments) {
      for (const std::int32_t end : s.ends) is_alone[static_cast<std::size_t>(end)] = 0;
    }
    std::size_t outside = 0;
    for (std::size_t i = 0; i < outline_.points.size(); ++i) {
      const std::int32_t v = arrangement_.place_of_point[i] < 0 ? -1 : inside.vertex[place_of(i)];
      if (v >= 0) made.vertex_of_point[i] = VertexId(static_cast<std::size_t>(v));
      outside += v < 0 ? 1 : 0;
      if (v < 0 && is_alone[i] != 0) {
        made.warnings.push_back(names_of(outline_).point(i) + " at " +
                                text_of(surface_, names_of(outline_), given_places_[i]) +
                                " is outside, and not in the mesh");
      }
    }
    if (std::string narrow = narrow_text(); !narrow.empty()) made.warnings.push_back(std::move(narrow));
    if (outside > 0) {
      made.notes.push_back(
          "points of the outline that are not in the mesh, because they or their segments are outside: " +
          std::to_string(outside));
    }
  }
  [[nodiscard]] std::size_t place_of(std::size_t point) const {
    return static_cast<std::size_t>(arrangement_.place_of_point[point]);
  }

  /// Points with a tag and points of no segment stay, too: they are the user's.
  void fix_points(OutlineMesh& made) const {
    std::vector<std::uint8_t> known(places_.size(), 0);  // on an edge, or marked
    for (const OutlineEdge& e : edges_) {
      for (const std::int32_t end : e.ends) known[static_cast<std::size_t>(end)] = 1;
    }
    const auto mark = [&](std::size_t point, std::int32_t tag) {
      const VertexId v = made.vertex_of_point[point];
      if (!v.valid()) return;
      const bool was_known = std::exchange(known[place_of(point)], 1) != 0;
      if (was_known && tag == 0) return;
      made.mesh.set_fixed(v, true);
      made.marked.push_back({v, tag});
    };
    for (const OutlineTag& p : outline_.point_tags) mark(static_cast<std::size_t>(p.element), p.tag);
    for (std::size_t i = 0; i < outline_.points.size(); ++i) mark(i, 0);
    made.groups = outline_.groups;
    note_lost_groups(made);
  }

  /// Tells of tags that the outline has and the mesh has not.
  void note_lost_groups(OutlineMesh& made) const {
    std::set<std::pair<int, std::int32_t>> lost;  // dimension and tag
    for (const OutlineTag& p : outline_.point_tags) lost.emplace(0, p.tag);
    for (const OutlineSegment& s : outline_.segments) {
      if (s.tag != 0) lost.emplace(1, s.tag);
    }
    for (const OutlineTag& s : outline_.further_tags) lost.emplace(1, s.tag);
    for (const MarkedVertex& m : made.marked) lost.erase({0, m.tag});
    for (const MeshLine& line : made.lines) lost.erase({1, line.tag});
    if (lost.empty()) return;
    std::string list;
    for (const auto& [dimension, tag] : lost) {
      list += (list.empty() ? "" : ", ") + std::string(dimension == 0 ? "points of " : "lines of ") +
              name_of_tag(outline_, dimension, tag);
    }
    made.notes.push_back("these tags of the outline are missing in the mesh (outside, left out or joined): " + list);
  }

  Expected<OutlineMesh> attempt() {
    const Expected<DividedOutline> divided = resolve();
    if (!divided) return divided.error();
    if (sources_.size() > counted_sources_) {  // narrow places and bad triangles have smaller sizes
      if (auto error = count_expected()) return *error;
      if (auto error = check_expected()) return *error;
      tell_estimate();
    }
    Expected<OutlineMesh> made = make(*divided);
    if (!made) return made;
    made->delaunay_bad = made->bad = bad_triangles(made->mesh).size();
    if (!options_.optimize) return made;
    OptimizeOptions options = *options_.optimize;
    // New vertices on the outline cure what no vertex inside does. On the sphere only another division makes them.
    const bool splits = surface_.space().is_plane() && options.repair != Repair::none;
    if (!splits) options.repair = Repair::none;
    if (const auto error = improve(*made, options)) return too_fine(*error);
    if (!splits || made->bad == 0 || stopped_early(*made)) return made;
    options.repair = Repair::vertices;
    options.boundary = BoundaryVertices::split;
    if (const auto error = improve(*made, options)) return *error;
    return made;
  }

  std::optional<InputError> improve(OutlineMesh& made, OptimizeOptions options) const {
    const double left = deadline_.time_left();
    OptimizeHooks hooks = hooks_;
    options.guard = {}, hooks.solvers.squared_errors = {};  // the Delaunay mesh is not the user's
    if (left > 0 && !(options.time_limit > 0 && options.time_limit < left)) options.time_limit = left;
    Expected<OptimizeReport> report = optimize(made.mesh, options, hooks);
    if (!report) return report.error();
    if (!report->vertices.empty()) renumber(made, report->vertices);
    made.report = *std::move(report);
    made.bad = bad_triangles(made.mesh).size();
    return {};
  }

  /// Renumbers lines and points of the outline after vertices were removed or inserted. Their own vertices never are
  /// removed, but lines may be split.
  static void renumber(OutlineMesh& made, const IdVector<VertexId, VertexId>& old_numbers) {
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

  /// Returns the lines with each one replaced by its pieces, which meet at vertices without an old number.
  static std::vector<MeshLine> pieces_of(const std::vector<MeshLine>& lines, const Mesh& mesh,
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

  /// Returns the next vertex on the way from `from` to `end` along a line: the end, or the new vertex that is nearest
  /// to the straight way.
  static VertexId next_on_line(const Mesh& mesh, VertexId from, VertexId end,
                               const IdVector<VertexId, VertexId>& old_numbers) {
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

  /// Makes sizes around the triangles that stay bad smaller.
  void refine_around_bad(const Mesh& mesh) {
    constexpr double kSmaller = 0.7;
    const GradedSize now = size();
    for (const TriangleId t : bad_triangles(mesh)) {
      for (const VertexId v : mesh.corners(t)) {
        const Vec3 p = surface_.place(mesh.point(v));
        sources_.push_back({p, kSmaller * now(p)});
      }
    }
  }

  /// Sizes in other coordinates than the outline's would go unnoticed, because they hold outside their mesh, too.
  void note_distant_field(OutlineMesh& made) const {
    if (!options_.field) return;
    const auto inside = [&](VertexId v) { return !options_.field->at(made.mesh.point(v)).outside; };
    const auto vertices = made.mesh.vertices();
    if (std::any_of(vertices.begin(), vertices.end(), inside)) return;
    made.notes.emplace_back(
        "the sizes are all outside the domain, so the nearest of them are used. Next: check that both have the same "
        "coordinates and units");
  }

  [[nodiscard]] bool stopped_early(const OutlineMesh& made) const {
    return deadline_.stopped() || temper::stopped_early(made.report.stopped);
  }

  /// Makes the constrained Delaunay triangulation of the outline alone. Repairs add the vertices that it lacks, and the
  /// optimization removes all that it can.
  Expected<OutlineMesh> few_points() {
    constexpr int kSweepsForFew = 10'000;  // repairs follow many restarts
    if (auto error = triangulate_undivided()) return *error;
    Expected<OutlineMesh> made = build(undivided(), {}, *undivided_);
    if (!made) return made;
    made->delaunay_bad = made->bad = bad_triangles(made->mesh).size();
    OptimizeOptions options = *options_.optimize;
    options.repair = Repair::vertices;
    options.boundary = BoundaryVertices::split;
    options.coarsen = std::numeric_limits<double>::max();  // no limit of sizes
    options.max_sweeps = std::max(options.max_sweeps, kSweepsForFew);
    if (options_.time_limit > 0) options.coarsen_moves = std::numeric_limits<int>::max();
    if (const auto error = improve(*made, options)) return *error;
    return made;
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
    if (deadline_.stopped()) best->report.stopped = deadline_.out_of_time() ? Stopped::time_limit : Stopped::canceled;
    return best;
  }

  Surface surface_;
  const Outline& outline_;
  std::vector<Vec3> given_places_;
  const MesherOptions& options_;
  const OptimizeHooks& hooks_;
  Deadline deadline_;
  WantedSize wanted_;
  Arrangement arrangement_;
  const std::vector<Vec3>& places_ = arrangement_.places;
  const std::vector<OutlineEdge>& edges_ = arrangement_.edges;
  Areas areas_;
  CornerRadii corners_;
  std::vector<SizeSource> sources_;
  std::optional<Gap> narrowest_;
  std::optional<Triangulated> undivided_;  // the outline alone
  double expected_ = 0, told_ = 0;         // number of triangles
  std::size_t counted_sources_ = 0;        // that it is for
};

}  // namespace

namespace {

std::vector<Vec3> places_of(const Outline& outline) {
  std::vector<Vec3> places;
  places.reserve(outline.points.size());
  for (const Vec2 p : outline.points) places.push_back({p.x, p.y, 0});
  return places;
}

/// Calls `use` with the mesher of a sphere.
template <class Result, class Use>
Expected<Result> with_sphere(const SphereOutline& outline, const MesherOptions& options, const OptimizeHooks& hooks,
                             const Use& use) {
  if (!(outline.radius > 0 && is_exact_coordinate(outline.radius)))
    return invalid("the radius of a sphere must be positive and finite");
  Expected<SphereOutlines> all = united(outline);
  if (!all) return all.error();
  Mesher mesher(Space::sphere(outline.radius), all->outline, std::move(all->places), options, hooks);
  return use(mesher);
}

}  // namespace

Expected<OutlineMesh> mesh_outline(const Outline& outline, const MesherOptions& options, const OptimizeHooks& hooks) {
  return Mesher(Space(), outline, places_of(outline), options, hooks).run();
}

Expected<MeshEstimate> estimate_outline(const Outline& outline, const MesherOptions& options,
                                        const OptimizeHooks& hooks) {
  return Mesher(Space(), outline, places_of(outline), options, hooks).estimate();
}

Expected<OutlineMesh> mesh_sphere(const SphereOutline& outline, const MesherOptions& options,
                                  const OptimizeHooks& hooks) {
  return with_sphere<OutlineMesh>(outline, options, hooks, [](Mesher& mesher) { return mesher.run(); });
}

Expected<MeshEstimate> estimate_sphere(const SphereOutline& outline, const MesherOptions& options,
                                       const OptimizeHooks& hooks) {
  return with_sphere<MeshEstimate>(outline, options, hooks, [](Mesher& mesher) { return mesher.estimate(); });
}

}  // namespace temper
