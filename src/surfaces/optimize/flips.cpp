#include "surfaces/optimize/flips.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "surfaces/mesh/surface_editor.hpp"
#include "surfaces/optimize/draft.hpp"
#include "topology/flip_inline.hpp"

namespace temper::surfaces {
namespace {

constexpr int kPasses = 6;
constexpr double kNegative = -1e-9;       // dual over length; ties stay
constexpr double kLeastAgreement = 0.75;  // of the new normals with the mean of the old ones
constexpr std::size_t kLeastDegree = 4;   // of the ends of an edge, which lose one

std::size_t degree(const Mesh& mesh, VertexId v) {
  std::size_t n = mesh.is_boundary(v) ? 1 : 0;
  for ([[maybe_unused]] const HalfedgeId h : mesh.star(v)) ++n;
  return n;
}

double dual_of(const SurfaceMesh& mesh, const inlined::Quad& q) {
  return dual_over_length(mesh.point(q.a), mesh.point(q.b), mesh.point(q.c), mesh.point(q.d));
}

/// Says whether a flip keeps the largest turn at the five edges within the limit.
bool may_turn(const SurfaceMesh& mesh, HalfedgeId h, const TurnLimit& limit) {
  const Mesh& connectivity = mesh.connectivity();
  const inlined::Quad q = inlined::quad(connectivity, h);
  const Vec3 a = mesh.position(q.a), b = mesh.position(q.b), c = mesh.position(q.c), d = mesh.position(q.d);
  const Vec3 left = normal_of(a, b, c), right = normal_of(b, a, d), at_a = normal_of(d, c, a),
             at_b = normal_of(c, d, b);
  double before = turn_deg(left, right), after = turn_deg(at_a, at_b);
  const auto add = [&](HalfedgeId edge, Vec3 old, Vec3 made) {
    const HalfedgeId twin = connectivity.twin(edge);
    if (!twin.valid()) return;
    const Vec3 outside = normal_at(mesh, Mesh::triangle(twin));
    before = std::max(before, turn_deg(old, outside));
    after = std::max(after, turn_deg(made, outside));
  };
  const HalfedgeId t = connectivity.twin(h);
  add(Mesh::next(h), left, at_b), add(Mesh::prev(h), left, at_a);
  add(Mesh::next(t), right, at_a), add(Mesh::prev(t), right, at_b);
  return after <= limit.at(before, false);
}

bool may_flip(const SurfaceMesh& mesh, HalfedgeId h, const Nearness& nearness, const TurnLimit& limit) {
  const Mesh& connectivity = mesh.connectivity();
  const inlined::Quad q = inlined::quad(connectivity, h);
  if (q.c == q.d || connectivity.find_halfedge(q.c, q.d).valid() || connectivity.find_halfedge(q.d, q.c).valid())
    return false;
  if (degree(connectivity, q.a) < kLeastDegree || degree(connectivity, q.b) < kLeastDegree) return false;
  const Vec3 a = mesh.position(q.a), b = mesh.position(q.b), c = mesh.position(q.c), d = mesh.position(q.d);
  const Vec3 mean = unit(unit(normal_of(a, b, c)) + unit(normal_of(b, a, d)));
  for (const Vec3 normal : {normal_of(d, c, a), normal_of(c, d, b)}) {
    if (!(dot(normal, mean) > kLeastAgreement * length(normal))) return false;
  }
  const double thinnest = std::min({kThin, width_of({a, b, c}), width_of({b, a, d})});
  if (std::min(width_of({d, c, a}), width_of({c, d, b})) < thinnest) return false;
  if (!(dual_of(mesh, {q.d, q.c, q.a, q.b}) > dual_of(mesh, q))) return false;
  if (!may_turn(mesh, h, limit)) return false;
  return nearness.is_near({d, c, a}) && nearness.is_near({c, d, b});
}

}  // namespace

std::size_t flip_negative_duals(SurfaceMesh& mesh, const Nearness& nearness, const TurnLimit& limit) {
  Mesh& connectivity = SurfaceEditor(mesh).connectivity();
  std::size_t flips = 0;
  for (int pass = 0; pass < kPasses; ++pass) {
    std::vector<std::pair<double, HalfedgeId>> negative;
    for (const HalfedgeId h : mesh.halfedges()) {
      if (connectivity.is_unflippable(h) || !connectivity.is_edge_representative(h)) continue;
      const double dual = dual_of(mesh, inlined::quad(connectivity, h));
      if (dual < kNegative) negative.emplace_back(dual, h);
    }
    std::sort(negative.begin(), negative.end());
    IdVector<TriangleId, std::uint8_t> touched(mesh.n_triangles(), 0);
    const std::size_t before = flips;
    for (const auto& [dual, h] : negative) {
      const TriangleId s = Mesh::triangle(h), t = Mesh::triangle(connectivity.twin(h));
      if (touched[s] != 0 || touched[t] != 0 || !may_flip(mesh, h, nearness, limit)) continue;
      inlined::flip(connectivity, h);
      touched[s] = touched[t] = 1;
      ++flips;
    }
    if (flips == before) break;
  }
  return flips;
}

}  // namespace temper::surfaces
