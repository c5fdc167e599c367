// The verbs of the program. Each reads its own arguments, so that starting up costs one verb's options only.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "exit.hpp"

namespace temper::app {

/// The words after the verb on the command line.
using Arguments = std::vector<std::string>;

Exit run_mesh(const Arguments& arguments);
Exit run_optimize(const Arguments& arguments);
Exit run_check(const Arguments& arguments);
Exit run_operators(const Arguments& arguments);
Exit run_draw(const Arguments& arguments);
Exit run_convert(const Arguments& arguments);
Exit run_example(const Arguments& arguments);
Exit run_paper(const Arguments& arguments);
Exit run_weights(const Arguments& arguments);
Exit run_explain(const Arguments& arguments);
Exit run_errors(const Arguments& arguments);  // only with temper::errors

struct Verb {
  std::string_view name;
  std::string summary;
  Exit (*run)(const Arguments& arguments);
};
[[nodiscard]] std::span<const Verb> verbs();

}  // namespace temper::app
