#include "reading.hpp"

#include <utility>

namespace temper::gallery {
namespace {

Reading& current() {
  static Reading reading;
  return reading;
}

}  // namespace

void set_reading(const Reading& reading) { current() = reading; }
const Reading& reading() { return current(); }

OptimizeOptions as_read(OptimizeOptions options) {
  const Reading& r = reading();
  PaperSwitches& p = options.paper;
  p.search_radius = r.search_radius.value_or(p.search_radius);
  p.weight_reach = r.weight_reach.value_or(p.weight_reach);
  if (r.refuses_inversions) p.inversion = Inversion::refuse;
  return options;
}

}  // namespace temper::gallery
