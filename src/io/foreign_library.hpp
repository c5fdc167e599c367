// Libraries of others that are loaded when the first file needs them: whoever has no such files need neither install
// them nor wait for them each time that the program starts.
#pragma once

#include <functional>
#include <mutex>
#include <span>
#include <string>

namespace temper::io {

/// Where a library may be.
struct ForeignLibrary {
  const char* variable;                   ///< of the environment: names the file, and no other is tried then
  std::span<const char* const> files;     ///< as the loader knows them, the newest first
  std::span<const char* const> packages;  ///< folders of the libraries of Python packages that bring it along
  std::string_view file_in_package;       ///< how its name begins there
};

/// What the variable names, or null.
[[nodiscard]] const char* chosen_file(const ForeignLibrary& library);

/// Calls take with the handle (of dlopen) of each file that can be loaded, until it says that it is the library. What
/// is loaded stays to the end of the process.
void find_library(const ForeignLibrary& library, const std::function<bool(void* handle)>& take);

/// Held while a file of libnetcdf or libhdf5 is open: both keep tables that only one thread may touch at a time, and
/// the one calls the other. It keeps temper's threads apart; who else calls the same library in this process (h5py)
/// does not know of it.
[[nodiscard]] std::mutex& foreign_tables();

}  // namespace temper::io
