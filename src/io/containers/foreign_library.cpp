#include "io/containers/foreign_library.hpp"

#include <cstdlib>
#include <filesystem>

#include "io/text/failure.hpp"
#include "temper/detail/path.hpp"

namespace temper::io {
namespace {

bool load_foreign(const std::string& file, const std::function<bool(void*)>& take) {
  void* const handle = load_library(file);
  return handle != nullptr && take(handle);
}

/// Python packages bring libraries along, for example netcdf4.libs/libnetcdf-HASH.so.22 next to the packages, or
/// netCDF4/.dylibs/libnetcdf.22.dylib in them. If a package holds this code or the program, the libraries are two or
/// three folders above.
void find_in_python_packages(const ForeignLibrary& library, const std::function<bool(void*)>& take) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  fs::path folder = fs::canonical(path_of(file_of_this_code()), ignored).parent_path();
  for (int level = 0; level < 3 && folder.has_relative_path(); ++level, folder = folder.parent_path()) {
    for (const char* package : library.packages) {
      // Not range-for, whose ++ throws.
      for (fs::directory_iterator entry(folder / package, ignored), end; entry != end; entry.increment(ignored)) {
        const std::string file = utf8(entry->path().filename());
        const std::size_t n = library.file_in_package.size();
        if (!file.starts_with(library.file_in_package) || (file[n] != '-' && file[n] != '.')) continue;
        if (load_foreign(utf8(entry->path()), take)) return;
      }
    }
  }
}

/// The file that the variable names, or null.
const char* chosen_file(const ForeignLibrary& library) {
  const char* const chosen = std::getenv(library.variable);
  return chosen != nullptr && *chosen != '\0' ? chosen : nullptr;
}

}  // namespace

void find_library(const ForeignLibrary& library, const std::function<bool(void*)>& take) {
  if (const char* const chosen = chosen_file(library)) {
    load_foreign(chosen, take);
    return;
  }
  for (const char* file : library.files) {
    if (load_foreign(file, take)) return;
  }
  find_in_python_packages(library, take);
}

std::recursive_mutex& foreign_tables() {
  static std::recursive_mutex tables;
  return tables;
}

void fail_without(const ForeignLibrary& library, const std::string& path) {
  const char* const chosen = chosen_file(library);
  fail(ErrorCode::unsupported, path,
       chosen != nullptr
           ? text(library.need, "; ", library.variable, " names ", chosen, ", which cannot be loaded as this library")
           : text(library.need, ", which was not found. Next: install it (", library.install, "), or set its file in ",
                  library.variable));
}

}  // namespace temper::io
