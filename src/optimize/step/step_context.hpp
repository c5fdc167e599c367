// The mesh and the settings that all steps on one working copy share.
#pragma once

#include "optimize/working/frame.hpp"
#include "optimize/options/settings.hpp"
#include "optimize/step/vertex_limits.hpp"
#include "optimize/trace/recorder.hpp"

namespace temper {

struct StepContext {
  Mesh& mesh;
  const Settings& settings;
  const SweepState& state;
  const Frame& frame;
  VertexLimits& limits;
  const Recorder& recorder;
};

}  // namespace temper
