// The rank of a mesh among those that a run comes to: which one it returns.
#pragma once

#include <compare>
#include <cstddef>
#include <vector>

#include "energy/accuracy_energy.hpp"
#include "optimize/settings.hpp"

namespace temper {

/// Validity comes first, then regularity, but for hidden vertices that the user keeps; for a barrier, which is there to
/// make triangles well-centered, their number; for the accuracy objective its margins, which its second phase keeps,
/// and lengths where they are asked for; then the energy.
struct Rank {
  std::size_t inverted = 0, non_regular = 0, bad = 0;
  bool lacks_margins = false;
  double missing_lengths = 0;  ///< of those asked for (lengths.hpp)
  double energy = 0;
  friend auto operator<=>(const Rank&, const Rank&) = default;
};

/// What is counted for a rank, whatever the energy.
struct Counts {
  std::size_t inverted = 0;  ///< none are looked for unless they are allowed
  std::size_t non_regular = 0, bad = 0;
};
[[nodiscard]] Counts count(const Mesh& mesh, const Settings& settings);

/// The rank by the energy of the settings, in the units of their model; with the sizes at its vertices by that of the
/// accuracy objective.
[[nodiscard]] Rank rank(const Mesh& mesh, const Settings& settings, const VertexSizes* sizes = nullptr);
/// The same of a mesh where all has been counted.
[[nodiscard]] Rank rank(const Mesh& mesh, const Counts& counts, const Settings& settings, const VertexSizes* sizes);

/// The root of the geometric mean of the schemes' squared errors; +∞ where there are none.
[[nodiscard]] double root_mean_square(const std::vector<double>& squared_errors);

}  // namespace temper
