// Bounds on what was measured, and everything as a table and as JSON.
#pragma once

#include <string>
#include <vector>

#include "row.hpp"

namespace temper::bench {

/// A requirement on one number; NaN when this run did not measure it.
struct Bound {
  std::string what;
  double value;
  bool at_least;
  double limit;

  [[nodiscard]] bool measured() const { return value == value; }
  [[nodiscard]] bool met() const { return at_least ? value >= limit : value <= limit; }
};

/// `startup`: of the program, in milliseconds.
[[nodiscard]] std::vector<Bound> bounds(const std::vector<Row>& rows, double startup);
void print(const std::vector<Row>& rows, const std::vector<Bound>& bounds);
void write_json(const std::string& path, const std::vector<Row>& rows, const std::vector<Bound>& bounds);

}  // namespace temper::bench
