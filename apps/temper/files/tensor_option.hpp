// A diffusion tensor, in the metric of which a verb measures.
#pragma once

#include <optional>
#include <string>

#include "files/input.hpp"
#include "help/command.hpp"
#include "temper/detail/tensor.hpp"

namespace temper::app {

/// --tensor; `what` it is for.
void add_tensor(Command& command, std::optional<Metric>& metric, const std::string& what);

/// Failure when an option was given, too, that is of the plane of the file.
void expect_without(const Command& command, const std::optional<Metric>& metric, const std::string& option);

/// A mesh of that input, in the plane of the metric.
[[nodiscard]] Mesh in_metric(const Mesh& mesh, const Metric& metric, const Input& input);

/// Puts the mesh of the input into the plane of the metric, if there is one. Returns the mesh as it was, then.
std::optional<Mesh> take_to_metric(Input& input, const std::optional<Metric>& metric);

}  // namespace temper::app
