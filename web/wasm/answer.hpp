// The answer of a function of the module: one buffer, valid until the next call. It holds JSON, or the bytes of an
// array, or after a failure {"code", "where", "message"}.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "temper/detail/error.hpp"
#include "temper/detail/ids.hpp"

namespace temper::wasm {

using Json = nlohmann::ordered_json;

/// A function of the module, by its own name.
#define TEMPER_EXPORT(name) extern "C" __attribute__((export_name(#name)))
/// A function that JavaScript gives to the module.
#define TEMPER_IMPORT(name) extern "C" __attribute__((import_module("temper"), import_name(#name)))

/// An argument of the wrong type: TypeError in JavaScript.
struct WrongType {
  std::string message;
};
/// An InputError on its way to JavaScript.
struct BadInput {
  InputError error;
};
[[noreturn]] void fail(ErrorCode code, std::string message);
template <class T>
T or_fail(Expected<T> value) {
  if (!value) throw BadInput{value.error()};
  return *std::move(value);
}
inline void or_fail(const Expected<void>& value) {
  if (!value) throw BadInput{value.error()};
}

void answer(std::string bytes);
void answer(const Json& json);
template <class T>
void answer_array(std::span<const T> values) {
  answer(std::string(reinterpret_cast<const char*>(values.data()), values.size_bytes()));
}
/// Makes the current exception the answer. Call it in a handler.
void answer_exception();

/// Runs the work of an exported function; `failed` is its result when the work ends with an exception.
template <class Result, class Work>
Result guarded(Result failed, Work work) {
  try {
    return work();
  } catch (...) {
    answer_exception();
    return failed;
  }
}
/// Runs work without a result. Returns 1, or 0 when it failed.
template <class Work>
int done(Work work) {
  return guarded(0, [&] {
    work();
    return 1;
  });
}

/// Text that JavaScript has put into memory.
struct Text {
  const char* data;
  std::size_t size;
  [[nodiscard]] std::string string() const { return {data, size}; }
};
[[nodiscard]] Json parse(Text text);

/// Numbers that JSON has not, infinite ones and NaN, are marked texts: web/npm turns them back.
[[nodiscard]] Json number(double value);
template <class Tag>
[[nodiscard]] Json number(Id<Tag> id) {
  return id.valid() ? Json(id.index) : Json(-1);
}

/// Takes a member of `given` into `target`, if there is one.
template <class T>
void take(const Json& given, const char* name, T& target) {
  const auto found = given.find(name);
  if (found == given.end() || found->is_null()) return;
  try {
    target = found->get<T>();
  } catch (const Json::exception&) {
    throw WrongType{std::string(name) + ": found " + found->dump()};
  }
}
/// TypeError for a member that none of these names is.
void expect_names(const Json& given, std::span<const std::string_view> names);

}  // namespace temper::wasm
