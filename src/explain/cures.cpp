// The best margin of the neighborhood is a continuous function of the place of a vertex, old or newly inserted. So
// places are first tried, and compass search improves the best of them. Changes that insert a vertex are tried twice:
// with the edges as the split leaves them, and flipped until the patch is Delaunay, as an optimization would do. The
// outer edges of the neighborhood stay.
#include "explain/cures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "feasibility/certify.hpp"
#include "feasibility/constraints.hpp"
#include "geometry/surface.hpp"
#include "mesh/input_positions.hpp"
#include "quality/measure.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/regularity.hpp"
#include "temper/topology.hpp"
#include "topology/rings.hpp"

namespace temper {
namespace {

constexpr double kCured = 1e-6;        // of a best margin: clearly more than the program's rounding
constexpr double kComfortable = 0.03;  // of a best margin: no need to look for better
constexpr int kCompassRounds = 5;      // the last step is 1/32 of the first
constexpr double kFirstStep = 0.35;    // of the distance to the nearest neighbor
constexpr double kFreshStep = 0.5;     // of a vertex just inserted, whose place is only a first try

using Triple = std::array<VertexId, 3>;

Triple sorted_corners(const Mesh& mesh, TriangleId t) {
  Triple corners = mesh.corners(t);
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// A mesh of its own made of some triangles of another.
struct Patch {
  Mesh mesh;
  std::vector<VertexId> original;    ///< vertex of the patch → of the mesh, sorted
  std::vector<TriangleId> slots;     ///< triangle of the patch → of the mesh
  std::vector<TriangleId> conflict;  ///< in the patch's numbers
  std::vector<Triple> excused;       ///< triangles that need not be good, while they are there

  [[nodiscard]] VertexId in_mesh(VertexId v) const { return original[v.index]; }
};

std::optional<Patch> patch_of(const Mesh& mesh, const Conflict& conflict, std::span<const TriangleId> others) {
  Patch patch;
  patch.slots = triangles_around(mesh, conflict.triangles);
  patch.original = vertices_of(mesh, patch.slots);
  std::map<VertexId, std::int32_t> number;
  InputPositions places(mesh.space());
  std::vector<std::int32_t> fixed, regions;
  for (const VertexId v : patch.original) {
    number[v] = static_cast<std::int32_t>(number.size());
    if (mesh.is_fixed(v)) fixed.push_back(number[v]);
    places.add(mesh.space().place(mesh.point(v)));
  }
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::array<std::int32_t, 2>> constrained;
  for (const TriangleId t : patch.slots) {
    const auto [a, b, c] = mesh.corners(t);
    triangles.push_back({number[a], number[b], number[c]});
    regions.push_back(mesh.region(t));
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(t, k);
      if (mesh.is_constrained(h)) constrained.push_back({number[mesh.origin(h)], number[mesh.target(h)]});
    }
  }
  MeshInput input = places.input();
  input.triangles = triangles, input.constrained_edges = constrained;
  input.regions = regions, input.fixed_vertices = fixed;
  auto built = Mesh::build(input);
  if (!built) return std::nullopt;  // the neighborhood touches itself at a vertex: it is no mesh of its own
  patch.mesh = std::move(built->mesh);
  for (std::size_t i = 0; i < patch.slots.size(); ++i) {
    const TriangleId t = patch.slots[i];
    if (std::binary_search(conflict.triangles.begin(), conflict.triangles.end(), t)) {
      patch.conflict.emplace_back(i);
    } else if (std::find(others.begin(), others.end(), t) != others.end()) {
      patch.excused.push_back(sorted_corners(patch.mesh, TriangleId(i)));
    }
  }
  return patch;
}

/// A trial of a change, and the best quality that weights can give the patch after it.
struct Trial {
  double margin = -kUnbounded;
  std::size_t triangles = 0;
  bool exact = false;  ///< the weights found do what they should, by the exact predicate
  [[nodiscard]] bool cures() const { return exact && margin > kCured; }
};

/// Judges a mesh by all its triangles, except the excused ones.
Trial judge(const Mesh& mesh, const std::vector<Triple>& excused, LpSolver& solver) {
  std::vector<TriangleId> asked;
  for (const TriangleId t : mesh.triangles()) {
    const auto [p, q, r] = mesh.corners(t);
    if (orientation(mesh.space(), mesh.point(p), mesh.point(q), mesh.point(r)) != Sign::positive) return {};
    if (std::find(excused.begin(), excused.end(), sorted_corners(mesh, t)) == excused.end()) asked.push_back(t);
  }
  const Bound bound = bound_margin(TriangleDemand(mesh, Constraints::well_centered), as_cells(asked), solver);
  if (bound.best.status != LpStatus::optimal) return {};
  return {bound.best.margin, asked.size(), bound.best.margin > kCured && suits(mesh, asked, bound.best)};
}

/// Directions at a place; both `along` a line.
std::vector<Vec3> compass(const Surface& surface, Vec3 at, std::optional<Vec3> along) {
  if (along) return {*along, -1.0 * *along};
  const Vec3 ahead = surface.some_direction(at), left = surface.to_the_left(ahead, at);
  std::vector<Vec3> directions;
  directions.reserve(8);
  for (int i = 0; i < 8; ++i) {
    directions.push_back(std::cos(i * std::numbers::pi / 4) * ahead + std::sin(i * std::numbers::pi / 4) * left);
  }
  return directions;
}

Vec3 position_at(const Mesh& mesh, VertexId v) { return Surface(mesh.space()).place(mesh.point(v)); }

double distance_to_nearest(const Mesh& mesh, VertexId v) {
  double least = kUnbounded;
  for (const HalfedgeId h : mesh.star(v)) {
    for (const VertexId u : {mesh.target(h), mesh.opposite(h)}) {
      least = std::min(least, squared_length(position_at(mesh, u) - position_at(mesh, v)));
    }
  }
  return std::sqrt(least);
}

Vec3 centroid(const Mesh& mesh, TriangleId t) {
  const auto [a, b, c] = mesh.corners(t);
  return Surface(mesh.space()).below((1.0 / 3) * (position_at(mesh, a) + position_at(mesh, b) + position_at(mesh, c)));
}

TriangleId largest(const Mesh& mesh, std::span<const TriangleId> triangles) {
  const auto area = [&](TriangleId t) {
    const auto [p, q, r] = mesh.corners(t);
    return Surface(mesh.space()).extent(mesh.point(p), mesh.point(q), mesh.point(r));
  };
  return *std::max_element(triangles.begin(), triangles.end(),
                           [&](TriangleId a, TriangleId b) { return area(a) < area(b); });
}

class CureFinder {
 public:
  CureFinder(Patch patch, LpSolver& solver)
      : patch_(std::move(patch)), surface_(patch_.mesh.space()), solver_(solver) {}

