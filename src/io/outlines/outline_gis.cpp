// Shapefiles and GeoPackages through GDAL: the features of all layers, as in GeoJSON. Coordinates are taken bit for
// bit.
//
// Fields with the names of GeoJSON's properties, in letters of any case, are these properties. A feature is called by
// its number (FID) and its layer.
#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "io/containers/gdal_library.hpp"
#include "io/outlines/outline_input.hpp"
#include "io/text/names.hpp"
#include "io/text/scanner.hpp"

namespace temper::io {
namespace {

using Type = JsonValue::Type;

JsonValue json(Type type) { return {.type = type}; }
JsonValue json(std::string string) { return {.type = Type::string, .string = std::move(string)}; }
JsonValue json(double number) { return {.type = Type::number, .number = number}; }
void add(JsonValue& object, std::string_view name, JsonValue member) {
  object.names.emplace_back(name);
  object.items.push_back(std::move(member));
}

class GisReader {
 public:
  explicit GisReader(const std::string& path) : path_(path), gdal_(path, GdalFile::Kind::vector) {}

  OutlineDocument read() {
    JsonValue features = json(Type::array);
    for (int i = 0; i < gdal_->GDALDatasetGetLayerCount(gdal_.data()); ++i) {
      void* const layer = gdal_->GDALDatasetGetLayer(gdal_.data(), i);
      const std::size_t before = features.items.size();
      gdal_->OGR_L_ResetReading(layer);
      while (void* const feature = gdal_->OGR_L_GetNextFeature(layer)) {
        add_feature(feature, gdal_->OGR_L_GetName(layer), features);
        gdal_->OGR_F_Destroy(feature);
      }
      if (features.items.size() > before) take_system(layer);
    }
    JsonValue root = json(Type::object);
    add(root, "type", json("FeatureCollection"));
    if (!is_geographic_.value_or(false)) add(root, "crs", json("projected"));
    add(root, "features", std::move(features));
    OutlineDocument document = read_features(path_, "gis", std::move(root));
    if (has_no_system_) {
      document.file.warnings.push_back(
          text(path_, ": has no coordinate system (in shapefiles .prj). temper takes the numbers for ",
               *is_geographic_ ? "longitude and latitude" : "lengths in a plane"));
    }
    return document;
  }

 private:
  void add_feature(void* feature, std::string_view layer, JsonValue& features) {
    void* const shape = gdal_->OGR_F_GetGeometryRef(feature);
    if (shape == nullptr) return;
    JsonValue value = json(Type::object), properties = json(Type::object);
    value.string = text("feature ", gdal_->OGR_F_GetFID(feature), " of ", layer);
    constexpr std::array<std::string_view, 5> kKeptNames = {"as", "name", "region", "size", "tag"};
    for (int i = 0; i < gdal_->OGR_F_GetFieldCount(feature); ++i) {
      if (gdal_->OGR_F_IsFieldSetAndNotNull(feature, i) == 0) continue;
      void* const field = gdal_->OGR_F_GetFieldDefnRef(feature, i);
      std::string name = gdal_->OGR_Fld_GetNameRef(field);
      if (const std::string lower = lower_case(name); std::ranges::find(kKeptNames, lower) != kKeptNames.end())
        name = lower;
      constexpr int kInteger = 0, kReal = 2, kInteger64 = 12;
      const int type = gdal_->OGR_Fld_GetType(field);
      add(properties, name,
          type == kInteger || type == kReal || type == kInteger64
              ? json(gdal_->OGR_F_GetFieldAsDouble(feature, i))
              : json(std::string(gdal_->OGR_F_GetFieldAsString(feature, i))));
    }
    void* const lines = gdal_->OGR_G_GetLinearGeometry(shape, 0, nullptr);  // arcs become chains
    add(value, "type", json("Feature"));
    add(value, "properties", std::move(properties));
    add(value, "geometry", geometry(lines));
    gdal_->OGR_G_DestroyGeometry(lines);
    features.items.push_back(std::move(value));
  }

  [[nodiscard]] JsonValue geometry(void* shape) {
    constexpr std::array<std::string_view, 8> kShapes = {
        "", "Point", "LineString", "Polygon", "MultiPoint", "MultiLineString", "MultiPolygon", "GeometryCollection"};
    // The highest bit and thousands stand for heights and measures.
    const auto type = (static_cast<unsigned>(gdal_->OGR_G_GetGeometryType(shape)) & 0x7fffffffU) % 1000;
    JsonValue value = json(Type::object);
    const bool is_known = type > 0 && type < kShapes.size();
    add(value, "type", json(is_known ? std::string(kShapes.at(type)) : gdal_->OGR_G_GetGeometryName(shape)));
    if (type < kShapes.size() - 1) {
      add(value, "coordinates", coordinates(shape, type));
      return value;
    }
    JsonValue all = json(Type::array);
    for (int i = 0; i < gdal_->OGR_G_GetGeometryCount(shape); ++i)
      all.items.push_back(geometry(gdal_->OGR_G_GetGeometryRef(shape, i)));
    add(value, "geometries", std::move(all));
    return value;
  }

  [[nodiscard]] JsonValue coordinates(void* shape, unsigned type) {
    constexpr unsigned kPoint = 1, kLineString = 2, kPolygon = 3, kParts = 3;
    const auto position = [&](int i) {
      JsonValue value = json(Type::numbers);
      value.numbers = {gdal_->OGR_G_GetX(shape, i), gdal_->OGR_G_GetY(shape, i)};
      for (std::size_t k = 0; k < 2; ++k) largest_.at(k) = std::max(largest_.at(k), std::abs(value.numbers[k]));
      return value;
    };
    if (type == kPoint) return position(0);
    JsonValue all = json(Type::array);
    const bool is_line = type == kLineString;
    const int n = is_line ? gdal_->OGR_G_GetPointCount(shape) : gdal_->OGR_G_GetGeometryCount(shape);
    for (int i = 0; i < n; ++i) {
      const unsigned of_part = type == kPolygon ? kLineString : type - kParts;
      all.items.push_back(is_line ? position(i) : coordinates(gdal_->OGR_G_GetGeometryRef(shape, i), of_part));
    }
    return all;
  }

  /// Without a system, as the numbers look.
  void take_system(void* layer) {
    constexpr double kMostLongitude = 360, kMostLatitude = 90;
    void* const system = gdal_->OGR_L_GetSpatialRef(layer);
    has_no_system_ = has_no_system_ || system == nullptr;
    const bool is_geographic = system != nullptr ? gdal_->OSRIsGeographic(system) != 0
                                                 : largest_[0] <= kMostLongitude && largest_[1] <= kMostLatitude;
    if (is_geographic_.value_or(is_geographic) != is_geographic)
      fail(ErrorCode::unsupported, path_, "layer ", in_quotes(gdal_->OGR_L_GetName(layer)),
           is_geographic ? " is in degrees, but the layers before it are not"
                         : " is not in degrees, as the layers before it",
           ". Next: give all layers one coordinate system");
    is_geographic_ = is_geographic;
  }

  const std::string& path_;
  GdalFile gdal_;
  std::optional<bool> is_geographic_;
  std::array<double, 2> largest_ = {};
  bool has_no_system_ = false;
};

}  // namespace

bool sniff_gis(std::string_view head) {
  using namespace std::string_view_literals;
  return head.starts_with("\0\0\x27\x0a"sv) || head.starts_with("SQLite format 3\0"sv);
}

OutlineDocument read_gis(Source& source) { return GisReader(source.path).read(); }

}  // namespace temper::io
