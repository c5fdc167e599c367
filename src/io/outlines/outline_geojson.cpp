// GeoJSON (RFC 7946): polygons become parts, lines stay inside as constrained edges, points as fixed vertices.
//
// Equal positions are one point, so polygons that share a piece of boundary share its edges. The reader uses four
// properties of a feature: "region" is a number (without it features count from 1 when there are several). "size" is
// the edge length inside, on its lines or at its points, "tag" the tag of its points and of the edges on its lines.
// "name" names their group, see NamedElements. Positions are longitude and latitude, unless a crs member of an older
// file names another system.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "io/outlines/outline_input.hpp"
#include "io/text/names.hpp"
#include "io/text/scanner.hpp"

namespace temper::io {
namespace {

using Type = JsonValue::Type;

constexpr std::array<std::string_view, 3> kProperties = {"region", "size", "tag"};

/// The property that a name misspells: one letter is too many, missing or another, two are swapped, or some are
/// capitals. Else empty.
std::string_view meant_by(std::string_view name) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  for (const std::string_view property : kProperties) {
    const std::size_t shorter = std::min(name.size(), property.size()), longer = std::max(name.size(), property.size());
    std::size_t head = 0, tail = 0;
    while (head < shorter && lower(name[head]) == property[head]) ++head;
    while (tail < shorter && lower(name[name.size() - 1 - tail]) == property[property.size() - 1 - tail]) ++tail;
    const bool swapped = shorter == longer && head + tail + 2 == longer && lower(name[head]) == property[head + 1] &&
                         lower(name[head + 1]) == property[head];
    if (head + tail + 1 >= longer || swapped) return property;
  }
  return {};
}

/// The properties of the feature around a geometry.
struct Feature {
  std::string name = "the geometry";
  std::optional<std::int32_t> region, tag;
  std::optional<double> size;
  std::string group;  ///< the property "name"
};

/// The points or segments of a feature with a name, in the order of the features.
struct NamedElements {
  int dimension = 0;
  std::int32_t tag = 0;  ///< of the feature; 0: none
  std::string name;
  std::vector<std::int32_t> elements;
};

class GeoJsonReader {
 public:
  GeoJsonReader(std::string path, std::string_view format, JsonValue root)
      : path_(std::move(path)), root_(std::move(root)) {
    document_.names = std::make_shared<OutlineFileNames>(path_);
    document_.file.format = format;
  }

  OutlineDocument read() {
    document_.file.geographic = is_geographic();
    const std::string_view type = root_.text("type");
    if (type == "FeatureCollection") {
      const std::vector<JsonValue>& features = items(root_, "features");
      for (std::size_t i = 0; i < features.size(); ++i)
        feature(features[i], features[i].string.empty() ? text("feature ", i) : features[i].string);
    } else if (type == "Feature") {
      feature(root_, "the feature");
    } else {
      geometry(root_, Feature());
    }
    number_regions();
    name_groups();
    if (dropped_ > 0) {
      document_.file.warnings.push_back(text(path_, ": ", dropped_, dropped_ == 1 ? " position is" : " positions are",
                                             " the same as the one before"));
    }
    if (heights_) document_.file.warnings.push_back(text(path_, ": heights of positions are dropped"));
    if (root_.line == 0) document_.names->point_lines = document_.names->segment_lines = {};
    return std::move(document_);
  }

 private:
  /// The line of a value; the path alone if the file has no lines.
  [[nodiscard]] std::string where(const JsonValue& value) const {
    return value.line == 0 ? path_ : text(path_, ":", value.line);
  }
  template <class... Parts>
  [[noreturn]] void fail_at(const JsonValue& value, ErrorCode code, const Parts&... message) const {
    fail(code, where(value), message...);
  }

  [[nodiscard]] bool is_geographic() const {
    const JsonValue* crs = root_.find("crs");
    const JsonValue* properties = crs != nullptr ? crs->find("properties") : nullptr;
    const std::string_view name = properties != nullptr ? properties->text("name") : root_.text("crs");
    for (const std::string_view geographic : {"CRS84", "4326", "4269", "4258"}) {
      if (name.ends_with(geographic)) return true;
    }
    return name.empty();
  }

  const std::vector<JsonValue>& items(const JsonValue& owner, std::string_view name) const {
    const JsonValue* member = owner.find(name);
    if (member == nullptr || member->type != Type::array) {
      fail_at(member != nullptr ? *member : owner, ErrorCode::syntax, "expected an array ", in_quotes(name), ", found ",
              member != nullptr ? describe(*member) : std::string_view("none"));
    }
    return member->items;
  }

