# The NetCDF library for C, 4.6.2 or later (files in memory): NetCDF::NetCDF. Found by pkg-config where there is one, else
# by name. (NetCDF's own CMake files ask for the development files of HDF5, which are not needed here.)
find_package(PkgConfig QUIET)
if(PKG_CONFIG_FOUND)
  pkg_check_modules(PC_NetCDF QUIET netcdf)
endif()

find_path(NetCDF_INCLUDE_DIR netcdf_mem.h HINTS ${PC_NetCDF_INCLUDE_DIRS} ${PC_NetCDF_INCLUDEDIR})
find_library(NetCDF_LIBRARY netcdf HINTS ${PC_NetCDF_LIBRARY_DIRS})
mark_as_advanced(NetCDF_INCLUDE_DIR NetCDF_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(NetCDF REQUIRED_VARS NetCDF_LIBRARY NetCDF_INCLUDE_DIR VERSION_VAR PC_NetCDF_VERSION)

if(NetCDF_FOUND AND NOT TARGET NetCDF::NetCDF)
  add_library(NetCDF::NetCDF UNKNOWN IMPORTED)
  set_target_properties(NetCDF::NetCDF PROPERTIES
    IMPORTED_LOCATION "${NetCDF_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${NetCDF_INCLUDE_DIR}")
endif()
