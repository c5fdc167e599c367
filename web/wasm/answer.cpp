// See answer.hpp.
#include "answer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <new>
#include <utility>

#include "temper/detail/version.hpp"

namespace temper::wasm {
namespace {

std::string last_answer;

constexpr char kMark = '\1';  // before the name of a number: no text of the library has it

void answer_error(std::string_view code, const std::string& where, const std::string& message) {
  answer(Json{{"code", code}, {"where", where}, {"message", message}});
}

}  // namespace

void fail(ErrorCode code, std::string message) { throw BadInput{{code, "", std::move(message)}}; }

void answer(std::string bytes) { last_answer = std::move(bytes); }

void answer(const Json& json) {
  // A name in a file need not be UTF-8; JSON must be.
  last_answer = json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void answer_exception() {
  try {
    throw;
  } catch (const BadInput& bad) {
    answer_error(name(bad.error.code), bad.error.where, bad.error.message);
  } catch (const WrongType& wrong) {
    answer_error("type", "", wrong.message);
  } catch (const std::bad_alloc&) {
    answer_error("memory", "", "needs more memory than there is");
  } catch (const std::exception& other) {
    answer_error("internal", "", other.what());
  }
}

Json parse(Text text) { return Json::parse(text.data, text.data + text.size); }

Json number(double value) {
  if (std::isfinite(value)) return value;
  return std::string(1, kMark) + (std::isnan(value) ? "NaN" : value > 0 ? "Infinity" : "-Infinity");
}

void expect_names(const Json& given, std::span<const std::string_view> names) {
  for (const auto& [key, value] : given.items()) {
    if (std::find(names.begin(), names.end(), key) == names.end()) throw WrongType{"there is no option " + key};
  }
}

TEMPER_EXPORT(answer_data) const char* answer_data() { return last_answer.data(); }
TEMPER_EXPORT(answer_size) std::size_t answer_size() { return last_answer.size(); }
/// Memory for arguments. Null when there is none left.
TEMPER_EXPORT(allocate) void* allocate(std::size_t size) { return std::malloc(size == 0 ? 1 : size); }
TEMPER_EXPORT(release) void release(void* memory) { std::free(memory); }

TEMPER_EXPORT(version) void answer_version() { answer(std::string(version())); }

}  // namespace temper::wasm
