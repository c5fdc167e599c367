// Diffusion tensors: a verb then measures in their metrics.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "files/input.hpp"
#include "help/command.hpp"
#include "temper/detail/certificate_io.hpp"
#include "temper/detail/tensor.hpp"

namespace temper::app {

/// The tensors that --tensor names: one for all, one for each region, or data of the cells. A tensor is a list of its
/// components, three of them or six.
struct TensorOption {
  std::vector<double> one;                                              ///< for all; empty: there is none
  std::vector<std::pair<std::string, std::vector<double>>> of_regions;  ///< by number or name
  std::vector<std::string> data;  ///< names: of kxx, kxy, …; of k11, k22, … and angles; or of one array
  std::string spelled;            ///< the options as given, " --tensor 1,0,4", for commands in messages

  [[nodiscard]] bool given() const { return !one.empty() || may_differ(); }
  /// Says whether cells may have different tensors.
  [[nodiscard]] bool may_differ() const { return !of_regions.empty() || !data.empty(); }
};

/// Adds --tensor for these cells; `what` is its purpose.
void add_tensor(Command& command, TensorOption& tensor, const std::string& what, CellKinds cells = CellKinds::both);

/// Failure when an option for the plane of the file was given, too.
void expect_without(const Command& command, const TensorOption& tensor, const std::string& option);

/// The tensor of each cell of the input; none without --tensor. If all have one, it is the only one. Failure if a
/// region or data are missing, or if tensors are those of other cells.
template <class Subject>
[[nodiscard]] std::vector<typename Subject::Tensor> tensors_of(const TensorOption& tensor,
                                                               const InputOf<Subject>& input);

/// A mesh of that input in the planes of its metrics. `tensors` and `corner_weights` are of its cells and corners.
template <class Subject>
[[nodiscard]] typename Subject::Pieces in_metric(const typename Subject::Mesh& mesh,
                                                 const std::vector<typename Subject::Tensor>& tensors,
                                                 const std::vector<double>& corner_weights,
                                                 const InputOf<Subject>& input);

/// Lets names and points of the input count the copies of vertices of interfaces, too.
template <class Subject>
void name_copies(InputOf<Subject>& input, const typename Subject::Pieces& pieces);

/// Numbers of the vertices of pieces in certificates: those of points, then those of further copies.
struct CopyNumbers {
  std::vector<std::size_t> points;      ///< of each vertex; empty: the same
  std::vector<io::CopyOfPoint> copies;  ///< what further numbers are
  io::VertexOfPoint vertices;           ///< the vertex of each number
};
template <class Subject>
[[nodiscard]] CopyNumbers number_copies(const InputOf<Subject>& input, const typename Subject::Pieces& pieces);

/// Warns if the file has weights for each region, and no tensors were given.
template <class Subject>
void warn_without(const TensorOption& tensor, const InputOf<Subject>& input);

/// The mesh of the input in the planes of its metrics, if there are tensors.
template <class Subject>
[[nodiscard]] std::optional<typename Subject::Pieces> metric_of(const InputOf<Subject>& input,
                                                                const TensorOption& tensor);

/// Warns if dual edges do not cross interfaces at one place.
template <class Subject>
void warn_of_crossings(const InputOf<Subject>& input, const typename Subject::Pieces& pieces);

/// A mesh in its own plane, and in the planes of its metrics.
template <class Subject>
struct MetricViewOf {
  typename Subject::Mesh plain;
  typename Subject::Pieces pieces;
};
using MetricView = MetricViewOf<Triangles>;
/// Puts the mesh of the input into the planes of its metrics, if there are tensors, and names copies. Warns if weights
/// do not keep the equations of interfaces.
template <class Subject>
std::optional<MetricViewOf<Subject>> take_to_metric(InputOf<Subject>& input, const TensorOption& tensor);

}  // namespace temper::app
