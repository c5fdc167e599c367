// The manufactured solutions: in the plane functions of the frame's coordinates, of order 1 in [−1, 1]²; on the sphere
// sums of spherical harmonics, of directions.
#pragma once

#include <cstddef>
#include <string_view>

#include "temper/space.hpp"
#include "temper/verify.hpp"

namespace temper::verify_detail {

/// A place in the frame: of the plane, with z = 0, or a direction.
struct Place : Vec3 {
  constexpr Place(double px, double py, double pz = 0) : Vec3{px, py, pz} {}
  constexpr Place(Vec2 p) : Vec3{p.x, p.y, 0} {}
  constexpr Place(Vec3 p) : Vec3(p) {}
};

/// The values of a field at a point that the measures need. Vectors are tangent to the space.
struct FieldValue {
  double u = 0;
  Vec3 gradient;
  double laplacian = 0;
  Vec3 potential;  ///< with divergence u: ∫ u over a region is the flow of it out of the region
};

struct Field {
  VerifyField field;
  FieldValue (*at)(Place p);
  SpaceKind space = SpaceKind::plane;
};
[[nodiscard]] std::span<const Field> all_fields(SpaceKind space = SpaceKind::plane);

/// Root mean squares over [−1, 1]², or over the sphere, which errors are relative to: they do not depend on any mesh.
struct FieldSize {
  double value = 0;
  double gradient = 0;
};
[[nodiscard]] FieldSize size_of(const Field& field);

/// The fields that VerifyOptions::fields asks for, in the order of all_fields(), each once.
[[nodiscard]] Expected<std::vector<Field>> select_fields(const std::vector<std::string>& names,
                                                         SpaceKind space = SpaceKind::plane);

}  // namespace temper::verify_detail
