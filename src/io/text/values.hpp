// The ten number types of Values: their names in VTU and legacy VTK, and operations on arrays of any of them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "io/text/file_names.hpp"
#include "temper/io.hpp"

namespace temper::io {

/// The index of a type in Values.
enum class Scalar : std::size_t { f64, f32, i64, i32, u8, i8, i16, u16, u32, u64 };

struct ScalarInfo {
  Scalar scalar;
  std::string_view vtu;   ///< "Float64"
  std::string_view text;  ///< "float64": in messages and in Triangle's comments
  std::size_t bytes;
};
[[nodiscard]] const ScalarInfo& info(Scalar scalar);
[[nodiscard]] std::optional<Scalar> scalar_of_vtu(std::string_view name);
[[nodiscard]] std::optional<Scalar> scalar_of_text(std::string_view name);

[[nodiscard]] inline Scalar scalar_of(const Values& values) { return static_cast<Scalar>(values.index()); }
[[nodiscard]] inline std::string_view type_name(const Values& values) { return info(scalar_of(values)).text; }
[[nodiscard]] std::size_t size(const Values& values);
[[nodiscard]] inline bool is_floating(const Values& values) { return scalar_of(values) <= Scalar::f32; }

/// Calls `f` with a default value of the type; all calls return the same type.
template <std::size_t I = 0, class F>
decltype(auto) with_scalar(Scalar scalar, F&& f) {
  if constexpr (I + 1 < std::variant_size_v<Values>) {
    if (scalar != static_cast<Scalar>(I)) return with_scalar<I + 1>(scalar, std::forward<F>(f));
  }
  return f(typename std::variant_alternative_t<I, Values>::value_type());
}

template <class Vector>
using ElementOf = typename std::remove_cvref_t<Vector>::value_type;

/// Says whether all values are numbers, neither infinite nor NaN.
[[nodiscard]] bool is_finite(const Values& values);
[[nodiscard]] Values zeros(Scalar scalar, std::size_t n);
/// The values as doubles; moved when they are doubles already.
[[nodiscard]] std::vector<double> to_doubles(Values&& values);
/// The values as 32-bit integers, or nothing when one of them is none.
[[nodiscard]] std::optional<std::vector<std::int32_t>> to_int32(const Values& values);
/// The values as 64-bit integers, moved when they are such already; or nothing when one of them is none.
[[nodiscard]] std::optional<std::vector<std::int64_t>> to_int64(Values&& values);
/// The tuples at the indices (runs of a longer array).
[[nodiscard]] Values gather(const Values& values, int components, const RunLength& indices);
/// Appends `more`, which must be of the same type.
void append(Values& values, const Values& more);

/// The corners of a cell, from a line to a tetrahedron, or of a point.
template <std::size_t n>
[[nodiscard]] std::span<std::int32_t, n> corners_of(std::array<std::int32_t, n>& cell) {
  return cell;
}
template <std::size_t n>
[[nodiscard]] std::span<const std::int32_t, n> corners_of(const std::array<std::int32_t, n>& cell) {
  return cell;
}
[[nodiscard]] inline std::span<std::int32_t, 1> corners_of(std::int32_t& point) {
  return std::span<std::int32_t, 1>(&point, 1);
}
[[nodiscard]] inline std::span<const std::int32_t, 1> corners_of(const std::int32_t& point) {
  return std::span<const std::int32_t, 1>(&point, 1);
}
/// All lists of arrays of a file.
template <class File>
[[nodiscard]] auto all_data(File& file) {
  return std::array{&file.point_data, &file.tetrahedra.data,    &file.triangles.data,
                    &file.lines.data, &file.marked_points.data, &file.field_data};
}
/// The array of that name, or null.
[[nodiscard]] const DataArray* find(const std::vector<DataArray>& arrays, std::string_view name);
/// A lookup for many names: each costs O(log n).
class ArraysByName {
 public:
  explicit ArraysByName(const std::vector<DataArray>& arrays) {
    for (const DataArray& a : arrays) first_.emplace(a.name, &a);
  }
  [[nodiscard]] const DataArray* find(std::string_view name) const {
    const auto it = first_.find(name);
    return it == first_.end() ? nullptr : it->second;
  }

 private:
  std::map<std::string_view, const DataArray*> first_;
};
/// Removes the array of that name and returns it.
[[nodiscard]] std::optional<DataArray> take(std::vector<DataArray>& arrays, std::string_view name);

}  // namespace temper::io
