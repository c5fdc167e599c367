#include "optimize/repair/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/surface.hpp"
#include "optimize/step/insertion_place.hpp"
#include "topology/locate.hpp"

namespace temper {
namespace {

// Circumradius over size above which a triangle is large. An equilateral triangle of the right size has 0.58.
constexpr double kLarge = 0.75;
// A vertex nearer to an edge than this part of the edge's length, or of the size, makes flat triangles.
constexpr double kClearance = 0.4;
// A line longer than this, relative to the size at its midpoint, is split. Its halves are then not much too short.
constexpr double kLongLine = 1.6;
// A line shorter than this is not split for a circumcenter that is too near: its halves would be much too short.
constexpr double kShortLine = 0.8;

double distance_to_segment(Vec3 x, Vec3 a, Vec3 b) {
  const Vec3 along = b - a;
  const double t = std::clamp(dot(x - a, along) / squared_length(along), 0.0, 1.0);
  return length(x - (a + t * along));
}

std::array<double, 3> key(Vec3 p) { return {p.x, p.y, p.z}; }

}  // namespace

DelaunayRefinement::DelaunayRefinement(const Mesh& mesh, const Sizes& sizes, std::function<bool(HalfedgeId)> may_split)
    : mesh_(mesh), gradation_(sizes.gradation), may_split_(std::move(may_split)) {
  std::vector<double> sum(mesh.n_vertices(), 0);
  std::vector<int> n_lines(mesh.n_vertices(), 0);
  find_lines();
  for (const Line& line : lines_) {
    for (const VertexId v : {mesh.origin(line.edge), mesh.target(line.edge)}) {
      sum[v.index] += length(line.b - line.a);
      ++n_lines[v.index];
    }
  }
  for (const VertexId v : mesh.vertices()) {
    if (n_lines[v.index] > 0) {
      sources_.push_back({place(v), sizes.factor * sum[v.index] / n_lines[v.index]});
    } else if (mesh.is_fixed(v) && !mesh.is_isolated(v)) {
      sources_.push_back({place(v), sizes.factor * distance_to_others(v, n_lines)});
    }
  }
}

std::optional<DelaunayRefinement::Place> DelaunayRefinement::next() {
  if (const HalfedgeId h = longest_line(); h.valid()) return Place{.edge = h};
  double worst = kLarge;
  std::optional<Place> found;
  const Space& space = mesh_.space();
  for (const TriangleId t : mesh_.triangles()) {
    if (mesh_.is_erased(t)) continue;
    const auto [a, b, c] = mesh_.corners(t);
    const WeightedPoint o =
        insertion_point(space, InsertionPlace::circumcenter, mesh_.point(a), mesh_.point(b), mesh_.point(c));
    if (!std::isfinite(o.x) || !std::isfinite(o.y) || !std::isfinite(o.w)) continue;
    const Vec3 x = position_in_space(space, o);
    const double wanted = size(x), relative = length(x - place(a)) / wanted;
    if (relative <= worst || refused_.contains({o.x, o.y, o.w})) continue;
    const Line* const near = line_too_near(x, wanted);
    if (near != nullptr && length(near->b - near->a) > kShortLine * wanted && may_split(*near)) {
      worst = relative;
      found = {.edge = near->edge};
      continue;
    }
    const Location at = near != nullptr ? Location() : locate(mesh_, o, t);
    if (at.kind != Location::Kind::in_triangle) {
      refuse({.point = o});
      continue;
    }
    worst = relative;
    found = {.triangle = at.triangle, .point = o};
  }
  return found;
}

void DelaunayRefinement::refuse(const Place& at) {
  if (at.edge.valid()) {
    refused_.insert(key(0.5 * (place(mesh_.origin(at.edge)) + place(mesh_.target(at.edge)))));
  } else {
    refused_.insert({at.point.x, at.point.y, at.point.w});
  }
}

void DelaunayRefinement::find_lines() {
  lines_.clear();
  for (const HalfedgeId h : mesh_.halfedges()) {
    if (mesh_.is_erased(Mesh::triangle(h)) || !mesh_.is_unflippable(h) || !mesh_.is_edge_representative(h)) continue;
    lines_.push_back({h, place(mesh_.origin(h)), place(mesh_.target(h))});
  }
}

Vec3 DelaunayRefinement::place(VertexId v) const { return position_in_space(mesh_.space(), mesh_.point(v)); }

double DelaunayRefinement::distance_to_others(VertexId v, const std::vector<int>& n_lines) const {
  const Vec3 x = place(v);
  double least = std::numeric_limits<double>::infinity();
  for (const Line& line : lines_) least = std::min(least, distance_to_segment(x, line.a, line.b));
  for (const VertexId u : mesh_.vertices()) {
    const bool stays = n_lines[u.index] > 0 || (mesh_.is_fixed(u) && !mesh_.is_isolated(u));
    if (u != v && stays) least = std::min(least, length(place(u) - x));
  }
  return least;
}

double DelaunayRefinement::size(Vec3 x) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Source& s : sources_) least = std::min(least, s.size + gradation_ * length(x - s.at));
  return least;
}

bool DelaunayRefinement::may_split(const Line& line) const {
  return !refused_.contains(key(0.5 * (line.a + line.b))) && may_split_(line.edge);
}

/// Returns the line that is longest for its place, if it is too long.
HalfedgeId DelaunayRefinement::longest_line() const {
  double worst = kLongLine;
  HalfedgeId longest;
  for (const Line& line : lines_) {
    const double relative = length(line.b - line.a) / size(0.5 * (line.a + line.b));
    if (relative <= worst || !may_split(line)) continue;
    worst = relative;
    longest = line.edge;
  }
  return longest;
}

/// Returns the nearest line that is too near to x, or null.
const DelaunayRefinement::Line* DelaunayRefinement::line_too_near(Vec3 x, double wanted) const {
  const Line* nearest = nullptr;
  double least = kClearance;
  for (const Line& line : lines_) {
    const double relative = distance_to_segment(x, line.a, line.b) / std::min(length(line.b - line.a), wanted);
    if (relative >= least) continue;
    least = relative;
    nearest = &line;
  }
  return nearest;
}

}  // namespace temper
