// GeoJSON (RFC 7946): polygons become parts, lines stay inside as constrained edges, points as fixed vertices.
//
// Equal positions are one point, so polygons that share a piece of boundary share its edges. The reader uses five
// properties of a feature: "region" is a number (without it features count from 1 when there are several). "size" is
// the edge length inside, on its lines or at its points, "tag" the tag of its points and of the edges on its lines.
// "name" names their group, see NamedElements. "as" says what its lines or borders become: "edges" or "faces".
// Positions are longitude and latitude, unless a crs member of an older file names another system.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "io/outlines/feature_names.hpp"
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
  LineKind as = LineKind::edges;
};

/// The name without blanks at its ends, which formats of text cannot keep, and without control characters.
std::string group_name(std::string_view name) {
  constexpr std::string_view kBlank = " \t\r\n";
  name.remove_prefix(std::min(name.find_first_not_of(kBlank), name.size()));
  name = name.substr(0, name.find_last_not_of(kBlank) + 1);
  return plain_name(name);
}

std::string kind(const JsonValue& value) {
  return value.type == Type::object ? in_quotes(value.text("type")) : std::string(describe(value));
}

/// Says whether positions are longitude and latitude.
bool is_geographic(const JsonValue& root) {
  const JsonValue* crs = root.find("crs");
  const JsonValue* properties = crs != nullptr ? crs->find("properties") : nullptr;
  const std::string_view name = properties != nullptr ? properties->text("name") : root.text("crs");
  for (const std::string_view geographic : {"CRS84", "4326", "4269", "4258"}) {
    if (name.ends_with(geographic)) return true;
  }
  return name.empty();
}

