// The steps of the mesher: find the domain, divide until all narrow places are resolved, place, triangulate, optimize.
// Then it repeats them with smaller sizes around triangles that stay bad.
#include "temper/mesher.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "base/text.hpp"
#include "mesh/bad_triangles.hpp"
#include "mesher/corridors.hpp"
#include "mesher/domain.hpp"
#include "mesher/estimate.hpp"
#include "mesher/outline_mesh.hpp"
#include "mesher/placement.hpp"
#include "mesher/refusals.hpp"
#include "mesher/sizing.hpp"
#include "mesher/sphere_outline.hpp"
#include "temper/detail/criterion.hpp"
#include "temper/detail/optimize_table.hpp"

namespace temper {
namespace {

using namespace mesher;

/// Sizes in other coordinates than the outline's would go unnoticed, because they hold outside their mesh, too.
void note_distant_field(const SizeField& field, OutlineMesh& made) {
  const auto inside = [&](VertexId v) { return !field.at(made.mesh.point(v)).outside; };
  const auto vertices = made.mesh.vertices();
  if (std::any_of(vertices.begin(), vertices.end(), inside)) return;
  made.notes.emplace_back(
      "the sizes are all outside the domain, so the nearest of them are used. Next: check that both have the same "
      "coordinates and units");
}

/// Repairs add the vertices that are lacking, and the optimization removes all that it can.
OptimizeOptions options_for_few(const MesherOptions& options) {
  constexpr int kSweeps = 10'000;  // repairs follow many restarts
  OptimizeOptions few = *options.optimize;
  few.repair = Repair::vertices;
  few.boundary = BoundaryVertices::split;
  few.coarsen = std::numeric_limits<double>::max();  // no limit of sizes
  few.max_sweeps = std::max(few.max_sweeps, kSweeps);
  if (options.time_limit > 0) few.coarsen_moves = std::numeric_limits<int>::max();
  return few;
}

class Mesher {
 public:
  explicit Mesher(Problem problem)
      : problem_(std::move(problem)), deadline_(options_.time_limit, problem_.hooks.observer) {}

  Expected<OutlineMesh> run() {
    expected_ = 2 * static_cast<double>(problem_.points.size());
    if (!(expected_ <= most_triangles(options_))) return too_many_points();
    if (auto error = prepare()) return *error;
    if (auto error = check_expected()) return *error;
    tell_estimate();
    if (problem_.has_few_points()) return few_points();
    Expected<OutlineMesh> made = best_of_attempts();
    if (made && options_.field) note_distant_field(*options_.field, *made);
    return made;
  }

  Expected<MeshEstimate> estimate() {
    if (auto error = prepare()) return *error;
    return estimate_of(expected_);
  }

 private:
  /// All steps before the work whose cost `expected_` tells.
  std::optional<InputError> prepare() {
    if (auto error = check(problem_)) return error;
    Expected<Domain> domain = find_domain(problem_, deadline_);
    if (!domain) return domain.error();
    domain_ = *std::move(domain);
    if (auto error = check_faces(problem_, domain_)) return error;
    warn_of_lines_at_faces(problem_, domain_);
    if (problem_.has_few_points()) {
      expected_ = 2 * static_cast<double>(domain_.arrangement.places.size());
      return {};
    }
    const double most = most_triangles(options_);
    expected_ = count_on_lines(problem_, domain_);
    if (!(expected_ <= most)) {
      return invalid("sizes of regions and lines would make about " + estimate_of(expected_).triangles_text() +
                     " triangles along them; at most " + estimate_of(most).triangles_text() +
                     " are made. Next: larger sizes there");
    }
    sizing_ = first_sizing(problem_, domain_);
    Expected<Triangulated> alone = triangulate_undivided();
    if (!alone) return alone.error();
    undivided_ = *std::move(alone);
    return count_expected();
  }

  /// The triangulation of the outline alone.
  Expected<Triangulated> triangulate_undivided() {
    return triangulated(undivided(domain_.arrangement), {}, "triangulated", domain_);
  }
  /// `doing`: what the outline was, if it is time to stop.
  Expected<Triangulated> triangulated(const DividedOutline& divided, const std::vector<Vec3>& placed,
                                      const std::string& doing, const Domain& domain) {
    Expected<Triangulated> all = triangulate(problem_.surface, divided, placed, domain.areas.sides, deadline_);
    if (deadline_.stopped()) return stopped_while(doing);
    return all ? std::move(all) : too_fine_for(all.error());
  }

