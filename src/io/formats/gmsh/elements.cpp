#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>

#include "io/formats/gmsh/reader.hpp"

namespace temper::io {
namespace {

/// In 4.1 a negative tag is that of a group that has the entity in the other direction. Entities of temper have no
/// boundary, and their tags may be negative.
bool is_of_reversed(const NamedGroups& named, std::pair<std::int32_t, std::int32_t> group, bool has_boundary) {
  const auto [dimension, tag] = group;
  return tag < 0 && tag > std::numeric_limits<std::int32_t>::min() && !named.contains(group) &&
         (has_boundary || named.contains({dimension, -tag}));
}

void read_physical_tags(GmshSource& in, Membership& of) {
  const std::size_t n_physical = in.get_count("physical tags", 2, 4);
  for (std::size_t k = 0; k < n_physical; ++k) {
    const auto physical = in.get<std::int32_t>("a physical tag");
    if (k == 0)
      of.physical = physical;
    else
      of.further.push_back(physical);
  }
}

}  // namespace

void GmshEntities::read(GmshSource& in, bool partitioned, const NamedGroups& named) {
  in.begin_numbers();
  if (partitioned) read_ghosts(in);
  std::array<std::size_t, 4> counts;
  for (std::size_t& n : counts) n = in.get_count("entities", 10, 36);
  for (std::int32_t dimension = 0; dimension < 4; ++dimension) {
    for (std::size_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i)
      read_entity(in, dimension, partitioned, named);
  }
}

void GmshEntities::read_ghosts(GmshSource& in) {
  in.get<std::uint64_t>("the number of partitions");
  const std::size_t n_ghosts = in.get_count("ghost entities", 4, 8);
  for (std::size_t i = 0; i < n_ghosts; ++i) {
    const auto tag = in.get<std::int32_t>("the tag of a ghost entity");
    Membership ghosts;
    ghosts.of_partition_alone = true;
    for (const std::int32_t dimension : {2, 3}) entities_.try_emplace({dimension, tag}, ghosts);  // cells have one
    in.get<std::int32_t>("the partition of a ghost entity");
  }
}

void GmshEntities::read_entity(GmshSource& in, std::int32_t dimension, bool partitioned, const NamedGroups& named) {
  const auto tag = in.get<std::int32_t>("the tag of an entity");
  Membership of;
  of.entity = tag;
  const Membership* parent = nullptr;
  if (partitioned) {
    const auto parent_dimension = in.get<std::int32_t>("the dimension of a parent");
    of.entity = in.get<std::int32_t>("the tag of a parent");
    of.of_partition_alone = parent_dimension != dimension;
    const auto found = entities_.find({dimension, of.entity});
    if (!of.of_partition_alone && found != entities_.end()) parent = &found->second;
    const std::size_t n_partitions = in.get_count("partitions", 2, 4);
    for (std::size_t k = 0; k < n_partitions; ++k) {
      const auto partition = in.get<std::int32_t>("a partition");
      if (k == 0) of.partition = partition;
    }
  }
  const int n_coordinates = dimension == 0 ? 3 : 6;
  for (int k = 0; k < n_coordinates; ++k) in.get<double>("a coordinate of an entity");
  read_physical_tags(in, of);
  const std::size_t n_bounding = dimension == 0 ? 0 : in.get_count("bounding entities", 2, 4);
  for (std::size_t k = 0; k < n_bounding; ++k) in.get<std::int32_t>("a bounding entity");
  of.is_reversed = is_of_reversed(named, {dimension, of.physical}, n_bounding > 0);
  if (of.is_reversed) of.physical = -of.physical;
  for (std::int32_t& group : of.further) {
    if (is_of_reversed(named, {dimension, group}, n_bounding > 0)) group = -group;
  }
  if (parent != nullptr && parent->physical != 0) {
    of.physical = parent->physical;
    of.further = parent->further;
    of.is_reversed = parent->is_reversed;
  }
  entities_[{dimension, tag}] = of;
}
Membership GmshEntities::of(std::int32_t dimension, std::int32_t tag) const {
  if (const auto found = entities_.find({dimension, tag}); found != entities_.end()) return found->second;
  Membership of;
  of.entity = tag;
  return of;
}

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

namespace {

// In version 2 an element with several physical groups is listed once for each: the others become further groups.
template <std::size_t N>
void keep_one_of_each(Elements<N>& elements, RunLength& left_out) {
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
      left_out.push_back(elements.numbers[static_cast<std::int64_t>(i)]);
    else
      kept.add_from(elements, i);
  }
  elements = std::move(kept);
}

}  // namespace

void GmshElements::finish(bool version4) {
  std::apply([](auto&... elements) { (elements.sort_by_number(), ...); }, all());
  if (!version4) {
    if (tets.nodes.empty())
      keep_one_of_each(triangles, left_out);  // beside tetrahedra they are tags, of which all stay
    keep_one_of_each(tets, left_out);
  }
  std::apply([](auto&... elements) { (elements.lookup.emplace(elements.numbers), ...); }, all());
  left_out_lookup.emplace(left_out);
}

}  // namespace temper::io