/// Warns of numbers under a name that nearly has a meaning, and of values that should be numbers and are not.
void warn_of_misspelt(const JsonValue& properties, const std::string& feature,
                      const std::function<void(const JsonValue&, const std::string&)>& warn_at) {
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

void add_size(Outline& outline, const std::array<std::int32_t, 2>& points, const Feature& about) {
  if (about.size) outline.sizes.push_back({points, *about.size});
}

class GeoJsonReader {
 public:
  GeoJsonReader(std::string path, std::string_view format, JsonValue root)
      : path_(std::move(path)), root_(std::move(root)) {
    document_.names = std::make_shared<OutlineFileNames>(path_);
    document_.file.format = format;
  }

  OutlineDocument read() {
    document_.file.geographic = is_geographic(root_);
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
    names_.number_regions(path_, document_.file.warnings);
    names_.name_groups();
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
  [[noreturn]] void fail_at(const JsonValue& value, ErrorCode code, const auto&... message) const {
    fail(code, where(value), message...);
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
    if (value.text("type") != "Feature")
      fail_at(value, ErrorCode::syntax, name, ": expected a Feature, found ", kind(value));
    Feature about;
    about.name = name;
    if (const JsonValue* properties = value.find("properties")) {
      warn_of_misspelt(*properties, name, [this](const auto& at, const auto& message) { warn_at(at, message); });
      about.region = integer(*properties, "region", name);
      about.tag = integer(*properties, "tag", name);
      about.group = group_name(properties->text("name"));
      if (const JsonValue* size = properties->find("size"); size != nullptr && size->type == Type::number) {
        if (!(size->number > 0))
          fail_at(*size, ErrorCode::syntax, name, ": expected a size above 0, found ", size->number);
        about.size = size->number;
      }
      about.as = line_kind(*properties, name);
    }
    const JsonValue* shape = value.find("geometry");
    if (shape == nullptr || shape->type == Type::null) return;  // allowed: a feature without a place
    geometry(*shape, about);
    warn_of_idle(*shape, about);
  }

  [[nodiscard]] LineKind line_kind(const JsonValue& properties, const std::string& name) const {
    const JsonValue* as = properties.find("as");
    if (as == nullptr || as->type == Type::null) return LineKind::edges;
    const std::string_view word = properties.text("as");
    if (word != "edges" && word != "faces")
      fail_at(*as, ErrorCode::syntax, name, ": expected \"edges\" or \"faces\" as \"as\", found ",
              as->type == Type::string ? in_quotes(word) : std::string(describe(*as)));
    return word == "faces" ? LineKind::faces : LineKind::edges;
  }

  void warn_at(const JsonValue& value, const std::string& message) {
    document_.file.warnings.push_back(text(where(value), ": ", message));
  }

  /// Warns of properties of polygons on other geometries.
  void warn_of_idle(const JsonValue& shape, const Feature& about) {
    const std::string_view type = shape.text("type");
    const bool polygon = type == "Polygon" || type == "MultiPolygon" || type == "GeometryCollection";
    if (about.region && !polygon)
      warn_at(shape, text(about.name, ": 'region' is for polygons and has no effect on a ", type));
    if (about.as == LineKind::faces && type.ends_with("Point"))
      warn_at(shape, text(about.name, ": 'as' is for lines and polygons and has no effect on a ", type));
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

  void geometry(const JsonValue& value, const Feature& about) {
    const std::string_view type = value.text("type");
    if (type == "GeometryCollection") {
      for (const JsonValue& inner : items(value, "geometries")) geometry(inner, about);
      return;
    }
    const bool is_multiple = type.starts_with("Multi");
    const std::string_view part = type.substr(is_multiple ? 5 : 0);
    if (part != "Polygon" && part != "LineString" && part != "Point") {
      fail_at(value, ErrorCode::syntax, about.name,
              ": expected a geometry (Polygon, MultiPolygon, LineString, MultiLineString, Point, "
              "MultiPoint, GeometryCollection), found ",
              kind(value));
    }
    const JsonValue* coordinates = value.find("coordinates");
    if (coordinates == nullptr) fail_at(value, ErrorCode::syntax, about.name, ": has no \"coordinates\"");
    std::vector<const JsonValue*> parts = {coordinates};
    if (is_multiple) {
      parts.clear();
      for (const JsonValue& one : array(*coordinates, about.name)) parts.push_back(&one);
    }
    if (part == "Polygon") polygons(parts, about);
    if (part == "LineString") lines(parts, about);
    if (part == "Point") marks(parts, about);
  }

  void lines(const std::vector<const JsonValue*>& all, const Feature& about) {
    const std::size_t first = document_.file.outline.segments.size();
    for (const JsonValue* one : all) line(*one, about, about.name);
    name_segments(about, first);
    Outline& o = document_.file.outline;
    for (std::size_t s = first; s < o.segments.size(); ++s) add_size(o, o.segments[s].ends, about);
  }

  void name_segments(const Feature& about, std::size_t first) {
    NamedElements named{1, about.tag.value_or(0), about.group, {}};
    for (std::size_t s = first; s < document_.file.outline.segments.size(); ++s)
      named.elements.push_back(static_cast<std::int32_t>(s));
    names_.add(std::move(named));
  }

  void marks(const std::vector<const JsonValue*>& positions, const Feature& about) {
    NamedElements named{0, about.tag.value_or(0), about.group, {}};
    for (const JsonValue* position : positions) named.elements.push_back(well(*position, about));
    for (const std::int32_t p : named.elements)
      names_.add_tag(p, named.tag), add_size(document_.file.outline, {p, p}, about);
    names_.add(std::move(named));
  }
  const std::vector<JsonValue>& array(const JsonValue& value, const std::string& name) const {
    if (value.type != Type::array)
      fail_at(value, ErrorCode::syntax, name, ": expected an array, found ", describe(value));
    return value.items;
  }

  /// All polygons of one geometry are one part: no interface between regions lies between them.
  void polygons(const std::vector<const JsonValue*>& all, const Feature& about) {
    OutlinePart part;
    part.size = about.size;
    part.region = about.region.value_or(0);
    names_.add_part(about.region.has_value(), about.group);
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
      o.segments.push_back({{from, to}, about.tag.value_or(0), about.as});
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

  std::string path_;
  JsonValue root_;
  OutlineDocument document_;
  FeatureNames names_{document_.file.outline};
  std::map<std::array<double, 2>, std::int32_t> point_at_;  // no hash, which a file could be made to defeat
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
