// The steps of reading a Gmsh file, and what they pass on: bytes, entities, elements, data, groups.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "io/disk/files.hpp"
#include "io/formats/format.hpp"
#include "io/text/scanner.hpp"

namespace temper::io {

/// The bytes of a file: numbers as text or in binary, in either byte order.
class GmshSource {
 public:
  explicit GmshSource(Source& source) : scanner(source.path, source.bytes), allocation(source.allocation) {}

  [[nodiscard]] std::string where() const { return is_binary ? scanner.path() : scanner.where(); }
  /// The next number: a word of text, or its bytes.
  template <class T>
  T get(std::string_view expected) {
    if (!is_binary) return scanner.number<T>(expected);
    const std::string_view bytes = scanner.bytes(sizeof(T), expected);
    std::array<char, sizeof(T)> copy;
    std::copy(bytes.begin(), bytes.end(), copy.begin());
    if (is_swapped) std::reverse(copy.begin(), copy.end());
    T value;
    std::memcpy(&value, copy.data(), sizeof(T));
    return value;
  }
  /// Reads the number of items that follow. Each has at least `text_bytes` as text, and `binary_bytes` in binary.
  std::size_t get_count(std::string_view things, std::size_t text_bytes, std::size_t binary_bytes) {
    const auto n = get<std::uint64_t>(text("the number of ", things));
    scanner.check_room(n, things, is_binary ? binary_bytes : text_bytes);
    return static_cast<std::size_t>(n);
  }
  /// Binary numbers begin on the next line.
  void begin_numbers() {
    if (is_binary) scanner.next_line();
  }
  [[nodiscard]] std::string quoted_string() {
    std::string_view line = scanner.rest_of_line();
    if (line.size() >= 2 && line.front() == '"' && line.back() == '"') line = line.substr(1, line.size() - 2);
    return std::string(line);
  }

  Scanner scanner;
  AllocationLimits& allocation;
  bool is_binary = false, is_swapped = false, is_version4 = false;
};

/// What an element belongs to.
struct Membership {
  std::int32_t physical = 0, entity = 0;
  std::vector<std::int32_t> further;       // physical groups after the first
  std::int32_t partition = 0;              // 0: the mesh has none
  bool is_reversed = false;                // the physical group has the entity in the other direction
  bool of_partition_alone = false;         // between its parts, or a ghost
  std::int32_t fourth_corner = kNoCorner;  // of a quadrilateral
};

/// The names of groups: their dimensions and tags.
using NamedGroups = std::set<std::pair<std::int32_t, std::int32_t>>;

/// The entities of version 4, by dimension and tag.
class GmshEntities {
 public:
  /// Reads the section $Entities, or $PartitionedEntities, which comes after it.
  void read(GmshSource& in, bool partitioned, const NamedGroups& named);
  /// What elements of an entity belong to.
  [[nodiscard]] Membership of(std::int32_t dimension, std::int32_t tag) const;

 private:
  void read_ghosts(GmshSource& in);
  void read_entity(GmshSource& in, std::int32_t dimension, bool partitioned, const NamedGroups& named);
  std::map<std::pair<std::int32_t, std::int32_t>, Membership> entities_;
};

/// Elements of one kind as they are read.
template <std::size_t N>
struct Elements {
  std::vector<std::array<std::int32_t, N>> nodes;
  std::vector<std::int32_t> physical, geometrical, partitions, fourth_corners;
  std::vector<std::pair<std::int64_t, std::int32_t>> further;  // number of an element, and one more of its groups
  RunLength numbers, text_lines;
  std::optional<NumberLookup> lookup = {};  // by number, when all are there

  [[nodiscard]] std::size_t size() const { return nodes.size(); }

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

struct GmshElements {
  Elements<1> points;
  Elements<2> lines;
  Elements<3> triangles;  // and quadrilaterals
  Elements<4> tets;
  RunLength left_out;  // the numbers of elements of the partition alone, and of cells that are there already
  std::optional<NumberLookup> left_out_lookup = {};
  std::size_t n_of_partition = 0;

  [[nodiscard]] auto all() { return std::tie(points, lines, triangles, tets); }
  /// Sorts elements by number, and makes further groups of those that version 2 lists again.
  void finish(bool version4);
};

/// Data of nodes and elements.
class GmshData {
 public:
  /// All must outlive it.
  GmshData(GmshSource& in, Document& document, const NumberLookup& nodes, const GmshElements& elements)
      : in_(in), document_(document), nodes_(nodes), elements_(elements) {}
  /// Reads a section $NodeData or $ElementData.
  void read(const std::string& section_name);

 private:
  void node_values(const std::string& name, std::size_t components, std::size_t entries);
  void element_values(const std::string& name, std::size_t components, std::size_t entries);
  GmshSource& in_;
  Document& document_;
  const NumberLookup& nodes_;
  const GmshElements& elements_;
  std::set<std::string> node_data_, element_data_;  // names
};

/// Makes one tag of the groups of each element, and data of the further ones. Data of the elements are those that the
/// document has, and follow.
void settle_groups(GmshElements& elements, Document& document, AllocationLimits& allocation);

}  // namespace temper::io
