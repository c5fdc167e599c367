// Checks in a useful order: numbers, indices, places; then joins, crossings, cutting and merging.
#include "mesher/arrangement.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

#include "base/text.hpp"
#include "temper/detail/geometry.hpp"

namespace temper::mesher {
namespace {

using Error = std::optional<InputError>;

class Arranger {
 public:
  Arranger(const Surface& surface, const Outline& outline, const std::vector<Vec3>& places, SnapOptions options,
           double drop_below, Deadline& deadline)
      : surface_(surface),
        o_(outline),
        places_(places),
        names_(names_of(outline)),
        options_(std::move(options)),
        drop_below_(drop_below),
        deadline_(deadline) {}

  Expected<Arrangement> run() {
    for (const auto check : {&Arranger::check_points, &Arranger::check_segments, &Arranger::check_places,
                             &Arranger::check_parts, &Arranger::join}) {
      if (Error error = (this->*check)()) return *std::move(error);
    }
    Arrangement result;
    result.edges = cut_and_merge();
    if (Error error = check_kept(result)) return *std::move(error);
    if (surface_.space().is_closed()) {
      if (Error error = check_closed(result.edges)) return *std::move(error);
    }
    number_places(result);
    if (snapped_.joins > 0) result.notes.push_back(note_of_joins());
    warn_of_lost_points(result.warnings);
    warn_of_lost_lines(result.warnings);
    return result;
  }

 private:
  [[nodiscard]] Vec3 point(std::int32_t i) const { return places_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] InputError at_point(ErrorCode code, std::size_t i, const std::string& what) const {
    return {code, names_.point_where(i), names_.point(i) + " " + what};
  }
  [[nodiscard]] InputError at_segment(ErrorCode code, std::size_t i, const std::string& what) const {
    return {code, names_.segment_where(i), names_.segment(i) + " " + what};
  }

  Error check_points() {
    if (!surface_.space().is_closed() && (o_.points.empty() || o_.segments.empty())) {
      return InputError{ErrorCode::empty_input, "",
                        "the outline has no " + std::string(o_.points.empty() ? "points" : "segments")};
    }
    for (std::size_t i = 0; i < o_.points.size(); ++i) {
      const Vec2 p = o_.points[i];
      if (!std::isfinite(p.x) || !std::isfinite(p.y)) {
        return at_point(ErrorCode::not_finite, i, "has coordinates " + coordinates(p) + "; expected finite numbers");
      }
      if (!is_exact_coordinate(p.x) || !is_exact_coordinate(p.y)) {
        return at_point(ErrorCode::out_of_scale, i, "has coordinates too large or too small for exact arithmetic");
      }
    }
    return check_tags(o_.point_tags, "point", o_.points.size());
  }

  Error check_segments() {
    const auto n = static_cast<std::int64_t>(o_.points.size());
    for (std::size_t i = 0; i < o_.segments.size(); ++i) {
      const auto& ends = o_.segments[i].ends;
      for (const std::int32_t end : ends) {
        if (end < 0 || end >= n) {
          return at_segment(ErrorCode::index_out_of_range, i,
                            "uses " + names_.point(static_cast<std::size_t>(std::int64_t{end})) +
                                ", but the outline has " + std::to_string(n) + " points");
        }
      }
      if (ends[0] == ends[1]) {
        return at_segment(ErrorCode::zero_area, i,
                          "has no length: both its ends are " + names_.point(static_cast<std::size_t>(ends[0])));
      }
    }
    return check_tags(o_.further_tags, "segment", o_.segments.size());
  }

  /// Two points at one place are an error if nothing is joined.
  Error check_places() {
    if (options_.within > 0) return {};
    std::vector<std::uint32_t> order(o_.points.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t i) { return std::array{places_[i].x, places_[i].y, places_[i].z}; };
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t i, std::uint32_t j) { return key(i) < key(j) || (key(i) == key(j) && i < j); });
    Error first;
    std::uint32_t least = 0;
    for (std::size_t k = 1; k < order.size(); ++k) {
      if (key(order[k - 1]) != key(order[k]) || (first && order[k] > least)) continue;
      least = order[k];
      first = at_point(ErrorCode::duplicate_point, order[k],
                       "is at the same place as " + names_.point(order[k - 1]) + ", " + text(places_[least]));
    }
    return first;
  }

