// The content of a mesh file besides points, weights and triangles, in NetCDF of any convention. Each array is a
// variable of temper's own, with the attributes temper_kind (point, cell, line, marked or field) and temper_name.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/containers/netcdf_file.hpp"
#include "io/formats/format.hpp"
#include "temper/dec.hpp"

namespace temper::io {

/// Collects from a file that is read what is to be kept.
class NetcdfCollector {
 public:
  /// Says whether an attribute need not be kept, from its name and its text, which it may change.
  using IsKnown = std::function<bool(std::string_view attribute, std::string& value)>;
  explicit NetcdfCollector(const NetcdfReader& in);
  /// The attributes of the file.
  void file(const IsKnown& is_known);
  /// The attributes of a variable that hold for its values as temper reads them, and its value if it is alone.
  void variable(const NetcdfVariable& v, const IsKnown& is_known = {}) { variable(v, v.name, is_known); }
  /// By another name.
  void variable(const NetcdfVariable& v, const std::string& name, const IsKnown& is_known = {});
  /// Puts all of it into the file's field data.
  void finish(MeshFile& file);

 private:
  void attributes(const NetcdfVariable* v, int to, const IsKnown& is_known);

  const NetcdfReader& in_;
  NetcdfWriter kept_;
  bool any_ = false;
};

/// Gives a file that is written what NetcdfCollector kept of the file that was read.
class NetcdfKept {
 public:
  explicit NetcdfKept(const MeshFile& file);
  /// The variable of that name, or null.
  [[nodiscard]] const NetcdfVariable* find(std::string_view name) const;
  /// The variable whose attribute has this text, or null.
  [[nodiscard]] const NetcdfVariable* find(const char* attribute, std::string_view value) const;
  /// Text of an attribute of a variable, or of the file when it is null; empty when there is none.
  [[nodiscard]] std::string text_of(const NetcdfVariable* variable, const char* attribute) const;
  [[nodiscard]] std::optional<double> number_of(const NetcdfVariable* variable, const char* attribute) const;
  /// Copies all attributes of a variable, or of the file when it is null; or one of a name.
  void copy(const NetcdfVariable* from, NetcdfWriter& out, int variable, std::string_view only = {}) const;
  /// Writes the variables with a value that `out` does not have.
  void write_values(NetcdfWriter& out) const;

 private:
  std::unique_ptr<Source> bytes_;
  std::unique_ptr<NetcdfReader> in_;
};

/// Dimensions of points and triangles, and the attributes that a convention prescribes for each variable.
struct NetcdfPositions {
  int points = -1, cells = -1;
  const NetcdfKept& kept;
  std::string mesh = {};  ///< UGRID: the name of the topology, for the attributes mesh and location; else empty
};
void write_netcdf_extras(NetcdfWriter& out, const WriteJob& job, const MeshFile& file, const NetcdfPositions& places);

/// Marks a variable as longitude or latitude, in degrees, by the names of CF.
void name_degrees(NetcdfWriter& out, int variable, std::string_view standard_name);

/// Regions, lines, marked points, names, z and data of temper's own.
void read_netcdf_extras(const NetcdfReader& in, Document& document, NetcdfCollector& kept);
/// Says whether a variable is kept though it is no array: a number without dimensions, or a coordinate system.
[[nodiscard]] bool is_kept_alone(const NetcdfReader& in, const NetcdfVariable& variable);
/// Says whether a variable is one of temper's own.
[[nodiscard]] bool is_netcdf_extra(const NetcdfReader& in, const NetcdfVariable& variable);
/// Adds a variable with one number per element as data, unpacked, and keeps its attributes; by another name if there is
/// one.
void add_netcdf_data(const NetcdfReader& in, const NetcdfVariable& variable, std::vector<DataArray>& arrays,
                     NetcdfCollector& kept, const std::string& name = {});

/// Warns of variables without a place in a mesh file.
void warn_of_dropped(Document& document, const std::vector<std::string_view>& names);

/// The file without unused points, with counter-clockwise triangles; also its mesh and operators.
struct NetcdfMesh {
  MeshFile file;
  Mesh mesh;
  DecComplex complex;
};
[[nodiscard]] NetcdfMesh mesh_for_netcdf(const WriteJob& job, std::string_view format);

}  // namespace temper::io
