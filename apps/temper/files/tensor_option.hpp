// A diffusion tensor: a verb then measures in its metric.
#pragma once

#include <optional>
#include <string>

#include "files/input.hpp"
#include "help/command.hpp"
#include "temper/detail/tensor.hpp"

namespace temper::app {

/// Adds --tensor; `what` is its purpose.
void add_tensor(Command& command, std::optional<Metric>& metric, const std::string& what);

/// Failure when an option for the plane of the file was given, too.
void expect_without(const Command& command, const std::optional<Metric>& metric, const std::string& option);

/// A mesh of that input, in the plane of the metric.
[[nodiscard]] Mesh in_metric(const Mesh& mesh, const Metric& metric, const Input& input);

/// Puts the mesh of the input into the plane of the metric, if there is one. Returns the original mesh in that case.
std::optional<Mesh> take_to_metric(Input& input, const std::optional<Metric>& metric);

}  // namespace temper::app
