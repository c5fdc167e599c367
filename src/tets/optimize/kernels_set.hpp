// Included by one source for each instruction set, compiled for that set.
#pragma once

#include <cmath>
#include <cstddef>
#include <new>

#include "geometry/predicates_inline.hpp"
#include "tets/optimize/kernels.hpp"

namespace temper::TEMPER_INSTRUCTION_SET {
namespace {

using tets::Link;
using tets::LinkLanes;
using tets::Mobility;
using tets::PointDerivatives;
using tets::StarStep;
using tets::WeightedPoint;
using Mask = Pack::Mask;
using Point = tets::PointVector<Pack>;
using Face = tets::LinkFace<Pack>;
using Apex = tets::Apex<Pack>;
static_assert(sizeof(Face) == sizeof(LinkLanes::face) && alignof(Face) <= alignof(LinkLanes));

// Trials per Newton step: over-relaxed, plain, then halved.
constexpr int kTrials = 6;
// A model decrease below this part of the star energy is rounding, not progress.
constexpr double kNoGain = 1e-15;
// A step goes at most this part of the way to the first tetrahedron's inversion.
constexpr double kInversionFraction = 0.9;

// A step may not lower the shape of a tetrahedron, its volume over (Σ length²)^(3/2), below this part of the regular
// one's; a worse shape may not fall at all. Else heights that no place makes positive would flatten the tetrahedra.
constexpr double kLeastShape = 0.1;
constexpr double kRegularShape = 0.048112522432468816;  // 1/√432: six volumes, 1/√2, over 6^(3/2)

constexpr tets::Lane kNumbers = {0, 1, 2, 3, 4, 5, 6, 7};
constexpr unsigned kAllLanes = (1U << kLanes) - 1;

TEMPER_INLINE Point load(const tets::LanePoints& p) { return tets::load<Pack>(p); }
TEMPER_INLINE Point in_all_lanes(const WeightedPoint& p) {
  return {{Pack::all(p.x), Pack::all(p.y), Pack::all(p.z)}, Pack::all(p.w)};
}
TEMPER_INLINE std::size_t n_blocks(const Link& link) { return (link.faces + kLanes - 1) / kLanes; }
/// The lanes of block b that have a face.
TEMPER_INLINE Mask lanes_in_use(const Link& link, std::size_t b) {
  return Pack::load(kNumbers) < static_cast<double>(link.faces - b * kLanes);
}
TEMPER_INLINE const Face& face_of(const LinkLanes& lanes) {
  return *std::launder(reinterpret_cast<const Face*>(lanes.face));
}

/// The same structure of f of each number.
template <class T, class F>
TEMPER_INLINE PointDerivatives<T> map(const PointDerivatives<Pack>& d, const F& f) {
  const auto& [xx, xy, xz, xw, yy, yz, yw, zz, zw, ww] = d.hessian;
  const auto& [at, w] = d.gradient;
  return {f(d.value),
          {{f(at.x), f(at.y), f(at.z)}, f(w)},
          {f(xx), f(xy), f(xz), f(xw), f(yy), f(yz), f(yw), f(zz), f(zw), f(ww)}};
}

TEMPER_INLINE Pack power_3_2(Pack x) { return x * square_root(x); }

/// Derivatives of a star, and the sum of its squared spokes, each as often as tetrahedra have it.
struct Around {
  PointDerivatives<double> derivatives;
  double spokes2;
};
TEMPER_INLINE Around look_around(const Link& link, const WeightedPoint& p, double gamma) {
  const Point center = in_all_lanes(p);
  PointDerivatives<Pack> sums = {};
  Pack spokes2 = {};
  for (std::size_t b = 0; b < n_blocks(link); ++b) {
    LinkLanes& lanes = link.blocks[b];
    const Mask used = lanes_in_use(link, b);
    const auto if_used = [used](const Pack& x) { return select(used, x, Pack::all(0)); };
    const Face& face = *new (lanes.face) Face(tets::link_face_of(load(lanes.q), load(lanes.r), load(lanes.s)));
    const Apex apex(face, center.at, center.w);
    (apex.volume6 / power_3_2(apex.length2)).store(lanes.shape);
    spokes2 = spokes2 + if_used(apex.length2 - face.length2);
    sums += map<Pack>(tets::tet_derivatives(face, apex, Pack::all(gamma)), if_used);
  }
  return {map<double>(sums, [](const Pack& x) { return sum(x); }), sum(spokes2)};
}

PointDerivatives<double> derivatives(const Link& link, const WeightedPoint& p, double gamma) {
  return look_around(link, p, gamma).derivatives;
}

/// Returns the part of a step before the first tetrahedron is nearly flat. Signed volumes are linear along a step.
TEMPER_INLINE double farthest(const Link& link, const WeightedPoint& origin, const WeightedPoint& step) {
  const Point from = in_all_lanes(origin), along = in_all_lanes(step);
  Pack limits = Pack::all(1);
  for (std::size_t b = 0; b < n_blocks(link); ++b) {
    const Face& face = face_of(link.blocks[b]);
    const Pack slope = dot(face.normal, along.at);
    const Pack limit = -kInversionFraction * dot(face.normal, from.at - face.origin) / slope;
    limits = select((slope < 0) & (limit < limits), limit, limits);
  }
  tets::Lane all;
  limits.store(all);
  double least = 1;
  for (const double limit : all) least = limit < least ? limit : least;
  return least;
}

/// Says whether the energy at p is less, and shapes are kept.
TEMPER_INLINE bool is_better(const Link& link, const WeightedPoint& p, double gamma, double value) {
  constexpr double kLeast = kLeastShape * kRegularShape;
  const Point center = in_all_lanes(p);
  Pack sums = Pack::all(0);
  for (std::size_t b = 0; b < n_blocks(link); ++b) {
    const LinkLanes& lanes = link.blocks[b];
    const Face& face = face_of(lanes);
    const Apex apex(face, center.at, center.w);
    const Pack before = Pack::load(lanes.shape), needed = select(before < kLeast, before, Pack::all(kLeast));
    if ((apex.volume6 >= needed * power_3_2(apex.length2)).bits() != kAllLanes) return false;
    const Pack energies = tets::tet_energy(face, apex, Pack::all(gamma));
    sums = sums + select(lanes_in_use(link, b), energies, Pack::all(0));
    if (!(sum(sums) < value)) return false;
  }
  return true;
}

/// Says whether the tetrahedra with p are positive, beyond doubt by rounding.
TEMPER_INLINE bool is_certainly_positive(const Link& link, const WeightedPoint& p) {
  const Point center = in_all_lanes(p);
  for (std::size_t b = 0; b < n_blocks(link); ++b) {
    const LinkLanes& lanes = link.blocks[b];
    const auto test = inlined::filtered_power_test(load(lanes.q).at, load(lanes.r).at, load(lanes.s).at, center.at);
    if ((test.value > test.bound).bits() != kAllLanes) return false;
  }
  return true;
}

bool keeps_angles(const Link& link, const WeightedPoint& from, const WeightedPoint& to, double most_cosine) {
  const Point before = in_all_lanes(from), now = in_all_lanes(to);
  for (std::size_t b = 0; b < n_blocks(link); ++b) {
    const LinkLanes& lanes = link.blocks[b];
    const auto q = load(lanes.q).at, r = load(lanes.r).at, s = load(lanes.s).at;
    const Pack cosine = tets::largest_dihedral_cosine(q, r, s, now.at);
    const Mask kept = Pack::all(most_cosine) >= cosine;
    if (kept.bits() == kAllLanes) continue;
    if ((kept | (tets::largest_dihedral_cosine(q, r, s, before.at) >= cosine)).bits() != kAllLanes) return false;
  }
  return true;
}

StarStep step(const Link& link, const WeightedPoint& origin, const Mobility& mobility,
              const tets::SweepParameters& parameters) {
  const auto [here, spokes2] = look_around(link, origin, parameters.gamma);
  if (!(here.value < HUGE_VAL)) return {};
  const double radius = square_root(spokes2 / (3 * static_cast<double>(link.faces)));
  const auto [newton, predicted] = tets::newton_step(here, mobility, radius);
  if (!(predicted > kNoGain * here.value)) return {};
  const double by = parameters.relaxation;
  const WeightedPoint along = {by * newton.x, by * newton.y, by * newton.z, by * newton.w};
  const bool moves = mobility.dimensions > 0;
  double t = farthest(link, origin, along);
  for (int trial = 0; trial < kTrials; ++trial) {
    WeightedPoint p = {origin.x, origin.y, origin.z, origin.w + t * along.w};
    if (moves) p.x += t * along.x, p.y += t * along.y, p.z += t * along.z;
    if (is_better(link, p, parameters.gamma, here.value)) return {p, true, !moves || is_certainly_positive(link, p)};
    t *= trial == 0 && by > 1 ? 1 / by : 0.5;
  }
  return {};
}

/// Adds what the height over the face of the first three corners says.
TEMPER_INLINE void judge_height(const Point (&at)[4], const std::size_t (&corners)[4], Mask& inside, Mask& outside) {
  struct Coordinates {
    Pack x, y, z, w;
  };
  const auto of = [&](std::size_t i) { return Coordinates{at[i].at.x, at[i].at.y, at[i].at.z, at[i].w}; };
  const auto height =
      tets::height_polynomial<tets::EstimateOf<Pack>>(of(corners[0]), of(corners[1]), of(corners[2]), of(corners[3]));
  const Pack bound = tets::kHeightBound * height.permanent;
  inside = inside & (height.value > bound);
  outside = outside | (height.value < -bound);
}

tets::Certainty tetrahedra(const tets::TetLanes& tetrahedra, double gamma, tets::Lane& energies) {
  const auto& c = tetrahedra.corners;
  const Point at[4] = {load(c[0]), load(c[1]), load(c[2]), load(c[3])};
  const Face face = tets::link_face_of(at[0], at[1], at[2]);
  tets::tet_energy(face, at[3].at, at[3].w, Pack::all(gamma)).store(energies);
  Mask inside = face.length2 >= 0, outside = ~inside;
  judge_height(at, {0, 1, 2, 3}, inside, outside);
  judge_height(at, {0, 3, 1, 2}, inside, outside);
  judge_height(at, {0, 2, 3, 1}, inside, outside);
  judge_height(at, {1, 3, 2, 0}, inside, outside);
  return {inside.bits(), outside.bits()};
}

}  // namespace

const tets::Kernels kTetKernels = {derivatives, step, keeps_angles, tetrahedra};

}  // namespace temper::TEMPER_INSTRUCTION_SET
