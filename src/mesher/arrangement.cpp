// Rings that go, joins, crossings, cutting and merging, in this order.
#include "mesher/arrangement.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

#include "base/text.hpp"
#include "mesher/outline_check.hpp"
#include "mesher/snap.hpp"

namespace temper::mesher {
namespace {

using Error = std::optional<InputError>;

double extent_of(const Problem& problem, const OutlineRing& ring) {
  if (ring.segments.empty()) return 0;
  const auto ends = [&](std::int32_t s) { return problem.outline.segments[static_cast<std::size_t>(s)].ends; };
  const Vec3 first = problem.point(ends(ring.segments[0])[0]);
  BoundingBox box = {first, first};
  for (const std::int32_t s : ring.segments) {
    for (const std::int32_t end : ends(s)) box = temper::united(box, {problem.point(end), problem.point(end)});
  }
  return length(box.high - box.low);
}

/// Flags of the segments of small rings, and of the points that have no other segment; or nothing.
struct Dropped {
  std::vector<std::uint8_t> segments, points;
};

Dropped small_rings(const Problem& problem) {
  const Outline& o = problem.outline;
  const double least = problem.options.drop_below;
  Dropped dropped{std::vector<std::uint8_t>(o.segments.size(), 0), {}};
  if (least == 0) return dropped;
  std::vector<std::uint8_t> small(o.rings.size(), 0);
  for (std::size_t i = 0; i < o.rings.size(); ++i) {
    const OutlineRing& ring = o.rings[i];
    small[i] = extent_of(problem, ring) < least ? 1 : 0;
    if (ring.shell >= 0 && static_cast<std::size_t>(ring.shell) < i) {
      small[i] |= small[static_cast<std::size_t>(ring.shell)];
    }
    if (small[i] == 0) continue;
    for (const std::int32_t s : ring.segments) dropped.segments[static_cast<std::size_t>(s)] = 1;
  }
  dropped.points.assign(o.points.size(), 0);
  for (const std::uint8_t pass :
       {std::uint8_t{1}, std::uint8_t{0}}) {  // first all points of rings that go, then not those that others use
    for (std::size_t i = 0; i < dropped.segments.size(); ++i) {
      if (dropped.segments[i] != pass) continue;
      for (const std::int32_t end : o.segments[i].ends) dropped.points[static_cast<std::size_t>(end)] = pass;
    }
  }
  return dropped;
}
Snapped joined(const Problem& problem, Deadline& deadline) {
  Dropped dropped = small_rings(problem);
  std::vector<SegmentPart> segments;
  segments.reserve(dropped.segments.size());
  for (std::size_t i = 0; i < dropped.segments.size(); ++i) {
    if (dropped.segments[i] == 0) segments.push_back({problem.outline.segments[i].ends, static_cast<std::uint32_t>(i)});
  }
  return snap(problem.surface, problem.points, std::move(segments),
              {problem.tolerance, problem.options.split_crossings, std::move(dropped.points)}, deadline);
}

InputError crossing_error(const Problem& problem, const Crossing& crossing) {
  const std::size_t i = crossing.first, j = crossing.second;
  const auto ends = [&](std::size_t segment) {
    const auto [a, b] = problem.outline.segments[segment].ends;
    return "(" + problem.names.point(static_cast<std::size_t>(a)) + " to " +
           problem.names.point(static_cast<std::size_t>(b));
  };
  const std::string where = problem.names.segment_where(i);
  return at_segment(problem, ErrorCode::overlap, j,
                    ends(j) + ") crosses " + problem.names.segment(i) + " " + ends(i) +
                        (where.empty() ? "" : ", " + where) + ") at " + problem.text(crossing.at) +
                        "; expected segments to meet at points only. Next: --split-crossings (split_crossings=True "
                        "in Python) divides both there");
}

std::string note_of_joins(const Problem& problem, const Snapped& snapped) {
  const auto farthest = static_cast<std::size_t>(snapped.farthest);
  return "points joined to a point or segment within " + to_text(problem.tolerance) + ": " +
         std::to_string(snapped.joins) + "; the largest distance is " + to_text(snapped.largest) + ", at " +
         problem.text(problem.points[farthest]);
}

std::vector<std::vector<std::int32_t>> parts_of_segments(const Outline& o) {
  std::vector<std::vector<std::int32_t>> parts(o.segments.size());
  for (std::size_t i = 0; i < o.parts.size(); ++i) {
    for (const std::int32_t s : o.parts[i].segments) {
      parts[static_cast<std::size_t>(s)].push_back(static_cast<std::int32_t>(i));
    }
  }
  for (std::size_t i = 0; i < o.rings.size(); ++i) {
    for (const std::int32_t s : o.rings[i].segments) {
      parts[static_cast<std::size_t>(s)].push_back(static_cast<std::int32_t>(o.parts.size() + i));
    }
  }
  return parts;
}

std::vector<std::vector<std::int32_t>> tags_of_segments(const Outline& o) {
  std::vector<std::vector<std::int32_t>> tags(o.segments.size());
  for (std::size_t i = 0; i < tags.size(); ++i) {
    if (o.segments[i].tag != 0) tags[i].push_back(o.segments[i].tag);
  }
  for (const OutlineTag& further : o.further_tags) {
    if (further.tag != 0) tags[static_cast<std::size_t>(further.element)].push_back(further.tag);
  }
  return tags;
}

/// Of each segment: its parts, then its rings; and its tags.
struct SegmentLabels {
  std::vector<std::vector<std::int32_t>> parts, tags;
};

/// Two points of no segment that became one are two of the user's things.
void warn_of_lost_points(const Problem& problem, const Snapped& snapped, std::vector<std::string>& warnings) {
  const std::vector<std::uint8_t> is_alone = alone(problem.outline);
  for (std::size_t i = 0; i < is_alone.size(); ++i) {
    const auto to = static_cast<std::size_t>(snapped.joined[i]);
    if (to == i || is_alone[i] == 0 || is_alone[to] == 0) continue;  // those left out are not alone
    warnings.push_back(problem.names.point(i) + " and " + problem.names.point(to) + " are at one place, " +
                       problem.text(problem.points[to]) + ", and become one vertex");
  }
}

/// Segments with a common end and tag are one line. Lines of which joins leave no edge are named; what remains of
/// parts and rings is checked elsewhere.
void warn_of_lost_lines(const Problem& problem, const Snapped& snapped, const SegmentLabels& of,
                        std::vector<std::string>& warnings) {
  const Outline& o = problem.outline;
  std::vector<std::uint8_t> left(o.segments.size(), 0);
  for (const SegmentPart& part : snapped.parts) left[part.segment] = 1;
  if (std::find(left.begin(), left.end(), 0) == left.end()) return;
  std::vector<std::size_t> line(left.size());  // its first segment
  const auto first = [&](std::size_t i) {
    while (line[i] != i) i = line[i] = line[line[i]];
    return i;
  };
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> at_end;  // and of that tag
  for (std::size_t i = 0; i < line.size(); ++i) {
    line[i] = i;
    for (const std::int32_t end : o.segments[i].ends) {
      const std::size_t other = first(at_end.emplace(std::pair(end, o.segments[i].tag), i).first->second);
      const auto [less, more] = std::minmax({other, first(i)});
      line[more] = less;
    }
  }
  for (std::size_t i = 0; i < left.size(); ++i) left[first(i)] |= left[i];
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (first(i) != i || left[i] != 0 || !of.parts[i].empty()) continue;
    std::string text_of_tags;
    for (const std::int32_t tag : of.tags[i]) text_of_tags += ", " + name_of_tag(o, 1, tag);
    warnings.push_back("joins within " + to_text(problem.tolerance) + " (--snap) remove the whole line at " +
                       problem.text(problem.point(o.segments[i].ends[0])) + ", " + problem.names.segment(i) +
                       text_of_tags + ": its points become one. Next: a smaller --snap keeps it");
  }
}

/// Keeps each value that occurs an odd number of times once, sorted.
void keep_odd(std::vector<std::int32_t>& values) {
  std::sort(values.begin(), values.end());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size();) {
    std::size_t end = i;
    while (end < values.size() && values[end] == values[i]) ++end;
    if ((end - i) % 2 == 1) values[kept++] = values[i];
    i = end;
  }
  values.resize(kept);
}

