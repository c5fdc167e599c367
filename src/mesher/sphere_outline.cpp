#include "mesher/sphere_outline.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "base/text.hpp"
#include "mesher/arrangement.hpp"
#include "temper/detail/projection.hpp"

namespace temper::mesher {
namespace {

// Relative to the radius: more than the rounding of degrees in another convention, less than any edge.
constexpr double kSamePlace = 1e-13;
// Relative to the radius: two ends at least this far from opposite have one shortest way between them.
constexpr double kOpposite = 1e-9;

/// An element of the outline, and its source.
struct Origin {
  std::size_t outline = 0, element = 0;
};

/// Errors in the names of the outline that an element comes from.
class JoinedNames final : public OutlineNames {
 public:
  std::vector<std::shared_ptr<const OutlineNames>> outlines;
  std::vector<Origin> points, segments, holes, regions, parts;

  [[nodiscard]] std::string point(std::size_t i) const override { return say(points, i, &OutlineNames::point); }
  [[nodiscard]] std::string segment(std::size_t i) const override { return say(segments, i, &OutlineNames::segment); }
  [[nodiscard]] std::string hole(std::size_t i) const override { return say(holes, i, &OutlineNames::hole); }
  [[nodiscard]] std::string region(std::size_t i) const override { return say(regions, i, &OutlineNames::region); }
  [[nodiscard]] std::string part(std::size_t i) const override {
    return parts[i].element == kLoops ? "what closed lines enclose" : say(parts, i, &OutlineNames::part);
  }
  [[nodiscard]] std::string point_where(std::size_t i) const override {
    return say(points, i, &OutlineNames::point_where);
  }
  [[nodiscard]] std::string segment_where(std::size_t i) const override {
    return say(segments, i, &OutlineNames::segment_where);
  }
  [[nodiscard]] std::string hole_where(std::size_t i) const override {
    return say(holes, i, &OutlineNames::hole_where);
  }
  [[nodiscard]] std::string region_where(std::size_t i) const override {
    return say(regions, i, &OutlineNames::region_where);
  }

  static constexpr std::size_t kLoops = static_cast<std::size_t>(-1);  // the part of segments of no part

 private:
  std::string say(const std::vector<Origin>& origins, std::size_t i,
                  std::string (OutlineNames::*name)(std::size_t) const) const {
    return (*outlines[origins[i].outline].*name)(origins[i].element);
  }
};

class Joiner {
 public:
  explicit Joiner(const SphereOutline& given)
      : radius_(given.radius), sources_{&given.basins, &given.coasts, &given.lines} {}

  Expected<JoinedOutline> run() {
    const auto from_zero = std::make_shared<const OutlineNames>();
    for (const Outline* outline : sources_) {
      names_->outlines.push_back(outline->names ? outline->names : from_zero);
    }
    for (std::size_t k = 0; k < sources_.size(); ++k) {
      if (auto error = check(k)) return *std::move(error);
    }
    join_points();
    find_tags_without_name();
    for (std::size_t k = 0; k < sources_.size(); ++k) {
      if (auto error = add(k)) return *std::move(error);
    }
    result_.outline.names = names_;
    return std::move(result_);
  }

 private:
  using Error = std::optional<InputError>;
  static constexpr std::size_t kBasins = 0, kCoasts = 1, kLines = 2;
  static constexpr std::int32_t kHighestTag = 2'000'000'000;  // free numbers come after it

  [[nodiscard]] const OutlineNames& names(std::size_t k) const { return *names_->outlines[k]; }
  [[nodiscard]] InputError at_segment(std::size_t k, std::size_t i, ErrorCode code, const std::string& what) const {
    return {code, names(k).segment_where(i), names(k).segment(i) + " " + what};
  }

  /// Checks that numbers are degrees, and that segments join existing points.
  Error check(std::size_t k) const {
    const Outline& o = *sources_[k];
    for (std::size_t i = 0; i < o.points.size(); ++i) {
      if (is_place(o.points[i])) continue;
      return InputError{ErrorCode::geographic, names(k).point_where(i),
                        names(k).point(i) + user_of(o, k, i) + " has longitude " + to_text(o.points[i].x) +
                            " and latitude " + to_text(o.points[i].y) +
                            "; expected degrees, a latitude between -90 and 90"};
    }
    const auto n = static_cast<std::int64_t>(o.points.size());
    for (std::size_t i = 0; i < o.segments.size(); ++i) {
      for (const std::int32_t end : o.segments[i].ends) {
        if (end >= 0 && end < n) continue;
        return at_segment(k, i, ErrorCode::index_out_of_range,
                          "uses " + names(k).point(static_cast<std::size_t>(std::int64_t{end})) +
                              ", but the outline has " + std::to_string(n) + " points");
      }
    }
    for (const auto& [tags, what, size] : {std::tuple(&o.point_tags, "point", o.points.size()),
                                           std::tuple(&o.further_tags, "segment", o.segments.size())}) {
      if (auto error = check_tags(*tags, what, size)) return error;
    }
    if (auto error = check_sizes(o)) return error;
    return check_conventions(k);
  }

