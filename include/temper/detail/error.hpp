// Bad input comes back as a value: the library never prints, throws or exits.
//
// Expected<T> has the interface of C++23's std::expected that temper needs. InputError says where the
// bad input is in the user's own numbering, what was expected and what was found.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace temper {

enum class ErrorCode {
  not_found,            ///< a file that does not exist or cannot be opened for reading
  empty_input,          ///< no bytes, no points or no triangles
  truncated,            ///< the file ends before what its header announces
  syntax,               ///< bytes that do not follow the format
  unsupported,          ///< a valid file that is not a planar triangle mesh, or a variant temper does not read
  index_out_of_range,   ///< a negative or too large vertex number
  size_mismatch,        ///< arrays of one mesh whose lengths disagree
  not_finite,           ///< NaN or infinity
  not_planar,           ///< z coordinates that are not all equal
  not_on_sphere,        ///< a point of a sphere that is not at its radius
  duplicate_point,      ///< two vertices at exactly the same place
  unused_point,         ///< a point of no triangle
  zero_area,            ///< a triangle with collinear corners or a repeated vertex
  non_manifold_edge,    ///< an edge with more than two triangles
  non_manifold_vertex,  ///< a vertex where the mesh touches itself (bow tie)
  overlap,              ///< triangles that cover the same place twice
  missing_edge,         ///< a constrained edge that is no edge of the mesh
  geographic,           ///< longitude and latitude, where a plane is needed
  out_of_scale,         ///< coordinates too large or too small for exact arithmetic
  invalid_option,       ///< an option whose value makes no sense
  hidden_vertex,        ///< weights that leave a vertex without power cell
  stopped,              ///< by the caller or a time limit, before there was a result
  trace_mismatch,       ///< an event of a trace that does not fit the mesh
  rank_mismatch,        ///< ranks of one run that have different meshes or options
  not_writable,         ///< an output that cannot be written; nothing was changed
};

/// "duplicate_point", … : the name of the code, stable across versions.
[[nodiscard]] std::string_view name(ErrorCode code);

/// An error in the input, told to a person: `where: message`.
struct InputError {
  ErrorCode code = ErrorCode::syntax;
  std::string where;    ///< "coast.msh:41", or empty when the input came as arrays
  std::string message;  ///< "triangle 12 uses vertex 305, but the file has 300 vertices"

  [[nodiscard]] std::string what() const { return where.empty() ? message : where + ": " + message; }
};

/// Text that a terminal may show: control characters but newlines and tabs as `\x1b`, bytes that are no UTF-8 as the
/// characters of Latin-1.
[[nodiscard]] std::string printable(std::string_view text);

/// A value or the reason why there is none.
template <class T>
class [[nodiscard]] Expected {
 public:
  Expected(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Expected(InputError error) : state_(std::in_place_index<1>, std::move(error)) {}

  [[nodiscard]] bool has_value() const { return state_.index() == 0; }
  explicit operator bool() const { return has_value(); }
  /// Precondition: has_value().
  [[nodiscard]] T& operator*() & { return *std::get_if<0>(&state_); }
  [[nodiscard]] const T& operator*() const& { return *std::get_if<0>(&state_); }
  [[nodiscard]] T&& operator*() && { return std::move(*std::get_if<0>(&state_)); }
  [[nodiscard]] T* operator->() { return std::get_if<0>(&state_); }
  [[nodiscard]] const T* operator->() const { return std::get_if<0>(&state_); }
  /// Precondition: !has_value().
  [[nodiscard]] const InputError& error() const { return *std::get_if<1>(&state_); }

 private:
  std::variant<T, InputError> state_;
};

/// Success, or the reason why not.
template <>
class [[nodiscard]] Expected<void> {
 public:
  Expected() = default;
  Expected(InputError error) : error_(std::in_place_index<1>, std::move(error)) {}

  [[nodiscard]] bool has_value() const { return error_.index() == 0; }
  explicit operator bool() const { return has_value(); }
  /// Precondition: !has_value().
  [[nodiscard]] const InputError& error() const { return *std::get_if<1>(&error_); }

 private:
  std::variant<std::monostate, InputError> error_;
};

}  // namespace temper
