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

/// Says whether a file such as libnetcdf-HASH.so.22, libnetcdf.22.dylib or netcdf-HASH.dll is a library with this name.
bool has_name(std::string_view file, std::string_view name) {
  if (file.starts_with("lib")) file.remove_prefix(3);
  return file.starts_with(name) &&
         (file.substr(name.size()).starts_with('-') || file.substr(name.size()).starts_with('.'));
}

/// Python packages bring libraries along, for example netcdf4.libs/libnetcdf-HASH.so.22 next to the packages, or
/// netCDF4/.dylibs/libnetcdf.22.dylib in them. If a package holds this code or the program, the packages are one to
/// three folders above. On Windows the program is in Scripts, next to Lib.
void find_in_python_packages(const ForeignLibrary& library, const std::function<bool(void*)>& take) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  fs::path folder = fs::canonical(path_of(file_of_this_code()), ignored).parent_path();
  for (int level = 0; level < 3 && folder.has_relative_path(); ++level, folder = folder.parent_path()) {
    for (const fs::path& packages : {folder, folder / "Lib" / "site-packages"}) {
      for (const char* package : library.packages) {
        // Not range-for, whose ++ throws.
        for (fs::directory_iterator entry(packages / package, ignored), end; entry != end; entry.increment(ignored)) {
          if (!has_name(utf8(entry->path().filename()), library.file_in_package)) continue;
          if (load_foreign(utf8(entry->path()), take)) return;
        }
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
