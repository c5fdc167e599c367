// Gmsh MSH 2 and 4.1, ASCII and binary, either byte order.
//
// A physical tag is the region of a triangle or tetrahedron, or the tag of a line or point. The number of the geometric
// entity is kept as data gmsh:geometrical. NodeData and ElementData become data; the NodeData "weight" are the weights.
// Elements are sorted by their numbers: Gmsh gave them in this order, and other programs count by it.
//
// The first physical group of an entity is the region, or the tag. Lines, points and tagged faces are there once more
// for each further group, as version 2 lists them. Further groups of cells are data gmsh:physical:TAG, 1 inside. Cells
// with different sets of groups are different regions, so that the boundary of each group stays. If sets have one first
// group, only one of them keeps its tag, and the data gmsh:physical:first have it for all.
//
// A partition divides entities into parts, and adds entities between the parts. A part belongs to its parent again; its
// number is the data gmsh:partition. Elements between parts are left out. So are ghosts, the cells of other parts in
// the file of one part.
//
//     surface 1, curve 5 |  gmsh    surface 3 of 1 | curve 8 of 1, | surface 4 of 1     (dimension 2 of 2, 1 of 2, …)
//                        |  ---->   curve 9 of 5   | not of a curve| curve 10 of 5
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "io/conversion/data_update.hpp"
#include "io/formats/format.hpp"
#include "io/formats/gmsh.hpp"
#include "io/text/scanner.hpp"
#include "io/text/values.hpp"

namespace temper::io {
namespace {

std::string_view mesh_format_version(std::string_view head) {
  Scanner comments("", head, '#');
  comments.skip_space();
  head = comments.tail();
  const std::size_t at = head.find("$MeshFormat");
  if (at == std::string_view::npos || !head.starts_with('$')) return {};
  std::string_view rest = head.substr(at + std::string_view("$MeshFormat").size());
  const std::size_t first = rest.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos ? std::string_view{} : rest.substr(first, 8);
}

// Names of the types from 4.
constexpr std::array<std::string_view, 8> kElementNames = {"tetrahedron",
                                                           "hexahedron",
                                                           "prism",
                                                           "pyramid",
                                                           "quadratic line",
                                                           "quadratic triangle",
                                                           "quadratic quadrilateral",
                                                           "quadratic tetrahedron"};
std::string_view element_name(std::int32_t type) {
  if (type == 16) return "quadratic quadrilateral";
  return type >= 4 && type <= 11 ? kElementNames[static_cast<std::size_t>(type) - 4] : "element of an unknown type";
}

/// What an element belongs to.
struct Membership {
  std::int32_t physical = 0, entity = 0;
  std::vector<std::int32_t> further;       // physical groups after the first
  std::int32_t partition = 0;              // 0: the mesh has none
  bool is_reversed = false;                // the physical group has the entity in the other direction
  bool of_partition_alone = false;         // between its parts, or a ghost
  std::int32_t fourth_corner = kNoCorner;  // of a quadrilateral
};

/// The physical groups of a cell, the further ones in the order of their tags.
struct GroupSet {
  std::int32_t first = 0;
  std::vector<std::int32_t> further = {};
  friend bool operator<(const GroupSet& a, const GroupSet& b) {
    const std::size_t n_a = a.further.size(), n_b = b.further.size();
    return std::tie(a.first, n_a, a.further) < std::tie(b.first, n_b, b.further);
  }
};

/// Elements of one kind as they are read.
template <std::size_t N>
struct Elements {
  std::vector<std::array<std::int32_t, N>> nodes;
  std::vector<std::int32_t> physical, geometrical, partitions, fourth_corners;
  std::vector<std::pair<std::int64_t, std::int32_t>> further;  // number of an element, and one more of its groups
  RunLength numbers, text_lines;

  void add(const std::array<std::int32_t, N>& element_nodes, const Membership& of, std::int64_t number,
           std::int64_t text_line) {
    nodes.push_back(element_nodes);
    physical.push_back(of.physical);
    geometrical.push_back(of.entity);
    partitions.push_back(of.partition);
    for (const std::int32_t group : of.further) further.emplace_back(number, group);
    if (of.fourth_corner != kNoCorner || !fourth_corners.empty()) {
      fourth_corners.resize(nodes.size() - 1, kNoCorner);
      fourth_corners.push_back(of.fourth_corner);
    }
    numbers.push_back(number);
    text_lines.push_back(text_line);
  }
  /// Appends an element of another list.
  void add_from(const Elements& other, std::size_t i) {
    const auto row = static_cast<std::int64_t>(i);
    Membership of = {other.physical[i], other.geometrical[i], {}, other.partitions[i]};
    if (!other.fourth_corners.empty()) of.fourth_corner = other.fourth_corners[i];
    add(other.nodes[i], of, other.numbers[row], other.text_lines[row]);
  }
  void sort_by_number();
};

template <std::size_t N>
void Elements<N>::sort_by_number() {
  const std::size_t n = nodes.size();
  std::vector<std::int64_t> number(n);
  for (std::size_t i = 0; i < n; ++i) number[i] = numbers[static_cast<std::int64_t>(i)];
  if (std::is_sorted(number.begin(), number.end())) return;
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return number[a] < number[b]; });
  Elements sorted;
  sorted.further = std::move(further);
  for (const std::size_t i : order) sorted.add_from(*this, i);
  *this = std::move(sorted);
}

