// Places of any space as input for building a mesh.
#pragma once

#include <vector>

#include "temper/mesh.hpp"

namespace temper {

/// Points of the plane, or places on the sphere. Must outlive its input.
class InputPositions {
 public:
  explicit InputPositions(const Space& space) : space_(space) {}
  void add(Vec3 place) {
    if (space_.dimension() == 2) {
      points_.push_back({place.x, place.y});
    } else {
      places_.push_back(place);
    }
  }
  /// An input with these places, and nothing else yet.
  [[nodiscard]] MeshInput input() const {
    MeshInput input;
    input.space = space_;
    input.points = points_;
    input.sphere_points = places_;
    return input;
  }

 private:
  Space space_;
  std::vector<Vec2> points_;
  std::vector<Vec3> places_;
};

}  // namespace temper
