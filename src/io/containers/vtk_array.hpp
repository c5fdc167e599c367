// An array that is written block by block.
#pragma once

#include <cstring>
#include <functional>
#include <string>

#include "io/text/values.hpp"

namespace temper::io {

inline constexpr std::size_t kVtkBlockBytes = std::size_t{1} << 18;  ///< of an array, made at a time
/// One array to be written: `fill` puts the bytes of its values first … first + n − 1 to a buffer.
struct VtkArray {
  std::string name;
  Scalar scalar = Scalar::f64;
  int components = 1;
  std::size_t n_values = 0;
  std::function<void(std::size_t first, std::size_t n, char* to)> fill;

  [[nodiscard]] std::size_t bytes() const { return n_values * info(scalar).bytes; }
};

/// The array of value(i), of type T, for each i.
template <class T, class F>
[[nodiscard]] VtkArray computed_vtk_array(std::string name, Scalar scalar, std::size_t n_values, F value,
                                          int components = 1) {
  return {std::move(name), scalar, components, n_values, [value](std::size_t first, std::size_t n, char* to) {
            for (std::size_t i = 0; i < n; ++i) {
              const T v = value(first + i);
              std::memcpy(to + i * sizeof(T), &v, sizeof(T));
            }
          }};
}

}  // namespace temper::io
