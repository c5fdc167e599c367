// Every energy with every way of removing vertices, with and without weights, on the dense horseshoe: how the runs of
// Algorithm 1 end (figure 32).
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/patch_test.hpp"
#include "gallery.hpp"
#include "temper/optimize.hpp"

namespace temper::gallery {

/// The ends that a run may have, the worst first.
enum class Verdict {
  mess,       ///< inverted triangles, or an energy a thousand times the input's: a HOT mess
  hidden,     ///< regular only without some vertices
  collapsed,  ///< nearly coincident vertices
  good,
};
inline constexpr std::size_t kVerdicts = 4;
[[nodiscard]] std::string_view name(Verdict verdict);

/// The mesh at the end of a run, whatever optimize() would give back.
struct Ending {
  Verdict verdict = Verdict::good;
  Mesh mesh;
  std::size_t inverted = 0, non_regular = 0, coincident = 0;
  double energy = 0;
  double well_centered = 0;
};

struct Cell {
  std::string_view energy;
  Unknowns unknowns = Unknowns::positions;
  RemovalRule rule = RemovalRule::none;
  std::vector<Ending> endings;  ///< one a vertex order; the first as numbered

  [[nodiscard]] std::size_t count(Verdict verdict) const;
  /// The verdict on most runs; the worse of two that are as frequent.
  [[nodiscard]] Verdict verdict() const;
};

/// 5 energies × {positions, positions and weights} × {no removal, short edges, patch test}, in this order; flips
/// deferred, weights from iteration 0, a few outer iterations. Of ★0 and ★2 two vertex orders and fewer sweeps, as many
/// as tell their ends.
struct Matrix {
  std::vector<Cell> cells;
  [[nodiscard]] const Cell& at(std::string_view energy, Unknowns unknowns, RemovalRule rule) const;
};
[[nodiscard]] const Matrix& summary_matrix(Effort effort, Inversion inversion, Star star = Star::one);

/// One cell again, hidden vertices treated by another policy.
[[nodiscard]] std::vector<Ending> endings(std::string_view energy, Unknowns unknowns, RemovalRule rule,
                                          HiddenPolicy hidden, Effort effort);

inline constexpr std::array<Unknowns, 2> kUnknowns = {Unknowns::positions, Unknowns::positions_and_weights};
inline constexpr std::array<RemovalRule, 3> kRules = {RemovalRule::none, RemovalRule::short_edge, RemovalRule::patch};

}  // namespace temper::gallery