  /// First with the whole neighborhood; if that has further conflicts, with the triangles that the change touches.
  std::vector<Cure> run() {
    for (const bool conflict_only : {false, true}) {
      conflict_only_ = conflict_only;
      if (!best_.empty()) break;
      move_vertices();
      flip_edges();
      insert_in_triangles();
      split_edges();
    }
    std::vector<Cure> cures;
    for (auto& [action, cure] : best_) cures.push_back(cure);
    return cures;
  }

 private:
  using Action = Cure::Action;

  /// v: the vertex that has moved or is new, or none.
  [[nodiscard]] Trial judge(const Mesh& mesh, VertexId v) {
    if (!conflict_only_) return temper::judge(mesh, patch_.excused, solver_);
    std::vector<Triple> excused = patch_.excused;
    for (const TriangleId t : patch_.mesh.triangles()) {
      const Triple corners = sorted_corners(patch_.mesh, t);
      const bool in_conflict = std::find(patch_.conflict.begin(), patch_.conflict.end(), t) != patch_.conflict.end();
      const bool touched = std::find(corners.begin(), corners.end(), v) != corners.end();
      if (!in_conflict && !touched) excused.push_back(corners);
    }
    return temper::judge(mesh, excused, solver_);
  }

  [[nodiscard]] bool has_comfortable(Action action) const {
    const auto known = best_.find(action);
    return known != best_.end() && known->second.margin >= kComfortable;
  }
  void offer(Cure cure, const Trial& trial) {
    if (!trial.cures()) return;
    cure.verified = true;
    cure.conflict_only = conflict_only_;
    cure.margin = trial.margin;
    cure.triangles = trial.triangles;
    cure.left_out = patch_.excused.size();
    const auto [known, is_new] = best_.emplace(cure.action, cure);
    if (!is_new && known->second.margin < cure.margin) known->second = std::move(cure);
  }
  /// The edge of h in the numbers of the mesh.
  [[nodiscard]] std::vector<VertexId> edge_of(HalfedgeId h) const {
    return {patch_.in_mesh(patch_.mesh.origin(h)), patch_.in_mesh(patch_.mesh.target(h))};
  }

