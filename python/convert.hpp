// Conversions between C++ values and Python values. Arrays are not copied if the memory layout allows it. Enums are
// their C++ names. Structs become dictionaries, which the Python package turns into dataclasses. The code uses little
// of pybind11's own machinery, which is slow to compile: every enum is a list of names, every struct a few lines.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "temper/detail/error.hpp"
#include "temper/detail/ids.hpp"
#include "temper/detail/projection.hpp"
#include "temper/detail/size.hpp"
#include "temper/detail/vec.hpp"
#include "temper/energy.hpp"
#include "temper/io.hpp"
#include "temper/quality.hpp"

namespace temper::python {

namespace py = pybind11;

// --- errors -------------------------------------------------------------------------------------------

/// Becomes temper.TemperError.
struct BadInput {
  InputError error;
};
[[noreturn]] void fail(ErrorCode code, std::string message);

template <class T>
T or_raise(Expected<T> value) {
  if (!value) throw BadInput{value.error()};
  return *std::move(value);
}
inline void or_raise(const Expected<void>& value) {
  if (!value) throw BadInput{value.error()};
}

// --- arrays -------------------------------------------------------------------------------------------

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Int32s = py::array_t<std::int32_t, py::array::c_style | py::array::forcecast>;
using Int64s = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

/// The values of an array whose last dimension is the dimension of T, without a copy. The Python package checks shapes;
/// wrong shapes are refused here too.
template <class T, class Array>
std::span<const T> as_span(const Array& array) {
  using Value = typename Array::value_type;
  static_assert(sizeof(T) % sizeof(Value) == 0);
  constexpr std::size_t per = sizeof(T) / sizeof(Value);
  const std::size_t size = static_cast<std::size_t>(array.size());
  if (size % per != 0) throw py::value_error("array of the wrong shape");
  return {reinterpret_cast<const T*>(array.data()), size / per};
}

/// Vertex numbers of 64 bits as the 32 bits of the library. A number that does not fit is an error. Callers check
/// the others against the number of vertices.
template <std::size_t n>
std::vector<std::array<std::int32_t, n>> narrow(const Int64s& array, const char* kind) {
  const auto wide = as_span<std::array<std::int64_t, n>>(array);
  std::vector<std::array<std::int32_t, n>> result(wide.size());
  for (std::size_t i = 0; i < wide.size(); ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      if (wide[i][k] < INT32_MIN || wide[i][k] > INT32_MAX) {
        fail(ErrorCode::index_out_of_range, std::string(kind) + " " + std::to_string(i) + " uses vertex " +
                                                std::to_string(wide[i][k]) + ", which no mesh has");
      }
      result[i][k] = static_cast<std::int32_t>(wide[i][k]);
    }
  }
  return result;
}

using Shape = std::vector<py::ssize_t>;
/// A read-only array on memory that `owner` keeps.
py::array view(const py::dtype& type, Shape shape, Shape strides, const void* data, const py::object& owner);

/// A capsule that keeps a value alive for views on it.
template <class T>
py::capsule keep(T value) {
  auto owned = std::make_unique<T>(std::move(value));
  py::capsule capsule(owned.get(), [](void* data) { delete static_cast<T*>(data); });
  owned.release();
  return capsule;
}

/// Ids as 32-bit numbers in memory; an invalid id is −1.
template <class T>
py::dtype dtype_of() {
  if constexpr (std::is_same_v<T, VertexId> || std::is_same_v<T, TriangleId> || std::is_same_v<T, HalfedgeId>) {
    static_assert(sizeof(T) == sizeof(std::int32_t));
    return py::dtype::of<std::int32_t>();
  } else {
    return py::dtype::of<T>();
  }
}

template <class T>
py::array array_of(std::span<const T> values) {
  return py::array(dtype_of<T>(), Shape{static_cast<py::ssize_t>(values.size())}, values.data());
}
/// (n, k) from n arrays of k numbers, or n structs of k doubles.
template <class Value, class T>
py::array rows_of(std::span<const T> values) {
  constexpr std::size_t per = sizeof(T) / sizeof(Value);
  return py::array(dtype_of<Value>(), Shape{static_cast<py::ssize_t>(values.size()), static_cast<py::ssize_t>(per)},
                   values.data());
}

// --- one value ----------------------------------------------------------------------------------------

