// Lines that become faces, by names and tags.
#include <algorithm>
#include <charconv>
#include <string>
#include <vector>

#include "mesher/problem.hpp"

namespace temper {
namespace {

/// The tags of lines, or the regions, that a word stands for.
std::vector<std::int32_t> numbers_of(const Outline& outline, int dimension, const std::string& name) {
  std::vector<std::int32_t> numbers;
  for (const PhysicalName& group : outline.groups) {
    if (group.dimension == dimension && group.name == name) numbers.push_back(group.tag);
  }
  std::int32_t tag = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), tag);
  const bool is_number = error == std::errc() && end == name.data() + name.size() && tag != 0;
  if (numbers.empty() && dimension == 1 && is_number) numbers.push_back(tag);
  return numbers;
}

/// The segments of a name, in any order.
std::vector<std::size_t> segments_of(const Outline& outline, const std::string& name) {
  std::vector<std::size_t> found;
  const auto add = [&](std::int32_t segment) { found.push_back(static_cast<std::size_t>(std::int64_t{segment})); };
  for (const std::int32_t tag : numbers_of(outline, 1, name)) {
    for (std::size_t i = 0; i < outline.segments.size(); ++i) {
      if (outline.segments[i].tag == tag) found.push_back(i);
    }
    for (const OutlineTag& further : outline.further_tags) {
      if (further.tag == tag) add(further.element);
    }
  }
  for (const std::int32_t region : numbers_of(outline, 2, name)) {
    for (const OutlinePart& part : outline.parts) {
      if (part.region == region) std::ranges::for_each(part.segments, add);
    }
  }
  return found;
}

/// "; it has 'fault', 'river'", or nothing.
std::string known_names(const Outline& outline) {
  std::string list;
  for (const PhysicalName& group : outline.groups) {
    if (group.dimension > 0) list += (list.empty() ? "; it has '" : ", '") + group.name + "'";
  }
  return list;
}

}  // namespace

Expected<void> become_faces(Outline& outline, std::span<const std::string> names) {
  for (const std::string& name : names) {
    const std::vector<std::size_t> segments = segments_of(outline, name);
    if (segments.empty()) {
      return mesher::invalid("no line or region of the outline has the name or tag '" + name + "'" +
                             known_names(outline));
    }
    for (const std::size_t segment : segments) {
      if (segment < outline.segments.size()) outline.segments[segment].as = LineKind::faces;
    }
  }
  return {};
}

}  // namespace temper