  [[nodiscard]] static bool is_place(Vec2 lon_lat) {
    return std::abs(lon_lat.y) <= 90 && std::abs(lon_lat.x) <= 720;  // false for NaN
  }
  /// " (segment 3 of feature 1)": the place in the file of a point without a name of its own.
  [[nodiscard]] std::string user_of(const Outline& o, std::size_t k, std::size_t point) const {
    const auto p = static_cast<std::int32_t>(point);
    const auto user = std::find_if(o.segments.begin(), o.segments.end(),
                                   [p](const OutlineSegment& s) { return s.ends[0] == p || s.ends[1] == p; });
    if (user == o.segments.end()) return {};
    return " (" + names(k).segment(static_cast<std::size_t>(user - o.segments.begin())) + ")";
  }

  /// If longitudes are below 0 and above 180, a jump has two meanings. It is the way across the end of one convention,
  /// or an edge from the other.
  Error check_conventions(std::size_t k) const {
    const Outline& o = *sources_[k];
    const auto any = [&](auto test) { return std::any_of(o.points.begin(), o.points.end(), test); };
    if (!any([](Vec2 p) { return p.x < 0; }) || !any([](Vec2 p) { return p.x > 180; })) return {};
    for (std::size_t i = 0; i < o.segments.size(); ++i) {
      const double from = point(o, o.segments[i].ends[0]).x, to = point(o, o.segments[i].ends[1]).x;
      if (std::abs(to - from) <= 180) continue;
      return at_segment(k, i, ErrorCode::geographic,
                        "goes from longitude " + to_text(from) + " to " + to_text(to) +
                            ", in a file with longitudes below 0 and above 180; expected one convention, or steps of "
                            "at most 180 degrees");
    }
    return {};
  }
  [[nodiscard]] static Vec2 point(const Outline& o, std::int32_t i) { return o.points[static_cast<std::size_t>(i)]; }

  /// Keeps one point for each place, the first given one.
  void join_points() {
    std::vector<Vec3> directions;
    std::vector<Origin> origins;
    for (std::size_t k = 0; k < sources_.size(); ++k) {
      first_point_.push_back(directions.size());
      for (std::size_t i = 0; i < sources_[k]->points.size(); ++i) {
        directions.push_back(direction_of(sources_[k]->points[i]));
        origins.push_back({k, i});
      }
    }
    const std::vector<std::uint32_t> first = first_of_each_place(directions);
    result_.numbers.resize(directions.size());
    for (std::size_t i = 0; i < directions.size(); ++i) {
      if (first[i] == i) {
        result_.numbers[i] = static_cast<std::int32_t>(result_.places.size());
        result_.places.push_back(radius_ * directions[i]);
        result_.outline.points.push_back(sources_[origins[i].outline]->points[origins[i].element]);
        names_->points.push_back(origins[i]);
      } else {
        result_.numbers[i] = result_.numbers[first[i]];
      }
    }
  }

  static std::vector<std::uint32_t> first_of_each_place(const std::vector<Vec3>& directions) {
    std::vector<std::uint32_t> order(directions.size()), first(directions.size());
    std::iota(order.begin(), order.end(), 0u);
    std::iota(first.begin(), first.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
      return directions[i].x != directions[j].x ? directions[i].x < directions[j].x : i < j;
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
      const Vec3 p = directions[order[i]];
      for (std::size_t j = i + 1; j < order.size() && directions[order[j]].x - p.x <= kSamePlace; ++j) {
        if (squared_length(directions[order[j]] - p) > kSamePlace * kSamePlace) continue;
        const std::uint32_t least = std::min(first[order[i]], first[order[j]]);
        first[order[i]] = first[order[j]] = least;
      }
    }
    for (std::uint32_t& f : first) f = first[f];
    return first;
  }

  // --- names of several outlines, as one list. Each outline has its own tags for its names ---

