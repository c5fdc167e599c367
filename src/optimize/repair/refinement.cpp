#include "optimize/repair/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/in_space.hpp"
#include "topology/locate.hpp"

namespace temper {
namespace {

// Circumradius over size: an equilateral triangle of the size has 0.58.
constexpr double kLarge = 0.75;
// Nearer to an edge than this part of its length, or of the size, a vertex makes flat triangles.
constexpr double kClearance = 0.4;

double distance_to_segment(Vec3 x, Vec3 a, Vec3 b) {
  const Vec3 along = b - a;
  const double t = std::clamp(dot(x - a, along) / squared_length(along), 0.0, 1.0);
  return length(x - (a + t * along));
}

}  // namespace

DelaunayRefinement::DelaunayRefinement(const Mesh& mesh, double gradation) : mesh_(mesh), gradation_(gradation) {
  std::vector<double> sum(mesh.n_vertices(), 0);
  std::vector<int> count(mesh.n_vertices(), 0);
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_erased(Mesh::triangle(h)) || !mesh.keeps_its_place(h) || !mesh.is_edge_representative(h)) continue;
    const VertexId a = mesh.origin(h), b = mesh.target(h);
    segments_.push_back({place(a), place(b)});
    for (const VertexId v : {a, b}) {
      sum[v.index] += length(place(b) - place(a));
      ++count[v.index];
    }
  }
  for (const VertexId v : mesh.vertices()) {
    if (count[v.index] > 0) sources_.push_back({place(v), sum[v.index] / count[v.index]});
  }
}

std::optional<DelaunayRefinement::Place> DelaunayRefinement::next() {
  double worst = kLarge;
  std::optional<Place> found;
  for (const TriangleId t : mesh_.triangles()) {
    if (mesh_.is_erased(t)) continue;
    const auto [a, b, c] = mesh_.corners(t);
    const Space& space = mesh_.space();
    const auto bare = [&](VertexId v) { return space.with_weight(mesh_.point(v), 0); };
    const WeightedPoint o = orthocenter(space, bare(a), bare(b), bare(c));
    if (!std::isfinite(o.x) || !std::isfinite(o.y) || !std::isfinite(o.w)) continue;
    const Vec3 x = place_in_space(space, o);
    const double relative = length(x - place(a)) / size(x);
    if (relative <= worst || refused_.count({o.x, o.y, o.w}) > 0) continue;
    const Location at = too_near_to_edges(x) ? Location() : locate(mesh_, o, t);
    if (at.kind != Location::Kind::in_triangle) {
      refuse(o);
      continue;
    }
    worst = relative;
    found = {at.triangle, o};
  }
  return found;
}

Vec3 DelaunayRefinement::place(VertexId v) const { return place_in_space(mesh_.space(), mesh_.point(v)); }

double DelaunayRefinement::size(Vec3 x) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Source& s : sources_) least = std::min(least, s.size + gradation_ * length(x - s.at));
  return least;
}

bool DelaunayRefinement::too_near_to_edges(Vec3 x) const {
  const double wanted = size(x);
  return std::any_of(segments_.begin(), segments_.end(), [&](const Segment& s) {
    return distance_to_segment(x, s.a, s.b) < kClearance * std::min(length(s.b - s.a), wanted);
  });
}

}  // namespace temper