  Error check_parts() {
    for (std::size_t i = 0; i < o_.parts.size(); ++i) {
      if (Error error = check_uses(names_.part(i), o_.parts[i].segments)) return error;
    }
    for (std::size_t i = 0; i < o_.rings.size(); ++i) {
      if (Error error = check_uses(names_.ring(i), o_.rings[i].segments)) return error;
      if (o_.rings[i].shell >= static_cast<std::int32_t>(o_.rings.size())) {
        return InputError{ErrorCode::index_out_of_range, "",
                          names_.ring(i) + " is a hole of ring " + std::to_string(o_.rings[i].shell) +
                              ", but the outline has " + std::to_string(o_.rings.size()) + " rings"};
      }
    }
    return {};
  }

  [[nodiscard]] Error check_uses(const std::string& what, const std::vector<std::int32_t>& segments) const {
    const auto n = static_cast<std::int32_t>(o_.segments.size());
    for (const std::int32_t segment : segments) {
      if (segment >= 0 && segment < n) continue;
      return InputError{ErrorCode::index_out_of_range, "",
                        what + " uses " + names_.segment(static_cast<std::size_t>(std::int64_t{segment})) +
                            ", but the outline has " + std::to_string(n) + " segments"};
    }
    return {};
  }

  [[nodiscard]] std::string text(Vec3 place) const { return text_of(surface_, names_, place); }

  Error join() {
    const std::vector<std::uint8_t> dropped = drop_small_rings();
    std::vector<SegmentPart> segments;
    segments.reserve(o_.segments.size());
    for (std::size_t i = 0; i < dropped.size(); ++i) {
      if (dropped[i] == 0) segments.push_back({o_.segments[i].ends, static_cast<std::uint32_t>(i)});
    }
    snapped_ = snap(surface_, places_, std::move(segments), options_, deadline_);
    if (snapped_.crossing) return crossing(*snapped_.crossing);
    return {};
  }

  /// Says which segments are left out. Points that have no other segment are ignored.
  std::vector<std::uint8_t> drop_small_rings() {
    std::vector<std::uint8_t> dropped(o_.segments.size(), 0), small(o_.rings.size(), 0);
    if (drop_below_ == 0) return dropped;
    for (std::size_t i = 0; i < o_.rings.size(); ++i) {
      const OutlineRing& ring = o_.rings[i];
      small[i] = extent_of(ring) < drop_below_ ? 1 : 0;
      if (ring.shell >= 0 && static_cast<std::size_t>(ring.shell) < i) {
        small[i] |= small[static_cast<std::size_t>(ring.shell)];
      }
      if (small[i] == 0) continue;
      for (const std::int32_t s : ring.segments) dropped[static_cast<std::size_t>(s)] = 1;
    }
    options_.ignored.assign(o_.points.size(), 0);
    for (const std::uint8_t pass :
         {std::uint8_t{1}, std::uint8_t{0}}) {  // first all points of rings that go, then not those that others use
      for (std::size_t i = 0; i < dropped.size(); ++i) {
        if (dropped[i] != pass) continue;
        for (const std::int32_t end : o_.segments[i].ends) options_.ignored[static_cast<std::size_t>(end)] = pass;
      }
    }
    return dropped;
  }
  [[nodiscard]] double extent_of(const OutlineRing& ring) const {
    if (ring.segments.empty()) return 0;
    const auto ends = [&](std::int32_t s) { return o_.segments[static_cast<std::size_t>(s)].ends; };
    const Vec3 first = point(ends(ring.segments[0])[0]);
    BoundingBox box = {first, first};
    for (const std::int32_t s : ring.segments) {
      for (const std::int32_t end : ends(s)) box = temper::united(box, {point(end), point(end)});
    }
    return length(box.high - box.low);
  }

