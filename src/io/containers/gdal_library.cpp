#include "io/containers/gdal_library.hpp"

#include <array>
#include <optional>

#include "io/containers/foreign_library.hpp"
#include "io/text/failure.hpp"
#include "temper/io.hpp"

namespace temper::io {
namespace {

constexpr std::array kGdalFiles = {"libgdal.so.36", "libgdal.so.35", "libgdal.so.34", "libgdal.so.33",
                                   "libgdal.so.32", "libgdal.so.31", "libgdal.so.30", "libgdal.so.28",
                                   "libgdal.so",    "libgdal.dylib", "gdal.dll"};
constexpr std::array kGdalPackages = {"rasterio.libs",    "fiona.libs",    "pyogrio.libs",
                                      "rasterio/.dylibs", "fiona/.dylibs", "pyogrio/.dylibs"};
constexpr ForeignLibrary kGdal = {.variable = "TEMPER_GDAL",
                                  .files = kGdalFiles,
                                  .packages = kGdalPackages,
                                  .file_in_package = "gdal",
                                  .need = "GeoTIFF, shapefiles and GeoPackages need GDAL 3 or later",
                                  .install = "apt: libgdal32, conda: libgdal, pip: rasterio"};

std::optional<GdalLibrary> gdal_of(void* handle) {
  GdalLibrary library;
#define TEMPER_FIND(result, function, arguments) TEMPER_FIND_FUNCTION(function)
  TEMPER_GDAL_FUNCTIONS(TEMPER_FIND)
#undef TEMPER_FIND
  library.GDALAllRegister();
  return library;
}

const GdalLibrary* find_gdal() { return find_functions(kGdal, gdal_of); }

const GdalLibrary& library_for(const std::string& path) {
  if (const GdalLibrary* const library = find_gdal()) return *library;
  fail_without(kGdal, path);
}

void be_quiet(int /*kind*/, int /*number*/, const char* /*message*/) {}

}  // namespace

std::string gdal_version() {
  const GdalLibrary* const library = find_gdal();
  return library == nullptr ? std::string() : library->GDALVersionInfo("RELEASE_NAME");
}

GdalFile::GdalFile(const std::string& path, Kind kind) : path_(path), library_(library_for(path)) {
  library_.CPLPushErrorHandler(be_quiet);
  constexpr unsigned kVerboseError = 0x40;
  data_ = library_.GDALOpenEx(path.c_str(), static_cast<unsigned>(kind) | kVerboseError, nullptr, nullptr, nullptr);
  if (data_ == nullptr) refuse(kind == Kind::raster ? "is no raster that GDAL reads" : "is no map that GDAL reads");
}

GdalFile::~GdalFile() {
  if (data_ != nullptr) library_.GDALClose(data_);
  library_.CPLPopErrorHandler();
}

void GdalFile::refuse(std::string_view what) const {
  const std::string message = library_.CPLGetLastErrorMsg();
  if (data_ == nullptr) library_.CPLPopErrorHandler();  // a constructor that fails has no destructor
  fail(ErrorCode::syntax, path_, what, message.empty() ? "" : ": ", message);
}

}  // namespace temper::io
