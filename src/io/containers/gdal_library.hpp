// GDAL, which is loaded if a file needs it. Its C interface is stable, and declared here: temper is built without GDAL.
#pragma once

#include <string>
#include <string_view>

#include "io/disk/files.hpp"

namespace temper::io {

/// Every function that is called here: its result, its name and its arguments (gdal.h, ogr_api.h, ogr_srs_api.h,
/// cpl_error.h).
#define TEMPER_GDAL_FUNCTIONS(use)                                                                                     \
  use(const char*, GDALVersionInfo, (const char*)) use(void, GDALAllRegister, ()) use(                                 \
      void*, GDALOpenEx, (const char*, unsigned, const char* const*, const char* const*, const char* const*))          \
      use(void, GDALClose, (void*)) use(int, GDALGetRasterXSize, (void*)) use(int, GDALGetRasterYSize, (void*)) use(   \
          int, GDALGetRasterCount, (void*)) use(int, GDALGetGeoTransform,                                              \
                                                (void*, double*)) use(const char*, GDALGetProjectionRef, (void*))      \
          use(void*, GDALGetRasterBand, (void*, int)) use(double, GDALGetRasterNoDataValue, (void*, int*)) use(        \
              double, GDALGetRasterScale, (void*, int*)) use(double, GDALGetRasterOffset, (void*, int*))               \
              use(int, GDALRasterIO, (void*, int, int, int, int, int, void*, int, int, int, int, int)) use(            \
                  int, GDALDatasetGetLayerCount, (void*)) use(void*, GDALDatasetGetLayer, (void*, int))                \
                  use(const char*, OGR_L_GetName, (void*)) use(void*, OGR_L_GetSpatialRef, (void*))                    \
                      use(void, OGR_L_ResetReading, (void*)) use(void*, OGR_L_GetNextFeature, (void*)) use(            \
                          long long, OGR_F_GetFID, (void*)) use(void*, OGR_F_GetGeometryRef, (void*))                  \
                          use(int, OGR_F_GetFieldCount, (void*)) use(void*, OGR_F_GetFieldDefnRef, (void*, int)) use(  \
                              int, OGR_F_IsFieldSetAndNotNull, (void*, int))                                           \
                              use(double, OGR_F_GetFieldAsDouble, (void*, int)) use(                                   \
                                  const char*, OGR_F_GetFieldAsString, (void*, int)) use(void, OGR_F_Destroy, (void*)) \
                                  use(const char*, OGR_Fld_GetNameRef, (void*)) use(int, OGR_Fld_GetType, (void*))     \
                                      use(void*, OGR_G_GetLinearGeometry, (void*, double, char**))                     \
                                          use(void, OGR_G_DestroyGeometry, (void*))                                    \
                                              use(int, OGR_G_GetGeometryType, (void*))                                 \
                                                  use(const char*, OGR_G_GetGeometryName, (void*))                     \
                                                      use(int, OGR_G_GetGeometryCount, (void*))                        \
                                                          use(void*, OGR_G_GetGeometryRef, (void*, int))               \
                                                              use(int, OGR_G_GetPointCount, (void*))                   \
                                                                  use(double, OGR_G_GetX, (void*, int))                \
                                                                      use(double, OGR_G_GetY, (void*, int))            \
                                                                          use(int, OSRIsGeographic, (void*))           \
                                                                              use(void, CPLPushErrorHandler,           \
                                                                                  (void (*)(int, int, const char*)))   \
                                                                                  use(void, CPLPopErrorHandler, ())    \
                                                                                      use(const char*,                 \
                                                                                          CPLGetLastErrorMsg, ())

/// Its functions by their own names, as members.
struct GdalLibrary {
// NOLINTNEXTLINE(bugprone-macro-parentheses): types and lists of arguments have none
#define TEMPER_MEMBER(result, function, arguments) result(*function) arguments = nullptr;
  TEMPER_GDAL_FUNCTIONS(TEMPER_MEMBER)
#undef TEMPER_MEMBER
};

/// An open file of GDAL. Its messages go into failures.
class GdalFile {
 public:
  enum class Kind : unsigned { raster = 2, vector = 4 };
  /// A failure if there is no GDAL, or it does not read the file.
  GdalFile(const std::string& path, Kind kind);
  ~GdalFile();
  GdalFile(const GdalFile&) = delete;
  GdalFile& operator=(const GdalFile&) = delete;

  [[nodiscard]] const GdalLibrary* operator->() const { return &library_; }
  [[nodiscard]] void* data() const { return data_; }
  [[noreturn]] void refuse(std::string_view what) const;

 private:
  const std::string& path_;
  const GdalLibrary& library_;
  void* data_ = nullptr;
};

}  // namespace temper::io
