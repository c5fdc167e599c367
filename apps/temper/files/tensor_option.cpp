#include "files/tensor_option.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "options/options.hpp"

namespace temper::app {

void add_tensor(Command& command, std::optional<Metric>& metric, const std::string& what) {
  const auto use = [&metric](const std::vector<double>& k) {
    const auto made = Metric::of({k[0], k[1], k[2]});
    if (!made) throw BadValue(made.error().message);
    metric = *made;
  };
  add_numbers(
      command, "--tensor", "KXX,KXY,KYY", 3, use,
      "Constant diffusion tensor K of -div(K grad u). " + what + " in its metric. See docs/howto/anisotropic.md.")
      .cells = CellKinds::triangles;
}

void expect_without(const Command& command, const std::optional<Metric>& metric, const std::string& option) {
  if (!metric || !command.was_given(option)) return;
  refuse_usage(command.name(), fmt::format("--tensor does not go with {}", option));
}

Mesh in_metric(const Mesh& mesh, const Metric& metric, const Input& input) {
  auto there = mapped(mesh, metric, *input.names);
  if (!there) throw as_failure(located(there.error(), input.path));
  return *std::move(there);
}

std::optional<Mesh> take_to_metric(Input& input, const std::optional<Metric>& metric) {
  if (!metric) return {};
  return std::exchange(input.loaded.mesh, in_metric(input.mesh(), *metric, input));
}

}  // namespace temper::app
