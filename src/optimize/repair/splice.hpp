// The splice of a repair: what its trial did in a neighbourhood is done to the whole mesh, and traced like all else.
#pragma once

#include <span>

#include "optimize/repair/neighborhood.hpp"
#include "optimize/step/flipper.hpp"

namespace temper {

/// Applies the events of a trial on `around` to the mesh that it was taken from, which must not have changed since.
/// Removed vertices stay as isolated ones until the caller compacts.
void splice(WorkingCopy& work, Flipper& flipper, const Recorder& recorder, const Neighborhood& around,
            std::span<const TraceEvent> events);

}  // namespace temper
