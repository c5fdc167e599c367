#include "tets/optimize/sweeper.hpp"

#include <algorithm>
#include <cmath>

namespace temper::tets {
namespace {

// Trials per Newton step: over-relaxed, plain, then halved.
constexpr int kTrials = 6;
// A model decrease below this part of the star energy is rounding, not progress.
constexpr double kNoGain = 1e-15;
// A step goes at most this part of the way to the first tetrahedron's inversion.
constexpr double kInversionFraction = 0.9;

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

/// Fixes marked points: they are places that the user chose, such as wells. But marks of all corners of a tetrahedron
/// list the vertices of a part, and fix nothing. A tag of 0 is none.
void fix_marked_points(const TetMesh& mesh, IdVector<VertexId, Mobility>& all) {
  IdVector<VertexId, std::uint8_t> marked(mesh.n_vertices()), listed(mesh.n_vertices());
  for (const TaggedPoint& tagged : mesh.tagged_points()) marked[tagged.vertex] = tagged.tag != 0;
  for (const TetId t : mesh.tetrahedra()) {
    const auto& corners = mesh.corners(t);
    if (!std::all_of(corners.begin(), corners.end(), [&](VertexId v) { return marked[v] != 0; })) continue;
    for (const VertexId v : corners) listed[v] = 1;
  }
  for (const VertexId v : mesh.vertices()) {
    if (marked[v] != 0 && listed[v] == 0) all[v] = Mobility::weight;
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
    const HalffaceId other = mesh.twin(h);
    if (!other.valid() || mesh.region(TetMesh::tetrahedron(h)) != mesh.region(TetMesh::tetrahedron(other))) fix(h);
  }
  for (const TaggedFace& tagged : mesh.tagged_faces()) fix(tagged.face);
  for (const TaggedLine& tagged : mesh.tagged_lines()) {
    for (const VertexId v : tagged.ends) all[v] = Mobility::weight;
  }
  fix_marked_points(mesh, all);
  for (const VertexId v : mesh.vertices()) {
    if (options.keep_positions) all[v] = Mobility::weight;
    if (options.keep_weights) all[v] = all[v] == Mobility::free ? Mobility::position : Mobility::none;
  }
  return all;
}

/// Signed volumes are linear along a step.
double Sweeper::farthest(const WeightedPoint& origin, const WeightedPoint& step) const {
  double limit = 1;
  for (const LinkFace<double>& face : link_) {
    const double volume = dot(face.normal, Vector<double>{origin.x, origin.y, origin.z} - face.origin);
    const double slope = dot(face.normal, Vector<double>{step.x, step.y, step.z});
    if (volume + limit * slope < (1 - kInversionFraction) * volume) limit = -kInversionFraction * volume / slope;
  }
  return limit;
}

/// Says whether all tetrahedra with p are positive, and the predicates exact for p.
bool Sweeper::is_valid(const WeightedPoint& p, Mobility mobility) const {
  if (!is_exact_weight(p.w)) return false;
  if (mobility == Mobility::weight) return true;
  if (!is_exact_coordinate(p.x) || !is_exact_coordinate(p.y) || !is_exact_coordinate(p.z)) return false;
  return std::all_of(halffaces_.begin(), halffaces_.end(), [&](HalffaceId h) {
    const auto [q, r, s] = mesh_.vertices(h);
    return orientation(mesh_.position(q), mesh_.position(r), mesh_.position(s), p.position()) == Sign::positive;
  });
}

void Sweeper::improve(VertexId v, const Parameters& parameters) {
  if (mobility_[v] == Mobility::none) return;
  collect_link(mesh_, v, halffaces_);
  link_.clear();
  for (const HalffaceId h : halffaces_) link_.push_back(link_face(mesh_, h));
  const WeightedPoint origin = mesh_.point(v);
  const PointDerivatives<double> here = star_derivatives(link_, origin, parameters.gamma);
  if (!std::isfinite(here.value)) return;
  auto [step, predicted] = newton_step(here, mobility_[v], radius_of(link_, origin));
  if (!(predicted > kNoGain * here.value)) return;
  step = along({}, step, parameters.relaxation);
  double t = farthest(origin, step);
  for (int trial = 0; trial < kTrials; ++trial) {
    const WeightedPoint p = along(origin, step, t);
    if (star_energy(link_, p, parameters.gamma) < here.value && is_valid(p, mobility_[v])) {
      // Zero steps may still change the sign of a zero.
      mesh_.set_point(v, mobility_[v] == Mobility::weight ? WeightedPoint{origin.x, origin.y, origin.z, p.w} : p);
      return;
    }
    t *= trial == 0 && parameters.relaxation > 1 ? 1 / parameters.relaxation : 0.5;
  }
}

}  // namespace temper::tets