  void feature(const JsonValue& value, const std::string& name) {
    if (value.text("type") != "Feature") {
      fail_at(value, ErrorCode::syntax, name, ": expected a Feature, found ", kind(value));
    }
    Feature about;
    about.name = name;
    if (const JsonValue* properties = value.find("properties")) {
      warn_of_misspelt(*properties, name);
      about.region = integer(*properties, "region", name);
      about.tag = integer(*properties, "tag", name);
      about.group = group_name(properties->text("name"));
      if (const JsonValue* size = properties->find("size"); size != nullptr && size->type == Type::number) {
        if (!(size->number > 0))
          fail_at(*size, ErrorCode::syntax, name, ": expected a size above 0, found ", size->number);
        about.size = size->number;
      }
    }
    const JsonValue* shape = value.find("geometry");
    if (shape == nullptr || shape->type == Type::null) return;  // allowed: a feature without a place
    geometry(*shape, about);
    warn_of_idle(*shape, about);
  }

  void warn_at(const JsonValue& value, const std::string& message) {
    document_.file.warnings.push_back(text(where(value), ": ", message));
  }

  /// Warns of numbers under a name that nearly has a meaning, and of values that should be numbers and are not.
  void warn_of_misspelt(const JsonValue& properties, const std::string& feature) {
    for (std::size_t i = 0; i < properties.names.size(); ++i) {
      const std::string& name = properties.names[i];
      const JsonValue& value = properties.items[i];
      const std::string_view meant = meant_by(name);
      const bool number = value.type == Type::number, exact = name == meant;
      if (meant.empty() || value.type == Type::null || number == exact) continue;
      if (exact) {
        warn_at(value,
                text(feature, ": property ", in_quotes(name), " is ", describe(value), ", not a number, and ignored"));
      } else {
        warn_at(value, text(feature, ": property ", in_quotes(name), " is ignored; is ", in_quotes(meant), " meant?"));
      }
    }
  }

  /// Warns of properties of polygons on other geometries.
  void warn_of_idle(const JsonValue& shape, const Feature& about) {
    const std::string_view type = shape.text("type");
    const bool polygon = type == "Polygon" || type == "MultiPolygon" || type == "GeometryCollection";
    if (about.region && !polygon)
      warn_at(shape, text(about.name, ": 'region' is for polygons and has no effect on a ", type));
  }

  /// The name without blanks at its ends, which formats of text cannot keep, and without control characters.
  [[nodiscard]] static std::string group_name(std::string_view name) {
    constexpr std::string_view kBlank = " \t\r\n";
    name.remove_prefix(std::min(name.find_first_not_of(kBlank), name.size()));
    name = name.substr(0, name.find_last_not_of(kBlank) + 1);
    return plain_name(name);
  }

  std::optional<std::int32_t> integer(const JsonValue& properties, std::string_view key,
                                      const std::string& name) const {
    const JsonValue* value = properties.find(key);
    if (value == nullptr || value->type != Type::number) return {};
    if (value->number != std::floor(value->number) || std::abs(value->number) > 2e9) {
      fail_at(*value, ErrorCode::syntax, name, ": expected a whole number as ", key, ", found ", value->number);
    }
    return static_cast<std::int32_t>(value->number);
  }

  [[nodiscard]] static std::string kind(const JsonValue& value) {
    return value.type == Type::object ? in_quotes(value.text("type")) : std::string(describe(value));
  }

