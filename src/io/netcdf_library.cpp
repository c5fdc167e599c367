// See netcdf_library.hpp.
#include "io/netcdf_library.hpp"

#include <dlfcn.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <optional>

#include "io/format.hpp"
#include "temper/io.hpp"

namespace temper::io {

namespace {

/// Whoever has several, or one where the loader does not look, names it by this variable of the environment.
constexpr const char* kVariable = "TEMPER_NETCDF";

/// Since 4.6.2, the first that reads and writes files in memory, the newest first. All of them have the same interface.
#ifdef __APPLE__
constexpr std::array kNames = {"libnetcdf.22.dylib", "libnetcdf.19.dylib", "libnetcdf.dylib"};
#else
constexpr std::array kNames = {"libnetcdf.so.22", "libnetcdf.so.19", "libnetcdf.so.18", "libnetcdf.so.15",
                               "libnetcdf.so"};
#endif

const char* chosen_library() {
  const char* const chosen = std::getenv(kVariable);
  return chosen != nullptr && *chosen != '\0' ? chosen : nullptr;
}

/// All functions of the library of that name, or nothing. What is loaded stays to the end of the process.
std::optional<NetcdfLibrary> load(const char* name) {
  void* const handle = dlopen(name, RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) return std::nullopt;
  NetcdfLibrary library;
#define TEMPER_FIND(function)                                                                \
  library.function = reinterpret_cast<decltype(library.function)>(dlsym(handle, #function)); \
  if (library.function == nullptr) return std::nullopt;
  TEMPER_NETCDF_FUNCTIONS(TEMPER_FIND)
#undef TEMPER_FIND
  return library;
}

/// Python's package netCDF4 brings the library along, as netcdf4.libs/libnetcdf-HASH.so.22 among all packages. Where
/// this code is one of them, or the program in one, that is found: two or three folders above.
std::optional<NetcdfLibrary> load_from_python_package() {
  namespace fs = std::filesystem;
  Dl_info self = {};
  if (dladdr(&kNames, &self) == 0) return std::nullopt;
  std::error_code ignored;
  fs::path folder = fs::canonical(self.dli_fname, ignored).parent_path();
  for (int level = 0; level < 3 && folder.has_relative_path(); ++level, folder = folder.parent_path()) {
    for (const char* libraries : {"netcdf4.libs", "netCDF4.libs"}) {
      for (const fs::directory_entry& entry : fs::directory_iterator(folder / libraries, ignored)) {
        if (!entry.path().filename().string().starts_with("libnetcdf-")) continue;
        if (auto library = load(entry.path().c_str())) return library;
      }
    }
  }
  return std::nullopt;
}

/// A library that was not there may be there at the next call: a Python that runs for days.
const NetcdfLibrary* find_library() {
  static std::mutex turn;
  static std::optional<NetcdfLibrary> found;
  const std::lock_guard lock(turn);
  if (found) return &*found;
  if (const char* const chosen = chosen_library()) {
    found = load(chosen);
  } else {
    for (std::size_t i = 0; i < kNames.size() && !found; ++i) found = load(kNames[i]);
    if (!found) found = load_from_python_package();
  }
  return found ? &*found : nullptr;
}

}  // namespace

const NetcdfLibrary& netcdf_library(const std::string& path) {
  if (const NetcdfLibrary* const library = find_library()) return *library;
  const char* const chosen = chosen_library();
  fail(ErrorCode::unsupported, path,
       chosen != nullptr
           ? text("NetCDF files need libnetcdf 4.6.2 or later; ", kVariable, " names ", chosen,
                  ", which cannot be loaded as that")
           : text("NetCDF files need libnetcdf 4.6.2 or later, and there is none: install it (apt: libnetcdf19; "
                  "conda: libnetcdf; pip: netCDF4), or name its file in ",
                  kVariable));
}

std::vector<std::string> netcdf_files(const std::string& path) {
  static_cast<void>(netcdf_library(path));
  return {path};
}

std::string netcdf_version() {
  const NetcdfLibrary* const library = find_library();
  if (library == nullptr) return {};
  const std::string version = library->nc_inq_libvers();  // "4.9.0 of Aug  3 2022 01:14:42 $"
  return version.substr(0, version.find(' '));
}

}  // namespace temper::io
