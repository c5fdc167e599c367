#include "temper/tets/explain.hpp"

#include <algorithm>
#include <utility>

#include "temper/tets/geometry.hpp"
#include "tets/quality/measure.hpp"

namespace temper::tets {
namespace {

FaceHeight height_over(const TetMesh& mesh, HalffaceId h) {
  const FacePoints points = points_of(mesh, h);
  const auto& [a, b, c] = points;
  const WeightedPoint d = mesh.point(mesh.opposite(h));
  FaceHeight face;
  face.vertices = mesh.vertices(h);
  face.boundary = mesh.is_boundary(h);
  face.outside = signed_height_sign(a, b, c, d) != Sign::positive;
  face.h = signed_height(a, b, c, d);
  face.h_over_l = face.h / length_of_area(area(points));
  face.crossed = is_crossed(points);
  return face;
}

/// Says of each face if it is on an interface. Such faces are on the boundary of their piece.
void mark_interfaces(const MetricMesh& pieces, Explanation& explanation) {
  std::vector<std::array<VertexId, 3>> faces;
  for (const SeamFace& seam : seams_of(pieces)) {
    faces.push_back(pieces.mesh.vertices(seam.one));
    faces.push_back(pieces.mesh.vertices(seam.other));
  }
  std::sort(faces.begin(), faces.end());
  for (Reason& reason : explanation.reasons) {
    for (FaceHeight& face : reason.faces) {
      face.at_interface = std::binary_search(faces.begin(), faces.end(), face.vertices);
      face.boundary = face.boundary && !face.at_interface;
    }
  }
}

bool all_marked(std::span<const VertexId> vertices, const IdVector<VertexId, std::uint8_t>& marks) {
  return std::all_of(vertices.begin(), vertices.end(), [&](VertexId v) { return marks[v] != 0; });
}

}  // namespace

std::string_view name(Cure cure) {
  switch (cure) {
    case Cure::weights:
      return "weights";
    case Cure::optimize:
      return "optimize";
    case Cure::split_boundary:
      return "split_boundary";
    case Cure::slide:
      return "slide";
  }
  return "";
}

Cure Explanation::cure(bool all_corners_on_boundary) const {
  if (verdict() == Feasibility::feasible) return Cure::weights;
  if (!all_corners_on_boundary) return Cure::optimize;
  return has_interfaces ? Cure::slide : Cure::split_boundary;
}

namespace {

/// `pieces`: null, or what has this mesh.
Expected<Explanation> explained(const TetMesh& mesh, const MetricMesh* pieces, LpSolver& solver,
                                const ExplainOptions& options) {
  const auto on_boundary = boundary_vertices(mesh);
  Explanation result;
  result.has_interfaces = pieces != nullptr;
  for (const TetId t : mesh.tetrahedra()) {
    if (measure_tetrahedron(mesh.points(t)).orthocenter_inside()) continue;
    ++result.bad;
    result.all_on_boundary += all_marked(mesh.corners(t), on_boundary);
  }
  if (result.bad > 0 && (mesh.n_tetrahedra() <= options.whole || result.bad <= options.whole)) {
    WeightOptions best;
    best.goal = WeightGoal::margin;
    Expected<WeightReport> weights =
        pieces != nullptr ? find_weights(*pieces, solver, best) : find_weights(mesh, solver, best);
    if (!weights) return weights.error();
    result.weights = *std::move(weights);
  }
  result.quality = quality(mesh, {std::min(result.bad, options.reasons)});
  for (WorstTet& worst : std::exchange(result.quality.worst, {})) {
    Reason& reason = result.reasons.emplace_back();
    static_cast<WorstTet&>(reason) = std::move(worst);
    const auto [a, b, c, d] = mesh.points(reason.tetrahedron);
    reason.orthocenter = orthocenter(a, b, c, d);
    for (int f = 0; f < 4; ++f)
      reason.faces[static_cast<std::size_t>(f)] = height_over(mesh, TetMesh::halfface(reason.tetrahedron, f));
    reason.all_on_boundary = all_marked(reason.vertices, on_boundary);
    reason.cure = result.cure(reason.all_on_boundary);
  }
  if (pieces != nullptr) mark_interfaces(*pieces, result);
  return result;
}

}  // namespace

Expected<Explanation> explain(const TetMesh& mesh, LpSolver& solver, const ExplainOptions& options) {
  return explained(mesh, nullptr, solver, options);
}

Expected<Explanation> explain(const MetricMesh& pieces, LpSolver& solver, const ExplainOptions& options) {
  return explained(pieces.mesh, pieces.is_cut() ? &pieces : nullptr, solver, options);
}

}  // namespace temper::tets