  /// A place for vertex v, and the quality of the mesh that make(place) gives: nothing if v cannot be there.
  struct Place {
    Vec3 at;
    Trial trial;
  };
  template <class Make>
  Place search(const Make& make, VertexId v, Vec3 start, double step, std::optional<Vec3> along) {
    const auto tried = [&](Vec3 at) {
      const std::optional<Mesh> mesh = make(at);
      return Place{at, mesh ? judge(*mesh, v) : Trial()};
    };
    Place best = tried(start);
    for (int round = 0; round < kCompassRounds && best.trial.margin < kComfortable; ++round, step /= 2) {
      const Vec3 from = best.at;
      for (const Vec3 direction : compass(surface_, from, along)) {
        const Place place = tried(surface_.below(from + step * direction));
        if (place.trial.margin > best.trial.margin) best = place;
      }
    }
    return best;
  }

  void move_vertices() {
    for (const VertexId v : free_vertices(patch_.mesh, patch_.conflict)) {
      if (has_comfortable(Action::move_vertex)) return;
      const auto moved = [&](Vec3 at) {
        Mesh mesh = patch_.mesh;
        mesh.set_point(v, surface_.vertex(at));
        return std::optional<Mesh>(std::move(mesh));
      };
      const double step = kFirstStep * distance_to_nearest(patch_.mesh, v);
      const Place best = search(moved, v, position_at(patch_.mesh, v), step, std::nullopt);
      Cure cure;
      cure.action = Action::move_vertex;
      cure.vertex = patch_.in_mesh(v);
      cure.at = surface_.space().as_shown(best.at);
      offer(cure, best.trial);
    }
  }

  void flip_edges() {
    for (const HalfedgeId h : edges_of(patch_.mesh, patch_.conflict)) {
      if (has_comfortable(Action::flip_edge)) return;
      if (can_flip(patch_.mesh, h) != FlipStatus::possible) continue;
      Mesh mesh = patch_.mesh;
      flip(mesh, h);
      Cure cure;
      cure.action = Action::flip_edge;
      cure.edge = edge_of(h);
      offer(cure, judge(mesh, VertexId()));
    }
  }

  /// insert(place) is the mesh with the new vertex, which is the last. It is tried with these edges, and Delaunay.
  template <class Insert>
  void offer_inserted(Cure cure, const Insert& insert, Vec3 start, double step, std::optional<Vec3> along) {
    const VertexId v(patch_.mesh.n_vertices());
    const auto delaunay = [&](Vec3 at) {
      std::optional<Mesh> mesh = insert(at);
      if (mesh) restore_regularity(*mesh, HiddenPolicy::undo);
      return mesh;
    };
    for (const Place& best : {search(insert, v, start, step, along), search(delaunay, v, start, step, along)}) {
      cure.at = surface_.space().as_shown(best.at);
      offer(cure, best.trial);
    }
  }

  void insert_in_triangles() {
    for (const TriangleId t : patch_.conflict) {
      if (has_comfortable(Action::insert_vertex)) return;
      const auto [a, b, c] = patch_.mesh.corners(t);
      const Vec3 p = position_at(patch_.mesh, a), q = position_at(patch_.mesh, b), r = position_at(patch_.mesh, c);
      const auto is_left = [&](Vec3 x, Vec3 y, Vec3 z) { return surface_.orientation(x, y, z) == Sign::positive; };
      const auto inserted = [&](Vec3 at) {
        std::optional<Mesh> mesh;
        if (is_left(p, q, at) && is_left(q, r, at) && is_left(r, p, at)) {
          mesh = patch_.mesh;
          insert_in_triangle(*mesh, t, surface_.vertex(at));
        }
        return mesh;
      };
      const Vec3 start = centroid(patch_.mesh, t);
      const double step = kFreshStep * std::min({length(p - start), length(q - start), length(r - start)});
      Cure cure;
      cure.action = Action::insert_vertex;
      cure.triangle = patch_.slots[t.index];
      offer_inserted(cure, inserted, start, step, std::nullopt);
    }
  }