inline py::object to_python(bool value) { return py::bool_(value); }
inline py::object to_python(int value) { return py::int_(value); }
inline py::object to_python(std::int32_t* value) = delete;
inline py::object to_python(std::size_t value) { return py::int_(value); }
inline py::object to_python(double value) { return py::float_(value); }
inline py::object to_python(std::string_view value) { return py::str(value.data(), value.size()); }
inline py::object to_python(const std::string& value) { return py::str(value); }
inline py::object to_python(py::object value) { return value; }
template <class Tag>
py::object to_python(Id<Tag> id) {
  return py::int_(id.valid() ? static_cast<std::int64_t>(id.index) : -1);
}
inline py::object to_python(Vec2 p) { return py::make_tuple(p.x, p.y); }
inline py::object to_python(const WeightedPoint& p) { return py::make_tuple(p.x, p.y, p.w); }
inline py::object to_python(const LengthParameter& s) {
  return py::make_tuple(s.value, s.scale == LengthScale::relative ? "relative" : "absolute");
}
template <class T>
py::object to_python(const std::optional<T>& value) {
  return value ? to_python(*value) : py::none();
}
template <class T, std::size_t n>
py::object to_python(const std::array<T, n>& values) {
  py::tuple tuple(n);
  for (std::size_t i = 0; i < n; ++i) tuple[i] = to_python(values[i]);
  return tuple;
}
inline py::object to_python(const std::vector<std::string>& values) {
  py::list list;
  for (const std::string& value : values) list.append(py::str(value));
  return list;
}
inline py::object to_python(const std::vector<double>& values) { return array_of<double>(values); }
inline py::object to_python(const std::vector<VertexId>& values) { return array_of<VertexId>(values); }
inline py::object to_python(const std::vector<TriangleId>& values) { return array_of<TriangleId>(values); }
inline py::object to_python(const std::vector<HalfedgeId>& values) { return array_of<HalfedgeId>(values); }
inline py::object to_python(const std::vector<std::size_t>& values) {
  return py::array(py::dtype::of<std::uint64_t>(), Shape{static_cast<py::ssize_t>(values.size())}, values.data());
}
template <class IdType, class T>
py::object to_python(const IdVector<IdType, T>& values) {
  return to_python(values.raw());
}

/// Record()("name", value)("name", value).dict
struct Record {
  py::dict dict;
  template <class T>
  Record& operator()(const char* name, const T& value) {
    dict[name] = to_python(value);
    return *this;
  }
};

// --- enums: their names in the order of their values -----------------------------------------------------

/// The index of `text` in the names, or an error that lists them.
std::size_t choose(std::string_view option, std::string_view text, std::span<const std::string_view> names);

template <class Enum>
struct Names;  // static constexpr std::string_view list[]

template <class Enum>
std::string_view name_of(Enum value) {
  return Names<Enum>::list[static_cast<std::size_t>(value)];
}
template <class Enum>
Enum from_name(std::string_view option, std::string_view text) {
  return static_cast<Enum>(choose(option, text, Names<Enum>::list));
}

// --- ids and texts from Python --------------------------------------------------------------------------

/// Numbers from Python as ids; a negative number is invalid.
template <class T, std::size_t n>
std::array<T, n> ids_from(const py::handle& sequence) {
  const auto items = sequence.cast<py::sequence>();
  if (items.size() != n) throw py::value_error("expected " + std::to_string(n) + " numbers");
  std::array<T, n> ids;
  for (std::size_t i = 0; i < n; ++i) {
    const auto index = items[i].cast<std::int64_t>();
    ids[i] = index < 0 ? T() : T(static_cast<std::size_t>(index));
  }
  return ids;
}

inline std::vector<std::string> strings_from(const py::sequence& sequence) {
  std::vector<std::string> strings;
  for (const auto& item : sequence) strings.push_back(item.cast<std::string>());
  return strings;
}

#define TEMPER_PYTHON_NAMES(ENUM, ...)                        \
  template <>                                                 \
  struct temper::python::Names<ENUM> {                        \
    static constexpr std::string_view list[] = {__VA_ARGS__}; \
  }

LengthParameter length_parameter_from(const py::handle& value);

/// Spells the options in a text of the library as Python users do.
std::string spelled(std::string_view text);

}  // namespace temper::python

TEMPER_PYTHON_NAMES(temper::Preference, "equal", "larger", "less");
TEMPER_PYTHON_NAMES(temper::LengthScale, "absolute", "relative");
TEMPER_PYTHON_NAMES(temper::BoundaryTreatment, "as_is", "absolute", "mirrored");
TEMPER_PYTHON_NAMES(temper::ProjectionKind, "stereographic", "mercator", "transverse_mercator");
TEMPER_PYTHON_NAMES(temper::io::Encoding, "ascii", "base64", "appended");
TEMPER_PYTHON_NAMES(temper::io::Positive, "up", "down");
TEMPER_PYTHON_NAMES(temper::CellsOf, "power", "triangles");
