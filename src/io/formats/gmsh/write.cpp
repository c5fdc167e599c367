// Writes Gmsh MSH 2, 2.2 and 4.1, ASCII and binary.
//
// Elements are numbered points first, then lines, triangles and tetrahedra, so that the reader finds their order again.
// All elements of a Gmsh entity are in the same physical groups, so entities are the distinct pairs (entity, groups).
// The first group is the region or tag, or comes from the data gmsh:physical:first. Further groups come from the data
// gmsh:physical:TAG. Version 2 lists an element once more for each further group. Numbers of entities come from the
// data gmsh:geometrical, or else from the groups.
//
// Gmsh drops elements without a physical group if another element has one, and meshio cannot read such a file. Then the
// elements without one are in a group of their own: kGmshUngrouped.
// NodeData and ElementData hold doubles alone.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>

#include "io/conversion/globe.hpp"
#include "io/formats/format.hpp"
#include "io/formats/gmsh/gmsh.hpp"
#include "io/text/values.hpp"

namespace temper::io {
namespace {

/// Physical groups: the region or tag, 0 if there is none, and the tags of further ones.
struct GroupsOfCell {
  std::int32_t first = 0;
  std::vector<std::int32_t> further;
  friend auto operator<=>(const GroupsOfCell&, const GroupsOfCell&) = default;
};

/// Elements of one kind, whatever their number of corners.
struct Kind {
  std::int32_t dimension = 0;
  std::int32_t type = 0;
  std::size_t n = 0;
  std::size_t corners = 1;
  const std::int32_t* nodes = nullptr;
  const std::vector<std::int32_t>* tags = nullptr;  // empty: all 0
  const std::vector<DataArray>* data = nullptr;
  std::size_t first_number = 1;
  std::vector<std::int32_t> entities = {};  // of each element; empty: all `only_entity`
  std::int32_t only_entity = 1;
  std::vector<std::pair<std::int32_t, std::vector<double>>> further_groups = {};  // tag, and of each element: 0 outside
  std::map<std::int32_t, GroupsOfCell> groups_of_entity = {};
  std::vector<std::int32_t> firsts = {};  // gmsh:physical:first; empty: the tags
  std::int32_t ungrouped = 0;             // the group of all elements without one

