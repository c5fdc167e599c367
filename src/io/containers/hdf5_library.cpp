// See hdf5_library.hpp.
#include "io/containers/hdf5_library.hpp"

#include <array>
#include <optional>

#include "io/containers/foreign_library.hpp"
#include "io/text/failure.hpp"
#include "temper/io.hpp"

namespace temper::io {

namespace {

/// Of 2.0, 1.14, 1.12 and 1.10. Debian's have a name of their own, beside those of libraries with MPI.
#ifdef __APPLE__
constexpr std::array kHdf5Files = {"libhdf5.320.dylib", "libhdf5.310.dylib", "libhdf5.200.dylib", "libhdf5.103.dylib",
                                   "libhdf5.dylib"};
#else
constexpr std::array kHdf5Files = {"libhdf5_serial.so.320", "libhdf5.so.320",        "libhdf5_serial.so.310",
                                   "libhdf5.so.310",        "libhdf5.so.200",        "libhdf5_serial.so.103",
                                   "libhdf5.so.103",        "libhdf5_serial.so.100", "libhdf5.so"};
#endif
constexpr std::array kHdf5Packages = {"h5py.libs", "netcdf4.libs", "netCDF4.libs"};
constexpr ForeignLibrary kHdf5 = {.variable = "TEMPER_HDF5",
                                  .files = kHdf5Files,
                                  .packages = kHdf5Packages,
                                  .file_in_package = "libhdf5-",
                                  .need = "VTKHDF files need libhdf5 1.10 or later",
                                  .install = "apt: libhdf5-103-1; conda: hdf5; pip: h5py or netCDF4"};

/// All functions of the library, or nothing: also of one before 1.10, whose numbers have 32 bits.
std::optional<Hdf5Library> hdf5_of(void* handle) {
  Hdf5Library library;
  TEMPER_HDF5_FUNCTIONS(TEMPER_FIND_FUNCTION)
  unsigned major = 0, minor = 0, patch = 0;
  if (library.H5get_libversion(&major, &minor, &patch) < 0 || (major == 1 && minor < 10)) return std::nullopt;
  if (library.H5open() < 0) return std::nullopt;
#define TEMPER_FIND_NUMBER(number)                                             \
  {                                                                            \
    const auto* value = static_cast<const hid_t*>(symbol_of(handle, #number)); \
    if (value == nullptr) return std::nullopt;                                 \
    library.number = *value;                                                   \
  }
  TEMPER_HDF5_NUMBERS(TEMPER_FIND_NUMBER)
#undef TEMPER_FIND_NUMBER
  return library;
}

const Hdf5Library* find_hdf5() { return find_functions(kHdf5, hdf5_of); }

}  // namespace

const Hdf5Library& hdf5_library(const std::string& path) {
  if (const Hdf5Library* const library = find_hdf5()) return *library;
  fail_without(kHdf5, path);
}

std::string hdf5_version() {
  const Hdf5Library* const library = find_hdf5();
  unsigned major = 0, minor = 0, patch = 0;
  if (library == nullptr || library->H5get_libversion(&major, &minor, &patch) < 0) return {};
  return text(major, ".", minor, ".", patch);
}

}  // namespace temper::io
