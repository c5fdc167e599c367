#include "io/formats/netcdf/netcdf_extras.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>
#include <variant>

#include "io/conversion/bed.hpp"
#include "io/conversion/globe.hpp"
#include "io/text/names.hpp"
#include "io/text/scanner.hpp"

namespace temper::io {
namespace {

constexpr std::string_view kLinePointsVariable = "temper_line_points", kLineTagsVariable = "temper_line_tags",
                           kMarkedPointsVariable = "temper_marked_points", kPointTagsVariable = "temper_point_tags",
                           kRegionVariable = "region";
constexpr const char *kKindAttribute = "temper_kind", *kNameAttribute = "temper_name",
                     *kNamesAttribute = "temper_names", *kZAttribute = "temper_z";

struct ExtraKind {
  std::string_view name;
  Content data;
  std::string_view location;  // of UGRID
};
constexpr std::array<ExtraKind, 5> kExtraKinds = {{{"point", kPointData, "node"},
                                                   {"cell", kCellData, "face"},
                                                   {"line", kLineData, ""},
                                                   {"marked", kMarkedPointData, ""},
                                                   {"field", kFieldData, ""}}};

/// A name that NetCDF accepts and no variable has.
std::string free_name(const NetcdfWriter& out, const ExtraKind& kind, const std::string& name) {
  std::string plain;
  for (const char c : name) {
    const bool fine = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    plain += fine ? c : '_';
  }
  const bool letter = !plain.empty() && (plain[0] < '0' || plain[0] > '9');
  if (letter && !out.has(plain)) return plain;
  plain = text("temper_", kind.name, "_", plain);
  if (!out.has(plain)) return plain;
  for (int i = 2;; ++i) {
    if (std::string other = text(plain, "_", i); !out.has(other)) return other;
  }
}

template <std::size_t n>
std::vector<std::int32_t> flattened(const std::vector<std::array<std::int32_t, n>>& rows) {
  std::vector<std::int32_t> all;
  all.reserve(n * rows.size());
  for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
  return all;
}

class ExtrasWriter {
 public:
  ExtrasWriter(NetcdfWriter& out, const WriteJob& job, const MeshFile& file, const NetcdfPositions& places)
      : out_(out), job_(job), file_(file), places_(places) {}

  void write() {
    const MeshFile& f = file_;
    if (!is_flat(f)) out_.attribute(NetcdfWriter::kFile, kZAttribute, f.z());
    if (!f.names.empty()) out_.attribute(NetcdfWriter::kFile, kNamesAttribute, lines_of(f.names));
    if (!f.triangles.tags.empty()) put(kExtraKinds[1], std::string(kRegionVariable), {places_.cells}, f.triangles.tags);
    if (!f.lines.empty()) {
      lines_ = out_.dimension("temper_lines", f.lines.size());
      out_.variable(std::string(kLinePointsVariable), {lines_, out_.dimension("TWO", 2)}, flattened(f.lines.corners));
      out_.variable(std::string(kLineTagsVariable), {lines_}, f.lines.tags);
    }
    if (!f.marked_points.empty()) {
      marked_ = out_.dimension("temper_marked", f.marked_points.size());
      out_.variable(std::string(kMarkedPointsVariable), {marked_}, f.marked_points.corners);
      out_.variable(std::string(kPointTagsVariable), {marked_}, f.marked_points.tags);
    }
    for (const ExtraKind& kind : kExtraKinds) {
      for (const DataArray& a : data_of(f, kind.data)) {
        if (a.name != kNetcdfAttributes) data(kind, a);
      }
    }
    places_.kept.write_values(out_);
  }

 private:
  int put(const ExtraKind& kind, const std::string& name, const std::vector<int>& dimensions, Values values) {
    const int id = out_.variable(name, dimensions, std::move(values));
    if (!places_.mesh.empty() && !kind.location.empty()) {
      out_.attribute(id, "mesh", places_.mesh);
      out_.attribute(id, "location", kind.location);
    }
    return id;
  }

