// temper optimize of a mesh of tetrahedra.
#pragma once

#include "files/outputs.hpp"
#include "help/command.hpp"
#include "verbs/optimize_settings.hpp"

namespace temper::app {

struct TetsToOptimize {
  io::MeshFile file;
  Executor* threads = nullptr;
};

/// Reads no more, improves, writes, reports: in the words and with the exit codes of triangles. Failure (bad usage) for
/// options that have no meaning for tetrahedra.
[[nodiscard]] Exit optimize_tetrahedra(const Command& command, OptimizeSettings& settings, Outputs& outputs,
                                       TetsToOptimize tets);

}  // namespace temper::app
