#include "io/containers/foreign_library.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>

#include "io/text/failure.hpp"

namespace temper::io {
namespace {

bool load_foreign(const char* file, const std::function<bool(void*)>& take) {
  void* const handle = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  return handle != nullptr && take(handle);
}

/// Python packages bring libraries along, for example netcdf4.libs/libnetcdf-HASH.so.22 next to the packages. If a
/// package holds this code or the program, the libraries are two or three folders above.
void find_in_python_packages(const ForeignLibrary& library, const std::function<bool(void*)>& take) {
  namespace fs = std::filesystem;
  static const char here = 0;
  Dl_info self = {};
  if (dladdr(&here, &self) == 0) return;
  std::error_code ignored;
  fs::path folder = fs::canonical(self.dli_fname, ignored).parent_path();
  for (int level = 0; level < 3 && folder.has_relative_path(); ++level, folder = folder.parent_path()) {
    for (const char* package : library.packages) {
      // Not range-for, whose ++ throws.
      for (fs::directory_iterator entry(folder / package, ignored), end; entry != end; entry.increment(ignored)) {
        const fs::path& file = entry->path();
        if (!file.filename().string().starts_with(library.file_in_package)) continue;
        if (load_foreign(file.c_str(), take)) return;
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

void* symbol_of(void* handle, const char* name) { return dlsym(handle, name); }

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
