// NetCDF files in memory, by the C library: failures are exceptions, and nothing is opened by name.
//
// The writer makes classic files: with 64-bit offsets, or CDF-5 when the types of some array need it. The reader takes
// all that the library reads, NetCDF-4 (HDF5) included.
#pragma once

#include <netcdf.h>
#include <netcdf_mem.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/disk/files.hpp"
#include "io/text/values.hpp"

namespace temper::io {

/// Every function of it that is called here.
#define TEMPER_NETCDF_FUNCTIONS(use)                                                                                 \
  use(nc_abort) use(nc_close_memio) use(nc_create_mem) use(nc_def_dim) use(nc_def_var) use(nc_enddef)                \
      use(nc_free_string) use(nc_get_att_double) use(nc_get_att_string) use(nc_get_att_text) use(nc_get_var)         \
          use(nc_inq_att) use(nc_inq_attname) use(nc_inq_dimid) use(nc_inq_dimlen) use(nc_inq_dimname)               \
              use(nc_inq_libvers) use(nc_inq_nvars) use(nc_inq_var) use(nc_inq_varnatts) use(nc_inq_vardimid)        \
                  use(nc_inq_varid) use(nc_open_mem) use(nc_put_att_double) use(nc_put_att_int) use(nc_put_att_text) \
                      use(nc_put_var) use(nc_set_fill) use(nc_strerror)

/// Its functions by their own names, as members. Null as long as it is not loaded.
struct NetcdfLibrary {
// NOLINTNEXTLINE(bugprone-macro-parentheses): the name of a member has none
#define TEMPER_MEMBER(function) decltype(&::function) function = nullptr;
  TEMPER_NETCDF_FUNCTIONS(TEMPER_MEMBER)
#undef TEMPER_MEMBER
};

/// The library; a failure about the file `path` when there is none. From several threads at once, too.
const NetcdfLibrary& netcdf_library(const std::string& path);

/// The magic numbers of the classic formats and of HDF5.
[[nodiscard]] bool is_netcdf(std::string_view head);

[[nodiscard]] nc_type netcdf_type(Scalar scalar);

/// Refuses a classic file whose header is wrong.
void check_netcdf_header(const Source& source);

struct NetcdfVariable {
  int id = -1;
  std::string name;
  std::vector<int> dimensions;
  std::vector<std::size_t> sizes;  ///< of the dimensions
  std::optional<Scalar> scalar;    ///< none: characters, strings and types of the user

  [[nodiscard]] std::size_t n_values() const;
};

/// An open file of libnetcdf, which is closed at the end. The library keeps a table of open files for one thread at a
/// time: other threads wait until this file is closed.
class NetcdfId {
 public:
  explicit NetcdfId(const NetcdfLibrary& library);
  ~NetcdfId();
  NetcdfId(const NetcdfId&) = delete;
  NetcdfId& operator=(const NetcdfId&) = delete;

  operator int() const { return id_; }
  [[nodiscard]] int* to_open() { return &id_; }
  /// The library has closed it.
  void is_closed() { id_ = -1; }

 private:
  std::unique_lock<std::recursive_mutex> turn_;
  const NetcdfLibrary& library_;
  int id_ = -1;
};

class NetcdfReader {
 public:
  static constexpr std::int64_t kNoInteger = std::numeric_limits<std::int64_t>::min();
  /// The bytes must outlive the reader.
  explicit NetcdfReader(Source& source);
  NetcdfReader(const NetcdfReader&) = delete;
  NetcdfReader& operator=(const NetcdfReader&) = delete;
  ~NetcdfReader() = default;

