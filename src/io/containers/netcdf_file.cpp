#include "io/containers/netcdf_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "io/containers/foreign_library.hpp"
#include "io/containers/hdf5_magic.hpp"
#include "temper/io.hpp"

namespace temper::io {
namespace {

/// Since 4.6.2, the first that reads and writes files in memory. All of them have the same interface.
#ifdef __APPLE__
constexpr std::array kNetcdfFiles = {"libnetcdf.22.dylib", "libnetcdf.19.dylib", "libnetcdf.dylib"};
#elif defined(_WIN32)
constexpr std::array kNetcdfFiles = {"netcdf.dll"};
#else
constexpr std::array kNetcdfFiles = {"libnetcdf.so.22", "libnetcdf.so.19", "libnetcdf.so.18", "libnetcdf.so.15",
                                     "libnetcdf.so"};
#endif
constexpr std::array kNetcdfPackages = {"netcdf4.libs", "netCDF4.libs", "netCDF4/.dylibs"};
constexpr ForeignLibrary kNetcdf = {.variable = "TEMPER_NETCDF",
                                    .files = kNetcdfFiles,
                                    .packages = kNetcdfPackages,
                                    .file_in_package = "netcdf",
                                    .need = "NetCDF files need libnetcdf 4.6.2 or later",
                                    .install = "apt: libnetcdf19, conda: libnetcdf, pip: netCDF4"};

/// All functions of the library, or nothing.
std::optional<NetcdfLibrary> netcdf_of(void* handle) {
  NetcdfLibrary library;
  TEMPER_NETCDF_FUNCTIONS(TEMPER_FIND_FUNCTION)
  return library;
}

const NetcdfLibrary* find_netcdf() { return find_functions(kNetcdf, netcdf_of); }

}  // namespace

const NetcdfLibrary& netcdf_library(const std::string& path) {
  if (const NetcdfLibrary* const library = find_netcdf()) return *library;
  fail_without(kNetcdf, path);
}

std::vector<std::string> netcdf_files(const std::string& path) {
  static_cast<void>(netcdf_library(path));
  return {path};
}

std::string netcdf_version() {
  const NetcdfLibrary* const library = find_netcdf();
  if (library == nullptr) return {};
  const std::string version = library->nc_inq_libvers();  // "4.9.0 of Aug  3 2022 01:14:42 $"
  return version.substr(0, version.find(' '));
}

namespace {

/// In the order of Scalar.
constexpr std::array<nc_type, 10> kNetcdfTypes = {NC_DOUBLE, NC_FLOAT, NC_INT64,  NC_INT,  NC_UBYTE,
                                                  NC_BYTE,   NC_SHORT, NC_USHORT, NC_UINT, NC_UINT64};

std::optional<Scalar> scalar_of_netcdf(nc_type type) {
  const auto it = std::find(kNetcdfTypes.begin(), kNetcdfTypes.end(), type);
  if (it == kNetcdfTypes.end()) return std::nullopt;
  return static_cast<Scalar>(it - kNetcdfTypes.begin());
}

}  // namespace

nc_type netcdf_type(Scalar scalar) { return kNetcdfTypes[static_cast<std::size_t>(scalar)]; }

bool is_netcdf(std::string_view head) {
  using namespace std::string_view_literals;
  return head.starts_with("CDF\1"sv) || head.starts_with("CDF\2"sv) || head.starts_with("CDF\5"sv) || is_hdf5(head);
}

std::size_t NetcdfVariable::n_values() const {
  std::size_t n = 1;
  for (const std::size_t size : sizes) n *= size;
  return n;
}

NetcdfId::NetcdfId(const NetcdfLibrary& library) : turn_(foreign_tables()), library_(library) {}

// A file that has not been finished is not kept.
NetcdfId::~NetcdfId() {
  if (id_ >= 0) library_.nc_abort(id_);
}

NetcdfReader::NetcdfReader(Source& source)
    : path_(source.path),
      bytes_(source.bytes.size()),
      allocation_(source.allocation),
      library_(netcdf_library(path_)),
      id_(library_) {
  check_netcdf_header(source);
  // In memory libnetcdf 4.9 refuses a classic file whose last chunk of the header would end after the file.
  constexpr std::size_t kChunk = 1 << 16;  // at least a page
  if (!is_hdf5(source.bytes)) source.bytes.resize(source.bytes.size() + kChunk);
  check(library_.nc_open_mem(path_.c_str(), NC_NOWRITE, source.bytes.size(), source.bytes.data(), id_.to_open()),
        "read the file");
  int n = 0;
  check(library_.nc_inq_nvars(id_, &n), "count variables");
  for (int i = 0; i < n; ++i) {
    char name[NC_MAX_NAME + 1] = {};
    nc_type type = NC_NAT;
    int n_dimensions = 0;
    check(library_.nc_inq_var(id_, i, name, &type, &n_dimensions, nullptr, nullptr), "look at a variable");
    NetcdfVariable v;
    v.id = i;
    v.name = name;
    v.scalar = scalar_of_netcdf(type);
    v.dimensions.resize(static_cast<std::size_t>(n_dimensions));
    check(library_.nc_inq_vardimid(id_, i, v.dimensions.data()), "look at a variable");
    for (const int d : v.dimensions) {
      std::size_t size = 0;
      check(library_.nc_inq_dimlen(id_, d, &size), "look at a dimension");
      v.sizes.push_back(size);
    }
    variables_.push_back(std::move(v));
  }
}

void NetcdfReader::check(int status, std::string_view doing) const {
  if (status != NC_NOERR) fail(ErrorCode::syntax, path_, "NetCDF cannot ", doing, ": ", library_.nc_strerror(status));
}

const NetcdfVariable* NetcdfReader::find(std::string_view name) const {
  const auto it =
      std::find_if(variables_.begin(), variables_.end(), [&](const NetcdfVariable& v) { return v.name == name; });
  return it == variables_.end() ? nullptr : &*it;
}

const NetcdfVariable& NetcdfReader::variable(std::string_view name) const {
  if (const NetcdfVariable* v = find(name)) return *v;
  fail(ErrorCode::syntax, path_, "has no variable ", name);
}

std::string NetcdfReader::dimension_name(int dimension) const {
  char name[NC_MAX_NAME + 1] = {};
  check(library_.nc_inq_dimname(id_, dimension, name), "look at a dimension");
  return name;
}

// Data may be larger than the file when they are compressed, and several variables may share bytes.
Values NetcdfReader::values(const NetcdfVariable& v) const {
  if (!v.scalar) fail(ErrorCode::unsupported, path_, "variable ", v.name, " holds no numbers");
  if (std::find(v.sizes.begin(), v.sizes.end(), 0u) != v.sizes.end()) return zeros(*v.scalar, 0);
  const std::string where = text(path_, ": variable ", v.name);
  std::uint64_t rows = 1;
  for (const std::size_t size : v.sizes) {
    allocation_.check(rows, size, where);
    rows *= size;
  }
  allocation_.take(rows, 1, where);
  Values result = zeros(*v.scalar, v.n_values());
  std::visit(
      [&](auto& values) { check(library_.nc_get_var(id_, v.id, values.data()), text("read variable ", v.name)); },
      result);
  return result;
}

std::vector<std::string> NetcdfReader::texts(const NetcdfVariable& v) const {
  nc_type type = NC_NAT;
  check(library_.nc_inq_var(id_, v.id, nullptr, &type, nullptr, nullptr, nullptr), "look at a variable");
  if (type != NC_CHAR || v.sizes.size() != 2 || v.n_values() == 0) return {};
  allocation_.take(v.sizes[0], v.sizes[1], text(path_, ": variable ", v.name));
  std::string all(v.n_values(), '\0');
  check(library_.nc_get_var(id_, v.id, all.data()), text("read variable ", v.name));
  std::vector<std::string> rows;
  for (std::size_t i = 0; i < v.sizes[0]; ++i) {
    std::string row = all.substr(i * v.sizes[1], v.sizes[1]);
    row.resize(std::min(row.find('\0'), row.size()));
    row.resize(row.find_last_not_of(' ') + 1);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<std::int64_t> NetcdfReader::integers(const NetcdfVariable& v) const {
  const Values all = values(v);
  return std::visit(
      [&](const auto& from) {
        std::vector<std::int64_t> result;
        result.reserve(from.size());
        for (const auto value : from) {
          if constexpr (std::is_integral_v<ElementOf<decltype(from)>>) {
            if (!std::in_range<std::int64_t>(value))
              fail(ErrorCode::index_out_of_range, path_, "variable ", v.name, " has the value ", value);
            result.push_back(static_cast<std::int64_t>(value));
          } else {
            constexpr double kMost = 1e15;  // beyond, doubles skip integers
            const double number = value;
            const bool whole = std::abs(number) < kMost && number == std::trunc(number);
            if (!whole && !std::isnan(number)) {
              fail(ErrorCode::syntax, path_, "variable ", v.name, " has the value ", value, "; expected whole numbers");
            }
            result.push_back(whole ? static_cast<std::int64_t>(number) : kNoInteger);
          }
        }
        return result;
      },
      all);
}

// --- writing ---------------------------------------------------------------------------------------------

NetcdfWriter::NetcdfWriter(std::string path, bool large_types)
    : path_(std::move(path)), large_types_(large_types), library_(netcdf_library(path_)), id_(library_) {
  const int mode = large_types ? NC_64BIT_DATA : NC_64BIT_OFFSET;
  check(library_.nc_create_mem(path_.c_str(), mode, 0, id_.to_open()), "make a file");
  int ignored = 0;
  check(library_.nc_set_fill(id_, NC_NOFILL, &ignored), "make a file");
}

void NetcdfWriter::check(int status, std::string_view doing) const {
  if (status != NC_NOERR)
    fail(ErrorCode::not_writable, path_, "NetCDF cannot ", doing, ": ", library_.nc_strerror(status));
}

int NetcdfWriter::dimension(const std::string& name, std::size_t size) {
  int id = -1;
  if (library_.nc_inq_dimid(id_, name.c_str(), &id) == NC_NOERR) return id;
  check(library_.nc_def_dim(id_, name.c_str(), size, &id), text("define dimension ", name));
  return id;
}

bool NetcdfWriter::has(const std::string& name) const {
  int id = -1;
  return library_.nc_inq_varid(id_, name.c_str(), &id) == NC_NOERR;
}

int NetcdfWriter::variable(const std::string& name, const std::vector<int>& dimensions, Values values) {
  int id = -1;
  check(library_.nc_def_var(id_, name.c_str(), kNetcdfTypes[values.index()], static_cast<int>(dimensions.size()),
                            dimensions.data(), &id),
        text("define variable ", name));
  waiting_.emplace_back(id, std::move(values));
  return id;
}

int NetcdfWriter::texts(const std::string& name, int rows, const std::vector<std::string_view>& values) {
  std::size_t width = 1;
  for (const std::string_view value : values) width = std::max(width, value.size());
  std::vector<std::int8_t> bytes;  // of characters
  for (std::size_t i = 0; i < values.size(); ++i) {
    bytes.insert(bytes.end(), values[i].begin(), values[i].end());
    bytes.resize(width * (i + 1), 0);
  }
  const std::array<int, 2> dimensions = {rows, dimension(text(name, "_length"), width)};
  int id = -1;
  check(library_.nc_def_var(id_, name.c_str(), NC_CHAR, 2, dimensions.data(), &id), text("define variable ", name));
  waiting_.emplace_back(id, std::move(bytes));
  return id;
}

void NetcdfWriter::attribute(int variable, const char* name, std::string_view value) {
  check(library_.nc_put_att_text(id_, variable, name, value.size(), value.data()), text("define attribute ", name));
}
void NetcdfWriter::attribute(int variable, const char* name, double value) {
  check(library_.nc_put_att_double(id_, variable, name, NC_DOUBLE, 1, &value), text("define attribute ", name));
}
void NetcdfWriter::attribute(int variable, const char* name, std::int32_t value) {
  check(library_.nc_put_att_int(id_, variable, name, NC_INT, 1, &value), text("define attribute ", name));
}

void NetcdfWriter::attribute(int variable, const char* name, const NetcdfReader::Numbers& numbers) {
  const auto is_int = [](double x) { return x == std::trunc(x) && std::abs(x) <= std::numeric_limits<int>::max(); };
  const nc_type type = large_types_ || numbers.type <= NC_DOUBLE                           ? numbers.type
                       : std::all_of(numbers.values.begin(), numbers.values.end(), is_int) ? NC_INT
                                                                                           : NC_DOUBLE;
  check(library_.nc_put_att_double(id_, variable, name, type, numbers.values.size(), numbers.values.data()),
        text("define attribute ", name));
}

void NetcdfWriter::finish(const std::function<void(std::string_view bytes)>& take) {
  check(library_.nc_enddef(id_), "define the file");
  for (auto& [id, values] : waiting_) {
    std::visit([&, v = id](const auto& each) { check(library_.nc_put_var(id_, v, each.data()), "write a variable"); },
               values);
    values = std::vector<double>();
  }
  NC_memio memory = {};
  const int status = library_.nc_close_memio(id_, &memory);
  id_.is_closed();
  const std::unique_ptr<void, void (*)(void*)> owner(memory.memory, free_of_library);
  check(status, "finish the file");
  take(std::string_view(static_cast<const char*>(memory.memory), memory.size));
}

bool needs_cdf5(const MeshFile& f, std::size_t most_values) {
  constexpr std::size_t kMostBytes = (std::size_t{1} << 32) - 4;
  if (most_values > kMostBytes / sizeof(double)) return true;
  for (const auto* arrays : all_data(f)) {
    for (const DataArray& a : *arrays) {
      if (a.name == kNetcdfAttributes) continue;  // no variable of the file
      const Scalar s = scalar_of(a.values);
      const bool classic =
          s == Scalar::f64 || s == Scalar::f32 || s == Scalar::i32 || s == Scalar::i16 || s == Scalar::i8;
      if (!classic || size(a.values) > kMostBytes / info(s).bytes) return true;
    }
  }
  return false;
}

}  // namespace temper::io
