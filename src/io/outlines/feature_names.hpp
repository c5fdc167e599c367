// Names of features become names of regions and tags.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/text/scanner.hpp"
#include "temper/detail/outline.hpp"

namespace temper::io {

/// The points or segments of a feature with a name, in the order of the features.
struct NamedElements {
  int dimension = 0;
  std::int32_t tag = 0;  ///< of the feature; 0: none
  std::string name;
  std::vector<std::int32_t> elements;
};

/// The regions and tags that names of features get, after all features are read.
class FeatureNames {
 public:
  explicit FeatureNames(Outline& outline) : outline_(outline) {}

  void add_part(bool has_region, std::string name) {
    given_region_.push_back(has_region ? 1 : 0);
    part_groups_.push_back(std::move(name));
  }
  void add(NamedElements named) {
    if (!named.name.empty()) named_.push_back(std::move(named));
  }
  void add_tag(std::int32_t point, std::int32_t tag) {
    if (tag != 0 && point_tags_.emplace(point, tag).second) outline_.point_tags.push_back({point, tag});
  }

  /// Several polygons without regions of their own count from 1. Polygons of one name are one region; a name without a
  /// region gets a free one.
  void number_regions(const std::string& path, std::vector<std::string>& warnings) {
    std::vector<OutlinePart>& parts = outline_.parts;
    const bool counts =
        parts.size() > 1 && std::find(given_region_.begin(), given_region_.end(), 1) == given_region_.end();
    std::int32_t highest = 0;
    for (const OutlinePart& part : parts) highest = std::max(highest, part.region);
    std::map<std::string, std::int32_t> region_of;
    std::map<std::int32_t, std::string> name_of;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (parts[i].region != 0) region_of.emplace(part_groups_[i], parts[i].region);
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      std::int32_t& region = parts[i].region;
      if (region == 0 && counts) region = static_cast<std::int32_t>(i + 1);
      if (part_groups_[i].empty()) continue;
      if (given_region_[i] == 0) region = region_of.emplace(part_groups_[i], counts ? region : ++highest).first->second;
      const auto [known, is_new] = name_of.emplace(region, part_groups_[i]);
      if (is_new) {
        outline_.groups.push_back({2, region, known->second});
      } else if (known->second != part_groups_[i]) {
        warnings.push_back(text(path, ": region ", region, " is named '", known->second, "'; its name '",
                                part_groups_[i], "' is dropped, because a region has one name"));
      }
    }
  }

  /// Gives each name of points and lines its tag. It is the tag of its features, if that is one tag with one name. Else
  /// it is a free one, above 1 and all others. Elements then carry it beside the tags that they have.
  void name_groups() {
    std::map<std::pair<int, std::string>, std::set<std::int32_t>> tags_of;
    std::map<std::pair<int, std::int32_t>, std::set<std::string>> names_of;
    std::int32_t highest = 1;
    for (const OutlineSegment& s : outline_.segments) highest = std::max(highest, s.tag);
    for (const OutlineTag& p : outline_.point_tags) highest = std::max(highest, p.tag);
    for (const NamedElements& named : named_) {
      auto& tags = tags_of[{named.dimension, named.name}];
      if (named.tag == 0) continue;
      tags.insert(named.tag);
      names_of[{named.dimension, named.tag}].insert(named.name);
    }
    std::map<std::pair<int, std::string>, std::int32_t> tag_of;
    for (const NamedElements& named : named_) {
      const std::pair group(named.dimension, named.name);
      if (!tag_of.contains(group)) {
        const std::set<std::int32_t>& tags = tags_of[group];
        const bool own = tags.size() == 1 && names_of[{named.dimension, *tags.begin()}].size() == 1;
        tag_of[group] = own ? *tags.begin() : ++highest;
        outline_.groups.push_back({named.dimension, tag_of[group], named.name});
      }
      carry(named, tag_of[group]);
    }
  }

 private:
  void carry(const NamedElements& named, std::int32_t tag) {
    Outline& o = outline_;
    for (const std::int32_t element : named.elements) {
      if (named.dimension == 0) {
        add_tag(element, tag);
        continue;
      }
      OutlineSegment& segment = o.segments[static_cast<std::size_t>(element)];
      if (segment.tag == 0) {
        segment.tag = tag;
      } else if (segment.tag != tag) {
        o.further_tags.push_back({element, tag});
      }
    }
  }

  Outline& outline_;
  std::vector<std::uint8_t> given_region_;
  std::vector<std::string> part_groups_;  // names of parts
  std::vector<NamedElements> named_;
  std::set<std::pair<std::int32_t, std::int32_t>> point_tags_;  // that the outline has
};

}  // namespace temper::io