  [[nodiscard]] InputError crossing(const Crossing& crossing) const {
    const std::size_t i = crossing.first, j = crossing.second;
    const auto ends = [&](std::size_t segment) {
      const auto [a, b] = o_.segments[segment].ends;
      return "(" + names_.point(static_cast<std::size_t>(a)) + " to " + names_.point(static_cast<std::size_t>(b));
    };
    const std::string where = names_.segment_where(i);
    return at_segment(ErrorCode::overlap, j,
                      ends(j) + ") crosses " + names_.segment(i) + " " + ends(i) + (where.empty() ? "" : ", " + where) +
                          ") at " + text(crossing.at) +
                          "; expected segments to meet at points only. Next: --split-crossings (split_crossings=True "
                          "in Python) divides both there");
  }

  [[nodiscard]] std::string note_of_joins() const {
    const auto farthest = static_cast<std::size_t>(snapped_.farthest);
    return "points joined to a point or segment within " + to_text(options_.within) + ": " +
           std::to_string(snapped_.joins) + "; the largest distance is " + to_text(snapped_.largest) + ", at " +
           text(places_[farthest]);
  }

  [[nodiscard]] std::vector<std::vector<std::int32_t>> parts_of_segments() const {
    std::vector<std::vector<std::int32_t>> parts(o_.segments.size());
    for (std::size_t i = 0; i < o_.parts.size(); ++i) {
      for (const std::int32_t s : o_.parts[i].segments) {
        parts[static_cast<std::size_t>(s)].push_back(static_cast<std::int32_t>(i));
      }
    }
    for (std::size_t i = 0; i < o_.rings.size(); ++i) {
      for (const std::int32_t s : o_.rings[i].segments) {
        parts[static_cast<std::size_t>(s)].push_back(static_cast<std::int32_t>(o_.parts.size() + i));
      }
    }
    return parts;
  }

  [[nodiscard]] std::vector<std::vector<std::int32_t>> tags_of_segments() const {
    std::vector<std::vector<std::int32_t>> tags(o_.segments.size());
    for (std::size_t i = 0; i < tags.size(); ++i) {
      if (o_.segments[i].tag != 0) tags[i].push_back(o_.segments[i].tag);
    }
    for (const OutlineTag& further : o_.further_tags) {
      if (further.tag != 0) tags[static_cast<std::size_t>(further.element)].push_back(further.tag);
    }
    return tags;
  }

  /// Two points of no segment that became one are two of the user's things.
  void warn_of_lost_points(std::vector<std::string>& warnings) const {
    std::vector<std::uint8_t> is_alone(o_.points.size(), 1);
    for (const OutlineSegment& s : o_.segments) {
      for (const std::int32_t end : s.ends) is_alone[static_cast<std::size_t>(end)] = 0;
    }
    for (std::size_t i = 0; i < is_alone.size(); ++i) {
      const auto to = static_cast<std::size_t>(snapped_.joined[i]);
      if (to == i || is_alone[i] == 0 || is_alone[to] == 0) continue;  // those left out are not alone
      warnings.push_back(names_.point(i) + " and " + names_.point(to) + " are at one place, " + text(places_[to]) +
                         ", and become one vertex");
    }
  }

