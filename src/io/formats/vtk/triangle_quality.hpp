// How well-centered each triangle is, as cell data of VTU and VTKHDF: made anew by every writing, and not a part of
// what was read.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "io/formats/vtk/vtk_arrays.hpp"

namespace temper::io {

/// One of the arrays: named as in Quality, of floats, which are enough for colours and half of what doubles take.
struct TriangleQualityArray {
  std::string_view name;
  Scalar scalar;
};
inline constexpr std::array<TriangleQualityArray, 4> kTriangleQuality = {{
    {"well_centered", Scalar::u8},
    {"min_h_over_l", Scalar::f32},
    {"min_d_over_l", Scalar::f32},
    {"min_angle_deg", Scalar::f32},
}};

struct TypeOfArray {
  Scalar scalar;
  int components;
};
/// Says whether the arrays are among cell data of these types, nothing being that of an array that is not there. They
/// come together: one of their names alone is the user's.
[[nodiscard]] bool has_triangle_quality(
    const std::function<std::optional<TypeOfArray>(std::string_view name)>& type_of);

/// The arrays of a mesh; zeros for lines and marked points. None where there are no triangles, lengths are unknown,
/// points being degrees, or data of the file have one of the names, which a warning says.
[[nodiscard]] std::vector<VtkArray> vtk_triangle_quality(const WriteJob& job);

}  // namespace temper::io