  [[nodiscard]] std::int32_t tag(std::size_t i) const { return tags->empty() ? 0 : (*tags)[i]; }
  [[nodiscard]] GroupsOfCell groups(std::size_t i) const {
    GroupsOfCell all = {firsts.empty() ? tag(i) : firsts[i], {}};
    for (const auto& [group, inside] : further_groups) {
      if (group != all.first && inside[i] != 0 && !std::isnan(inside[i])) all.further.push_back(group);
    }
    if (all.first == 0 && !all.further.empty()) {
      all.first = all.further.front();
      all.further.erase(all.further.begin());
    }
    if (all.first == 0) all.first = ungrouped;
    return all;
  }
  [[nodiscard]] std::int32_t entity(std::size_t i) const { return entities.empty() ? only_entity : entities[i]; }
};

template <int dimension>
Kind kind_of(std::int32_t type, const Cells<dimension>& cells, std::size_t first_number) {
  Kind kind = {.dimension = dimension, .type = type, .n = cells.size(), .corners = dimension + 1};
  if (!cells.empty()) kind.nodes = corners_of(cells[0]).data();
  kind.tags = &cells.tags;
  kind.data = &cells.data;
  kind.first_number = first_number;
  return kind;
}

/// The entity numbers that came with the file, if any.
const std::vector<std::int32_t>* given_entities(const Kind& kind) {
  const DataArray* array = find(*kind.data, kGmshEntity);
  return array == nullptr || array->components != 1 ? nullptr : std::get_if<std::vector<std::int32_t>>(&array->values);
}

/// Numbers entities so that all elements of each are in the same groups.
void number_entities(Kind& kind) {
  if (kind.n == 0) return;
  const auto* given = given_entities(kind);
  const bool uniform =
      given == nullptr && kind.further_groups.empty() && kind.firsts.empty() &&
      (kind.tags->empty() || std::count(kind.tags->begin(), kind.tags->end(), kind.tag(0)) == std::ssize(*kind.tags));
  if (uniform) {
    kind.groups_of_entity[kind.only_entity] = kind.groups(0);
    return;
  }
  std::map<std::pair<std::int32_t, GroupsOfCell>, std::int32_t> entity_of_pair;
  const auto pair_of = [&](std::size_t i) { return std::pair(given == nullptr ? 0 : (*given)[i], kind.groups(i)); };
  for (std::size_t i = 0; i < kind.n; ++i) entity_of_pair[pair_of(i)] = 0;
  std::set<std::int32_t> taken;
  for (auto& [pair, entity] : entity_of_pair) {
    if (pair.first > 0 && taken.insert(pair.first).second) entity = pair.first;
  }
  std::int32_t next = 1;
  for (auto& [pair, entity] : entity_of_pair) {
    while (entity == 0) {
      if (taken.insert(next).second) entity = next;
      ++next;
    }
    kind.groups_of_entity[entity] = pair.second;
  }
  kind.entities.resize(kind.n);
  for (std::size_t i = 0; i < kind.n; ++i) kind.entities[i] = entity_of_pair[pair_of(i)];
}

/// Rows of NaN have no value: Gmsh omits them.
bool has_value(const double* values, std::size_t components) {
  return !std::all_of(values, values + components, [](double v) { return std::isnan(v); });
}

class GmshWriter {
 public:
  GmshWriter(const WriteJob& job, bool version4)
      : job_(job),
        file_(job.file),
        out_(job.outputs.open(job.path)),
        version4_(version4),
        binary_(job.encoding.value_or(Encoding::ascii) != Encoding::ascii) {
    points_ = kind_of(kGmshPoint, file_.marked_points, 1);
    lines_ = kind_of(kGmshLine, file_.lines, 1 + points_.n);
    triangles_ = kind_of(kGmshTriangle, file_.triangles, lines_.first_number + lines_.n);
    tets_ = kind_of(kGmshTetrahedron, file_.tetrahedra, triangles_.first_number + triangles_.n);
    for (Kind* kind : kinds()) {
      for (const DataArray& array : *kind->data) {
        if (const auto tag = further_group(array))
          kind->further_groups.emplace_back(*tag, to_doubles(Values(array.values)));
        if (array.name != kFirstGroup || array.components != 1) continue;
        if (auto firsts = to_int32(array.values)) kind->firsts = *std::move(firsts);
      }
    }
    group_all();
    for (Kind* kind : kinds()) number_entities(*kind);
  }
  void write() {
    out_.put("$MeshFormat\n", version4_ ? "4.1 " : is_for_wavewatch() ? "2 " : "2.2 ", binary_ ? 1 : 0, " 8\n");
    if (binary_) {
      out_.put_raw(std::int32_t{1});
      out_.put('\n');
    }
    out_.put("$EndMeshFormat\n", "");
    physical_names();
    if (version4_) entities();
    nodes();
    version4_ ? elements_4() : elements_2();
    node_data();
    element_data();
  }

