// What all steps on one mesh share: its limits, its settings, its units.
#pragma once

#include <cstdint>

#include "optimize/flips/guard.hpp"
#include "optimize/flips/size_band.hpp"
#include "optimize/options/settings.hpp"
#include "optimize/step/dofs.hpp"
#include "optimize/trace/recorder.hpp"
#include "optimize/working/working_copy.hpp"
#include "optimize/working/working_units.hpp"

namespace temper {

/// The limits of each vertex: mobility, size band and guard, shared by all that make steps on one mesh.
struct VertexLimits {
  VertexLimits(const WorkingCopy& work, const Settings& settings, const WorkingUnits& units)
      : mobility(mobilities(work.mesh, settings.options, settings.executor())),
        degree(work.mesh.n_vertices(), 0),
        band(work.mesh, units, settings.size_field, settings.options.size_band),
        guard(work.mesh, units, settings.guard, settings.in_copy),
        work_(work),
        mesh_(work.mesh),
        options_(settings.options) {
    if (work.divided.empty()) return;
    for (const VertexId v : mesh_.vertices()) mobility[v] = mobility_of(v, mobility[v]);
  }

  IdVector<VertexId, Mobility> mobility;
  IdVector<VertexId, std::uint8_t> degree;  ///< number of triangles when a batch last took the vertex; 0: never
  SizeBand band;                            ///< keeps its last query, so with a band only one step runs at a time
  Guard guard;                              ///< of which each step has a copy

  /// Fixes the position and weight of v.
  void freeze(VertexId v) { mobility[v] = Mobility::frozen; }
  /// Follows a compaction of the mesh.
  void renumber(const Compaction& kept) {
    mobility = kept_of(mobility, kept.vertices);
    degree.resize(mobility.size());
    band.renumber(kept);
    guard.renumber(kept);
  }
  /// Follows insertions and splits: new vertices are the last vertices of the mesh.
  void grow() {
    for (std::size_t i = mobility.size(); i < mesh_.n_vertices(); ++i) {
      mobility.push_back(mobility_of(VertexId(i), temper::mobility(mesh_, VertexId(i), options_)));
    }
    degree.resize(mobility.size());
    band.grow();
    guard.grow();
  }

  /// Returns the divided edge along which v slides, if v is a vertex of the run.
  [[nodiscard]] const DividedEdge* divided_edge(VertexId v) const {
    return mobility[v] == Mobility::sliding ? work_.divided_edge(v) : nullptr;
  }

 private:
  /// The run's own vertices on lines slide, whatever the options say about the vertices of the input.
  [[nodiscard]] Mobility mobility_of(VertexId v, Mobility of_input) const {
    return work_.divided_edge(v) != nullptr ? Mobility::sliding : of_input;
  }

  const WorkingCopy& work_;
  const Mesh& mesh_;
  const OptimizeOptions& options_;
};

/// The mesh and the settings that all steps on one working copy share.
struct StepContext {
  Mesh& mesh;
  const Settings& settings;
  const SweepState& state;
  const WorkingUnits& units;
  VertexLimits& limits;
  const Recorder& recorder;
};

}  // namespace temper
