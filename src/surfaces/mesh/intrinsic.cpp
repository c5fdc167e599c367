// Triangulations of a fixed surface by edge lengths alone, and their flips.
//
//             c          Both triangles are unfolded: a is the origin, and b lies on the x axis.
//           /   \          c = (ab·ac, S_c)/ℓ,  d = (ab·ad, −S_d)/ℓ,  S twice the area, ℓ = |ab|
//         /       \        |cd|² = ((ab·ac − ab·ad)² + (S_c + S_d)²)/ℓ²
//        a ------- b     The quadrilateral is convex if the angles at a and at b are less than π:
//         \       /        S_c (ab·ad) + S_d (ab·ac) > 0, and at b alike
//           \   /
//             d
#include <algorithm>
#include <cmath>
#include <vector>

#include "temper/surfaces.hpp"
#include "topology/flip_inline.hpp"

namespace temper::surfaces {
namespace {

// Dual over length above which an edge is not negative: far above the rounding of lengths after many flips.
constexpr double kNegativeDual = -1e-10;
// Sine of the angle that is missing to π at an end of an edge, above its rounding.
constexpr double kLeastSine = 1e-9;
// Flips per edge, at most. Lawson's flips end without rounding; lattices take about one per edge.
constexpr std::size_t kMostFlips = 100;

/// Says whether the angle at the first corner of `left` and the second one of `right` is less than π.
bool is_convex_at_p(const MetricTriangle& left, const MetricTriangle& right) {
  const double here = left.dots()[0], there = right.dots()[1];
  const double sine = doubled_area(left) * there + doubled_area(right) * here;
  return sine > kLeastSine * left.pq * std::sqrt(left.rp * right.qr);
}

double squared_diagonal(const MetricTriangle& left, const MetricTriangle& right) {
  const double along = left.dots()[0] - right.dots()[1];
  const double across = doubled_area(left) + doubled_area(right);
  return (along * along + across * across) / left.pq;
}

bool has_negative_dual(const IntrinsicMesh& mesh, HalfedgeId h) {
  const Mesh& connectivity = mesh.connectivity();
  if (connectivity.is_boundary(h)) return false;
  return dual_over_length(mesh.triangle(h), mesh.triangle(connectivity.twin(h))) < kNegativeDual;
}

}  // namespace

IntrinsicMesh::IntrinsicMesh(const SurfaceMesh& mesh)
    : mesh_(mesh.connectivity()), squared_lengths_(mesh.connectivity().n_halfedges()) {
  for (const HalfedgeId h : mesh_.halfedges()) {
    // Twins have one length: it is measured from the vertex with the lower number.
    const VertexId from = std::min(mesh_.origin(h), mesh_.target(h)), to = std::max(mesh_.origin(h), mesh_.target(h));
    squared_lengths_[h] = temper::squared_length(mesh.position(to) - mesh.position(from));
  }
}

MetricTriangle IntrinsicMesh::triangle(HalfedgeId h) const {
  return {squared_lengths_[h],     squared_lengths_[Mesh::next(h)], squared_lengths_[Mesh::prev(h)],
          weight(mesh_.origin(h)), weight(mesh_.target(h)),         weight(mesh_.opposite(h))};
}

bool IntrinsicMesh::flip(HalfedgeId h) {
  if (mesh_.is_unflippable(h)) return false;
  const inlined::Quad q = inlined::quad(mesh_, h);
  if (q.c == q.d || mesh_.find_halfedge(q.c, q.d).valid() || mesh_.find_halfedge(q.d, q.c).valid()) return false;
  const HalfedgeId g = mesh_.twin(h);
  const MetricTriangle left = triangle(h), right = triangle(g);
  if (!is_convex_at_p(left, right) || !is_convex_at_p(right, left)) return false;
  const double diagonal = squared_diagonal(left, right);
  if (is_flat({diagonal, left.rp, right.qr}) || is_flat({diagonal, right.rp, left.qr})) return false;
  // The slots turn: see topology/flip_inline.hpp.
  const HalfedgeId n = Mesh::next(h), p = Mesh::prev(h), gn = Mesh::next(g), gp = Mesh::prev(g);
  inlined::flip(mesh_, h);
  squared_lengths_[h] = squared_lengths_[g] = diagonal;
  squared_lengths_[n] = left.rp, squared_lengths_[p] = right.qr;
  squared_lengths_[gn] = right.rp, squared_lengths_[gp] = left.qr;
  return true;
}

IntrinsicFlips flip_to_regular(IntrinsicMesh& mesh) {
  const Mesh& connectivity = mesh.connectivity();
  IntrinsicFlips result;
  std::vector<HalfedgeId> stack;
  for (const HalfedgeId h : connectivity.halfedges()) {
    if (connectivity.is_edge_representative(h)) stack.push_back(h);
  }
  const std::size_t most = kMostFlips * stack.size();
  while (!stack.empty() && result.flips < most) {
    const HalfedgeId h = stack.back();
    stack.pop_back();
    if (!has_negative_dual(mesh, h) || !mesh.flip(h)) continue;
    ++result.flips;
    const HalfedgeId g = connectivity.twin(h);
    for (const HalfedgeId side : {Mesh::next(h), Mesh::prev(h), Mesh::next(g), Mesh::prev(g)}) stack.push_back(side);
  }
  for (const HalfedgeId h : connectivity.halfedges()) {
    if (connectivity.is_edge_representative(h) && has_negative_dual(mesh, h)) ++result.blocked;
  }
  return result;
}

}  // namespace temper::surfaces