class GmshReader {
 public:
  explicit GmshReader(Source& source)
      : scanner_(source.path, source.bytes), document_(new_document(source.path)), allocation_(source.allocation) {}
  Document read() {
    while (!scanner_.at_end()) {
      if (scanner_.peek().starts_with('#')) {
        scanner_.next_line();
        continue;
      }
      const std::string name(scanner_.word("a section"));
      if (!name.starts_with('$'))
        scanner_.fail_here(ErrorCode::syntax, "expected a section ($…), found ", in_quotes(name));
      section(name.substr(1));
    }
    if (!has_nodes_) scanner_.fail_truncated("the section $Nodes");
    if (!has_elements_) scanner_.fail_truncated("the section $Elements");
    finish();
    return std::move(document_);
  }

 private:
  void section(const std::string& name) {
    if (name == "MeshFormat") {
      mesh_format();
    } else if (name == "PhysicalNames") {
      physical_names();
    } else if ((name == "Entities" || name == "PartitionedEntities") && version4_) {
      entities(name == "PartitionedEntities");
    } else if (name == "Nodes" || (name == "ParametricNodes" && !version4_)) {
      version4_ ? nodes_4() : nodes_2(name == "ParametricNodes");
      finish_nodes();
    } else if (name == "Elements") {
      if (!has_nodes_) scanner_.fail_here(ErrorCode::syntax, "expected $Nodes before $Elements");
      version4_ ? elements_4() : elements_2();
      finish_elements();
    } else if (name == "NodeData" || name == "ElementData") {
      data(name);
    } else {
      skip(name);
      return;
    }
    const std::string_view end = scanner_.word(text("$End", name));
    if (end != text("$End", name)) fail(ErrorCode::syntax, where(), "expected $End", name, ", found ", in_quotes(end));
  }
  void mesh_format() {
    const std::string version(scanner_.word("the version"));
    version4_ = version == "4.1";
    if (!version4_ && !version.starts_with('2')) {
      scanner_.fail_here(ErrorCode::unsupported, "is Gmsh MSH ", in_quotes(version), "; temper reads 2 and 4.1");
    }
    const std::int32_t type = scanner_.integer("the file type");
    const std::int32_t data_size = scanner_.integer("the data size");
    if (type != 0 && type != 1) scanner_.fail_here(ErrorCode::syntax, "expected file type 0 or 1, found ", type);
    if (data_size != 8) scanner_.fail_here(ErrorCode::unsupported, "has data of ", data_size, " bytes; expected 8");
    document_.file.format = version4_ ? "gmsh41" : "gmsh22";
    if (type == 0) return;
    scanner_.next_line();
    binary_ = true;
    const auto one = get<std::int32_t>("the number 1 in binary");
    if (one == 1) return;
    swap_ = true;
    if (one != 0x01000000) fail(ErrorCode::syntax, scanner_.path(), "expected the number 1 in binary, found ", one);
  }
  // Since version 2.1 `dimension tag "name"`, in 2.0 `tag "name"`.
  void physical_names() {
    const std::size_t n = scanner_.count("physical names", 4);
    for (std::size_t i = 0; i < n; ++i) {
      PhysicalName name;
      name.dimension = scanner_.integer("the dimension of a physical name");
      if (!version4_ && scanner_.more_on_line() && scanner_.peek().starts_with('"')) {
        name.tag = std::exchange(name.dimension, 0);
        name.name = quoted_string();
        names_without_dimension_.push_back(std::move(name));
        continue;
      }
      name.tag = scanner_.integer("the tag of a physical name");
      name.name = quoted_string();
      named_.emplace(name.dimension, name.tag);
      document_.file.names.push_back(std::move(name));
    }
  }
  /// A name without a dimension is for all dimensions whose elements carry its tag.
  void settle_names() {
    MeshFile& f = document_.file;
    const std::vector<std::int32_t>& regions = document_.file.tetrahedra.tags;
    const std::array<std::set<std::int32_t>, 4> tags = {
        std::set(f.marked_points.tags.begin(), f.marked_points.tags.end()),
        std::set(f.lines.tags.begin(), f.lines.tags.end()), std::set(f.triangles.tags.begin(), f.triangles.tags.end()),
        std::set(regions.begin(), regions.end())};
    for (const PhysicalName& name : names_without_dimension_) {
      bool used = false;
      for (const std::int32_t dimension : {0, 1, 2, 3}) {
        if (!tags[static_cast<std::size_t>(dimension)].contains(name.tag)) continue;
        f.names.push_back({dimension, name.tag, name.name});
        used = true;
      }
      if (used) continue;
      f.warnings.push_back(text(scanner_.path(), ": the physical name ", in_quotes(name.name), " of tag ", name.tag,
                                " is dropped: it has no dimension, and no element has the tag"));
    }
  }
  void entities(bool partitioned) {
    if (binary_) scanner_.next_line();
    if (partitioned) {
      get<std::uint64_t>("the number of partitions");
      const std::size_t n_ghosts = get_count("ghost entities", 4, 8);
      for (std::size_t i = 0; i < n_ghosts; ++i) {
        const auto tag = get<std::int32_t>("the tag of a ghost entity");
        Membership ghosts;
        ghosts.of_partition_alone = true;
        for (const std::int32_t dimension : {2, 3}) entities_.try_emplace({dimension, tag}, ghosts);  // cells have one
        get<std::int32_t>("the partition of a ghost entity");
      }
    }
    std::array<std::size_t, 4> counts;
    for (std::size_t& n : counts) n = get_count("entities", 10, 36);
    for (std::int32_t dimension = 0; dimension < 4; ++dimension) {
      for (std::size_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) entity(dimension, partitioned);
    }
  }
  void entity(std::int32_t dimension, bool partitioned) {
    const auto tag = get<std::int32_t>("the tag of an entity");
    Membership of;
    of.entity = tag;
    const Membership* parent = nullptr;
    if (partitioned) {
      const auto parent_dimension = get<std::int32_t>("the dimension of a parent");
      of.entity = get<std::int32_t>("the tag of a parent");
      of.of_partition_alone = parent_dimension != dimension;
      const auto found = entities_.find({dimension, of.entity});
      if (!of.of_partition_alone && found != entities_.end()) parent = &found->second;
      const std::size_t n_partitions = get_count("partitions", 2, 4);
      for (std::size_t k = 0; k < n_partitions; ++k) {
        const auto partition = get<std::int32_t>("a partition");
        if (k == 0) of.partition = partition;
      }
    }
    const int n_coordinates = dimension == 0 ? 3 : 6;
    for (int k = 0; k < n_coordinates; ++k) get<double>("a coordinate of an entity");
    const std::size_t n_physical = get_count("physical tags", 2, 4);
    for (std::size_t k = 0; k < n_physical; ++k) {
      const auto physical = get<std::int32_t>("a physical tag");
      if (k == 0)
        of.physical = physical;
      else
        of.further.push_back(physical);
    }
    const std::size_t n_bounding = dimension == 0 ? 0 : get_count("bounding entities", 2, 4);
    for (std::size_t k = 0; k < n_bounding; ++k) get<std::int32_t>("a bounding entity");
    of.is_reversed = is_of_reversed(dimension, of.physical, n_bounding > 0);
    if (of.is_reversed) of.physical = -of.physical;
    for (std::int32_t& group : of.further) {
      if (is_of_reversed(dimension, group, n_bounding > 0)) group = -group;
    }
    if (parent != nullptr && parent->physical != 0) {
      of.physical = parent->physical;
      of.further = parent->further;
      of.is_reversed = parent->is_reversed;
    }
    entities_[{dimension, tag}] = of;
  }
  /// In 4.1 a negative tag is that of a group that has the entity in the other direction. Entities of temper have no
  /// boundary, and their tags may be negative.
  [[nodiscard]] bool is_of_reversed(std::int32_t dimension, std::int32_t tag, bool has_boundary) const {
    return tag < 0 && tag > std::numeric_limits<std::int32_t>::min() && !is_named(dimension, tag) &&
           (has_boundary || is_named(dimension, -tag));
  }
  [[nodiscard]] bool is_named(std::int32_t dimension, std::int32_t tag) const {
    return named_.contains({dimension, tag});
  }
  void nodes_2(bool parametric) {
    const std::size_t n = scanner_.count("nodes", binary_ ? 28 : 8);
    if (binary_) scanner_.next_line();
    document_.file.points.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      const auto number = get<std::int32_t>("the number of a node");
      document_.names->points.push_back(number);
      if (!binary_) document_.names->point_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
      const double x = get<double>("the x coordinate of a node");
      const double y = get<double>("the y coordinate of a node");
      add_node(x, y, get<double>("the z coordinate of a node"));
      if (!parametric) continue;
      const auto dimension = get<std::int32_t>("the dimension of an entity");
      get<std::int32_t>("the tag of an entity");
      const int n_parameters = dimension == 1 || dimension == 2 ? dimension : 0;
      for (int k = 0; k < n_parameters; ++k) get<double>("a parameter of a node");
    }
  }
  void nodes_4() {
    if (binary_) scanner_.next_line();
    const std::size_t n_blocks = get_count("blocks of nodes", 8, 20);
    const std::size_t total = get_count("nodes", 8, 32);
    get<std::uint64_t>("the least number of a node");
    get<std::uint64_t>("the largest number of a node");
    document_.file.points.reserve(total);
    for (std::size_t b = 0; b < n_blocks; ++b) {
      const auto dimension = get<std::int32_t>("the dimension of an entity");
      get<std::int32_t>("the tag of an entity");
      const bool parametric = get<std::int32_t>("0 or 1: parametric") != 0;
      const std::size_t n = get_count("nodes", 8, 32);
      for (std::size_t i = 0; i < n; ++i) {
        document_.names->points.push_back(static_cast<std::int64_t>(get<std::uint64_t>("the number of a node")));
      }
      for (std::size_t i = 0; i < n; ++i) {
        const double x = get<double>("the x coordinate of a node");
        if (!binary_) document_.names->point_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
        const double y = get<double>("the y coordinate of a node");
        add_node(x, y, get<double>("the z coordinate of a node"));
        for (int k = 0; parametric && k < dimension; ++k) get<double>("a parameter of a node");
      }
    }
  }
  void elements_2() {
    const std::size_t n = scanner_.count("elements", binary_ ? 12 : 8);
    if (binary_) scanner_.next_line();
    std::int32_t type = 0, n_tags = 0;
    std::int32_t left_in_block = binary_ ? 0 : std::numeric_limits<std::int32_t>::max();
    for (std::size_t i = 0; i < n; ++i) {
      if (left_in_block == 0) {
        type = get<std::int32_t>("the type of elements");
        left_in_block = get<std::int32_t>("the number of elements of a block");
        n_tags = get<std::int32_t>("the number of tags");
        if (left_in_block <= 0) fail(ErrorCode::syntax, where(), "a block has ", left_in_block, " elements");
      }
      const auto number = get<std::int32_t>("the number of an element");
      if (!binary_) {
        type = get<std::int32_t>("the type of an element");
        n_tags = get<std::int32_t>("the number of tags");
      } else {
        --left_in_block;
      }
      if (n_tags < 0) fail(ErrorCode::syntax, where(), "element ", number, " has ", n_tags, " tags");
      add_element(type, number, membership_2(type, n_tags));
    }
  }
  /// Tags: physical, entity, number of partitions, these; a negative one has the element as a ghost. Before
  /// version 2.2: physical, entity, partition.
  Membership membership_2(std::int32_t type, std::int32_t n_tags) {
    Membership of;
    int n_partitions = 0;
    for (std::int32_t k = 0; k < n_tags; ++k) {
      const auto tag = get<std::int32_t>("a tag of an element");
      if (k == 0) of.physical = tag;
      if (k == 1) of.entity = tag;
      if (k == 3 || (k == 2 && n_tags == 3)) of.partition = tag;
      if (k >= 3 && tag > 0) ++n_partitions;
    }
    const std::int32_t dimension = type == kGmshPoint ? 0 : type == kGmshLine ? 1 : type == kGmshTetrahedron ? 3 : 2;
    of.of_partition_alone = n_partitions > 1 && dimension < 2 && !is_named(dimension, of.physical);
    return of;
  }
  void elements_4() {
    if (binary_) scanner_.next_line();
    const std::size_t n_blocks = get_count("blocks of elements", 8, 20);
    get_count("elements", 4, 16);
    get<std::uint64_t>("the least number of an element");
    get<std::uint64_t>("the largest number of an element");
    for (std::size_t b = 0; b < n_blocks; ++b) {
      const auto dimension = get<std::int32_t>("the dimension of an entity");
      const auto entity = get<std::int32_t>("the tag of an entity");
      const auto type = get<std::int32_t>("the type of elements");
      const std::size_t n = get_count("elements", 4, 16);
      Membership of;
      of.entity = entity;
      if (const auto found = entities_.find({dimension, entity}); found != entities_.end()) of = found->second;
      for (std::size_t i = 0; i < n; ++i) {
        const auto number = static_cast<std::int64_t>(get<std::uint64_t>("the number of an element"));
        add_element(type, number, of);
      }
    }
  }
  void data(const std::string& section_name) {
    if (!has_elements_) scanner_.fail_here(ErrorCode::syntax, "expected $Nodes and $Elements before $", section_name);
    std::string name = "data";
    const std::size_t n_strings = scanner_.count("names", 2);
    scanner_.next_line();
    for (std::size_t i = 0; i < n_strings; ++i) {
      const std::string string = quoted_string();
      if (i == 0) name = string;
    }
    double time = 0;
    const std::size_t n_reals = scanner_.count("real tags", 2);
    for (std::size_t i = 0; i < n_reals; ++i) {
      const double real = scanner_.real("a real tag");
      if (i == 0) time = real;
    }
    std::array<std::int32_t, 3> integers = {0, 1, 0};  // time step, components, entries
    const std::size_t n_integers = scanner_.count("integer tags", 2);
    for (std::size_t i = 0; i < n_integers; ++i) {
      const std::int32_t value = scanner_.integer("an integer tag");
      if (i < 3) integers[i] = value;
    }
    constexpr std::int32_t kMostComponents = 64;  // Gmsh itself uses 1, 3 and 9
    if (integers[1] < 1 || integers[1] > kMostComponents || integers[2] < 0) {
      scanner_.fail_here(ErrorCode::syntax, "data ", in_quotes(name), " have ", integers[1], " components and ",
                         integers[2], " entries");
    }
    const auto components = static_cast<std::size_t>(integers[1]), entries = static_cast<std::size_t>(integers[2]);
    scanner_.check_room(entries, "entries", binary_ ? 4 + 8 * components : 2 + 2 * components);
    if (binary_) scanner_.next_line();
    const bool nodes = section_name == "NodeData";
    auto& names = nodes ? node_data_ : element_data_;
    if (names.contains(name)) {
      name = text(name, "@", time);
    } else if (nodes || entries > 0) {
      names.insert(name);
    }
    nodes ? node_values(name, components, entries) : element_values(name, components, entries);
  }
  void node_values(const std::string& name, std::size_t components, std::size_t entries) {
    MeshFile& f = document_.file;
    allocation_.take(f.points.size(), components, where());
    std::vector<double> values(f.points.size() * components, std::numeric_limits<double>::quiet_NaN());
    std::vector<bool> given(f.points.size());
    for (std::size_t i = 0; i < entries; ++i) {
      const auto number = get<std::int32_t>("the number of a node");
      const auto index = lookup_->find(number);
      if (!index) {
        fail(ErrorCode::index_out_of_range, where(), "node data ", in_quotes(name), " are given for node ", number,
             ", which does not exist");
      }
      given[*index] = true;
      for (std::size_t k = 0; k < components; ++k)
        values[*index * components + k] = get<double>("a value of node data");
    }
    const auto missing = static_cast<std::size_t>(std::count(given.begin(), given.end(), false));
    if (name == "weight" && components == 1) {
      if (missing > 0) {
        const auto first = static_cast<std::size_t>(std::find(given.begin(), given.end(), false) - given.begin());
        fail(ErrorCode::size_mismatch, where(), "node data 'weight' miss ", missing, " of ", f.points.size(),
             " points, the first is ", document_.names->point(first));
      }
      f.weights = std::move(values);
      return;
    }
    if (missing > 0)
      f.warnings.push_back(text(where(), ": node data ", in_quotes(name), " miss ", missing, " points: read as NaN"));
    f.point_data.push_back({name, static_cast<int>(components), std::move(values)});
  }
  void element_values(const std::string& name, std::size_t components, std::size_t entries) {
    MeshFile& f = document_.file;
    struct Target {
      const NumberLookup* lookup;
      std::size_t n;
      std::vector<DataArray>* list;
      std::vector<double> values;
      std::size_t given = 0;
    };
    std::array<Target, 4> targets = {{{&*tet_lookup_, tets_.nodes.size(), &document_.file.tetrahedra.data, {}},
                                      {&*triangle_lookup_, triangles_.nodes.size(), &f.triangles.data, {}},
                                      {&*line_lookup_, lines_.nodes.size(), &f.lines.data, {}},
                                      {&*point_lookup_, points_.nodes.size(), &f.marked_points.data, {}}}};
    for (std::size_t i = 0; i < entries; ++i) {
      const auto number = get<std::int32_t>("the number of an element");
      Target* target = nullptr;
      std::size_t index = 0;
      for (Target& candidate : targets) {
        if (const auto found = candidate.lookup->find(number)) {
          target = &candidate;
          index = *found;
          break;
        }
      }
      if (target == nullptr && left_out_lookup_->find(number)) {
        for (std::size_t k = 0; k < components; ++k) get<double>("a value of element data");
        continue;
      }
      if (target == nullptr) {
        fail(ErrorCode::index_out_of_range, where(), "element data ", in_quotes(name), " are given for element ",
             number, ", which does not exist");
      }
      if (target->values.empty()) {
        allocation_.take(target->n, components, where());
        target->values.assign(target->n * components, std::numeric_limits<double>::quiet_NaN());
      }
      ++target->given;
      for (std::size_t k = 0; k < components; ++k)
        target->values[index * components + k] = get<double>("a value of element data");
    }
    for (Target& target : targets) {
      if (target.values.empty()) continue;
      if (target.given < target.n) {
        f.warnings.push_back(text(where(), ": element data ", in_quotes(name), " miss ", target.n - target.given,
                                  " elements: read as NaN"));
      }
      target.list->push_back({name, static_cast<int>(components), std::move(target.values)});
    }
  }
  void skip(const std::string& name) {
    const std::string at = where();
    if (!scanner_.until(text("$End", name))) scanner_.fail_truncated(text("$End", name));
    if (name != "Comments" && name != "Entities")
      document_.file.warnings.push_back(text(at, ": section $", name, " is dropped"));
  }
  template <std::size_t N>
  void add_groups(Elements<N>& cells, const NumberLookup& lookup, std::vector<DataArray>& data) {
    if (cells.further.empty()) return;
    std::map<std::int32_t, std::vector<std::int32_t>> groups;
    for (const auto& [number, group] : cells.further) {
      std::vector<std::int32_t>& inside = groups[group];
      if (inside.empty()) allocation_.take(cells.nodes.size(), 1, scanner_.path());
      inside.resize(cells.nodes.size());
      inside[*lookup.find(number)] = 1;
    }
    part_regions(cells, groups, data);
    for (auto& [group, inside] : groups) data.push_back({text(kFurtherGroup, group), 1, std::move(inside)});
  }
  /// Makes cells with different sets of groups different regions. `inside` has 1 for each cell of a further group.
  template <std::size_t N>
  void part_regions(Elements<N>& cells, const std::map<std::int32_t, std::vector<std::int32_t>>& inside,
                    std::vector<DataArray>& data) {
    std::vector<GroupSet> set_of_cell(cells.nodes.size());
    std::map<GroupSet, std::int32_t> region_of;
    for (std::size_t i = 0; i < set_of_cell.size(); ++i) {
      set_of_cell[i].first = cells.physical[i];
      for (const auto& [group, values] : inside) {
        if (values[i] != 0 && group != cells.physical[i]) set_of_cell[i].further.push_back(group);
      }
      region_of.emplace(set_of_cell[i], 0);
    }
    name_regions(static_cast<std::int32_t>(N) - 1, region_of);
    std::vector<std::int32_t> firsts = cells.physical;
    for (std::size_t i = 0; i < firsts.size(); ++i) cells.physical[i] = region_of[set_of_cell[i]];
    if (firsts == cells.physical) return;
    allocation_.take(firsts.size(), 1, scanner_.path());
    data.push_back({std::string(kFirstGroup), 1, std::move(firsts)});
  }
  /// Of sets with one first group, the smallest keeps its tag. Another set takes the tag of a group that no other set
  /// has, as an inner group. Else it gets a free tag, and a name from its groups.
  void name_regions(std::int32_t dimension, std::map<GroupSet, std::int32_t>& region_of) {
    std::map<std::int32_t, std::size_t> n_sets;  // with this group
    std::set<std::int32_t> taken, is_first;
    for (const auto& [groups, region] : region_of) {
      is_first.insert(groups.first);
      ++n_sets[groups.first];
      for (const std::int32_t group : groups.further) ++n_sets[group];
    }
    for (const auto& [group, n] : n_sets) taken.insert(group);
    for (const PhysicalName& name : document_.file.names) taken.insert(name.tag);
    std::set<std::int32_t> has_region;          // first groups
    for (auto& [groups, region] : region_of) {  // the smallest set of each first group before the others
      const auto own = std::find_if(groups.further.begin(), groups.further.end(), [&](std::int32_t group) {
        return n_sets[group] == 1 && !is_first.contains(group);
      });
      if (has_region.insert(groups.first).second) {
        region = groups.first;
      } else if (own != groups.further.end()) {
        region = *own;
      } else {
        region = free_tag(taken);
        taken.insert(region);
        std::string name = group_name(dimension, groups.first);
        for (const std::int32_t group : groups.further) name += " and " + group_name(dimension, group);
        document_.file.names.push_back({dimension, region, std::move(name)});
      }
    }
  }
  [[nodiscard]] std::string group_name(std::int32_t dimension, std::int32_t tag) const {
    for (const PhysicalName& name : document_.file.names) {
      if (name.dimension == dimension && name.tag == tag) return name.name;
    }
    return std::to_string(tag);
  }
  template <std::size_t N>
  static void repeat_for_groups(Elements<N>& elements, const NumberLookup& lookup, std::vector<DataArray>& data) {
    if (elements.further.empty()) return;
    std::vector<std::size_t> rows(elements.nodes.size());
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    const std::vector<std::pair<std::int64_t, std::int32_t>> further = std::move(elements.further);
    for (const auto& [number, group] : further) {
      rows.push_back(*lookup.find(number));
      elements.add_from(elements, rows.back());
      elements.physical.back() = group;
    }
    take_rows(data, rows);
  }
  /// The group that the writer gives to elements without one is no group.
  void forget_ungrouped() {
    const auto forget = [](auto& elements, std::int32_t tag) {
      std::replace(elements.physical.begin(), elements.physical.end(), tag, 0);
      std::erase_if(elements.further, [tag](const auto& element) { return element.second == tag; });
    };
    std::erase_if(document_.file.names, [&](const PhysicalName& name) {
      const std::int32_t d = name.dimension;
      if (d < 0 || d > 3 || name.name != kGmshUngrouped[static_cast<std::size_t>(d)]) return false;
      if (d == 0) forget(points_, name.tag);
      if (d == 1) forget(lines_, name.tag);
      if (d == 2) forget(triangles_, name.tag);
      if (d == 3) forget(tets_, name.tag);
      return true;
    });
  }
  void settle_groups() {
    forget_ungrouped();
    MeshFile& f = document_.file;
    const bool has_tets = !tets_.nodes.empty();
    add_groups(tets_, *tet_lookup_, document_.file.tetrahedra.data);
    has_tets ? repeat_for_groups(triangles_, *triangle_lookup_, f.triangles.data)
             : add_groups(triangles_, *triangle_lookup_, f.triangles.data);
    repeat_for_groups(lines_, *line_lookup_, f.lines.data);
    repeat_for_groups(points_, *point_lookup_, f.marked_points.data);
  }
  void finish() {
    settle_groups();
    MeshFile& f = document_.file;
    const auto hand_over = [](auto& elements, auto& nodes, auto& tags, auto& data) {
      nodes = std::move(elements.nodes);
      tags = std::move(elements.physical);
      const bool has_entities =
          std::any_of(elements.geometrical.begin(), elements.geometrical.end(), [](auto e) { return e != 0; });
      if (has_entities) data.push_back({std::string(kGmshEntity), 1, std::move(elements.geometrical)});
    };
    document_.fourth_corners = std::move(triangles_.fourth_corners);
    const auto hand_over_cells = [&](auto& elements, auto& nodes, auto& regions, auto& data) {
      auto& partitions = elements.partitions;
      if (std::any_of(partitions.begin(), partitions.end(), [](auto p) { return p != 0; }))
        data.push_back({std::string(kGmshPartition), 1, std::move(partitions)});
      hand_over(elements, nodes, regions, data);
      // No physical group at all: no regions.
      if (std::count(regions.begin(), regions.end(), 0) == std::ssize(regions)) regions.clear();
    };
    hand_over_cells(triangles_, f.triangles.corners, f.triangles.tags, f.triangles.data);
    hand_over_cells(tets_, f.tetrahedra.corners, f.tetrahedra.tags, f.tetrahedra.data);
    hand_over(lines_, f.lines.corners, f.lines.tags, f.lines.data);
    f.marked_points.corners.reserve(points_.nodes.size());
    for (const auto& [node] : points_.nodes) f.marked_points.corners.push_back(node);
    std::vector<std::array<std::int32_t, 1>> unused;
    hand_over(points_, unused, f.marked_points.tags, f.marked_points.data);
    settle_names();

    FileNames& names = *document_.names;
    names.triangles = std::move(triangles_.numbers);
    names.lines = std::move(lines_.numbers);
    names.tetrahedra = std::move(tets_.numbers);
    if (!binary_) {
      names.tetrahedron_lines = std::move(tets_.text_lines);
      names.triangle_lines = std::move(triangles_.text_lines);
      names.line_lines = std::move(lines_.text_lines);
    }
    if (n_of_partition_ > 0) {
      f.warnings.push_back(text(scanner_.path(), ": ", n_of_partition_, n_of_partition_ == 1 ? " element" : " elements",
                                " that the partition added ", n_of_partition_ == 1 ? "is" : "are", " left out"));
    }
  }

  void add_node(double x, double y, double z) {
    MeshFile& f = document_.file;
    f.points.push_back({x, y});
    PlaneCheck(document_).add(f.points.size() - 1, z);
  }
  void finish_nodes() {
    if (has_nodes_) {
      fail(ErrorCode::syntax, where(),
           "has two sections $Nodes; expected one mesh. Next: append views of Gmsh with PostProcessing.SaveMesh = 0");
    }
    has_nodes_ = true;
    lookup_.emplace(document_.names->points);
    if (const auto twice = lookup_->duplicate()) {
      fail(ErrorCode::syntax, where(), "node number ", *twice, " is given twice");
    }
  }
  void add_element(std::int32_t type, std::int64_t number, const Membership& of) {
    if (!of.further.empty()) allocation_.take(of.further.size(), 1, where());
    const auto line = static_cast<std::int64_t>(scanner_.line());
    switch (type) {
      case kGmshTetrahedron: {
        const auto corners = nodes_of<4>("tetrahedron", number);
        return of.of_partition_alone ? leave_out(number) : tets_.add(corners, of, number, line);
      }
      case kGmshTriangle: {
        const auto corners = nodes_of<3>("triangle", number);
        return of.of_partition_alone ? leave_out(number) : triangles_.add(corners, of, number, line);
      }
      case kGmshQuadrilateral: {
        const auto [a, b, c, d] = nodes_of<4>("quadrilateral", number);
        Membership of_face = of;
        of_face.fourth_corner = d;
        return of.of_partition_alone ? leave_out(number) : triangles_.add({a, b, c}, of_face, number, line);
      }
      case kGmshLine: {
        auto ends = nodes_of<2>("line", number);
        if (of.is_reversed) std::swap(ends[0], ends[1]);
        return of.of_partition_alone ? leave_out(number) : lines_.add(ends, of, number, line);
      }
      case kGmshPoint: {
        const auto point = nodes_of<1>("point element", number);
        return of.of_partition_alone ? leave_out(number) : points_.add(point, of, number, line);
      }
      default:
        refuse_element(where(), number, element_name(type), KindsOfCells::all);
    }
  }
  void leave_out(std::int64_t number) {
    left_out_.push_back(number);
    ++n_of_partition_;
  }
  template <std::size_t N>
  [[nodiscard]] std::array<std::int32_t, N> nodes_of(std::string_view kind, std::int64_t element) {
    std::array<std::int32_t, N> nodes;
    for (std::int32_t& node : nodes) node = node_index(kind, element);
    return nodes;
  }
  [[nodiscard]] std::int32_t node_index(std::string_view kind, std::int64_t element) {
    const std::int64_t number = version4_ ? static_cast<std::int64_t>(get<std::uint64_t>("the number of a node"))
                                          : get<std::int32_t>("the number of a node");
    const auto index = lookup_->find(number);
    if (index) return static_cast<std::int32_t>(*index);
    const std::size_t n = document_.file.points.size();
    const bool contiguous = document_.names->points.counts_from(1);
    fail(ErrorCode::index_out_of_range, where(), kind, " ", element, " uses vertex ", number, ", but the file has ",
         contiguous ? text(n, " vertices, numbered from 1") : "no vertex of that number");
  }
  // In version 2 an element with several physical groups is listed once for each: the others become further groups.
  template <std::size_t N>
  void keep_one_of_each(Elements<N>& elements) {
    const std::vector<std::int32_t>& physical = elements.physical;
    if (std::adjacent_find(physical.begin(), physical.end(), std::not_equal_to<>()) == physical.end()) return;
    std::vector<std::pair<std::array<std::int32_t, N>, std::size_t>> all;
    all.reserve(physical.size());
    for (std::array<std::int32_t, N> corners : elements.nodes) {
      std::sort(corners.begin(), corners.end());
      all.emplace_back(corners, all.size());
    }
    std::sort(all.begin(), all.end());
    std::vector<bool> repeated(all.size());
    for (std::size_t first = 0, i = 1; i < all.size(); ++i) {
      const std::size_t a = all[first].second, b = all[i].second;
      const bool same = all[i].first == all[first].first && physical[a] != physical[b] &&
                        elements.geometrical[a] == elements.geometrical[b];
      repeated[b] = same;
      if (same) elements.further.emplace_back(elements.numbers[static_cast<std::int64_t>(a)], physical[b]);
      if (!same) first = i;
    }
    if (std::find(repeated.begin(), repeated.end(), true) == repeated.end()) return;
    Elements<N> kept;
    kept.further = std::move(elements.further);
    for (std::size_t i = 0; i < repeated.size(); ++i) {
      if (repeated[i])
        left_out_.push_back(elements.numbers[static_cast<std::int64_t>(i)]);
      else
        kept.add_from(elements, i);
    }
    elements = std::move(kept);
  }
  void finish_elements() {
    if (has_elements_) fail(ErrorCode::syntax, where(), "has two sections $Elements");
    has_elements_ = true;
    triangles_.sort_by_number();
    lines_.sort_by_number();
    points_.sort_by_number();
    tets_.sort_by_number();
    if (!version4_) {
      if (tets_.nodes.empty()) keep_one_of_each(triangles_);  // beside tetrahedra they are tags, of which all stay
      keep_one_of_each(tets_);
    }
    tet_lookup_.emplace(tets_.numbers);
    triangle_lookup_.emplace(triangles_.numbers);
    left_out_lookup_.emplace(left_out_);
    line_lookup_.emplace(lines_.numbers);
    point_lookup_.emplace(points_.numbers);
  }
  std::string quoted_string() {
    std::string_view line = scanner_.rest_of_line();
    if (line.size() >= 2 && line.front() == '"' && line.back() == '"') line = line.substr(1, line.size() - 2);
    return std::string(line);
  }
  std::string where() const { return binary_ ? scanner_.path() : scanner_.where(); }

  /// The next number: a word of text, or its bytes.
  template <class T>
  T get(std::string_view expected) {
    if (!binary_) return scanner_.number<T>(expected);
    const std::string_view bytes = scanner_.bytes(sizeof(T), expected);
    std::array<char, sizeof(T)> copy;
    std::copy(bytes.begin(), bytes.end(), copy.begin());
    if (swap_) std::reverse(copy.begin(), copy.end());
    T value;
    std::memcpy(&value, copy.data(), sizeof(T));
    return value;
  }
  /// Reads the number of items that follow. Each has at least `text_bytes` as text, and `binary_bytes` in binary.
  std::size_t get_count(std::string_view things, std::size_t text_bytes, std::size_t binary_bytes) {
    const auto n = get<std::uint64_t>(text("the number of ", things));
    scanner_.check_room(n, things, binary_ ? binary_bytes : text_bytes);
    return static_cast<std::size_t>(n);
  }

  Scanner scanner_;
  Document document_;
  AllocationLimits& allocation_;
  bool binary_ = false, swap_ = false, version4_ = false, has_nodes_ = false, has_elements_ = false;
  std::optional<NumberLookup> lookup_;
  std::map<std::pair<std::int32_t, std::int32_t>, Membership> entities_;  // by dimension and tag
  std::vector<PhysicalName> names_without_dimension_;
  std::set<std::pair<std::int32_t, std::int32_t>> named_;  // dimension and tag
  Elements<4> tets_;
  Elements<3> triangles_;
  Elements<2> lines_;
  Elements<1> points_;
  std::optional<NumberLookup> tet_lookup_, triangle_lookup_, line_lookup_, point_lookup_;
  RunLength left_out_;  // the numbers of elements of the partition alone, and of triangles that are there already
  std::optional<NumberLookup> left_out_lookup_;
  std::size_t n_of_partition_ = 0;
  std::set<std::string> node_data_, element_data_;  // names
};

}  // namespace

bool sniff_gmsh22(std::string_view head) { return mesh_format_version(head).starts_with("2"); }
bool sniff_gmsh41(std::string_view head) { return mesh_format_version(head).starts_with("4.1"); }

Document read_gmsh(Source& source) { return GmshReader(source).read(); }

}  // namespace temper::io
