#include "optimize/repair/edits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/sort_unique.hpp"
#include "geometry/surface.hpp"
#include "mesh/bad_triangles.hpp"
#include "optimize/repair/local_copy.hpp"
#include "optimize/step/insertion_place.hpp"
#include "temper/detail/necessity.hpp"
#include "topology/locate.hpp"
#include "topology/rings.hpp"

namespace temper {
namespace {

constexpr int kPerturbations = 3;
// Largest number of bad triangles of a neighborhood at which edits begin.
constexpr std::size_t kMostBad = 6;
constexpr std::size_t kMostRemovals = 12;
// Largest number of lines near bad triangles that edits split.
constexpr std::size_t kMostLines = 8;
// Gradations of sizes: the first sizes hardly grow, the last ones double within their own length.
constexpr double kGradations[] = {0.3, 0.6, 1};

/// Returns the seed of the neighborhood, and other bad triangles.
std::vector<TriangleId> some_bad_triangles(const Neighborhood& around) {
  std::vector<TriangleId> bad = {around.seed};
  for (const TriangleId t : around.mesh.triangles()) {
    if (bad.size() == kMostBad) break;
    if (t != around.seed && is_bad(around.mesh, t)) bad.push_back(t);
  }
  return bad;
}

void add_insertions(const Mesh& mesh, TriangleId t, InsertionPlace place, std::vector<Edit>& edits) {
  const auto [a, b, c] = mesh.points(t);
  const auto add = [&, &a = a, &b = b, &c = c](InsertionPlace rule) {
    const WeightedPoint p = insertion_point(mesh.space(), rule, a, b, c);
    const Location at = locate(mesh, p, t);
    if (at.kind != Location::Kind::in_triangle) return;
    edits.push_back(Insert{at.triangle, p});
  };
  if (place != InsertionPlace::best) return add(place);
  add(InsertionPlace::centroid);
  add(InsertionPlace::orthocenter);
  for (int side = 0; side < 3; ++side) {
    const HalfedgeId h = Mesh::halfedge(t, side);
    if (!mesh.is_boundary(h) && !mesh.is_constrained(h)) edits.push_back(Split{h});
  }
}

/// Returns the corners of these triangles and their neighbors, each once.
std::vector<VertexId> vertices_near(const Mesh& mesh, const std::vector<TriangleId>& triangles) {
  std::vector<VertexId> near;
  for (const TriangleId t : triangles) {
    for (const VertexId v : mesh.corners(t)) {
      near.push_back(v);
      for (const HalfedgeId h : mesh.star(v)) near.push_back(mesh.target(h));
    }
  }
  sort_unique(near);
  return near;
}

void add_removals(const Neighborhood& around, const std::vector<TriangleId>& bad, std::vector<Edit>& edits) {
  std::size_t count = 0;
  for (const VertexId v : vertices_near(around.mesh, bad)) {
    if (!may_be_removed(around.mesh, around.frozen, around.divided, v)) continue;
    if (plan_removal(around.mesh, v).status != RemovalStatus::possible) continue;
    if (++count > kMostRemovals) return;
    edits.push_back(Remove{v});
  }
}

/// Returns the edges of lines near these triangles that may be split: first the edges of the triangles themselves.
std::vector<HalfedgeId> lines_near(const Neighborhood& around, const std::vector<TriangleId>& triangles) {
  const Mesh& mesh = around.mesh;
  std::vector<HalfedgeId> lines;
  const auto add = [&](HalfedgeId h) {
    if (!mesh.is_unflippable(h) || mesh.is_diagonal(h) || around.is_rim(mesh.origin(h), mesh.target(h))) return;
    const HalfedgeId edge = mesh.is_edge_representative(h) ? h : mesh.twin(h);
    const bool is_new = std::find(lines.begin(), lines.end(), edge) == lines.end();
    if (is_new && lines.size() < kMostLines) lines.push_back(edge);
  };
  for (const TriangleId t : triangles) {
    for (int side = 0; side < 3; ++side) add(Mesh::halfedge(t, side));
  }
  for (const TriangleId t : triangles_around(mesh, triangles)) {
    for (int side = 0; side < 3; ++side) add(Mesh::halfedge(t, side));
  }
  return lines;
}

/// Returns the parts of the way along h at which its dual and the corners across ask for a vertex.
std::vector<double> parts_to_split(const Mesh& mesh, HalfedgeId h) {
  constexpr double kDistinct = 0.03;
  const Vec2 a = mesh.position(mesh.origin(h)), along = mesh.position(mesh.target(h)) - a;
  const double l2 = squared_length(along), dw = mesh.weight(mesh.origin(h)) - mesh.weight(mesh.target(h));
  std::vector<double> parts;
  const auto add = [&](double part) {
    const bool is_short = std::min(part, 1 - part) < EdgeConflict::kLeastPiece;
    const bool is_new = std::ranges::none_of(parts, [&](double other) { return std::abs(part - other) < kDistinct; });
    if (!is_short && is_new) parts.push_back(part);
  };
  for (const HalfedgeId side : {h, mesh.twin(h)}) {
    if (side.valid()) add(dot(mesh.position(mesh.opposite(side)) - a, along) / l2);
  }
  add(0.5 * (1 + dw / l2));  // the crossing of the dual
  add(0.5);
  return parts;
}

/// Adds cuts of all lines at corners of these triangles at which lines meet at a sharp angle.
void add_corner_cuts(const Mesh& mesh, const std::vector<TriangleId>& triangles, std::vector<Edit>& edits) {
  std::vector<VertexId> corners;
  for (const TriangleId t : triangles) {
    for (const VertexId v : mesh.corners(t)) corners.push_back(v);
  }
  sort_unique(corners);
  for (const VertexId v : corners) {
    std::vector<Vec2> spokes;
    for (const HalfedgeId h : lines_at(mesh, v)) {
      spokes.push_back(mesh.position(mesh.origin(h) == v ? mesh.target(h) : mesh.origin(h)) - mesh.position(v));
    }
    bool is_sharp = false;
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < spokes.size(); ++i) {
      shortest = std::min(shortest, length(spokes[i]));
      for (std::size_t j = 0; j < i; ++j) is_sharp = is_sharp || dot(spokes[i], spokes[j]) > 0;
    }
    if (!is_sharp) continue;
    for (const double part : {1.0, 0.5}) edits.push_back(CutCorner{v, part * shortest});
  }
}

void add_line_splits(const Neighborhood& around, const std::vector<TriangleId>& bad, std::vector<Edit>& edits) {
  for (const HalfedgeId h : lines_near(around, bad)) {
    for (const double part : parts_to_split(around.mesh, h)) edits.push_back(Split{h, part});
  }
  add_corner_cuts(around.mesh, bad, edits);
}

}  // namespace