  [[nodiscard]] std::string narrow() const { return narrow_text(problem_, domain_.arrangement, sizing_.narrowest); }
  [[nodiscard]] InputError stopped_while(const std::string& doing) const { return stopped(doing, narrow()); }
  [[nodiscard]] InputError too_fine_for(const InputError& error) const {
    return too_fine(problem_, domain_.arrangement, sizing_.narrowest, error);
  }
  [[nodiscard]] InputError too_many_points() const {
    return refused(options_, expected_, "an outline of " + quantity(problem_.points.size(), "points"),
                   "an outline with fewer points, or more memory");
  }

  /// The number of triangles by the sizes so far, if the largest size were `most`.
  double count(double most) {
    if (most == problem_.wanted.most) return count(most, domain_.areas, sizing_.size(problem_));
    Areas areas = domain_.areas;
    for (Area& a : areas.areas) {
      if (a.size == problem_.wanted.most) a.size = most;
    }
    return count(most, areas, {problem_.surface, sizing_.sources, {most, problem_.wanted.field}, options_.grade});
  }
  double count(double most, const Areas& areas, const GradedSize& size) {
    const double triangles = std::max(count_triangles(undivided_, areas, size, 1, deadline_),
                                      2 * count_pieces(problem_.surface, domain_.arrangement, most));
    if (!size.has_field()) return triangles;
    return std::max(triangles, count_field(problem_.surface, undivided_, {most, problem_.wanted.field}, deadline_));
  }

  std::optional<InputError> count_expected() {
    deadline_.begin("estimating the number of triangles");
    expected_ = count(problem_.wanted.most);
    if (deadline_.stopped()) return stopped_while("measured");
    return {};
  }

  /// Says whether sources since the last count may matter: a count in few steps finds too many triangles, if any.
  bool are_many_more() {
    constexpr double kMany = 1.5, kStepsPerTriangle = 1.0 / 16;
    const double at_most =
        count_triangles(undivided_, domain_.areas, sizing_.size(problem_), kStepsPerTriangle, deadline_);
    return deadline_.stopped() || at_most > std::min(kMany * expected_, most_triangles(options_));
  }

  /// Refuses meshes that would take all memory.
  [[nodiscard]] std::optional<InputError> check_expected() {
    if (expected_ <= most_triangles(options_)) return {};
    if (problem_.has_few_points()) return too_many_points();
    const auto advice = sizes_that_fit(
        problem_, expected_, [this](double most) { return count(most); }, deadline_);
    if (!advice) return too_many(narrow());
    const bool by_field = options_.field && !(options_.size > 0);
    return refused(options_, expected_, by_field ? "the size field" : "a size of " + to_text(options_.size), *advice);
  }

  /// Tells the caller, again if narrow places make it much more.
  void tell_estimate() {
    constexpr double kMuchMore = 2;
    if (!options_.estimated || expected_ < kMuchMore * told_) return;
    told_ = expected_;
    options_.estimated(estimate_of(expected_));
  }

  /// Divides the outline, finer at pieces that face each other, until nothing changes.
  Expected<DividedOutline> resolve() {
    constexpr int kRounds = 20;  // each finds what the last one's longer pieces hid; three or four do nearly always
    const std::size_t most = most_pieces();
    const auto divided_again = [&] {
      return divide(domain_.arrangement, sizing_.size(problem_), sizing_.corners, most, deadline_);
    };
    deadline_.begin("dividing the outline");
    DividedOutline divided = divided_again();
    for (int round = 0; round < kRounds; ++round) {
      if (deadline_.stopped()) return stopped_while("divided");
      if (divided.pieces.size() > most) return too_many(narrow());
      const Expected<Triangulated> all = triangulated(divided, {}, "divided", domain_);
      if (!all) return all.error();
      const NarrowPlaces found = narrow_places(divided, *all, sizing_.size(problem_), deadline_);
      add(found, sizing_);
      if (found.sources.empty()) break;
      divided = divided_again();
    }
    if (deadline_.stopped()) return stopped_while("divided");
    if (divided.pieces.size() > most) return too_many(narrow());
    return divided;
  }

