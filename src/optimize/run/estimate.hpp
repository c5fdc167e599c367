// How long a run may still take: an extrapolation of its last sweeps.
#pragma once

#include <optional>
#include <span>

#include "temper/optimize.hpp"

namespace temper {

/// The sweeps until the gain of one is below the tolerance, if gains go on shrinking by one factor a sweep, as sweeps
/// for barriers do near their end. None where that cannot be told: in the first sweeps of a stage (one objective, one
/// γ), where the energy rises or gains do not shrink, and with StoppingRule::paper. Stages that may follow are not
/// known yet.
[[nodiscard]] std::optional<double> estimate_sweeps_left(std::span<const SweepRecord> history,
                                                         const OptimizeOptions& options);

}  // namespace temper
