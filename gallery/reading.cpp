#include "reading.hpp"

#include <utility>

namespace temper::gallery {
namespace {

Reading& current() {
  static Reading reading;
  return reading;
}

RunSettings& counted() {
  static RunSettings settings;
  return settings;
}

}  // namespace

void set_reading(Reading reading) { current() = std::move(reading); }

OptimizeOptions as_read(OptimizeOptions options) {
  const Inversion own = options.paper.inversion;
  for (const ReadOption& read : current()) read.option->set(options, read.value);
  // Among inverted triangles no edge can be flipped at once.
  if (options.paper.inversion == Inversion::allow && options.flips != Flips::deferred) options.paper.inversion = own;
  RunSettings& settings = counted();
  ++settings.runs;
  for (std::size_t i = 0; i < kOpen.size(); ++i) {
    const OptionRow& row = *find_option(kOpen[i]);
    if (missing_need(row, options).empty()) settings.values[i].insert(option_text(row, row.get(options)));
  }
  return options;
}

RunSettings take_run_settings() { return std::exchange(counted(), {}); }

}  // namespace temper::gallery
