// From a mesh to its flat picture: the plane as it is, or a sphere seen from far away, of which the near half shows.
//
// A sphere is projected along parallel lines: a disc of its radius, north up. Arcs become chains of segments too short
// to tell from curves, and end at the limb.
//
//        .-- y --.
//      /     ^     \      the picture: x and y, in the unit of length of the mesh;
//     |      +-> x  |     z: towards the viewer, in parts of the radius; what has z < 0 is behind the limb
//      \           /
//        '-------'  limb
#pragma once

#include <array>
#include <span>
#include <vector>

#include "temper/draw.hpp"
#include "temper/mesh.hpp"

namespace temper {

class View {
 public:
  /// Of the plane.
  View() = default;
  /// Of a sphere: longitude and latitude of the middle of the picture [degrees].
  View(double radius, Vec2 middle);

  /// Of the plane, as it is.
  [[nodiscard]] bool is_flat() const { return radius_ == 0; }
  /// Of the disc that a sphere is; 0 of the plane.
  [[nodiscard]] double radius() const { return radius_; }

  // Points are those of the mesh's space: of the sphere only the direction counts.

  /// The place of a point in the picture.
  [[nodiscard]] Vec2 at(const WeightedPoint& p) const;
  /// Says whether a point is not behind the limb.
  [[nodiscard]] bool shows(const WeightedPoint& p) const;
  /// What is seen of the edge from p to q: a chain of points, empty when it is behind the limb.
  [[nodiscard]] std::vector<Vec2> line(const WeightedPoint& p, const WeightedPoint& q) const;
  /// What is seen of a triangle: a polygon, empty when it is behind the limb.
  [[nodiscard]] std::vector<Vec2> polygon(const std::array<WeightedPoint, 3>& triangle) const;
  /// Points around one of the sphere, whose arcs are a circle of this radius [length]. Precondition: a sphere.
  [[nodiscard]] std::vector<WeightedPoint> circle(const WeightedPoint& p, double radius) const;

 private:
  [[nodiscard]] Vec3 seen(const WeightedPoint& p) const;
  void add_arc(std::vector<Vec2>& chain, Vec3 a, Vec3 b) const;

  double radius_ = 0;
  Vec3 right_, up_, towards_;
};

/// The view of meshes of one space that the options ask for; by default on the middle of a mesh that is a part of the
/// sphere, else on 0° E, 0° N.
[[nodiscard]] View make_view(std::span<const Mesh* const> meshes, const DrawOptions& options);

}  // namespace temper
