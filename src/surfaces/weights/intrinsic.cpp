// Weights of intrinsic triangulations: the constraints of surfaces with lengths in place of points, and the search that
// flips between two programs.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "surfaces/weights/demand.hpp"

namespace temper::surfaces {
namespace {

using Kind = WeightConstraint::Kind;

constexpr std::size_t kMostRounds = 8;

std::size_t n_bad(const IntrinsicDemand& demand, const VertexWeights& weights) {
  const auto cells = demand.cells();
  return static_cast<std::size_t>(
      std::count_if(cells.begin(), cells.end(), [&](CellId cell) { return !demand.is_kept(cell, weights); }));
}

void set_weights(IntrinsicMesh& mesh, const VertexWeights& weights) {
  for (const VertexId v : mesh.connectivity().vertices()) mesh.set_weight(v, weights[v]);
}

}  // namespace

MetricTriangle IntrinsicDemand::triangle(VertexId p, VertexId q) const {
  const HalfedgeId h = mesh().find_halfedge(p, q);
  return surface_.triangle(h.valid() ? h : mesh().find_halfedge(q, p));
}

double IntrinsicDemand::doubled_area(VertexId p, VertexId q, VertexId r) const {
  const HalfedgeId h = mesh().find_halfedge(p, q);
  const bool is_here = h.valid() && mesh().opposite(h) == r;
  return surfaces::doubled_area(is_here ? surface_.triangle(h) : triangle(q, p));
}

LinearForm IntrinsicDemand::form_of_height(VertexId p, VertexId q, VertexId r) const {
  const MetricTriangle t = triangle(p, q);
  return height_form({Kind::height, p, q, r}, t.pq, t.dots(), surfaces::doubled_area(t));
}

bool IntrinsicDemand::is_kept(CellId cell, const VertexWeights& weights) const {
  const auto at = [&](HalfedgeId h) {
    MetricTriangle t = surface_.triangle(h);
    t.wp = weights[mesh().origin(h)], t.wq = weights[mesh().target(h)], t.wr = weights[mesh().opposite(h)];
    return t;
  };
  if (has_crossings()) return is_well_centered(at(Mesh::halfedge(TriangleId(cell.index), 0)));
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(TriangleId(cell.index), k);
    if (has_height(h) && !is_good(signed_height_sign(at(h)))) return false;
    if (has_dual(h) && !is_good(dual_length_sign(at(h), at(mesh().twin(h))))) return false;
  }
  return true;
}

double IntrinsicDemand::angle_deg(const WeightConstraint& c) const {
  if (c.kind != Kind::height) return 0;
  const MetricTriangle t = triangle(c.p, c.q);
  return std::atan2(surfaces::doubled_area(t), t.dots()[2]) * (180 / std::numbers::pi);
}

CertificateCheck IntrinsicDemand::check(const Certificate& certificate) const {
  return check_certificate(surface_, certificate);
}

double weight_margin(const IntrinsicMesh& mesh, Constraints constraints) {
  const IntrinsicDemand demand(mesh, constraints);
  return least_margin(demand, demand.weights());
}

std::size_t n_bad_triangles(const IntrinsicMesh& mesh, Constraints constraints) {
  const IntrinsicDemand demand(mesh, constraints);
  return n_bad(demand, demand.weights());
}

Expected<WeightReport> find_weights(const IntrinsicMesh& mesh, LpSolver& solver, const WeightOptions& options,
                                    ConvexSolver* convex) {
  if (auto error = expect_surface_request(mesh.connectivity(), options, convex)) return *std::move(error);
  return temper::find_weights(IntrinsicDemand(mesh, options.constraints, options.edges), solver, options, convex);
}

Expected<IntrinsicWeights> find_intrinsic_weights(IntrinsicMesh& mesh, LpSolver& solver, const WeightOptions& options,
                                                  ConvexSolver* convex) {
  const VertexWeights zero(mesh.connectivity().n_vertices(), 0.0);
  const VertexWeights start = options.from_input ? IntrinsicDemand(mesh, options.constraints).weights() : zero;
  IntrinsicMesh now = mesh;
  set_weights(now, start);
  IntrinsicWeights best;
  best.bad_before = n_bad_triangles(now, options.constraints);
  IntrinsicFlips flips;
  for (std::size_t round = 0; round < kMostRounds; ++round) {
    if (round > 0) {
      const IntrinsicFlips more = flip_to_regular(now);
      if (more.flips == 0) break;
      flips = {flips.flips + more.flips, more.blocked};
    }
    IntrinsicMesh weighted = now;
    set_weights(weighted, start);
    auto found = find_weights(weighted, solver, options, convex);
    if (!found) return std::move(found).error();
    set_weights(weighted, found->weights);
    const std::size_t bad = n_bad_triangles(weighted, options.constraints);
    if (round > 0) now = weighted;  // the first flips are those of the weights at the start
    if (round > 0 && bad >= best.bad_after) break;
    mesh = std::move(weighted);
    best = {*std::move(found), flips, best.bad_before, bad, round + 1};
    if (bad == 0 || (options.must_stop && options.must_stop())) break;
  }
  return best;
}

}  // namespace temper::surfaces
