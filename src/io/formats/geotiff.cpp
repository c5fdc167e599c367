// GeoTIFF through GDAL, which is loaded if a file needs it. Its C interface is stable, and declared here: temper is
// built without GDAL. Values are at centers of cells.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/containers/foreign_library.hpp"
#include "io/formats/raster.hpp"

namespace temper::io {
namespace {

constexpr std::array kGdalFiles = {"libgdal.so.36", "libgdal.so.35", "libgdal.so.34", "libgdal.so.33", "libgdal.so.32",
                                   "libgdal.so.31", "libgdal.so.30", "libgdal.so.28", "libgdal.so",    "libgdal.dylib"};
constexpr std::array kGdalPackages = {"rasterio.libs", "fiona.libs"};
constexpr ForeignLibrary kGdal = {.variable = "TEMPER_GDAL",
                                  .files = kGdalFiles,
                                  .packages = kGdalPackages,
                                  .file_in_package = "libgdal-",
                                  .need = "GeoTIFF files need GDAL 3 or later",
                                  .install = "apt: libgdal32, conda: libgdal, pip: rasterio"};

/// Functions of gdal.h and cpl_error.h, by their own names.
struct GdalLibrary {
  void (*GDALAllRegister)() = nullptr;
  void* (*GDALOpenEx)(const char*, unsigned, const char* const*, const char* const*, const char* const*) = nullptr;
  void (*GDALClose)(void*) = nullptr;
  int (*GDALGetRasterXSize)(void*) = nullptr;
  int (*GDALGetRasterYSize)(void*) = nullptr;
  int (*GDALGetRasterCount)(void*) = nullptr;
  int (*GDALGetGeoTransform)(void*, double*) = nullptr;
  const char* (*GDALGetProjectionRef)(void*) = nullptr;
  void* (*GDALGetRasterBand)(void*, int) = nullptr;
  double (*GDALGetRasterNoDataValue)(void*, int*) = nullptr;
  double (*GDALGetRasterScale)(void*, int*) = nullptr;
  double (*GDALGetRasterOffset)(void*, int*) = nullptr;
  int (*GDALRasterIO)(void*, int, int, int, int, int, void*, int, int, int, int, int) = nullptr;
  void (*CPLPushErrorHandler)(void (*)(int, int, const char*)) = nullptr;
  void (*CPLPopErrorHandler)() = nullptr;
  const char* (*CPLGetLastErrorMsg)() = nullptr;
};

std::optional<GdalLibrary> gdal_of(void* handle) {
  GdalLibrary library;
  TEMPER_FIND_FUNCTION(GDALAllRegister)
  TEMPER_FIND_FUNCTION(GDALOpenEx)
  TEMPER_FIND_FUNCTION(GDALClose)
  TEMPER_FIND_FUNCTION(GDALGetRasterXSize)
  TEMPER_FIND_FUNCTION(GDALGetRasterYSize)
  TEMPER_FIND_FUNCTION(GDALGetRasterCount)
  TEMPER_FIND_FUNCTION(GDALGetGeoTransform)
  TEMPER_FIND_FUNCTION(GDALGetProjectionRef)
  TEMPER_FIND_FUNCTION(GDALGetRasterBand)
  TEMPER_FIND_FUNCTION(GDALGetRasterNoDataValue)
  TEMPER_FIND_FUNCTION(GDALGetRasterScale)
  TEMPER_FIND_FUNCTION(GDALGetRasterOffset)
  TEMPER_FIND_FUNCTION(GDALRasterIO)
  TEMPER_FIND_FUNCTION(CPLPushErrorHandler)
  TEMPER_FIND_FUNCTION(CPLPopErrorHandler)
  TEMPER_FIND_FUNCTION(CPLGetLastErrorMsg)
  library.GDALAllRegister();
  return library;
}

void be_quiet(int /*kind*/, int /*number*/, const char* /*message*/) {}

/// An open raster; messages of GDAL go into failures.
class GdalRaster {
 public:
  explicit GdalRaster(const std::string& path) : path_(path), library_(library_for(path)) {
    library_.CPLPushErrorHandler(be_quiet);
    constexpr unsigned kRaster = 2, kVerboseError = 0x40;
    data_ = library_.GDALOpenEx(path.c_str(), kRaster | kVerboseError, nullptr, nullptr, nullptr);
    if (data_ == nullptr) refuse("is no raster that GDAL reads");
  }
  ~GdalRaster() {
    if (data_ != nullptr) library_.GDALClose(data_);
    library_.CPLPopErrorHandler();
  }
  GdalRaster(const GdalRaster&) = delete;
  GdalRaster& operator=(const GdalRaster&) = delete;

  Raster read(const std::optional<std::array<Vec2, 2>>& window) const {
    std::array<double, 6> place = {};
    if (library_.GDALGetGeoTransform(data_, place.data()) != 0)
      fail(ErrorCode::unsupported, path_,
           "the raster has no place. Next: give it one, for example by gdal_translate -a_ullr");
    if (place[2] != 0 || place[4] != 0)
      fail(ErrorCode::unsupported, path_, "the raster is turned. Next: gdalwarp makes columns and rows follow x and y");
    Raster raster;
    raster.degrees = std::string_view(library_.GDALGetProjectionRef(data_)).starts_with("GEOG");
    Part x = {0, library_.GDALGetRasterXSize(data_)}, y = {0, library_.GDALGetRasterYSize(data_)};
    if (window) {
      x = part(x, place[0], place[1], (*window)[0].x, (*window)[1].x, raster.degrees);
      y = part(y, place[3], place[5], (*window)[0].y, (*window)[1].y, false);
    }
    for (int i = 0; i < x.size; ++i) raster.x.push_back(place[0] + (x.first + i + 0.5) * place[1]);
    for (int j = 0; j < y.size; ++j) raster.y.push_back(place[3] + (y.first + j + 0.5) * place[5]);
    for (int band = 1; band <= library_.GDALGetRasterCount(data_); ++band)
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

  static const GdalLibrary& library_for(const std::string& path) {
    if (const GdalLibrary* const library = find_functions(kGdal, gdal_of)) return *library;
    fail_without(kGdal, path);
  }
  [[noreturn]] void refuse(std::string_view what) const {
    const std::string message = library_.CPLGetLastErrorMsg();
    if (data_ == nullptr) library_.CPLPopErrorHandler();  // a constructor that fails has no destructor
    fail(ErrorCode::syntax, path_, what, message.empty() ? "" : ": ", message);
  }

  [[nodiscard]] std::vector<double> values(int number, Part x, Part y) const {
    constexpr int kRead = 0, kDoubles = 7;
    void* const band = library_.GDALGetRasterBand(data_, number);
    std::vector<double> all(static_cast<std::size_t>(x.size) * static_cast<std::size_t>(y.size));
    if (library_.GDALRasterIO(band, kRead, x.first, y.first, x.size, y.size, all.data(), x.size, y.size, kDoubles, 0,
                              0) != 0)
      refuse("cannot be read by GDAL");
    int has_missing = 0, has_scale = 0, has_offset = 0;
    const double missing = library_.GDALGetRasterNoDataValue(band, &has_missing);
    const double scale = library_.GDALGetRasterScale(band, &has_scale);
    const double offset = library_.GDALGetRasterOffset(band, &has_offset);
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
  const GdalLibrary& library_;
  void* data_ = nullptr;
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
