#include "mesher/sphere_outline.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "base/text.hpp"
#include "mesher/problem.hpp"
#include "temper/detail/projection.hpp"

namespace temper::mesher {
namespace {

// Relative to the radius: two ends at least this far from opposite have one shortest way between them.
constexpr double kOpposite = 1e-9;
// In degrees: files that end at 180 pass it by rounding, as 180.00000000000014.
constexpr double kEndOfMap = 180 + 1e-9;

/// An element of the outline, and its source.
struct Origin {
  std::size_t outline = 0, element = 0;
};

/// Errors in the names of the outline that an element comes from.
class UnitedNames final : public OutlineNames {
 public:
  std::vector<std::shared_ptr<const OutlineNames>> outlines;
  std::vector<Origin> points, segments, holes, regions, parts, rings;

  [[nodiscard]] std::string point(std::size_t i) const override { return say(points, i, &OutlineNames::point); }
  [[nodiscard]] std::string segment(std::size_t i) const override { return say(segments, i, &OutlineNames::segment); }
  [[nodiscard]] std::string hole(std::size_t i) const override { return say(holes, i, &OutlineNames::hole); }
  [[nodiscard]] std::string region(std::size_t i) const override { return say(regions, i, &OutlineNames::region); }
  [[nodiscard]] std::string part(std::size_t i) const override {
    return parts[i].element == kLoops ? "what closed lines enclose" : say(parts, i, &OutlineNames::part);
  }
  [[nodiscard]] std::string ring(std::size_t i) const override { return say(rings, i, &OutlineNames::ring); }
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

class Uniter {
 public:
  explicit Uniter(const SphereOutline& given)
      : radius_(given.radius), sources_{&given.basins, &given.coasts, &given.lines} {}

