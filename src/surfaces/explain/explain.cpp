// Explanations of surfaces: those of the plane, with measures of triangles in space.
#include <cmath>
#include <numbers>
#include <utility>

#include "explain/duals.hpp"
#include "surfaces/quality/duals.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {
namespace {

/// h/ℓ on one side of an edge, with the angle across in degrees.
struct Side {
  std::string text;
  double angle_deg;
};

Side side_of(const SurfaceMesh& mesh, HalfedgeId h) {
  const Mesh& c = mesh.connectivity();
  const VertexId apex = c.opposite(h);
  const WeightedPoint a = mesh.point(c.origin(h)), b = mesh.point(c.target(h)), p = mesh.point(apex);
  const Vec3 pa = a.position() - p.position(), pb = b.position() - p.position();
  const double angle = std::atan2(length(cross(pa, pb)), dot(pa, pb)) * (180 / std::numbers::pi);
  const double h_over_l = signed_height(a, b, p) / length(b.position() - a.position());
  return {height_text(h_over_l, apex) + ", where the angle is " + degrees(angle), angle};
}

/// Without weights a dual is negative if the angles across it are above 180° together, or above 90° alone.
std::string why(const SurfaceMesh& mesh, const ViolatedEdge& violated) {
  const Side side = side_of(mesh, violated.edge);
  std::string text = side.text;
  double sum = side.angle_deg, limit = 90;
  if (violated.kind == DualKind::inside) {
    const Side other = side_of(mesh, mesh.connectivity().twin(violated.edge));
    text += ", and " + other.text;
    sum += other.angle_deg, limit = 180;
  }
  return sum > limit ? text : text + "; such angles allow a positive one, so the weights are the cause";
}

}  // namespace

Expected<Explanation> explain(const SurfaceMesh& mesh, LpSolver& solver, std::size_t most, std::size_t whole) {
  Explanation explanation;
  const Quality measured = quality(mesh, most);
  explanation.triangles = measured.triangles;
  explanation.bad = violations(measured, Criterion::well_centered);
  explanation.worst = measured.worst;
  if (explanation.worst.size() > explanation.bad) explanation.worst.resize(explanation.bad);
  WeightOptions options;
  options.from_input = true;
  options.whole = whole;
  auto weights = find_weights(mesh, solver, options);
  if (!weights) return weights.error();
  explanation.verdict = weights->verdict;
  explanation.changed = weights->moved;
  explanation.margin = weights->margin;
  explanation.certificate = std::move(weights->certificate);
  return explanation;
}

DualExplanation explain_duals(const SurfaceMesh& mesh, Criterion criterion, std::size_t most) {
  return worst_of(
      criterion, violated_edges(mesh, criterion), most, [](const ViolatedEdge& v) { return v.dual_over_l; },
      [&](const ViolatedEdge& v) {
        const VertexId a = mesh.connectivity().origin(v.edge), b = mesh.connectivity().target(v.edge);
        return DualReason{{a, b}, v.kind, v.dual_over_l, 0.5 * (mesh.position(a) + mesh.position(b)), why(mesh, v)};
      });
}

}  // namespace temper::surfaces