  void geometry(const JsonValue& value, const Feature& about) {
    const std::string_view type = value.text("type");
    if (type == "GeometryCollection") {
      for (const JsonValue& inner : items(value, "geometries")) geometry(inner, about);
      return;
    }
    const JsonValue* coordinates = value.find("coordinates");
    const bool known = type == "Polygon" || type == "MultiPolygon" || type == "LineString" ||
                       type == "MultiLineString" || type == "Point" || type == "MultiPoint";
    if (!known) {
      fail_at(value, ErrorCode::syntax, about.name,
              ": expected a geometry (Polygon, MultiPolygon, LineString, MultiLineString, Point, "
              "MultiPoint, GeometryCollection), found ",
              kind(value));
    }
    if (coordinates == nullptr) fail_at(value, ErrorCode::syntax, about.name, ": has no \"coordinates\"");
    if (type == "Polygon") polygons({coordinates}, about);
    if (type == "MultiPolygon") {
      std::vector<const JsonValue*> all;
      for (const JsonValue& polygon : array(*coordinates, about.name)) all.push_back(&polygon);
      polygons(all, about);
    }
    const std::size_t first = document_.file.outline.segments.size();
    if (type == "LineString") line(*coordinates, about, about.name);
    if (type == "MultiLineString") {
      for (const JsonValue& one : array(*coordinates, about.name)) line(one, about, about.name);
    }
    if (type.ends_with("LineString")) {
      name_segments(about, first);
      for (std::size_t s = first; s < document_.file.outline.segments.size(); ++s)
        add_size(document_.file.outline.segments[s].ends, about);
    }
    if (type == "Point") marks({coordinates}, about);
    if (type == "MultiPoint") {
      std::vector<const JsonValue*> all;
      for (const JsonValue& one : array(*coordinates, about.name)) all.push_back(&one);
      marks(all, about);
    }
  }

  void name_segments(const Feature& about, std::size_t first) {
    if (about.group.empty()) return;
    NamedElements named{1, about.tag.value_or(0), about.group, {}};
    for (std::size_t s = first; s < document_.file.outline.segments.size(); ++s)
      named.elements.push_back(static_cast<std::int32_t>(s));
    named_.push_back(std::move(named));
  }

  void marks(const std::vector<const JsonValue*>& positions, const Feature& about) {
    NamedElements named{0, about.tag.value_or(0), about.group, {}};
    for (const JsonValue* position : positions) named.elements.push_back(well(*position, about));
    for (const std::int32_t p : named.elements) add_tag(p, named.tag), add_size({p, p}, about);
    if (!about.group.empty()) named_.push_back(std::move(named));
  }
  void add_size(const std::array<std::int32_t, 2>& points, const Feature& about) {
    if (about.size) document_.file.outline.sizes.push_back({points, *about.size});
  }
  void add_tag(std::int32_t point, std::int32_t tag) {
    if (tag != 0 && point_tags_.emplace(point, tag).second) document_.file.outline.point_tags.push_back({point, tag});
  }

  const std::vector<JsonValue>& array(const JsonValue& value, const std::string& name) const {
    if (value.type != Type::array) {
      fail_at(value, ErrorCode::syntax, name, ": expected an array, found ", describe(value));
    }
    return value.items;
  }

  /// All polygons of one geometry are one part: no interface between regions lies between them.
  void polygons(const std::vector<const JsonValue*>& all, const Feature& about) {
    OutlinePart part;
    part.size = about.size;
    part.region = about.region.value_or(0);
    given_region_.push_back(about.region.has_value() ? 1 : 0);
    part_groups_.push_back(about.group);
    const std::size_t first_segment = document_.file.outline.segments.size();
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::vector<JsonValue>& rings = array(*all[i], about.name);
      for (std::size_t k = 0; k < rings.size(); ++k) {
        const std::string name = text("ring ", k, all.size() > 1 ? text(" of polygon ", i) : "", " of ", about.name);
        Outline& o = document_.file.outline;
        OutlineRing ring;
        if (k > 0) ring.shell = static_cast<std::int32_t>(o.rings.size() - k);
        const std::size_t first = o.segments.size();
        line(rings[k], about, name);
        for (std::size_t s = first; s < o.segments.size(); ++s) ring.segments.push_back(static_cast<std::int32_t>(s));
        check_ring(rings[k], name, ring.segments.size());
        part.segments.insert(part.segments.end(), ring.segments.begin(), ring.segments.end());
        o.rings.push_back(std::move(ring));
        document_.names->rings.push_back(name);
      }
    }
    if (about.tag) name_segments(about, first_segment);
    document_.file.outline.parts.push_back(std::move(part));
    document_.names->parts.push_back(about.name);
  }

  void check_ring(const JsonValue& ring, const std::string& name, std::size_t segments) const {
    const JsonValue &first = ring.items.front(), &last = ring.items.back();
    if (first.numbers[0] != last.numbers[0] || first.numbers[1] != last.numbers[1]) {
      fail_at(last, ErrorCode::syntax, name, " is not closed: expected its last position to be its first, (",
              first.numbers[0], ", ", first.numbers[1], "), found (", last.numbers[0], ", ", last.numbers[1], ")");
    }
    if (segments < 3) fail_at(ring, ErrorCode::syntax, name, " has ", segments, " sides; expected three or more");
  }

