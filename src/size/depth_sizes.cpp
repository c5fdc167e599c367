// See sizes_from_depths() in temper/detail/size.hpp.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "base/text.hpp"
#include "temper/detail/size.hpp"

namespace temper {
namespace {

std::optional<InputError> check(const DepthSizes& rules) {
  const auto refused = [](const std::string& message) { return InputError{ErrorCode::invalid_option, "", message}; };
  struct Row {
    const char* name;
    double value;
    bool may_be_zero;
  };
  for (const auto& [name, value, may_be_zero] :
       {Row{"per_wavelength", rules.per_wavelength, true}, Row{"period", rules.period, false},
        Row{"time_step", rules.time_step, true}, Row{"courant", rules.courant, false}, Row{"least", rules.least, false},
        Row{"largest", rules.largest, true}}) {
    if (std::isfinite(value) && (value > 0 || (may_be_zero && value == 0))) continue;
    return refused("sizes from depths: expected a finite number above 0 as " + std::string(name) + ", found " +
                   to_text(value));
  }
  if (rules.per_wavelength == 0 && rules.time_step == 0)
    return refused("sizes from depths: expected per_wavelength or time_step");
  if (rules.largest > 0 && rules.largest < rules.least) {
    return refused("sizes from depths: largest is " + to_text(rules.largest) + ", but least is " +
                   to_text(rules.least));
  }
  return {};
}

}  // namespace

Expected<std::vector<double>> sizes_from_depths(std::span<const double> depths, const DepthSizes& rules) {
  if (auto error = check(rules)) return *std::move(error);
  const double largest = rules.largest > 0 ? rules.largest : std::numeric_limits<double>::infinity();
  std::vector<double> sizes;
  sizes.reserve(depths.size());
  for (const double depth : depths) {
    const double speed = depth > 0 ? std::sqrt(kGravity * depth) : 0;
    double size = rules.per_wavelength > 0 ? speed * rules.period / rules.per_wavelength : rules.least;
    size = std::min(std::max(size, rules.least), largest);
    sizes.push_back(std::max(size, speed * rules.time_step / rules.courant));
  }
  return sizes;
}

}  // namespace temper
