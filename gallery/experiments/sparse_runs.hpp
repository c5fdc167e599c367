// Runs of Algorithm 1 on the sparse horseshoe (§6.4), where vertex 4 alone can move.
//
// Steps stop short of turning a triangle over: where p_4 meets p_1, E_T and E_∂T have a wall, and beyond it they fall
// again, so that a golden section over the whole patch radius would jump it. When weights join later, runs go on for
// a set number of sweeps: by the paper's rule positions alone have converged by then.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/energies.hpp"
#include "experiments/recording.hpp"

namespace temper::gallery {

/// Vertices of the sparse horseshoe, first visited first.
using VertexSequence = std::array<std::size_t, 5>;
inline constexpr VertexSequence kAsNumbered = {0, 1, 2, 3, 4};
/// All 120.
[[nodiscard]] std::vector<VertexSequence> all_sequences();
[[nodiscard]] std::string name(const VertexSequence& sequence);

struct SparseSetting {
  std::string_view energy = "dT";
  std::optional<int> weights_from = {};                  ///< i_w; absent: positions only
  std::optional<std::string_view> collapse_energy = {};  ///< E_c, from iteration 0; absent: no collapses
  VertexSequence sequence = kAsNumbered;
  Inversion inversion = Inversion::refuse;
  std::optional<double> length_parameter = {};  ///< γ of E_BP or −h° of E_BHs, instead of the usual
  int sweeps = 12;                              ///< at most
};

/// The mesh after one sweep, with what is asked of it.
struct SparseSweep {
  double energy = 0;
  double largest_weight = 0;  ///< |w|
  bool collapsed = false;     ///< p_4 is gone
  Vec2 p4;                    ///< where it is
  double closeness = 0;       ///< of p_4 to its nearest neighbor (closeness.hpp)
  Mesh mesh;
};

struct SparseRun {
  std::vector<SparseSweep> sweeps;  ///< [0] is the input

  [[nodiscard]] const SparseSweep& last() const { return sweeps.back(); }
  /// First sweep, counted from 1, after which p_4 is gone; 0: never.
  [[nodiscard]] int collapsed_in() const;
  /// Energy or weights left all bounds: |E| beyond any that a bounded run here has.
  [[nodiscard]] bool runs_away() const;
  [[nodiscard]] bool nearly_collapses() const;
};

[[nodiscard]] SparseRun run_sparse(const SparseSetting& setting);

/// Over vertex sequences: how runs of that setting end.
struct SequenceCount {
  std::size_t all = 0;
  std::size_t open = 0;                     ///< p_4 there, away from its neighbors
  std::size_t open_bounded = 0;             ///< of these, with finite energy and weights
  std::size_t near = 0;                     ///< nearly coincident with a neighbor
  std::size_t collapsed = 0;                ///< removed
  std::size_t collapsed_later = 0;          ///< of these, not in the first sweep
  std::optional<VertexSequence> most_open;  ///< of these, where p_4 stays furthest from its neighbors
};
/// With reduced effort, 24 of the 120 sequences.
inline constexpr std::size_t kReducedStride = 5;
/// Counts over all 120 sequences, or over each stride-th.
[[nodiscard]] SequenceCount count_sequences(const SparseSetting& setting, std::size_t stride = 1);

/// The mesh with numbered vertices; weight circles at a quarter of their radius, as in figures 13 to 15.
[[nodiscard]] std::string sparse_picture(const Mesh& mesh, const std::string& title, const std::string& footer);

}  // namespace temper::gallery
