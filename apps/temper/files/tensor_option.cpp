#include "files/tensor_option.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>

#include "console.hpp"
#include "files/region_values.hpp"
#include "options/options.hpp"
#include "temper/detail/suggest.hpp"
#include "temper/feasibility.hpp"

namespace temper::app {
namespace {

constexpr double kDegrees = 57.29577951308232;
// Largest distance between the crossings of an interface edge from its two sides, over its length: rounding of a file.
constexpr double kSameCrossing = 1e-9;

/// The numbers of a list; none if a word is no number.
std::optional<std::vector<double>> numbers_of(const std::vector<std::string>& words) {
  std::vector<double> numbers;
  for (const std::string& word : words) {
    const auto number = parse_number(word);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

Tensor tensor_from(const std::vector<double>& k, const std::string& text) {
  if (k.size() != 3)
    throw BadValue(fmt::format("expected three numbers KXX,KXY,KYY, found {} in '{}'", k.size(), text));
  const Tensor tensor = {k[0], k[1], k[2]};
  if (const auto metric = Metric::of(tensor); !metric) throw BadValue(metric.error().message);
  return tensor;
}

void take(TensorOption& option, const std::string& text) {
  const auto one_kind = [&](bool others) {
    if (others) throw BadValue(fmt::format("expected tensors of regions, or one other value, found '{}', too", text));
  };
  if (const std::size_t equals = text.find('='); equals != std::string::npos) {
    one_kind(option.metric || !option.data.empty());
    const auto numbers = numbers_of(separated(std::string_view(text).substr(equals + 1)));
    if (!numbers) throw BadValue(fmt::format("expected REGION=KXX,KXY,KYY, found '{}'", text));
    option.of_regions.emplace_back(text.substr(0, equals), tensor_from(*numbers, text));
    return;
  }
  one_kind(option.given());
  const std::vector<std::string> words = separated(text);
  if (const auto numbers = numbers_of(words)) {
    option.metric = *Metric::of(tensor_from(*numbers, text));
  } else if (words.size() == 1 || words.size() == 3) {
    option.data = words;
  } else {
    throw BadValue(
        fmt::format("expected KXX,KXY,KYY, REGION=KXX,KXY,KYY, or one or three names of cell data, found '{}'", text));
  }
}

const io::DataArray& find_data(const Input& input, const std::string& name, int components) {
  const std::vector<io::DataArray>& all = input.file.triangles.data;
  const auto found = std::ranges::find_if(
      all, [&](const io::DataArray& array) { return array.name == name && array.components == components; });
  if (found != all.end()) return *found;
  std::vector<std::string_view> names;
  for (const io::DataArray& array : all) {
    if (array.components == components) names.push_back(array.name);
  }
  throw Failure(Exit::bad_usage,
                fmt::format("{}: --tensor: there are no cell data '{}' of {}; {}. Next: give one of these, or "
                            "REGION=KXX,KXY,KYY",
                            input.path, name, components == 1 ? "one number" : "three numbers",
                            names.empty() ? "the file has none of that size" : "there are " + join(names)));
}

/// The tensor with axes that are turned counter-clockwise from x and y [degrees], as angle1 of MODFLOW turns k11 and
/// k22.
Tensor turned(double k11, double k22, double degrees) {
  const double c = std::cos(degrees / kDegrees), s = std::sin(degrees / kDegrees);
  return {k11 * c * c + k22 * s * s, (k11 - k22) * c * s, k11 * s * s + k22 * c * c};
}

/// Three names are k11, k22 and an angle if the last one begins with "angle", else kxx, kxy and kyy.
std::vector<Tensor> from_data(const TensorOption& option, const Input& input) {
  std::vector<Tensor> tensors(input.mesh().n_triangles());
  if (option.data.size() == 1) {
    const std::vector<double> values = as_doubles(find_data(input, option.data[0], 3));
    for (std::size_t t = 0; t < tensors.size(); ++t) tensors[t] = {values[3 * t], values[3 * t + 1], values[3 * t + 2]};
    return tensors;
  }
  std::array<std::vector<double>, 3> values;
  for (std::size_t i = 0; i < 3; ++i) values.at(i) = as_doubles(find_data(input, option.data[i], 1));
  const bool turns = option.data[2].starts_with("angle");
  for (std::size_t t = 0; t < tensors.size(); ++t) {
    tensors[t] =
        turns ? turned(values[0][t], values[1][t], values[2][t]) : Tensor{values[0][t], values[1][t], values[2][t]};
  }
  return tensors;
}

/// Names that know the copies of vertices of interfaces.
class PieceNames final : public tets::InputNames {
 public:
  PieceNames(std::shared_ptr<const tets::InputNames> whole, IdVector<VertexId, VertexId> first_copies)
      : whole_(std::move(whole)), first_copies_(std::move(first_copies)) {}
  [[nodiscard]] std::string point(std::size_t index) const override { return whole_->point(first(index)); }
  [[nodiscard]] std::string triangle(std::size_t index) const override { return whole_->triangle(index); }
  [[nodiscard]] std::string point_where(std::size_t index) const override { return whole_->point_where(first(index)); }
  [[nodiscard]] std::string triangle_where(std::size_t index) const override { return whole_->triangle_where(index); }

 private:
  [[nodiscard]] std::size_t first(std::size_t index) const {
    return index < first_copies_.size() ? first_copies_[VertexId(index)].index : index;
  }
  std::shared_ptr<const tets::InputNames> whole_;
  IdVector<VertexId, VertexId> first_copies_;
};

void warn_of_crossings(const Input& input, const MetricMesh& pieces) {
  const double apart = largest_gap(pieces);
  if (apart <= kSameCrossing) return;
  print_warnings(std::array{fmt::format(
      "{}: from its two sides, a dual edge crosses an interface between tensors at places that are up to {:.2g} edge "
      "lengths apart. Next: temper optimize or temper weights, with --tensor",
      input.path, apart)});
}

}  // namespace

void name_copies(Input& input, const MetricMesh& pieces) {
  if (!pieces.is_cut()) return;
  input.names = std::make_shared<PieceNames>(input.names, pieces.first_copies);
  std::vector<std::size_t> points;
  for (const VertexId v : pieces.mesh.vertices()) {
    const VertexId first = pieces.first_copy(v);
    points.push_back(input.points.empty() ? first.index : input.points[first.index]);
  }
  input.points = std::move(points);
}

void add_tensor(Command& command, TensorOption& tensor, const std::string& what) {
  Option option;
  option.names = "--tensor";
  option.value_name = "K";
  option.sentence = what +
                    " in the metric of the diffusion tensor K of -div(K grad u). K is KXX,KXY,KYY for all, or "
                    "REGION=KXX,KXY,KYY for each region, repeated. Or K names cell data: one array of three numbers, "
                    "three arrays kxx,kxy,kyy, or k11,k22,angle1 as MODFLOW has them. See docs/howto/anisotropic.md.";
  option.take = [&tensor](const std::string& text) { take(tensor, text); };
  option.values = Values::repeated;
  option.cells = CellKinds::triangles;
  command.add(std::move(option));
}

void expect_without(const Command& command, const TensorOption& tensor, const std::string& option) {
  if (!tensor.given() || !command.was_given(option)) return;
  refuse_usage(command.name(), fmt::format("--tensor does not go with {}", option));
}

std::vector<Tensor> tensors_of(const TensorOption& tensor, const Input& input) {
  if (!tensor.data.empty()) return from_data(tensor, input);
  if (tensor.of_regions.empty()) return {};
  std::map<std::int32_t, Tensor> values;
  for (const auto& [name, value] : tensor.of_regions) {
    const std::int32_t region = tag_of("--tensor", name, Triangles::dimension, input);
    if (!values.emplace(region, value).second)
      throw Failure(Exit::bad_usage, fmt::format("{}: --tensor: region {} has two values", input.path, region));
  }
  return at_elements("--tensor", values, input);
}

MetricMesh in_metric(const Mesh& mesh, const TensorOption& tensor, const std::vector<Tensor>& tensors,
                     const std::vector<double>& corner_weights, const Input& input) {
  const auto metrics =
      tensors.empty() ? Expected<Metrics>(Metrics(*tensor.metric)) : Metrics::of(tensors, *input.names);
  if (!metrics) throw as_failure(located(metrics.error(), input.path));
  auto there = mapped(mesh, *metrics, corner_weights, *input.names);
  if (!there) throw as_failure(located(there.error(), input.path));
  return *std::move(there);
}

std::optional<MetricMesh> metric_of(const Input& input, const TensorOption& tensor) {
  if (!tensor.given()) return {};
  return in_metric(input.mesh(), tensor, tensors_of(tensor, input), io::corner_weights_of(input.file, input.loaded),
                   input);
}

std::optional<MetricView> take_to_metric(Input& input, const TensorOption& tensor) {
  std::optional<MetricMesh> pieces = metric_of(input, tensor);
  if (!pieces) return {};
  MetricView view = {input.mesh(), *std::move(pieces)};
  warn_of_crossings(input, view.pieces);
  name_copies(input, view.pieces);
  input.loaded.mesh = view.pieces.mesh;
  return view;
}

}  // namespace temper::app