  /// The number that stands for a missing value takes the place of NaN again.
  static void put_fill(Values& values, double fill) {
    std::visit(
        [&](auto& numbers) {
          using Number = ElementOf<decltype(numbers)>;
          if constexpr (std::is_floating_point_v<Number>)
            std::ranges::replace_if(
                numbers, [](Number x) { return std::isnan(x); }, static_cast<Number>(fill));
        },
        values);
  }
  /// Says whether an array may hold the number: it may have got another type since it was read.
  static bool can_be(const Values& values, double number) {
    return std::visit(
        [number](const auto& all) {
          using Limits = std::numeric_limits<ElementOf<decltype(all)>>;
          return !Limits::is_integer ||
                 (number >= static_cast<double>(Limits::min()) && number <= static_cast<double>(Limits::max()));
        },
        values);
  }
  /// Declares the number that stands for a missing value, in the type of the values: NaN if no other is known.
  void declare_fill(int id, const Values& values, std::optional<double> fill) {
    const bool has_nan = std::visit(
        [](const auto& all) {
          return std::ranges::any_of(all, [](auto x) { return std::isnan(static_cast<double>(x)); });
        },
        values);
    if (!fill && !has_nan) return;
    out_.attribute(id, "_FillValue",
                   {{fill.value_or(std::numeric_limits<double>::quiet_NaN())}, netcdf_type(scalar_of(values))});
  }

  void data(const ExtraKind& kind, const DataArray& a) {
    const auto components = static_cast<std::size_t>(a.components);
    const std::size_t tuples = size(a.values) / components;
    if (tuples == 0) {
      job_.warn(kind.name, " data ", in_quotes(a.name), " have no values and are not written");
      return;
    }
    std::vector<int> dimensions;
    if (kind.name == "field") {
      dimensions.push_back(out_.dimension(text("temper_size_", tuples), tuples));
    } else {
      dimensions.push_back(kind.name == "point"  ? places_.points
                           : kind.name == "cell" ? places_.cells
                           : kind.name == "line" ? lines_
                                                 : marked_);
    }
    if (components > 1) dimensions.push_back(out_.dimension(text("temper_components_", components), components));
    const std::string name = free_name(out_, kind, a.name);
    const NetcdfVariable* const kept = places_.kept.find(name);
    Values values = a.values;
    auto fill = places_.kept.number_of(kept, "_FillValue");
    if (!fill) fill = places_.kept.number_of(kept, "missing_value");
    if (fill && !can_be(a.values, *fill)) fill.reset();
    if (fill) put_fill(values, *fill);
    const int id = put(kind, name, dimensions, std::move(values));
    if (a.name == kLongitude || a.name == kLatitude) name_degrees(out_, id, a.name);
    if (a.name == kBedLevel && kept == nullptr) {
      out_.attribute(id, "standard_name", "altitude");
      out_.attribute(id, "long_name", "bed level");
      out_.attribute(id, "units", "m");
      out_.attribute(id, "positive", "up");
    }
    if (fill || is_floating(a.values)) declare_fill(id, a.values, fill);
    if (kept != nullptr) places_.kept.copy(kept, out_, id);
    out_.attribute(id, kKindAttribute, kind.name);
    out_.attribute(id, kNameAttribute, a.name);
  }

