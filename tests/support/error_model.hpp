// What the program and Python do before a run: give options the model of errors that they can use.
#pragma once

#include <gtest/gtest.h>

#include <utility>

#include "temper/optimize.hpp"
#include "temper/verify.hpp"

namespace temper::test {

/// The options with the model of errors that they can use.
[[nodiscard]] inline OptimizeOptions with_error_model(const Mesh& mesh, OptimizeOptions options) {
  if (!wants_error_model(options, mesh)) return options;
  auto model = solver_error_model(mesh, {.scheme = options.for_});
  EXPECT_TRUE(model) << model.error().what();
  if (model) options.error.model = *std::move(model);
  return options;
}

}  // namespace temper::test