  [[nodiscard]] const std::vector<NetcdfVariable>& variables() const { return variables_; }
  [[nodiscard]] const NetcdfVariable* find(std::string_view name) const;
  /// Fails when there is none.
  [[nodiscard]] const NetcdfVariable& variable(std::string_view name) const;
  [[nodiscard]] std::string dimension_name(int dimension) const;
  [[nodiscard]] Values values(const NetcdfVariable& variable) const;
  /// The rows of a table of characters, without what fills them up; empty if the variable is none.
  [[nodiscard]] std::vector<std::string> texts(const NetcdfVariable& variable) const;
  /// The values as CF and NUG say: unpacked by scale_factor and add_offset, to float if both are, else to double.
  /// Floating or packed numbers are NaN where _FillValue, missing_value, a valid range or the default fill value say
  /// that they are missing. Other integers stay: they are labels.
  [[nodiscard]] Values unpacked(const NetcdfVariable& variable) const;
  [[nodiscard]] bool is_packed(const NetcdfVariable& variable) const;
  /// The integers that stand for no value in a table.
  [[nodiscard]] std::vector<double> fill_values(const NetcdfVariable& variable) const;
  /// Also floating types, if all values are whole. A value that is not a number becomes kNoInteger.
  [[nodiscard]] std::vector<std::int64_t> integers(const NetcdfVariable& variable) const;
  [[nodiscard]] std::vector<std::string> attribute_names(const NetcdfVariable* variable) const;
  /// Text of an attribute of a variable, or of the file when it is null; empty when there is none. Several strings have
  /// blanks between them.
  [[nodiscard]] std::string text_attribute(const NetcdfVariable* variable, const char* name) const;
  [[nodiscard]] std::optional<double> number_attribute(const NetcdfVariable* variable, const char* name) const;
  struct Numbers {
    std::vector<double> values;  ///< empty when there are none
    nc_type type = NC_NAT;
  };
  [[nodiscard]] Numbers numbers_attribute(const NetcdfVariable* variable, const char* name) const;

 private:
  void check(int status, std::string_view doing) const;

  const std::string& path_;
  std::size_t bytes_;
  AllocationLimits& allocation_;
  const NetcdfLibrary& library_;
  NetcdfId id_;
  std::vector<NetcdfVariable> variables_;
};

class NetcdfWriter {
 public:
  /// `large_types`: some array is of a type that only CDF-5 has.
  NetcdfWriter(std::string path, bool large_types);
  NetcdfWriter(const NetcdfWriter&) = delete;
  NetcdfWriter& operator=(const NetcdfWriter&) = delete;
  ~NetcdfWriter() = default;

  /// The dimension of that name; made when it is not there. Precondition: size > 0.
  int dimension(const std::string& name, std::size_t size);
  /// A new variable; the values are written by finish(), a single one when there are no dimensions.
  int variable(const std::string& name, const std::vector<int>& dimensions, Values values);
  /// A new variable of characters with a row for each element, filled up with zeros.
  int texts(const std::string& name, int rows, const std::vector<std::string_view>& values);
  [[nodiscard]] bool has(const std::string& name) const;
  static constexpr int kFile = -1;  ///< instead of a variable
  void attribute(int variable, const char* name, std::string_view text);
  void attribute(int variable, const char* name, double value);
  void attribute(int variable, const char* name, std::int32_t value);
  /// In their type, if this file may have it.
  void attribute(int variable, const char* name, const NetcdfReader::Numbers& numbers);
  /// Hands the bytes of the file on.
  void finish(const std::function<void(std::string_view bytes)>& take);

 private:
  void check(int status, std::string_view doing) const;

  std::string path_;
  bool large_types_;
  const NetcdfLibrary& library_;
  NetcdfId id_;
  std::vector<std::pair<int, Values>> waiting_;
};

// Attributes, and variables without dimensions (coordinate systems), belong to no array. They are kept as the bytes of
// a small classic NetCDF file with these alone, in the field data `netcdf:attributes`. So they survive in every format
// with field data, and come back to NetCDF of any convention.
inline constexpr std::string_view kNetcdfAttributes = "netcdf:attributes";

/// Says whether a file with these data has to be CDF-5. It has to be for their types, or when a variable is too long
/// for 64-bit offsets. The largest other variable has `most_values` values of at most eight bytes.
[[nodiscard]] bool needs_cdf5(const MeshFile& file, std::size_t most_values);

}  // namespace temper::io