  void line(const JsonValue& value, const Feature& about, const std::string& name) {
    Outline& o = document_.file.outline;
    const std::vector<JsonValue>& positions = array(value, name);
    if (positions.size() < 2)
      fail_at(value, ErrorCode::syntax, name, ": expected two positions or more, found ", positions.size());
    document_.names->groups.push_back({name, o.segments.size()});
    std::int32_t from = point(positions[0], name);
    for (std::size_t i = 1; i < positions.size(); ++i) {
      const std::int32_t to = point(positions[i], name);
      if (to == from) {
        ++dropped_;
        continue;
      }
      o.segments.push_back({{from, to}, about.tag.value_or(0)});
      document_.names->segment_lines.push_back(positions[i - 1].line);
      from = to;
    }
  }

  /// A point of its own. Two of them at one place would be one vertex without a word.
  std::int32_t well(const JsonValue& position, const Feature& about) {
    const std::int32_t p = point(position, about.name);
    const auto [known, is_new] = document_.names->point_names.emplace(p, text("the point of ", about.name));
    if (is_new) return p;
    warn_at(position, text("the point of ", about.name, " is at the place of ", known->second, ", (",
                           position.numbers[0], ", ", position.numbers[1], "), and becomes one vertex with it"));
    return p;
  }

  std::int32_t point(const JsonValue& position, const std::string& name) {
    if (position.type != Type::numbers || position.numbers.size() < 2) {
      fail_at(position, ErrorCode::syntax, name, ": expected a position [x, y], found ", describe(position));
    }
    heights_ = heights_ || position.numbers.size() > 2;
    // Negative zero is the same place as zero.
    const std::array<double, 2> place = {position.numbers[0] + 0.0, position.numbers[1] + 0.0};
    Outline& o = document_.file.outline;
    const auto [known, is_new] = point_at_.emplace(place, static_cast<std::int32_t>(o.points.size()));
    if (is_new) {
      o.points.push_back({place[0], place[1]});
      document_.names->point_lines.push_back(position.line);
    }
    return known->second;
  }

  /// Several polygons without regions of their own count from 1. Polygons of one name are one region; a name without a
  /// region gets a free one.
  void number_regions() {
    std::vector<OutlinePart>& parts = document_.file.outline.parts;
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
        document_.file.outline.groups.push_back({2, region, known->second});
      } else if (known->second != part_groups_[i]) {
        document_.file.warnings.push_back(text(path_, ": region ", region, " is named '", known->second,
                                               "'; its name '", part_groups_[i],
                                               "' is dropped, because a region has one name"));
      }
    }
  }

  /// Gives each name of points and lines its tag. It is the tag of its features, if that is one tag with one name. Else
  /// it is a free one, above 1 and all others. Elements then carry it beside the tags that they have.
  void name_groups() {
    std::map<std::pair<int, std::string>, std::set<std::int32_t>> tags_of;
    std::map<std::pair<int, std::int32_t>, std::set<std::string>> names_of;
    std::int32_t highest = 1;
    for (const OutlineSegment& s : document_.file.outline.segments) highest = std::max(highest, s.tag);
    for (const OutlineTag& p : document_.file.outline.point_tags) highest = std::max(highest, p.tag);
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
        document_.file.outline.groups.push_back({named.dimension, tag_of[group], named.name});
      }
      carry(named, tag_of[group]);
    }
  }
  void carry(const NamedElements& named, std::int32_t tag) {
    Outline& o = document_.file.outline;
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

  std::string path_;
  JsonValue root_;
  OutlineDocument document_;
  std::map<std::array<double, 2>, std::int32_t> point_at_;  // no hash, which a file could be made to defeat
  std::vector<std::uint8_t> given_region_;
  std::vector<std::string> part_groups_;  // names of parts
  std::vector<NamedElements> named_;
  std::set<std::pair<std::int32_t, std::int32_t>> point_tags_;  // that the outline has
  std::size_t dropped_ = 0;
  bool heights_ = false;
};

}  // namespace

bool sniff_geojson(std::string_view head) {
  if (head.starts_with("\xef\xbb\xbf")) head.remove_prefix(3);
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && head[first] == '{';
}

OutlineDocument read_geojson(Source& source) {
  return read_features(source.path, "geojson", parse_json(source.path, source.bytes));
}

OutlineDocument read_features(const std::string& path, std::string_view format, JsonValue root) {
  return GeoJsonReader(path, format, std::move(root)).read();
}

}  // namespace temper::io
