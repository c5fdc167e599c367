// Numbers of the parts of a mesh over several changes.
#pragma once

namespace temper {

/// Numbers of parts of a mesh before two changes: `last` in the mesh between, `before` of that one. Empty: the same.
template <class Numbers>
[[nodiscard]] Numbers numbers_before_both(const Numbers& last, const Numbers& before) {
  if (last.empty() || before.empty()) return last.empty() ? before : last;
  Numbers result;
  for (const auto number : last) {
    if constexpr (requires { number.valid(); })
      result.push_back(number.valid() ? before[number] : number);
    else
      result.push_back(before[number]);
  }
  return result;
}

}  // namespace temper
