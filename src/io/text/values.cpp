#include "io/text/values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "io/text/failure.hpp"

namespace temper::io {
namespace {

constexpr std::array<ScalarInfo, 10> kScalars = {{{Scalar::f64, "Float64", "float64", 8},
                                                  {Scalar::f32, "Float32", "float32", 4},
                                                  {Scalar::i64, "Int64", "int64", 8},
                                                  {Scalar::i32, "Int32", "int32", 4},
                                                  {Scalar::u8, "UInt8", "uint8", 1},
                                                  {Scalar::i8, "Int8", "int8", 1},
                                                  {Scalar::i16, "Int16", "int16", 2},
                                                  {Scalar::u16, "UInt16", "uint16", 2},
                                                  {Scalar::u32, "UInt32", "uint32", 4},
                                                  {Scalar::u64, "UInt64", "uint64", 8}}};

std::optional<Scalar> scalar_named(std::string_view name, std::string_view ScalarInfo::*column) {
  for (const ScalarInfo& row : kScalars) {
    if (row.*column == name) return row.scalar;
  }
  return std::nullopt;
}

template <class Integer, class T>
bool is_a(T value) {
  if constexpr (std::is_floating_point_v<T>) {
    constexpr T kLeast = static_cast<T>(std::numeric_limits<Integer>::min());  // a power of two, and so exact
    return value >= kLeast && value < -kLeast && std::floor(value) == value;
  } else {
    return std::in_range<Integer>(value);
  }
}

template <class Integer>
std::optional<std::vector<Integer>> to_integers(const Values& values) {
  return std::visit(
      [](const auto& v) -> std::optional<std::vector<Integer>> {
        if (!std::all_of(v.begin(), v.end(), [](auto x) { return is_a<Integer>(x); })) return std::nullopt;
        std::vector<Integer> result(v.size());
        std::transform(v.begin(), v.end(), result.begin(), [](auto x) { return static_cast<Integer>(x); });
        return result;
      },
      values);
}

}  // namespace

const ScalarInfo& info(Scalar scalar) { return kScalars[static_cast<std::size_t>(scalar)]; }
std::optional<Scalar> scalar_of_vtu(std::string_view name) { return scalar_named(name, &ScalarInfo::vtu); }
std::optional<Scalar> scalar_of_text(std::string_view name) { return scalar_named(name, &ScalarInfo::text); }

std::size_t size(const Values& values) {
  return std::visit([](const auto& v) { return v.size(); }, values);
}

bool is_finite(const Values& values) {
  return std::visit(
      [](const auto& all) {
        return std::all_of(all.begin(), all.end(), [](auto x) { return std::isfinite(static_cast<double>(x)); });
      },
      values);
}

Values zeros(Scalar scalar, std::size_t n) {
  return with_scalar(scalar, [n](auto zero) -> Values { return std::vector<decltype(zero)>(n); });
}

std::vector<double> to_doubles(Values&& values) {
  if (auto* doubles = std::get_if<std::vector<double>>(&values)) return std::move(*doubles);
  return std::visit(
      [](const auto& v) {
        std::vector<double> result(v.size());
        std::transform(v.begin(), v.end(), result.begin(), [](auto x) { return static_cast<double>(x); });
        return result;
      },
      values);
}

std::optional<std::vector<std::int32_t>> to_int32(const Values& values) { return to_integers<std::int32_t>(values); }

std::optional<std::vector<std::int64_t>> to_int64(Values&& values) {
  if (auto* same = std::get_if<std::vector<std::int64_t>>(&values)) return std::move(*same);
  return to_integers<std::int64_t>(values);
}

Values gather(const Values& values, int components, const RunLength& indices) {
  return std::visit(
      [&](const auto& v) -> Values {
        std::remove_cvref_t<decltype(v)> result;
        const auto c = static_cast<std::size_t>(components);
        result.reserve(indices.size() * c);
        for (std::size_t i = 0; i < indices.size(); ++i) {
          const auto from = static_cast<std::size_t>(indices[static_cast<std::int64_t>(i)]) * c;
          for (std::size_t k = 0; k < c; ++k) result.push_back(v[from + k]);
        }
        return result;
      },
      values);
}

void append(Values& values, const Values& more) {
  std::visit(
      [&](auto& v) {
        const auto& other = std::get<std::remove_cvref_t<decltype(v)>>(more);
        v.insert(v.end(), other.begin(), other.end());
      },
      values);
}

const DataArray* find(const std::vector<DataArray>& arrays, std::string_view name) {
  const auto it = std::find_if(arrays.begin(), arrays.end(), [&](const DataArray& a) { return a.name == name; });
  return it == arrays.end() ? nullptr : &*it;
}

std::optional<DataArray> take(std::vector<DataArray>& arrays, std::string_view name) {
  const auto it = std::find_if(arrays.begin(), arrays.end(), [&](const DataArray& a) { return a.name == name; });
  if (it == arrays.end()) return std::nullopt;
  DataArray taken = std::move(*it);
  arrays.erase(it);
  return taken;
}

}  // namespace temper::io