std::vector<OutlineEdge> cut(const Outline& outline, const Snapped& snapped, const SegmentLabels& of) {
  std::vector<OutlineEdge> edges;
  edges.reserve(snapped.parts.size());
  for (const SegmentPart& part : snapped.parts) {
    edges.push_back(
        {part.ends, of.tags[part.segment], of.parts[part.segment], part.segment, outline.segments[part.segment].as});
  }
  return edges;
}

/// Merges equal edges into the first, with the tags of all, and the parts that an odd number of them bound.
std::vector<OutlineEdge> merged(const std::vector<OutlineEdge>& edges) {
  std::vector<std::uint32_t> order(edges.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i) { return std::minmax(edges[i].ends[0], edges[i].ends[1]); };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t i, std::uint32_t j) { return key(i) < key(j) || (key(i) == key(j) && i < j); });
  std::vector<std::uint32_t> first_of(edges.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && key(order[k]) == key(order[k - 1]);
    first_of[order[k]] = same ? first_of[order[k - 1]] : order[k];
  }
  std::vector<OutlineEdge> result;
  std::vector<std::size_t> place(edges.size());
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    if (first_of[i] == i) place[i] = result.size(), result.push_back({edges[i].ends, {}, {}, edges[i].segment});
    OutlineEdge& edge = result[place[first_of[i]]];
    if (edges[i].as == LineKind::faces) edge.as = LineKind::faces;
    for (const std::int32_t tag : edges[i].tags) {
      if (std::find(edge.tags.begin(), edge.tags.end(), tag) == edge.tags.end()) edge.tags.push_back(tag);
    }
    edge.parts.insert(edge.parts.end(), edges[i].parts.begin(), edges[i].parts.end());
  }
  for (OutlineEdge& edge : result) keep_odd(edge.parts);
  return result;
}

