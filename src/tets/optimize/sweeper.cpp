#include "tets/optimize/sweeper.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>

namespace temper::tets {
namespace {

// Trials per Newton step: over-relaxed, plain, then halved.
constexpr int kTrials = 6;
// A model decrease below this part of the star energy is rounding, not progress.
constexpr double kNoGain = 1e-15;
// A step goes at most this part of the way to the first tetrahedron's inversion.
constexpr double kInversionFraction = 0.9;

// A step may not lower the shape of a tetrahedron, its volume over (Σ length²)^(3/2), below this part of the regular
// one's; a worse shape may not fall at all. Else heights that no place makes positive would flatten the tetrahedra.
constexpr double kLeastShape = 0.1;
const double kRegularShape = 1 / std::sqrt(432.0);  // six volumes over this power of the lengths: 1/√2 over 6^(3/2)

double shape(const LinkFace<double>& face, const WeightedPoint& p) {
  const Apex<double> apex(face, {p.x, p.y, p.z}, p.w);
  return apex.volume6 / (apex.length2 * std::sqrt(apex.length2));
}

bool keeps_shapes(std::span<const LinkFace<double>> link, const WeightedPoint& origin, const WeightedPoint& p) {
  return std::all_of(link.begin(), link.end(), [&](const LinkFace<double>& face) {
    const double now = shape(face, p);
    return now >= kLeastShape * kRegularShape || now >= shape(face, origin);
  });
}

/// Root mean square of the lengths of the spokes.
double radius_of(std::span<const LinkFace<double>> link, const WeightedPoint& p) {
  double sum = 0;
  for (const LinkFace<double>& face : link) {
    const Apex<double> apex(face, {p.x, p.y, p.z}, p.w);
    sum += apex.length2 - face.length2;
  }
  return std::sqrt(sum / (3 * static_cast<double>(link.size())));
}

WeightedPoint along(const WeightedPoint& p, const WeightedPoint& step, double t) {
  return {p.x + t * step.x, p.y + t * step.y, p.z + t * step.z, p.w + t * step.w};
}

/// Fixes marked points: they are places that the user chose, such as wells. But if all corners of a tetrahedron have
/// the same tag, this tag lists the vertices of a part, and fixes nothing. A tag of 0 is none.
void fix_marked_points(const TetMesh& mesh, IdVector<VertexId, Mobility>& all) {
  std::set<std::pair<VertexId, std::int32_t>> marks;
  for (const auto& [vertex, tag] : mesh.tagged_points()) {
    if (tag != 0) marks.emplace(vertex, tag);
  }
  std::set<std::int32_t> of_parts;
  for (const TetId t : mesh.tetrahedra()) {
    const auto& corners = mesh.corners(t);
    for (auto mark = marks.lower_bound({corners[0], std::numeric_limits<std::int32_t>::min()});
         mark != marks.end() && mark->first == corners[0]; ++mark) {
      const std::int32_t tag = mark->second;
      if (std::all_of(corners.begin(), corners.end(), [&](VertexId v) { return marks.contains({v, tag}); }))
        of_parts.insert(tag);
    }
  }
  for (const auto& [vertex, tag] : marks) {
    if (!of_parts.contains(tag)) all[vertex] = Mobility::weight;
  }
}

}  // namespace

IdVector<VertexId, Mobility> mobilities(const TetMesh& mesh, const OptimizeOptions& options) {
  IdVector<VertexId, Mobility> all(mesh.n_vertices());
  for (const VertexId v : mesh.vertices()) all[v] = Mobility::free;
  const auto fix = [&](HalffaceId h) {
    for (const VertexId v : mesh.vertices(h)) all[v] = Mobility::weight;
  };
  for (const HalffaceId h : mesh.halffaces()) {
    if (mesh.bounds_region(h)) fix(h);
  }
  for (const TaggedFace& tagged : mesh.tagged_faces()) fix(tagged.face);
  for (const TaggedLine& tagged : mesh.tagged_lines()) {
    for (const VertexId v : tagged.ends) all[v] = Mobility::weight;
  }
  fix_marked_points(mesh, all);
  for (const VertexId v : mesh.fixed_points()) all[v] = Mobility::weight;
  for (const VertexId v : mesh.vertices()) {
    if (options.keep_positions) all[v] = Mobility::weight;
    if (options.keep_weights) all[v] = all[v] == Mobility::free ? Mobility::position : Mobility::none;
  }
  return all;
}

namespace {

/// How much of a step goes before the first tetrahedron is nearly flat. Signed volumes are linear along a step.
double farthest(std::span<const LinkFace<double>> link, const WeightedPoint& origin, const WeightedPoint& step) {
  double limit = 1;
  for (const LinkFace<double>& face : link) {
    const double volume = dot(face.normal, Vector<double>{origin.x, origin.y, origin.z} - face.origin);
    const double slope = dot(face.normal, Vector<double>{step.x, step.y, step.z});
    if (volume + limit * slope < (1 - kInversionFraction) * volume) limit = -kInversionFraction * volume / slope;
  }
  return limit;
}

/// Says whether all tetrahedra with p are positive, and the predicates exact for p.
bool is_valid(const TetMesh& mesh, std::span<const HalffaceId> link, const WeightedPoint& p, Mobility mobility) {
  if (!is_exact_weight(p.w)) return false;
  if (mobility == Mobility::weight) return true;
  if (!is_exact_coordinate(p.x) || !is_exact_coordinate(p.y) || !is_exact_coordinate(p.z)) return false;
  return std::all_of(link.begin(), link.end(), [&](HalffaceId h) {
    const auto [q, r, s] = mesh.vertices(h);
    return orientation(mesh.position(q), mesh.position(r), mesh.position(s), p.position()) == Sign::positive;
  });
}

}  // namespace

WeightedPoint improved(const TetMesh& mesh, std::span<const HalffaceId> halffaces, const WeightedPoint& origin,
                       Mobility mobility, const SweepParameters& parameters) {
  thread_local std::vector<LinkFace<double>> link;
  link.clear();
  for (const HalffaceId h : halffaces) link.push_back(link_face(mesh, h));
  const PointDerivatives<double> here = star_derivatives(link, origin, parameters.gamma);
  if (!std::isfinite(here.value)) return origin;
  auto [step, predicted] = newton_step(here, mobility, radius_of(link, origin));
  if (!(predicted > kNoGain * here.value)) return origin;
  step = along({}, step, parameters.relaxation);
  double t = farthest(link, origin, step);
  for (int trial = 0; trial < kTrials; ++trial) {
    WeightedPoint p = along(origin, step, t);
    if (mobility == Mobility::weight) p = {origin.x, origin.y, origin.z, p.w};  // -0.0 + 0 is another zero
    if (star_energy(link, p, parameters.gamma) < here.value &&
        (mobility == Mobility::weight || keeps_shapes(link, origin, p)) && is_valid(mesh, halffaces, p, mobility))
      return p;
    t *= trial == 0 && parameters.relaxation > 1 ? 1 / parameters.relaxation : 0.5;
  }
  return origin;
}

void Sweeper::improve(VertexId v, const SweepParameters& parameters) {
  if (mobility_[v] == Mobility::none) return;
  collect_link(mesh_, v, link_);
  mesh_.set_point(v, improved(mesh_, link_, mesh_.point(v), mobility_[v], parameters));
}

}  // namespace temper::tets
