// The bed of water: depths, positive down (ADCIRC, SCHISM, FESOM), or levels, positive up (D-Flow FM).
//
// Point data are the bed if they have the name `depth` or that of D-Flow FM (mesh2d_node_z), if they are z of a 2DM
// file or z whose sign the user says, or if NetCDF said so by standard_name. They are levels if the user says so, or
// else NetCDF, by `positive` or standard_name, or else by their names.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "temper/io.hpp"

namespace temper::io {

/// The bed of water that a format has a place for.
enum class Bed {
  as_it_came,
  depth,  ///< point data `depth`, positive down
  level,  ///< point data `mesh2d_node_z`, positive up, except the depth of a NetCDF file
  z,      ///< point data `z`, positive up, and z of the points
};

inline constexpr std::string_view kDepth = "depth", kBedLevel = "mesh2d_node_z";

/// The bed among point data; null: the file has none.
[[nodiscard]] const DataArray* bed_of(const MeshFile& file);
/// Says whether the bed of the file has another sign or name than the format.
[[nodiscard]] bool needs_turned_bed(Bed bed, const MeshFile& file);
/// Gives the bed the sign and the name that the format has. Precondition: it needs it.
void turn_bed(MeshFile& file, Bed bed);

/// The text of an attribute that NetCDF gave to data of this name. Empty: it has no such attribute; nothing: the data
/// do not come from NetCDF.
[[nodiscard]] std::optional<std::string> netcdf_attribute(const MeshFile& file, std::string_view name,
                                                          const char* attribute);

}  // namespace temper::io
