#include "explain/conflict.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

#include "feasibility/constraints.hpp"
#include "geometry/ground.hpp"
#include "quality/measure.hpp"
#include "quality/worst.hpp"
#include "temper/detail/geometry.hpp"

namespace temper {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr std::size_t kFew = 60;  // a programme for each is well below a second

/// Those that are tried first to do without: good ones before bad ones, whatever their numbers.
void sort_for_dropping(const Mesh& mesh, TriangleId kept, std::vector<TriangleId>& triangles) {
  struct Key {
    double margin;
    Vec2 at;
    TriangleId triangle;
  };
  std::vector<Key> keys;
  keys.reserve(triangles.size());
  for (const TriangleId t : triangles) keys.push_back({measure_triangle(mesh, t).margin(), middle_of(mesh, t), t});
  std::sort(keys.begin(), keys.end(), [kept](const Key& a, const Key& b) {
    if ((a.triangle == kept) != (b.triangle == kept)) return b.triangle == kept;
    if (a.margin != b.margin) return a.margin > b.margin;
    return a.at.x != b.at.x ? a.at.x < b.at.x : a.at.y < b.at.y;
  });
  for (std::size_t i = 0; i < keys.size(); ++i) triangles[i] = keys[i].triangle;
}

bool is_refuted(const BestMargin& best) { return !best.certificate.terms.empty(); }

std::optional<Conflict> drop_what_can_be(const Mesh& mesh, std::vector<TriangleId> triangles, TriangleId kept,
                                         LpSolver& solver) {
  BestMargin best = best_margin(mesh, triangles, solver);
  if (!is_refuted(best)) return std::nullopt;
  sort_for_dropping(mesh, kept, triangles);
  for (std::size_t i = 0; i < triangles.size();) {
    std::vector<TriangleId> fewer = triangles;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    BestMargin without = fewer.empty() ? BestMargin() : best_margin(mesh, fewer, solver);
    if (is_refuted(without)) {
      triangles = std::move(fewer);
      best = std::move(without);
    } else {
      ++i;
    }
  }
  std::sort(triangles.begin(), triangles.end());
  return Conflict{std::move(triangles), std::move(best)};
}

/// The triangles that the terms speak of; for a split both sides of its edge, unless a height has named one already.
/// None but those `among`, when there are any.
std::vector<TriangleId> triangles_of(const Mesh& mesh, const Certificate& certificate,
                                     std::span<const TriangleId> among) {
  std::vector<TriangleId> triangles;
  const auto is_in = [](std::span<const TriangleId> set, TriangleId t) {
    return std::find(set.begin(), set.end(), t) != set.end();
  };
  const auto add = [&](TriangleId t) {
    if (!is_in(triangles, t) && (among.empty() || is_in(among, t))) triangles.push_back(t);
  };
  for (const auto& [constraint, multiplier] : certificate.terms) {
    if (constraint.kind == WeightConstraint::Kind::height) {
      add(Mesh::triangle(mesh.find_halfedge(constraint.p, constraint.q)));
    }
  }
  const std::size_t by_height = triangles.size();
  for (const auto& [constraint, multiplier] : certificate.terms) {
    if (constraint.kind == WeightConstraint::Kind::height) continue;
    std::vector<TriangleId> sides;
    for (const HalfedgeId h :
         {mesh.find_halfedge(constraint.p, constraint.q), mesh.find_halfedge(constraint.q, constraint.p)}) {
      if (h.valid()) sides.push_back(Mesh::triangle(h));
    }
    const auto named = [&](TriangleId t) { return is_in(std::span(triangles).first(by_height), t); };
    if (std::none_of(sides.begin(), sides.end(), named)) std::for_each(sides.begin(), sides.end(), add);
  }
  return triangles;
}

bool has_corner(const Mesh& mesh, TriangleId t, VertexId v) {
  const auto corners = mesh.corners(t);
  return std::find(corners.begin(), corners.end(), v) != corners.end();
}

/// The angles of the domain at v, or of a full turn.
double angle_around(const Mesh& mesh, VertexId v) {
  if (!mesh.is_boundary(v)) return 360;
  double angle = 0;
  for (const HalfedgeId h : mesh.star(v)) {
    angle += corner_angle(mesh.space(), mesh.point(v), mesh.point(mesh.target(h)), mesh.point(mesh.opposite(h)));
  }
  return angle * kDegrees;
}

}  // namespace

