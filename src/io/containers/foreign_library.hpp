// Libraries of others, loaded when the first file needs them. Without such files nobody has to install them, and no
// start of the program waits for them.
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/system/system.hpp"

namespace temper::io {

/// The places of a library.
struct ForeignLibrary {
  const char* variable;                   ///< of the environment: names the file, and no other is tried then
  std::span<const char* const> files;     ///< as the loader finds them, the newest first
  std::span<const char* const> packages;  ///< folders of the libraries of Python packages that bring it along
  std::string_view file_in_package;       ///< how its name begins there, behind "lib" and before - or .
  std::string_view need;                  ///< "VTKHDF files need libhdf5 1.10 or later"
  std::string_view install;               ///< "apt: libhdf5-103-1, conda: …": the packages that have it
};

/// Calls take with the handle of each file that can be loaded, until take accepts the library. A loaded
/// file stays loaded to the end of the process.
void find_library(const ForeignLibrary& library, const std::function<bool(void* handle)>& take);

/// Held while a file of libnetcdf or libhdf5 is open. Both keep tables for one thread at a time, and libnetcdf calls
/// libhdf5. It keeps temper's threads apart, but not other users of the library in this process (h5py). One thread may
/// have several files open.
[[nodiscard]] std::recursive_mutex& foreign_tables();

/// The functions of the library, which functions_of(handle) takes from it, or null. In a Python that runs for days a
/// missing library may be there at the next call. Takes foreign_tables().
template <class Functions>
const Functions* find_functions(const ForeignLibrary& library, std::optional<Functions> (*functions_of)(void* handle)) {
  static std::optional<Functions> found;
  const std::lock_guard turn(foreign_tables());
  if (!found) {
    find_library(library, [&](void* handle) {
      found = functions_of(handle);
      return found.has_value();
    });
  }
  return found ? &*found : nullptr;
}

/// Takes one of a list of functions into `library`, or returns nothing.
#define TEMPER_FIND_FUNCTION(function)                                                           \
  library.function = reinterpret_cast<decltype(library.function)>(symbol_of(handle, #function)); \
  if (library.function == nullptr) return std::nullopt;

/// A failure about the file `path`, for which there is no such library.
[[noreturn]] void fail_without(const ForeignLibrary& library, const std::string& path);

}  // namespace temper::io
