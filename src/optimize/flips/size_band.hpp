// The band around a size field. It refuses steps and flips that would take local sizes out of it.
//
// A vertex is in the band B if its local size is within [s/B, B s], with s the field at its place. The band refuses
// each change that takes a vertex out, or further out than it is. A step of v moves v in the field and changes the
// areas of its neighbors' stars. The area of its own star, whose outline stays, does not change. A flip takes a
// triangle from two vertices and gives it to two others. All sizes are squared, so no step needs a root.
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
  /// The band of a mesh in working units, around a field in the user's units. Without a field or a `band` it is off.
  SizeBand(const Mesh& mesh, const WorkingUnits& units, const std::optional<SizeField>& field,
           std::optional<double> band);

  [[nodiscard]] bool on() const { return squared_band_ > 0; }

  /// Says whether the center of the patch may go to p. The band keeps the field's value at p for moved().
  [[nodiscard]] bool allows(const Patch& patch, Vec2 p);
  /// Call this if the center of the patch has gone to the p of the last allows().
  void moved(VertexId v) {
    if (on()) squared_field_[v] = there_squared_, triangle_[v] = there_;
  }

  // The flips of one step. Call begin_flips() first, about_to_flip() before each flip, and allow_flips() at the end.
  void begin_flips() { touched_.clear(); }
  void about_to_flip(HalfedgeId h);
  [[nodiscard]] bool allow_flips() const;

  /// Follow a compaction of the mesh, and new vertices at its end.
  void renumber(const Compaction& kept);
  void grow();

 private:
  [[nodiscard]] double excess(double squared_size, double squared_field) const;
  [[nodiscard]] double excess(VertexId v) const;

  const Mesh& mesh_;
  const WorkingUnits& units_;
  std::optional<SizeField> field_;
  double squared_band_ = 0;                   // B², since sizes are squared; 0: off
  IdVector<VertexId, double> squared_field_;  // in working units
  IdVector<VertexId, TriangleId> triangle_;   // of the field
  double there_squared_ = 0;                  // at the p of the last allows()
  TriangleId there_;
  std::vector<std::pair<VertexId, double>> touched_;  // vertices of flips, with their excess before
};

}  // namespace temper
