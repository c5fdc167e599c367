// Attributes of NetCDF, and the numbers that they unpack: CF conventions 8.1, and appendix B of the NetCDF User's
// Guide.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "io/containers/netcdf_file.hpp"

namespace temper::io {

std::vector<std::string> NetcdfReader::attribute_names(const NetcdfVariable* v) const {
  const int id = v == nullptr ? NC_GLOBAL : v->id;
  int n = 0;
  check(library_.nc_inq_varnatts(id_, id, &n), "count attributes");
  std::vector<std::string> names;
  for (int i = 0; i < n; ++i) {
    char name[NC_MAX_NAME + 1] = {};
    check(library_.nc_inq_attname(id_, id, i, name), "look at an attribute");
    names.emplace_back(name);
  }
  return names;
}

std::string NetcdfReader::text_attribute(const NetcdfVariable* v, const char* name) const {
  const int id = v == nullptr ? NC_GLOBAL : v->id;
  nc_type type = NC_NAT;
  std::size_t n = 0;
  if (library_.nc_inq_att(id_, id, name, &type, &n) != NC_NOERR || n > bytes_) return {};
  if (type == NC_STRING) {
    std::vector<char*> strings(n, nullptr);
    if (n > 0) check(library_.nc_get_att_string(id_, id, name, strings.data()), text("read attribute ", name));
    std::string all;
    for (const char* each : strings) all += text(all.empty() ? "" : " ", each == nullptr ? "" : each);
    if (n > 0) library_.nc_free_string(n, strings.data());
    return all;
  }
  if (type != NC_CHAR) return {};
  std::string result(n, '\0');
  if (n > 0) check(library_.nc_get_att_text(id_, id, name, result.data()), text("read attribute ", name));
  while (!result.empty() && (result.back() == '\0' || result.back() == ' ')) result.pop_back();
  return result;
}

NetcdfReader::Numbers NetcdfReader::numbers_attribute(const NetcdfVariable* v, const char* name) const {
  const int id = v == nullptr ? NC_GLOBAL : v->id;
  Numbers numbers;
  std::size_t n = 0;
  if (library_.nc_inq_att(id_, id, name, &numbers.type, &n) != NC_NOERR || n > bytes_) return {};
  if (n == 0 || numbers.type == NC_CHAR || numbers.type < NC_BYTE || numbers.type > NC_UINT64) return {};
  numbers.values.resize(n);
  if (library_.nc_get_att_double(id_, id, name, numbers.values.data()) != NC_NOERR) return {};
  return numbers;
}

std::optional<double> NetcdfReader::number_attribute(const NetcdfVariable* v, const char* name) const {
  const Numbers numbers = numbers_attribute(v, name);
  return numbers.values.size() == 1 ? std::optional(numbers.values[0]) : std::nullopt;
}

bool NetcdfReader::is_packed(const NetcdfVariable& v) const {
  return number_attribute(&v, "scale_factor") || number_attribute(&v, "add_offset");
}

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
/// In the order of Scalar; bytes have none.
constexpr std::array<double, 10> kDefaultFills = {
    NC_FILL_DOUBLE, double{NC_FILL_FLOAT}, double(NC_FILL_INT64), NC_FILL_INT,  kNone,
    kNone,          NC_FILL_SHORT,         NC_FILL_USHORT,        NC_FILL_UINT, double(NC_FILL_UINT64)};

bool is_floating(nc_type type) { return type == NC_FLOAT || type == NC_DOUBLE; }

/// Bytes and integers of classic files, which have no unsigned types, if the attribute _Unsigned is "true".
Values as_unsigned(Values values) {
  return std::visit(
      [](auto& from) -> Values {
        using Number = ElementOf<decltype(from)>;
        if constexpr (std::is_integral_v<Number>) {
          return std::vector<std::make_unsigned_t<Number>>(from.begin(), from.end());
        } else {
          return std::move(from);
        }
      },
      values);
}

/// How packed numbers become values, and which of them are none.
struct Unpacking {
  bool packed = false, is_unsigned = false;
  double factor = 1, shift = 0;
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool bounds_unpacked = false;  ///< by their type, which is wider than that of the packed numbers
  std::vector<double> fills = {};
};

template <class Raw>
bool is_fill(Raw x, double fill, bool is_unsigned) {
  if constexpr (std::is_floating_point_v<Raw>) {
    return x == static_cast<Raw>(fill);
  } else {
    constexpr Raw kHalf = std::numeric_limits<Raw>::max() / 2 + 1;
    constexpr double kTurn = 2.0 * static_cast<double>(kHalf);
    return static_cast<double>(x) == (is_unsigned && fill < 0 ? fill + kTurn : fill);
  }
}

template <class Unpacked, class Raw>
std::vector<Unpacked> unpack(const std::vector<Raw>& from, const Unpacking& how) {
  std::vector<Unpacked> result;
  result.reserve(from.size());
  for (const Raw x : from) {
    const double value = how.packed ? how.factor * static_cast<double>(x) + how.shift : static_cast<double>(x);
    const double compared = how.bounds_unpacked ? value : static_cast<double>(x);
    const bool missing =
        compared < how.low || compared > how.high ||
        std::any_of(how.fills.begin(), how.fills.end(), [&](double fill) { return is_fill(x, fill, how.is_unsigned); });
    result.push_back(missing ? std::numeric_limits<Unpacked>::quiet_NaN() : static_cast<Unpacked>(value));
  }
  return result;
}

}  // namespace

std::vector<double> NetcdfReader::fill_values(const NetcdfVariable& v) const {
  std::vector<double> fills = numbers_attribute(&v, "_FillValue").values;
  if (fills.empty() && v.scalar) fills.push_back(kDefaultFills[static_cast<std::size_t>(*v.scalar)]);
  const std::vector<double> missing = numbers_attribute(&v, "missing_value").values;
  fills.insert(fills.end(), missing.begin(), missing.end());
  return fills;
}

Values NetcdfReader::unpacked(const NetcdfVariable& v) const {
  Values raw = values(v);
  const bool is_unsigned = text_attribute(&v, "_Unsigned") == "true", packed = is_packed(v);
  if (is_unsigned) raw = as_unsigned(std::move(raw));
  if (!packed && !io::is_floating(raw)) return raw;
  const Numbers scale = numbers_attribute(&v, "scale_factor"), offset = numbers_attribute(&v, "add_offset");
  const double factor = scale.values.empty() ? 1 : scale.values[0],
               shift = offset.values.empty() ? 0 : offset.values[0];

  Unpacking how = {packed, is_unsigned, factor, shift};
  const auto bound = [&](const char* name, std::size_t count, auto set) {
    const Numbers numbers = numbers_attribute(&v, name);
    if (numbers.values.size() != count) return;
    how.bounds_unpacked = !io::is_floating(raw) && is_floating(numbers.type);
    set(numbers.values);
  };
  bound("valid_min", 1, [&](const auto& x) { how.low = x[0]; });
  bound("valid_max", 1, [&](const auto& x) { how.high = x[0]; });
  bound("valid_range", 2, [&](const auto& x) { how.low = x[0], how.high = x[1]; });
  how.fills = fill_values(v);
  const auto is_float = [](const Numbers& n) { return n.values.empty() || n.type == NC_FLOAT; };
  const bool single =
      packed ? is_float(scale) && is_float(offset) && scalar_of(raw) != Scalar::f64 : scalar_of(raw) == Scalar::f32;
  return std::visit(
      [&](const auto& from) { return single ? Values(unpack<float>(from, how)) : unpack<double>(from, how); }, raw);
}

}  // namespace temper::io