std::optional<Conflict> shrink(const Mesh& mesh, const Certificate& certificate, TriangleId kept, LpSolver& solver) {
  return drop_what_can_be(mesh, triangles_of(mesh, certificate, {}), kept, solver);
}

std::optional<Conflict> find_conflict(const Mesh& mesh, std::span<const TriangleId> triangles, TriangleId kept,
                                      LpSolver& solver) {
  if (triangles.empty()) return std::nullopt;
  const BestMargin best = best_margin(mesh, triangles, solver);
  if (!is_refuted(best)) return std::nullopt;
  if (auto conflict = drop_what_can_be(mesh, triangles_of(mesh, best.certificate, triangles), kept, solver)) {
    return conflict;
  }
  // The certificate leaned on triangles that it has no term of, to bound a residual.
  if (triangles.size() > kFew) return std::nullopt;
  return drop_what_can_be(mesh, std::vector<TriangleId>(triangles.begin(), triangles.end()), kept, solver);
}

std::optional<FanCenter> fan_center(const Mesh& mesh, std::span<const TriangleId> triangles) {
  const Ground ground(mesh.space());
  std::optional<FanCenter> center;
  double widest = -1;
  for (const VertexId v : mesh.corners(triangles.front())) {
    const auto has_v = [&](TriangleId t) { return has_corner(mesh, t, v); };
    if (!std::all_of(triangles.begin(), triangles.end(), has_v)) continue;
    FanCenter here;
    here.vertex = v;
    here.on_boundary = mesh.is_boundary(v);
    here.angle_deg = angle_around(mesh, v);
    here.shortest_length = kUnbounded;
    double angle = 0;
    for (const TriangleId t : triangles) {
      const auto corners = mesh.corners(t);
      const std::size_t k = static_cast<std::size_t>(std::find(corners.begin(), corners.end(), v) - corners.begin());
      const VertexId next = corners[(k + 1) % 3], last = corners[(k + 2) % 3];
      angle = std::max(angle, corner_angle(mesh.space(), mesh.point(v), mesh.point(next), mesh.point(last)));
      for (const VertexId u : {next, last}) {
        const double l = ground.distance(ground.place(mesh.point(v)), ground.place(mesh.point(u)));
        if (l < here.shortest_length) here.shortest_length = l, here.shortest = u;
        if (l > here.longest_length) here.longest_length = l, here.longest = u;
      }
    }
    // Of two common vertices the corner of the domain says more, then the larger angle.
    const double rank = angle + (here.on_boundary ? 10 : 0);
    if (rank <= widest) continue;
    widest = rank;
    center = here;
  }
  return center;
}

ReasonKind kind_of(const Conflict& conflict, bool has_center, bool has_crossing) {
  if (!has_crossing) return ReasonKind::patch;
  if (conflict.triangles.size() == 2) return ReasonKind::edge;
  return has_center ? ReasonKind::fan : ReasonKind::patch;
}

std::vector<VertexId> free_vertices(const Mesh& mesh, std::span<const TriangleId> triangles) {
  std::vector<VertexId> vertices;
  std::vector<TriangleId> sorted(triangles.begin(), triangles.end());
  std::sort(sorted.begin(), sorted.end());
  for (const VertexId v : vertices_of(mesh, sorted)) {
    bool free = !mesh.is_boundary(v) && !mesh.is_fixed(v);
    for (const HalfedgeId h : mesh.star(v)) free = free && !mesh.is_constrained(h);
    if (free) vertices.push_back(v);
  }
  return vertices;
}

}  // namespace temper
