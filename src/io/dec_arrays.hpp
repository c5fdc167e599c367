// Arrays of VTU files that are computed of operators or columns.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "io/vtk_arrays.hpp"

namespace temper::io {

/// An array of doubles, or of 32-bit integers.
template <class F>
[[nodiscard]] VtkArray dual_reals(std::string name, std::size_t n, F value) {
  return computed_vtk_array<double>(std::move(name), Scalar::f64, n, std::move(value));
}
template <class F>
[[nodiscard]] VtkArray dual_integers(std::string name, std::size_t n, F value) {
  return computed_vtk_array<std::int32_t>(std::move(name), Scalar::i32, n,
                                          [value](std::size_t i) { return static_cast<std::int32_t>(value(i)); });
}
/// The types of cells that are all of one.
[[nodiscard]] inline VtkArray one_type(std::size_t n, int type) {
  return computed_vtk_array<std::uint8_t>("types", Scalar::u8, n,
                                          [type](std::size_t) { return static_cast<std::uint8_t>(type); });
}

}  // namespace temper::io
