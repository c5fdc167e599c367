#include "files/problem_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <type_traits>
#include <utility>

#include "files/region_values.hpp"
#include "options/options.hpp"
#include "temper/detail/suggest.hpp"

namespace temper::app {
namespace {

/// The names of arrays of single numbers.
std::vector<std::string_view> names_of_numbers(const std::vector<io::DataArray>& data) {
  std::vector<std::string_view> names;
  for (const io::DataArray& array : data) {
    if (array.components == 1) names.push_back(array.name);
  }
  return names;
}

/// The data of elements with this name.
template <class Subject>
std::vector<double> from_data(const Command& command, const std::string& name, const InputOf<Subject>& input) {
  const std::vector<io::DataArray>& data = (input.file.*Subject::cells_of_file).data;
  if (const io::DataArray* const found = find_numbers(data, name)) return as_doubles(*found);
  const std::vector<std::string_view> names = names_of_numbers(data);
  throw Failure(Exit::bad_usage,
                fmt::format("{}: {}: --coefficient: there are no data '{}' of {}; {}. Next: give one of these, "
                            "or REGION=K,...",
                            command.name(), input.path, name, Subject::elements,
                            names.empty() ? "the file has none of one number" : "there are " + join(names)));
}

/// "clay=1e-9" as the name and the number.
std::pair<std::string, double> name_and_value(const Command& command, const std::string& option,
                                              const std::string& entry) {
  const std::size_t equals = entry.rfind('=');
  const auto value = equals == std::string::npos ? std::nullopt : parse_number(entry.substr(equals + 1));
  if (!value) refuse_usage(command.name(), fmt::format("{}: expected NAME=NUMBER, found '{}'", option, entry));
  return {entry.substr(0, equals), *value};
}

template <class Subject>
std::vector<double> from_regions(const Command& command, const std::string& text, const InputOf<Subject>& input) {
  std::map<std::int32_t, double> values;
  for (const std::string& entry : separated(text)) {
    const auto [name, value] = name_and_value(command, "--coefficient", entry);
    const std::int32_t region = tag_of("--coefficient", name, Subject::dimension, input);
    if (!values.emplace(region, value).second)
      refuse_usage(command.name(), fmt::format("--coefficient: region {} has two values", region));
  }
  return at_elements("--coefficient", values, input);
}

}  // namespace

std::int32_t tag_of(const std::string& option, const std::string& word, int dimension, const std::string& path,
                    const std::vector<io::PhysicalName>& all) {
  std::vector<std::string_view> names;
  for (const io::PhysicalName& n : all) {
    if (n.dimension != dimension) continue;
    if (n.name == word) return n.tag;
    names.push_back(n.name);
  }
  const auto number = parse_number(word);
  if (number && *number == std::floor(*number) && std::abs(*number) < 2e9) return static_cast<std::int32_t>(*number);
  throw Failure(Exit::bad_usage, fmt::format("{}: {}: expected the number or name of {} before '=', found '{}'{}", path,
                                             option, dimension > 1 ? "a region" : "lines on the boundary", word,
                                             names.empty() ? "" : "; names are " + join(names)));
}

void add_coefficient(Command& command, std::string& target) {
  add_text(command, "--coefficient", "NAME", target,
           "Coefficient K > 0 of -div(K grad u) on each " + any_element() +
               ": the name of its data. Or write a value for each region, by number or name: 1=1e-4,clay=1e-9.");
}

template <class Subject>
std::vector<double> read_coefficient(const Command& command, const std::string& text, const InputOf<Subject>& input) {
  if (text.empty()) return {};
  return text.find('=') == std::string::npos ? from_data(command, text, input) : from_regions(command, text, input);
}
#define TEMPER_MAKE(S) \
  template std::vector<double> read_coefficient(const Command&, const std::string&, const InputOf<S>&);
TEMPER_EACH_SUBJECT(TEMPER_MAKE)
#undef TEMPER_MAKE

namespace {

/// The source at each vertex, from a number or the name of point data. Empty if the text is. Failure if there are no
/// such data.
std::vector<double> read_source(const Command& command, const std::string& text, const Input& input) {
  if (text.empty()) return {};
  if (const auto number = parse_number(text)) {
    std::vector<double> everywhere(input.mesh().n_vertices(), *number);
    return everywhere;
  }
  if (const io::DataArray* const found = find_numbers(input.file.point_data, text)) return at_vertices(input, *found);
  const std::vector<std::string_view> names = names_of_numbers(input.file.point_data);
  throw Failure(Exit::bad_usage, fmt::format("{}: {}: --source: expected a number or the name of point data, found "
                                             "'{}'; {}",
                                             command.name(), input.path, text,
                                             names.empty() ? "the file has no data" : "there are " + join(names)));
}

/// The name that gave a value to each edge, by its vertices.
using NamesOfEdges = std::map<std::pair<VertexId, VertexId>, std::string>;

/// Adds the parts of a text NAME=VALUE,…; "boundary" is all of it, except what has another name. Failure if two names
/// give values to one edge.
void add_boundary_values(const Command& command, bool is_flux, const std::string& text, const Input& input,
                         std::vector<BoundaryValue>& values, NamesOfEdges& names) {
  if (text.empty()) return;
  const std::string option = is_flux ? "--neumann" : "--dirichlet";
  const Mesh& mesh = input.mesh();
  const auto on_boundary = [&mesh](VertexId a, VertexId b) {
    const HalfedgeId h = mesh.find_halfedge(a, b), other = mesh.find_halfedge(b, a);
    return (h.valid() && mesh.is_boundary(h)) || (other.valid() && mesh.is_boundary(other));
  };
  for (const std::string& entry : separated(text)) {
    const auto [name, value] = name_and_value(command, option, entry);
    BoundaryValue part{{}, value, is_flux};
    const bool is_rest = name == "boundary";
    if (is_rest) {
      for (const HalfedgeId h : mesh.halfedges()) {
        if (mesh.is_boundary(h)) part.edges.push_back({mesh.origin(h), mesh.target(h)});
      }
    } else {
      const std::int32_t tag = tag_of(option, name, 1, input);
      for (std::size_t i = 0; i < input.file.lines.size(); ++i) {
        if (input.file.lines.tags[i] != tag) continue;
        const auto& [from, to] = input.file.lines[i];
        const std::int32_t a = input.loaded.vertex_of_point[static_cast<std::size_t>(from)],
                           b = input.loaded.vertex_of_point[static_cast<std::size_t>(to)];
        if (a < 0 || b < 0) continue;
        const VertexId v(static_cast<std::size_t>(a)), w(static_cast<std::size_t>(b));
        if (on_boundary(v, w)) part.edges.push_back({v, w});
      }
    }
    if (part.edges.empty()) {
      throw Failure(Exit::bad_usage, fmt::format("{}: {}: {}: no boundary edge has the tag '{}'", command.name(),
                                                 input.path, option, name));
    }
    if (is_rest) {
      values.insert(values.begin(), std::move(part));
      continue;
    }
    for (const auto& [a, b] : part.edges) {
      const auto [known, is_new] = names.emplace(std::minmax(a, b), name);
      if (is_new) continue;
      throw Failure(Exit::bad_usage,
                    fmt::format("{}: {}: the boundary edge from {} to {} has two values: by '{}' and by '{}'. Next: "
                                "give it one",
                                command.name(), input.path, input.names->point(a.index), input.names->point(b.index),
                                known->second, name));
    }
    values.push_back(std::move(part));
  }
}

}  // namespace

void add_problem(Command& command, ProblemOptions& options, const std::string& effect) {
  const std::size_t first = command.options().size();
  add_text(command, "--dirichlet", "NAME=U,...", options.dirichlet,
           "Values of u on parts of the boundary, by the name or tag of their lines; 'boundary' is the rest of it. " +
               effect);
  add_text(command, "--neumann", "NAME=Q,...", options.neumann,
           "Fluxes K du/dn into the domain, on parts of the boundary. Other edges have no flux.");
  add_text(command, "--source", "F|NAME", options.source, "Source f: a number, or the name of point data.");
  add_coefficient(command, options.coefficient);
  for (std::size_t i = first; i < command.options().size(); ++i) command.option_at(i).cells = CellKinds::triangles;
}

void expect_complete(const Command& command, const ProblemOptions& options) {
  for (const char* option : {"--neumann", "--source", "--coefficient"}) {
    if (command.was_given(option) && !options.given())
      refuse_usage(command.name(),
                   std::string(option) + " needs --dirichlet: without a value of u there is more than one solution");
  }
}

DiffusionProblem read_problem(const Command& command, const ProblemOptions& options, const Input& input) {
  DiffusionProblem problem = {
      read_coefficient(command, options.coefficient, input), read_source(command, options.source, input), {}};
  NamesOfEdges names;
  add_boundary_values(command, true, options.neumann, input, problem.boundary, names);
  add_boundary_values(command, false, options.dirichlet, input, problem.boundary, names);
  return problem;
}

}  // namespace temper::app
