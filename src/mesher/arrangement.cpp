// Checks in a useful order: numbers, indices, places, crossings; then cutting and merging.
#include "mesher/arrangement.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/text.hpp"
#include "geometry/bounding_boxes.hpp"
#include "temper/detail/geometry.hpp"

namespace temper::mesher {
namespace {

using Error = std::optional<InputError>;

std::string coordinates(Vec2 p) { return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ")"; }

class Arranger {
 public:
  Arranger(const Surface& surface, const Outline& outline, const std::vector<Vec3>& places)
      : surface_(surface), o_(outline), places_(places), names_(names_of(outline)) {}

  Expected<std::vector<OutlineEdge>> run() {
    for (const auto check : {&Arranger::check_points, &Arranger::check_segments, &Arranger::check_places,
                             &Arranger::check_parts, &Arranger::find_meetings}) {
      if (Error error = (this->*check)()) return *std::move(error);
    }
    return cut_and_merge();
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

  Error check_places() {
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
                       "is at the same place as " + names_.point(order[k - 1]) + ", " + coordinates(o_.points[least]));
    }
    return first;
  }

  Error check_parts() {
    const auto n = static_cast<std::int32_t>(o_.segments.size());
    for (std::size_t i = 0; i < o_.parts.size(); ++i) {
      for (const std::int32_t segment : o_.parts[i].segments) {
        if (segment < 0 || segment >= n) {
          return InputError{ErrorCode::index_out_of_range, "",
                            names_.part(i) + " uses " +
                                names_.segment(static_cast<std::size_t>(std::int64_t{segment})) +
                                ", but the outline has " + std::to_string(n) + " segments"};
        }
      }
    }
    return {};
  }

  [[nodiscard]] bool strictly_inside(Vec3 p, Vec3 a, Vec3 b) const {
    return surface_.orientation(a, b, p) == Sign::zero && surface_.is_between(p, a, b);
  }

  void note_meeting(std::size_t segment, std::int32_t p) {
    const auto& ends = o_.segments[segment].ends;
    if (p != ends[0] && p != ends[1] && strictly_inside(point(p), point(ends[0]), point(ends[1]))) {
      on_segment_[segment].push_back(p);
    }
  }

  Error cross(std::size_t i, std::size_t j) {
    const auto [a, b] = o_.segments[i].ends;
    const auto [c, d] = o_.segments[j].ends;
    const auto side = [&](std::int32_t p, std::int32_t q, std::int32_t r) {
      return surface_.orientation(point(p), point(q), point(r));
    };
    // Two great circles meet twice: the segments meet only if c and a are on opposite sides of each other's segment.
    const Sign of_c = side(a, b, c), of_a = side(c, d, a);
    if (of_c != Sign::zero && side(a, b, d) == -of_c && of_a == -of_c && side(c, d, b) == of_c) {
      const auto name = [&](std::int32_t p) { return names_.point(static_cast<std::size_t>(p)); };
      const std::string where = names_.segment_where(i);
      return at_segment(ErrorCode::overlap, j,
                        "(" + name(c) + " to " + name(d) + ") crosses " + names_.segment(i) + " (" + name(a) + " to " +
                            name(b) + (where.empty() ? "" : ", " + where) +
                            "); expected segments to meet at points only");
    }
    note_meeting(i, c), note_meeting(i, d), note_meeting(j, a), note_meeting(j, b);
    return {};
  }

  Error find_meetings() {
    std::vector<BoundingBox> boxes;
    std::vector<std::uint8_t> used(o_.points.size(), 0);
    for (const OutlineSegment& s : o_.segments) {
      boxes.push_back(box_around(surface_, point(s.ends[0]), point(s.ends[1])));
      for (const std::int32_t end : s.ends) used[static_cast<std::size_t>(end)] = 1;
    }
    const BoundingBoxTree tree(boxes);
    on_segment_.resize(o_.segments.size());
    Error error;
    for (std::size_t i = 0; i < boxes.size() && !error; ++i) {
      tree.visit(boxes[i], [&](std::size_t j) {
        if (j > i && !error) error = cross(i, j);
        return !error;
      });
    }
    for (std::size_t p = 0; p < o_.points.size() && !error; ++p) {
      if (used[p] != 0) continue;
      tree.visit({places_[p], places_[p]}, [&](std::size_t i) {
        note_meeting(i, static_cast<std::int32_t>(p));
        return true;
      });
    }
    return error;
  }

  [[nodiscard]] std::vector<std::vector<std::int32_t>> parts_of_segments() const {
    std::vector<std::vector<std::int32_t>> parts(o_.segments.size());
    for (std::size_t i = 0; i < o_.parts.size(); ++i) {
      for (const std::int32_t s : o_.parts[i].segments) {
        parts[static_cast<std::size_t>(s)].push_back(static_cast<std::int32_t>(i));
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

  std::vector<OutlineEdge> cut() {
    const auto parts = parts_of_segments(), tags = tags_of_segments();
    std::vector<OutlineEdge> edges;
    for (std::size_t i = 0; i < o_.segments.size(); ++i) {
      std::vector<std::int32_t>& on = on_segment_[i];
      const std::int32_t a = o_.segments[i].ends[0], b = o_.segments[i].ends[1];
      std::sort(on.begin(), on.end(), [&](std::int32_t p, std::int32_t q) {
        const double dp = squared_length(point(p) - point(a)), dq = squared_length(point(q) - point(a));
        return dp < dq || (dp == dq && p < q);
      });
      on.erase(std::unique(on.begin(), on.end()), on.end());
      std::int32_t from = a;
      for (const std::int32_t p : on) {
        edges.push_back({{from, p}, tags[i], parts[i]});
        from = p;
      }
      edges.push_back({{from, b}, tags[i], parts[i]});
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
      if (first_of[i] == i) place[i] = merged.size(), merged.push_back({edges[i].ends, {}, {}});
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

  const Surface& surface_;
  const Outline& o_;
  const std::vector<Vec3>& places_;
  const OutlineNames& names_;
  std::vector<std::vector<std::int32_t>> on_segment_;
};

}  // namespace

const OutlineNames& names_of(const Outline& outline) {
  static const OutlineNames from_zero;
  return outline.names ? *outline.names : from_zero;
}

std::optional<InputError> check_tags(const std::vector<OutlineTag>& tags, const std::string& what, std::size_t n) {
  for (const OutlineTag& tag : tags) {
    if (tag.element >= 0 && static_cast<std::size_t>(tag.element) < n) continue;
    return InputError{ErrorCode::index_out_of_range, "",
                      "tag " + std::to_string(tag.tag) + " is for " + what + " " + std::to_string(tag.element) +
                          ", but the outline has " + std::to_string(n) + " " + what + "s"};
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

Expected<std::vector<OutlineEdge>> arrange(const Surface& surface, const Outline& outline,
                                           const std::vector<Vec3>& places) {
  return Arranger(surface, outline, places).run();
}

}  // namespace temper::mesher