  /// Segments with a common end and tag are one line. Lines of which joins leave no edge are named; what remains of
  /// parts and rings is checked elsewhere.
  void warn_of_lost_lines(std::vector<std::string>& warnings) const {
    std::vector<std::uint8_t> left(o_.segments.size(), 0);
    for (const SegmentPart& part : snapped_.parts) left[part.segment] = 1;
    if (std::find(left.begin(), left.end(), 0) == left.end()) return;
    const auto parts = parts_of_segments(), tags = tags_of_segments();
    std::vector<std::size_t> line(left.size());  // its first segment
    const auto first = [&](std::size_t i) {
      while (line[i] != i) i = line[i] = line[line[i]];
      return i;
    };
    std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> at_end;  // and of that tag
    for (std::size_t i = 0; i < line.size(); ++i) {
      line[i] = i;
      for (const std::int32_t end : o_.segments[i].ends) {
        const std::size_t other = first(at_end.emplace(std::pair(end, o_.segments[i].tag), i).first->second);
        const auto [less, more] = std::minmax({other, first(i)});
        line[more] = less;
      }
    }
    for (std::size_t i = 0; i < left.size(); ++i) left[first(i)] |= left[i];
    for (std::size_t i = 0; i < left.size(); ++i) {
      if (first(i) != i || left[i] != 0 || !parts[i].empty()) continue;
      std::string text_of_tags;
      for (const std::int32_t tag : tags[i]) text_of_tags += ", " + name_of_tag(o_, 1, tag);
      warnings.push_back("joins within " + to_text(options_.within) + " (--snap) remove the whole line at " +
                         text(point(o_.segments[i].ends[0])) + ", " + names_.segment(i) + text_of_tags +
                         ": its points become one. Next: a smaller --snap keeps it");
    }
  }

  std::vector<OutlineEdge> cut() {
    const auto parts = parts_of_segments(), tags = tags_of_segments();
    std::vector<OutlineEdge> edges;
    edges.reserve(snapped_.parts.size());
    for (const SegmentPart& part : snapped_.parts) {
      edges.push_back({part.ends, tags[part.segment], parts[part.segment], part.segment});
    }
    return edges;
  }

  /// Merges equal edges into the first, with the tags of all, and the parts that an odd number of them bound.
  std::vector<OutlineEdge> cut_and_merge() {
    const std::vector<OutlineEdge> edges = cut();
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
    std::vector<OutlineEdge> merged;
    std::vector<std::size_t> place(edges.size());
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
      if (first_of[i] == i) place[i] = merged.size(), merged.push_back({edges[i].ends, {}, {}, edges[i].segment});
      OutlineEdge& edge = merged[place[first_of[i]]];
      for (const std::int32_t tag : edges[i].tags) {
        if (std::find(edge.tags.begin(), edge.tags.end(), tag) == edge.tags.end()) edge.tags.push_back(tag);
      }
      edge.parts.insert(edge.parts.end(), edges[i].parts.begin(), edges[i].parts.end());
    }
    for (OutlineEdge& edge : merged) keep_odd(edge.parts);
    return merged;
  }

  /// Keeps each value that occurs an odd number of times once, sorted.
  static void keep_odd(std::vector<std::int32_t>& values) {
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

  /// A part or ring whose edges all went encloses nothing any more.
  [[nodiscard]] Error check_kept(Arrangement& result) {
    std::vector<std::uint8_t>& kept = result.kept;
    kept.assign(o_.parts.size() + o_.rings.size(), 0);
    for (const OutlineEdge& e : result.edges) {
      for (const std::int32_t part : e.parts) kept[static_cast<std::size_t>(part)] = 1;
    }
    for (std::size_t i = 0; i < kept.size() && drop_below_ == 0; ++i) {
      const bool ring = i >= o_.parts.size();
      const std::vector<std::int32_t>& segments = ring ? o_.rings[i - o_.parts.size()].segments : o_.parts[i].segments;
      if (kept[i] != 0 || segments.empty()) continue;
      const auto first = static_cast<std::size_t>(segments[0]);
      const std::string name = ring ? names_.ring(i - o_.parts.size()) : names_.part(i);
      return InputError{ErrorCode::zero_area, names_.segment_where(first),
                        name + " at " + text(point(o_.segments[first].ends[0])) + " encloses nothing" +
                            (options_.within > 0 ? " after joins within " + to_text(options_.within) : std::string()) +
                            ". Next: leave it out with --drop-below, or join less with --snap"};
    }
    const auto gone = std::count(kept.end() - static_cast<std::ptrdiff_t>(o_.rings.size()), kept.end(), 0);
    if (gone > 0) {
      result.notes.push_back("rings left out, because their extent is below " + to_text(drop_below_) +
                             " or joins leave nothing of them: " + std::to_string(gone));
    }
    return {};
  }

  /// On the sphere a part is one of the sides of its lines, so they must be closed.
  [[nodiscard]] Error check_closed(const std::vector<OutlineEdge>& edges) const {
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
    return at_segment(ErrorCode::empty_input, edges[open->edge].segment,
                      "ends at " + text(snapped_.places[static_cast<std::size_t>(open->place)]) +
                          ", but no other segment goes on there; expected a closed coast");
  }

  /// Keeps one number for each place, in their order.
  void number_places(Arrangement& result) const {
    std::vector<std::int32_t> number(snapped_.places.size());
    for (std::size_t i = 0; i < number.size(); ++i) {
      const auto to = static_cast<std::size_t>(snapped_.joined[i]);
      if (snapped_.joined[i] < 0) {
        number[i] = -1;
      } else if (to == i) {
        number[i] = static_cast<std::int32_t>(result.places.size());
        result.origin.push_back(number[i]);
        result.places.push_back(snapped_.places[i]);
        result.point.push_back(i < places_.size() ? static_cast<std::uint32_t>(i) : Arrangement::kNoPoint);
      } else {
        number[i] = number[to];
      }
      if (i < places_.size()) result.place_of_point.push_back(number[i]);
    }
    for (OutlineEdge& edge : result.edges) {
      for (std::int32_t& end : edge.ends) end = number[static_cast<std::size_t>(end)];
    }
  }

  const Surface& surface_;
  const Outline& o_;
  const std::vector<Vec3>& places_;
  const OutlineNames& names_;
  SnapOptions options_;
  double drop_below_;
  Deadline& deadline_;
  Snapped snapped_;
};

}  // namespace