  /// Divides the outline, and lays corridors along faces, shorter until they leave each other room. Then it looks
  /// whether still shorter ones have more sites in their own cells.
  Expected<Laid> lay() {
    constexpr int kRounds = 12;   // of pieces 0.7 times as long: where that is not enough, angles are too small
    constexpr int kForCells = 3;  // rounds without a better result
    std::optional<std::pair<Laid, Sizing>> best;
    for (int round = 0, last = kRounds;; ++round) {
      Expected<DividedOutline> divided = resolve();
      if (!divided && !best) return divided.error();
      if (divided && !has_faces(domain_)) return Laid{*std::move(divided), {}, {}, {}};
      Laid laid;
      if (divided) laid = lay_corridors(problem_, domain_, *divided);
      const bool is_usable = divided && laid.too_long.empty();
      if (is_usable && laid.outside_cells.empty()) return laid;
      if (is_usable && (!best || laid.outside_cells.size() < best->first.outside_cells.size()))
        best = {laid, sizing_}, last = std::min(kRounds, round + kForCells);
      if (best && (round == last || !divided)) {
        sizing_ = std::move(best->second);
        return std::move(best->first);
      }
      if (round == kRounds) return no_room_for_faces(problem_, domain_, laid.too_long.front().at);
      make_shorter(laid.too_long.empty() ? laid.outside_cells : laid.too_long, sizing_);
    }
  }

  /// Narrow places may make many more pieces than the sizes alone; more than this is a mistake in the outline.
  [[nodiscard]] std::size_t most_pieces() const {
    constexpr double kTimes = 20, kAtLeast = 50'000;
    const double pieces = count_pieces(problem_.surface, domain_.arrangement, problem_.wanted.most);
    return static_cast<std::size_t>(std::min(kAtLeast + kTimes * pieces, most_triangles(options_)));
  }

  Expected<OutlineMesh> make(Laid laid) {
    const Domain& domain = laid.divided.corridors.polygons.empty() ? domain_ : laid.domain;
    DividedOutline& divided = laid.divided;
    const auto most_points = static_cast<std::size_t>(most_triangles(options_) / 2);  // two triangles per vertex
    deadline_.begin("placing points", expected_ / 2);
    std::vector<Vec3> placed = place_points(divided, domain.areas, sizing_.size(problem_), most_points, deadline_);
    if (placed.size() >= most_points) return too_many(narrow());
    deadline_.begin("triangulating",
                    static_cast<double>(divided.points.size() + placed.size() + divided.pieces.size()));
    Expected<Triangulated> all = triangulated(divided, placed, "filled with points", domain);
    if (!all) return all.error();
    return build({std::move(divided), std::move(placed), *std::move(all)}, domain);
  }

  Expected<OutlineMesh> build(const Filled& filled, const Domain& domain) {
    deadline_.begin("building the mesh");
    const std::optional<Inside> inside = find_inside(domain, filled);
    if (deadline_.ask()) return stopped_while("made a mesh");
    if (!inside) return too_coarse(problem_);
    Expected<OutlineMesh> made = build_inside(problem_, domain, filled, *inside, deadline_);
    if (deadline_.stopped()) return stopped_while("made a mesh");
    if (!made) return too_fine_for(made.error());
    if (std::string text = narrow(); !text.empty()) made->warnings.push_back(std::move(text));
    made->delaunay_bad = made->bad = bad_triangles(made->mesh).size();
    return made;
  }

  Expected<OutlineMesh> attempt() {
    Expected<Laid> laid = lay();
    if (!laid) return laid.error();
    if (are_many_more()) {  // narrow places and bad triangles have smaller sizes
      if (auto error = count_expected()) return *error;
      if (auto error = check_expected()) return *error;
      tell_estimate();
    }
    Expected<OutlineMesh> made = make(*std::move(laid));
    if (!made || !options_.optimize) return made;
    OptimizeOptions options = *options_.optimize;
    // New vertices on the outline cure what no vertex inside does. On the sphere only another division makes them.
    const bool splits = problem_.surface.space().is_plane() && options.repair != Repair::none;
    if (!splits) options.repair = Repair::none;
    if (const auto error = improve(*made, options)) return too_fine_for(*error);
    if (!splits || is_finished(*made) || stopped_early(*made)) return made;
    options.repair = Repair::vertices;
    options.boundary = BoundaryVertices::split;
    if (const auto error = improve(*made, options)) return *error;
    return made;
  }

