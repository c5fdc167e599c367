// The splice of a repair: what its trial did in a neighbourhood is done to the whole mesh, and traced like all else.
#pragma once

#include <span>
#include <vector>

#include "optimize/repair/neighborhood.hpp"
#include "optimize/flips/flipper.hpp"

namespace temper {

/// Applies the events of a trial on `around` to the mesh that it was taken from, which must not have changed since.
/// Removed vertices stay as isolated ones until the caller compacts. Returns the vertices of the place as it is then:
/// every triangle that has changed has its corners among them.
std::vector<VertexId> splice(WorkingCopy& work, Flipper& flipper, const Recorder& recorder, const Neighborhood& around,
                             std::span<const TraceEvent> events);

}  // namespace temper
