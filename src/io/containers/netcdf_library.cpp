// See netcdf_library.hpp.
#include "io/containers/netcdf_library.hpp"

#include <array>
#include <optional>

#include "io/containers/foreign_library.hpp"
#include "temper/io.hpp"

namespace temper::io {

namespace {

/// Since 4.6.2, the first that reads and writes files in memory. All of them have the same interface.
#ifdef __APPLE__
constexpr std::array kNetcdfFiles = {"libnetcdf.22.dylib", "libnetcdf.19.dylib", "libnetcdf.dylib"};
#else
constexpr std::array kNetcdfFiles = {"libnetcdf.so.22", "libnetcdf.so.19", "libnetcdf.so.18", "libnetcdf.so.15",
                                     "libnetcdf.so"};
#endif
constexpr std::array kNetcdfPackages = {"netcdf4.libs", "netCDF4.libs"};
constexpr ForeignLibrary kNetcdf = {.variable = "TEMPER_NETCDF",
                                    .files = kNetcdfFiles,
                                    .packages = kNetcdfPackages,
                                    .file_in_package = "libnetcdf-",
                                    .need = "NetCDF files need libnetcdf 4.6.2 or later",
                                    .install = "apt: libnetcdf19; conda: libnetcdf; pip: netCDF4"};

/// All functions of the library, or nothing.
std::optional<NetcdfLibrary> netcdf_of(void* handle) {
  NetcdfLibrary library;
  TEMPER_NETCDF_FUNCTIONS(TEMPER_FIND_FUNCTION)
  return library;
}

const NetcdfLibrary* find_netcdf() { return find_functions(kNetcdf, netcdf_of); }

}  // namespace

const NetcdfLibrary& netcdf_library(const std::string& path) {
  if (const NetcdfLibrary* const library = find_netcdf()) return *library;
  fail_without(kNetcdf, path);
}

std::vector<std::string> netcdf_files(const std::string& path) {
  static_cast<void>(netcdf_library(path));
  return {path};
}

std::string netcdf_version() {
  const NetcdfLibrary* const library = find_netcdf();
  if (library == nullptr) return {};
  const std::string version = library->nc_inq_libvers();  // "4.9.0 of Aug  3 2022 01:14:42 $"
  return version.substr(0, version.find(' '));
}

}  // namespace temper::io
