// Diffusion tensors: a verb then measures in their metrics.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "files/input.hpp"
#include "help/command.hpp"
#include "temper/detail/tensor.hpp"

namespace temper::app {

/// The tensors that --tensor names: one for all, one for each region, or data of the cells.
struct TensorOption {
  std::optional<Metric> metric;                            ///< of one tensor for all
  std::vector<std::pair<std::string, Tensor>> of_regions;  ///< by number or name
  std::vector<std::string> data;  ///< names: of kxx, kxy, kyy; of k11, k22 and an angle; or of one array

  [[nodiscard]] bool given() const { return metric || !of_regions.empty() || !data.empty(); }
};

/// Adds --tensor; `what` is its purpose.
void add_tensor(Command& command, TensorOption& tensor, const std::string& what);

/// Failure when an option for the plane of the file was given, too.
void expect_without(const Command& command, const TensorOption& tensor, const std::string& option);

/// The tensor of each triangle of the input; none if all have one. Failure if a region or data are missing.
[[nodiscard]] std::vector<Tensor> tensors_of(const TensorOption& tensor, const Input& input);

/// A mesh of that input in the planes of its metrics. `tensors` and `corner_weights` are of its triangles and corners,
/// if there are several tensors.
[[nodiscard]] MetricMesh in_metric(const Mesh& mesh, const TensorOption& tensor, const std::vector<Tensor>& tensors,
                                   const std::vector<double>& corner_weights, const Input& input);

/// Lets names and points of the input count the copies of vertices of interfaces, too.
void name_copies(Input& input, const MetricMesh& pieces);

/// The mesh of the input in the planes of its metrics, if there are tensors.
[[nodiscard]] std::optional<MetricMesh> metric_of(const Input& input, const TensorOption& tensor);

/// A mesh in its own plane, and in the planes of its metrics.
struct MetricView {
  Mesh plain;
  MetricMesh pieces;
};
/// Puts the mesh of the input into the planes of its metrics, if there are tensors, and names copies. Warns if weights
/// do not keep the equations of interfaces.
std::optional<MetricView> take_to_metric(Input& input, const TensorOption& tensor);

}  // namespace temper::app
