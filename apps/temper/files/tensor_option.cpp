#include "files/tensor_option.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <type_traits>

#include "console.hpp"
#include "files/region_values.hpp"
#include "options/options.hpp"
#include "temper/detail/suggest.hpp"
#include "temper/feasibility.hpp"
#include "temper/tets/weights.hpp"

namespace temper::app {
namespace {

constexpr double kDegrees = 57.29577951308232;
// Largest distance between the crossings of an interface edge from its two sides, over its length: rounding of a file.
constexpr double kSameCrossing = 1e-7;

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

template <class K>
K tensor_from(std::span<const double> k) {
  if constexpr (std::is_same_v<K, Tensor>)
    return {k[0], k[1], k[2]};
  else
    return {k[0], k[1], k[2], k[3], k[4], k[5]};
}

/// The components, if they are those of a tensor. `text` is what the user gave, `region` the name in it.
std::vector<double> checked(std::vector<double> k, const std::string& text, const std::string& region = {}) {
  std::optional<InputError> wrong;
  if (k.size() == 3) {
    if (const auto metric = Metric::of(tensor_from<Tensor>(k)); !metric) wrong = metric.error();
  } else if (k.size() == 6) {
    if (const auto metric = tets::Metric::of(tensor_from<Tensor3>(k)); !metric) wrong = metric.error();
  } else {
    throw BadValue(fmt::format("expected {}; found {} in '{}'", any_tensor(), k.size(), text));
  }
  if (wrong) throw BadValue(region.empty() ? wrong->message : fmt::format("region {}: {}", region, wrong->message));
  return k;
}

void take(TensorOption& option, const std::string& text) {
  const auto one_kind = [&](bool others) {
    if (others) throw BadValue(fmt::format("expected tensors of regions, or one other value, found '{}', too", text));
  };
  if (const std::size_t equals = text.find('='); equals != std::string::npos) {
    one_kind(!option.one.empty() || !option.data.empty());
    auto numbers = numbers_of(separated(std::string_view(text).substr(equals + 1)));
    if (!numbers) throw BadValue(fmt::format("expected REGION={}, found '{}'", Triangles::tensor, text));
    const std::string region = text.substr(0, equals);
    option.of_regions.emplace_back(region, checked(*std::move(numbers), text, region));
    return;
  }
  one_kind(option.given());
  const std::vector<std::string> words = separated(text);
  if (auto numbers = numbers_of(words)) {
    option.one = checked(*std::move(numbers), text);
  } else if (words.size() == 1 || (words.size() >= 3 && words.size() <= 6)) {
    option.data = words;
  } else {
    throw BadValue(fmt::format("expected {0}, REGION={0}, or one or three to six names of cell data, found '{1}'",
                               Triangles::tensor, text));
  }
}

constexpr std::string_view numbers_in_words(int n) {
  return n == 1 ? "one number" : n == 3 ? "three numbers" : "six numbers";
}

template <class Subject>
const io::DataArray& find_data(const InputOf<Subject>& input, const std::string& name, int components) {
  const std::vector<io::DataArray>& all = (input.file.*Subject::cells_of_file).data;
  const auto found = std::ranges::find_if(
      all, [&](const io::DataArray& array) { return array.name == name && array.components == components; });
  if (found != all.end()) return *found;
  std::vector<std::string_view> names;
  for (const io::DataArray& array : all) {
    if (array.components == components) names.push_back(array.name);
  }
  throw Failure(
      Exit::bad_usage,
      fmt::format("{}: --tensor: there are no cell data '{}' of {}; {}. Next: give one of these, or REGION={}",
                  input.path, name, numbers_in_words(components),
                  names.empty() ? "the file has none of that size" : "there are " + join(names), Subject::tensor));
}

/// The tensor with axes that are turned as MODFLOW turns k11, k22 and k33 [degrees]. angle1 turns them about z, from x
/// to y. angle2 then lifts the first axis, and angle3 turns the others about it, the second axis downwards.
Tensor turned(const std::array<double, 2>& k, double angle1) {
  const double c = std::cos(angle1 / kDegrees), s = std::sin(angle1 / kDegrees);
  return {k[0] * c * c + k[1] * s * s, (k[0] - k[1]) * c * s, k[0] * s * s + k[1] * c * c};
}
Tensor3 turned(const std::array<double, 3>& k, const std::array<double, 3>& angles) {
  const auto cosine = [&](std::size_t i) { return std::cos(angles[i] / kDegrees); };
  const auto sine = [&](std::size_t i) { return std::sin(angles[i] / kDegrees); };
  const double c1 = cosine(0), s1 = sine(0), c2 = cosine(1), s2 = sine(1), c3 = cosine(2), s3 = sine(2);
  const Vec3 first = {c1 * c2, s1 * c2, s2}, level = {-s1, c1, 0}, up = cross(first, level);
  const std::array<Vec3, 3> axes = {first, c3 * level - s3 * up, s3 * level + c3 * up};
  Tensor3 sum = {0, 0, 0, 0, 0, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [x, y, z] = axes[i];
    sum.xx += k[i] * x * x, sum.xy += k[i] * x * y, sum.xz += k[i] * x * z;
    sum.yy += k[i] * y * y, sum.yz += k[i] * y * z, sum.zz += k[i] * z * z;
  }
  return sum;
}

/// The tensor of one cell, from the numbers of its arrays; with `turns` they are conductivities and angles.
template <class K>
K tensor_of_numbers(const std::vector<double>& k, bool turns) {
  if (!turns) return tensor_from<K>(k);
  if constexpr (std::is_same_v<K, Tensor>)
    return turned({k[0], k[1]}, k[2]);
  else
    return turned({k[0], k[1], k[2]}, {k[3], k.size() > 4 ? k[4] : 0, k.size() > 5 ? k[5] : 0});
}

/// Several names are of conductivities along axes and of angles if the first one after the axes begins with "angle".
/// Else they are of the components.
template <class Subject>
std::vector<typename Subject::Tensor> from_data(const TensorOption& option, const InputOf<Subject>& input) {
  using K = typename Subject::Tensor;
  constexpr std::size_t n_components = std::tuple_size_v<decltype(K().components())>;
  const std::vector<std::string>& names = option.data;
  const bool is_one = names.size() == 1;
  const auto n_axes = static_cast<std::size_t>(Subject::dimension);
  const bool turns = names.size() > n_axes && names[n_axes].starts_with("angle");
  if (!is_one && !(turns && names.size() <= n_components) && names.size() != n_components) {
    throw Failure(Exit::bad_usage,
                  fmt::format("{}: --tensor: {} need one name of cell data, {} names of {}, or {}; found {} names",
                              input.path, Subject::elements, n_components, K::kNames,
                              n_axes == 2 ? "k11,k22,angle1" : "k11,k22,k33,angle1[,angle2[,angle3]]", names.size()));
  }
  std::vector<std::vector<double>> columns;
  columns.reserve(names.size());
  for (const std::string& name : names)
    columns.push_back(as_doubles(find_data(input, name, is_one ? static_cast<int>(n_components) : 1)));
  std::vector<K> tensors;
  for (const auto t : elements_of(input.mesh())) {
    std::vector<double> numbers;
    for (std::size_t i = 0; i < (is_one ? n_components : columns.size()); ++i)
      numbers.push_back(is_one ? columns[0][n_components * t.index + i] : columns[i][t.index]);
    tensors.push_back(tensor_of_numbers<K>(numbers, turns));
  }
  return tensors;
}

/// The tensor of these components. Fails if they are for other cells.
template <class Subject>
typename Subject::Tensor given_tensor(const std::vector<double>& components, const InputOf<Subject>& input) {
  using K = typename Subject::Tensor;
  if (components.size() != K().components().size()) {
    throw Failure(Exit::bad_usage,
                  fmt::format("{}: --tensor: {} need {} numbers {}, found {}", input.path, Subject::elements,
                              K().components().size(), Subject::tensor, components.size()));
  }
  return tensor_from<K>(components);
}

}  // namespace

template <class Subject>
void warn_of_crossings(const InputOf<Subject>& input, const typename Subject::Pieces& pieces) {
  const double apart = largest_gap(pieces);
  if (apart <= kSameCrossing) return;
  bool can_keep = true;
  if constexpr (requires { largest_gap_of_edges(pieces); }) can_keep = largest_gap_of_edges(pieces) > kSameCrossing;
  const std::string where = fmt::format(
      "{}: from its two sides, a dual edge crosses an interface between tensors at places that are up to {:.2g} edge "
      "lengths apart",
      input.path, apart);
  print_warnings(std::array{
      where + (can_keep ? ". Next: temper optimize or temper weights, with --tensor"
                        : ": the metrics of the tensors differ within its faces, and no weights change that")});
}

template <class Subject>
void name_copies(InputOf<Subject>& input, const typename Subject::Pieces& pieces) {
  if (!pieces.is_cut()) return;
  std::vector<std::size_t> first_copies, points;
  for (const VertexId v : pieces.mesh.vertices()) {
    const VertexId first = pieces.first_copy(v);
    first_copies.push_back(first.index);
    points.push_back(input.points.empty() ? first.index : input.points[first.index]);
  }
  input.points = std::move(points);
  input.names = std::make_shared<VertexNames>(input.names, std::move(first_copies), pieces.mesh.n_vertices());
}

template <class Subject>
CopyNumbers number_copies(const InputOf<Subject>& input, const typename Subject::Pieces& pieces) {
  const io::VertexOfPoint& vertices = input.loaded.vertex_of_point;
  CopyNumbers numbers = {input.points, {}, vertices};
  if (!pieces.is_cut()) return numbers;
  std::vector<bool> kept;
  for (std::size_t p = 0; p < vertices.size(); ++p) kept.push_back(vertices[p] >= 0);
  numbers.points.clear();
  for (const VertexId v : pieces.mesh.vertices()) {
    const VertexId first = pieces.first_copy(v);
    const std::size_t point = input.points.empty() ? first.index : input.points[first.index];
    if (first != v) numbers.copies.push_back({kept.size(), point, 0});
    numbers.points.push_back(first == v ? point : kept.size());
    if (first != v) kept.push_back(true);
  }
  for (const auto t : elements_of(pieces.mesh)) {
    for (const VertexId v : pieces.mesh.corners(t)) {
      if (const std::size_t number = numbers.points[v.index]; number >= vertices.size())
        numbers.copies[number - vertices.size()].cell = t.index;
    }
  }
  numbers.vertices = io::VertexOfPoint(kept);
  return numbers;
}

void add_tensor(Command& command, TensorOption& tensor, const std::string& what, CellKinds cells) {
  Option option;
  option.names = "--tensor";
  option.value_name = "K";
  option.sentence = what +
                    " in the metric of the diffusion tensor K of -div(K grad u). K is KXX,KXY,KYY for all, or "
                    "REGION=KXX,KXY,KYY for each region, repeated. Or K names cell data: one array of three numbers, "
                    "three arrays kxx,kxy,kyy, or k11,k22,angle1 as MODFLOW has them. " +
                    (cells == Triangles::cells ? "" : other_tensors()) + "See docs/howto/anisotropic.md.";
  option.take = [&tensor](const std::string& text) {
    take(tensor, text);
    tensor.spelled += " --tensor " + text;
  };
  option.values = Values::repeated;
  option.cells = cells;
  command.add(std::move(option));
}

void expect_without(const Command& command, const TensorOption& tensor, const std::string& option) {
  if (!tensor.given() || !command.was_given(option)) return;
  refuse_usage(command.name(), fmt::format("--tensor does not go with {}", option));
}

template <class Subject>
std::vector<typename Subject::Tensor> tensors_of(const TensorOption& tensor, const InputOf<Subject>& input) {
  if (!tensor.one.empty()) return {given_tensor(tensor.one, input)};
  if (!tensor.data.empty()) return from_data(tensor, input);
  if (tensor.of_regions.empty()) return {};
  std::map<std::int32_t, typename Subject::Tensor> values;
  for (const auto& [name, components] : tensor.of_regions) {
    const std::int32_t region = tag_of("--tensor", name, Subject::dimension, input);
    if (!values.emplace(region, given_tensor(components, input)).second)
      throw Failure(Exit::bad_usage, fmt::format("{}: --tensor: region {} has two values", input.path, region));
  }
  return at_elements("--tensor", values, input);
}

template <class Subject>
typename Subject::Pieces in_metric(const typename Subject::Mesh& mesh,
                                   const std::vector<typename Subject::Tensor>& tensors,
                                   const std::vector<double>& corner_weights, const InputOf<Subject>& input) {
  using Metrics = typename Subject::Metrics;
  const auto one = [&] { return MetricOf<typename Subject::Tensor>::of(tensors.front()); };
  const Expected<Metrics> metrics =
      tensors.size() == 1 ? Expected<Metrics>(Metrics(or_fail(one()))) : Metrics::of(tensors, *input.names);
  if (!metrics) throw as_failure(located(metrics.error(), input.path));
  auto there = mapped(mesh, *metrics, corner_weights, *input.names);
  if (!there) throw as_failure(located(there.error(), input.path));
  return *std::move(there);
}

template <class Subject>
void warn_without(const TensorOption& tensor, const InputOf<Subject>& input) {
  if (tensor.given() || !io::has_corner_weights(input.file)) return;
  print_warnings(std::array{fmt::format(
      "{}: has weights for each region, which are right with diffusion tensors alone. Next: give the tensors, too, by "
      "--tensor",
      input.path)});
}

template <class Subject>
std::optional<typename Subject::Pieces> metric_of(const InputOf<Subject>& input, const TensorOption& tensor) {
  warn_without(tensor, input);
  if (!tensor.given()) return {};
  return in_metric(input.mesh(), tensors_of(tensor, input), io::corner_weights_of(input.file, input.loaded), input);
}

template <class Subject>
std::optional<MetricViewOf<Subject>> take_to_metric(InputOf<Subject>& input, const TensorOption& tensor) {
  auto pieces = metric_of(input, tensor);
  if (!pieces) return {};
  MetricViewOf<Subject> view = {input.mesh(), *std::move(pieces)};
  warn_of_crossings(input, view.pieces);
  name_copies(input, view.pieces);
  input.loaded.mesh = view.pieces.mesh;
  return view;
}

// NOLINTBEGIN(bugprone-macro-parentheses): the name of a type has none
#define TEMPER_MAKE(S)                                                                                    \
  template std::vector<S::Tensor> tensors_of(const TensorOption&, const InputOf<S>&);                     \
  template S::Pieces in_metric(const S::Mesh&, const std::vector<S::Tensor>&, const std::vector<double>&, \
                               const InputOf<S>&);                                                        \
  template void name_copies(InputOf<S>&, const S::Pieces&);                                               \
  template CopyNumbers number_copies(const InputOf<S>&, const S::Pieces&);                                \
  template void warn_of_crossings(const InputOf<S>&, const S::Pieces&);                                   \
  template void warn_without(const TensorOption&, const InputOf<S>&);                                     \
  template std::optional<S::Pieces> metric_of(const InputOf<S>&, const TensorOption&);                    \
  template std::optional<MetricViewOf<S>> take_to_metric(InputOf<S>&, const TensorOption&);
// NOLINTEND(bugprone-macro-parentheses)
TEMPER_EACH_FLAT_SUBJECT(TEMPER_MAKE)
#undef TEMPER_MAKE

}  // namespace temper::app
