// Reads HDF5. See hdf5_file.hpp.
#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "io/containers/foreign_library.hpp"
#include "io/containers/hdf5_file.hpp"
#include "io/text/failure.hpp"
#include "io/text/scanner.hpp"
#include "temper/io.hpp"

namespace temper::io {
namespace {

/// Names for HDF5 2.0, 1.14, 1.12 and 1.10. Debian's library has a name of its own, next to its libraries with MPI.
#ifdef __APPLE__
constexpr std::array kHdf5Files = {"libhdf5.320.dylib", "libhdf5.310.dylib", "libhdf5.200.dylib", "libhdf5.103.dylib",
                                   "libhdf5.dylib"};
#elif defined(_WIN32)
constexpr std::array kHdf5Files = {"hdf5.dll"};
#else
constexpr std::array kHdf5Files = {"libhdf5_serial.so.320", "libhdf5.so.320",        "libhdf5_serial.so.310",
                                   "libhdf5.so.310",        "libhdf5.so.200",        "libhdf5_serial.so.103",
                                   "libhdf5.so.103",        "libhdf5_serial.so.100", "libhdf5.so"};
#endif
constexpr std::array kHdf5Packages = {"h5py.libs",    "netcdf4.libs",    "netCDF4.libs",
                                      "h5py/.dylibs", "netCDF4/.dylibs", "h5py"};
constexpr ForeignLibrary kHdf5 = {.variable = "TEMPER_HDF5",
                                  .files = kHdf5Files,
                                  .packages = kHdf5Packages,
                                  .file_in_package = "hdf5",
                                  .need = "VTKHDF files need libhdf5 1.10 or later",
                                  .install = "apt: libhdf5-103-1, conda: hdf5, pip: h5py or netCDF4"};

/// All functions of the library, or nothing. A library before 1.10, whose numbers have 32 bits, gives nothing.
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

namespace {

// The library copies a file in memory by these functions; here every copy is the one image itself.
void* same_image(std::size_t /*size*/, H5FD_file_image_op_t /*what_for*/, void* bytes) { return bytes; }
void* no_copy(void* to, const void* /*from*/, std::size_t /*size*/, H5FD_file_image_op_t, void*) { return to; }
void* no_growth(void* /*bytes*/, std::size_t /*size*/, H5FD_file_image_op_t, void*) { return nullptr; }
herr_t keep_image(void* /*bytes*/, H5FD_file_image_op_t, void*) { return 0; }
void* same_bytes(void* bytes) { return bytes; }
herr_t keep_bytes(void* /*bytes*/) { return 0; }

herr_t refuse_other_file(const char*, const char*, const char*, const char*, unsigned*, hid_t, void*) { return -1; }

}  // namespace

hid_t hdf5_type(const Hdf5Library& library, Scalar scalar) {
  static constexpr hid_t Hdf5Library::*kNativeTypes[] = {
      // in the order of Scalar
      &Hdf5Library::H5T_NATIVE_DOUBLE_g, &Hdf5Library::H5T_NATIVE_FLOAT_g,  &Hdf5Library::H5T_NATIVE_INT64_g,
      &Hdf5Library::H5T_NATIVE_INT32_g,  &Hdf5Library::H5T_NATIVE_UINT8_g,  &Hdf5Library::H5T_NATIVE_INT8_g,
      &Hdf5Library::H5T_NATIVE_INT16_g,  &Hdf5Library::H5T_NATIVE_UINT16_g, &Hdf5Library::H5T_NATIVE_UINT32_g,
      &Hdf5Library::H5T_NATIVE_UINT64_g};
  return library.*kNativeTypes[static_cast<std::size_t>(scalar)];
}

Hdf5Reader::Hdf5Reader(Source& source)
    : path_(source.path),
      bytes_(source.bytes),
      allocation_(source.allocation),
      library_(hdf5_library(path_)),
      turn_(foreign_tables()),
      quiet_(library_) {
  links_ = {check(library_.H5Pcreate(library_.H5P_CLS_LINK_ACCESS_ID_g), "begin"), library_.H5Pclose};
  check(library_.H5Pset_elink_cb(links_, refuse_other_file, nullptr), "begin");
  const Hdf5Id access = {check(library_.H5Pcreate(library_.H5P_CLS_FILE_ACCESS_ID_g), "begin"), library_.H5Pclose};
  H5FD_file_image_callbacks_t callbacks = {same_image, no_copy,    no_growth,    keep_image,
                                           same_bytes, keep_bytes, bytes_.data()};
  constexpr std::size_t kIncrement = 1 << 16;  // of files that grow, which this one does not
  check(library_.H5Pset_fapl_core(access, kIncrement, false), "begin");
  check(library_.H5Pset_fclose_degree(access, H5F_CLOSE_STRONG), "begin");
  check(library_.H5Pset_file_image_callbacks(access, &callbacks), "begin");
  check(library_.H5Pset_file_image(access, bytes_.data(), bytes_.size()), "begin");
  // The library needs a name that no file on disk has.
  const std::string name = path_ + "/in memory";
  file_ = {check(library_.H5Fopen(name.c_str(), kHdf5ReadOnly, access), "read the file: it is cut off or damaged"),
           library_.H5Fclose};
}

hid_t Hdf5Reader::check(hid_t status, std::string_view doing) const {
  if (status < 0) fail(ErrorCode::syntax, path_, "HDF5 cannot ", doing);
  return status;
}

Hdf5Id Hdf5Reader::object(const Hdf5Id& in, const std::string& name) const {
  const std::string doing = text("look for ", in_quotes(name));
  if (check(library_.H5Lexists(in, name.c_str(), H5P_DEFAULT), doing) == 0) return {};
  const hid_t id = library_.H5Oopen(in, name.c_str(), links_);
  if (id < 0) fail(ErrorCode::syntax, path_, "HDF5 cannot open ", in_quotes(name), " in this file");
  return {id, library_.H5Oclose};
}

std::optional<Hdf5Id> Hdf5Reader::group(const Hdf5Id& in, const std::string& name) const {
  Hdf5Id found = object(in, name);
  if (found < 0 || library_.H5Iget_type(found) != H5I_GROUP) return std::nullopt;
  return found;
}

std::optional<Hdf5Dataset> Hdf5Reader::find(const Hdf5Id& in, const std::string& name) const {
  Hdf5Dataset result = {name, object(in, name), {}, {}};
  if (result.id < 0 || library_.H5Iget_type(result.id) != H5I_DATASET) return std::nullopt;
  expect_numbers_within(result);  // first: to learn its size libhdf5 may open others
  const std::string doing = text("look at the dataset ", in_quotes(name));
  result.sizes = sizes({check(library_.H5Dget_space(result.id), doing), library_.H5Sclose});
  result.scalar = scalar({check(library_.H5Dget_type(result.id), doing), library_.H5Tclose});
  return result;
}

Hdf5Dataset Hdf5Reader::dataset(const Hdf5Id& in, const std::string& name) const {
  if (auto found = find(in, name)) return std::move(*found);
  fail(ErrorCode::truncated, path_, "the dataset ", in_quotes(name), " is missing");
}

std::vector<std::string> Hdf5Reader::names(const Hdf5Id& in) const {
  H5G_info_t info = {};
  check(library_.H5Gget_info(in, &info), "list a group");
  const Hdf5Id properties = {check(library_.H5Gget_create_plist(in), "list a group"), library_.H5Pclose};
  unsigned order = 0;
  check(library_.H5Pget_link_creation_order(properties, &order), "list a group");
  const H5_index_t index = (order & H5P_CRT_ORDER_TRACKED) != 0 ? H5_INDEX_CRT_ORDER : H5_INDEX_NAME;
  std::vector<std::string> all;
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    const auto get = [&](char* name, std::size_t size) {
      const ssize_t n = library_.H5Lget_name_by_idx(in, ".", index, H5_ITER_INC, i, name, size, H5P_DEFAULT);
      return static_cast<std::size_t>(check(n, "list a group"));
    };
    std::string name(get(nullptr, 0), '\0');
    get(name.data(), name.size() + 1);
    all.push_back(std::move(name));
  }
  return all;
}

std::vector<std::size_t> Hdf5Reader::sizes(const Hdf5Id& space) const {
  const int n = library_.H5Sget_simple_extent_ndims(space);
  check(n, "look at a dataspace");
  std::vector<hsize_t> all(static_cast<std::size_t>(n));
  check(library_.H5Sget_simple_extent_dims(space, all.data(), nullptr), "look at a dataspace");
  return {all.begin(), all.end()};
}

std::optional<Scalar> Hdf5Reader::scalar(const Hdf5Id& type) const {
  const std::size_t size = library_.H5Tget_size(type);
  const H5T_class_t kind = library_.H5Tget_class(type);
  if (kind == H5T_FLOAT) {
    return size == sizeof(double)  ? std::optional(Scalar::f64)
           : size == sizeof(float) ? std::optional(Scalar::f32)
                                   : std::nullopt;
  }
  if (kind != H5T_INTEGER) return std::nullopt;
  const bool is_signed = library_.H5Tget_sign(type) == H5T_SGN_2;
  switch (size) {
    case 1:
      return is_signed ? Scalar::i8 : Scalar::u8;
    case 2:
      return is_signed ? Scalar::i16 : Scalar::u16;
    case 4:
      return is_signed ? Scalar::i32 : Scalar::u32;
    case 8:
      return is_signed ? Scalar::i64 : Scalar::u64;
    default:
      return std::nullopt;
  }
}

void Hdf5Reader::expect_numbers_within(const Hdf5Dataset& d) const {
  const Hdf5Id properties = {check(library_.H5Dget_create_plist(d.id), "look at a dataset"), library_.H5Pclose};
  if (library_.H5Pget_layout(properties) != H5D_VIRTUAL && library_.H5Pget_external_count(properties) == 0) return;
  fail(ErrorCode::unsupported, path_, "the numbers of the dataset ", in_quotes(d.name),
       " are in other files; temper reads one");
}

// Data may be larger than the file when they are compressed or left out, and several datasets may share bytes.
std::size_t Hdf5Reader::allowed_values(const Hdf5Dataset& d) const {
  if (!d.scalar) fail(ErrorCode::unsupported, path_, "the dataset ", in_quotes(d.name), " holds no numbers");
  if (std::find(d.sizes.begin(), d.sizes.end(), 0u) != d.sizes.end()) return 0;
  const std::string where = text(path_, ": the dataset ", in_quotes(d.name));
  std::uint64_t n = 1;
  for (const std::size_t size : d.sizes) {
    allocation_.check(n, size, where);
    n *= size;
  }
  allocation_.take(n, 1, where);
  return static_cast<std::size_t>(n);
}

Values Hdf5Reader::values(const Hdf5Dataset& d) const {
  const std::size_t n = allowed_values(d);
  return with_scalar(d.scalar.value(), [&](auto zero) -> Values {
    std::vector<decltype(zero)> result(n);
    if (n > 0) {
      check(library_.H5Dread(d.id, hdf5_type(library_, *d.scalar), H5S_ALL, H5S_ALL, H5P_DEFAULT, result.data()),
            text("read the dataset ", in_quotes(d.name)));
    }
    return result;
  });
}

template <class T>
std::vector<T> Hdf5Reader::values_as(const Hdf5Dataset& d, Scalar scalar) const {
  std::vector<T> result(allowed_values(d));
  if (!result.empty()) {
    check(library_.H5Dread(d.id, hdf5_type(library_, scalar), H5S_ALL, H5S_ALL, H5P_DEFAULT, result.data()),
          text("read the dataset ", in_quotes(d.name)));
  }
  return result;
}

std::vector<double> Hdf5Reader::reals(const Hdf5Dataset& d) const { return values_as<double>(d, Scalar::f64); }

void Hdf5Reader::expect_integers(const Hdf5Dataset& d) const {
  if (!d.scalar || *d.scalar <= Scalar::f32)
    fail(ErrorCode::syntax, path_, "the dataset ", in_quotes(d.name), " holds no integers");
}

// The library converts block by block, and replaces a number that does not fit by the nearest one.
std::vector<std::int32_t> Hdf5Reader::integers(const Hdf5Dataset& d) const {
  expect_integers(d);
  auto result = values_as<std::int32_t>(d, Scalar::i32);
  using Limits = std::numeric_limits<std::int32_t>;
  const bool fits = std::none_of(result.begin(), result.end(),
                                 [](std::int32_t i) { return i == Limits::min() || i == Limits::max(); });
  if (!fits) {
    fail(ErrorCode::index_out_of_range, path_, "the dataset ", in_quotes(d.name), " has a value beyond 32 bits");
  }
  return result;
}

std::vector<std::int64_t> Hdf5Reader::long_integers(const Hdf5Dataset& d) const {
  expect_integers(d);
  return values_as<std::int64_t>(d, Scalar::i64);
}

std::vector<std::int64_t> Hdf5Reader::integer_attribute(const Hdf5Id& of, const char* name) const {
  if (library_.H5Aexists(of, name) <= 0) return {};
  const std::string doing = text("read the attribute ", name);
  const Hdf5Id attribute = {check(library_.H5Aopen(of, name, H5P_DEFAULT), doing), library_.H5Aclose};
  const Hdf5Id type = {check(library_.H5Aget_type(attribute), doing), library_.H5Tclose};
  if (library_.H5Tget_class(type) != H5T_INTEGER) return {};
  const auto shape = sizes({check(library_.H5Aget_space(attribute), doing), library_.H5Sclose});
  constexpr std::size_t kMost = 16;
  if (shape.size() > 1 || (shape.size() == 1 && (shape[0] == 0 || shape[0] > kMost))) return {};
  std::vector<std::int64_t> result(shape.empty() ? 1 : shape[0]);
  check(library_.H5Aread(attribute, hdf5_type(library_, Scalar::i64), result.data()), doing);
  return result;
}

std::optional<std::string> Hdf5Reader::text_attribute(const Hdf5Id& of, const char* name) const {
  if (library_.H5Aexists(of, name) <= 0) return std::nullopt;
  const std::string doing = text("read the attribute ", name);
  const Hdf5Id attribute = {check(library_.H5Aopen(of, name, H5P_DEFAULT), doing), library_.H5Aclose};
  const Hdf5Id type = {check(library_.H5Aget_type(attribute), doing), library_.H5Tclose};
  const auto shape = sizes({check(library_.H5Aget_space(attribute), doing), library_.H5Sclose});
  const bool is_one = shape.empty() || (shape.size() == 1 && shape[0] == 1);
  if (library_.H5Tget_class(type) != H5T_STRING || !is_one) return std::nullopt;
  if (library_.H5Tis_variable_str(type) > 0) {
    char* value = nullptr;
    check(library_.H5Aread(attribute, type, static_cast<void*>(&value)), doing);
    std::string result = value == nullptr ? "" : value;
    library_.H5free_memory(value);
    return result;
  }
  const std::size_t n = library_.H5Tget_size(type);
  if (n > bytes_.size()) return std::nullopt;
  std::string result(n, '\0');
  check(library_.H5Aread(attribute, type, result.data()), doing);
  result.resize(std::min(result.find('\0'), result.size()));
  return result;
}

}  // namespace temper::io
