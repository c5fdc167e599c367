// What `--html` of check and optimize writes: the HTML report (temper/html.hpp) with the numbers that --json and
// --report have, the reasons of temper explain, and the command to run again. Nothing in it depends on the time a run
// took.
#pragma once

#include <string>

#include "input.hpp"
#include "report_json.hpp"

namespace temper::app {

/// `quality`: with what is worst listed as the page is to show it.
[[nodiscard]] std::string check_html(const std::string& command, const Input& input, const Quality& quality);

/// `names`: of the vertices and triangles of the result; null: counted from 0. `before`, `mesh`: of record.before and
/// after.
struct OptimizePage {
  const OptimizeRecord& record;
  const Input& input;
  const Mesh& before;
  const Mesh& mesh;
};
[[nodiscard]] std::string optimize_html(const OptimizePage& page);

}  // namespace temper::app
