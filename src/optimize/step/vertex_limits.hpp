// The limits of each vertex: mobility and size band, shared by all that make steps on one mesh.
#pragma once

#include <cstdint>

#include "optimize/flips/size_band.hpp"
#include "optimize/options/settings.hpp"
#include "optimize/step/freedom.hpp"
#include "optimize/trace/recorder.hpp"
#include "optimize/working/frame.hpp"
#include "optimize/working/working_copy.hpp"

namespace temper {

struct VertexLimits {
  VertexLimits(const Mesh& mesh, const Settings& settings, const Frame& frame)
      : mobility(mobilities(mesh, settings.options, settings.executor())),
        degree(mesh.n_vertices(), 0),
        band(mesh, frame, settings.size_field, settings.options.size_band),
        mesh_(mesh),
        options_(settings.options) {}

  IdVector<VertexId, Mobility> mobility;
  IdVector<VertexId, std::uint8_t> degree;  ///< triangles there were when a batch took the vertex last; 0: never
  SizeBand band;  ///< keeps what it was asked about last: with a band, only one step at a time

  /// v stays, weight and all.
  void freeze(VertexId v) { mobility[v] = Mobility::frozen; }
  /// The mesh has been compacted.
  void renumber(const Compaction& kept) {
    mobility = kept_of(mobility, kept.vertices);
    degree.resize(mobility.size());
    band.renumber(kept);
  }
  /// Vertices have been inserted, or edges split: new vertices are the last ones of the mesh.
  void grow() {
    for (std::size_t i = mobility.size(); i < mesh_.n_vertices(); ++i) {
      mobility.push_back(temper::mobility(mesh_, VertexId(i), options_));
    }
    degree.resize(mobility.size());
    band.grow();
  }

 private:
  const Mesh& mesh_;
  const OptimizeOptions& options_;
};

// The mesh and the settings that all steps on one working copy share.

struct StepContext {
  Mesh& mesh;
  const Settings& settings;
  const SweepState& state;
  const Frame& frame;
  VertexLimits& limits;
  const Recorder& recorder;
};

}  // namespace temper
