#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "io/formats/gmsh/reader.hpp"

namespace temper::io {

void GmshData::read(const std::string& section_name) {
  std::string name = "data";
  const std::size_t n_strings = in_.scanner.count("names", 2);
  in_.scanner.next_line();
  for (std::size_t i = 0; i < n_strings; ++i) {
    const std::string string = in_.quoted_string();
    if (i == 0) name = string;
  }
  double time = 0;
  const std::size_t n_reals = in_.scanner.count("real tags", 2);
  for (std::size_t i = 0; i < n_reals; ++i) {
    const double real = in_.scanner.real("a real tag");
    if (i == 0) time = real;
  }
  std::array<std::int32_t, 3> integers = {0, 1, 0};  // time step, components, entries
  const std::size_t n_integers = in_.scanner.count("integer tags", 2);
  for (std::size_t i = 0; i < n_integers; ++i) {
    const std::int32_t value = in_.scanner.integer("an integer tag");
    if (i < 3) integers[i] = value;
  }
  constexpr std::int32_t kMostComponents = 64;  // Gmsh itself uses 1, 3 and 9
  if (integers[1] < 1 || integers[1] > kMostComponents || integers[2] < 0) {
    in_.scanner.fail_here(ErrorCode::syntax, "data ", in_quotes(name), " have ", integers[1], " components and ",
                          integers[2], " entries");
  }
  const auto components = static_cast<std::size_t>(integers[1]), entries = static_cast<std::size_t>(integers[2]);
  in_.scanner.check_room(entries, "entries", in_.is_binary ? 4 + 8 * components : 2 + 2 * components);
  in_.begin_numbers();
  const bool nodes = section_name == "NodeData";
  auto& names = nodes ? node_data_ : element_data_;
  if (names.contains(name)) {
    name = text(name, "@", time);
  } else if (nodes || entries > 0) {
    names.insert(name);
  }
  nodes ? node_values(name, components, entries) : element_values(name, components, entries);
}
void GmshData::node_values(const std::string& name, std::size_t components, std::size_t entries) {
  MeshFile& f = document_.file;
  in_.allocation.take(f.points.size(), components, in_.where());
  std::vector<double> values(f.points.size() * components, std::numeric_limits<double>::quiet_NaN());
  std::vector<bool> given(f.points.size());
  for (std::size_t i = 0; i < entries; ++i) {
    const auto number = in_.get<std::int32_t>("the number of a node");
    const auto index = nodes_.find(number);
    if (!index) {
      fail(ErrorCode::index_out_of_range, in_.where(), "node data ", in_quotes(name), " are given for node ", number,
           ", which does not exist");
    }
    given[*index] = true;
    for (std::size_t k = 0; k < components; ++k)
      values[*index * components + k] = in_.get<double>("a value of node data");
  }
  const auto missing = static_cast<std::size_t>(std::count(given.begin(), given.end(), false));
  if (name == "weight" && components == 1) {
    if (missing > 0) {
      const auto first = static_cast<std::size_t>(std::find(given.begin(), given.end(), false) - given.begin());
      fail(ErrorCode::size_mismatch, in_.where(), "node data 'weight' miss ", missing, " of ", f.points.size(),
           " points, the first is ", document_.names->point(first));
    }
    f.weights = std::move(values);
    return;
  }
  if (missing > 0)
    f.warnings.push_back(text(in_.where(), ": node data ", in_quotes(name), " miss ", missing, " points: read as NaN"));
  f.point_data.push_back({name, static_cast<int>(components), std::move(values)});
}
void GmshData::element_values(const std::string& name, std::size_t components, std::size_t entries) {
  MeshFile& f = document_.file;
  struct Target {
    const NumberLookup* lookup;
    std::size_t n;
    std::vector<DataArray>* list;
    std::vector<double> values;
    std::size_t given = 0;
  };
  std::array<Target, 4> targets = {{{&*elements_.tets.lookup, elements_.tets.size(), &f.tetrahedra.data, {}},
                                    {&*elements_.triangles.lookup, elements_.triangles.size(), &f.triangles.data, {}},
                                    {&*elements_.lines.lookup, elements_.lines.size(), &f.lines.data, {}},
                                    {&*elements_.points.lookup, elements_.points.size(), &f.marked_points.data, {}}}};
  for (std::size_t i = 0; i < entries; ++i) {
    const auto number = in_.get<std::int32_t>("the number of an element");
    Target* target = nullptr;
    std::size_t index = 0;
    for (Target& candidate : targets) {
      if (const auto found = candidate.lookup->find(number)) {
        target = &candidate;
        index = *found;
        break;
      }
    }
    if (target == nullptr && elements_.left_out_lookup->find(number)) {
      for (std::size_t k = 0; k < components; ++k) in_.get<double>("a value of element data");
      continue;
    }
    if (target == nullptr) {
      fail(ErrorCode::index_out_of_range, in_.where(), "element data ", in_quotes(name), " are given for element ",
           number, ", which does not exist");
    }
    if (target->values.empty()) {
      in_.allocation.take(target->n, components, in_.where());
      target->values.assign(target->n * components, std::numeric_limits<double>::quiet_NaN());
    }
    ++target->given;
    for (std::size_t k = 0; k < components; ++k)
      target->values[index * components + k] = in_.get<double>("a value of element data");
  }
  for (Target& target : targets) {
    if (target.values.empty()) continue;
    if (target.given < target.n) {
      f.warnings.push_back(text(in_.where(), ": element data ", in_quotes(name), " miss ", target.n - target.given,
                                " elements: read as NaN"));
    }
    target.list->push_back({name, static_cast<int>(components), std::move(target.values)});
  }
}

}  // namespace temper::io
