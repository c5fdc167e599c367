// Edges of the input that a run divides. New vertices on them are the run's own: it may slide and remove them.
#pragma once

#include "optimize/working/working_units.hpp"
#include "temper/detail/vec.hpp"

namespace temper {

/// An edge of the boundary or of a line in the input, by the places of its ends, which stay.
struct DividedEdge {
  Vec2 a, b;

  [[nodiscard]] Vec2 along() const { return b - a; }
  [[nodiscard]] Vec2 direction() const { return (1 / length(along())) * along(); }
  /// Returns the part of the way from a to b that is nearest to p.
  [[nodiscard]] double part_of(Vec2 p) const { return dot(p - a, along()) / squared_length(along()); }
  /// Returns a place at about the part t of the way, 0 < t < 1, that the user's coordinates can hold. It is exactly on
  /// the edge if t can be rounded to few bits so that nothing else is rounded, as for ends with whole coordinates.
  /// Otherwise it is on the edge up to rounding.
  [[nodiscard]] Vec2 at(double t, const WorkingUnits& units) const;
  /// Returns the place nearest to p, as at() does.
  [[nodiscard]] Vec2 nearest(Vec2 p, const WorkingUnits& units) const { return at(part_of(p), units); }
};

}  // namespace temper