  using Group = std::pair<int, std::int32_t>;  // dimension and tag

  /// Tags without a name keep their number, so no name may get it.
  void find_tags_without_name() {
    for (const Outline* o : sources_) {
      std::set<Group> tags, named;
      for (const OutlineSegment& s : o->segments) tags.emplace(1, s.tag);
      for (const OutlineTag& further : o->further_tags) tags.emplace(1, further.tag);
      for (const OutlineTag& p : o->point_tags) tags.emplace(0, p.tag);
      for (const PhysicalName& g : o->groups) named.emplace(g.dimension, g.tag);
      for (const Group& tag : tags) {
        highest_ = std::max(highest_, std::min(tag.second, kHighestTag));
        if (!named.contains(tag)) taken_.insert(tag);
      }
    }
  }
  /// The tag of a name in the common list: its own number, unless another group has it.
  std::int32_t tag_of(int dimension, std::int32_t tag, const std::string& name) {
    const auto [known, is_new] = tags_.emplace(std::pair(dimension, name), tag);
    if (!is_new) return known->second;
    if (tag == 0 || taken_.contains({dimension, tag})) known->second = ++highest_;
    taken_.emplace(dimension, known->second);
    result_.outline.groups.push_back({dimension, known->second, name});
    return known->second;
  }
  /// The tags of an outline in the common list, by its own; regions stay.
  std::map<Group, std::int32_t> common_tags(std::size_t k) {
    std::map<Group, std::int32_t> tags;
    for (const PhysicalName& g : sources_[k]->groups) {
      if (g.dimension < 2) {
        tags.emplace(Group(g.dimension, g.tag), tag_of(g.dimension, g.tag, g.name));
      } else if (k == kBasins) {
        result_.outline.groups.push_back(g);
      }
    }
    return tags;
  }
  /// Coasts and lines leave no region in the mesh. So the names of their polygons go to the edges of these, as further
  /// tags.
  void name_edges_of_polygons(std::size_t k, const std::vector<std::int32_t>& now) {
    const Outline& o = *sources_[k];
    std::map<std::int32_t, std::int32_t> tag_of_region;
    for (const PhysicalName& g : o.groups) {
      if (g.dimension == 2 && k != kBasins) tag_of_region.emplace(g.tag, tag_of(1, 0, g.name));
    }
    for (const OutlinePart& part : o.parts) {
      const auto tag = tag_of_region.find(part.region);
      if (tag == tag_of_region.end()) continue;
      for (const std::int32_t s : part.segments) {
        const auto i = static_cast<std::size_t>(s);
        if (s >= 0 && i < now.size() && now[i] >= 0) result_.outline.further_tags.push_back({now[i], tag->second});
      }
    }
  }

  Error add(std::size_t k) {
    const Outline& o = *sources_[k];
    const std::map<Group, std::int32_t> tags = common_tags(k);
    const auto common = [&tags](int dimension, std::int32_t tag) {
      const auto found = tags.find({dimension, tag});
      return found == tags.end() ? tag : found->second;
    };
    std::vector<std::int32_t> now(o.segments.size(), -1);  // segments between two names of one place go
    for (std::size_t i = 0; i < o.segments.size(); ++i) {
      OutlineSegment segment = o.segments[i];
      for (std::int32_t& end : segment.ends) end = number(k, end);
      if (segment.ends[0] == segment.ends[1]) continue;
      const Vec3 a = place(segment.ends[0]), b = place(segment.ends[1]);
      if (length(a + b) < kOpposite * radius_)
        return at_segment(k, i, ErrorCode::geographic,
                          "joins opposite places of the sphere; expected one shortest way between its ends");
      segment.tag = common(1, segment.tag);
      now[i] = static_cast<std::int32_t>(result_.outline.segments.size());
      result_.outline.segments.push_back(segment);
      names_->segments.push_back({k, i});
    }
    name_edges_of_polygons(k, now);
    for (const OutlineTag& p : o.point_tags)
      result_.outline.point_tags.push_back({number(k, p.element), common(0, p.tag)});
    for (const OutlineTag& further : o.further_tags) {
      const std::int32_t there = now[static_cast<std::size_t>(further.element)];
      if (there >= 0) result_.outline.further_tags.push_back({there, common(1, further.tag)});
    }
    for (OutlineSize size : o.sizes) {
      for (std::int32_t& p : size.points) p = result_.numbers[first_point_[k] + static_cast<std::size_t>(p)];
      result_.outline.sizes.push_back(size);
    }
    for (std::size_t i = 0; i < o.holes.size(); ++i) {
      result_.outline.holes.push_back(o.holes[i]);
      names_->holes.push_back({k, i});
    }
    for (std::size_t i = 0; i < o.regions.size(); ++i) {
      result_.outline.regions.push_back(o.regions[i]);
      names_->regions.push_back({k, i});
    }
    return k == kLines ? Error() : add_parts(k, now);
  }
  [[nodiscard]] Vec3 place(std::int32_t i) const { return result_.places[static_cast<std::size_t>(i)]; }
  /// The place of a point of an outline.
  [[nodiscard]] std::int32_t number(std::size_t k, std::int32_t point) const {
    return result_.numbers[first_point_[k] + static_cast<std::size_t>(point)];
  }

