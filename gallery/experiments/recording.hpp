// A run of optimize() with everything that can be seen of it: the mesh at each moment, and each event.
#pragma once

#include <string>
#include <vector>

#include "temper/detail/trace.hpp"
#include "temper/mesh.hpp"
#include "temper/optimize.hpp"

namespace temper::gallery {

/// A Snapshot to keep.
struct Moment {
  Snapshot::Moment kind = Snapshot::Moment::start;
  int sweep = 0;
  int outer = 0;
  double energy = 0;
  Mesh mesh;
  IdVector<VertexId, VertexId> vertices;  ///< number in the input of each vertex

  /// The vertex with that number in the input, or an invalid id when it has been removed.
  [[nodiscard]] VertexId find(VertexId input) const;
};

/// Triangles of one mesh that the other has not, compared by the input's numbers of their corners.
[[nodiscard]] std::vector<TriangleId> triangles_not_in(const Moment& one, const Moment& other);

struct Recording {
  std::vector<Moment> moments;
  std::vector<TraceEvent> events;
  OptimizeReport report;
  Mesh result;        ///< what optimize() gave back: the best mesh of the run
  std::string error;  ///< why there was no run; else empty

  /// The moments of one kind, in order.
  [[nodiscard]] std::vector<const Moment*> all(Snapshot::Moment kind) const;
  /// The moment at which an iteration, counted from 0, begins: before flips when it follows some.
  [[nodiscard]] const Moment& begin_of(int iteration) const;
};

/// The meshes that are kept of a run: those between outer iterations, or also those after each sweep.
enum class Keep { outer, sweeps };

/// CannotBeMade: optimize() refuses the options, as the reading has them.
[[nodiscard]] Recording record(const Mesh& start, const OptimizeOptions& options, Keep keep);

}  // namespace temper::gallery
