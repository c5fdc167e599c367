// Ranks that make a run together must be given the same: each would go its own way otherwise, and wait for ever.
#pragma once

#include <optional>

#include "temper/optimize.hpp"

namespace temper {

/// The error, on every rank, when one of them has other options, another mesh or another state to resume than rank 0,
/// or another build of temper; or when some are traced and some are not.
[[nodiscard]] std::optional<InputError> expect_agreement(const OptimizeHooks& hooks, const OptimizeOptions& options,
                                                         const Mesh& mesh);

}  // namespace temper