 private:
  /// WAVEWATCH III has depths in z, and reads a whole number as the version. Without names, 2.2 is the same as 2.
  [[nodiscard]] bool is_for_wavewatch() const { return !version4_ && job_.has_heights() && file_.names.empty(); }
  /// Gives each element a group if any has one.
  void group_all() {
    std::set<std::int32_t> taken;
    std::array<bool, 4> has_ungrouped = {};
    for (const Kind* kind : kinds()) {
      for (std::size_t i = 0; i < kind->n; ++i) {
        const GroupsOfCell groups = kind->groups(i);
        taken.insert(groups.first);
        taken.insert(groups.further.begin(), groups.further.end());
        if (groups.first == 0) has_ungrouped[static_cast<std::size_t>(kind->dimension)] = true;
      }
    }
    taken.erase(0);
    if (taken.empty()) return;
    for (const PhysicalName& n : file_.names) taken.insert(n.tag);
    std::array<std::int32_t, 4> tags = {};  // one for each dimension: some readers find names by the tag alone
    for (Kind* kind : kinds()) {
      const auto dimension = static_cast<std::size_t>(kind->dimension);
      if (!has_ungrouped[dimension]) continue;
      if (tags[dimension] == 0) taken.insert(tags[dimension] = free_tag(taken));
      kind->ungrouped = tags[dimension];
    }
  }
  /// The names of the file, except those of regions that are no groups; and the names of elements without a group.
  [[nodiscard]] std::vector<PhysicalName> names() {
    std::vector<PhysicalName> names;
    std::array<std::set<std::int32_t>, 4> no_groups;
    for (const Kind* kind : kinds()) {
      std::set<std::int32_t>& tags = no_groups[static_cast<std::size_t>(kind->dimension)];
      if (!kind->firsts.empty()) tags.insert(kind->tags->begin(), kind->tags->end());
      for (const auto& [entity, groups] : kind->groups_of_entity) {
        tags.erase(groups.first);
        for (const std::int32_t group : groups.further) tags.erase(group);
      }
    }
    for (const PhysicalName& n : file_.names) {
      const bool has_elements = n.dimension >= 0 && n.dimension < 4;
      if (!has_elements || !no_groups[static_cast<std::size_t>(n.dimension)].contains(n.tag)) names.push_back(n);
    }
    for (const Kind* kind : kinds()) {
      if (kind->ungrouped != 0 && !is_for_wavewatch())
        names.push_back(
            {kind->dimension, kind->ungrouped, std::string(kGmshUngrouped[static_cast<std::size_t>(kind->dimension)])});
    }
    return names;
  }
  void physical_names() {
    const std::vector<PhysicalName> all = names();
    if (all.empty()) return;
    out_.put("$PhysicalNames\n", all.size(), '\n');
    for (const PhysicalName& n : all) out_.put(n.dimension, ' ', n.tag, " \"", job_.written(n.name), "\"\n");
    out_.put("$EndPhysicalNames\n", "");
  }
  void entities() {
    out_.put("$Entities\n", "");
    for (const Kind* kind : kinds()) put(std::uint64_t{kind->groups_of_entity.size()});
    end_line();
    const std::array<double, 6> box = bounding_box();
    for (const Kind* kind : kinds()) {
      for (const auto& [entity, groups] : kind->groups_of_entity) {
        put(entity);
        for (std::size_t k = 0; k < (kind->dimension == 0 ? 3 : 6); ++k) put(box[k]);
        put(std::uint64_t{(groups.first == 0 ? 0 : 1) + groups.further.size()});
        if (groups.first != 0) put(groups.first);
        for (const std::int32_t group : groups.further) put(group);
        if (kind->dimension > 0) put(std::uint64_t{0});
        end_line();
      }
    }
    end_section();
    out_.put("$EndEntities\n", "");
  }
  void put_place(std::size_t point) {
    const Vec3 p = job_.place(point);
    put(p.x), put(p.y), put(p.z);
    end_line();
  }
  void nodes() {
    const std::size_t n = file_.points.size();
    out_.put("$Nodes\n", "");
    if (!version4_) {
      out_.put(n, '\n');
      for (std::size_t i = 0; i < n; ++i) {
        put(static_cast<std::int32_t>(i + 1));
        put_place(i);
      }
    } else {
      for (const std::uint64_t v : {std::uint64_t{1}, std::uint64_t{n}, std::uint64_t{1}, std::uint64_t{n}}) put(v);
      end_line();
      const Kind& cells = tets_.n > 0 ? tets_ : triangles_;
      const std::int32_t entity = cells.groups_of_entity.empty() ? 1 : cells.groups_of_entity.begin()->first;
      put(tets_.n > 0 ? 3 : 2), put(entity), put(std::int32_t{0}), put(std::uint64_t{n});
      end_line();
      for (std::size_t i = 0; i < n; ++i) put(std::uint64_t{i + 1}), end_line();
      for (std::size_t i = 0; i < n; ++i) put_place(i);
    }
    end_section();
    out_.put("$EndNodes\n", "");
  }
  void elements_2() {
    std::size_t n_further = 0;
    for_each_further([&](const Kind&, std::size_t, std::int32_t) { ++n_further; });
    out_.put("$Elements\n", n_elements() + n_further, '\n');
    for (const Kind* kind : kinds()) {
      const std::size_t n_triangles = kind == &triangles_ ? job_.n_triangles() : kind->n;
      for (std::size_t i = 0; i < kind->n; ++i) {
        const std::int32_t type = i < n_triangles ? kind->type : kGmshQuadrilateral;
        const std::size_t n_alike = i < n_triangles ? n_triangles : kind->n - n_triangles;
        if (binary_ && (i == 0 || i == n_triangles))
          put(type), put(static_cast<std::int32_t>(n_alike)), put(std::int32_t{2});
        put(static_cast<std::int32_t>(kind->first_number + i));
        if (!binary_) put(type), put(std::int32_t{2});
        put(kind->groups(i).first), put(kind->entity(i));
        put_nodes<std::int32_t>(*kind, i);
      }
    }
    auto number = static_cast<std::int32_t>(n_elements());
    for_each_further([&](const Kind& kind, std::size_t i, std::int32_t group) {
      const std::int32_t type = is_quadrilateral(kind, i) ? kGmshQuadrilateral : kind.type;
      ++number;
      binary_ ? (put(type), put(std::int32_t{1}), put(std::int32_t{2}), put(number))
              : (put(number), put(type), put(std::int32_t{2}));
      put(group), put(kind.entity(i));
      put_nodes<std::int32_t>(kind, i);
    });
    end_section();
    out_.put("$EndElements\n", "");
  }
  template <class Use>
  void for_each_further(const Use& use) {
    for (const Kind* kind : kinds()) {
      for (std::size_t i = 0; i < kind->n; ++i) {
        for (const std::int32_t group : kind->groups(i).further) use(*kind, i, group);
      }
    }
  }
  [[nodiscard]] bool is_quadrilateral(const Kind& kind, std::size_t i) const {
    return &kind == &triangles_ && i >= job_.n_triangles();
  }
  template <class Number>
  void put_nodes(const Kind& kind, std::size_t i) {
    for (std::size_t k = 0; k < kind.corners; ++k) put(static_cast<Number>(kind.nodes[i * kind.corners + k]) + 1);
    if (is_quadrilateral(kind, i)) put(static_cast<Number>(job_.fourth_corners[i - job_.n_triangles()]) + 1);
    end_line();
  }
  void elements_4() {
    out_.put("$Elements\n", "");
    const std::uint64_t total = n_elements();
    // The elements of each entity, and there of each type.
    std::array<std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::size_t>>, 4> blocks;
    std::uint64_t n_blocks = 0;
    for (std::size_t d = 0; d < blocks.size(); ++d) {
      const Kind& kind = *kinds()[d];
      for (std::size_t i = 0; i < kind.n; ++i)
        blocks[d][{kind.entity(i), is_quadrilateral(kind, i) ? kGmshQuadrilateral : kind.type}].push_back(i);
      n_blocks += blocks[d].size();
    }
    put(n_blocks), put(total), put(std::uint64_t{1}), put(total);
    end_line();
    for (std::size_t d = 0; d < blocks.size(); ++d) {
      const Kind& kind = *kinds()[d];
      for (const auto& [of, members] : blocks[d]) {
        put(kind.dimension), put(of.first), put(of.second), put(std::uint64_t{members.size()});
        end_line();
        for (const std::size_t i : members) {
          put(std::uint64_t{kind.first_number + i});
          put_nodes<std::uint64_t>(kind, i);
        }
      }
    }
    end_section();
    out_.put("$EndElements\n", "");
  }
  void node_data() {
    const auto section = [&](const std::string& name, const std::vector<double>& values, std::size_t components,
                             int padded) {
      const std::size_t n = values.size() / components;
      std::size_t rows = 0;
      for (std::size_t i = 0; i < n; ++i) rows += has_value(&values[i * components], components);
      data_header("NodeData", name, padded, rows);
      for (std::size_t i = 0; i < n; ++i) {
        if (!has_value(&values[i * components], components)) continue;
        data_row(static_cast<std::int32_t>(i + 1), &values[i * components], components,
                 static_cast<std::size_t>(padded));
      }
      end_section();
      out_.put("$EndNodeData\n", "");
    };
    if (!file_.weights.empty()) section("weight", file_.weights, 1, 1);
    for (const DataArray& a : file_.point_data) {
      const int padded = components_in_gmsh(a, "point data");
      if (padded == 0) continue;
      note_type(a, "point data");
      section(a.name, to_doubles(Values(a.values)), static_cast<std::size_t>(a.components), padded);
    }
  }
  void element_data() {
    std::set<std::string_view> done = {kGmshEntity, kFirstGroup};
    const std::pair<const Kind*, ArraysByName> named[] = {{&points_, ArraysByName(*points_.data)},
                                                          {&lines_, ArraysByName(*lines_.data)},
                                                          {&triangles_, ArraysByName(*triangles_.data)},
                                                          {&tets_, ArraysByName(*tets_.data)}};
    for (const Kind* leading : kinds()) {
      for (const DataArray& a : *leading->data) {
        if (!done.insert(a.name).second || further_group(a)) continue;
        const int padded = components_in_gmsh(a, "cell data");
        if (padded == 0) continue;
        note_type(a, "cell data");
        // The array of this name for all kinds of elements that have one with as many components.
        std::vector<std::pair<const Kind*, std::vector<double>>> parts;
        std::size_t rows = 0;
        const auto c = static_cast<std::size_t>(a.components);
        for (const auto& [kind, arrays] : named) {
          const DataArray* same = arrays.find(a.name);
          if (same == nullptr || same->components != a.components) continue;
          parts.emplace_back(kind, to_doubles(Values(same->values)));
          for (std::size_t i = 0; i < kind->n; ++i) rows += has_value(&parts.back().second[i * c], c);
        }
        data_header("ElementData", a.name, padded, rows);
        for (const auto& [kind, values] : parts) {
          for (std::size_t i = 0; i < kind->n; ++i) {
            if (!has_value(&values[i * c], c)) continue;
            data_row(static_cast<std::int32_t>(kind->first_number + i), &values[i * c], c,
                     static_cast<std::size_t>(padded));
          }
        }
        end_section();
        out_.put("$EndElementData\n", "");
      }
    }
  }
  void data_header(std::string_view section, const std::string& name, int components, std::size_t entries) {
    out_.put("$", section, "\n1\n\"", job_.written(name), "\"\n1\n0\n3\n0\n", components, '\n', entries, '\n');
  }
  void data_row(std::int32_t number, const double* values, std::size_t components, std::size_t padded) {
    put(number);
    for (std::size_t k = 0; k < padded; ++k) put(k < components ? values[k] : 0.0);
    end_line();
  }
  /// Gmsh has scalars, vectors of 3 and tensors of 9.
  [[nodiscard]] int components_in_gmsh(const DataArray& array, std::string_view kind) const {
    const int c = array.components;
    if (c == 1 || c == 3 || c == 9) return c;
    if (c > 9) {
      job_.warn(kind, " '", array.name, "' is not written: it has ", c, " components, Gmsh holds 1, 3 or 9");
      return 0;
    }
    const int padded = c < 3 ? 3 : 9;
    job_.warn(kind, " '", array.name, "' of ", c, " components is filled up with zeros to ", padded);
    return padded;
  }
  void note_type(const DataArray& array, std::string_view kind) const {
    if (scalar_of(array.values) != Scalar::f64) {
      job_.warn(kind, " '", array.name, "' of type ", type_name(array.values),
                " is written as float64, all that Gmsh holds");
    }
  }
  [[nodiscard]] std::array<double, 6> bounding_box() const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    std::array<double, 6> box = {kInfinity, kInfinity, kInfinity, -kInfinity, -kInfinity, -kInfinity};
    for (std::size_t i = 0; i < file_.points.size(); ++i) {
      const Vec3 p = job_.place(i);
      box[0] = std::min(box[0], p.x), box[1] = std::min(box[1], p.y), box[2] = std::min(box[2], p.z);
      box[3] = std::max(box[3], p.x), box[4] = std::max(box[4], p.y), box[5] = std::max(box[5], p.z);
    }
    return box;
  }
  [[nodiscard]] std::array<Kind*, 4> kinds() { return {&points_, &lines_, &triangles_, &tets_}; }
  [[nodiscard]] std::size_t n_elements() const { return points_.n + lines_.n + triangles_.n + tets_.n; }

  /// A number: text with a blank behind it, or its bytes.
  template <class T>
  void put(T value) {
    if (binary_)
      out_.put_raw(value);
    else
      out_.put(value, ' ');
  }
  void end_line() {
    if (!binary_) out_.put('\n');
  }
  void end_section() {
    if (binary_) out_.put('\n');
  }

  const WriteJob& job_;
  const MeshFile& file_;
  Output& out_;
  bool version4_, binary_;
  Kind points_, lines_, triangles_, tets_;
};

}  // namespace

void write_gmsh22(const WriteJob& job) { GmshWriter(job, false).write(); }
void write_gmsh41(const WriteJob& job) { GmshWriter(job, true).write(); }

}  // namespace temper::io