  NetcdfWriter& out_;
  const WriteJob& job_;
  const MeshFile& file_;
  const NetcdfPositions& places_;
  int lines_ = -1, marked_ = -1;
};

/// Variables of temper's own must have one row for each element.
void expect_rows(const Document& d, const NetcdfVariable& v, std::size_t rows) {
  if (!v.sizes.empty() && v.sizes[0] == rows) return;
  fail(ErrorCode::size_mismatch, d.names->path, "variable ", v.name, " has ", v.sizes.empty() ? 1 : v.sizes[0],
       " rows, expected ", rows);
}

std::vector<std::int32_t> read_int32(const NetcdfReader& in, const Document& d, const NetcdfVariable& v) {
  auto values = to_int32(in.values(v));
  if (!values)
    fail(ErrorCode::index_out_of_range, d.names->path, "variable ", v.name, " has a value of more than 32 bits");
  return std::move(*values);
}

void read_own_data(const NetcdfReader& in, Document& document, const NetcdfVariable& v, const ExtraKind& kind) {
  MeshFile& f = document.file;
  std::string name = in.text_attribute(&v, kNameAttribute);
  if (name.empty()) name = v.name;
  if (!v.scalar || v.sizes.empty() || v.sizes.size() > 2)
    fail(ErrorCode::syntax, document.names->path, "variable ", v.name, " is no array of numbers");
  const std::size_t components = v.sizes.size() == 2 ? v.sizes[1] : 1;
  constexpr std::size_t kMostComponents = 4096;
  if (components < 1 || components > kMostComponents)
    fail(ErrorCode::syntax, document.names->path, "variable ", v.name, " has ", components, " components");
  if (kind.name == "point") expect_rows(document, v, f.points.size());
  if (kind.name == "cell") expect_rows(document, v, f.triangles.size());
  if (kind.name == "line") expect_rows(document, v, f.lines.size());
  if (kind.name == "marked") expect_rows(document, v, f.marked_points.size());
  auto& arrays = data_of(f, kind.data);
  arrays.push_back({std::move(name), static_cast<int>(components), in.unpacked(v)});
}

}  // namespace

void name_degrees(NetcdfWriter& out, int variable, std::string_view standard_name) {
  out.attribute(variable, "standard_name", standard_name);
  out.attribute(variable, "units", standard_name == kLongitude ? "degrees_east" : "degrees_north");
}

void write_netcdf_extras(NetcdfWriter& out, const WriteJob& job, const MeshFile& file, const NetcdfPositions& places) {
  ExtrasWriter(out, job, file, places).write();
}

bool is_kept_alone(const NetcdfReader& in, const NetcdfVariable& v) {
  const bool is_map = !in.text_attribute(&v, "grid_mapping_name").empty() || !in.text_attribute(&v, "crs_wkt").empty();
  return in.text_attribute(&v, "cf_role").empty() && (is_map || (v.scalar && v.dimensions.empty()));
}

bool is_netcdf_extra(const NetcdfReader& in, const NetcdfVariable& v) {
  return v.name == kLinePointsVariable || v.name == kLineTagsVariable || v.name == kMarkedPointsVariable ||
         v.name == kPointTagsVariable || v.name == kRegionVariable || !in.text_attribute(&v, kKindAttribute).empty();
}

void read_netcdf_extras(const NetcdfReader& in, Document& document, NetcdfCollector& kept) {
  MeshFile& f = document.file;
  if (const auto z = in.number_attribute(nullptr, kZAttribute)) document.z = *z;
  const std::string names = in.text_attribute(nullptr, kNamesAttribute);
  Scanner scanner(document.names->path, names);
  read_physical_names(scanner, f.names);
  if (const NetcdfVariable* v = in.find(kRegionVariable); v != nullptr && v->sizes.size() == 1) {
    expect_rows(document, *v, f.triangles.size());
    f.triangles.tags = read_int32(in, document, *v);
  }
  if (const NetcdfVariable* v = in.find(kLinePointsVariable)) {
    const auto ends = read_int32(in, document, *v);
    if (v->sizes.size() != 2 || v->sizes[1] != 2)
      fail(ErrorCode::syntax, document.names->path, "variable ", v->name, " has other than two columns");
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) f.lines.corners.push_back({ends[i], ends[i + 1]});
    const NetcdfVariable& tags = in.variable(kLineTagsVariable);
    expect_rows(document, tags, f.lines.size());
    f.lines.tags = read_int32(in, document, tags);
    f.lines.tags.resize(f.lines.size());
  }
  if (const NetcdfVariable* v = in.find(kMarkedPointsVariable)) {
    f.marked_points.corners = read_int32(in, document, *v);
    const NetcdfVariable& tags = in.variable(kPointTagsVariable);
    expect_rows(document, tags, f.marked_points.size());
    f.marked_points.tags = read_int32(in, document, tags);
    f.marked_points.tags.resize(f.marked_points.size());
  }
  for (const NetcdfVariable& v : in.variables()) {
    const std::string kind = in.text_attribute(&v, kKindAttribute);
    for (const ExtraKind& row : kExtraKinds) {
      if (kind != row.name) continue;
      read_own_data(in, document, v, row);
      kept.variable(v);
    }
  }
}

