#include "optimize/run/schedule.hpp"

#include <algorithm>
#include <array>

#include "energy/whole_mesh.hpp"
#include "geometry/triangle_kernel.hpp"
#include "optimize/step/ties.hpp"

namespace temper {
namespace {

// So small that the least h/ℓ of a converged mesh agrees to three digits with the hard barrier's.
constexpr double kFloor = 0.003;
// On the 7 × 9 horseshoe the first restart leaves 30 triangles bad, and this one 5. On 33 × 25 they leave 6 and 0.
constexpr Restart kThorough = {
    .start = 2, .factor = 0.5, .relaxation = kRelaxation, .level_sweeps = 30, .level_fall = 1e-4, .jitter = 0.02};
// kFar is for meshes that must change nearly everywhere, also in connectivity; kNear if only a few triangles must.
constexpr Restart kFar = {.start = 1, .factor = 0.5, .relaxation = 1.97, .until_good = true};
constexpr Restart kNear = {.start = 0.5, .factor = 0.7, .relaxation = kRelaxation, .until_good = true};
constexpr std::array<Restart, 2> kManyBad = {kFar, kThorough};
constexpr std::array<Restart, 2> kFewBad = {kNear, kThorough};
// At 0 ties stay; at 1 the dual no longer crosses the shortest edge of a vertex. In a strip of squares this value moves
// the orthocenters a quarter of the way from the diagonal to the opposite side of their triangle.
constexpr double kTieWeight = 0.25;
constexpr Restart with_ties(Restart restart) {
  restart.tie_weight = kTieWeight;
  return restart;
}
// Along a row of ties weights grow from its ends, some triangles per sweep. A restart that chooses their diagonals is
// faster, so this one gives up early.
constexpr double kManyFewer = 0.75;
constexpr Restart without_ties(Restart restart) {
  restart.fewer = kManyFewer;
  return restart;
}
// The restarts for meshes with ties that cannot move.
constexpr std::array<Restart, 3> kManyBadAndTied = {without_ties(kFar), with_ties(kFar), with_ties(kThorough)};
constexpr std::array<Restart, 3> kFewBadAndTied = {without_ties(kNear), with_ties(kNear), with_ties(kThorough)};
constexpr double kMany = 0.25;  // part of the triangles
// Fewer bad triangles make too few flips for kFar to pay; the result is luck.
constexpr std::size_t kLeastMany = 100;

// For meshes that are well-centered already, and energies that nothing softens.
constexpr std::array<Restart, 1> kHard = {{{.start = kFloor, .relaxation = kRelaxation}}};
// −h°/ℓ stays this factor beyond the worst h/ℓ of the mesh, so that every term is finite.
constexpr double kBeyondWorst = 1.25;
// A relative change of h° that moves no minimum by more than rounding in a picture.
constexpr double kSettledShift = 0.01;

/// Returns the least h/ℓ over all edges of all triangles.
double least_relative_height(const Mesh& mesh) {
  double least = 1;
  for (const TriangleId t : mesh.triangles()) {
    const auto [p, q, r] = mesh.points(t);
    for (const EdgeShape& e : triangle_shape(mesh.space(), p, q, r).edges) {
      least = std::min(least, e.g / e.l2);
    }
  }
  return least;
}

double least_shift(const Mesh& mesh) { return std::max(kFloor, -kBeyondWorst * least_relative_height(mesh)); }

}  // namespace

const Restart kPolish = kHard.front();
const Restart kNearlyGood = kNear;

std::span<const Restart> restarts(const Settings& settings, const Mesh& mesh) {
  const bool softens = settings.energy().softened_by_gamma && !settings.policy.gamma;
  if (!softens || least_relative_height(mesh) > 0) return kHard;
  const std::size_t n = mesh.n_triangles();
  const auto bad = static_cast<double>(count_bad(mesh, settings.executor()));
  const bool many = n >= kLeastMany && bad >= kMany * static_cast<double>(n);
  if (has_tied_quads(mesh, settings.options)) return many ? kManyBadAndTied : kFewBadAndTied;
  return many ? kManyBad : kFewBad;
}

void GammaSchedule::start(const Mesh& mesh, EnergyModel& model) {
  if (gamma_shrinks_) model.gamma = {restart_.start, LengthScale::relative};
  if (h0_shrinks_) model.h0 = {least_shift(mesh), LengthScale::relative};
  settled_ = !h0_shrinks_ && (!gamma_shrinks_ || model.gamma.value <= kFloor);
}

bool GammaSchedule::advance(const Mesh& mesh, double fall, std::size_t bad, EnergyModel& model) {
  if (settled_) return false;
  if (h0_shrinks_) {
    constexpr double kFactor = 0.7;
    const double last = model.h0.value;
    model.h0.value = std::min(last, std::max(kFactor * last, least_shift(mesh)));
    settled_ = model.h0.value >= (1 - kSettledShift) * last;
    return true;
  }
  const bool last = restart_.until_good && bad == 0;
  if (!last && ++sweeps_at_level_ < restart_.level_sweeps && fall > restart_.level_fall) return false;
  sweeps_at_level_ = 0;
  model.gamma.value = last ? kFloor : std::max(kFloor, restart_.factor * model.gamma.value);
  settled_ = model.gamma.value <= kFloor;
  return true;
}

}  // namespace temper