  std::optional<InputError> improve(OutlineMesh& made, OptimizeOptions options) const {
    const double left = deadline_.time_left();
    OptimizeHooks hooks = problem_.hooks;
    options.guard = {}, hooks.solvers.squared_errors = {};  // the Delaunay mesh is not the user's: all may change
    options.change = Change::all;
    if (left > 0 && !(options.time_limit > 0 && options.time_limit < left)) options.time_limit = left;
    Expected<OptimizeReport> report = optimize(made.mesh, options, hooks);
    if (!report) return report.error();
    if (!report->vertices.empty()) renumber(made, report->vertices);
    made.report = *std::move(report);
    made.bad = bad_triangles(made.mesh).size();
    return {};
  }

  /// The triangles that stay bad. Sites around faces stay, and triangles next to them may have no room to become
  /// well-centered. So with faces the criterion of the target decides.
  [[nodiscard]] std::vector<TriangleId> left(const OutlineMesh& made) const {
    const bool by_target = has_faces(domain_) && options_.optimize;
    const Criterion criterion = by_target ? criterion_of(*options_.optimize) : Criterion::well_centered;
    if (criterion == Criterion::well_centered && made.bad == 0) return {};
    return cells_at_violations(made.mesh, criterion, problem_.hooks.executor);
  }
  [[nodiscard]] bool is_finished(const OutlineMesh& made) const { return left(made).empty(); }

  [[nodiscard]] bool stopped_early(const OutlineMesh& made) const {
    return deadline_.stopped() || temper::stopped_early(made.report.stopped);
  }

  /// Optimizes the constrained Delaunay triangulation of the outline alone.
  Expected<OutlineMesh> few_points() {
    Expected<Triangulated> alone = triangulate_undivided();
    if (!alone) return alone.error();
    Expected<OutlineMesh> made = build({undivided(domain_.arrangement), {}, *std::move(alone)}, domain_);
    if (!made) return made;
    if (const auto error = improve(*made, options_for_few(options_))) return *error;
    return made;
  }

  Expected<OutlineMesh> best_of_attempts() {
    Expected<OutlineMesh> best = attempt();
    if (!best || !options_.optimize) return best;
    std::vector<TriangleId> left_of_best = left(*best), left_of_last = left_of_best;
    Mesh last = best->mesh;
    int attempts = 1;
    for (; !left_of_best.empty() && attempts < options_.attempts && !stopped_early(*best); ++attempts) {
      refine_around(problem_, last, left_of_last, sizing_);
      Expected<OutlineMesh> next = attempt();
      if (!next) break;  // no time, or sizes too small for the coordinates: the best so far stays
      last = next->mesh;
      left_of_last = left(*next);
      const bool last_stopped_early = stopped_early(*next);
      if (left_of_last.size() < left_of_best.size()) best = std::move(next), left_of_best = left_of_last;
      if (last_stopped_early) break;
    }
    if (!left_of_best.empty() && options_.optimize->repair != Repair::none && !stopped_early(*best)) {
      if (auto error = improve(*best, *options_.optimize)) return *error;
    }
    best->attempts = attempts;
    if (deadline_.stopped()) best->report.stopped = deadline_.out_of_time() ? Stopped::time_limit : Stopped::canceled;
    return best;
  }

  Problem problem_;
  const MesherOptions& options_ = problem_.options;
  Deadline deadline_;
  Domain domain_;
  Sizing sizing_;
  Triangulated undivided_;          // the outline alone, on which triangles are counted
  double expected_ = 0, told_ = 0;  // number of triangles
};

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
  Mesher mesher(make_problem(Space::sphere(outline.radius), all->outline, std::move(all->places), options, hooks));
  return use(mesher);
}

}  // namespace

Expected<OutlineMesh> mesh_outline(const Outline& outline, const MesherOptions& options, const OptimizeHooks& hooks) {
  return Mesher(make_problem(Space(), outline, places_of(outline), options, hooks)).run();
}

Expected<MeshEstimate> estimate_outline(const Outline& outline, const MesherOptions& options,
                                        const OptimizeHooks& hooks) {
  return Mesher(make_problem(Space(), outline, places_of(outline), options, hooks)).estimate();
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