void add_netcdf_data(const NetcdfReader& in, const NetcdfVariable& v, std::vector<DataArray>& arrays,
                     NetcdfCollector& kept, const std::string& name) {
  arrays.push_back({name.empty() ? v.name : name, 1, in.unpacked(v)});
  kept.variable(v, arrays.back().name);
}

void warn_of_dropped(Document& document, const std::vector<std::string_view>& names) {
  if (names.empty()) return;
  document.file.warnings.push_back(text(document.names->path, ": variables are dropped: ", list_of(names)));
}

NetcdfMesh mesh_for_netcdf(const WriteJob& job, std::string_view format) {
  NetcdfMesh result{job.file, {}, {}};
  result.file.warnings.clear();
  auto made = make_mesh(result.file, {}, job.executor);
  if (!made) {
    fail(made.error().code, job.path, format, " holds orthocenters and so needs a valid mesh: ", made.error().what());
  }
  update(result.file, *made, made->mesh);
  for (const std::string& w : made->warnings) job.warnings.push_back(w);
  result.mesh = std::move(made->mesh);
  result.complex = dec_operators(result.mesh);
  return result;
}

// --- what is kept of a file that was read -------------------------------------------------------------------------

namespace {

/// Attributes that the numbers of memory do not have, or that the writer makes again.
bool holds_no_more(std::string_view name, bool packed) {
  constexpr std::array kNever = {"mesh",         "location", "scale_factor", "add_offset",  "_Unsigned",
                                 "actual_range", "bounds",   "_ChunkSizes",  "coordinates", "_NCProperties"};
  constexpr std::array kOfPacked = {"_FillValue", "missing_value", "valid_min", "valid_max", "valid_range"};
  const auto is = [name](const char* other) { return name == other; };
  return name.starts_with("temper_") || std::ranges::any_of(kNever, is) ||
         (packed && std::ranges::any_of(kOfPacked, is));
}

/// One value in a type that classic files have: other whole numbers become an int, or a double if they are too large.
Values classic(const Values& one) {
  return std::visit(
      [&](const auto& each) -> Values {
        using T = typename std::decay_t<decltype(each)>::value_type;
        if constexpr (std::is_floating_point_v<T> || (std::is_signed_v<T> && sizeof(T) <= sizeof(std::int32_t))) {
          return each;
        } else {
          if (std::in_range<std::int32_t>(each[0]))
            return std::vector<std::int32_t>{static_cast<std::int32_t>(each[0])};
          return std::vector<double>{static_cast<double>(each[0])};
        }
      },
      one);
}

}  // namespace

NetcdfCollector::NetcdfCollector(const NetcdfReader& in) : in_(in), kept_(std::string(kNetcdfAttributes), false) {}

void NetcdfCollector::file(const IsKnown& is_known) { attributes(nullptr, NetcdfWriter::kFile, is_known); }

void NetcdfCollector::variable(const NetcdfVariable& v, const std::string& name, const IsKnown& is_known) {
  // Attributes of an array are those of a variable with a dimension, without values.
  const bool alone = is_kept_alone(in_, v);
  const std::vector<int> dimensions = alone ? std::vector<int>() : std::vector<int>{kept_.dimension("array", 1)};
  const bool has_value = alone && v.scalar && v.n_values() == 1;
  const int to = kept_.variable(name, dimensions, has_value ? classic(in_.values(v)) : std::vector<std::int32_t>{0});
  any_ = any_ || alone;
  attributes(&v, to, is_known);
}

