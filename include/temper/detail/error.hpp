// Errors are values: for bad input the library never prints, throws or exits.
//
// Expected<T> has the part of the interface of C++23's std::expected that temper needs. InputError names the place of
// the bad input in the user's numbering, the expected value and the value found.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace temper {

enum class ErrorCode {
  not_found,            ///< A file that does not exist or cannot be opened for reading
  empty_input,          ///< No bytes, no points or no triangles
  truncated,            ///< The file ends before what its header announces
  syntax,               ///< Bytes that do not follow the format
  unsupported,          ///< A valid file that temper does not read, or that this function does not take
  index_out_of_range,   ///< A negative or too large vertex number
  size_mismatch,        ///< Arrays of one mesh whose lengths disagree
  not_finite,           ///< NaN or infinity
  not_planar,           ///< Z coordinates that are not all equal
  not_on_sphere,        ///< A point of a sphere that is not at its radius
  duplicate_point,      ///< Two vertices at exactly the same place
  unused_point,         ///< A point of no triangle
  zero_area,            ///< A triangle with collinear corners or a repeated vertex
  zero_volume,          ///< A tetrahedron with coplanar corners or a repeated vertex
  non_manifold_face,    ///< A face with more than two tetrahedra
  non_manifold_edge,    ///< An edge with more than two triangles, or where tetrahedra touch along the edge alone
  non_manifold_vertex,  ///< A vertex where the mesh touches itself (bow tie)
  overlap,              ///< Triangles or tetrahedra that cover the same place twice
  missing_edge,         ///< A constrained edge that is no edge of the mesh
  geographic,           ///< Longitude and latitude, although a plane is needed
  out_of_scale,         ///< Coordinates too large or too small for exact arithmetic
  invalid_option,       ///< An option whose value makes no sense
  hidden_vertex,        ///< Weights that leave a vertex without power cell
  stopped,              ///< Stopped by the caller or a time limit before there was a result
  trace_mismatch,       ///< An event of a trace that does not fit the mesh
  rank_mismatch,        ///< Ranks of one run that have different meshes or options
  not_writable,         ///< An output that cannot be written; nothing was changed
};

/// The name of the code, such as "duplicate_point"; stable across versions.
[[nodiscard]] std::string_view name(ErrorCode code);

/// An error in the input, for a person to read: `where: message`.
struct InputError {
  ErrorCode code = ErrorCode::syntax;
  std::string where;    ///< "coast.msh:41", or empty when the input came as arrays
  std::string message;  ///< "triangle 12 uses vertex 305, but the file has 300 vertices"

  [[nodiscard]] std::string what() const { return where.empty() ? message : where + ": " + message; }
};

/// Makes text safe for a terminal. Control characters except newlines and tabs become `\x1b` and the like. Bytes that
/// are not UTF-8 become characters of Latin-1.
[[nodiscard]] std::string printable(std::string_view text);

/// A value, or the reason why there is none.
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

/// Success, or the reason of the failure.
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