  /// The places where the edge of h may be split: its midpoint, and the foot of the opposite corner on either side.
  [[nodiscard]] std::vector<Vec3> places_on(HalfedgeId h) const {
    const Mesh& mesh = patch_.mesh;
    const Vec3 p = position_at(mesh, mesh.origin(h)), q = position_at(mesh, mesh.target(h));
    std::vector<Vec3> places = {surface_.between(p, q, 0.5)};
    for (const HalfedgeId side : {h, mesh.twin(h)}) {
      if (!side.valid()) continue;
      const double s = surface_.part_below(p, q, position_at(mesh, mesh.opposite(side)));
      if (s > 0.1 && s < 0.9) places.push_back(surface_.between(p, q, s));
    }
    return places;
  }
  [[nodiscard]] bool can_split(HalfedgeId h, Vec3 at) const {
    const Mesh& mesh = patch_.mesh;
    const auto is_left = [&](Vec3 x, Vec3 y, Vec3 z) { return surface_.orientation(x, y, z) == Sign::positive; };
    for (const HalfedgeId side : {h, mesh.twin(h)}) {
      if (!side.valid()) continue;
      const Vec3 p = position_at(mesh, mesh.origin(side)), q = position_at(mesh, mesh.target(side));
      const Vec3 across = position_at(mesh, mesh.opposite(side));
      if (!is_left(p, at, across) || !is_left(at, q, across)) return false;
    }
    return true;
  }

  void split_edges() {
    for (const HalfedgeId h : edges_of(patch_.mesh, patch_.conflict)) {
      const bool boundary = patch_.mesh.is_boundary(h);
      const Action action = boundary ? Action::split_boundary : Action::split_edge;
      const Vec3 p = position_at(patch_.mesh, patch_.mesh.origin(h)),
                 q = position_at(patch_.mesh, patch_.mesh.target(h));
      for (const Vec3 at : places_on(h)) {
        if (has_comfortable(action)) break;
        const auto split = [&](Vec3 place) {
          std::optional<Mesh> mesh;
          if (can_split(h, place)) {
            mesh = patch_.mesh;
            split_edge(*mesh, h, surface_.vertex(place));
          }
          return mesh;
        };
        Cure cure;
        cure.action = action;
        cure.edge = edge_of(h);
        offer_inserted(cure, split, at, kFreshStep * std::min(length(at - p), length(q - at)),
                       surface_.direction(at, q));
      }
    }
  }

  Patch patch_;
  Surface surface_;
  LpSolver& solver_;
  bool conflict_only_ = false;
  std::map<Action, Cure> best_;  // in the order of the enumeration: what changes least comes first
};

}  // namespace

std::vector<Cure> suggested_cures(const Mesh& mesh, const Conflict& conflict) {
  std::vector<Cure> cures;
  if (!free_vertices(mesh, conflict.triangles).empty()) cures.emplace_back();  // optimize
  if (cures.empty()) {  // nothing can move: a vertex inside would
    Cure cure;
    cure.action = Cure::Action::insert_vertex;
    cure.triangle = largest(mesh, conflict.triangles);
    cure.at = mesh.space().as_shown(centroid(mesh, cure.triangle));
    cures.push_back(cure);
  }
  HalfedgeId longest;
  double most = 0;
  for (const HalfedgeId h : edges_of(mesh, conflict.triangles)) {
    const double l = length(position_at(mesh, mesh.target(h)) - position_at(mesh, mesh.origin(h)));
    if (!mesh.is_boundary(h) || l <= most) continue;
    most = l, longest = h;
  }
  if (longest.valid()) {
    Cure cure;
    cure.action = Cure::Action::split_boundary;
    cure.edge = {mesh.origin(longest), mesh.target(longest)};
    const Vec3 middle =
        Surface(mesh.space()).between(position_at(mesh, cure.edge[0]), position_at(mesh, cure.edge[1]), 0.5);
    cure.at = mesh.space().as_shown(middle);
    cures.push_back(cure);
  }
  return cures;
}

std::vector<Cure> find_cures(const Mesh& mesh, const Conflict& conflict, std::span<const TriangleId> others,
                             LpSolver& solver) {
  std::vector<Cure> cures;
  if (auto patch = patch_of(mesh, conflict, others)) cures = CureFinder(*std::move(patch), solver).run();
  return cures.empty() ? suggested_cures(mesh, conflict) : cures;
}

}  // namespace temper