std::vector<std::vector<Edit>> edits_for(const Neighborhood& around, const Allowed& allowed, Rng& rng) {
  std::vector<Edit> moves = {JustSweep{}}, weights, one, many, anew;
  for (int i = 0; i < kPerturbations; ++i) moves.push_back(Perturb{rng.next()});
  if (allowed.weights) weights.push_back(AssignWeights{});
  if (!allowed.vertices) return {moves, weights};
  const std::vector<TriangleId> bad = some_bad_triangles(around);
  add_removals(around, bad, one);
  for (const TriangleId t : bad) add_insertions(around.mesh, t, allowed.place, one);
  if (allowed.lines) add_line_splits(around, bad, one);
  // Refinement has places of its own, and measures across the neighborhood.
  if (allowed.place != InsertionPlace::best || around.mesh.space().is_periodic()) return {moves, weights, one};
  for (const double gradation : kGradations) {
    for (const bool splits : {false, true}) {
      if (splits && !allowed.lines) continue;
      many.push_back(Refine{{gradation}, splits});
      anew.push_back(Refine{{gradation}, splits, true});
    }
  }
  return {moves, weights, one, many, anew};
}

std::vector<Edit> splits_of(const Neighborhood& around, HalfedgeId h, double part) {
  const Mesh& mesh = around.mesh;
  const VertexId u = mesh.origin(h), v = mesh.target(h);
  const double whole = length(mesh.position(v) - mesh.position(u));
  return {Split{h, part}, CutCorner{u, part * whole}, CutCorner{v, (1 - part) * whole}};
}

}  // namespace temper