/// A part or ring whose edges all went encloses nothing any more.
Error check_kept(const Problem& problem, Arrangement& result) {
  const Outline& o = problem.outline;
  std::vector<std::uint8_t>& kept = result.kept;
  kept.assign(o.parts.size() + o.rings.size(), 0);
  for (const OutlineEdge& e : result.edges) {
    for (const std::int32_t part : e.parts) kept[static_cast<std::size_t>(part)] = 1;
  }
  for (std::size_t i = 0; i < kept.size() && problem.options.drop_below == 0; ++i) {
    const bool ring = i >= o.parts.size();
    const std::vector<std::int32_t>& segments = ring ? o.rings[i - o.parts.size()].segments : o.parts[i].segments;
    if (kept[i] != 0 || segments.empty()) continue;
    const auto first = static_cast<std::size_t>(segments[0]);
    const std::string name = ring ? problem.names.ring(i - o.parts.size()) : problem.names.part(i);
    return InputError{
        ErrorCode::zero_area, problem.names.segment_where(first),
        name + " at " + problem.text(problem.point(o.segments[first].ends[0])) + " encloses nothing" +
            (problem.tolerance > 0 ? " after joins within " + to_text(problem.tolerance) : std::string()) +
            ". Next: leave it out with --drop-below, or join less with --snap"};
  }
  const auto gone = std::count(kept.end() - static_cast<std::ptrdiff_t>(o.rings.size()), kept.end(), 0);
  if (gone > 0) {
    result.notes.push_back("rings left out, because their extent is below " + to_text(problem.options.drop_below) +
                           " or joins leave nothing of them: " + std::to_string(gone));
  }
  return {};
}

/// On the sphere a part is one of the sides of its lines, so they must be closed.
Error check_closed(const Problem& problem, const std::vector<Vec3>& places, const std::vector<OutlineEdge>& edges) {
  struct End {
    std::int32_t part, place;
    std::size_t edge;
    [[nodiscard]] bool meets(const End& other) const { return part == other.part && place == other.place; }
  };
  std::vector<End> ends;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (const std::int32_t part : edges[i].parts) {
      for (const std::int32_t end : edges[i].ends) ends.push_back({part, end, i});
    }
  }
  std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) {
    return std::tie(a.part, a.place, a.edge) < std::tie(b.part, b.place, b.edge);
  });
  const End* open = nullptr;
  for (std::size_t i = 0, next = 0; i < ends.size(); i = next) {
    while (next < ends.size() && ends[next].meets(ends[i])) ++next;
    if ((next - i) % 2 == 1 && (open == nullptr || ends[i].edge < open->edge)) open = &ends[i];
  }
  if (open == nullptr) return {};
  return at_segment(problem, ErrorCode::empty_input, edges[open->edge].segment,
                    "ends at " + problem.text(places[static_cast<std::size_t>(open->place)]) +
                        ", but no other segment goes on there; expected a closed coast");
}

/// Keeps one number for each place, in their order.
void number_places(std::size_t n_points, const Snapped& snapped, Arrangement& result) {
  std::vector<std::int32_t> number(snapped.places.size());
  for (std::size_t i = 0; i < number.size(); ++i) {
    const auto to = static_cast<std::size_t>(snapped.joined[i]);
    if (snapped.joined[i] < 0) {
      number[i] = -1;
    } else if (to == i) {
      number[i] = static_cast<std::int32_t>(result.places.size());
      result.origin.push_back(number[i]);
      result.places.push_back(snapped.places[i]);
      result.point.push_back(i < n_points ? static_cast<std::uint32_t>(i) : Arrangement::kNoPoint);
    } else {
      number[i] = number[to];
    }
    if (i < n_points) result.place_of_point.push_back(number[i]);
  }
  for (OutlineEdge& edge : result.edges) {
    for (std::int32_t& end : edge.ends) end = number[static_cast<std::size_t>(end)];
  }
}

}  // namespace

Expected<Arrangement> arrange(const Problem& problem, Deadline& deadline) {
  if (Error error = check_outline(problem)) return *std::move(error);
  const Snapped snapped = joined(problem, deadline);
  if (snapped.crossing) return crossing_error(problem, *snapped.crossing);
  const SegmentLabels labels = {parts_of_segments(problem.outline), tags_of_segments(problem.outline)};
  Arrangement result;
  result.edges = merged(cut(problem.outline, snapped, labels));
  if (Error error = check_kept(problem, result)) return *std::move(error);
  if (problem.is_closed()) {
    if (Error error = check_closed(problem, snapped.places, result.edges)) return *std::move(error);
  }
  number_places(problem.points.size(), snapped, result);
  if (snapped.joins > 0) result.notes.push_back(note_of_joins(problem, snapped));
  warn_of_lost_points(problem, snapped, result.warnings);
  warn_of_lost_lines(problem, snapped, labels, result.warnings);
  return result;
}

}  // namespace temper::mesher