void NetcdfCollector::attributes(const NetcdfVariable* v, int to, const IsKnown& is_known) {
  const bool packed = v != nullptr && in_.is_packed(*v);
  for (const std::string& name : in_.attribute_names(v)) {
    std::string value = in_.text_attribute(v, name.c_str());
    const auto numbers = in_.numbers_attribute(v, name.c_str());
    if ((value.empty() && numbers.values.empty()) || holds_no_more(name, packed) || (is_known && is_known(name, value)))
      continue;
    any_ = true;
    if (value.empty()) {
      kept_.attribute(to, name.c_str(), numbers);
    } else {
      kept_.attribute(to, name.c_str(), value);
    }
  }
}

void NetcdfCollector::finish(MeshFile& file) {
  if (!any_) return;
  kept_.finish([&](std::string_view bytes) {
    file.field_data.push_back(
        {std::string(kNetcdfAttributes), 1, std::vector<std::uint8_t>(bytes.begin(), bytes.end())});
  });
}

NetcdfKept::NetcdfKept(const MeshFile& file) {
  const DataArray* const array = io::find(file.field_data, kNetcdfAttributes);
  const auto* const bytes = array == nullptr ? nullptr : std::get_if<std::vector<std::uint8_t>>(&array->values);
  if (bytes == nullptr) return;
  bytes_ = std::make_unique<Source>(Source{std::string(kNetcdfAttributes), std::string(bytes->begin(), bytes->end())});
  if (!bytes_->bytes.starts_with("CDF"))
    fail(ErrorCode::syntax, file.path, "field data ", kNetcdfAttributes, " are not the bytes of a classic NetCDF file");
  in_ = std::make_unique<NetcdfReader>(*bytes_);
}

const NetcdfVariable* NetcdfKept::find(std::string_view name) const { return in_ ? in_->find(name) : nullptr; }

const NetcdfVariable* NetcdfKept::find(const char* attribute, std::string_view value) const {
  if (!in_) return nullptr;
  const auto found = std::ranges::find_if(in_->variables(),
                                          [&](const auto& v) { return in_->text_attribute(&v, attribute) == value; });
  return found == in_->variables().end() ? nullptr : &*found;
}

std::string NetcdfKept::text_of(const NetcdfVariable* v, const char* attribute) const {
  return in_ ? in_->text_attribute(v, attribute) : std::string();
}

std::optional<double> NetcdfKept::number_of(const NetcdfVariable* v, const char* attribute) const {
  return v != nullptr ? in_->number_attribute(v, attribute) : std::nullopt;
}

void NetcdfKept::copy(const NetcdfVariable* from, NetcdfWriter& out, int variable, std::string_view only) const {
  if (!in_) return;
  for (const std::string& name : in_->attribute_names(from)) {
    if ((!only.empty() && name != only) || name == "_FillValue" || name == "node_coordinates") continue;
    if (const std::string value = in_->text_attribute(from, name.c_str()); !value.empty()) {
      out.attribute(variable, name.c_str(), value);
    } else {
      out.attribute(variable, name.c_str(), in_->numbers_attribute(from, name.c_str()));
    }
  }
}

std::optional<std::string> netcdf_attribute(const MeshFile& file, std::string_view name, const char* attribute) {
  if (io::find(file.field_data, kNetcdfAttributes) == nullptr || netcdf_version().empty()) return std::nullopt;
  const NetcdfKept kept(file);
  const NetcdfVariable* const variable = kept.find(name);
  return variable == nullptr ? std::nullopt : std::optional(kept.text_of(variable, attribute));
}

void NetcdfKept::write_values(NetcdfWriter& out) const {
  if (!in_) return;
  for (const NetcdfVariable& v : in_->variables()) {
    if (v.dimensions.empty() && v.scalar && !out.has(v.name)) copy(&v, out, out.variable(v.name, {}, in_->values(v)));
  }
}

}  // namespace temper::io
