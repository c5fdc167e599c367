// GeoTIFF through GDAL. Values are at centers of cells.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/containers/gdal_library.hpp"
#include "io/formats/raster.hpp"

namespace temper::io {
namespace {

class GdalRaster {
 public:
  explicit GdalRaster(const std::string& path) : path_(path), file_(path, GdalFile::Kind::raster) {}

  Raster read(const std::optional<std::array<Vec2, 2>>& window) const {
    std::array<double, 6> place = {};
    if (file_->GDALGetGeoTransform(file_.data(), place.data()) != 0)
      fail(ErrorCode::unsupported, path_,
           "the raster has no place. Next: give it one, for example by gdal_translate -a_ullr");
    if (place[2] != 0 || place[4] != 0)
      fail(ErrorCode::unsupported, path_, "the raster is turned. Next: gdalwarp makes columns and rows follow x and y");
    Raster raster;
    raster.degrees = std::string_view(file_->GDALGetProjectionRef(file_.data())).starts_with("GEOG");
    Part x = {0, file_->GDALGetRasterXSize(file_.data())}, y = {0, file_->GDALGetRasterYSize(file_.data())};
    if (window) {
      x = part(x, place[0], place[1], (*window)[0].x, (*window)[1].x, raster.degrees);
      y = part(y, place[3], place[5], (*window)[0].y, (*window)[1].y, false);
    }
    for (int i = 0; i < x.size; ++i) raster.x.push_back(place[0] + (x.first + i + 0.5) * place[1]);
    for (int j = 0; j < y.size; ++j) raster.y.push_back(place[3] + (y.first + j + 0.5) * place[5]);
    for (int band = 1; band <= file_->GDALGetRasterCount(file_.data()); ++band)
      raster.data.push_back({"Band" + std::to_string(band), 1, values(band, x, y)});
    return raster;
  }

 private:
  struct Part {
    int first, size;
  };
  /// The columns or rows around a window; all if longitudes may have to move by a turn.
  static Part part(Part all, double start, double step, double low, double high, bool may_turn) {
    constexpr double kMore = 3;
    const double a = (low - start) / step, b = (high - start) / step;
    const double from = std::floor(std::min(a, b)) - kMore, to = std::ceil(std::max(a, b)) + kMore;
    if (to <= 0 || from >= all.size || (may_turn && (from < 0 || to > all.size))) return all;
    const int first = static_cast<int>(std::max(from, 0.0));
    return {first, static_cast<int>(std::min<double>(to, all.size)) - first};
  }

  [[nodiscard]] std::vector<double> values(int number, Part x, Part y) const {
    constexpr int kRead = 0, kDoubles = 7;
    void* const band = file_->GDALGetRasterBand(file_.data(), number);
    std::vector<double> all(static_cast<std::size_t>(x.size) * static_cast<std::size_t>(y.size));
    if (file_->GDALRasterIO(band, kRead, x.first, y.first, x.size, y.size, all.data(), x.size, y.size, kDoubles, 0,
                            0) != 0)
      file_.refuse("cannot be read by GDAL");
    int has_missing = 0, has_scale = 0, has_offset = 0;
    const double missing = file_->GDALGetRasterNoDataValue(band, &has_missing);
    const double scale = file_->GDALGetRasterScale(band, &has_scale);
    const double offset = file_->GDALGetRasterOffset(band, &has_offset);
    for (double& value : all) {
      if (has_missing != 0 && value == missing) {
        value = std::numeric_limits<double>::quiet_NaN();
      } else {
        value = (has_scale != 0 ? scale : 1) * value + (has_offset != 0 ? offset : 0);
      }
    }
    return all;
  }

  const std::string& path_;
  GdalFile file_;
};

}  // namespace

bool sniff_geotiff(std::string_view head) {
  using namespace std::string_view_literals;
  return head.starts_with("II*\0"sv) || head.starts_with("MM\0*"sv) || head.starts_with("II+\0"sv) ||
         head.starts_with("MM\0+"sv);
}

Document read_geotiff(Source& source) {
  const GdalRaster raster(source.path);
  return mesh_of_raster(raster.read(source.window), source);
}

}  // namespace temper::io
