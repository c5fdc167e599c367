// One run of temper optimize: from the mesh that was read to the one that will be written, with all that is told of it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "files/input.hpp"
#include "options/requirement.hpp"
#include "temper/checkpoint.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "verbs/optimize_settings.hpp"

namespace temper::app {

/// What a run made, apart from the mesh.
struct RunResults {
  Quality before, after;
  Mesh original;  ///< when a picture, a page or --verify needs it
  OptimizeReport report;
  std::vector<Outcome> outcomes;  ///< of --require
  bool lacks_flips = false;       ///< edges are not regular that should be
  io::DataReport data;
  std::string picture;                   ///< SVG, when asked for
  std::string errors_text, errors_json;  ///< of solvers, when asked for
  std::vector<std::string> warnings;
};

/// The checkpoint that a run goes on from.
struct Resumed {
  std::string path;
  io::Checkpoint checkpoint;
};

/// A trace that is being written.
struct TraceFile {
  io::TextStream stream;
  io::CheckpointFile::TracePlace place;  ///< how far it is

  void write(std::string_view text) {
    stream.write(text);
    place.bytes += text.size();
  }
};

/// All that a run works with, besides its settings. Null: there is none.
struct RunFiles {
  Executor* threads = nullptr;
  const Resumed* resumed = nullptr;
  TraceFile* trace = nullptr;
  io::CheckpointFile* checkpoint = nullptr;
};

/// A file that the run reads: that of the checkpoint, when it is resumed; and it goes into its own.
[[nodiscard]] io::MeshFile read_file(const RunFiles& files, const std::string& path);

/// Improves the mesh of the input in place: a second copy is made only when something needs one.
void improve(const OptimizeSettings& s, Input& input, RunResults& results, const RunFiles& files);

}  // namespace temper::app
