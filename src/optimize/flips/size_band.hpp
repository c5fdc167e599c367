// The band around a size field: which steps and flips would take local sizes out of it.
//
// A vertex is in the band B when its local size is within [s/B, B s], s the field where it is. What would take a
// vertex out, or further out than it is, is not done. A step of v moves v itself in the field and changes the area of
// the stars of its neighbors (that of its own star, whose outline stays, it does not change); a flip takes a
// triangle from two vertices and gives it to two others. All in squares: no step needs a root.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "energy/patch.hpp"
#include "optimize/working/working_units.hpp"
#include "temper/detail/size.hpp"

namespace temper {

class SizeBand {
 public:
  /// The band of a mesh in the units around a field in the user's units; switched off without either of field and band.
  SizeBand(const Mesh& mesh, const WorkingUnits& units, const std::optional<SizeField>& field,
           std::optional<double> band);

  [[nodiscard]] bool on() const { return squared_band_ > 0; }

  /// Says whether the center of the patch may go from where it is to p. The field's value there is kept for moved().
  [[nodiscard]] bool allows(const Patch& patch, Vec2 p);
  /// The center of the patch that allows() was last asked about has gone there.
  void moved(VertexId v) {
    if (on()) squared_field_[v] = there_squared_, triangle_[v] = there_;
  }

  // The flips of one step: between begin_flips() and allow_flips(), about_to_flip() is told of each.
  void begin_flips() { touched_.clear(); }
  void about_to_flip(HalfedgeId h);
  [[nodiscard]] bool allow_flips() const;

  /// The mesh has been compacted, or has new vertices: its last ones.
  void renumber(const Compaction& kept);
  void grow();

 private:
  [[nodiscard]] double excess(double squared_size, double squared_field) const;
  [[nodiscard]] double excess(VertexId v) const;

  const Mesh& mesh_;
  const WorkingUnits& units_;
  std::optional<SizeField> field_;
  double squared_band_ = 0;                   // B², as squares of sizes are compared; 0: off
  IdVector<VertexId, double> squared_field_;  // in the units's units
  IdVector<VertexId, TriangleId> triangle_;   // of the field
  double there_squared_ = 0;                  // of the position asked about last
  TriangleId there_;
  std::vector<std::pair<VertexId, double>> touched_;  // by flips, with their excess before
};

}  // namespace temper
