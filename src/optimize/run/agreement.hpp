// All ranks of a run must be given the same. Otherwise each goes its own way, and waits forever.
#pragma once

#include <optional>

#include "temper/optimize.hpp"

namespace temper {

/// The error, on every rank, when one of them has another mesh, other options or another version of temper than rank 0;
/// or when some have a tracer and some have none.
[[nodiscard]] std::optional<InputError> expect_agreement(const OptimizeHooks& hooks, const OptimizeOptions& options,
                                                         const Mesh& mesh);

}  // namespace temper