  /// Adds the parts of an outline, and the part that its other segments enclose.
  Error add_parts(std::size_t k, const std::vector<std::int32_t>& now) {
    const Outline& o = *sources_[k];
    std::vector<std::uint8_t> loose(o.segments.size(), 1);
    for (std::size_t i = 0; i < o.parts.size(); ++i) {
      for (const std::int32_t s : o.parts[i].segments) {
        if (s >= 0 && static_cast<std::size_t>(s) < loose.size()) loose[static_cast<std::size_t>(s)] = 0;
      }
      if (auto error = add_part(k, o.parts[i], now, i)) return error;
    }
    OutlinePart loops;
    for (std::size_t s = 0; s < loose.size(); ++s) {
      if (loose[s] != 0) loops.segments.push_back(static_cast<std::int32_t>(s));
    }
    if (loops.segments.empty()) return {};
    return add_part(k, loops, now, JoinedNames::kLoops);
  }

  Error add_part(std::size_t k, OutlinePart part, const std::vector<std::int32_t>& now, std::size_t element) {
    if (auto error = check_closed(k, part.segments)) return error;
    std::vector<std::int32_t> segments;
    for (const std::int32_t s : part.segments) {
      const std::int32_t there = now[static_cast<std::size_t>(s)];
      if (there >= 0) segments.push_back(there);
    }
    part.segments = std::move(segments);
    part.cut = k == kCoasts;
    result_.outline.parts.push_back(std::move(part));
    names_->parts.push_back({k, element});
    return {};
  }

  Error check_closed(std::size_t k, const std::vector<std::int32_t>& segments) {
    const Outline& o = *sources_[k];
    const auto number = [&](std::int32_t end) {
      return static_cast<std::size_t>(result_.numbers[first_point_[k] + static_cast<std::size_t>(end)]);
    };
    degree_.resize(result_.places.size(), 0);
    for (const std::int32_t s : segments) {
      if (s < 0 || static_cast<std::size_t>(s) >= o.segments.size())
        return InputError{ErrorCode::index_out_of_range, "",
                          "a part uses " + names(k).segment(static_cast<std::size_t>(std::int64_t{s})) +
                              ", but the outline has " + std::to_string(o.segments.size()) + " segments"};
      for (const std::int32_t end : o.segments[static_cast<std::size_t>(s)].ends) ++degree_[number(end)];
    }
    for (const std::int32_t s : segments) {
      const auto i = static_cast<std::size_t>(s);
      for (const std::int32_t end : o.segments[i].ends) {
        if (degree_[number(end)] % 2 == 0) continue;
        const Vec2 p = point(o, end);
        return at_segment(k, i, ErrorCode::empty_input,
                          "ends at (" + to_text(p.x) + ", " + to_text(p.y) +
                              "), but no other segment goes on there; expected a closed coast");
      }
    }
    for (const std::int32_t s : segments) {
      for (const std::int32_t end : o.segments[static_cast<std::size_t>(s)].ends) degree_[number(end)] = 0;
    }
    return {};
  }

  double radius_;
  std::vector<const Outline*> sources_;
  std::shared_ptr<JoinedNames> names_ = std::make_shared<JoinedNames>();
  JoinedOutline result_;
  std::vector<std::size_t> first_point_;                      // of each outline, among all points given
  std::vector<std::uint32_t> degree_;                         // of places, in the part that is looked at; else 0
  std::set<Group> taken_;                                     // tags that no further name may get
  std::int32_t highest_ = 1;                                  // of all tags
  std::map<std::pair<int, std::string>, std::int32_t> tags_;  // of names
};

}  // namespace

Expected<JoinedOutline> join(const SphereOutline& given) { return Joiner(given).run(); }

}  // namespace temper::mesher
