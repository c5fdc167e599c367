// See gmsh/read.cpp: how groups become regions, tags and data.
#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "io/conversion/follow.hpp"
#include "io/formats/gmsh/gmsh.hpp"
#include "io/formats/gmsh/reader.hpp"

namespace temper::io {
namespace {

/// The physical groups of a cell, the further ones in the order of their tags.
struct GroupSet {
  std::int32_t first = 0;
  std::vector<std::int32_t> further = {};
  friend bool operator<(const GroupSet& a, const GroupSet& b) {
    const std::size_t n_a = a.further.size(), n_b = b.further.size();
    return std::tie(a.first, n_a, a.further) < std::tie(b.first, n_b, b.further);
  }
};

struct GroupsOfFile {
  Document& document;
  AllocationLimits& allocation;
};

std::string group_name(const std::vector<PhysicalName>& names, std::int32_t dimension, std::int32_t tag) {
  for (const PhysicalName& name : names) {
    if (name.dimension == dimension && name.tag == tag) return name.name;
  }
  return std::to_string(tag);
}

/// Of sets with one first group, the smallest keeps its tag. Another set takes the tag of a group that no other set
/// has, as an inner group. Else it gets a free tag, and a name from its groups.
void name_regions(std::vector<PhysicalName>& names, std::int32_t dimension,
                  std::map<GroupSet, std::int32_t>& region_of) {
  std::map<std::int32_t, std::size_t> n_sets;  // with this group
  std::set<std::int32_t> taken, is_first;
  for (const auto& [groups, region] : region_of) {
    is_first.insert(groups.first);
    ++n_sets[groups.first];
    for (const std::int32_t group : groups.further) ++n_sets[group];
  }
  for (const auto& [group, n] : n_sets) taken.insert(group);
  for (const PhysicalName& name : names) taken.insert(name.tag);
  std::set<std::int32_t> has_region;          // first groups
  for (auto& [groups, region] : region_of) {  // the smallest set of each first group before the others
    const auto own = std::find_if(groups.further.begin(), groups.further.end(),
                                  [&](std::int32_t group) { return n_sets[group] == 1 && !is_first.contains(group); });
    if (has_region.insert(groups.first).second) {
      region = groups.first;
    } else if (own != groups.further.end()) {
      region = *own;
    } else {
      region = free_tag(taken);
      taken.insert(region);
      std::string name = group_name(names, dimension, groups.first);
      for (const std::int32_t group : groups.further) name += " and " + group_name(names, dimension, group);
      names.push_back({dimension, region, std::move(name)});
    }
  }
}

/// Makes cells with different sets of groups different regions. `inside` has 1 for each cell of a further group.
template <std::size_t N>
void part_regions(Elements<N>& cells, const std::map<std::int32_t, std::vector<std::int32_t>>& inside,
                  std::vector<DataArray>& data, const GroupsOfFile& to) {
  std::vector<GroupSet> set_of_cell(cells.nodes.size());
  std::map<GroupSet, std::int32_t> region_of;
  for (std::size_t i = 0; i < set_of_cell.size(); ++i) {
    set_of_cell[i].first = cells.physical[i];
    for (const auto& [group, values] : inside) {
      if (values[i] != 0 && group != cells.physical[i]) set_of_cell[i].further.push_back(group);
    }
    region_of.emplace(set_of_cell[i], 0);
  }
  name_regions(to.document.file.names, static_cast<std::int32_t>(N) - 1, region_of);
  std::vector<std::int32_t> firsts = cells.physical;
  for (std::size_t i = 0; i < firsts.size(); ++i) cells.physical[i] = region_of[set_of_cell[i]];
  if (firsts == cells.physical) return;
  to.allocation.take(firsts.size(), 1, to.document.names->path);
  data.push_back({std::string(kFirstGroup), 1, std::move(firsts)});
}

template <std::size_t N>
void add_groups(Elements<N>& cells, std::vector<DataArray>& data, const GroupsOfFile& to) {
  if (cells.further.empty()) return;
  std::map<std::int32_t, std::vector<std::int32_t>> groups;
  for (const auto& [number, group] : cells.further) {
    std::vector<std::int32_t>& inside = groups[group];
    if (inside.empty()) to.allocation.take(cells.nodes.size(), 1, to.document.names->path);
    inside.resize(cells.nodes.size());
    inside[*cells.lookup->find(number)] = 1;
  }
  part_regions(cells, groups, data, to);
  for (auto& [group, inside] : groups) data.push_back({text(kFurtherGroup, group), 1, std::move(inside)});
}

template <std::size_t N>
void repeat_for_groups(Elements<N>& elements, std::vector<DataArray>& data) {
  if (elements.further.empty()) return;
  std::vector<std::size_t> rows(elements.nodes.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  const std::vector<std::pair<std::int64_t, std::int32_t>> further = std::move(elements.further);
  for (const auto& [number, group] : further) {
    rows.push_back(*elements.lookup->find(number));
    elements.add_from(elements, rows.back());
    elements.physical.back() = group;
  }
  take_rows(data, rows);
}

/// The group that the writer gives to elements without one is no group.
void forget_ungrouped(GmshElements& all, std::vector<PhysicalName>& names) {
  const auto forget = [](auto& elements, std::int32_t tag) {
    std::replace(elements.physical.begin(), elements.physical.end(), tag, 0);
    std::erase_if(elements.further, [tag](const auto& element) { return element.second == tag; });
  };
  std::erase_if(names, [&](const PhysicalName& name) {
    const std::int32_t d = name.dimension;
    if (d < 0 || d > 3 || name.name != kGmshUngrouped[static_cast<std::size_t>(d)]) return false;
    if (d == 0) forget(all.points, name.tag);
    if (d == 1) forget(all.lines, name.tag);
    if (d == 2) forget(all.triangles, name.tag);
    if (d == 3) forget(all.tets, name.tag);
    return true;
  });
}

}  // namespace

void settle_groups(GmshElements& elements, Document& document, AllocationLimits& allocation) {
  MeshFile& f = document.file;
  const GroupsOfFile to = {document, allocation};
  forget_ungrouped(elements, f.names);
  const bool has_tets = !elements.tets.nodes.empty();
  add_groups(elements.tets, f.tetrahedra.data, to);
  has_tets ? repeat_for_groups(elements.triangles, f.triangles.data)
           : add_groups(elements.triangles, f.triangles.data, to);
  repeat_for_groups(elements.lines, f.lines.data);
  repeat_for_groups(elements.points, f.marked_points.data);
}

}  // namespace temper::io
