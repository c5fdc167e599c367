// One run of temper optimize: from the mesh that was read to the one that will be written, with all that is told of it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "files/input.hpp"
#include "options/requirement.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "verbs/optimize_settings.hpp"

namespace temper::app {

/// What a run made, apart from the mesh.
struct RunResults {
  Quality before, after;
  Mesh original;  ///< when a picture or a page needs it
  OptimizeReport report;
  std::vector<Outcome> outcomes;  ///< of --require
  bool lacks_flips = false;       ///< edges are not regular that should be
  io::DataReport data;
  std::string picture;                   ///< SVG, when asked for
  std::string errors_text, errors_json;  ///< of solvers, when asked for
  std::vector<std::string> warnings;
};

/// A trace that is being written.
struct TraceFile {
  io::TextStream stream;
  std::size_t events = 0;
};

/// All that a run works with, besides its settings. Null: there is none.
struct RunFiles {
  Executor* threads = nullptr;
  TraceFile* trace = nullptr;
};

/// Improves the mesh of the input in place: a second copy is made only when something needs one.
void improve(const OptimizeSettings& s, Input& input, RunResults& results, const RunFiles& files);

}  // namespace temper::app
