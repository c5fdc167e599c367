#include "io/formats/netcdf/netcdf_extras.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <type_traits>
#include <utility>
#include <variant>

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
  std::vector<DataArray> MeshFile::*data;
  std::string_view location;  // of UGRID
};
constexpr std::array<ExtraKind, 5> kExtraKinds = {{{"point", &MeshFile::point_data, "node"},
                                                   {"cell", &MeshFile::cell_data, "face"},
                                                   {"line", &MeshFile::line_data, ""},
                                                   {"marked", &MeshFile::marked_point_data, ""},
                                                   {"field", &MeshFile::field_data, ""}}};

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
    if (!f.regions.empty()) put(kExtraKinds[1], std::string(kRegionVariable), {places_.cells}, f.regions);
    if (!f.lines.empty()) {
      lines_ = out_.dimension("temper_lines", f.lines.size());
      out_.variable(std::string(kLinePointsVariable), {lines_, out_.dimension("TWO", 2)}, flattened(f.lines));
      out_.variable(std::string(kLineTagsVariable), {lines_}, f.line_tags);
    }
    if (!f.marked_points.empty()) {
      marked_ = out_.dimension("temper_marked", f.marked_points.size());
      out_.variable(std::string(kMarkedPointsVariable), {marked_}, f.marked_points);
      out_.variable(std::string(kPointTagsVariable), {marked_}, f.point_tags);
    }
    for (const ExtraKind& kind : kExtraKinds) {
      for (const DataArray& a : f.*kind.data) data(kind, a);
    }
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
    const int id = put(kind, free_name(out_, kind, a.name), dimensions, a.values);
    if (a.name == kLongitude || a.name == kLatitude) name_degrees(out_, id, a.name);
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
  auto& arrays = f.*kind.data;
  arrays.push_back({std::move(name), static_cast<int>(components), in.values(v)});
}

/// A number that stands for a missing value becomes NaN, so that no depth is interpolated from it.
void make_nan(Values& values, double missing) {
  const auto replace = [missing](auto& numbers) {
    using Number = typename std::decay_t<decltype(numbers)>::value_type;
    if constexpr (std::is_floating_point_v<Number>)
      std::ranges::replace(numbers, static_cast<Number>(missing), std::numeric_limits<Number>::quiet_NaN());
  };
  std::visit(replace, values);
}

}  // namespace

void name_degrees(NetcdfWriter& out, int variable, std::string_view standard_name) {
  out.attribute(variable, "standard_name", standard_name);
  out.attribute(variable, "units", standard_name == kLongitude ? "degrees_east" : "degrees_north");
}

void write_netcdf_extras(NetcdfWriter& out, const WriteJob& job, const MeshFile& file, const NetcdfPositions& places) {
  ExtrasWriter(out, job, file, places).write();
}

bool is_netcdf_extra(const NetcdfReader& in, const NetcdfVariable& v) {
  return v.name == kLinePointsVariable || v.name == kLineTagsVariable || v.name == kMarkedPointsVariable ||
         v.name == kPointTagsVariable || v.name == kRegionVariable || !in.text_attribute(&v, kKindAttribute).empty();
}

void read_netcdf_extras(const NetcdfReader& in, Document& document) {
  MeshFile& f = document.file;
  if (const auto z = in.number_attribute(nullptr, kZAttribute)) document.z = *z;
  const std::string names = in.text_attribute(nullptr, kNamesAttribute);
  Scanner scanner(document.names->path, names);
  read_physical_names(scanner, f.names);
  if (const NetcdfVariable* v = in.find(kRegionVariable); v != nullptr && v->sizes.size() == 1) {
    expect_rows(document, *v, f.triangles.size());
    f.regions = read_int32(in, document, *v);
  }
  if (const NetcdfVariable* v = in.find(kLinePointsVariable)) {
    const auto ends = read_int32(in, document, *v);
    if (v->sizes.size() != 2 || v->sizes[1] != 2)
      fail(ErrorCode::syntax, document.names->path, "variable ", v->name, " has other than two columns");
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) f.lines.push_back({ends[i], ends[i + 1]});
    const NetcdfVariable& tags = in.variable(kLineTagsVariable);
    expect_rows(document, tags, f.lines.size());
    f.line_tags = read_int32(in, document, tags);
    f.line_tags.resize(f.lines.size());
  }
  if (const NetcdfVariable* v = in.find(kMarkedPointsVariable)) {
    f.marked_points = read_int32(in, document, *v);
    const NetcdfVariable& tags = in.variable(kPointTagsVariable);
    expect_rows(document, tags, f.marked_points.size());
    f.point_tags = read_int32(in, document, tags);
    f.point_tags.resize(f.marked_points.size());
  }
  for (const NetcdfVariable& v : in.variables()) {
    const std::string kind = in.text_attribute(&v, kKindAttribute);
    for (const ExtraKind& row : kExtraKinds) {
      if (kind == row.name) read_own_data(in, document, v, row);
    }
  }
}

void add_netcdf_data(const NetcdfReader& in, const NetcdfVariable& v, std::vector<DataArray>& arrays) {
  Values values = in.values(v);
  for (const char* attribute : {"_FillValue", "missing_value"}) {
    if (const auto missing = in.number_attribute(&v, attribute)) make_nan(values, *missing);
  }
  arrays.push_back({v.name, 1, std::move(values)});
}

NetcdfMesh mesh_for_netcdf(const WriteJob& job, std::string_view format) {
  NetcdfMesh result{job.file, {}, {}};
  result.file.warnings.clear();
  auto made = make_mesh(result.file, {}, job.executor);
  if (!made) {
    fail(made.error().code, job.path, format, " holds orthocenters and so needs a valid mesh: ", made.error().what());
  }
  const bool weighted = !result.file.weights.empty();
  update(result.file, *made, made->mesh);
  if (!weighted) result.file.weights.clear();
  for (const std::string& w : made->warnings) job.warnings.push_back(w);
  result.mesh = std::move(made->mesh);
  result.complex = dec_operators(result.mesh);
  return result;
}

}  // namespace temper::io