  Expected<SphereOutlines> run() {
    const auto from_zero = std::make_shared<const OutlineNames>();
    for (const Outline* outline : sources_) {
      names_->outlines.push_back(outline->names ? outline->names : from_zero);
    }
    for (std::size_t k = 0; k < sources_.size(); ++k) {
      if (auto error = check(k)) return *std::move(error);
    }
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
    if (!any([](Vec2 p) { return p.x < 0; }) || !any([](Vec2 p) { return p.x > kEndOfMap; })) return {};
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
  void name_edges_of_polygons(std::size_t k) {
    const Outline& o = *sources_[k];
    std::map<std::int32_t, std::int32_t> tag_of_region;
    for (const PhysicalName& g : o.groups) {
      if (g.dimension == 2 && k != kBasins) tag_of_region.emplace(g.tag, tag_of(1, 0, g.name));
    }
    for (const OutlinePart& part : o.parts) {
      const auto tag = tag_of_region.find(part.region);
      if (tag == tag_of_region.end()) continue;
      for (const std::int32_t s : part.segments) {
        if (s >= 0 && static_cast<std::size_t>(s) < o.segments.size())
          result_.outline.further_tags.push_back({first_segment_ + s, tag->second});
      }
    }
  }

  /// Appends elements of outline k to all of their kind, and their origins.
  template <class T>
  static void append(const std::vector<T>& elements, std::size_t k, std::vector<T>& all, std::vector<Origin>& origins) {
    for (std::size_t i = 0; i < elements.size(); ++i) origins.push_back({k, i});
    all.insert(all.end(), elements.begin(), elements.end());
  }

  Error add(std::size_t k) {
    const Outline& o = *sources_[k];
    const auto first_point = static_cast<std::int32_t>(result_.places.size());
    first_segment_ = static_cast<std::int32_t>(result_.outline.segments.size());
    const std::map<Group, std::int32_t> tags = common_tags(k);
    const auto common = [&tags](int dimension, std::int32_t tag) {
      const auto found = tags.find({dimension, tag});
      return found == tags.end() ? tag : found->second;
    };
    append(o.points, k, result_.outline.points, names_->points);
    for (const Vec2 p : o.points) result_.places.push_back(radius_ * direction_of(p));
    for (std::size_t i = 0; i < o.segments.size(); ++i) {
      OutlineSegment segment = o.segments[i];
      for (std::int32_t& end : segment.ends) end += first_point;
      if (length(place(segment.ends[0]) + place(segment.ends[1])) < kOpposite * radius_)
        return at_segment(k, i, ErrorCode::geographic,
                          "joins opposite places of the sphere; expected one shortest way between its ends");
      segment.tag = common(1, segment.tag);
      result_.outline.segments.push_back(segment);
      names_->segments.push_back({k, i});
    }
    name_edges_of_polygons(k);
    for (const OutlineTag& p : o.point_tags)
      result_.outline.point_tags.push_back({first_point + p.element, common(0, p.tag)});
    for (const OutlineTag& further : o.further_tags)
      result_.outline.further_tags.push_back({first_segment_ + further.element, common(1, further.tag)});
    for (const OutlineSize& s : o.sizes)
      result_.outline.sizes.push_back({{first_point + s.points[0], first_point + s.points[1]}, s.size});
    append(o.holes, k, result_.outline.holes, names_->holes);
    append(o.regions, k, result_.outline.regions, names_->regions);
    return k == kLines ? Error() : add_parts(k);
  }
  [[nodiscard]] Vec3 place(std::int32_t i) const { return result_.places[static_cast<std::size_t>(i)]; }

  /// Adds the parts and rings of an outline, and the part that its other segments enclose.
  Error add_parts(std::size_t k) {
    const Outline& o = *sources_[k];
    std::vector<std::uint8_t> loose(o.segments.size(), 1);
    for (std::size_t i = 0; i < o.parts.size(); ++i) {
      for (const std::int32_t s : o.parts[i].segments) {
        if (s < 0 || static_cast<std::size_t>(s) >= loose.size())
          return InputError{ErrorCode::index_out_of_range, "",
                            "a part uses " + names(k).segment(static_cast<std::size_t>(std::int64_t{s})) +
                                ", but the outline has " + std::to_string(o.segments.size()) + " segments"};
        loose[static_cast<std::size_t>(s)] = 0;
      }
      add_part(k, o.parts[i], i);
    }
    const auto first_ring = static_cast<std::int32_t>(result_.outline.rings.size());
    for (std::size_t i = 0; i < o.rings.size(); ++i) {
      OutlineRing ring = o.rings[i];
      for (std::int32_t& s : ring.segments) s += first_segment_;
      if (ring.shell >= 0) ring.shell += first_ring;
      result_.outline.rings.push_back(std::move(ring));
      names_->rings.push_back({k, i});
    }
    OutlinePart loops;
    for (std::size_t s = 0; s < loose.size(); ++s) {
      if (loose[s] != 0) loops.segments.push_back(static_cast<std::int32_t>(s));
    }
    if (!loops.segments.empty()) add_part(k, loops, UnitedNames::kLoops);
    return {};
  }

  void add_part(std::size_t k, OutlinePart part, std::size_t element) {
    for (std::int32_t& s : part.segments) s += first_segment_;
    part.cut = k == kCoasts;
    result_.outline.parts.push_back(std::move(part));
    names_->parts.push_back({k, element});
  }

  double radius_;
  std::vector<const Outline*> sources_;
  std::shared_ptr<UnitedNames> names_ = std::make_shared<UnitedNames>();
  SphereOutlines result_;
  std::int32_t first_segment_ = 0;                            // of the outline that is added
  std::set<Group> taken_;                                     // tags that no further name may get
  std::int32_t highest_ = 1;                                  // of all tags
  std::map<std::pair<int, std::string>, std::int32_t> tags_;  // of names
};

}  // namespace

Expected<SphereOutlines> united(const SphereOutline& given) { return Uniter(given).run(); }

}  // namespace temper::mesher
