// The content of a mesh file besides points, weights and triangles, in NetCDF of any convention. Each array is a
// variable of temper's own, with the attributes temper_kind (point, cell, line, marked or field) and temper_name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/containers/netcdf_file.hpp"
#include "io/formats/format.hpp"
#include "temper/dec.hpp"

namespace temper::io {

/// Dimensions of points and triangles, and the attributes that a convention prescribes for each variable.
struct NetcdfPositions {
  int points = -1, cells = -1;
  std::string mesh;  ///< UGRID: the name of the topology, for the attributes mesh and location; else empty
};
void write_netcdf_extras(NetcdfWriter& out, const WriteJob& job, const MeshFile& file, const NetcdfPositions& places);

/// Marks a variable as longitude or latitude, in degrees, by the names of CF.
void name_degrees(NetcdfWriter& out, int variable, std::string_view standard_name);

/// Regions, lines, marked points, names, z and data of temper's own.
void read_netcdf_extras(const NetcdfReader& in, Document& document);
/// Says whether a variable is one of temper's own.
[[nodiscard]] bool is_netcdf_extra(const NetcdfReader& in, const NetcdfVariable& variable);
/// Adds a variable with one number per element as data. Numbers that the file declares as missing become NaN.
void add_netcdf_data(const NetcdfReader& in, const NetcdfVariable& variable, std::vector<DataArray>& arrays);

/// The file without unused points, with counter-clockwise triangles; also its mesh and operators.
struct NetcdfMesh {
  MeshFile file;
  Mesh mesh;
  DecComplex complex;
};
[[nodiscard]] NetcdfMesh mesh_for_netcdf(const WriteJob& job, std::string_view format);

}  // namespace temper::io