const OutlineNames& names_of(const Outline& outline) {
  static const OutlineNames from_zero;
  return outline.names ? *outline.names : from_zero;
}

std::string name_of_tag(const Outline& outline, int dimension, std::int32_t tag) {
  const auto named = std::find_if(outline.groups.begin(), outline.groups.end(),
                                  [&](const PhysicalName& g) { return g.dimension == dimension && g.tag == tag; });
  return named == outline.groups.end() ? "tag " + std::to_string(tag) : "'" + named->name + "'";
}

std::optional<InputError> check_tags(const std::vector<OutlineTag>& tags, const std::string& what, std::size_t n) {
  for (const OutlineTag& tag : tags) {
    if (tag.element >= 0 && static_cast<std::size_t>(tag.element) < n) continue;
    std::string message = "tag " + std::to_string(tag.tag) + " is for ";
    message.append(what).append(" ").append(std::to_string(tag.element));
    message.append(", but the outline has ").append(std::to_string(n)).append(" ").append(what).append("s");
    return InputError{ErrorCode::index_out_of_range, "", std::move(message)};
  }
  return {};
}

std::optional<InputError> check_sizes(const Outline& outline) {
  const OutlineNames& names = names_of(outline);
  const auto n = static_cast<std::int64_t>(outline.points.size());
  for (const OutlineSize& s : outline.sizes) {
    for (const std::int32_t p : s.points) {
      if (p >= 0 && p < n) continue;
      return InputError{ErrorCode::index_out_of_range, "",
                        "size " + to_text(s.size) + " is for point " + std::to_string(p) + ", but the outline has " +
                            std::to_string(n) + " points"};
    }
    if (s.size > 0 && std::isfinite(s.size)) continue;
    const auto p = static_cast<std::size_t>(s.points[0]);
    return InputError{ErrorCode::invalid_option, names.point_where(p),
                      names.point(p) + " has size " + to_text(s.size) + "; expected a finite, positive length"};
  }
  return {};
}

std::string text_of(const Surface& surface, const OutlineNames& names, Vec3 place) {
  const Vec2 p = names.in_file(surface.space().as_shown(place));
  return "(" + to_text(p.x) + ", " + to_text(p.y) + ")";
}

Expected<Arrangement> arrange(const Surface& surface, const Outline& outline, const std::vector<Vec3>& places,
                              const SnapOptions& options, double drop_below, Deadline& deadline) {
  return Arranger(surface, outline, places, options, drop_below, deadline).run();
}

}  // namespace temper::mesher
