// Libraries of others that are loaded when the first file needs them: whoever has no such files need neither install
// them nor wait for them each time that the program starts.
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace temper::io {

/// Where a library may be.
struct ForeignLibrary {
  const char* variable;                   ///< of the environment: names the file, and no other is tried then
  std::span<const char* const> files;     ///< as the loader knows them, the newest first
  std::span<const char* const> packages;  ///< folders of the libraries of Python packages that bring it along
  std::string_view file_in_package;       ///< how its name begins there
  std::string_view need;                  ///< "VTKHDF files need libhdf5 1.10 or later"
  std::string_view install;               ///< "apt: libhdf5-103-1; conda: …": the packages that have it
};

/// Calls take with the handle (of dlopen) of each file that can be loaded, until it says that it is the library. What
/// is loaded stays to the end of the process.
void find_library(const ForeignLibrary& library, const std::function<bool(void* handle)>& take);

/// Held while a file of libnetcdf or libhdf5 is open: both keep tables that only one thread may touch at a time, and
/// the one calls the other. It keeps temper's threads apart; who else calls the same library in this process (h5py)
/// does not know of it.
[[nodiscard]] std::mutex& foreign_tables();

/// The functions of the library, which functions_of(handle) takes from it, or null. One that was not there may be there
/// at the next call: a Python that runs for days. Takes foreign_tables().
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

/// What the library has under that name, or null.
[[nodiscard]] void* symbol_of(void* handle, const char* name);
/// Of a list of functions: takes that one into `library`, or returns nothing.
#define TEMPER_FIND_FUNCTION(function)                                                           \
  library.function = reinterpret_cast<decltype(library.function)>(symbol_of(handle, #function)); \
  if (library.function == nullptr) return std::nullopt;

/// A failure about the file `path`, for which there is no such library.
[[noreturn]] void fail_without(const ForeignLibrary& library, const std::string& path);

}  // namespace temper::io
