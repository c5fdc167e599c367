// HDF5 files in memory, by the C library: failures are exceptions, and nothing is opened by name.
//
// The library lays a file out without the numbers, so that it holds some kilobytes however large the mesh is. The mesh
// gives the numbers, block by block, for the room that the library has left.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/containers/vtk_array.hpp"
#include "io/disk/files.hpp"
#include "io/text/values.hpp"

namespace temper::io {

// libhdf5, 1.10 or later, loaded when the first file needs it.
//
// Only functions that are unchanged in all versions since are called: none of those that the headers choose by macro.

static_assert(sizeof(hid_t) == 8, "the headers of HDF5 are those of 1.10 or later");

/// Every function of it that is called here.
#define TEMPER_HDF5_FUNCTIONS(use)                                                                                    \
  use(H5Aclose) use(H5Acreate2) use(H5Aexists) use(H5Aget_space) use(H5Aget_type) use(H5Aopen) use(H5Aread)           \
      use(H5Awrite) use(H5Dclose) use(H5Dcreate2) use(H5Dget_create_plist) use(H5Dget_offset) use(H5Dget_space)       \
          use(H5Dget_type) use(H5Dread) use(H5Eget_auto2) use(H5Eset_auto2) use(H5Fclose) use(H5Fcreate)              \
              use(H5Fget_filesize) use(H5Fopen) use(H5Gclose) use(H5Gcreate2) use(H5Gget_create_plist)                \
                  use(H5Gget_info) use(H5Iget_type) use(H5Lexists) use(H5Lget_name_by_idx) use(H5Oclose) use(H5Oopen) \
                      use(H5Pclose) use(H5Pcreate) use(H5Pget_external_count) use(H5Pget_layout)                      \
                          use(H5Pget_link_creation_order) use(H5Pset_alloc_time) use(H5Pset_char_encoding)            \
                              use(H5Pset_elink_cb) use(H5Pset_fclose_degree) use(H5Pset_fapl_core)                    \
                                  use(H5Pset_file_image) use(H5Pset_file_image_callbacks) use(H5Pset_fill_time)       \
                                      use(H5Pset_link_creation_order) use(H5Pset_meta_block_size)                     \
                                          use(H5Pset_obj_track_times) use(H5Pset_small_data_block_size) use(H5Sclose) \
                                              use(H5Screate) use(H5Screate_simple) use(H5Sget_simple_extent_dims)     \
                                                  use(H5Sget_simple_extent_ndims) use(H5Tclose) use(H5Tcopy)          \
                                                      use(H5Tget_class) use(H5Tget_sign) use(H5Tget_size)             \
                                                          use(H5Tis_variable_str) use(H5Tset_size) use(H5free_memory) \
                                                              use(H5get_libversion) use(H5open)

/// Classes of properties and types, which the library numbers when it is opened.
#define TEMPER_HDF5_NUMBERS(use)                                                                               \
  use(H5P_CLS_DATASET_CREATE_ID_g) use(H5P_CLS_FILE_ACCESS_ID_g) use(H5P_CLS_GROUP_CREATE_ID_g)                \
      use(H5P_CLS_LINK_ACCESS_ID_g) use(H5P_CLS_LINK_CREATE_ID_g) use(H5T_C_S1_g) use(H5T_NATIVE_DOUBLE_g)     \
          use(H5T_NATIVE_FLOAT_g) use(H5T_NATIVE_INT64_g) use(H5T_NATIVE_INT32_g) use(H5T_NATIVE_UINT8_g)      \
              use(H5T_NATIVE_INT8_g) use(H5T_NATIVE_INT16_g) use(H5T_NATIVE_UINT16_g) use(H5T_NATIVE_UINT32_g) \
                  use(H5T_NATIVE_UINT64_g)

/// H5F_ACC_RDONLY and H5F_ACC_TRUNC, whose macros call functions.
inline constexpr unsigned kHdf5ReadOnly = 0, kHdf5Truncate = 2;

/// Its functions and numbers by their own names, as members. Null as long as it is not loaded.
struct Hdf5Library {
// NOLINTBEGIN(bugprone-macro-parentheses): the name of a member has none
#define TEMPER_MEMBER(function) decltype(&::function) function = nullptr;
  TEMPER_HDF5_FUNCTIONS(TEMPER_MEMBER)
#undef TEMPER_MEMBER
#define TEMPER_MEMBER(number) hid_t number = -1;
  TEMPER_HDF5_NUMBERS(TEMPER_MEMBER)
#undef TEMPER_MEMBER
  // NOLINTEND(bugprone-macro-parentheses)
};

/// The library; a failure about the file `path` when there is none. From several threads at once, too.
const Hdf5Library& hdf5_library(const std::string& path);

/// An object of the library, which is closed at the end.
class Hdf5Id {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5Id() = default;
  Hdf5Id(hid_t id, Close how) : id_(id), close_(how) {}
  ~Hdf5Id() { close(); }
  Hdf5Id(Hdf5Id&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Id& operator=(Hdf5Id&& other) noexcept {
    close();
    id_ = std::exchange(other.id_, -1);
    close_ = other.close_;
    return *this;
  }
  Hdf5Id(const Hdf5Id&) = delete;
  Hdf5Id& operator=(const Hdf5Id&) = delete;

  operator hid_t() const { return id_; }
  /// Closes it, and returns the answer of the library; negative is a failure.
  herr_t close() { return id_ < 0 ? 0 : close_(std::exchange(id_, -1)); }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// While it lives the library prints no errors. Afterwards the library handles them as before, perhaps by a function
/// that another user has set. Precondition: the caller holds foreign_tables().
class QuietHdf5 {
 public:
  explicit QuietHdf5(const Hdf5Library& library) : library_(library) {
    library_.H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    library_.H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~QuietHdf5() { library_.H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  QuietHdf5(const QuietHdf5&) = delete;
  QuietHdf5& operator=(const QuietHdf5&) = delete;

 private:
  const Hdf5Library& library_;
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

struct Hdf5Dataset {
  std::string name;
  Hdf5Id id;
  std::vector<std::size_t> sizes;
  std::optional<Scalar> scalar;  ///< none: text and types of the user
};

class Hdf5Reader {
 public:
  /// The bytes must outlive the reader.
  explicit Hdf5Reader(Source& source);
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;
  ~Hdf5Reader() = default;

  [[nodiscard]] const Hdf5Id& root() const { return file_; }
  /// The group of that name; nothing when nothing has that name, or something else has it.
  [[nodiscard]] std::optional<Hdf5Id> group(const Hdf5Id& in, const std::string& name) const;
  [[nodiscard]] std::optional<Hdf5Dataset> find(const Hdf5Id& in, const std::string& name) const;
  /// Fails when there is none.
  [[nodiscard]] Hdf5Dataset dataset(const Hdf5Id& in, const std::string& name) const;
  /// In the order of creation if the file has kept it.
  [[nodiscard]] std::vector<std::string> names(const Hdf5Id& in) const;

  /// All its numbers, row by row. Failure, when it has none.
  [[nodiscard]] Values values(const Hdf5Dataset& dataset) const;
  /// The numbers of any floating point type.
  [[nodiscard]] std::vector<double> reals(const Hdf5Dataset& dataset) const;
  /// The numbers of any type of integers. Fails when one is beyond 32 bits, judged by the least and the greatest
  /// number.
  [[nodiscard]] std::vector<std::int32_t> integers(const Hdf5Dataset& dataset) const;
  [[nodiscard]] std::vector<std::int64_t> long_integers(const Hdf5Dataset& dataset) const;

  /// The value of an attribute; empty when none has that name and kind.
  [[nodiscard]] std::vector<std::int64_t> integer_attribute(const Hdf5Id& of, const char* name) const;
  [[nodiscard]] std::optional<std::string> text_attribute(const Hdf5Id& of, const char* name) const;

 private:
  hid_t check(hid_t status, std::string_view doing) const;
  [[nodiscard]] Hdf5Id object(const Hdf5Id& in, const std::string& name) const;
  [[nodiscard]] std::vector<std::size_t> sizes(const Hdf5Id& space) const;
  [[nodiscard]] std::optional<Scalar> scalar(const Hdf5Id& type) const;
  void expect_numbers_within(const Hdf5Dataset& dataset) const;
  [[nodiscard]] std::size_t allowed_values(const Hdf5Dataset& dataset) const;
  void expect_integers(const Hdf5Dataset& dataset) const;
  template <class T>
  [[nodiscard]] std::vector<T> values_as(const Hdf5Dataset& dataset, Scalar scalar) const;

  const std::string& path_;
  std::string& bytes_;
  AllocationLimits& allocation_;
  const Hdf5Library& library_;
  std::unique_lock<std::recursive_mutex> turn_;
  QuietHdf5 quiet_;  // outlives what is open
  Hdf5Id links_;     // properties of access: links do not lead to other files
  Hdf5Id file_;
};

class Hdf5Writer {
 public:
  /// `objects`: about how many groups and arrays there will be.
  Hdf5Writer(std::string path, std::size_t objects);
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;
  ~Hdf5Writer() = default;

  [[nodiscard]] const Hdf5Id& root() const { return file_; }
  [[nodiscard]] Hdf5Id group(const Hdf5Id& in, const std::string& name) const;
  void attribute(const Hdf5Id& of, const char* name, const std::vector<std::int64_t>& values) const;
  void attribute(const Hdf5Id& of, const char* name, std::string_view value) const;
  /// A new dataset, a row for each tuple; finish() writes the numbers. The memory that its array reads must outlive
  /// this.
  [[nodiscard]] Hdf5Id dataset(const Hdf5Id& in, const std::string& name, VtkArray array);
  void finish(Output& out);

 private:
  struct Waiting {
    std::uint64_t offset;
    VtkArray array;
  };
  /// The file in the memory of the library: everything except the numbers.
  struct Image {
    std::unique_ptr<char, void (*)(void*)> bytes{nullptr, std::free};
    std::size_t size = 0;
  };
  static H5FD_file_image_callbacks_t callbacks(Image* image);
  hid_t check(hid_t status, std::string_view doing) const;
  /// Bytes of the layout: zeros where the library has written nothing.
  void put_layout(Output& out, std::uint64_t from, std::uint64_t to) const;

  std::string path_;
  const Hdf5Library& library_;
  std::unique_lock<std::recursive_mutex> turn_;
  QuietHdf5 quiet_;  // outlives what is open
  Image image_;      // outlives the file
  Hdf5Id ordered_, utf8_, without_numbers_;
  Hdf5Id file_;
  std::vector<Waiting> waiting_;
};

/// The type of numbers in memory.
[[nodiscard]] hid_t hdf5_type(const Hdf5Library& library, Scalar scalar);

}  // namespace temper::io
